//! The directional albedo of a rough dielectric, glass for instance: the share of the light that one
//! scattering leaves, reflected and transmitted. What is missing to 1 is what energy compensation
//! returns (Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", 2017).
//!
//! Of radiance, what is transmitted counts by 1/η²: light that leaves the medium spreads, and its BSDF,
//! integrated without that factor, is what published tables hold.
//!
//! Definition: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, eqs. 20
//! and 21 times the cosine, integrated over the sphere, entering the medium, with separable Smith
//! masking (eq. 23) and exact Fresnel, `alpha = roughness²`. With normals drawn from the distribution,
//! facets reflect `F W(l)` and transmit `(1 - F) W(t)`, `W = G2 (v·h) / ((n·h) (n·v))`.
//!
//! Method: light that enters a denser medium is bent away from the surface, so every facet that v
//! sees transmits. It is seen at all azimuths up to θ = π/2 - θv, and at |φ| < acos(-cot θ cot θv)
//! beyond; reflected light is above the horizon as in [`dfg`](super::dfg). The double-exponential rule
//! integrates over each azimuth up to its limit, and over normals between all angles
//! where one of the limits begins or ends to fall.

use super::normals::{Normal, mean, reflected_azimuths};
use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Choices, Make, Parameter, Recipe, Target, points};
use crate::dataset::Axis;
use crate::microfacet::{fresnel, ggx};
use crate::quadrature::TanhSinh;
use std::f64::consts::{FRAC_PI_2, PI};

/// The largest estimated error that [`generate`](super::generate) accepts: about the rounding to f32.
pub const ALLOWED_ERROR: f64 = 1e-7;
/// A tenth of it, for each integral: the errors of nested integrals add up.
const TOLERANCE: f64 = 1e-8;
/// The reflectances at normal incidence of indices of refraction from 1.25 to 3, those of Sforza and
/// Pellacini, "Enforcing Energy Preservation in Microfacet Models", 2022.
const REFLECTANCES: [f64; 2] = [0.0125, 0.25];
/// Sampled instead of n·v = 0, where W is undefined.
const GRAZING: f64 = 0.001;
const POWER: &str = "power";
const RADIANCE: &str = "radiance";
const REFLECTED: &str = "reflected";

pub(super) const TARGET: Target = Target {
    name: "dielectric_albedo",
    description: "directional albedo of a rough dielectric, scattering once",
    columns: "f0, roughness, n_dot_v → albedo",
    parameters: &[
        Parameter {
            name: "of",
            description: "power; radiance, 1/η² of what is transmitted; or what is reflected alone",
            default: POWER,
            choices: Choices::OneOf(&[POWER, RADIANCE, REFLECTED]),
        },
        points("16", 64),
        SAMPLING,
        SAMPLING_SEED,
    ],
    make: Make::Table(table),
};

/// The two shares of the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Albedo {
    /// The share that is reflected.
    pub reflected: f64,
    /// The share that is transmitted.
    pub transmitted: f64,
    /// An estimate of the absolute error of either.
    pub error: f64,
}

/// Computes the albedo for an index of refraction `eta` > 1 over that in front of the surface,
/// `n_dot_v` in (0, 1] and `alpha` in [0, 1]; at alpha = 0, its limit. Make `rule` once for many
/// points.
pub fn integrate(rule: &TanhSinh, eta: f64, alpha: f64, n_dot_v: f64) -> Albedo {
    if alpha == 0.0 {
        let reflected = fresnel::dielectric(eta, n_dot_v);
        return Albedo { reflected, transmitted: 1.0 - reflected, error: 0.0 };
    }
    let sine = ((1.0 - n_dot_v) * (1.0 + n_dot_v)).sqrt();
    let surface = Surface { eta, alpha, cosine: n_dot_v, sine };
    let theta_v = sine.atan2(n_dot_v);
    let mut limits =
        [0.5 * (FRAC_PI_2 - theta_v), 0.5 * (FRAC_PI_2 + theta_v), FRAC_PI_2 - theta_v];
    limits.sort_by(f64::total_cmp);
    let limits = limits.map(|theta| Normal::at_angle(theta, alpha));
    let ends = [Normal::MACROSCOPIC, limits[0], limits[1], limits[2], Normal::HORIZONTAL];
    let over = |pair: &[Normal]| {
        mean(rule, TOLERANCE, pair[0], pair[1], |normal| surface.ring(rule, normal))
    };
    let parts = ends.windows(2).map(over);
    let [reflected, transmitted, error] =
        parts.fold([0.0; 3], |sum, part| std::array::from_fn(|term| sum[term] + part[term]));
    Albedo { reflected, transmitted, error }
}

