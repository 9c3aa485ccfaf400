//! Values as formulas over the inputs: a function is interpreted once, and written down.

use super::machine::{Extra, Machine, Reason};
use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Draft, Instr, Program, effective};
use std::collections::HashMap;

/// The most instructions that are written down. By hand: far above what a search could beat.
const MOST_INSTRUCTIONS: usize = 20_000;

/// The most numbers, which are indexed by 16 bits.
const MOST_CONSTANTS: usize = 60_000;

/// The machine that writes down what it is asked to compute. What is known is computed as a
/// compiler would, in `f32`.
#[derive(Debug)]
pub(super) struct Symbols {
    pub draft: Draft,
    constants: HashMap<u32, Arg>,
    results: HashMap<Instr, Arg>,
    conditions: Vec<Condition>,
}

/// A condition; others by their places.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Condition {
    Known(bool),
    Less(Arg, Arg),
    Not(usize),
    Both(usize, usize),
    Either(usize, usize),
}

impl Symbols {
    pub fn new(inputs: usize) -> Symbols {
        let draft = Draft { inputs, ..Draft::default() };
        let (constants, results) = (HashMap::new(), HashMap::new());
        Symbols { draft, constants, results, conditions: Vec::new() }
    }

    fn condition(&mut self, condition: Condition) -> usize {
        let known = self.conditions.iter().position(|other| *other == condition);
        known.unwrap_or_else(|| {
            self.conditions.push(condition);
            self.conditions.len() - 1
        })
    }

    fn number(&self, arg: Arg) -> Option<f32> {
        match arg {
            Arg::Const(index) => self.draft.consts.get(usize::from(index)).copied(),
            Arg::Input(_) | Arg::Result(_) => None,
        }
    }

    fn write(&mut self, op: Op, args: &[Arg]) -> Result<Arg, Reason> {
        let numbers: Option<Vec<f32>> = args.iter().map(|&arg| self.number(arg)).collect();
        if let Some(numbers) = numbers {
            let mut all = [0.0; MAX_ARITY];
            all[..numbers.len()].copy_from_slice(&numbers);
            return Ok(self.float(op.apply(all).into()));
        }
        if let Some(same) = self.unchanged(op, args) {
            return Ok(same);
        }
        let instr = Instr::new(op, args);
        if let Some(&known) = self.results.get(&instr) {
            return Ok(known);
        }
        if self.draft.instrs.len() >= MOST_INSTRUCTIONS {
            return Err(format!("it has more than {MOST_INSTRUCTIONS} operations when unrolled"));
        }
        let result = self.draft.push(op, args);
        self.results.insert(instr, result);
        Ok(result)
    }

    /// Returns the argument that an operation leaves as it is: what unrolling leaves of sums that
    /// begin with 0 and products with the components of an axis.
    fn unchanged(&mut self, op: Op, args: &[Arg]) -> Option<Arg> {
        let is = |place: usize, value: f32| self.number(args[place]) == Some(value);
        match op {
            Op::Add if is(0, 0.0) => Some(args[1]),
            Op::Add | Op::Sub if is(1, 0.0) => Some(args[0]),
            Op::Mul if is(0, 1.0) => Some(args[1]),
            Op::Mul | Op::Div if is(1, 1.0) => Some(args[0]),
            // As compilers that are not strict about infinities do.
            Op::Mul if is(0, 0.0) || is(1, 0.0) => Some(self.float(0.0)),
            Op::Mad if is(0, 0.0) || is(1, 0.0) => Some(args[2]),
            Op::Mad if is(0, 1.0) => self.write(Op::Add, &args[1..3]).ok(),
            Op::Mad if is(1, 1.0) => self.write(Op::Add, &[args[0], args[2]]).ok(),
            Op::Mad if is(2, 0.0) => self.write(Op::Mul, &args[..2]).ok(),
            _ => None,
        }
    }
}

impl Machine for Symbols {
    type Float = Arg;
    type Bool = usize;

    const SYMBOLIC: bool = true;

    fn float(&mut self, value: f64) -> Arg {
        let value = value as f32;
        if let Some(&known) = self.constants.get(&value.to_bits()) {
            return known;
        }
        // Beyond them none is needed: the program is refused.
        let constant = match self.draft.consts.len() > MOST_CONSTANTS {
            true => Arg::Const(0),
            false => self.draft.constant(value),
        };
        self.constants.insert(value.to_bits(), constant);
        constant
    }

    fn boolean(&mut self, value: bool) -> usize {
        self.condition(Condition::Known(value))
    }

    fn known(&self, value: Arg) -> Option<f64> {
        self.number(value).map(f64::from)
    }

    fn decided(&self, condition: usize) -> Option<bool> {
        match self.conditions[condition] {
            Condition::Known(value) => Some(value),
            _ => None,
        }
    }

    fn apply(&mut self, op: Op, args: [Arg; MAX_ARITY]) -> Result<Arg, Reason> {
        self.write(op, &args[..op.arity()])
    }

