//! The colour of a black body: what Planck's law looks like at a temperature.
//!
//! Definition: the tristimulus values are sums of Planck's spectral radiance times the colour
//! matching functions of the CIE 1931 2-degree observer (CIE 15:2004, §7.1; ISO 11664-1) over every
//! 5 nm from 360 to 830 nm. Sums over every 1 nm differ by less than what is stated as the error.
//! Constants are exact in the SI of 2019. Luminance is 1 at any temperature: how bright a body is,
//! is another matter.
//!
//! Temperatures are equidistant in their logarithm, so that flames (to 2500 K), lamps (to 6000 K)
//! and skies have as many samples each: in kelvins half of them lie above 8000 K, where colour
//! hardly changes, in reciprocals of kelvins half lie below 1900 K.

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Choices, Make, Parameter, Recipe, Target, points};
use crate::dataset::{Axis, Spacing};

/// The largest difference of a chromaticity from sums over every 1 nm, above 1000 K.
const CHROMATICITY_ERROR: f64 = 3e-6;
/// The same of linear sRGB: of blue at 15000 K.
const RGB_ERROR: f64 = 4e-5;
/// In kelvins: from embers to the bluest sky, where Krystek's formula holds, too.
const TEMPERATURES: [f64; 2] = [1000.0, 15000.0];
const XY: &str = "xy";
const LINEAR_SRGB: &str = "linear_srgb";

pub(super) const TARGET: Target = Target {
    name: "blackbody",
    description: "colour of a black body, of luminance 1, over its temperature (K)",
    columns: "temperature → x, y or r, g, b",
    parameters: &[
        Parameter {
            name: "of",
            description: "CIE 1931 chromaticity, or linear sRGB (Rec. 709), unclipped",
            default: XY,
            choices: Choices::OneOf(&[XY, LINEAR_SRGB]),
        },
        points("256", 4096),
        SAMPLING,
        SAMPLING_SEED,
    ],
    make: Make::Table(table),
};

/// Computes X and Z of a black body of luminance Y = 1 at a temperature in kelvins, at least 100.
pub fn tristimulus(temperature: f64) -> [f64; 2] {
    let mut sums = [0.0; 3];
    for (index, matched) in OBSERVER.iter().enumerate() {
        let wavelength = 1e-9 * (FIRST_NM + STEP_NM * index as f64);
        let radiance =
            wavelength.powi(-5) / (SECOND_RADIATION / (wavelength * temperature)).exp_m1();
        for (sum, matched) in sums.iter_mut().zip(matched) {
            *sum += radiance * matched;
        }
    }
    [sums[0] / sums[1], sums[2] / sums[1]]
}

/// Computes the CIE 1931 chromaticity x, y at a temperature in kelvins, at least 100.
pub fn chromaticity(temperature: f64) -> [f64; 2] {
    let [x, z] = tristimulus(temperature);
    [x, 1.0].map(|value| value / (x + 1.0 + z))
}

/// Computes linear sRGB at a temperature in kelvins, at least 100. Blue is negative below 1900 K:
/// no display of these primaries shows that.
pub fn linear_srgb(temperature: f64) -> [f64; 3] {
    let [x, z] = tristimulus(temperature);
    XYZ_TO_SRGB.map(|row| row[0] * x + row[1] + row[2] * z)
}

/// Returns the table on temperatures in [1000, 15000] K.
fn table(recipe: &Recipe) -> Table {
    let axes = vec![Axis {
        unit: "K".into(),
        domain: TEMPERATURES,
        spacing: Spacing::Logarithmic,
        ..Axis::unit("temperature")
    }];
    if recipe.get("of") == Some(LINEAR_SRGB) {
        return Table::new(recipe, axes, &[("r", "1"), ("g", "1"), ("b", "1")], RGB_ERROR, |at| {
            Sample { values: linear_srgb(at[0]), error: RGB_ERROR }
        });
    }
    Table::new(recipe, axes, &[("x", "1"), ("y", "1")], CHROMATICITY_ERROR, |at| Sample {
        values: chromaticity(at[0]),
        error: CHROMATICITY_ERROR,
    })
}

/// hc/k in m K, exact in the SI of 2019 and so rounded.
const SECOND_RADIATION: f64 = 6.626_070_15e-34 * 299_792_458.0 / 1.380_649e-23;

/// From XYZ to the primaries and the white of Rec. 709 (ITU-R BT.709-6, §1), which are those of
/// sRGB: the inverse of the matrix that these chromaticities define.
const XYZ_TO_SRGB: [[f64; 3]; 3] = [
    [3.240_969_941_9, -1.537_383_177_6, -0.498_610_760_3],
    [-0.969_243_636_3, 1.875_967_501_5, 0.041_555_057_4],
    [0.055_630_079_7, -0.203_976_958_9, 1.056_971_514_2],
];

