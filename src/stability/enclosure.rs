//! Encloses programs on boxes: bounds every value that each instruction can give there.

use super::chord;
use super::form::{AffineForm, Terms};
use super::rounding::{HUGE, Rounding, flushed};
use crate::eval::{Arithmetic, Bounds};
use crate::num::Interval;
use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Program};

/// The bounds of a value, and how it varies over the box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Enclosed {
    pub bounds: Interval,
    /// Describes the value wherever that is a number; none if it may be infinite.
    form: Option<AffineForm>,
}

/// Evaluates programs on boxes by interval arithmetic, rounded outward and narrowed by affine
/// forms, whose overestimate falls with the square of the box's width.
#[derive(Clone, Debug)]
pub struct Enclosure {
    rounding: Rounding,
    inputs: Vec<Enclosed>,
    results: Vec<Enclosed>,
    terms: Terms,
}

impl Enclosure {
    /// Makes an enclosure for a rounding, with nothing evaluated yet.
    pub fn new(rounding: Rounding) -> Enclosure {
        Enclosure { rounding, inputs: Vec::new(), results: Vec::new(), terms: Terms::default() }
    }

    /// Encloses every instruction of a program, each input being any number of its interval.
    ///
    /// # Panics
    /// If `domain` does not have one interval for each input.
    pub fn evaluate(&mut self, program: &Program, domain: &[Interval]) {
        assert_eq!(domain.len(), program.inputs, "one interval for each input");
        self.inputs.clear();
        self.results.clear();
        self.terms.clear();
        for &bounds in domain {
            let bounds = self.stored(bounds);
            let form = AffineForm::input(bounds, &mut self.terms);
            self.inputs.push(Enclosed { bounds, form });
        }
        for instr in &program.instrs {
            let args = instr.args();
            let values = [0, 1, 2, 3].map(|k| self.value(program, args[k.min(args.len() - 1)]));
            let square = args.len() > 1 && args[0] == args[1];
            let mut step = Step { rounding: self.rounding, terms: &mut self.terms };
            let mut result = step.apply(instr.op(), values, square);
            result.form = result.form.map(|form| form.of_instruction(&mut self.terms));
            self.results.push(result);
        }
    }

    /// Returns the bounds of an argument or output on the box last evaluated.
    pub fn bounds(&self, program: &Program, arg: Arg) -> Interval {
        self.value(program, arg).bounds
    }

    /// Returns how far an argument or output varies with an input across the box; 0 if unknown.
    pub(super) fn slope(&self, program: &Program, arg: Arg, input: usize) -> f64 {
        let [form, input] = [self.value(program, arg), self.inputs[input]].map(|value| value.form);
        form.zip(input).map_or(0.0, |(form, input)| form.slope(&input, &self.terms))
    }

    fn value(&self, program: &Program, arg: Arg) -> Enclosed {
        match arg {
            Arg::Input(i) => self.inputs[usize::from(i)],
            Arg::Result(i) => self.results[usize::from(i)],
            Arg::Const(i) => {
                let bounds = self.stored(Bounds.constant(program.consts[usize::from(i)]));
                Enclosed { bounds, form: AffineForm::around(bounds) }
            }
        }
    }

    fn stored(&self, bounds: Interval) -> Interval {
        if self.rounding == Rounding::Gpu { flushed(bounds) } else { bounds }
    }
}

impl Enclosed {
    /// Makes the value that both the bounds and the form allow.
    fn new(rounding: Rounding, bounds: Interval, form: Option<AffineForm>) -> Enclosed {
        let form = form.filter(AffineForm::is_finite);
        let bounds = form.map_or(bounds, |form| bounds.narrowed(form.bounds()));
        // Where the bounds are much narrower than the form, its terms are worth little.
        let plain = AffineForm::around(bounds);
        let form = match (form, plain) {
            (Some(form), Some(plain)) if plain.radius() > form.radius() / 2.0 => Some(form),
            (Some(form), Some(plain)) => Some(plain.in_place_of(&form)),
            // Two readers may see different sides of a jump.
            (None, Some(plain)) if rounding == Rounding::Gpu => Some(plain.unshared()),
            (_, plain) => plain,
        };
        Enclosed { bounds, form }
    }
}

/// One operation on a box.
struct Step<'a> {
    rounding: Rounding,
    terms: &'a mut Terms,
}

