//! Bytes of headers, taken one field after the other.

use super::Fault;

/// A file's bytes from a position on. Numbers are little-endian.
pub(super) struct Bytes<'a> {
    all: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    pub(super) fn new(all: &'a [u8]) -> Bytes<'a> {
        Bytes { all, at: 0 }
    }

    /// Takes the next bytes.
    ///
    /// # Errors
    /// Fewer are left.
    pub(super) fn take(&mut self, count: usize) -> Result<&'a [u8], Fault> {
        let end = self.at.checked_add(count);
        let taken = end.and_then(|end| self.all.get(self.at..end));
        let (expected, found) = (self.at.saturating_add(count) as u64, self.all.len() as u64);
        let taken = taken.ok_or(Fault::Truncated { expected, found })?;
        self.at += count;
        Ok(taken)
    }

    pub(super) fn u32(&mut self) -> Result<u32, Fault> {
        let bytes = self.take(4)?;
        Ok(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
    }

    pub(super) fn u64(&mut self) -> Result<u64, Fault> {
        let (low, high) = (self.u32()?, self.u32()?);
        Ok(u64::from(high) << 32 | u64::from(low))
    }

    /// Takes as many numbers as the array has places.
    pub(super) fn u32s<const N: usize>(&mut self) -> Result<[u32; N], Fault> {
        let mut numbers = [0; N];
        for number in &mut numbers {
            *number = self.u32()?;
        }
        Ok(numbers)
    }

    /// Goes to a position counted from the file's first byte; what is taken there is checked.
    pub(super) fn go_to(&mut self, at: usize) {
        self.at = at;
    }

    /// Takes a line without its end; the rest, if there is no line end.
    pub(super) fn line(&mut self) -> Result<&'a [u8], Fault> {
        let rest = &self.all[self.at.min(self.all.len())..];
        match rest.iter().position(|&byte| byte == b'\n') {
            Some(end) => self.take(end + 1).map(|line| line[..end].trim_ascii_end()),
            None => self.take(rest.len().max(1)).map(<[u8]>::trim_ascii_end),
        }
    }
}
