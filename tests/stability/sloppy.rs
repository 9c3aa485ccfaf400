//! A GPU that makes, at random, every error that the specifications allow it.

#![deny(clippy::wildcard_enum_match_arm)]

use lgp::eval::{Arithmetic, Double};
use lgp::op::{Accuracy, Op};
use lgp::program::Program;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::cell::RefCell;

pub struct Sloppy(RefCell<ChaCha8Rng>);

impl Sloppy {
    pub fn new(seed: u64) -> Sloppy {
        Sloppy(RefCell::new(ChaCha8Rng::seed_from_u64(seed)))
    }

    pub fn evaluate(&self, program: &Program, point: &[f32]) -> Vec<f32> {
        let point: Vec<f32> = point.iter().map(|&x| self.flushed(x)).collect();
        Arithmetic::evaluate(self, program, &point)
    }

    fn coin(&self) -> bool {
        self.0.borrow_mut().random_bool(0.5)
    }

    /// Where nothing is promised.
    fn anything(&self) -> f32 {
        let some = [0.0, -1.0, 1.5, -1e30, f32::INFINITY, f32::NAN];
        some[self.0.borrow_mut().random_range(0..some.len())]
    }

    fn flushed(&self, x: f32) -> f32 {
        if x.is_subnormal() && self.coin() { 0.0 } else { x }
    }

    /// Either neighbour of a number, or a denormal flushed.
    fn rounded(&self, x: f64) -> f32 {
        let nearest = x as f32;
        let exact = f64::from(nearest) == x || !x.is_finite();
        let result = match (exact || self.coin(), f64::from(nearest) < x) {
            (true, _) => nearest,
            (false, true) => nearest.next_up(),
            (false, false) => nearest.next_down(),
        };
        self.flushed(result)
    }

    /// Off by a share of what the operation table grants GPUs.
    fn owed(&self, op: Op, argument: f32, exact: f64) -> f32 {
        let Accuracy::Within(tolerance) = op.gpu_accuracy() else { return exact as f32 };
        let ulps = tolerance.ulps_up_to(argument.abs().into());
        self.off(exact, ulps, tolerance.absolute_between(argument, argument))
    }

    /// Off by a random share of so many units, often all, plus as much of an absolute error.
    fn off(&self, x: f64, ulps: f64, absolute: f64) -> f32 {
        let share = self.0.borrow_mut().random_range(-2.0f64..2.0).clamp(-1.0, 1.0);
        if !x.is_finite() {
            return x as f32;
        }
        let nearest = (x as f32).abs();
        let ulp = if nearest.is_finite() {
            f64::from(nearest.next_up()) - f64::from(nearest)
        } else {
            f64::powi(2.0, 104)
        };
        let ulp = if ulp.is_finite() { ulp } else { f64::powi(2.0, 104) };
        let allowed = ulps * ulp + absolute;
        let result = (x + share * allowed) as f32;
        self.flushed(match f64::from(result) - x {
            far if far > allowed => result.next_down(),
            far if far < -allowed => result.next_up(),
            _ => result,
        })
    }
}

/// The table of WGSL's specification, section "Floating Point Accuracy", for `f32`; where that defines an
/// operation by others, by way of these, so that what follows from it is tried as well.
impl Arithmetic for Sloppy {
    type Value = f32;

    fn constant(&self, value: f32) -> f32 {
        self.flushed(value)
    }

    fn apply(&self, op: Op, arguments: [f32; 4]) -> f32 {
        let [a, b, c, _] = arguments;
        let exact = Double.apply(op, arguments.map(f64::from));
        let two = |op: Op, a: f32, b: f32| self.apply(op, [a, b, 0.0, 0.0]);
        match op {
            Op::Add | Op::Sub | Op::Mul | Op::Fract => self.rounded(exact),
            Op::Mad if self.coin() => self.rounded(exact),
            Op::Mad => two(Op::Add, two(Op::Mul, a, b), c),
            Op::Div if b.abs() > 8.6e37 && self.coin() => 0.0 * a,
            Op::Div => self.owed(op, a, exact),
            Op::Rcp if a.abs() > 8.6e37 && self.coin() => 0.0,
            Op::Rcp | Op::Rsqrt => self.owed(op, a, exact),
            Op::Sqrt if a > 0.0 && a.is_finite() => two(Op::Rcp, two(Op::Rsqrt, a, 0.0), 0.0),
            Op::Exp2 | Op::Exp => {
                let power = self.owed(op, a, exact);
                if power < 0.0 { 0.0 } else { power }
            }
            Op::Log2 | Op::Log | Op::Atan => self.owed(op, a, exact),
            Op::Pow => two(Op::Exp2, two(Op::Mul, b, two(Op::Log2, a, 0.0)), 0.0),
            Op::Sin | Op::Cos if a.abs() <= op.gpu_accuracy().up_to() => self.owed(op, a, exact),
            Op::Sin | Op::Cos if a.is_nan() => a,
            Op::Sin | Op::Cos => self.anything(),
            Op::Tan => two(Op::Div, two(Op::Sin, a, 0.0), two(Op::Cos, a, 0.0)),
            Op::Atan2 => self.flushed(op.apply(arguments)),
            Op::Asin | Op::Acos if a.abs() <= 1.0 => {
                let root = two(Op::Sqrt, two(Op::Sub, 1.0, two(Op::Mul, a, a)).max(0.0), 0.0);
                let (y, x) = if op == Op::Asin { (a, root) } else { (root, a) };
                self.off(f64::from(y).atan2(x.into()), 4096.0, 0.0)
            }
            Op::Tanh => self.off(exact, 4.0, 1e-5),
            Op::Lerp if self.coin() => {
                two(Op::Add, two(Op::Mul, a, two(Op::Sub, 1.0, c)), two(Op::Mul, b, c))
            }
            Op::Lerp => self.apply(Op::Mad, [c, two(Op::Sub, b, a), a, 0.0]),
            Op::Min if self.coin() => a.min(b),
            Op::Max if self.coin() => a.max(b),
            Op::Saturate if a.is_nan() && self.coin() => 0.0,
            // Without an error of their own, or without a value.
            Op::Neg
            | Op::Abs
            | Op::Min
            | Op::Max
            | Op::Saturate
            | Op::Sqrt
            | Op::Asin
            | Op::Acos => self.flushed(op.apply(arguments)),
            Op::Step | Op::Select | Op::Floor | Op::Sign => self.flushed(op.apply(arguments)),
        }
    }
}
