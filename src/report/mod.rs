//! What a person looks at: pictures of a front, the page of a run, maps, spheres.

pub mod maps;
pub mod page;
pub mod plot;
mod raster;
pub mod spheres;
