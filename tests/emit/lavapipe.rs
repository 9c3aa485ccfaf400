//! WGSL, GLSL, HLSL and Slang: run on Mesa's software Vulkan, or the device whose name has
//! `LGP_VULKAN_DEVICE` in it, and compared with the interpreter.

use crate::agreement::{Case, OF_FORMULAS, Tolerance, front, operations};
use crate::compile::validated;
use crate::vulkan::Gpu;
use crate::{dxc, materialx, slang, text, tools};
use lgp::emit::{Language, Snippet, emit_half};
use lgp::op::Op;
use std::collections::BTreeMap;
use std::path::Path;

/// What makes SPIR-V of a language.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Compiler {
    Naga,
    GlslangOfGlsl,
    GlslangOfHlsl,
    Dxc,
    Slangc,
    /// MaterialX's generator of GLSL, and glslang.
    MaterialX,
}

impl Compiler {
    /// The language of the shader.
    fn language(self) -> Language {
        match self {
            Compiler::Naga => Language::Wgsl,
            Compiler::GlslangOfGlsl | Compiler::MaterialX => Language::Glsl,
            Compiler::GlslangOfHlsl | Compiler::Dxc => Language::Hlsl,
            Compiler::Slangc => Language::Slang,
        }
    }

    fn found(self, untested: &str) -> bool {
        let glslang = || tools::found(&["glslangValidator", "--version"], untested);
        match self {
            Compiler::Naga => true,
            Compiler::GlslangOfGlsl | Compiler::GlslangOfHlsl => glslang(),
            Compiler::Dxc => dxc::found(untested),
            Compiler::Slangc => slang::found(untested),
            Compiler::MaterialX => materialx::found(untested) && glslang(),
        }
    }
}

#[test]
fn wgsl_computes_what_the_interpreter_computes() {
    agree(Compiler::Naga);
}

#[test]
fn glsl_computes_what_the_interpreter_computes() {
    agree(Compiler::GlslangOfGlsl);
}

#[test]
fn hlsl_computes_what_the_interpreter_computes() {
    agree(Compiler::GlslangOfHlsl);
}

/// The device, unless that or the compiler is missing.
pub fn device(compiler: Compiler) -> Option<Gpu> {
    let untested = format!("{compiler:?} was not run");
    let name = std::env::var("LGP_VULKAN_DEVICE");
    let gpu = Gpu::open(name.as_deref().unwrap_or("llvmpipe"))
        .map_err(|why| tools::skipped(&format!("{why}; {untested}")));
    gpu.ok().filter(|_| compiler.found(&untested))
}

pub fn agree(compiler: Compiler) {
    agree_within(compiler, tolerance);
}

pub fn agree_within(compiler: Compiler, tolerance: fn(Op) -> Tolerance) {
    let Some(gpu) = device(compiler) else { return };
    let (operations, front) = (operations(), front());
    let mut worst: BTreeMap<Op, f32> = BTreeMap::new();
    for (case, found) in operations.iter().zip(outputs(&gpu, compiler, Single, &operations)) {
        let op = case.op.unwrap();
        let apart = case.compare(&found, tolerance(op));
        worst.entry(op).and_modify(|worst| *worst = worst.max(apart)).or_insert(apart);
    }
    for (op, worst) in worst {
        println!("{compiler:?}, {op}: {worst:.1e} apart at most");
    }
    for (case, found) in front.iter().zip(outputs(&gpu, compiler, Single, &front)) {
        let apart = case.compare(&found, OF_FORMULAS);
        println!("{compiler:?}, {}: {apart:.1e} apart at most", case.title);
    }
}

/// What Vulkan demands of single precision ("Precision of Individual Operations"), an ulp being
/// up to 1.2e-7 of a value; functions that it derives from others, on ordinary arguments.
pub fn tolerance(op: Op) -> Tolerance {
    let [absolute, relative] = match op {
        Op::Neg | Op::Abs | Op::Min | Op::Max | Op::Saturate | Op::Step | Op::Select => [0.0, 0.0],
        Op::Floor | Op::Fract | Op::Sign => [0.0, 0.0],
        Op::Add | Op::Sub | Op::Mul => [0.0, 0.0],
        // A product and a sum; x·(1 − a) + y·a: of terms up to 64 that may cancel.
        Op::Mad | Op::Lerp => [1e-5, 0.0],
        // 2.5 ulp; 2; and of the one by the other.
        Op::Div | Op::Rcp => [0.0, 3e-7],
        Op::Rsqrt => [0.0, 2.4e-7],
        Op::Sqrt => [0.0, 5.4e-7],
        // 3 + 2 |x| ulp, |x| up to 8.
        Op::Exp2 | Op::Exp => [0.0, 2.3e-6],
        // 2^-21 between ½ and 2, 3 ulp elsewhere.
        Op::Log2 | Op::Log => [4.8e-7, 3.6e-7],
        // exp2(y·log2 x), |y·log2 x| up to 24: 4 ulp of it in the exponent, and 51.
        Op::Pow => [0.0, 1.5e-5],
        Op::Sin | Op::Cos => [4.9e-4, 0.0],
        // Of the sine by the cosine, which is .26 at least.
        Op::Tan => [0.0, 4e-3],
        // 4096 ulp.
        Op::Asin | Op::Acos | Op::Atan | Op::Atan2 => [4.9e-4, 4.9e-4],
        // A difference of exponentials by their sum.
        Op::Tanh => [1e-6, 5e-6],
    };
    Tolerance { absolute, relative }
}

