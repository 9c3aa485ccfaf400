//! Verdicts as `front.json` and `lgp check --json` have them.

use super::{Finding, Status, Verdict};
use crate::program::{ALWAYS_ASKED, Names};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What is known of a formula's behaviour.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VerdictRecord {
    /// That no output is infinite or NaN.
    pub finite: ClaimRecord,
    /// None where nothing was asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<ClaimRecord>,
    /// By name.
    #[serde(flatten)]
    pub claims: BTreeMap<String, ClaimRecord>,
}

/// What became of a claim in the interpreter's arithmetic, and on GPUs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClaimRecord {
    /// In the interpreter's arithmetic.
    #[serde(flatten)]
    pub exact: StatusRecord,
    /// The claim that failed or is open, as `scale ≥ 0`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub claim: Option<String>,
    /// On GPUs, where that differs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gpu: Option<StatusRecord>,
}

/// A [`Status`], its input by name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StatusRecord {
    /// `proved`, `refuted`, `open`, or `sampled`: it holds on every sample of both splits.
    pub status: String,
    /// Where it fails.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub input: Option<BTreeMap<String, f32>>,
    /// What the formula gives there: a number, or the text `NaN`, `inf` or `-inf`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
    /// The share of the domain where it is open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub volume: Option<f64>,
}

/// A value that JSON may have no number for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// A finite number.
    Number(f32),
    /// An infinity or NaN, by name.
    Text(String),
}

impl From<f32> for Value {
    fn from(value: f32) -> Value {
        if value.is_finite() { Value::Number(value) } else { Value::Text(value.to_string()) }
    }
}

impl Default for VerdictRecord {
    /// What every formula of a front is: finite on every sample.
    fn default() -> VerdictRecord {
        let sampled = StatusRecord::plain("sampled");
        let finite = ClaimRecord { exact: sampled, claim: None, gpu: None };
        VerdictRecord { finite, range: None, claims: BTreeMap::new() }
    }
}

impl VerdictRecord {
    /// # Panics
    /// If the verdict is of no output.
    pub fn new(verdict: &Verdict, names: &Names) -> VerdictRecord {
        let of = |topic: &str| Some(ClaimRecord::new(verdict.worst(topic)?, names));
        let [finite, range] = ALWAYS_ASKED;
        let topics = verdict.topics().into_iter().filter(|topic| !ALWAYS_ASKED.contains(topic));
        VerdictRecord {
            finite: of(finite).expect("every output is asked whether it is finite"),
            range: of(range),
            claims: topics.filter_map(|topic| Some((topic.to_owned(), of(topic)?))).collect(),
        }
    }

    /// What was asked, and what became of it.
    pub fn topics(&self) -> Vec<(&str, &ClaimRecord)> {
        let [finite, range] = ALWAYS_ASKED;
        let claims = self.claims.iter().map(|(name, claim)| (name.as_str(), claim));
        let range = self.range.iter().map(|claim| (range, claim));
        [(finite, &self.finite)].into_iter().chain(range).chain(claims).collect()
    }

    /// Whether anything but samples was looked at.
    pub fn is_judged(&self) -> bool {
        self.finite.exact.status != "sampled"
    }
}

impl ClaimRecord {
    /// Returns the record of a finding.
    pub fn new(finding: &Finding, names: &Names) -> ClaimRecord {
        let status = |status: &Status| StatusRecord::new(status, finding, names);
        let proved = (&finding.exact, &finding.gpu) == (&Status::Proved, &Status::Proved);
        ClaimRecord {
            exact: status(&finding.exact),
            claim: (!proved).then(|| finding.text(names)),
            gpu: Some(status(&finding.gpu)),
        }
    }
}

impl StatusRecord {
    fn plain(status: &str) -> StatusRecord {
        StatusRecord { status: status.to_owned(), input: None, value: None, volume: None }
    }

    fn new(status: &Status, finding: &Finding, names: &Names) -> StatusRecord {
        match status {
            Status::Proved => StatusRecord::plain("proved"),
            Status::Open { volume } => {
                StatusRecord { volume: Some(*volume), ..StatusRecord::plain("open") }
            }
            Status::Refuted { input, value } => StatusRecord {
                input: Some(finding.named(names, input).into_iter().collect()),
                value: Some((*value).into()),
                ..StatusRecord::plain("refuted")
            },
        }
    }
}
