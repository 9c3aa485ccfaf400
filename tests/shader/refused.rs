//! What one sample of one function has not: said with the place and what to do.

use crate::{options, read, read_with, says};
use lgp::shader::Shader;

const UNIFORMS: &str = "
struct Camera { exposure: f32, @align(16) tint: vec3<f32> }
@group(0) @binding(0) var<uniform> camera: Camera;
@group(0) @binding(1) var<storage, read> weights: array<f32>;
@group(0) @binding(2) var<storage, read_write> results: array<f32>;
@group(0) @binding(3) var image: texture_2d<f32>;
@group(0) @binding(4) var sampling: sampler;
@group(0) @binding(5) var<storage, read_write> counter: atomic<u32>;
var<workgroup> shared_sum: f32;

fn exposed(x: f32) -> f32 {
    return x
        * camera.exposure;
}
fn weighted(x: f32) -> f32 { return x * weights[2]; }
fn looked_up(x: f32) -> f32 { return textureSampleLevel(image, sampling, vec2(x), 0.0).x; }
fn loaded(x: f32) -> f32 { return textureLoad(image, vec2(0, 0), 0).x * x; }
fn sized(x: f32) -> f32 { return x * f32(textureDimensions(image).x); }
fn across(x: f32) -> f32 { return x + dpdx(x); }
fn wide(x: f32) -> f32 { return fwidth(x * x); }
fn thrown(x: f32) -> f32 { if (x < 0.5) { discard; } return x; }
fn counted(x: f32) -> f32 { return x + f32(atomicAdd(&counter, 1u)); }
fn written(x: f32) -> f32 { results[0] = x; return results[0]; }
fn waits(x: f32) -> f32 { shared_sum = x; workgroupBarrier(); return shared_sum * 2.0; }
fn endless(x: f32) -> f32 { var a = x; loop { a = cos(a); } return a; }
fn out_of(x: f32) -> f32 { var a = array<f32, 2>(x, x); let i = i32(x * 10.0); return a[i]; }
";

fn of(entry: &str) -> Shader {
    read_with("things.wgsl", UNIFORMS, &options(entry, &[], &[], &[])).unwrap()
}

#[test]
fn what_a_sample_has_not_is_refused_with_its_place() {
    for (entry, line, parts) in [
        ("exposed", 13, ["`camera.exposure` is a uniform", "--set camera.exposure=1.0"]),
        ("looked_up", 16, ["texture", "lgp import"]),
        ("loaded", 17, ["texture", "lgp import"]),
        ("sized", 18, ["texture", "lgp import"]),
        ("across", 19, ["derivative across pixels", "pass its value as a parameter"]),
        ("wide", 20, ["derivative across pixels", "pass its value as a parameter"]),
        ("thrown", 21, ["discards", "approximate what it returns"]),
        ("counted", 22, ["other invocations", "approximate a function of values"]),
    ] {
        let shader = of(entry);
        let place = format!("things.wgsl, line {line}, column");
        for error in [shader.at(&[0.25]).unwrap_err(), shader.program().unwrap_err()] {
            says(&error, &[&place, parts[0], parts[1]]);
        }
    }
    says(&of("weighted").at(&[0.25]).unwrap_err(), &["things.wgsl, line 15", "weights"]);
    says(&of("written").at(&[0.25]).unwrap_err(), &["things.wgsl, line 23", "results"]);
    assert_eq!(of("waits").at(&[0.25]).unwrap(), [0.5]);
    says(&of("out_of").at(&[0.25]).unwrap_err(), &["things.wgsl, line 26", "index 2 is out of"]);
    assert_eq!(of("out_of").at(&[0.125]).unwrap(), [0.125]);
}

#[test]
fn a_loop_without_end_ends() {
    let start = std::time::Instant::now();
    let shader = of("endless");
    says(&shader.at(&[0.5]).unwrap_err(), &["things.wgsl, line 25", "a loop may have no end"]);
    says(&shader.program().unwrap_err(), &["things.wgsl, line 25", "operations when unrolled"]);
    assert!(start.elapsed().as_secs() < 60, "{:?}", start.elapsed());
}

#[test]
fn uniforms_are_fixed_by_member_or_component_or_have_a_range() {
    let text = "
struct Camera { exposure: f32, tint: vec3<f32> }
@group(0) @binding(0) var<uniform> camera: Camera;
fn exposed(x: f32) -> vec3<f32> { return x * camera.exposure * camera.tint; }";
    let with = |set: &[&str], ranged: &[&str]| {
        read_with("camera.wgsl", text, &options("", set, &[], ranged)).unwrap()
    };
    let shader = with(&["camera.exposure=2", "camera.tint=vec3(1.0, 2.0, 0.5)"], &[]);
    assert_eq!(shader.inputs(), ["x"]);
    assert_eq!(shader.outputs(), ["exposed_x", "exposed_y", "exposed_z"]);
    assert_eq!(shader.at(&[0.25]).unwrap(), [0.5, 1.0, 0.25]);
    let shader = with(&["camera.tint=1.0", "camera.tint.y=4.0"], &["camera_exposure"]);
    assert_eq!(shader.inputs(), ["x", "camera_exposure"]);
    assert_eq!(shader.at(&[0.25, 3.0]).unwrap(), [0.75, 3.0, 0.75]);
    let error = with(&["camera.exposure=2"], &[]).at(&[0.25]).unwrap_err();
    says(&error, &["camera.wgsl, line 4", "`camera.tint`"]);
    let wrong = |set: &str| read_with("camera.wgsl", text, &options("", &[set], &[], &[]));
    says(&wrong("camera.exposre=1").unwrap_err(), &["camera.exposre", "did you mean"]);
    says(&wrong("camera.exposure=").unwrap_err(), &["write NAME=VALUE"]);
    says(
        &wrong("camera.exposure=two").unwrap_err(),
        &["camera.exposure = two", "write it in WGSL"],
    );
    let error = wrong("camera.tint=vec2(1.0, 2.0)").unwrap().at(&[0.25]).unwrap_err();
    says(&error, &["2 components are given for 3"]);
}

