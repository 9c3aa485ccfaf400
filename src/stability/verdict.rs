//! What is asked of a formula as a rule, and what became of it.

use super::{Bound, Claim, Limits, Rounding, Status, Stopped, prove_until};
use crate::dataset::Column;
use crate::num::{Interval, inside};
use crate::op::Op;
use crate::program::{Names, Program, shortest};

/// What a claim is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Topic {
    Finite,
    Range,
    /// No more light leaves than falls in, whatever the reflectance at normal incidence.
    Energy,
}

/// What is asked of a formula over a domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Questions {
    /// What each input can be: the numbers of `f32` that its domain holds.
    pub domain: Vec<Interval>,
    /// For each output, what it must not leave; infinite where it may.
    pub ranges: Vec<[f64; 2]>,
    /// Outputs `scale` and `bias` of which `f0·scale + bias ≤ 1` is asked for f0 in [0, 1].
    pub energy: Option<[usize; 2]>,
    pub slack: f64,
}

impl Questions {
    /// What the columns of a dataset suggest: over the inputs' domain, an output whose domain is within
    /// [0, 1] must stay there, and one that is never negative must not be; energy where outputs are
    /// called `scale` and `bias`.
    pub fn of(inputs: &[Column], outputs: &[Column]) -> Questions {
        let range = |column: &Column| match column.domain {
            [low, high] if low >= 0.0 && high <= 1.0 => [0.0, 1.0],
            [low, _] if low >= 0.0 => [0.0, f64::INFINITY],
            _ => [f64::NEG_INFINITY, f64::INFINITY],
        };
        let place = |name: &str| outputs.iter().position(|column| column.name == name);
        Questions {
            domain: inputs
                .iter()
                .map(|column| inside(column.domain[0], column.domain[1]))
                .collect(),
            ranges: outputs.iter().map(range).collect(),
            energy: place("scale").zip(place("bias")).map(|(scale, bias)| [scale, bias]),
            slack: Limits::new(Rounding::Exact).slack,
        }
    }

    /// The claims in order, those on `f0·scale + bias` where f0 is 0 and 1: it is linear in f0. The
    /// sum is an output after those of the program.
    fn claims(&self) -> Vec<(Topic, Claim)> {
        let outputs = self.ranges.len();
        let mut claims = Vec::new();
        for output in 0..outputs {
            claims.push((Topic::Finite, Claim::of(output, Bound::Finite)));
        }
        for (output, [low, high]) in self.ranges.iter().copied().enumerate() {
            if low.is_finite() {
                claims.push((Topic::Range, Claim::of(output, Bound::AtLeast(low))));
            }
            if high.is_finite() {
                claims.push((Topic::Range, Claim::of(output, Bound::AtMost(high))));
            }
        }
        if let Some([_, bias]) = self.energy {
            claims.push((Topic::Energy, Claim::of(bias, Bound::AtMost(1.0))));
            claims.push((Topic::Energy, Claim::of(outputs, Bound::AtMost(1.0))));
        }
        claims
    }
}

/// What became of one claim.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    pub topic: Topic,
    /// On an output, or the sum of scale and bias after the last.
    pub claim: Claim,
    /// In the interpreter's arithmetic.
    pub exact: Status,
    /// In any that GPUs are allowed.
    pub gpu: Status,
}

/// What is known of a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    pub findings: Vec<Finding>,
}

/// The rounding of `f0·scale + bias` itself, which a claim on it where f0 is 0 and 1 leaves out.
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
        let program = with_sum(program, questions.energy);
        let claims = questions.claims();
        let topics: Vec<Topic> = claims.iter().map(|(topic, _)| *topic).collect();
        let decide = |rounding: Rounding, of_energy: bool, left: &[bool]| -> Vec<Option<Status>> {
            let margin = if of_energy { SUM_ROUNDING } else { 0.0 };
            let limits = Limits { rounding, slack: questions.slack, margin, boxes };
            let wanted = |i: &usize| left[*i] && (topics[*i] == Topic::Energy) == of_energy;
            let places: Vec<usize> = (0..claims.len()).filter(wanted).collect();
            let mut decided = vec![None; claims.len()];
            for places in places.chunks(64) {
                let some: Vec<Claim> = places.iter().map(|&i| claims[i].1).collect();
                let found = prove_until(&program, &questions.domain, &some, &limits, stopped);
                places.iter().zip(found).for_each(|(&i, status)| decided[i] = Some(status));
            }
            decided
        };
        let both = |rounding: Rounding, left: &[bool]| -> Vec<Option<Status>> {
            let pairs = decide(rounding, false, left).into_iter().zip(decide(rounding, true, left));
            pairs.map(|(plain, energy)| plain.or(energy)).collect()
        };
        // What holds for every GPU holds for the interpreter, and what it refutes it does.
        let gpu = both(Rounding::Gpu, &vec![true; claims.len()]);
        let open = |status: &Option<Status>| matches!(status, Some(Status::Open { .. }));
        let left: Vec<bool> = gpu.iter().map(open).collect();
        let exact = both(Rounding::Exact, &left);
        let finding = |((&(topic, claim), gpu), exact): ((&(Topic, Claim), Option<Status>), _)| {
            let gpu = gpu.expect("every claim was looked at");
            Finding { topic, claim, exact: Option::unwrap_or(exact, gpu.clone()), gpu }
        };
        Verdict { findings: claims.iter().zip(gpu).zip(exact).map(finding).collect() }
    }

    /// Whether nothing is left open.
    pub fn is_decided(&self) -> bool {
        let open = |status: &Status| matches!(status, Status::Open { .. });
        !self.findings.iter().any(|finding| open(&finding.exact) || open(&finding.gpu))
    }

    /// Of one topic the finding that matters: refuted, else open, else proved; nothing where nothing
    /// was asked.
    pub fn worst(&self, topic: Topic) -> Option<&Finding> {
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
    /// The claim in words, as `scale ≥ 0`.
    pub fn text(&self, names: &Names) -> String {
        let what = match (self.topic, names.outputs.get(self.claim.output)) {
            (Topic::Energy, _) => "f0*scale + bias",
            (_, Some(name)) => name,
            (_, None) => "scale + bias",
        };
        match self.claim.bound {
            Bound::Finite => format!("{what} finite"),
            Bound::AtLeast(low) => format!("{what} ≥ {}", shortest(low)),
            Bound::AtMost(high) => format!("{what} ≤ {}", shortest(high)),
        }
    }

    /// What f0 is in this claim.
    pub fn f0(&self, names: &Names) -> Option<f32> {
        let sum = self.claim.output >= names.outputs.len();
        (self.topic == Topic::Energy).then_some(if sum { 1.0 } else { 0.0 })
    }
}

/// The program with the sum of two outputs after its own.
fn with_sum(program: &Program, energy: Option<[usize; 2]>) -> Program {
    let Some([scale, bias]) = energy else { return program.clone() };
    let mut draft = program.clone().into_draft();
    let sum = draft.push(Op::Add, &[draft.outputs[scale], draft.outputs[bias]]);
    draft.outputs.push(sum);
    program.or_longer(draft)
}
