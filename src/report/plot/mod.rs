//! A Pareto front, error against GPU cycles, with published formulas on the same axes; and lines,
//! error against time.

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

/// SVG coordinates of plotters are whole numbers: this many to a pixel.
const SVG_SCALE: u32 = 4;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    #[default]
    Light,
    Dark,
}

/// A front as it is drawn. Points that are not finite are not drawn; incumbents among them are
/// named below the plot. Errors of zero are drawn on the axis of cycles.
#[derive(Clone, Copy, Debug)]
pub struct FrontPlot<'a> {
    pub title: &'a str,
    pub subtitle: &'a str,
    pub x_label: &'a str,
    pub y_label: &'a str,
    /// Cycles and error of each formula, cost rising, error falling.
    pub front: &'a [(f64, f64)],
    /// Name, cycles and error of each published formula.
    pub incumbents: &'a [(String, f64, f64)],
    pub theme: Theme,
}

/// Lines on two logarithmic axes. Points that are not finite, or whose abscissa is not positive,
/// are not drawn.
#[derive(Clone, Copy, Debug)]
pub struct LinePlot<'a> {
    pub title: &'a str,
    pub subtitle: &'a str,
    pub x_label: &'a str,
    pub y_label: &'a str,
    pub lines: &'a [Line],
    pub theme: Theme,
}

/// A line, points by rising abscissa, and thin ones of the same colour, such as the best and the
/// worst of what it is the median of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    pub name: String,
    pub points: Vec<(f64, f64)>,
    pub bounds: Vec<Vec<(f64, f64)>>,
}

/// What can be drawn on every surface.
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

/// Why a plot cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    #[error("a plot {width} pixels wide cannot be drawn; ask for {least} to {most}")]
    Width { width: u32, least: u32, most: u32 },
    #[error("the plot could not be drawn: {problem}")]
    Draw { problem: String },
    #[error("the plot could not be written as PNG: {0}")]
    Encode(#[from] png::EncodingError),
}

/// The plot as an SVG document, 800 by 480 pixels where it is not scaled.
pub fn svg(plot: &FrontPlot) -> Result<String, PlotError> {
    document(plot)
}

/// The plot as the bytes of a PNG file, `width` pixels wide and 0.6 times as high.
pub fn png(plot: &FrontPlot, width: u32) -> Result<Vec<u8>, PlotError> {
    bitmap(plot, width)
}

/// [`svg`] of lines.
pub fn lines_svg(plot: &LinePlot) -> Result<String, PlotError> {
    document(plot)
}

/// [`png`](fn@png) of lines.
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

/// Drawn this much larger and averaged, because plotters does not smooth the edges of shapes.
fn oversampling(width: u32) -> u32 {
    if width <= 2000 { 4 } else { 2 }
}

/// The mean of each square of `finer` by `finer` pixels.
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
