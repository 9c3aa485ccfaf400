//! Values, slopes and curvatures of each operation over spans of its arguments, in real numbers.

use super::functions::{
    angle, arc, choice, exponential, ln_2, logarithm, number, power, quotient, step, tangent, wave,
};
use crate::num::Span;
use crate::op::Op;
use std::f64::consts::FRAC_PI_2;

/// An operation of one or two arguments, over all values of these.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local {
    /// Its values.
    pub value: Span,
    /// Its derivatives by each argument; across a kink, all slopes between those on either side.
    pub slopes: [Span; 2],
    /// Its second derivatives: by the first argument, by both, by the second.
    pub curvatures: [Span; 3],
}

impl Local {
    pub fn of_one(value: Span, slope: Span, curvature: Span) -> Local {
        let zero = Span::ZERO;
        Local { value, slopes: [slope, zero], curvatures: [curvature, zero, zero] }
    }

    pub fn of_two(value: Span, slopes: [Span; 2], curvatures: [Span; 3]) -> Local {
        Local { value, slopes, curvatures }
    }

    /// Makes one of constant slopes.
    pub fn straight(value: Span, slopes: [f64; 2]) -> Local {
        Local::of_two(value, slopes.map(number), [Span::ZERO; 3])
    }

    /// Makes one that bends at an unknown place.
    fn bent(value: Span, slope: Span) -> Local {
        Local::of_one(value, slope, Span::ALL)
    }

    /// Makes one that jumps at an unknown place.
    pub fn jumping(value: Span) -> Local {
        Local::of_two(value, [Span::ALL; 2], [Span::ALL; 3])
    }

