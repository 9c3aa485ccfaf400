//! Panels beside and below each other: heat maps, with contours where asked for, curves and dots.

use super::scale::Scale;
use crate::report::maps::{PANEL, bar_between, viridis};
use crate::report::plot::text::Face;
use crate::report::plot::{PlotError, Theme};
use crate::report::raster::{Colour, Inks, Raster};

/// A part of a picture.
pub(super) struct Panel {
    /// The lines above it.
    pub title: [String; 2],
    /// What the axes say: across, up.
    pub axes: [String; 2],
    pub content: Content,
    /// A place to mark, from 0 to 1 along each axis.
    pub mark: Option<[f32; 2]>,
}

/// What a panel shows; all places are from 0 to 1.
pub(super) enum Content {
    /// Values at the crossings of ascending places along both axes, the lowest row first; grey where
    /// they are not finite.
    Heat { across: Vec<f32>, up: Vec<f32>, values: Vec<f32>, scale: Scale, contours: bool },
    /// Points; where one is not finite, the curve is interrupted.
    Curve(Vec<[f32; 2]>),
    /// Points, each with its value.
    Dots { points: Vec<[f32; 2]>, values: Vec<f32>, scale: Scale },
}

const SIDE: usize = 24;
const GAP: usize = 26;
const HEADING: usize = 84;
const TITLE: usize = 44;
const BELOW: usize = 84;

/// The fewest panels that a picture is wide enough for: its heading is a line of text.
const ACROSS: usize = 3;

/// The number of contours between a panel's least and its greatest value. By hand.
const CONTOURS: f32 = 14.0;

/// Draws rows of panels as a PNG.
pub(super) fn picture(
    [title, subtitle]: [&str; 2],
    rows: &[Vec<Panel>],
    theme: Theme,
) -> Result<Vec<u8>, PlotError> {
    let inks = Inks::of(theme);
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0).max(ACROSS);
    let width = 2 * SIDE + columns * (PANEL + GAP) - GAP;
    let height = HEADING + rows.len() * (TITLE + PANEL + BELOW);
    let mut raster = Raster::new(width, height, inks.paper);
    raster.write(title, Face::bold(18.0), inks.ink, (SIDE, 38), width - 2 * SIDE);
    raster.write(subtitle, Face::regular(13.0), inks.faint, (SIDE, 62), width - 2 * SIDE);
    for (line, panels) in rows.iter().enumerate() {
        for (column, panel) in panels.iter().enumerate() {
            let left = SIDE + column * (PANEL + GAP);
            draw(&mut raster, panel, (left, HEADING + line * (TITLE + PANEL + BELOW)), &inks);
        }
    }
    raster.png()
}

fn draw(raster: &mut Raster, panel: &Panel, (left, top): (usize, usize), inks: &Inks) {
    let small = Face::regular(12.0);
    raster.write(&panel.title[0], Face::bold(14.0), inks.ink, (left, top + 14), PANEL);
    raster.write(&panel.title[1], small, inks.faint, (left, top + 33), PANEL + GAP - 4);
    let corner = (left, top + TITLE);
    let below = top + TITLE + PANEL;
    for ((arrow, axis), line) in ["→", "↑"].into_iter().zip(&panel.axes).zip([16, 32]) {
        let text = format!("{arrow} {axis}");
        raster.write(&text, small, inks.faint, (left, below + line), PANEL + GAP - 4);
    }
    let colours = |raster: &mut Raster, scale: &Scale| {
        bar_between(raster, (left, below + 40), scale.bar_texts(), inks);
    };
    match &panel.content {
        Content::Heat { across, up, values, scale, contours } => {
            heat(raster, corner, [across, up], |cell| scale.place(values[cell]), *contours);
            colours(raster, scale);
        }
        Content::Curve(points) => {
            frame(raster, corner, inks);
            curve(raster, corner, points);
        }
        Content::Dots { points, values, scale } => {
            frame(raster, corner, inks);
            for (point, value) in points.iter().zip(values) {
                disc(raster, corner, *point, viridis(scale.place(*value)));
            }
            colours(raster, scale);
        }
    }
    if let Some([x, y]) = panel.mark {
        cross(raster, corner, [x, y]);
    }
}

/// The places around a pixel, and how far it is from the first to the second.
type Around = (usize, usize, f32);

