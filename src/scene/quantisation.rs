//! Quantisation: errors that a display's steps hide.

use super::Error;
use crate::eval::{Arithmetic, Double};
use crate::program::{Names, Program, parse};
use serde::{Deserialize, Serialize};

/// The target's steps; an error below half a step does not count.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantisation {
    /// The bits of the target, 1 to 16: it holds 2^bits values from 0 to 1.
    pub bits: u32,
    /// The value that is stored of an output `y`, as in `y/(1 + y)`; empty for `y` itself.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub tone_map: String,
}

/// The bits that a target may have. Chosen by hand, unmeasured.
const BITS: std::ops::RangeInclusive<u32> = 1..=16;

/// The step of a numerical derivative, as a share of the value, or of 1 if that is larger. Chosen
/// by hand, unmeasured.
const STEP: f64 = 1e-6;

impl Quantisation {
    /// Checks the bits and parses the tone map.
    pub(super) fn steps(&self, scene: &str) -> Result<Steps, Error> {
        let refuse = |problem: String| Error::Quantisation { scene: scene.to_owned(), problem };
        if !BITS.contains(&self.bits) {
            let (least, most) = (BITS.start(), BITS.end());
            return Err(refuse(format!("{} bits; give {least} to {most}", self.bits)));
        }
        let text = if self.tone_map.is_empty() { "y" } else { &self.tone_map };
        let program = parse(&format!("shown = {text}"), &Names::new(["y"], ["shown"]))
            .map_err(|error| refuse(format!("tone_map, over `y`: {error}")))?;
        Ok(Steps { half: 0.5 / f64::from((1u32 << self.bits) - 1), tone_map: program })
    }

    /// Returns the quantisation in words.
    pub(super) fn summary(&self) -> String {
        match self.tone_map.is_empty() {
            true => format!("errors below half a step of {} bits are free", self.bits),
            false => {
                format!(
                    "errors below half a step of {} bits of {} are free",
                    self.bits, self.tone_map
                )
            }
        }
    }
}

/// A quantisation, checked and ready to apply.
#[derive(Clone, Debug)]
pub(super) struct Steps {
    half: f64,
    tone_map: Program,
}

impl Steps {
    /// Returns the error of `y` that moves the stored value by half a step: half a step over the
    /// tone map's slope there. None if that is NaN.
    pub fn dead_zone(&self, y: f32) -> Option<f32> {
        let h = STEP * f64::from(y).abs().max(1.0);
        let shown = |at: f64| Double.evaluate(&self.tone_map, &[at])[0];
        let slope = (shown(f64::from(y) + h) - shown(f64::from(y) - h)) / (2.0 * h);
        let dead_zone = self.half / slope.abs();
        (!dead_zone.is_nan()).then(|| dead_zone.min(f32::MAX.into()) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_step_grows_where_the_tone_map_is_flat() {
        let steps = |bits, tone_map: &str| {
            Quantisation { bits, tone_map: tone_map.into() }.steps("s").unwrap()
        };
        let near = |found: Option<f32>, expected: f64| {
            let found = f64::from(found.unwrap());
            assert!((found / expected - 1.0).abs() < 1e-4, "{found} for {expected}");
        };
        near(steps(8, "").dead_zone(0.3), 0.5 / 255.0);
        // d/dy y/(1 + y) = 1/(1 + y)²
        near(steps(10, "y/(1 + y)").dead_zone(3.0), 16.0 * 0.5 / 1023.0);
        assert_eq!(steps(8, "saturate(y)").dead_zone(2.0), Some(f32::MAX));
        assert_eq!(steps(8, "sqrt(y)").dead_zone(-1.0), None);
        assert!(Quantisation { bits: 0, tone_map: String::new() }.steps("s").is_err());
        assert!(Quantisation { bits: 8, tone_map: "x".into() }.steps("s").is_err());
    }
}