#[derive(Clone, Copy, PartialEq)]
pub enum Precision {
    Single,
    InHalf,
}
use Precision::{InHalf, Single};

const GROUP: usize = 64;

/// All cases in one shader: the outputs of each.
pub fn outputs(
    gpu: &Gpu,
    compiler: Compiler,
    precision: Precision,
    cases: &[Case],
) -> Vec<Vec<Vec<f32>>> {
    let usual = |case: &Case| match compiler {
        Compiler::MaterialX => String::new(),
        _ => function(compiler.language(), precision, case),
    };
    outputs_of(gpu, compiler, precision, cases, &usual)
}

/// The same of functions that are written in another way.
pub fn outputs_of(
    gpu: &Gpu,
    compiler: Compiler,
    precision: Precision,
    cases: &[Case],
    written: &dyn Fn(&Case) -> String,
) -> Vec<Vec<Vec<f32>>> {
    let input: Vec<f32> = cases.iter().flat_map(|case| case.inputs.concat()).collect();
    let rows = cases[0].rows();
    let columns: usize = cases.iter().map(|case| case.expected.len()).sum();
    let spirv = compiled(compiler, precision, &source(compiler, precision, cases, written));
    let groups = rows.div_ceil(GROUP) as u32;
    let ran = gpu.run(&spirv, &input, rows * columns, groups).unwrap();
    let mut found = ran.output.chunks_exact(rows).map(<[f32]>::to_vec);
    cases.iter().map(|case| found.by_ref().take(case.expected.len()).collect()).collect()
}

fn source(
    compiler: Compiler,
    precision: Precision,
    cases: &[Case],
    written: &dyn Fn(&Case) -> String,
) -> String {
    let language = compiler.language();
    let mut allowed = match (compiler, precision) {
        (Compiler::GlslangOfHlsl, InHalf) => functions_of_halves(),
        (Compiler::MaterialX, _) => materialx::functions(cases),
        _ => String::new(),
    };
    let (mut functions, mut calls) = (String::new(), String::new());
    let (mut input, mut output) = (0, 0);
    for case in cases {
        assert_eq!(case.rows(), cases[0].rows());
        let code = written(case);
        match code.split_once("\n\n") {
            // The line that allows halves may stand only once.
            Some((line, rest)) if precision == InHalf && !line.contains("_INCLUDED") => {
                allowed = line.to_owned() + "\n";
                functions += rest;
            }
            _ => functions += &code,
        }
        calls += &call(language, precision, case, input, output);
        input += case.inputs.len() * case.rows();
        output += case.expected.len() * case.rows();
    }
    let (before, after) = main_of(language, cases[0].rows());
    allowed + &functions + &before + &calls + after
}

/// glslang has the functions of HLSL in single precision only; these stand for those of halves.
fn functions_of_halves() -> String {
    const BY_ARITY: [&str; 3] = [
        "abs saturate rcp sqrt rsqrt exp2 log2 exp log sin cos tan asin acos atan tanh floor frac \
         sign",
        "min max pow atan2 step",
        "mad lerp",
    ];
    let mut functions = String::new();
    for (names, arguments) in BY_ARITY.into_iter().zip([1, 2, 3]) {
        for name in names.split_whitespace() {
            let each = |kind: fn(&str) -> String| {
                ["a", "b", "c"][..arguments].iter().map(|a| kind(a)).collect::<Vec<_>>().join(", ")
            };
            let (declared, given) =
                (each(|a| format!("half {a}")), each(|a| format!("float({a})")));
            functions += &format!("half {name}({declared}) {{ return half({name}({given})); }}\n");
        }
    }
    functions
}

