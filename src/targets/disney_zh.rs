//! Zonal harmonics of the Disney diffuse lobe, for environment lighting.
//!
//! Definition (Pesce and Iwanicki, "Approximate Models for Physically Based
//! Rendering", 2015, §6; the BRDF is Burley's, 2012): the lobe
//! `f(l) cos θ`, `f = (1 + (F - 1)(1 - n·l)⁵)(1 + (F - 1)(1 - n·v)⁵) / π`,
//! `F = 1/2 + 2 roughness (l·h)²`, is projected on orthonormal spherical
//! harmonics of the bands 0 to 2. With d the direction of the band-1 vector,
//! `zhₗ = √(4π/(2l+1)) Σₘ cₗₘ Yₗₘ(d)`, which the addition theorem makes
//! `√((2l+1)/(4π)) ∫ f cos θ Pₗ(l·d) dl`; and d ∝ (1 - β) n + β v.
//!
//! Method: (l·h)² = (1 + l·v)/2, so F is linear in l·v = n·l n·v + sin θ sin θv cos φ, and the lobe
//! is `a + b cos φ + c cos² φ`. The integral over azimuth has a closed form; a polynomial in n·l
//! remains, for which Gauss–Legendre is exact, up to rounding. b has the factor sin θv, so that the
//! quotient tan θd / sin θv, from which β follows, exists at v = n, too.

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Make, Recipe, Target, points};
use crate::dataset::Axis;
use crate::quadrature::Rule;
use std::f64::consts::PI;

/// Enough for the polynomials in n·l, of degree 12 at most: 5 of (1 - n·l)⁵, 2 of F², 1 of the
/// cosine, 2 of P₂ and 2 of sin².
const POINTS: usize = 8;
/// The rounding of sums of about a hundred terms of order 1.
const ERROR: f64 = 1e-14;

pub(super) const TARGET: Target = Target {
    name: "disney_zh",
    description: "zonal harmonics of the Disney diffuse lobe times cosine, 1/pi included",
    columns: "n_dot_v, roughness → zh0, zh1, zh2, beta (axis = (1 - beta) n + beta v)",
    parameters: &[points("64", 1024), SAMPLING, SAMPLING_SEED],
    make: Make::Table(table),
};

/// The coefficients of the lobe about its axis, and the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    /// Bands 0, 1 and 2.
    pub zh: [f64; 3],
    /// The axis, along (1 - β) n + β v.
    pub beta: f64,
}

/// Integrals of the lobe times coordinates of l, v being in the plane of x and z.
#[derive(Clone, Copy, Default)]
struct Moments {
    one: f64,
    /// The integral over sin θv.
    x: f64,
    z: f64,
    xx: f64,
    /// The integral over sin θv.
    xz: f64,
    zz: f64,
}

/// Projects the lobe at `n_dot_v` and `roughness`, each in [0, 1].
pub fn project(n_dot_v: f64, roughness: f64) -> Lobe {
    let moments = moments(n_dot_v, roughness);
    let sin_v = ((1.0 - n_dot_v) * (1.0 + n_dot_v)).sqrt();
    // tan θd / sin θv
    let slope = moments.x / moments.z;
    let cos_d = 1.0 / (1.0 + (slope * sin_v).powi(2)).sqrt();
    let sin_d = slope * sin_v * cos_d;
    let along = sin_v * sin_d * moments.x + cos_d * moments.z;
    let along_squared = sin_d * sin_d * moments.xx
        + 2.0 * sin_d * cos_d * sin_v * moments.xz
        + cos_d * cos_d * moments.zz;
    let band = |l: f64, integral: f64| ((2.0 * l + 1.0) / (4.0 * PI)).sqrt() * integral;
    Lobe {
        zh: [
            band(0.0, moments.one),
            band(1.0, along),
            band(2.0, 1.5 * along_squared - 0.5 * moments.one),
        ],
        // From sin θd / cos θd = β sin θv / (1 - β + β cos θv).
        beta: slope / (1.0 + (1.0 - n_dot_v) * slope),
    }
}

fn moments(n_dot_v: f64, roughness: f64) -> Moments {
    let sin_v_squared = (1.0 - n_dot_v) * (1.0 + n_dot_v);
    let at_view = (1.0 - n_dot_v).powi(5);
    let mut moments = Moments::default();
    for point in Rule::gauss_legendre(POINTS).points().iter().filter(|p| p.weight > 0.0) {
        let (n_dot_l, weight) = (0.5 * (1.0 + point.node), 0.5 * point.weight);
        let sin_l_squared = (1.0 - n_dot_l) * (1.0 + n_dot_l);
        let at_light = (1.0 - n_dot_l).powi(5);
        // F - 1 without its part in cos φ; that part over sin θv sin θl cos φ is `roughness`.
        let even = -0.5 + roughness * (1.0 + n_dot_l * n_dot_v);
        let (light, view) = (1.0 + even * at_light, 1.0 + even * at_view);
        let a = light * view;
        // Over sin θv sin θl, and over its square.
        let b = roughness * (at_light * view + at_view * light);
        let c = roughness * roughness * at_light * at_view;
        let square = c * sin_v_squared * sin_l_squared;
        // Means of cos², cos⁴ over azimuth: 1/2, 3/8.
        let (mean, mean_cosine, mean_square) =
            (a + 0.5 * square, 0.5 * b, 0.5 * a + 0.375 * square);
        let weight = 2.0 * weight * n_dot_l;
        moments.one += weight * mean;
        moments.x += weight * sin_l_squared * mean_cosine;
        moments.z += weight * n_dot_l * mean;
        moments.xx += weight * sin_l_squared * mean_square;
        moments.xz += weight * n_dot_l * sin_l_squared * mean_cosine;
        moments.zz += weight * n_dot_l * n_dot_l * mean;
    }
    moments
}

/// Returns the table on [0, 1]², edges included.
fn table(recipe: &Recipe) -> Table {
    Table::new(
        recipe,
        vec![Axis::unit("n_dot_v"), Axis::unit("roughness")],
        &[("zh0", "1"), ("zh1", "1"), ("zh2", "1"), ("beta", "1")],
        ERROR,
        |at| {
            let Lobe { zh: [zh0, zh1, zh2], beta } = project(at[0], at[1]);
            Sample { values: [zh0, zh1, zh2, beta], error: ERROR }
        },
    )
}
