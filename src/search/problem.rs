//! The problem: a goal for a dataset, a grammar and a GPU, laid out for a search.

use super::require::Checks;
use super::scales::Scales;
use super::{CostOf, Goal};
use crate::cost::{CostScratch, Profile};
use crate::dataset::{self, Dataset, Split, joint_unit, output_units};
use crate::eval::{Evaluator, Samples, Tape};
use crate::fit::Measure;
use crate::grammar::{FileError, Grammar};
use crate::program::{Draft, Outer, Program, Shape, Template};
use crate::simplify::{Placement, Simplifier};
use std::borrow::Cow;
use std::sync::Arc;

/// A search problem: formulas of a grammar for a dataset, cheap on a GPU, as a [`Goal`] demands.
///
/// ```
/// use lgp::dataset::{Dataset, axis};
/// use lgp::fit::Measure;
/// use lgp::search::Problem;
///
/// let data = Dataset::sampled([axis("x", 0.0..=1.0)], ["y"], |[x]| [x * x])?;
/// let problem = Problem::of(data).gpu("turing").measure(Measure::Max).max_cost(8.0).build()?;
/// assert_eq!(problem.profile().name, "turing");
/// assert_eq!(problem.goal().max_cost, 8.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Problem {
    pub(super) dataset: Arc<Dataset>,
    /// The rows in place of its search split, if there are some ([`Problem::sampled_on`]); their
    /// weights are shares of the domain.
    followed: Option<Arc<Dataset>>,
    /// The dataset, or what is in its place, over the columns that are searched
    /// ([`super::scales`]).
    searched: Arc<Dataset>,
    /// The scaling of those columns; none if they are the dataset's own.
    pub(super) scales: Option<Scales>,
    pub(super) grammar: Arc<Grammar>,
    pub(super) profile: Arc<Profile>,
    pub(super) goal: Goal,
    pub(super) checks: Checks,
    /// The outer form around formulas, if the goal has transforms or a template.
    pub(super) outer: Option<Outer>,
    /// The goal's template.
    pub(super) template: Option<Template>,
    /// The template's calls, if only they are costed.
    pub(super) calls_alone: Option<Outer>,
    /// The shape of the drafts that are searched.
    shape: Shape,
    /// The cycles of the template around holes that do nothing; 0 without a template.
    floor: f64,
    pub(super) all: Samples,
    /// All samples without those that only hold formulas to an end; none if there are no such.
    without_ends: Option<Samples>,
    /// The loss of the best constants.
    pub(super) constant_loss: f64,
    /// The unit of errors over all outputs, in which losses are mean squares.
    unit: f64,
}

/// The reason why a problem or a search cannot be set up.
#[allow(missing_docs, reason = "each message names its fields")]
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    #[error(transparent)]
    Dataset(#[from] dataset::Error),
    #[error(transparent)]
    File(#[from] FileError),
    #[error("the goal is invalid: {0}")]
    Goal(String),
    #[error("the method is invalid: {0}")]
    Method(String),
    #[error(
        "there are too many formulas of at most {cost} cycles to try all (more than {most}, or of too many inputs); ask for fewer cycles"
    )]
    TooMany { cost: f64, most: usize },
    #[error("no search for this goal by this method can have reached the state: {0}")]
    State(String),
}

/// A problem in the making, from [`Problem::of`].
#[derive(Clone, Debug)]
pub struct ProblemBuilder {
    dataset: Arc<Dataset>,
    grammar: Result<Arc<Grammar>, String>,
    profile: Result<Arc<Profile>, String>,
    goal: Goal,
}

/// The name of the default grammar.
pub const USUAL_GRAMMAR: &str = "shader";
/// The name of the default GPU profile.
pub const USUAL_GPU: &str = "gcn";

impl ProblemBuilder {
    /// Sets the grammar of formulas, such as one from [`Grammar::find`]; by default `shader`.
    pub fn grammar(self, grammar: impl Into<Arc<Grammar>>) -> ProblemBuilder {
        ProblemBuilder { grammar: Ok(grammar.into()), ..self }
    }

    /// Sets the profile of costs, such as one from [`Profile::find`]; by default `gcn`.
    pub fn profile(self, profile: impl Into<Arc<Profile>>) -> ProblemBuilder {
        ProblemBuilder { profile: Ok(profile.into()), ..self }
    }

    /// Sets the profile by name, or a mix as in `gcn:2,turing:1`.
    pub fn gpu(self, name_or_mix: &str) -> ProblemBuilder {
        ProblemBuilder { profile: Err(name_or_mix.to_owned()), ..self }
    }

    /// Sets the whole goal.
    pub fn goal(self, goal: Goal) -> ProblemBuilder {
        ProblemBuilder { goal, ..self }
    }

