//! A projection: what is asked, checked, and the work on it.

use super::bench::{Bench, Point, Problem, position};
use super::groups::{Group, groups_of};
use super::layout::Layout;
use super::plan::{Kind, Stage, plan};
use super::work::Work;
use super::{Error, Model, Settings, State};
use crate::dataset::{Dataset, Split, output_units};
use crate::deadline::Deadline;
use crate::fit::{Measure, Parameter, Scale};
use rayon::prelude::*;

/// A model, and the groups of rows on which its parameters are to be found.
#[derive(Clone, Debug)]
pub struct Projection {
    pub(super) dataset: Dataset,
    pub(super) model: Model,
    pub(super) settings: Settings,
    /// The columns that groups share the values of.
    pub(super) over: Vec<usize>,
    pub(super) layout: Layout,
    pub(super) measure: Measure,
    stages: Vec<Stage>,
    /// Of the outputs, in their units.
    pub(super) variance: f64,
    key: String,
}

/// The number of groups between two looks at what is done. By hand: a fraction of a second.
const AT_ONCE: usize = 512;

/// The step, in spreads, below which sweeps end. By hand: less is seen in no picture.
const SETTLED: f64 = 1e-3;

impl Projection {
    /// Groups the rows and checks all that is asked.
    ///
    /// # Errors
    /// [`Error`]: what is wrong with the template, the inputs, the options; data on which no
    /// parameter is determined.
    pub fn new(
        data: &Dataset,
        template: &str,
        over: &[String],
        settings: Settings,
    ) -> Result<Projection, Error> {
        let names = data.names();
        let model = Model::parse(template, &names, &settings)?;
        let columns = columns_of(&names.inputs, over)?;
        model.check_names(over)?;
        let measure = settings.measure.unwrap_or(Measure::usual(&data.search));
        if matches!(measure, Measure::Max | Measure::Relative) {
            return Err(Error::Measure { measure });
        }
        if !(settings.smooth >= 0.0 && settings.smooth.is_finite()) {
            return Err(Error::Smooth { smooth: settings.smooth });
        }
        let dataset = data.select(None, Some(model.outputs()))?;
        let search = groups_of(&dataset.search, &columns);
        if search.len() < 2 {
            return Err(Error::OneGroup { over: over.join(",") });
        }
        let validation = validation_groups(&dataset, &model, &columns, &search);
        let layout = Layout::new(search, validation);
        let mut projection = Projection {
            variance: variance(&dataset, measure),
            key: key(&dataset, &model, over, &settings, measure),
            stages: Vec::new(),
            over: columns,
            dataset,
            model,
            settings,
            layout,
            measure,
        };
        projection.check_rows()?;
        projection.check_influence()?;
        let smooth = projection.settings.smooth > 0.0;
        let thin = |group: u32| projection.is_thin(&projection.layout.groups[group as usize]);
        projection.stages = plan(&projection.layout, thin, smooth, projection.settings.everywhere);
        Ok(projection)
    }

    /// Returns true if a group has too few values for its parameters to be determined.
    pub(super) fn is_thin(&self, group: &Group) -> bool {
        is_thin(group, &self.model)
    }

    /// Checks that some groups have enough rows.
    fn check_rows(&self) -> Result<(), Error> {
        let search = &self.layout.groups[..self.layout.searched];
        if search.iter().any(|group| !self.is_thin(group)) {
            return Ok(());
        }
        let most = search.iter().map(|group| group.rows.len()).max().unwrap_or(0);
        let parameters = self.model.labels().len();
        let most = most * self.model.outputs().len();
        Err(Error::AllThin { groups: search.len(), most, parameters })
    }

