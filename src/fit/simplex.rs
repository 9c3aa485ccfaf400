//! The simplex of Nelder and Mead, and one step of it.

use super::Range;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// The coefficients of reflection, expansion, contraction and reduction, as Nelder and Mead and the
/// course notes have them.
const REFLECTION: f64 = 1.0;
const EXPANSION: f64 = 2.0;
const CONTRACTION: f64 = -0.5;
const REDUCTION: f64 = 0.5;

/// A corner: a position on the scale of each range, and the function's value there.
#[derive(Clone)]
struct Vertex {
    at: Vec<f64>,
    value: f64,
}

/// Corners one more than dimensions, from the least value to the largest.
pub(super) struct Simplex {
    vertices: Vec<Vertex>,
    centroid: Vec<f64>,
    reflected: Vertex,
    other: Vertex,
}

impl Simplex {
    /// Makes a simplex at a position whose value is known, the other corners about a step away.
    ///
    /// Corner i is at least half a step away along axis i, to the side where there is room, and at
    /// most half a step, in units of each axis's step, along all others together. The edges then
    /// form a diagonally dominant matrix, which is not singular: the corners are never coplanar.
    pub fn around(
        (at, value): (&[f64], f64),
        steps: &[f64],
        ranges: &[Range],
        rng: &mut ChaCha8Rng,
        evaluate: &mut dyn FnMut(&[f64]) -> f64,
    ) -> Simplex {
        let dimensions = at.len();
        let first = Vertex { at: at.to_vec(), value };
        let mut vertices = vec![first.clone()];
        for own in 0..dimensions {
            let mut corner = first.clone();
            for (axis, range) in ranges.iter().enumerate() {
                let share = match axis == own {
                    true => rng.random_range(0.5..1.0),
                    false => rng.random_range(0.0..0.5) / dimensions as f64,
                };
                let sign = if rng.random() { 1.0 } else { -1.0 };
                let distance = sign * share * steps[axis];
                let there = at[axis] + distance;
                let is_room = range.contains(there);
                corner.at[axis] = if is_room { there } else { range.clamp(at[axis] - distance) };
            }
            corner.value = evaluate(&corner.at);
            vertices.push(corner);
        }
        let mut simplex = Simplex {
            vertices,
            centroid: vec![0.0; dimensions],
            reflected: first.clone(),
            other: first,
        };
        simplex.sort();
        simplex
    }

    fn sort(&mut self) {
        self.vertices.sort_by(|a, b| a.value.total_cmp(&b.value));
    }

    /// Replaces the worst corner, or all but the best.
    pub fn step(&mut self, ranges: &[Range], evaluate: &mut dyn FnMut(&[f64]) -> f64) {
        let last = self.vertices.len() - 1;
        if last == 0 {
            return;
        }
        centroid_of(&self.vertices[..last], &mut self.centroid);
        let (best, worst) = (self.vertices[0].value, self.vertices[last].value);
        let next_to_worst = self.vertices[last - 1].value;
        let from = &self.vertices[last].at;
        let mut reach = |by: f64, to: &mut Vertex| {
            let along = self.centroid.iter().zip(from).zip(ranges).zip(&mut to.at);
            for (((centre, from), range), to) in along {
                *to = range.clamp(centre + by * (centre - from));
            }
            to.value = evaluate(&to.at);
        };
        reach(REFLECTION, &mut self.reflected);
        if self.reflected.value < best {
            reach(EXPANSION, &mut self.other);
            let is_better = self.other.value < self.reflected.value;
            let better = if is_better { &mut self.other } else { &mut self.reflected };
            std::mem::swap(&mut self.vertices[last], better);
        } else if self.reflected.value < next_to_worst {
            std::mem::swap(&mut self.vertices[last], &mut self.reflected);
        } else {
            reach(CONTRACTION, &mut self.other);
            if self.other.value < worst {
                std::mem::swap(&mut self.vertices[last], &mut self.other);
            } else {
                self.reduce(evaluate);
            }
        }
        self.sort();
    }

    fn reduce(&mut self, evaluate: &mut dyn FnMut(&[f64]) -> f64) {
        let (best, others) = self.vertices.split_at_mut(1);
        for vertex in others {
            for (to, best) in vertex.at.iter_mut().zip(&best[0].at) {
                *to = best + REDUCTION * (*to - best);
            }
            vertex.value = evaluate(&vertex.at);
        }
    }

    /// Returns true if no corner is further from the best one than a share of each axis's step.
    pub fn is_within(&self, share: f64, steps: &[f64]) -> bool {
        let best = &self.vertices[0].at;
        let is_near = |vertex: &Vertex| {
            let mut axes = vertex.at.iter().zip(best).zip(steps);
            axes.all(|((at, best), step)| (at - best).abs() <= share * step)
        };
        self.vertices[1..].iter().all(is_near)
    }

    pub fn best(&self) -> (&[f64], f64) {
        (&self.vertices[0].at, self.vertices[0].value)
    }

    /// Returns the centroid of all corners.
    pub fn centroid(&self) -> Vec<f64> {
        let mut centroid = vec![0.0; self.centroid.len()];
        centroid_of(&self.vertices, &mut centroid);
        centroid
    }
}

