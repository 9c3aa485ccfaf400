//! Bounds a formula's distance from the truth over one box.

use super::jet::{Jet, Jets, Order, curvature};
use super::rounded::{Rounded, RoundedValues, span};
use crate::num::{Interval, Span};
use crate::program::Program;
use crate::stability::Rounding;

/// The most inputs for which curvatures are worth their number. Chosen by hand, unmeasured.
const CURVED: usize = 8;

/// What the few additions of a bound in `f64` may lose, relative to the sum of magnitudes.
const LOSS: f64 = 1e-14;

/// A formula, the truth, and room to evaluate both.
#[derive(Clone, Debug)]
pub(super) struct Distance<'a> {
    formula: &'a Program,
    constants: Vec<f64>,
    truth: &'a Program,
    truth_constants: &'a [f64],
    output: usize,
    rounded: RoundedValues,
    point: Jets,
    ends: Jets,
    whole: Jets,
}

/// The bounds over one box.
#[derive(Clone, Debug)]
pub(super) struct Estimate {
    /// The largest error that may occur, rounding included; infinite if none is known.
    pub most: f64,
    /// How much a side's width adds to that, in no unit; infinite if no bound is known for it.
    pub by_side: Vec<f64>,
    /// True if the truth may have no value.
    pub of_no_value: bool,
}

/// What is known at one input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sampled {
    /// The interpreter's value.
    pub value: f32,
    /// The error is at least this; infinite if the value is no number but the truth is one.
    pub error: f64,
    /// No bound on the error is smaller: the distance in real numbers plus all that rounding may do.
    pub reach: f64,
}

impl<'a> Distance<'a> {
    pub fn new(
        formula: &'a Program,
        (truth, truth_constants): (&'a Program, &'a [f64]),
        output: usize,
        rounding: Rounding,
    ) -> Distance<'a> {
        let inputs = formula.inputs;
        let order = if inputs <= CURVED { Order::Curvatures } else { Order::Slopes };
        Distance {
            formula,
            constants: formula.consts.iter().map(|&c| f64::from(c)).collect(),
            truth,
            truth_constants,
            output,
            rounded: RoundedValues::new(rounding),
            point: Jets::new(inputs, Order::Value),
            ends: Jets::new(inputs, Order::Slopes),
            whole: Jets::new(inputs, order),
        }
    }

    /// Bounds the error over a box.
    pub fn over(&mut self, domain: &[Interval]) -> Estimate {
        let sides: Vec<Span> = domain.iter().map(|&side| span(side)).collect();
        let middle: Vec<Span> = sides.iter().map(|side| Span::point(side.middle())).collect();
        let offsets: Vec<Span> =
            sides.iter().zip(&middle).map(|(side, middle)| side.minus(*middle)).collect();
        let rounded = self.rounded.evaluate(self.formula, domain, self.output);
        let (whole, of_no_value) = self.difference(|distance| &mut distance.whole, &sides);
        let (center, _) = self.difference(|distance| &mut distance.ends, &middle);
        let reaches: Vec<f64> = offsets.iter().map(|offset| offset.most()).collect();
        let mut bounds = whole[0].narrowed(by_slopes(&center, &whole, &offsets));
        if whole.len() > 1 + sides.len() {
            bounds = bounds.narrowed(by_curvatures(&center, &whole, &reaches));
        }
        let undefined = rounded.may_be_undefined() || whole[0].may_be_undefined();
        let most = if undefined { f64::INFINITY } else { sum(bounds.most(), &rounded) };
        Estimate { most, by_side: by_side(&whole, &reaches), of_no_value }
    }

    /// Returns what is known at one input; none where the truth has no value.
    pub fn at(&mut self, input: &[f32]) -> Option<Sampled> {
        let point: Vec<Span> = input.iter().map(|&x| Span::point(x.into())).collect();
        let truth = self.point.evaluate(self.truth, self.truth_constants, &point, self.output);
        let truth = truth[0];
        if truth.may_be_undefined() || !truth.is_bounded() {
            return None;
        }
        let value = self.formula.evaluate(input)[self.output];
        let error = match value.is_finite() {
            true => Span::point(value.into()).minus(truth).least(),
            false => f64::INFINITY,
        };
        Some(Sampled { value, error, reach: error })
    }

    /// Returns what is known at one input, with the reach of the rounding.
    pub fn reach_at(&mut self, input: &[f32]) -> Option<Sampled> {
        let sampled = self.at(input)?;
        let point: Vec<Span> = input.iter().map(|&x| Span::point(x.into())).collect();
        let domain: Vec<Interval> = input.iter().map(|&x| Interval::new(x, x)).collect();
        let exact = self.difference(|distance| &mut distance.point, &point).0[0];
        let rounded = self.rounded.evaluate(self.formula, &domain, self.output);
        Some(Sampled { reach: sum(exact.least(), &rounded).max(sampled.error), ..sampled })
    }

    /// Returns the jet of the formula, in real numbers, less the truth; and whether that may have
    /// no value.
    fn difference(
        &mut self,
        jets: impl Fn(&mut Self) -> &mut Jets,
        domain: &[Span],
    ) -> (Jet, bool) {
        let (formula, truth, output) = (self.formula, self.truth, self.output);
        let truth_constants = self.truth_constants;
        let constants = std::mem::take(&mut self.constants);
        let jets = jets(self);
        let of_truth = jets.evaluate(truth, truth_constants, domain, output);
        let mut jet = jets.evaluate(formula, &constants, domain, output);
        self.constants = constants;
        let of_no_value = of_truth[0].may_be_undefined();
        jet.iter_mut().zip(of_truth).for_each(|(to, truth)| *to = to.minus(truth));
        (jet, of_no_value)
    }
}

