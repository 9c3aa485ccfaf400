//! Diffuse light from a rough dielectric: GGX facets, each a Fresnel interface above a white
//! Lambertian interior, return it after one transmission or after several.
//!
//! Source: Hammon, "PBR Diffuse Lighting for GGX+Smith Microsurfaces", 2017, whose fit is
//! [`crate::microfacet::diffuse::Hammon`]. Definition and method: [`microsurface`]. An albedo ρ
//! turns them into ρ single + ρ² multi, to first order as on the slides.
//!
//! All views of one light share its paths. Blocks of paths have a ChaCha8 stream each and are added
//! in order, so that the number of threads changes nothing.

mod grid;
pub mod microsurface;

pub use microsurface::{Microsurface, Sampler};

use super::{Choices, Error, Make, Parameter, Progress, Recipe, Target};
use crate::dataset::{Column, Dataset};
use crate::quadrature::Estimate;
use glam::DVec3;
use grid::Grid;
use microsurface::{Light, View};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Any seed would do.
const SEED: u64 = 2017;
/// Blocks of paths per light: more than the threads of most machines. By hand.
const BLOCKS: usize = 32;
const EXACT: &str = "exact";
const LITERAL: &str = "literal";
const FINE: &str = "fine";
const COARSE: &str = "coarse";
const AS_WEIGHTS: &str = "weights";
const AS_COLUMNS: &str = "columns";

pub(super) const TARGET: Target = Target {
    name: "hammon",
    description: "diffuse light from GGX facets on a white interior, path-traced, F0 = .02",
    columns: "alpha, n_dot_l, n_dot_v, n_dot_h, l_dot_v → single, multi",
    parameters: &[
        Parameter {
            name: "sampler",
            description: "facets met: exact Smith, or as on the slides that the published constants are from",
            default: EXACT,
            choices: Choices::OneOf(&[EXACT, LITERAL]),
        },
        Parameter {
            name: "grid",
            description: "search grid: fine 8 alpha, 8 x 8 angles, 7 azimuths; coarse 6, 7 x 7, 5",
            default: FINE,
            choices: Choices::OneOf(&[FINE, COARSE]),
        },
        Parameter {
            name: "paths",
            description: "paths from each direction of the light",
            default: "400000",
            choices: Choices::Count { least: 100, most: 1_000_000_000 },
        },
        Parameter {
            name: "standard_errors",
            description: "keep them beside the outputs and weigh rows by them, or give them as outputs single_se, multi_se",
            default: AS_WEIGHTS,
            choices: Choices::OneOf(&[AS_WEIGHTS, AS_COLUMNS]),
        },
    ],
    make: Make::Rows(generate),
};

/// Mean light in a direction, in 1/sr, each with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    /// Reflected only.
    pub specular: Estimate,
    /// Transmitted once.
    pub single: Estimate,
    /// Transmitted twice or more.
    pub multi: Estimate,
}

/// Traces `paths` of light from `l` and returns the lobes towards `views`, all above the horizon.
/// `stream` chooses the random numbers: the same one gives the same lobes at any number of threads.
/// `after_block` is called after each block of paths, from any thread.
pub fn lobes(
    surface: Microsurface,
    l: DVec3,
    views: &[DVec3],
    paths: usize,
    stream: u64,
    after_block: &(dyn Fn() + Sync),
) -> Vec<Lobe> {
    let views: Vec<View> = views.iter().map(|&view| surface.view(view)).collect();
    let blocks: Vec<Vec<Sums>> = (0..BLOCKS)
        .into_par_iter()
        .map(|block| {
            let mut rng = ChaCha8Rng::seed_from_u64(SEED);
            rng.set_stream(stream * BLOCKS as u64 + block as u64);
            let share = paths * (block + 1) / BLOCKS - paths * block / BLOCKS;
            let sums = trace(&surface, l, &views, share, &mut rng);
            after_block();
            sums
        })
        .collect();
    let mut total = vec![Sums::default(); views.len()];
    for block in &blocks {
        total.iter_mut().zip(block).for_each(|(total, sums)| total.add(sums));
    }
    total.iter().map(|sums| sums.lobe(paths)).collect()
}