fn centroid_of(vertices: &[Vertex], centroid: &mut [f64]) {
    centroid.fill(0.0);
    for vertex in vertices {
        centroid.iter_mut().zip(&vertex.at).for_each(|(sum, at)| *sum += at);
    }
    centroid.iter_mut().for_each(|sum| *sum /= vertices.len() as f64);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Scale;
    use rand::SeedableRng;
    use std::collections::BTreeSet;

    fn sphere(at: &[f64]) -> f64 {
        at.iter().map(|x| x * x).sum()
    }

    /// A simplex of known corners.
    fn simplex(corners: &[[f64; 2]], f: fn(&[f64]) -> f64) -> Simplex {
        let vertex = |at: &[f64; 2]| Vertex { at: at.to_vec(), value: f(at) };
        let vertices: Vec<Vertex> = corners.iter().map(vertex).collect();
        let (reflected, other) = (vertices[0].clone(), vertices[0].clone());
        let mut simplex = Simplex { vertices, centroid: vec![0.0; 2], reflected, other };
        simplex.sort();
        simplex
    }

    /// The corners after one step, and the number of evaluations.
    fn stepped(corners: &[[f64; 2]], f: fn(&[f64]) -> f64) -> (Vec<Vec<f64>>, u32) {
        let mut simplex = simplex(corners, f);
        let mut count = 0;
        simplex.step(&[Range::ANY; 2], &mut |at| {
            count += 1;
            f(at)
        });
        (simplex.vertices.iter().map(|vertex| vertex.at.clone()).collect(), count)
    }

    #[test]
    fn each_move_is_the_one_that_the_values_ask_for() {
        // The worst corner (0, 0) goes to (2, 2) by reflection, to (3, 3) by expansion.
        let corners = [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]];
        let (expanded, count) = stepped(&corners, |x| -x[0] - x[1]);
        assert_eq!((expanded[0].as_slice(), count), (&[3.0, 3.0][..], 2));
        // Beyond (2, 2) it is worse again.
        let (reflected, count) = stepped(&corners, |x| (x[0] - 2.0).powi(2) + (x[1] - 2.0).powi(2));
        assert_eq!((reflected[0].as_slice(), count), (&[2.0, 2.0][..], 2));
        // The reflected point is between the best and the next: it is taken as it is.
        let (between, count) = stepped(&corners, |x| match (x[0], x[1]) {
            (2.0, 0.0) => 0.0,
            (2.0, 2.0) => 1.0,
            (0.0, 2.0) => 2.0,
            _ => 3.0,
        });
        assert_eq!((between[1].as_slice(), count), (&[2.0, 2.0][..], 1));
        // The centroid is (1, 1): halfway towards it.
        let (contracted, count) = stepped(&corners, |x| match (x[0], x[1]) {
            (0.5, 0.5) => 2.5,
            (2.0, 0.0) => 1.0,
            (0.0, 2.0) => 2.0,
            (0.0, 0.0) => 3.0,
            _ => 9.0,
        });
        assert_eq!((contracted[2].as_slice(), count), (&[0.5, 0.5][..], 2));
        // Nothing is better: all but the best come halfway to it.
        let (reduced, count) = stepped(&corners, |x| match (x[0], x[1]) {
            (2.0, 0.0) => 1.0,
            (0.0, 2.0) => 2.0,
            (0.0, 0.0) => 3.0,
            _ => 9.0,
        });
        assert_eq!(count, 4);
        assert!(reduced.contains(&vec![2.0, 0.0]) && reduced.contains(&vec![1.0, 0.0]));
        assert!(reduced.contains(&vec![1.0, 1.0]), "{reduced:?}");
    }

    #[test]
    fn first_corners_are_never_coplanar_and_stay_within_ranges() {
        for dimensions in [1, 2, 3, 8] {
            let ranges = vec![Range::new(-1.0, 1.0, Scale::Linear).unwrap(); dimensions];
            let steps = vec![0.5; dimensions];
            for seed in 0..50 {
                let mut rng = ChaCha8Rng::seed_from_u64(seed);
                // In a corner of the ranges half of the perturbations would leave them.
                let at = vec![if seed % 2 == 0 { 1.0 } else { -1.0 }; dimensions];
                let mut plain = sphere;
                let simplex = Simplex::around((&at, 1.0), &steps, &ranges, &mut rng, &mut plain);
                let edges: Vec<Vec<f64>> = simplex
                    .vertices
                    .iter()
                    .filter(|vertex| vertex.at != at)
                    .map(|vertex| vertex.at.iter().zip(&at).map(|(x, y)| (x - y) / 0.5).collect())
                    .collect();
                assert_eq!(edges.len(), dimensions);
                assert!(edges.iter().flatten().all(|edge| edge.abs() <= 1.0), "{edges:?}");
                // A row a dominant element, each in a column of its own: not singular.
                let mut columns = BTreeSet::new();
                for edge in &edges {
                    let sizes = || edge.iter().map(|x| x.abs()).enumerate();
                    let (own, largest) = sizes().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
                    let all: f64 = sizes().map(|(_, size)| size).sum();
                    assert!(largest > all - largest, "{dimensions} {seed}: {edge:?}");
                    columns.insert(own);
                }
                assert_eq!(columns.len(), dimensions);
                let is_inside = |x: &f64| (-1.0..=1.0).contains(x);
                assert!(simplex.vertices.iter().all(|vertex| vertex.at.iter().all(is_inside)));
            }
        }
    }

    #[test]
    fn corners_stay_within_ranges() {
        let range = Range::new(-1.0, 3.0, Scale::Linear).unwrap();
        let mut simplex = simplex(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], |x| x[0] - x[1]);
        for _ in 0..30 {
            simplex.step(&[range; 2], &mut |x| x[0] - x[1]);
            let mut corners = simplex.vertices.iter().flat_map(|vertex| &vertex.at);
            assert!(corners.all(|x| range.contains(*x)));
        }
        assert_eq!(simplex.best(), (&[-1.0, 3.0][..], -4.0));
    }
}
