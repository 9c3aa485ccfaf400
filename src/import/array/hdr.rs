//! Radiance HDR (RGBE).

use super::bytes::Bytes;
use super::shape::Shape;
use super::{Array, Fault, Request};

const WRITE_AGAIN: &str = "write it again, or save it as EXR";

/// Widths of scan lines that may be run-length encoded by channel.
const ENCODED_WIDTHS: std::ops::RangeInclusive<usize> = 8..=0x7fff;

pub(super) fn read(content: &[u8], _: &Request) -> Result<Array, Fault> {
    let mut bytes = Bytes::new(content);
    let mut notes = Vec::new();
    loop {
        let line = bytes.line()?;
        if line.is_empty() {
            break;
        }
        if line.starts_with(b"FORMAT=") && line != b"FORMAT=32-bit_rle_rgbe" {
            let format = String::from_utf8_lossy(line).into_owned();
            return Err(Fault::new(
                format!("{format} is not read"),
                "save it in RGB (RGBE) or as EXR",
            ));
        }
        if line.starts_with(b"EXPOSURE=") {
            notes.push("EXPOSURE is not applied".to_owned());
        }
    }
    let (width, height, upwards) = resolution(bytes.line()?)?;
    let shape = Shape::new(vec![width, height], 3)?;
    // A scan line takes four bytes at least, and a byte stands for at most 127 numbers.
    let least = (height * 4).max(shape.values() / 127);
    if content.len() < least {
        return Err(Fault::Truncated { expected: least as u64, found: content.len() as u64 });
    }
    let mut rows = Vec::with_capacity(height);
    for _ in 0..height {
        rows.push(scan_line(&mut bytes, width)?);
    }
    if upwards {
        rows.reverse();
    }
    Ok(Array {
        kind: "Radiance HDR".to_owned(),
        size: shape.size.into_iter().filter(|&along| along != 1).collect(),
        channels: Array::unnamed_channels(3),
        values: rows.iter().flatten().copied().flat_map(colour).collect(),
        is_picture: true,
        notes,
        ..Array::default()
    })
}

/// Returns width, height, and whether the first row is the lowest.
fn resolution(line: &[u8]) -> Result<(usize, usize, bool), Fault> {
    let text = String::from_utf8_lossy(line);
    let words: Vec<&str> = text.split_whitespace().collect();
    let sizes = |height: &str, width: &str| Some((width.parse().ok()?, height.parse().ok()?));
    let found = match words[..] {
        ["-Y", height, "+X", width] => sizes(height, width).map(|(w, h)| (w, h, false)),
        ["+Y", height, "+X", width] => sizes(height, width).map(|(w, h)| (w, h, true)),
        _ => None,
    };
    found.ok_or_else(|| {
        let line = crate::printable::printable(&text).into_owned();
        Fault::new(format!("its size and orientation `{line}` are not read"), WRITE_AGAIN)
    })
}

/// Decodes a pixel; the exponent is that of all three mantissas.
fn colour([r, g, b, exponent]: [u8; 4]) -> [f32; 3] {
    let scale = match exponent {
        0 => 0.0,
        exponent => f64::from(i32::from(exponent) - 136).exp2(),
    };
    [r, g, b].map(|mantissa| (f64::from(mantissa) * scale) as f32)
}

fn scan_line(bytes: &mut Bytes, width: usize) -> Result<Vec<[u8; 4]>, Fault> {
    let first = pixel(bytes)?;
    let encoded = [2, 2, (width >> 8) as u8, width as u8];
    if ENCODED_WIDTHS.contains(&width) && first == encoded {
        return by_channel(bytes, width);
    }
    plain(bytes, width, first)
}

fn pixel(bytes: &mut Bytes) -> Result<[u8; 4], Fault> {
    let four = bytes.take(4)?;
    Ok([four[0], four[1], four[2], four[3]])
}

