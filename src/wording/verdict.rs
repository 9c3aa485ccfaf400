//! Verdicts in words.

use super::truth::truth_sentence;
use crate::stability::{ClaimRecord, StatusRecord, Value, VerdictRecord};
use std::collections::BTreeMap;

/// Returns a line for each topic, as in a snippet's header.
pub fn verdict_lines(verdict: &VerdictRecord) -> Vec<String> {
    if !verdict.is_judged() {
        return vec!["finite on every sample of both splits".to_owned()];
    }
    let topics = verdict.topics().into_iter();
    let claims = topics.map(|(topic, claim)| format!("{topic}: {}", claim_text(claim)));
    claims.chain(verdict.truth.iter().map(truth_sentence)).collect()
}

/// Describes a claim's status in the interpreter's arithmetic, and on GPUs where that differs.
pub fn claim_text(claim: &ClaimRecord) -> String {
    let exact = match &claim.claim {
        Some(text) => format!("{text} {}", status_text(&claim.exact)),
        None => status_text(&claim.exact),
    };
    match &claim.gpu {
        Some(gpu) if gpu.status != claim.exact.status => {
            format!("{exact}; on GPUs {}", status_text(gpu))
        }
        _ => exact,
    }
}

/// Describes a status: where, and how far.
pub(crate) fn status_text(status: &StatusRecord) -> String {
    match (&status.input, &status.value, status.volume) {
        (Some(input), Some(value), _) => {
            format!("{}: {} at {}", status.status, value_text(value), input_text(input))
        }
        (_, _, Some(volume)) => {
            format!("{} in {} of the domain", status.status, share_text(volume))
        }
        _ => status.status.clone(),
    }
}

/// Formats a share as a percentage.
pub(crate) fn share_text(share: f64) -> String {
    let percent = share * 100.0;
    if percent >= 0.01 { format!("{percent:.2} %") } else { format!("{percent:.0e} %") }
}

/// Formats a number as [`number_text`] does; other values are text already.
pub(crate) fn value_text(value: &Value) -> String {
    match value {
        Value::Number(number) => number_text((*number).into()),
        Value::Text(text) => text.clone(),
    }
}

/// Formats a number with five significant digits.
pub fn number_text(number: f64) -> String {
    match number.abs() {
        0.0 => "0".to_owned(),
        size if !(1e-4..1e6).contains(&size) => format!("{number:.3e}"),
        size => {
            let decimals = (4 - size.log10().floor() as i32).clamp(0, 7) as usize;
            let text = format!("{number:.decimals$}");
            match text.contains('.') {
                true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
                false => text,
            }
        }
    }
}

/// Formats inputs with all their digits, so that they can be tried.
pub(crate) fn input_text(input: &BTreeMap<String, f32>) -> String {
    let one = |(name, value): (&String, &f32)| format!("{name} = {value:?}");
    input.iter().map(one).collect::<Vec<_>>().join(", ")
}
