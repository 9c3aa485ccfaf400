//! Requirements that every formula must meet, whatever its error: checked on samples during a
//! search, and over the whole domain before a formula is shown.

use super::{Problem, Requirement, claims};
use crate::dataset::{Column, Dataset, Split, output_units};
use crate::eval::{Evaluator, Samples, Tape, Values};
use crate::fit::Measure;
use crate::grammar::Grammar;
use crate::num::Interval;
use crate::op::Op;
use crate::program::{Arg, Claim, Draft, Program};
use crate::stability::{
    Bound, Limits, Property, Questions, Rounding, Status, half_error, points_in, prove,
};
use crate::truth::{exact_formula, formula_of};

/// The largest error of a value that must be exact, as a share of the output's largest magnitude.
/// Chosen by hand, unmeasured.
const EXACT: f64 = 1e-5;

/// The weight of a sample at an end, in the others' mean weight; larger for the maximum error,
/// which evens out all errors. By hand: an end is then met to rounding.
const WEIGHT_OF_ENDS: f64 = 1e4;
const WEIGHT_OF_ENDS_BY_MAXIMUM: f64 = 1e7;

/// The number of steps over an input's domain, between whose ends a monotone output is compared,
/// and the rounding allowed, as a share of the output's largest magnitude. Chosen by hand,
/// unmeasured.
const STEPS: f64 = 64.0;
const ROUNDING: f64 = 1e-6;

/// A problem's requirements, with the samples on which they are checked.
#[derive(Clone, Debug)]
pub(super) struct Checks {
    requirements: Vec<Requirement>,
    /// The samples of both splits, if some values must be finite or in a range.
    whole: Option<Samples>,
    /// The other samples of each requirement; if outputs are compared, also those a step further.
    samples: Vec<Vec<Samples>>,
    /// The inputs at which half precision is tried.
    few_points: Vec<Vec<f32>>,
    /// The largest magnitude of each output.
    magnitudes: Vec<f64>,
    /// The claims among the requirements.
    claims: Vec<Claim>,
    domain: Vec<Interval>,
}

impl Checks {
    /// Lays out rows of the search split for a measure, and adds the rows of both splits at the
    /// ends that must be exact, with larger weights. The total weight stays that of the rows asked
    /// for.
    pub fn samples(&self, dataset: &Dataset, measure: Measure, rows: &[u32]) -> Samples {
        let (inputs, units) = (dataset.inputs.len(), output_units(&dataset.outputs));
        let ends = self.rows_at_ends(dataset);
        if ends.is_empty() {
            return measure.samples(&dataset.search, inputs, rows, &units);
        }
        let split = with_rows(&dataset.search, &both_splits(dataset), &ends);
        let plain = rows.len();
        let at_ends = dataset.search.rows() as u32..split.rows() as u32;
        let rows: Vec<u32> = rows.iter().copied().chain(at_ends).collect();
        let mut samples = measure.samples(&split, inputs, &rows, &units);
        let weight_of_ends = match measure {
            Measure::Max => WEIGHT_OF_ENDS_BY_MAXIMUM,
            _ => WEIGHT_OF_ENDS,
        };
        let total = samples.total_weight() - (ends.len() * dataset.outputs.len()) as f64;
        for output in 0..samples.outputs() {
            let mut weights = samples.weights(output).to_vec();
            let (plain, at_ends) = weights.split_at_mut(plain);
            let mean = plain.iter().map(|w| f64::from(*w)).sum::<f64>() / plain.len() as f64;
            at_ends.fill((mean * weight_of_ends) as f32);
            samples.set_weights(output, &weights);
        }
        samples.set_total_weight(total);
        samples
    }

    /// Returns the rows at ends that must be exact, as indices into both splits joined.
    fn rows_at_ends(&self, dataset: &Dataset) -> Vec<u32> {
        let inputs = self.requirements.iter().filter_map(|requirement| match *requirement {
            Requirement::Ends { input, .. } => Some(input),
            _ => None,
        });
        let whole = both_splits(dataset);
        inputs.flat_map(|input| rows_at_ends(&whole, dataset, input)).collect()
    }

