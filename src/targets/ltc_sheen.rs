//! Linearly transformed cosines of sheen: the lobes of a layer of upright fibres (`fibres`).
//!
//! Definition (Zeltner, Burley and Chiang, "Practical Multiple-Scattering Sheen Using Linearly
//! Transformed Cosines", 2022): a cosine lobe about n whose directions a matrix M transforms, times
//! the layer's albedo. In a frame with n as z and v in the plane of x and z, x > 0, M⁻¹ is
//! `[m11 0 m13; 0 m11 0; 0 0 1]` (row, column); theirs are A = m11 and B = m13. As their program
//! (`fitting/python/fit_ltc_sheen_volume.py` of github.com/tizian/ltc-sheen), the fit minimises
//! `∫∫ |lobe - layer|³ dθ dφ` over angles of the hemisphere, not over solid angles. It differs in
//! that the layer's lobe is computed, not estimated by random walks of at most 16 scatterings, and
//! the integral is one instead of a sum over 32×32 angles: at grazing angles, where the lobe is as
//! narrow as their bins, m11 is less, by 7 % at roughness .26 and n·v = .01.
//!
//! Method: the layer's lobe by its orders over azimuth, the fit by a simplex.

use super::fibres::{Angles, Matrix};
use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::sheen_volume_albedo::{GRAZING, LEAST_ROUGHNESS};
use super::simplex;
use super::table::{Sample, Table};
use super::{Make, Recipe, Target, points};
use crate::dataset::Axis;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use std::sync::{Arc, Mutex, OnceLock};

/// The largest error of a value.
pub const ERROR: f64 = 1e-3;
/// Angles of the layer; by hand, for [`ERROR`].
const ANGLES: usize = 64;
/// Azimuths over half a turn at which lobes are compared.
const AZIMUTHS: usize = 64;
/// The thinnest layer is 2 to the minus that thick; by hand, for [`ERROR`].
const HALVINGS: usize = 18;

pub(super) const TARGET: Target = Target {
    name: "ltc_sheen",
    description: "linearly transformed cosines of the sheen of fibres: inverse matrix, albedo",
    columns: "roughness, n_dot_v → m11, m13, albedo",
    parameters: &[points("32", 1024), SAMPLING, SAMPLING_SEED],
    make: Make::Table(table),
};

/// A transformed cosine: its inverse matrix is `[m11 0 m13; 0 m11 0; 0 0 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    /// x to x and y to y.
    pub m11: f64,
    /// z to x.
    pub m13: f64,
    /// The lobe's magnitude.
    pub albedo: f64,
}

/// What a layer reflects to all directions.
#[derive(Debug)]
pub struct Layer {
    angles: Angles,
    /// By their order over azimuth, from 0.
    orders: Vec<Matrix>,
}

impl Layer {
    /// Computes the layer for a `roughness` in [.25, 1], in a second or two.
    pub fn new(roughness: f64) -> Layer {
        // By hand, for ERROR; a layer of roughness 1 scatters alike to all sides.
        Layer::of(ANGLES, (8.0 / roughness).ceil() as usize, roughness)
    }

    fn of(count: usize, orders: usize, roughness: f64) -> Layer {
        let sigma = roughness * roughness;
        let angles = Angles::new(count);
        let mean = angles.mean(sigma);
        let others = angles.orders(sigma, orders);
        let all = std::iter::once(&mean).chain(&others);
        let reflected = |order| angles.reflected(sigma, HALVINGS, order, &mean);
        Layer { orders: all.map(reflected).collect(), angles }
    }

    /// Fits the transformed cosine at `n_dot_v` in [.001, 1].
    pub fn fit(&self, n_dot_v: f64) -> Lobe {
        let weights = self.angles.weights_at(n_dot_v);
        let angles = 0..self.angles.theta.len();
        let reflected = |order: &Matrix, to: usize| -> f64 {
            weights.iter().enumerate().map(|(from, weight)| weight * order.row(from)[to]).sum()
        };
        let albedo: f64 = angles.clone().map(|to| reflected(&self.orders[0], to)).sum();
        let azimuths = (0..AZIMUTHS).map(|at| PI * (at as f64 + 0.5) / AZIMUTHS as f64);
        let places: Vec<Place> = angles
            .flat_map(|to| {
                // Over the azimuth from v, which is half a turn from that of the light's way.
                let amplitudes: Vec<f64> = self.orders.iter().map(|o| reflected(o, to)).collect();
                let (sine, cosine) = self.angles.theta[to].sin_cos();
                let [solid, plane] = [self.angles.solid[to], self.angles.plane[to]];
                azimuths.clone().map(move |phi| {
                    let term = |(m, amplitude): (usize, &f64)| {
                        let twice = if m == 0 { 1.0 } else { 2.0 };
                        twice * amplitude * (m as f64 * (phi + PI)).cos()
                    };
                    let sum: f64 = amplitudes.iter().enumerate().map(term).sum();
                    Place {
                        direction: [sine * phi.cos(), sine * phi.sin(), cosine],
                        density: sum / (TAU * solid * albedo),
                        weight: plane,
                    }
                })
            })
            .collect();
        let [m11, m13] = simplex::minimum([0.6, -0.05], 0.1, |at| misfit(at, &places));
        Lobe { m11, m13, albedo }
    }
}