const FIRST_NM: f64 = 360.0;
const STEP_NM: f64 = 5.0;
/// The colour matching functions x̄, ȳ, z̄ of the CIE 1931 2-degree observer (ISO 11664-1:2007,
/// table 1).
const OBSERVER: [[f64; 3]; 95] = [
    [0.0001299, 0.000003917, 0.0006061],
    [0.0002321, 0.000006965, 0.001086],
    [0.0004149, 0.00001239, 0.001946],
    [0.0007416, 0.00002202, 0.003486],
    [0.001368, 0.000039, 0.006450001],
    [0.002236, 0.000064, 0.01054999],
    [0.004243, 0.00012, 0.02005001],
    [0.00765, 0.000217, 0.03621],
    [0.01431, 0.000396, 0.06785001],
    [0.02319, 0.00064, 0.1102],
    [0.04351, 0.00121, 0.2074],
    [0.07763, 0.00218, 0.3713],
    [0.13438, 0.004, 0.6456],
    [0.21477, 0.0073, 1.0390501],
    [0.2839, 0.0116, 1.3856],
    [0.3285, 0.01684, 1.62296],
    [0.34828, 0.023, 1.74706],
    [0.34806, 0.0298, 1.7826],
    [0.3362, 0.038, 1.77211],
    [0.3187, 0.048, 1.7441],
    [0.2908, 0.06, 1.6692],
    [0.2511, 0.0739, 1.5281],
    [0.19536, 0.09098, 1.28764],
    [0.1421, 0.1126, 1.0419],
    [0.09564, 0.13902, 0.8129501],
    [0.05795001, 0.1693, 0.6162],
    [0.03201, 0.20802, 0.46518],
    [0.0147, 0.2586, 0.3533],
    [0.0049, 0.323, 0.272],
    [0.0024, 0.4073, 0.2123],
    [0.0093, 0.503, 0.1582],
    [0.0291, 0.6082, 0.1117],
    [0.06327, 0.71, 0.07824999],
    [0.1096, 0.7932, 0.05725001],
    [0.1655, 0.862, 0.04216],
    [0.2257499, 0.9148501, 0.02984],
    [0.2904, 0.954, 0.0203],
    [0.3597, 0.9803, 0.0134],
    [0.4334499, 0.9949501, 0.008749999],
    [0.5120501, 1.0, 0.005749999],
    [0.5945, 0.995, 0.0039],
    [0.6784, 0.9786, 0.002749999],
    [0.7621, 0.952, 0.0021],
    [0.8425, 0.9154, 0.0018],
    [0.9163, 0.87, 0.001650001],
    [0.9786, 0.8163, 0.0014],
    [1.0263, 0.757, 0.0011],
    [1.0567, 0.6949, 0.001],
    [1.0622, 0.631, 0.0008],
    [1.0456, 0.5668, 0.0006],
    [1.0026, 0.503, 0.00034],
    [0.9384, 0.4412, 0.00024],
    [0.8544499, 0.381, 0.00019],
    [0.7514, 0.321, 0.0001],
    [0.6424, 0.265, 0.00005],
    [0.5419, 0.217, 0.00003],
    [0.4479, 0.175, 0.00002],
    [0.3608, 0.1382, 0.00001],
    [0.2835, 0.107, 0.0],
    [0.2187, 0.0816, 0.0],
    [0.1649, 0.061, 0.0],
    [0.1212, 0.04458, 0.0],
    [0.0874, 0.032, 0.0],
    [0.0636, 0.0232, 0.0],
    [0.04677, 0.017, 0.0],
    [0.0329, 0.01192, 0.0],
    [0.0227, 0.00821, 0.0],
    [0.01584, 0.005723, 0.0],
    [0.01135916, 0.004102, 0.0],
    [0.008110916, 0.002929, 0.0],
    [0.005790346, 0.002091, 0.0],
    [0.004109457, 0.001484, 0.0],
    [0.002899327, 0.001047, 0.0],
    [0.00204919, 0.00074, 0.0],
    [0.001439971, 0.00052, 0.0],
    [0.000999949, 0.0003611, 0.0],
    [0.000690079, 0.0002492, 0.0],
    [0.000476021, 0.0001719, 0.0],
    [0.000332301, 0.00012, 0.0],
    [0.000234826, 0.0000848, 0.0],
    [0.000166151, 0.00006, 0.0],
    [0.000117413, 0.0000424, 0.0],
    [0.000083075, 0.00003, 0.0],
    [0.000058707, 0.0000212, 0.0],
    [0.00004151, 0.00001499, 0.0],
    [0.000029353, 0.0000106, 0.0],
    [0.000020674, 0.000007466, 0.0],
    [0.00001456, 0.000005258, 0.0],
    [0.000010254, 0.000003703, 0.0],
    [0.000007221, 0.000002608, 0.0],
    [0.000005086, 0.000001837, 0.0],
    [0.000003582, 0.000001293, 0.0],
    [0.000002523, 0.000000911, 0.0],
    [0.000001777, 0.000000642, 0.0],
    [0.000001251, 0.000000452, 0.0],
];
