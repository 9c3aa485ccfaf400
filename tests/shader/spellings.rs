//! GLSL as people have it: of Shadertoy, of OpenGL ES, with macros and included files.

use crate::{options, read, read_with, says, tools};
use lgp::shader::{Options, Shader};

const TOY: &str = "
float ring(vec2 p) { return smoothstep(.02, .0, abs(length(p) - .5)); }

void mainImage( out vec4 fragColor, in vec2 fragCoord )
{
    vec2 uv = fragCoord/iResolution.xy;
    vec3 col = 0.5 + 0.5*cos(iTime+uv.xyx+vec3(0,2,4));
    fragColor = vec4(col * (1.0 - ring(uv)),1.0);
}";

#[test]
fn shadertoys_are_read_with_what_they_are_given() {
    let error = read("toy.glsl", TOY).unwrap_err();
    says(&error, &["toy.glsl, line 6", "`iResolution` is declared nowhere", "--set iResolution"]);
    let set = ["iResolution=vec3(640.0, 360.0, 1.0)", "iTime=1.5"];
    let shader = read_with("toy.glsl", TOY, &options("", &set, &[], &[])).unwrap();
    assert_eq!(shader.inputs(), ["fragCoord_x", "fragCoord_y"]);
    let outputs = ["fragColor_x", "fragColor_y", "fragColor_z", "fragColor_w"];
    assert_eq!(shader.outputs(), outputs);
    let found = shader.at(&[320.0, 90.0]).unwrap();
    let (x, y) = (0.5f64, 0.25f64);
    let t = ((0.5 - x.hypot(y)).abs() - f64::from(0.02f32)) / -f64::from(0.02f32);
    let t = t.clamp(0.0, 1.0);
    let expected = (0.5 + 0.5 * (1.5 + y + 2.0).cos()) * (1.0 - t * t * (3.0 - 2.0 * t));
    assert!((found[1] - expected).abs() < 1e-12, "{found:?}, {expected}");
    assert_eq!(found[3], 1.0);
    assert!(shader.program().is_ok());
}

#[test]
fn declared_uniforms_of_any_form_are_given_from_outside() {
    let text = "#version 330 core
uniform float gain;
uniform vec2 offset, scale;
layout(std140) uniform Light { vec3 color; float power; } light;
layout(std140) uniform Fog { float density; };
layout(location = 0) in vec3 v_normal;
in float v_depth;

vec3 shaded(float x) {
    float fog = exp(-density * v_depth);
    return light.color * light.power * fog * (gain * x * scale.x + offset.y) + v_normal;
}";
    let set = [
        "gain=2.0",
        "offset=vec2(0.0, 1.0)",
        "scale=0.5",
        "light.color=vec3(1.0, 0.5, 0.25)",
        "light.power=2.0",
        "density=0.0",
    ];
    let ranged = ["v_depth", "v_normal_x", "v_normal_y", "v_normal_z"];
    let shader = read_with("fog.frag", text, &options("", &set, &[], &ranged)).unwrap();
    assert_eq!(shader.inputs().len(), 5, "{:?}", shader.inputs());
    let place = |name: &str| shader.inputs().iter().position(|known| known == name).unwrap();
    let mut point = [0.0; 5];
    (point[place("x")], point[place("v_normal_y")]) = (3.0, 10.0);
    assert_eq!(shader.at(&point).unwrap(), [8.0, 14.0, 2.0]);
    let bare = read_with("fog.frag", text, &Options::default()).unwrap();
    let error = bare.at(&[0.5]).unwrap_err();
    says(&error, &["fog.frag, line 10", "`density` is a uniform", "--set density=1.0"]);
    let some = read_with("fog.frag", text, &options("", &set[5..], &[], &[])).unwrap();
    let error = some.at(&[0.5]).unwrap_err();
    says(&error, &["fog.frag, line 10", "`v_depth` is an input of the stage", "--set v_depth"]);
}