fn trace(
    surface: &Microsurface,
    l: DVec3,
    views: &[View],
    paths: usize,
    rng: &mut ChaCha8Rng,
) -> Vec<Sums> {
    let mut sums = vec![Sums::default(); views.len()];
    let mut light = vec![Light::default(); views.len()];
    for _ in 0..paths {
        light.fill(Light::default());
        surface.trace(l, views, rng, &mut light);
        sums.iter_mut().zip(&light).for_each(|(sums, light)| sums.add_path(light));
    }
    sums
}

/// Sums over paths of the light, and of its square.
#[derive(Clone, Copy, Default)]
struct Sums {
    specular: [f64; 2],
    single: [f64; 2],
    multi: [f64; 2],
}

impl Sums {
    fn add_path(&mut self, light: &Light) {
        let of = |value: f64| [value, value * value];
        self.add(&Sums {
            specular: of(light.specular),
            single: of(light.single),
            multi: of(light.multi),
        });
    }

    fn add(&mut self, other: &Sums) {
        let add = |sums: &mut [f64; 2], other: [f64; 2]| {
            sums[0] += other[0];
            sums[1] += other[1];
        };
        add(&mut self.specular, other.specular);
        add(&mut self.single, other.single);
        add(&mut self.multi, other.multi);
    }

    fn lobe(&self, paths: usize) -> Lobe {
        let estimate = |[sum, squares]: [f64; 2]| {
            let value = sum / paths as f64;
            let variance = (squares / paths as f64 - value * value).max(0.0);
            Estimate { value, error: (variance / paths as f64).sqrt(), evaluations: paths }
        };
        Lobe {
            specular: estimate(self.specular),
            single: estimate(self.single),
            multi: estimate(self.multi),
        }
    }
}

/// Makes the dataset: search split on the grid that the recipe names, weighted only by standard
/// errors near or above .005; validation split on 9 widths, 9 × 9 angles and 9 azimuths with the
/// ends of each, 89° instead of 90°, weighted by cell, too. The row of α = 0 is known in closed
/// form ([`crate::microfacet::diffuse::under_interface`]).
///
/// # Errors
/// None that a recipe can cause.
pub fn generate(recipe: &Recipe, progress: Progress) -> Result<Dataset, Error> {
    let sampler = match recipe.get("sampler") {
        Some(LITERAL) => Sampler::Literal,
        _ => Sampler::Exact,
    };
    let (searched, validated) = match recipe.get("grid") {
        Some(COARSE) => (Grid::coarse(), Grid::validation()),
        _ => (Grid::fine(), Grid::validation()),
    };
    let done = AtomicUsize::new(0);
    let total = BLOCKS * (searched.rough_lights() + validated.rough_lights());
    let tick = || progress(1 + done.fetch_add(1, Ordering::Relaxed), total);
    let paths = recipe.count("paths");
    let search = searched.trace(sampler, paths, 0, &tick);
    let validation = validated.trace(sampler, paths, searched.lights().len() as u64, &tick);
    let noise =
        [relative_noise(&search, |lobe| lobe.single), relative_noise(&search, |lobe| lobe.multi)];
    let as_columns = recipe.get("standard_errors") == Some(AS_COLUMNS);
    let splits = [(&searched, search), (&validated, validation)]
        .map(|(grid, lobes)| grid.split(&lobes, as_columns));
    let inputs = [
        ("alpha", [0.0, 1.0]),
        ("n_dot_l", [0.0, 1.0]),
        ("n_dot_v", [0.0, 1.0]),
        ("n_dot_h", [0.0, 1.0]),
        ("l_dot_v", [-1.0, 1.0]),
    ];
    let outputs: &[&str] = match as_columns {
        true => &["single", "multi", "single_se", "multi_se"],
        false => &["single", "multi"],
    };
    let [single, multi] = noise;
    Ok(Dataset::of_splits(
        TARGET.name,
        recipe.origin(format!(
            "median relative standard error {single:.1e} of single, {multi:.1e} of multi"
        )),
        inputs.map(|(name, domain)| Column::new(name, domain)).to_vec(),
        outputs.iter().map(|&name| (name, "1/sr")),
        splits,
    )?)
}

fn relative_noise(lobes: &[Lobe], of: impl Fn(&Lobe) -> Estimate) -> f64 {
    let mut noise: Vec<f64> = lobes.iter().map(|lobe| of(lobe).error / of(lobe).value).collect();
    noise.sort_by(f64::total_cmp);
    noise[noise.len() / 2]
}