    /// Returns an operation over its arguments; `same` is true if these are one. A choice between
    /// arguments has its own treatment where it is undecided. Operations of more arguments are made
    /// of others, and have none.
    pub fn of(op: Op, a: Span, b: Span, same: bool) -> Option<Local> {
        let local = match op {
            Op::Add => Local::straight(a.plus(b), [1.0, 1.0]),
            Op::Sub => Local::straight(a.minus(b), [1.0, -1.0]),
            Op::Neg => Local::straight(a.negated(), [-1.0, 0.0]),
            Op::Mul if same => Local::of_one(a.squared(), a.times(number(2.0)), number(2.0)),
            Op::Mul => Local::of_two(a.times(b), [b, a], [Span::ZERO, Span::ONE, Span::ZERO]),
            Op::Div => quotient(a, b),
            Op::Min => choice(a, b),
            Op::Max => {
                let Local { value, slopes, curvatures } = choice(a.negated(), b.negated());
                Local::of_two(value.negated(), slopes, curvatures.map(Span::negated))
            }
            Op::Abs if a.low() >= 0.0 => Local::straight(a, [1.0, 0.0]),
            Op::Abs if a.high() <= 0.0 => Local::straight(a.negated(), [-1.0, 0.0]),
            Op::Abs => Local::bent(a.abs(), Span::new(-1.0, 1.0)),
            Op::Saturate if a.low() >= 0.0 && a.high() <= 1.0 => Local::straight(a, [1.0, 0.0]),
            Op::Saturate if a.high() <= 0.0 || a.low() >= 1.0 => {
                Local::straight(a.clamped(0.0, 1.0), [0.0, 0.0])
            }
            Op::Saturate => Local::bent(a.clamped(0.0, 1.0), Span::new(0.0, 1.0)),
            Op::Rcp => {
                let value = a.reciprocal();
                let slope = value.squared().negated();
                Local::of_one(value, slope, slope.times(value).times(number(-2.0)))
            }
            Op::Sqrt => {
                let value = a.root();
                let slope = number(0.5).times(value.reciprocal());
                let curvature = slope.times(a.clamped(0.0, f64::INFINITY).reciprocal());
                Local::of_one(value, slope, curvature.times(number(-0.5)))
            }
            Op::Rsqrt => {
                let value = a.root().reciprocal();
                let reciprocal = a.clamped(0.0, f64::INFINITY).reciprocal();
                let slope = value.times(reciprocal).times(number(-0.5));
                Local::of_one(value, slope, slope.times(reciprocal).times(number(-1.5)))
            }
            Op::Exp2 => {
                let value = exponential(a, f64::exp2);
                let slope = value.times(ln_2());
                Local::of_one(value, slope, slope.times(ln_2()))
            }
            Op::Exp => {
                let value = exponential(a, f64::exp);
                Local::of_one(value, value, value)
            }
            Op::Log2 => logarithm(a, f64::log2, ln_2().reciprocal()),
            Op::Log => logarithm(a, f64::ln, Span::ONE),
            Op::Pow => power(a, b),
            Op::Sin => {
                let value = wave(a, f64::sin, FRAC_PI_2);
                Local::of_one(value, wave(a, f64::cos, 0.0), value.negated())
            }
            Op::Cos => {
                let value = wave(a, f64::cos, 0.0);
                Local::of_one(value, wave(a, f64::sin, FRAC_PI_2).negated(), value.negated())
            }
            Op::Tan => {
                let value = tangent(a);
                let slope = Span::ONE.plus(value.squared());
                Local::of_one(value, slope, value.times(slope).times(number(2.0)))
            }
            Op::Asin => arc(a, a.restricted(-1.0, 1.0).increasing(f64::asin), 1.0),
            Op::Acos => arc(a, a.restricted(-1.0, 1.0).decreasing(f64::acos), -1.0),
            Op::Atan => {
                let slope = Span::ONE.plus(a.squared()).reciprocal();
                let curvature = a.times(slope.squared()).times(number(-2.0));
                Local::of_one(a.increasing(f64::atan), slope, curvature)
            }
            Op::Atan2 => angle(a, b),
            Op::Tanh => {
                let value = a.increasing(f64::tanh).clamped(-1.0, 1.0);
                let slope = Span::ONE.minus(value.squared());
                Local::of_one(value, slope, value.times(slope).times(number(-2.0)))
            }
            Op::Step => step(a, b),
            Op::Floor if a.low().floor() == a.high().floor() => {
                Local::straight(number(a.low().floor()), [0.0, 0.0])
            }
            Op::Floor => Local::jumping(Span::new(a.low().floor(), a.high().floor())),
            Op::Fract if a.low().floor() == a.high().floor() => {
                Local::straight(a.minus(number(a.low().floor())), [1.0, 0.0])
            }
            Op::Fract => Local::jumping(Span::new(0.0, 1.0)),
            Op::Sign if a.low() > 0.0 => Local::straight(Span::ONE, [0.0, 0.0]),
            Op::Sign if a.high() < 0.0 => Local::straight(number(-1.0), [0.0, 0.0]),
            Op::Sign if a.low() == 0.0 && a.high() == 0.0 => Local::straight(a, [0.0, 0.0]),
            Op::Sign => Local::jumping(Span::new(-1.0, 1.0)),
            Op::Mad | Op::Lerp | Op::Select => return None,
        };
        Some(local.of_defined(op, a, b))
    }