    /// Checks that each parameter changes an output somewhere.
    fn check_influence(&self) -> Result<(), Error> {
        let problem = self.problem();
        let mut bench = Bench::new(&problem);
        let groups = &self.layout.groups[..self.layout.searched];
        // Even steps would meet a grid in one of its lines.
        let spread = |k: usize| (0.618_034 * k as f64).fract() * groups.len() as f64;
        let probed_groups = (0..PROBED.min(groups.len())).map(|k| &groups[spread(k) as usize]);
        let mut idle: Vec<usize> = (0..self.model.labels().len()).collect();
        let mut has_values = false;
        for group in probed_groups {
            let task = problem.task(&self.dataset.search, &group.rows);
            for probe in 0..PROBES {
                let usual = probed(self.model.parameters(), &self.model.starts(), probe, None);
                let outputs = bench.outputs(&task, &usual);
                has_values |= outputs.iter().flatten().any(|value| value.is_finite());
                idle.retain(|&place| {
                    let moved = probed(self.model.parameters(), &usual, probe + 1, Some(place));
                    let other = bench.outputs(&task, &moved);
                    let differ = outputs.iter().flatten().zip(other.iter().flatten());
                    differ.into_iter().all(|(a, b)| a == b || (a.is_nan() && b.is_nan()))
                });
                if idle.is_empty() {
                    return Ok(());
                }
            }
        }
        match has_values {
            true => Err(Error::NoInfluence { name: self.model.labels()[idle[0]].clone() }),
            false => Ok(()),
        }
    }

    pub(super) fn problem(&self) -> Problem<'_> {
        Problem::new(&self.dataset, &self.model, self.measure, self.settings.seed)
    }

    /// Returns the model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Returns the measure that is made small in each group.
    pub fn measure(&self) -> Measure {
        self.measure
    }

    /// Returns the state before any fit.
    pub fn begin(&self) -> State {
        State::new(self.layout.groups.len())
    }

    /// Reads a state that [`Projection::save`] made.
    ///
    /// # Errors
    /// [`Error::State`], [`Error::OtherState`]: it is damaged, or of another projection.
    pub fn resume(&self, bytes: &[u8]) -> Result<State, Error> {
        let parameters = self.model.labels().len();
        State::from_bytes(bytes, &self.key, self.layout.groups.len(), parameters)
    }

    /// Returns the bytes of a state, with which the projection goes on as if it had not stopped.
    pub fn save(&self, state: &State) -> Vec<u8> {
        state.to_bytes(&self.key)
    }

    /// Fits groups until all is done or the deadline is past; returns true if all is done. `hear`
    /// is told the state and the share of the work now and then. The result is the same at any
    /// number of threads, and wherever it was interrupted.
    pub fn advance(
        &self,
        state: &mut State,
        deadline: &Deadline,
        hear: &mut dyn FnMut(&State, f64),
    ) -> bool {
        let problem = self.problem();
        let total = self.stages.iter().map(|stage| stage.groups.len()).sum::<usize>().max(1);
        let mut before: usize =
            self.stages.iter().take(state.stage as usize).map(|stage| stage.groups.len()).sum();
        while let Some(stage) = self.stages.get(state.stage as usize) {
            if !self.work(stage, state, &problem, deadline, &mut |state| {
                hear(state, (before + state.fresh.len()) as f64 / total as f64);
            }) {
                return false;
            }
            before += stage.groups.len();
        }
        true
    }

    /// Does a stage; returns false if the deadline cut it.
    fn work(
        &self,
        stage: &Stage,
        state: &mut State,
        problem: &Problem,
        deadline: &Deadline,
        hear: &mut dyn FnMut(&State),
    ) -> bool {
        self.enter(stage, state);
        let is_over = state.is_settled && is_repeated(stage.kind);
        let spreads = self.spreads(state);
        let done: Vec<u32> = state.fresh.iter().map(|(group, _)| *group).collect();
        let mut left: Vec<u32> = stage.groups.clone();
        if is_over {
            left.clear();
        } else if !done.is_empty() {
            let mut is_done = vec![false; self.layout.groups.len()];
            done.iter().for_each(|&group| is_done[group as usize] = true);
            left.retain(|&group| !is_done[group as usize]);
        }
        for some in left.chunks(AT_ONCE) {
            let work = Work {
                problem,
                layout: &self.layout,
                state,
                spreads: spreads.clone(),
                variance: self.variance,
                smooth: self.settings.smooth,
            };
            let fit = |bench: &mut Bench, &group: &u32| {
                (!deadline.is_past()).then(|| (group, work.fit(bench, stage.kind, group)))
            };
            let found: Vec<Option<(u32, Option<Point>)>> =
                some.par_iter().map_init(|| Bench::new(problem), fit).collect();
            let is_cut = found.iter().any(Option::is_none);
            state.fresh.extend(found.into_iter().flatten());
            hear(state);
            if is_cut {
                return false;
            }
        }
        self.leave(stage, state, problem, spreads);
        true
    }

    /// Prepares the state for a stage, unless it is in the middle of it.
    fn enter(&self, stage: &Stage, state: &mut State) {
        let is_pulled = matches!(stage.kind, Kind::PulledLevel | Kind::Sweep { .. });
        if is_pulled && state.alone.is_empty() {
            let nothing = vec![None; state.current.len()];
            state.alone = std::mem::replace(&mut state.current, nothing);
            state.is_settled = false;
            state.moved = 0.0;
        }
    }

    /// Takes what a stage has found.
    fn leave(&self, stage: &Stage, state: &mut State, problem: &Problem, spreads: Vec<f64>) {
        let fresh = std::mem::take(&mut state.fresh);
        let is_over = state.is_settled && is_repeated(stage.kind);
        if is_repeated(stage.kind) && !is_over {
            let work = Work {
                problem,
                layout: &self.layout,
                state,
                spreads,
                variance: self.variance,
                smooth: self.settings.smooth,
            };
            let step = |(group, point): &(u32, Option<Point>)| match (
                &state.current[*group as usize],
                point,
            ) {
                (Some(old), Some(new)) => work.distance(&old.values, &new.values),
                (None, None) => 0.0,
                _ => f64::INFINITY,
            };
            let moved = fresh.iter().map(step).fold(0.0, f64::max);
            state.moved = state.moved.max(moved);
        }
        for (group, point) in fresh {
            state.current[group as usize] = point;
        }
        state.stage += 1;
        let next = self.stages.get(state.stage as usize).map(|stage| stage.kind);
        let ends_round = match (stage.kind, next) {
            (Kind::Sweep { round, .. }, Some(Kind::Sweep { round: next, .. })) => next != round,
            (kind, _) => is_repeated(kind),
        };
        if ends_round && !is_over {
            state.is_settled = state.moved < SETTLED;
            state.moved = 0.0;
        }
    }

    /// Returns the spread of each parameter over the groups of the search split, on its scale: half
    /// of what lies between a sixth of the values and five sixths of them, as of a normal
    /// distribution's standard deviation. A few values that jump do not change it.
    fn spreads(&self, state: &State) -> Vec<f64> {
        let known = if state.alone.is_empty() { &state.current } else { &state.alone };
        let known = &known[..self.layout.searched];
        let of = |(place, parameter): (usize, &Parameter)| {
            let positions = known.iter().flatten();
            let mut positions: Vec<f64> =
                positions.map(|point| position(parameter, point.values[place])).collect();
            positions.sort_unstable_by(f64::total_cmp);
            spread(&positions, parameter.scale)
        };
        self.model.parameters().iter().enumerate().map(of).collect()
    }
}

