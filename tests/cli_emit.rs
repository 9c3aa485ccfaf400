//! `lgp emit`: engines, signatures, and what `lgp verify` makes of them.

mod command;

use command::{lgp_here, text};
use lgp::emit::Engine;
use std::path::Path;
use std::process::Output;

const RUN: &str = "tests/fixtures/dfg";
const DATA: &str = "datasets/dfg.bin";

/// Emits to a file of the folder, and verifies that.
fn emitted_and_verified(folder: &Path, file: &str, form: &[&str]) -> (String, Output) {
    let path = folder.join(file);
    let output = ["-o", path.to_str().unwrap()];
    let emit = lgp_here(&[&["emit", RUN, "--max-cost", "12"], form, &output].concat());
    assert!(emit.status.success(), "{form:?}: {}", text(&emit.stderr));
    let code = std::fs::read_to_string(&path).unwrap();
    assert!(code.is_ascii(), "{code}");
    let verify = lgp_here(&["verify", path.to_str().unwrap(), DATA, "--max-error", "0.012"]);
    (code, verify)
}

fn is_verified(file: &str, form: &[&str], says: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let (code, verify) = emitted_and_verified(folder.path(), file, form);
    assert_eq!(verify.status.code(), Some(0), "{}\n{code}", text(&verify.stderr));
    assert!(text(&verify.stdout).contains(says), "{}\n{code}", text(&verify.stdout));
    code
}

const AS_COMMENTED: &str = "computes the formula in its comment";

#[test]
fn a_file_for_each_engine_is_verified() {
    for engine in Engine::ALL {
        let file = format!("dfg.{}", engine.extension());
        let of_engine = ["--for", engine.name()];
        is_verified(&file, &of_engine, AS_COMMENTED);
        is_verified(&file, &[&of_engine[..], &["--clamp-inputs"]].concat(), AS_COMMENTED);
        let bare = is_verified(
            &file,
            &[&of_engine[..], &["--no-comments"]].concat(),
            "no formula in its comment",
        );
        assert!(!bare.contains("// "), "{bare}");
        let half = [&of_engine[..], &["--half"]].concat();
        match engine.has_halves() {
            true => drop(is_verified(&file, &half, AS_COMMENTED)),
            false => {
                let output = lgp_here(&[&["emit", RUN], &half[..]].concat());
                assert_eq!(output.status.code(), Some(2), "{engine}");
                assert!(text(&output.stderr).contains("has no halves"), "{engine}");
            }
        }
    }
}

