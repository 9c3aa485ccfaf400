//! The GGX distribution relative to its peak, `π α² D`: a known formula that single precision
//! spoils unless it is written with care.
//!
//! The textbook's `n·h²(α² - 1) + 1` cancels where the lobe is narrow. Rows are
//! spread over the lobe of each width: n·h at equal steps of the fraction
//! `t² / (1 + t²)`, t = tan θ / α, of the normals nearer to n, α at equal ratios
//! from .001 to 1. The truth is that of n·h and α as rounded to f32.

use super::{Error, Make, Progress, Recipe, Target, points};
use crate::dataset::{Axis, Dataset, Spacing, Split, grid_weights};
use crate::microfacet::{ggx, sampling};
use std::f64::consts::PI;

fn widths() -> Axis {
    Axis { domain: [0.001, 1.0], spacing: Spacing::Logarithmic, ..Axis::unit("alpha") }
}

pub(super) const TARGET: Target = Target {
    name: "ggx_d",
    description: "GGX distribution over its peak, pi alpha^2 D, in narrow lobes: stiff",
    columns: "n_dot_h, alpha → d_over_peak",
    parameters: &[points("64", 1024)],
    make: Make::Rows(generate),
};

/// `π α² D`, in [0, 1], of `n_dot_h` in [0, 1] and `alpha` in (0, 1].
pub(crate) fn over_peak(n_dot_h: f64, alpha: f64) -> f64 {
    ggx::distribution(n_dot_h, alpha) * PI * alpha * alpha
}

/// Makes the dataset. Search split at the centres of cells of the lobe and of
/// log α; validation split at about a hundred nodes along each, from the peak to
/// the horizon and from end to end, weighted by the area of their cells.
///
/// # Errors
/// None that a recipe can cause.
pub fn generate(recipe: &Recipe, progress: Progress) -> Result<Dataset, Error> {
    let points = recipe.count("points");
    let centre = |i: usize| (i as f64 + 0.5) / points as f64;
    let centres: Vec<f64> = (0..points).map(centre).collect();
    let nodes: Vec<f64> = (0..=100).map(|k| f64::from(k) / 100.0).collect();
    let search = rows(&centres);
    progress(1, 2);
    let mut validation = rows(&nodes);
    let lengths = nodes.iter().map(|&at| if at == 0.0 || at == 1.0 { 0.5 } else { 1.0 }).collect();
    validation.weights = grid_weights(&vec![lengths; 2]);
    progress(2, 2);
    Ok(Dataset::of_splits(
        TARGET.name,
        recipe.origin("estimated error below 1e-13 before rounding to f32"),
        vec![Axis::unit("n_dot_h").column(), widths().column()],
        [("d_over_peak", "1")],
        [search, validation],
    )?)
}

/// Samples every pair of a width and a place in its lobe, both given in [0, 1].
fn rows(places: &[f64]) -> Split {
    let (widths, mut columns) = (widths(), vec![Vec::new(); 3]);
    for &width in places {
        let alpha = widths.at(width);
        for &place in places {
            let n_dot_h =
                if place < 1.0 { sampling::ggx([0.0, place], alpha.into()).z } else { 0.0 };
            let n_dot_h = n_dot_h as f32;
            let truth = over_peak(n_dot_h.into(), alpha.into()) as f32;
            for (column, value) in columns.iter_mut().zip([n_dot_h, alpha, truth]) {
                column.push(value);
            }
        }
    }
    Split { columns, ..Split::default() }
}
