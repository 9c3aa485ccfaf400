//! SPIR-V, as glslang and naga write it.

use crate::{options, says, tools};
use lgp::shader::{Options, Shader};

fn read(bytes: &[u8], options: &Options) -> Result<Shader, lgp::shader::Error> {
    Shader::parse("f.spv".as_ref(), bytes.to_vec(), options)
}

fn of_glslang(text: &str) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("f.frag"), text).unwrap();
    tools::run(folder.path(), &["glslangValidator", "-V", "-Od", "f.frag", "-o", "f.spv"]);
    std::fs::read(folder.path().join("f.spv")).unwrap()
}

fn of_naga(text: &str) -> Vec<u8> {
    let module = naga::front::wgsl::parse_str(text).unwrap();
    let flags = naga::valid::ValidationFlags::all();
    let info = naga::valid::Validator::new(flags, naga::valid::Capabilities::default())
        .validate(&module)
        .unwrap();
    let mut options = naga::back::spv::Options::default();
    options.flags |= naga::back::spv::WriterFlags::DEBUG;
    let words = naga::back::spv::write_vec(&module, &info, &options, None).unwrap();
    words.into_iter().flat_map(u32::to_le_bytes).collect()
}

const OF_GLSL: &str = "#version 450
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
layout(binding = 0) uniform Camera { float exposure; } camera;
float curve(float x, float y) {
    for (int i = 0; i < 3; i++) { if (x > y) x *= 0.5; else x += 0.25; }
    return x * camera.exposure;
}
float at_place(float x) { return x * uv.x; }
void main() { color = vec4(curve(uv.x, uv.y), at_place(2.0), 0.0, 1.0); }";

#[test]
fn modules_of_glslang_are_read() {
    if !tools::found(&["glslangValidator", "--version"], "SPIR-V of glslang was not read") {
        return;
    }
    let code = of_glslang(OF_GLSL);
    let set = ["camera.exposure=2.0"];
    // What the function writes to may be a copy: the module does not say.
    let shader = read(&code, &options("curve", &set, &[], &["x"])).unwrap();
    assert_eq!((shader.inputs().len(), shader.outputs().len()), (2, 2));
    assert_eq!(shader.at(&[1.0, 0.5]).unwrap(), [0.75, 0.375]);
    assert!(shader.program().is_ok());
    let whole = read(&code, &options("main", &set, &[], &["uv_x", "uv_y"])).unwrap();
    assert_eq!(whole.inputs(), ["uv_x", "uv_y"]);
    assert_eq!(whole.at(&[1.0, 0.5]).unwrap(), [0.75, 2.0, 0.0, 1.0]);
    let part = read(&code, &options("at_place", &[], &[], &["x"])).unwrap();
    says(&part.at(&[1.0]).unwrap_err(), &["f.spv", "`uv`", "--set uv"]);
}

#[test]
fn modules_of_naga_are_read() {
    let text = "
fn curve(x: f32, v: vec2<f32>) -> vec2<f32> {
    var sum = v;
    for (var i = 0u; i < 4u; i++) { sum = sum.yx * x + f32(i); }
    return select(sum, v, x < 0.5);
}
@fragment fn main(@location(0) uv: vec2<f32>) -> @location(0) vec4<f32> {
    return vec4(curve(uv.x, uv), 0.0, 1.0);
}";
    let code = of_naga(text);
    let shader = read(&code, &options("curve", &[], &[], &[])).unwrap();
    let same = Shader::parse("f.wgsl".as_ref(), text.into(), &options("curve", &[], &[], &[]));
    let same = same.unwrap();
    for point in [[0.25, 1.0, 2.0], [0.75, 1.0, 2.0]] {
        assert_eq!(shader.at(&point).unwrap(), same.at(&point).unwrap());
        let program = shader.program().unwrap();
        let single = program.evaluate(&point.map(|value| value as f32));
        let expected: Vec<f32> = same.at(&point).unwrap().iter().map(|v| *v as f32).collect();
        assert_eq!(single, expected);
    }
}

#[test]
fn what_is_cut_or_no_module_is_refused() {
    let code = of_naga(
        "fn f(x: f32) -> f32 { return x * 2.0; }
@fragment fn main(@location(0) x: f32) -> @location(0) f32 { return f(x); }",
    );
    assert!(read(&code, &options("f", &[], &[], &[])).is_ok());
    for length in (0..code.len()).step_by(4).chain([1, 2, 3, code.len() - 1]) {
        let error = read(&code[..length], &options("f", &[], &[], &[]));
        says(&error.unwrap_err(), &["f.spv"]);
    }
    says(&read(&[7; 400], &Options::default()).unwrap_err(), &["f.spv", "not SPIR-V"]);
}
