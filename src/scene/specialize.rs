//! Formulas without what a scene makes superfluous.

use super::combine::folded;
use super::idle::{Evidence, first_idle};
use super::removal::{Removal, apart, removals};
use super::{View, idle};
use crate::archive::undominated;
use crate::cost::{CostScratch, Profile};
use crate::dataset::{Dataset, joint_unit, output_units};
use crate::eval::Samples;
use crate::fit::{Fitter, Measure, Stop, drop_negligible, shorten};
use crate::op::Op;
use crate::program::{Constants, Draft, Program, effective, structural_hash};
use crate::simplify::tidy;
use rayon::prelude::*;
use std::cmp::Ordering;
use std::collections::HashSet;

/// What was done to a formula.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Nothing: fixed inputs are constants, outputs are combined.
    Given,
    /// Constants folded, and what algebra does to what is left.
    Folded,
    /// An operation that never acts is gone.
    Idle(Op, Evidence),
    /// Constants fitted to the scene.
    Refitted,
    /// A term is gone, the constants fitted again.
    Removed(String),
}

/// A formula on the way to a cheaper one, over the view's columns.
#[derive(Clone, Debug)]
pub struct Step {
    /// The change that led here.
    pub change: Change,
    /// The formula after it.
    pub program: Program,
    /// Its cycles.
    pub cost: f64,
}

/// What became of a formula.
#[derive(Clone, Debug, Default)]
pub struct Specialization {
    /// From the formula as it was given to what is left in the end.
    pub steps: Vec<Step>,
    /// Formulas beside the way that were better at their cost.
    pub others: Vec<Program>,
}

/// A first look at a removal, on some samples; and the fit of what is promising, on all.
const FIRST_LOOK: Stop = Stop { max_steps: 5, min_gain: 1e-3 };
const SECOND_LOOK: Stop = Stop { max_steps: 40, min_gain: 1e-4 };
const TO_CONVERGENCE: Stop = Stop { max_steps: 200, min_gain: 1e-7 };

const SUBSET: usize = 512;
/// Removals that are looked at twice.
const PROMISING: usize = 24;

/// Cycles that a removal gets credit for. The last step, to a constant, would look cheap too early.
const MAX_CREDITED: f64 = 4.0;

/// Formulas beside the way whose removals are looked at, at most.
const EXPANSIONS: usize = 200;

/// As in a search's fronts.
const SHORTENING_ALLOWANCE: f64 = 0.004;

/// Root mean square below which one error is as good as another.
const NEGLIGIBLE: f64 = 1e-7;

/// Specialises a formula over the whole dataset's inputs, for the outputs of it that are named, to
/// what a view leaves (`dataset`, perhaps with fewer outputs). First what costs no accuracy: constants are
/// folded, operations that never act dropped. Then constants are fitted; then terms are removed one
/// after the other, each time the one that raises the error least for the cycles it saves, the
/// constants fitted again, until nothing is left or the error (root mean square, in `measure`)
/// exceeds `limit`; and from the best formulas beside that way in the same manner. Nothing where the formula lacks an output that is needed.
///
/// # Panics
/// As [`View::program`], or if `dataset` has other inputs than the view.
pub fn specialize(
    view: &View,
    formula: &Program,
    defined: &[String],
    dataset: &Dataset,
    profile: &Profile,
    measure: Measure,
    limit: f64,
) -> Option<Specialization> {
    let wanted = dataset.names().outputs;
    let given = view.substituted(formula, defined, &wanted)?;
    let given = effective(&Program::verify(given).ok()?);
    let mut work = Work::new(dataset, profile, measure);
    work.note(Change::Given, given.clone());
    let mut program = folded(&given)?;
    work.note_if_cheaper(Change::Folded, &program);
    while let Some(idle::Idle { op, evidence, program: without }) = first_idle(&program, dataset) {
        program = folded(&without)?;
        work.note(Change::Idle(op, evidence), program.clone());
    }
    work.remove_terms(program, limit);
    Some(work.finished())
}

fn hash(draft: &Draft) -> u64 {
    structural_hash(draft, Constants::Ignored, &mut Vec::new())
}

struct Work<'a> {
    profile: &'a Profile,
    all: Samples,
    subset: Samples,
    /// Of errors over all outputs, by which losses are divided.
    unit: f64,
    steps: Vec<Step>,
    /// How many of the steps' constants are the formula's own.
    unfitted: usize,
    /// Fitted, with cost and loss.
    seen: Vec<(f64, f64, Draft)>,
    /// Structures whose removals were looked at.
    expanded: HashSet<u64>,
}