#[test]
fn what_the_stage_gives_is_not_zero_unless_one_says_so() {
    let text = "float f(float x) { return x + gl_FragCoord.x; }";
    let error = read("f.frag", text).unwrap().at(&[0.5]).unwrap_err();
    says(&error, &["f.frag, line 1", "`gl_FragCoord`", "--set gl_FragCoord"]);
    let with = options("", &["gl_FragCoord=vec4(2.0, 0.0, 0.0, 1.0)"], &[], &[]);
    assert_eq!(read_with("f.frag", text, &with).unwrap().at(&[0.5]).unwrap(), [2.5]);
    let ranged = options("", &[], &[], &["gl_FragCoord_x"]);
    let shader = read_with("f.frag", text, &ranged).unwrap();
    assert_eq!(shader.inputs(), ["x", "gl_FragCoord_x"]);
    assert_eq!(shader.at(&[0.5, 3.0]).unwrap(), [3.5]);
}

#[test]
fn entry_points_need_what_they_read_of_the_stage() {
    let text = "@fragment
fn shaded(@builtin(position) at: vec4<f32>, @location(0) uv: vec2<f32>) -> @location(0) vec4<f32> {
    return vec4(at.x * 2.0, uv, 1.0);
}";
    let shader = read_with("p.wgsl", text, &options("", &[], &[], &["at_x"])).unwrap();
    assert_eq!(shader.inputs(), ["at_x", "uv_x", "uv_y"]);
    assert_eq!(shader.at(&[3.0, 0.5, 0.25]).unwrap(), [6.0, 0.5, 0.25, 1.0]);
    let error = read("p.wgsl", text).unwrap().at(&[0.5, 0.25]).unwrap_err();
    says(&error, &["p.wgsl, line 3", "no value yet", "--set"]);
}

#[test]
fn open_gl_es_is_read() {
    let old = "#version 100
#extension GL_OES_standard_derivatives : enable
precision mediump float;
#define SAMPLES 4
#define LINEAR(x) ((x)*(x))
#ifdef GL_ES
#define GAIN 2.0
#else
#define GAIN 3.0
#endif
varying highp vec2 v_uv;
uniform lowp float u_gain;
lowp float tone(mediump float x) {
    float sum = 0.0;
    for (int i = 0; i < SAMPLES; ++i) { sum += LINEAR(x + float(i)); }
    return sum * u_gain;
}";
    let with = options("", &["u_gain=0.5"], &[], &[]);
    assert_eq!(read_with("old.frag", old, &with).unwrap().at(&[1.0]).unwrap(), [15.0]);
    let new = "#version 300 es
precision highp float;
precision highp int;
in vec2 v_uv;
out vec4 color;
float tone(float x) { return x / (1.0 + x); }
void main() { color = vec4(tone(v_uv.x), v_uv.y, 0.0, 1.0); }";
    let shader = read_with("new.frag", new, &options("tone", &[], &[], &[])).unwrap();
    assert_eq!(shader.at(&[1.0]).unwrap(), [0.5]);
    let ranged = options("", &[], &[], &["v_uv_x", "v_uv_y"]);
    let whole = read_with("new.frag", new, &ranged).unwrap();
    assert_eq!(whole.inputs(), ["v_uv_x", "v_uv_y"]);
    assert_eq!(whole.at(&[1.0, 0.25]).unwrap(), [0.5, 0.25, 0.0, 1.0]);
    let sampled = "uniform sampler2D map;\nvec4 f(vec2 uv) { return texture2D(map, uv); }";
    says(&read("map.frag", sampled).unwrap_err(), &["map.frag, line", "texture", "lgp import"]);
}

