//! DirectDraw surfaces (DDS) with uncompressed texels.

use super::bytes::Bytes;
use super::texels::{Texels, compressed, not_read, several};
use super::{Array, Fault, Request, Scalar};

const TOOL: &str = "texconv -f R32G32B32A32_FLOAT";

/// Bits of the pixel format's flags.
const ALPHA_ONLY: u32 = 0x2;
const FOUR_CC: u32 = 0x4;
const RGB: u32 = 0x40;
const LUMINANCE: u32 = 0x2_0000;

/// Bits of the second word of capabilities.
const CUBE_MAP: u32 = 0x200;
const VOLUME: u32 = 0x20_0000;

/// The channels' order, the kind of number, and whether it is called sRGB.
type TexelFormat = (&'static str, Scalar, bool);

pub(super) fn read(content: &[u8], _: &Request) -> Result<Array, Fault> {
    let mut bytes = Bytes::new(content);
    bytes.take(4)?;
    let [header_size, _flags, height, width, _pitch, depth, levels] = bytes.u32s()?;
    if header_size != 124 {
        return Err(Fault::new(
            "damaged: its header has another length than 124",
            "write it again",
        ));
    }
    bytes.take(44)?;
    let [_size, flags, four_cc, bits, red, green, blue, alpha] = bytes.u32s()?;
    let [_caps, caps2, _, _, _] = bytes.u32s()?;
    if caps2 & CUBE_MAP != 0 {
        return Err(several("faces of a cube map", 6));
    }
    let is_volume = caps2 & VOLUME != 0;
    let (order, scalar, is_srgb) = match &four_cc.to_le_bytes() {
        _ if flags & FOUR_CC == 0 => of_masks(flags, bits, [red, green, blue, alpha])?,
        b"DX10" => {
            let [format, _dimension, misc, layers, _] = bytes.u32s()?;
            if misc & 0x4 != 0 {
                return Err(several("faces of a cube map", 6));
            }
            if layers > 1 {
                return Err(several("layers", layers));
            }
            of_dxgi(format)?
        }
        name => of_four_cc(four_cc, name)?,
    };
    let depth = if is_volume { depth as usize } else { 1 };
    let texels =
        Texels { kind: "DDS", size: [width as usize, height as usize, depth], order, scalar };
    let pixels = bytes.take(texels.bytes()?)?;
    let mut array = texels.array(pixels, false)?;
    if levels > 1 {
        array.notes.push(format!("the first of {levels} levels"));
    }
    if is_srgb {
        array.notes.push("the format is sRGB, which a sampler decodes: --srgb does".to_owned());
    }
    Ok(array)
}

/// Formats of DXGI.
fn of_dxgi(format: u32) -> Result<TexelFormat, Fault> {
    use Scalar::{F16, F32, Unorm};
    Ok(match format {
        2 => ("rgba", F32, false),
        6 => ("rgb", F32, false),
        10 => ("rgba", F16, false),
        11 => ("rgba", Unorm(2), false),
        16 => ("rg", F32, false),
        28 => ("rgba", Unorm(1), false),
        29 => ("rgba", Unorm(1), true),
        34 => ("rg", F16, false),
        35 => ("rg", Unorm(2), false),
        41 => ("r", F32, false),
        49 => ("rg", Unorm(1), false),
        54 => ("r", F16, false),
        56 => ("r", Unorm(2), false),
        61 => ("r", Unorm(1), false),
        65 => ("a", Unorm(1), false),
        87 => ("bgra", Unorm(1), false),
        88 => ("bgrx", Unorm(1), false),
        91 => ("bgra", Unorm(1), true),
        93 => ("bgrx", Unorm(1), true),
        70..=84 | 94..=99 => return Err(compressed(&format!("BC, DXGI format {format}"), TOOL)),
        _ => return Err(not_read(&format!("{format} of DXGI"))),
    })
}

/// Formats of Direct3D 9 that are given by a number or four letters.
fn of_four_cc(number: u32, letters: &[u8; 4]) -> Result<TexelFormat, Fault> {
    use Scalar::{F16, F32, Unorm};
    Ok(match number {
        36 => ("rgba", Unorm(2), false),
        111 => ("r", F16, false),
        112 => ("rg", F16, false),
        113 => ("rgba", F16, false),
        114 => ("r", F32, false),
        115 => ("rg", F32, false),
        116 => ("rgba", F32, false),
        _ => {
            let name = String::from_utf8_lossy(letters).into_owned();
            let name = crate::printable::printable(&name).into_owned();
            return Err(match letters {
                [b'D', b'X', b'T', _] | [b'A' | b'B', ..] => compressed(&name, TOOL),
                _ => not_read(&format!("`{name}`, {number}")),
            });
        }
    })
}

/// Formats that are given by masks of bits.
fn of_masks(flags: u32, bits: u32, masks: [u32; 4]) -> Result<TexelFormat, Fault> {
    const LOW: [u32; 4] = [0xff, 0xff00, 0xff_0000, 0xff00_0000];
    let [low, second, third, high] = LOW;
    let [red, green, blue, alpha] = masks;
    let byte = Scalar::Unorm(1);
    let found = match (bits, [red, green, blue]) {
        (8, _) if flags & ALPHA_ONLY != 0 => Some(("a", byte)),
        (8, [0xff | 0, ..]) if flags & LUMINANCE != 0 => Some(("r", byte)),
        (16, [0xffff, ..]) if flags & LUMINANCE != 0 => Some(("r", Scalar::Unorm(2))),
        (16, [0xff, ..]) if flags & LUMINANCE != 0 && alpha == second => Some(("ra", byte)),
        _ if flags & RGB == 0 => None,
        (8, [0xff, 0, 0]) => Some(("r", byte)),
        (16, [r, g, 0]) if [r, g] == [low, second] => Some(("rg", byte)),
        (24, [r, g, b]) if [r, g, b] == [low, second, third] => Some(("rgb", byte)),
        (24, [r, g, b]) if [r, g, b] == [third, second, low] => Some(("bgr", byte)),
        (32, [0xffff, 0xffff_0000, 0]) => Some(("rg", Scalar::Unorm(2))),
        (32, [r, g, b]) if [r, g, b] == [low, second, third] => {
            Some((if alpha == high { "rgba" } else { "rgbx" }, byte))
        }
        (32, [r, g, b]) if [r, g, b] == [third, second, low] => {
            Some((if alpha == high { "bgra" } else { "bgrx" }, byte))
        }
        _ => None,
    };
    let found = found.map(|(order, scalar)| (order, scalar, false));
    found.ok_or_else(|| {
        let masks = masks.map(|mask| format!("{mask:x}")).join(", ");
        not_read(&format!("of {bits} bits with the masks {masks}"))
    })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A header of Direct3D 10 or later.
    pub(in super::super) fn dx10(format: u32, [width, height]: [u32; 2]) -> Vec<u8> {
        let mut words = vec![124, 0x1007, height, width, 0, 1, 1];
        words.extend([0; 11]);
        words.extend([32, FOUR_CC, u32::from_le_bytes(*b"DX10"), 0, 0, 0, 0, 0]);
        words.extend([0x1000, 0, 0, 0, 0, format, 3, 0, 1, 0]);
        [b"DDS ".to_vec(), words.into_iter().flat_map(u32::to_le_bytes).collect()].concat()
    }

    fn parsed(header: Vec<u8>, data: &[u8]) -> Result<Array, Fault> {
        read(&[header, data.to_vec()].concat(), &Request::default())
    }

    #[test]
    fn floats_halves_and_bytes_are_read() {
        let floats = [0.25f32, -2.0, 1e-20, 3e30].map(f32::to_le_bytes).concat();
        let read = parsed(dx10(16, [2, 1]), &floats).unwrap();
        assert_eq!((read.size, read.channels), (vec![2], vec!["r".to_owned(), "g".to_owned()]));
        assert_eq!(read.values, [0.25, -2.0, 1e-20, 3e30]);
        let halves = [0x3800u16, 0x3c00].map(u16::to_le_bytes).concat();
        assert_eq!(parsed(dx10(54, [1, 2]), &halves).unwrap().values, [0.5, 1.0]);
        let blue_first = parsed(dx10(87, [1, 1]), &[51, 102, 255, 0]).unwrap();
        assert_eq!(blue_first.values, [1.0, 0.4, 0.2, 0.0]);
        assert_eq!(blue_first.channels.concat(), "rgba");
    }

    #[test]
    fn compressed_unknown_and_truncated_ones_are_refused() {
        let refused = |header: Vec<u8>, data: &[u8]| parsed(header, data).unwrap_err().to_string();
        assert!(refused(dx10(98, [4, 4]), &[0; 16]).contains("texconv"));
        assert!(refused(dx10(71, [4, 4]), &[0; 8]).contains("BC"));
        assert!(refused(dx10(26, [4, 4]), &[0; 64]).contains("26 of DXGI"));
        assert!(refused(dx10(2, [4, 4]), &[0; 255]).contains("403 bytes of 404"));
        assert!(refused(dx10(2, [16384, 16384]), &[]).contains("16384 × 16384"));
        assert!(refused(dx10(2, [0, 4]), &[]).contains("no texels"));
        let mut dxt = dx10(0, [4, 4]);
        dxt[84..88].copy_from_slice(b"DXT5");
        assert!(refused(dxt, &[0; 16]).contains("compressed (DXT5)"));
    }
}
