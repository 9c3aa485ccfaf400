//! The points of a tile: as many in each.

use super::Tile;
use crate::quadrature::Rule;
use crate::truth::sampling::low_discrepancy;

/// The Gauss points along each axis, by the number of axes. By hand: tiles of 8, 16 and 8 points.
const GAUSS: [usize; 3] = [8, 4, 2];
/// The points of a tile of more axes, by Sobol's sequence. By hand.
const SCATTERED: u64 = 32;

/// A point of a tile, in coordinates of the tile from 0 to 1, and its share of the tile's volume.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub at: Vec<f64>,
    pub share: f64,
}

/// The rule by which a mean over a tile is estimated.
#[derive(Clone, Debug)]
pub(super) struct Points {
    axes: usize,
    inner: Inner,
}

#[derive(Clone, Debug)]
enum Inner {
    /// The product of a rule for [0, 1], its nodes and weights, with itself.
    Gauss(Vec<(f64, f64)>),
    Scattered(Vec<Vec<f64>>),
}

impl Points {
    pub fn new(axes: usize) -> Points {
        let inner = match GAUSS.get(axes.wrapping_sub(1)) {
            Some(&points) => {
                // Without the coarser rule's nodes.
                let rule = Rule::gauss_legendre(points);
                let nodes = rule.points().iter().filter(|point| point.weight > 0.0);
                Inner::Gauss(nodes.map(|at| (0.5 + 0.5 * at.node, 0.5 * at.weight)).collect())
            }
            None => Inner::Scattered(low_discrepancy(0..SCATTERED, axes).points),
        };
        Points { axes, inner }
    }

    /// Returns the number of points of a tile in the middle.
    pub fn count(&self) -> usize {
        match &self.inner {
            Inner::Gauss(rule) => rule.len().pow(self.axes as u32),
            Inner::Scattered(points) => points.len(),
        }
    }

    /// Returns the points of a tile. Where few axes meet an end of the domain, there are points at
    /// the end, too, of share 0: errors are often largest there.
    pub fn of(&self, tile: &Tile) -> Vec<Place> {
        let rule = match &self.inner {
            Inner::Gauss(rule) => rule,
            Inner::Scattered(points) => {
                let share = 1.0 / points.len() as f64;
                return points.iter().map(|at| Place { at: at.clone(), share }).collect();
            }
        };
        let mut places = vec![Place { at: Vec::new(), share: 1.0 }];
        for axis in 0..self.axes {
            let [low, high] = tile.ends(axis);
            let low = (low == 0.0).then_some((0.0, 0.0));
            let high = (high == 1.0).then_some((1.0, 0.0));
            let along: Vec<(f64, f64)> =
                low.into_iter().chain(rule.iter().copied()).chain(high).collect();
            let longer = places.iter().flat_map(|place| {
                along.iter().map(|&(x, share)| Place {
                    at: place.at.iter().copied().chain([x]).collect(),
                    share: place.share * share,
                })
            });
            places = longer.collect();
        }
        places
    }
}
