//! Runs of one dataset beside each other.

use super::{escaped, filled, own, within_script};
use crate::printable::printable;
use crate::run::Trace;
use serde::Serialize;

/// What a page of several runs shows.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    pub title: String,
    #[serde(skip)]
    pub subtitle: String,
    /// The profile that costs are of.
    pub gpu: String,
    /// Cycles at which errors are listed.
    pub costs: Vec<f64>,
    /// The errors that formulas have; the first is what is shown at first.
    pub measures: Vec<&'static str>,
    /// Whether all may spend the same cycles: only then do hypervolumes compare.
    pub same_budget: bool,
    pub groups: Vec<Group>,
}

/// Runs that differ in nothing but their seeds.
#[derive(Clone, Debug, Serialize)]
pub struct Group {
    pub label: String,
    pub runs: Vec<ComparedRun>,
}

/// A run among others.
#[derive(Clone, Debug, Serialize)]
pub struct ComparedRun {
    pub seconds: f64,
    pub considered: u64,
    /// Each member's cost, and its errors by each of [`Comparison::measures`].
    pub front: Vec<Vec<f64>>,
    pub trace: Option<Trace>,
}

const TEMPLATE: &str = include_str!("compare.html");
const SCRIPTS: [&str; 3] = [
    include_str!("script/elements.js"),
    include_str!("script/chart.js"),
    include_str!("script/compare.js"),
];

/// The comparison as HTML.
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
