//! KTX2 with uncompressed texels.

use super::bytes::Bytes;
use super::texels::{Texels, compressed, not_read, several};
use super::{Array, Fault, Request, Scalar};

const TOOL: &str = "`ktx extract`, or a plain format of `ktx create`";

/// The most levels of a texture whose sides are below 2³².
const MOST_LEVELS: u32 = 32;

pub(super) fn read(content: &[u8], _: &Request) -> Result<Array, Fault> {
    let mut bytes = Bytes::new(content);
    bytes.take(12)?;
    let [format, _type_size, width, height, depth] = bytes.u32s()?;
    let [layers, faces, levels, supercompression] = bytes.u32s()?;
    bytes.take(32)?;
    if supercompression != 0 {
        let name = ["BasisLZ", "Zstandard", "zlib"].get(supercompression as usize - 1);
        return Err(compressed(
            name.unwrap_or(&"an unknown scheme"),
            "`ktx extract`, or write it without supercompression",
        ));
    }
    if faces > 1 {
        return Err(several("faces of a cube map", faces));
    }
    if layers > 1 {
        return Err(several("layers", layers));
    }
    if levels > MOST_LEVELS {
        return Err(Fault::new(format!("damaged: {levels} levels"), "write it again"));
    }
    let (order, scalar, is_srgb) = texel_format(format)?;
    // A height or a depth of 0 is that of a texture without this axis.
    let size = [width as usize, height.max(1) as usize, depth.max(1) as usize];
    let texels = Texels { kind: "KTX2", size, order, scalar };
    let expected = texels.bytes()?;
    let (offset, length) = (bytes.u64()?, bytes.u64()?);
    if length < expected as u64 {
        return Err(Fault::Truncated { expected: expected as u64, found: length });
    }
    bytes.go_to(usize::try_from(offset).unwrap_or(usize::MAX));
    let mut array = texels.array(bytes.take(expected)?, false)?;
    if levels > 1 {
        array.notes.push(format!("the first of {levels} levels"));
    }
    if is_srgb {
        array.notes.push("the format is sRGB, which a sampler decodes: --srgb does".to_owned());
    }
    Ok(array)
}

/// Formats of Vulkan: the channels' order, the kind of number, whether it is called sRGB.
fn texel_format(format: u32) -> Result<(&'static str, Scalar, bool), Fault> {
    use Scalar::{F16, F32, Unorm};
    Ok(match format {
        9 => ("r", Unorm(1), false),
        15 => ("r", Unorm(1), true),
        16 => ("rg", Unorm(1), false),
        22 => ("rg", Unorm(1), true),
        23 => ("rgb", Unorm(1), false),
        29 => ("rgb", Unorm(1), true),
        30 => ("bgr", Unorm(1), false),
        36 => ("bgr", Unorm(1), true),
        37 => ("rgba", Unorm(1), false),
        43 => ("rgba", Unorm(1), true),
        44 => ("bgra", Unorm(1), false),
        50 => ("bgra", Unorm(1), true),
        70 => ("r", Unorm(2), false),
        76 => ("r", F16, false),
        77 => ("rg", Unorm(2), false),
        83 => ("rg", F16, false),
        84 => ("rgb", Unorm(2), false),
        90 => ("rgb", F16, false),
        91 => ("rgba", Unorm(2), false),
        97 => ("rgba", F16, false),
        100 => ("r", F32, false),
        103 => ("rg", F32, false),
        106 => ("rgb", F32, false),
        109 => ("rgba", F32, false),
        0 => return Err(compressed("Basis Universal, or no format of Vulkan", TOOL)),
        131..=184 => {
            return Err(compressed(
                &format!("BC, ETC2, EAC or ASTC, Vulkan format {format}"),
                TOOL,
            ));
        }
        _ => return Err(not_read(&format!("{format} of Vulkan"))),
    })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A file of one level.
    pub(in super::super) fn file(format: u32, [width, height]: [u32; 2], data: &[u8]) -> Vec<u8> {
        let words = [format, 1, width, height, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        let offsets = [104, data.len() as u64, data.len() as u64];
        let mut bytes = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
        bytes.extend(words.into_iter().flat_map(u32::to_le_bytes));
        bytes.extend(offsets.into_iter().flat_map(u64::to_le_bytes));
        bytes.extend(data);
        bytes
    }

    #[test]
    fn floats_halves_and_bytes_are_read() {
        let parsed = |file: Vec<u8>| read(&file, &Request::default()).unwrap();
        let floats = [0.25f32, -2.0].map(f32::to_le_bytes).concat();
        assert_eq!(parsed(file(103, [1, 1], &floats)).values, [0.25, -2.0]);
        let halves = [0x3800u16, 0x3c00].map(u16::to_le_bytes).concat();
        let read = parsed(file(76, [2, 0], &halves));
        assert_eq!((read.size, read.values), (vec![2], vec![0.5, 1.0]));
        assert_eq!(parsed(file(30, [1, 1], &[0, 51, 255])).values, [1.0, 0.2, 0.0]);
    }

    #[test]
    fn compressed_and_truncated_ones_are_refused() {
        let refused = |file: &[u8]| read(file, &Request::default()).unwrap_err().to_string();
        assert!(refused(&file(145, [4, 4], &[0; 16])).contains("compressed"));
        assert!(refused(&file(103, [4, 4], &[0; 16])).contains("truncated"));
        assert!(refused(&file(103, [1 << 16, 1 << 16], &[])).contains("65536 × 65536"));
        let mut zipped = file(103, [1, 1], &[0; 8]);
        zipped[44] = 2;
        assert!(refused(&zipped).contains("Zstandard"));
        let whole = file(103, [1, 1], &[0; 8]);
        let mut elsewhere = whole.clone();
        elsewhere[80..88].fill(0xff);
        assert!(refused(&elsewhere).contains("truncated"));
        for length in 12..whole.len() {
            assert!(refused(&whole[..length]).contains("truncated"), "{length}");
        }
    }
}
