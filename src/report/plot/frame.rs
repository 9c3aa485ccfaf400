//! The frame of every plot: paper, heading, axes.

use super::axis::{Errors, Tick};
use super::canvas::{Anchor, Canvas, HEIGHT, Surface, WIDTH};
use super::labels::Area;
use super::text::Face;
use super::{PlotError, Theme};
use plotters::style::RGBColor;

pub(super) const MARGIN: f64 = 24.0;
const TITLE: Face = Face::bold(18.0);
pub(super) const SUBTITLE: Face = Face::regular(12.5);
pub(super) const TICK: Face = Face::regular(11.5);

/// The lower edge of the axes.
pub(super) const FLOOR: f64 = HEIGHT - 56.0;
/// The least distance between ticks of errors.
const TICKS_APART: f64 = 20.0;

pub(super) struct Palette {
    pub paper: RGBColor,
    pub ink: RGBColor,
    pub faint: RGBColor,
    pub grid: RGBColor,
    /// Incumbents that the front dominates.
    pub dominated: RGBColor,
    pub front: RGBColor,
    pub incumbent: RGBColor,
    /// Lines of one plot, told apart.
    pub lines: [RGBColor; 7],
}

/// Data has the colours of Okabe and Ito's palette, yellow darkened on white.
const LIGHT: Palette = Palette {
    paper: RGBColor(255, 255, 255),
    ink: RGBColor(31, 35, 40),
    faint: RGBColor(89, 99, 110),
    grid: RGBColor(226, 230, 235),
    dominated: RGBColor(243, 248, 252),
    front: RGBColor(0, 114, 178),
    incumbent: RGBColor(213, 94, 0),
    lines: [
        RGBColor(0, 0, 0),
        RGBColor(230, 159, 0),
        RGBColor(86, 180, 233),
        RGBColor(0, 158, 115),
        RGBColor(0, 114, 178),
        RGBColor(213, 94, 0),
        RGBColor(204, 121, 167),
    ],
};

const DARK: Palette = Palette {
    paper: RGBColor(13, 17, 23),
    ink: RGBColor(230, 237, 243),
    faint: RGBColor(145, 152, 161),
    grid: RGBColor(38, 44, 53),
    dominated: RGBColor(17, 25, 35),
    front: RGBColor(86, 180, 233),
    incumbent: RGBColor(230, 159, 0),
    lines: [
        RGBColor(230, 237, 243),
        RGBColor(230, 159, 0),
        RGBColor(86, 180, 233),
        RGBColor(0, 158, 115),
        RGBColor(240, 228, 66),
        RGBColor(213, 94, 0),
        RGBColor(204, 121, 167),
    ],
};

impl Palette {
    pub(super) fn of(theme: Theme) -> &'static Palette {
        match theme {
            Theme::Light => &LIGHT,
            Theme::Dark => &DARK,
        }
    }
}

pub(super) struct Frame<'a> {
    pub title: &'a str,
    pub subtitle: &'a str,
    pub x_label: &'a str,
    pub y_label: &'a str,
    pub palette: &'static Palette,
    pub axes: Area,
}

impl Frame<'_> {
    /// Returns the area of the axes: as wide as the ticks of errors and the text to the right
    /// permit, as high as the heading does.
    pub(super) fn axes(subtitle: &str, errors: &Errors, beside: f64) -> Area {
        let top = if subtitle.is_empty() { 82.0 } else { 104.0 };
        let ticks = errors.ticks(TICKS_APART / (FLOOR - top));
        let widest = ticks.iter().map(|tick| TICK.width(&tick.text)).fold(0.0, f64::max);
        let right = WIDTH - MARGIN - 4.0 - beside;
        Area { left: (MARGIN + widest + 8.0).round(), top, right, bottom: FLOOR }
    }

    pub(super) fn x(&self, place: f64) -> f64 {
        self.axes.left + place * (self.axes.right - self.axes.left)
    }

    pub(super) fn y(&self, place: f64) -> f64 {
        self.axes.bottom - place * (self.axes.bottom - self.axes.top)
    }

    pub(super) fn paper<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        canvas.rectangle((0.0, 0.0), (WIDTH, HEIGHT), self.palette.paper)
    }

    pub(super) fn grid<S: Surface>(
        &self,
        canvas: &mut Canvas<S>,
        abscissae: &[Tick],
        errors: &Errors,
    ) -> Result<(), PlotError> {
        let Palette { grid, faint, .. } = *self.palette;
        let Area { left, top, right, bottom } = self.axes;
        for tick in abscissae {
            let x = self.x(tick.place);
            canvas.rectangle((x - 0.5, top), (x + 0.5, bottom), grid)?;
            canvas.write(&tick.text, TICK, faint, Anchor::Middle, (x, bottom + 18.0))?;
        }
        for tick in errors.ticks(TICKS_APART / (bottom - top)) {
            let y = self.y(tick.place);
            canvas.rectangle((left, y - 0.5), (right, y + 0.5), grid)?;
            canvas.write(&tick.text, TICK, faint, Anchor::Right, (left - 8.0, y + 4.0))?;
        }
        canvas.rectangle((left, bottom - 0.5), (right, bottom + 0.5), faint)
    }

    pub(super) fn heading<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        let Palette { ink, faint, .. } = *self.palette;
        let width = WIDTH - 2.0 * MARGIN;
        let mut left = |text: &str, face: Face, colour, y| {
            canvas.write(&face.fitted(text, width), face, colour, Anchor::Left, (MARGIN, y))
        };
        left(self.title, TITLE, ink, 38.0)?;
        left(self.subtitle, SUBTITLE, faint, 59.0)?;
        left(&TICK.fitted(self.y_label, width / 2.0), TICK, faint, self.axes.top - 14.0)?;
        let x_label = TICK.fitted(self.x_label, width / 2.0);
        let below = (self.axes.right, FLOOR + 39.0);
        canvas.write(&x_label, TICK, faint, Anchor::Right, below)
    }
}
