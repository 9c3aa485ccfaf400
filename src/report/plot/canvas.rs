//! Shapes and text on an SVG document or on a bitmap, in units of a plot 800 wide.

use super::PlotError;
use super::text::{FAMILY, Face, Weight};
use plotters::backend::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontDesc, FontFamily, FontStyle, RGBColor, ShapeStyle, TextStyle};
use std::fmt::Display;

pub(super) const WIDTH: f64 = 800.0;
pub(super) const HEIGHT: f64 = 480.0;

pub(super) type Vector<'a> = SVGBackend<'a>;
pub(super) type Bitmap<'a> = BitMapBackend<'a>;
pub(super) type Point = (f64, f64);

/// The side of a text that a position refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Left,
    Middle,
    Right,
}

/// A backend that can write text: plotters places it differently on each.
pub(super) trait Surface: DrawingBackend {
    /// Writes text on the baseline at a position.
    fn write(
        &mut self,
        text: &str,
        face: Face,
        colour: RGBColor,
        anchor: Anchor,
        at: (i32, i32),
    ) -> Result<(), PlotError>;
}

impl Surface for Vector<'_> {
    fn write(
        &mut self,
        text: &str,
        face: Face,
        colour: RGBColor,
        anchor: Anchor,
        (x, y): (i32, i32),
    ) -> Result<(), PlotError> {
        let weight = match face.weight {
            Weight::Regular => FontStyle::Normal,
            Weight::Bold => FontStyle::Bold,
        };
        let side = match anchor {
            Anchor::Left => HPos::Left,
            Anchor::Middle => HPos::Center,
            Anchor::Right => HPos::Right,
        };
        // plotters writes a size of 1.24 em as 1 em, and the baseline 0.76 em below the top.
        let font = FontDesc::new(FontFamily::Name(FAMILY), face.size * 1.24, weight);
        let style = TextStyle::from(font).color(&colour).pos(Pos::new(side, VPos::Top));
        let top = y - (face.size * 0.76).round() as i32;
        self.draw_text(text, &style, (x, top)).map_err(failed)
    }
}

impl Surface for Bitmap<'_> {
    fn write(
        &mut self,
        text: &str,
        face: Face,
        colour: RGBColor,
        anchor: Anchor,
        (x, y): (i32, i32),
    ) -> Result<(), PlotError> {
        let before = match anchor {
            Anchor::Left => 0.0,
            Anchor::Middle => face.width(text) / 2.0,
            Anchor::Right => face.width(text),
        };
        let left = x - before.round() as i32;
        let mut drawn = Ok(());
        face.rasterise(text, |column, row, coverage| {
            let shade = colour.mix(f64::from(coverage)).to_backend_color();
            if drawn.is_ok() {
                drawn = self.draw_pixel((left + column, y + row), shade);
            }
        });
        drawn.map_err(failed)
    }
}

pub(super) struct Canvas<S> {
    surface: S,
    scale: f64,
}

impl<'a> Canvas<Vector<'a>> {
    pub(super) fn vector(document: &'a mut String, scale: u32) -> Self {
        let size = (WIDTH as u32 * scale, HEIGHT as u32 * scale);
        Canvas { surface: SVGBackend::with_string(document, size), scale: f64::from(scale) }
    }
}

impl<'a> Canvas<Bitmap<'a>> {
    pub(super) fn bitmap(pixels: &'a mut [u8], size: (u32, u32)) -> Self {
        let surface = BitMapBackend::with_buffer(pixels, size);
        Canvas { surface, scale: f64::from(size.0) / WIDTH }
    }
}

impl<S: Surface> Canvas<S> {
    pub(super) fn finish(mut self) -> Result<(), PlotError> {
        self.surface.present().map_err(failed)
    }

    pub(super) fn rectangle(
        &mut self,
        from: Point,
        to: Point,
        colour: RGBColor,
    ) -> Result<(), PlotError> {
        let (from, to) = (self.at(from), self.at(to));
        self.surface.draw_rect(from, to, &colour, true).map_err(failed)
    }

    pub(super) fn polygon(&mut self, corners: &[Point], colour: RGBColor) -> Result<(), PlotError> {
        let corners: Vec<_> = corners.iter().map(|corner| self.at(*corner)).collect();
        self.surface.fill_polygon(corners, &colour).map_err(failed)
    }

    pub(super) fn line(
        &mut self,
        points: &[Point],
        width: f64,
        colour: RGBColor,
    ) -> Result<(), PlotError> {
        let stroke_width = (width * self.scale).round().max(1.0) as u32;
        let style = ShapeStyle { color: colour.to_rgba(), filled: false, stroke_width };
        let points: Vec<_> = points.iter().map(|point| self.at(*point)).collect();
        self.surface.draw_path(points, &style).map_err(failed)
    }

    pub(super) fn disc(
        &mut self,
        centre: Point,
        radius: f64,
        colour: RGBColor,
    ) -> Result<(), PlotError> {
        let radius = (radius * self.scale).round() as u32;
        self.surface.draw_circle(self.at(centre), radius, &colour, true).map_err(failed)
    }

    pub(super) fn diamond(
        &mut self,
        (x, y): Point,
        radius: f64,
        colour: RGBColor,
    ) -> Result<(), PlotError> {
        let corners = [(x, y - radius), (x + radius, y), (x, y + radius), (x - radius, y)];
        self.polygon(&corners, colour)
    }

    pub(super) fn write(
        &mut self,
        text: &str,
        face: Face,
        colour: RGBColor,
        anchor: Anchor,
        baseline: Point,
    ) -> Result<(), PlotError> {
        let at = self.at(baseline);
        self.surface.write(text, face.scaled(self.scale), colour, anchor, at)
    }

    fn at(&self, (x, y): Point) -> (i32, i32) {
        ((x * self.scale).round() as i32, (y * self.scale).round() as i32)
    }
}

fn failed(problem: impl Display) -> PlotError {
    PlotError::Draw { problem: problem.to_string() }
}