impl Step<'_> {
    /// Applies an operation; `square` is true if its first two arguments are the same.
    fn apply(&mut self, op: Op, arguments: [Enclosed; MAX_ARITY], square: bool) -> Enclosed {
        let [a, b, c, d] = arguments;
        match op {
            Op::Pow => {
                let exponent = self.of(Op::Log2, &[a]);
                let exponent = self.of(Op::Mul, &[b, exponent]);
                self.of(Op::Exp2, &[exponent])
            }
            Op::Mad if self.rounding == Rounding::Gpu => {
                let product = self.apply(Op::Mul, arguments, square);
                self.of(Op::Add, &[product, c])
            }
            Op::Tan if self.rounding == Rounding::Gpu => {
                let [sin, cos] = [Op::Sin, Op::Cos].map(|op| self.of(op, &[a]));
                self.of(Op::Div, &[sin, cos])
            }
            Op::Lerp => self.lerp([a, b, c]),
            Op::Select => self.select([a, b], c, d),
            Op::Add
            | Op::Sub
            | Op::Mul
            | Op::Div
            | Op::Mad
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
            | Op::Sign => self.single(op, arguments, square),
        }
    }

    /// Applies an operation that is not composed of others.
    fn single(&mut self, op: Op, arguments: [Enclosed; MAX_ARITY], square: bool) -> Enclosed {
        let [a, b, ..] = arguments;
        let bounds = bounds(self.rounding, op, &arguments, square);
        let form = self.form(op, &arguments, square).map(|form| {
            let reach = f64::from(bounds.narrowed(form.bounds()).abs().high());
            let error = self.rounding.error(op, arguments.map(|argument| argument.bounds));
            // The value before rounding may reach a little farther.
            form.widened(error.of(reach + error.of(reach)))
        });
        let form = form.filter(|_| describes(self.rounding, op, a.bounds, b.bounds));
        Enclosed::new(self.rounding, bounds, form)
    }

    fn of(&mut self, op: Op, arguments: &[Enclosed]) -> Enclosed {
        let mut all = [arguments[0]; MAX_ARITY];
        all[..arguments.len()].copy_from_slice(arguments);
        self.apply(op, all, false)
    }

    fn lerp(&mut self, [a, b, t]: [Enclosed; 3]) -> Enclosed {
        let difference = self.of(Op::Sub, &[b, a]);
        let fused = self.of(Op::Mad, &[t, difference, a]);
        if self.rounding == Rounding::Exact {
            return fused;
        }
        let one = Interval::new(1.0, 1.0);
        let one = Enclosed { bounds: one, form: AffineForm::around(one) };
        let rest = self.of(Op::Sub, &[one, t]);
        let (first, second) = (self.of(Op::Mul, &[a, rest]), self.of(Op::Mul, &[b, t]));
        let sum = self.of(Op::Add, &[first, second]);
        self.hull(&fused, &sum)
    }

    /// Returns the operation's result before rounding, as an affine form.
    fn form(
        &mut self,
        op: Op,
        arguments: &[Enclosed; MAX_ARITY],
        square: bool,
    ) -> Option<AffineForm> {
        let x = arguments[0].bounds;
        let [a, b, c, _] = arguments.each_ref().map(|argument| argument.form.as_ref());
        let terms = &mut *self.terms;
        let product = |terms: &mut Terms| match square {
            true => Some(chord::square(a?, x, terms)),
            false => Some(a?.times(b?, terms)),
        };
        match op {
            Op::Add => Some(a?.plus(b?, terms)),
            Op::Sub => Some(a?.minus(b?, terms)),
            Op::Neg => Some(a?.negated(terms)),
            Op::Mul => product(terms),
            Op::Mad => Some(product(terms)?.plus(c?, terms)),
            Op::Div => {
                let reciprocal = chord::image(Op::Rcp, b?, arguments[1].bounds, terms)?;
                Some(a?.times(&reciprocal, terms))
            }
            Op::Rsqrt => {
                let root = chord::image(Op::Sqrt, a?, x, terms)?;
                let bounds = Bounds.apply(Op::Sqrt, [x; MAX_ARITY]).widened(1);
                chord::image(Op::Rcp, &root, bounds, terms)
            }
            Op::Abs => Some(chord::absolute(a?, x, terms)),
            Op::Max => Some(chord::maximum(a?, b?, terms)),
            Op::Min => Some(chord::minimum(a?, b?, terms)),
            Op::Saturate => {
                let [zero, one] = [0.0, 1.0].map(|x| AffineForm::around(Interval::new(x, x)));
                let positive = chord::maximum(a?, zero.as_ref()?, terms);
                Some(chord::minimum(&positive, one.as_ref()?, terms))
            }
            Op::Floor => Some(a?.mapped(0.0, [whole(x)?; 2], 0.0, terms)),
            Op::Fract => Some(a?.mapped(1.0, [-whole(x)?; 2], whole(x)?.abs(), terms)),
            Op::Rcp
            | Op::Sqrt
            | Op::Exp2
            | Op::Exp
            | Op::Log2
            | Op::Log
            | Op::Sin
            | Op::Cos
            | Op::Tan
            | Op::Asin
            | Op::Acos
            | Op::Atan
            | Op::Tanh => chord::image(op, a?, x, terms),
            // Composed of others, or with jumps.
            Op::Pow | Op::Lerp | Op::Atan2 | Op::Step | Op::Select | Op::Sign => None,
        }
    }

    /// Returns `yes` where a < b, else `no`.
    fn select(&mut self, [a, b]: [Enclosed; 2], yes: Enclosed, no: Enclosed) -> Enclosed {
        let nan = a.bounds.may_be_nan() || b.bounds.may_be_nan();
        let difference = match (&a.form, &b.form) {
            (Some(a), Some(b)) => a.minus(b, self.terms).bounds(),
            _ => Interval::LINE,
        };
        let numbers = !a.bounds.is_empty() && !b.bounds.is_empty();
        let may_hold = numbers && a.bounds.low() < b.bounds.high() && difference.low() < 0.0;
        let may_fail = nan || a.bounds.high() >= b.bounds.low() && difference.high() >= 0.0;
        match (may_hold, may_fail) {
            (true, false) => yes,
            (false, _) => no,
            (true, true) => self.hull(&yes, &no),
        }
    }

    fn hull(&mut self, a: &Enclosed, b: &Enclosed) -> Enclosed {
        let form = match (&a.form, &b.form) {
            // Two readers may see different sides of a jump.
            (Some(first), Some(second)) => Some(first.hull(second, self.terms).unshared()),
            _ => None,
        };
        Enclosed::new(self.rounding, a.bounds.hull(b.bounds), form)
    }
}

