//! The split-integral DFG terms of a GGX specular lobe, which image-based
//! lighting looks up or approximates: directional albedo =
//! `f0 * scale + bias`.
//!
//! Definition (Karis, "Real Shading in Unreal Engine 4", 2013): with normals
//! drawn from the distribution, `W = G2 (v·h) / ((n·h) (n·v))`, and the mean
//! over the samples of `(1 - (1 - v·h)^5) W` is `scale`, that of
//! `(1 - v·h)^5 W` is `bias`.
//!
//! Method: for normals at θ from n drawn with u = t²/(1 + t²), t = tan θ / α, the light is above
//! the horizon for azimuths |φ| < φmax(θ). φmax is π up to θ = (π/2 - θv) / 2 and falls to 0 at
//! (π/2 + θv) / 2. The double-exponential rule integrates over φ from 0 to φmax, and over u in each
//! of the two ranges: all that is stiff (a narrow lobe, grazing light) lies at an end of one of
//! them.

use super::normals::{Normal, mean, reflected_azimuths};
use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Choices, Make, Parameter, Recipe, Target, points};
use crate::dataset::Axis;
use crate::microfacet::{fresnel, ggx};
use crate::quadrature::TanhSinh;
use std::cell::Cell;
use std::f64::consts::{FRAC_PI_2, PI};

/// The largest estimated error that [`generate`](super::generate) accepts: about the rounding to f32.
pub const ALLOWED_ERROR: f64 = 1e-7;
/// A hundredth of it, for each integral: the errors of nested integrals add up.
const TOLERANCE: f64 = 1e-9;
/// Sampled instead of n·v = 0, where W is undefined.
const GRAZING: f64 = 0.001;
const CORRELATED: &str = "correlated";
const SEPARABLE: &str = "separable";
const SCHLICK: &str = "schlick";
const ROUGHNESS_SQUARED: &str = "roughness^2";
const ROUGHNESS_FOURTH: &str = "roughness^4";
const ALPHA_IS_GIVEN: &str = "given";

pub(super) const TARGET: Target = Target {
    name: "dfg",
    description: "split-integral DFG terms of GGX specular: albedo = f0 * scale + bias",
    columns: "n_dot_v, roughness or alpha → scale, bias",
    parameters: &[
        Parameter {
            name: "masking",
            description: "Smith's G2: height-correlated (engines today), separable (older), or Schlick's fit to it",
            default: CORRELATED,
            choices: Choices::OneOf(&[CORRELATED, SEPARABLE, SCHLICK]),
        },
        Parameter {
            name: "alpha",
            description: "width of the lobe, from perceptual roughness; given: an input itself",
            default: ROUGHNESS_SQUARED,
            choices: Choices::OneOf(&[ROUGHNESS_SQUARED, ROUGHNESS_FOURTH, ALPHA_IS_GIVEN]),
        },
        points("64", 1024),
        SAMPLING,
        SAMPLING_SEED,
    ],
    make: Make::Table(table),
};

/// The combination of the masking of v and the shadowing of l.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Masking {
    /// Correlated by height ([`ggx::g2_correlated`]).
    Correlated,
    /// Independent ([`ggx::g2_separable`]).
    Separable,
    /// Independent, and each by Schlick's form ([`ggx::g2_schlick`]).
    Schlick,
}

/// The two terms at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dfg {
    /// The factor of f0.
    pub scale: f64,
    /// The summand.
    pub bias: f64,
    /// An estimate of the absolute error of either.
    pub error: f64,
    /// The number of evaluations of the integrand.
    pub evaluations: usize,
}

/// Computes the terms at `n_dot_v` in (0, 1] and `alpha` in [0, 1], to about 1e-9; at alpha = 0,
/// their limit. Make `rule` once for many points.
pub fn integrate(rule: &TanhSinh, n_dot_v: f64, alpha: f64, masking: Masking) -> Dfg {
    integrate_within(rule, TOLERANCE, n_dot_v, alpha, masking)
}

/// [`integrate`], with an absolute `tolerance` for each integral.
pub fn integrate_within(
    rule: &TanhSinh,
    tolerance: f64,
    n_dot_v: f64,
    alpha: f64,
    masking: Masking,
) -> Dfg {
    if alpha == 0.0 {
        let bias = fresnel::schlick_weight(n_dot_v);
        return Dfg { scale: 1.0 - bias, bias, error: 0.0, evaluations: 0 };
    }
    let shares = |v_dot_h| {
        let bias = fresnel::schlick_weight(v_dot_h);
        [1.0 - bias, bias]
    };
    let ([scale, bias, error], evaluations) =
        reflected(rule, tolerance, n_dot_v, alpha, masking, &shares);
    Dfg { scale, bias, error, evaluations }
}

