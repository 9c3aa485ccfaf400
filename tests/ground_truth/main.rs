//! Ground truths against reference values that were computed by other programs
//! (`tests/reference/README.md`), and committed datasets against their recipes.

mod area_light;
mod area_norm;
mod average_albedo;
mod average_fresnel;
mod blackbody;
mod coat_albedo;
mod committed;
mod conductor;
mod dfg;
mod dielectric_albedo;
mod disney_zh;
mod ggx_lobes;
mod lobe_plane;
mod ltc_ggx;
mod ltc_sheen;
mod recipes;
mod sampling;
mod sheen_albedo;
mod sheen_volume_albedo;
mod sphere_light;
mod tone_curve;

use std::path::{Path, PathBuf};

fn reference(name: &str) -> Vec<Vec<f64>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name);
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().skip(1);
    rows.map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

fn committed(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets").join(file)
}

/// Equal but for the last bits: the sine and exponential of the system may
/// differ from those of the machine that made the files.
fn assert_near(found: f32, expected: f32, place: &str) {
    let allowed = 2.0 * f32::EPSILON * expected.abs();
    assert!((found - expected).abs() <= allowed, "{place}: {found} and {expected}");
}
