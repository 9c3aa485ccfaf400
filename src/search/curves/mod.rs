//! Curves of a template, its holes of one argument: first their values are fitted, then formulas
//! are found for these.
//!
//! With a formula in its hole that is far from right, the constants around a curve settle far from
//! right, too, and there the next formula does no better. So a bent line of many pieces takes the
//! place of each curve, and the bends and the template's constants are fitted together, from several
//! starts. What comes out is a table of each curve; a short search finds formulas for it, and these
//! go back into the template, between constants that fit them.

mod line;
mod table;

use self::line::{spread, write_line};
use super::vary::random_draft;
use super::{Goal, Method, Problem, Search};
use crate::archive::near_the_least;
use crate::dataset::Dataset;
use crate::deadline::Deadline;
use crate::eval::{Evaluator, Samples, Tape};
use crate::fit::{Fitter, Measure, Stop};
use crate::program::{Arg, Draft, Hole, Program, Reads, Template};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::cmp::Ordering;

/// The bends of a line. By hand: a filmic curve is followed to a thousandth.
const BENDS: usize = 20;

/// The starts of a fit of values, and those that are kept.
const STARTS: u64 = 64;
const KEPT: usize = 2;

/// The samples of such a fit, and its end.
const ROWS: usize = 1024;
const ON_ROWS: Stop = Stop { max_steps: 60, min_gain: 1e-4 };

/// The generations of the search for a curve's formulas, and its islands.
const GENERATIONS: u64 = 12;
const ISLANDS: usize = 4;

/// The end of a first look at children.
const AS_THEY_ARE: Stop = Stop { max_steps: 0, min_gain: 0.0 };

/// The most children of the same cost. By hand.
const OF_A_COST: usize = 3;

/// The first random stream of these fits, which no generation reaches.
const STREAM: u64 = 1 << 62;

impl Search {
    /// Offers every island what is found by the values of a template's curves. Does nothing without
    /// a template, or if one of its holes has several arguments or values.
    pub fn inject_curves_until(&mut self, deadline: &Deadline) {
        let Some(curves) = Curves::of(&self.problem) else { return };
        let mut children = Vec::new();
        for lines in curves.fitted(self.method.seed, deadline) {
            children.extend(curves.formulas(&lines, self.method.seed, deadline));
        }
        self.inject_children(&children, deadline);
    }
}

/// The curves of a problem's template.
struct Curves<'a> {
    problem: &'a Problem,
    template: &'a Template,
    holes: Vec<&'a Hole>,
    rows: Samples,
    /// Where the line of each bends.
    bends: Vec<Vec<f32>>,
}

