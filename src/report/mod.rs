//! What a person looks at: tables and pictures of a front, verdicts in words, the page of a run, maps,
//! spheres.

pub mod examination;
pub mod maps;
pub mod page;
pub mod plot;
mod raster;
pub mod spheres;
pub mod table;
pub mod verdict;
