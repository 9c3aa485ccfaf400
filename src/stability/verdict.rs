//! The questions asked of every formula over its domain, and their outcomes.

use super::prove::prove_until;
use super::truth::{ErrorBound, ErrorLimits, largest_error_until};
use super::{Bound, Limits, Property, Rounding, Status, Stopped};
use crate::dataset::Column;
use crate::num::{Interval, inside};
use crate::op::Op;
use crate::program::{ALWAYS_ASKED, Arg, Claim, Draft, ExactProgram, Names, Program, shortest};
use crate::simplify::folded_draft;

/// The questions about a formula over a domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Questions {
    /// The values of each input: the `f32`s that its domain holds.
    pub domain: Vec<Interval>,
    /// The range that each output must stay in; an infinite end is no bound.
    pub ranges: Vec<[f64; 2]>,
    /// Claims over these inputs and outputs.
    pub claims: Vec<Claim>,
    /// The absolute amount by which a value may leave its range.
    pub slack: f64,
    /// The function in real numbers that the outputs approximate, over the same inputs, if it is
    /// known.
    pub truth: Option<ExactProgram>,
}

const FINITE: &str = ALWAYS_ASKED[0];
const RANGE: &str = ALWAYS_ASKED[1];

impl Questions {
    /// Makes the questions that a dataset's columns suggest: over the inputs' domain, an output
    /// whose domain is within [0, 1] must stay in [0, 1], and one that is never negative must not
    /// become negative. Of the claims, those over these columns are kept.
    pub fn of(inputs: &[Column], outputs: &[Column], claims: &[String]) -> Questions {
        let range = |column: &Column| match column.domain {
            [low, high] if low >= 0.0 && high <= 1.0 => [0.0, 1.0],
            [low, _] if low >= 0.0 => [0.0, f64::INFINITY],
            _ => [f64::NEG_INFINITY, f64::INFINITY],
        };
        let [input_names, output_names] =
            [inputs, outputs].map(|columns| columns.iter().map(|column| column.name.clone()));
        let names = Names::new(input_names, output_names);
        let side = |column: &Column| inside(column.domain[0], column.domain[1]);
        Questions {
            domain: inputs.iter().map(side).collect(),
            ranges: outputs.iter().map(range).collect(),
            claims: claims.iter().filter_map(|text| Claim::parse(text, &names).ok()).collect(),
            slack: Limits::new(Rounding::Exact).slack,
            truth: None,
        }
    }

    /// Returns what is to be proved of a program, in order.
    fn groups(&self, program: &Program) -> Vec<Group> {
        let outputs = 0..self.ranges.len();
        let finite = outputs.clone().map(|o| Finding::open(FINITE, Property::of(o, Bound::Finite)));
        let ranges = outputs.zip(&self.ranges).flat_map(|(o, range)| within(o, *range));
        let ranges = ranges.map(|property| Finding::open(RANGE, property));
        let plain = Group {
            program: Some(program.clone()),
            domain: self.domain.clone(),
            margin: 0.0,
            findings: finite.chain(ranges).collect(),
        };
        let claims = self.claims.iter().map(|claim| self.claimed(program, claim));
        [plain].into_iter().chain(claims).collect()
    }