impl<'a> Curves<'a> {
    fn of(problem: &'a Problem) -> Option<Curves<'a>> {
        let template = problem.template.as_ref()?;
        let holes = template.holes().iter().filter(|hole| !hole.is_constant());
        let mut holes: Vec<&Hole> = holes.collect();
        holes.sort_by_key(|hole| hole.outputs().start);
        let is_curve = |hole: &&Hole| hole.parameters.len() == 1 && hole.outputs().len() == 1;
        if holes.is_empty() || !holes.iter().all(is_curve) {
            return None;
        }
        let rows = problem.race(ROWS);
        let mut curves = Curves { problem, template, holes, rows, bends: Vec::new() };
        let plain = curves.child(|_, draft, x| draft.outputs.push(x), |start| start.unwrap_or(1.0));
        let arguments = (0..curves.holes.len()).map(|hole| curves.arguments(hole, &plain));
        curves.bends = arguments.map(|values| spread(&values, BENDS)).collect();
        curves.bends.iter().all(|bends| bends.len() > 2).then_some(curves)
    }

    /// Returns a child whose curves are what `write` adds to it for the argument, and whose
    /// constants are what `start` makes of theirs.
    fn child(
        &self,
        mut write: impl FnMut(usize, &mut Draft, Arg),
        mut start: impl FnMut(Option<f32>) -> f32,
    ) -> Draft {
        let shape = self.template.outer().shape();
        let mut child = Draft { inputs: shape.inputs, ..Draft::default() };
        for (place, hole) in self.holes.iter().enumerate() {
            write(place, &mut child, Arg::Input(hole.inputs()[0] as u16));
        }
        for reads in &shape.reads()[self.holes.len()..] {
            let Reads::Constant(known) = reads else { unreachable!("constants are last") };
            let value = child.constant(start(*known));
            child.outputs.push(value);
        }
        child
    }

    /// Returns what a curve is called with in a child, in ascending order.
    fn arguments(&self, hole: usize, child: &Draft) -> Vec<f32> {
        let mut plain = child.clone();
        plain.outputs[hole] = Arg::Input(self.holes[hole].inputs()[0] as u16);
        let values = self.template.outer().values_of(self.holes[hole].outputs().start, &plain);
        let Ok(values) = Program::verify(values) else { return Vec::new() };
        let values = Evaluator::default().outputs(&Tape::new(&values), &self.rows);
        let mut values: Vec<f32> =
            values.iter().flatten().copied().filter(|value| value.is_finite()).collect();
        values.sort_unstable_by(f32::total_cmp);
        values
    }

    /// Returns children whose curves are bent lines, fitted, the best first.
    fn fitted(&self, seed: u64, deadline: &Deadline) -> Vec<Lines> {
        let starts: Vec<u64> = (0..STARTS).collect();
        let fitted = starts.into_par_iter().filter(|_| !deadline.is_past());
        let mut fitted: Vec<Lines> = fitted.map(|start| self.fit(seed, start, deadline)).collect();
        fitted.retain(|lines| lines.loss.is_finite());
        fitted.sort_by(|a, b| a.loss.total_cmp(&b.loss));
        fitted.dedup_by(|b, a| b.loss < 1.01 * a.loss);
        fitted.truncate(KEPT);
        fitted
    }

    fn fit(&self, seed: u64, start: u64, deadline: &Deadline) -> Lines {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(STREAM + start);
        let mut random = Draft::default();
        random_draft(&mut rng, self.template.outer().shape(), &self.problem.grammar, &mut random);
        let mut constants = random.outputs[self.holes.len()..].iter().map(|&arg| match arg {
            Arg::Const(i) => random.consts[usize::from(i)],
            _ => unreachable!("constants are last"),
        });
        let mut is_free = Vec::new();
        let write = |place: usize, child: &mut Draft, x: Arg| {
            let line = write_line(child, x, &self.bends[place], &mut is_free);
            child.outputs.push(line);
        };
        let mut child = self.child(write, |_| constants.next().expect("one for each"));
        is_free.resize(child.consts.len(), true);
        let mut fitter = Fitter::until(&deadline.moment_alone());
        let loss = self.problem.on_formula(&mut child, |formula, _| {
            let is_free = |i: usize| is_free.get(i).copied().unwrap_or(false);
            fitter.fit_free(formula, &self.rows, ON_ROWS, is_free)
        });
        Lines { child, loss }
    }

    /// Returns children whose curves are formulas for the lines.
    fn formulas(&self, lines: &Lines, seed: u64, deadline: &Deadline) -> Vec<Draft> {
        let tables = (0..self.holes.len()).map(|hole| self.table(hole, lines));
        let Some(tables) = tables.collect::<Option<Vec<Dataset>>>() else { return Vec::new() };
        let found = tables.into_par_iter().zip(&self.holes);
        let found: Vec<Vec<Draft>> =
            found.map(|(table, hole)| self.search(table, hole, seed, deadline)).collect();
        let combined = found.iter().fold(vec![Vec::new()], |combined: Vec<Vec<&Draft>>, next| {
            let longer = combined.iter().flat_map(|one| {
                next.iter().map(|formula| one.iter().copied().chain([formula]).collect())
            });
            longer.collect()
        });
        let values = |i: &Arg| match *i {
            Arg::Const(i) => lines.child.consts[usize::from(i)],
            _ => unreachable!("constants are last"),
        };
        let children = combined.iter().map(|formulas| {
            let mut constants = lines.child.outputs[self.holes.len()..].iter().map(values);
            let write = |place: usize, child: &mut Draft, x: Arg| {
                let formula = Program::verify(formulas[place].clone()).expect("it was found");
                let value = child.append(&formula, &[x]);
                child.outputs.extend(value);
            };
            self.child(write, |_| constants.next().expect("one for each"))
        });
        self.best_of(children.collect(), deadline)
    }

    /// Returns the children that, fitted, come near the least error at their cost.
    fn best_of(&self, children: Vec<Draft>, deadline: &Deadline) -> Vec<Draft> {
        let children = children.into_par_iter().map_init(Default::default, |scratch, child| {
            (self.problem.cost_of_child(&child, scratch), 0.0, child)
        });
        let mut children: Vec<(f64, f64, Draft)> =
            children.filter(|(cost, ..)| *cost <= self.problem.goal.max_cost).collect();
        for (steps, within) in [(AS_THEY_ARE, 4.0), (ON_ROWS, 1.5)] {
            let new_fitter = || Fitter::until(&deadline.moment_alone());
            children = children
                .into_par_iter()
                .filter(|_| !deadline.is_past())
                .map_init(new_fitter, |fitter, (cost, _, mut child)| {
                    let loss = self.problem.on_formula(&mut child, |formula, own| {
                        fitter.fit_free(formula, &self.rows, steps, |i| i < own)
                    });
                    (cost, loss, child)
                })
                .collect();
            let place = |(cost, loss, _): &(f64, f64, Draft)| (*cost, *loss);
            children = near_the_least(children, within, place, |_, _| Ordering::Equal);
            let alike = children.chunk_by(|a, b| a.0 == b.0);
            children = alike.flat_map(|some| some.iter().take(OF_A_COST).cloned()).collect();
        }
        children.into_iter().rev().map(|(.., child)| child).collect()
    }

    /// Returns formulas for a table, over its input, at different costs.
    fn search(&self, table: Dataset, hole: &Hole, seed: u64, deadline: &Deadline) -> Vec<Draft> {
        let Problem { grammar, profile, goal, .. } = self.problem;
        let left = (goal.max_cost - self.problem.floor()) / hole.calls as f64;
        let measure =
            if table.search.weights.is_empty() { Measure::Rmse } else { Measure::Weighted };
        let goal = Goal { measure, max_cost: left.max(1.0), ..Goal::default() };
        let problem = Problem::of(table).grammar(grammar.clone()).profile(profile.clone());
        let Ok(problem) = problem.goal(goal).build() else { return Vec::new() };
        let method = Method { seed, islands: ISLANDS, ..Method::default() };
        let Ok(mut search) = Search::new(problem, method) else { return Vec::new() };
        while search.generation() < GENERATIONS && search.advance_until(deadline) {}
        let members = search.archive().members().iter();
        members.map(|member| search.problem().formula_of(&member.draft)).collect()
    }
}

/// A child whose curves are bent lines, with the sum of squares that it leaves.
struct Lines {
    child: Draft,
    loss: f64,
}
