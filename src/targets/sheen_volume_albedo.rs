//! The directional albedo of a layer of upright fibres in which light scatters any number of times,
//! the sheen of Zeltner, Burley and Chiang, "Practical Multiple-Scattering Sheen Using Linearly
//! Transformed Cosines", 2022 (OpenPBR's fuzz, Cycles' Microfiber).
//!
//! Definition: their volume, a slab of thickness and density 1 of SGGX fibres along n (Heitz,
//! Dupuy, Crassin and Dachsbacher, "The SGGX Microflake Distribution", 2015), flakes that reflect
//! all light like mirrors, over a black base. Of width σ = roughness², they extinguish
//! `√(1 - μ² + σ² μ²)` of light, and scatter `D(h) / 4` from v to l,
//! `D(h) = 1 / (π σ (1 + k (n·h)²)²)`, `k = 1/σ² - 1`. Their tables stop after 16 scatterings;
//! light here goes on.
//!
//! Method: adding and doubling (van de Hulst, "Multiple Light Scattering", 1980, ch. 4). An albedo
//! needs only light's mean over azimuth, over which the integral of D is elementary as in
//! [`average_albedo`](super::average_albedo). Angles are those of a Gauss–Legendre rule that crowds
//! at both ends. Fibres scatter most light on into a narrow cone about its way; the share that a
//! direction scatters into itself is what conserves light, so that a cone too narrow for the rule
//! scatters nothing, its limit. The thinnest layer scatters at most once, which errs by nearly its
//! thickness: two thicknesses are extrapolated to none. Between the rule's angles albedos are
//! interpolated by their polynomial.

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Make, Recipe, Target, points};
use crate::dataset::Axis;
use crate::quadrature::Rule;
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::{Arc, Mutex, OnceLock};

/// The largest estimated error that [`generate`](super::generate) accepts. A finer one costs time,
/// with the cube of the number of angles.
pub const ALLOWED_ERROR: f64 = 1e-5;
/// The least roughness: of smoother layers the rule would need hundreds of angles.
const LEAST_ROUGHNESS: f64 = 0.25;
/// Sampled instead of n·v = 0, where a ray never leaves its height.
const GRAZING: f64 = 0.001;
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
    /// The rule's nodes in [-1, 1].
    nodes: Vec<f64>,
    /// Of the polynomial through them (Wang and Xiang, Mathematics of Computation 81, 2012, eq.
    /// 3.6).
    barycentric: Vec<f64>,
    /// At each node.
    albedos: Vec<f64>,
    errors: Vec<f64>,
}

impl Layer {
    /// Computes the albedos for a `roughness` in [.25, 1], in some tens of milliseconds.
    pub fn new(roughness: f64) -> Layer {
        // By hand: the error falls with the fourth power of the angles between nodes over the cone.
        let count = (32.0 / roughness).ceil().clamp(64.0, 512.0) as usize;
        let sigma = roughness * roughness;
        let (fine, coarse) = (Layer::of_rule(count, sigma), Layer::of_rule(count / 2, sigma));
        let errors = fine.nodes.iter().zip(fine.albedos.iter().zip(&fine.errors));
        // Half the angles, sixteen times the error; half of that is left as a margin.
        let errors = errors.map(|(&node, (albedo, error))| {
            error + (coarse.interpolated(&coarse.albedos, node) - albedo).abs() / 8.0
        });
        Layer { errors: errors.collect(), ..fine.clone() }
    }

    /// Computes the albedos by a rule of so many nodes, with the change by extrapolation as the
    /// error.
    fn of_rule(count: usize, sigma: f64) -> Layer {
        let rule = legendre(count);
        let [thick, thin] =
            [HALVINGS - 1, HALVINGS].map(|halvings| reflected(&rule, sigma, halvings));
        let nodes = rule.iter().map(|&(node, _)| node).collect();
        let signs = [1.0, -1.0].into_iter().cycle();
        let barycentric = rule
            .iter()
            .zip(signs)
            .map(|(&(node, weight), sign)| sign * ((1.0 - node) * (1.0 + node) * weight).sqrt());
        let pairs = || thick.iter().zip(&thin);
        Layer {
            nodes,
            barycentric: barycentric.collect(),
            albedos: pairs().map(|(thick, thin)| 2.0 * thin - thick).collect(),
            errors: pairs().map(|(thick, thin)| (thin - thick).abs()).collect(),
        }
    }

    /// The albedo at `n_dot_v` in [0, 1], and an estimate of its absolute error.
    pub fn albedo(&self, n_dot_v: f64) -> [f64; 2] {
        let node = node_of(n_dot_v.acos());
        [&self.albedos, &self.errors].map(|values| self.interpolated(values, node))
    }

    fn interpolated(&self, values: &[f64], node: f64) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for ((&at, &weight), &value) in self.nodes.iter().zip(&self.barycentric).zip(values) {
            if at == node {
                return value;
            }
            let share = weight / (node - at);
            sum += share * value;
            weights += share;
        }
        sum / weights
    }
}

/// Nodes and weights of a Gauss–Legendre rule.
fn legendre(count: usize) -> Vec<(f64, f64)> {
    let rule = Rule::gauss_legendre(count);
    let own = rule.points().iter().filter(|point| point.weight > 0.0);
    own.map(|point| (point.node, point.weight)).collect()
}

/// The angle from n of a node, `π/2 (3 u² - 2 u³)` with `u = (1 + node)/2`, and its derivative.
fn angle_of(node: f64) -> [f64; 2] {
    let u = 0.5 * (1.0 + node);
    [FRAC_PI_2 * u * u * (3.0 - 2.0 * u), FRAC_PI_2 * 3.0 * u * (1.0 - u)]
}