    /// Carries over that an argument may be undefined.
    fn of_defined(mut self, op: Op, a: Span, b: Span) -> Local {
        let undefined = a.may_be_undefined() || (op.arity() > 1 && b.may_be_undefined());
        self.value = self.value.or_undefined_if(undefined);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eval::{Arithmetic, Double};

    /// Corners of boxes that meet every case: signs, ends of domains, kinks, several turns.
    const ENDS: [f64; 9] = [-4.5, -1.25, -1.0, -0.25, 0.0, 0.125, 0.75, 1.0, 3.75];

    /// Where operations of one argument end, bend or jump.
    const EDGES: [f64; 3] = [-1.0, 0.0, 1.0];

    fn spans() -> Vec<Span> {
        let from = |i: usize| ENDS[i..].iter().map(move |&high| Span::new(ENDS[i], high));
        (0..ENDS.len()).flat_map(from).collect()
    }

    fn members(span: Span) -> [f64; 3] {
        [0.125, 0.4375, 0.875].map(|share| span.low() + share * span.width().next_down())
    }

    /// Whether a span holds a value that finite differences give, whose error grows with its size.
    fn holds(span: Span, x: f64, doubt: f64) -> bool {
        let doubt = doubt * (1.0 + x.abs());
        !x.is_finite() || (span.low() - doubt <= x && x <= span.high() + doubt)
    }

    /// Returns what is not within its span.
    fn problem(op: Op, [a, b]: [Span; 2], [x, y]: [f64; 2]) -> Option<String> {
        let Local { value, slopes, curvatures } = Local::of(op, a, b, false)?;
        let f = |x: f64, y: f64| Double.apply(op, [x, y, 0.0, 0.0]);
        let place = format!("{op} at ({x}, {y}) in {a:?}, {b:?}");
        let z = f(x, y);
        if !(if z.is_nan() { value.may_be_undefined() } else { holds(value, z, 1e-15) }) {
            return Some(format!("{place}: {z} in {value:?}"));
        }
        let (h, two) = (1e-4, op.arity() > 1);
        // A single point where differences cross an end, a kink or a pole shows nothing.
        let inside = |span: Span, x: f64| span.contains(x - h) && span.contains(x + h);
        let single = |span: Span, x: f64| span.width() < 1e-9 && !EDGES.contains(&x);
        let usable = |span: Span, x: f64| inside(span, x) || single(span, x);
        if !usable(a, x) || two && (!usable(b, y) || op.is_piecewise() && (x - y).abs() < 2.0 * h) {
            return None;
        }
        let across = |dx: f64, dy: f64| f(x + dx * h, y + dy * h);
        let slope = |dx: f64, dy: f64| (across(dx, dy) - across(-dx, -dy)) / (2.0 * h);
        let bend = |dx: f64, dy: f64| (across(dx, dy) - 2.0 * z + across(-dx, -dy)) / (h * h);
        let even = across(1.0, 1.0) + across(-1.0, -1.0);
        let twist = (even - across(1.0, -1.0) - across(-1.0, 1.0)) / (4.0 * h * h);
        let checks = [
            (slopes[0], slope(1.0, 0.0), 1e-5),
            (curvatures[0], bend(1.0, 0.0), 1e-4),
            (slopes[1], slope(0.0, 1.0), 1e-5),
            (curvatures[1], twist, 1e-4),
            (curvatures[2], bend(0.0, 1.0), 1e-4),
        ];
        let mut checks = checks.into_iter().take(if two { 5 } else { 2 });
        let wrong = checks.position(|(span, x, doubt)| !holds(span, x, doubt))?;
        Some(format!("{place}: check {wrong} of {slopes:?}, {curvatures:?}"))
    }

    #[test]
    fn values_slopes_and_curvatures_are_within_their_spans() {
        let mut problems = Vec::new();
        for &op in Op::ALL {
            for a in spans() {
                for b in if op.arity() > 1 { spans() } else { vec![Span::ONE] } {
                    for x in members(a) {
                        let found = members(b).map(|y| problem(op, [a, b], [x, y]));
                        problems.extend(found.into_iter().flatten());
                    }
                }
            }
        }
        problems.dedup_by_key(|problem| problem[..4].to_owned());
        assert!(problems.is_empty(), "{}", problems.join("\n"));
    }

    /// Narrow spans have narrow images, or bounds would be true and worthless.
    #[test]
    fn narrow_spans_have_narrow_images() {
        let near = |x: f64| Span::new(x, x + 1e-6);
        for &op in Op::ALL {
            let Some(local) = Local::of(op, near(0.3), near(0.6), false) else { continue };
            let [by_a, by_b] = local.slopes;
            for span in [local.value, by_a, by_b].into_iter().chain(local.curvatures) {
                assert!(span.width() < 1e-3, "{op}: {local:?}");
            }
        }
    }
}
