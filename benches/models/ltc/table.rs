//! Tables of the entries over roughness and `sqrt(1 - n·v)`, sampled bilinearly, as published.

use super::Outcome;
use super::scene::Entries;
use lgp::quadrature::TanhSinh;
use lgp::targets::dfg::{Masking, integrate};
use lgp::targets::ltc_ggx::Fitter;
use rayon::prelude::*;

pub struct Table {
    roughnesses: Vec<f64>,
    /// Nodes along the root.
    columns: usize,
    entries: Vec<Entries>,
}

impl Table {
    /// Fits the matrices at the nodes.
    pub fn fitted(roughnesses: Vec<f64>, columns: usize) -> Table {
        let (rule, fitter) = (TanhSinh::new(), Fitter::new());
        let node = |index: usize| {
            let root = (index % columns) as f64 / (columns - 1) as f64;
            let n_dot_v = (1.0 - root * root).max(1e-3);
            let alpha = roughnesses[index / columns].powi(2);
            let albedo = integrate(&rule, n_dot_v, alpha, Masking::Correlated);
            let magnitude = albedo.scale + albedo.bias;
            let [m11, m13, m31, m33] = fitter.fit(n_dot_v, alpha, magnitude).into();
            [m11, m13, m31, m33, magnitude, albedo.bias]
        };
        let entries = (0..roughnesses.len() * columns).into_par_iter().map(node).collect();
        Table { roughnesses, columns, entries }
    }

    /// A table of `nodes` places along each axis, as published.
    pub fn square(nodes: usize) -> Table {
        Table::fitted(regular(nodes), nodes)
    }

    /// Reads the published tables, rows (roughness, root, m11, m31, m13, m33) and (roughness, root,
    /// magnitude, fresnel, …): their second and third entry are ours in another order.
    pub fn published(matrix: &str, norm: &str) -> Outcome<Table> {
        let rows = |path: &str| -> Outcome<Vec<Vec<f64>>> {
            let text = std::fs::read_to_string(path)?;
            let row = |line: &str| line.split(',').map(str::parse).collect::<Result<Vec<_>, _>>();
            Ok(text.lines().skip(1).map(row).collect::<Result<_, _>>()?)
        };
        let (matrix, norm) = (rows(matrix)?, rows(norm)?);
        let nodes = matrix.len().isqrt();
        let mut entries = vec![[0.0; 6]; nodes * nodes];
        for (matrix, norm) in matrix.iter().zip(&norm) {
            let &[roughness, root, m11, m31, m13, m33] = &matrix[..] else {
                return Err("six columns of a matrix".into());
            };
            let [row, column] = [roughness, root].map(|at| (at * (nodes - 1) as f64).round());
            entries[row as usize * nodes + column as usize] =
                [m11, m13, m31, m33, norm[2], norm[3]];
        }
        Ok(Table { roughnesses: regular(nodes), columns: nodes, entries })
    }

    pub fn at(&self, n_dot_v: f64, roughness: f64) -> Entries {
        let after = self.roughnesses.partition_point(|&node| node <= roughness);
        let row = after.clamp(1, self.roughnesses.len() - 1) - 1;
        let [above, below] = [self.roughnesses[row], self.roughnesses[row + 1]];
        let down = (roughness - above) / (below - above);
        let place = (1.0 - n_dot_v).sqrt() * (self.columns - 1) as f64;
        let column = (place as usize).min(self.columns - 2);
        let right = place - column as f64;
        let node = |rows: usize, columns: usize| {
            self.entries[(row + rows) * self.columns + column + columns]
        };
        std::array::from_fn(|entry| {
            let along = |rows: usize| {
                let [a, b] = [node(rows, 0)[entry], node(rows, 1)[entry]];
                a + right * (b - a)
            };
            let [a, b] = [along(0), along(1)];
            a + down * (b - a)
        })
    }
}

fn regular(nodes: usize) -> Vec<f64> {
    (0..nodes).map(|at| at as f64 / (nodes - 1) as f64).collect()
}
