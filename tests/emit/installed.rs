//! What `tests/tools/install` installs, and the scripts beside it.

use crate::tools;
use std::path::{Path, PathBuf};

/// The interpreter for the drivers, with the packages for them.
pub const PYTHON: &str = "python/bin/python";
pub const SLANGC: &str = "python/lib/python3.11/site-packages/slangtorch/bin/slangc";
pub const NVCC: &str = "python/lib/python3.11/site-packages/nvidia/cu13/bin/nvcc";

/// What is installed at the path, or says what was not tested without it.
pub fn installed(path: &str, untested: &str) -> Option<String> {
    let folder = std::env::var_os("LGP_TOOLS").map(PathBuf::from);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = folder.unwrap_or_else(|| root.join("target/tools")).join(path);
    if !path.exists() {
        let path = path.display();
        tools::skipped(&format!("there is no {path} (see tests/tools/install); {untested}"));
        return None;
    }
    Some(path.to_str().expect("a path in UTF-8").to_owned())
}

/// A script of `tests/tools`.
pub fn driver(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/tools").join(name);
    path.to_str().expect("a path in UTF-8").to_owned()
}
