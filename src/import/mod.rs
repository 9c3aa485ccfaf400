//! Other people's files made datasets.
//!
//! [`table`] reads tables of numbers as repositories, instruments and spreadsheets write them,
//! `array` textures, lookup tables and arrays.

#[cfg(feature = "arrays")]
pub mod array;
mod error;
mod source;
mod split;
pub mod table;

pub use error::Error;
pub use source::{STANDARD_INPUT, read_source};
pub(crate) use split::split_rows;
