//! The response of a GGX surface to light from any direction: what the multi-lobe model of
//! [`ggx_lobes`](super::ggx_lobes) approximates, to search formulas of its parameters end to end,
//! by a template that is the model.
//!
//! Definition (course notes, §7.3): [`Response`], the BRDF at F = 1 times the cosine,
//! `alpha = roughness²`. The direction of light is (x, y, z), z along the normal, v in the plane of
//! x and z at x ≤ 0. By symmetry, y ≥ 0.
//!
//! Method: at each place, directions are drawn from the response and from a spherical Gaussian
//! about the mirrored direction, wide enough to reach below the horizon where the response does
//! not, and weighted by the balance heuristic over `∫ R²`. The weighted sum of the squared errors
//! of a model is then its error (eq. 8) as a share of that of no model, averaged over places: in
//! absolute terms, smooth surfaces alone would count, whose error is as 1/alpha².

use super::ggx_lobes::axes;
use super::{Choices, Error, Make, Parameter, Progress, Recipe, Target, points};
use crate::dataset::{Axis, Column, Dataset, Split};
use crate::lobes::{Lobe, Misfit, Response, SphericalGaussian, direction_at};
use crate::num::low_discrepancy::halton;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Points for `∫ R²`.
const POINTS: usize = 16 * 243;
/// The bandwidth of the Gaussian times alpha²: half that of the response near its peak. By hand.
const BANDWIDTH: f64 = 0.5;

pub(super) const TARGET: Target = Target {
    name: "ggx_response",
    description: "GGX BRDF times cosine over directions of light, weighted as an integral",
    columns: "n_dot_v, roughness, x, y, z → response",
    parameters: &[
        points("8", 64),
        Parameter {
            name: "directions",
            description: "directions of light at each place, half of them by the response",
            default: "64",
            choices: Choices::Count { least: 2, most: 65_536 },
        },
    ],
    make: Make::Rows(generate),
};

/// Makes the dataset. Search split: places at the centres of cells; validation split: at the cells'
/// corners with the domain's edges, .01 and .03 in place of 0, and other directions.
///
/// # Errors
/// None that a recipe can cause.
pub fn generate(recipe: &Recipe, progress: Progress) -> Result<Dataset, Error> {
    let (points, directions) = (recipe.count("points"), recipe.count("directions"));
    let axes = axes();
    let [centres, nodes] = [
        axes.each_ref().map(|axis| axis.centres(points)),
        axes.each_ref().map(|axis| axis.nodes(points)),
    ];
    let done = AtomicUsize::new(0);
    let total = [&centres, &nodes].iter().map(|along| along[0].len() * along[1].len()).sum();
    let tick = || progress(1 + done.fetch_add(1, Ordering::Relaxed), total);
    let search = rows(&centres, directions, &tick);
    let validation = rows(&nodes, directions, &tick);
    let cosines = [("x", -1.0), ("y", 0.0), ("z", -1.0)];
    let cosines = cosines.map(|(name, least)| Column::new(name, [least, 1.0]));
    Ok(Dataset::of_splits(
        TARGET.name,
        recipe.origin("estimated error below 1e-9 of each value before rounding to f32"),
        axes.iter().map(Axis::column).chain(cosines).collect(),
        [("response", "1/sr")],
        [search, validation],
    )?)
}

fn rows(along: &[Vec<f32>; 2], directions: usize, tick: &(dyn Fn() + Sync)) -> Split {
    let places: Vec<[f32; 2]> =
        along[0].iter().flat_map(|&v| along[1].iter().map(move |&r| [v, r])).collect();
    let at = |(index, place): (usize, &[f32; 2])| {
        let rows = place_rows(*place, index, directions);
        tick();
        rows
    };
    let of_places: Vec<Vec<[f32; 7]>> = places.par_iter().enumerate().map(at).collect();
    let mut columns = vec![Vec::new(); 6];
    let mut weights = Vec::new();
    for row in of_places.into_iter().flatten() {
        columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
        weights.push(row[6]);
    }
    Split { columns, weights, ..Split::default() }
}

/// The inputs, the response and the weight of each direction at a place. Each place has points of
/// its own, so that their errors differ.
fn place_rows([n_dot_v, roughness]: [f32; 2], index: usize, directions: usize) -> Vec<[f32; 7]> {
    let alpha = f64::from(roughness).powi(2);
    let response = Response::new(n_dot_v.into(), alpha);
    let lambda = BANDWIDTH / (alpha * alpha);
    let wide = SphericalGaussian::new(direction_at(f64::from(n_dot_v).acos()), lambda, 1.0);
    let squares = Misfit::new(response, POINTS).moments(&[wide]).response_squared;
    let half = directions.div_ceil(2);
    let point = |k: usize| -> [f64; 2] { halton(1 + (index * half + k) as u64) };
    let by_response = (0..half).filter_map(|k| response.sample(point(k)));
    let by_gaussian = (0..directions - half).map(|k| wide.sample(point(k)));
    let row = |direction: glam::DVec3| {
        // As rounded, from which formulas start.
        let [x, y, z] = [direction.x, direction.y.abs(), direction.z].map(|part| part as f32);
        let rounded = glam::DVec3::new(x.into(), y.into(), z.into()).normalize();
        let [value, density] = response.value_and_density(rounded);
        let drawn = half as f64 * density + (directions - half) as f64 * wide.density(rounded);
        [n_dot_v, roughness, x, y, z, value as f32, (1.0 / (drawn * squares)) as f32]
    };
    by_response.chain(by_gaussian).map(row).collect()
}
