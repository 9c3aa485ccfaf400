//! The complex index of refraction of metals, as it was measured in the visible.
//!
//! Definition: the permittivity of Rakić, Djurišić, Elazar and Majewski, "Optical properties of
//! metallic films for vertical-cavity optoelectronic devices", Applied Optics 37(22), 1998: free
//! electrons, and between bands four or five Brendel–Bormann oscillators, Lorentz oscillators whose
//! energy has a normal distribution. The paper fits its figures to measurements of each metal. At
//! the photon's energy ω (all in eV, ωp the plasma energy)
//!
//! `ε = 1 - f0 ωp²/(ω (ω + iΓ0)) + Σ ∫ N(x; ωj, σj) fj ωp²/(x² - ω² - iωΓj) dx`, `(n + ik)² = ε`.
//!
//! Measurements differ from one another by more than the model from its own: Johnson and Christy's
//! ("Optical Constants of the Noble Metals", 1972) of gold by .14 in k, of copper from 500 to
//! 600 nm by .3 in n. For the measured values of one sample, `lgp import` reads a table.
//!
//! Method: the double-exponential rule over each distribution, divided where the oscillator
//! resonates.

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Choices, Make, Parameter, Recipe, Target, points};
use crate::dataset::Axis;
use crate::microfacet::fresnel;
use crate::quadrature::TanhSinh;
use std::f64::consts::PI;

/// The largest estimated error that [`generate`](super::generate) accepts: below rounding to f32.
pub const ALLOWED_ERROR: f64 = 1e-8;
/// Of each part of an integral: there are up to fifteen.
const TOLERANCE: f64 = 1e-10;
/// The standard deviations beyond which a normal distribution is below 1e-15.
const REACH: f64 = 8.0;
/// Of visible light, in micrometres.
const WAVELENGTHS: [f64; 2] = [0.38, 0.78];
/// hc/e in eV µm.
const PHOTON_ENERGY: f64 = 1.239_841_984;
const INDEX: &str = "index";
const REFLECTANCE: &str = "reflectance";

pub(super) const TARGET: Target = Target {
    name: "conductor",
    description: "index of refraction of a metal, n + ik, over the wavelength (µm), visible",
    columns: "wavelength → n, k or f0",
    parameters: &[
        Parameter {
            name: "metal",
            description: "which",
            default: "gold",
            choices: Choices::OneOf(&[
                "gold",
                "silver",
                "copper",
                "aluminium",
                "beryllium",
                "chromium",
                "nickel",
                "palladium",
                "platinum",
                "titanium",
                "tungsten",
            ]),
        },
        Parameter {
            name: "of",
            description: "the index n + ik, or the reflectance f0 at normal incidence",
            default: INDEX,
            choices: Choices::OneOf(&[INDEX, REFLECTANCE]),
        },
        points("256", 4096),
        SAMPLING,
        SAMPLING_SEED,
    ],
    make: Make::Table(table),
};

/// A metal, as the paper describes it; energies are in eV.
#[derive(Debug)]
pub struct Metal {
    /// Its name.
    pub name: &'static str,
    /// The plasma energy.
    plasma: f64,
    /// Strength and damping of the free electrons.
    drude: [f64; 2],
    /// Strength, damping, energy and its standard deviation.
    oscillators: &'static [[f64; 4]],
}

/// A complex index of refraction n + ik.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Index {
    /// The real part.
    pub n: f64,
    /// The imaginary part, positive.
    pub k: f64,
    /// An estimate of the absolute error of either.
    pub error: f64,
}

impl Metal {
    /// Computes the index at a wavelength in micrometres, above 0. Make `rule` once for many
    /// points.
    pub fn index(&self, rule: &TanhSinh, wavelength: f64) -> Index {
        let energy = PHOTON_ENERGY / wavelength;
        let [strength, damping] = self.drude;
        let free = strength * self.plasma.powi(2) / (energy.powi(2) + damping.powi(2));
        let mut epsilon = [1.0 - free, free * damping / energy];
        let mut error = 0.0;
        for oscillator in self.oscillators {
            let [real, imaginary, its_error] = self.bound(rule, *oscillator, energy);
            epsilon[0] += real;
            epsilon[1] += imaginary;
            error += its_error;
        }
        let [real, imaginary] = epsilon;
        let modulus = real.hypot(imaginary);
        let larger = (0.5 * (modulus + real.abs())).sqrt();
        let smaller = 0.5 * imaginary / larger;
        let [n, k] = if real > 0.0 { [larger, smaller] } else { [smaller, larger] };
        Index { n, k, error: error / modulus.sqrt() }
    }

    /// Real and imaginary part that an oscillator adds, and the error of either.
    fn bound(&self, rule: &TanhSinh, oscillator: [f64; 4], energy: f64) -> [f64; 3] {
        let [strength, damping, centre, deviation] = oscillator;
        let scale = strength * self.plasma.powi(2) / (2.0 * PI).sqrt();
        let resonances = [-energy, energy].map(|x| ((x - centre) / deviation).clamp(-REACH, REACH));
        let ends = [-REACH, resonances[0], resonances[1], REACH];
        let mut sum = [0.0; 3];
        for part in ends.windows(2) {
            let parts = rule.integrate_all(part[0], part[1], TOLERANCE, |t| {
                let x = centre + deviation * t.x;
                let [away, width] = [(x - energy) * (x + energy), energy * damping];
                let weight = scale * (-0.5 * t.x * t.x).exp() / (away * away + width * width);
                [weight * away, weight * width]
            });
            sum[0] += parts[0].value;
            sum[1] += parts[1].value;
            sum[2] += parts[0].error + parts[1].error;
        }
        sum
    }
}

