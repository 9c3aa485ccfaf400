//! Derivatives by constants, in forward mode, as further instructions of the same program.

use crate::eval::Jacobian;
use crate::op::Op;
use crate::program::{Arg, Draft, Program};

/// A program extended by the derivatives of its outputs by each of its constants.
#[derive(Clone, Debug)]
pub struct Differentiated {
    /// The extended program: its outputs are the original's, then the derivatives that are not
    /// zero; its first constants are the original's.
    pub program: Program,
    /// The places of the derivatives among the program's outputs.
    pub jacobian: Jacobian,
    scratch: Draft,
    /// The derivative of each instruction by the current constant.
    tangents: Vec<Tangent>,
    /// The derivatives of each instruction by its arguments, once a constant needs them.
    partials: Vec<Option<[Tangent; 4]>>,
}

/// A derivative; most are zero or one and need no instructions.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Tangent {
    Zero,
    One,
    MinusOne,
    Is(Arg),
}
use Tangent::{Is, MinusOne, One, Zero};

/// What stands for the infinite slope of a root at zero, or of an arc at its end: times a derivative
/// that is zero, as beyond a clamp, it is zero; times any other, its square is beyond `f32`, so that
/// the constant counts as one without a derivative.
const STEEPEST: f32 = 1e37;

impl Default for Differentiated {
    fn default() -> Differentiated {
        let draft =
            Draft { inputs: 0, consts: vec![0.0], instrs: vec![], outputs: vec![Arg::Const(0)] };
        Differentiated {
            program: Program::verify(draft).expect("a constant is a program"),
            jacobian: Jacobian::default(),
            scratch: Draft::default(),
            tangents: Vec::new(),
            partials: Vec::new(),
        }
    }
}

impl Differentiated {
    /// Differentiates effective code by each of its constants, reusing the allocations.
    pub fn assign(&mut self, source: &Draft) {
        self.assign_free(source, |_| true);
    }

    /// Differentiates by the constants that are free; the derivatives by the others are zero.
    pub(crate) fn assign_free(&mut self, source: &Draft, is_free: impl Fn(usize) -> bool) {
        self.scratch.copy_from(source);
        self.partials.clear();
        self.partials.resize(source.instrs.len(), None);
        let parameters = source.consts.len();
        self.jacobian.outputs = source.outputs.len();
        self.jacobian.parameters = parameters;
        self.jacobian.entries.iter_mut().for_each(Vec::clear);
        let values = self.jacobian.entries.len().max(source.outputs.len());
        self.jacobian.entries.resize(values, Vec::new());
        for parameter in (0..parameters).filter(|&parameter| is_free(parameter)) {
            self.by_constant(source, parameter as u16);
        }
        self.program.assign(&self.scratch).expect("derivatives read earlier results");
    }

    fn by_constant(&mut self, source: &Draft, parameter: u16) {
        self.tangents.clear();
        for i in 0..source.instrs.len() {
            let tangent = self.instruction(source, i, parameter);
            self.tangents.push(tangent);
        }
        for (o, &output) in source.outputs.iter().enumerate() {
            let tangent = self.tangent(output, parameter);
            if tangent != Zero {
                let entry = (parameter, self.scratch.outputs.len() as u16);
                let value = self.value(tangent);
                self.scratch.outputs.push(value);
                self.jacobian.entries[o].push(entry);
            }
        }
    }

    fn tangent(&self, arg: Arg, parameter: u16) -> Tangent {
        match arg {
            Arg::Input(_) => Zero,
            Arg::Const(i) => {
                if i == parameter {
                    One
                } else {
                    Zero
                }
            }
            Arg::Result(i) => self.tangents[usize::from(i)],
        }
    }

