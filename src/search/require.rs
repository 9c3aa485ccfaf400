//! What every formula of a search must be, whatever its error.

use super::Problem;
use crate::dataset::{Dataset, Split};
use crate::eval::{Evaluator, Samples, Tape, Values};
use crate::op::Op;
use crate::program::{Arg, Draft, Names, Program};
use crate::suggest::did_you_mean;
use serde::{Deserialize, Serialize};

/// A condition on formulas. Those on values are checked on samples: what holds there may fail between
/// them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Requirement {
    /// No output, or not this one, leaves the range.
    Range { output: Option<u16>, low: f32, high: f32 },
    /// All outputs, or this one, never fall, or never rise, as an input grows.
    Monotone { output: Option<u16>, input: u16, rising: bool },
    /// All outputs, or this one, meet the data to 1e-5 where an input is at either end of its
    /// domain, and the dataset has a sample there.
    Ends { output: Option<u16>, input: u16 },
    /// The formula has this operation.
    Operation(Op),
    /// The formula reads this input.
    Input(u16),
}

/// How far a value may be off where it must be exact.
const EXACT: f32 = 1e-5;

/// What the samples at the ends weigh, against 1 for others.
const WEIGHT_OF_ENDS: f32 = 1e4;

/// Steps over an input's domain, between the ends of which a monotone output is compared, and the rounding
/// that is forgiven.
const STEPS: f64 = 64.0;
const ROUNDING: f32 = 1e-6;

impl Requirement {
    /// Reads `range=0..1`, `rising=INPUT`, `falling=INPUT`, `ends=INPUT`, `uses=OPERATION` or
    /// `uses=INPUT`; an output's name and a dot before it make it that output's alone.
    ///
    /// # Errors
    /// What is wrong with the text, and what may stand there.
    pub fn parse(text: &str, names: &Names) -> Result<Requirement, String> {
        let wanted = "give range=LOW..HIGH, rising=INPUT, falling=INPUT, ends=INPUT or uses=NAME, an output's name and a dot before it if it is for one output";
        let (key, value) = text.split_once('=').ok_or_else(|| format!("`{text}`: {wanted}"))?;
        let (output, key) = match key.split_once('.') {
            Some((output, key)) => (Some(place(output, &names.outputs, "output")?), key),
            None => (None, key),
        };
        let input = || place(value, &names.inputs, "input");
        match key {
            "range" => {
                let ends = value.split_once("..").and_then(|(low, high)| {
                    Some((low.parse().ok()?, high.parse().ok()?)).filter(|(low, high)| low < high)
                });
                let (low, high) =
                    ends.ok_or_else(|| format!("`{text}`: a range is LOW..HIGH, as in 0..1"))?;
                Ok(Requirement::Range { output, low, high })
            }
            "rising" | "falling" => {
                Ok(Requirement::Monotone { output, input: input()?, rising: key == "rising" })
            }
            "ends" => Ok(Requirement::Ends { output, input: input()? }),
            "uses" => match Op::from_name(value) {
                Some(op) => Ok(Requirement::Operation(op)),
                None => Ok(Requirement::Input(input()?)),
            },
            _ => Err(format!("`{text}`: {wanted}")),
        }
    }
}

impl Requirement {
    /// What [`Requirement::parse`] reads as this.
    pub fn text(&self, names: &Names) -> String {
        let of = |output: Option<u16>| {
            output.map_or_else(String::new, |o| format!("{}.", names.outputs[usize::from(o)]))
        };
        let input = |input: u16| &names.inputs[usize::from(input)];
        match *self {
            Requirement::Range { output, low, high } => {
                format!("{}range={low}..{high}", of(output))
            }
            Requirement::Monotone { output, input: along, rising } => {
                let direction = if rising { "rising" } else { "falling" };
                format!("{}{direction}={}", of(output), input(along))
            }
            Requirement::Ends { output, input: along } => {
                format!("{}ends={}", of(output), input(along))
            }
            Requirement::Operation(op) => format!("uses={}", op.name()),
            Requirement::Input(read) => format!("uses={}", input(read)),
        }
    }
}

fn place(name: &str, names: &[String], kind: &str) -> Result<u16, String> {
    names.iter().position(|known| known == name).map(|at| at as u16).ok_or_else(|| {
        let meant = did_you_mean(name, names.iter().map(String::as_str));
        format!("there is no {kind} `{name}`{meant}")
    })
}

/// A problem's requirements, with the samples on which they are checked.
#[derive(Clone, Debug)]
pub(super) struct Checks {
    requirements: Vec<Requirement>,
    /// For each requirement: its samples, and where outputs are compared, those a step further.
    samples: Vec<Vec<Samples>>,
}

