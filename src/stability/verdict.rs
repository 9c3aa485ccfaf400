//! What is asked of a formula as a rule, and what became of it.

use super::prove::prove_until;
use super::{Bound, Limits, Property, Rounding, Status, Stopped};
use crate::dataset::Column;
use crate::num::{Interval, inside};
use crate::op::Op;
use crate::program::{ALWAYS_ASKED, Arg, Claim, Draft, Names, Program, shortest};
use crate::simplify::folded_draft;

/// What is asked of a formula over a domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Questions {
    /// What each input can be: the numbers of `f32` that its domain holds.
    pub domain: Vec<Interval>,
    /// For each output, what it must not leave; infinite where it may.
    pub ranges: Vec<[f64; 2]>,
    /// Over these inputs and outputs.
    pub claims: Vec<Claim>,
    /// By how much a value may leave its range.
    pub slack: f64,
}

const FINITE: &str = ALWAYS_ASKED[0];
const RANGE: &str = ALWAYS_ASKED[1];

impl Questions {
    /// What the columns of a dataset suggest: over the inputs' domain, an output whose domain is within
    /// [0, 1] must stay there, and one that is never negative must not be; and of the claims those that are
    /// over these columns.
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
        }
    }

    /// What is to be proved of a program, in order.
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

    /// A claim where the variables that it is linear in are at the ends of their ranges, the others being inputs
    /// after those of the program. What it bounds are outputs after those of the program.
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
            // Where a factor is 0, the other does not matter: whether it is a number is asked apart.
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

/// The bounds of an output that must stay in a range.
fn within(output: usize, [low, high]: [f64; 2]) -> impl Iterator<Item = Property> {
    let bounds = [Bound::AtLeast(low), Bound::AtMost(high)].into_iter().zip([low, high]);
    let asked = bounds.filter(|(_, end)| end.is_finite());
    asked.map(move |(bound, _)| Property::of(output, bound))
}

/// Puts a number in an input's place.
fn fix(draft: &mut Draft, input: Arg, value: f32) {
    let value = draft.constant(value);
    let Draft { instrs, outputs, .. } = draft;
    let args = instrs.iter_mut().flat_map(|instr| instr.args_mut()).chain(outputs);
    args.filter(|arg| **arg == input).for_each(|arg| *arg = value);
}

/// Whether a program is linear in an input, with a factor and a rest that are of the others, as far as its
/// operations show it.
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

/// Properties of one program over one domain, decided together; no program where it would be too long.
struct Group {
    program: Option<Program>,
    domain: Vec<Interval>,
    margin: f64,
    findings: Vec<Finding>,
}

impl Group {
    fn decided(mut self, slack: f64, boxes: usize, stopped: Stopped) -> Vec<Finding> {
        let Some(program) = &self.program else { return self.findings };
        // What holds for every GPU holds for the interpreter, and what it refutes it does.
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

/// A claim where some of its variables are at an end of their range.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The expression that is bounded.
    pub expression: String,
    /// Names and values; none of those that are anything in their range.
    pub variables: Vec<(String, Option<f32>)>,
}

/// What became of one property.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// `finite`, `range`, or the claim's name.
    pub topic: String,
    /// Of an output, or of what the case of a claim bounds.
    pub property: Property,
    /// The values of the claim's variables.
    pub case: Option<Case>,
    /// In the interpreter's arithmetic.
    pub exact: Status,
    /// In any that GPUs are allowed.
    pub gpu: Status,
}

/// What is known of a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// One finding a claim and case.
    pub findings: Vec<Finding>,
}

/// The rounding of a claim's expression itself between the ends of a variable, which looking at them leaves out.
const SUM_ROUNDING: f64 = 1e-6;

impl Verdict {
    /// Tries to prove or refute everything asked.
    ///
    /// # Panics
    /// If the program has other numbers of inputs and outputs than the questions.
    pub fn of(program: &Program, questions: &Questions) -> Verdict {
        let boxes = Limits::new(Rounding::Exact).boxes;
        Verdict::within(program, questions, boxes, &|| false)
    }

    /// [`Verdict::of`], with no more than so many boxes for each proof, and until it is told to stop:
    /// what is undecided then is open.
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
        Verdict { findings: decided.collect() }
    }

    /// Whether nothing is left open.
    pub fn is_decided(&self) -> bool {
        let open = |status: &Status| matches!(status, Status::Open { .. });
        !self.findings.iter().any(|finding| open(&finding.exact) || open(&finding.gpu))
    }

    /// What was asked, in order, each once.
    pub fn topics(&self) -> Vec<&str> {
        let mut topics: Vec<&str> = self.findings.iter().map(|f| f.topic.as_str()).collect();
        topics.dedup();
        topics
    }

    /// Of one topic the finding that matters: refuted, else open, else proved; nothing where nothing
    /// was asked.
    pub fn worst(&self, topic: &str) -> Option<&Finding> {
        let rank = |finding: &Finding| match (&finding.exact, &finding.gpu) {
            (Status::Refuted { .. }, _) => 3,
            (Status::Open { .. }, _) => 2,
            (_, Status::Refuted { .. } | Status::Open { .. }) => 1,
            _ => 0,
        };
        let findings = self.findings.iter().filter(|finding| finding.topic == topic);
        // Of equals the first.
        findings.rev().max_by_key(|finding| rank(finding))
    }
}

impl Finding {
    /// Of which nothing is known.
    fn open(topic: &str, property: Property) -> Finding {
        let open = Status::Open { volume: 1.0 };
        Finding { topic: topic.to_owned(), property, case: None, exact: open.clone(), gpu: open }
    }

    /// The property in words, as `scale ≥ 0`.
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

    /// The values of a claim's variables that are given, as ` (f0 = 0)`; or nothing.
    pub fn given(&self) -> String {
        let variables = self.case.iter().flat_map(|case| &case.variables);
        let given = variables.filter_map(|(name, value)| Some(format!("{name} = {}", (*value)?)));
        match given.collect::<Vec<_>>().join(", ") {
            none if none.is_empty() => none,
            given => format!(" ({given})"),
        }
    }

    /// An input at which it was refuted by name, with the values of the claim's variables.
    pub fn named(&self, names: &Names, input: &[f32]) -> Vec<(String, f32)> {
        let mut values = input.iter().copied();
        let inputs: Vec<_> = names.inputs.iter().cloned().zip(values.by_ref()).collect();
        let variables = self.case.iter().flat_map(|case| &case.variables);
        let variables = variables
            .filter_map(|(name, given)| Some((name.clone(), given.or_else(|| values.next())?)));
        inputs.into_iter().chain(variables).collect()
    }
}
