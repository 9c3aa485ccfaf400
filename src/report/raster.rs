//! Pixels of pictures that are not made of lines.

use super::plot::text::Face;
use super::plot::{PlotError, Theme, encode};

pub(super) type Colour = [u8; 3];

pub(super) struct Raster {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
}

/// The colours of a theme's text.
pub(super) struct Inks {
    pub paper: Colour,
    pub ink: Colour,
    pub faint: Colour,
}

impl Inks {
    pub(super) fn of(theme: Theme) -> Inks {
        let [paper, ink, faint] = match theme {
            Theme::Light => [[255; 3], [31, 35, 40], [89, 99, 110]],
            Theme::Dark => [[13, 17, 23], [230, 237, 243], [145, 152, 161]],
        };
        Inks { paper, ink, faint }
    }
}

impl Raster {
    pub(super) fn new(width: usize, height: usize, paper: Colour) -> Raster {
        Raster { width, height, pixels: paper.repeat(width * height) }
    }

    /// Mixes a colour in; does nothing beyond the edges.
    pub(super) fn blend(&mut self, x: usize, y: usize, colour: Colour, coverage: f32) {
        if x >= self.width || y >= self.height {
            return;
        }
        let at = 3 * (y * self.width + x);
        for (to, colour) in self.pixels[at..at + 3].iter_mut().zip(colour) {
            let from = f32::from(*to);
            *to = (from + coverage.clamp(0.0, 1.0) * (f32::from(colour) - from) + 0.5) as u8;
        }
    }

    /// Writes text, as much as fits into the given width and the raster.
    pub(super) fn write(
        &mut self,
        text: &str,
        face: Face,
        colour: Colour,
        (left, baseline): (usize, usize),
        width: usize,
    ) {
        let text = face.fitted(text, width.min(self.width.saturating_sub(left)) as f64);
        face.rasterise(&text, |x, y, coverage| {
            let (x, y) = (left as i32 + x, baseline as i32 + y);
            if x >= 0 && y >= 0 {
                self.blend(x as usize, y as usize, colour, coverage);
            }
        });
    }

    /// Returns the bytes of a PNG file.
    pub(super) fn png(&self) -> Result<Vec<u8>, PlotError> {
        encode(&self.pixels, self.width as u32, self.height as u32)
    }
}
