//! Linearly transformed cosines of GGX: the matrices by which area lights are shaded.
//!
//! Definition (Heitz, Dupuy, Hill and Neubelt, "Real-Time Polygonal-Light Shading with Linearly
//! Transformed Cosines", 2016): a cosine lobe about z whose directions a matrix M transforms is
//! near GGX times the cosine of the light, times a magnitude. A shader multiplies the corners of a
//! light by M⁻¹ and integrates the cosine. In a frame with the surface's normal as z and v in the
//! plane of x and z, x > 0, M⁻¹ is `[m11 0 m13; 0 1 0; m31 0 m33]` (row, column), scaled to m22 = 1.
//! The magnitude is the directional albedo without Fresnel, `fresnel` its part that is weighted by
//! `(1 - v·h)⁵`: the albedo is `f0 * (magnitude - fresnel) + fresnel`. `alpha = roughness²`,
//! height-correlated masking. The published tables (github.com/selfshadow/ltc_code) have the same
//! entries, over `sqrt(1 - n·v)`: m11, m31, m13, m33 are x, y, z, w of their first texture.
//!
//! The fit minimises `∫ (lobe - GGX)²` over the sphere in three entries, as many as the published
//! program (`fit/fitLTC.cpp`) fits to `∫ |lobe - GGX|³`. Theirs hold the third column of M, to the
//! mean direction of the lobe. Here the third row of M⁻¹ is held: it is normal to the plane where a
//! transformed cosine ends, and that plane is at the horizon for alpha = 1 and leans towards the
//! mirrored direction r as alpha → 0, by [`LEAN`] of the way:
//! `m31 : m33 = -LEAN (1 - alpha) c s : 1 - LEAN (1 - alpha) s²`, c = n·v and s = sin θv. With all
//! four entries free, the error of the third power is a seventh smaller, but lights from behind
//! which one looks at grazing angles come out brighter, and the entries vary more.
//!
//! As alpha → 0, the fit tends to m11 = c², m13 = cs, and c m33 - s m31 = 2 alpha c: both lobes are
//! `1/(1 + t²)²` of a linear t then. Where c is of the order of alpha, `(m11 - c²)/alpha²`,
//! `m13/alpha` and m33/alpha are functions of c/alpha.
//!
//! Method: the directions of light are drawn from both lobes, by a rule instead of by chance
//! (`lobe`); Newton's method starts from that limit (`fit`). Magnitude and Fresnel are integrals of
//! [`dfg`].

mod fit;
mod lobe;

use super::dfg::{self, Masking};
use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Make, Recipe, Target, points};
use crate::dataset::Axis;
use crate::quadrature::TanhSinh;
use fit::Fit;
use glam::DVec2;
use lobe::{Reflection, Sphere, Techniques, Transformed};

/// The largest error of an entry: of 21×21 places with the domain's edges, the largest difference
/// from the fit by rules of twice the points was 5.5e-5, at n·v = .2.
pub const ERROR: f64 = 1e-4;
/// Points along each axis of the rules of integration: two for Newton's method, by hand; one for
/// [`ERROR`].
const POINTS: [usize; 3] = [16, 32, 64];
/// Below, entries that are of the order of alpha are proportional to it, to 1e-5; and they come to
/// rest on less and less of the error.
const LEAST_ALPHA: f64 = 1e-4;
/// Sampled instead of n·v = 0, as in [`dfg`].
const GRAZING: f64 = 0.001;

/// How far the plane where lobes end leans from the horizon to one that faces the mirrored
/// direction. By hand: of 0 to 1, .5 has the least error of lobes, .9 the least of pictures.
pub const LEAN: f64 = 0.75;

pub(super) const TARGET: Target = Target {
    name: "ltc_ggx",
    description: "linearly transformed cosines of GGX: inverse matrix (m22 = 1), albedo, Fresnel",
    columns: "n_dot_v, roughness → m11, m13, m31, m33, magnitude, fresnel",
    parameters: &[points("64", 1024), SAMPLING, SAMPLING_SEED],
    make: Make::Table(table),
};

/// The entries of the inverse matrix that are not 0, by row and column; m22 is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inverse {
    /// x to x.
    pub m11: f64,
    /// z to x.
    pub m13: f64,
    /// x to z.
    pub m31: f64,
    /// z to z.
    pub m33: f64,
}

