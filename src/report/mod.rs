//! What a person looks at: tables and pictures of a front.

pub mod plot;
pub mod table;