fn sum(exact: f64, rounded: &Rounded) -> f64 {
    let sum = exact + rounded.error;
    if sum.is_nan() || rounded.computed.is_empty() { f64::INFINITY } else { sum.next_up() }
}

/// Bounds values by the mean-value theorem: that at the centre, and slopes times offsets.
fn by_slopes(center: &[Span], whole: &[Span], offsets: &[Span]) -> Span {
    let parts = whole[1..].iter().zip(offsets);
    parts.fold(center[0], |sum, (slope, offset)| sum.plus(slope.times(*offset)))
}

/// Bounds values by Taylor's theorem of second order about the centre.
fn by_curvatures(center: &[Span], whole: &[Span], reaches: &[f64]) -> Span {
    let n = reaches.len();
    let (mut above, mut below, mut size) = (0.0, 0.0, 0.0);
    for i in 0..n {
        let (slope, bend) = (center[1 + i].most(), whole[curvature(n, i, i)]);
        above += parabola(slope, bend.high(), reaches[i]);
        below += parabola(slope, -bend.low(), reaches[i]);
        size += slope * reaches[i] + bend.most() * reaches[i] * reaches[i];
        for j in i + 1..n {
            let twist = whole[curvature(n, i, j)];
            let part =
                if twist == Span::ZERO { 0.0 } else { twist.most() * reaches[i] * reaches[j] };
            (above, below, size) = (above + part, below + part, size + part);
        }
    }
    let loss = size * LOSS;
    match (above + below + loss).is_finite() {
        true => center[0].plus(Span::new(-(below + loss), above + loss)),
        false => Span::ALL,
    }
}

/// Returns the largest `slope·t + bend·t²/2` for `t` up to `reach`.
fn parabola(slope: f64, bend: f64, reach: f64) -> f64 {
    if reach == 0.0 {
        return 0.0;
    }
    if bend < 0.0 && slope < -bend * reach {
        return slope * slope / (-2.0 * bend);
    }
    slope * reach + bend * reach * reach / 2.0
}

/// Returns how much each side's width adds to the bounds.
fn by_side(whole: &[Span], reaches: &[f64]) -> Vec<f64> {
    let n = reaches.len();
    let by_slope = |i: usize| {
        let slope = whole[1 + i];
        if slope == Span::ZERO || reaches[i] == 0.0 { 0.0 } else { slope.width() * reaches[i] }
    };
    if whole.len() == 1 + n {
        return (0..n).map(by_slope).collect();
    }
    let by_curvature = |i: usize| -> f64 {
        let parts = (0..n).map(|j| {
            let bend = whole[curvature(n, i.min(j), i.max(j))];
            let product = reaches[i] * reaches[j];
            if bend == Span::ZERO || product == 0.0 { 0.0 } else { bend.most() * product }
        });
        parts.sum()
    };
    (0..n).map(|i| by_curvature(i).min(by_slope(i))).collect()
}
