//! One output: its smooth fit, the shares of its inputs, and the forms that it may have.

use super::candidates::candidates;
use super::departure::{Departure, Verdict};
use super::fitting::Fitting;
use super::form::Form;
use super::rows::Rows;
use super::shape::Shape;
use super::table::Table;
use super::template::{Template, templates};
use super::tested::{FIRST_ROWS, Tested};
use super::{MOST_PAIRED, MOST_TOGETHER, periodic};
use crate::dataset::Dataset;
use rayon::prelude::*;
use serde::Serialize;

/// What the data say of one output.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OutputReport {
    /// Its name.
    pub output: String,
    /// Its standard deviation over the rows, weighted; the unit of all residuals.
    pub spread: f64,
    /// The stated standard errors, the root of their mean square, in spreads; null if none are.
    pub noise: Option<f64>,
    /// The smooth fit; null if the output is constant.
    pub smooth: Option<SmoothFit>,
    /// Input by input.
    pub inputs: Vec<Influence>,
    /// The forms that were tested.
    pub forms: Vec<Finding>,
    /// The templates that these suggest, the better one first.
    pub templates: Vec<Template>,
}

/// A polynomial fit of all inputs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SmoothFit {
    /// The total degree.
    pub degree: usize,
    /// The number of its terms.
    pub terms: usize,
    /// The root mean square error on rows left out, in spreads.
    pub residual: f64,
}

/// The shares of an output's variance that one input explains.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Influence {
    /// The input.
    pub input: String,
    /// Whether it has the same value in all rows.
    pub constant: bool,
    /// The share that it explains alone; null if it is constant or was not looked at.
    pub first: Option<f64>,
    /// The share that is lost without it.
    pub total: Option<f64>,
    /// The most by which the shares may be too small: the share that is not explained at all.
    pub uncertainty: f64,
    /// What is left without it.
    pub without: Option<Departure>,
    /// What that says.
    pub verdict: Option<Verdict>,
    /// Whether it can be left out, together with all others of which this is said. Where inputs
    /// depend on each other, one may be left out because the others are there.
    pub needless: bool,
}

/// A form that was tested.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The form; inputs are numbered as the dataset's.
    pub form: Form,
    /// The form as text.
    pub text: String,
    /// What the data say of it.
    pub verdict: Verdict,
    /// By how much they depart from it.
    pub departure: Departure,
}

pub(super) fn explore_output(dataset: &Dataset, output: usize) -> OutputReport {
    let name = dataset.outputs[output].name.clone();
    let Some(rows) = Rows::of(dataset, output) else { return constant(dataset, name) };
    let all = Tested::of(&rows, Table::of(dataset, output, rows.spread), together(&rows));
    let mut influences = influences(dataset, &all);
    let needless = all.needless(&influences, Verdict::Holds, &[]);
    needless.iter().for_each(|&input| influences[input].needless = true);
    let smooth =
        SmoothFit { degree: all.full.degree, terms: all.full.terms, residual: all.full.residual };
    // Without inputs that do not matter, polynomials of a higher degree can be fitted.
    let tested = match needless.is_empty() {
        true => all,
        false => {
            let needed = all.inputs.iter().copied().filter(|input| !needless.contains(input));
            Tested::of(&rows, all.table, needed.collect())
        }
    };
    let mut active = tested.inputs.clone();
    active.sort_by(|&a, &b| {
        let total = |input: usize| influences[input].total.unwrap_or(0.0);
        total(b).total_cmp(&total(a)).then(a.cmp(&b))
    });
    active.truncate(MOST_PAIRED);
    active.sort_unstable();
    let names: Vec<String> = dataset.inputs.iter().map(|column| column.name.clone()).collect();
    let mut forms: Vec<Finding> = candidates(dataset, &rows, &active)
        .into_par_iter()
        .map(|form| tested.finding(form, &names))
        .collect();
    forms.extend(periodic::findings(&tested, &active, &names));
    let templates = templates(dataset, &name, &tested, &influences, &forms);
    OutputReport {
        output: name,
        spread: rows.spread,
        noise: rows.errors_stated.then_some(rows.noise),
        smooth: Some(smooth),
        inputs: influences,
        forms,
        templates,
    }
}

fn constant(dataset: &Dataset, output: String) -> OutputReport {
    let influence = |column: &crate::dataset::Column| Influence {
        input: column.name.clone(),
        constant: false,
        first: None,
        total: None,
        uncertainty: 0.0,
        without: None,
        verdict: None,
        needless: false,
    };
    OutputReport {
        output,
        spread: 0.0,
        noise: None,
        smooth: None,
        inputs: dataset.inputs.iter().map(influence).collect(),
        forms: Vec::new(),
        templates: Vec::new(),
    }
}

/// Returns the inputs that are not constant, of many those that explain most alone.
fn together(rows: &Rows) -> Vec<usize> {
    let varying: Vec<usize> = (0..rows.inputs.len()).filter(|&i| !rows.is_constant(i)).collect();
    if varying.len() <= MOST_TOGETHER {
        return varying;
    }
    let alone = |&input: &usize| {
        let residual =
            Fitting::new(rows, &[]).fit(&Shape::of_inputs(&[input]), FIRST_ROWS).residual;
        (residual, input)
    };
    let mut order: Vec<(f64, usize)> = varying.par_iter().map(alone).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut chosen: Vec<usize> = order[..MOST_TOGETHER].iter().map(|(_, input)| *input).collect();
    chosen.sort_unstable();
    chosen
}

fn influences(dataset: &Dataset, tested: &Tested) -> Vec<Influence> {
    let rows = tested.fitting.rows;
    let explained = |residual: f64| (1.0 - residual * residual).clamp(0.0, 1.0);
    let of = |(input, column): (usize, &crate::dataset::Column)| {
        let looked_at = tested.inputs.contains(&input);
        let without = looked_at.then(|| tested.departure(&Form::Without(input)));
        let alone = looked_at.then(|| tested.alone(input));
        let on_grid = without.is_some_and(|departure| departure.on_grid);
        let floor = if on_grid { rows.noise } else { tested.full.residual };
        Influence {
            input: column.name.clone(),
            constant: rows.is_constant(input),
            first: alone.map(explained),
            total: without.map(|departure| departure.estimate.powi(2).min(1.0)),
            uncertainty: floor * floor,
            verdict: without.map(|departure| departure.verdict()),
            without,
            needless: false,
        }
    };
    dataset.inputs.par_iter().enumerate().map(of).collect()
}
