//! Texels of uncompressed textures, one after the other.

use super::error::times;
use super::shape::Shape;
use super::{Array, Fault, Scalar};

/// How a texture's bytes are to be read.
pub(super) struct Texels<'a> {
    /// The kind of file.
    pub kind: &'static str,
    /// Width, height, depth.
    pub size: [usize; 3],
    /// The channels in the file's order, each a letter; `x` is none.
    pub order: &'a str,
    pub scalar: Scalar,
}

impl Texels<'_> {
    /// Checks the size, so that the file need not be long for a refusal.
    ///
    /// # Errors
    /// As [`Shape::new`].
    pub(super) fn shape(&self) -> Result<Shape, Fault> {
        let used: Vec<usize> = self.size.iter().copied().filter(|&along| along != 1).collect();
        Shape::new(used, self.order.len())
    }

    /// Returns the bytes of all texels.
    ///
    /// # Errors
    /// As [`Texels::shape`].
    pub(super) fn bytes(&self) -> Result<usize, Fault> {
        Ok(self.shape()?.values() * self.scalar.bytes())
    }

    /// Makes an array of the texels' bytes, its channels in the order r, g, b, a.
    ///
    /// # Errors
    /// As [`Texels::shape`]; values beyond f32.
    pub(super) fn array(&self, bytes: &[u8], big_endian: bool) -> Result<Array, Fault> {
        let shape = self.shape()?;
        let values = self.scalar.values(bytes, big_endian)?;
        let (channels, values) = in_order(self.order, values);
        Ok(Array {
            kind: format!("{}, {}", self.kind, self.scalar.name()),
            size: shape.size,
            channels,
            values,
            is_picture: true,
            is_unorm: matches!(self.scalar, Scalar::Unorm(_)),
            notes: self.scalar.note().into_iter().collect(),
            ..Array::default()
        })
    }
}

/// Sorts channels as r, g, b, a and leaves `x` out.
fn in_order(order: &str, values: Vec<f32>) -> (Vec<String>, Vec<f32>) {
    let places: Vec<usize> = "rgba".chars().filter_map(|channel| order.find(channel)).collect();
    let names = "rgba".chars().filter(|&channel| order.contains(channel)).map(String::from);
    if "rgba".starts_with(order) {
        return (names.collect(), values);
    }
    let sorted = values.chunks_exact(order.len());
    let sorted = sorted.flat_map(|texel| places.iter().map(|&place| texel[place]));
    (names.collect(), sorted.collect())
}

/// The fault of a texture of several layers, faces or the like.
pub(super) fn several(what: &str, count: u32) -> Fault {
    let problem = format!("it holds {} {what}", times(&[count as usize]));
    Fault::new(problem, "write one of them to a file of its own")
}

/// The fault of a texture in a format that is not read.
pub(super) fn not_read(format: &str) -> Fault {
    let problem = format!("its texels are in the format {format}, which is not read");
    let advice =
        "convert it to R, RG, RGB or RGBA of 8-bit or 16-bit UNORM, 16-bit or 32-bit floats";
    Fault::new(problem, advice)
}

/// The fault of a texture in a compressed format.
pub(super) fn compressed(format: &str, tool: &str) -> Fault {
    let problem = format!("its texels are compressed ({format})");
    Fault::new(
        problem,
        format!("their values are not exact: export the original, or decompress it ({tool})"),
    )
}