/// Returns the floor of all numbers of an interval; none if they differ in it.
fn whole(x: Interval) -> Option<f64> {
    (x.low().floor() == x.high().floor()).then(|| f64::from(x.low().floor()))
}

/// Returns true if the exact operation and its stated error cover every possible result.
pub(super) fn describes(rounding: Rounding, op: Op, a: Interval, b: Interval) -> bool {
    let reach = a.abs().high();
    let gpu = rounding == Rounding::Gpu;
    match op {
        // On GPUs a tangent is a quotient, whose operations are asked one by one.
        Op::Sin | Op::Cos | Op::Tan => rounding.promises(op, a),
        Op::Min | Op::Max => !gpu || !a.may_be_nan() && !b.may_be_nan(),
        Op::Saturate => !gpu || !a.may_be_nan(),
        Op::Rcp => !gpu || reach < HUGE,
        Op::Div => !gpu || b.abs().high() < HUGE,
        Op::Add | Op::Sub | Op::Mul | Op::Mad | Op::Neg | Op::Abs => true,
        Op::Sqrt | Op::Rsqrt | Op::Exp2 | Op::Log2 | Op::Exp | Op::Log | Op::Pow => true,
        Op::Asin | Op::Acos | Op::Atan | Op::Atan2 | Op::Tanh | Op::Lerp => true,
        Op::Step | Op::Select | Op::Floor | Op::Fract | Op::Sign => true,
    }
}

fn bounds(rounding: Rounding, op: Op, arguments: &[Enclosed; MAX_ARITY], square: bool) -> Interval {
    let [a, b, c, d] = arguments.map(|argument| argument.bounds);
    // A square is the product of the absolute values.
    let product = matches!(op, Op::Mul | Op::Mad);
    let (a, b) = if product && square && !a.is_empty() { (a.abs(), a.abs()) } else { (a, b) };
    rounding.bounds(op, [a, b, c, d])
}