    /// Applies the chain rule to one instruction.
    fn instruction(&mut self, source: &Draft, i: usize, parameter: u16) -> Tangent {
        let instr = source.instrs[i];
        let args = instr.args();
        let mut inner = [Zero; 4];
        for (to, &arg) in inner.iter_mut().zip(args) {
            *to = self.tangent(arg, parameter);
        }
        if inner == [Zero; 4] {
            return Zero;
        }
        let (a, b) = (args[0], args[args.len().min(2) - 1]);
        match instr.op() {
            // Only the branch taken counts.
            Op::Min => return self.branch(a, b, inner[0], inner[1]),
            Op::Max => return self.branch(b, a, inner[0], inner[1]),
            Op::Select => return self.branch(a, b, inner[2], inner[3]),
            _ => {}
        }
        let partials = match self.partials[i] {
            Some(known) => known,
            None => {
                let partials = self.partial_derivatives(instr.op(), args, Arg::Result(i as u16));
                self.partials[i] = Some(partials);
                partials
            }
        };
        let mut sum = Zero;
        for (partial, inner) in partials.into_iter().zip(inner) {
            sum = self.add_product(partial, inner, sum);
        }
        sum
    }

    /// Returns `left` where `a < b`, else `right`.
    fn branch(&mut self, a: Arg, b: Arg, left: Tangent, right: Tangent) -> Tangent {
        if left == right {
            return left;
        }
        let (left, right) = (self.value(left), self.value(right));
        Is(self.scratch.push(Op::Select, &[a, b, left, right]))
    }

    /// Returns the textbook derivatives of `y = op(args)` by its arguments.
    fn partial_derivatives(&mut self, op: Op, args: &[Arg], y: Arg) -> [Tangent; 4] {
        let a = args[0];
        let b = args.get(1).copied().unwrap_or(a);
        let c = args.get(2).copied().unwrap_or(a);
        let one = |p: Tangent| [p, Zero, Zero, Zero];
        match op {
            Op::Add => [One, One, Zero, Zero],
            Op::Sub => [One, MinusOne, Zero, Zero],
            Op::Mul => [Is(b), Is(a), Zero, Zero],
            Op::Mad => [Is(b), Is(a), One, Zero],
            Op::Div => {
                let reciprocal = self.push(Op::Rcp, &[b]);
                let quotient = self.push(Op::Mul, &[y, reciprocal]);
                [Is(reciprocal), Is(self.push(Op::Neg, &[quotient])), Zero, Zero]
            }
            Op::Neg => one(MinusOne),
            Op::Fract => one(One),
            Op::Abs => one(Is(self.push(Op::Sign, &[a]))),
            Op::Saturate => {
                let (nought, unit) = (self.literal(0.0), self.literal(1.0));
                let below = self.push(Op::Select, &[a, unit, unit, nought]);
                one(Is(self.push(Op::Select, &[nought, a, below, nought])))
            }
            Op::Rcp => {
                let square = self.push(Op::Mul, &[y, y]);
                one(Is(self.push(Op::Neg, &[square])))
            }
            Op::Sqrt => {
                let (half, steepest) = (self.literal(0.5), self.literal(STEEPEST));
                let slope = self.push(Op::Div, &[half, y]);
                one(Is(self.push(Op::Min, &[slope, steepest])))
            }
            Op::Rsqrt => {
                let minus_half = self.literal(-0.5);
                let square = self.push(Op::Mul, &[y, y]);
                let cube = self.push(Op::Mul, &[square, y]);
                one(Is(self.push(Op::Mul, &[minus_half, cube])))
            }
            Op::Exp2 => {
                let ln_2 = self.literal(std::f32::consts::LN_2);
                one(Is(self.push(Op::Mul, &[ln_2, y])))
            }
            Op::Exp => one(Is(y)),
            Op::Log2 => {
                let ln_2 = self.literal(std::f32::consts::LN_2);
                let scaled = self.push(Op::Mul, &[ln_2, a]);
                one(Is(self.push(Op::Rcp, &[scaled])))
            }
            Op::Log => one(Is(self.push(Op::Rcp, &[a]))),
            Op::Pow => self.power(a, b, y),
            Op::Sin => one(Is(self.push(Op::Cos, &[a]))),
            Op::Cos => {
                let sin = self.push(Op::Sin, &[a]);
                one(Is(self.push(Op::Neg, &[sin])))
            }
            Op::Tan => {
                let unit = self.literal(1.0);
                one(Is(self.push(Op::Mad, &[y, y, unit])))
            }
            Op::Asin | Op::Acos => {
                let unit = self.literal(1.0);
                let square = self.push(Op::Mul, &[a, a]);
                let rest = self.push(Op::Sub, &[unit, square]);
                let steepest = self.literal(STEEPEST);
                let slope = self.push(Op::Rsqrt, &[rest]);
                let slope = self.push(Op::Min, &[slope, steepest]);
                one(Is(if op == Op::Asin { slope } else { self.push(Op::Neg, &[slope]) }))
            }
            Op::Atan => {
                let unit = self.literal(1.0);
                let rest = self.push(Op::Mad, &[a, a, unit]);
                one(Is(self.push(Op::Rcp, &[rest])))
            }
            Op::Atan2 => {
                let square = self.push(Op::Mul, &[a, a]);
                let rest = self.push(Op::Mad, &[b, b, square]);
                let by_a = self.push(Op::Div, &[b, rest]);
                let minus_by_b = self.push(Op::Div, &[a, rest]);
                [Is(by_a), Is(self.push(Op::Neg, &[minus_by_b])), Zero, Zero]
            }
            Op::Tanh => {
                let unit = self.literal(1.0);
                let square = self.push(Op::Mul, &[y, y]);
                one(Is(self.push(Op::Sub, &[unit, square])))
            }
            Op::Lerp => {
                let unit = self.literal(1.0);
                let rest = self.push(Op::Sub, &[unit, c]);
                [Is(rest), Is(c), Is(self.push(Op::Sub, &[b, a])), Zero]
            }
            Op::Step | Op::Floor | Op::Sign => [Zero; 4],
            Op::Min | Op::Max | Op::Select => unreachable!("handled as branches"),
        }
    }