#[test]
fn parameters_are_defined_by_new_names() {
    let text = "fn lit(n: vec3<f32>, v: vec3<f32>, on: bool, count: i32) -> f32 {
    return select(0.0, dot(n, v), on) * f32(count);
}";
    let set = ["n=vec3(0.0, 0.0, 1.0)", "on=true", "count=3"];
    let define = ["v = vec3(sqrt(1.0 - n_dot_v*n_dot_v), 0.0, n_dot_v)"];
    let shader = read_with("lit.wgsl", text, &options("", &set, &define, &[])).unwrap();
    assert_eq!(shader.inputs(), ["n_dot_v"]);
    assert_eq!(shader.at(&[0.25]).unwrap(), [0.75]);
    assert!(shader.program().is_ok());
    let derived = ["n_dot_v = dot(n, v)"];
    let shader = read_with("lit.wgsl", text, &options("", &set, &derived, &[])).unwrap();
    assert_eq!(shader.inputs(), ["v_x", "v_y", "v_z"]);
    assert_eq!(shader.at(&[0.5, 0.25, 0.125]).unwrap(), [0.125, 0.375]);
    says(&shader.program().unwrap_err(), &["columns are functions of its parameters"]);
    for (set, define, parts) in [
        (&set[..2], "v = vec3(c, 0.0, c)", ["`count` is an integer", "--set count=3"]),
        (&set[..], "v = vec3(n.x, 0.0, c)", ["`n` is a parameter", "new names"]),
        (&set[..], "w = vec3(c, 0.0, c)", ["neither `w` nor `c` is a parameter", "n, v"]),
        (&set[..], "v = vec3(c, 0.0", ["v = vec3(c, 0.0", "write it in WGSL"]),
        (&set[..], "v", ["`v`", "write NAME=VALUE"]),
    ] {
        let error = read_with("lit.wgsl", text, &options("", set, &[define], &[])).unwrap_err();
        says(&error, &parts);
    }
    let define = ["v = vec2(c, c)"];
    let shader = read_with("lit.wgsl", text, &options("", &set, &define, &[])).unwrap();
    says(&shader.at(&[0.5]).unwrap_err(), &["2 components are given for 3"]);
}

#[test]
fn the_function_is_the_one_that_is_called_by_none() {
    let text = "fn a(x: f32) -> f32 { return x; }
fn b(x: f32) -> f32 { return a(x) + 1.0; }";
    assert_eq!(read("two.wgsl", text).unwrap().name(), "b");
    let named = |name| read_with("two.wgsl", text, &options(name, &[], &[], &[]));
    assert_eq!(named("a").unwrap().name(), "a");
    says(&named("c").unwrap_err(), &["there is no function `c`", "a, b"]);
    let more = format!("{text}\nfn c(x: f32) -> f32 {{ return x; }}");
    says(&read("three.wgsl", &more).unwrap_err(), &["several functions: b, c", "--entry b"]);
    says(&read("none.wgsl", "const x = 1.0;").unwrap_err(), &["it has no function"]);
    says(&read("nothing.wgsl", "fn f(x: f32) {}").unwrap_err(), &["`f` returns nothing"]);
    says(
        &read("t.wgsl", "fn f(t: texture_2d<f32>) -> f32 { return 1.0; }").unwrap_err(),
        &["`t` is a texture", "lgp import"],
    );
}

#[test]
fn errors_name_the_line_as_the_author_counts() {
    for (file, text, line) in [
        ("a.wgsl", "fn f(x: f32) -> f32 {\n    return y;\n}", 2),
        ("a.glsl", "float f(float x) {\n    return y;\n}", 2),
        ("a.glsl", "#version 450\nfloat f(float x) {\n    return x +;\n}", 3),
        ("a.glsl", "float f(float x) {\n    return sampled(x);\n}", 2),
    ] {
        says(&read(file, text).unwrap_err(), &[&format!("{file}, line {line}, column")]);
    }
    let error = read("a.glsl", "float f(float x) { return x * scale; }").unwrap_err();
    says(&error, &["`scale` is declared nowhere", "--set scale=1.0"]);
    let error = read("a.wgsl", "#import bevy_pbr::lighting\nfn f(x: f32) -> f32 { return x; }");
    says(&error.unwrap_err(), &["a.wgsl, line 1", "no preprocessor"]);
    says(&read("a.png", "x").unwrap_err(), &["not a shader, by its extension", ".wgsl"]);
}