    pub fn new(requirements: &[Requirement], dataset: &Dataset) -> Checks {
        let samples = requirements.iter().map(|requirement| samples_for(requirement, dataset));
        let names = dataset.names();
        let claims: Vec<Claim> = requirements
            .iter()
            .filter_map(|one| match one {
                Requirement::Claim { text } => Claim::parse(text, &names).ok(),
                _ => None,
            })
            .collect();
        let domain = Questions::of(&dataset.inputs, &[], &[]).domain;
        let of_values = |one: &Requirement| {
            matches!(
                one,
                Requirement::Range { .. } | Requirement::Finite | Requirement::Claim { .. }
            )
        };
        let whole = requirements.iter().any(of_values);
        let whole = whole.then(|| Samples::new(&both_splits(dataset), dataset.inputs.len()));
        let rows = dataset.search.rows();
        let inputs = &dataset.search.columns[..dataset.inputs.len()];
        let point = |row| inputs.iter().map(|column| column[row]).collect();
        let few_points = (0..rows).step_by(rows.div_ceil(FEW_ROWS).max(1)).map(point).collect();
        let largest = |column: &Column| column.domain.iter().fold(0.0, |m, end| end.abs().max(m));
        let magnitudes = dataset.outputs.iter().map(largest).collect();
        let samples = samples.collect();
        let requirements = requirements.to_vec();
        Checks { whole, samples, requirements, few_points, magnitudes, claims, domain }
    }

    /// Returns true if a formula has the required operations and inputs, whatever its values.
    pub(crate) fn structure_ok(&self, draft: &Draft) -> bool {
        self.requirements.iter().all(|requirement| match *requirement {
            Requirement::Operation(wanted) => draft.instrs.iter().any(|instr| instr.op() == wanted),
            Requirement::Input(wanted) => {
                let args = draft.instrs.iter().flat_map(|instr| instr.args());
                args.chain(&draft.outputs).any(|&arg| arg == Arg::Input(wanted))
            }
            _ => true,
        })
    }

    /// Returns true if a formula's values on the samples are as required.
    pub(crate) fn hold_on_samples(&self, draft: &Draft, evaluator: &mut Evaluator) -> bool {
        let of_halves = |one: &Requirement| matches!(one, Requirement::Half { .. });
        let of_samples = self.whole.is_some() || !self.samples.iter().all(Vec::is_empty);
        if !of_samples && !self.requirements.iter().any(of_halves) {
            return true;
        }
        let Ok(program) = Program::verify(draft.clone()) else { return false };
        let tape = Tape::new(&program);
        let mut values = |samples: &Samples| {
            let mut values = Values::default();
            evaluator.outputs_into(&tape, samples, &mut values);
            values
        };
        let whole = self.whole.as_ref().map(&mut values);
        let plain = self.requirements.iter().zip(&self.samples).all(|(requirement, samples)| {
            let holds = |output: Option<u16>, test: &dyn Fn(usize) -> bool| match output {
                Some(output) => test(usize::from(output)),
                None => (0..program.outputs.len()).all(test),
            };
            match (requirement, samples.as_slice()) {
                (&Requirement::Range { output, low, high }, _) => {
                    let Some(values) = &whole else { return true };
                    let within = |value: &f32| (low..=high).contains(value);
                    holds(output, &|o| values.column(o).iter().all(within))
                }
                (&Requirement::Monotone { output, rising, .. }, [here, further]) => {
                    let (here, further) = (values(here), values(further));
                    holds(output, &|o| {
                        let rounding = (ROUNDING * self.magnitudes[o]) as f32;
                        let ordered = |(a, b): (&f32, &f32)| match rising {
                            true => *b >= a - rounding,
                            false => *b <= a + rounding,
                        };
                        here.column(o).iter().zip(further.column(o)).all(ordered)
                    })
                }
                (&Requirement::Ends { output, .. }, [samples]) => {
                    let values = values(samples);
                    holds(output, &|o| {
                        let most = (EXACT * self.magnitudes[o]) as f32;
                        let exact = |(f, y): (&f32, &f32)| (f - y).abs() <= most;
                        values.column(o).iter().zip(samples.targets(o)).all(exact)
                    })
                }
                (&Requirement::Finite, _) => {
                    let Some(values) = &whole else { return true };
                    holds(None, &|o| values.column(o).iter().all(|value| value.is_finite()))
                }
                (&Requirement::Half { error }, _) => {
                    let points = self.few_points.iter().map(Vec::as_slice);
                    half_error(&program, points) <= error
                }
                _ => true,
            }
        });
        let claims = self.claims.iter();
        plain
            && self.whole.as_ref().is_none_or(|samples| {
                claims.into_iter().all(|claim| {
                    claims::holds_on(claim, &program, &self.domain, samples, evaluator)
                })
            })
    }

