//! Files that are large, deep, endless or damaged: they end soon, and with a message.

use crate::{options, read, says};
use lgp::shader::{Error, LARGEST_SHADER, Options, Shader};
use std::time::{Duration, Instant};

/// By hand: tests share a machine, and parsers are compiled without optimisation.
const PATIENCE: Duration = Duration::from_secs(60);

/// Reads, evaluates, and writes down as a program; returns the first failure.
fn tried(file: &str, text: &str, point: &[f64]) -> Result<Vec<f64>, Error> {
    let start = Instant::now();
    let tried = read(file, text).and_then(|shader| {
        let values = shader.at(point)?;
        let _ = shader.program();
        Ok(values)
    });
    assert!(start.elapsed() < PATIENCE, "{file}: {:?}", start.elapsed());
    tried
}

#[test]
fn many_functions_are_read() {
    let (mut wgsl, mut glsl) = (String::new(), String::new());
    for i in 0..20_000 {
        wgsl += &format!("fn g{i}(x: f32) -> f32 {{\n    return x * {i}.0;\n}}\n\n\n");
        glsl += &format!("float g{i}(float x) {{\n    return x * {i}.0;\n}}\n\n\n");
    }
    says(&tried("many.wgsl", &wgsl, &[1.0]).unwrap_err(), &["several functions", "--entry g0"]);
    says(&tried("many.glsl", &glsl, &[1.0]).unwrap_err(), &["several functions", "--entry g0"]);
    let told = tried("many.wgsl", &wgsl, &[1.0]).unwrap_err().to_string();
    assert!(told.len() < 300, "{told}");
    let with = options("g7", &[], &[], &[]);
    let shader = Shader::parse("many.wgsl".as_ref(), wgsl.into(), &with).unwrap();
    assert_eq!(shader.at(&[2.0]).unwrap(), [14.0]);
}

#[test]
fn long_expressions_are_read_or_refused() {
    let sum = vec!["x"; 100_000].join(" + ");
    let wgsl = tried("sum.wgsl", &format!("fn f(x: f32) -> f32 {{ return {sum}; }}"), &[0.5]);
    assert_eq!(wgsl.unwrap(), [50_000.0]);
    let glsl = tried("sum.glsl", &format!("float f(float x) {{ return {sum}; }}"), &[0.5]);
    assert_eq!(glsl.unwrap(), [50_000.0]);
    let lines = "    y = y + x;\n".repeat(100_000);
    let text = format!("float f(float x) {{\n    float y = 0.0;\n{lines}    return y;\n}}");
    assert_eq!(tried("lines.glsl", &text, &[0.5]).unwrap(), [50_000.0]);
}

#[test]
fn deep_texts_are_refused() {
    let of = |file: &str, expression: &str| {
        let text = match file.ends_with("wgsl") {
            true => format!("fn f(x: f32) -> f32 {{ return {expression}; }}"),
            false => format!("float f(float x) {{ return {expression}; }}"),
        };
        tried(file, &text, &[0.5])
    };
    for file in ["deep.wgsl", "deep.glsl"] {
        let bracketed = |n: usize| format!("{}x{}", "(".repeat(n), ")".repeat(n));
        says(&of(file, &bracketed(100_000)).unwrap_err(), &[file, "line 1", "256 deep"]);
        assert_eq!(of(file, &bracketed(100)).unwrap(), [0.5]);
        let negated = format!("{}x", "- ".repeat(100_000));
        match of(file, &negated) {
            Ok(values) => assert_eq!(values, [0.5]),
            Err(error) => says(&error, &[file]),
        }
        let calls = |n: usize| format!("{}x{}", "sin(".repeat(n), ")".repeat(n));
        assert!(of(file, &calls(100)).is_ok());
        if let Err(error) = of(file, &calls(200)) {
            says(&error, &[file, "nested too deep"]);
        }
    }
    let choices = format!("{}x", "x > 0.5 ? 1.0 : ".repeat(100_000));
    match of("choices.glsl", &choices) {
        Ok(values) => assert_eq!(values, [0.5]),
        Err(error) => says(&error, &["choices.glsl"]),
    }
}

#[test]
fn chains_of_branches_are_read_up_to_a_depth() {
    let chain = |n: usize, condition: &str| -> String {
        (0..n).map(|i| format!("if ({condition}) {{ y = {i}.0; }}\nelse ")).collect()
    };
    let of = |file: &str, n: usize| {
        let chain = chain(n, "x > 2.0");
        let text = match file.ends_with("wgsl") {
            true => {
                format!("fn f(x: f32) -> f32 {{ var y = x; {chain} {{ y = 9.0; }} return y; }}")
            }
            false => {
                format!("float f(float x) {{ float y = x; {chain} {{ y = 9.0; }} return y; }}")
            }
        };
        tried(file, &text, &[0.5])
    };
    for file in ["chain.wgsl", "chain.glsl"] {
        assert_eq!(of(file, 100).unwrap(), [9.0], "{file}");
        says(&of(file, 100_000).unwrap_err(), &[file, "line 402", "nested more than 400 deep"]);
    }
    // Such tables of colors exist.
    assert_eq!(of("chain.glsl", 256).unwrap(), [9.0]);
}

