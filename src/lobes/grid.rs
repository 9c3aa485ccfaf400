//! Fans over a grid of places.

use super::fit::{self, Amplitude, Fitted};
use super::{Fan, Misfit, Response};
use rayon::prelude::*;

/// Points of each distribution for finding a minimum, which need only be near it.
const COARSE: usize = 16 * 27;
/// Points for the minimum itself: 34 992 in all with eight lobes, where the notes take 30 000 to
/// 50 000. The error is within a thousandth of that of reference values.
const FINE: usize = 16 * 243;
/// Rounds of fits from the best of the neighbours' optima. By hand: the second changes few places.
const SWEEPS: usize = 2;
/// The gain in error below which a place keeps its optimum. By hand.
const GAIN: f64 = 1e-3;

/// The places of a grid, each a view and a roughness, whose square is the response's width.
#[derive(Clone, Copy, Debug)]
pub struct Grid<'a> {
    /// n·v, each in (0, 1]; varies slowest.
    pub n_dot_v: &'a [f64],
    /// Roughness, each in (0, 1].
    pub roughness: &'a [f64],
}

impl Grid<'_> {
    /// Fits a fan of `count` lobes at every place, on all of rayon's threads; their number changes
    /// nothing. Each is fitted by itself, then from its neighbours' optima while that makes it
    /// better, so that tables of the parameters are smooth. `after_place` is called when a place is
    /// done, from any thread.
    pub fn fans(
        &self,
        count: usize,
        amplitude: Amplitude,
        after_place: &(dyn Fn() + Sync),
    ) -> Vec<Fitted<Fan>> {
        let places = self.n_dot_v.len() * self.roughness.len();
        let misfits: Vec<Misfit> =
            (0..places).into_par_iter().map(|place| self.misfit(place, COARSE)).collect();
        let mut fans: Vec<Fitted<Fan>> =
            misfits.par_iter().map(|misfit| fit::fan(misfit, count, amplitude, &[])).collect();
        for _ in 0..SWEEPS {
            // All from the round before: the order of places changes nothing.
            let next = misfits.par_iter().enumerate().map(|(place, misfit)| {
                let beside = self.neighbours(place).into_iter();
                let moved = beside.map(|other| self.moved(fans[other].model, other, place));
                let error = |fan: &Fan| misfit.fan_moments(fan).relative_error();
                let starts = moved.map(|fan| (error(&fan), fan));
                let Some((_, start)) = starts.min_by(|a, b| a.0.total_cmp(&b.0)) else {
                    return fans[place];
                };
                let found = fit::fan(misfit, count, amplitude, &[start]);
                let is_better = found.error < fans[place].error * (1.0 - GAIN);
                if is_better { found } else { fans[place] }
            });
            fans = next.collect();
        }
        let finished = fans.par_iter().enumerate().map(|(place, coarse)| {
            let misfit = self.misfit(place, FINE);
            let fine = fit::fan(&misfit, count, amplitude, &[coarse.model]);
            after_place();
            fine
        });
        finished.collect()
    }

    fn at(&self, place: usize) -> [f64; 2] {
        let columns = self.roughness.len();
        [self.n_dot_v[place / columns], self.roughness[place % columns]]
    }

    fn misfit(&self, place: usize, points: usize) -> Misfit {
        let [n_dot_v, roughness] = self.at(place);
        Misfit::new(Response::new(n_dot_v, roughness * roughness), points)
    }

    fn neighbours(&self, place: usize) -> Vec<usize> {
        let columns = self.roughness.len();
        let (row, column) = (place / columns, place % columns);
        let mut found = Vec::new();
        found.extend((row > 0).then(|| place - columns));
        found.extend((row + 1 < self.n_dot_v.len()).then(|| place + columns));
        found.extend((column > 0).then(|| place - 1));
        found.extend((column + 1 < columns).then(|| place + 1));
        found
    }

    /// What a fan would be at another place, if it only turned with the view and had the same shape
    /// in units of the response's width.
    fn moved(&self, fan: Fan, from: usize, to: usize) -> Fan {
        let [[v_from, r_from], [v_to, r_to]] = [self.at(from), self.at(to)];
        let wider = (r_to / r_from).powi(2);
        let theta = v_to.acos() + (fan.theta - v_from.acos()) * wider;
        let theta = theta.clamp(0.0, std::f64::consts::FRAC_PI_2);
        let spread = (fan.spread * wider).min(theta);
        Fan { theta, spread, lambda: fan.lambda / (wider * wider), ..fan }
    }
}
