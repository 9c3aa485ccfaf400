//! Files as a whole: read up to a limit, written so that a killed process leaves the old content or
//! the new. Folders, devices, pipes and sockets are neither read nor replaced.

mod read;
mod write;

pub use read::{LARGEST_TEXT, check_replaceable, read_file, read_text};
pub use write::{StagedFile, TEMPORARY, remove_file, replace_file, witness_file_operations};