/// Integrates the light that facets reflect once, for two reflectances by v·h, `shares`: two albedos
/// and the error of either, and the number of evaluations. `alpha` > 0.
pub(super) fn reflected(
    rule: &TanhSinh,
    tolerance: f64,
    n_dot_v: f64,
    alpha: f64,
    masking: Masking,
    shares: &dyn Fn(f64) -> [f64; 2],
) -> ([f64; 3], usize) {
    let sine = ((1.0 - n_dot_v) * (1.0 + n_dot_v)).sqrt();
    let evaluations = Cell::new(0);
    let view = View { cosine: n_dot_v, sine, alpha, masking, tolerance, shares, evaluations };
    let theta_v = view.sine.atan2(view.cosine);
    let all_azimuths = Normal::at_angle(0.5 * (FRAC_PI_2 - theta_v), alpha);
    let no_azimuths = Normal::at_angle(0.5 * (FRAC_PI_2 + theta_v), alpha);
    let over = |from, to| mean(rule, tolerance, from, to, |normal| view.ring(rule, normal));
    let full = over(Normal::MACROSCOPIC, all_azimuths);
    let partial = over(all_azimuths, no_azimuths);
    (std::array::from_fn(|term| full[term] + partial[term]), view.evaluations.get())
}

struct View<'a> {
    cosine: f64,
    sine: f64,
    alpha: f64,
    masking: Masking,
    tolerance: f64,
    shares: &'a dyn Fn(f64) -> [f64; 2],
    evaluations: Cell<usize>,
}

impl View<'_> {
    /// Integrates over azimuth: the means of both albedos, and the error of either.
    fn ring(&self, rule: &TanhSinh, normal: Normal) -> [f64; 3] {
        let (n_dot_h, sin_h) = normal.direction(self.alpha);
        let phi_max = reflected_azimuths([self.cosine, self.sine], [n_dot_h, sin_h]);
        let [first, second] = rule
            .integrate_all(0.0, phi_max, self.tolerance, |phi| self.terms(n_dot_h, sin_h, phi.x));
        self.evaluations.set(self.evaluations.get() + first.evaluations);
        let error = first.error.max(second.error);
        [first.value / PI, second.value / PI, error / PI]
    }

    fn terms(&self, n_dot_h: f64, sin_h: f64, phi: f64) -> [f64; 2] {
        let v_dot_h = (self.sine * sin_h * phi.cos() + self.cosine * n_dot_h).min(1.0);
        let n_dot_l = (2.0 * v_dot_h * n_dot_h - self.cosine).min(1.0);
        if n_dot_l <= 0.0 {
            return [0.0; 2];
        }
        let g2 = match self.masking {
            Masking::Correlated => ggx::g2_correlated(self.cosine, n_dot_l, self.alpha),
            Masking::Separable => ggx::g2_separable(self.cosine, n_dot_l, self.alpha),
            Masking::Schlick => ggx::g2_schlick(self.cosine, n_dot_l, self.alpha),
        };
        let weight = g2 * v_dot_h / (n_dot_h * self.cosine);
        (self.shares)(v_dot_h).map(|share| share * weight)
    }
}

/// Returns the table: search split at the cell centres of a regular grid on
/// [0, 1]², unweighted, `n_dot_v` varying slowest; validation split at the
/// nodes of another grid, edges included, with n·v = .001 in place of 0,
/// weighted by area (trapezoidal, mean 1). No point is in both.
fn table(recipe: &Recipe) -> Table {
    let rule = TanhSinh::new();
    let masking = match recipe.get("masking") {
        Some(SEPARABLE) => Masking::Separable,
        Some(SCHLICK) => Masking::Schlick,
        _ => Masking::Correlated,
    };
    let (power, width) = match recipe.get("alpha") {
        Some(ROUGHNESS_FOURTH) => (4, "roughness"),
        Some(ALPHA_IS_GIVEN) => (1, "alpha"),
        _ => (2, "roughness"),
    };
    // A fourth power of libm would differ from the square's square in the last place.
    let alpha = move |width: f64| match power {
        1 => width,
        2 => width * width,
        _ => (width * width) * (width * width),
    };
    let n_dot_v = Axis { least: Some(GRAZING), ..Axis::unit("n_dot_v") };
    let axes = vec![n_dot_v, Axis::unit(width)];
    let outputs = &[("scale", "1"), ("bias", "1")];
    let table = Table::new(recipe, axes, outputs, ALLOWED_ERROR, move |at| {
        let dfg = integrate(&rule, at[0], alpha(at[1]), masking);
        Sample { values: [dfg.scale, dfg.bias], error: dfg.error }
    });
    table.claiming(ENERGY)
}

/// No more light leaves than arrives, whatever the reflectance at normal incidence.
const ENERGY: &str = "energy: f0*scale + bias <= 1 for f0 in 0..1";