#[test]
fn a_function_under_a_given_head_is_verified() {
    for (file, form, line) in [
        (
            "a.glsl",
            &["--lang", "glsl", "--signature", "vec2 EnvDFG(float roughness, float nov)"][..],
            "vec2 EnvDFG(float roughness, float nov) {",
        ),
        (
            "b.glsl",
            &[
                "--lang",
                "glsl",
                "--signature",
                "vec2 EnvDFG(vec2 uv)",
                "--let",
                "n_dot_v = uv.y; roughness = sqrt(uv.x)",
                "--let",
                "return.x = bias; return.y = scale",
            ],
            "vec2 EnvDFG(vec2 uv) {",
        ),
        (
            "c.hlsl",
            &[
                "--lang",
                "hlsl",
                "--signature",
                "float3 Env(float3 N, float3 V, float rough, float f0)",
                "--let",
                "n_dot_v = saturate(dot(N, V))",
                "--let",
                "roughness = rough",
                "--let",
                "return.x = f0*scale + bias; return.y = scale + bias; return.z = 0",
            ],
            "saturate(N.x*V.x + N.y*V.y + N.z*V.z)",
        ),
        (
            "d.wgsl",
            &[
                "--lang",
                "wgsl",
                "--half",
                "--signature",
                "fn F_AB(perceptual_roughness: f16, NdotV: f16) -> vec2<f16>",
            ],
            "fn F_AB(perceptual_roughness: f16, NdotV: f16) -> vec2<f16> {",
        ),
        (
            "e.metal",
            &[
                "--lang",
                "msl",
                "--signature",
                "void f(float roughness, float n_dot_v, thread float2 &dfg)",
                "--let",
                "dfg.x = bias; dfg.y = scale + bias",
            ],
            "    dfg = float2(",
        ),
        (
            "f.hpp",
            &[
                "--lang",
                "cpp",
                "--clamp-inputs",
                "--signature",
                "static inline void EnvDFG(float roughness, float nov, float &scale, float &bias)",
            ],
            "static inline void EnvDFG(",
        ),
        (
            "k.c",
            &[
                "--lang",
                "c",
                "--signature",
                "static void env(float roughness, float nov, float *scale, float *bias)",
            ],
            "    *bias = ",
        ),
        (
            "l.wgsl",
            &[
                "--lang",
                "wgsl",
                "--signature",
                "fn env(roughness: f32, nov: f32, dfg: ptr<function, vec2<f32>>)",
                "--let",
                "dfg.x = scale; dfg.y = bias",
            ],
            "    *dfg = vec2<f32>(",
        ),
        (
            "m.rs",
            &[
                "--lang",
                "rust",
                "--signature",
                "fn env(roughness: f32, nov: f32, scale: &mut f32, bias: &mut f32)",
            ],
            "    *scale = ",
        ),
        (
            "n.hlsl",
            &[
                "--lang",
                "hlsl",
                "--signature",
                "float3 Env(float3 F0, float rough, float3 N, float4 V, float unused)",
                "--let",
                "n_dot_v = saturate(dot(N, normalize(V.xyz))); roughness = rough",
                "--let",
                "return = F0.rgb*scale + bias",
            ],
            "float3 Env(float3 F0, float rough, float3 N, float4 V, float unused) {",
        ),
        (
            "o.tsl.js",
            &["--lang", "tsl", "--signature", "const env = Fn(([roughness, dotNV]) => {"],
            "\nconst env = Fn(([roughness, dotNV]) => {",
        ),
        (
            "q.glsl",
            &[
                "--lang",
                "glsl",
                "--signature",
                "vec2 dfg(const in float roughness, in float dotNV)",
            ],
            "vec2 dfg(const in float roughness, in float dotNV) {",
        ),
        (
            "r.cu",
            &[
                "--lang",
                "cuda",
                "--signature",
                "static __device__ float2 dfg(float roughness, float NoV)",
            ],
            "\nstatic __device__ float2 dfg(float roughness, float NoV) {",
        ),
        (
            "s.hlsl",
            &[
                "--for",
                "unity",
                "--signature",
                "void Env_float(float NdotV, float Roughness, out float Scale, out float Bias)",
            ],
            "void Env_half(half NdotV, half Roughness, out half Scale, out half Bias) {",
        ),
        (
            "t.hlsl",
            &[
                "--for",
                "unity",
                "--signature",
                "void Env_half(float3 F0, float NdotV, float Roughness, out float3 Out)",
                "--let",
                "Out = F0*scale + bias",
            ],
            "void Env_float(float3 F0, float NdotV, float Roughness, out float3 Out) {",
        ),
        (
            "p.js",
            &["--lang", "js", "--signature", "function env(roughness, dotNV)"],
            "\nfunction env(roughness, dotNV) {",
        ),
        (
            "g.py",
            &["--lang", "python", "--signature", "env(roughness, nov)"],
            "def env(roughness, nov):",
        ),
        ("h.tsl.js", &["--lang", "tsl", "--name", "envDFG"], "export const envDFG = Fn("),
        (
            "i.mtlx",
            &["--lang", "materialx", "--name", "env"],
            "<nodedef name=\"ND_env\" node=\"env\">",
        ),
        ("j.rs", &["--lang", "rust", "--name", "env", "--clamp-inputs"], "pub fn env("),
    ] {
        let code = is_verified(file, form, AS_COMMENTED);
        assert!(code.contains(line), "{code}");
    }
}