/// Returns the places around each pixel along an axis.
fn around(places: &[f32]) -> Vec<Around> {
    let last = places.len() - 1;
    let of = |pixel: usize| {
        let at = (pixel as f32 + 0.5) / PANEL as f32;
        let high = places.partition_point(|place| *place < at).min(last);
        let low = if places[high] < at { high } else { high.saturating_sub(1) };
        let apart = places[high] - places[low];
        let share = if apart > 0.0 { ((at - places[low]) / apart).clamp(0.0, 1.0) } else { 0.0 };
        (low, high, share)
    };
    (0..PANEL).map(of).collect()
}

fn heat(
    raster: &mut Raster,
    (left, top): (usize, usize),
    [across, up]: [&[f32]; 2],
    place: impl Fn(usize) -> f32,
    contours: bool,
) {
    let (columns, rows) = (around(across), around(up));
    let nearest = |(low, high, share): Around| if share < 0.5 { low } else { high };
    let at = |x: usize, y: usize| place(y * across.len() + x);
    let between = |x: usize, y: usize| -> Option<f32> {
        let ((x0, x1, u), (y0, y1, v)) = (columns[x], rows[PANEL - 1 - y]);
        let below = at(x0, y0) + u * (at(x1, y0) - at(x0, y0));
        let above = at(x0, y1) + u * (at(x1, y1) - at(x0, y1));
        Some(below + v * (above - below)).filter(|value| value.is_finite())
    };
    let level = |x: usize, y: usize| between(x, y).map(|value| (CONTOURS * value).floor());
    let value = |x: usize, y: usize| at(nearest(columns[x]), nearest(rows[PANEL - 1 - y]));
    for y in 0..PANEL {
        for x in 0..PANEL {
            raster.blend(left + x, top + y, viridis(value(x, y)), 1.0);
            if !contours || x + 1 == PANEL || y + 1 == PANEL {
                continue;
            }
            let here = level(x, y);
            let is_edge = |other: Option<f32>| other.is_some() && other != here;
            if here.is_some() && (is_edge(level(x + 1, y)) || is_edge(level(x, y + 1))) {
                raster.blend(left + x, top + y, WHITE, 0.6);
            }
        }
    }
}

const WHITE: Colour = [255; 3];
const RED: Colour = [213, 40, 40];

fn frame(raster: &mut Raster, (left, top): (usize, usize), inks: &Inks) {
    for edge in 0..PANEL {
        for (x, y) in [(edge, 0), (edge, PANEL - 1), (0, edge), (PANEL - 1, edge)] {
            raster.blend(left + x, top + y, inks.faint, 0.35);
        }
    }
}

/// Returns the pixel of a place within a panel.
fn pixel([x, y]: [f32; 2]) -> [f32; 2] {
    let last = (PANEL - 1) as f32;
    [x.clamp(0.0, 1.0) * last, (1.0 - y.clamp(0.0, 1.0)) * last]
}

fn curve(raster: &mut Raster, (left, top): (usize, usize), points: &[[f32; 2]]) {
    let mut dot = |[x, y]: [f32; 2]| {
        for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            raster.blend(left + x as usize + dx, top + y as usize + dy, viridis(0.3), 1.0);
        }
    };
    for pair in points.windows(2) {
        let is_finite = pair.iter().flatten().all(|part| part.is_finite());
        if is_finite {
            let [a, b] = [pixel(pair[0]), pixel(pair[1])];
            let steps = 1 + (2.0 * (b[0] - a[0]).hypot(b[1] - a[1])) as usize;
            for step in 0..=steps {
                let share = step as f32 / steps as f32;
                dot([0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis])));
            }
        }
    }
}

fn disc(raster: &mut Raster, (left, top): (usize, usize), at: [f32; 2], colour: Colour) {
    const RADIUS: i32 = 4;
    let [x, y] = pixel(at).map(|part| part as i32);
    for dy in -RADIUS..=RADIUS {
        for dx in -RADIUS..=RADIUS {
            let (x, y) = (left as i32 + x + dx, top as i32 + y + dy);
            let coverage = RADIUS as f32 + 0.5 - ((dx * dx + dy * dy) as f32).sqrt();
            if x >= 0 && y >= 0 && coverage > 0.0 {
                raster.blend(x as usize, y as usize, colour, coverage);
            }
        }
    }
}

fn cross(raster: &mut Raster, (left, top): (usize, usize), at: [f32; 2]) {
    let [x, y] = pixel(at).map(|part| part as i32);
    for away in -5..=5i32 {
        for (dx, dy) in [(away, 0), (away, 1), (0, away), (1, away)] {
            let inside = |at: i32| (0..PANEL as i32).contains(&at);
            if inside(x + dx) && inside(y + dy) {
                let (x, y) = (left as i32 + x + dx, top as i32 + y + dy);
                raster.blend(x as usize, y as usize, RED, 1.0);
            }
        }
    }
}