    /// Returns the questions about formulas over the whole domain: the dataset's, with the required
    /// ranges in place of its own.
    pub fn questions(&self, dataset: &Dataset) -> Questions {
        let mut questions = Questions::of(&dataset.inputs, &dataset.outputs, &dataset.claims);
        questions.claims.retain(|one| self.claims.iter().all(|claim| claim.name != one.name));
        questions.claims.extend(self.claims.iter().cloned());
        for requirement in &self.requirements {
            let &Requirement::Range { output, low, high } = requirement else { continue };
            for (o, range) in questions.ranges.iter_mut().enumerate() {
                if output.is_none_or(|output| usize::from(output) == o) {
                    *range = [low.into(), high.into()];
                }
            }
        }
        questions
    }

    /// Returns true if no requirement is refuted anywhere in the domain.
    fn not_refuted(&self, program: &Program, dataset: &Dataset) -> bool {
        let domain = Questions::of(&dataset.inputs, &[], &[]).domain;
        let mut claims = Vec::new();
        for requirement in &self.requirements {
            let each = (0..program.outputs.len()).filter(|&o| match requirement {
                Requirement::Range { output, .. } => output.is_none_or(|one| usize::from(one) == o),
                _ => true,
            });
            match *requirement {
                Requirement::Finite => claims.extend(each.map(|o| Property::of(o, Bound::Finite))),
                Requirement::Range { low, high, .. } => claims.extend(each.flat_map(|o| {
                    let bounds = [Bound::AtLeast(low.into()), Bound::AtMost(high.into())];
                    bounds.map(|bound| Property::of(o, bound))
                })),
                Requirement::Half { error } => {
                    let points = points_in(&domain);
                    if half_error(program, points.iter().map(Vec::as_slice)) > error {
                        return false;
                    }
                }
                _ => {}
            }
        }
        let limits = Limits { boxes: BOXES, ..Limits::new(Rounding::Exact) };
        let refuted = |status: &Status| matches!(status, Status::Refuted { .. });
        !claims.chunks(64).any(|some| prove(program, &domain, some, &limits).iter().any(refuted))
            && !self.claims.iter().any(|claim| claims::is_refuted(claim, program, &domain, BOXES))
    }

    /// Returns true if there are ranges, and clamps that the grammar has are all that a formula of
    /// finite values may need to be as required.
    fn can_clamp(&self, grammar: &Grammar) -> bool {
        let mut ranges = 0;
        let each = self.requirements.iter().all(|requirement| match *requirement {
            Requirement::Range { low, high, .. } => {
                ranges += 1;
                clamp_of([low, high], grammar).is_some()
            }
            Requirement::Finite => true,
            _ => false,
        });
        each && ranges > 0
    }