    fn extra(&mut self, function: Extra, a: Arg, b: Arg) -> Result<Arg, Reason> {
        let (one, half) = (self.float(1.0), self.float(0.5));
        match function {
            Extra::Sinh | Extra::Cosh => {
                let op = if function == Extra::Sinh { Op::Sub } else { Op::Add };
                let against = self.write(Op::Neg, &[a])?;
                let (up, down) = (self.write(Op::Exp, &[a])?, self.write(Op::Exp, &[against])?);
                let sum = self.write(op, &[up, down])?;
                self.write(Op::Mul, &[sum, half])
            }
            Extra::Asinh | Extra::Acosh => {
                let one = if function == Extra::Asinh { one } else { self.float(-1.0) };
                let square = self.write(Op::Mad, &[a, a, one])?;
                let root = self.write(Op::Sqrt, &[square])?;
                let sum = self.write(Op::Add, &[a, root])?;
                self.write(Op::Log, &[sum])
            }
            Extra::Atanh => {
                let (over, under) =
                    (self.write(Op::Add, &[one, a])?, self.write(Op::Sub, &[one, a])?);
                let quotient = self.write(Op::Div, &[over, under])?;
                let logarithm = self.write(Op::Log, &[quotient])?;
                self.write(Op::Mul, &[logarithm, half])
            }
            Extra::Round => {
                let shifted = self.write(Op::Add, &[a, half])?;
                self.write(Op::Floor, &[shifted])
            }
            Extra::Remainder => {
                let quotient = self.write(Op::Div, &[a, b])?;
                let size = self.write(Op::Abs, &[quotient])?;
                let whole = self.write(Op::Floor, &[size])?;
                let (sign, against) =
                    (self.write(Op::Sign, &[quotient])?, self.write(Op::Neg, &[b])?);
                let whole = self.write(Op::Mul, &[whole, sign])?;
                self.write(Op::Mad, &[whole, against, a])
            }
        }
    }

    fn less(&mut self, a: Arg, b: Arg) -> usize {
        match (self.number(a), self.number(b)) {
            (Some(a), Some(b)) => self.boolean(a < b),
            _ => self.condition(Condition::Less(a, b)),
        }
    }

    fn equal(&mut self, a: Arg, b: Arg) -> usize {
        if let (Some(a), Some(b)) = (self.number(a), self.number(b)) {
            return self.boolean(a == b);
        }
        let (less, more) = (self.less(a, b), self.less(b, a));
        let differ = self.or(less, more);
        self.not(differ)
    }

    fn not(&mut self, a: usize) -> usize {
        match self.conditions[a] {
            Condition::Known(value) => self.boolean(!value),
            Condition::Not(inner) => inner,
            _ => self.condition(Condition::Not(a)),
        }
    }

    fn and(&mut self, a: usize, b: usize) -> usize {
        match (self.decided(a), self.decided(b)) {
            (Some(false), _) | (_, Some(true)) => a,
            (_, Some(false)) | (Some(true), _) => b,
            _ => self.condition(Condition::Both(a, b)),
        }
    }

    fn or(&mut self, a: usize, b: usize) -> usize {
        // `a <= b` is written as a comparison and an equality: the one that is not its opposite.
        if let (Condition::Less(x, y), Condition::Not(differ)) =
            (self.conditions[a], self.conditions[b])
            && let Condition::Either(_, more) = self.conditions[differ]
            && self.conditions[more] == Condition::Less(y, x)
        {
            return self.not(more);
        }
        match (self.decided(a), self.decided(b)) {
            (Some(true), _) | (_, Some(false)) => a,
            (_, Some(true)) | (Some(false), _) => b,
            _ => self.condition(Condition::Either(a, b)),
        }
    }

    fn choose(&mut self, condition: usize, yes: Arg, no: Arg) -> Result<Arg, Reason> {
        if yes == no {
            return Ok(yes);
        }
        match self.conditions[condition] {
            Condition::Known(value) => Ok(if value { yes } else { no }),
            Condition::Less(a, b) => self.write(Op::Select, &[a, b, yes, no]),
            Condition::Not(inner) => self.choose(inner, no, yes),
            Condition::Both(a, b) => {
                let inner = self.choose(b, yes, no)?;
                self.choose(a, inner, no)
            }
            Condition::Either(a, b) => {
                let inner = self.choose(b, yes, no)?;
                self.choose(a, yes, inner)
            }
        }
    }
}

impl Symbols {
    /// Returns an input.
    pub fn input(&self, index: usize) -> Arg {
        Arg::Input(index as u16)
    }

    /// Returns the program with these outputs.
    pub fn program(self, outputs: Vec<Arg>) -> Result<Program, Reason> {
        if self.draft.consts.len() > MOST_CONSTANTS {
            return Err(format!("it has more than {MOST_CONSTANTS} numbers"));
        }
        let draft = Draft { outputs, ..self.draft };
        let program = Program::verify(draft).map_err(|invalid| invalid.to_string())?;
        Ok(effective(&program))
    }
}
