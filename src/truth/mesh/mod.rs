//! Samples that follow a search: a mesh of tiles, as many samples in each, and more tiles where the
//! formulas of a front err most.
//!
//! As the globally adaptive integrator does it (Pesce and Iwanicki, "Approximate Models for
//! Physically Based Rendering", 2015, §3.1.1), whose tiles §5.2 proposes for a search straight on a
//! function: each tile has the points of a fixed rule, and the tile that the error estimate blames
//! most is halved next. Here an estimate is of a whole front, and tiles that matter to no formula
//! are joined, so that the number of samples, and with it the time of a generation, stays.
//!
//! ```
//! use lgp::truth::{Mesh, Norm, Truth, parse_domain};
//!
//! let truth = Truth::formula("y = exp2(-64*x)", &[], &parse_domain("x=0..1")?)?;
//! let mut mesh = Mesh::new(truth, 64);
//! mesh.sample(&|| false)?;
//! // A formula that is 0 everywhere errs at the left end alone.
//! let errors = mesh.rows().columns[1].iter().map(|y| f64::from(*y).powi(2)).collect();
//! assert!(mesh.refine(&[errors], Norm::Mean) > 0);
//! mesh.sample(&|| false)?;
//! assert_eq!(mesh.tiles()[0].ends(0), [0.0, 1.0 / 16.0]);
//! # Ok::<(), lgp::truth::Error>(())
//! ```

mod integral;
mod refine;
mod rule;
mod tile;

pub use integral::{DomainError, Formulas};
pub use refine::Norm;
pub use tile::Tile;

use super::parallel::in_parallel;
use super::{Error, Truth};
use crate::dataset::Split;
use rule::Points;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

/// The values of a truth at the points of a tile.
#[derive(Debug)]
pub(super) struct Rows {
    /// The inputs of formulas, by column.
    pub inputs: Vec<Vec<f32>>,
    /// The outputs, by column.
    pub outputs: Vec<Vec<f64>>,
    /// Each point's share of the tile's volume.
    pub shares: Vec<f64>,
    /// The points, in coordinates of the tile from 0 to 1.
    pub at: Vec<Vec<f64>>,
}

/// Tiles that cover a truth's domain, with its values.
#[derive(Clone, Debug)]
pub struct Mesh {
    truth: Truth,
    points: Points,
    /// In order.
    tiles: Vec<Tile>,
    /// The values of the tiles that were sampled.
    known: HashMap<Tile, Arc<Rows>>,
    /// The tiles of the equal mesh, and the halvings that lead to them.
    usual: usize,
    usual_depth: usize,
}

impl Mesh {
    /// Makes a mesh of equal tiles that have together about as many samples as a split of so many
    /// `rows`.
    pub fn new(truth: Truth, rows: usize) -> Mesh {
        let (axes, points) = (truth.axes().len(), Points::new(truth.axes().len()));
        let tiles = tile::equal(axes, (rows / points.count()).max(1));
        let (usual, usual_depth) = (tiles.len(), tiles[0].depth());
        Mesh { truth, points, tiles, known: HashMap::new(), usual, usual_depth }
    }

    /// As [`Mesh::new`], with the tiles that a mesh had; none if these do not cover the domain.
    pub fn of_tiles(truth: Truth, rows: usize, tiles: Vec<Tile>) -> Option<Mesh> {
        let mesh = Mesh::new(truth, rows);
        let covers = tile::cover(&tiles, mesh.truth.axes().len());
        covers.then(|| Mesh { tiles, ..mesh })
    }

    /// Returns the truth.
    pub fn truth(&self) -> &Truth {
        &self.truth
    }

    /// Returns the tiles, those of lower halves first.
    pub fn tiles(&self) -> &[Tile] {
        &self.tiles
    }

    /// Evaluates the truth at the points of tiles where it was not, on all of rayon's threads,
    /// unless `stopped` returns true, which may be called from any of them. Returns true if all
    /// tiles are sampled.
    ///
    /// # Errors
    /// As [`Truth::at`], of the first tile that has such a point.
    pub fn sample(&mut self, stopped: &(dyn Fn() -> bool + Sync)) -> Result<bool, Error> {
        let known = &self.known;
        let unknown = self.tiles.iter().filter(|tile| !known.contains_key(*tile));
        let unknown: Vec<Tile> = unknown.cloned().collect();
        let sampled = in_parallel(&unknown, |tile| match stopped() {
            true => Ok(None),
            false => self.rows_of(tile).map(Some),
        })?;
        let mut is_whole = true;
        for (tile, rows) in unknown.into_iter().zip(sampled) {
            match rows {
                Some(rows) => drop(self.known.insert(tile, Arc::new(rows))),
                None => is_whole = false,
            }
        }
        Ok(is_whole)
    }

    /// Evaluates the truth at the points of a tile.
    pub(super) fn rows_of(&self, tile: &Tile) -> Result<Rows, Error> {
        let places = self.points.of(tile);
        let (inputs, outputs) = (self.truth.inputs().len(), self.truth.outputs().len());
        let mut rows = Rows {
            inputs: vec![Vec::with_capacity(places.len()); inputs],
            outputs: vec![Vec::with_capacity(places.len()); outputs],
            shares: places.iter().map(|place| place.share).collect(),
            at: Vec::with_capacity(places.len()),
        };
        for place in places {
            let point: Vec<f32> = (self.truth.axes().iter().enumerate().zip(&place.at))
                .map(|((index, axis), at)| {
                    let [low, high] = tile.ends(index);
                    axis.inside(low + at * (high - low))
                })
                .collect();
            let (inputs, outputs) = self.truth.row(&point)?;
            rows.inputs.iter_mut().zip(inputs).for_each(|(column, value)| column.push(value));
            rows.outputs.iter_mut().zip(outputs).for_each(|(column, value)| column.push(value));
            rows.at.push(place.at);
        }
        Ok(rows)
    }

    /// Returns the samples, tile by tile: the inputs of formulas and the outputs, weighted by their
    /// shares of the domain (mean 1).
    ///
    /// # Panics
    /// If tiles are not sampled ([`Mesh::sample`]).
    pub fn rows(&self) -> Split {
        let (inputs, outputs) = (self.truth.inputs().len(), self.truth.outputs().len());
        let mut split = Split { columns: vec![Vec::new(); inputs + outputs], ..Split::default() };
        for tile in &self.tiles {
            let rows = &self.known[tile];
            let (to_inputs, to_outputs) = split.columns.split_at_mut(inputs);
            to_inputs.iter_mut().zip(&rows.inputs).for_each(|(to, from)| to.extend(from));
            for (to, from) in to_outputs.iter_mut().zip(&rows.outputs) {
                to.extend(from.iter().map(|&value| value as f32));
            }
            let volume = tile.volume();
            split.weights.extend(rows.shares.iter().map(|share| (share * volume) as f32));
        }
        // The shares add up to 1.
        let count = split.weights.len() as f32;
        split.weights.iter_mut().for_each(|weight| *weight *= count);
        split
    }

    /// Returns the rows of each tile among [`Mesh::rows`].
    fn spans(&self) -> Vec<Range<usize>> {
        let mut end = 0;
        let of = |tile: &Tile| {
            let begin = end;
            end += self.known[tile].shares.len();
            begin..end
        };
        self.tiles.iter().map(of).collect()
    }
}
