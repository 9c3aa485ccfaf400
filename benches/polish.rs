//! Formulas from anywhere, made ready as a search makes ready its front: constants fitted to
//! convergence and shortened, code simplified, cycles counted, dominated formulas dropped.
//!
//! `cargo run --release --example polish -- DATASET OUTPUT < FORMULAS`, a formula a line: a statement
//! or an expression of the output, over the dataset's inputs or `x0`, `x1`, …. `exp` and `log` become
//! `exp2` and `log2` with a constant, so that no formula pays for a base. Prints the front as
//! CSV: cost, RMSE and maximum on the search grid, formula.

use lgp::cost::Profile;
use lgp::dataset::Dataset;
use lgp::eval::Samples;
use lgp::fit::{Fitter, Measure, Stop, shorten};
use lgp::op::Op;
use lgp::program::{Arg, Draft, Names, Program, effective, parse};
use lgp::search::{Front, FrontMember};
use lgp::simplify::{Simplifier, tidy};
use std::error::Error;

/// As for the front of a search.
const TO_CONVERGENCE: Stop = Stop { max_steps: 200, min_gain: 1e-7 };
const SHORTENING_ALLOWANCE: f64 = 0.004;

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().collect();
    let [_, path, output] = &args[..] else {
        return Err("DATASET OUTPUT < FORMULAS".into());
    };
    let dataset = Dataset::load(path.as_ref())?.select(None, Some(std::slice::from_ref(output)))?;
    let profile = Profile::find("gcn")?;
    let (mut members, mut refused) = (Vec::new(), 0);
    for line in std::io::stdin().lines() {
        match read(line?.trim(), &dataset) {
            Ok(program) => members.extend(polish(program, &dataset, &profile)),
            Err(error) => {
                refused += 1;
                eprintln!("left out: {error}");
            }
        }
    }
    println!("cost,rmse,max,formula");
    for member in Front::from_members(members, Measure::Rmse).members {
        let error = member.search_error();
        println!("{},{:.4e},{:.4e},\"{}\"", member.cost, error.rmse, error.max, member.formula);
    }
    if refused > 0 { Err(format!("{refused} formulas were left out").into()) } else { Ok(()) }
}

/// A program over the dataset's inputs, of a statement or an expression.
fn read(text: &str, dataset: &Dataset) -> Result<Program, Box<dyn Error>> {
    let names = dataset.names();
    let output = &names.outputs[0];
    let statement = if text.contains('=') { text.to_owned() } else { format!("{output} = {text}") };
    let numbered = Names::new((0..names.inputs.len()).map(|i| format!("x{i}")), [output.clone()]);
    Ok(parse(&statement, &names).or_else(|_| parse(&statement, &numbered))?)
}

fn polish(program: Program, dataset: &Dataset, profile: &Profile) -> Option<FrontMember> {
    let samples = Samples::new(&dataset.search, dataset.inputs.len());
    let mut fitter = Fitter::default();
    let mut simplifier = Simplifier::default();
    let mut draft = Draft::default();
    simplifier.simplify(&in_base_two(&program), &mut draft);
    fitter.fit(&mut draft, &samples, TO_CONVERGENCE);
    shorten(&mut fitter, &mut draft, &samples, SHORTENING_ALLOWANCE);
    let mut simple = Draft::default();
    simplifier.simplify(&draft, &mut simple);
    let names = dataset.names();
    let finished = [draft, simple].into_iter().filter_map(|draft| {
        let program = effective(&tidy(&Program::verify(draft).ok()?));
        Some(FrontMember::new(program, dataset, profile, &names))
    });
    finished.filter(|member| member.score.is_finite()).reduce(|plain, simple| {
        if simple.dominates(&plain, Measure::Rmse) { simple } else { plain }
    })
}

/// The program with `exp2` and `log2` for `exp` and `log`, and every use of a constant its own.
fn in_base_two(program: &Program) -> Draft {
    let mut draft = Draft::default();
    draft.clear(program.inputs);
    let mut results = Vec::with_capacity(program.instrs.len());
    for instr in &program.instrs {
        let args: Vec<Arg> =
            instr.args().iter().map(|&arg| moved(arg, program, &results, &mut draft)).collect();
        let result = match instr.op() {
            Op::Exp => {
                let factor = draft.constant(std::f32::consts::LOG2_E);
                let scaled = draft.push(Op::Mul, &[args[0], factor]);
                draft.push(Op::Exp2, &[scaled])
            }
            Op::Log => {
                let logarithm = draft.push(Op::Log2, &args);
                let factor = draft.constant(std::f32::consts::LN_2);
                draft.push(Op::Mul, &[logarithm, factor])
            }
            op => draft.push(op, &args),
        };
        results.push(result);
    }
    for &output in &program.outputs {
        let output = moved(output, program, &results, &mut draft);
        draft.outputs.push(output);
    }
    draft
}

fn moved(arg: Arg, program: &Program, results: &[Arg], draft: &mut Draft) -> Arg {
    match arg {
        Arg::Input(_) => arg,
        Arg::Result(i) => results[usize::from(i)],
        Arg::Const(i) => draft.constant(program.consts[usize::from(i)]),
    }
}
