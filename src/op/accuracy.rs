//! States how far an operation's results may be off.

/// The accuracy of an operation's results.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Accuracy {
    /// No error: a choice among arguments, a sign, a whole number.
    Exact,
    /// The errors of the operations that it is made of, one after the other, and none of its own.
    InSteps,
    /// An error of its own.
    Within(Tolerance),
}

/// An error that grows with the result, and with the argument, plus an absolute one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Units in the last place of the result.
    pub ulps: f64,
    /// More units in the last place for each unit of the first argument's magnitude,
    pub ulps_per_unit: f64,
    /// up to this magnitude.
    pub most_units: f64,
    /// An absolute error, in the result's unit.
    pub absolute: f64,
    /// The first arguments for which the absolute error is added.
    pub absolute_within: [f32; 2],
    /// The largest magnitude of the first argument for which any of this holds.
    pub up_to: f32,
}

impl Tolerance {
    pub(super) const fn of_ulps(ulps: f64) -> Tolerance {
        Tolerance {
            ulps,
            ulps_per_unit: 0.0,
            most_units: 0.0,
            absolute: 0.0,
            absolute_within: [f32::NEG_INFINITY, f32::INFINITY],
            up_to: f32::INFINITY,
        }
    }

    pub(super) const fn of_size(absolute: f64) -> Tolerance {
        Tolerance { absolute, ..Tolerance::of_ulps(0.0) }
    }

    /// Returns the units in the last place for first arguments up to a magnitude.
    pub fn ulps_up_to(&self, magnitude: f64) -> f64 {
        self.ulps + self.ulps_per_unit * magnitude.min(self.most_units)
    }

    /// Returns the absolute error for first arguments from `low` to `high`.
    pub fn absolute_between(&self, low: f32, high: f32) -> f64 {
        let [first, last] = self.absolute_within;
        if low > last || high < first { 0.0 } else { self.absolute }
    }
}

impl Accuracy {
    /// Returns the most floating-point numbers between the result and those nearest to the exact
    /// value.
    pub const fn steps(self) -> u32 {
        match self {
            Accuracy::Exact | Accuracy::InSteps => 0,
            Accuracy::Within(tolerance) => tolerance.ulps as u32,
        }
    }

    /// Returns the largest magnitude of the first argument for which this holds.
    pub const fn up_to(self) -> f32 {
        match self {
            Accuracy::Exact | Accuracy::InSteps => f32::INFINITY,
            Accuracy::Within(tolerance) => tolerance.up_to,
        }
    }
}

// Short names for the table's rows.
pub(super) const EXACT: Accuracy = Accuracy::Exact;
pub(super) const IN_STEPS: Accuracy = Accuracy::InSteps;

pub(super) const fn within(tolerance: Tolerance) -> Accuracy {
    Accuracy::Within(tolerance)
}

pub(super) const fn within_ulps(ulps: f64) -> Accuracy {
    within(Tolerance::of_ulps(ulps))
}
