//! The choice of the tiles that are halved, and of those that are joined.

use super::{Mesh, Rows, Tile};
use std::collections::HashSet;
use std::ops::Range;

/// What is made small of a formula's errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Norm {
    /// Their mean square.
    Mean,
    /// The largest.
    Largest,
}

/// The least ratio of a tile's unevenness to the mean at which it is halved, and the largest of two
/// halves together at which they are joined. By hand: halving divides it by two to four.
const UNEVEN: f64 = 2.0;
const EVEN: f64 = 0.5;

/// The most tiles that are halved at a time, as a share of all: a tile's unevenness is known once it
/// is sampled. By hand.
const AT_A_TIME: f64 = 0.25;

/// The most halvings by which tiles are larger than equal ones, so that what turns up later is not
/// overlooked. By hand: a quarter of the density.
const COARSER: usize = 2;

impl Mesh {
    /// Halves tiles where errors are uneven and joins others where they are not, so that the number
    /// of tiles stays about that of equal ones. `squares` are the squares of several formulas'
    /// errors at [`Mesh::rows`]. Returns the number of tiles to be sampled anew.
    ///
    /// # Panics
    /// If tiles are not sampled ([`Mesh::sample`]), or there are fewer squares than rows.
    pub fn refine(&mut self, squares: &[Vec<f64>], norm: Norm) -> usize {
        let unevenness = self.unevenness(squares, norm);
        let mean = unevenness.iter().map(|one| one.size).sum::<f64>() / self.tiles.len() as f64;
        if mean <= 0.0 || !mean.is_finite() {
            return 0;
        }
        let halved = self.to_be_halved(&unevenness, UNEVEN * mean);
        let joined = self.to_be_joined(&unevenness, &halved, EVEN * mean);
        // As many more as joining makes room for.
        let room = (self.usual + joined.len()).saturating_sub(self.tiles.len());
        let halved: HashSet<usize> = halved.into_iter().take(room).collect();
        // Joining alone would gain nothing.
        let joined: HashSet<usize> = joined
            .into_iter()
            .take((self.tiles.len() + halved.len()).saturating_sub(self.usual))
            .collect();
        self.exchange(&unevenness, &halved, &joined)
    }

    /// Returns the tiles above a size, the most uneven first.
    fn to_be_halved(&self, unevenness: &[Unevenness], least: f64) -> Vec<usize> {
        let can_be = |&place: &usize| {
            unevenness[place].size > least
                && self.tiles[place].halved(unevenness[place].axis).is_some()
        };
        let mut halved: Vec<usize> = (0..self.tiles.len()).filter(can_be).collect();
        halved.sort_by(|&a, &b| unevenness[b].size.total_cmp(&unevenness[a].size));
        halved.truncate((AT_A_TIME * self.tiles.len() as f64).ceil() as usize);
        halved
    }

    /// Returns the first of each two halves that are together below a size, the most even first.
    fn to_be_joined(&self, unevenness: &[Unevenness], halved: &[usize], most: f64) -> Vec<usize> {
        let both = |place: usize| unevenness[place].size + unevenness[place + 1].size;
        let least_depth = self.usual_depth.saturating_sub(COARSER);
        let can_be = |&place: &usize| {
            let [lower, upper] = [&self.tiles[place], &self.tiles[place + 1]];
            both(place) < most
                && lower.joined(upper).is_some_and(|whole| whole.depth() >= least_depth)
                && !halved.contains(&place)
                && !halved.contains(&(place + 1))
        };
        let last = self.tiles.len() - 1;
        let mut joined: Vec<usize> = (0..last).filter(can_be).collect();
        joined.sort_by(|&a, &b| both(a).total_cmp(&both(b)));
        joined
    }

    fn exchange(
        &mut self,
        unevenness: &[Unevenness],
        halved: &HashSet<usize>,
        joined: &HashSet<usize>,
    ) -> usize {
        let mut tiles = Vec::with_capacity(self.tiles.len() + halved.len());
        let mut place = 0;
        while let Some(tile) = self.tiles.get(place) {
            let whole = joined.contains(&place).then(|| tile.joined(&self.tiles[place + 1]));
            if let Some(whole) = whole.flatten() {
                tiles.push(whole);
                place += 2;
                continue;
            }
            match tile.halved(unevenness[place].axis).filter(|_| halved.contains(&place)) {
                Some(halves) => tiles.extend(halves),
                None => tiles.push(tile.clone()),
            }
            place += 1;
        }
        self.tiles = tiles;
        let current: HashSet<&Tile> = self.tiles.iter().collect();
        self.known.retain(|tile, _| current.contains(tile));
        self.tiles.len() - self.known.len()
    }

