//! The directional albedo of a layer of fibres.

use crate::reference;
use lgp::targets::sheen_volume_albedo::{ALLOWED_ERROR, Layer};

#[test]
fn it_agrees_with_random_walks() {
    let rows = reference("sheen_volume_albedo.csv");
    assert_eq!(rows.len(), 20);
    let mut squares = 0.0;
    for four in rows.chunks(4) {
        let layer = Layer::new(four[0][0]);
        for row in four {
            let [albedo, error] = layer.albedo(row[1]);
            let deviation = (albedo - row[2]) / row[3];
            assert!(deviation.abs() < 3.5, "{row:?}: {albedo}");
            assert!(error <= ALLOWED_ERROR, "{row:?}: {error:e}");
            squares += deviation * deviation;
        }
    }
    let spread = (squares / 20.0).sqrt();
    assert!((0.6..1.5).contains(&spread), "{spread} standard errors");
}

/// The rule's own nodes crowd at both ends, where the polynomial must not swing.
#[test]
fn it_falls_smoothly_from_grazing_angles_on() {
    for roughness in [0.25, 0.6, 1.0] {
        let layer = Layer::new(roughness);
        let albedos: Vec<f64> =
            (0..=1000).map(|i| layer.albedo(f64::from(i) / 1000.0)[0]).collect();
        assert!(albedos[0] < 0.77 && albedos.iter().all(|&albedo| albedo > 0.0));
        assert!(albedos.windows(2).all(|pair| pair[1] < pair[0]), "{roughness}");
    }
}
