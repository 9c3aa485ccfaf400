//! Removes constants that quotients and products have too many of: `(a x + b)/(c x + d)` is the
//! same for all multiples of its four. A factor moves into a sum whose every term has a constant to
//! take it, and one of the rest is made 1.

use super::Simplifier;
use crate::op::Op;
use crate::program::Arg;

/// A scale of constants.
#[derive(Clone, Copy)]
enum Scale {
    By(f32),
    Over(f32),
}

impl Scale {
    /// Scales a constant; none if the result is not of ordinary size.
    fn of(self, value: f32) -> Option<f32> {
        let scaled = match self {
            Scale::By(factor) => value * factor,
            Scale::Over(divisor) => value / divisor,
        };
        (value == 0.0 || ORDINARY.contains(&scaled.abs())).then_some(scaled)
    }
}

/// Sizes within which scaling back and forth loses nothing: far from `f32`'s limits. By hand.
const ORDINARY: std::ops::RangeInclusive<f32> = 1e-9..=1e9;

impl Simplifier {
    /// Takes the factor of `c S` into the sum `S`.
    pub(super) fn scaled_sum(&mut self, sum: Arg, c: Arg) -> Option<Arg> {
        let scale = Scale::By(self.constant(c)?);
        self.takes_into_sum(sum, scale).then(|| self.scaled(sum, scale))
    }

    /// Takes the factor of `c (N/D)` into either sum.
    pub(super) fn scaled_quotient(&mut self, quotient: Arg, c: Arg) -> Option<Arg> {
        let value = self.constant(c)?;
        if !self.is_read_once(quotient) {
            return None;
        }
        let instr = self.definition(quotient)?;
        let (numerator, divisor) = match (instr.op(), instr.args()) {
            (Op::Div, &[numerator, divisor]) => (numerator, divisor),
            (Op::Rcp, &[divisor]) => return Some(self.build(Op::Div, &[c, divisor])),
            _ => return None,
        };
        if self.takes_into_sum(numerator, Scale::By(value)) {
            let numerator = self.scaled(numerator, Scale::By(value));
            return Some(self.build(Op::Div, &[numerator, divisor]));
        }
        if self.takes_into_sum(divisor, Scale::Over(value)) {
            let divisor = self.scaled(divisor, Scale::Over(value));
            return Some(self.build(Op::Div, &[numerator, divisor]));
        }
        None
    }

    /// Writes `c/D` as the inverse of a sum, and `N/D` with a factor of 1 in either sum.
    pub(super) fn normal_quotient(&mut self, numerator: Arg, divisor: Arg) -> Option<Arg> {
        if let Some(value) = self.constant(numerator) {
            let scale = Scale::Over(value);
            let takes = value != 1.0 && self.takes_into_sum(divisor, scale);
            return takes.then(|| {
                let divisor = self.scaled(divisor, scale);
                self.build(Op::Rcp, &[divisor])
            });
        }
        let scale = Scale::Over(self.leading([numerator, divisor])?);
        let takes = self.takes_into_sum(numerator, scale) && self.takes_into_sum(divisor, scale);
        takes.then(|| {
            let args = [numerator, divisor].map(|sum| self.scaled(sum, scale));
            self.build(Op::Div, &args)
        })
    }

    /// Writes a product of two sums with a factor of 1 in one of them.
    pub(super) fn normal_product(&mut self, x: Arg, y: Arg) -> Option<Arg> {
        for (one, other) in [(x, y), (y, x)] {
            let Some(value) = self.leading([one]) else { continue };
            let (over, by) = (Scale::Over(value), Scale::By(value));
            if self.takes_into_sum(one, over) && self.takes_into_sum(other, by) {
                let (one, other) = (self.scaled(one, over), self.scaled(other, by));
                return Some(self.build(Op::Mul, &[one, other]));
            }
        }
        None
    }

    fn takes_into_sum(&self, arg: Arg, scale: Scale) -> bool {
        let is_sum = self.definition(arg).is_some_and(|i| matches!(i.op(), Op::Add | Op::Sub));
        is_sum && self.takes(arg, scale)
    }

    /// Returns true if every term has a constant to scale, and nothing else reads it.
    fn takes(&self, arg: Arg, scale: Scale) -> bool {
        if self.takes_as_constant(arg, scale) {
            return true;
        }
        let Some(instr) = self.definition(arg).filter(|_| self.is_read_once(arg)) else {
            return false;
        };
        // Constants alone have no finite value here, or they would have been folded.
        if instr.args().iter().all(|&arg| self.constant(arg).is_some()) {
            return false;
        }
        match (instr.op(), instr.args()) {
            (Op::Add | Op::Sub, args) => args.iter().all(|&term| self.takes(term, scale)),
            (Op::Mul, args) => args.iter().any(|&factor| self.takes_as_constant(factor, scale)),
            (Op::Div, args) => self.takes_as_constant(args[0], scale),
            _ => false,
        }
    }

    fn takes_as_constant(&self, arg: Arg, scale: Scale) -> bool {
        self.constant(arg).is_some_and(|value| scale.of(value).is_some())
    }

    /// Scales a value for which [`Simplifier::takes`] is true.
    fn scaled(&mut self, arg: Arg, scale: Scale) -> Arg {
        if let Some(scaled) = self.constant(arg).and_then(|value| scale.of(value)) {
            return self.number(scaled);
        }
        let Some(instr) = self.definition(arg) else { return arg };
        let mut args = [instr.args()[0], instr.args()[1]];
        match instr.op() {
            Op::Add | Op::Sub => args = args.map(|term| self.scaled(term, scale)),
            Op::Mul if self.constant(args[0]).is_none() => args[1] = self.scaled(args[1], scale),
            _ => args[0] = self.scaled(args[0], scale),
        }
        self.build(instr.op(), &args)
    }

    /// Returns the factor, of a term in one of the sums, that is best made 1: the first that is an
    /// instruction by itself, or else the first.
    fn leading<const N: usize>(&self, sums: [Arg; N]) -> Option<f32> {
        let mut best = None;
        sums.iter().for_each(|&sum| self.find_factor(sum, &mut best));
        best.map(|(factor, _)| factor)
    }

    /// Looks for a better factor among the terms; each comes with whether making it 1 saves a
    /// product.
    fn find_factor(&self, arg: Arg, best: &mut Option<(f32, bool)>) {
        let instr = self.definition(arg).filter(|_| self.is_read_once(arg));
        let Some(instr) = instr else { return };
        let args = instr.args();
        let factor = match instr.op() {
            Op::Mul => args.iter().find_map(|&factor| self.constant(factor)),
            Op::Div => self.constant(args[0]),
            _ => None,
        };
        match (factor, instr.op()) {
            (Some(1.0), _) => {}
            (Some(factor), op) => {
                let is_product = |arg: &Arg| self.operands(*arg, Op::Mul).is_some();
                let saves = op == Op::Div || args.iter().any(is_product);
                if best.is_none_or(|(_, saved)| saves && !saved) {
                    *best = Some((factor, saves));
                }
            }
            (None, Op::Add | Op::Sub) => args.iter().for_each(|&arg| self.find_factor(arg, best)),
            _ => {}
        }
    }
}
