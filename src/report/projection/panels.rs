//! Panels beside and below each other: heat maps, with contours where asked for, and curves.

use crate::report::maps::{PANEL, bar, end_text, viridis};
use crate::report::plot::text::Face;
use crate::report::plot::{PlotError, Theme};
use crate::report::raster::{Colour, Inks, Raster};

/// A part of a picture.
pub(super) struct Panel {
    /// The lines above it.
    pub title: [String; 2],
    /// The name and the ends of each axis.
    pub axes: [(String, [f32; 2]); 2],
    pub content: Content,
    /// A place to mark, from 0 to 1 along each axis.
    pub mark: Option<[f32; 2]>,
}

/// What a panel shows.
pub(super) enum Content {
    /// Values, the lowest row first; grey where they are not finite.
    Heat { across: usize, up: usize, values: Vec<f32>, contours: bool },
    /// Points, from 0 to 1 along each axis; where one is not finite, the curve is interrupted.
    Curve(Vec<[f32; 2]>),
}

const SIDE: usize = 24;
const GAP: usize = 26;
const HEADING: usize = 84;
const TITLE: usize = 44;
const BELOW: usize = 66;

/// The number of contours between a panel's least and its greatest value. By hand.
const CONTOURS: f32 = 14.0;

/// Draws rows of panels as a PNG.
pub(super) fn picture(
    [title, subtitle]: [&str; 2],
    rows: &[Vec<Panel>],
    theme: Theme,
) -> Result<Vec<u8>, PlotError> {
    let inks = Inks::of(theme);
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0).max(2);
    let width = 2 * SIDE + columns * (PANEL + GAP) - GAP;
    let height = HEADING + rows.len() * (TITLE + PANEL + BELOW);
    let mut raster = Raster::new(width, height, inks.paper);
    raster.write(title, Face::bold(20.0), inks.ink, (SIDE, 38), width - 2 * SIDE);
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
    raster.write(&panel.title[1], small, inks.faint, (left, top + 33), PANEL);
    let corner = (left, top + TITLE);
    let ends = |(name, ends): &(String, [f32; 2])| {
        format!("{name} {}…{}", end_text(ends[0]), end_text(ends[1]))
    };
    let below = top + TITLE + PANEL;
    match &panel.content {
        Content::Heat { across, up, values, contours } => {
            heat(raster, corner, [*across, *up], values, *contours);
            let text = format!("→ {}  ↑ {}", ends(&panel.axes[0]), ends(&panel.axes[1]));
            raster.write(&text, small, inks.faint, (left, below + 16), PANEL + GAP - 4);
            bar(raster, (left, below + 24), range(values), inks);
        }
        Content::Curve(points) => {
            curve(raster, corner, points, inks);
            raster.write(
                &format!("→ {}", ends(&panel.axes[0])),
                small,
                inks.faint,
                (left, below + 16),
                PANEL,
            );
            raster.write(
                &format!("↑ {}", ends(&panel.axes[1])),
                small,
                inks.faint,
                (left, below + 32),
                PANEL,
            );
        }
    }
    if let Some([x, y]) = panel.mark {
        cross(raster, corner, [x, y]);
    }
}

/// Returns the range of the values that are finite.
fn range(values: &[f32]) -> [f32; 2] {
    let finite = values.iter().copied().filter(|value| value.is_finite());
    let [low, high] = finite.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    if low <= high { [low, high] } else { [0.0, 0.0] }
}

fn heat(
    raster: &mut Raster,
    (left, top): (usize, usize),
    [across, up]: [usize; 2],
    values: &[f32],
    contours: bool,
) {
    let [low, high] = range(values);
    let span = (high - low).max(f32::MIN_POSITIVE);
    let value = |x: usize, y: usize| {
        let cell = (PANEL - 1 - y) * up / PANEL * across + x * across / PANEL;
        (values[cell] - low) / span
    };
    let level = |x: usize, y: usize| {
        between(values, [across, up], x, y).map(|value| (CONTOURS * (value - low) / span).floor())
    };
    for y in 0..PANEL {
        for x in 0..PANEL {
            raster.blend(left + x, top + y, viridis(value(x, y)), 1.0);
            let here = level(x, y);
            let is_edge = contours
                && x + 1 < PANEL
                && y + 1 < PANEL
                && here.is_some()
                && (level(x + 1, y) != here || level(x, y + 1) != here);
            if is_edge {
                raster.blend(left + x, top + y, WHITE, 0.6);
            }
        }
    }
}

const WHITE: Colour = [255; 3];
const RED: Colour = [213, 40, 40];

/// Interpolates values bilinearly at a pixel; none where one of them is not finite.
fn between(values: &[f32], [across, up]: [usize; 2], x: usize, y: usize) -> Option<f32> {
    let along = |pixel: usize, points: usize| {
        let at = ((pixel as f32 + 0.5) / PANEL as f32 * points as f32 - 0.5)
            .clamp(0.0, (points - 1) as f32);
        let low = at as usize;
        (low, (low + 1).min(points - 1), at.fract())
    };
    let (x0, x1, u) = along(x, across);
    let (y0, y1, v) = along(PANEL - 1 - y, up);
    let at = |x: usize, y: usize| values[y * across + x];
    let below = at(x0, y0) + u * (at(x1, y0) - at(x0, y0));
    let above = at(x0, y1) + u * (at(x1, y1) - at(x0, y1));
    Some(below + v * (above - below)).filter(|value| value.is_finite())
}

fn curve(raster: &mut Raster, (left, top): (usize, usize), points: &[[f32; 2]], inks: &Inks) {
    for edge in 0..PANEL {
        for (x, y) in [(edge, 0), (edge, PANEL - 1), (0, edge), (PANEL - 1, edge)] {
            raster.blend(left + x, top + y, inks.faint, 0.35);
        }
    }
    let last = (PANEL - 1) as f32;
    let pixel = |[x, y]: [f32; 2]| [x.clamp(0.0, 1.0) * last, (1.0 - y.clamp(0.0, 1.0)) * last];
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

fn cross(raster: &mut Raster, (left, top): (usize, usize), [x, y]: [f32; 2]) {
    let last = (PANEL - 1) as f32;
    let [x, y] = [x.clamp(0.0, 1.0) * last, (1.0 - y.clamp(0.0, 1.0)) * last];
    let (x, y) = (left as i32 + x as i32, top as i32 + y as i32);
    for away in -5..=5i32 {
        for (dx, dy) in [(away, 0), (away, 1), (0, away), (1, away)] {
            let inside = x + dx >= left as i32 && y + dy >= top as i32;
            if inside {
                raster.blend((x + dx) as usize, (y + dy) as usize, RED, 1.0);
            }
        }
    }
}