    /// Sets the measure to minimise; by default the RMSE.
    pub fn measure(mut self, measure: Measure) -> ProblemBuilder {
        self.goal.measure = measure;
        self
    }

    /// Sets the most cycles that a formula may cost; by default 40.
    pub fn max_cost(mut self, cycles: f64) -> ProblemBuilder {
        self.goal.max_cost = cycles;
        self
    }

    /// Checks all parts and lays the samples out.
    ///
    /// # Errors
    /// [`SetupError`]: a dataset, grammar, profile or goal that breaks its own rules; a goal for
    /// which the dataset lacks columns or weights.
    pub fn build(self) -> Result<Problem, SetupError> {
        let ProblemBuilder { dataset, grammar, profile, goal } = self;
        dataset.validate()?;
        let grammar = grammar.or_else(|name| Grammar::find(&name).map(Arc::new))?;
        let profile = profile.or_else(|name| Profile::find(&name).map(Arc::new))?;
        grammar.check()?;
        let (inputs, outputs) = (dataset.inputs.len(), dataset.outputs.len());
        goal.check(inputs, outputs).map_err(SetupError::Goal)?;
        if goal.measure == Measure::Weighted && dataset.search.weights.is_empty() {
            return Err(SetupError::Goal(
                "`measure` is weighted, but the data has no weights".into(),
            ));
        }
        let names = dataset.names();
        let template = goal.template(&names).map_err(SetupError::Goal)?;
        // A template is written over the columns as they are.
        let scales =
            Some(Scales::of(&dataset)).filter(|scales| template.is_none() && !scales.are_natural());
        let checks = Checks::new(&goal.requirements, &dataset);
        let outer = template.as_ref().map(|template| template.outer().clone());
        let units = output_units(&dataset.outputs);
        let problem = Problem {
            constant_loss: f64::INFINITY,
            without_ends: None,
            shape: goal.shape(&names).map_err(SetupError::Goal)?,
            calls_alone: outer
                .as_ref()
                .filter(|_| goal.cost_of == CostOf::Holes)
                .map(Outer::calls_alone),
            outer: outer.or_else(|| goal.outer(inputs, outputs)),
            floor: 0.0,
            template,
            unit: if goal.measure == Measure::Relative { 1.0 } else { joint_unit(&units) },
            searched: Arc::clone(&dataset),
            dataset,
            followed: None,
            scales,
            grammar,
            profile,
            goal,
            checks,
            all: Samples::default(),
        };
        let floor = problem.cost_of_idle_holes();
        Ok(Problem { floor, ..problem }.laid_out())
    }
}

impl Problem {
    /// Makes a builder of a problem of this dataset; by default with the grammar `shader`, the GPU
    /// `gcn`, and the goal of the least RMSE at up to 40 cycles.
    pub fn of(dataset: impl Into<Arc<Dataset>>) -> ProblemBuilder {
        ProblemBuilder {
            dataset: dataset.into(),
            grammar: Err(USUAL_GRAMMAR.to_owned()),
            profile: Err(USUAL_GPU.to_owned()),
            goal: Goal::default(),
        }
    }

    /// Returns the dataset that formulas are searched for.
    pub fn dataset(&self) -> &Arc<Dataset> {
        &self.dataset
    }

    /// Returns the grammar that formulas are written in.
    pub fn grammar(&self) -> &Arc<Grammar> {
        &self.grammar
    }

    /// Returns the GPU profile of costs.
    pub fn profile(&self) -> &Arc<Profile> {
        &self.profile
    }

    /// Returns the goal.
    pub fn goal(&self) -> &Goal {
        &self.goal
    }

    /// Returns the same problem with other rows in place of the search split, on which formulas are
    /// fitted and judged; they are over all columns, and their weights are shares of the domain
    /// (mean 1). Formulas that are shown are scored on the dataset as it is.
    ///
    /// # Errors
    /// Rows that are no split of the dataset.
    pub fn sampled_on(&self, rows: Split) -> Result<Problem, SetupError> {
        let dataset = Dataset { search: rows, ..Dataset::clone(&self.dataset) };
        dataset.validate()?;
        Ok(Problem { followed: Some(Arc::new(dataset)), ..self.clone() }.laid_out())
    }

    /// Lays out the samples.
    fn laid_out(self) -> Problem {
        let sampled = self.followed.as_ref().unwrap_or(&self.dataset);
        let searched = match &self.scales {
            Some(scales) => Arc::new(scales.scaled(sampled)),
            None => Arc::clone(sampled),
        };
        let (inputs, units) = (searched.inputs.len(), output_units(&searched.outputs));
        let plain = self.by_share(self.goal.measure).all_samples(&searched.search, inputs, &units);
        let plain = self.relative_by_share(plain, self.goal.measure, &searched.search.weights);
        let problem = Problem { searched, ..self };
        let all = problem.laid_out_in(problem.goal.measure);
        Problem {
            constant_loss: constant_loss(&plain, problem.goal.measure),
            without_ends: (all.rows() > plain.rows()).then_some(plain),
            all,
            ..problem
        }
    }

