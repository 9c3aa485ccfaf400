//! The constants of a program that are fitted, and the bounds that they keep to.

use super::{Range, RangeError, Scale};
use serde::Serialize;

/// A constant to be fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// The index in the constant table.
    pub index: usize,
    /// The least and the greatest value; infinite if unbounded.
    pub bounds: [f32; 2],
    /// The scale on which starts are drawn and a global fit searches. A logarithmic one needs two
    /// positive, finite bounds.
    pub scale: Scale,
}

/// A bound that a fitted parameter lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Bound {
    /// The least value allowed.
    Lower,
    /// The greatest value allowed.
    Upper,
}

/// How far a parameter is searched globally where a bound is infinite: this many times its start or
/// its other bound, whichever is further from 0, or this far if both are 0. By hand, unmeasured.
const REACH: f32 = 10.0;

impl Parameter {
    /// Makes an unbounded parameter, on a linear scale.
    pub fn unbounded(index: usize) -> Parameter {
        let bounds = [f32::NEG_INFINITY, f32::INFINITY];
        Parameter { index, bounds, scale: Scale::Linear }
    }

    /// Returns the bound on which a value lies, if on any.
    pub fn bound(&self, value: f32) -> Option<Bound> {
        let [low, high] = self.bounds;
        match () {
            () if value == low => Some(Bound::Lower),
            () if value == high => Some(Bound::Upper),
            () => None,
        }
    }

    /// Returns the range that a global fit searches: the bounds, or, where one is infinite, ten
    /// times the start or the other bound, whichever is further from 0, of either sign; ten, if
    /// both are 0.
    ///
    /// Returns an error if the bounds are out of order, or not positive on a logarithmic scale.
    pub fn range(&self, start: f32) -> Result<Range, RangeError> {
        let given = self.bounds.map(f64::from);
        let [low, high] = self.bounds;
        Range::new(given[0], given[1], self.scale)?;
        let finite = self.bounds.into_iter().chain([start]).filter(|value| value.is_finite());
        let furthest = finite.map(f32::abs).fold(0.0, f32::max);
        let reach = if furthest == 0.0 { REACH } else { (REACH * furthest).min(f32::MAX) };
        let low = if low.is_finite() { low } else { -reach };
        let high = if high.is_finite() { high } else { reach };
        Range::new(low.into(), high.into(), self.scale)
    }

    /// Returns the nearest value within bounds.
    pub(super) fn nearest(&self, value: f64) -> f32 {
        let [low, high] = self.bounds;
        (value as f32).clamp(low, high)
    }

    pub(super) fn contains(&self, value: f32) -> bool {
        let [low, high] = self.bounds;
        (low..=high).contains(&value)
    }
}
