//! Fronts, verdicts and examinations in words.

pub mod examination;
mod table;
mod truth;
mod verdict;

pub use table::{axis_title, cut, cycles_text, error_text, front_table, title};
pub use truth::{rounded_down, rounded_up, truth_sentence};
pub use verdict::{claim_text, number_text, verdict_lines};
