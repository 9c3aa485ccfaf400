//! Linearly transformed cosines of sheen.

use crate::committed;
use lgp::dataset::{Dataset, Split};
use lgp::targets::Recipe;
use lgp::targets::ltc_sheen::{ERROR, Layer, Lobe};
use rayon::prelude::*;

/// Roughness, n·v, A, B and R of the published table (github.com/tizian/ltc-sheen,
/// `fitting/python/data/ltc_table_sheen_volume.npy`), by random walks. Where lobes are narrow or dark,
/// at smaller n·v and roughness, their bins or their noise are seen.
const PUBLISHED: [[f64; 5]; 6] = [
    [24.0 / 31.0, 8.0 / 31.0, 0.66757559, -0.09696795, 0.522108],
    [24.0 / 31.0, 16.0 / 31.0, 0.72083091, -0.07262644, 0.3542065],
    [24.0 / 31.0, 24.0 / 31.0, 0.75049365, -0.0489112, 0.231465],
    [16.0 / 31.0, 8.0 / 31.0, 0.42538788, -0.09729306, 0.371446],
    [16.0 / 31.0, 16.0 / 31.0, 0.49060189, -0.05014277, 0.157179],
    [1.0, 16.0 / 31.0, 0.86319772, -4.76878147e-5, 0.4919100],
];

#[test]
fn it_agrees_with_the_published_table() {
    PUBLISHED.par_iter().for_each(|&[roughness, n_dot_v, a, b, r]| {
        let Lobe { m11, m13, albedo } = Layer::new(roughness).fit(n_dot_v);
        let off = [m11 - a, m13 - b, albedo - r].map(f64::abs);
        assert!(off.iter().all(|off| *off < 7e-4), "{roughness} {n_dot_v}: {off:?}");
    });
}

/// A part of the committed dataset.
#[test]
fn the_committed_dataset_has_its_values() {
    let recipe = Recipe::load(&committed("ltc_sheen.ron")).unwrap();
    let made = Dataset::load(&committed("ltc_sheen.bin")).unwrap();
    assert_eq!(Recipe::parse(&made.origin.source()).unwrap(), recipe);
    let truth = lgp::targets::truth(&recipe).unwrap();
    let check = |split: &Split, step: usize| {
        let rows: Vec<usize> = (0..split.rows()).step_by(step).collect();
        rows.into_par_iter().for_each(|row| {
            let sample: Vec<f32> = split.columns.iter().map(|column| column[row]).collect();
            let again = truth.at(&[f64::from(sample[0]), f64::from(sample[1])]).unwrap();
            for (again, made) in again.iter().zip(&sample[2..]) {
                assert!((again - f64::from(*made)).abs() < ERROR, "{sample:?}: {again}");
            }
        });
    };
    check(&made.search, 199);
    check(&made.validation, 2003);
}