#[test]
fn included_files_are_found_beside_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        path
    };
    file("math/square.glsl", "#pragma once\nfloat square(float x) { return x*x; }\n");
    file(
        "math/fourth.glsl",
        "#include \"square.glsl\"\n#ifndef FOURTH\n#define FOURTH\n\
        float fourth(float x) { return square(square(x)); }\n#endif",
    );
    let main = "// #include \"no.glsl\"\n#include \"math/fourth.glsl\"\n  # include <math/square.glsl>\n\
        #include \"math/fourth.glsl\"\nfloat f(float x) {\n    return fourth(x) + square(x);\n}\n";
    let path = file("main.glsl", main);
    let shader = Shader::load(&path, &Options::default()).unwrap();
    assert_eq!(shader.at(&[2.0]).unwrap(), [20.0]);
    let path = file("wrong.glsl", &main.replace("return", "return y +"));
    let error = Shader::load(&path, &Options::default()).unwrap_err();
    says(&error, &["wrong.glsl, line 6, column", "`y`"]);
    file("math/square.glsl", "\nfloat square(float x) { return z; }\n");
    let error = Shader::load(&path, &Options::default()).unwrap_err();
    says(&error, &["square.glsl, line 2, column", "`z`"]);
    let path = file("missing.glsl", "#include \"none.glsl\"\nfloat f(float x) { return x; }");
    says(&Shader::load(&path, &Options::default()).unwrap_err(), &["missing.glsl, line 1", "none"]);
    file("math/cube.wgsl", "fn cube(x: f32) -> f32 { return x*x*x; }");
    let path = file(
        "f.wgsl",
        "#include \"math/cube.wgsl\"\n#include \"math/cube.wgsl\"\n\
        fn f(x: f32) -> f32 { return cube(x); }",
    );
    assert_eq!(Shader::load(&path, &Options::default()).unwrap().at(&[2.0]).unwrap(), [8.0]);
    let path = file("f.hlsl", "#include \"none.hlsl\"\nfloat f(float x) { return x; }");
    says(&Shader::load(&path, &Options::default()).unwrap_err(), &["f.hlsl"]);
    let path = file("itself.glsl", "#include \"itself.glsl\"\nfloat f(float x) { return x; }");
    let error = Shader::load(&path, &Options::default()).unwrap_err();
    says(&error, &["itself.glsl", "line 1", "include each other"]);
}

/// What naga's front end does not read, and a compiler does.
#[test]
fn glsl_that_naga_does_not_read_is_compiled() {
    if !tools::found(&["glslangValidator", "--version"], "GLSL was not compiled") {
        return;
    }
    let text = "#define COUNT 3
const float TABLE[] = float[](1.0, 2.0, 3.0);
uniform float gain;
float mixed(float x, out float other) {
    mat2 m = mat2(x);
    m[0].y = iScale;
    float sum = 0.0;
    for (int i = 0; i < COUNT; i++) sum += TABLE[i] * m[0].y;
    x *= 2.0;
    other = x;
    return sum + gain + matrixCompMult(m, m)[1].y;
}";
    let with = options("", &["gain=10.0", "iScale=0.5"], &[], &[]);
    let shader = read_with("mixed.glsl", text, &with).unwrap();
    assert_eq!(shader.inputs(), ["x"]);
    assert_eq!(shader.outputs(), ["mixed", "other"]);
    assert_eq!(shader.at(&[2.0]).unwrap(), [17.0, 4.0]);
    assert!(shader.program().is_ok());
    let error = read_with("mixed.glsl", &text.replace("sum + gain", "sum + vec2(1.0)"), &with);
    says(&error.unwrap_err(), &["mixed.glsl, line 11, column"]);
}

#[test]
fn prototypes_are_no_matter_and_recursion_is_refused() {
    let text = "float late(float x);
float f(float x) { return late(x) + 1.0; }
float late(float x) { return x * x; }";
    let shader = read("late.glsl", text).unwrap();
    assert_eq!((shader.name(), shader.at(&[3.0]).unwrap()), ("f", vec![10.0]));
    let error = read("self.glsl", &text.replace("x * x", "f(x)")).unwrap_err();
    says(&error, &["self.glsl", "calls itself"]);
    let error = read("self.wgsl", "fn f(x: f32) -> f32 { return f(x); }").unwrap_err();
    says(&error, &["self.wgsl, line 1"]);
}

#[test]
fn a_byte_order_mark_and_ends_of_lines_are_no_matter() {
    let text = "\u{feff}float f(float x) {\r\n    return x * 2.0;\r\n}\r\n";
    assert_eq!(read("mark.glsl", text).unwrap().at(&[1.0]).unwrap(), [2.0]);
    let text = "\u{feff}fn f(x: f32) -> f32 {\r    return x * 2.0;\r}";
    assert_eq!(read("mark.wgsl", text).unwrap().at(&[1.0]).unwrap(), [2.0]);
}