fn function(language: Language, precision: Precision, case: &Case) -> String {
    let Case { program, names, function, stay_single, .. } = case;
    match precision {
        Single => text(language, program, names, function, &[]),
        InHalf => {
            let snippet = Snippet::new(program, names, function);
            emit_half(language, &snippet, stay_single).unwrap()
        }
    }
}

/// The types of a float and of a vector of floats, but for its number.
fn types(language: Language, precision: Precision) -> [&'static str; 2] {
    match (language, precision) {
        (Language::Wgsl, Single) => ["f32", "vec"],
        (Language::Wgsl, InHalf) => ["f16", "vec"],
        (Language::Glsl, Single) => ["float", "vec"],
        (Language::Glsl, InHalf) => ["float16_t", "f16vec"],
        (_, Single) => ["float", "float"],
        (_, InHalf) => ["half", "half"],
    }
}

/// The case's outputs at the row `i`.
fn call(
    language: Language,
    precision: Precision,
    case: &Case,
    input: usize,
    output: usize,
) -> String {
    let ([float, vector], [single, _]) = (types(language, precision), types(language, Single));
    let argument = |column| format!("{float}(columns[{}u + i])", input + column * case.rows());
    let arguments: Vec<String> = (0..case.inputs.len()).map(argument).collect();
    let (function, count) = match case.names.outputs.as_slice() {
        [output] => (format!("{}_{output}", case.function), 1),
        outputs => (case.function.clone(), outputs.len()),
    };
    let declared = match (language, count) {
        (Language::Wgsl, _) => "let".to_owned(),
        (_, 1) => float.to_owned(),
        (_, n) => format!("{vector}{n}"),
    };
    let mut code = format!("        {{ {declared} y = {function}({});", arguments.join(", "));
    for (o, component) in [".x", ".y", ".z", ".w"].into_iter().take(count).enumerate() {
        let value = if count == 1 { "y".to_owned() } else { format!("y{component}") };
        code += &format!(" results[{}u + i] = {single}({value});", output + o * case.rows());
    }
    code + " }\n"
}

/// What stands before the calls and after.
fn main_of(language: Language, rows: usize) -> (String, &'static str) {
    let before = match language {
        Language::Wgsl => format!(
            "@group(0) @binding(0) var<storage, read> columns: array<f32>;
@group(0) @binding(1) var<storage, read_write> results: array<f32>;
@compute @workgroup_size({GROUP})
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let i = id.x;
    if (i < {rows}u) {{\n"
        ),
        Language::Glsl => format!(
            "layout(local_size_x = {GROUP}) in;
layout(std430, binding = 0) readonly buffer Columns {{ float columns[]; }};
layout(std430, binding = 1) buffer Results {{ float results[]; }};
void main() {{
    uint i = gl_GlobalInvocationID.x;
    if (i < {rows}u) {{\n"
        ),
        _ => format!(
            "[[vk::binding(0)]] StructuredBuffer<float> columns;
[[vk::binding(1)]] RWStructuredBuffer<float> results;
[numthreads({GROUP}, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {{
    uint i = id.x;
    if (i < {rows}u) {{\n"
        ),
    };
    (before, "    }\n}\n")
}

fn compiled(compiler: Compiler, precision: Precision, source: &str) -> Vec<u32> {
    match compiler {
        Compiler::Naga => {
            let (module, info) = validated(source);
            let options = naga::back::spv::Options::default();
            naga::back::spv::write_vec(&module, &info, &options, None).unwrap()
        }
        Compiler::GlslangOfGlsl | Compiler::MaterialX => {
            glslang("main.comp", &format!("#version 450\n{source}"), &[])
        }
        Compiler::GlslangOfHlsl => {
            let halves = (precision == InHalf).then_some("--hlsl-enable-16bit-types");
            let options = ["-D", "-e", "main", "-S", "comp"].into_iter().chain(halves);
            glslang("main.hlsl", source, &options.collect::<Vec<_>>())
        }
        Compiler::Dxc => dxc::spirv(source, precision),
        Compiler::Slangc => slang::spirv(source),
    }
}

fn glslang(file: &str, source: &str, options: &[&str]) -> Vec<u32> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(file), source).unwrap();
    let command = ["glslangValidator", "-V", "--target-env", "vulkan1.2", "-o", "main.spv"];
    tools::run(folder.path(), &[&command, options, &[file]].concat());
    words(&folder.path().join("main.spv"))
}

/// A module of SPIR-V.
pub fn words(path: &Path) -> Vec<u32> {
    let bytes = std::fs::read(path).unwrap();
    bytes.chunks_exact(4).map(|b| u32::from_le_bytes(b.try_into().unwrap())).collect()
}
