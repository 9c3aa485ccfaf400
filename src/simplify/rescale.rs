//! Rewrites programs for columns in other units.
//!
//! A power of two that multiplies an input or output moves through the program into existing
//! constants, exactly; a multiplication is added only where there is none.

use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Draft, use_counts};

/// The scale of an input: the given program's input is `(column + offset) · 2^−exponent`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InputScale {
    /// In the column's unit.
    pub offset: f32,
    /// The unit's exponent.
    pub exponent: i32,
}

/// The place where inputs are brought to the given program's unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placement {
    /// Once, before anything else: best where an input is multiplied with itself and others.
    First,
    /// In the constants that it meets: best where it meets few, each being multiplied by one.
    Constants,
}

/// The most inputs in other units that may be multiplied with each other before one is brought to
/// the given program's unit. The units decide nothing else, so costs do not depend on them. By
/// hand, unmeasured.
const MAX_DEGREE: u32 = 2;
/// Inputs of a larger exponent count twice: the square of a small value would be no normal `f32`.
const LARGE_EXPONENT: i32 = 31;

/// The largest exponent of a factor: its power and inverse are normal `f32`s.
const MAX_EXPONENT: i32 = 126;

/// Rewrites the program to read the columns that `inputs` describes; its outputs are the given
/// program's times two to the power of `outputs`. If no offset is given and nothing leaves `f32`,
/// each instruction's value is the given program's to the bit, except for a power of two. Which
/// instructions are added depends only on the program's structure, and on which exponents are zero
/// or large.
///
/// # Panics
/// If there are fewer scales than inputs or outputs.
pub fn rescaled(
    draft: &Draft,
    inputs: &[InputScale],
    outputs: &[i32],
    placement: Placement,
) -> Draft {
    let mut uses = Vec::new();
    use_counts(draft, &mut uses);
    let new = Draft { instrs: Vec::new(), outputs: Vec::new(), ..draft.clone() };
    let mut work = Work {
        new,
        inputs,
        placement,
        offsets: Vec::new(),
        multiples: Vec::new(),
        read_once: Vec::new(),
    };
    let mut moved: Vec<Scaled> = Vec::with_capacity(draft.instrs.len());
    for (instr, &uses) in draft.instrs.iter().zip(&uses) {
        let mut args = [Scaled::default(); MAX_ARITY];
        for (to, &arg) in args.iter_mut().zip(instr.args()) {
            *to = work.value(arg, &moved);
        }
        moved.push(work.instruction(instr.op(), &mut args[..instr.args().len()], uses == 1));
    }
    for (&output, &exponent) in draft.outputs.iter().zip(outputs) {
        let value = work.value(output, &moved);
        let output = work.brought(value, exponent);
        work.new.outputs.push(output);
    }
    work.new
}

/// A value of the new program: the given program's times two to the power of `exponent`.
#[derive(Clone, Copy, Debug)]
struct Scaled {
    arg: Arg,
    exponent: i32,
    /// The number of inputs in other units that it is a product of: constants that take them in are
    /// as large.
    degree: u32,
}

impl Default for Scaled {
    fn default() -> Scaled {
        Scaled { arg: Arg::Input(0), exponent: 0, degree: 0 }
    }
}

