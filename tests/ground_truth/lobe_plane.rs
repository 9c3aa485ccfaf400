//! Perpendicular lobes that look alike on a plane.

use crate::reference;
use lgp::targets::lobe_plane::{ALLOWED_ERROR, fit_angle, fit_distance};

#[test]
fn agrees_with_the_reference_over_distance() {
    let mut largest = 0.0_f64;
    for row in reference("lobe_plane_distance.csv") {
        let fit = fit_distance(row[0], row[1], row[2]);
        let error = (fit.roughness - row[3]).abs();
        assert!(error <= 1e-3, "{row:?}: {fit:?}");
        assert!(fit.error <= ALLOWED_ERROR, "{row:?}: {fit:?}");
        largest = largest.max(error);
        // Scale and offset stand in for each other where the lobe is wide.
        let others = [fit.scale - row[4], fit.offset - row[5]];
        assert!(others.iter().all(|error| error.abs() <= 1e-2), "{row:?}: {fit:?}");
    }
    println!("distance: {largest:e}");
}

/// The reference does not say which part of the plane it fits: only narrow spots, on which that
/// has little influence, can be compared.
#[test]
fn agrees_with_the_reference_over_angle_where_the_spot_is_narrow() {
    for row in reference("lobe_plane_angle.csv") {
        let fit = fit_angle(row[0], row[1].to_radians(), 2.0);
        assert!(fit.error <= ALLOWED_ERROR, "{row:?}: {fit:?}");
        if row[0] < 0.3 && row[1] < 50.0 {
            assert!((fit.roughness - row[2]).abs() <= 1e-3, "{row:?}: {fit:?}");
            assert!((fit.shift - row[3]).abs() <= 1e-2, "{row:?}: {fit:?}");
        }
    }
}

#[test]
fn narrow_lobes_follow_their_laws() {
    for roughness in [1e-3, 1e-2, 0.05] {
        for distance in [0.25, 0.7, 1.0, 3.0, 4.0_f64] {
            let fit = fit_distance(roughness, distance, 2.0).roughness;
            let law = roughness * distance.sqrt();
            assert!((fit / law - 1.0).abs() < roughness.powi(2), "{roughness} {distance}: {fit}");
        }
        for angle in [0.0, 0.3, 1.0_f64] {
            let fit = fit_angle(roughness, angle, 2.0).roughness;
            let law = roughness / angle.cos().powf(0.75);
            assert!((fit / law - 1.0).abs() < 0.02, "{roughness} {angle}: {fit} {law}");
        }
    }
}

#[test]
fn nothing_changes_where_nothing_differs() {
    for roughness in [0.001, 0.2, 0.5, 1.0] {
        assert!((fit_distance(roughness, 1.0, 2.0).roughness - roughness).abs() < 1e-8);
        assert!((fit_angle(roughness, 0.0, 2.0).roughness - roughness).abs() < 1e-6);
    }
}
