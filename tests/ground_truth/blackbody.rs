//! The colour of black bodies.

use crate::reference;
use lgp::targets::blackbody::{chromaticity, linear_srgb};

/// Sums over every 5 nm, as the target's, against sums over every nanometre.
#[test]
fn it_agrees_with_a_finer_table_of_the_observer() {
    for row in reference("blackbody.csv") {
        let found = chromaticity(row[0]);
        let expected = &row[1..];
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 3e-6, "{row:?}: {found}");
        }
        for (found, expected) in linear_srgb(row[0]).iter().zip(&expected[2..]) {
            assert!((found - expected).abs() < 4e-5, "{row:?}: {found}");
        }
    }
}

/// Illuminant A is a black body of 2848 K where c2 is 1.435e-2 m K (CIE 15:2004, §3.1, and its
/// chromaticity in table T.3, of sums from 380 to 780 nm); and luminance is 1.
#[test]
fn it_is_illuminant_a_at_its_temperature() {
    let [x, y] = chromaticity(2848.0 * 1.438_776_877 / 1.435);
    assert!((x - 0.44758).abs() < 1.2e-5 && (y - 0.40745).abs() < 1.2e-5, "{x} {y}");
    let [r, g, b] = linear_srgb(2856.0);
    assert!((0.212_639 * r + 0.715_169 * g + 0.072_192 * b - 1.0).abs() < 1e-5);
}
