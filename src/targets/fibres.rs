//! What a layer of upright fibres reflects, in which light scatters any number of times: the volume of
//! the sheen of Zeltner, Burley and Chiang, "Practical Multiple-Scattering Sheen Using Linearly
//! Transformed Cosines", 2022 (OpenPBR's fuzz, Cycles' Microfiber).
//!
//! Definition: a slab of thickness and density 1 of SGGX fibres along n (Heitz, Dupuy, Crassin and
//! Dachsbacher, "The SGGX Microflake Distribution", 2015), flakes that reflect all light like mirrors,
//! over a black base. Of width σ = roughness², they extinguish `√(1 - μ² + σ² μ²)` of light, and
//! scatter `D(h) / 4` from v to l, `D(h) = 1 / (π σ (1 + k (n·h)²)²)`, `k = 1/σ² - 1`. Their tables
//! stop after 16 scatterings; light here goes on.
//!
//! Method: adding and doubling (van de Hulst, "Multiple Light Scattering", 1980, ch. 4), apart for
//! each order of light over azimuth, `cos(m φ)` (ch. 15). For the mean, m = 0, the integral of D is
//! elementary as in [`average_albedo`](super::average_albedo). Angles are those of a Gauss–Legendre
//! rule that crowds at both ends. Fibres scatter most light on into a narrow cone about its way; the
//! share that a direction scatters into itself is what conserves light, so that a cone too narrow for
//! the rule scatters nothing, its limit. The thinnest layer scatters at most once, which errs by
//! nearly its thickness. Between the rule's angles a polynomial interpolates.

use crate::quadrature::Rule;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Of the orders above the mean, over half a turn. By hand.
const AZIMUTHS: usize = 384;

/// Directions by their angle from n.
#[derive(Clone, Debug)]
pub(super) struct Angles {
    /// The rule's nodes in [-1, 1].
    nodes: Vec<f64>,
    /// Of the polynomial through them (Wang and Xiang, Mathematics of Computation 81, 2012, eq.
    /// 3.6).
    barycentric: Vec<f64>,
    pub theta: Vec<f64>,
    /// Their shares of `∫ sin θ dθ`.
    pub solid: Vec<f64>,
    /// Their shares of `∫ dθ`.
    pub plane: Vec<f64>,
}

/// How much light scatters from each angle (row) to each other's, of one order over azimuth.
pub(super) struct Order {
    /// Back to the side from which it comes.
    back: Matrix,
    /// On to the other.
    on: Matrix,
}

impl Angles {
    pub fn new(count: usize) -> Angles {
        let rule = Rule::gauss_legendre(count);
        let own: Vec<(f64, f64)> = rule
            .points()
            .iter()
            .filter(|point| point.weight > 0.0)
            .map(|point| (point.node, point.weight))
            .collect();
        let signs = [1.0, -1.0].into_iter().cycle();
        let barycentric = own
            .iter()
            .zip(signs)
            .map(|(&(node, weight), sign)| sign * ((1.0 - node) * (1.0 + node) * weight).sqrt());
        let theta: Vec<f64> = own.iter().map(|&(node, _)| angle_of(node)[0]).collect();
        let plane: Vec<f64> =
            own.iter().map(|&(node, weight)| weight * angle_of(node)[1]).collect();
        Angles {
            nodes: own.iter().map(|&(node, _)| node).collect(),
            barycentric: barycentric.collect(),
            solid: theta.iter().zip(&plane).map(|(theta, plane)| plane * theta.sin()).collect(),
            theta,
            plane,
        }
    }

    /// The weights of the angles in what is interpolated at a cosine in [0, 1].
    pub fn weights_at(&self, cosine: f64) -> Vec<f64> {
        let node = node_of(cosine.acos());
        if let Some(hit) = self.nodes.iter().position(|&at| at == node) {
            return (0..self.nodes.len()).map(|at| f64::from(u8::from(at == hit))).collect();
        }
        let shares =
            self.nodes.iter().zip(&self.barycentric).map(|(at, share)| share / (node - at));
        let shares: Vec<f64> = shares.collect();
        let sum: f64 = shares.iter().sum();
        shares.iter().map(|share| share / sum).collect()
    }

