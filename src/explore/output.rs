//! One output: its smooth fit, the shares of its inputs, and the forms that it may have.

use super::departure::{Departure, Verdict};
use super::fitting::Fitting;
use super::form::Form;
use super::rows::Rows;
use super::shape::{Join, Pairing, Shape};
use super::smooth::Fit;
use super::table::{Left, Table};
use super::template::{Template, templates};
use super::{MOST_PAIRED, MOST_TOGETHER, periodic};
use crate::dataset::Dataset;
use rayon::prelude::*;
use serde::Serialize;

/// The rows with which forms that fail by far are told. By hand: four for each term.
const FIRST_ROWS: usize = 1024;
/// The residual that is by far, in spreads, and relative to that of the smooth fit. By hand.
const BY_FAR: [f64; 2] = [0.3, 5.0];

/// How much of an input's range has to lie on either side of a centre. By hand, unmeasured.
const BOTH_SIDES: f64 = 0.2;

/// The ranges of two inputs that are exchanged may differ by so much. By hand, unmeasured.
const ALIKE: f64 = 1.25;

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

/// What tests of forms need.
pub(super) struct Tested<'a> {
    pub fitting: Fitting<'a>,
    pub full: Fit,
    pub table: Option<Table>,
    /// The inputs that the full fit is of.
    pub inputs: Vec<usize>,
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

