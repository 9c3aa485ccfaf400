//! Reads files up to a limit.

use std::fs::{File, FileType};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// The most bytes of a file of settings, recipes or formulas. Chosen by hand.
pub const LARGEST_TEXT: u64 = 1 << 24;

/// Checks that a file may be put at `path`: there is nothing, a file, or a link.
///
/// # Errors
/// A folder (or a link to one), a device, a pipe or a socket.
pub fn check_replaceable(path: &Path) -> io::Result<()> {
    if path.is_dir() {
        return Err(io::Error::other("it is a folder"));
    }
    match path.symlink_metadata() {
        Ok(there) if !there.is_file() && !there.is_symlink() => {
            let kind = kind(there.file_type());
            Err(io::Error::other(format!("it is {kind}, which no file may replace")))
        }
        _ => Ok(()),
    }
}

/// Reads a file of at most `most` bytes.
///
/// # Errors
/// A folder, a device, a pipe or a socket, none of which is opened; a longer file; errors of
/// opening and reading.
pub fn read_file(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let there = path.metadata()?;
    if !there.is_file() {
        let kind = kind(there.file_type());
        return Err(io::Error::new(ErrorKind::InvalidInput, format!("it is {kind}, not a file")));
    }
    if there.len() > most {
        return Err(too_long(most));
    }
    let mut bytes = Vec::new();
    // It may grow while it is read.
    File::open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_long(most)) } else { Ok(bytes) }
}

/// Reads a text in UTF-8 of at most [`LARGEST_TEXT`] bytes.
///
/// # Errors
/// As [`read_file`]; bytes that are not UTF-8.
pub fn read_text(path: &Path) -> io::Result<String> {
    String::from_utf8(read_file(path, LARGEST_TEXT)?).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        let reason = format!("it is not text in UTF-8 (line {line})");
        io::Error::new(ErrorKind::InvalidData, reason)
    })
}

fn too_long(most: u64) -> io::Error {
    let reason = match most {
        1_048_576.. => format!("it is longer than {} MiB", most >> 20),
        _ => format!("it is longer than {most} bytes"),
    };
    io::Error::new(ErrorKind::FileTooLarge, reason)
}

fn kind(file: FileType) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if file.is_fifo() {
            return "a pipe";
        }
        if file.is_socket() {
            return "a socket";
        }
    }
    if file.is_dir() { "a folder" } else { "a device" }
}
