//! The tone curve of ACES: what its output transforms for displays make of grey.
//!
//! Definition: the Reference Rendering Transform and the Output Device Transform "sRGB, 100 nits,
//! dim" of the Academy Color Encoding System, versions 1.0 to 1.3, of a neutral colour: two
//! segmented quadratic splines in the logarithms of luminance (`segmented_spline_c5_fwd`, then
//! `segmented_spline_c9_fwd` with `ODT_48nits`, in `ACESlib.Tonescales.ctl` of
//! github.com/ampas/aces-dev), the display's luminance from black to white, and its power .9811 for
//! a dim surround. All else in them leaves greys alone. `signal` is that, encoded for sRGB
//! (IEC 61966-2-1).
//!
//! Exposure is in stops over middle grey, .18. Within 6.5 stops the curve rises from 0 to 1, beyond
//! it is cut off. It is what shaders call "ACES", and its inverse has no short form, so that both
//! are best found together, by the template `display = f(stops); back = g(f(stops))` and
//! `--derive 'back = stops'`.

use super::sampling::{SAMPLING, SAMPLING_SEED};
use super::table::{Sample, Table};
use super::{Choices, Make, Parameter, Recipe, Target, points};
use crate::dataset::Axis;
use std::f64::consts::LN_10;

/// Rounding.
const ERROR: f64 = 1e-12;
/// The first and the last exposure of the output transform's spline, black and white.
const STOPS: [f64; 2] = [-6.5, 6.5];
/// The luminance of white, in nits.
const WHITE: f64 = 48.0;
const DIM_SURROUND: f64 = 0.9811;
const LINEAR: &str = "display";
const SIGNAL: &str = "signal";

pub(super) const TARGET: Target = Target {
    name: "tone_curve",
    description: "tone curve of ACES 1.x for sRGB displays, of grey",
    columns: "stops → display or signal",
    parameters: &[
        Parameter {
            name: "of",
            description: "the display's light, linear; or its signal, encoded for sRGB",
            default: LINEAR,
            choices: Choices::OneOf(&[LINEAR, SIGNAL]),
        },
        points("256", 4096),
        SAMPLING,
        SAMPLING_SEED,
    ],
    make: Make::Table(table),
};

/// Computes the display's light, linear in [0, 1], for an exposure in stops over middle grey:
/// beyond 6.5 stops black or white.
pub fn display(stops: f64) -> f64 {
    let [darkest, grey, brightest] = [STOPS[0], 0.0, STOPS[1]].map(rendered);
    let rendered = rendered(stops).clamp(darkest, brightest);
    let log_nits = match rendered < grey {
        true => spline(&OUTPUT_LOW, (rendered - darkest) / (grey - darkest)),
        false => spline(&OUTPUT_HIGH, (rendered - grey) / (brightest - grey)),
    };
    // Black, .02 nits, is the spline's first value: a difference of powers would cancel near it.
    let black = OUTPUT_LOW[0];
    let light = ((log_nits - black) * LN_10).exp_m1() / (WHITE / 10.0_f64.powf(black) - 1.0);
    light.clamp(0.0, 1.0).powf(DIM_SURROUND)
}

/// Encodes light in [0, 1] for sRGB (IEC 61966-2-1).
pub fn encode_srgb(light: f64) -> f64 {
    match light <= 0.003_130_8 {
        true => 12.92 * light,
        false => 1.055 * light.powf(1.0 / 2.4) - 0.055,
    }
}

/// The Reference Rendering Transform: the logarithm of luminance to base 10.
fn rendered(stops: f64) -> f64 {
    match stops < 0.0 {
        true => spline(&RENDERING_LOW, (stops + 15.0) / 15.0),
        false => spline(&RENDERING_HIGH, stops / 18.0),
    }
}

/// Evaluates a uniform quadratic B-spline, `u` in [0, 1] from its first to its last knot.
fn spline<const N: usize>(coefficients: &[f64; N], u: f64) -> f64 {
    let place = u.clamp(0.0, 1.0) * (N - 2) as f64;
    let segment = (place as usize).min(N - 3);
    let t = place - segment as f64;
    let [a, b, c] = [0, 1, 2].map(|next| coefficients[segment + next]);
    0.5 * ((a - 2.0 * b + c) * t * t + 2.0 * (b - a) * t + a + b)
}

/// Returns the table on exposures from -6.5 to 6.5 stops.
fn table(recipe: &Recipe) -> Table {
    let axes = vec![Axis { domain: STOPS, ..Axis::unit("stops") }];
    if recipe.get("of") == Some(SIGNAL) {
        return Table::new(recipe, axes, &[("signal", "1")], ERROR, |at| Sample {
            values: [encode_srgb(display(at[0]))],
            error: ERROR,
        });
    }
    Table::new(recipe, axes, &[("display", "1")], ERROR, |at| Sample {
        values: [display(at[0])],
        error: ERROR,
    })
}

/// `RRT_PARAMS`, from 15 stops below middle grey to it, and to 18 stops above.
const RENDERING_LOW: [f64; 5] = [-4.0, -4.0, -3.157_376_577_3, -0.485_249_995_8, 1.847_732_470_6];
const RENDERING_HIGH: [f64; 5] = [-0.718_548_242_5, 2.081_030_717_2, 3.668_124_123_7, 4.0, 4.0];
/// `ODT_48nits`, from what black is rendered as to middle grey, and to white.
const OUTPUT_LOW: [f64; 9] = [
    -1.698_970_004_3,
    -1.698_970_004_3,
    -1.477_9,
    -1.229_1,
    -0.864_8,
    -0.448,
    0.005_18,
    0.451_108_033_4,
    0.911_374_441_4,
];
const OUTPUT_HIGH: [f64; 9] = [
    0.515_438_696_5,
    0.847_043_778_3,
    1.135_8,
    1.380_2,
    1.519_7,
    1.598_5,
    1.646_7,
    1.674_609_135_7,
    1.687_873_339,
];
