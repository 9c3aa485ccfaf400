use std::io::{self, Write};
use std::path::Path;

/// Writes a file so that, whenever the process is killed, `path` holds either
/// its old content or all of the new: to a temporary in the same folder, then
/// renamed.
///
/// # Errors
/// Those of creating, writing and renaming the temporary.
pub fn replace_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".lgp-");
    // Temporaries are private by default; what they become should not be.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path)?;
    Ok(())
}