    /// Returns `∂aᵇ/∂a = b aᵇ/a` and `∂aᵇ/∂b = ln a · aᵇ`, both 0 at a = 0, where aᵇ is 0.
    fn power(&mut self, a: Arg, b: Arg, y: Arg) -> [Tangent; 4] {
        let smallest = self.literal(1e-30);
        let positive = self.push(Op::Max, &[a, smallest]);
        let ratio = self.push(Op::Div, &[y, positive]);
        let by_a = self.push(Op::Mul, &[b, ratio]);
        let ln = self.push(Op::Log, &[positive]);
        [Is(by_a), Is(self.push(Op::Mul, &[ln, y])), Zero, Zero]
    }

    fn push(&mut self, op: Op, args: &[Arg]) -> Arg {
        self.scratch.push(op, args)
    }

    /// Returns `x · y + sum`.
    fn add_product(&mut self, x: Tangent, y: Tangent, sum: Tangent) -> Tangent {
        match (x, y, sum) {
            (Zero, _, sum) | (_, Zero, sum) => sum,
            (One, product, Zero) | (product, One, Zero) => product,
            (MinusOne, MinusOne, Zero) => One,
            (MinusOne, Is(arg), Zero) | (Is(arg), MinusOne, Zero) => Is(self.push(Op::Neg, &[arg])),
            (Is(x), Is(y), Zero) => Is(self.push(Op::Mul, &[x, y])),
            (One, Is(arg), sum) | (Is(arg), One, sum) => {
                let sum = self.value(sum);
                Is(self.push(Op::Add, &[sum, arg]))
            }
            (MinusOne, Is(arg), sum) | (Is(arg), MinusOne, sum) => {
                let sum = self.value(sum);
                Is(self.push(Op::Sub, &[sum, arg]))
            }
            (x, y, sum) => {
                let [x, y, sum] = [x, y, sum].map(|t| self.value(t));
                Is(self.push(Op::Mad, &[x, y, sum]))
            }
        }
    }

    fn value(&mut self, tangent: Tangent) -> Arg {
        match tangent {
            Zero => self.literal(0.0),
            One => self.literal(1.0),
            MinusOne => self.literal(-1.0),
            Is(arg) => arg,
        }
    }

    /// Returns a constant of the derivatives' own, which follow the parameters.
    fn literal(&mut self, value: f32) -> Arg {
        let own = &self.scratch.consts[self.jacobian.parameters..];
        match own.iter().position(|c| c.to_bits() == value.to_bits()) {
            Some(known) => Arg::Const((self.jacobian.parameters + known) as u16),
            None => self.scratch.constant(value),
        }
    }
}
