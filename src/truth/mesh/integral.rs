//! The errors of formulas over a whole domain, by adaptive integration, with error bars.

use super::{Mesh, Rows, Tile};
use crate::dataset::Split;
use crate::truth::Error;
use crate::truth::parallel::in_parallel;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// An output's errors over a whole domain.
///
/// The mean is the integral of the squared error over the domain in which samples are equidistant
/// (on a logarithmic axis, that of the logarithm), divided by its volume.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DomainError {
    /// The root of the mean square.
    pub rmse: f64,
    /// An estimate of how far that may be off.
    pub rmse_within: f64,
    /// The largest absolute error that was found.
    pub max: f64,
    /// An estimate of how much larger it may be elsewhere.
    pub max_within: f64,
}

/// The error bars, as shares of the values, at which integration ends. By hand: finer than what is
/// printed of them.
const ENOUGH_OF_RMSE: f64 = 1e-3;
const ENOUGH_OF_MAX: f64 = 1e-3;

/// The share of the tiles that are halved at a time. By hand.
const AT_A_TIME: usize = 8;

/// Formulas whose errors are integrated.
#[derive(Clone, Copy)]
pub struct Formulas<'a> {
    /// Their values at rows, by formula and output.
    pub values: &'a (dyn Fn(&Split) -> Vec<Vec<Vec<f32>>> + Sync),
    /// Of how many, the first ones, error bars are to be small.
    pub deciding: usize,
}

/// What is known of one formula's output in a tile: the mean square of its errors there and the
/// largest, and how far each may be off.
#[derive(Clone, Copy, Debug)]
struct Known {
    mean: f64,
    mean_within: f64,
    largest: f64,
    largest_within: f64,
}

/// A tile, and what is known in it, formula by formula and output by output.
#[derive(Clone, Debug)]
struct Part {
    tile: Tile,
    known: Vec<Known>,
    axis: usize,
}

/// A tile, and the truth there.
type Sampled = (Tile, Arc<Rows>);

/// The sums over all tiles.
#[derive(Clone, Copy, Debug, Default)]
struct Total {
    mean: f64,
    mean_within: f64,
    largest: f64,
    /// What the largest may be.
    at_most: f64,
}

