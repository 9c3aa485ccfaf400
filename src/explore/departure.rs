//! How far data are from a form, and what can be said of that.

use super::rows::Rows;
use super::smooth::{Fit, root_mean_square};
use super::table::Left;
use serde::Serialize;

/// The departure up to which a form holds, as far as formulas are concerned. By hand: 1e-4 of the
/// spread is below what eight bits, or an eye, tell apart.
const EXACT: f64 = 1e-4;

/// The departure up to which a form may serve as an approximation, in spreads. By hand: the cheap
/// members of fronts, those of a few cycles, err by as much.
const NEAR: f64 = 0.03;

/// Standard errors that a difference has to exceed to count. By hand: the usual two.
const SIGNIFICANT: f64 = 2.0;

/// What the data say of a form.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// No departure is seen, and one that mattered would be.
    Holds,
    /// The departure is small enough for an approximation.
    Nearly,
    /// The departure is larger.
    Fails,
    /// What the smooth fit leaves, or noise, could hide a departure, or be taken for one.
    Open,
}

/// The distance of data from the nearest function of a form, the root of its mean square, in
/// spreads (standard deviations) of the output.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Departure {
    /// The estimate: what the form leaves beyond what the smooth fit, or on a grid noise, leaves.
    pub estimate: f64,
    /// The least that it may be.
    pub low: f64,
    /// The most that it may be.
    pub high: f64,
    /// All that the nearest function found leaves, noise too: what a formula of the form can reach.
    pub residual: f64,
    /// Whether it was compared value by value on a grid, not by a smooth fit.
    pub on_grid: bool,
}

impl Departure {
    /// Compares a fit of the form with that of no form, on rows that neither was fitted to.
    pub(super) fn of_fit(rows: &Rows, form: &Fit, full: &Fit) -> Departure {
        let count = form.errors.len().min(full.errors.len());
        let weights = &rows.weights[..count];
        let excess: Vec<f64> = form.errors[..count]
            .iter()
            .zip(&full.errors)
            .map(|(form, full)| form * form - full * full)
            .collect();
        let total: f64 = weights.iter().sum();
        let mean = excess.iter().zip(weights).map(|(d, w)| d * w).sum::<f64>() / total;
        let centred: Vec<f64> = excess.iter().zip(weights).map(|(d, w)| w * (d - mean)).collect();
        let error = centred.iter().map(|d| d * d).sum::<f64>().sqrt() / total;
        let residual = root_mean_square(&form.errors, &rows.weights);
        let floor = root_mean_square(&full.errors[..count], weights);
        Departure::between(mean, error, unexplained(rows, floor), residual, false)
    }

    /// Judges what the best table of the form leaves on a grid. What a smooth fit leaves may be
    /// noise that nobody stated.
    pub(super) fn on_grid(rows: &Rows, left: Left, full: &Fit) -> Departure {
        let residual = left.residual;
        let variance = left.free * rows.noise * rows.noise;
        let error = variance * (2.0 / rows.len() as f64).sqrt();
        let unexplained = unexplained(rows, full.residual);
        let mean = residual * residual - variance;
        Departure::between(mean, error, unexplained, residual, true)
    }

    /// `mean` and `error` are the excess of the mean square and its standard error.
    fn between(mean: f64, error: f64, hidden: f64, residual: f64, on_grid: bool) -> Departure {
        let root = |square: f64| square.max(0.0).sqrt();
        let estimate = root(mean);
        let low = (root(mean - SIGNIFICANT * error) - hidden).max(0.0);
        let beyond = if on_grid { 0.0 } else { hidden };
        let high = (root(mean.max(0.0) + SIGNIFICANT * error) + beyond).min(residual);
        Departure { estimate, low, high: high.max(estimate), residual, on_grid }
    }

    /// Returns what the departure says of the form.
    pub fn verdict(&self) -> Verdict {
        let Departure { estimate, low, high, .. } = *self;
        if high <= EXACT || (low == 0.0 && high <= NEAR && estimate <= high / 2.0) {
            Verdict::Holds
        } else if high <= NEAR || (estimate <= NEAR && high <= 2.0 * low.max(NEAR / 2.0)) {
            Verdict::Nearly
        } else if low > NEAR {
            Verdict::Fails
        } else {
            Verdict::Open
        }
    }
}

/// Returns the part of what a smooth fit leaves that stated errors do not explain.
fn unexplained(rows: &Rows, floor: f64) -> f64 {
    // Standard errors are themselves known to a tenth or so. By hand, unmeasured.
    let stated = 1.1 * rows.noise;
    (floor * floor - stated * stated).max(0.0).sqrt()
}
