//! The GGX lobe by angle, and integrals over angles with features of any size.

use crate::quadrature::{Estimate, TanhSinh};
use std::f64::consts::FRAC_PI_2;

/// D of GGX at `angle` from the normal over its peak, D(0) = 1/(π α²): (cos² + sin²/α²)⁻². It takes
/// the angle, since 1 - n·h loses it where the lobe is narrow. `alpha` > 0.
pub(super) fn ggx(angle: f64, alpha: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let stretched = sin / alpha;
    (cos * cos + stretched * stretched).powi(-2)
}

/// Relative to the size of the integrand: about its rounding.
const TOLERANCE: f64 = 1e-12;

/// Integrates over an angle from 0 to π/2 an integrand ≥ 0 that changes its character near each of
/// `scales` (those outside the range are ignored): by the double-exponential rule between each two,
/// in the logarithm of the angle, so that scales of any ratio are resolved.
pub(super) fn integrate_angle(rule: &TanhSinh, scales: &[f64], f: impl Fn(f64) -> f64) -> Estimate {
    let inside = scales.iter().copied().filter(|scale| (1e-300..FRAC_PI_2).contains(scale));
    let mut ends: Vec<f64> = inside.chain([FRAC_PI_2]).collect();
    ends.sort_by(f64::total_cmp);
    let size = ends.iter().map(|&end| end * f(end)).fold(0.0, f64::max);
    let tolerance = TOLERANCE * size.max(f64::MIN_POSITIVE);
    let mut total = rule.integrate(0.0, ends[0], tolerance, |at| f(at.x));
    for pair in ends.windows(2) {
        let (from, to) = (pair[0].ln(), pair[1].ln());
        let piece = rule.integrate(from, to, tolerance, |at| {
            let angle = at.x.exp();
            angle * f(angle)
        });
        total.value += piece.value;
        total.error += piece.error;
        total.evaluations += piece.evaluations;
    }
    total
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::microfacet::ggx::distribution;
    use std::f64::consts::PI;

    #[test]
    fn is_the_distribution_over_its_peak() {
        for alpha in [0.01, 0.2, 0.7, 1.0] {
            for angle in [0.0, 0.01, 0.3, 1.0, 1.5] {
                let expected = distribution(f64::cos(angle), alpha) * PI * alpha * alpha;
                assert!((ggx(angle, alpha) / expected - 1.0).abs() < 1e-9, "{angle} {alpha}");
            }
        }
    }

    #[test]
    fn lobes_of_any_width_are_normalised() {
        // 2π ∫ D cosθ sinθ dθ = 1
        let rule = TanhSinh::new();
        for alpha in [1e-12, 1e-6, 1e-3, 0.1, 1.0] {
            let found = integrate_angle(&rule, &[alpha], |angle| {
                2.0 / (alpha * alpha) * ggx(angle, alpha) * angle.cos() * angle.sin()
            });
            assert!((found.value - 1.0).abs() < 1e-10, "{alpha}: {found:?}");
            assert!(found.error < 1e-10, "{alpha}: {found:?}");
        }
    }
}