    /// Clamps each output that must stay in a range, and bounds those that claims are linear in; none
    /// if there is no such output, or if the grammar lacks the operations.
    pub fn clamped(&self, draft: &Draft, grammar: &Grammar) -> Option<Draft> {
        let mut clamped = draft.clone();
        for requirement in &self.requirements {
            let &Requirement::Range { output, low, high } = requirement else { continue };
            for o in
                (0..draft.outputs.len()).filter(|&o| output.is_none_or(|one| usize::from(one) == o))
            {
                let mut value = clamped.outputs[o];
                match clamp_of([low, high], grammar)? {
                    Clamp::Saturate => value = clamped.push(Op::Saturate, &[value]),
                    Clamp::Ends => {
                        for (op, bound) in [(Op::Max, low), (Op::Min, high)] {
                            if bound.is_finite() {
                                let bound = clamped.constant(bound);
                                value = clamped.push(op, &[value, bound]);
                            }
                        }
                    }
                }
                clamped.outputs[o] = value;
            }
        }
        self.claims.iter().for_each(|claim| claims::bound(claim, &mut clamped, grammar));
        (clamped.instrs.len() > draft.instrs.len()).then_some(clamped)
    }
}

/// How a value is kept in a range.
enum Clamp {
    Saturate,
    /// By its ends, with `max` and `min`.
    Ends,
}

/// Returns how a grammar keeps a value in a range, if it can.
fn clamp_of(range: [f32; 2], grammar: &Grammar) -> Option<Clamp> {
    if range == [0.0, 1.0] && grammar.has(Op::Saturate) {
        return Some(Clamp::Saturate);
    }
    (grammar.has(Op::Min) && grammar.has(Op::Max)).then_some(Clamp::Ends)
}

/// Returns true if the values of programs, over the inputs of a dataset, are in their ranges on both
/// splits.
pub(super) fn ranges_hold(
    ranges: &[(Program, [f32; 2])],
    dataset: &Dataset,
    evaluator: &mut Evaluator,
) -> bool {
    let inputs = dataset.inputs.len();
    [&dataset.search, &dataset.validation].into_iter().all(|split| {
        let samples = Samples::new(split, inputs);
        ranges.iter().all(|(program, [low, high])| {
            let values = evaluator.outputs(&Tape::new(program), &samples);
            values.iter().flatten().all(|value| (low..=high).contains(&value))
        })
    })
}

/// Returns true if no value of a program that must be in a range is refuted in a dataset's domain.
pub(super) fn range_is_not_refuted(
    program: &Program,
    [low, high]: [f32; 2],
    dataset: &Dataset,
) -> bool {
    let domain = Questions::of(&dataset.inputs, &[], &[]).domain;
    let bounds = [Bound::AtLeast(low.into()), Bound::AtMost(high.into())];
    let each = 0..program.outputs.len();
    let claims: Vec<_> = each.flat_map(|o| bounds.map(|bound| Property::of(o, bound))).collect();
    let limits = Limits { boxes: BOXES, ..Limits::new(Rounding::Exact) };
    let refuted = |status: &Status| matches!(status, Status::Refuted { .. });
    !claims.chunks(64).any(|some| prove(program, &domain, some, &limits).iter().any(refuted))
}

/// The boxes searched before a formula counts as not refuted. By hand.
const BOXES: usize = 2000;

/// The most rows on which half precision is tried during a search. Chosen by hand, unmeasured.
const FEW_ROWS: usize = 256;

fn samples_for(requirement: &Requirement, dataset: &Dataset) -> Vec<Samples> {
    let inputs = dataset.inputs.len();
    let whole = both_splits(dataset);
    match *requirement {
        Requirement::Monotone { input, .. } => {
            let [low, high] = dataset.inputs[usize::from(input)].domain;
            let step = ((high - low) / STEPS) as f32;
            let column = &whole.columns[usize::from(input)];
            let rows: Vec<u32> = (0..whole.rows() as u32)
                .filter(|&row| f64::from(column[row as usize] + step) <= high)
                .collect();
            if rows.is_empty() {
                return Vec::new();
            }
            let mut further = whole.clone();
            further.columns[usize::from(input)].iter_mut().for_each(|x| *x += step);
            [whole, further].iter().map(|split| Samples::of_rows(split, inputs, &rows)).collect()
        }
        Requirement::Ends { input, .. } => {
            let rows = rows_at_ends(&whole, dataset, input);
            if rows.is_empty() {
                return Vec::new();
            }
            vec![Samples::of_rows(&whole, inputs, &rows)]
        }
        _ => Vec::new(),
    }
}

