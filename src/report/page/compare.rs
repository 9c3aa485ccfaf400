//! The page that compares runs of one dataset.

use super::{escaped, filled, own, within_script};
use crate::printable::printable;
use crate::run::Trace;
use serde::Serialize;

/// The contents of a page of several runs.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// The heading.
    pub title: String,
    /// The line below it.
    #[serde(skip)]
    pub subtitle: String,
    /// The GPU profile of all costs.
    pub gpu: String,
    /// The cycles at which errors are listed.
    pub costs: Vec<f64>,
    /// The measures of errors; the first is shown at first.
    pub measures: Vec<&'static str>,
    /// True if all have the same cost budget: only then can hypervolumes be compared.
    pub same_budget: bool,
    /// The runs.
    pub groups: Vec<Group>,
}

/// Runs that differ in nothing but their seeds.
#[derive(Clone, Debug, Serialize)]
pub struct Group {
    /// The traits that tell the group from the others.
    pub label: String,
    /// The runs of the group.
    pub runs: Vec<ComparedRun>,
}

/// A run of a comparison.
#[derive(Clone, Debug, Serialize)]
pub struct ComparedRun {
    /// The seconds that it took.
    pub seconds: f64,
    /// The candidates that it considered.
    pub considered: u64,
    /// Each member's cost, and its errors by each of [`Comparison::measures`].
    pub front: Vec<Vec<f64>>,
    /// Its progress, if that was recorded.
    pub trace: Option<Trace>,
}

const TEMPLATE: &str = include_str!("compare.html");
const SCRIPTS: [&str; 3] = [
    include_str!("script/elements.js"),
    include_str!("script/chart.js"),
    include_str!("script/compare.js"),
];

/// Returns the comparison as HTML.
pub fn comparison(comparison: &Comparison) -> String {
    let data = serde_json::to_string(comparison).expect("plain data");
    let [policy, style, script] = own(&SCRIPTS.concat());
    let values = [
        ("title", escaped(&printable(&comparison.title))),
        ("subtitle", escaped(&printable(&comparison.subtitle))),
        ("data", within_script(&data)),
        policy,
        style,
        script,
    ];
    filled(TEMPLATE, &values)
}