impl Checks {
    pub fn new(requirements: &[Requirement], dataset: &Dataset) -> Checks {
        let samples = requirements.iter().map(|requirement| samples_for(requirement, dataset));
        Checks { samples: samples.collect(), requirements: requirements.to_vec() }
    }

    /// Whether a formula is built as required; its values are not looked at.
    pub fn admits(&self, draft: &Draft) -> bool {
        self.requirements.iter().all(|requirement| match *requirement {
            Requirement::Operation(wanted) => draft.instrs.iter().any(|instr| instr.op() == wanted),
            Requirement::Input(wanted) => {
                let args = draft.instrs.iter().flat_map(|instr| instr.args());
                args.chain(&draft.outputs).any(|&arg| arg == Arg::Input(wanted))
            }
            _ => true,
        })
    }

    /// Whether a formula's values are as required on the samples.
    pub fn hold(&self, draft: &Draft, evaluator: &mut Evaluator) -> bool {
        if self.samples.iter().all(Vec::is_empty) {
            return true;
        }
        let Ok(program) = Program::verify(draft.clone()) else { return false };
        let tape = Tape::new(&program);
        let mut values = |samples: &Samples| {
            let mut values = Values::default();
            evaluator.outputs_into(&tape, samples, &mut values);
            values
        };
        self.requirements.iter().zip(&self.samples).all(|(requirement, samples)| {
            let holds = |output: Option<u16>, test: &dyn Fn(usize) -> bool| match output {
                Some(output) => test(usize::from(output)),
                None => (0..program.outputs.len()).all(test),
            };
            match (requirement, samples.as_slice()) {
                (&Requirement::Range { output, low, high }, [samples]) => {
                    let values = values(samples);
                    let within = |value: &f32| (low..=high).contains(value);
                    holds(output, &|o| values.column(o).iter().all(within))
                }
                (&Requirement::Monotone { output, rising, .. }, [here, further]) => {
                    let (here, further) = (values(here), values(further));
                    let ordered = |(a, b): (&f32, &f32)| match rising {
                        true => *b >= a - ROUNDING,
                        false => *b <= a + ROUNDING,
                    };
                    holds(output, &|o| here.column(o).iter().zip(further.column(o)).all(ordered))
                }
                (&Requirement::Ends { output, .. }, [samples]) => {
                    let values = values(samples);
                    let exact = |(f, y): (&f32, &f32)| (f - y).abs() <= EXACT;
                    holds(output, &|o| values.column(o).iter().zip(samples.targets(o)).all(exact))
                }
                _ => true,
            }
        })
    }
}

fn samples_for(requirement: &Requirement, dataset: &Dataset) -> Vec<Samples> {
    let inputs = dataset.inputs.len();
    let whole = both_splits(dataset);
    match *requirement {
        Requirement::Range { .. } => vec![Samples::new(&whole, inputs)],
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

/// The search split, and at the ends that must be exact the validation split's rows, weighing more.
pub(super) fn with_ends(dataset: &Dataset, requirements: &[Requirement]) -> Split {
    let mut split = dataset.search.clone();
    for requirement in requirements {
        let &Requirement::Ends { input, .. } = requirement else { continue };
        let whole = both_splits(dataset);
        split.weights = (0..split.rows()).map(|row| split.weight(row)).collect();
        for row in rows_at_ends(&whole, dataset, input) {
            for (to, from) in split.columns.iter_mut().zip(&whole.columns) {
                to.push(from[row as usize]);
            }
            split.weights.push(WEIGHT_OF_ENDS);
            split.free.iter_mut().for_each(|free| free.push(0.0));
        }
        split.grid.clear();
    }
    split
}

fn rows_at_ends(split: &Split, dataset: &Dataset, input: u16) -> Vec<u32> {
    let domain = dataset.inputs[usize::from(input)].domain;
    let column = &split.columns[usize::from(input)];
    let at_end = |row: &u32| domain.contains(&f64::from(column[*row as usize]));
    (0..split.rows() as u32).filter(at_end).collect()
}

fn both_splits(dataset: &Dataset) -> Split {
    let columns = dataset.search.columns.iter().zip(&dataset.validation.columns);
    Split {
        columns: columns.map(|(a, b)| [a.as_slice(), b.as_slice()].concat()).collect(),
        ..Split::default()
    }
}

impl Problem<'_> {
    /// Whether a formula is built as required, and as the grammar allows.
    pub(super) fn admits(&self, draft: &Draft) -> bool {
        self.checks.admits(draft)
            && self.grammar.allows_nesting(draft)
            && self.transforms().all(|(output, transform)| transform.is_undone(draft, output))
    }

    /// Whether a formula that is to be shown is as required.
    pub(super) fn accepts(&self, draft: &Draft) -> bool {
        self.admits(draft) && self.checks.hold(draft, &mut Evaluator::default())
    }
}