#[test]
fn the_functions_for_engines_compute_their_formulas() {
    let folder = Path::new("results/engines");
    let table = std::fs::read_to_string(folder.join("dropins.csv")).unwrap();
    let rows: Vec<Vec<&str>> =
        table.lines().skip(1).map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 8);
    for row in rows {
        let [_, file, data, ..] = row.as_slice() else { panic!("{row:?}") };
        let [file, data] = [format!("results/engines/{file}"), format!("datasets/{data}.bin")];
        let verify = lgp_here(&["verify", &file, &data, "--max-error", "0.015"]);
        assert!(verify.status.success(), "{file}: {}", text(&verify.stderr));
        assert!(text(&verify.stdout).contains(AS_COMMENTED), "{file}: {}", text(&verify.stdout));
    }
}

#[test]
fn what_no_comment_says_is_said_to_verify() {
    let folder = tempfile::tempdir().unwrap();
    let head = ["--signature", "vec2 env(float alpha, float nov)", "--no-comments"];
    let lets = ["--let", "roughness = sqrt(alpha)"];
    let path = folder.path().join("env.glsl");
    let out = ["-o", path.to_str().unwrap()];
    let emit = lgp_here(&[&["emit", RUN, "--lang", "glsl"], &head[..], &lets, &out].concat());
    assert!(emit.status.success(), "{}", text(&emit.stderr));
    let verify = |lets: &[&str]| {
        let arguments = ["verify", path.to_str().unwrap(), DATA, "--max-error", "0.1"];
        lgp_here(&[&arguments[..], lets].concat())
    };
    let without = verify(&[]);
    assert!(text(&without.stderr).contains("takes `alpha`"), "{}", text(&without.stderr));
    let with = verify(&[&lets[..], &["--outputs", "scale,bias"]].concat());
    assert!(with.status.success(), "{}", text(&with.stderr));
}

#[test]
fn outputs_that_are_derived_of_the_data_are_verified_by_it() {
    let folder = tempfile::tempdir().unwrap();
    let [run, path] = ["run", "dfg.glsl"].map(|name| folder.path().join(name));
    let [run, path] = [&run, &path].map(|path| path.to_str().unwrap());
    let derived = ["--derive", "total = scale + bias", "--outputs", "bias,total"];
    let short = ["--generations", "2", "--out", run, "-q"];
    let search = lgp_here(&[&["search", DATA], &derived[..], &short].concat());
    assert!(search.status.success(), "{}", text(&search.stderr));
    let head = ["--signature", "vec2 dfg(float roughness, float NoV)"];
    let lets = ["--let", "return.x = max(total - bias, 0); return.y = bias"];
    let emit = lgp_here(&[&["emit", run, "--lang", "glsl", "-o", path], &head[..], &lets].concat());
    assert!(emit.status.success(), "{}", text(&emit.stderr));
    let code = std::fs::read_to_string(path).unwrap();
    assert!(code.contains("// derived: total = scale + bias\n"), "{code}");
    let verify = lgp_here(&["verify", path, DATA, "--max-error", "1"]);
    assert!(verify.status.success(), "{}", text(&verify.stderr));
    assert!(text(&verify.stdout).contains(AS_COMMENTED), "{}", text(&verify.stdout));
}

#[test]
fn one_output_is_returned_by_its_name() {
    let code = is_verified(
        "bias.glsl",
        &[
            "--lang",
            "glsl",
            "--signature",
            "float Env(float roughness, float nov, float f0)",
            "--let",
            "return = f0*scale + bias",
        ],
        AS_COMMENTED,
    );
    assert!(code.contains("// let: return = f0*scale + bias"), "{code}");
    assert!(code.contains("as it is called here: 13 cycles"), "{code}");
}

#[test]
fn a_changed_conversion_or_number_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let form = [
        "--lang",
        "glsl",
        "--signature",
        "vec2 f(float alpha, float nov)",
        "--let",
        "roughness = sqrt(alpha)",
    ];
    let (code, _) = emitted_and_verified(folder.path(), "f.glsl", &form);
    let path = folder.path().join("f.glsl");
    for (from, to) in [("sqrt(alpha);", "alpha;"), ("16.0", "16.1")] {
        assert!(code.contains(from), "{code}");
        std::fs::write(&path, code.replace(from, to)).unwrap();
        let verify = lgp_here(&["verify", path.to_str().unwrap(), DATA, "--max-error", "1"]);
        assert_eq!(verify.status.code(), Some(4), "{}", text(&verify.stdout));
        assert!(text(&verify.stderr).contains("does not compute the formula"), "{from}");
    }
}

