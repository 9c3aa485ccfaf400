//! What a person looks at: tables and pictures of a front, verdicts in words.

pub mod examination;
pub mod plot;
pub mod table;
pub mod verdict;