/// Each channel's bytes in runs of up to 127 equal ones and of up to 128 others.
fn by_channel(bytes: &mut Bytes, width: usize) -> Result<Vec<[u8; 4]>, Fault> {
    let mut row = vec![[0; 4]; width];
    for channel in 0..4 {
        let mut at = 0;
        while at < width {
            let count = usize::from(bytes.take(1)?[0]);
            let (count, repeated) = if count > 128 { (count - 128, true) } else { (count, false) };
            if count == 0 || at + count > width {
                return Err(Fault::new(
                    "damaged: a run of pixels is longer than its row",
                    WRITE_AGAIN,
                ));
            }
            let values = bytes.take(if repeated { 1 } else { count })?;
            for (index, pixel) in row[at..at + count].iter_mut().enumerate() {
                pixel[channel] = values[if repeated { 0 } else { index }];
            }
            at += count;
        }
    }
    Ok(row)
}

/// Pixels one after the other; (1, 1, 1, n) repeats the last one n times, and n more significant
/// digits of the number follow.
fn plain(bytes: &mut Bytes, width: usize, first: [u8; 4]) -> Result<Vec<[u8; 4]>, Fault> {
    let mut row = Vec::with_capacity(width);
    let (mut next, mut shift) = (first, 0);
    loop {
        match (next, row.last().copied()) {
            ([1, 1, 1, count], Some(last)) => {
                let count = usize::from(count).checked_shl(shift).unwrap_or(usize::MAX);
                if count > width - row.len() {
                    return Err(Fault::new(
                        "damaged: a run of pixels is longer than its row",
                        WRITE_AGAIN,
                    ));
                }
                row.resize(row.len() + count, last);
                shift += 8;
            }
            _ => {
                row.push(next);
                shift = 0;
            }
        }
        if row.len() == width {
            return Ok(row);
        }
        next = pixel(bytes)?;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(size: &str, data: &[u8]) -> Result<Array, Fault> {
        let header = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n");
        read(&[header.as_bytes(), data].concat(), &Request::default())
    }

    #[test]
    fn plain_and_both_encoded_rows_are_read() {
        let plain = values("-Y 1 +X 2", &[128, 64, 0, 129, 255, 0, 0, 120]).unwrap();
        assert_eq!(plain.size, [2]);
        let small = 255.0 / 65536.0;
        assert_eq!(plain.values, [1.0, 0.5, 0.0, small, 0.0, 0.0]);
        let repeated = values("-Y 1 +X 3", &[128, 64, 0, 129, 1, 1, 1, 2]).unwrap();
        assert_eq!(repeated.values, [1.0, 0.5, 0.0].repeat(3));
        let mut data = vec![2, 2, 0, 8];
        // Red 0, 16, 32, … of its own, the others of a run each.
        data.push(8);
        data.extend((0..8).map(|i| i * 16));
        data.extend([136, 128, 136, 0, 136, 129]);
        let encoded = values("-Y 1 +X 8", &data).unwrap();
        let expected: Vec<f32> = (0..8).flat_map(|i| [i as f32 / 8.0, 1.0, 0.0]).collect();
        assert_eq!(encoded.values, expected);
    }

    #[test]
    fn rows_from_the_bottom_are_turned_round() {
        let data = [128, 0, 0, 129, 0, 0, 0, 0];
        assert_eq!(values("+Y 2 +X 1", &data).unwrap().values[..3], [0.0; 3]);
        assert_eq!(values("-Y 2 +X 1", &data).unwrap().values[..3], [1.0, 0.0, 0.0]);
    }

    #[test]
    fn what_is_damaged_is_refused() {
        for (size, data) in [
            ("-Y 1 +X 8", &[2u8, 2, 0, 8, 200, 1][..]),
            ("-Y 1 +X 8", &[2, 2, 0, 8, 0, 0]),
            ("-Y 1 +X 2", &[5, 5, 5, 128, 1, 1, 1, 2]),
            ("-Y 4 +X 2", &[1, 2, 3, 4]),
            ("-Y 0 +X 2", &[]),
            ("-Y 1000000 +X 1000000", &[]),
            ("+X 2 +Y 2", &[0; 16]),
        ] {
            assert!(values(size, data).is_err(), "{size} {data:?}");
        }
    }
}
