//! Linearly transformed cosines of sheen.

use crate::committed::committed_values_are_found_again;
use lgp::targets::ltc_sheen::{Layer, Lobe};
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

#[test]
fn the_committed_dataset_has_its_values() {
    committed_values_are_found_again("ltc_sheen", [199, 2003]);
}