/// Returns the table on wavelengths in [0.38, 0.78] µm.
fn table(recipe: &Recipe) -> Table {
    let rule = TanhSinh::new();
    let metal = METALS.iter().find(|metal| recipe.get("metal") == Some(metal.name));
    let metal = metal.unwrap_or(&METALS[0]);
    let axis = Axis { unit: "µm".into(), domain: WAVELENGTHS, ..Axis::unit("wavelength") };
    if recipe.get("of") == Some(REFLECTANCE) {
        return Table::new(recipe, vec![axis], &[("f0", "1")], ALLOWED_ERROR, move |at| {
            let Index { n, k, error } = metal.index(&rule, at[0]);
            Sample { values: [fresnel::conductor(n, k, 1.0)], error }
        });
    }
    Table::new(recipe, vec![axis], &[("n", "1"), ("k", "1")], ALLOWED_ERROR, move |at| {
        let Index { n, k, error } = metal.index(&rule, at[0]);
        Sample { values: [n, k], error }
    })
}

/// The metals of the paper, with the figures of its Brendel–Bormann model; gold, the default, is
/// first.
pub const METALS: [Metal; 11] = [
    Metal {
        name: "gold",
        plasma: 9.03,
        drude: [0.77, 0.05],
        oscillators: &[
            [0.054, 0.074, 0.218, 0.742],
            [0.05, 0.035, 2.885, 0.349],
            [0.312, 0.083, 4.069, 0.83],
            [0.719, 0.125, 6.137, 1.246],
            [1.648, 0.179, 27.97, 1.795],
        ],
    },
    Metal {
        name: "silver",
        plasma: 9.01,
        drude: [0.821, 0.049],
        oscillators: &[
            [0.05, 0.189, 2.025, 1.894],
            [0.133, 0.067, 5.185, 0.665],
            [0.051, 0.019, 4.343, 0.189],
            [0.467, 0.117, 9.809, 1.17],
            [4.0, 0.052, 18.56, 0.516],
        ],
    },
    Metal {
        name: "copper",
        plasma: 10.83,
        drude: [0.562, 0.03],
        oscillators: &[
            [0.076, 0.056, 0.416, 0.562],
            [0.081, 0.047, 2.849, 0.469],
            [0.324, 0.113, 4.819, 1.131],
            [0.726, 0.172, 8.136, 1.719],
        ],
    },
    Metal {
        name: "aluminium",
        plasma: 14.98,
        drude: [0.526, 0.047],
        oscillators: &[
            [0.213, 0.312, 0.163, 0.013],
            [0.06, 0.315, 1.561, 0.042],
            [0.182, 1.587, 1.827, 0.256],
            [0.014, 2.145, 4.495, 1.735],
        ],
    },
    Metal {
        name: "beryllium",
        plasma: 18.51,
        drude: [0.081, 0.035],
        oscillators: &[
            [0.066, 2.956, 0.131, 0.277],
            [0.067, 3.962, 0.469, 3.167],
            [0.346, 2.398, 2.827, 1.446],
            [0.311, 3.904, 4.318, 0.893],
        ],
    },
    Metal {
        name: "chromium",
        plasma: 10.75,
        drude: [0.154, 0.048],
        oscillators: &[
            [0.338, 4.256, 0.281, 0.115],
            [0.261, 3.957, 0.584, 0.252],
            [0.817, 2.218, 1.919, 0.225],
            [0.105, 6.983, 6.997, 4.903],
        ],
    },
    Metal {
        name: "nickel",
        plasma: 15.92,
        drude: [0.083, 0.022],
        oscillators: &[
            [0.357, 2.82, 0.317, 0.606],
            [0.039, 0.12, 1.059, 1.454],
            [0.127, 1.822, 4.583, 0.379],
            [0.654, 6.637, 8.825, 0.51],
        ],
    },
    Metal {
        name: "palladium",
        plasma: 9.72,
        drude: [0.33, 0.009],
        oscillators: &[
            [0.769, 2.343, 0.066, 0.694],
            [0.093, 0.497, 0.502, 0.027],
            [0.309, 2.022, 2.432, 1.167],
            [0.409, 0.119, 5.987, 1.331],
        ],
    },
    Metal {
        name: "platinum",
        plasma: 9.59,
        drude: [0.333, 0.08],
        oscillators: &[
            [0.186, 0.498, 0.782, 0.031],
            [0.665, 1.851, 1.317, 0.096],
            [0.551, 2.604, 3.189, 0.766],
            [2.214, 2.891, 8.236, 1.146],
        ],
    },
    Metal {
        name: "titanium",
        plasma: 7.29,
        drude: [0.126, 0.067],
        oscillators: &[
            [0.427, 1.877, 1.459, 0.463],
            [0.218, 0.1, 2.661, 0.506],
            [0.513, 0.615, 0.805, 0.799],
            [0.0002, 4.109, 19.86, 2.854],
        ],
    },
    Metal {
        name: "tungsten",
        plasma: 13.22,
        drude: [0.197, 0.057],
        oscillators: &[
            [0.006, 3.689, 0.481, 3.754],
            [0.022, 0.277, 0.985, 0.059],
            [0.136, 1.433, 1.962, 0.273],
            [2.648, 4.555, 5.442, 1.912],
        ],
    },
];