/// The effect of an operation on powers of two that its arguments are multiplied by.
enum Scaling {
    /// The first two arguments are multiplied; the third, if any, is added.
    Product,
    Quotient,
    Reciprocal,
    /// The result is multiplied as the arguments at these places, which must be alike; others must
    /// not be multiplied.
    Linear(&'static [usize]),
    /// The result does not change if the arguments at these places are multiplied alike.
    Invariant(&'static [usize]),
    /// The exponent is halved, with this sign.
    Root(i32),
    /// Linear in the last two, if the first two are alike.
    Choice,
    /// No argument may be multiplied.
    None,
}

fn scaling(op: Op) -> Scaling {
    match op {
        Op::Mul | Op::Mad => Scaling::Product,
        Op::Div => Scaling::Quotient,
        Op::Rcp => Scaling::Reciprocal,
        Op::Neg | Op::Abs => Scaling::Linear(&[0]),
        Op::Add | Op::Sub | Op::Min | Op::Max | Op::Lerp => Scaling::Linear(&[0, 1]),
        Op::Sign => Scaling::Invariant(&[0]),
        Op::Step | Op::Atan2 => Scaling::Invariant(&[0, 1]),
        Op::Sqrt => Scaling::Root(1),
        Op::Rsqrt => Scaling::Root(-1),
        Op::Select => Scaling::Choice,
        Op::Saturate
        | Op::Exp2
        | Op::Log2
        | Op::Exp
        | Op::Log
        | Op::Pow
        | Op::Sin
        | Op::Cos
        | Op::Tan
        | Op::Asin
        | Op::Acos
        | Op::Atan
        | Op::Tanh
        | Op::Floor
        | Op::Fract => Scaling::None,
    }
}

struct Work<'a> {
    new: Draft,
    inputs: &'a [InputScale],
    placement: Placement,
    /// Inputs with their offsets added.
    offsets: Vec<(u16, Arg)>,
    /// Values that were multiplied by a power of two.
    multiples: Vec<(Arg, i32, Arg)>,
    /// For each new instruction, true if its result is read once in the end, so that it may still
    /// change.
    read_once: Vec<bool>,
}

impl Work<'_> {
    fn value(&mut self, arg: Arg, moved: &[Scaled]) -> Scaled {
        match arg {
            Arg::Const(_) => Scaled { arg, exponent: 0, degree: 0 },
            Arg::Result(i) => moved[usize::from(i)],
            Arg::Input(i) => {
                let InputScale { offset, exponent } = self.inputs[usize::from(i)];
                let arg = if offset == 0.0 { arg } else { self.with_offset(i, offset) };
                match self.placement {
                    Placement::Constants => Scaled { arg, exponent, degree: degree(exponent) },
                    Placement::First => {
                        Scaled { arg: self.multiplied(arg, -exponent), exponent: 0, degree: 0 }
                    }
                }
            }
        }
    }

    fn with_offset(&mut self, input: u16, offset: f32) -> Arg {
        if let Some((_, known)) = self.offsets.iter().find(|(known, _)| *known == input) {
            return *known;
        }
        let offset = self.new.constant(offset);
        let sum = self.push(Op::Add, &[Arg::Input(input), offset], false);
        self.offsets.push((input, sum));
        sum
    }

    fn push(&mut self, op: Op, args: &[Arg], read_once: bool) -> Arg {
        self.read_once.push(read_once);
        self.new.push(op, args)
    }

    fn instruction(&mut self, op: Op, values: &mut [Scaled], read_once: bool) -> Scaled {
        let exponent = match scaling(op) {
            Scaling::Product => self.product(values),
            Scaling::Quotient => {
                self.bound_degree(values);
                values[0].exponent - values[1].exponent
            }
            Scaling::Reciprocal => -values[0].exponent,
            Scaling::Linear(places) => {
                self.bring_others(values, places);
                self.bring_alike(values, places)
            }
            Scaling::Invariant(places) => {
                self.bring_alike(values, places);
                0
            }
            Scaling::Root(sign) => {
                if values[0].exponent % 2 != 0 {
                    let even = values[0].exponent - 1;
                    self.bring(&mut values[0], even);
                }
                sign * values[0].exponent / 2
            }
            Scaling::Choice => {
                self.bring_alike(values, &[0, 1]);
                self.bring_alike(values, &[2, 3])
            }
            Scaling::None => {
                self.bring_others(values, &[]);
                0
            }
        };
        let degrees = values.iter().map(|value| value.degree);
        let degree = match scaling(op) {
            Scaling::Product => values[0].degree + values[1].degree,
            Scaling::Quotient => degrees.sum(),
            Scaling::Invariant(_) | Scaling::None => 0,
            _ => degrees.max().unwrap_or(0),
        };
        let mut args = [Arg::Input(0); MAX_ARITY];
        args.iter_mut().zip(values.iter()).for_each(|(to, value)| *to = value.arg);
        Scaled { arg: self.push(op, &args[..values.len()], read_once), exponent, degree }
    }