    /// Returns the group of a claim. Variables in which it is linear are at the ends of their
    /// ranges, a case for each combination; others are inputs after the program's. The bounded
    /// expressions are outputs after the program's.
    fn claimed(&self, program: &Program, claim: &Claim) -> Group {
        let (mut joint, mut domain) = (program.clone().into_draft(), self.domain.clone());
        let columns = (0..domain.len() as u16).map(Arg::Input).chain(joint.outputs.iter().copied());
        let mut args: Vec<Arg> = columns.collect();
        let case = Case { expression: claim.expression.clone(), variables: Vec::new() };
        let mut cases = vec![(claim.program.clone().into_draft(), case)];
        for (name, [low, high]) in &claim.variables {
            let variable = Arg::Input(args.len() as u16);
            if is_linear(&claim.program, variable) {
                let at = |(draft, case): &(Draft, Case), end| {
                    let (mut draft, mut case) = (draft.clone(), case.clone());
                    fix(&mut draft, variable, end);
                    case.variables.push((name.clone(), Some(end)));
                    (draft, case)
                };
                cases =
                    cases.iter().flat_map(|case| [*low, *high].map(|end| at(case, end))).collect();
                args.push(variable);
            } else {
                let free = (name.clone(), None);
                cases.iter_mut().for_each(|(_, case)| case.variables.push(free.clone()));
                args.push(Arg::Input(domain.len() as u16));
                domain.push(Interval::new(*low, *high));
            }
        }
        joint.inputs = domain.len();
        let margin = if cases.len() > 1 { SUM_ROUNDING } else { 0.0 };
        let mut findings = Vec::new();
        let mut fits = true;
        for (draft, case) in cases {
            // Folding drops what is multiplied by 0: whether that is finite is asked apart.
            let draft = folded_draft(&draft);
            let longest = |draft: &Draft| draft.instrs.len().max(draft.consts.len());
            fits &= longest(&joint) + longest(&draft) <= usize::from(u16::MAX);
            if fits {
                let bounded = joint.append(&draft, &args);
                joint.outputs.extend(bounded);
            }
            findings.extend(within(joint.outputs.len() - 1, claim.range).map(|property| Finding {
                case: Some(case.clone()),
                ..Finding::open(&claim.name, property)
            }));
        }
        let program = if fits { Program::verify(joint).ok() } else { None };
        Group { program, domain, margin, findings }
    }
}

/// A program with the expressions that a claim bounds as further outputs.
#[derive(Clone, Debug)]
pub struct Bounded {
    /// The program; variables in which the claim is not linear are further inputs.
    pub program: Program,
    /// The domain of its inputs.
    pub domain: Vec<Interval>,
    /// What must hold.
    pub properties: Vec<Property>,
}

/// Returns a program over a domain with what a claim bounds; none if that is too long a program.
pub fn bounded(program: &Program, domain: &[Interval], claim: &Claim) -> Option<Bounded> {
    let (domain, ranges) = (domain.to_vec(), Vec::new());
    let questions = Questions { domain, ranges, claims: Vec::new(), slack: 0.0, truth: None };
    let Group { program, domain, findings, .. } = questions.claimed(program, claim);
    let properties = findings.iter().map(|finding| finding.property).collect();
    Some(Bounded { program: program?, domain, properties })
}

/// Returns the properties of an output that must stay in a range: its finite ends as bounds.
fn within(output: usize, [low, high]: [f64; 2]) -> impl Iterator<Item = Property> {
    let bounds = [Bound::AtLeast(low), Bound::AtMost(high)].into_iter().zip([low, high]);
    let asked = bounds.filter(|(_, end)| end.is_finite());
    asked.map(move |(bound, _)| Property::of(output, bound))
}

/// Puts a number in place of an input.
fn fix(draft: &mut Draft, input: Arg, value: f32) {
    let value = draft.constant(value);
    let Draft { instrs, outputs, .. } = draft;
    let args = instrs.iter_mut().flat_map(|instr| instr.args_mut()).chain(outputs);
    args.filter(|arg| **arg == input).for_each(|arg| *arg = value);
}