fn is_repeated(kind: Kind) -> bool {
    matches!(kind, Kind::Compare { .. } | Kind::Sweep { .. })
}

/// The spread of values that are all the same, in their magnitude or in octaves. By hand: any that
/// is small and not 0.
const LEAST_SPREAD: f64 = 1e-6;

fn spread(positions: &[f64], scale: Scale) -> f64 {
    let Some(last) = positions.len().checked_sub(1) else { return 1.0 };
    let at = |share: f64| positions[(share * last as f64).round() as usize];
    let largest = positions[0].abs().max(positions[last].abs());
    let least = match scale {
        Scale::Linear => LEAST_SPREAD * if largest > 0.0 { largest } else { 1.0 },
        Scale::Logarithmic => LEAST_SPREAD,
    };
    let middle = (at(0.84) - at(0.16)) / 2.0;
    if middle > least { middle } else { ((positions[last] - positions[0]) / 2.0).max(least) }
}

/// Finds the inputs of `--over`.
fn columns_of(inputs: &[String], over: &[String]) -> Result<Vec<usize>, Error> {
    let listed = || inputs.join(", ");
    if over.is_empty() {
        return Err(Error::NothingOver { inputs: listed() });
    }
    let mut columns = Vec::new();
    for name in over {
        let known = inputs.iter().position(|input| input == name);
        let column =
            known.ok_or_else(|| Error::UnknownInput { name: name.clone(), inputs: listed() })?;
        if columns.contains(&column) {
            return Err(Error::Twice { name: name.clone() });
        }
        columns.push(column);
    }
    if columns.len() == inputs.len() { Err(Error::EveryInput) } else { Ok(columns) }
}