    /// Returns a subset of so many samples for candidates to race on; for the maximum error also up
    /// to as many at the ends of the inputs.
    pub(super) fn race(&self, subset: usize) -> Samples {
        let mut rows = spread_rows(self.searched.search.rows(), subset);
        if self.goal.measure == Measure::Max {
            let edges = edge_rows(&self.searched.search, self.dataset.inputs.len());
            let chosen = spread_rows(edges.len(), subset);
            rows.extend(chosen.into_iter().map(|place| edges[place as usize]));
            rows.sort_unstable();
            rows.dedup();
        }
        self.samples(&self.searched, self.goal.measure, &rows)
    }

    /// Lays out rows of the dataset or of what is searched, weighted for a measure.
    fn samples(&self, dataset: &Dataset, measure: Measure, rows: &[u32]) -> Samples {
        let samples = self.checks.samples(dataset, self.by_share(measure), rows);
        let shares: Vec<f32> =
            rows.iter().map(|&row| dataset.search.weight(row as usize)).collect();
        self.relative_by_share(samples, measure, &shares)
    }

    /// Weighs samples by their shares as well, if their errors are relative.
    fn relative_by_share(&self, mut samples: Samples, measure: Measure, shares: &[f32]) -> Samples {
        if self.followed.is_none() || measure != Measure::Relative {
            return samples;
        }
        for output in 0..samples.outputs() {
            let weights = samples.weights(output).iter().zip(shares);
            let weights: Vec<f32> = weights.map(|(weight, share)| weight * share).collect();
            samples.set_weights(output, &weights);
        }
        let total = shares.iter().copied().map(f64::from).sum::<f64>() * samples.outputs() as f64;
        samples.set_total_weight(total);
        samples
    }

    /// Returns the measure that weighs rows by their shares of the domain, if they have some.
    fn by_share(&self, measure: Measure) -> Measure {
        match measure {
            Measure::Rmse if self.followed.is_some() => Measure::Weighted,
            _ => measure,
        }
    }

    /// Returns all samples, weighted for a measure.
    pub(super) fn all_in(&self, measure: Measure) -> Samples {
        if measure == self.goal.measure { self.all.clone() } else { self.laid_out_in(measure) }
    }

    fn laid_out_in(&self, measure: Measure) -> Samples {
        let rows: Vec<u32> = (0..self.searched.search.rows() as u32).collect();
        self.samples(&self.searched, measure, &rows)
    }

    /// As [`Problem::all_in`], but over the dataset's own columns.
    pub(super) fn all_as_given(&self, measure: Measure) -> Samples {
        let dataset = self.followed.as_ref().unwrap_or(&self.dataset);
        let rows: Vec<u32> = (0..dataset.search.rows() as u32).collect();
        self.samples(dataset, measure, &rows)
    }

    /// Returns the error over all outputs that a loss stands for, as
    /// [`super::FrontMember::search_error`] shows it.
    pub fn error(&self, loss: f64) -> f64 {
        loss.sqrt() * self.unit
    }

    /// Returns the archive's loss of a draft whose fit to all samples came to `fitted`: without the
    /// samples that only hold formulas to an end.
    pub(super) fn archive_loss(
        &self,
        draft: &Draft,
        fitted: f64,
        evaluator: &mut Evaluator,
    ) -> f64 {
        let Some(samples) = &self.without_ends else { return fitted };
        let Ok(program) = Program::verify(draft.clone()) else { return f64::INFINITY };
        let loss = evaluator.loss(&Tape::new(&program), samples, f64::INFINITY);
        match self.goal.measure {
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

    /// Returns the shape of a child.
    pub(super) fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Returns the cycles of the template around holes that do nothing; 0 without a template.
    pub(super) fn floor(&self) -> f64 {
        self.floor
    }

    /// Returns the template whose holes are searched for, if there is one.
    pub fn template(&self) -> Option<&Template> {
        self.template.as_ref()
    }

    /// Returns the formula over the dataset's own columns that a child, as the archive has it,
    /// becomes.
    pub fn formula_of(&self, child: &Draft) -> Draft {
        self.natural(&self.formula(child)).into_owned()
    }

    /// Returns the draft that a child becomes within the outer form.
    pub(super) fn formula<'d>(&self, child: &'d Draft) -> Cow<'d, Draft> {
        self.outer.as_ref().map_or(Cow::Borrowed(child), |outer| Cow::Owned(outer.append(child)))
    }