/// Returns true if a program's operations show that it is linear in an input, with a factor and a
/// rest that depend on the others only.
fn is_linear(program: &Program, input: Arg) -> bool {
    let mut degrees: Vec<u32> = Vec::new();
    let degree = |arg: &Arg, degrees: &[u32]| match arg {
        Arg::Result(i) => degrees[usize::from(*i)],
        Arg::Input(_) | Arg::Const(_) => u32::from(*arg == input),
    };
    for instr in &program.instrs {
        let of: Vec<u32> = instr.args().iter().map(|arg| degree(arg, &degrees)).collect();
        let most = of.iter().copied().max().unwrap_or(0);
        let (op, product) = (instr.op(), |i: usize, j: usize| of[i].saturating_add(of[j]));
        degrees.push(if most == 0 {
            0
        } else if matches!(op, Op::Add | Op::Sub | Op::Neg) {
            most
        } else if op == Op::Mul {
            product(0, 1)
        } else if op == Op::Mad {
            product(0, 1).max(of[2])
        } else if op == Op::Div && of[1] == 0 {
            of[0]
        } else {
            u32::MAX
        });
    }
    program.outputs.iter().all(|output| degree(output, &degrees) <= 1)
}

/// Properties of one program over one domain, decided together.
struct Group {
    /// None if it would be too long: its properties stay open.
    program: Option<Program>,
    domain: Vec<Interval>,
    /// The part of the slack that proofs may not use.
    margin: f64,
    findings: Vec<Finding>,
}

impl Group {
    fn decided(mut self, slack: f64, boxes: usize, stopped: Stopped) -> Vec<Finding> {
        let Some(program) = &self.program else { return self.findings };
        // A proof for every GPU, or a refutation, which is the interpreter's, decides both.
        for rounding in [Rounding::Gpu, Rounding::Exact] {
            let limits = Limits { rounding, slack, margin: self.margin, boxes };
            let open = |finding: &&mut Finding| matches!(finding.gpu, Status::Open { .. });
            let mut open: Vec<&mut Finding> = self.findings.iter_mut().filter(open).collect();
            for some in open.chunks_mut(64) {
                let properties: Vec<Property> = some.iter().map(|one| one.property).collect();
                let found = prove_until(program, &self.domain, &properties, &limits, stopped);
                for (finding, status) in some.iter_mut().zip(found) {
                    if rounding == Rounding::Gpu {
                        finding.gpu = status.clone();
                    }
                    finding.exact = status;
                }
            }
        }
        self.findings
    }
}

/// A case of a claim: each variable in which it is linear is at an end of its range.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The expression that is bounded.
    pub expression: String,
    /// The variables' names and values; none for one that takes any value of its range.
    pub variables: Vec<(String, Option<f32>)>,
}

/// The outcome of one property.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// `finite`, `range`, or the claim's name.
    pub topic: String,
    /// The property of an output, or of the expression that the claim bounds.
    pub property: Property,
    /// The case of the claim; none for `finite` and `range`.
    pub case: Option<Case>,
    /// The outcome in the interpreter's arithmetic.
    pub exact: Status,
    /// The outcome in any arithmetic that GPUs are allowed.
    pub gpu: Status,
}

/// The findings on a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// One finding for each property, in the order asked.
    pub findings: Vec<Finding>,
    /// The largest error of each output against the truth, if it is known: in the interpreter's
    /// arithmetic, and in any arithmetic that GPUs are allowed.
    pub errors: Vec<[ErrorBound; 2]>,
}

/// The rounding of a claim's own expression between a variable's ends, which alone are checked.
/// Chosen by hand, unmeasured.
const SUM_ROUNDING: f64 = 1e-6;

impl Verdict {
    /// Tries to prove or refute everything asked.
    ///
    /// # Panics
    /// If the program does not have as many inputs and outputs as the questions.
    pub fn of(program: &Program, questions: &Questions) -> Verdict {
        let boxes = Limits::new(Rounding::Exact).boxes;
        Verdict::within(program, questions, boxes, &|| false)
    }

