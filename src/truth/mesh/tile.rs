//! Tiles: the boxes that halvings cut out of the unit cube.

use serde::{Deserialize, Serialize};

/// The most halvings of an axis: beyond them, points of a tile would be equal as `f32`.
const DEEPEST: usize = 20;

/// One halving of a box along an axis, and the half that is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
struct Half {
    axis: u8,
    upper: bool,
}

/// A box of the unit cube. Tiles that cover it are in order if those of lower halves come first.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Tile {
    halves: Vec<Half>,
}

impl Tile {
    /// Returns its ends along an axis.
    pub fn ends(&self, axis: usize) -> [f64; 2] {
        let along = self.halves.iter().filter(|half| usize::from(half.axis) == axis);
        along.fold([0.0, 1.0], |[low, high], half| {
            let middle = 0.5 * (low + high);
            if half.upper { [middle, high] } else { [low, middle] }
        })
    }

    /// Returns its volume.
    pub fn volume(&self) -> f64 {
        0.5_f64.powi(self.depth() as i32)
    }

    /// Returns the number of halvings that lead to it.
    pub fn depth(&self) -> usize {
        self.halves.len()
    }

    /// Returns the number of those along an axis.
    pub fn level(&self, axis: usize) -> usize {
        self.halves.iter().filter(|half| usize::from(half.axis) == axis).count()
    }

    /// Returns both halves along an axis; none if they would be too narrow.
    pub fn halved(&self, axis: usize) -> Option<[Tile; 2]> {
        let half = |upper| {
            let half = Half { axis: axis as u8, upper };
            Tile { halves: self.halves.iter().copied().chain([half]).collect() }
        };
        (self.level(axis) < DEEPEST).then(|| [false, true].map(half))
    }

    /// Returns the tile that another and this are the halves of.
    pub fn joined(&self, other: &Tile) -> Option<Tile> {
        let ([whole @ .., a], [other @ .., b]) = (&*self.halves, &*other.halves) else {
            return None;
        };
        let are_halves = whole == other && a.axis == b.axis && a.upper != b.upper;
        are_halves.then(|| Tile { halves: whole.to_vec() })
    }
}

/// Returns true if the tiles, in order, cover the cube of so many axes.
pub(super) fn cover(tiles: &[Tile], axes: usize) -> bool {
    let mut open: Vec<Tile> = Vec::new();
    for tile in tiles {
        let fits = |half: &Half| usize::from(half.axis) < axes;
        let levels = (0..axes).all(|axis| tile.level(axis) <= DEEPEST);
        if !tile.halves.iter().all(fits) || !levels {
            return false;
        }
        open.push(tile.clone());
        while let [.., lower, upper] = open.as_slice() {
            let in_order = upper.halves.last().is_some_and(|half| half.upper);
            let Some(whole) = lower.joined(upper).filter(|_| in_order) else { break };
            open.truncate(open.len() - 2);
            open.push(whole);
        }
    }
    open == [Tile::default()]
}

/// Returns equal tiles in order, at most so many: each axis is halved in turn.
pub(super) fn equal(axes: usize, most: usize) -> Vec<Tile> {
    let mut tiles = vec![Tile::default()];
    for axis in (0..axes).cycle() {
        if 2 * tiles.len() > most {
            break;
        }
        let halves: Option<Vec<[Tile; 2]>> = tiles.iter().map(|tile| tile.halved(axis)).collect();
        let Some(halves) = halves else { break };
        tiles = halves.into_flattened();
    }
    tiles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_tiles_cover_the_cube() {
        let tiles = equal(2, 40);
        assert_eq!(tiles.len(), 32);
        assert!(tiles.is_sorted() && cover(&tiles, 2));
        assert_eq!(tiles[0].ends(0), [0.0, 0.125]);
        assert_eq!(tiles[0].ends(1), [0.0, 0.25]);
        assert_eq!(tiles.iter().map(Tile::volume).sum::<f64>(), 1.0);
    }

    #[test]
    fn tiles_that_do_not_cover_the_cube_are_recognised() {
        let mut tiles = equal(2, 4);
        let [lower, upper] = tiles[1].halved(0).unwrap();
        assert_eq!(lower.joined(&upper), Some(tiles[1].clone()));
        assert_eq!(lower.joined(&tiles[0]), None);
        tiles.splice(1..2, [lower, upper]);
        assert!(cover(&tiles, 2) && !cover(&tiles, 1));
        tiles.swap(1, 2);
        assert!(!cover(&tiles, 2));
        tiles.swap(1, 2);
        tiles.remove(2);
        assert!(!cover(&tiles, 2) && !cover(&[], 2));
    }
}
