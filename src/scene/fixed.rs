//! The rows of a split at one value of an input.

use crate::dataset::Split;

/// The number of a grid's planes from which a value between them is interpolated. Chosen by hand,
/// unmeasured.
const PLANES: usize = 4;

/// The distance within which values are the same, as a share of the domain. Chosen by hand,
/// unmeasured.
const SAME: f64 = 1e-6;

/// Returns a split at one value of the input in column `axis`, without that column. On a grid it is
/// the plane with the value, or Lagrange's polynomial through the nearest planes; otherwise it is
/// the rows with the value.
///
/// # Errors
/// The nearest value that occurs, if the rows are no grid and none has it, or if it lies more than
/// a cell beyond the grid.
pub(super) fn at(split: &Split, axis: usize, value: f64, domain: [f64; 2]) -> Result<Split, f64> {
    match split.grid.get(axis) {
        Some(_) => on_grid(split, axis, value),
        None => among_rows(split, axis, value, domain),
    }
}

fn among_rows(split: &Split, axis: usize, value: f64, [low, high]: [f64; 2]) -> Result<Split, f64> {
    let distance = |row: usize| (f64::from(split.columns[axis][row]) - value).abs();
    let same = SAME * (high - low);
    let rows: Vec<usize> = (0..split.rows()).filter(|&row| distance(row) <= same).collect();
    if rows.is_empty() {
        let nearest = (0..split.rows()).min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
        return Err(nearest.map_or(f64::NAN, |row| f64::from(split.columns[axis][row])));
    }
    let mut taken = super::view::gather(split, &rows);
    taken.columns.remove(axis);
    Ok(taken)
}

fn on_grid(split: &Split, axis: usize, value: f64) -> Result<Split, f64> {
    let planes = split.grid[axis];
    let stride: usize = split.grid[axis + 1..].iter().product();
    let place = |plane: usize| f64::from(split.columns[axis][plane * stride]);
    let mut nearest: Vec<usize> = (0..planes).collect();
    nearest.sort_by(|&a, &b| (place(a) - value).abs().total_cmp(&(place(b) - value).abs()));
    let first = nearest[0];
    let cell = nearest.get(1).map_or(0.0, |&second| (place(second) - place(first)).abs());
    if (place(first) - value).abs() > cell {
        return Err(place(first));
    }
    nearest.truncate(if place(first) == f64::from(value as f32) { 1 } else { PLANES });
    let shares: Vec<f64> = nearest
        .iter()
        .map(|&i| {
            let others = nearest.iter().filter(|&&j| j != i);
            others.map(|&j| (value - place(j)) / (place(i) - place(j))).product()
        })
        .collect();
    let block = planes * stride;
    let starts: Vec<usize> = (0..split.rows() / block)
        .flat_map(|outer| (0..stride).map(move |inner| outer * block + inner))
        .collect();
    let interpolated = |column: &Vec<f32>| {
        let value = |&start: &usize| {
            let terms = nearest.iter().zip(&shares);
            terms
                .map(|(plane, share)| share * f64::from(column[start + plane * stride]))
                .sum::<f64>()
        };
        starts.iter().map(|start| value(start) as f32).collect::<Vec<f32>>()
    };
    let taken = |column: &Vec<f32>| {
        starts.iter().map(|start| column[start + first * stride]).collect::<Vec<f32>>()
    };
    let inputs = split.grid.len();
    let mut grid = split.grid.clone();
    grid.remove(axis);
    let columns = split.columns.iter().enumerate().filter(|(index, _)| *index != axis);
    Ok(Split {
        columns: columns
            .map(
                |(index, column)| if index < inputs { taken(column) } else { interpolated(column) },
            )
            .collect(),
        weights: if split.weights.is_empty() { Vec::new() } else { taken(&split.weights) },
        dead_zone: Vec::new(),
        standard_errors: split.standard_errors.iter().map(taken).collect(),
        grid,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples `f` on a grid of 5 × 3 points.
    fn grid(f: impl Fn(f32, f32) -> f32) -> Split {
        let points: Vec<(f32, f32)> =
            (0..5).flat_map(|i| (0..3).map(move |j| (i as f32 / 4.0, j as f32 / 2.0))).collect();
        Split {
            columns: vec![
                points.iter().map(|p| p.0).collect(),
                points.iter().map(|p| p.1).collect(),
                points.iter().map(|p| f(p.0, p.1)).collect(),
            ],
            weights: points.iter().map(|p| 1.0 + p.1).collect(),
            grid: vec![5, 3],
            ..Split::default()
        }
    }

    #[test]
    fn a_plane_is_taken_as_it_is_and_cubics_are_met_between_planes() {
        let f = |x: f32, y: f32| 3.0 * x * x * x - x + y * y;
        let taken = at(&grid(f), 0, 0.25, [0.0, 1.0]).unwrap();
        assert_eq!(taken.columns[1], [0.0, 0.5, 1.0].map(|y| f(0.25, y)));
        assert_eq!(taken.grid, [3]);
        assert_eq!(taken.weights, [1.0, 1.5, 2.0]);
        for x in [0.1, 0.6, 0.99, 1.1] {
            let between = at(&grid(f), 0, f64::from(x), [0.0, 1.0]).unwrap();
            for (found, y) in between.columns[1].iter().zip([0.0, 0.5, 1.0]) {
                assert!((found - f(x, y)).abs() < 1e-5, "{x}, {y}: {found}");
            }
        }
        // Along the other axis three planes only: parabolas are met.
        let other = at(&grid(f), 1, 0.3, [0.0, 1.0]).unwrap();
        assert_eq!(other.grid, [5]);
        for (x, found) in other.columns[0].iter().zip(&other.columns[1]) {
            assert!((found - f(*x, 0.3)).abs() < 1e-5);
        }
        assert_eq!(at(&grid(f), 0, 2.0, [0.0, 1.0]), Err(1.0));
    }

    #[test]
    fn scattered_rows_are_taken_where_they_have_the_value() {
        let split = Split {
            columns: vec![vec![0.1, 0.5, 0.5], vec![1.0, 2.0, 3.0], vec![7.0, 8.0, 9.0]],
            ..Split::default()
        };
        let taken = at(&split, 0, 0.5, [0.0, 1.0]).unwrap();
        assert_eq!(taken.columns, [[2.0, 3.0], [8.0, 9.0]]);
        assert_eq!(at(&split, 0, 0.25, [0.0, 1.0]), Err(f64::from(0.1f32)));
    }
}
