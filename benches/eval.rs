//! Evaluators on the same random programs, preparation included, one thread; and each operation
//! by itself. Throughput is in operations times samples.

mod programs;

use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use criterion::{SamplingMode, measurement::WallTime};
use dynamic_expressions::operator_enum::builtin::*;
use dynamic_expressions::{
    EvalContext, EvalOptions, PNode, PostfixExpr, eval_tree_array_into, opset,
};
use lgp::eval::{BLOCK, CHUNK, Evaluator, Samples, Tape, Values};
use lgp::op::{MAX_ARITY, Op};
use lgp::program::{Arg, Draft, Program};
use ndarray::Array2;
use std::hint::black_box;
use std::time::Duration;

/// Programs of each set.
const PROGRAMS: usize = 200;

opset! {
    Peer for f32 { Sqrt, Exp2, Log2, Add, Sub, Mul, Div, Min, Max }
}

/// The peer's number for an operation: its place in the list above.
fn peer_operation(op: Op) -> u16 {
    let order =
        [Op::Sqrt, Op::Exp2, Op::Log2, Op::Add, Op::Sub, Op::Mul, Op::Div, Op::Min, Op::Max];
    order.iter().position(|&known| known == op).expect("an operation of the sets") as u16
}

/// A tree in postfix order.
fn postfix(program: &Program) -> PostfixExpr<f32, Peer, 2> {
    fn visit(program: &Program, arg: Arg, nodes: &mut Vec<PNode>) {
        match arg {
            Arg::Input(feature) => nodes.push(PNode::Var { feature }),
            Arg::Const(idx) => nodes.push(PNode::Const { idx }),
            Arg::Result(i) => {
                let instr = program.instrs[usize::from(i)];
                instr.args().iter().for_each(|&arg| visit(program, arg, nodes));
                let (arity, op) = (instr.op().arity() as u8, peer_operation(instr.op()));
                nodes.push(PNode::Op { arity, op });
            }
        }
    }
    let mut nodes = Vec::new();
    visit(program, program.outputs[0], &mut nodes);
    PostfixExpr::new(nodes, program.consts.clone(), Default::default())
}

/// What one would write first: sample by sample, instruction by instruction.
fn scalar(program: &Program, columns: &[Vec<f32>], results: &mut Vec<f32>, values: &mut [f32]) {
    for (row, value) in values.iter_mut().enumerate() {
        results.clear();
        let read = |arg: Arg, results: &[f32]| match arg {
            Arg::Input(i) => columns[usize::from(i)][row],
            Arg::Const(i) => program.consts[usize::from(i)],
            Arg::Result(i) => results[usize::from(i)],
        };
        for instr in &program.instrs {
            let mut args = [0.0; MAX_ARITY];
            for (to, &arg) in args.iter_mut().zip(instr.args()) {
                *to = read(arg, results);
            }
            let [a, b, ..] = args;
            results.push(match instr.op() {
                Op::Add => a + b,
                Op::Sub => a - b,
                Op::Mul => a * b,
                Op::Div => a / b,
                Op::Min => a.min(b),
                Op::Max => a.max(b),
                Op::Sqrt => a.sqrt(),
                Op::Exp2 => a.exp2(),
                Op::Log2 => a.log2(),
                other => unreachable!("{other} is in no set"),
            });
        }
        *value = read(program.outputs[0], results);
    }
}

fn compare(criterion: &mut Criterion) {
    let split = programs::samples(programs::SAMPLES);
    let samples = Samples::new(&split, programs::INPUTS);
    let columns = &split.columns[..programs::INPUTS];
    let table = Array2::from_shape_vec((programs::INPUTS, programs::SAMPLES), columns.concat());
    let table = table.expect("columns of equal length");
    for set in &programs::SETS {
        let programs = set.programs(PROGRAMS);
        let trees: Vec<_> = programs.iter().map(postfix).collect();
        let mut group = criterion.benchmark_group(set.name);
        group.throughput(Throughput::Elements(
            (programs::operations(&programs) * programs::SAMPLES) as u64,
        ));
        brief(&mut group);

        let (mut evaluator, mut tape) = (Evaluator::default(), Tape::default());
        let mut values = Values::default();
        group.bench_function("lgp", |bencher| {
            bencher.iter(|| {
                for program in &programs {
                    tape.prepare(black_box(program));
                    evaluator.outputs_into(&tape, &samples, &mut values);
                    black_box(values.column(0));
                }
            })
        });

        let options = EvalOptions { check_finite: false, early_exit: false };
        let mut context = EvalContext::<f32, 2>::new(programs::SAMPLES);
        let mut out = vec![0.0; programs::SAMPLES];
        group.bench_function("dynamic_expressions", |bencher| {
            bencher.iter(|| {
                for tree in &trees {
                    let tree = black_box(tree);
                    eval_tree_array_into(&mut out, tree, table.view(), &mut context, &options);
                    black_box(&out);
                }
            })
        });

        let mut results = Vec::new();
        group.bench_function("scalar", |bencher| {
            bencher.iter(|| {
                for program in &programs {
                    scalar(black_box(program), columns, &mut results, &mut out);
                    black_box(&out);
                }
            })
        });
        group.finish();
    }
}

/// Times are those of a chunk and `CHAIN` operations, each on the last one's result.
fn operations(criterion: &mut Criterion) {
    const CHAIN: usize = 64;
    let split = programs::samples(CHUNK);
    let samples = Samples::new(&split, programs::INPUTS);
    let mut group = criterion.benchmark_group("operation");
    group.throughput(Throughput::Elements((CHAIN * CHUNK) as u64));
    brief(&mut group);
    let (mut evaluator, mut values) = (Evaluator::default(), Values::default());
    for &op in Op::ALL {
        let tape = Tape::new(&chain(op, CHAIN));
        group.bench_function(op.name(), |bencher| {
            bencher.iter(|| {
                evaluator.outputs_into(black_box(&tape), &samples, &mut values);
                black_box(values.column(0)[BLOCK]);
            })
        });
    }
    group.finish();
}

/// `op` on inputs and, last, the result before.
fn chain(op: Op, length: usize) -> Program {
    let mut draft = Draft { inputs: programs::INPUTS, ..Draft::default() };
    let mut args = [Arg::Input(0), Arg::Input(1), Arg::Input(2), Arg::Input(0)];
    for _ in 0..length {
        args[op.arity() - 1] = draft.push(op, &args);
    }
    draft.outputs = vec![args[op.arity() - 1]];
    Program::verify(draft).expect("arguments are earlier ones")
}

fn brief(group: &mut BenchmarkGroup<WallTime>) {
    group
        .sampling_mode(SamplingMode::Flat)
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1500));
}

criterion_group! {
    name = benches;
    // Its plots want a font that is registered; ours are drawn by `throughput`.
    config = Criterion::default().without_plots();
    targets = compare, operations
}
criterion_main!(benches);
