//! Other people's files made datasets.
//!
//! [`table`] reads tables of numbers as repositories, instruments and spreadsheets write them.

mod error;
mod source;
mod split;
pub mod table;

pub use error::Error;
pub use source::{STANDARD_INPUT, read_source};
pub(crate) use split::split_rows;

use std::path::Path;

/// Extensions of files whose rows do not hold their inputs: lookup tables, pictures, source code.
const ARRAYS: [&str; 17] = [
    "3dl", "bin", "c", "cube", "dds", "exr", "h", "hdr", "hpp", "inc", "inl", "npy", "npz", "png",
    "spi1d", "spi3d", "tif",
];

/// Returns true for a file that is an array of values by its extension, and no table: read as one,
/// a row of a lookup table would count as inputs and outputs.
pub fn is_array(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str());
    extension.is_some_and(|extension| ARRAYS.contains(&&*extension.to_ascii_lowercase()))
}
