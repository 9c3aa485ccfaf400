//! The forms that make sense for the inputs of a dataset.

use super::form::Form;
use super::rows::Rows;
use super::shape::Pairing;
use crate::dataset::Dataset;

/// How much of an input's range has to lie on either side of a centre. By hand, unmeasured.
const BOTH_SIDES: f64 = 0.2;

/// The ranges of two inputs that are exchanged may differ by so much. By hand, unmeasured.
const ALIKE: f64 = 1.25;

/// Lists the forms that make sense for some inputs.
pub(super) fn candidates(dataset: &Dataset, rows: &Rows, inputs: &[usize]) -> Vec<Form> {
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