    /// Returns each tile's unevenness, the largest of any formula.
    fn unevenness(&self, squares: &[Vec<f64>], norm: Norm) -> Vec<Unevenness> {
        let tiles: Vec<(&Tile, &Rows, Range<usize>)> = (self.tiles.iter().zip(self.spans()))
            .map(|(tile, span)| (tile, &*self.known[tile], span))
            .collect();
        let mut worst = vec![Unevenness { size: 0.0, axis: 0 }; tiles.len()];
        for squares in squares {
            let total: f64 = match norm {
                Norm::Mean => (tiles.iter())
                    .map(|(tile, rows, span)| {
                        tile.volume() * mean(&rows.shares, &squares[span.clone()])
                    })
                    .sum(),
                Norm::Largest => squares.iter().copied().fold(0.0, f64::max).sqrt(),
            };
            if !(total > 0.0 && total.is_finite()) {
                continue;
            }
            for ((tile, rows, span), worst) in tiles.iter().zip(&mut worst) {
                let squares = &squares[span.clone()];
                let size = match norm {
                    Norm::Mean => tile.volume() * spread(rows, squares) / total,
                    Norm::Largest => excess(squares, total),
                };
                if size > worst.size {
                    *worst = Unevenness { size, axis: axis_of_change(tile, rows, squares) };
                }
            }
        }
        worst
    }
}

/// How much is uncertain of a formula's error because of a tile, and the axis along which halving it
/// tells most.
#[derive(Clone, Copy, Debug)]
struct Unevenness {
    size: f64,
    axis: usize,
}

fn mean(shares: &[f64], values: &[f64]) -> f64 {
    shares.iter().zip(values).map(|(share, value)| share * value).sum()
}

/// Returns the standard deviation of values in a tile: what a random sample of it would be
/// uncertain by, so that tiles of equal spread times volume are those of optimal stratification.
fn spread(rows: &Rows, values: &[f64]) -> f64 {
    let middle = mean(&rows.shares, values);
    let squares = rows.shares.iter().zip(values).map(|(share, v)| share * (v - middle).powi(2));
    squares.sum::<f64>().sqrt()
}

/// Returns by what share of the largest error elsewhere that between a tile's samples may be larger
/// still: as much above the tile's largest as that is above its mean, at most.
fn excess(squares: &[f64], largest: f64) -> f64 {
    let top = squares.iter().copied().fold(0.0, f64::max).sqrt();
    let mean = squares.iter().map(|square| square.sqrt()).sum::<f64>() / squares.len() as f64;
    ((2.0 * top - mean) / largest - 1.0).max(0.0)
}

/// The parts of a tile along an axis, between whose means values change.
const PARTS: usize = 4;

/// Returns the axis along which values change most: whose parts' means differ most; of equals, the
/// one along which the tile is longest.
pub(super) fn axis_of_change(tile: &Tile, rows: &Rows, values: &[f64]) -> usize {
    let axes = rows.at.first().map_or(0, Vec::len);
    let change = |axis: usize| {
        let mut parts = [(0.0, 0.0); PARTS];
        for ((at, share), value) in rows.at.iter().zip(&rows.shares).zip(values) {
            let part = ((at[axis] * PARTS as f64) as usize).min(PARTS - 1);
            parts[part].0 += share;
            parts[part].1 += share * value;
        }
        let whole = mean(&rows.shares, values);
        let means = parts.iter().filter(|(share, _)| *share > 0.0);
        means.map(|(share, sum)| share * (sum / share - whole).powi(2)).sum::<f64>()
    };
    let key = |&axis: &usize| (change(axis), std::cmp::Reverse(tile.level(axis)));
    let order = |a: &usize, b: &usize| {
        let ((a, a_level), (b, b_level)) = (key(a), key(b));
        a.total_cmp(&b).then(a_level.cmp(&b_level))
    };
    // The first of equals.
    (0..axes).rev().max_by(order).unwrap_or(0)
}
