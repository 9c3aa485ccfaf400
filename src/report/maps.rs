//! Truth, formulas, and their differences over the plane of two inputs: figure 22 of Pesce and
//! Iwanicki, "Approximate Models for Physically Based Rendering" (SIGGRAPH 2015 course).

use super::plot::text::Face;
use super::plot::{PlotError, Theme};
use super::raster::{Colour, Inks, Raster};
use crate::dataset::{Dataset, Split};
use crate::program::format_constant;

/// The magnification of differences in maps: a difference has the colour of a value this many times
/// as large. By hand, unmeasured.
pub const DIFFERENCE_TIMES: f32 = 3.0;

/// The plane of a grid's first two inputs, through the middle of all others.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// Points across and up.
    pub points: [usize; 2],
    /// Rows of the split, across and then up.
    pub rows: Vec<usize>,
}

impl Plane {
    /// Returns none if the split is no grid or has only one input.
    pub fn of(split: &Split) -> Option<Plane> {
        let [across, up, others @ ..] = split.grid.as_slice() else { return None };
        let below: usize = others.iter().product();
        // The row of the others' middles within their block.
        let middle = others.iter().fold(0, |row, points| row * points + points / 2);
        let row = |(x, y): (usize, usize)| (x * up + y) * below + middle;
        let cells = (0..*up).flat_map(|y| (0..*across).map(move |x| (x, y)));
        Some(Plane { points: [*across, *up], rows: cells.map(row).collect() })
    }

    /// Returns a column of the split on the plane.
    pub fn column(&self, values: &[f32]) -> Vec<f32> {
        self.rows.iter().map(|&row| values[row]).collect()
    }
}

/// A picture of maps.
#[derive(Clone, Debug)]
pub struct Maps {
    /// The first line of the heading.
    pub title: String,
    /// The second line of the heading.
    pub subtitle: String,
    /// The two-line titles of the columns; the last column is the truth.
    pub columns: Vec<[String; 2]>,
    /// The points that are drawn.
    pub plane: Plane,
    /// The maps of each output.
    pub outputs: Vec<OutputMaps>,
}

/// The maps of one output.
#[derive(Clone, Debug)]
pub struct OutputMaps {
    /// The output's name.
    pub name: String,
    /// By column, the values on the plane; an output of fewer columns has the last ones.
    pub columns: Vec<Vec<f32>>,
}

/// Describes a plane's axes.
pub fn axes(dataset: &Dataset) -> String {
    let names: Vec<&str> = dataset.inputs.iter().map(|input| input.name.as_str()).collect();
    let [across, up, others @ ..] = names.as_slice() else { return String::new() };
    let plane = format!("{across} from left to right, {up} upwards");
    match others {
        [] => plane,
        others => format!("{plane}, {} in the middle", others.join(", ")),
    }
}

pub(super) const PANEL: usize = 200;
const GAP: usize = 10;
const SIDE: usize = 24;
const HEADING: usize = 84;
const BLOCK_HEADING: usize = 72;
const BAR: usize = 44;
/// Pixels between the maps of two outputs.
const APART: usize = 32;

/// Returns the maps as a PNG: for each output a row of values above a row of differences, each with
/// its scale, that of differences ending at a [`DIFFERENCE_TIMES`]th of the values' range. Two
/// outputs stand side by side.
///
/// # Errors
/// Those of encoding.
pub fn picture(maps: &Maps, theme: Theme) -> Result<Vec<u8>, PlotError> {
    let inks = Inks::of(theme);
    let block_width = maps.columns.len() * (PANEL + GAP) - GAP;
    let block_height = BLOCK_HEADING + 2 * (PANEL + GAP) + BAR;
    let beside = maps.outputs.len().clamp(1, 2);
    let lines = maps.outputs.len().div_ceil(beside);
    let width = 2 * SIDE + beside * (block_width + APART) - APART;
    let mut raster = Raster::new(width, HEADING + lines * (block_height + GAP), inks.paper);
    raster.write(&maps.title, Face::bold(22.0), inks.ink, (SIDE, 40), width - 2 * SIDE);
    raster.write(&maps.subtitle, Face::regular(14.0), inks.faint, (SIDE, 65), width - 2 * SIDE);
    for (i, output) in maps.outputs.iter().enumerate() {
        let left = SIDE + i % beside * (block_width + APART);
        let top = HEADING + i / beside * (block_height + GAP);
        block(&mut raster, maps, output, (left, top), &inks);
    }
    raster.png()
}

fn block(
    raster: &mut Raster,
    maps: &Maps,
    output: &OutputMaps,
    (left, top): (usize, usize),
    inks: &Inks,
) {
    let Some((truth, _)) = output.columns.split_last() else { return };
    let low = truth.iter().copied().fold(f32::INFINITY, f32::min);
    let high = truth.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let span = span(low, high);
    raster.write(&output.name, Face::bold(16.0), inks.ink, (left, top + 20), PANEL);
    let small = Face::regular(13.0);
    for (c, values) in output.columns.iter().enumerate() {
        let x = left + c * (PANEL + GAP);
        let y = top + BLOCK_HEADING;
        let title = maps.columns.len() - output.columns.len() + c;
        for (line, text) in maps.columns[title].iter().enumerate() {
            let colour = if line == 0 { inks.ink } else { inks.faint };
            raster.write(text, small, colour, (x, y - 25 + 17 * line), PANEL);
        }
        panel(raster, &maps.plane, (x, y), |i| viridis((values[i] - low) / span));
        let below = (x, y + PANEL + GAP);
        if c + 1 < output.columns.len() {
            panel(raster, &maps.plane, below, |i| {
                difference_colour((values[i] - truth[i]).abs(), span)
            });
        } else {
            // Nothing differs from a truth that stands alone.
            let scales = scales(low, high).into_iter().take(output.columns.len());
            for (y, (words, ends)) in [18, 92].into_iter().zip(scales) {
                raster.write(words, small, inks.faint, (below.0, below.1 + y), PANEL);
                bar(raster, (below.0, below.1 + y + 10), ends, inks);
            }
        }
    }
}

