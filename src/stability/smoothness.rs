//! Jumps, kinks and trends along the axes.

use super::blame::traced;
use crate::eval::{Arithmetic, Double};
use crate::num::Interval;
use crate::op::Op;
use crate::program::{Arg, Program, use_counts};
use serde::Serialize;

/// A place where an output is not smooth: the worst found along one input.
#[derive(Clone, Debug, PartialEq)]
pub struct Break {
    /// The index of the output.
    pub output: usize,
    /// The index of the input that changes.
    pub along: usize,
    /// The place, in `f64`.
    pub input: Vec<f64>,
    /// The instruction whose branches meet there.
    pub instruction: usize,
    /// The change of the value.
    pub jump: f64,
    /// The change of the slope, per unit of the input.
    pub kink: f64,
}

/// The direction of an output as an input grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Trend {
    /// It does not change.
    Constant,
    /// It never falls.
    Rising,
    /// It never rises.
    Falling,
    /// It rises and falls.
    Neither,
}

/// The breaks and trends seen along lines through the domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Smoothness {
    /// For each output and input the largest jump that counts, else the largest kink that counts.
    pub breaks: Vec<Break>,
    /// The trends, by output and input.
    pub trends: Vec<Vec<Trend>>,
}

/// The number of lines along each input: 9 × 9 values of two others. Chosen by hand, unmeasured.
const LINES: usize = 81;

/// The number of steps on a line. Chosen by hand, unmeasured.
const STEPS: usize = 128;

/// The relative change that rounding of `f64` may make. Chosen by hand, unmeasured.
const ROUNDING: f64 = 1e-12;

/// The size above which a jump counts. Chosen by hand, unmeasured.
pub const JUMP: f64 = 1e-5;

/// The size above which a kink times the side's width counts. Chosen by hand, unmeasured.
const KINK: f64 = 1e-3;

impl Smoothness {
    /// Follows a program along lines parallel to the axes, in `f64`.
    ///
    /// # Panics
    /// If `domain` does not have one interval for each input.
    pub fn of(program: &Program, domain: &[Interval]) -> Smoothness {
        let mut used = Vec::new();
        use_counts(program, &mut used);
        let watched: Vec<usize> = (0..program.instrs.len())
            .filter(|&i| used[i] > 0 && program.instrs[i].op().is_piecewise())
            .collect();
        let view = View { program, traced: traced(program), domain, watched };
        let mut breaks = Vec::new();
        let mut trends = vec![Vec::new(); program.outputs.len()];
        for along in 0..domain.len() {
            let (found, seen) = view.along(along);
            breaks.extend(found);
            trends.iter_mut().zip(seen).for_each(|(trends, trend)| trends.push(trend));
        }
        Smoothness { breaks, trends }
    }
}

struct View<'a> {
    program: &'a Program,
    traced: Program,
    domain: &'a [Interval],
    /// The piecewise instructions that are used.
    watched: Vec<usize>,
}

