//! NPY, the arrays of numpy.

use super::error::times;
use super::shape::Shape;
use super::{Array, Fault, Request, Scalar};

/// The most bytes of a header. By hand: those of numbers take a hundred.
const LONGEST_HEADER: usize = 1 << 16;

/// The most dimensions of numpy.
const MOST_DIMENSIONS: usize = 64;

const SAVE_AGAIN: &str = "save it again with numpy.save";

pub(super) fn read(content: &[u8], request: &Request) -> Result<Array, Fault> {
    let header = Header::of(content)?;
    let shape = header.shape(request)?;
    let data = &content[header.length..];
    let expected = header.values() * header.scalar.bytes();
    if data.len() < expected {
        let [expected, found] = [header.length + expected, content.len()].map(|bytes| bytes as u64);
        return Err(Fault::Truncated { expected, found });
    }
    header.array(shape, &data[..expected])
}

/// What an array's data are.
#[derive(Debug)]
pub(super) struct Header {
    pub scalar: Scalar,
    pub big_endian: bool,
    /// Whether the first dimension varies fastest in the file.
    pub fortran: bool,
    pub dimensions: Vec<usize>,
    /// The bytes before the data.
    pub length: usize,
}

impl Header {
    /// Returns the bytes before the data, as far as the first twelve tell.
    pub(super) fn length_of(start: &[u8]) -> Result<usize, Fault> {
        let truncated = Fault::Truncated { expected: 12, found: start.len() as u64 };
        let Some(&[b'\x93', b'N', b'U', b'M', b'P', b'Y', version, _, a, b, c, d]) =
            start.get(..12)
        else {
            let is_npy = start.starts_with(b"\x93NUMPY");
            return Err(if is_npy { truncated } else { Fault::Magic { format: "NPY" } });
        };
        let length = match version {
            1 => 10 + usize::from(u16::from_le_bytes([a, b])),
            2 | 3 => (u32::from_le_bytes([a, b, c, d]) as usize).saturating_add(12),
            _ => {
                return Err(Fault::new(
                    format!("version {version} of NPY is not read"),
                    SAVE_AGAIN,
                ));
            }
        };
        if length > LONGEST_HEADER {
            return Err(Fault::new(format!("damaged: a header of {length} bytes"), SAVE_AGAIN));
        }
        Ok(length)
    }

    pub(super) fn of(content: &[u8]) -> Result<Header, Fault> {
        let length = Header::length_of(content)?;
        let start = if content[6] == 1 { 10 } else { 12 };
        let Some(text) = content.get(start..length) else {
            let (expected, found) = (length as u64, content.len() as u64);
            return Err(Fault::Truncated { expected, found });
        };
        let text = String::from_utf8_lossy(text);
        let field = |name: &str| -> Option<&str> {
            let (_, rest) = text.split_once(&format!("'{name}'"))?;
            Some(rest.trim_start().strip_prefix(':')?.trim_start())
        };
        let (Some(kind), Some(order), Some(shape)) =
            (field("descr"), field("fortran_order"), field("shape"))
        else {
            return Err(Fault::new(
                "damaged: its header names no descr, fortran_order or shape",
                SAVE_AGAIN,
            ));
        };
        let (scalar, big_endian) = number(kind)?;
        let dimensions = dimensions(shape)
            .ok_or_else(|| Fault::new("damaged: its header's shape is none", SAVE_AGAIN))?;
        Ok(Header { scalar, big_endian, fortran: order.starts_with("True"), dimensions, length })
    }

    /// Returns the shape, checked before data are read.
    pub(super) fn shape(&self, request: &Request) -> Result<Shape, Fault> {
        let product = self.dimensions.iter().try_fold(1usize, |product, &n| product.checked_mul(n));
        let size = self.dimensions.clone();
        match product {
            None => return Err(Fault::TooLarge { size, channels: 1 }),
            Some(0) => return Err(Fault::NoTexels { size }),
            Some(_) => {}
        }
        let Some(size) = &request.size else {
            return Shape::of_dimensions(&self.dimensions, request.axes);
        };
        let shape = Shape::of_size(size, request.axes)?;
        match product == Some(shape.values()) {
            true => Ok(shape),
            false => {
                let problem = format!(
                    "it has {} values, and --size {}",
                    times(&self.dimensions),
                    times(size)
                );
                Err(Fault::new(problem, "give a size of as many, or leave it out"))
            }
        }
    }