impl From<[f64; 4]> for Inverse {
    fn from([m11, m13, m31, m33]: [f64; 4]) -> Inverse {
        Inverse { m11, m13, m31, m33 }
    }
}

impl From<Inverse> for [f64; 4] {
    fn from(of: Inverse) -> [f64; 4] {
        [of.m11, of.m13, of.m31, of.m33]
    }
}

/// Fits matrices. Make it once for many places.
#[derive(Clone, Debug)]
pub struct Fitter {
    newton: [Sphere; 2],
    fine: Sphere,
}

impl Default for Fitter {
    fn default() -> Fitter {
        Fitter::new()
    }
}

impl Fitter {
    /// Makes the rules of integration.
    pub fn new() -> Fitter {
        Fitter::of_points(POINTS)
    }

    fn of_points([first, second, fine]: [usize; 3]) -> Fitter {
        Fitter { newton: [first, second].map(Sphere::new), fine: Sphere::new(fine) }
    }

    /// Fits the matrix at `n_dot_v` and `alpha`, each in [0, 1], to entries that are off by
    /// [`ERROR`] at most. `magnitude` is the lobe's albedo.
    pub fn fit(&self, n_dot_v: f64, alpha: f64, magnitude: f64) -> Inverse {
        let fitted = alpha.max(LEAST_ALPHA);
        let seen = Reflection::new(n_dot_v, fitted);
        let sine = ((1.0 - n_dot_v) * (1.0 + n_dot_v)).sqrt();
        let lean = LEAN * (1.0 - fitted) * sine;
        let row = DVec2::new(-lean * n_dot_v, 1.0 - lean * sine);
        let of = Fit { seen: &seen, magnitude, row };
        let from = start(n_dot_v, fitted);
        let near = self.newton.iter().fold(from, |at, sphere| of.descend(sphere, at));
        let mut at = of.inverse(of.settle([&self.newton[1], &self.fine], near));
        at.m31 *= alpha / fitted;
        at.m33 *= alpha / fitted;
        at
    }
}

/// The limit at small alpha; and about the isotropic lobe about n at alpha = 1.
fn start(n_dot_v: f64, alpha: f64) -> [f64; 3] {
    let square = n_dot_v * n_dot_v;
    let rough = alpha * alpha;
    let m11 = square + (1.0 - square) * rough;
    let m13 = n_dot_v * (1.0 - square).sqrt() * (1.0 - rough);
    [m11, m13, 2.0 * alpha / (1.0 + 0.75 * alpha)]
}

/// How far a transformed cosine is from GGX, each as a share of the same norm of GGX.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// By the integral over the sphere of the absolute difference.
    pub first: f64,
    /// By the root of the integral of its square, which the fit minimises.
    pub second: f64,
    /// By the cube root of the integral of its third power, which the published fit minimises.
    pub third: f64,
}

/// Measures a transformed cosine of a positive determinant, times `magnitude`, at `n_dot_v` in [0,
/// 1] and `alpha` in (0, 1], with `points` × `points` directions from either lobe; 64 are enough
/// for two digits. NaN if the determinant is not positive.
pub fn distance(
    points: usize,
    n_dot_v: f64,
    alpha: f64,
    inverse: Inverse,
    magnitude: f64,
) -> Distance {
    let seen = Reflection::new(n_dot_v, alpha);
    let Some(cosine) = Transformed::of_inverse(inverse.into()) else {
        return Distance { first: f64::NAN, second: f64::NAN, third: f64::NAN };
    };
    let mut sums = [[0.0; 3]; 2];
    for light in Sphere::new(points).lights(&seen, &cosine, Techniques::Both) {
        let difference = magnitude * cosine.at(light.direction) - light.value;
        for (sum, size) in sums.iter_mut().zip([difference.abs(), light.value]) {
            (0..3).for_each(|power| sum[power] += light.weight * size.powi(power as i32 + 1));
        }
    }
    let [first, second, third] = std::array::from_fn(|power| sums[0][power] / sums[1][power]);
    Distance { first, second: second.sqrt(), third: third.cbrt() }
}

