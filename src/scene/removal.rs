//! Removals: cheaper programs with an operation or argument taken out.

use crate::cost::{CostScratch, Profile};
use crate::eval::{Evaluator, Samples, Tape};
use crate::op::Op;
use crate::program::{Arg, Constants, Draft, Program, structural_hash};
use crate::simplify::Simplifier;
use std::collections::HashSet;

/// A cheaper draft whose constants are not fitted yet.
#[derive(Clone, Debug)]
pub(super) struct Removal {
    pub draft: Draft,
    pub cost: f64,
    pub what: String,
}

/// The values of a draft's inputs and results on samples.
struct Statistics {
    results: Vec<Vec<f32>>,
    inputs: Vec<Vec<f32>>,
}

/// Returns every cheaper draft that one removal gives, each structure once: a result is replaced by
/// one of its arguments or by its mean, an argument by its mean, an expensive operation by a
/// straight line or a simpler operation.
pub(super) fn removals(draft: &Draft, samples: &Samples, profile: &Profile) -> Vec<Removal> {
    let Some(statistics) = Statistics::of(draft, samples) else { return Vec::new() };
    let (mut scratch, mut hashes) = (CostScratch::default(), Vec::new());
    let mut simplifier = Simplifier::default();
    let cost = profile.cycles(draft, &mut scratch);
    let mut known = HashSet::new();
    let mut found = Vec::new();
    for at in 0..draft.instrs.len() {
        for (what, removed) in at_instruction(draft, at, &statistics, profile) {
            let mut simple = Draft::default();
            simplifier.simplify(&removed, &mut simple);
            let cheaper = profile.cycles(&simple, &mut scratch);
            let hash = structural_hash(&simple, Constants::Ignored, &mut hashes);
            let finite = simple.consts.iter().all(|c| c.is_finite());
            if cheaper < cost && finite && known.insert(hash) {
                found.push(Removal { draft: apart(&simple), cost: cheaper, what });
            }
        }
    }
    found
}

fn at_instruction(
    draft: &Draft,
    at: usize,
    statistics: &Statistics,
    profile: &Profile,
) -> Vec<(String, Draft)> {
    let instr = draft.instrs[at];
    let (op, args) = (instr.op(), instr.args());
    let mut found = Vec::new();
    let mut offer = |what: String, make: &dyn Fn(&mut Draft, &[Arg]) -> Arg| {
        found.push((what, rebuilt(draft, at, make)));
    };
    let mean = statistics.mean(Arg::Result(at as u16));
    offer(format!("{op} replaced by a constant"), &|new, _| new.constant(mean));
    for place in (0..args.len()).filter(|&place| !matches!(args[place], Arg::Const(_))) {
        offer(dropped(op), &|_, args| args[place]);
        let mean = statistics.mean(args[place]);
        offer(format!("an argument of {op} replaced by a constant"), &|new, args| {
            let mut args = args.to_vec();
            args[place] = new.constant(mean);
            new.push(op, &args)
        });
        if profile.of(op) > DEAR
            && let Some([slope, intercept]) =
                line(&statistics.results[at], statistics.values(args[place]))
        {
            offer(format!("{op} replaced by a straight line"), &|new, args| {
                let (slope, intercept) = (new.constant(slope), new.constant(intercept));
                new.push(Op::Mad, &[args[place], slope, intercept])
            });
        }
    }
    if op == Op::Div && !matches!(args[1], Arg::Const(_)) {
        let inverse: Vec<f32> = statistics.values(args[1]).iter().map(|b| 1.0 / b).collect();
        if let Some([slope, intercept]) = line(&inverse, statistics.values(args[1])) {
            offer("a division replaced by a straight line".to_owned(), &|new, args| {
                let (slope, intercept) = (new.constant(slope), new.constant(intercept));
                let inverse = new.push(Op::Mad, &[args[1], slope, intercept]);
                new.push(Op::Mul, &[args[0], inverse])
            });
        }
    }
    if op == Op::Pow {
        offer("pow replaced by a square".to_owned(), &|new, args| {
            new.push(Op::Mul, &[args[0], args[0]])
        });
        offer("pow replaced by a root".to_owned(), &|new, args| new.push(Op::Sqrt, &[args[0]]));
        if !matches!(args[0], Arg::Const(_)) {
            let base = statistics.mean(args[0]).max(f32::MIN_POSITIVE).log2();
            offer("pow replaced by exp2".to_owned(), &|new, args| {
                let rate = new.constant(base);
                let exponent = new.push(Op::Mul, &[args[1], rate]);
                new.push(Op::Exp2, &[exponent])
            });
        }
    }
    found
}

/// Returns the words for replacing an operation by one of its arguments.
fn dropped(op: Op) -> String {
    match op {
        Op::Add | Op::Sub => "a term of a sum dropped".to_owned(),
        Op::Mul => "a factor dropped".to_owned(),
        Op::Div => "a division dropped".to_owned(),
        op => format!("{op} dropped"),
    }
}

/// The cycles above which an operation is expensive. Chosen by hand, unmeasured.
const DEAR: f64 = 1.5;

/// Remakes one instruction: `make` returns the replacement of its result, given its arguments.
fn rebuilt(draft: &Draft, at: usize, make: &dyn Fn(&mut Draft, &[Arg]) -> Arg) -> Draft {
    draft.rewritten(|new, i, instr| match i == at {
        true => make(new, instr.args()),
        false => new.push_instr(instr),
    })
}

/// Gives every use of a constant a constant of its own, so that they are fitted separately.
pub(super) fn apart(draft: &Draft) -> Draft {
    let mut new = draft.clone();
    new.unshare_constants();
    new
}

impl Statistics {
    fn of(draft: &Draft, samples: &Samples) -> Option<Statistics> {
        let all = |args: Vec<Arg>| -> Option<Vec<Vec<f32>>> {
            if args.is_empty() {
                return Some(Vec::new());
            }
            let program = Program::verify(Draft { outputs: args, ..draft.clone() }).ok()?;
            Some(Evaluator::default().outputs(&Tape::new(&program), samples))
        };
        Some(Statistics {
            results: all((0..draft.instrs.len()).map(|i| Arg::Result(i as u16)).collect())?,
            inputs: all((0..draft.inputs).map(|i| Arg::Input(i as u16)).collect())?,
        })
    }

    fn values(&self, arg: Arg) -> &[f32] {
        match arg {
            Arg::Input(i) => &self.inputs[usize::from(i)],
            Arg::Result(i) => &self.results[usize::from(i)],
            Arg::Const(_) => &[],
        }
    }

    fn mean(&self, arg: Arg) -> f32 {
        let values = self.values(arg);
        (values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len() as f64) as f32
    }
}

/// Returns slope and intercept of the least-squares line of `ys` on `xs`; none if not finite.
fn line(ys: &[f32], xs: &[f32]) -> Option<[f32; 2]> {
    let n = ys.len() as f64;
    let mean = |values: &[f32]| values.iter().map(|&v| f64::from(v)).sum::<f64>() / n;
    let (x0, y0) = (mean(xs), mean(ys));
    let (mut xx, mut xy) = (0.0, 0.0);
    for (&x, &y) in xs.iter().zip(ys) {
        xx += (f64::from(x) - x0).powi(2);
        xy += (f64::from(x) - x0) * (f64::from(y) - y0);
    }
    let slope = xy / xx;
    let found = [slope as f32, (y0 - slope * x0) as f32];
    found.iter().all(|value| value.is_finite()).then_some(found)
}
