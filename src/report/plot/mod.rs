//! Plots: a Pareto front, error against GPU cycles, with published formulas on the same axes; and
//! lines, error against time.
//!
//! ```
//! use lgp::report::plot::{FrontPlot, Theme, svg};
//! let plot = FrontPlot {
//!     title: "weight",
//!     subtitle: "two formulas",
//!     x_label: "cycles",
//!     y_label: "RMSE",
//!     front: &[(3.0, 0.1), (8.0, 0.01)],
//!     incumbents: &[],
//!     theme: Theme::Light,
//! };
//! assert!(svg(&plot)?.starts_with("<svg"));
//! # Ok::<(), lgp::report::plot::PlotError>(())
//! ```

mod axis;
mod canvas;
mod draw;
mod frame;
mod labels;
mod lines;
pub(super) mod text;

use canvas::{Bitmap, Canvas, HEIGHT, Surface, Vector, WIDTH};

/// The narrowest and the widest plot, in pixels.
const WIDTHS: (u32, u32) = (320, 4096);

/// Plotters has whole SVG coordinates: this many to a pixel.
const SVG_SCALE: u32 = 4;

/// The colours of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    /// Dark on white.
    #[default]
    Light,
    /// Light on dark.
    Dark,
}

/// A plot of a front. Points that are not finite are not drawn; incumbents among them are named
/// below the plot. Errors of zero are drawn on the axis of cycles.
#[derive(Clone, Copy, Debug)]
pub struct FrontPlot<'a> {
    /// The first line of the heading.
    pub title: &'a str,
    /// The second line of the heading.
    pub subtitle: &'a str,
    /// The title of the axis of cycles.
    pub x_label: &'a str,
    /// The title of the axis of errors.
    pub y_label: &'a str,
    /// Cycles and error of each formula, cost rising, error falling.
    pub front: &'a [(f64, f64)],
    /// Name, cycles and error of each published formula.
    pub incumbents: &'a [(String, f64, f64)],
    /// The colours.
    pub theme: Theme,
}

/// A plot of lines on two logarithmic axes. Points that are not finite, or whose abscissa is not
/// positive, are not drawn.
#[derive(Clone, Copy, Debug)]
pub struct LinePlot<'a> {
    /// The first line of the heading.
    pub title: &'a str,
    /// The second line of the heading.
    pub subtitle: &'a str,
    /// The title of the abscissa.
    pub x_label: &'a str,
    /// The title of the ordinate.
    pub y_label: &'a str,
    /// The lines, each named at its right end.
    pub lines: &'a [Line],
    /// The colours.
    pub theme: Theme,
}

/// A line, and thin ones of the same colour, such as the best and the worst of what it is the
/// median of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// Its name.
    pub name: String,
    /// Its points, by rising abscissa.
    pub points: Vec<(f64, f64)>,
    /// The points of the thin lines.
    pub bounds: Vec<Vec<(f64, f64)>>,
}

/// A picture that can be drawn on every surface.
trait Picture {
    fn draw<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError>;
}

impl Picture for FrontPlot<'_> {
    fn draw<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        draw::front(self, canvas)
    }
}

impl Picture for LinePlot<'_> {
    fn draw<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        lines::lines(self, canvas)
    }
}

/// A plot that cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each message names its fields")]
pub enum PlotError {
    #[error("a plot {width} pixels wide cannot be drawn; ask for {least} to {most}")]
    Width { width: u32, least: u32, most: u32 },
    #[error("the plot could not be drawn: {problem}")]
    Draw { problem: String },
    #[error("the plot could not be written as PNG: {0}")]
    Encode(#[from] png::EncodingError),
}

/// Returns the plot as an SVG document, 800 by 480 pixels if it is not scaled.
///
/// # Errors
/// [`PlotError::Draw`].
pub fn svg(plot: &FrontPlot) -> Result<String, PlotError> {
    document(plot)
}

/// Returns the plot as a PNG file, `width` pixels wide and 0.6 times as high.
///
/// # Errors
/// [`PlotError`].
pub fn png(plot: &FrontPlot, width: u32) -> Result<Vec<u8>, PlotError> {
    bitmap(plot, width)
}

/// Returns lines as [`svg`] returns a front.
///
/// # Errors
/// [`PlotError::Draw`].
pub fn lines_svg(plot: &LinePlot) -> Result<String, PlotError> {
    document(plot)
}

/// Returns lines as [`png`](fn@png) returns a front.
///
/// # Errors
/// [`PlotError`].
pub fn lines_png(plot: &LinePlot, width: u32) -> Result<Vec<u8>, PlotError> {
    bitmap(plot, width)
}

fn document(picture: &impl Picture) -> Result<String, PlotError> {
    let mut document = String::new();
    let mut canvas = Canvas::<Vector>::vector(&mut document, SVG_SCALE);
    picture.draw(&mut canvas)?;
    canvas.finish()?;
    let size = |scale: u32| {
        format!("width=\"{}\" height=\"{}\"", WIDTH as u32 * scale, HEIGHT as u32 * scale)
    };
    Ok(document.replacen(&size(SVG_SCALE), &size(1), 1))
}

fn bitmap(picture: &impl Picture, width: u32) -> Result<Vec<u8>, PlotError> {
    let (least, most) = WIDTHS;
    if !(least..=most).contains(&width) {
        return Err(PlotError::Width { width, least, most });
    }
    let height = (f64::from(width) * HEIGHT / WIDTH).round() as u32;
    let finer = oversampling(width);
    let mut fine = vec![0; (width * finer * height * finer * 3) as usize];
    let mut canvas = Canvas::<Bitmap>::bitmap(&mut fine, (width * finer, height * finer));
    picture.draw(&mut canvas)?;
    canvas.finish()?;
    encode(&averaged(&fine, width, height, finer), width, height)
}

/// Returns how many times larger a bitmap is drawn before it is averaged: plotters does not smooth
/// the edges of shapes.
fn oversampling(width: u32) -> u32 {
    if width <= 2000 { 4 } else { 2 }
}

/// Averages each square of `finer` by `finer` pixels.
fn averaged(fine: &[u8], width: u32, height: u32, finer: u32) -> Vec<u8> {
    let (width, height, finer) = (width as usize, height as usize, finer as usize);
    let samples = (finer * finer) as u32;
    let mean = |x: usize, y: usize, channel: usize| {
        let at = |i: usize| {
            let (column, row) = (x * finer + i % finer, y * finer + i / finer);
            u32::from(fine[(row * width * finer + column) * 3 + channel])
        };
        ((0..finer * finer).map(at).sum::<u32>() + samples / 2) / samples
    };
    let mut pixels = Vec::with_capacity(width * height * 3);
    for y in 0..height {
        for x in 0..width {
            pixels.extend((0..3).map(|channel| mean(x, y, channel) as u8));
        }
    }
    pixels
}

pub(super) fn encode(pixels: &[u8], width: u32, height: u32) -> Result<Vec<u8>, PlotError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}
