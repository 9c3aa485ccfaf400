//! The accuracy of textures used in place of a formula.

use crate::dataset::Split;
use serde::Serialize;

/// A table of `size` texels along each input, read with linear interpolation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LookupTable {
    /// Texels along each input.
    pub size: usize,
    /// RMSE and maximum over all outputs, on the search split.
    pub error: [f64; 2],
}

/// The texels along each input that are tried.
const SIZES: [usize; 4] = [4, 8, 16, 32];

/// Returns tables with at most half as many texels along each input as a split has points, if the
/// split is a full grid of cell centres over one to three inputs; else none. Texels are
/// interpolated from the split at their centres; outside, the nearest is taken, as a sampler that
/// clamps does.
pub fn lookup_tables(split: &Split, outputs: usize) -> Vec<LookupTable> {
    let grid = &split.grid;
    let fewest = grid.iter().copied().min().unwrap_or(0);
    if !(1..=3).contains(&grid.len()) {
        return Vec::new();
    }
    let sizes = SIZES.into_iter().filter(|size| 2 * size <= fewest);
    let columns = &split.columns[split.columns.len() - outputs..];
    sizes.map(|size| LookupTable { size, error: error(columns, grid, size) }).collect()
}

fn error(columns: &[Vec<f32>], grid: &[usize], size: usize) -> [f64; 2] {
    let texels = vec![size; grid.len()];
    let (mut squares, mut max) = (0.0, 0.0f64);
    for column in columns {
        let table: Vec<f32> = centres(&texels).map(|at| read(column, grid, &at)).collect();
        let mut sum = 0.0;
        for (at, truth) in centres(grid).zip(column) {
            let difference = f64::from(read(&table, &texels, &at)) - f64::from(*truth);
            sum += difference.powi(2);
            max = max.max(difference.abs());
        }
        squares += sum / column.len() as f64;
    }
    [(squares / columns.len() as f64).sqrt(), max]
}

/// Returns the centres of a grid's cells, each coordinate in [0, 1], the last varying fastest.
fn centres(grid: &[usize]) -> impl Iterator<Item = Vec<f64>> + '_ {
    (0..grid.iter().product()).map(move |row| {
        let mut rest: usize = row;
        let mut at = vec![0.0; grid.len()];
        for (place, points) in at.iter_mut().zip(grid).rev() {
            *place = ((rest % points) as f64 + 0.5) / *points as f64;
            rest /= points;
        }
        at
    })
}

/// Interpolates linearly between the cell centres of a grid.
fn read(values: &[f32], grid: &[usize], at: &[f64]) -> f32 {
    let mut sum = 0.0;
    for corner in 0..1usize << grid.len() {
        let (mut index, mut weight) = (0, 1.0);
        for (axis, (&points, place)) in grid.iter().zip(at).enumerate() {
            let along = (place * points as f64 - 0.5).clamp(0.0, (points - 1) as f64);
            let low = (along as usize).min(points.saturating_sub(2));
            let upper = corner >> axis & 1;
            weight *= if upper == 1 { along - low as f64 } else { 1.0 - (along - low as f64) };
            index = index * points + (low + upper).min(points - 1);
        }
        sum += weight * f64::from(values[index]);
    }
    sum as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(f: impl Fn(f64, f64) -> f64) -> Split {
        let values = centres(&[16, 32]).map(|at| f(at[0], at[1]) as f32).collect();
        let inputs = vec![vec![0.0; 512]; 2];
        Split { columns: [inputs, vec![values]].concat(), grid: vec![16, 32], ..Split::default() }
    }

    #[test]
    fn a_plane_is_exact_but_for_its_rim() {
        let tables = lookup_tables(&split(|x, y| x + 2.0 * y), 1);
        assert_eq!(tables.iter().map(|table| table.size).collect::<Vec<_>>(), [4, 8]);
        // Between the first texel's centre and the first point's: (1/8 − 1/32) and twice (1/8 − 1/64).
        let expected = (0.125 - 0.03125) + 2.0 * (0.125 - 0.015625);
        assert!((tables[0].error[1] - expected).abs() < 1e-6, "{tables:?}");
        assert!(tables[1].error[0] < tables[0].error[0]);
    }

    #[test]
    fn a_constant_is_exact_and_rows_that_are_no_grid_have_no_table() {
        assert_eq!(lookup_tables(&split(|_, _| 0.5), 1)[0].error, [0.0, 0.0]);
        assert!(lookup_tables(&Split { grid: vec![], ..split(|x, _| x) }, 1).is_empty());
    }
}
