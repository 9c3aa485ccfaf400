//! Sums without lost digits.

use std::ops::AddAssign;

/// A sum that also carries what rounding lost, so that its error does not grow with the number of
/// terms (Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen",
/// 1974).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompensatedSum {
    sum: f64,
    lost: f64,
}

impl CompensatedSum {
    /// Returns the sum.
    pub fn value(self) -> f64 {
        // After an overflow `lost` is NaN.
        if self.sum.is_finite() { self.sum + self.lost } else { self.sum }
    }
}

impl AddAssign<f64> for CompensatedSum {
    fn add_assign(&mut self, term: f64) {
        let sum = self.sum + term;
        let (large, small) = match self.sum.abs() >= term.abs() {
            true => (self.sum, term),
            false => (term, self.sum),
        };
        self.lost += (large - sum) + small;
        self.sum = sum;
    }
}

impl FromIterator<f64> for CompensatedSum {
    fn from_iter<T: IntoIterator<Item = f64>>(terms: T) -> CompensatedSum {
        let mut sum = CompensatedSum::default();
        terms.into_iter().for_each(|term| sum += term);
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::CompensatedSum;

    fn sum(terms: impl IntoIterator<Item = f64>) -> f64 {
        terms.into_iter().collect::<CompensatedSum>().value()
    }

    #[test]
    fn keeps_what_rounding_loses() {
        assert_eq!(sum([1.0, 1e100, 1.0, -1e100]), 2.0);
        assert_eq!(sum((0..10_000_000).map(|_| 0.1)), 1_000_000.0);
        assert_eq!(sum([]), 0.0);
    }

    #[test]
    fn what_is_not_finite_stays_so() {
        assert_eq!(sum([1.0, f64::INFINITY, 1.0]), f64::INFINITY);
        assert_eq!(sum([f64::MAX, f64::MAX]), f64::INFINITY);
        assert!(sum([f64::INFINITY, f64::NEG_INFINITY]).is_nan());
    }
}
