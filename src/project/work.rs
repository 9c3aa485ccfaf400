//! The fit of one group in each kind of stage.

use super::bench::{Bench, Point, Problem, Task, mean, position};
use super::layout::Layout;
use super::penalty::Pull;
use super::plan::Kind;
use super::state::State;
use crate::dataset::Split;

/// How many times the largest error of its neighbours a group's may be and count as in line with
/// them, squared. By hand, unmeasured.
const IN_LINE: f64 = 4.0;

/// The error, as a share of the outputs' spread, up to which it is always in line, squared. By
/// hand: what an eye hardly sees.
const SMALL: f64 = 1e-6;

/// The distance, in spreads of a parameter, from which on a neighbour's optimum is another start.
/// By hand, unmeasured.
const FAR: f64 = 0.1;

/// What the fits of a stage read.
pub(super) struct Work<'a> {
    pub problem: &'a Problem<'a>,
    pub layout: &'a Layout,
    pub state: &'a State,
    /// By parameter.
    pub spreads: Vec<f64>,
    /// The variance of the outputs.
    pub variance: f64,
    pub smooth: f64,
}

impl Work<'_> {
    /// Fits a group; none if the model is finite from no start.
    pub fn fit(&self, bench: &mut Bench, kind: Kind, group: u32) -> Option<Point> {
        let dataset = self.problem.dataset;
        let is_search = (group as usize) < self.layout.searched;
        let split: &Split = if is_search { &dataset.search } else { &dataset.validation };
        let task = self.problem.task(split, &self.layout.groups[group as usize].rows);
        let point = match kind {
            Kind::Level { globally } => self.level(bench, &task, group, globally),
            Kind::Compare { first } => self.compare(bench, &task, group, first),
            Kind::PulledLevel => self.pulled_level(bench, &task, group),
            Kind::Sweep { round, .. } => self.sweep(bench, &task, group, round),
        };
        point.filter(|point| point.square.is_finite())
    }

    fn points(&self, groups: &[u32]) -> Vec<&Point> {
        groups.iter().filter_map(|&group| self.state.current[group as usize].as_ref()).collect()
    }

    fn level(&self, bench: &mut Bench, task: &Task, group: u32, globally: bool) -> Option<Point> {
        let near = self.points(&self.layout.coarser[group as usize]);
        let parameters = self.problem.parameters();
        let usual = self.problem.model.starts();
        if near.is_empty() {
            let best = bench.local(task, &usual);
            return Some(better(task, best, bench.global(task, &usual, group)));
        }
        let around = mean(parameters, &values(&near));
        let mut best = bench.local(task, &around);
        let lead = least(&near, |point| bench.square(task, &point.values));
        let mut agree = true;
        if lead.values != around {
            let second = bench.local(task, &lead.values);
            agree = task.are_same(best.square, second.square);
            best = better(task, best, second);
        }
        if !agree {
            for other in near.iter().filter(|other| other.values != lead.values) {
                best = better(task, best, bench.local(task, &other.values));
            }
        }
        if globally || !agree || !self.is_in_line(&best, &near) {
            let from = best.values.clone();
            best = better(task, best, bench.global(task, &from, group));
        }
        Some(best)
    }

    fn compare(&self, bench: &mut Bench, task: &Task, group: u32, first: bool) -> Option<Point> {
        let near = self.points(&self.layout.beside[group as usize]);
        let usual = self.problem.model.starts();
        let own = self.state.current[group as usize].clone();
        let mut best = own.unwrap_or(Point { values: usual, square: f64::INFINITY });
        for other in &near {
            if !best.square.is_finite() || self.is_far(&best.values, &other.values) {
                best = better(task, best, bench.local(task, &other.values));
            }
        }
        if first && !near.is_empty() && !self.is_in_line(&best, &near) {
            let from = best.values.clone();
            best = better(task, best, bench.global(task, &from, group));
        }
        Some(best)
    }

    fn pull(&self, near: &[&Point]) -> Pull {
        let smooth = self.smooth * self.variance;
        Pull::new(self.problem.parameters(), &values(near), &self.spreads, smooth)
    }

    fn pulled_level(&self, bench: &mut Bench, task: &Task, group: u32) -> Option<Point> {
        let alone = self.state.alone[group as usize].as_ref();
        let mut near = self.points(&self.layout.coarser[group as usize]);
        if let Some(beside) = self.layout.beside.get(group as usize)
            && near.is_empty()
        {
            near = self.points(beside);
        }
        if near.is_empty() {
            return alone.cloned();
        }
        let pull = self.pull(&near);
        let parameters = self.problem.parameters();
        let made_small =
            |point: &Point, square: f64| square + pull.penalty(parameters, &point.values);
        let lead = least(&near, |point| made_small(point, bench.square(task, &point.values)));
        let around = mean(parameters, &values(&near));
        let starts = [Some(&around), Some(&lead.values), alone.map(|point| &point.values)];
        pulled(bench, task, &pull, starts.into_iter().flatten())
    }

    fn sweep(&self, bench: &mut Bench, task: &Task, group: u32, round: u32) -> Option<Point> {
        let own = self.state.current[group as usize].as_ref();
        let near = self.points(&self.layout.beside[group as usize]);
        if near.is_empty() {
            return own.cloned();
        }
        let pull = self.pull(&near);
        let alone = self.state.alone[group as usize].as_ref().filter(|_| round == 0);
        let is_other =
            |point: &&&Point| own.is_none_or(|own| self.is_far(&own.values, &point.values));
        let starts = own.into_iter().chain(alone).chain(near.iter().filter(is_other).copied());
        pulled(bench, task, &pull, starts.map(|point| &point.values))
    }

    fn is_in_line(&self, point: &Point, near: &[&Point]) -> bool {
        let most = near.iter().map(|near| near.square).fold(0.0, f64::max);
        point.square <= IN_LINE * most + SMALL * self.variance
    }

    fn is_far(&self, a: &[f32], b: &[f32]) -> bool {
        self.distance(a, b) > FAR
    }

    /// Returns the largest distance of two values of a parameter, in spreads.
    pub fn distance(&self, a: &[f32], b: &[f32]) -> f64 {
        let apart = |(parameter, (a, b)): (_, (&f32, &f32))| {
            (position(parameter, *a) - position(parameter, *b)).abs()
        };
        let all = self.problem.parameters().iter().zip(a.iter().zip(b)).map(apart);
        all.zip(&self.spreads).map(|(apart, spread)| apart / spread).fold(0.0, f64::max)
    }
}

fn values<'a>(points: &[&'a Point]) -> Vec<&'a [f32]> {
    points.iter().map(|point| point.values.as_slice()).collect()
}

/// Returns the second of two fits if it is better.
fn better(task: &Task, first: Point, second: Point) -> Point {
    if task.is_better(second.square, first.square) { second } else { first }
}

/// Returns the first of the points for which a value is least.
fn least<'a>(points: &[&'a Point], mut of: impl FnMut(&Point) -> f64) -> &'a Point {
    let mut best = (points[0], of(points[0]));
    for point in &points[1..] {
        let value = of(point);
        if value < best.1 {
            best = (point, value);
        }
    }
    best.0
}

/// Returns the best of the pulled fits from some starts.
fn pulled<'a>(
    bench: &mut Bench,
    task: &Task,
    pull: &Pull,
    starts: impl Iterator<Item = &'a Vec<f32>>,
) -> Option<Point> {
    let mut best: Option<(Point, f64)> = None;
    for start in starts {
        let (point, made_small) = bench.pulled(task, start, pull);
        if best.as_ref().is_none_or(|(_, least)| task.is_better(made_small, *least)) {
            best = Some((point, made_small));
        }
    }
    best.map(|(point, _)| point)
}
