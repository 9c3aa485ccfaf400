//! Bounds how far rounding takes a formula's values from those in real numbers.

use super::local::Local;
use crate::eval::{Arithmetic, Bounds};
use crate::num::{Interval, Span, enclose};
use crate::op::{Accuracy, MAX_ARITY, Op};
use crate::program::{Arg, Program};
use crate::stability::Rounding;
use crate::stability::enclosure::describes;
use crate::stability::rounding::flushed;

/// A value over a box: in real numbers, as computed, and how far these may be apart at an input.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rounded {
    real: Span,
    /// All that may be computed, NaN included.
    pub computed: Interval,
    /// The most by which the computed number is off; says nothing of NaN.
    pub error: f64,
}

/// What the additions of errors in `f64` may lose, relative to their sum.
const LOSS: f64 = 1e-14;

/// Evaluates programs over boxes as a rounding allows, beside their values in real numbers. The
/// error of each operation is that of its arguments times its slopes, and its own.
#[derive(Clone, Debug)]
pub(super) struct RoundedValues {
    rounding: Rounding,
    values: Vec<Rounded>,
}

impl RoundedValues {
    pub fn new(rounding: Rounding) -> RoundedValues {
        RoundedValues { rounding, values: Vec::new() }
    }

    /// Returns the program's output of the index over a box.
    pub fn evaluate(&mut self, program: &Program, domain: &[Interval], output: usize) -> Rounded {
        self.values.clear();
        let step = Step(self.rounding);
        for instr in &program.instrs {
            let args = instr.args();
            let of = |k: usize| self.load(program, domain, args[k.min(args.len() - 1)]);
            let same = args.len() > 1 && args[0] == args[1];
            let result = step.apply(instr.op(), [of(0), of(1), of(2), of(3)], same);
            self.values.push(result);
        }
        self.load(program, domain, program.outputs[output])
    }

    fn load(&self, program: &Program, domain: &[Interval], arg: Arg) -> Rounded {
        let stored = |exact: Interval| {
            let computed = if self.rounding == Rounding::Gpu { flushed(exact) } else { exact };
            let denormal = computed != exact || exact.contains(0.0) && exact.low() < exact.high();
            let flushes = self.rounding == Rounding::Gpu && denormal;
            let error = if flushes { f64::from(f32::MIN_POSITIVE) } else { 0.0 };
            Rounded { real: span(exact), computed, error }
        };
        match arg {
            Arg::Result(i) => self.values[usize::from(i)],
            Arg::Input(i) => stored(domain[usize::from(i)]),
            Arg::Const(i) => {
                let value = program.consts[usize::from(i)];
                stored(Interval::new(value, value))
            }
        }
    }
}

impl Rounded {
    /// Returns true if it may be NaN, or has no value in real numbers.
    pub fn may_be_undefined(&self) -> bool {
        self.computed.may_be_nan() || self.real.may_be_undefined()
    }

    /// Returns the values of either, where the real one is the same.
    fn hull(self, other: Rounded) -> Rounded {
        let real = self.real.narrowed(other.real);
        let computed = self.computed.hull(other.computed);
        Rounded { real, computed, error: self.error.max(other.error) }
    }

    /// Returns all between the real value and the computed one.
    fn between(&self) -> Span {
        if self.computed.is_empty() { self.real } else { self.real.hull(span(self.computed)) }
    }

    /// Returns the largest distance of any real value from any computed one.
    fn apart(&self) -> f64 {
        if self.computed.is_empty() {
            return 0.0;
        }
        let computed = span(self.computed);
        let apart = self.real.minus(computed).most();
        if apart.is_nan() { f64::INFINITY } else { apart }
    }

    /// Uses each of the three to narrow the others.
    fn settled(mut self) -> Rounded {
        self.error = self.error.min(self.apart());
        if self.error.is_finite() && self.real.is_bounded() {
            let (low, high) = (self.real.low() - self.error, self.real.high() + self.error);
            self.computed = self.computed.narrowed(enclose(low.next_down(), high.next_up()));
        }
        self
    }
}

/// Returns the numbers of an interval.
pub(super) fn span(x: Interval) -> Span {
    Span::new(x.low().into(), x.high().into())
}

/// One operation over a box.
struct Step(Rounding);