/// Returns the range that values are divided by.
fn span(low: f32, high: f32) -> f32 {
    (high - low).max(f32::MIN_POSITIVE)
}

fn difference_colour(difference: f32, span: f32) -> Colour {
    viridis(DIFFERENCE_TIMES * difference / span)
}

/// Returns the scales of colours for values between two ends: of values, then of differences.
fn scales(low: f32, high: f32) -> [(&'static str, [f32; 2]); 2] {
    let most = span(low, high) / DIFFERENCE_TIMES;
    [("values", [low, high]), ("left: |difference| from the truth", [0.0, most])]
}

/// Draws a scale of colours with the values at its ends.
fn bar(raster: &mut Raster, at: (usize, usize), [low, high]: [f32; 2], inks: &Inks) {
    let nothing = 1e-3 * (high - low);
    let shown = |end: f32| if end.abs() < nothing { 0.0 } else { end };
    bar_between(raster, at, [low, high].map(|end| end_text(shown(end))), inks);
}

/// Draws a scale of colours with a text at each end.
pub(super) fn bar_between(
    raster: &mut Raster,
    (left, top): (usize, usize),
    [low, high]: [String; 2],
    inks: &Inks,
) {
    for x in 0..PANEL {
        for y in 0..10 {
            raster.blend(left + x, top + y, viridis(x as f32 / (PANEL - 1) as f32), 1.0);
        }
    }
    let small = Face::regular(12.0);
    raster.write(&low, small, inks.faint, (left, top + 26), PANEL / 2);
    let right = left + PANEL - small.width(&high) as usize;
    raster.write(&high, small, inks.faint, (right, top + 26), PANEL / 2);
}

/// Formats three significant digits, without zeros at the end.
pub(super) fn end_text(value: f32) -> String {
    format_constant(format!("{value:.2e}").parse().unwrap_or(value))
}

fn panel(
    raster: &mut Raster,
    plane: &Plane,
    (left, top): (usize, usize),
    colour: impl Fn(usize) -> Colour,
) {
    let [across, up] = plane.points;
    for y in 0..PANEL {
        for x in 0..PANEL {
            let cell = (PANEL - 1 - y) * up / PANEL * across + x * across / PANEL;
            raster.blend(left + x, top + y, colour(cell), 1.0);
        }
    }
}

/// Returns a colour of Viridis (van der Walt and Smith, 2015), from ninths with linear
/// interpolation; grey if `place` is not finite.
pub(super) fn viridis(place: f32) -> Colour {
    const STOPS: [Colour; 10] = [
        [0x44, 0x01, 0x54],
        [0x48, 0x28, 0x78],
        [0x3e, 0x49, 0x89],
        [0x31, 0x68, 0x8e],
        [0x26, 0x82, 0x8e],
        [0x1f, 0x9e, 0x89],
        [0x35, 0xb7, 0x79],
        [0x6e, 0xce, 0x58],
        [0xb5, 0xde, 0x2b],
        [0xfd, 0xe7, 0x25],
    ];
    if !place.is_finite() {
        return [128; 3];
    }
    let along = place.clamp(0.0, 1.0) * 9.0;
    let low = (along as usize).min(8);
    let part = along - low as f32;
    std::array::from_fn(|c| {
        let [a, b] = [STOPS[low][c], STOPS[low + 1][c]].map(f32::from);
        (a + part * (b - a) + 0.5) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_runs_across_and_then_up_through_the_middle_of_the_rest() {
        let split = |grid: Vec<usize>| Split { grid, ..Split::default() };
        let plane = Plane::of(&split(vec![3, 2])).unwrap();
        assert_eq!((plane.points, plane.rows), ([3, 2], vec![0, 2, 4, 1, 3, 5]));
        let sliced = Plane::of(&split(vec![2, 2, 3])).unwrap();
        assert_eq!(sliced.rows, [1, 7, 4, 10]);
        assert!(Plane::of(&split(vec![9])).is_none() && Plane::of(&split(vec![])).is_none());
    }

    #[test]
    fn ends_have_three_digits() {
        for (value, expected) in [
            (0.0, "0"),
            (1.0, "1"),
            (0.333_333_34, "0.333"),
            (-1234.5, "-1230"),
            (1.5e-7, "1.5e-7"),
        ] {
            assert_eq!(end_text(value), expected);
        }
    }

    #[test]
    fn the_scale_of_differences_ends_where_their_colours_do() {
        for (low, high) in [(0.0, 1.0), (-3.0, 7.5), (1e-4, 2e-4)] {
            let [(_, values), (_, differences)] = scales(low, high);
            assert_eq!(values, [low, high]);
            let colour = |share: f32| {
                let at = differences[0] + share * (differences[1] - differences[0]);
                difference_colour(at, span(low, high))
            };
            for share in [0.0, 0.25, 0.5, 1.0] {
                let apart =
                    std::iter::zip(colour(share), viridis(share)).map(|(a, b)| a.abs_diff(b));
                assert!(apart.max() <= Some(1), "{share} of {low}..{high}");
            }
        }
    }

    #[test]
    fn colours_end_where_viridis_does() {
        assert_eq!([viridis(-1.0), viridis(2.0)], [[0x44, 0x01, 0x54], [0xfd, 0xe7, 0x25]]);
        assert_eq!(viridis(f32::NAN), [128; 3]);
    }
}
