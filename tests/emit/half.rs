//! WGSL, GLSL, HLSL and Slang in half precision: run on Mesa's software Vulkan, GLSL ES on its OpenGL, and
//! compared with the evaluator for halves, and with single precision.

use crate::agreement::{Case, Tolerance, front, operations};
use crate::grid::Grid;
use crate::lavapipe::{Compiler, Precision::InHalf, device, outputs};
use crate::{browser, tools};
use ::half::f16;
use lgp::eval::{Arithmetic, Double, Half};
use lgp::num::Interval;
use lgp::op::{MAX_ARITY, Op};
use lgp::program::Arg;
use lgp::stability::must_stay_single;
use std::collections::BTreeMap;

#[test]
fn wgsl_in_half_precision_computes_what_the_evaluator_computes() {
    agree_in_half(Compiler::Naga);
}

#[test]
fn glsl_in_half_precision_computes_what_the_evaluator_computes() {
    agree_in_half(Compiler::GlslangOfGlsl);
}

#[test]
fn hlsl_in_half_precision_computes_what_the_evaluator_computes() {
    agree_in_half(Compiler::GlslangOfHlsl);
}

#[test]
fn hlsl_in_half_precision_by_dxc_computes_what_the_evaluator_computes() {
    agree_in_half(Compiler::Dxc);
}

#[test]
fn slang_in_half_precision_computes_what_the_evaluator_computes() {
    agree_in_half(Compiler::Slangc);
}

/// What [`must_stay_single`] leaves in single precision for an error of [`MIXED_ERROR`].
#[test]
fn mixed_precision_errs_as_little_as_it_was_chosen_for() {
    let domain = [Interval::new(0.0, 1.0); 2];
    let chosen = |mut case: Case| {
        case.stay_single = must_stay_single(&case.program, &domain, MIXED_ERROR)?;
        (!case.stay_single.is_empty()).then(|| with_half_inputs(case))
    };
    let cases: Vec<Case> = front().into_iter().step_by(4).filter_map(chosen).collect();
    assert!(cases.len() >= 5, "too few formulas need it: {}", cases.len());
    let compilers = [
        Compiler::Naga,
        Compiler::GlslangOfGlsl,
        Compiler::GlslangOfHlsl,
        Compiler::Dxc,
        Compiler::Slangc,
    ];
    for compiler in compilers {
        let Some(gpu) = device(compiler) else { continue };
        if !gpu.half {
            return tools::skipped(&format!("{} has no halves; they were not run", gpu.name));
        }
        errs_little(&format!("{compiler:?}"), &cases, outputs(&gpu, compiler, InHalf, &cases));
    }
    if browser::found("GLSL ES in mixed precision was not run") {
        let grid = Grid { cases };
        errs_little("GLSL ES", &grid.cases, browser::outputs_in_half(&grid));
    }
}

fn errs_little(what: &str, cases: &[Case], found: Vec<Vec<Vec<f32>>>) {
    for (case, found) in cases.iter().zip(found) {
        let singles = case.stay_single.len();
        let exact = in_double(case);
        let [off, evaluated, without] = [&found, &mixed(case), &in_half(case)]
            .map(|outputs| largest_difference(outputs, &exact));
        println!(
            "{what}, {}: {singles} in single, off by {off:.5}, the evaluator by \
             {evaluated:.5}; by {without:.5} in halves alone",
            case.title
        );
        assert!(f64::from(evaluated) <= MIXED_SLACK * MIXED_ERROR, "{}: {off}", case.title);
        assert!(f64::from(off) <= 2.0 * MIXED_ERROR, "{}: {off}", case.title);
    }
}

const MIXED_ERROR: f64 = 2e-3;

/// Points are others than those that it was chosen on.
const MIXED_SLACK: f64 = 1.5;

/// The outputs in halves, but for what stays in single precision.
fn mixed(case: &Case) -> Vec<Vec<f32>> {
    let mut outputs = vec![Vec::new(); case.expected.len()];
    let half = |x: f32| f16::from_f32(x).to_f32();
    for row in 0..case.rows() {
        let mut results: Vec<f32> = Vec::new();
        let value = |arg: Arg, results: &[f32]| match arg {
            Arg::Input(i) => case.inputs[usize::from(i)][row],
            Arg::Const(i) => case.program.consts[usize::from(i)],
            Arg::Result(i) => results[usize::from(i)],
        };
        for (i, instr) in case.program.instrs.iter().enumerate() {
            let mut args = [0.0; MAX_ARITY];
            args.iter_mut().zip(instr.args()).for_each(|(to, &arg)| *to = value(arg, &results));
            results.push(match case.stay_single.contains(&i) {
                true => instr.op().apply(args),
                false => Half::default().apply(instr.op(), args.map(f16::from_f32)).to_f32(),
            });
        }
        for (output, &arg) in outputs.iter_mut().zip(&case.program.outputs) {
            output.push(half(value(arg, &results)));
        }
    }
    outputs
}

