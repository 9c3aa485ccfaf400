//! The typeface of plots: widths of text, and its pixels.

use crate::printable::is_hidden;
use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};
use std::sync::LazyLock;

/// The families in SVG, whose reader may not have the first.
pub(in crate::report) const FAMILY: &str = "DejaVu Sans, Verdana, Geneva, sans-serif";

static REGULAR: LazyLock<Option<FontRef>> =
    LazyLock::new(|| FontRef::try_from_slice(include_bytes!("../font/DejaVuSans.ttf")).ok());

static BOLD: LazyLock<Option<FontRef>> =
    LazyLock::new(|| FontRef::try_from_slice(include_bytes!("../font/DejaVuSans-Bold.ttf")).ok());

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::report) enum Weight {
    Regular,
    Bold,
}

/// Size in units of the em square, and weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::report) struct Face {
    pub size: f64,
    pub weight: Weight,
}

impl Face {
    pub(in crate::report) const fn regular(size: f64) -> Face {
        Face { size, weight: Weight::Regular }
    }

    pub(in crate::report) const fn bold(size: f64) -> Face {
        Face { size, weight: Weight::Bold }
    }

    pub(in crate::report) fn scaled(self, scale: f64) -> Face {
        Face { size: self.size * scale, ..self }
    }

    pub(in crate::report) fn width(self, text: &str) -> f64 {
        self.set(text).1
    }

    /// Calls `pixel` with the coverage of each pixel, the text beginning at 0 on the baseline.
    pub(in crate::report) fn rasterise(self, text: &str, mut pixel: impl FnMut(i32, i32, f32)) {
        let Some(font) = self.font() else { return };
        let outlined = |glyph| font.outline_glyph(glyph);
        for glyph in self.set(text).0.into_iter().filter_map(outlined) {
            let (left, top) = (glyph.px_bounds().min.x as i32, glyph.px_bounds().min.y as i32);
            glyph.draw(|x, y, coverage| pixel(left + x as i32, top + y as i32, coverage));
        }
    }

    /// Returns the text, or as much of its beginning as fits, with an ellipsis.
    pub(in crate::report) fn fitted(self, text: &str, width: f64) -> String {
        let mut kept: String = text.chars().map(printable).collect();
        if self.width(&kept) <= width {
            return kept;
        }
        loop {
            let shown = format!("{}…", kept.trim_end());
            if kept.pop().is_none() || self.width(&shown) <= width {
                return shown;
            }
        }
    }

    fn font(self) -> Option<&'static FontRef<'static>> {
        match self.weight {
            Weight::Regular => REGULAR.as_ref(),
            Weight::Bold => BOLD.as_ref(),
        }
    }

    /// Returns glyphs along the baseline, and where the next would begin.
    fn set(self, text: &str) -> (Vec<Glyph>, f64) {
        let Some(font) = self.font() else { return (Vec::new(), 0.0) };
        let units = font.units_per_em().unwrap_or(2048.0);
        // ab_glyph's size is that of a line, not of the em square.
        let scale = PxScale::from(self.size as f32 * font.height_unscaled() / units);
        let font = font.as_scaled(scale);
        let (mut glyphs, mut pen) = (Vec::<Glyph>::new(), 0.0);
        for character in text.chars() {
            let id = font.glyph_id(character);
            pen += glyphs.last().map_or(0.0, |last| font.kern(last.id, id));
            glyphs.push(id.with_scale_and_position(scale, point(pen, 0.0)));
            pen += font.h_advance(id);
        }
        (glyphs, f64::from(pen))
    }
}

/// Replaces control characters, which XML does not know, and others that turn the text around them.
fn printable(character: char) -> char {
    match character {
        hidden if is_hidden(hidden) => ' ',
        other => other,
    }
}