impl View<'_> {
    fn along(&self, along: usize) -> (Vec<Break>, Vec<Trend>) {
        let outputs = self.program.outputs.len();
        let mut worst: Vec<[Option<Break>; 2]> = vec![[None, None]; outputs];
        let mut moves = vec![[false; 2]; outputs];
        let side = self.domain[along];
        let (low, width) = (f64::from(side.low()), f64::from(side.high()) - f64::from(side.low()));
        if width == 0.0 {
            return (Vec::new(), vec![Trend::Constant; outputs]);
        }
        for line in 0..LINES {
            let at = |share: f64| {
                let mut point = self.elsewhere(line, along);
                point[along] = low + width * share;
                point
            };
            let mut before = self.evaluate(&at(0.0));
            for step in 1..=STEPS {
                let (left, right) = ((step - 1) as f64 / STEPS as f64, step as f64 / STEPS as f64);
                let here = self.evaluate(&at(right));
                for (o, moves) in moves.iter_mut().enumerate() {
                    let (a, b) = (self.output(&before, o), self.output(&here, o));
                    let rounding = ROUNDING * a.abs().max(b.abs()).max(1e-3);
                    moves[0] |= b > a + rounding;
                    moves[1] |= b < a - rounding;
                }
                let changed = |i: &&usize| {
                    self.branch(**i, &at(left), &before) != self.branch(**i, &at(right), &here)
                };
                for &instruction in self.watched.iter().filter(changed) {
                    for found in self.locate(instruction, along, [left, right], &at) {
                        let [jump, kink] = &mut worst[found.output];
                        keep(jump, &found, |one| one.jump.abs());
                        keep(kink, &found, |one| one.kink.abs());
                    }
                }
                before = here;
            }
        }
        let notable = |[jump, kink]: [Option<Break>; 2]| {
            let jump = jump.filter(|one| one.jump.abs() > JUMP);
            kink.filter(|one| one.kink.abs() * width > KINK && jump.is_none()).or(jump)
        };
        let trend = |[up, down]: [bool; 2]| match (up, down) {
            (true, true) => Trend::Neither,
            (true, false) => Trend::Rising,
            (false, true) => Trend::Falling,
            (false, false) => Trend::Constant,
        };
        (worst.into_iter().filter_map(notable).collect(), moves.into_iter().map(trend).collect())
    }

    /// Returns the other inputs on a line: nine values of each of two, others by the golden ratio.
    fn elsewhere(&self, line: usize, along: usize) -> Vec<f64> {
        let mut others = 0;
        let share = |i: usize, others: &mut usize| {
            if i == along {
                return 0.0;
            }
            *others += 1;
            match *others {
                1 => (line % 9) as f64 / 8.0,
                2 => (line / 9) as f64 / 8.0,
                more => (line as f64 * 0.618_033_988_75 * more as f64).fract(),
            }
        };
        let side = |(i, side): (usize, &Interval)| {
            let width = f64::from(side.high()) - f64::from(side.low());
            f64::from(side.low()) + width * share(i, &mut others)
        };
        self.domain.iter().enumerate().map(side).collect()
    }

    fn evaluate(&self, point: &[f64]) -> Vec<f64> {
        Double.evaluate(&self.traced, point)
    }

    fn output(&self, values: &[f64], o: usize) -> f64 {
        values[self.program.instrs.len() + o]
    }

    /// Returns the piece that a piecewise operation takes.
    fn branch(&self, i: usize, point: &[f64], values: &[f64]) -> i64 {
        let instr = &self.program.instrs[i];
        let value = |k: usize| match instr.args()[k] {
            Arg::Input(i) => point[usize::from(i)],
            Arg::Const(i) => self.program.consts[usize::from(i)].into(),
            Arg::Result(i) => values[usize::from(i)],
        };
        match instr.op() {
            Op::Abs => i64::from(value(0) < 0.0),
            Op::Min | Op::Max | Op::Select => i64::from(value(0) < value(1)),
            Op::Step => i64::from(value(1) >= value(0)),
            Op::Atan2 => i64::from(value(0) < 0.0 && value(1) < 0.0),
            Op::Saturate => i64::from(value(0) > 0.0) + i64::from(value(0) > 1.0),
            Op::Floor | Op::Fract => value(0).floor().clamp(-1e18, 1e18) as i64,
            Op::Sign => i64::from(value(0) > 0.0) - i64::from(value(0) < 0.0),
            // In one piece.
            Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Neg | Op::Mad | Op::Lerp | Op::Pow => 0,
            Op::Rcp | Op::Sqrt | Op::Rsqrt | Op::Exp2 | Op::Log2 | Op::Exp | Op::Log => 0,
            Op::Sin | Op::Cos | Op::Tan | Op::Asin | Op::Acos | Op::Atan | Op::Tanh => 0,
        }
    }

    /// Bisects a step to where the branches meet; returns each output's break there.
    fn locate(
        &self,
        instruction: usize,
        along: usize,
        [mut left, mut right]: [f64; 2],
        at: &impl Fn(f64) -> Vec<f64>,
    ) -> Vec<Break> {
        let branch = |share: f64| self.branch(instruction, &at(share), &self.evaluate(&at(share)));
        let first = branch(left);
        for _ in 0..44 {
            let middle = (left + right) / 2.0;
            if branch(middle) == first { left = middle } else { right = middle }
        }
        // Chosen by hand, unmeasured.
        const APART: f64 = 1e-5;
        let sample = |share: f64| self.evaluate(&at(share.clamp(0.0, 1.0)));
        let [far_left, near_left, near_right, far_right] =
            [left - APART, left, right, right + APART].map(sample);
        let width = f64::from(self.domain[along].high()) - f64::from(self.domain[along].low());
        let found = |output: usize| {
            let [a, b, c, d] =
                [&far_left, &near_left, &near_right, &far_right].map(|v| self.output(v, output));
            let jump = c - b;
            let kink = ((d - c) - (b - a)) / (APART * width);
            Break { output, along, input: at(right), instruction, jump, kink }
        };
        (0..self.program.outputs.len()).map(found).collect()
    }
}

fn keep(worst: &mut Option<Break>, found: &Break, size: impl Fn(&Break) -> f64) {
    let finite = size(found).is_finite();
    if finite && worst.as_ref().is_none_or(|known| size(found) > size(known)) {
        *worst = Some(found.clone());
    }
}