impl Step {
    /// Applies an operation; `same` is true if its first two arguments are one.
    fn apply(&self, op: Op, arguments: [Rounded; MAX_ARITY], same: bool) -> Rounded {
        let [a, b, c, d] = arguments;
        match op {
            Op::Pow => self.power(a, b),
            Op::Mad if self.0 == Rounding::Gpu => {
                let product = self.single(Op::Mul, [a, b], same);
                self.single(Op::Add, [product, c], false)
            }
            Op::Mad => self.fused([a, b, c], same),
            Op::Tan if self.0 == Rounding::Gpu => {
                let [sin, cos] = [Op::Sin, Op::Cos].map(|op| self.single(op, [a; 2], false));
                self.single(Op::Div, [sin, cos], false)
            }
            Op::Lerp => self.lerp([a, b, c]),
            Op::Select => self.select([a, b], c, d),
            Op::Add
            | Op::Sub
            | Op::Mul
            | Op::Div
            | Op::Neg
            | Op::Abs
            | Op::Min
            | Op::Max
            | Op::Saturate
            | Op::Rcp
            | Op::Sqrt
            | Op::Rsqrt
            | Op::Exp2
            | Op::Log2
            | Op::Exp
            | Op::Log
            | Op::Sin
            | Op::Cos
            | Op::Tan
            | Op::Asin
            | Op::Acos
            | Op::Atan
            | Op::Atan2
            | Op::Tanh
            | Op::Step
            | Op::Floor
            | Op::Fract
            | Op::Sign => self.single(op, [a, b], same),
        }
    }

    /// Applies an operation of one or two arguments that is not composed of others.
    fn single(&self, op: Op, [a, b]: [Rounded; 2], same: bool) -> Rounded {
        let local = |a: Span, b: Span| {
            Local::of(op, a, b, same).expect("an operation of one or two arguments")
        };
        let real = local(a.real, b.real).value;
        let slopes = local(a.between(), b.between()).slopes;
        let computed = self.computed(op, [a.computed, b.computed, a.computed, b.computed], same);
        let two = op.arity() > 1;
        let passed = part(slopes[0], a.error) + if two { part(slopes[1], b.error) } else { 0.0 };
        let passed = if op == Op::Sqrt {
            // |√x − √y| ≤ √|x − y|
            passed.min(a.error.sqrt())
        } else if matches!(op, Op::Min | Op::Max) {
            passed.min(a.error.max(b.error))
        } else {
            passed
        };
        let nan = a.computed.may_be_nan() || two && b.computed.may_be_nan();
        let known = !nan && describes(self.0, op, a.computed, b.computed);
        let error = if known { passed + self.own(op, a.computed, computed) } else { f64::INFINITY };
        Rounded { real, computed, error: error * (1.0 + LOSS) }.settled()
    }

    /// Applies a product and a sum, rounded once.
    fn fused(&self, [a, b, c]: [Rounded; 3], same: bool) -> Rounded {
        let product = Local::of(Op::Mul, a.real, b.real, same).expect("of two arguments").value;
        let real = product.plus(c.real);
        let arguments = [a.computed, b.computed, c.computed, c.computed];
        let computed = self.computed(Op::Mad, arguments, same);
        let slopes = [b.between(), a.between()];
        let passed = part(slopes[0], a.error) + part(slopes[1], b.error) + c.error;
        let nan = arguments.iter().any(|argument| argument.may_be_nan());
        let own = self.own(Op::Mad, a.computed, computed);
        let error = if nan { f64::INFINITY } else { passed + own };
        Rounded { real, computed, error: error * (1.0 + LOSS) }.settled()
    }

    /// Applies `exp2(b · log2(a))`.
    fn power(&self, a: Rounded, b: Rounded) -> Rounded {
        let logarithm = self.single(Op::Log2, [a, a], false);
        let exponent = self.single(Op::Mul, [b, logarithm], false);
        let power = self.single(Op::Exp2, [exponent, exponent], false);
        // The real power is known better, and has a value at zero.
        let real = Local::of(Op::Pow, a.real, b.real, false).expect("of two arguments").value;
        Rounded { real, ..power }.settled()
    }