    /// Runs `work` on the draft that a child becomes, and copies the child's constants back. They
    /// are the first ones, and their number is passed; the others are the outer form's.
    pub(super) fn on_formula<R>(
        &self,
        child: &mut Draft,
        work: impl FnOnce(&mut Draft, usize) -> R,
    ) -> R {
        let own = child.consts.len();
        let Some(outer) = &self.outer else { return work(child, own) };
        let mut formula = outer.append(child);
        let result = work(&mut formula, own);
        child.consts.copy_from_slice(&formula.consts[..own]);
        result
    }

    /// Returns the cycles plus penalties of the formula that a draft of the search becomes.
    pub(super) fn cost(&self, draft: &Draft, scratch: &mut CostScratch) -> f64 {
        self.natural_and_cost(draft, scratch).1
    }

    /// Returns the cycles plus penalties of the formula that a child becomes; those of a template's
    /// own operations are not penalised.
    pub(super) fn cost_of_child(&self, child: &Draft, scratch: &mut FormulaScratch) -> f64 {
        let FormulaScratch { simplifier, formula, cost } = scratch;
        let Some(outer) = self.calls_alone.as_ref().or(self.outer.as_ref()) else {
            return self.cost(child, cost);
        };
        simplifier.simplify(&outer.append(child), formula);
        match &self.template {
            Some(_) => self.profile.cycles(formula, cost) + self.grammar.penalty(child),
            None => self.cost(formula, cost),
        }
    }

    /// Returns the cycles of the template around holes that are their first parameters.
    fn cost_of_idle_holes(&self) -> f64 {
        let Some(template) = &self.template else { return 0.0 };
        let mut idle = template.guess("").expect("no text is a guess");
        idle.consts.iter_mut().zip(0u8..).for_each(|(constant, i)| *constant = 0.6 + f32::from(i));
        self.cost_of_child(&idle, &mut FormulaScratch::default())
    }

    /// Rewrites a draft of the search as one over the dataset's own columns.
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
        // Costed as written: constants that are 0 or 1 only in these units are no gain yet.
        let costs = [&first, &in_constants].map(|draft| {
            self.profile.cycles_as_written(draft, scratch) + self.grammar.penalty(draft)
        });
        match costs[0] < costs[1] {
            true => (Cow::Owned(first), costs[0]),
            false => (Cow::Owned(in_constants), costs[1]),
        }
    }

    /// Rewrites a draft over the dataset's own columns as one of the search.
    pub(super) fn over_searched(&self, draft: &Draft) -> Draft {
        self.scales.as_ref().map_or_else(|| draft.clone(), |scales| scales.searched(draft))
    }

    /// Rewrites a draft over the dataset's own columns as a child; one of a template's shape is a
    /// child already.
    pub(super) fn searched_child(&self, draft: &Draft) -> Draft {
        let searched = self.over_searched(draft);
        if self.template.is_some() {
            return searched;
        }
        match self.goal.inner(searched.inputs, searched.outputs.len()) {
            Some(inner) => inner.append(&searched),
            None => searched,
        }
    }

    /// Returns the factor that turns a sum of squares over all samples and outputs into a mean.
    pub(super) fn scale(&self) -> f64 {
        1.0 / self.all.total_weight()
    }
}

/// The memory in which children become formulas and are costed.
#[derive(Clone, Debug, Default)]
pub(super) struct FormulaScratch {
    pub simplifier: Simplifier,
    pub formula: Draft,
    pub cost: CostScratch,
}

/// Returns the loss of the best constants, one for each output.
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

/// Returns rows spread evenly over the table by the golden ratio; on a grid they form a lattice.
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

/// Returns the rows with an input at an end, where errors are mostly largest.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::axis;
    use crate::fit::{Fitter, Stop};
    use crate::program::{Names, parse};

    #[test]
    fn constants_of_the_outer_form_stay() {
        let data = Dataset::sampled([axis("x", 0.0..=1.0)], ["y"], |[x]| [0.5 * (3.0 * x) + 0.25]);
        let mut problem = Problem::of(data.unwrap()).build().unwrap();
        let form = parse("y = 0.5*hole + 0.25", &Names::new(["x", "hole"], ["y"])).unwrap();
        problem.outer = Some(Outer::new(form, 1));
        let mut child = parse("hole = 1*x", &Names::new(["x"], ["hole"])).unwrap().into_draft();
        let loss = problem.on_formula(&mut child, |formula, own| {
            let stop = Stop { max_steps: 20, min_gain: 0.0 };
            Fitter::default().fit_free(formula, &problem.all, stop, |i| i < own)
        });
        assert!(loss < 1e-10 && (child.consts[0] - 3.0).abs() < 1e-5, "{child:?}");
        assert_eq!(problem.formula(&child).consts[1..], [0.5, 0.25]);
    }
}