#[test]
fn endless_and_long_loops_end() {
    for (file, body) in [
        (
            "a.wgsl",
            "var y = x; for (var i = 0; i < 1000000000; i++) { y = y * 0.5 + 1.0; } return y;",
        ),
        ("b.wgsl", "var y = x; loop { y = y * 0.5; continuing { break if y > 8.0; } } return y;"),
        ("c.wgsl", "var y = x; while (y < 2.0) { y = y * 0.5; } return y;"),
    ] {
        let text = format!("fn f(x: f32) -> f32 {{ {body} }}");
        says(&tried(file, &text, &[0.5]).unwrap_err(), &[file, "line 1", "steps", "no end"]);
        let program = read(file, &text).unwrap().program();
        assert!(program.is_err());
    }
    let slow = "fn g(x: f32) -> f32 { var y = x; for (var i = 0; i < 40; i++) {
        if (fract(y * f32(i)) < 0.5) { break; } y += 1.0; } return y; }
fn f(x: f32) -> f32 { var y = x; for (var i = 0; i < 40; i++) { y += g(y); } return y; }";
    assert!(tried("paths.wgsl", slow, &[0.5]).is_ok());
}

/// Every sample of an endless loop runs into the bound, but not all are tried.
#[test]
fn functions_that_fail_everywhere_fail_once() {
    let (domain, text) =
        ("x=0..1", "fn f(x: f32) -> f32 { var y = x; loop { y += 1.0; } return y; }");
    let start = Instant::now();
    let shader = read("endless.wgsl", text).unwrap();
    let truth = shader.truth(&lgp::truth::parse_domain(domain).unwrap()).unwrap();
    let told = truth.dataset(None, &|_, _| ()).unwrap_err().to_string();
    assert!(told.contains("more than 100000000 steps"), "{told}");
    assert!(start.elapsed() < 4 * PATIENCE, "{:?}", start.elapsed());
}

#[test]
fn calls_that_double_end() {
    let mut text = "fn g0(x: f32) -> f32 { return x * 0.5; }\n".to_owned();
    for i in 1..60 {
        let before = i - 1;
        text += &format!("fn g{i}(x: f32) -> f32 {{ return g{before}(g{before}(x)); }}\n");
    }
    says(&tried("double.wgsl", &text, &[0.5]).unwrap_err(), &["double.wgsl", "steps"]);
    let chain: String = (1..2000)
        .map(|i| format!("fn g{i}(x: f32) -> f32 {{ return g{}(x); }}\n", i - 1))
        .collect();
    let text = format!("fn g0(x: f32) -> f32 {{ return x; }}\n{chain}");
    says(&tried("chain.wgsl", &text, &[0.5]).unwrap_err(), &["chain.wgsl", "deep"]);
}

#[test]
fn large_arrays_are_refused_or_small() {
    for (file, text) in [
        (
            "a.wgsl",
            "var<private> a: array<f32, 1000000000>; fn f(x: f32) -> f32 { return a[3] + x; }",
        ),
        (
            "b.wgsl",
            "fn f(x: f32) -> f32 { var a: array<array<array<f32, 1000>, 1000>, 1000>; return a[1][1][1] + x; }",
        ),
        (
            "c.wgsl",
            "@group(0) @binding(0) var<uniform> a: array<vec4<f32>, 4000000>; fn f(x: f32) -> f32 { return a[1].x + x; }",
        ),
        (
            "e.wgsl",
            "struct S { a: array<f32, 200000>, b: array<f32, 200000> } fn f(x: f32) -> f32 { var a: array<S, 100>; return a[1].a[1] + x; }",
        ),
        (
            "g.wgsl",
            "fn f(x: f32) -> f32 { var a: array<f32, 200000>; var b = a; var c = b; return a[1] + b[1] + c[1] + x; }",
        ),
        ("d.glsl", "float a[2000000000]; float f(float x) { return a[1] + x; }"),
    ] {
        says(&tried(file, text, &[0.5]).unwrap_err(), &[file]);
    }
    let copied = "fn f(x: f32) -> f32 {
        var a: array<f32, 100000>; var sum = x;
        for (var i = 0; i < 100000; i++) { a[i] = x; sum += a[i]; }
        return sum;
    }";
    assert_eq!(tried("copied.wgsl", copied, &[0.5]).unwrap(), [50_000.5]);
    for (file, step) in [
        ("copies.wgsl", "b = a; a = b; y += a[i % 7];"),
        ("paths.wgsl", "if (y > x) { a[1] = y; } else { a[2] = y; } y += a[2] + 1.0;"),
        ("ways.wgsl", "if (y > x + f32(i)) { return a[3]; } y += 0.5;"),
        ("zeros.wgsl", "let c = array<f32, 100000>(); y += c[i % 7];"),
    ] {
        let text = format!(
            "fn f(x: f32) -> f32 {{ var a: array<f32, 100000>; var b: array<f32, 100000>; var y = x;
            for (var i = 0; i < 1000000; i++) {{ {step} }} return y; }}"
        );
        let shader = read(file, &text).unwrap();
        let start = Instant::now();
        let (values, program) = (shader.at(&[0.5]), shader.program());
        assert!(start.elapsed() < PATIENCE, "{file}: {:?}", start.elapsed());
        assert!(program.is_err(), "{file}");
        if let Err(error) = values {
            says(&error, &[file, "line 2", "steps"]);
        }
    }
    let table: String = (0..4096).map(|i| format!("{i}.0, ")).collect();
    let looked_up = format!(
        "const TABLE = array<f32, 4096>({table});
fn f(x: f32) -> f32 {{ var y = x; for (var i = 0; i < 40960; i++) {{ y += TABLE[i % 4096]; }} return y; }}"
    );
    assert_eq!(tried("table.wgsl", &looked_up, &[0.5]).unwrap(), [83_865_600.5]);
}

