//! The directional albedo of a white sheen, the lobe of cloth: what image-based lighting multiplies
//! by the sheen's colour, and what is taken from the layer below.
//!
//! Definition: Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", 2017, the lobe `D V`
//! ([`charlie`]) times the cosine, integrated over the hemisphere of light. V is that of Neubelt
//! and Pettineo (glTF's simpler choice, Filament, three.js, MaterialX), or `G / (4 n·l n·v)` with
//! `G = 1 / (1 + Λ(v) + Λ(l))` (glTF's other choice, Unity), where the paper softens Λ(l). `alpha`
//! is roughness² (glTF, Filament, three.js), or roughness itself (the paper, MaterialX).
//!
//! The lobe gains energy where smooth cloth is seen at grazing angles: its albedo is above 1 there,
//! without bound as alpha falls to 0. Renderers cut it to 1, or the layer below would be black and
//! less.
//!
//! Method: over half vectors, `4 (v·h) dω(h) = dω(l)`. Light is above the horizon as in
//! [`dfg`](super::dfg): up to θ = (π/2 + θv)/2 from n, at azimuths that begin to narrow at (π/2 -
//! θv)/2. sin^(1/α) is a narrow band at the outer end, where the double-exponential rule has its
//! nodes. Λ has a seam at the light's cosine of ½ and a branch point at 1: the azimuths are halved
//! at the first, and angles at all where one of them comes or goes.

use super::normals::reflected_azimuths;
use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Choices, Make, Parameter, Recipe, Target, points};
use crate::dataset::Axis;
use crate::microfacet::charlie;
use crate::quadrature::TanhSinh;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

/// The largest estimated error that [`generate`](super::generate) accepts: about the rounding to
/// f32.
pub const ALLOWED_ERROR: f64 = 1e-7;
/// A hundredth of it, for each integral: the errors of nested integrals add up.
const TOLERANCE: f64 = 1e-9;
/// Sampled instead of n·v = 0, where the albedo has no bound as alpha falls to 0.
const GRAZING: f64 = 0.001;
/// Sampled instead of a roughness of 0, where only n·v = 0 would be lit. MaterialX renders none
/// below.
const LEAST_ROUGHNESS: f64 = 0.005;
const NEUBELT: &str = "neubelt";
const CHARLIE: &str = "charlie";
const SOFTENED: &str = "softened";
const ROUGHNESS_SQUARED: &str = "roughness^2";
const ROUGHNESS: &str = "roughness";
const CUT: &str = "cut";
const KEPT: &str = "kept";

pub(super) const TARGET: Target = Target {
    name: "sheen_albedo",
    description: "directional albedo of the Charlie sheen of cloth",
    columns: "roughness, n_dot_v → albedo",
    parameters: &[
        Parameter {
            name: "masking",
            description: "Neubelt's denominator (engines), the paper's Smith fit, or its softened one",
            default: NEUBELT,
            choices: Choices::OneOf(&[NEUBELT, CHARLIE, SOFTENED]),
        },
        Parameter {
            name: "alpha",
            description: "width of the lobe, from perceptual roughness (the paper's is roughness)",
            default: ROUGHNESS_SQUARED,
            choices: Choices::OneOf(&[ROUGHNESS_SQUARED, ROUGHNESS]),
        },
        Parameter {
            name: "above_one",
            description: "an albedo above 1, at grazing angles: cut to 1, as renderers do, or kept",
            default: CUT,
            choices: Choices::OneOf(&[CUT, KEPT]),
        },
        points("64", 1024),
        SAMPLING,
        SAMPLING_SEED,
    ],
    make: Make::Table(table),
};

/// What stands for the masking of v, the shadowing of l, and the denominator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Masking {
    /// [`charlie::visibility_neubelt`].
    Neubelt,
    /// Smith's, with [`charlie::lambda`] in both directions.
    Charlie,
    /// Smith's, with [`charlie::lambda_softened`] for l.
    Softened,
}

/// The albedo at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Albedo {
    /// The share of the light that is reflected, which may be above 1.
    pub value: f64,
    /// An estimate of its absolute error.
    pub error: f64,
}