/// What only a compiler would see: results in other places, parts of a dot product, a script's text.
#[test]
fn what_a_compiler_would_understand_otherwise_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let three_results = [
        "--lang",
        "hlsl",
        "--signature",
        "float3 Env(float3 n, float3 v, float roughness, float f0)",
        "--let",
        "n_dot_v = dot(n, v)",
        "--let",
        "return.x = f0*scale + bias; return.y = scale; return.z = bias",
    ];
    let by_parameter = [
        "--lang",
        "hlsl",
        "--signature",
        "void Env(float2 uv, out float2 res)",
        "--let",
        "n_dot_v = uv.x; roughness = uv.y; res.x = scale; res.y = bias",
    ];
    let by_type = |language| vec!["--lang", language];
    for (file, form, from, to) in [
        ("a.hlsl", three_results.to_vec(), "n.y*v.y", "7.0*n.y*v.y"),
        ("b.hlsl", three_results.to_vec(), " + n.y*v.y", ""),
        ("c.hlsl", three_results.to_vec(), "return_x, return_y", "return_y, return_x"),
        ("d.hlsl", by_parameter.to_vec(), "(res_x, res_y)", "(res_y, res_x)"),
        ("e.hlsl", by_type("hlsl"), "(scale, bias)", "(bias, scale)"),
        ("f.py", by_type("python"), "return scale, bias", "return bias, scale"),
        ("g.rs", by_type("rust"), "(scale, bias)\n", "(bias, scale)\n"),
        ("h.c", by_type("c"), "{ scale, bias }", "{ bias, scale }"),
        ("i.hpp", by_type("cpp"), "float scale;\n    float bias;", "float bias;\n    float scale;"),
        ("j.js", by_type("js"), "return [", "return\n        ["),
        ("k.tsl.js", by_type("tsl"), "max, ", "max as min, min as max, "),
        ("l.tsl.js", by_type("tsl"), "mul(0.15, t0)", "0.15*t0"),
        ("m.glsl.js", vec!["--for", "three"], "`;", "`.replace('0.9', '0.1');"),
        ("n.glsl.js", vec!["--for", "three"], "    float t1", "    // \\n t1 = 0.0;\n    float t1"),
        (
            "o.glsl.js",
            vec!["--for", "three"],
            "export const",
            "String.raw = () => 0;\nexport const",
        ),
        ("p.glsl.js", vec!["--for", "three"], "/* glsl */`", "hlsl`"),
        ("q.glsl", vec!["--lang", "glsl", "--clamp-inputs"], "clamp(n_dot_v, 0.0, 1.0)", "n_dot_v"),
        (
            "r.osl",
            by_type("osl"),
            "output float scale, output float bias",
            "output float bias, output float scale",
        ),
        (
            "s.glsl",
            by_type("glsl"),
            "float n_dot_v, float roughness",
            "float roughness, float n_dot_v",
        ),
        ("t.c", by_type("c"), "float scale;", "float sale;"),
        ("u.rs", by_type("rust"), "    let t1", "    /* a /* b */ /* c */ let t1"),
        ("v.py", by_type("python"), "    return", "return"),
        ("w.py", by_type("python"), "    t1 =", "  t1 ="),
        ("x.js", by_type("js"), ", 0.0)", ", 00)"),
        ("y.mtlx", by_type("materialx"), "<output", "1 <output"),
        ("z.gdshaderinc", vec!["--for", "godot"], "#endif", ""),
    ] {
        let (code, _) = emitted_and_verified(folder.path(), file, &form);
        assert!(code.contains(from), "{file}: {code}");
        let path = folder.path().join(file);
        std::fs::write(&path, code.replacen(from, to, 1)).unwrap();
        let verify = lgp_here(&["verify", path.to_str().unwrap(), DATA, "--max-error", "1"]);
        let status = verify.status.code();
        assert!(matches!(status, Some(3 | 4)), "{file}: {}", text(&verify.stdout));
    }
}