    /// The mean over azimuth.
    pub fn mean(&self, sigma: f64) -> Order {
        self.order(&|from, to| scattered(from, to, sigma))
    }

    /// The orders from 1 to `count`, of light by the azimuth of its way.
    pub fn orders(&self, sigma: f64, count: usize) -> Vec<Order> {
        let azimuths: Vec<f64> =
            (0..AZIMUTHS).map(|at| PI * (at as f64 + 0.5) / AZIMUTHS as f64).collect();
        let cosines: Vec<f64> = azimuths.iter().map(|phi| phi.cos()).collect();
        let size = self.theta.len();
        // For all pairs, first back, then on.
        let values: Vec<Vec<f64>> = [false, true]
            .into_iter()
            .flat_map(|on| (0..size * size).map(move |pair| (on, pair)))
            .map(|(on, pair)| {
                let [from, to] = [self.theta[pair / size], self.theta[pair % size]];
                let to = if on { PI - to } else { to };
                cosines.iter().map(|&cosine| phase(from, to, cosine, sigma)).collect()
            })
            .collect();
        let order = |m: usize| {
            // Light arrives from the opposite of its way.
            let sign = if m.is_multiple_of(2) { 1.0 } else { -1.0 };
            let waves: Vec<f64> = azimuths
                .iter()
                .map(|phi| sign * TAU / AZIMUTHS as f64 * (m as f64 * phi).cos())
                .collect();
            let cell = |pair: usize| -> f64 {
                values[pair].iter().zip(&waves).map(|(value, wave)| value * wave).sum()
            };
            let matrix =
                |first: usize| Matrix::of(size, |i, j| cell(first + i * size + j) * self.solid[j]);
            Order { back: matrix(0), on: matrix(size * size) }
        };
        (1..=count).map(order).collect()
    }

    fn order(&self, of: &dyn Fn(f64, f64) -> f64) -> Order {
        let between = |to: &dyn Fn(f64) -> f64| {
            Matrix::of(self.theta.len(), |i, j| {
                of(self.theta[i], to(self.theta[j])) * self.solid[j]
            })
        };
        Order { back: between(&|theta| theta), on: between(&|theta| PI - theta) }
    }

    /// Returns what the whole layer reflects from each angle (row) to each other's, of one order, if
    /// the thinnest layer is 2^-halvings thick. `mean` is what the layer scatters of the mean.
    pub fn reflected(&self, sigma: f64, halvings: usize, order: &Order, mean: &Order) -> Matrix {
        let Angles { theta, .. } = self;
        let count = theta.len();
        let Order { back, on } = order;
        let mut on = on.clone();
        let extinction = |i: usize| theta[i].sin().hypot(sigma * theta[i].cos());
        for i in 0..count {
            let sum: f64 = mean.back.row(i).iter().chain(mean.on.row(i)).sum();
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
        reflecting
    }
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

/// `D(h) / 4` from a direction to another, by their angles from n and the cosine of the azimuth
/// between them.
fn phase(from: f64, to: f64, cosine: f64, sigma: f64) -> f64 {
    let k = (1.0 - sigma) * (1.0 + sigma) / (sigma * sigma);
    let height = from.cos() + to.cos();
    let square = 2.0 + 2.0 * (from.cos() * to.cos() + from.sin() * to.sin() * cosine);
    let lifted = if square > 0.0 { height * height / square } else { 0.0 };
    1.0 / (4.0 * PI * sigma * (1.0 + k * lifted).powi(2))
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

/// A square matrix, row by row.
#[derive(Clone, Debug)]
pub(super) struct Matrix {
    size: usize,
    cells: Vec<f64>,
}

impl Matrix {
    fn of(size: usize, cell: impl Fn(usize, usize) -> f64) -> Matrix {
        let cells = (0..size * size).map(|index| cell(index / size, index % size)).collect();
        Matrix { size, cells }
    }

    pub fn row(&self, row: usize) -> &[f64] {
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