/// Appends rows of another split to a split, with weight one and no dead zone.
fn with_rows(split: &Split, other: &Split, rows: &[u32]) -> Split {
    let mut extended = Split { grid: Vec::new(), ..split.clone() };
    for (to, from) in extended.columns.iter_mut().zip(&other.columns) {
        to.extend(rows.iter().map(|&row| from[row as usize]));
    }
    let length = extended.rows();
    let beside = extended.dead_zone.iter_mut().chain(&mut extended.standard_errors);
    beside.for_each(|column| column.resize(length, 0.0));
    if !extended.weights.is_empty() {
        extended.weights.resize(length, 1.0);
    }
    extended
}

fn rows_at_ends(split: &Split, dataset: &Dataset, input: u16) -> Vec<u32> {
    // Rounded as the columns' values are: 1.6 is no `f32`.
    let domain = dataset.inputs[usize::from(input)].domain.map(|end| end as f32);
    let column = &split.columns[usize::from(input)];
    let at_end = |row: &u32| domain.contains(&column[*row as usize]);
    (0..split.rows() as u32).filter(at_end).collect()
}

fn both_splits(dataset: &Dataset) -> Split {
    let columns = dataset.search.columns.iter().zip(&dataset.validation.columns);
    Split {
        columns: columns.map(|(a, b)| [a.as_slice(), b.as_slice()].concat()).collect(),
        ..Split::default()
    }
}

impl Problem {
    /// Returns true if a formula is built as required and nested as the grammar allows.
    pub(super) fn structure_ok(&self, draft: &Draft) -> bool {
        self.checks.structure_ok(draft) && self.grammar.allows_nesting(draft)
    }

    /// Returns true if the values of a draft of the search are as required on the samples.
    pub(super) fn holds_on_samples(&self, draft: &Draft, evaluator: &mut Evaluator) -> bool {
        self.checks.hold_on_samples(&self.natural(draft), evaluator)
    }

    /// Returns true if clamps are all that a formula may need to be as required, so that it can be
    /// clamped when it is good enough for the archive: no error grows where a value is moved into a
    /// range that holds the data. On the joint split-integral DFG, 30 seconds, two seeds, that is
    /// 6 % less error in the median than without requirements and 12 % less at 40 cycles; with
    /// clamps in the populations it was 3 % and 17 % more.
    pub(super) fn can_clamp(&self) -> bool {
        self.outer.is_none() && self.checks.can_clamp(&self.grammar)
    }

    /// As [`Checks::clamped`], for a draft of the search.
    pub(super) fn clamped(&self, draft: &Draft) -> Option<Draft> {
        let clamped = self.checks.clamped(&self.natural(draft), &self.grammar)?;
        Some(self.over_searched(&clamped))
    }

    /// Returns true if a formula over the dataset's own columns may be shown: it is built as
    /// required, holds on the samples, and is not refuted in the domain.
    pub(super) fn may_show(&self, program: &Program) -> bool {
        self.grammar.allows_nesting(program) && self.may_show_values(program)
    }

    /// As [`Problem::may_show`], however deep operations are nested.
    pub(super) fn may_show_values(&self, program: &Program) -> bool {
        self.checks.structure_ok(program)
            && self.checks.hold_on_samples(program, &mut Evaluator::default())
            && self.checks.not_refuted(program, &self.dataset)
    }

    /// Returns the questions by which every formula that is shown is judged.
    pub fn questions(&self) -> Questions {
        let truth =
            formula_of(&self.dataset).and_then(|text| exact_formula(&text, &self.dataset.names()));
        Questions { truth, ..self.checks.questions(&self.dataset) }
    }
}
