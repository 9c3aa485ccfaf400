//! Verdicts as in `front.json` and the output of `lgp check --json`.

use super::{ErrorRecord, Finding, Status, TruthRecord, Verdict};
use crate::program::{ALWAYS_ASKED, Names};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A [`Verdict`], its worst finding for each topic.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VerdictRecord {
    /// The claim that no output is infinite or NaN.
    pub finite: ClaimRecord,
    /// The claim that outputs stay in their ranges; none if no output has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<ClaimRecord>,
    /// The largest error of each output against the truth; empty if that is not known as a formula.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub truth: Vec<TruthRecord>,
    /// The other claims, by name.
    #[serde(flatten)]
    pub claims: BTreeMap<String, ClaimRecord>,
}

/// The outcome of a claim in the interpreter's arithmetic, and on GPUs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClaimRecord {
    /// The outcome in the interpreter's arithmetic.
    #[serde(flatten)]
    pub exact: StatusRecord,
    /// The claim, such as `scale ≥ 0`; none if proved for both or only sampled.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub claim: Option<String>,
    /// The outcome on GPUs; none if it was only sampled.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gpu: Option<StatusRecord>,
}

/// A [`Status`] with its input by name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StatusRecord {
    /// `proved`, `refuted`, `open`, or `sampled`: it holds on every sample of both splits.
    pub status: String,
    /// The counterexample, if it is refuted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub input: Option<BTreeMap<String, f32>>,
    /// The value there: a number, or the text `NaN`, `inf` or `-inf`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
    /// The share of the domain where it is not proved, if it is open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub volume: Option<f64>,
}

/// A value for which JSON may have no number.
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
    /// Returns what holds for every formula of a front: finite on every sample.
    fn default() -> VerdictRecord {
        let sampled = StatusRecord::plain("sampled");
        let finite = ClaimRecord { exact: sampled, claim: None, gpu: None };
        VerdictRecord { finite, range: None, truth: Vec::new(), claims: BTreeMap::new() }
    }
}

impl VerdictRecord {
    /// Makes the record of a verdict.
    ///
    /// # Panics
    /// If the verdict is on a formula without outputs.
    pub fn new(verdict: &Verdict, names: &Names) -> VerdictRecord {
        let of = |topic: &str| Some(ClaimRecord::new(verdict.worst(topic)?, names));
        let [finite, range] = ALWAYS_ASKED;
        let truth = names.outputs.iter().zip(&verdict.errors).map(|(output, [exact, gpu])| {
            let gpu = Some(ErrorRecord::new(gpu, names));
            TruthRecord { output: output.clone(), exact: ErrorRecord::new(exact, names), gpu }
        });
        let topics = verdict.topics().into_iter().filter(|topic| !ALWAYS_ASKED.contains(topic));
        VerdictRecord {
            finite: of(finite).expect("every output is asked whether it is finite"),
            range: of(range),
            truth: truth.collect(),
            claims: topics.filter_map(|topic| Some((topic.to_owned(), of(topic)?))).collect(),
        }
    }

    /// Returns what was asked, by name, and the outcome: finite, range, then claims.
    pub fn topics(&self) -> Vec<(&str, &ClaimRecord)> {
        let [finite, range] = ALWAYS_ASKED;
        let claims = self.claims.iter().map(|(name, claim)| (name.as_str(), claim));
        let range = self.range.iter().map(|claim| (range, claim));
        [(finite, &self.finite)].into_iter().chain(range).chain(claims).collect()
    }

    /// Returns true if the formula was examined beyond its samples.
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
