//! Means over the normals of GGX facets: what directional albedos are.
//!
//! A normal at θ from n is drawn with `u = t²/(1 + t²)`, `t = tan θ / α` (Walter et al., "Microfacet
//! Models for Refraction through Rough Surfaces", 2007, eqs. 35 and 36). u is carried with its
//! complement, which keeps the far tail of a narrow lobe.

use crate::quadrature::{Abscissa, TanhSinh};
use std::f64::consts::PI;

/// A normal's sample coordinate u and 1 - u, each to full relative precision.
#[derive(Clone, Copy)]
pub(super) struct Normal {
    u: f64,
    complement: f64,
}

impl Normal {
    /// n itself.
    pub(super) const MACROSCOPIC: Normal = Normal { u: 0.0, complement: 1.0 };
    /// At a right angle to n.
    pub(super) const HORIZONTAL: Normal = Normal { u: 1.0, complement: 0.0 };

    /// The normal at `theta` < π/2 from n.
    pub(super) fn at_angle(theta: f64, alpha: f64) -> Normal {
        let t = theta.tan() / alpha;
        let complement = 1.0 / (1.0 + t * t);
        Normal { u: t * t * complement, complement }
    }

    /// Cosine and sine of the angle from n.
    pub(super) fn direction(self, alpha: f64) -> (f64, f64) {
        let lifted = alpha * alpha * self.u;
        let norm = self.complement + lifted;
        ((self.complement / norm).sqrt(), (lifted / norm).sqrt())
    }
}

/// Returns the azimuth from v, in [0, π], up to which facets reflect v to above the horizon, for the
/// cosine and the sine of v and of the facet's normal from n.
pub(super) fn reflected_azimuths([cosine, sine]: [f64; 2], [n_dot_h, sin_h]: [f64; 2]) -> f64 {
    let horizon = -cosine * (n_dot_h - sin_h) * (n_dot_h + sin_h);
    let reach = 2.0 * n_dot_h * sin_h * sine;
    if horizon <= -reach { PI } else { (horizon / reach).min(1.0).acos() }
}

/// Integrates over u between two normals what `ring` returns at each: two means over azimuth, and the
/// error of either. Returns the same.
pub(super) fn mean(
    rule: &TanhSinh,
    tolerance: f64,
    from: Normal,
    to: Normal,
    ring: impl Fn(Normal) -> [f64; 3],
) -> [f64; 3] {
    // The range as the difference that loses no digits.
    let width = if from.u < 0.5 { to.u - from.u } else { from.complement - to.complement };
    if width <= 0.0 {
        return [0.0; 3];
    }
    let at = |at: Abscissa| {
        ring(Normal { u: from.u + at.from_a, complement: to.complement + at.from_b })
    };
    let [first, second, inner] = rule.integrate_all(0.0, width, tolerance, at);
    [first.value, second.value, first.error.max(second.error) + inner.value.abs()]
}
