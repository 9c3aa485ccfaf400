//! The directional albedo of a layer of upright fibres in which light scatters any number of times
//! (`fibres`), the sheen of Zeltner, Burley and Chiang, "Practical
//! Multiple-Scattering Sheen Using Linearly Transformed Cosines", 2022.
//!
//! Method: an albedo needs only light's mean over azimuth. Two thicknesses of the thinnest layer are
//! extrapolated to none.

use super::fibres::Angles;
use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Make, Recipe, Target, points};
use crate::dataset::Axis;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock};

/// The largest estimated error that [`generate`](super::generate) accepts. A finer one costs time,
/// with the cube of the number of angles.
pub const ALLOWED_ERROR: f64 = 1e-5;
/// The least roughness: of smoother layers the rule would need hundreds of angles.
pub(super) const LEAST_ROUGHNESS: f64 = 0.25;
/// Sampled instead of n·v = 0, where a ray never leaves its height.
pub(super) const GRAZING: f64 = 0.001;
/// The thickness of the thinner of the two thinnest layers is 2 to the minus that. By hand: the
/// estimated error stays below the accepted one.
const HALVINGS: usize = 25;

pub(super) const TARGET: Target = Target {
    name: "sheen_volume_albedo",
    description: "directional albedo of a layer of fibres, scattering any number of times",
    columns: "roughness, n_dot_v → albedo",
    parameters: &[points("64", 1024), SAMPLING, SAMPLING_SEED],
    make: Make::Table(table),
};

/// The albedo of a layer over all angles.
#[derive(Clone, Debug)]
pub struct Layer {
    angles: Angles,
    /// At each angle.
    albedos: Vec<f64>,
    errors: Vec<f64>,
}

impl Layer {
    /// Computes the albedos for a `roughness` in [.25, 1], in some tens of milliseconds.
    pub fn new(roughness: f64) -> Layer {
        // By hand: the error falls with the fourth power of the angles between nodes over the cone.
        let count = (32.0 / roughness).ceil().clamp(64.0, 512.0) as usize;
        let sigma = roughness * roughness;
        let (fine, coarse) = (Layer::of_angles(count, sigma), Layer::of_angles(count / 2, sigma));
        let errors = fine.angles.theta.iter().zip(fine.albedos.iter().zip(&fine.errors));
        // Half the angles, sixteen times the error; half of that is left as a margin.
        let errors = errors.map(|(&theta, (albedo, error))| {
            error + (coarse.albedo(theta.cos())[0] - albedo).abs() / 8.0
        });
        Layer { errors: errors.collect(), ..fine.clone() }
    }

    /// Computes the albedos by so many angles, with the change by extrapolation as the error.
    fn of_angles(count: usize, sigma: f64) -> Layer {
        let angles = Angles::new(count);
        let mean = angles.mean(sigma);
        let [thick, thin] = [HALVINGS - 1, HALVINGS].map(|halvings| -> Vec<f64> {
            let reflected = angles.reflected(sigma, halvings, &mean, &mean);
            (0..count).map(|angle| reflected.row(angle).iter().sum()).collect()
        });
        let pairs = || thick.iter().zip(&thin);
        Layer {
            albedos: pairs().map(|(thick, thin)| 2.0 * thin - thick).collect(),
            errors: pairs().map(|(thick, thin)| (thin - thick).abs()).collect(),
            angles,
        }
    }

    /// The albedo at `n_dot_v` in [0, 1], and an estimate of its absolute error.
    pub fn albedo(&self, n_dot_v: f64) -> [f64; 2] {
        let weights = self.angles.weights_at(n_dot_v);
        [&self.albedos, &self.errors]
            .map(|values| weights.iter().zip(values).map(|(weight, value)| weight * value).sum())
    }
}

/// Returns the table on roughness from .25 to 1 and cosines on [0, 1] with .001 in place of 0. It
/// keeps each layer that it computed.
fn table(recipe: &Recipe) -> Table {
    let axes = vec![
        Axis { domain: [LEAST_ROUGHNESS, 1.0], ..Axis::unit("roughness") },
        Axis { least: Some(GRAZING), ..Axis::unit("n_dot_v") },
    ];
    let layers: Mutex<HashMap<u64, Arc<OnceLock<Layer>>>> = Mutex::default();
    let table = Table::new(recipe, axes, &[("albedo", "1")], ALLOWED_ERROR, move |at| {
        let layer = {
            let mut layers = layers.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
            Arc::clone(layers.entry(at[0].to_bits()).or_default())
        };
        let [albedo, error] = layer.get_or_init(|| Layer::new(at[0])).albedo(at[1]);
        Sample { values: [albedo], error }
    });
    table.claiming(ENERGY)
}

/// No more light leaves than arrives.
const ENERGY: &str = "energy: albedo <= 1";
