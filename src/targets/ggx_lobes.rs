//! GGX reflections as eight spherical Gaussians: the parameters of the multi-lobe model of least
//! error, which a shader looks up, or computes by formulas, for its samples of a prefiltered
//! environment.
//!
//! Definition (Pesce and Iwanicki, "Approximate Models for Physically Based Rendering", SIGGRAPH
//! 2015 course notes, §7.6, eq. 10): [`Fan`], fitted to [`crate::lobes::Response`] with `alpha =
//! roughness²`; the error is [`crate::lobes::Misfit`]. Amplitude and bandwidth are given by their
//! natural logarithms, the middle by its cosine.
//!
//! Method: [`Grid`]. The two splits are fitted apart, each from its own neighbours.

use super::{Choices, Error, Make, Parameter, Progress, Recipe, Target, points};
use crate::dataset::{Axis, Dataset, Split, grid_weights};
use crate::lobes::fit::Amplitude;
use crate::lobes::{Fan, Grid};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Fitted instead of n·v = 0, where the response is a single direction at the horizon.
const GRAZING: f64 = 0.01;
/// Fitted instead of roughness = 0, a mirror.
const SMOOTHEST: f64 = 0.03;
const NORMALISED: &str = "normalised";
const FREE: &str = "free";

pub(super) const AMPLITUDE: Parameter = Parameter {
    name: "amplitude",
    description: "free, for the least error; or normalised, the integral that of the response",
    default: FREE,
    choices: Choices::OneOf(&[NORMALISED, FREE]),
};

pub(super) const TARGET: Target = Target {
    name: "ggx_lobes",
    description: "GGX reflections as eight spherical Gaussians, of least error",
    columns: "n_dot_v, roughness → cos_theta, spread, log_amplitude, log_lambda",
    parameters: &[
        AMPLITUDE,
        Parameter {
            name: "lobes",
            description: "number of Gaussians",
            default: "8",
            choices: Choices::Count { least: 1, most: 64 },
        },
        points("16", 256),
    ],
    make: Make::Rows(generate),
};

/// The inputs of lobes: n·v and roughness.
pub(super) fn axes() -> [Axis; 2] {
    [
        Axis { least: Some(GRAZING), ..Axis::unit("n_dot_v") },
        Axis { least: Some(SMOOTHEST), ..Axis::unit("roughness") },
    ]
}

/// Makes the dataset. Search split: the centres of cells; validation split: the cells' corners,
/// with .01 and .03 in place of 0, weighted by area.
///
/// # Errors
/// None that a recipe can cause.
pub fn generate(recipe: &Recipe, progress: Progress) -> Result<Dataset, Error> {
    let points = recipe.count("points");
    let axes = axes();
    let [centres, nodes] = [
        axes.each_ref().map(|axis| axis.centres(points)),
        axes.each_ref().map(|axis| axis.nodes(points)),
    ];
    let done = AtomicUsize::new(0);
    let total = [&centres, &nodes].iter().map(|along| along[0].len() * along[1].len()).sum();
    let tick = || progress(1 + done.fetch_add(1, Ordering::Relaxed), total);
    let search = rows(recipe, &centres, &tick);
    let mut validation = rows(recipe, &nodes, &tick);
    let length = |node: usize| if node == 0 || node == points { 0.5 } else { 1.0 };
    validation.weights = grid_weights(&vec![(0..=points).map(length).collect(); 2]);
    Ok(Dataset::of_splits(
        TARGET.name,
        recipe.origin("errors within a thousandth of the least"),
        axes.iter().map(Axis::column).collect(),
        [("cos_theta", "1"), ("spread", "rad"), ("log_amplitude", "1"), ("log_lambda", "1")],
        [search, validation],
    )?)
}

/// Returns the recipe's kind of amplitude.
pub(super) fn amplitude_of(recipe: &Recipe) -> Amplitude {
    match recipe.get(AMPLITUDE.name) {
        Some(NORMALISED) => Amplitude::Normalised,
        _ => Amplitude::Free,
    }
}

fn rows(recipe: &Recipe, along: &[Vec<f32>; 2], after_place: &(dyn Fn() + Sync)) -> Split {
    let [n_dot_v, roughness] =
        along.each_ref().map(|places| places.iter().copied().map(f64::from).collect::<Vec<_>>());
    let grid = Grid { n_dot_v: &n_dot_v, roughness: &roughness };
    let fans = grid.fans(recipe.count("lobes"), amplitude_of(recipe), after_place);
    let places = along[0].iter().flat_map(|&v| along[1].iter().map(move |&r| [v, r]));
    let mut columns = vec![Vec::new(); 6];
    for ([n_dot_v, roughness], fitted) in places.zip(&fans) {
        let Fan { theta, spread, lambda, amplitude, .. } = fitted.model;
        let outputs = [theta.cos(), spread, amplitude.ln(), lambda.ln()].map(|value| value as f32);
        let row = [n_dot_v, roughness].into_iter().chain(outputs);
        columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
    }
    Split { columns, grid: along.iter().map(Vec::len).collect(), ..Split::default() }
}