    fn lerp(&self, [a, b, t]: [Rounded; 3]) -> Rounded {
        let difference = self.single(Op::Sub, [b, a], false);
        let fused = self.apply(Op::Mad, [t, difference, a, a], false);
        if self.0 == Rounding::Exact {
            return fused;
        }
        let one = Rounded { real: Span::ONE, computed: Interval::new(1.0, 1.0), error: 0.0 };
        let rest = self.single(Op::Sub, [one, t], false);
        let [first, second] = [[a, rest], [b, t]].map(|both| self.single(Op::Mul, both, false));
        fused.hull(self.single(Op::Add, [first, second], false))
    }

    /// Returns `yes` where a < b, else `no`.
    fn select(&self, [a, b]: [Rounded; 2], yes: Rounded, no: Rounded) -> Rounded {
        let nan = a.computed.may_be_nan() || b.computed.may_be_nan();
        let undefined = a.real.may_be_undefined() || b.real.may_be_undefined();
        let [x, y] = [a.between(), b.between()];
        let chosen = if !nan && x.high() < y.low() {
            yes
        } else if !nan && x.low() >= y.high() {
            no
        } else {
            let [a, b] = [a, b].map(|argument| argument.computed);
            let computed = Bounds.apply(Op::Select, [a, b, yes.computed, no.computed]);
            // Either may take the other branch.
            let real = yes.real.hull(no.real);
            Rounded { real, computed, error: f64::INFINITY }.settled()
        };
        Rounded { real: chosen.real.or_undefined_if(undefined), ..chosen }
    }

    /// Bounds what an operation gives of computed arguments.
    fn computed(&self, op: Op, [a, b, c, d]: [Interval; 4], same: bool) -> Interval {
        // A square is the product of the absolute values.
        let square = same && matches!(op, Op::Mul | Op::Mad) && !a.is_empty();
        let (a, b) = if square { (a.abs(), a.abs()) } else { (a, b) };
        let bounds = self.0.bounds(op, [a, b, c, d]);
        // Rounding to a neighbour changes no sign, nor does flushing.
        let to_neighbour = matches!(op, Op::Add | Op::Sub | Op::Mul);
        if !to_neighbour || bounds.is_empty() {
            return bounds;
        }
        let exact = Bounds.apply(op, [a, b, c, d]);
        if exact.low() >= 0.0 {
            bounds.clamped(0.0, f32::INFINITY)
        } else if exact.high() <= 0.0 {
            bounds.clamped(f32::NEG_INFINITY, 0.0)
        } else {
            bounds
        }
    }

    /// Returns the error that the operation adds.
    fn own(&self, op: Op, a: Interval, computed: Interval) -> f64 {
        if computed.is_empty() {
            return 0.0;
        }
        let reach = computed.abs().high();
        let error = self.0.error(op, [a; MAX_ARITY]);
        if self.0 == Rounding::Exact && is_nearest(op) {
            return half_unit(reach);
        }
        let reach = f64::from(reach);
        // The value before rounding may reach a little farther.
        let error = error.of(reach + error.of(reach));
        match self.0 {
            Rounding::Exact => error,
            // Even a choice may flush its result.
            Rounding::Gpu => error + f64::from(f32::MIN_POSITIVE),
        }
    }
}

/// Returns the error that an argument's error makes.
fn part(slope: Span, error: f64) -> f64 {
    if error == 0.0 || slope == Span::ZERO { 0.0 } else { slope.most() * error }
}

/// Returns true if the interpreter rounds to the nearest number.
fn is_nearest(op: Op) -> bool {
    matches!(op.accuracy(), Accuracy::Within(tolerance) if tolerance.ulps <= 0.5)
}

/// Returns half the distance of neighbouring `f32`s up to a magnitude, which is one.
fn half_unit(reach: f32) -> f64 {
    (f64::from(reach) - f64::from(reach.next_down())) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_unit_is_that_of_the_binade() {
        assert_eq!(half_unit(1.5), (2f64).powi(-24));
        assert_eq!(half_unit(1.0), (2f64).powi(-25));
        assert_eq!(half_unit(0.999), (2f64).powi(-25));
        assert_eq!(half_unit(f32::INFINITY), f64::INFINITY);
        assert_eq!(half_unit(0.0), (2f64).powi(-150));
    }
}