/// The inverse of [`angle_of`].
fn node_of(angle: f64) -> f64 {
    -2.0 * ((1.0 - 2.0 * angle / FRAC_PI_2).clamp(-1.0, 1.0).asin() / 3.0).sin()
}

/// `∫ D(h) / 4 dφ` from a direction to another, by their angles from n.
fn scattered(from: f64, to: f64, sigma: f64) -> f64 {
    let k = (1.0 - sigma) * (1.0 + sigma) / (sigma * sigma);
    let near = (0.5 * (from - to)).cos().powi(2);
    let far = (0.5 * (from + to)).cos().powi(2);
    let (across, along) = (1.0 + k * near, 1.0 + k * far);
    let product = across * along;
    let lifted = k * (near * far / product).sqrt();
    let slope = k * (far * across + near * along) / product;
    (2.0 - lifted * (4.0 - slope)) / (4.0 * sigma)
}

/// Returns what the whole layer reflects of light at each node's angle, if the thinnest layer is
/// 2^-halvings thick.
fn reflected(rule: &[(f64, f64)], sigma: f64, halvings: usize) -> Vec<f64> {
    let count = rule.len();
    let theta: Vec<f64> = rule.iter().map(|&(node, _)| angle_of(node)[0]).collect();
    let solid = |&(node, weight): &(f64, f64)| {
        let [theta, slope] = angle_of(node);
        weight * slope * theta.sin()
    };
    let solid: Vec<f64> = rule.iter().map(solid).collect();
    let between = |to: &dyn Fn(f64) -> f64| {
        Matrix::of(count, |i, j| scattered(theta[i], to(theta[j]), sigma) * solid[j])
    };
    let (back, mut on) = (between(&|theta| theta), between(&|theta| PI - theta));
    let extinction = |i: usize| theta[i].sin().hypot(sigma * theta[i].cos());
    for i in 0..count {
        let sum: f64 = back.row(i).iter().chain(on.row(i)).sum();
        on.cells[i * count + i] += extinction(i) - sum;
    }
    // Along a ray that crosses a layer of thickness 1.
    let depth: Vec<f64> = (0..count).map(|i| extinction(i) / theta[i].cos()).collect();
    let thickness = 0.5_f64.powi(halvings as i32);
    let mut reflecting = Matrix::of(count, |i, j| {
        let depth = depth[i] + depth[j];
        back.row(i)[j] / theta[i].cos() * -(-thickness * depth).exp_m1() / depth
    });
    let mut transmitting = Matrix::of(count, |i, j| {
        let difference = thickness * (depth[i] - depth[j]).abs();
        let mean = if difference > 0.0 { -(-difference).exp_m1() / difference } else { 1.0 };
        let once = thickness * (-thickness * depth[i].min(depth[j])).exp() * mean;
        let direct = if i == j { (-thickness * depth[i]).exp() } else { 0.0 };
        direct + on.row(i)[j] / theta[i].cos() * once
    });
    for _ in 0..halvings {
        let through = reflecting.times(&reflecting).resolvent(&transmitting);
        let turned = transmitting.times(&reflecting.times(&through));
        reflecting = reflecting.plus(&turned);
        transmitting = transmitting.times(&through);
    }
    (0..count).map(|i| reflecting.row(i).iter().sum()).collect()
}

/// A square matrix, row by row.
struct Matrix {
    size: usize,
    cells: Vec<f64>,
}

impl Matrix {
    fn of(size: usize, cell: impl Fn(usize, usize) -> f64) -> Matrix {
        let cells = (0..size * size).map(|index| cell(index / size, index % size)).collect();
        Matrix { size, cells }
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.cells[row * self.size..][..self.size]
    }

    fn plus(&self, other: &Matrix) -> Matrix {
        let cells = self.cells.iter().zip(&other.cells).map(|(a, b)| a + b).collect();
        Matrix { size: self.size, cells }
    }

    fn times(&self, other: &Matrix) -> Matrix {
        let mut cells = vec![0.0; self.cells.len()];
        for (sums, row) in cells.chunks_exact_mut(self.size).zip(self.cells.chunks_exact(self.size))
        {
            for (&factor, others) in row.iter().zip(other.cells.chunks_exact(self.size)) {
                subtract(sums, -factor, others);
            }
        }
        Matrix { size: self.size, cells }
    }

    /// Solves `(1 - self) x = right` by elimination without exchange of rows: self is what light
    /// does between two layers, whose rows sum to less than 1.
    fn resolvent(&self, right: &Matrix) -> Matrix {
        let size = self.size;
        let mut left = Matrix::of(size, |i, j| f64::from(u8::from(i == j)) - self.row(i)[j]).cells;
        let mut cells = right.cells.clone();
        for pivot in 0..size {
            let (above, below) = left.split_at_mut((pivot + 1) * size);
            let (solved, rest) = cells.split_at_mut((pivot + 1) * size);
            let (row, solved) = (&above[pivot * size..], &solved[pivot * size..]);
            for (other, sums) in below.chunks_exact_mut(size).zip(rest.chunks_exact_mut(size)) {
                let factor = other[pivot] / row[pivot];
                subtract(&mut other[pivot..], factor, &row[pivot..]);
                subtract(sums, factor, solved);
            }
        }
        for row in (0..size).rev() {
            let (above, below) = cells.split_at_mut((row + 1) * size);
            let sums = &mut above[row * size..];
            let factors = &left[row * size..][..size];
            for (&factor, solved) in factors[row + 1..].iter().zip(below.chunks_exact(size)) {
                subtract(sums, factor, solved);
            }
            sums.iter_mut().for_each(|sum| *sum /= factors[row]);
        }
        Matrix { size, cells }
    }
}

/// `sums -= factor * terms`
fn subtract(sums: &mut [f64], factor: f64, terms: &[f64]) {
    sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum -= factor * term);
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