/// The outputs in double precision.
fn in_double(case: &Case) -> Vec<Vec<f32>> {
    let mut outputs = vec![Vec::new(); case.expected.len()];
    for row in 0..case.rows() {
        let inputs: Vec<f64> = case.inputs.iter().map(|x| x[row].into()).collect();
        let values = Double.evaluate(&case.program, &inputs);
        outputs.iter_mut().zip(values).for_each(|(output, value)| output.push(value as f32));
    }
    outputs
}

fn agree_in_half(compiler: Compiler) {
    let Some(gpu) = device(compiler) else { return };
    if !gpu.half {
        return tools::skipped(&format!("{} has no halves; they were not run", gpu.name));
    }
    for cases in [operations(), front()] {
        let cases: Vec<Case> = cases.into_iter().map(with_half_inputs).collect();
        compare(&format!("{compiler:?}"), &cases, outputs(&gpu, compiler, InHalf, &cases));
    }
}

/// SwiftShader computes `mediump` in single precision, Mesa in half.
#[test]
fn glsl_es_in_half_precision_computes_what_the_evaluator_computes() {
    if browser::found("GLSL ES in half precision was not run") {
        let cases = Grid::of_all().cases.into_iter().map(with_half_inputs).collect();
        let grid = Grid { cases };
        let mut found = browser::outputs_in_half(&grid);
        // Of a function with one operation it makes one of single precision, which the qualifier allows.
        let values = found.iter_mut().flatten().flatten();
        values.for_each(|value| *value = f16::from_f32(*value).to_f32());
        compare("GLSL ES", &grid.cases, found);
    }
}

/// Operations with the evaluator for halves, formulas with it and with single precision.
fn compare(what: &str, cases: &[Case], found: Vec<Vec<Vec<f32>>>) {
    let mut worst: BTreeMap<Op, f32> = BTreeMap::new();
    for (case, found) in cases.iter().zip(found) {
        let evaluator = in_half(case);
        if let Some(op) = case.op {
            let apart = case.compare_with(&evaluator, &found, half_tolerance(op));
            worst.entry(op).and_modify(|worst| *worst = worst.max(apart)).or_insert(apart);
            continue;
        }
        let run = largest_difference(&found, &case.expected);
        let evaluated = largest_difference(&evaluator, &case.expected);
        let between = largest_difference(&found, &evaluator);
        println!(
            "{what} in half, {}: off single precision by {run:.5}, the evaluator by \
             {evaluated:.5}; {between:.5} between them",
            case.title
        );
        assert!(run <= 2.0 * evaluated + 2e-3, "{}: {run}, not {evaluated}", case.title);
    }
    for (op, worst) in worst {
        println!("{what} in half, {op}: {worst:.1e} apart at most");
    }
}

/// The same with inputs that a shader in half precision can be given; what is expected remains.
pub fn with_half_inputs(mut case: Case) -> Case {
    for value in case.inputs.iter_mut().flatten() {
        *value = f16::from_f32(*value).to_f32();
    }
    case
}

/// The outputs that the evaluator for half precision gives.
pub fn in_half(case: &Case) -> Vec<Vec<f32>> {
    let mut outputs = vec![Vec::new(); case.expected.len()];
    for row in 0..case.rows() {
        let inputs: Vec<f16> = case.inputs.iter().map(|x| f16::from_f32(x[row])).collect();
        let values = Half::default().evaluate(&case.program, &inputs);
        outputs.iter_mut().zip(values).for_each(|(output, value)| output.push(value.to_f32()));
    }
    outputs
}

pub fn largest_difference(found: &[Vec<f32>], expected: &[Vec<f32>]) -> f32 {
    let differences =
        found.iter().flatten().zip(expected.iter().flatten()).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |worst, difference| if difference <= worst { worst } else { difference })
}

/// What Vulkan demands of half precision, an ulp being up to 9.8e-4 of a value.
fn half_tolerance(op: Op) -> Tolerance {
    let [absolute, relative] = match op {
        Op::Neg | Op::Abs | Op::Min | Op::Max | Op::Saturate | Op::Step | Op::Select => [0.0, 0.0],
        Op::Floor | Op::Fract | Op::Sign => [0.0, 0.0],
        Op::Add | Op::Sub | Op::Mul => [0.0, 0.0],
        // Roundings of terms up to 64 and 72.
        Op::Mad => [0.04, 0.0],
        Op::Lerp => [0.2, 0.0],
        Op::Div | Op::Rcp => [0.0, 2.5e-3],
        Op::Rsqrt | Op::Sqrt => [0.0, 4e-3],
        // 1 + 2 |x| ulp, |x| up to 8.
        Op::Exp2 | Op::Exp => [0.0, 0.017],
        // 2^-7 between ½ and 2, 3 ulp elsewhere.
        Op::Log2 | Op::Log => [7.9e-3, 3e-3],
        Op::Pow => [7.9e-3, 0.15],
        Op::Sin | Op::Cos => [7.9e-3, 0.0],
        Op::Tan => [0.03, 0.03],
        // 5 ulp.
        Op::Asin | Op::Acos | Op::Atan | Op::Atan2 => [5e-3, 5e-3],
        Op::Tanh => [5e-3, 5e-3],
    };
    Tolerance { absolute, relative }
}
