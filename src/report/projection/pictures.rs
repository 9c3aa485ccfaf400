//! The pictures of a projection: parameters and residual over the places, errors over parameters.

use super::panels::{Content, Panel, picture};
use crate::program::format_constant;
use crate::project::{Landscape, Place, Surfaces};
use crate::report::plot::{PlotError, Theme};

/// The most slices of a third input that are shown. By hand.
const SLICES: usize = 3;

/// Returns the picture of the parameters and the residual; none if the places are scattered.
pub(super) fn surfaces(
    surfaces: &Surfaces,
    title: &str,
    theme: Theme,
) -> Result<Option<Vec<u8>>, PlotError> {
    let Some((axes, numbers)) = surfaces.table() else { return Ok(None) };
    let names: Vec<&str> = surfaces.over.iter().map(|column| column.name.as_str()).collect();
    let shown = surfaces.labels.iter().map(String::as_str).chain(["residual"]).enumerate();
    let value = |number: Option<usize>, which: usize| {
        number.map_or(f32::NAN, |number| value_of(&surfaces.search[number], which))
    };
    let slices = slices(&axes);
    let mut rows = Vec::new();
    for (which, label) in shown {
        let described = if label == "residual" { "distance of data and model, RMSE" } else { "" };
        let panel = |(slice, below): &(String, Vec<usize>)| {
            let title =
                [label.to_owned(), if slice.is_empty() { described } else { slice }.to_owned()];
            match axes.as_slice() {
                [only] => curve_of(title, names[0], only, |i| value(numbers[i], which)),
                _ => {
                    let cell = |x: usize, y: usize| {
                        let outer = x * axes[1].len() + y;
                        let inner = axes[2..].iter().zip(below);
                        inner.fold(outer, |cell, (axis, i)| cell * axis.len() + i)
                    };
                    let values = (0..axes[1].len())
                        .flat_map(|y| (0..axes[0].len()).map(move |x| (x, y)))
                        .map(|(x, y)| value(numbers[cell(x, y)], which));
                    Panel {
                        title,
                        axes: [0, 1].map(|axis| (names[axis].to_owned(), ends(&axes[axis]))),
                        content: Content::Heat {
                            across: axes[0].len(),
                            up: axes[1].len(),
                            values: values.collect(),
                            contours: false,
                        },
                        mark: None,
                    }
                }
            }
        };
        rows.push(slices.iter().map(panel).collect::<Vec<Panel>>());
    }
    // One panel a row would be a narrow strip.
    if slices.len() == 1 {
        let panels: Vec<Panel> = rows.into_iter().flatten().collect();
        rows = in_rows(panels, 4);
    }
    let subtitle = "each group by its own optimum; jumps between neighbours are other optima";
    Ok(Some(picture([title, subtitle], &rows, theme)?))
}

fn in_rows(panels: Vec<Panel>, across: usize) -> Vec<Vec<Panel>> {
    let mut rows: Vec<Vec<Panel>> = Vec::new();
    for panel in panels {
        match rows.last_mut() {
            Some(row) if row.len() < across => row.push(panel),
            _ => rows.push(vec![panel]),
        }
    }
    rows
}

fn value_of(place: &Place, which: usize) -> f32 {
    place.values.get(which).copied().unwrap_or(place.residual)
}

fn ends(axis: &[f32]) -> [f32; 2] {
    [axis[0], axis[axis.len() - 1]]
}

/// Returns the slices of the inputs after the second: of the third at its ends and in the middle,
/// of further ones in the middle.
fn slices(axes: &[Vec<f32>]) -> Vec<(String, Vec<usize>)> {
    let [_, _, third, others @ ..] = axes else { return vec![(String::new(), Vec::new())] };
    let mut at = vec![0, third.len() / 2, third.len() - 1];
    at.dedup();
    let middle: Vec<usize> = others.iter().map(|axis| axis.len() / 2).collect();
    let slice = |i: usize| {
        let places = [&[i][..], &middle].concat();
        let values = axes[2..].iter().zip(&places).map(|(axis, &i)| format_constant(axis[i]));
        (format!("further inputs {}", values.collect::<Vec<_>>().join(", ")), places)
    };
    at.into_iter().take(SLICES).map(slice).collect()
}

/// Draws a function of places along an axis between its least and greatest value.
fn curve_of(title: [String; 2], name: &str, along: &[f32], value: impl Fn(usize) -> f32) -> Panel {
    let values: Vec<f32> = (0..along.len()).map(value).collect();
    let finite = values.iter().copied().filter(|value| value.is_finite());
    let [low, high] = finite.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    let share = |value: f32, [low, high]: [f32; 2]| match high > low {
        true => (value - low) / (high - low),
        false => 0.5,
    };
    let point = |(at, value): (&f32, &f32)| [share(*at, ends(along)), share(*value, [low, high])];
    Panel {
        title,
        axes: [(name.to_owned(), ends(along)), ("value".to_owned(), [low, high])],
        content: Content::Curve(along.iter().zip(&values).map(point).collect()),
        mark: None,
    }
}

/// Returns the picture of errors over parameters: a row a place, logarithms of the RMSE.
pub(super) fn landscapes(
    found: &[Vec<Landscape>],
    surfaces: &Surfaces,
    title: &str,
    theme: Theme,
) -> Result<Vec<u8>, PlotError> {
    let panel = |landscape: &Landscape| {
        let labels: Vec<&str> =
            landscape.parameters.iter().map(|&i| surfaces.labels[i].as_str()).collect();
        let place: Vec<String> = surfaces
            .over
            .iter()
            .zip(&landscape.at)
            .map(|(column, at)| format!("{} {}", column.name, format_constant(*at)))
            .collect();
        let title = [format!("error over {}", labels.join(", ")), place.join(", ")];
        let errors: Vec<f32> =
            landscape.errors.iter().map(|error| error.max(1e-30).log10()).collect();
        match landscape.ranges.as_slice() {
            [across, up] => Panel {
                title,
                axes: [(labels[0].to_owned(), *across), (labels[1].to_owned(), *up)],
                content: Content::Heat {
                    across: landscape.points,
                    up: landscape.points,
                    values: errors,
                    contours: true,
                },
                mark: Some([landscape.optimum[0], landscape.optimum[1]]),
            },
            ranges => {
                let [low, high] = ranges.first().copied().unwrap_or([0.0, 1.0]);
                let at = |i: usize| low + (high - low) * (i as f32 + 0.5) / landscape.points as f32;
                let along: Vec<f32> = (0..landscape.points).map(at).collect();
                curve_of(title, labels[0], &along, |i| errors[i])
            }
        }
    };
    let rows: Vec<Vec<Panel>> = found.iter().map(|row| row.iter().map(panel).collect()).collect();
    let subtitle =
        "logarithm of the RMSE to the base 10, the other parameters at their optimum (cross)";
    picture([title, subtitle], &rows, theme)
}