/// Returns the table on [0, 1]², with n·v = .001 in place of 0.
fn table(recipe: &Recipe) -> Table {
    let (rule, fitter) = (TanhSinh::new(), Fitter::new());
    let outputs = &[
        ("m11", "1"),
        ("m13", "1"),
        ("m31", "1"),
        ("m33", "1"),
        ("magnitude", "1"),
        ("fresnel", "1"),
    ];
    let axes =
        vec![Axis { least: Some(GRAZING), ..Axis::unit("n_dot_v") }, Axis::unit("roughness")];
    let table = Table::new(recipe, axes, outputs, ERROR, move |at| {
        let alpha = at[1] * at[1];
        let albedo = dfg::integrate(&rule, at[0], alpha, Masking::Correlated);
        let magnitude = albedo.scale + albedo.bias;
        let Inverse { m11, m13, m31, m33 } = fitter.fit(at[0], alpha, magnitude);
        let values = [m11, m13, m31, m33, magnitude, albedo.bias];
        Sample { values, error: ERROR.max(2.0 * albedo.error) }
    });
    table.claiming(ENERGY)
}

/// No more light leaves than arrives.
const ENERGY: &str = "energy: magnitude <= 1";

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn magnitude(n_dot_v: f64, alpha: f64) -> f64 {
        let albedo = dfg::integrate(&TanhSinh::new(), n_dot_v, alpha, Masking::Correlated);
        albedo.scale + albedo.bias
    }

    #[test]
    fn more_points_change_entries_by_less_than_the_stated_error() {
        let (fitter, finer) = (Fitter::new(), Fitter::of_points([16, 32, 128]));
        for (n_dot_v, alpha) in [(0.001, 0.4), (0.2, 0.5), (0.6, 0.1), (0.95, 0.3), (1.0, 0.6)] {
            let albedo = magnitude(n_dot_v, alpha);
            let fits = [&fitter, &finer].map(|by| <[f64; 4]>::from(by.fit(n_dot_v, alpha, albedo)));
            let apart = std::array::from_fn::<f64, 4, _>(|at| (fits[0][at] - fits[1][at]).abs());
            assert!(apart.iter().all(|apart| *apart < ERROR), "{n_dot_v} {alpha}: {fits:?}");
        }
    }

    #[test]
    fn transformed_cosines_are_normalised() {
        let seen = Reflection::new(0.3, 0.2);
        for entries in [[1.0, 0.0, 0.0, 1.0], [0.2, 0.3, -0.1, 0.3], [0.9, 0.1, -0.1, 1.3]] {
            let cosine = Transformed::of_inverse(entries).unwrap();
            let lights = Sphere::new(48).lights(&seen, &cosine, Techniques::Both);
            let sum = |of: &dyn Fn(DVec3) -> f64| -> f64 {
                lights.iter().map(|light| light.weight * of(light.direction)).sum()
            };
            let total = sum(&|l| cosine.at(l));
            assert!((total - 1.0).abs() < 1e-3, "{entries:?}: {total}");
            let albedo: f64 = lights.iter().map(|light| light.weight * light.value).sum();
            assert!((albedo - magnitude(0.3, 0.2)).abs() < 1e-3, "{entries:?}: {albedo}");
        }
        assert!(Transformed::of_inverse([1.0, 1.0, 1.0, 1.0]).is_none());
    }

    #[test]
    fn narrow_lobes_tend_to_their_limit() {
        let fitter = Fitter::new();
        for c in [0.2, 0.5, 0.9, 1.0_f64] {
            let s = (1.0 - c * c).sqrt();
            for alpha in [1e-3, 1e-6, 0.0] {
                let Inverse { m11, m13, m31, m33 } = fitter.fit(c, alpha, magnitude(c, alpha));
                let off = [m11 - c * c, m13 - c * s].map(f64::abs);
                assert!(off.iter().all(|off| *off < 1e-4), "{c} {alpha}: {off:?}");
                let across = c * m33 - s * m31 - 2.0 * alpha * c;
                assert!(across.abs() <= 1e-3 * alpha, "{c} {alpha}: {across}");
            }
        }
    }

    #[test]
    fn at_a_right_angle_the_lobe_is_isotropic() {
        let fitter = Fitter::new();
        for alpha in [0.05, 0.3, 1.0] {
            let Inverse { m11, m13, m31, .. } = fitter.fit(1.0, alpha, magnitude(1.0, alpha));
            let off = [m11 - 1.0, m13, m31].map(f64::abs);
            assert!(off.iter().all(|off| *off < 1e-9), "{alpha}: {off:?}");
        }
    }
}
