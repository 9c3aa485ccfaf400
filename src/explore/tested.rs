//! What forms are tested with, and the tests.

use super::departure::{Departure, Verdict};
use super::fitting::Fitting;
use super::form::Form;
use super::output::{Finding, Influence};
use super::rows::Rows;
use super::shape::{Join, Shape};
use super::smooth::Fit;
use super::table::{Left, Table};

/// The rows with which forms that fail by far are told. By hand: four for each term.
pub(super) const FIRST_ROWS: usize = 1024;
/// The residual that is by far, in spreads, and relative to that of the smooth fit. By hand.
const BY_FAR: [f64; 2] = [0.3, 5.0];

/// What tests of forms need.
pub(super) struct Tested<'a> {
    pub fitting: Fitting<'a>,
    pub full: Fit,
    pub table: Option<Table>,
    /// The inputs that the full fit is of.
    pub inputs: Vec<usize>,
}

impl<'a> Tested<'a> {
    pub fn of(rows: &'a Rows, table: Option<Table>, inputs: Vec<usize>) -> Tested<'a> {
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
    pub fn alone(&self, input: usize) -> f64 {
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

    pub fn departure(&self, form: &Form) -> Departure {
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
