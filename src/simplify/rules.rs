//! The rewriting rules; `c` stands for constants, `x` and `y` for anything.

use super::Simplifier;
use crate::op::Op;
use crate::program::Arg;

/// The most that an added constant may exceed what is left of it, so that at most 4 bits are lost.
/// By hand, unmeasured.
const FAR: f32 = 16.0;

impl Simplifier {
    /// Rewrites `op` on `args` by one of the rules; the arguments are simplified already.
    pub(super) fn rewrite(&mut self, op: Op, args: &[Arg]) -> Option<Arg> {
        let (x, y) = (args[0], *args.get(1).unwrap_or(&args[0]));
        match op {
            Op::Add => self.sum(x, y),
            Op::Sub => self.difference(x, y),
            Op::Mul => self.product(x, y),
            Op::Div => self.quotient(x, y),
            Op::Neg => self.negation(x),
            Op::Min | Op::Max => self.extremum(op, x, y),
            Op::Mad => {
                let product = self.build(Op::Mul, &args[..2]);
                Some(self.build(Op::Add, &[product, args[2]]))
            }
            Op::Abs => self.absolute(x),
            Op::Lerp if self.constant(args[2]) == Some(1.0) => Some(y),
            Op::Pow if self.constant(y) == Some(0.0) => Some(self.number(1.0)),
            _ => self.inverse(op, x),
        }
    }

    /// `|−x|` as `|x|`; `|c x|` as `|c| |x|`, so that constants meet.
    fn absolute(&mut self, x: Arg) -> Option<Arg> {
        if let Some(inner) = self.negated(x) {
            return Some(self.build(Op::Abs, &[inner]));
        }
        let (inner, c) = self.constant_last(x, Op::Mul).filter(|_| self.is_read_once(x))?;
        let c = self.fold(Op::Abs, &[c])?;
        let inner = self.build(Op::Abs, &[inner]);
        Some(self.build(Op::Mul, &[inner, c]))
    }

    /// Cancels functions of their inverse.
    fn inverse(&mut self, op: Op, x: Arg) -> Option<Arg> {
        let inner = self.definition(x)?;
        let (y, _) = self.operands(x, inner.op())?;
        match (op, inner.op()) {
            (Op::Exp2, Op::Log2) | (Op::Log2, Op::Exp2) => Some(y),
            (Op::Exp, Op::Log) | (Op::Log, Op::Exp) => Some(y),
            (Op::Sin, Op::Asin) | (Op::Cos, Op::Acos) | (Op::Tan, Op::Atan) => Some(y),
            (Op::Rcp, Op::Exp2 | Op::Exp) => self.inverse_power(x),
            (Op::Rcp, Op::Rcp) => Some(y),
            (Op::Rcp, Op::Sqrt) | (Op::Sqrt, Op::Rcp) if self.is_read_once(x) => {
                Some(self.build(Op::Rsqrt, &[y]))
            }
            (Op::Rcp, Op::Rsqrt) if self.is_read_once(x) => Some(self.build(Op::Sqrt, &[y])),
            (Op::Sqrt, Op::Mul) if inner.args()[0] == inner.args()[1] => {
                Some(self.build(Op::Abs, &[y]))
            }
            (Op::Rcp, Op::Div) if self.is_read_once(x) => {
                let args = [inner.args()[1], inner.args()[0]];
                Some(self.build(Op::Div, &args))
            }
            _ => None,
        }
    }

    fn sum(&mut self, x: Arg, y: Arg) -> Option<Arg> {
        if self.constant(x).is_some() {
            return self.sum_with_constant(y, x);
        }
        if self.constant(y).is_some() {
            return self.sum_with_constant(x, y);
        }
        if let Some(inner) = self.negated(y) {
            return Some(self.build(Op::Sub, &[x, inner]));
        }
        if let Some(inner) = self.negated(x) {
            return Some(self.build(Op::Sub, &[y, inner]));
        }
        if x == y {
            let two = self.number(2.0);
            return Some(self.build(Op::Mul, &[x, two]));
        }
        // (x + c₁) + (y + c₂) = x + (y + c)
        let (left, c1) = self.constant_last(x, Op::Add).filter(|_| self.is_read_once(x))?;
        let (right, c2) = self.constant_last(y, Op::Add).filter(|_| self.is_read_once(y))?;
        let c = self.fold(Op::Add, &[c1, c2])?;
        let right = self.build(Op::Add, &[right, c]);
        Some(self.build(Op::Add, &[left, right]))
    }

