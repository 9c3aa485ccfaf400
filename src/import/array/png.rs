//! PNG.

use super::error::counted;
use super::texels::Texels;
use super::{Array, Fault, Request, Scalar};
use ::png::{BitDepth, ColorType, Decoder, DecodingError, Limits, Transformations};
use std::io::Cursor;

/// The most bytes that the decoder may allocate beside the pixels. By hand: a row of 8192 texels takes
/// a thousandth.
const MOST_MEMORY: usize = 64 << 20;

const WRITE_AGAIN: &str = "write it again";

pub(super) fn read(content: &[u8], _: &Request) -> Result<Array, Fault> {
    let limits = Limits { bytes: MOST_MEMORY };
    let mut decoder = Decoder::new_with_limits(Cursor::new(content), limits);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(damaged)?;
    let info = reader.info();
    let size = [info.width as usize, info.height as usize, 1];
    let (says_srgb, is_palette) = (info.srgb.is_some(), info.color_type == ColorType::Indexed);
    let stored = info.bit_depth;
    let (colour, depth) = reader.output_color_type();
    let scalar = if depth == BitDepth::Sixteen { Scalar::Unorm(2) } else { Scalar::Unorm(1) };
    let order = match colour {
        ColorType::Grayscale => "r",
        ColorType::GrayscaleAlpha => "ra",
        ColorType::Rgba => "rgba",
        ColorType::Rgb | ColorType::Indexed => "rgb",
    };
    let texels = Texels { kind: "PNG", size, order, scalar };
    let bytes = texels.bytes()?;
    if reader.output_buffer_size() != Some(bytes) {
        return Err(Fault::new("damaged: its rows have another length than its size", WRITE_AGAIN));
    }
    let mut pixels = vec![0; bytes];
    reader.next_frame(&mut pixels).map_err(damaged)?;
    let mut array = texels.array(&pixels, true)?;
    if order.starts_with('r') && order.len() < 3 {
        array.channels[0] = "value".to_owned();
    }
    if is_palette {
        array.notes.push("the palette's colours".to_owned());
    } else if (stored as u8) < 8 {
        // They were spread over eight bits.
        let bits = stored as u8;
        let note =
            format!("values are the file's {bits}-bit integers divided by {}", (1 << bits) - 1);
        array.kind = format!("PNG, {}", counted(bits.into(), "bit"));
        array.notes = vec![note];
    }
    if says_srgb {
        array.notes.push("the file calls itself sRGB: --srgb decodes it".to_owned());
    }
    Ok(array)
}

fn damaged(error: DecodingError) -> Fault {
    let problem = match error {
        DecodingError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            "truncated: the PNG ends within its data".to_owned()
        }
        DecodingError::LimitsExceeded => {
            let advice = "scale it down (a search needs thousands of texels, not millions)";
            return Fault::new("its rows need more memory than is allowed", advice);
        }
        error => format!("damaged: {error}"),
    };
    Fault::new(problem, WRITE_AGAIN)
}
