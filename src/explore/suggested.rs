//! Templates that forms suggest, one form or several together.

use super::candidate::{Argument, Candidate, from_centre};
use super::departure::{Departure, Verdict};
use super::form::Form;
use super::groups::groups;
use super::output::Finding;
use super::shape::{Coordinate, Join, Shape};
use super::tested::Tested;
use crate::dataset::Dataset;
use rayon::prelude::*;

/// The forms that hold at a level of verdict, from which templates are made.
pub(super) struct Suggested<'a> {
    pub dataset: &'a Dataset,
    pub tested: &'a Tested<'a>,
    pub forms: &'a [Finding],
    pub level: Verdict,
    /// The number of inputs that a search without a template has.
    pub inputs: usize,
}

impl Suggested<'_> {
    /// Returns whether a verdict is good enough.
    pub fn accepts(&self, verdict: Verdict) -> bool {
        verdict == Verdict::Holds || verdict == self.level
    }

    /// Returns the forms that hold well enough, those with the smallest departure first.
    fn accepted(&self) -> Vec<&Finding> {
        let mut accepted: Vec<&Finding> =
            self.forms.iter().filter(|finding| self.accepts(finding.verdict)).collect();
        accepted.sort_by(|a, b| {
            let level = |finding: &Finding| finding.verdict != Verdict::Holds;
            let by_level = level(a).cmp(&level(b));
            by_level.then(a.departure.residual.total_cmp(&b.departure.residual))
        });
        accepted
    }

    fn holds(&self, form: &Form) -> bool {
        self.forms.iter().any(|finding| finding.form == *form && self.accepts(finding.verdict))
    }

    /// Lists the templates for functions of some inputs that the forms suggest.
    pub fn candidates(&self, inputs: &[usize]) -> Vec<Candidate> {
        if inputs.is_empty() {
            return Vec::new();
        }
        let pairs = self.pairs(inputs);
        let mut candidates: Vec<Candidate> = self.symmetric(inputs).into_iter().collect();
        for with in [&pairs[..], &[]] {
            let (arguments, odd) = self.arguments(inputs, with);
            let changed = with.len() + (self.inputs - inputs.len());
            let folded = arguments.iter().any(|argument| argument.degree > 1);
            if changed > 0 || folded {
                candidates.push(self.candidate(&arguments, odd, None));
            }
            for join in [Join::Product, Join::Sum] {
                let parts = self.parts(&arguments, join);
                // A sum that is odd as a whole has but one part.
                if parts.len() > 1 && !(join == Join::Sum && odd.is_some()) {
                    candidates.push(self.candidate(&arguments, odd, Some((join, parts))));
                }
            }
            if pairs.is_empty() {
                break;
            }
        }
        candidates
    }

    /// A function in which two inputs may be exchanged is one of their sum and product.
    fn symmetric(&self, inputs: &[usize]) -> Option<Candidate> {
        // Otherwise the form is of other inputs than the template's.
        let same = inputs == self.tested.inputs;
        let found = self.accepted().into_iter().filter(|_| same);
        let mut found = found.filter_map(|finding| match finding.form {
            Form::Symmetric(x, y) => Some((x, y, finding.departure)),
            _ => None,
        });
        let (x, y, departure) = found.next()?;
        let mut arguments = self.plain(inputs);
        for argument in &mut arguments {
            let [a, b] = [x, y].map(|input| &self.dataset.inputs[input].name);
            match argument.coordinate {
                Coordinate::Input(input) if input == x => argument.text = format!("{a} + {b}"),
                Coordinate::Input(input) if input == y => {
                    (argument.text, argument.degree) = (format!("{a}*{b}"), 2);
                }
                _ => {}
            }
        }
        let candidate = self.candidate(&arguments, None, None);
        Some(Candidate { known: Some(departure), ..candidate })
    }

    fn plain(&self, inputs: &[usize]) -> Vec<Argument> {
        let argument = |&input: &usize| Argument {
            coordinate: Coordinate::Input(input),
            text: self.dataset.inputs[input].name.clone(),
            degree: 1,
        };
        inputs.iter().map(argument).collect()
    }

    /// Chooses pairs of inputs that come together as one, each input in one pair at most.
    fn pairs(&self, inputs: &[usize]) -> Vec<Form> {
        let mut used = Vec::new();
        let mut pairs = Vec::new();
        for finding in self.accepted() {
            let Form::Through(_, x, y) = finding.form else { continue };
            if [x, y].iter().all(|input| inputs.contains(input) && !used.contains(input)) {
                used.extend([x, y]);
                pairs.push(finding.form.clone());
            }
        }
        pairs
    }

    /// Returns the arguments of a function of inputs, some of them in pairs, and the input in which
    /// it is odd.
    fn arguments(&self, inputs: &[usize], pairs: &[Form]) -> (Vec<Argument>, Option<(usize, f64)>) {
        let name = |input: usize| self.dataset.inputs[input].name.as_str();
        let mut odd = None;
        let mut arguments = Vec::new();
        for &input in inputs {
            let pair = pairs.iter().find_map(|form| match *form {
                Form::Through(pairing, x, y) if x == input || y == input => Some((pairing, x, y)),
                _ => None,
            });
            match pair {
                Some((pairing, x, y)) if x == input => arguments.push(Argument {
                    coordinate: Coordinate::Pair(pairing, x, y),
                    text: pairing.text(name(x), name(y)),
                    degree: 1,
                }),
                Some(_) => {}
                None => arguments.push(self.argument(input, &mut odd)),
            }
        }
        (arguments, odd)
    }

    fn argument(&self, input: usize, odd: &mut Option<(usize, f64)>) -> Argument {
        let name = &self.dataset.inputs[input].name;
        for finding in self.accepted() {
            let (centre, square) = match finding.form {
                Form::Even(x, centre) if x == input => (centre, false),
                Form::Odd(x, centre) if x == input && odd.is_none() => {
                    *odd = Some((input, centre));
                    (centre, true)
                }
                _ => continue,
            };
            let distance = from_centre(name, centre);
            let text = match (square, centre == 0.0) {
                (true, true) => format!("{distance}^2"),
                (true, false) => format!("({distance})^2"),
                (false, _) => format!("abs({distance})"),
            };
            return Argument { coordinate: Coordinate::Folded(input, centre), text, degree: 2 };
        }
        Argument { coordinate: Coordinate::Input(input), text: name.clone(), degree: 1 }
    }

    /// Returns the largest groups of arguments that do not separate from each other.
    fn parts(&self, arguments: &[Argument], join: Join) -> Vec<Vec<usize>> {
        let count = arguments.len();
        let mut together = vec![vec![true; count]; count];
        let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b]));
        let pairs: Vec<[usize; 2]> = pairs.collect();
        let apart = pairs.into_par_iter().filter(|pair| self.separate(arguments, *pair, join));
        for [a, b] in apart.collect::<Vec<_>>() {
            (together[a][b], together[b][a]) = (false, false);
        }
        groups(&together)
    }

    fn separate(&self, arguments: &[Argument], [a, b]: [usize; 2], join: Join) -> bool {
        let input = |at: usize| match arguments[at].coordinate {
            Coordinate::Input(input) | Coordinate::Folded(input, _) => Some(input),
            _ => None,
        };
        if let (Some(x), Some(y)) = (input(a), input(b)) {
            let forms = match join {
                Join::Product => [Form::PairProduct(x, y), Form::Product(x), Form::Product(y)],
                Join::Sum => [Form::PairSum(x, y), Form::Sum(x), Form::Sum(y)],
            };
            return forms.iter().any(|form| self.holds(form));
        }
        let but = |out: usize| (0..arguments.len()).filter(|at| *at != out).collect();
        let coordinates = arguments.iter().map(|argument| argument.coordinate).collect();
        let shape = Shape::joint(coordinates).split(join, vec![but(b), but(a)]);
        self.accepts(self.tested.departure_of(&shape).verdict())
    }

    fn candidate(
        &self,
        arguments: &[Argument],
        odd: Option<(usize, f64)>,
        split: Option<(Join, Vec<Vec<usize>>)>,
    ) -> Candidate {
        let mut shape =
            Shape::joint(arguments.iter().map(|argument| argument.coordinate).collect());
        if let Some((join, parts)) = split {
            shape = shape.split(join, parts);
        }
        shape.odd = odd;
        let factor = odd.map_or(String::new(), |(input, centre)| {
            let distance = from_centre(&self.dataset.inputs[input].name, centre);
            if centre == 0.0 { format!("{distance}*") } else { format!("({distance})*") }
        });
        let same = (0..shape.parts.len()).map(|part| self.same_as(&shape, part)).collect();
        Candidate { shape, arguments: arguments.to_vec(), factor, same, known: None }
    }

    /// Returns the first part that is the same function as a part, of another input.
    fn same_as(&self, shape: &Shape, part: usize) -> usize {
        // The factors of a product that is symmetric may differ by a sign.
        let values = &self.tested.fitting.rows.output;
        if shape.join == Join::Product && values.iter().any(|value| *value < 0.0) {
            return part;
        }
        let exchanged = |x: usize, y: usize| {
            let (Coordinate::Input(x), Coordinate::Input(y)) =
                (shape.coordinates[x], shape.coordinates[y])
            else {
                return false;
            };
            self.holds(&Form::Symmetric(x.min(y), x.max(y)))
        };
        let only = |of: &[usize], other: &[usize]| -> Vec<usize> {
            of.iter().copied().filter(|at| !other.contains(at)).collect()
        };
        let parts = &shape.parts;
        let earlier = (0..part).find(|&earlier| {
            let (own, its) =
                (only(&parts[part], &parts[earlier]), only(&parts[earlier], &parts[part]));
            own.len() == 1 && its.len() == 1 && exchanged(own[0], its[0])
        });
        earlier.unwrap_or(part)
    }

    /// Returns what the data say of a template.
    pub fn departure(&self, candidate: &Candidate) -> Departure {
        let Candidate { shape, known, .. } = candidate;
        if let Some(known) = known {
            return *known;
        }
        let input = |coordinate: &Coordinate| match coordinate {
            Coordinate::Input(input) => Some(*input),
            _ => None,
        };
        let plain: Option<Vec<usize>> = shape.coordinates.iter().map(input).collect();
        let table = self.tested.table.as_ref().zip(plain).filter(|_| shape.odd.is_none());
        let left = table.and_then(|(table, inputs)| {
            let part = |part: &Vec<usize>| part.iter().map(|&at| inputs[at]).collect();
            table.of_parts(shape.join, &shape.parts.iter().map(part).collect::<Vec<_>>())
        });
        match left {
            Some(left) => Departure::on_grid(self.tested.fitting.rows, left, &self.tested.full),
            None => self.tested.departure_of(shape),
        }
    }
}
