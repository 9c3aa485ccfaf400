//! The pictures of a projection: parameters and residual over the places, errors over parameters.

use super::panels::{Content, Panel, picture};
use super::scale::Scale;
use crate::project::{Landscape, Place, PlaceGrid, Surfaces};
use crate::report::maps::end_text;
use crate::report::plot::{PlotError, Theme};

/// The most slices of a third input that are shown. By hand.
const SLICES: usize = 3;

/// The most panels side by side. By hand: the page's width.
const ACROSS: usize = 4;

/// Returns the picture of the parameters and the residual.
pub(super) fn surfaces(
    surfaces: &Surfaces,
    title: &str,
    theme: Theme,
) -> Result<Vec<u8>, PlotError> {
    let labels = surfaces.labels.iter().map(String::as_str).chain(["residual"]).enumerate();
    let rows: Vec<Vec<Panel>> = match surfaces.table() {
        Some(grid) => {
            let table = Table { surfaces, grid };
            labels.map(|(which, label)| table.panels(which, label)).collect()
        }
        None => labels.map(|(which, label)| vec![scattered(surfaces, which, label)]).collect(),
    };
    // One panel a row would be a narrow strip.
    let rows = match rows.iter().all(|row| row.len() == 1) {
        true => in_rows(rows.into_iter().flatten().collect()),
        false => rows,
    };
    let subtitle = "Each group's own optimum; jumps between neighbours are other optima";
    picture([title, subtitle], &rows, theme)
}

fn in_rows(panels: Vec<Panel>) -> Vec<Vec<Panel>> {
    let mut rows: Vec<Vec<Panel>> = Vec::new();
    for panel in panels {
        match rows.last_mut() {
            Some(row) if row.len() < ACROSS => row.push(panel),
            _ => rows.push(vec![panel]),
        }
    }
    rows
}

/// What stands below a panel's name.
fn described(label: &str) -> String {
    if label == "residual" { "RMSE of data and model" } else { "" }.to_owned()
}

fn value_of(place: &Place, which: usize) -> f32 {
    place.values.get(which).copied().unwrap_or(place.residual)
}

/// Returns the scale of a parameter, or of the residual, over all places.
fn scale_of(surfaces: &Surfaces, which: usize) -> Scale {
    Scale::of_values(surfaces.search.iter().map(|place| value_of(place, which)))
}

/// Surfaces on a grid, or most of one.
struct Table<'a> {
    surfaces: &'a Surfaces,
    grid: PlaceGrid,
}

impl Table<'_> {
    fn value(&self, cell: usize, which: usize) -> f32 {
        let number = self.grid.numbers[cell];
        number.map_or(f32::NAN, |number| value_of(&self.surfaces.search[number], which))
    }

    /// Returns a panel for each slice.
    fn panels(&self, which: usize, label: &str) -> Vec<Panel> {
        let scale = scale_of(self.surfaces, which);
        if let [only] = self.grid.axes.as_slice() {
            let title = [label.to_owned(), described(label)];
            let values: Vec<f32> = (0..only.len()).map(|i| self.value(i, which)).collect();
            let name = &self.surfaces.over[0].name;
            let axes = [Scale::along(only), scale];
            return vec![curve(title, [name, label], axes, only, &values)];
        }
        let slice = |(below, text): &(Vec<usize>, String)| {
            let text = if text.is_empty() { described(label) } else { text.clone() };
            self.slice(which, scale, [label.to_owned(), text], below)
        };
        self.slices().iter().map(slice).collect()
    }

    fn slice(&self, which: usize, scale: Scale, title: [String; 2], below: &[usize]) -> Panel {
        let [across, up, others @ ..] = self.grid.axes.as_slice() else {
            unreachable!("a slice has two inputs")
        };
        let cell = |x: usize, y: usize| {
            let inner = others.iter().zip(below);
            inner.fold(x * up.len() + y, |cell, (axis, i)| cell * axis.len() + i)
        };
        let cells = (0..up.len()).flat_map(|y| (0..across.len()).map(move |x| (x, y)));
        let values = cells.map(|(x, y)| self.value(cell(x, y), which)).collect();
        let scales = [across, up].map(|axis| Scale::along(axis));
        let places = |scale: &Scale, axis: &[f32]| axis.iter().map(|at| scale.place(*at)).collect();
        Panel {
            title,
            axes: [0, 1].map(|axis| scales[axis].label(&self.surfaces.over[axis].name)),
            content: Content::Heat {
                across: places(&scales[0], across),
                up: places(&scales[1], up),
                values,
                scale,
                contours: false,
            },
            mark: None,
        }
    }

    /// Returns the slices of the inputs after the second, in words, too: of the third at its ends
    /// and in the middle, of further ones in the middle.
    fn slices(&self) -> Vec<(Vec<usize>, String)> {
        let [_, _, third, others @ ..] = self.grid.axes.as_slice() else {
            return vec![(Vec::new(), String::new())];
        };
        let mut at = vec![0, third.len() / 2, third.len() - 1];
        at.dedup();
        let middle: Vec<usize> = others.iter().map(|axis| axis.len() / 2).collect();
        let slice = |i: usize| {
            let places = [&[i][..], &middle].concat();
            let values = self.grid.axes[2..].iter().zip(&places).map(|(axis, &i)| axis[i]);
            let named = self.surfaces.over[2..].iter().zip(values);
            let texts = named.map(|(column, value)| format!("{} {}", column.name, end_text(value)));
            let text = texts.collect::<Vec<_>>().join(", ");
            (places, text)
        };
        at.into_iter().take(SLICES).map(slice).collect()
    }
}