    fn sum_with_constant(&mut self, x: Arg, c: Arg) -> Option<Arg> {
        if let Some((inner, c2)) = self.constant_last(x, Op::Add) {
            let c = self.fold(Op::Add, &[c2, c])?;
            return Some(self.build(Op::Add, &[inner, c]));
        }
        if let Some(sum) = self.scaled_sum_with_constant(x, c) {
            return Some(sum);
        }
        let (left, right) = self.operands(x, Op::Sub)?;
        self.constant(left)?;
        let c = self.fold(Op::Add, &[left, c])?;
        Some(self.build(Op::Sub, &[c, right]))
    }

    /// `c₁ (x + c₂) + c` as `c₁ x + c₃`, if nothing else reads the parts. Where `c₂` brings values
    /// far from zero near to it, digits would be lost: then not.
    fn scaled_sum_with_constant(&mut self, product: Arg, c: Arg) -> Option<Arg> {
        let (sum, c1) = self.constant_last(product, Op::Mul)?;
        if !self.is_read_once(product) || !self.is_read_once(sum) {
            return None;
        }
        let (op, x, c2) = match self.constant_last(sum, Op::Add) {
            Some((x, c2)) => (Op::Add, x, c2),
            None => {
                let (c2, x) = self.operands(sum, Op::Sub)?;
                (Op::Sub, x, c2)
            }
        };
        let shift = self.fold(Op::Mul, &[c1, c2])?;
        let size = |arg: Arg| self.constant(arg).map(f32::abs);
        if size(shift)? > FAR * size(c)?.max(size(c1)?) {
            return None;
        }
        let c = self.fold(Op::Add, &[shift, c])?;
        let x = self.build(Op::Mul, &[x, c1]);
        Some(match op {
            Op::Add => self.build(Op::Add, &[x, c]),
            _ => self.build(Op::Sub, &[c, x]),
        })
    }

    /// Returns the operands of `arg`, an `op` of something and a constant, the constant second.
    fn constant_last(&self, arg: Arg, op: Op) -> Option<(Arg, Arg)> {
        let (a, b) = self.operands(arg, op)?;
        match (self.constant(a), self.constant(b)) {
            (_, Some(_)) => Some((a, b)),
            (Some(_), _) if op.commutes() => Some((b, a)),
            _ => None,
        }
    }

    fn difference(&mut self, x: Arg, y: Arg) -> Option<Arg> {
        if let Some(c) = self.constant(y) {
            let c = self.number(-c);
            return Some(self.build(Op::Add, &[x, c]));
        }
        if let Some(inner) = self.negated(y) {
            return Some(self.build(Op::Add, &[x, inner]));
        }
        if self.constant(x).is_some() {
            // c₁ − (x + c₂), c₁ − (c₂ − x), c₁ − c₂x
            if let Some((inner, c2)) = self.constant_last(y, Op::Add) {
                let c = self.fold(Op::Sub, &[x, c2])?;
                return Some(self.build(Op::Sub, &[c, inner]));
            }
            if let Some((left, right)) = self.operands(y, Op::Sub)
                && self.constant(left).is_some()
            {
                let c = self.fold(Op::Sub, &[x, left])?;
                return Some(self.build(Op::Add, &[right, c]));
            }
            if let Some(negated) = self.negated_product(y) {
                return Some(self.build(Op::Add, &[negated, x]));
            }
        }
        None
    }

    /// `−(c x)` as `(−c) x`, if nothing else reads the product.
    fn negated_product(&mut self, arg: Arg) -> Option<Arg> {
        let (inner, c) = self.constant_last(arg, Op::Mul).filter(|_| self.is_read_once(arg))?;
        let c = self.fold(Op::Neg, &[c])?;
        Some(self.build(Op::Mul, &[inner, c]))
    }

    fn negation(&mut self, x: Arg) -> Option<Arg> {
        if let Some((left, right)) = self.operands(x, Op::Sub)
            && self.is_read_once(x)
        {
            return Some(self.build(Op::Sub, &[right, left]));
        }
        if let Some((inner, c)) = self.constant_last(x, Op::Add)
            && self.is_read_once(x)
        {
            let c = self.fold(Op::Neg, &[c])?;
            return Some(self.build(Op::Sub, &[c, inner]));
        }
        self.negated_product(x)
    }

    fn product(&mut self, x: Arg, y: Arg) -> Option<Arg> {
        if self.constant(x).is_some() {
            return self.product_with_constant(y, x);
        }
        if self.constant(y).is_some() {
            return self.product_with_constant(x, y);
        }
        for (a, b) in [(x, y), (y, x)] {
            if let Some(inner) = self.negated(a) {
                let product = self.build(Op::Mul, &[inner, b]);
                return Some(self.build(Op::Neg, &[product]));
            }
            // (c x) y = (x y) c, so that constants meet.
            if let Some((inner, c)) = self.constant_last(a, Op::Mul)
                && self.is_read_once(a)
            {
                let product = self.build(Op::Mul, &[inner, b]);
                return Some(self.build(Op::Mul, &[product, c]));
            }
            if let Some((inner, _)) = self.operands(a, Op::Rcp) {
                return Some(self.build(Op::Div, &[b, inner]));
            }
        }
        if x == y
            && let Some((inner, _)) = self.operands(x, Op::Sqrt)
        {
            return Some(inner);
        }
        self.normal_product(x, y)
    }

