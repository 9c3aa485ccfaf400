//! Linearly transformed cosines of GGX.

use crate::committed::committed_values_are_found_again;
use crate::reference;
use lgp::quadrature::TanhSinh;
use lgp::targets::dfg::{Masking, integrate};
use lgp::targets::ltc_ggx::{ERROR, Fitter, distance};
use rayon::prelude::*;

fn magnitude(n_dot_v: f64, alpha: f64) -> f64 {
    let albedo = integrate(&TanhSinh::new(), n_dot_v, alpha, Masking::Correlated);
    albedo.scale + albedo.bias
}

#[test]
fn it_agrees_with_fits_of_another_program() {
    let fitter = Fitter::new();
    reference("ltc_ggx.csv").par_iter().for_each(|row| {
        let &[n_dot_v, roughness, ..] = &row[..] else { panic!("{row:?}") };
        let alpha = roughness * roughness;
        let albedo = integrate(&TanhSinh::new(), n_dot_v, alpha, Masking::Correlated);
        let magnitude = albedo.scale + albedo.bias;
        let inverse = fitter.fit(n_dot_v, alpha, magnitude);
        let entries: [f64; 4] = inverse.into();
        for (found, expected) in entries.iter().zip(&row[2..6]) {
            assert!((found - expected).abs() < 2.0 * ERROR, "{row:?}: {inverse:?}");
        }
        // Its corner at the horizon costs the other program's rule a few digits.
        assert!(
            (magnitude - row[6]).abs() < 1e-4 && (albedo.bias - row[7]).abs() < 1e-4,
            "{row:?}"
        );
        let left = distance(64, n_dot_v, alpha, inverse, magnitude);
        for (found, expected) in [left.first, left.second, left.third].iter().zip(&row[8..]) {
            assert!((found / expected - 1.0).abs() < 0.02, "{row:?}: {left:?}");
        }
    });
}

/// The published tables (github.com/selfshadow/ltc_code, `fit/results/ltc.js`) at the 16×16 places
/// below, by [`distance`] of 160 points: mean and worst by the first, second and third power.
const PUBLISHED: [[f64; 2]; 3] = [[0.1250, 0.746], [0.0914, 0.495], [0.0858, 0.443]];

#[test]
fn it_is_nearer_to_ggx_than_the_published_tables() {
    let fitter = Fitter::new();
    let places = (0..256).into_par_iter().map(|place| {
        // Nodes of their 64×64: roughness 3/63 to 1, sqrt(1 - n·v) 2/63 to 62/63.
        let (row, column) = (4 * (place / 16) + 3, 4 * (place % 16) + 2);
        let n_dot_v = 1.0 - (f64::from(column) / 63.0).powi(2);
        let alpha = (f64::from(row) / 63.0).powi(2);
        let magnitude = magnitude(n_dot_v, alpha);
        let inverse = fitter.fit(n_dot_v, alpha, magnitude);
        let left = distance(64, n_dot_v, alpha, inverse, magnitude);
        [left.first, left.second, left.third]
    });
    let left: Vec<[f64; 3]> = places.collect();
    for (power, [mean, worst]) in PUBLISHED.into_iter().enumerate() {
        let of = left.iter().map(|left| left[power]);
        assert!(of.clone().sum::<f64>() / 256.0 < 0.8 * mean, "{power}");
        assert!(of.fold(0.0, f64::max) < worst, "{power}");
    }
}

#[test]
fn the_committed_dataset_has_its_values() {
    committed_values_are_found_again("ltc_ggx", [41, 101]);
}
