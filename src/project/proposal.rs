//! What to go on with: the model with functions in place of its parameters, and a first guess of
//! each.

use super::{Dependence, Projection, Surfaces};
use crate::explore::Cholesky;
use crate::program::format_constant;

/// A template to search for functions in, and where to start.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// By parameter, the inputs that it is worth to be a function of; none where it may as well be a
    /// constant.
    pub arguments: Vec<Vec<String>>,
    /// The model in which each parameter is a function of these inputs; none if all names that it
    /// could have are taken.
    pub template: Option<String>,
    /// A function for each parameter, as `lgp search --guess` takes them: the table in its least
    /// terms.
    pub guess: String,
}

/// The share of a plainer form's squares that the next one may have and count as the better guess:
/// it costs more. By hand, unmeasured.
const MUCH_BETTER: f64 = 0.5;

impl Projection {
    /// Proposes a search for the parameters as functions of what they depend on.
    pub fn proposal(&self, surfaces: &Surfaces, dependences: &[Dependence]) -> Proposal {
        let parameters = 0..surfaces.labels.len();
        let numbers: Vec<Vec<usize>> =
            parameters.map(|parameter| arguments(surfaces, parameter, dependences)).collect();
        let name = |&input: &usize| surfaces.over[input].name.clone();
        let arguments: Vec<Vec<String>> =
            numbers.iter().map(|inputs| inputs.iter().map(name).collect()).collect();
        let names = self.dataset.names();
        let written = self.model.with_functions(&arguments, &names);
        let (template, called) = match written {
            Some((template, called)) => (Some(template), called),
            None => (None, surfaces.labels.clone()),
        };
        let guess = |(parameter, inputs): (usize, &Vec<usize>)| {
            let body = guess(surfaces, parameter, inputs);
            match inputs.is_empty() {
                true => format!("${} = {body}", called[parameter]),
                false => {
                    format!("{}({}) = {body}", called[parameter], arguments[parameter].join(", "))
                }
            }
        };
        let guesses: Vec<String> = numbers.iter().enumerate().map(guess).collect();
        Proposal { template, guess: guesses.join("; "), arguments }
    }
}

/// Returns the inputs that a parameter depends on by more than hardly; the one that it depends on
/// most, at least, unless it may as well be a constant.
fn arguments(surfaces: &Surfaces, parameter: usize, dependences: &[Dependence]) -> Vec<usize> {
    let own = || dependences.iter().filter(|one| one.parameter == parameter);
    if own().any(|one| one.input.is_none() && one.is_weak) {
        return Vec::new();
    }
    let weak = |input: &usize| own().any(|one| one.input == Some(*input) && one.is_weak);
    let kept: Vec<usize> = (0..surfaces.over.len()).filter(|input| !weak(input)).collect();
    if !kept.is_empty() {
        return kept;
    }
    let most = own().filter(|one| one.input.is_some()).max_by(|a, b| a.rmse.total_cmp(&b.rmse));
    most.and_then(|one| one.input).into_iter().collect()
}

/// A way to write a parameter down with a sum of terms, one an input.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    Sum,
    /// `exp2` of a sum of inputs.
    Exponential,
    /// `exp2` of a sum of the inputs' logarithms.
    Power,
}

impl Form {
    fn term(self, input: f64) -> f64 {
        if self == Form::Power { input.log2() } else { input }
    }

    /// Returns what the sum is to be, for a value.
    fn target(self, value: f64) -> f64 {
        if self == Form::Sum { value } else { value.log2() }
    }

    fn value(self, sum: f64) -> f64 {
        if self == Form::Sum { sum } else { sum.exp2() }
    }
}

/// Returns the function of some inputs of the plainest form that is near to a parameter.
fn guess(surfaces: &Surfaces, parameter: usize, inputs: &[usize]) -> String {
    let of = |form: Form| {
        let rows: Vec<Vec<f64>> = surfaces
            .search
            .iter()
            .map(|place| {
                let own = inputs.iter().map(|&input| form.term(place.at[input].into()));
                own.chain([1.0]).collect()
            })
            .collect();
        let values = surfaces.search.iter().map(|place| f64::from(place.values[parameter]));
        let targets: Vec<f64> = values.clone().map(|value| form.target(value)).collect();
        let factors = nearest(&rows, &targets);
        let apart =
            |(row, value): (&Vec<f64>, f64)| (form.value(sum(row, &factors)) - value).powi(2);
        let squares: f64 = rows.iter().zip(values).map(apart).sum();
        (form, factors, squares)
    };
    let mut best = of(Form::Sum);
    if !inputs.is_empty() {
        for form in [Form::Exponential, Form::Power] {
            let other = of(form);
            // Not so where there is no logarithm: nothing is less than NaN.
            if other.2 < MUCH_BETTER * best.2 {
                best = other;
            }
        }
    }
    let (form, factors, _) = best;
    text(form, surfaces, inputs, &factors)
}

/// Returns the factors of the sum that is nearest to some values.
fn nearest(rows: &[Vec<f64>], values: &[f64]) -> Vec<f64> {
    let terms = rows[0].len();
    let over_rows = |of: &dyn Fn(&[f64], f64) -> f64| -> f64 {
        rows.iter().zip(values).map(|(row, value)| of(row, *value)).sum()
    };
    let squares: Vec<f64> = (0..terms * terms)
        .map(|entry| over_rows(&|row, _| row[entry / terms] * row[entry % terms]))
        .collect();
    let products: Vec<f64> =
        (0..terms).map(|term| over_rows(&|row, value| row[term] * value)).collect();
    let cholesky = Cholesky::new(&squares, terms);
    cholesky.back(&cholesky.forward(&products), terms)
}

fn sum(row: &[f64], factors: &[f64]) -> f64 {
    row.iter().zip(factors).map(|(part, factor)| part * factor).sum()
}

fn text(form: Form, surfaces: &Surfaces, inputs: &[usize], factors: &[f64]) -> String {
    let (constant, factors) = factors.split_last().expect("a sum has a constant");
    let mut text = short(*constant);
    for (&input, factor) in inputs.iter().zip(factors) {
        let sign = if *factor < 0.0 { '-' } else { '+' };
        let name = &surfaces.over[input].name;
        let term = if form == Form::Power { format!("log2({name})") } else { name.clone() };
        text += &format!(" {sign} {}*{term}", short(factor.abs()));
    }
    if form == Form::Sum { text } else { format!("exp2({text})") }
}

/// Three digits are enough to start from.
fn short(value: f64) -> String {
    let value = if value.is_finite() { value } else { 1.0 };
    format_constant(format!("{value:.2e}").parse().unwrap_or(1.0))
}