    fn product_with_constant(&mut self, x: Arg, c: Arg) -> Option<Arg> {
        if let Some((inner, c2)) = self.constant_last(x, Op::Mul) {
            let c = self.fold(Op::Mul, &[c2, c])?;
            return Some(self.build(Op::Mul, &[inner, c]));
        }
        if let Some(inner) = self.negated(x) {
            let c = self.fold(Op::Neg, &[c])?;
            return Some(self.build(Op::Mul, &[inner, c]));
        }
        if let Some((left, right)) = self.operands(x, Op::Div)
            && self.constant(left).is_some()
        {
            let c = self.fold(Op::Mul, &[left, c])?;
            return Some(self.build(Op::Div, &[c, right]));
        }
        self.scaled_sum(x, c).or_else(|| self.scaled_quotient(x, c))
    }

    fn quotient(&mut self, x: Arg, y: Arg) -> Option<Arg> {
        if x == y {
            return Some(self.number(1.0));
        }
        if let Some(c) = self.constant(y) {
            let inverse = 1.0 / c;
            if !inverse.is_finite() {
                return None;
            }
            let inverse = self.number(inverse);
            return Some(self.build(Op::Mul, &[x, inverse]));
        }
        if let Some((inner, _)) = self.operands(y, Op::Rcp) {
            return Some(self.build(Op::Mul, &[x, inner]));
        }
        if self.constant(x).is_some() {
            // c₁ / (c₂ y)
            if let Some((inner, c2)) = self.constant_last(y, Op::Mul)
                && self.is_read_once(y)
            {
                let c = self.fold(Op::Div, &[x, c2])?;
                return Some(self.build(Op::Div, &[c, inner]));
            }
            if self.constant(x) == Some(1.0) {
                return Some(self.build(Op::Rcp, &[y]));
            }
        }
        if let Some(inverse) = self.inverse_power(y) {
            return Some(self.build(Op::Mul, &[x, inverse]));
        }
        for (a, b, numerator) in [(x, y, true), (y, x, false)] {
            if let Some(inner) = self.negated(a) {
                let quotient =
                    self.build(Op::Div, &if numerator { [inner, b] } else { [b, inner] });
                return Some(self.build(Op::Neg, &[quotient]));
            }
        }
        // (c x) / y = (x / y) c
        if let Some((inner, c)) = self.constant_last(x, Op::Mul)
            && self.is_read_once(x)
        {
            let quotient = self.build(Op::Div, &[inner, y]);
            return Some(self.build(Op::Mul, &[quotient, c]));
        }
        self.normal_quotient(x, y)
    }

    /// `1/exp2(x)` as `exp2(−x)`, if nothing else reads the power: signs are free, an inverse is
    /// not.
    fn inverse_power(&mut self, power: Arg) -> Option<Arg> {
        let inner = self.definition(power).filter(|_| self.is_read_once(power))?;
        if !matches!(inner.op(), Op::Exp2 | Op::Exp) {
            return None;
        }
        let exponent = self.build(Op::Neg, &[inner.args()[0]]);
        Some(self.build(inner.op(), &[exponent]))
    }

    fn extremum(&mut self, op: Op, x: Arg, y: Arg) -> Option<Arg> {
        for (a, b) in [(x, y), (y, x)] {
            if let Some(clamped) = self.unit_clamp(op, a, b) {
                return Some(clamped);
            }
            // min(min(x, c₁), c₂), min(min(x, y), y)
            if let Some((left, right)) = self.operands(a, op) {
                if left == b || right == b {
                    return Some(a);
                }
                if let Some((inner, c)) = self.constant_last(a, op)
                    && self.constant(b).is_some()
                {
                    let c = self.fold(op, &[c, b])?;
                    return Some(self.build(op, &[inner, c]));
                }
            }
        }
        None
    }

    /// `min(max(x, 0), 1)` and `max(min(x, 1), 0)` are a saturation, which is free on a result.
    fn unit_clamp(&mut self, op: Op, inner: Arg, bound: Arg) -> Option<Arg> {
        let (opposite, bounds) = match op {
            Op::Min => (Op::Max, [0.0, 1.0]),
            _ => (Op::Min, [1.0, 0.0]),
        };
        let (x, inner_bound) = self.constant_last(inner, opposite)?;
        let found = [self.constant(inner_bound)?, self.constant(bound)?];
        (found == bounds).then(|| self.build(Op::Saturate, &[x]))
    }
}
