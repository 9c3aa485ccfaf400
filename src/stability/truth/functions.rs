//! The functions whose values, slopes and curvatures take more than a line.

use super::local::Local;
use crate::num::Span;
use crate::op::Op;
use std::f64::consts::{FRAC_PI_2, LN_2, PI, TAU};

/// ln 2, which no `f64` is.
pub(super) fn ln_2() -> Span {
    Span::new(LN_2.next_down(), LN_2.next_up())
}

pub(super) fn number(x: f64) -> Span {
    Span::point(x)
}

/// Returns `a / b`.
pub(super) fn quotient(a: Span, b: Span) -> Local {
    let (value, reciprocal) = (a.over(b), b.reciprocal());
    let by_b = value.times(reciprocal).negated();
    let by_both = reciprocal.squared().negated();
    let twice = by_b.times(reciprocal).times(number(-2.0));
    Local::of_two(value, [reciprocal, by_b], [Span::ZERO, by_both, twice])
}

/// Returns the smaller of two.
pub(super) fn choice(a: Span, b: Span) -> Local {
    let value = a.minimum(b);
    if a.high() <= b.low() {
        return Local::straight(value, [1.0, 0.0]);
    }
    if b.high() <= a.low() {
        return Local::straight(value, [0.0, 1.0]);
    }
    Local::of_two(value, [Span::new(0.0, 1.0); 2], [Span::ALL; 3])
}

/// Returns an exponential, which may underflow.
pub(super) fn exponential(a: Span, f: impl Fn(f64) -> f64) -> Span {
    let value = a.increasing(f).clamped(0.0, f64::INFINITY);
    if value.low() > f64::MIN_POSITIVE {
        return value;
    }
    value.hull(Span::new(0.0, f64::MIN_POSITIVE))
}

/// Returns `f(a)`, whose slope is `scale/a`.
pub(super) fn logarithm(a: Span, f: impl Fn(f64) -> f64, scale: Span) -> Local {
    let of = a.restricted(0.0, f64::INFINITY);
    if of.low() < 0.0 {
        return Local::of_one(of, Span::ALL, Span::ALL);
    }
    let reciprocal = of.reciprocal();
    let slope = scale.times(reciprocal);
    // At zero it has no value.
    let value = of.increasing(f).or_undefined_if(of.low() == 0.0);
    Local::of_one(value, slope, slope.times(reciprocal).negated())
}

/// Returns `a^b` for `a` from 0; 0 to a positive power is 0.
pub(super) fn power(a: Span, b: Span) -> Local {
    let of = a.restricted(0.0, f64::INFINITY);
    if of.low() < 0.0 {
        return Local::jumping(of);
    }
    let undefined = of.may_be_undefined() || of.low() == 0.0 && b.low() <= 0.0;
    let log = Local::of(Op::Log2, of, of, false).map_or(Span::ALL, |log| log.value);
    let known = b.low() == b.high() && b.low() != 0.0;
    let value = if known { raised(of, b.low()) } else { exponential(b.times(log), f64::exp2) };
    // The exponents that are less by one and two may round to others.
    let less = |by: f64| match b.minus(number(by)) {
        exponent if exponent.low() == exponent.high() => raised(of, exponent.low()),
        exponent => exponential(exponent.times(log), f64::exp2),
    };
    let ln = log.times(ln_2());
    let (lower, by_b) = (less(1.0), value.times(ln));
    let by_a = b.times(lower);
    let curvatures = [
        b.times(b.minus(Span::ONE)).times(less(2.0)),
        lower.times(Span::ONE.plus(b.times(ln))),
        by_b.times(ln),
    ];
    // Within the steps a zero has no logarithm; the power may have a value there.
    let value = Span::new(value.low(), value.high()).or_undefined_if(undefined);
    Local::of_two(value, [by_a, by_b], curvatures)
}

