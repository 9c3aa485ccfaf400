//! The grids on which lobes are sampled.

use super::{Lobe, Microsurface, Sampler, lobes};
use crate::dataset::Split;
use crate::microfacet::{diffuse, half_vector};
use crate::quadrature::Estimate;
use glam::DVec3;
use rayon::prelude::*;

/// The standard error, in 1/sr, at which a row counts half: about the error of a good formula. By
/// hand.
const TOLERABLE: f64 = 0.005;

/// Every combination of a width, an angle of the light, one of the view, and an azimuth between
/// them, which is 0 if they are on the same side. Angles in radians.
pub(super) struct Grid {
    alphas: Vec<f64>,
    /// From the normal, of light and view alike.
    angles: Vec<f64>,
    azimuths: Vec<f64>,
    /// True if rows are weighted by the measure of their cells.
    by_cell: bool,
}

impl Grid {
    /// 3584 rows: centres of cells, except along the azimuth.
    pub(super) fn fine() -> Grid {
        Grid {
            alphas: (0..8).map(|i| (f64::from(i) + 0.5) / 8.0).collect(),
            angles: (0..8).map(|i| ((f64::from(i) + 0.5) * 11.25).to_radians()).collect(),
            azimuths: (0..7).map(|i| (f64::from(i) * 30.0).to_radians()).collect(),
            by_cell: false,
        }
    }

    /// 1470 rows, the grid of the reference values in the tests.
    pub(super) fn coarse() -> Grid {
        Grid {
            alphas: vec![0.1, 0.3, 0.5, 0.7, 0.85, 1.0],
            angles: [5.0, 20.0, 35.0, 50.0, 65.0, 75.0, 85.0].map(f64::to_radians).to_vec(),
            azimuths: [0.0, 45.0, 90.0, 135.0, 180.0].map(f64::to_radians).to_vec(),
            by_cell: false,
        }
    }

    /// 6561 rows, with the ends of every axis; none is in another grid.
    pub(super) fn validation() -> Grid {
        let angle = |i: i32| (f64::from(i) * 11.25).min(89.0).to_radians();
        Grid {
            alphas: (0..=8).map(|i| f64::from(i) / 8.0).collect(),
            angles: (0..=8).map(angle).collect(),
            azimuths: (0..=8).map(|i| (f64::from(i) * 22.5).to_radians()).collect(),
            by_cell: true,
        }
    }

    /// Returns the widths and angles of the light.
    pub(super) fn lights(&self) -> Vec<(f64, f64)> {
        let with = |&alpha| self.angles.iter().map(move |&angle| (alpha, angle));
        self.alphas.iter().flat_map(with).collect()
    }

    fn views(&self) -> Vec<DVec3> {
        let with = |&angle| self.azimuths.iter().map(move |&azimuth| direction(angle, azimuth));
        self.angles.iter().flat_map(with).collect()
    }

    /// Traces the lobes of all rows, the azimuth varying fastest. Each light has a stream of random
    /// numbers of its own, from `first_stream` on.
    pub(super) fn trace(
        &self,
        sampler: Sampler,
        paths: usize,
        first_stream: u64,
        after_block: &(dyn Fn() + Sync),
    ) -> Vec<Lobe> {
        let views = self.views();
        let of_lights: Vec<Vec<Lobe>> = self
            .lights()
            .into_par_iter()
            .enumerate()
            .map(|(light, (alpha, angle))| {
                let stream = first_stream + light as u64;
                let l = direction(angle, 0.0);
                if alpha == 0.0 {
                    return views.iter().map(|v| flat(l.z, v.z)).collect();
                }
                let surface = Microsurface { alpha, sampler };
                lobes(surface, l, &views, paths, stream, after_block)
            })
            .collect();
        of_lights.into_iter().flatten().collect()
    }

    /// Counts the lights that need paths.
    pub(super) fn rough_lights(&self) -> usize {
        self.lights().iter().filter(|(alpha, _)| *alpha > 0.0).count()
    }