impl<'a> Tested<'a> {
    fn of(rows: &'a Rows, table: Option<Table>, inputs: Vec<usize>) -> Tested<'a> {
        let fitting = Fitting::new(rows, &inputs);
        let full = fitting.fit(&Shape::of_inputs(&inputs), rows.len());
        Tested { fitting, full, table, inputs }
    }

    /// Returns the inputs that can be left out together, beside some others, at a level of verdict.
    pub fn needless(&self, known: &[Influence], level: Verdict, out: &[usize]) -> Vec<usize> {
        let departure = |input: usize| known[input].without.map_or(f64::INFINITY, |d| d.residual);
        let accepted =
            |verdict: Option<Verdict>| verdict == Some(Verdict::Holds) || verdict == Some(level);
        let mut order: Vec<usize> = self.inputs.clone();
        order.retain(|&input| accepted(known[input].verdict) && !out.contains(&input));
        order.sort_by(|&a, &b| departure(a).total_cmp(&departure(b)).then(a.cmp(&b)));
        let mut needless: Vec<usize> = out.to_vec();
        for input in order {
            let rest = self.inputs.iter().copied();
            let rest: Vec<usize> = rest.filter(|i| *i != input && !needless.contains(i)).collect();
            // Alone it has been tested already.
            if needless.is_empty() || accepted(Some(self.of_inputs(&rest).verdict())) {
                needless.push(input);
            }
        }
        needless
    }

    /// Returns the departure from a function of some inputs alone.
    fn of_inputs(&self, inputs: &[usize]) -> Departure {
        match self.table.as_ref().and_then(|table| table.of_axes(inputs)) {
            Some(left) => Departure::on_grid(self.fitting.rows, left, &self.full),
            None => self.departure_of(&Shape::of_inputs(inputs)),
        }
    }

    /// Returns what the best function of one input leaves.
    fn alone(&self, input: usize) -> f64 {
        let by_table = self.table.as_ref().and_then(|table| table.of_axes(&[input]));
        by_table.map(|left| left.residual).unwrap_or_else(|| {
            self.fitting.fit(&Shape::of_inputs(&[input]), self.fitting.rows.len()).residual
        })
    }

    pub fn finding(&self, form: Form, names: &[String]) -> Finding {
        let departure = self.departure(&form);
        Finding {
            text: form.text(names, &self.inputs),
            verdict: departure.verdict(),
            departure,
            form,
        }
    }

    fn departure(&self, form: &Form) -> Departure {
        let rows = self.fitting.rows;
        if let Some(left) = self.table.as_ref().and_then(|table| self.on_grid(table, form)) {
            return Departure::on_grid(rows, left, &self.full);
        }
        let shape = form.shape(&self.inputs);
        match form {
            // Shares of the variance are wanted of all rows.
            Form::Without(_) => {
                Departure::of_fit(rows, &self.fitting.fit(&shape, rows.len()), &self.full)
            }
            _ => self.departure_of(&shape),
        }
    }

    /// Fits a shape: to few rows, then, unless these tell that it fails by far, to all.
    pub fn departure_of(&self, shape: &Shape) -> Departure {
        let rows = self.fitting.rows;
        if rows.len() > 2 * FIRST_ROWS {
            let first = self.fitting.fit(shape, FIRST_ROWS);
            if first.residual > BY_FAR[0].max(BY_FAR[1] * self.full.residual) {
                return Departure::of_fit(rows, &first, &self.full);
            }
        }
        Departure::of_fit(rows, &self.fitting.fit(shape, rows.len()), &self.full)
    }

    /// Returns what a form leaves on a grid, if it can be compared value by value there.
    fn on_grid(&self, table: &Table, form: &Form) -> Option<Left> {
        let others = |but: &[usize]| -> Vec<usize> {
            self.inputs.iter().copied().filter(|input| !but.contains(input)).collect()
        };
        match *form {
            Form::Without(x) => table.of_axes(&others(&[x])),
            Form::Sum(x) => table.of_parts(Join::Sum, &[vec![x], others(&[x])]),
            Form::Product(x) => table.of_parts(Join::Product, &[vec![x], others(&[x])]),
            Form::PairSum(x, y) => table.of_parts(Join::Sum, &[others(&[y]), others(&[x])]),
            Form::PairProduct(x, y) => table.of_parts(Join::Product, &[others(&[y]), others(&[x])]),
            Form::Symmetric(x, y) => table.symmetric(x, y),
            Form::Even(x, centre) => table.mirrored(x, centre, 1.0),
            Form::Odd(x, centre) => table.mirrored(x, centre, -1.0),
            Form::Through(..) | Form::Periodic(..) => None,
        }
    }
}

/// Lists the forms that make sense for some inputs.
fn candidates(dataset: &Dataset, rows: &Rows, inputs: &[usize]) -> Vec<Form> {
    let mut forms = Vec::new();
    for (at, &x) in inputs.iter().enumerate() {
        for centre in centres(dataset, rows, x) {
            forms.extend([Form::Even(x, centre), Form::Odd(x, centre)]);
        }
        // Of two inputs, one against the other says it all.
        if inputs.len() > 2 || (inputs.len() == 2 && at == 0) {
            forms.extend([Form::Product(x), Form::Sum(x)]);
        }
        for &y in &inputs[at + 1..] {
            if inputs.len() > 2 {
                forms.extend([Form::PairProduct(x, y), Form::PairSum(x, y)]);
            }
            if may_be_exchanged(rows, x, y) {
                forms.push(Form::Symmetric(x, y));
            }
            forms.extend(Pairing::ALL.map(|pairing| Form::Through(pairing, x, y)));
        }
    }
    forms
}

/// Returns zero and the middle of an input's domain, where rows lie on both sides.
fn centres(dataset: &Dataset, rows: &Rows, input: usize) -> Vec<f64> {
    let [low, high] = rows.range(input);
    let [first, last] = dataset.inputs[input].domain;
    let middle = (first + last) / 2.0;
    let nearly_zero = middle.abs() < 1e-6 * (last - first);
    let mut centres = if nearly_zero { vec![0.0] } else { vec![0.0, middle] };
    let side = BOTH_SIDES * (high - low);
    centres.retain(|centre| low + side <= *centre && *centre <= high - side);
    centres
}

fn may_be_exchanged(rows: &Rows, x: usize, y: usize) -> bool {
    let ([a, b], [c, d]) = (rows.range(x), rows.range(y));
    b.max(d) - a.min(c) <= ALIKE * (b.min(d) - a.max(c))
}
