//! Specialisation: formulas without the parts that a scene makes superfluous.

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

/// A change of a formula.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// None: the formula as given, with fixed inputs as constants and outputs combined.
    Given,
    /// Constants folded, and the rest simplified.
    Folded,
    /// An operation that never acts dropped.
    Idle(Op, Evidence),
    /// Constants fitted to the scene.
    Refitted,
    /// A removal, in words, and the constants fitted again.
    Removed(String),
}

/// A formula on the way to a cheaper one, over the view's columns.
#[derive(Clone, Debug)]
pub struct Step {
    /// The change that led here.
    pub change: Change,
    /// The formula after it.
    pub program: Program,
    /// The formula's cycles.
    pub cost: f64,
}

/// The results of specialising a formula.
#[derive(Clone, Debug, Default)]
pub struct Specialization {
    /// The steps from the given formula to the last one within the limit.
    pub steps: Vec<Step>,
    /// The fitted formulas within the limit that none dominates, on the way or beside it.
    pub others: Vec<Program>,
}

/// The ends of a removal's first fit, on some samples; of a promising one's second, on all; and of
/// the final fits. Chosen by hand, unmeasured.
const FIRST_LOOK: Stop = Stop { max_steps: 5, min_gain: 1e-3 };
const SECOND_LOOK: Stop = Stop { max_steps: 40, min_gain: 1e-4 };
const TO_CONVERGENCE: Stop = Stop { max_steps: 200, min_gain: 1e-7 };

/// The most samples of a first look. Chosen by hand, unmeasured.
const SUBSET: usize = 512;
/// The most removals that are looked at twice. Chosen by hand, unmeasured.
const PROMISING: usize = 24;

/// The most saved cycles credited to a removal: else the last step, to a constant, would look good
/// too early. Chosen by hand, unmeasured.
const MAX_CREDITED: f64 = 4.0;

/// The most formulas beside the way whose removals are tried. Chosen by hand, unmeasured.
const EXPANSIONS: usize = 200;

/// The share by which shorter constants may raise the sum of squares, as in a search's fronts.
const SHORTENING_ALLOWANCE: f64 = 0.004;

/// The root mean square below which all errors are equally good. Chosen by hand, unmeasured.
const NEGLIGIBLE: f64 = 1e-7;

/// Specialises a formula over the whole dataset's inputs to a view. `defined` names the outputs of
/// the whole dataset that it computes; `dataset` is the view's, perhaps with fewer outputs.
///
/// First constants are folded and operations that never act dropped, which costs no accuracy. Then
/// constants are fitted, and terms removed one after the other: each time the one that raises the
/// error least for the cycles it saves, with the constants fitted again, until nothing is left or
/// the error (root mean square, in `measure`) exceeds `limit`. The best formulas beside that way
/// are treated in the same manner. None if the formula lacks an output that is needed.
///
/// # Panics
/// As [`View::program`], or if the inputs of `dataset` are not the view's.
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
    /// The unit of errors over all outputs, in which losses count.
    unit: f64,
    steps: Vec<Step>,
    /// The number of first steps whose constants are the given formula's.
    unfitted: usize,
    /// The fitted drafts, each with its cost and loss.
    seen: Vec<(f64, f64, Draft)>,
    /// The hashes of structures whose removals were tried.
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

    /// Returns the loss below which all are equally good.
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

    /// Tries the removals of drafts beside the way that nothing dominates, the costliest first.
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

    /// Returns the removal that raises the error least for the cycles it saves, fitted, and its
    /// loss.
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

    /// Shortens constants, and keeps only drafts beside the way that nothing dominates.
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