    /// Returns the exponent of a product, or of one with a summand, which is brought to it.
    fn product(&mut self, values: &mut [Scaled]) -> i32 {
        let (factors, summand) = values.split_at_mut(2);
        self.bound_degree(factors);
        let exponent = factors[0].exponent + factors[1].exponent;
        let Some(summand) = summand.first_mut() else { return exponent };
        let change = summand.exponent - exponent;
        let into_factor = change != 0
            && !self.can_change(summand.arg)
            && factors.iter().any(|factor| self.can_change(factor.arg));
        if into_factor {
            let place = factors.iter().position(|factor| self.can_change(factor.arg));
            let factor = &mut factors[place.unwrap_or(0)];
            factor.arg = self.changed(factor.arg, change);
            return summand.exponent;
        }
        self.bring(summand, exponent);
        exponent
    }

    /// Brings factors whose degree together is too high to their unit: first those that no constant
    /// can take in.
    fn bound_degree(&mut self, factors: &mut [Scaled]) {
        for can_change in [false, true] {
            for i in 0..factors.len() {
                let degree: u32 = factors.iter().map(|factor| factor.degree).sum();
                let factor = factors[i];
                let chosen = self.can_change(factor.arg) == can_change && factor.degree > 0;
                if degree > MAX_DEGREE && chosen {
                    let arg = self.multiplied(factor.arg, -factor.exponent);
                    factors[i] = Scaled { arg, exponent: 0, degree: 0 };
                }
            }
        }
    }

    /// Brings the values at other than the given places to exponent zero.
    fn bring_others(&mut self, values: &mut [Scaled], places: &[usize]) {
        for (place, value) in values.iter_mut().enumerate() {
            if !places.contains(&place) {
                self.bring(value, 0);
            }
        }
    }

    /// Brings the values at the given places to one exponent: that of a value which cannot be
    /// changed for free.
    fn bring_alike(&mut self, values: &mut [Scaled], places: &[usize]) -> i32 {
        let fixed = places.iter().map(|&place| values[place]).find(|v| !self.can_change(v.arg));
        let exponent = fixed.unwrap_or(values[places[0]]).exponent;
        places.iter().for_each(|&place| self.bring(&mut values[place], exponent));
        exponent
    }

    fn bring(&mut self, value: &mut Scaled, exponent: i32) {
        *value = Scaled { arg: self.brought(*value, exponent), exponent, ..*value };
    }

    /// Multiplies the value so that its exponent becomes this.
    fn brought(&mut self, value: Scaled, exponent: i32) -> Arg {
        let change = exponent - value.exponent;
        if change == 0 {
            return value.arg;
        }
        if self.can_change(value.arg) {
            return self.changed(value.arg, change);
        }
        self.multiplied(value.arg, change)
    }

    fn multiplied(&mut self, arg: Arg, change: i32) -> Arg {
        if change == 0 {
            return arg;
        }
        let known = |(known, by, _): &&(Arg, i32, Arg)| (*known, *by) == (arg, change);
        if let Some((_, _, multiple)) = self.multiples.iter().find(known) {
            return *multiple;
        }
        let mut multiple = arg;
        let mut left = change;
        while left != 0 {
            let step = left.clamp(-MAX_EXPONENT, MAX_EXPONENT);
            let factor = self.new.constant(f64::from(step).exp2() as f32);
            multiple = self.push(Op::Mul, &[multiple, factor], false);
            left -= step;
        }
        self.multiples.push((arg, change, multiple));
        multiple
    }

    fn constant(&self, arg: Arg) -> Option<f32> {
        match arg {
            Arg::Const(i) => Some(self.new.consts[usize::from(i)]),
            _ => None,
        }
    }

    /// Returns true if changing constants alone can multiply a value by any power of two.
    fn can_change(&self, arg: Arg) -> bool {
        let i = match arg {
            Arg::Const(_) => return true,
            Arg::Input(_) => return false,
            Arg::Result(i) => i,
        };
        let i = usize::from(i);
        if !self.read_once[i] {
            return false;
        }
        let args = self.new.instrs[i].args();
        match scaling(self.new.instrs[i].op()) {
            Scaling::Product => {
                let factor = args[..2].iter().any(|&arg| self.can_change(arg));
                factor && args[2..].iter().all(|&arg| self.can_change(arg))
            }
            Scaling::Quotient => self.can_change(args[0]) || self.can_change(args[1]),
            Scaling::Reciprocal | Scaling::Root(_) => self.can_change(args[0]),
            Scaling::Linear(places) => places.iter().all(|&p| self.can_change(args[p])),
            Scaling::Choice => args[2..].iter().all(|&arg| self.can_change(arg)),
            Scaling::Invariant(_) | Scaling::None => false,
        }
    }

