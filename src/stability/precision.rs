//! The losses of single and half precision.

use super::blame::{Blame, Cause, Evaluation, relative, traced};
use super::variants::Variant;
use super::{half, points};
use crate::eval::{Arithmetic, Double, Half};
use crate::num::Interval;
use crate::op::Op;
use crate::program::{Arg, Program};

/// The worst loss found of an output.
#[derive(Clone, Debug, PartialEq)]
pub struct PrecisionLoss {
    /// The index of the output.
    pub output: usize,
    /// The input where it occurs.
    pub input: Vec<f32>,
    /// The value in low precision.
    pub found: f64,
    /// The value in `f64`.
    pub exact: f64,
    /// The instruction to blame.
    pub blame: Blame,
}

impl PrecisionLoss {
    fn is_of_numbers(&self) -> bool {
        self.found.is_finite() && self.exact.is_finite()
    }

    /// Returns the absolute error; infinite unless both values are finite.
    pub fn absolute(&self) -> f64 {
        let error = (self.found - self.exact).abs();
        if error.is_nan() { f64::INFINITY } else { error }
    }

    /// Returns the relative error; 1 where `f64` has underflowed, too, since all digits are lost.
    pub fn relative(&self) -> f64 {
        match relative(self.found, self.exact) {
            0.0 if self.blame.cause == Cause::Underflow => 1.0,
            error => error,
        }
    }

    /// Returns the absolute error in units in the last place of `f32`.
    pub fn ulps(&self) -> f64 {
        let exact = (self.exact as f32).abs();
        self.absolute() / f64::from(exact.next_up() - exact)
    }
}

/// The worst losses found, of finite values by absolute and by relative error, and of values not
/// finite in low precision.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Precision {
    /// The largest absolute error.
    pub absolute: Option<PrecisionLoss>,
    /// The largest relative error.
    pub relative: Option<PrecisionLoss>,
    /// A value that is infinite or NaN in low precision.
    pub not_finite: Option<PrecisionLoss>,
}

/// The approximate number of points tried. Chosen by hand, unmeasured.
const POINTS: usize = 4096;

impl Precision {
    /// Compares `f32` with `f64`, every `mad` fused and not, at points spread over the domain and
    /// crowded towards its faces.
    ///
    /// # Panics
    /// If `domain` does not have one interval for each input.
    pub fn single(program: &Program, domain: &[Interval]) -> Precision {
        let points = points::all(&points::axes(domain, POINTS, 24));
        let least = f32::MIN_POSITIVE.into();
        worst(program, &points, least, |program, point| {
            vec![program.evaluate(point).into_iter().map(f64::from).collect()]
        })
    }

    /// Compares half precision with `f64`, at inputs that halves hold, denormals kept and flushed.
    ///
    /// # Panics
    /// If `domain` does not have one interval for each input.
    pub fn half(program: &Program, domain: &[Interval]) -> Precision {
        Precision::in_halves(program, domain, &half::ARITHMETICS)
    }

    /// Compares as [`Precision::half`] does, with denormals kept, or flushed, or both, as given.
    ///
    /// # Panics
    /// If `domain` does not have one interval for each input.
    pub fn in_halves(program: &Program, domain: &[Interval], arithmetics: &[Half]) -> Precision {
        let points = half::points(domain, POINTS).points;
        worst(program, &points, half::MIN_NORMAL, |program, point| {
            let of = |&arithmetic| half::outputs(program, &[], arithmetic, point);
            arithmetics.iter().map(of).collect()
        })
    }
}

/// Returns the worst losses at `points`. `evaluate` gives the outputs of one arithmetic or several;
/// `least` is their least normal number. Blame refers to the program as written.
fn worst(
    program: &Program,
    points: &[Vec<f32>],
    least: f64,
    evaluate: impl Fn(&Program, &[f32]) -> Vec<Vec<f64>>,
) -> Precision {
    let mut worst = Precision::default();
    for Variant { program, origin } in Variant::fused_or_not(program) {
        let traced = traced(&program);
        for point in points {
            let inputs: Vec<f64> = point.iter().map(|&x| x.into()).collect();
            let exact = Double.evaluate(&traced, &inputs);
            for found in evaluate(&traced, point) {
                let (program, exact) = (&program, &exact);
                let trace = Evaluation { program, inputs: point, found: &found, exact, least };
                worst.note(&trace, &origin);
            }
        }
    }
    worst
}

