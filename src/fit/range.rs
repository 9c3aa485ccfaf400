//! The ranges within which minima are searched for.

/// The scale on which a parameter is searched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences count alike.
    #[default]
    Linear,
    /// Equal ratios count alike; for positive values alone.
    Logarithmic,
}

/// The reason why two bounds are no range.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RangeError {
    /// The lower bound is above the upper one, or one is NaN.
    #[error("{low} to {high} is no range: give a lower bound, then an upper one")]
    OutOfOrder {
        /// The lower bound as given.
        low: f64,
        /// The upper bound as given.
        high: f64,
    },
    /// A logarithm would not be finite.
    #[error(
        "{low} to {high} has no logarithmic scale: give two positive bounds, or keep to a linear scale"
    )]
    NotPositive {
        /// The lower bound as given.
        low: f64,
        /// The upper bound as given.
        high: f64,
    },
    /// Points cannot be drawn from all of the range.
    #[error("{low} to {high} has no end: a global search needs two finite bounds")]
    Infinite {
        /// The lower bound as given.
        low: f64,
        /// The upper bound as given.
        high: f64,
    },
}

/// The range of one coordinate, and the scale on which it is searched.
///
/// ```
/// use lgp::fit::{Range, RangeError, Scale};
///
/// assert!(Range::new(1e-3, 1e3, Scale::Logarithmic).is_ok());
/// let refused = Range::new(0.0, 1.0, Scale::Logarithmic);
/// assert_eq!(refused, Err(RangeError::NotPositive { low: 0.0, high: 1.0 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    bounds: [f64; 2],
    /// The bounds as positions on the scale.
    ends: [f64; 2],
    scale: Scale,
}

impl Range {
    /// The range without bounds.
    pub const ANY: Range = Range {
        bounds: [f64::NEG_INFINITY, f64::INFINITY],
        ends: [f64::NEG_INFINITY, f64::INFINITY],
        scale: Scale::Linear,
    };

    /// Makes a range. On a linear scale either bound may be infinite; on a logarithmic one both are
    /// positive and finite.
    pub fn new(low: f64, high: f64, scale: Scale) -> Result<Range, RangeError> {
        let is_ordered = low <= high && low < f64::INFINITY && high > f64::NEG_INFINITY;
        if !is_ordered {
            return Err(RangeError::OutOfOrder { low, high });
        }
        let ends = match scale {
            Scale::Linear => [low, high],
            Scale::Logarithmic if low > 0.0 && high.is_finite() => [low.ln(), high.ln()],
            Scale::Logarithmic => return Err(RangeError::NotPositive { low, high }),
        };
        Ok(Range { bounds: [low, high], ends, scale })
    }

    /// Returns the lower and the upper bound.
    pub fn bounds(&self) -> [f64; 2] {
        self.bounds
    }

    /// Returns an error if points cannot be drawn from all of the range.
    pub(super) fn check_finite(&self) -> Result<(), RangeError> {
        let [low, high] = self.bounds;
        match self.width().is_finite() {
            true => Ok(()),
            false => Err(RangeError::Infinite { low, high }),
        }
    }

    /// Returns a value's position on the scale.
    pub(super) fn position(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => value,
            Scale::Logarithmic => value.ln(),
        }
        .clamp(self.ends[0], self.ends[1])
    }

    /// Returns the value at a position; beyond an end, the bound itself.
    pub(super) fn value(&self, position: f64) -> f64 {
        let ([low, high], [first, last]) = (self.bounds, self.ends);
        if position <= first {
            return low;
        }
        if position >= last {
            return high;
        }
        match self.scale {
            Scale::Linear => position,
            Scale::Logarithmic => position.exp().clamp(low, high),
        }
    }

    /// Returns the position at a share of the width.
    pub(super) fn at(&self, share: f64) -> f64 {
        (self.ends[0] + self.width() * share).clamp(self.ends[0], self.ends[1])
    }

    pub(super) fn contains(&self, position: f64) -> bool {
        (self.ends[0]..=self.ends[1]).contains(&position)
    }

    pub(super) fn clamp(&self, position: f64) -> f64 {
        position.clamp(self.ends[0], self.ends[1])
    }

    /// Returns the distance of the ends on the scale.
    pub(super) fn width(&self) -> f64 {
        self.ends[1] - self.ends[0]
    }

    /// Returns the first step of a local search from a position: a share of the width, or, where
    /// that is infinite, of the position itself, or of 1 at 0.
    pub(super) fn step(&self, position: f64, share: f64) -> f64 {
        match self.width().is_finite() {
            true => self.width() * share,
            false if position == 0.0 => share,
            false => position.abs() * share,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_range_is_refused() {
        let (nan, infinity) = (f64::NAN, f64::INFINITY);
        for (low, high) in [(1.0, 0.0), (nan, 1.0), (0.0, nan), (infinity, infinity)] {
            let refused = Range::new(low, high, Scale::Linear).unwrap_err();
            assert!(matches!(refused, RangeError::OutOfOrder { .. }), "{low} {high}: {refused}");
        }
        for (low, high) in [(0.0, 1.0), (-1.0, 1.0), (1.0, infinity), (-infinity, infinity)] {
            let refused = Range::new(low, high, Scale::Logarithmic).unwrap_err();
            assert_eq!(refused, RangeError::NotPositive { low, high });
            assert!(refused.to_string().contains("two positive bounds"), "{refused}");
        }
        let half = Range::new(0.0, infinity, Scale::Linear).unwrap();
        let refused = half.check_finite().unwrap_err();
        assert!(refused.to_string().contains("two finite bounds"), "{refused}");
    }

    #[test]
    fn equal_ratios_are_equally_far_on_a_logarithmic_scale() {
        let range = Range::new(1e-3, 1e3, Scale::Logarithmic).unwrap();
        assert!((range.value(range.at(0.5)) - 1.0).abs() < 1e-12);
        let linear = Range::new(1e-3, 1e3, Scale::Linear).unwrap();
        assert!((linear.value(linear.at(0.5)) - 500.0).abs() < 1.0);
    }

    #[test]
    fn the_ends_are_the_bounds_to_the_bit() {
        for scale in [Scale::Linear, Scale::Logarithmic] {
            let range = Range::new(0.1, 7.3, scale).unwrap();
            assert_eq!([range.value(range.at(0.0)), range.value(range.at(1.0))], [0.1, 7.3]);
            assert_eq!([range.value(-99.0), range.value(99.0)], [0.1, 7.3]);
            assert_eq!(range.value(range.position(99.0)), 7.3);
        }
    }
}
