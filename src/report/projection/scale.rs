//! Scales: where values lie between two ends, linearly or by their logarithms.

use crate::report::maps::end_text;

/// Two ends, and how values lie between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub ends: [f32; 2],
    pub logarithmic: bool,
}

/// The ratios of a parameter's ends between which its scale is logarithmic: below, a linear one
/// shows as much; above, the least value is a zero but for rounding. By hand.
const RATIOS: [f32; 2] = [100.0, 1e6];

/// The ratio of an axis' ends from which on its spacing is looked at. By hand.
const WIDE: f32 = 8.0;

/// The least error that is told apart, as a share of the greatest shown. By hand: the rounding of
/// f32.
const NOTHING: f32 = 1e-8;

impl Scale {
    /// Returns the scale of a parameter's values.
    pub fn of_values(values: impl Iterator<Item = f32>) -> Scale {
        let ends = range(values);
        let ratio = ends[1] / ends[0];
        let logarithmic = ends[0] > 0.0 && (RATIOS[0]..RATIOS[1]).contains(&ratio);
        Scale { ends, logarithmic }
    }

    /// Returns the scale of ascending places along an axis, as they are spaced.
    pub fn along(places: &[f32]) -> Scale {
        let ends = [places[0], places[places.len() - 1]];
        let middle = places[places.len() / 2];
        let [low, high] = ends;
        let is_by_ratios = low > 0.0
            && high > WIDE * low
            && places.len() > 2
            && (middle / (low * high).sqrt()).ln().abs()
                < (middle / (0.5 * (low + high))).ln().abs();
        Scale { ends, logarithmic: is_by_ratios }
    }

    /// Returns the scale of errors, logarithmic, of which those above `most` are as `most`.
    pub fn of_errors(errors: &[f32], most: f32) -> Scale {
        let [least, greatest] = range(errors.iter().copied());
        let high = greatest.min(most.max(1e3 * least)).max(f32::MIN_POSITIVE);
        Scale { ends: [least.max(NOTHING * high), high], logarithmic: true }
    }

    /// Returns a value's place from 0 to 1; not finite where the value is not.
    pub fn place(&self, value: f32) -> f32 {
        if !value.is_finite() {
            return f32::NAN;
        }
        let [low, high] = self.ends.map(|end| self.position(end));
        let place = (self.position(value.clamp(self.ends[0], self.ends[1])) - low) / (high - low);
        if high > low { place as f32 } else { 0.5 }
    }

    fn position(&self, value: f32) -> f64 {
        let value = f64::from(value);
        if self.logarithmic { value.ln() } else { value }
    }

    /// Returns the ends in words; of an end that is nothing beside the other, zero.
    pub fn texts(&self) -> [String; 2] {
        let [low, high] = self.ends;
        let nothing = if self.logarithmic { 0.0 } else { 1e-3 * (high - low) };
        self.ends.map(|end| end_text(if end.abs() < nothing { 0.0 } else { end }))
    }

    /// Returns the ends in words, the second with the kind of scale.
    pub fn bar_texts(&self) -> [String; 2] {
        let [low, high] = self.texts();
        [low, format!("{high}{}", self.how())]
    }

    fn how(&self) -> &'static str {
        if self.logarithmic { " (log)" } else { "" }
    }

    /// Returns the name of an axis with its ends.
    pub fn label(&self, name: &str) -> String {
        let [low, high] = self.texts();
        format!("{name} {low}…{high}{}", self.how())
    }
}

/// Returns the range of the values that are finite; zeros if none is.
fn range(values: impl Iterator<Item = f32>) -> [f32; 2] {
    let finite = values.filter(|value| value.is_finite());
    let [low, high] = finite.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    if low <= high { [low, high] } else { [0.0, 0.0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_lie_as_they_are_spaced() {
        let linear = Scale::along(&[0.1, 0.4, 0.7, 1.0]);
        assert!(!linear.logarithmic && (linear.place(0.4) - 1.0 / 3.0).abs() < 1e-6);
        let by_ratios = Scale::along(&[0.01, 0.1, 1.0]);
        assert!(by_ratios.logarithmic && (by_ratios.place(0.1) - 0.5).abs() < 1e-6);
        assert_eq!(by_ratios.label("alpha"), "alpha 0.01…1 (log)");
        assert!(!Scale::along(&[-1.0, 0.0, 9.0]).logarithmic);
        assert!(!Scale::along(&[0.01, 1.0]).logarithmic);
    }

    #[test]
    fn values_of_some_decades_are_on_a_logarithmic_scale() {
        let scale = |values: &[f32]| Scale::of_values(values.iter().copied());
        assert!(scale(&[0.3, 3000.0]).logarithmic);
        assert!(!scale(&[0.3, 3.0]).logarithmic && !scale(&[-0.3, 3000.0]).logarithmic);
        let rounding = scale(&[1e-8, 237.0, f32::NAN]);
        assert!(!rounding.logarithmic);
        assert_eq!(rounding.texts(), ["0", "237"]);
        assert!(rounding.place(f32::NAN).is_nan());
        assert_eq!(scale(&[2.0, 2.0]).place(2.0), 0.5);
        assert_eq!(scale(&[]).ends, [0.0, 0.0]);
    }

    #[test]
    fn errors_end_where_nobody_looks() {
        let scale = Scale::of_errors(&[0.1, 1e20, f32::INFINITY], 2.0);
        assert_eq!(scale.ends, [0.1, 100.0]);
        assert_eq!((scale.place(1e20), scale.place(0.1)), (1.0, 0.0));
        assert_eq!(Scale::of_errors(&[0.0, 1.0], 2.0).ends, [NOTHING, 1.0]);
    }
}