    /// Returns the number of values; [`Header::shape`] has checked it.
    pub(super) fn values(&self) -> usize {
        self.dimensions.iter().product()
    }

    /// Makes an array of the data.
    pub(super) fn array(&self, shape: Shape, data: &[u8]) -> Result<Array, Fault> {
        let mut values = self.scalar.values(data, self.big_endian)?;
        if self.fortran {
            values = last_fastest(&values, &self.dimensions);
        }
        let is_perhaps_table = shape.size.len() == 1 && shape.channels > 1;
        let note = "if it is a table, a row a sample: --inputs 2 makes the first 2 columns inputs";
        Ok(Array {
            notes: is_perhaps_table.then(|| note.to_owned()).into_iter().collect(),
            kind: format!("NPY, {}, shape ({})", self.scalar.name(), listed(&self.dimensions)),
            channels: Array::unnamed_channels(shape.channels),
            size: shape.size,
            values,
            ..Array::default()
        })
    }
}

/// Returns a shape as Python writes it.
fn listed(dimensions: &[usize]) -> String {
    match dimensions {
        [one] => format!("{one},"),
        more => more.iter().map(usize::to_string).collect::<Vec<_>>().join(", "),
    }
}

/// Parses what `descr` says: `'<f4'`.
fn number(text: &str) -> Result<(Scalar, bool), Fault> {
    let quoted = text.strip_prefix('\'').and_then(|text| text.split_once('\''));
    let Some((kind, _)) = quoted else {
        let problem = "its elements are records";
        return Err(Fault::new(
            problem,
            "save one plain array of numbers, or several with numpy.savez",
        ));
    };
    let order = kind.chars().next().unwrap_or(' ');
    let kind_alone = kind.trim_start_matches(['<', '>', '|', '=']);
    let scalar = match kind_alone {
        "f2" => Scalar::F16,
        "f4" => Scalar::F32,
        "f8" => Scalar::F64,
        "b1" => Scalar::Bool,
        "i1" => Scalar::Signed(1),
        "i2" => Scalar::Signed(2),
        "i4" => Scalar::Signed(4),
        "i8" => Scalar::Signed(8),
        "u1" => Scalar::Unsigned(1),
        "u2" => Scalar::Unsigned(2),
        "u4" => Scalar::Unsigned(4),
        "u8" => Scalar::Unsigned(8),
        _ => {
            let kind = crate::printable::printable(kind).into_owned();
            let problem = format!("its elements are of the type `{kind}`, which is not read");
            return Err(Fault::new(
                problem,
                "save real numbers, as in array.astype(numpy.float32)",
            ));
        }
    };
    Ok((scalar, order == '>'))
}

/// Parses what `shape` says: `(64, 64, 2)`.
fn dimensions(text: &str) -> Option<Vec<usize>> {
    let (inside, _) = text.strip_prefix('(')?.split_once(')')?;
    let numbers = inside.split(',').map(str::trim).filter(|number| !number.is_empty());
    // Python 2 wrote long integers with a letter.
    let parsed = numbers.map(|number| number.trim_end_matches('L').parse().ok());
    let parsed: Vec<usize> = parsed.collect::<Option<_>>()?;
    (parsed.len() <= MOST_DIMENSIONS).then_some(parsed)
}

