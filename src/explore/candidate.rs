//! A formula with holes that is to be fitted, and how it is written.

use super::departure::Departure;
use super::design::terms_up_to;
use super::form::number;
use super::shape::{Coordinate, Join, Shape};
use super::template::Template;
use crate::dataset::Dataset;

/// Names of holes, as far as no column has them.
const NAMES: [&str; 12] = ["f", "g", "h", "p", "q", "r", "s", "t", "u", "v", "w", "z"];

/// An argument of holes.
#[derive(Clone)]
pub(super) struct Argument {
    pub coordinate: Coordinate,
    pub text: String,
    /// How often its degree counts: twice for a square.
    pub degree: usize,
}

/// A formula with holes that is to be fitted.
pub(super) struct Candidate {
    pub shape: Shape,
    pub arguments: Vec<Argument>,
    /// What stands before it: the input in which it is odd.
    pub factor: String,
    /// For each part, the part that is the same function.
    pub same: Vec<usize>,
    /// What the data say of it, where that is known already.
    pub known: Option<Departure>,
}

impl Candidate {
    /// Writes it down, given the degree of the smooth fit and the number of inputs that a search
    /// without a template has.
    pub fn template(
        &self,
        dataset: &Dataset,
        output: &str,
        departure: Departure,
        [degree, inputs]: [usize; 2],
    ) -> Template {
        let Candidate { shape, arguments, factor, same, .. } = self;
        let taken = |name: &&&str| {
            let columns = dataset.inputs.iter().chain(&dataset.outputs);
            columns.into_iter().all(|column| column.name != **name)
        };
        let names: Vec<&str> = NAMES.iter().filter(taken).copied().collect();
        let mut distinct: Vec<usize> = same.clone();
        distinct.sort_unstable();
        distinct.dedup();
        let hole = |at: usize| {
            let place = distinct.iter().position(|&part| part == same[at]).unwrap_or(0);
            let name = names.get(place).map_or(format!("f{place}"), |name| (*name).to_owned());
            let part = in_order(shape, at, same[at]);
            let texts: Vec<&str> = part.iter().map(|&arg| arguments[arg].text.as_str()).collect();
            format!("{name}({})", texts.join(", "))
        };
        let join = if shape.join == Join::Sum { " + " } else { "*" };
        let holes: Vec<String> = (0..shape.parts.len()).map(hole).collect();
        let degree = degree.max(2);
        let parts: Vec<Vec<usize>> = distinct.iter().map(|&at| shape.parts[at].clone()).collect();
        let counts: Vec<usize> = arguments.iter().map(|argument| argument.degree).collect();
        let all: Vec<usize> = (0..inputs).collect();
        Template {
            formula: format!("{output} = {factor}{}", holes.join(join)),
            verdict: departure.verdict(),
            departure,
            holes: distinct.len(),
            most_arguments: shape.parts.iter().map(Vec::len).max().unwrap_or(0),
            inputs,
            terms: terms_up_to(degree - usize::from(shape.odd.is_some()), &parts, &counts),
            all_terms: terms_up_to(degree, &[all], &vec![1; inputs]),
        }
    }
}

/// Returns a part's arguments; those of the same function stand where the first has them.
fn in_order(shape: &Shape, part: usize, first: usize) -> Vec<usize> {
    let own = &shape.parts[part];
    let other = own.iter().copied().find(|at| !shape.parts[first].contains(at));
    let model = shape.parts[first].iter();
    model.filter_map(|&at| if own.contains(&at) { Some(at) } else { other }).collect()
}

/// Writes the distance of an input from a centre.
pub(super) fn from_centre(name: &str, centre: f64) -> String {
    match centre {
        0.0 => name.to_owned(),
        centre if centre < 0.0 => format!("{name} + {}", number(-centre)),
        centre => format!("{name} - {}", number(centre)),
    }
}