impl Precision {
    /// Notes losses at a point that are worse than those known; `origin` maps to the program as
    /// written.
    fn note(&mut self, trace: &Evaluation, origin: &[usize]) {
        let count = trace.program.instrs.len();
        for (output, &arg) in trace.program.outputs.iter().enumerate() {
            let (found, exact) = (trace.found[count + output], trace.exact[count + output]);
            let vanished = vanished(trace, found, exact);
            let plain = Blame { instruction: None, cause: Cause::Rounding, condition: 1.0 };
            let blame = vanished.unwrap_or(plain);
            let mut loss = PrecisionLoss { output, input: Vec::new(), found, exact, blame };
            if !self.is_worsened_by(&loss) {
                continue;
            }
            loss.blame = vanished.unwrap_or_else(|| trace.blame(arg));
            loss.blame.instruction = loss.blame.instruction.map(|i| origin[i]);
            loss.input = trace.inputs.to_vec();
            self.take(&loss);
        }
    }

    fn is_worsened_by(&self, loss: &PrecisionLoss) -> bool {
        let exceeds = |known: &Option<PrecisionLoss>, size: fn(&PrecisionLoss) -> f64| {
            known.as_ref().is_none_or(|known| size(loss) > size(known))
        };
        loss.is_of_numbers()
            && (exceeds(&self.absolute, PrecisionLoss::absolute)
                || exceeds(&self.relative, PrecisionLoss::relative))
            || !loss.found.is_finite() && self.not_finite.is_none()
    }

    /// Notes a loss wherever it is worse than the one known.
    fn take(&mut self, loss: &PrecisionLoss) {
        let offer = |to: &mut Option<PrecisionLoss>, size: fn(&PrecisionLoss) -> f64| {
            if to.as_ref().is_none_or(|known| size(loss) > size(known)) {
                *to = Some(loss.clone());
            }
        };
        if loss.is_of_numbers() {
            offer(&mut self.absolute, PrecisionLoss::absolute);
            offer(&mut self.relative, PrecisionLoss::relative);
        }
        if !loss.found.is_finite() {
            offer(&mut self.not_finite, |_| 1.0);
        }
    }
}

/// Returns the blame for an output that is zero because an exponential has underflowed even in
/// `f64`; none if that is not so.
fn vanished(trace: &Evaluation, found: f64, exact: f64) -> Option<Blame> {
    if found != 0.0 || exact != 0.0 {
        return None;
    }
    let value = |arg: Arg| match arg {
        Arg::Input(i) => f64::from(trace.inputs[usize::from(i)]),
        Arg::Const(i) => f64::from(trace.program.consts[usize::from(i)]),
        Arg::Result(i) => trace.exact[usize::from(i)],
    };
    let place = trace.program.instrs.iter().enumerate().position(|(i, instr)| {
        let args = instr.args();
        trace.exact[i] == 0.0
            && match instr.op() {
                Op::Exp | Op::Exp2 => value(args[0]).is_finite(),
                Op::Pow => value(args[0]) > 0.0 && value(args[1]).is_finite(),
                // Zero only where the exact result is zero.
                Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Neg | Op::Mad | Op::Lerp => false,
                Op::Rcp | Op::Sqrt | Op::Rsqrt | Op::Log2 | Op::Log | Op::Tanh => false,
                Op::Sin | Op::Cos | Op::Tan | Op::Asin | Op::Acos | Op::Atan | Op::Atan2 => false,
                Op::Abs | Op::Min | Op::Max | Op::Saturate | Op::Step | Op::Select => false,
                Op::Floor | Op::Fract | Op::Sign => false,
            }
    });
    let condition = f64::INFINITY;
    place.map(|i| Blame { instruction: Some(i), cause: Cause::Underflow, condition })
}
