//! Bounds on the error as in JSON.

use super::ErrorBound;
use crate::program::Names;
use crate::stability::Value;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The largest error of one output against the truth, in the interpreter's arithmetic and on GPUs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TruthRecord {
    /// The output's name.
    pub output: String,
    /// The error in the interpreter's arithmetic.
    #[serde(flatten)]
    pub exact: ErrorRecord,
    /// The error on GPUs; none if it was not asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gpu: Option<ErrorRecord>,
}

/// An [`ErrorBound`] with its inputs by name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorRecord {
    /// `proved`: no error is above `most`. `refuted`: the formula has no value where the truth has
    /// one. `open`: neither. `sampled`: nobody tried a proof.
    pub status: String,
    /// The bound that is proved, in the output's unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub most: Option<f64>,
    /// The largest error that was seen; none if none is a number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seen: Option<f64>,
    /// The input where it was seen, or where the formula has no value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub input: Option<BTreeMap<String, f32>>,
    /// The formula's value there: a number, or the text `NaN`, `inf` or `-inf`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
    /// The share of the domain where it is not bounded, if it is open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub volume: Option<f64>,
    /// An input for which nothing is said, since the truth may have no value there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap: Option<BTreeMap<String, f32>>,
    /// The number of such inputs, if there is one.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub gaps: usize,
}

fn is_zero(number: &usize) -> bool {
    *number == 0
}

fn named(names: &Names, input: &[f32]) -> BTreeMap<String, f32> {
    names.inputs.iter().cloned().zip(input.iter().copied()).collect()
}

impl ErrorRecord {
    /// Makes the record of a bound.
    pub fn new(bound: &ErrorBound, names: &Names) -> ErrorRecord {
        let tried = !bound.at.is_empty();
        let status = if bound.seen == f64::INFINITY {
            "refuted"
        } else if bound.proved.is_finite() {
            "proved"
        } else {
            "open"
        };
        ErrorRecord {
            status: status.to_owned(),
            most: Some(bound.proved).filter(|most| most.is_finite()),
            seen: Some(bound.seen).filter(|seen| tried && seen.is_finite()),
            input: tried.then(|| named(names, &bound.at)),
            value: tried.then(|| bound.value.into()),
            volume: (status == "open").then_some(bound.volume),
            gap: bound.gap.as_ref().map(|gap| named(names, gap)),
            gaps: bound.gaps,
        }
    }

    /// Makes the record of the largest error among samples, at an input.
    pub fn sampled(seen: f64, input: &[f32], value: f32, names: &Names) -> ErrorRecord {
        ErrorRecord {
            status: "sampled".to_owned(),
            most: None,
            seen: Some(seen).filter(|seen| seen.is_finite()),
            input: Some(named(names, input)),
            value: Some(value.into()),
            volume: None,
            gap: None,
            gaps: 0,
        }
    }
}
