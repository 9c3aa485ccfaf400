//! The bytes of a file or of standard input.

use super::Error;
use crate::dataset::{self, LARGEST_FILE};
use crate::file::read_file;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// What standard input is called in messages and as the source of a dataset.
pub const STANDARD_INPUT: &str = "standard input";

/// Reads a file, or standard input where `path` is `-`.
///
/// # Errors
/// A file that does not exist or cannot be read; more than [`LARGEST_FILE`] bytes.
pub fn read_source(path: &Path) -> Result<Vec<u8>, Error> {
    if path.as_os_str() != "-" {
        let read = read_file(path, LARGEST_FILE);
        return Ok(read.map_err(|source| dataset::Error::unread(path, source))?);
    }
    let mut bytes = Vec::new();
    let read = io::stdin().lock().take(LARGEST_FILE + 1).read_to_end(&mut bytes).and_then(|_| {
        let too_long = || format!("it is longer than {} MiB", LARGEST_FILE >> 20);
        match bytes.len() as u64 > LARGEST_FILE {
            true => Err(io::Error::new(ErrorKind::FileTooLarge, too_long())),
            false => Ok(()),
        }
    });
    read.map_err(|source| dataset::Error::unread(Path::new(STANDARD_INPUT), source))?;
    Ok(bytes)
}