impl<'a> Work<'a> {
    fn new(dataset: &Dataset, profile: &'a Profile, measure: Measure) -> Work<'a> {
        let (split, inputs) = (&dataset.search, dataset.inputs.len());
        let units = output_units(&dataset.outputs);
        let apart = split.rows().div_ceil(SUBSET).max(1);
        let rows: Vec<u32> = (0..split.rows() as u32).step_by(apart | 1).collect();
        Work {
            profile,
            all: measure.all_samples(split, inputs, &units),
            subset: measure.samples(split, inputs, &rows, &units),
            unit: joint_unit(&units),
            steps: Vec::new(),
            unfitted: 0,
            seen: Vec::new(),
            expanded: HashSet::new(),
        }
    }

    fn cost(&self, draft: &Draft) -> f64 {
        self.profile.cycles(draft, &mut CostScratch::default())
    }

    fn note(&mut self, change: Change, program: Program) {
        let cost = self.cost(&program);
        self.steps.push(Step { change, program, cost });
        self.unfitted = self.steps.len();
    }

    fn note_if_cheaper(&mut self, change: Change, program: &Program) {
        if self.steps.last().is_none_or(|last| self.cost(program) < last.cost) {
            self.note(change, program.clone());
        }
    }

    /// What makes losses comparable.
    fn negligible(&self) -> f64 {
        NEGLIGIBLE.powi(2) * self.all.total_weight()
    }

    fn remove_terms(&mut self, program: Program, limit: f64) {
        let mut current = apart(&program);
        let mut loss = Fitter::default().fit(&mut current, &self.all, TO_CONVERGENCE);
        if !loss.is_finite() {
            return;
        }
        self.take(Change::Refitted, &current, loss);
        let most = (limit / self.unit).powi(2) * self.all.total_weight();
        while let Some((removal, fitted_loss)) = self.best_removal(&current, loss) {
            if fitted_loss > most {
                break;
            }
            loss = fitted_loss;
            current = removal.draft;
            self.take(Change::Removed(removal.what), &current, loss);
        }
        self.explore();
        self.seen.retain(|(_, loss, _)| *loss <= most);
    }

    /// Looks at the removals of what lies beside the way, as long as that is not dominated, the
    /// costliest first.
    fn explore(&mut self) {
        for _ in 0..EXPANSIONS {
            self.keep_undominated();
            let waiting =
                |(_, _, draft): &&(f64, f64, Draft)| !self.expanded.contains(&hash(draft));
            let Some((_, loss, draft)) = self.seen.iter().rev().find(waiting) else { return };
            let (loss, draft) = (*loss, draft.clone());
            self.best_removal(&draft, loss);
        }
    }

    fn keep_undominated(&mut self) {
        let seen = std::mem::take(&mut self.seen);
        self.seen = undominated(seen, |(cost, loss, _)| (*cost, *loss), |_, _| Ordering::Equal);
    }

    fn take(&mut self, change: Change, draft: &Draft, loss: f64) {
        let Ok(program) = Program::verify(draft.clone()) else { return };
        let cost = self.cost(draft);
        self.seen.push((cost, loss, draft.clone()));
        self.steps.push(Step { change, program, cost });
    }

    /// The removal that raises the error least for the cycles it saves, fitted.
    fn best_removal(&mut self, draft: &Draft, loss: f64) -> Option<(Removal, f64)> {
        self.expanded.insert(hash(draft));
        let cost = self.cost(draft);
        let found = removals(draft, &self.subset, self.profile);
        let least = self.negligible();
        let price = |removal: &Removal, before: f64, after: f64| {
            let saved = (cost - removal.cost).min(MAX_CREDITED);
            (after.max(least) / before.max(least)).ln() / saved
        };
        let share = self.subset.total_weight() / self.all.total_weight();
        let fitted = |removal: Removal, samples: &Samples, stop, fitter: &mut Fitter| {
            let mut removal = removal;
            let loss = fitter.fit(&mut removal.draft, samples, stop);
            (removal, loss)
        };
        let mut looked_at: Vec<(Removal, f64)> = found
            .into_par_iter()
            .map_init(Fitter::default, |fitter, removal| {
                fitted(removal, &self.subset, FIRST_LOOK, fitter)
            })
            .filter(|(_, loss)| loss.is_finite())
            .collect();
        looked_at.sort_by(|(a, a_loss), (b, b_loss)| {
            let (a, b) = (price(a, loss * share, *a_loss), price(b, loss * share, *b_loss));
            a.total_cmp(&b)
        });
        looked_at.truncate(PROMISING);
        let mut tried: Vec<(Removal, f64)> = looked_at
            .into_par_iter()
            .map_init(Fitter::default, |fitter, (removal, _)| {
                fitted(removal, &self.all, SECOND_LOOK, fitter)
            })
            .filter(|(_, loss)| loss.is_finite())
            .collect();
        self.seen.extend(tried.iter().map(|(r, loss)| (r.cost, *loss, r.draft.clone())));
        tried.sort_by(|(a, a_loss), (b, b_loss)| {
            price(a, loss, *a_loss).total_cmp(&price(b, loss, *b_loss))
        });
        tried.into_iter().next()
    }

    /// Constants shortened; of what lies beside the way, only what nothing dominates.
    fn finished(mut self) -> Specialization {
        self.keep_undominated();
        let all = &self.all;
        let short = |draft: &Draft| {
            let (mut fitter, mut draft) = (Fitter::default(), draft.clone());
            fitter.fit(&mut draft, all, TO_CONVERGENCE);
            drop_negligible(&mut fitter, &mut draft, all, SHORTENING_ALLOWANCE);
            shorten(&mut fitter, &mut draft, all, SHORTENING_ALLOWANCE);
            Some(effective(&tidy(&Program::verify(draft).ok()?)))
        };
        let others = self.seen.par_iter().filter_map(|(_, _, draft)| short(draft)).collect();
        let (own, fitted) = self.steps.split_at(self.unfitted);
        let shortened = fitted.par_iter().map(|step| {
            let program = short(&step.program).unwrap_or_else(|| step.program.clone());
            Step { program, ..step.clone() }
        });
        let steps = own.to_vec().into_par_iter().chain(shortened).collect();
        Specialization { steps, others }
    }
}
