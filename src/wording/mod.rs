//! Fronts, verdicts and examinations in words.

pub mod examination;
mod table;
mod verdict;

pub use table::{axis_title, cut, cycles_text, dominating, error_text, front_table, title};
pub use verdict::{
    claim_text, input_text, number_text, share_text, status_text, value_text, verdict_lines,
};
