//! Replaces operations that do nothing, as any compiler does.

use super::Simplifier;
use crate::op::Op;
use crate::program::Arg;

impl Simplifier {
    /// Returns the value of `op` on `args` where it does nothing, or nothing but change a sign; it
    /// is the same wherever the operation's result is finite, except for the sign of a zero and the
    /// rounding of a power.
    pub(super) fn identity(&mut self, op: Op, args: &[Arg]) -> Option<Arg> {
        let (x, y) = (args[0], *args.get(1).unwrap_or(&args[0]));
        let known = [self.constant(x), self.constant(y)];
        match (op, known) {
            (Op::Add, [Some(0.0), _]) => Some(y),
            (Op::Add | Op::Sub, [_, Some(0.0)]) => Some(x),
            (Op::Sub, _) if x == y => Some(self.number(0.0)),
            (Op::Sub, [Some(0.0), _]) => Some(self.build(Op::Neg, &[y])),
            (Op::Mul, [Some(0.0), _] | [_, Some(0.0)]) => Some(self.number(0.0)),
            (Op::Mul, [Some(1.0), _]) => Some(y),
            (Op::Mul | Op::Div | Op::Pow, [_, Some(1.0)]) => Some(x),
            (Op::Mul, [Some(-1.0), _]) => Some(self.build(Op::Neg, &[y])),
            (Op::Mul | Op::Div, [_, Some(-1.0)]) => Some(self.build(Op::Neg, &[x])),
            (Op::Div, [Some(0.0), divisor]) if divisor != Some(0.0) => Some(self.number(0.0)),
            (Op::Mad, _) => self.plain_mad(args),
            (Op::Min | Op::Max, _) if x == y => Some(x),
            (Op::Lerp, _) if x == y || self.constant(args[2]) == Some(0.0) => Some(x),
            (Op::Select, _) if args[2] == args[3] => Some(args[2]),
            (Op::Select, [Some(a), Some(b)]) => Some(if a < b { args[2] } else { args[3] }),
            (Op::Neg, _) => Some(self.operands(x, Op::Neg)?.0),
            (Op::Abs | Op::Saturate | Op::Floor | Op::Sign, _) => {
                (self.definition(x)?.op() == op).then_some(x)
            }
            _ => None,
        }
    }

    /// Simplifies a `mad` of which a factor or the summand does nothing.
    fn plain_mad(&mut self, args: &[Arg]) -> Option<Arg> {
        let (a, b, c) = (args[0], args[1], args[2]);
        match [a, b, c].map(|arg| self.constant(arg)) {
            [Some(0.0), ..] | [_, Some(0.0), _] => Some(c),
            [Some(1.0), ..] => Some(self.build(Op::Add, &[b, c])),
            [_, Some(1.0), _] => Some(self.build(Op::Add, &[a, c])),
            [Some(-1.0), ..] => Some(self.build(Op::Sub, &[c, b])),
            [_, Some(-1.0), _] => Some(self.build(Op::Sub, &[c, a])),
            [.., Some(0.0)] => Some(self.build(Op::Mul, &[a, b])),
            _ => None,
        }
    }
}