/// A direction of the hemisphere.
struct Place {
    direction: [f64; 3],
    /// Of the layer's lobe, per steradian; it integrates to 1.
    density: f64,
    weight: f64,
}

fn misfit([m11, m13]: [f64; 2], places: &[Place]) -> f64 {
    if m11 <= 0.0 {
        return f64::INFINITY;
    }
    let term = |place: &Place| {
        let [x, y, z] = place.direction;
        let (across, along) = (m11 * x + m13 * z, m11 * y);
        let square = across * across + along * along + z * z;
        // The determinant is m11², and z is as it was.
        let cosine = m11 * m11 / PI * z / (square * square);
        place.weight * (cosine - place.density).abs().powi(3)
    };
    places.iter().map(term).sum()
}

/// Returns the table on roughness from .25 to 1 and cosines on [0, 1] with .001 in place of 0. It
/// keeps each layer that it computed.
fn table(recipe: &Recipe) -> Table {
    let axes = vec![
        Axis { domain: [LEAST_ROUGHNESS, 1.0], ..Axis::unit("roughness") },
        Axis { least: Some(GRAZING), ..Axis::unit("n_dot_v") },
    ];
    let outputs = &[("m11", "1"), ("m13", "1"), ("albedo", "1")];
    let layers: Mutex<HashMap<u64, Arc<OnceLock<Layer>>>> = Mutex::default();
    let table = Table::new(recipe, axes, outputs, ERROR, move |at| {
        let layer = {
            let mut layers = layers.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
            Arc::clone(layers.entry(at[0].to_bits()).or_default())
        };
        let Lobe { m11, m13, albedo } = layer.get_or_init(|| Layer::new(at[0])).fit(at[1]);
        Sample { values: [m11, m13, albedo], error: ERROR }
    });
    table.claiming(ENERGY)
}

/// No more light leaves than arrives.
const ENERGY: &str = "energy: albedo <= 1";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_angles_and_orders_change_values_by_less_than_the_stated_error() {
        for roughness in [0.25, 0.5, 0.8] {
            let layer = Layer::new(roughness);
            let finer = Layer::of(96, (12.0 / roughness).ceil() as usize, roughness);
            for n_dot_v in [0.001, 0.1, 0.4, 0.8, 1.0] {
                let [a, b] = [&layer, &finer].map(|layer| layer.fit(n_dot_v));
                let off = [a.m11 - b.m11, a.m13 - b.m13, a.albedo - b.albedo].map(f64::abs);
                assert!(off.iter().all(|off| *off < ERROR), "{roughness} {n_dot_v}: {a:?} {b:?}");
            }
        }
    }

    /// Its phase function is that of a ball, so that azimuths do not matter.
    #[test]
    fn the_roughest_layer_has_a_lobe_about_the_normal() {
        let layer = Layer::new(1.0);
        for n_dot_v in [0.1, 0.7] {
            let m13 = layer.fit(n_dot_v).m13;
            assert!(m13.abs() < 1e-6, "{n_dot_v}: {m13}");
        }
    }

    #[test]
    fn albedos_are_those_of_the_mean_alone() {
        for roughness in [0.3, 0.7] {
            let layer = Layer::new(roughness);
            let mean = super::super::sheen_volume_albedo::Layer::new(roughness);
            for n_dot_v in [0.05, 0.5, 0.9] {
                let off = layer.fit(n_dot_v).albedo - mean.albedo(n_dot_v)[0];
                assert!(off.abs() < ERROR, "{roughness} {n_dot_v}: {off}");
            }
        }
    }
}