/// Computes the albedo at `n_dot_v` in (0, 1] and `alpha` in [0, 1], to about 1e-8; at alpha = 0,
/// its limit. Make `rule` once for many points.
pub fn integrate(rule: &TanhSinh, alpha: f64, n_dot_v: f64, masking: Masking) -> Albedo {
    if alpha == 0.0 {
        return Albedo { value: 0.0, error: 0.0 };
    }
    let sine = ((1.0 - n_dot_v) * (1.0 + n_dot_v)).sqrt();
    let lambda = charlie::lambda(n_dot_v, alpha);
    let view = View { alpha, cosine: n_dot_v, sine, masking, lambda };
    let theta_v = sine.atan2(n_dot_v);
    let narrowing = 0.5 * (FRAC_PI_2 - theta_v);
    let limits = match masking {
        Masking::Neubelt => vec![narrowing],
        _ => vec![
            narrowing,
            0.5 * theta_v,
            0.5 * (theta_v - FRAC_PI_3).abs(),
            0.5 * (theta_v + FRAC_PI_3),
        ],
    };
    let mut limits = [vec![0.0, 0.5 * (FRAC_PI_2 + theta_v)], limits].concat();
    limits.sort_by(f64::total_cmp);
    let mut albedo = Albedo { value: 0.0, error: 0.0 };
    for pair in limits.windows(2) {
        let [part, inner] =
            rule.integrate_all(pair[0], pair[1], TOLERANCE, |theta| view.ring(rule, theta.x));
        albedo.value += part.value;
        albedo.error += part.error + inner.value;
    }
    albedo
}

struct View {
    alpha: f64,
    cosine: f64,
    sine: f64,
    masking: Masking,
    /// Λ(v).
    lambda: f64,
}

impl View {
    /// Integrates over the azimuths of half vectors at `theta` from n: the light, and its error.
    fn ring(&self, rule: &TanhSinh, theta: f64) -> [f64; 2] {
        let (sin_h, n_dot_h) = theta.sin_cos();
        // Both sides of the plane of n and v.
        let density = 2.0 * sin_h * charlie::distribution(n_dot_h, self.alpha);
        let tolerance = TOLERANCE / density.max(1.0);
        let phi_max = reflected_azimuths([self.cosine, self.sine], [n_dot_h, sin_h]);
        let seam = self.seam(n_dot_h, sin_h).min(phi_max);
        let over =
            |from, to| rule.integrate(from, to, tolerance, |phi| self.share(n_dot_h, sin_h, phi.x));
        let (near, far) = (over(0.0, seam), over(seam, phi_max));
        [near.value + far.value, near.error + far.error].map(|sum| density * sum)
    }

    /// Returns the azimuth where Λ(l) has its seam: that of light at a cosine of ½.
    fn seam(&self, n_dot_h: f64, sin_h: f64) -> f64 {
        let reach = self.sine * sin_h;
        if self.masking == Masking::Neubelt || reach == 0.0 {
            return 0.0;
        }
        let v_dot_h = (0.5 + self.cosine) / (2.0 * n_dot_h);
        ((v_dot_h - self.cosine * n_dot_h) / reach).clamp(-1.0, 1.0).acos()
    }

    /// `4 V (n·l) (v·h)`
    fn share(&self, n_dot_h: f64, sin_h: f64, phi: f64) -> f64 {
        let v_dot_h = self.sine * sin_h * phi.cos() + self.cosine * n_dot_h;
        let n_dot_l = (2.0 * v_dot_h * n_dot_h - self.cosine).min(1.0);
        if n_dot_l <= 0.0 {
            return 0.0;
        }
        let smith = |shadowing| 1.0 / ((1.0 + self.lambda + shadowing) * self.cosine);
        let visible = match self.masking {
            Masking::Neubelt => 4.0 * n_dot_l * charlie::visibility_neubelt(self.cosine, n_dot_l),
            Masking::Charlie => smith(charlie::lambda(n_dot_l, self.alpha)),
            Masking::Softened => smith(charlie::lambda_softened(n_dot_l, self.alpha)),
        };
        visible * v_dot_h
    }
}

/// Returns the table on [0, 1]², with a roughness of .005 and n·v = .001 in place of 0.
fn table(recipe: &Recipe) -> Table {
    let rule = TanhSinh::new();
    let masking = match recipe.get("masking") {
        Some(CHARLIE) => Masking::Charlie,
        Some(SOFTENED) => Masking::Softened,
        _ => Masking::Neubelt,
    };
    let squared = recipe.get("alpha") != Some(ROUGHNESS);
    let most = if recipe.get("above_one") == Some(KEPT) { f64::INFINITY } else { 1.0 };
    let axes = vec![
        Axis { least: Some(LEAST_ROUGHNESS), ..Axis::unit("roughness") },
        Axis { least: Some(GRAZING), ..Axis::unit("n_dot_v") },
    ];
    let table = Table::new(recipe, axes, &[("albedo", "1")], ALLOWED_ERROR, move |at| {
        let alpha = if squared { at[0] * at[0] } else { at[0] };
        let albedo = integrate(&rule, alpha, at[1], masking);
        Sample { values: [albedo.value.min(most)], error: albedo.error }
    });
    if most == 1.0 { table.claiming(ENERGY) } else { table }
}

/// No more light leaves than arrives.
const ENERGY: &str = "energy: albedo <= 1";