/// Draws places that lie on no grid, over the first two inputs.
fn scattered(surfaces: &Surfaces, which: usize, label: &str) -> Panel {
    let along = |axis: usize| {
        let mut places: Vec<f32> = surfaces.search.iter().map(|place| place.at[axis]).collect();
        places.sort_unstable_by(f32::total_cmp);
        Scale::along(&places)
    };
    let scales = [0, 1].map(along);
    let at = |place: &Place| [0, 1].map(|axis| scales[axis].place(place.at[axis]));
    Panel {
        title: [label.to_owned(), described(label)],
        axes: [0, 1].map(|axis| scales[axis].label(&surfaces.over[axis].name)),
        content: Content::Dots {
            points: surfaces.search.iter().map(at).collect(),
            values: surfaces.search.iter().map(|place| value_of(place, which)).collect(),
            scale: scale_of(surfaces, which),
        },
        mark: None,
    }
}

/// Draws values at ascending places.
fn curve(
    title: [String; 2],
    names: [&str; 2],
    scales: [Scale; 2],
    along: &[f32],
    values: &[f32],
) -> Panel {
    let point = |(at, value): (&f32, &f32)| [scales[0].place(*at), scales[1].place(*value)];
    Panel {
        title,
        axes: [0, 1].map(|axis| scales[axis].label(names[axis])),
        content: Content::Curve(along.iter().zip(values).map(point).collect()),
        mark: None,
    }
}

/// Returns the picture of errors over parameters, a row a place; errors above `most` are as `most`.
pub(super) fn landscapes(
    found: &[Vec<Landscape>],
    surfaces: &Surfaces,
    most: f32,
    [title, subtitle]: [&str; 2],
    theme: Theme,
) -> Result<Vec<u8>, PlotError> {
    let panel = |landscape: &Landscape| landscape_panel(landscape, surfaces, most);
    let mut rows: Vec<Vec<Panel>> =
        found.iter().map(|row| row.iter().map(panel).collect()).collect();
    if rows.iter().all(|row| row.len() == 1) {
        rows = in_rows(rows.into_iter().flatten().collect());
    }
    picture([title, subtitle], &rows, theme)
}

fn landscape_panel(landscape: &Landscape, surfaces: &Surfaces, most: f32) -> Panel {
    let labels: Vec<&str> =
        landscape.parameters.iter().map(|&i| surfaces.labels[i].as_str()).collect();
    let at = surfaces.over.iter().zip(&landscape.at);
    let at: Vec<String> =
        at.map(|(column, at)| format!("{} {}", column.name, end_text(*at))).collect();
    let residual = end_text(landscape.residual);
    let title = [format!("RMSE {residual} at best"), at.join(", ")];
    let scale = Scale::of_errors(&landscape.errors, most);
    let axis = |which: usize| Scale {
        ends: landscape.ranges[which],
        logarithmic: landscape.logarithmic[which],
    };
    let centre = |i: usize| (i as f32 + 0.5) / landscape.points as f32;
    let centres: Vec<f32> = (0..landscape.points).map(centre).collect();
    match labels.as_slice() {
        [across, up] => Panel {
            title,
            axes: [axis(0).label(across), axis(1).label(up)],
            content: Content::Heat {
                across: centres.clone(),
                up: centres,
                values: landscape.errors.clone(),
                scale,
                contours: true,
            },
            mark: Some([landscape.optimum[0], landscape.optimum[1]]),
        },
        labels => Panel {
            title,
            axes: [axis(0).label(labels[0]), scale.label("RMSE")],
            content: Content::Curve(
                centres
                    .iter()
                    .zip(&landscape.errors)
                    .map(|(at, error)| [*at, scale.place(*error)])
                    .collect(),
            ),
            mark: Some([landscape.optimum[0], scale.place(landscape.residual)]),
        },
    }
}