/// A surface seen at an angle.
struct Surface {
    eta: f64,
    alpha: f64,
    cosine: f64,
    sine: f64,
}

impl Surface {
    /// Integrates over azimuth: the means of reflected and transmitted light, and the error of either.
    fn ring(&self, rule: &TanhSinh, normal: Normal) -> [f64; 3] {
        let (n_dot_h, sin_h) = normal.direction(self.alpha);
        let over = |phi_max, share: &dyn Fn(f64) -> f64| {
            let mean = rule.integrate(0.0, phi_max, TOLERANCE, |phi| {
                let v_dot_h = self.sine * sin_h * phi.x.cos() + self.cosine * n_dot_h;
                share(v_dot_h.clamp(0.0, 1.0))
            });
            [mean.value / PI, mean.error / PI]
        };
        let weight = |v_dot_h: f64, leaving: f64| {
            let g2 = ggx::g2_separable(self.cosine, leaving, self.alpha);
            g2 * v_dot_h / (n_dot_h * self.cosine)
        };
        let azimuths = reflected_azimuths([self.cosine, self.sine], [n_dot_h, sin_h]);
        let [reflected, reflected_error] = over(azimuths, &|v_dot_h| {
            let n_dot_l = 2.0 * v_dot_h * n_dot_h - self.cosine;
            if n_dot_l <= 0.0 {
                return 0.0;
            }
            fresnel::dielectric(self.eta, v_dot_h) * weight(v_dot_h, n_dot_l.min(1.0))
        });
        let [transmitted, transmitted_error] =
            over(self.seen_azimuths(n_dot_h, sin_h), &|v_dot_h| {
                // n·t of the refracted direction t = (v·h/η - cos θt) h - v/η.
                let bent = (1.0 - (1.0 - v_dot_h * v_dot_h) / (self.eta * self.eta)).sqrt();
                let below = self.cosine / self.eta - (v_dot_h / self.eta - bent) * n_dot_h;
                let share = 1.0 - fresnel::dielectric(self.eta, v_dot_h);
                share * weight(v_dot_h, below.min(1.0))
            });
        [reflected, transmitted, reflected_error.max(transmitted_error)]
    }

    /// Returns the azimuth from v, in [0, π], up to which v sees the front of facets.
    fn seen_azimuths(&self, n_dot_h: f64, sin_h: f64) -> f64 {
        let (behind, reach) = (self.cosine * n_dot_h, self.sine * sin_h);
        if behind >= reach { PI } else { (-behind / reach).acos() }
    }
}

/// Returns the table: reflectances of [`REFLECTANCES`], roughness on [0, 1], and cosines on [0, 1]
/// with .001 in place of 0.
fn table(recipe: &Recipe) -> Table {
    let rule = TanhSinh::new();
    let of = recipe.get("of").unwrap_or(POWER).to_owned();
    let axes = vec![
        Axis { domain: REFLECTANCES, ..Axis::unit("f0") },
        Axis::unit("roughness"),
        Axis { least: Some(GRAZING), ..Axis::unit("n_dot_v") },
    ];
    let table = Table::new(recipe, axes, &[("albedo", "1")], ALLOWED_ERROR, move |at| {
        let eta = fresnel::eta_of_f0(at[0]);
        let albedo = integrate(&rule, eta, at[1] * at[1], at[2]);
        let transmitted = match &of[..] {
            REFLECTED => 0.0,
            RADIANCE => albedo.transmitted / (eta * eta),
            _ => albedo.transmitted,
        };
        Sample { values: [albedo.reflected + transmitted], error: 2.0 * albedo.error }
    });
    table.claiming(ENERGY)
}

/// No more light leaves than arrives.
const ENERGY: &str = "energy: albedo <= 1";
