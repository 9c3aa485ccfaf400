//! Writes files as a whole.

use super::check_replaceable;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use tempfile::TempPath;

/// The prefix of temporaries' names.
pub const TEMPORARY: &str = ".lgp-";

/// Writes a file so that, whenever the process is killed, `path` holds either its old content or
/// all of the new: to a temporary in the same folder, then renamed. A link at `path` is itself
/// replaced; its destination stays.
///
/// # Errors
/// A folder, a device, a pipe or a socket at `path`, which is left alone; errors of creating,
/// writing and renaming the temporary.
pub fn replace_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    StagedFile::new(path, bytes)?.put_in_place()
}

/// A file written whole beside its destination. Dropping it removes it.
#[derive(Debug)]
pub struct StagedFile {
    temporary: TempPath,
    path: PathBuf,
}

impl StagedFile {
    /// Writes the content to a temporary in the folder of `path`.
    ///
    /// # Errors
    /// As [`check_replaceable`]; errors of creating and writing the temporary.
    pub fn new(path: &Path, bytes: &[u8]) -> io::Result<StagedFile> {
        check_replaceable(path)?;
        let folder = match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(TEMPORARY);
        // Temporaries are private by default; what they become should not be.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        announce("create", path);
        let mut file = builder.tempfile_in(folder).map_err(plain)?;
        announce("write", path);
        file.write_all(bytes).map_err(plain)?;
        file.as_file().sync_all()?;
        Ok(StagedFile { temporary: file.into_temp_path(), path: path.to_owned() })
    }

    /// Returns its destination.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Renames it to its destination, replacing what is there.
    ///
    /// # Errors
    /// Errors of renaming.
    pub fn put_in_place(self) -> io::Result<()> {
        announce("rename", &self.path);
        Ok(self.temporary.persist(&self.path)?)
    }
}

/// Returns the error without the temporary's name, which would tell nobody anything.
fn plain(error: io::Error) -> io::Error {
    let inner = error.get_ref().and_then(|error| error.source());
    let inner = inner.and_then(|error| error.downcast_ref::<io::Error>());
    let code = inner.and_then(io::Error::raw_os_error);
    code.map_or(error, io::Error::from_raw_os_error)
}

/// Removes a file, if it exists.
///
/// # Errors
/// Errors of removing a file that exists.
pub fn remove_file(path: &Path) -> io::Result<()> {
    announce("remove", path);
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// A function of an operation and the file that it is about to change.
type Witness = fn(&'static str, &Path);

static WITNESS: OnceLock<Witness> = OnceLock::new();

/// Sets a function to be called before each creation, writing, renaming and removal of a file:
/// tests end the process there, to see what is left. Only the first call counts.
#[doc(hidden)]
pub fn witness_file_operations(witness: Witness) {
    let _ = WITNESS.set(witness);
}

fn announce(operation: &'static str, path: &Path) {
    if let Some(witness) = WITNESS.get() {
        witness(operation, path);
    }
}
