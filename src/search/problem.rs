//! What is searched for, laid out as a search works on it.

use super::Settings;
use super::require::Checks;
use super::scales::Scales;
use super::transform::Transform;
use crate::cost::{CostScratch, Profile};
use crate::dataset::{Dataset, Split, joint_unit, output_units};
use crate::eval::{Evaluator, Samples, Tape};
use crate::fit::Measure;
use crate::grammar::Grammar;
use crate::program::{Draft, Program};
use crate::simplify::Placement;
use std::borrow::Cow;

/// What is searched for: a formula of some grammar for some samples, cheap on some GPU.
#[derive(Clone, Debug)]
pub struct Problem<'a> {
    pub dataset: &'a Dataset,
    /// The dataset over the columns that are searched ([`scales`]).
    searched: Cow<'a, Dataset>,
    /// How those columns are scaled; none if they are the dataset's own.
    pub(super) scales: Option<Scales>,
    pub grammar: &'a Grammar,
    pub profile: &'a Profile,
    pub(super) measure: Measure,
    pub(super) checks: Checks,
    transforms: Vec<Option<Transform>>,
    pub(super) all: Samples,
    pub(super) subset: Samples,
    /// All samples without those that only hold formulas to an end; none where there are none.
    without_ends: Option<Samples>,
    /// What the best constant's loss is.
    pub(super) constant_loss: f64,
    /// Of errors over all outputs: losses are mean squares in it.
    unit: f64,
}

impl<'a> Problem<'a> {
    /// Lays the samples out, with a subset of `settings.subset` of them; where the maximum error is to be
    /// small, and of as many at the ends of the inputs.
    ///
    /// # Panics
    /// If the dataset is not valid.
    pub fn new(
        dataset: &'a Dataset,
        grammar: &'a Grammar,
        profile: &'a Profile,
        settings: &Settings,
    ) -> Problem<'a> {
        let inputs = dataset.inputs.len();
        let measure = settings.measure;
        let scales = Some(Scales::of(dataset)).filter(|scales| !scales.are_natural());
        let searched = match &scales {
            Some(scales) => Cow::Owned(scales.scaled(dataset)),
            None => Cow::Borrowed(dataset),
        };
        let mut rows = spread_rows(dataset.search.rows(), settings.subset);
        if measure == Measure::Max {
            let edges = edge_rows(&searched.search, inputs);
            let chosen = spread_rows(edges.len(), settings.subset);
            rows.extend(chosen.into_iter().map(|place| edges[place as usize]));
            rows.sort_unstable();
            rows.dedup();
        }
        let checks = Checks::new(&settings.requirements, dataset);
        let units = output_units(&dataset.outputs);
        let searched_units = output_units(&searched.outputs);
        let plain = measure.all_samples(&searched.search, inputs, &searched_units);
        let all_rows: Vec<u32> = (0..dataset.search.rows() as u32).collect();
        let all = checks.samples(&searched, measure, &all_rows);
        let subset = checks.samples(&searched, measure, &rows);
        Problem {
            dataset,
            searched,
            scales,
            grammar,
            profile,
            measure,
            transforms: settings.transforms.clone(),
            subset,
            constant_loss: constant_loss(&plain, measure),
            without_ends: (all.rows() > plain.rows()).then_some(plain),
            all,
            checks,
            unit: if measure == Measure::Relative { 1.0 } else { joint_unit(&units) },
        }
    }

    /// All samples, weighing as they do in a measure.
    pub(super) fn all_in(&self, measure: Measure) -> Samples {
        if measure == self.measure {
            return self.all.clone();
        }
        let rows: Vec<u32> = (0..self.dataset.search.rows() as u32).collect();
        self.checks.samples(&self.searched, measure, &rows)
    }

    /// The same over the dataset's columns.
    pub(super) fn all_as_given(&self, measure: Measure) -> Samples {
        let rows: Vec<u32> = (0..self.dataset.search.rows() as u32).collect();
        self.checks.samples(self.dataset, measure, &rows)
    }

    /// The error over all outputs that a loss stands for, as [`super::FrontMember::search_error`] shows it.
    pub fn error(&self, loss: f64) -> f64 {
        loss.sqrt() * self.unit
    }

    /// The loss of a draft that was fitted to all samples, which came to `fitted`.
    pub(super) fn archive_loss(
        &self,
        draft: &Draft,
        fitted: f64,
        evaluator: &mut Evaluator,
    ) -> f64 {
        let Some(samples) = &self.without_ends else { return fitted };
        let Ok(program) = Program::verify(draft.clone()) else { return f64::INFINITY };
        let loss = evaluator.loss(&Tape::new(&program), samples, f64::INFINITY);
        match self.measure {
            Measure::Max => {
                let largest = |output: usize| {
                    f64::from(loss.max_error[output]).powi(2)
                        * f64::from(samples.weights(output)[0])
                };
                (0..samples.outputs()).map(largest).fold(0.0, f64::max)
            }
            _ => loss.total() * self.scale(),
        }
    }

    /// The outputs that are searched for through a function of them.
    pub(super) fn transforms(&self) -> impl Iterator<Item = (usize, Transform)> + '_ {
        let each = self.transforms.iter().enumerate();
        each.filter_map(|(output, transform)| Some((output, (*transform)?)))
    }

    /// Cycles and penalties of the formula that a draft of the search becomes.
    pub(super) fn cost(&self, draft: &Draft, scratch: &mut CostScratch) -> f64 {
        self.natural_and_cost(draft, scratch).1
    }

    /// A draft of the search as one over the dataset's columns.
    pub fn natural<'d>(&self, draft: &'d Draft) -> Cow<'d, Draft> {
        self.natural_and_cost(draft, &mut CostScratch::default()).0
    }

    fn natural_and_cost<'d>(
        &self,
        draft: &'d Draft,
        scratch: &mut CostScratch,
    ) -> (Cow<'d, Draft>, f64) {
        let Some(scales) = &self.scales else {
            let cost = self.profile.cycles(draft, scratch) + self.grammar.penalty(draft);
            return (Cow::Borrowed(draft), cost);
        };
        let [first, in_constants] =
            [Placement::First, Placement::Constants].map(|place| scales.natural(draft, place));
        // What folds in these units alone, constants that are none or one here by chance, is no gain yet.
        let costs = [&first, &in_constants].map(|draft| {
            self.profile.cycles_as_written(draft, scratch) + self.grammar.penalty(draft)
        });
        match costs[0] < costs[1] {
            true => (Cow::Owned(first), costs[0]),
            false => (Cow::Owned(in_constants), costs[1]),
        }
    }

    /// A draft over the dataset's columns as one of the search.
    pub(super) fn over_searched(&self, draft: &Draft) -> Draft {
        self.scales.as_ref().map_or_else(|| draft.clone(), |scales| scales.searched(draft))
    }

    /// What turns a sum of squares over all samples and outputs into a mean.
    pub(super) fn scale(&self) -> f64 {
        1.0 / self.all.total_weight()
    }

    /// The same for the subset.
    pub(super) fn subset_scale(&self) -> f64 {
        1.0 / self.subset.total_weight()
    }
}

