//! HLSL and Slang: by way of a compiler, and without one.

use crate::{options, read, read_with, says, tools};
#[cfg(feature = "cli")]
use std::process::Command;

fn compiles() -> bool {
    tools::found(&["glslangValidator", "--version"], "HLSL was not compiled")
}

const TEXT: &str = "
static const float WEIGHTS[3] = { 0.25, 0.5, 0.25 };
static const float3x3 TURN = float3x3(1.0, 2.0, 3.0,  4.0, 5.0, 6.0,  7.0, 8.0, 10.0);
cbuffer Camera : register(b0) { float exposure; row_major float4x4 view; };
Texture2D<float4> image : register(t0);
SamplerState sampling;

float3 tone(float3 color) { return saturate(color * exposure); }

[noinline]
void shade(float3 p : TEXCOORD0, float x : TEXCOORD1, out float3 result : SV_Target,
           out float sum, uniform float gain = 1.0f)
{
    sum = 0;
    [unroll]
    for (int i = 0; i < 3; i++) { sum += WEIGHTS[i] * pow(abs(x), (float)i); }
    result = lerp(mul(TURN, p), mul(p, TURN), 0.5) * frac(x * 2.5) + TURN[1].z;
    result.xy += float2(TURN._m01, TURN._m10) + rcp(1 + x) + mad(x, 2.0, 1.0);
    if (any(p < 0)) { result = tone(result); }
    x += 1;
}
float4 textured(float2 uv) { return image.Sample(sampling, uv); }
float plain(float x) { clip(x); return ddx(x); }
float looped(float x) {
    [loop] for (int i = 0; i < 8; i++) { if (x > 2.0) break; x = x * 1.5 + 0.125; }
    return x;
}
";

#[test]
fn hlsl_is_compiled_and_read() {
    if !compiles() {
        return;
    }
    let with = options("shade", &["exposure=0.5", "gain=1.0"], &[], &[]);
    let shader = read_with("shade.hlsl", TEXT, &with).unwrap();
    assert_eq!(shader.inputs(), ["p_x", "p_y", "p_z", "x"]);
    assert_eq!(shader.outputs(), ["result_x", "result_y", "result_z", "sum"]);
    let m = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 10.0]];
    for [p0, p1, p2, x] in [[0.5, 0.25, 0.125, 0.3], [-0.5, 0.25, 0.0, 0.7]] {
        let p = [p0, p1, p2];
        let of = |i: usize| {
            let by_rows: f64 = (0..3).map(|j| m[i][j] * p[j]).sum();
            let by_columns: f64 = (0..3).map(|j| m[j][i] * p[j]).sum();
            let mut value = 0.5 * (by_rows + by_columns) * (x * 2.5f64).fract() + 6.0;
            if i < 2 {
                value += [2.0, 4.0][i] + 1.0 / (1.0 + x) + 2.0 * x + 1.0;
            }
            if p.iter().any(|p| *p < 0.0) { (0.5 * value).clamp(0.0, 1.0) } else { value }
        };
        let sum = 0.25 + 0.5 * x + 0.25 * x * x;
        let found = shader.at(&[p0, p1, p2, x]).unwrap();
        for (found, expected) in found.iter().zip([of(0), of(1), of(2), sum]) {
            assert!((found - expected).abs() < 1e-12, "{found}, {expected}");
        }
    }
    let program = shader.program().unwrap();
    assert_eq!(program.inputs, 4);
    let looped = read_with("shade.hlsl", TEXT, &options("looped", &[], &[], &[])).unwrap();
    assert_eq!(looped.at(&[1.0]).unwrap(), [2.5625]);
    assert!(looped.program().is_ok());
}

#[test]
fn what_hlsl_has_beside_values_is_refused() {
    if !compiles() {
        return;
    }
    let of = |entry: &str| read_with("shade.hlsl", TEXT, &options(entry, &[], &[], &[]));
    let error = of("textured").and_then(|shader| shader.at(&[0.5, 0.5])).unwrap_err();
    says(&error, &["shade.hlsl", "texture", "lgp import"]);
    let error = of("plain").and_then(|shader| shader.at(&[0.5])).unwrap_err();
    says(&error, &["shade.hlsl", "derivative"]);
    says(&of("shadow").unwrap_err(), &["no function `shadow`", "did you mean `shade`?"]);
    says(&read("shade.hlsl", TEXT).unwrap_err(), &["several functions", "--entry"]);
    let shade = of("shade").unwrap();
    says(&shade.at(&[0.5; 4]).unwrap_err(), &["4 values are given for 5 inputs"]);
    let error = shade.at(&[-0.5, 0.5, 0.5, 0.5, 1.0]).unwrap_err();
    says(&error, &["`exposure` is a uniform", "--set exposure=1.0"]);
    let error = read("wrong.hlsl", "float f(float x)\n{\n    return y;\n}").unwrap_err();
    says(&error, &["wrong.hlsl, line 3, column 5", "'y'", "glslangValidator"]);
}

#[test]
fn slang_that_hlsl_compilers_read_is_read() {
    if compiles() {
        let text =
            "float3 schlick(float3 f0, float u) { return f0 + (1.0 - f0)*pow(1.0 - u, 5.0); }";
        let shader = read("schlick.slang", text).unwrap();
        assert_eq!(shader.inputs(), ["f0_x", "f0_y", "f0_z", "u"]);
        assert_eq!(shader.at(&[0.5, 0.25, 0.0, 0.5]).unwrap()[0], 0.515625);
    }
}

/// A child without a PATH finds no compiler; the program is of the feature `cli`.
#[cfg(feature = "cli")]
#[test]
fn without_a_compiler_straight_functions_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let run = |text: &str| {
        std::fs::write(folder.path().join("f.hlsl"), text).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_lgp"));
        command.current_dir(folder.path()).env("PATH", "");
        command.args(["generate", "f.hlsl", "--domain", "x=0..1", "-o", "f.bin"]);
        let output = command.output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let straight =
        "float f(float x)\n{\n    float y = saturate(x * 2.0);\n    return lerp(y, x, 0.5);\n}\n";
    let (code, said) = run(straight);
    assert_eq!(code, Some(0), "{said}");
    assert!(folder.path().join("f.bin").exists());
    let (code, said) = run("float f(float x)\n{\n    if (x > 0.5) { x = 1; }\n    return x;\n}\n");
    assert_eq!(code, Some(3), "{said}");
    assert!(said.contains("install slangc, glslangValidator or dxc"), "{said}");
}
