//! The tone curve of ACES.

use crate::reference;
use lgp::targets::tone_curve::{display, encode_srgb};

/// Of whole colours, in single precision.
#[test]
fn it_agrees_with_an_implementation_of_the_whole_transform() {
    let rows = reference("tone_curve.csv");
    for row in &rows {
        let &[stops, light, signal] = &row[..] else { panic!("{row:?}") };
        let found = display(stops);
        assert!((found - light).abs() < 4e-7, "{row:?}: {found}");
        assert!((encode_srgb(found) - signal).abs() < 4e-7, "{row:?}: {found}");
    }
    assert_eq!(rows.len(), 53);
}

#[test]
fn it_rises_from_black_to_white_and_stays() {
    let curve: Vec<f64> = (-650..=650).map(|stops| display(f64::from(stops) * 0.01)).collect();
    assert!(curve.windows(2).all(|pair| pair[0] < pair[1]));
    assert_eq!([display(-6.5), display(-9.0)], [0.0; 2]);
    assert!((display(6.5) - 1.0).abs() < 1e-9 && display(9.0) == display(6.5));
}