/// Both functions of a file in two precisions are looked at.
#[test]
fn a_changed_function_of_halves_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let (code, _) = emitted_and_verified(folder.path(), "dfg.hlsl", &["--for", "unity"]);
    let path = folder.path().join("dfg.hlsl");
    std::fs::write(&path, code.replace("half(16.0)", "half(17.0)")).unwrap();
    let verify = lgp_here(&["verify", path.to_str().unwrap(), DATA, "--max-error", "1"]);
    assert_eq!(verify.status.code(), Some(4), "{}", text(&verify.stdout));
}

#[test]
fn what_does_not_fit_is_refused_with_its_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("old.hlsl");
    std::fs::write(&file, "old").unwrap();
    for (form, expected) in [
        (&["--signature", "float2 f(float rough, float nov)"][..], "--let \"roughness = …\""),
        (&["--signature", "float3 f(float roughness, float nov)"], "3 values are returned"),
        (
            &["--signature", "float f(float roughness, float nov)"],
            "1 value is returned, but 2 outputs are left for it (scale, bias)",
        ),
        (
            &[
                "--signature",
                "float3 f(float2 f0, float roughness, float nov)",
                "--let",
                "return = f0*scale",
            ],
            "`return` has 3 components, but is given 2",
        ),
        (
            &["--signature", "float2 f(float2 uv)", "--let", "n_dot_v = uv.z; roughness = uv.x"],
            "`uv` has the components `xy`, and no `z`\n  uv.z",
        ),
        (&["--let", "roughness = n_dot_v/0"], "no values of the parameters make it one in [0, 1]"),
        (&["--signature", "half2 f(half roughness, half nov)"], "give --half or --half-error"),
        (&["--signature", "float2 sample(float roughness, float nov)"], "`sample` means something"),
        (&["--signature", "float2 f(float roughness, float nov"], "expected `,`"),
        (&["--signature", "float2 f(double roughness, float nov)"], "cannot be the type"),
        (&["--let", "alpha = 3"], "neither an input (n_dot_v, roughness) nor a result"),
        (&["--let", "roughness = alpha*alpha"], "`alpha`"),
        (&["--let", "roughness"], "expected `name = expression`"),
        (&["--let", "roughness = n_dot_v; roughness = 1"], "given twice"),
        (&["--signature", "void f(float roughness, float nov)"], "nothing is returned"),
        (
            &["--signature", "float2 f(float n, float roughness)", "--let", "n_dot_v = dot(n, n)"],
            "`dot` is of vectors",
        ),
        (
            &[
                "--signature",
                "float2 f(float roughness, float nov)",
                "--let",
                "return.y = scale*bias",
            ],
            "--let \"return.x = scale\"",
        ),
        (
            &["--signature", "float2 f(float roughness, float nov, float NoV)"],
            "several parameters may be `n_dot_v`: nov, NoV",
        ),
        (&["--name", "2x"], "no name of a function in hlsl"),
        (&["--name", "saturate"], "no name of a function in hlsl"),
        (
            &["--signature", "void f(float roughness, float nov, out float energy)"],
            "leaves by `energy`",
        ),
    ] {
        let output = ["-o", file.to_str().unwrap()];
        let emit = lgp_here(&[&["emit", RUN, "--lang", "hlsl"], form, &output].concat());
        let message = text(&emit.stderr);
        assert_eq!(emit.status.code(), Some(2), "{form:?}: {message}");
        assert!(message.contains(expected), "{form:?}: {message}");
        assert_eq!(std::fs::read_to_string(&file).unwrap(), "old");
    }
    let unknown = lgp_here(&["emit", RUN, "--for", "untiy"]);
    assert!(text(&unknown.stderr).contains("did you mean `unity`?"), "{}", text(&unknown.stderr));
    assert_eq!(lgp_here(&["emit", RUN]).status.code(), Some(2));
}