    /// Judges as [`Verdict::of`] does, with at most `boxes` boxes for each proof, and leaves open
    /// what is undecided once `stopped` returns true.
    ///
    /// # Panics
    /// As [`Verdict::of`] does.
    pub fn within(
        program: &Program,
        questions: &Questions,
        boxes: usize,
        stopped: Stopped,
    ) -> Verdict {
        let groups = questions.groups(program).into_iter();
        let decided = groups.flat_map(|group| group.decided(questions.slack, boxes, stopped));
        let findings = decided.collect();
        let bound = |output, rounding, truth: &ExactProgram| {
            let limits = ErrorLimits { boxes, ..ErrorLimits::new(rounding) };
            let (truth, domain) = ((&truth.program, truth.constants.as_slice()), &questions.domain);
            largest_error_until(program, truth, output, domain, &limits, stopped)
        };
        let errors = questions.truth.iter().flat_map(|truth| {
            let each = [Rounding::Exact, Rounding::Gpu];
            (0..program.outputs.len()).map(move |o| each.map(|rounding| bound(o, rounding, truth)))
        });
        Verdict { findings, errors: errors.collect() }
    }

    /// Returns true if nothing is left open.
    pub fn is_decided(&self) -> bool {
        let open = |status: &Status| matches!(status, Status::Open { .. });
        let unbounded = self.errors.iter().flatten().any(|bound| bound.volume > 0.0);
        !unbounded
            && !self.findings.iter().any(|finding| open(&finding.exact) || open(&finding.gpu))
    }

    /// Returns the topics, each once, in the order asked.
    pub fn topics(&self) -> Vec<&str> {
        let mut topics: Vec<&str> = self.findings.iter().map(|f| f.topic.as_str()).collect();
        topics.dedup();
        topics
    }

    /// Returns the worst finding on a topic, the first of equals: refuted, else open, else proved
    /// for the interpreter only, else proved. None if the topic was not asked.
    pub fn worst(&self, topic: &str) -> Option<&Finding> {
        let rank = |finding: &Finding| match (&finding.exact, &finding.gpu) {
            (Status::Refuted { .. }, _) => 3,
            (Status::Open { .. }, _) => 2,
            (_, Status::Refuted { .. } | Status::Open { .. }) => 1,
            _ => 0,
        };
        let findings = self.findings.iter().filter(|finding| finding.topic == topic);
        // `max_by_key` returns the last of equals.
        findings.rev().max_by_key(|finding| rank(finding))
    }
}

impl Finding {
    /// Makes a finding of which nothing is known yet.
    fn open(topic: &str, property: Property) -> Finding {
        let open = Status::Open { volume: 1.0 };
        Finding { topic: topic.to_owned(), property, case: None, exact: open.clone(), gpu: open }
    }

    /// Returns the property as text, such as `scale ≥ 0`.
    pub fn text(&self, names: &Names) -> String {
        let what = match &self.case {
            Some(case) => &case.expression,
            None => &names.outputs[self.property.output],
        };
        match self.property.bound {
            Bound::Finite => format!("{what} finite"),
            Bound::AtLeast(low) => format!("{what} ≥ {}", shortest(low)),
            Bound::AtMost(high) => format!("{what} ≤ {}", shortest(high)),
        }
    }

    /// Returns the given values of a claim's variables, such as ` (f0 = 0)`, or an empty text.
    pub fn given(&self) -> String {
        let variables = self.case.iter().flat_map(|case| &case.variables);
        let given = variables.filter_map(|(name, value)| Some(format!("{name} = {}", (*value)?)));
        match given.collect::<Vec<_>>().join(", ") {
            none if none.is_empty() => none,
            given => format!(" ({given})"),
        }
    }

    /// Returns a counterexample's inputs and the claim's variables, by name.
    pub fn named(&self, names: &Names, input: &[f32]) -> Vec<(String, f32)> {
        let mut values = input.iter().copied();
        let inputs: Vec<_> = names.inputs.iter().cloned().zip(values.by_ref()).collect();
        let variables = self.case.iter().flat_map(|case| &case.variables);
        let variables = variables
            .filter_map(|(name, given)| Some((name.clone(), given.or_else(|| values.next())?)));
        inputs.into_iter().chain(variables).collect()
    }
}
