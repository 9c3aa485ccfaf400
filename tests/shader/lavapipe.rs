//! The same functions on Mesa's software Vulkan, or the device whose name has `LGP_VULKAN_DEVICE` in
//! it: against the interpreter, and programs against it.

use crate::cases::{CASES, Case};
use crate::tools;
use crate::vulkan::Gpu;

const ROWS: usize = 256;
const GROUP: usize = 64;
const COLUMNS: [char; 6] = ['a', 'b', 'c', 'd', 'e', 'f'];

#[test]
fn gpus_compute_what_the_interpreter_computes_of_wgsl() {
    agree("wgsl");
}

#[test]
fn gpus_compute_what_the_interpreter_computes_of_glsl() {
    agree("glsl");
}

fn agree(language: &str) {
    let untested = format!("functions in {language} were not run");
    let name = std::env::var("LGP_VULKAN_DEVICE");
    let gpu = match Gpu::open(name.as_deref().unwrap_or("llvmpipe")) {
        Ok(gpu) => gpu,
        Err(why) => return tools::skipped(&format!("{why}; {untested}")),
    };
    if language == "glsl" && !tools::found(&["glslangValidator", "--version"], &untested) {
        return;
    }
    for case in &CASES {
        if let Some(text) = case.text(language) {
            compare(&gpu, case, language, &text);
        }
    }
}

fn compare(gpu: &Gpu, case: &Case, language: &str, text: &str) {
    let points = case.points(ROWS);
    let input: Vec<f32> = (0..case.domain.len())
        .flat_map(|column| points.iter().map(move |point| point[column] as f32))
        .collect();
    let spirv = compiled(language, &format!("{text}\n{}", main_of(case, language)));
    let groups = ROWS.div_ceil(GROUP) as u32;
    let output = gpu.run(&spirv, &input, ROWS * case.outputs.len(), groups).unwrap().output;
    let shader = case.read(language).unwrap();
    let program = shader.program().ok();
    assert_eq!(program.is_some(), case.no_program.is_none(), "{}", case.name);
    let (mut worst, mut worst_of_program) = (0.0f64, 0.0f64);
    for (row, point) in points.iter().enumerate() {
        let found: Vec<f64> =
            (0..case.outputs.len()).map(|o| output[o * ROWS + row].into()).collect();
        let check = |values: &[f64], what: &str| {
            let mut worst = 0.0f64;
            for (o, (found, value)) in found.iter().zip(values).enumerate() {
                let apart = (found - value).abs() / value.abs().max(1.0);
                assert!(
                    apart <= case.single,
                    "{}.{language}, output {o} at {point:?}: {found:e}, but {value:e} of {what}",
                    case.name
                );
                worst = worst.max(apart);
            }
            worst
        };
        worst = worst.max(check(&shader.at(point).unwrap(), "the interpreter"));
        if let Some(program) = &program {
            let single: Vec<f32> = point.iter().map(|&value| value as f32).collect();
            let values: Vec<f64> = program.evaluate(&single).into_iter().map(f64::from).collect();
            worst_of_program = worst_of_program.max(check(&values, "the program"));
        }
    }
    let name = case.name;
    println!("{name}.{language}: {worst:.1e} apart at most, {worst_of_program:.1e} of the program");
}

/// An entry point that calls the function for each row.
fn main_of(case: &Case, language: &str) -> String {
    let declared = if language == "wgsl" { "let" } else { "float" };
    let mut code = String::new();
    for (column, name) in COLUMNS.iter().enumerate().take(case.domain.len()) {
        code += &format!("        {declared} {name} = lgp_columns[{}u + i];\n", column * ROWS);
    }
    for (o, component) in case.outputs.iter().enumerate() {
        let Case { before, call, .. } = case;
        code += &format!("        {before}lgp_results[{}u + i] = {call}{component};\n", o * ROWS);
    }
    let before = match language {
        "wgsl" => format!(
            "@group(0) @binding(0) var<storage, read> lgp_columns: array<f32>;
@group(0) @binding(1) var<storage, read_write> lgp_results: array<f32>;
@compute @workgroup_size({GROUP})
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let i = id.x;
    if (i < {ROWS}u) {{\n"
        ),
        _ => format!(
            "layout(local_size_x = {GROUP}) in;
layout(std430, binding = 0) readonly buffer Columns {{ float lgp_columns[]; }};
layout(std430, binding = 1) buffer Results {{ float lgp_results[]; }};
void main() {{
    uint i = gl_GlobalInvocationID.x;
    if (i < {ROWS}u) {{\n"
        ),
    };
    format!("{before}{code}    }}\n}}\n")
}

fn compiled(language: &str, source: &str) -> Vec<u32> {
    if language == "wgsl" {
        let module = naga::front::wgsl::parse_str(source)
            .unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
        let flags = naga::valid::ValidationFlags::all();
        let mut validator =
            naga::valid::Validator::new(flags, naga::valid::Capabilities::default());
        let info = validator.validate(&module).unwrap();
        let options = naga::back::spv::Options::default();
        return naga::back::spv::write_vec(&module, &info, &options, None).unwrap();
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("main.comp"), format!("#version 450\n{source}")).unwrap();
    let command = ["glslangValidator", "-V", "--target-env", "vulkan1.2", "-o", "main.spv"];
    tools::run(folder.path(), &[&command[..], &["main.comp"]].concat());
    let bytes = std::fs::read(folder.path().join("main.spv")).unwrap();
    bytes.chunks_exact(4).map(|b| u32::from_le_bytes(b.try_into().unwrap())).collect()
}