    /// Multiplies a value for which [`Work::can_change`] is true by changing constants.
    fn changed(&mut self, arg: Arg, by: i32) -> Arg {
        if let Some(value) = self.constant(arg) {
            return self.new.constant((f64::from(value) * f64::from(by).exp2()) as f32);
        }
        let Arg::Result(result) = arg else { return arg };
        let i = usize::from(result);
        let args = self.new.instrs[i].args().to_vec();
        let changes: Vec<(usize, i32)> = match scaling(self.new.instrs[i].op()) {
            Scaling::Product => {
                let factor = usize::from(!self.can_change(args[0]));
                [(factor, by)].into_iter().chain((2..args.len()).map(|p| (p, by))).collect()
            }
            Scaling::Quotient if self.can_change(args[0]) => vec![(0, by)],
            Scaling::Quotient => vec![(1, -by)],
            Scaling::Reciprocal => vec![(0, -by)],
            Scaling::Linear(places) => places.iter().map(|&place| (place, by)).collect(),
            Scaling::Root(sign) => vec![(0, 2 * sign * by)],
            Scaling::Choice => vec![(2, by), (3, by)],
            Scaling::Invariant(_) | Scaling::None => Vec::new(),
        };
        for (place, by) in changes {
            let changed = self.changed(args[place], by);
            self.new.instrs[i].args_mut()[place] = changed;
        }
        arg
    }
}

fn degree(exponent: i32) -> u32 {
    match exponent.abs() {
        0 => 0,
        1..=LARGE_EXPONENT => 1,
        _ => 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{Names, Program, parse, print};

    /// `y` over `x` where both are counted in other units, as text.
    fn over(text: &str, exponent: i32, output: i32) -> String {
        let names = Names::new(["x", "z"], ["y"]);
        let draft = parse(text, &names).unwrap().into_draft();
        let scales = [InputScale { offset: 0.0, exponent }, InputScale::default()];
        let program =
            Program::verify(rescaled(&draft, &scales, &[output], Placement::Constants)).unwrap();
        print(&crate::simplify::tidy(&program), &names)
    }

    #[test]
    fn powers_of_two_go_into_constants() {
        assert_eq!(over("y = 3*x + 0.5", 2, 0), "y = 0.75*x + 0.5");
        assert_eq!(over("y = exp2(3*x)", 2, 0), "y = exp2(0.75*x)");
        assert_eq!(over("y = 3*x + 0.5", 0, 4), "y = 48*x + 8");
        assert_eq!(over("y = exp2(x)*3", 0, -1), "y = 1.5*exp2(x)");
        assert_eq!(over("y = exp2(x)", 0, 3), "y = 8*exp2(x)");
    }

    #[test]
    fn inputs_may_be_multiplied_before_anything_else() {
        let names = Names::new(["x"], ["y"]);
        let draft = parse("y = x*x + exp2(x)", &names).unwrap().into_draft();
        let scales = [InputScale { offset: 0.0, exponent: 5 }];
        let program = Program::verify(rescaled(&draft, &scales, &[0], Placement::First)).unwrap();
        assert_eq!(print(&program, &names), "t0 = 0.03125*x; y = t0^2 + exp2(t0)");
    }

    #[test]
    fn offsets_are_added_once() {
        let names = Names::new(["x"], ["y"]);
        let draft = parse("y = exp2(x) + x*x", &names).unwrap().into_draft();
        let scales = [InputScale { offset: -600.0, exponent: 0 }];
        let program =
            Program::verify(rescaled(&draft, &scales, &[0], Placement::Constants)).unwrap();
        let additions = program.instrs.iter().filter(|instr| instr.op() == Op::Add).count();
        assert_eq!(additions, 2, "{}", print(&program, &names));
    }
}
