//! Rows of spheres as a PNG.

use super::RADIUS;
use crate::report::plot::text::Face;
use crate::report::plot::{PlotError, Theme};
use crate::report::raster::{Inks, Raster};

/// The text above and beside the spheres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    /// The first line of the heading.
    pub title: String,
    /// The second line of the heading.
    pub subtitle: String,
    /// The title of each row.
    pub rows: Vec<String>,
    /// The title of each column.
    pub columns: Vec<String>,
    /// The colours.
    pub theme: Theme,
}

/// What of each square is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// The sphere in it.
    Sphere,
    /// All of it.
    Square,
}

const GAP: usize = 12;
const SIDE: usize = 24;
const HEADING: usize = 96;
const ROW_HEADING: usize = 28;

/// Returns a PNG of squares of `size` pixels, row by row, each the colours of
/// [`super::Spheres::shade`], or other pictures; without labels, the squares alone, side by side.
///
/// # Errors
/// Those of encoding.
pub fn picture(
    rows: &[Vec<Vec<[f32; 3]>>],
    size: usize,
    shape: Shape,
    labels: Option<&Labels>,
) -> Result<Vec<u8>, PlotError> {
    let columns = rows.first().map_or(0, Vec::len);
    let at = |row: usize, column: usize| match labels {
        None => (column * size, row * size),
        Some(_) => {
            (SIDE + column * (size + GAP), HEADING + row * (size + GAP + ROW_HEADING) + ROW_HEADING)
        }
    };
    let (right, bottom) = at(rows.len().saturating_sub(1), columns.saturating_sub(1));
    let margin = if labels.is_some() { SIDE } else { 0 };
    let (width, height) = (right + size + margin, bottom + size + margin);
    let inks = Inks::of(labels.map_or(Theme::Light, |labels| labels.theme));
    let mut raster = Raster::new(width, height, inks.paper);
    for (r, row) in rows.iter().enumerate() {
        for (c, square) in row.iter().enumerate() {
            paint(&mut raster, at(r, c), size, shape, square);
        }
    }
    let Some(labels) = labels else { return raster.png() };
    let face = Face::regular(14.0);
    raster.write(&labels.title, Face::bold(22.0), inks.ink, (SIDE, 42), width);
    raster.write(&labels.subtitle, face, inks.faint, (SIDE, 67), width);
    for (c, label) in labels.columns.iter().enumerate() {
        let centre = at(0, c).0 + size / 2;
        let left = centre.saturating_sub((face.width(label) / 2.0) as usize);
        raster.write(label, face, inks.faint, (left, HEADING), size);
    }
    for (r, label) in labels.rows.iter().enumerate() {
        let (x, y) = at(r, 0);
        raster.write(label, face, inks.ink, (x, y - 8), width);
    }
    raster.png()
}

fn paint(
    raster: &mut Raster,
    (left, top): (usize, usize),
    size: usize,
    shape: Shape,
    square: &[[f32; 3]],
) {
    let centre = |i: usize| i as f32 + 0.5 - size as f32 / 2.0;
    for (i, colour) in square.iter().enumerate() {
        let (x, y) = (i % size, i / size);
        let distance = centre(x).hypot(centre(y));
        let coverage = match shape {
            Shape::Sphere => RADIUS * size as f32 / 2.0 - distance + 0.5,
            Shape::Square => 1.0,
        };
        let colour = colour.map(|channel| (channel.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
        raster.blend(left + x, top + y, colour, coverage);
    }
}
