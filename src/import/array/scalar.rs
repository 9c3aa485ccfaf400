//! Numbers as files hold them.

use super::Fault;
use half::f16;

/// The kind of a number in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// A byte, 0 or 1.
    Bool,
    /// A signed integer of this many bytes: 1, 2, 4 or 8.
    Signed(usize),
    /// An unsigned integer of this many bytes: 1, 2, 4 or 8.
    Unsigned(usize),
    /// An unsigned integer of this many bytes, 1 or 2, that stands for 0 to 1.
    Unorm(usize),
    /// Half precision.
    F16,
    /// Single precision.
    F32,
    /// Double precision.
    F64,
}

impl Scalar {
    /// Returns the bytes of a number.
    pub fn bytes(self) -> usize {
        match self {
            Scalar::Bool => 1,
            Scalar::F16 => 2,
            Scalar::F32 => 4,
            Scalar::F64 => 8,
            Scalar::Signed(bytes) | Scalar::Unsigned(bytes) | Scalar::Unorm(bytes) => bytes,
        }
    }

    /// Returns its name for a person.
    pub fn name(self) -> String {
        match self {
            Scalar::Bool => "bool".into(),
            Scalar::F16 => "16-bit floats".into(),
            Scalar::F32 => "32-bit floats".into(),
            Scalar::F64 => "64-bit floats".into(),
            Scalar::Signed(bytes) => format!("signed {}-bit integers", 8 * bytes),
            Scalar::Unsigned(bytes) => format!("unsigned {}-bit integers", 8 * bytes),
            Scalar::Unorm(bytes) => format!("{} bits", 8 * bytes),
        }
    }

    /// Returns what was done to integers that stand for 0 to 1.
    pub(super) fn note(self) -> Option<String> {
        let Scalar::Unorm(bytes) = self else { return None };
        let most = if bytes == 1 { 255 } else { 65535 };
        Some(format!("values are the file's {}-bit integers divided by {most}", 8 * bytes))
    }

    /// Decodes a number whose bytes begin with the low one.
    fn decode(self, low_first: [u8; 8]) -> f64 {
        let bits = u64::from_le_bytes(low_first);
        match self {
            Scalar::Bool => f64::from(low_first[0] != 0),
            Scalar::F16 => f16::from_bits(bits as u16).to_f64(),
            Scalar::F32 => f64::from(f32::from_bits(bits as u32)),
            Scalar::F64 => f64::from_bits(bits),
            Scalar::Unsigned(_) => bits as f64,
            Scalar::Signed(bytes) => {
                let unused = 64 - 8 * bytes as u32;
                (((bits << unused) as i64) >> unused) as f64
            }
            Scalar::Unorm(1) => bits as f64 / 255.0,
            Scalar::Unorm(_) => bits as f64 / 65535.0,
        }
    }

    /// Decodes all whole numbers of `bytes`.
    ///
    /// # Errors
    /// A finite number beyond f32.
    pub(super) fn values(self, bytes: &[u8], big_endian: bool) -> Result<Vec<f32>, Fault> {
        let one = |(index, bytes): (usize, &[u8])| {
            let mut low_first = [0; 8];
            low_first[..bytes.len()].copy_from_slice(bytes);
            if big_endian {
                low_first[..bytes.len()].reverse();
            }
            narrow(index, self.decode(low_first))
        };
        bytes.chunks_exact(self.bytes()).enumerate().map(one).collect()
    }
}

/// Rounds a number to f32; `index`, from 0, is its place among all.
///
/// # Errors
/// A finite number beyond f32.
pub(super) fn narrow(index: usize, value: f64) -> Result<f32, Fault> {
    let narrow = value as f32;
    match narrow.is_infinite() && value.is_finite() {
        true => Err(Fault::Overflow { number: index + 1, value }),
        false => Ok(narrow),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_each_kind_are_decoded_in_both_orders() {
        let cases: [(Scalar, &[u8], f32); 10] = [
            (Scalar::Bool, &[1], 1.0),
            (Scalar::Signed(1), &[0xff], -1.0),
            (Scalar::Signed(4), &[0xfe, 0xff, 0xff, 0xff], -2.0),
            (Scalar::Signed(8), &(-3i64).to_le_bytes(), -3.0),
            (Scalar::Unsigned(2), &[0x01, 0x02], 513.0),
            (Scalar::Unorm(1), &[51], 0.2),
            (Scalar::Unorm(2), &[0xff, 0xff], 1.0),
            (Scalar::F16, &f16::from_f32(0.375).to_le_bytes(), 0.375),
            (Scalar::F32, &0.1f32.to_le_bytes(), 0.1),
            (Scalar::F64, &0.1f64.to_le_bytes(), 0.1),
        ];
        for (scalar, bytes, value) in cases {
            let reversed: Vec<u8> = bytes.iter().rev().copied().collect();
            assert_eq!(scalar.bytes(), bytes.len());
            assert_eq!(scalar.values(bytes, false).unwrap(), [value], "{scalar:?}");
            assert_eq!(scalar.values(&reversed, true).unwrap(), [value], "{scalar:?}");
        }
    }

    #[test]
    fn a_number_beyond_f32_is_told_from_infinity() {
        let bytes = [0.0, 1e300f64].map(f64::to_le_bytes).concat();
        let refused = Scalar::F64.values(&bytes, false).unwrap_err();
        assert!(matches!(refused, Fault::Overflow { number: 2, .. }), "{refused}");
        let infinite = Scalar::F64.values(&f64::INFINITY.to_le_bytes(), false).unwrap();
        assert_eq!(infinite, [f32::INFINITY]);
    }
}
