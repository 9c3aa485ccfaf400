//! Every function of one argument on all 2³² `f32`s against `f64`: the largest error and where.
//!
//! `cargo run --release --example exhaustive [FUNCTION]…`, some minutes.

use lgp::dataset::Split;
use lgp::eval::{Evaluator, Samples, Tape, Values};
use lgp::op::Op;
use lgp::program::{Arg, Draft, Program};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering};

/// A function, its exact values, and the arguments for which an error is stated.
struct Case {
    op: Op,
    exact: fn(f64) -> f64,
    range: (f32, f32),
}

const ALL: (f32, f32) = (f32::NEG_INFINITY, f32::INFINITY);

const CASES: &[Case] = &[
    Case { op: Op::Exp2, exact: f64::exp2, range: ALL },
    Case { op: Op::Exp, exact: f64::exp, range: ALL },
    Case { op: Op::Log2, exact: f64::log2, range: ALL },
    Case { op: Op::Log, exact: f64::ln, range: ALL },
    Case { op: Op::Sin, exact: f64::sin, range: (-1e4, 1e4) },
    Case { op: Op::Cos, exact: f64::cos, range: (-1e4, 1e4) },
    Case { op: Op::Tan, exact: f64::tan, range: (-1e4, 1e4) },
    Case { op: Op::Asin, exact: f64::asin, range: ALL },
    Case { op: Op::Acos, exact: f64::acos, range: ALL },
    Case { op: Op::Atan, exact: f64::atan, range: ALL },
    Case { op: Op::Tanh, exact: f64::tanh, range: ALL },
    Case { op: Op::Rcp, exact: f64::recip, range: ALL },
    Case { op: Op::Sqrt, exact: f64::sqrt, range: ALL },
    Case { op: Op::Rsqrt, exact: |x| x.sqrt().recip(), range: ALL },
    Case { op: Op::Floor, exact: f64::floor, range: ALL },
    Case { op: Op::Fract, exact: |x| x - x.floor(), range: (f32::MIN, f32::MAX) },
    Case { op: Op::Neg, exact: |x| -x, range: ALL },
    Case { op: Op::Abs, exact: f64::abs, range: ALL },
    Case { op: Op::Sign, exact: |x| if x == 0.0 { x } else { x.signum() }, range: ALL },
    Case {
        op: Op::Saturate,
        exact: |x| if x.is_nan() { x } else { x.clamp(0.0, 1.0) },
        range: ALL,
    },
];

/// Fails to compile where a function of one argument is forgotten.
const _: () = {
    let (mut functions, mut i) = (0, 0);
    while i < Op::ALL.len() {
        functions += (Op::ALL[i].arity() == 1) as usize;
        i += 1;
    }
    assert!(CASES.len() == functions, "a case for each function of one argument");
};

/// Arguments that are evaluated at once; they share their upper bits.
const BATCH: u32 = 1 << 16;

/// The largest error so far, and whether some value is of the wrong kind (NaN, infinite or not).
#[derive(Clone, Copy, Default)]
struct Worst {
    ulp: f64,
    at: f32,
    wrong: Option<f32>,
}

impl Worst {
    fn take(&mut self, x: f32, got: f32, exact: f64) {
        let rounded = exact as f32;
        let same = got == rounded || (got.is_nan() && rounded.is_nan());
        if same && !rounded.is_finite() {
            return;
        }
        // One ulp beside the largest float is infinity.
        let edge = rounded.is_infinite() && got.abs() == f32::MAX
            || got.is_infinite() && rounded.abs() == f32::MAX;
        if !(got.is_finite() && rounded.is_finite()) {
            if !edge {
                self.wrong.get_or_insert(x);
            }
            return;
        }
        let error = (f64::from(got) - exact).abs() / ulp(rounded);
        if error > self.ulp {
            (self.ulp, self.at) = (error, x);
        }
    }

    fn merge(&mut self, other: Worst) {
        if other.ulp > self.ulp {
            (self.ulp, self.at) = (other.ulp, other.at);
        }
        self.wrong = self.wrong.or(other.wrong);
    }
}

/// The unit in the last place of `x`; of a denormal the smallest denormal.
fn ulp(x: f32) -> f64 {
    let binade = f32::from_bits(x.abs().to_bits().max(0x0080_0000) & 0x7f80_0000);
    f64::from(binade) * f64::from(f32::EPSILON)
}

fn program(op: Op) -> Program {
    let mut draft = Draft { inputs: 1, ..Draft::default() };
    let result = draft.push(op, &[Arg::Input(0)]);
    draft.outputs = vec![result];
    Program::verify(draft).expect("one instruction")
}

/// Batches from the shared counter until none is left.
fn work(case: &Case, next: &AtomicU32) -> Worst {
    let tape = Tape::new(&program(case.op));
    let (mut evaluator, mut values) = (Evaluator::default(), Values::default());
    let mut worst = Worst::default();
    loop {
        let batch = next.fetch_add(1, Ordering::Relaxed);
        if batch >= 1 << 16 {
            return worst;
        }
        let arguments: Vec<f32> = (0..BATCH).map(|i| f32::from_bits(batch << 16 | i)).collect();
        let inside = |x: f32| x.is_nan() || (case.range.0..=case.range.1).contains(&x);
        if !arguments.iter().any(|&x| inside(x)) {
            continue;
        }
        let split = Split { columns: vec![arguments], ..Split::default() };
        evaluator.outputs_into(&tape, &Samples::new(&split, 1), &mut values);
        for (&x, &got) in split.columns[0].iter().zip(values.column(0)) {
            if inside(x) {
                worst.take(x, got, (case.exact)(f64::from(x)));
            }
        }
    }
}

fn check(case: &Case) -> Worst {
    let (next, worst) = (AtomicU32::new(0), Mutex::new(Worst::default()));
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let found = work(case, &next);
                worst.lock().expect("no thread panics").merge(found);
            });
        }
    });
    worst.into_inner().expect("no thread panics")
}

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    println!("function   largest error   at               range");
    for case in CASES {
        if !wanted.is_empty() && !wanted.iter().any(|name| name == case.op.name()) {
            continue;
        }
        let worst = check(case);
        let (low, high) = case.range;
        print!("{:10} {:.4} ulp      {:<16e} [{low}, {high}]", case.op.name(), worst.ulp, worst.at);
        match worst.wrong {
            Some(x) => println!("; of the wrong kind at {x:e}"),
            None => println!(),
        }
    }
}
