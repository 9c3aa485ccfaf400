//! Forms that functions may have, as text and as shapes.

use super::shape::{Coordinate, Join, Pairing, Shape};
use serde::Serialize;

/// A form that a function of inputs may have; inputs are numbered as a dataset's.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// It does not depend on this input.
    Without(usize),
    /// `f(x) + g(others)`
    Sum(usize),
    /// `f(x)*g(others)`
    Product(usize),
    /// `f(x, others) + g(y, others)`
    PairSum(usize, usize),
    /// `f(x, others)*g(y, others)`
    PairProduct(usize, usize),
    /// `f(x*y, others)`, and so on.
    Through(Pairing, usize, usize),
    /// The same with two inputs exchanged.
    Symmetric(usize, usize),
    /// Even in an input about a centre.
    Even(usize, f64),
    /// Odd in an input about a centre.
    Odd(usize, f64),
    /// It repeats along an input.
    Periodic(usize, f64),
}

impl Form {
    /// Returns the form of a function of some inputs as text, `f` and `g` standing for any
    /// functions.
    ///
    /// # Panics
    /// If there are fewer names than inputs.
    pub fn text(&self, names: &[String], inputs: &[usize]) -> String {
        let name = |input: &usize| -> String { names[*input].clone() };
        let with = |inside: &str, but: &[usize]| {
            let others = inputs.iter().filter(|input| !but.contains(input)).map(name);
            let inside = (!inside.is_empty()).then(|| inside.to_owned());
            inside.into_iter().chain(others).collect::<Vec<String>>().join(", ")
        };
        match self {
            Form::Without(x) => format!("no {}", name(x)),
            Form::Sum(x) => format!("f({}) + g({})", name(x), with("", &[*x])),
            Form::Product(x) => format!("f({})*g({})", name(x), with("", &[*x])),
            Form::PairSum(x, y) => {
                format!("f({}) + g({})", with(&name(x), &[*x, *y]), with(&name(y), &[*x, *y]))
            }
            Form::PairProduct(x, y) => {
                format!("f({})*g({})", with(&name(x), &[*x, *y]), with(&name(y), &[*x, *y]))
            }
            Form::Through(pairing, x, y) => {
                format!("f({})", with(&pairing.text(&name(x), &name(y)), &[*x, *y]))
            }
            Form::Symmetric(x, y) => format!("symmetric in {} and {}", name(x), name(y)),
            Form::Even(x, centre) => format!("even in {}", about(&name(x), *centre)),
            Form::Odd(x, centre) => format!("odd in {}", about(&name(x), *centre)),
            Form::Periodic(x, period) => {
                format!("repeats along {} every {}", name(x), number(*period))
            }
        }
    }

    /// Returns the shape of functions of these inputs that have the form; none where a period or a
    /// grid's own comparison has another one.
    pub(super) fn shape(&self, inputs: &[usize]) -> Shape {
        let place = |input: usize| inputs.iter().position(|&i| i == input).unwrap_or(0);
        let others = |but: &[usize]| -> Vec<usize> {
            (0..inputs.len()).filter(|at| !but.contains(at)).collect()
        };
        let plain = Shape::of_inputs(inputs);
        match *self {
            Form::Without(x) | Form::Periodic(x, _) => {
                let rest: Vec<usize> = inputs.iter().copied().filter(|&i| i != x).collect();
                Shape::of_inputs(&rest)
            }
            Form::Sum(x) | Form::Product(x) => {
                let x = place(x);
                plain.split(self.join(), vec![vec![x], others(&[x])])
            }
            Form::PairSum(x, y) | Form::PairProduct(x, y) => {
                let (x, y) = (place(x), place(y));
                plain.split(self.join(), vec![others(&[y]), others(&[x])])
            }
            Form::Through(pairing, x, y) => {
                let pair = Coordinate::Pair(pairing, x, y);
                let rest = inputs.iter().filter(|i| ![x, y].contains(i));
                let rest = rest.copied().map(Coordinate::Input);
                Shape::joint([pair].into_iter().chain(rest).collect())
            }
            Form::Symmetric(x, y) => Shape { symmetric: Some((place(x), place(y))), ..plain },
            Form::Even(x, centre) => plain.folded(place(x), centre),
            Form::Odd(x, centre) => {
                Shape { odd: Some((x, centre)), ..plain.folded(place(x), centre) }
            }
        }
    }

    fn join(&self) -> Join {
        match self {
            Form::Product(_) | Form::PairProduct(..) => Join::Product,
            _ => Join::Sum,
        }
    }
}

impl Shape {
    /// The same function, of the square of the distance from a centre in place of an input.
    pub(super) fn folded(mut self, at: usize, centre: f64) -> Shape {
        if let Coordinate::Input(input) = self.coordinates[at] {
            self.coordinates[at] = Coordinate::Folded(input, centre);
        }
        self
    }
}

fn about(name: &str, centre: f64) -> String {
    if centre == 0.0 { name.to_owned() } else { format!("{name} about {}", number(centre)) }
}

/// Writes a number with at most four digits after the point, as far as they say something.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