/// Returns `a^b` for `a` from 0.
fn raised(a: Span, b: f64) -> Span {
    if b == 0.0 {
        return Span::ONE;
    }
    let value = if b > 0.0 { a.increasing(|x| x.powf(b)) } else { a.decreasing(|x| x.powf(b)) };
    // A power may underflow.
    let lowest = value.low() <= f64::MIN_POSITIVE && a.high() > 0.0;
    if lowest { value.hull(Span::new(0.0, f64::MIN_POSITIVE)) } else { value }
}

/// Returns a sine shifted to have a maximum at `crest`.
pub(super) fn wave(a: Span, f: impl Fn(f64) -> f64, crest: f64) -> Span {
    // Beyond, counting periods is not exact enough.
    if a.most() > 1e6 {
        return Span::new(-1.0, 1.0);
    }
    let passes = |at: f64| ((a.low() - at) / TAU - 1e-9).ceil() <= (a.high() - at) / TAU + 1e-9;
    let ends = [a.low(), a.high()].map(|x| number(x).increasing(&f));
    let ends = ends[0].hull(ends[1]).clamped(-1.0, 1.0);
    let above = if passes(crest) { 1.0 } else { ends.high() };
    let below = if passes(crest + PI) { -1.0 } else { ends.low() };
    Span::new(below, above)
}

pub(super) fn tangent(a: Span) -> Span {
    let turn = |x: f64| (x + FRAC_PI_2) / PI;
    // A pole within rounding of either end counts.
    let branch = |x: f64| [turn(x) - 1e-9, turn(x) + 1e-9].map(f64::floor);
    let [low, high] = [branch(a.low()), branch(a.high())];
    if a.most() > 1e6 || low[0] != high[1] {
        return Span::ALL.or_undefined_if(true);
    }
    a.increasing(f64::tan)
}

/// Returns an arc sine (sign 1) or cosine (sign −1), given its values.
pub(super) fn arc(a: Span, value: Span, sign: f64) -> Local {
    let of = a.restricted(-1.0, 1.0);
    if !of.is_bounded() {
        return Local::of_one(value, Span::ALL, Span::ALL);
    }
    // (1 − a)(1 + a), with its maximum at a = 0.
    let at = |x: f64| Span::ONE.minus(number(x)).times(Span::ONE.plus(number(x)));
    let ends = at(of.low()).hull(at(of.high()));
    let rest = if of.contains(0.0) { ends.hull(Span::ONE) } else { ends };
    let rest = rest.clamped(0.0, 1.0).reciprocal();
    let slope = rest.root();
    let curvature = of.times(slope).times(rest);
    Local::of_one(value, slope.times(number(sign)), curvature.times(number(sign)))
}

/// Returns the angle of the point (x, y).
pub(super) fn angle(y: Span, x: Span) -> Local {
    if y.contains(0.0) && x.low() <= 0.0 {
        let all = Span::new(-PI.next_up(), PI.next_up());
        return Local::jumping(all.or_undefined_if(x.contains(0.0)));
    }
    // The extremes are at corners.
    let corner = |y: f64, x: f64| number(1.0).increasing(|_| y.atan2(x));
    let value = [(y.low(), x.high()), (y.high(), x.low()), (y.high(), x.high())]
        .into_iter()
        .fold(corner(y.low(), x.low()), |hull, (y, x)| hull.hull(corner(y, x)));
    let reciprocal = x.squared().plus(y.squared()).reciprocal();
    let square = reciprocal.squared();
    let bend = number(2.0).times(x.times(y)).times(square);
    let by_both = y.squared().minus(x.squared()).times(square);
    let slopes = [x.times(reciprocal), y.times(reciprocal).negated()];
    Local::of_two(value, slopes, [bend.negated(), by_both, bend])
}

pub(super) fn step(edge: Span, x: Span) -> Local {
    if x.low() >= edge.high() {
        return Local::straight(Span::ONE, [0.0, 0.0]);
    }
    if x.high() < edge.low() {
        return Local::straight(Span::ZERO, [0.0, 0.0]);
    }
    Local::jumping(Span::new(0.0, 1.0))
}
