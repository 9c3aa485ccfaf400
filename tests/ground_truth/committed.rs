//! Committed datasets against their recipes and checksums.

use crate::{assert_near, committed};
use lgp::dataset::{Dataset, Split};
use lgp::targets::{Recipe, generate, targets};
use rayon::prelude::*;
use std::collections::HashSet;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A quarter of a minute and more to make; tests of their own look at a part of each.
const SLOW: [&str; 4] = ["hammon", "ggx_lobes", "ltc_ggx", "ltc_sheen"];

/// Every recipe but those.
fn names() -> Vec<String> {
    let files = std::fs::read_dir(committed("")).unwrap().map(|entry| entry.unwrap().path());
    let recipes = files.filter(|file| file.extension().is_some_and(|end| end == "ron"));
    let name = |file: std::path::PathBuf| file.file_stem().unwrap().to_str().unwrap().to_owned();
    let mut names: Vec<String> =
        recipes.map(name).filter(|name| !SLOW.contains(&&name[..])).collect();
    names.sort();
    names
}

/// A target comes with its data.
#[test]
fn every_target_has_a_recipe_and_data() {
    let target =
        |name: &String| Recipe::load(&committed(&format!("{name}.ron"))).unwrap().target().name;
    let known: Vec<&str> = names().iter().chain(&SLOW.map(str::to_owned)).map(target).collect();
    for target in targets() {
        assert!(known.contains(&target.name), "{} has no recipe in datasets/", target.name);
    }
}

#[test]
fn committed_datasets_are_generated_again() {
    for name in &names() {
        let recipe = Recipe::load(&committed(&format!("{name}.ron"))).unwrap();
        let made = Dataset::load(&committed(&format!("{name}.bin"))).unwrap();
        assert_eq!(&made.name, name);
        assert_eq!(Recipe::parse(&made.origin.source()).unwrap(), recipe, "{name}");
        let done = AtomicUsize::new(0);
        let again = generate(&recipe, &|_, total| {
            assert!(done.fetch_add(1, Ordering::Relaxed) < total);
        });
        let again = again.unwrap();
        if let (Some(search), Some(validation)) =
            (made.search.grid.first(), made.validation.grid.first())
        {
            assert_eq!(done.into_inner(), search + validation);
        }
        let of = |data: &Dataset| (data.inputs.clone(), data.claims.clone(), data.origin.clone());
        assert_eq!(of(&again), of(&made), "{name}");
        for (again, made) in [(&again.search, &made.search), (&again.validation, &made.validation)]
        {
            assert_eq!((&again.grid, &again.weights), (&made.grid, &made.weights), "{name}");
            let pairs = again.columns.iter().flatten().zip(made.columns.iter().flatten());
            pairs.for_each(|(&again, &made)| assert_near(again, made, name));
        }
    }
}

#[test]
fn no_row_is_in_both_splits_and_the_edges_are_validated() {
    for name in &names() {
        let made = Dataset::load(&committed(&format!("{name}.bin"))).unwrap();
        for (index, input) in made.inputs.iter().enumerate() {
            let [search, validation] = [&made.search, &made.validation].map(|s| &s.columns[index]);
            let range = |column: &[f32]| {
                column.iter().fold([f32::MAX, f32::MIN], |[a, b], &v| [a.min(v), b.max(v)])
            };
            let ([low, high], [inner_low, inner_high]) = (range(validation), range(search));
            // Points that are no grid are as likely at an end in either split.
            if made.search.grid.is_empty() {
                continue;
            }
            assert!(low < inner_low && inner_high < high, "{name}: {}", input.name);
            assert!((f64::from(high) - input.domain[1]).abs() < 1e-6, "{name}: {}", input.name);
        }
        assert!(made.search.rows() <= 4096 && made.search.rows() < made.validation.rows());
        let rows = |split: &Split| -> HashSet<Vec<u32>> {
            let inputs = &split.columns[..made.inputs.len()];
            let row = |row: usize| inputs.iter().map(|column| column[row].to_bits()).collect();
            (0..split.rows()).map(row).collect()
        };
        assert!(rows(&made.search).is_disjoint(&rows(&made.validation)), "{name}");
    }
}

#[test]
fn committed_datasets_have_their_checksums() {
    let text = std::fs::read_to_string(committed("checksums.txt")).unwrap();
    let mut listed = Vec::new();
    for line in text.lines() {
        let (expected, file) = line.split_once("  ").unwrap();
        let bytes = std::fs::read(committed(file)).unwrap();
        assert_eq!(blake3::hash(&bytes).to_hex().as_str(), expected, "{file}");
        listed.push(file.to_owned());
    }
    let mut files: Vec<String> = std::fs::read_dir(committed(""))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|file| file.ends_with(".bin"))
        .collect();
    files.sort();
    assert_eq!(listed, files);
}

/// Looks at every so manieth row of either split of a dataset that takes long to make.
pub fn committed_values_are_found_again(name: &str, steps: [usize; 2]) {
    let recipe = Recipe::load(&committed(&format!("{name}.ron"))).unwrap();
    let made = Dataset::load(&committed(&format!("{name}.bin"))).unwrap();
    assert_eq!(Recipe::parse(&made.origin.source()).unwrap(), recipe);
    let truth = lgp::targets::truth(&recipe).unwrap();
    for (split, step) in [&made.search, &made.validation].into_iter().zip(steps) {
        let rows: Vec<usize> = (0..split.rows()).step_by(step).collect();
        rows.into_par_iter().for_each(|row| {
            let sample: Vec<f32> = split.columns.iter().map(|column| column[row]).collect();
            let place = [f64::from(sample[0]), f64::from(sample[1])];
            for (again, made) in truth.at(&place).unwrap().iter().zip(&sample[2..]) {
                // Iterations end at other last digits where the system's functions do.
                assert!((again - f64::from(*made)).abs() < 1e-5, "{place:?}: {again} {made}");
            }
        });
    }
}