fn is_thin(group: &Group, model: &Model) -> bool {
    group.rows.len() * model.outputs().len() < model.labels().len()
}

/// The least number of groups of the validation split, as one in so many of the search split's. By
/// hand: `lgp import` holds back as many rows.
const ENOUGH: usize = 4;

/// Returns the groups of the validation split that have rows enough, if enough of them lie where
/// the search split has none.
fn validation_groups(
    dataset: &Dataset,
    model: &Model,
    over: &[usize],
    search: &[Group],
) -> Vec<Group> {
    let mut groups = groups_of(&dataset.validation, over);
    let bits = |group: &Group| group.place.iter().map(|v| v.to_bits()).collect::<Vec<u32>>();
    let known: std::collections::HashSet<Vec<u32>> = search.iter().map(bits).collect();
    groups.retain(|group| !is_thin(group, model));
    let new = groups.iter().filter(|group| !known.contains(&bits(group))).count();
    if new * ENOUGH < search.len() { Vec::new() } else { groups }
}

/// Groups and values of parameters that are tried for an influence. By hand, unmeasured.
const PROBED: usize = 16;
const PROBES: usize = 16;

/// Returns values of parameters to try, of all or of one: points of the sequence of multiples of
/// the golden ratio, over the bounds or over octaves around the starts.
fn probed(parameters: &[Parameter], starts: &[f32], probe: usize, only: Option<usize>) -> Vec<f32> {
    let value = |(place, (parameter, start)): (usize, (&Parameter, &f32))| {
        if only.is_some_and(|only| only != place) || (only.is_none() && probe == 0) {
            return *start;
        }
        let share = (0.618_034 * (probe + 1) as f32 + 0.324_718 * place as f32).fract();
        let [low, high] = parameter.bounds;
        match high - low {
            // A parameter may matter only within a few of its orders of magnitude.
            width if width.is_finite() && parameter.scale == Scale::Logarithmic => {
                (low * (high / low).powf(share)).clamp(low, high)
            }
            width if width.is_finite() => low + width * share,
            _ => (start.abs().max(0.1) * (6.0 * share - 3.0).exp2()).clamp(low, high),
        }
    };
    parameters.iter().zip(starts).enumerate().map(value).collect()
}

/// Returns the weighted variance of the outputs of the search split, each in its unit.
fn variance(dataset: &Dataset, measure: Measure) -> f64 {
    let split: &Split = &dataset.search;
    let weight = |row: usize| match measure {
        Measure::Weighted | Measure::Visible => f64::from(split.weight(row)),
        _ => 1.0,
    };
    let inputs = dataset.inputs.len();
    let units = output_units(&dataset.outputs);
    let of = |(column, unit): (&Vec<f32>, f64)| {
        let sum = |of: &dyn Fn(f64) -> f64| -> f64 {
            column.iter().enumerate().map(|(row, y)| weight(row) * of(f64::from(*y) / unit)).sum()
        };
        let total: f64 = sum(&|_| 1.0);
        let mean = sum(&|y| y) / total;
        sum(&|y| (y - mean).powi(2)) / total
    };
    let columns = split.columns[inputs..].iter().zip(units);
    columns.map(of).sum::<f64>() / dataset.outputs.len() as f64
}

/// Returns what tells a projection from others.
fn key(
    dataset: &Dataset,
    model: &Model,
    over: &[String],
    settings: &Settings,
    measure: Measure,
) -> String {
    let asked = format!(
        "{}\n{}\n{over:?}\n{:?}\n{:?}\n{measure}\n{}\n{}\n{}",
        dataset.hash(),
        model.text(),
        model.parameters(),
        model.starts(),
        settings.smooth.to_bits(),
        settings.everywhere,
        settings.seed
    );
    blake3::hash(asked.as_bytes()).to_hex().to_string()
}