/// Reorders values of which the first dimension varies fastest.
fn last_fastest(values: &[f32], dimensions: &[usize]) -> Vec<f32> {
    let mut sorted = Vec::with_capacity(values.len());
    let mut index = vec![0; dimensions.len()];
    let mut strides = vec![1; dimensions.len()];
    for dimension in 1..dimensions.len() {
        strides[dimension] = strides[dimension - 1] * dimensions[dimension - 1];
    }
    for _ in 0..values.len() {
        sorted
            .push(values[index.iter().zip(&strides).map(|(i, stride)| i * stride).sum::<usize>()]);
        for dimension in (0..dimensions.len()).rev() {
            index[dimension] += 1;
            if index[dimension] < dimensions[dimension] {
                break;
            }
            index[dimension] = 0;
        }
    }
    sorted
}

/// Writes an array as NPY in 32-bit floats. Its shape is that of the axes, the last axis first, then
/// the channels.
pub fn to_npy(array: &Array) -> Vec<u8> {
    let mut dimensions: Vec<usize> = array.size.iter().rev().copied().collect();
    dimensions.push(array.channels.len());
    let shape = listed(&dimensions);
    let mut header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({shape}), }}");
    // The data begin at a multiple of 64 bytes.
    let unpadded = 10 + header.len() + 1;
    header.extend(std::iter::repeat_n(' ', unpadded.next_multiple_of(64) - unpadded));
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(array.values.iter().flat_map(|value| value.to_le_bytes()));
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(header: &str, data: &[u8]) -> Vec<u8> {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        [bytes, header.as_bytes().to_vec(), data.to_vec()].concat()
    }

    fn parsed(header: &str, data: &[u8]) -> Result<Array, Fault> {
        read(&file(header, data), &Request::default())
    }

    #[test]
    fn shapes_orders_and_types_are_read() {
        let bytes: Vec<u8> = (0..6).collect();
        let c = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3), }";
        let read = parsed(c, &bytes).unwrap();
        assert_eq!((read.size, read.channels.len()), (vec![2], 3));
        assert_eq!(read.values, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
        let fortran = c.replace("False", "True");
        assert_eq!(parsed(&fortran, &bytes).unwrap().values, [0.0, 2.0, 4.0, 1.0, 3.0, 5.0]);
        let halves = "{'descr': '>f2', 'fortran_order': False, 'shape': (1,), }";
        assert_eq!(parsed(halves, &[0x38, 0]).unwrap().values, [0.5]);
    }

    #[test]
    fn what_was_written_is_read() {
        let array = Array {
            size: vec![5, 7],
            channels: Array::unnamed_channels(2),
            values: (0..70).map(|i| (i as f32).sin()).collect(),
            ..Array::default()
        };
        let bytes = to_npy(&array);
        assert_eq!((bytes.len() - 70 * 4) % 64, 0);
        let again = read(&bytes, &Request::default()).unwrap();
        assert_eq!((again.size, again.values), (array.size, array.values));
    }

    #[test]
    fn damaged_and_unusable_ones_are_refused() {
        let refused = |header: &str, data: &[u8]| parsed(header, data).unwrap_err().to_string();
        let of = |kind: &str, shape: &str| {
            format!("{{'descr': {kind}, 'fortran_order': False, 'shape': {shape}, }}")
        };
        assert!(refused(&of("'|O'", "(2,)"), &[]).contains("astype"));
        assert!(refused(&of("'<c8'", "(2,)"), &[]).contains("astype"));
        assert!(refused(&of("[('x', '<f4')]", "(2,)"), &[]).contains("records"));
        assert!(refused(&of("'<f4'", "(2, 3)"), &[0; 23]).contains("truncated"));
        assert!(refused(&of("'<f4'", "(0, 3)"), &[]).contains("no texels"));
        assert!(refused(&of("'<f4'", "(16384, 16384)"), &[]).contains("16384 × 16384"));
        assert!(refused(&of("'<f4'", "(99999999999, 99999999999)"), &[]).contains("at most"));
        assert!(refused(&of("'<f4'", "(-1, 3)"), &[]).contains("damaged"));
        assert!(refused("{}", &[]).contains("damaged"));
        let whole = file(&of("'<f4'", "(2,)"), &[0; 8]);
        for length in 0..whole.len() {
            assert!(read(&whole[..length], &Request::default()).is_err(), "{length}");
        }
    }
}