    /// Returns the lobes of all rows as a table.
    pub(super) fn split(&self, lobes: &[Lobe], standard_errors_as_columns: bool) -> Split {
        let mut columns = vec![Vec::new(); if standard_errors_as_columns { 9 } else { 7 }];
        let mut weights = Vec::new();
        let views = self.views();
        let lights = self.lights();
        let rows = lights.iter().flat_map(|light| views.iter().map(move |v| (light, v)));
        for ((&(alpha, angle), v), lobe) in rows.zip(lobes) {
            let l = direction(angle, 0.0);
            let n_dot_h = half_vector::n_dot_h(l.z, v.z, l.dot(*v)).min(1.0);
            let Lobe { single, multi, .. } = lobe;
            let inputs = [alpha, l.z, v.z, n_dot_h, l.dot(*v).clamp(-1.0, 1.0)];
            let outputs = [single.value, multi.value, single.error, multi.error];
            for (column, value) in columns.iter_mut().zip(inputs.into_iter().chain(outputs)) {
                column.push(value as f32);
            }
            let noise = (single.error.powi(2) + multi.error.powi(2)) / TOLERABLE.powi(2);
            weights.push(if standard_errors_as_columns { 1.0 } else { 1.0 / (1.0 + noise) });
        }
        if self.by_cell {
            weights.iter_mut().zip(self.cells()).for_each(|(weight, cell)| *weight *= cell);
        }
        let mean = weights.iter().sum::<f64>() / weights.len() as f64;
        let weights = weights.iter().map(|weight| (weight / mean) as f32).collect();
        let errors = |of: fn(&Lobe) -> Estimate| -> Vec<f32> {
            lobes.iter().map(|lobe| of(lobe).error as f32).collect()
        };
        let standard_errors = match standard_errors_as_columns {
            true => Vec::new(),
            false => vec![errors(|lobe| lobe.single), errors(|lobe| lobe.multi)],
        };
        Split { columns, weights, standard_errors, ..Split::default() }
    }

    /// Returns the measures of the rows' cells (trapezoidal), up to a factor.
    fn cells(&self) -> Vec<f64> {
        [&self.alphas, &self.angles, &self.angles, &self.azimuths].into_iter().fold(
            vec![1.0],
            |cells, axis| {
                let last = axis.len() - 1;
                let length = |i: usize| axis[(i + 1).min(last)] - axis[i.saturating_sub(1)];
                let with = |cell: &f64| (0..=last).map(|i| cell * length(i)).collect::<Vec<_>>();
                cells.iter().flat_map(with).collect()
            },
        )
    }
}

fn direction(angle: f64, azimuth: f64) -> DVec3 {
    DVec3::new(angle.sin() * azimuth.cos(), angle.sin() * azimuth.sin(), angle.cos())
}

/// The limit of a smooth surface, without the mirrored direction.
fn flat(n_dot_l: f64, n_dot_v: f64) -> Lobe {
    let exactly = |value| Estimate { value, error: 0.0, evaluations: 0 };
    Lobe {
        specular: exactly(0.0),
        single: exactly(diffuse::under_interface(n_dot_l, n_dot_v, super::microsurface::F0)),
        multi: exactly(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_have_the_rows_they_say_and_share_none() {
        let rows = |grid: &Grid| -> Vec<Vec<u32>> {
            let smooth = vec![flat(0.5, 0.5); grid.lights().len() * grid.views().len()];
            let split = grid.split(&smooth, false);
            let row =
                |i: usize| split.columns[..5].iter().map(|column| column[i].to_bits()).collect();
            (0..split.rows()).map(row).collect()
        };
        let validation = rows(&Grid::validation());
        assert_eq!(validation.len(), 6561);
        for (grid, expected) in [(Grid::fine(), 3584), (Grid::coarse(), 1470)] {
            let searched = rows(&grid);
            assert_eq!(searched.len(), expected);
            assert!(searched.iter().all(|row| !validation.contains(row)));
        }
    }

    #[test]
    fn cells_at_the_ends_are_halves() {
        let grid = Grid::validation();
        let (cells, row) = (grid.cells(), |a: usize, l: usize| ((a * 9 + l) * 9 + 4) * 9 + 4);
        let inside = cells[row(4, 4)];
        assert!((cells[row(0, 4)] / inside - 0.5).abs() < 1e-12);
        assert!((cells[row(8, 0)] / inside - 0.25).abs() < 1e-12);
    }
}
