//! A room to be reflected, and its levels of convolution.

use glam::DVec3;
use lgp::lobes::{Lobe, SphericalGaussian};
use lgp::num::low_discrepancy::hammersley;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Radiance from a direction, y up: a room with windows and a lamp, its edges half a degree soft.
pub fn radiance(l: DVec3) -> DVec3 {
    let floor = DVec3::new(0.10, 0.08, 0.06);
    let wall = DVec3::new(0.16, 0.17, 0.20);
    let mut light = floor.lerp(wall, soft(l.y));
    let (azimuth, height) = (l.x.atan2(l.z), l.y.asin());
    for (at, colour) in [
        (0.5, DVec3::new(3.0, 3.2, 3.6)),
        (2.4, DVec3::new(3.6, 2.6, 1.6)),
        (-1.9, DVec3::splat(2.4)),
    ] {
        for pane in [-0.17, 0.17] {
            let across = (azimuth - at - pane + PI).rem_euclid(TAU) - PI;
            let inside = soft(0.14 - across.abs()) * soft(0.28 - (height - 0.45).abs());
            light = light.lerp(colour, inside);
        }
    }
    let lamp = DVec3::new(-0.45, 0.6, 0.66).normalize();
    light.lerp(DVec3::new(9.0, 8.0, 6.5), soft(l.dot(lamp).clamp(-1.0, 1.0) - 0.995))
}

fn soft(x: f64) -> f64 {
    (0.5 + x / 0.0175).clamp(0.0, 1.0)
}

/// Columns and rows of each level: azimuth, and angle from y.
pub const SIDES: [usize; 2] = [128, 64];
/// Bandwidths 2^14, 2^12, …, 1.
pub const LEVELS: usize = 8;
/// Samples of each texel. By hand: no noise shows.
const SAMPLES: u64 = 1024;

/// Convolves the room with Gaussians of the bandwidths 2^(14 - 2 level), normalised: texel after
/// texel, level after level, three numbers each.
pub fn levels() -> Vec<f32> {
    let [columns, rows] = SIDES;
    let texels = (0..LEVELS * rows * columns).into_par_iter().map(|index| {
        let (level, row, column) =
            (index / (rows * columns), index / columns % rows, index % columns);
        let phi = TAU * (column as f64 + 0.5) / columns as f64;
        let theta = PI * (row as f64 + 0.5) / rows as f64;
        let axis = DVec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
        let lobe = SphericalGaussian::new(axis, 2.0_f64.powi(14 - 2 * level as i32), 1.0);
        let light = (0..SAMPLES).map(|i| radiance(lobe.sample(hammersley::<2>(i, SAMPLES))));
        (light.sum::<DVec3>() / SAMPLES as f64).to_array().map(|value| value as f32)
    });
    texels.collect::<Vec<_>>().concat()
}