/// The loss of the constants that err least, one for each output.
fn constant_loss(samples: &Samples, measure: Measure) -> f64 {
    let of = |output: usize| {
        let pairs = || samples.targets(output).iter().zip(samples.weights(output));
        let weighted = |f: &dyn Fn(f64) -> f64| -> f64 {
            pairs().map(|(y, w)| f64::from(*w) * f(f64::from(*y))).sum()
        };
        if measure == Measure::Max {
            let ends = (f32::INFINITY, f32::NEG_INFINITY);
            let (low, high) = pairs().fold(ends, |(low, high), (y, _)| (low.min(*y), high.max(*y)));
            let unit = f64::from(samples.weights(output)[0]);
            return ((f64::from(high) - f64::from(low)) / 2.0).powi(2) * unit;
        }
        let mean = weighted(&|y| y) / weighted(&|_| 1.0);
        weighted(&|y| (y - mean).powi(2))
    };
    let losses = (0..samples.outputs()).map(of);
    match measure {
        Measure::Max => losses.fold(0.0, f64::max),
        _ => losses.sum::<f64>() / samples.total_weight(),
    }
}

/// Rows spread evenly over the table, by the golden ratio: on a grid they form a lattice.
fn spread_rows(rows: usize, wanted: usize) -> Vec<u32> {
    if rows <= wanted {
        return (0..rows as u32).collect();
    }
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let mut spread: Vec<u32> =
        (0..wanted).map(|i| (((i as f64 + 0.5) * GOLDEN).fract() * rows as f64) as u32).collect();
    spread.sort_unstable();
    spread.dedup();
    spread
}

/// Rows at which an input is at an end: where errors are largest, more often than not.
fn edge_rows(split: &Split, inputs: usize) -> Vec<u32> {
    let bounds = |column: &Vec<f32>| {
        let ends = (f32::INFINITY, f32::NEG_INFINITY);
        column.iter().fold(ends, |(low, high), &x| (low.min(x), high.max(x)))
    };
    let ends: Vec<(f32, f32)> = split.columns[..inputs].iter().map(bounds).collect();
    let at_an_end = |row: &u32| {
        let mut cells = split.columns.iter().zip(&ends).map(|(c, ends)| (c[*row as usize], ends));
        cells.any(|(x, (low, high))| x == *low || x == *high)
    };
    (0..split.rows() as u32).filter(at_an_end).collect()
}