impl Mesh {
    /// Integrates the squares of formulas' errors over the domain and looks for the largest, until
    /// error bars are small or the truth was evaluated about so many times. Returns each formula's
    /// errors by output; none if `stopped` returned true before there were error bars.
    ///
    /// Tiles are halved where the error bars come from, beginning with the mesh's own. The mean
    /// over a tile counts as uncertain by its change when the tile was halved; so does the largest.
    ///
    /// # Errors
    /// As [`Mesh::sample`].
    pub fn domain_errors(
        &self,
        formulas: Formulas,
        evaluations: usize,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<Vec<DomainError>>>, Error> {
        let mut mesh = self.clone();
        if !mesh.sample(stopped)? {
            return Ok(None);
        }
        let outputs = self.truth.outputs().len();
        let first: Vec<Sampled> =
            mesh.tiles.iter().map(|tile| (tile.clone(), Arc::clone(&mesh.known[tile]))).collect();
        let parts = mesh.judged(&first, formulas);
        // At first all are halved: there are no error bars before.
        let mut left = evaluations.saturating_sub(2 * self.points.count() * parts.len());
        let Some(mut parts) = mesh.halved(parts, formulas, stopped)? else { return Ok(None) };
        loop {
            let totals = totals(&parts);
            let room = left / (2 * self.points.count());
            let blamed = blamed(
                &parts,
                &totals[..formulas.deciding * outputs],
                room.min(parts.len() / AT_A_TIME + 1),
            );
            if blamed.is_empty() {
                return Ok(Some(errors(&totals, outputs)));
            }
            left = left.saturating_sub(2 * self.points.count() * blamed.len());
            let (mut halved, mut kept) = (Vec::new(), Vec::new());
            for (place, part) in parts.iter().enumerate() {
                if blamed.contains(&place) { &mut halved } else { &mut kept }.push(part.clone());
            }
            let Some(halves) = mesh.halved(halved, formulas, stopped)? else {
                return Ok(Some(errors(&totals, outputs)));
            };
            kept.extend(halves);
            parts = kept;
        }
    }

    /// Judges formulas in tiles.
    fn judged(&self, tiles: &[Sampled], formulas: Formulas) -> Vec<Part> {
        let of = |tiles: &[Sampled]| -> Vec<Part> {
            let rows: Vec<&Rows> = tiles.iter().map(|(_, rows)| &**rows).collect();
            let values = (formulas.values)(&joined(&rows, self.truth.inputs().len()));
            let mut end = 0;
            let part = |(tile, rows): &Sampled| {
                let begin = end;
                end += rows.shares.len();
                part(tile, rows, &values, begin, formulas.deciding)
            };
            tiles.iter().map(part).collect()
        };
        // As many rows at a time as fit a processor's cache.
        tiles.par_chunks(64).map(of).collect::<Vec<_>>().concat()
    }

    /// Halves tiles, and estimates how far what is known in the halves may be off. None if it was
    /// stopped.
    fn halved(
        &self,
        parts: Vec<Part>,
        formulas: Formulas,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Vec<Part>>, Error> {
        let halves = |part: &Part| part.tile.halved(part.axis).map_or(Vec::new(), Vec::from);
        let tiles: Vec<Tile> = parts.iter().flat_map(halves).collect();
        let sampled = in_parallel(&tiles, |tile| match stopped() {
            true => Ok(None),
            false => self.rows_of(tile).map(|rows| Some((tile.clone(), Arc::new(rows)))),
        })?;
        let Some(sampled) = sampled.into_iter().collect::<Option<Vec<Sampled>>>() else {
            return Ok(None);
        };
        let mut judged = self.judged(&sampled, formulas).into_iter();
        let mut halved = Vec::with_capacity(2 * parts.len());
        for part in parts {
            if part.tile.halved(part.axis).is_none() {
                halved.push(part);
                continue;
            }
            let mut halves: Vec<Part> = judged.by_ref().take(2).collect();
            for (index, whole) in part.known.iter().enumerate() {
                let [a, b] = [&halves[0].known[index], &halves[1].known[index]];
                let mean_within = (0.5 * (a.mean + b.mean) - whole.mean).abs();
                let largest_within = (a.largest.max(b.largest) - whole.largest).max(0.0);
                for half in &mut halves {
                    half.known[index].mean_within = mean_within;
                    half.known[index].largest_within = largest_within;
                }
            }
            halved.extend(halves);
        }
        Ok(Some(halved))
    }
}

/// Joins the rows of tiles to a split, without weights.
fn joined(tiles: &[&Rows], inputs: usize) -> Split {
    let outputs = tiles.first().map_or(0, |rows| rows.outputs.len());
    let mut columns = vec![Vec::new(); inputs + outputs];
    for rows in tiles {
        let (to_inputs, to_outputs) = columns.split_at_mut(inputs);
        to_inputs.iter_mut().zip(&rows.inputs).for_each(|(to, from)| to.extend(from));
        for (to, from) in to_outputs.iter_mut().zip(&rows.outputs) {
            to.extend(from.iter().map(|&value| value as f32));
        }
    }
    Split { columns, ..Split::default() }
}

/// Judges formulas in a tile whose rows begin at a place of those that `values` are of.
fn part(tile: &Tile, rows: &Rows, values: &[Vec<Vec<f32>>], begin: usize, deciding: usize) -> Part {
    let mut known = Vec::new();
    // Along which axis squares change most, each formula's in its own mean square.
    let mut changing = vec![0.0; rows.shares.len()];
    for (formula, outputs) in values.iter().enumerate() {
        for (exact, values) in rows.outputs.iter().zip(outputs) {
            let values = &values[begin..begin + rows.shares.len()];
            let error = |(value, exact): (&f32, &f64)| match value.is_finite() {
                true => (f64::from(*value) - exact).abs(),
                false => f64::INFINITY,
            };
            let errors: Vec<f64> = values.iter().zip(exact).map(error).collect();
            let mean = rows.shares.iter().zip(&errors).map(|(share, e)| share * e * e).sum::<f64>();
            let largest = errors.iter().copied().fold(0.0, f64::max);
            if formula < deciding && mean > 0.0 && mean.is_finite() {
                changing.iter_mut().zip(&errors).for_each(|(sum, e)| *sum += e * e / mean);
            }
            known.push(Known { mean, mean_within: 0.0, largest, largest_within: 0.0 });
        }
    }
    let axis = super::refine::axis_of_change(tile, rows, &changing);
    Part { tile: tile.clone(), known, axis }
}

fn totals(parts: &[Part]) -> Vec<Total> {
    let mut totals = vec![Total::default(); parts.first().map_or(0, |part| part.known.len())];
    for part in parts {
        let volume = part.tile.volume();
        for (total, known) in totals.iter_mut().zip(&part.known) {
            total.mean += volume * known.mean;
            total.mean_within += volume * known.mean_within;
            total.largest = total.largest.max(known.largest);
            total.at_most = total.at_most.max(known.largest + known.largest_within);
        }
    }
    totals
}

/// Returns the tiles that error bars come from, the worst first, at most so many; none if all bars
/// are small.
fn blamed(parts: &[Part], totals: &[Total], most: usize) -> Vec<usize> {
    // A root is uncertain by half as much as its square.
    let rmse_bar = |total: &Total| 0.5 * total.mean_within / total.mean;
    let max_bar = |total: &Total| total.at_most / total.largest - 1.0;
    let blame = |part: &Part| {
        let volume = part.tile.volume();
        let of = |(known, total): (&Known, &Total)| {
            let mean = match rmse_bar(total) > ENOUGH_OF_RMSE {
                true => 0.5 * volume * known.mean_within / total.mean / ENOUGH_OF_RMSE,
                false => 0.0,
            };
            let above = (known.largest + known.largest_within) / total.largest - 1.0;
            let largest = match max_bar(total) > ENOUGH_OF_MAX && above > 0.0 {
                true => above / ENOUGH_OF_MAX,
                false => 0.0,
            };
            let sum = mean + largest;
            if sum.is_finite() { sum } else { 0.0 }
        };
        part.known.iter().zip(totals).map(of).fold(0.0, f64::max)
    };
    let blames: Vec<f64> = parts.iter().map(blame).collect();
    let can_be = |&place: &usize| {
        blames[place] > 0.0 && parts[place].tile.halved(parts[place].axis).is_some()
    };
    let mut places: Vec<usize> = (0..parts.len()).filter(can_be).collect();
    places.sort_by(|&a, &b| {
        blames[b].total_cmp(&blames[a]).then_with(|| parts[a].tile.cmp(&parts[b].tile))
    });
    places.truncate(most);
    places
}

fn errors(totals: &[Total], outputs: usize) -> Vec<Vec<DomainError>> {
    let error = |total: &Total| {
        let rmse = total.mean.sqrt();
        let rmse_within = match rmse > 0.0 && rmse.is_finite() {
            // The root of what the mean may be at most.
            true => (total.mean + total.mean_within).sqrt() - rmse,
            false => total.mean_within.sqrt(),
        };
        let max_within = match total.largest.is_finite() {
            true => total.at_most - total.largest,
            false => 0.0,
        };
        DomainError { rmse, rmse_within, max: total.largest, max_within }
    };
    totals.chunks(outputs.max(1)).map(|totals| totals.iter().map(error).collect()).collect()
}