#[test]
fn empty_and_damaged_files_are_refused() {
    for file in ["e.wgsl", "e.glsl", "e.hlsl", "e.slang", "e.spv"] {
        let whole = |bytes: Vec<u8>| Shader::parse(file.as_ref(), bytes, &Options::default());
        says(&whole(Vec::new()).unwrap_err(), &[file]);
        says(&whole(vec![0; 4096]).unwrap_err(), &[file]);
        let noise = (0..4096u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
        says(&whole(noise).unwrap_err(), &[file]);
        says(&whole(b"float f(float x) {\n \xff\xfe }".to_vec()).unwrap_err(), &[file]);
    }
    let error = Shader::parse("u.wgsl".as_ref(), b"\n\n\xff".to_vec(), &Options::default());
    says(&error.unwrap_err(), &["u.wgsl", "line 3 is not UTF-8"]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.wgsl");
    let file = std::fs::File::create(&path).unwrap();
    file.set_len(LARGEST_SHADER + 1).unwrap();
    says(&Shader::load(&path, &Options::default()).unwrap_err(), &["large.wgsl", "16 MiB"]);
    says(&Shader::load(folder.path(), &Options::default()).unwrap_err(), &["not a shader"]);
    let absent = Shader::load(&folder.path().join("absent.wgsl"), &Options::default());
    says(&absent.unwrap_err(), &["absent.wgsl"]);
}

#[test]
fn numbers_that_are_none_are_numbers() {
    let of = |expression: &str| {
        tried("n.glsl", &format!("float f(float x) {{ return {expression}; }}"), &[0.5])
    };
    assert_eq!(of("x / 0.0").unwrap(), [f64::INFINITY]);
    assert!(of("sqrt(x - 1.0)").unwrap()[0].is_nan());
    for expression in ["1.0 / 0.0 + x", "0.0 / 0.0 + x", "float(1 / 0) + x", "float(3 % 0) + x"] {
        if let Err(error) = of(expression) {
            says(&error, &["n.glsl, line 1"]);
        }
    }
    let wgsl = "fn f(x: f32) -> f32 { let zero = i32(x) ; return f32(7 / zero + 7 % zero) + x; }";
    assert_eq!(tried("n.wgsl", wgsl, &[0.5]).unwrap(), [7.5]);
    let least = "fn f(x: f32) -> f32 { let a = -2147483647 - i32(x); return f32(a / -i32(x) + a % -i32(x)); }";
    assert_eq!(tried("l.wgsl", least, &[1.0]).unwrap(), [-2_147_483_648.0]);
    let shifted = "fn f(x: f32) -> f32 { let n = u32(x); return f32((1u << n) + (8u >> n)); }";
    assert_eq!(tried("s.wgsl", shifted, &[33.0]).unwrap(), [6.0]);
}

#[test]
fn macros_that_grow_end() {
    let mut text = "#define A0 x + x\n".to_owned();
    for i in 1..40 {
        text += &format!("#define A{i} A{} + A{}\n", i - 1, i - 1);
    }
    let start = Instant::now();
    let error = read("grow.glsl", &format!("{text}float f(float x) {{ return A39; }}"));
    says(&error.unwrap_err(), &["grow.glsl, line", "macros make too much"]);
    assert!(start.elapsed() < PATIENCE);
}
