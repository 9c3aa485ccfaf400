//! Fits of shapes: coordinates stretched, terms made of them, sums or products fitted.

use super::design::Design;
use super::product;
use super::rows::{Rows, range};
use super::shape::{Coordinate, Join, Scale, Shape};
use super::smooth::{self, Fit};

/// The rows and the terms with which scales are chosen. By hand: most fits are for these, and take
/// some milliseconds so.
const SCALE_ROWS: usize = 1024;
const SCALE_TERMS: usize = 92;

/// What another scale has to leave, relative to the plain one. By hand, unmeasured.
const WORTH: f64 = 0.7;

/// The rows of an output, and the scale of each input that suits a smooth fit.
pub(super) struct Fitting<'a> {
    pub rows: &'a Rows,
    scales: Vec<Scale>,
}

impl<'a> Fitting<'a> {
    /// Chooses the scale of each of some inputs, one after the other.
    pub fn new(rows: &'a Rows, inputs: &[usize]) -> Fitting<'a> {
        let mut fitting = Fitting { rows, scales: vec![Scale::Linear; rows.inputs.len()] };
        let count = rows.len().min(SCALE_ROWS);
        let shape = Shape::of_inputs(inputs);
        for (at, &input) in inputs.iter().enumerate() {
            let scales = fitting.scales_of(&shape);
            fitting.scales[input] = fitting.best_scale(&shape, &scales, at, count);
        }
        fitting
    }

    fn scales_of(&self, shape: &Shape) -> Vec<Scale> {
        let of = |coordinate: &Coordinate| match coordinate {
            Coordinate::Input(input) => self.scales[*input],
            _ => Scale::Linear,
        };
        shape.coordinates.iter().map(of).collect()
    }

    fn best_scale(&self, shape: &Shape, scales: &[Scale], at: usize, count: usize) -> Scale {
        let coordinate = shape.coordinates[at];
        // Ends that rows further on reach are the same for all fits.
        let all = coordinate.values(self.rows, self.rows.len());
        let mut best = scales[at];
        let mut least = f64::INFINITY;
        let sum = Shape { join: Join::Sum, ..shape.clone() };
        for scale in Scale::suitable(&all) {
            let mut tried = scales.to_vec();
            tried[at] = scale;
            let mut design = self.design(&sum, &tried, count);
            design.truncate_to(SCALE_TERMS);
            let left = smooth::fit(self.rows, &design).residual;
            if least.is_infinite() || left < WORTH * least {
                (best, least) = (scale, left);
            }
        }
        best
    }

    fn design(&self, shape: &Shape, scales: &[Scale], count: usize) -> Design {
        let columns = self.columns(shape, scales, count);
        let mut design = Design::new(count, columns, &shape.parts, shape.symmetric);
        if let Some(highest) = shape.highest_degree {
            design.truncate(highest);
        }
        design.factor = shape.odd.map(|(input, centre)| {
            self.rows.inputs[input][..count].iter().map(|x| x - centre).collect()
        });
        design
    }

    fn columns(&self, shape: &Shape, scales: &[Scale], count: usize) -> Vec<Vec<f64>> {
        let ends: Vec<[f64; 2]> = shape.coordinates.iter().map(|c| self.ends(*c)).collect();
        let stretched = |at: usize| {
            let mut ends_of = ends[at];
            let mut scale = scales[at];
            // What may be exchanged is stretched alike.
            if let Some((a, b)) = shape.symmetric.filter(|&(a, b)| at == a || at == b) {
                ends_of = [ends[a][0].min(ends[b][0]), ends[a][1].max(ends[b][1])];
                scale = if scales[a] == scales[b] { scale } else { Scale::Linear };
            }
            scale.stretched(&shape.coordinates[at].values(self.rows, count), ends_of)
        };
        (0..shape.coordinates.len()).map(stretched).collect()
    }

    fn ends(&self, coordinate: Coordinate) -> [f64; 2] {
        match coordinate {
            Coordinate::Input(input) => self.rows.range(input),
            Coordinate::Cosine(..) | Coordinate::Sine(..) => [-1.0, 1.0],
            _ => range(&coordinate.values(self.rows, self.rows.len())),
        }
    }

    /// Fits a shape to the first rows.
    pub fn fit(&self, shape: &Shape, count: usize) -> Fit {
        let most = if shape.join == Join::Product { product::MOST_ROWS } else { usize::MAX };
        let count = count.min(self.rows.len()).min(most);
        let small = count.min(SCALE_ROWS);
        let mut scales = self.scales_of(shape);
        for (at, coordinate) in shape.coordinates.iter().enumerate() {
            if matches!(coordinate, Coordinate::Pair(..) | Coordinate::Folded(..)) {
                scales[at] = self.best_scale(shape, &scales, at, small);
            }
        }
        match shape.join {
            Join::Sum => smooth::fit(self.rows, &self.design(shape, &scales, count)),
            Join::Product => {
                let joint = Shape { odd: shape.odd, ..Shape::joint(shape.coordinates.clone()) };
                let design = self.design(&joint, &scales, count);
                let fitted = smooth::fit(self.rows, &design);
                product::fit(self.rows, &shape.parts, (&design, &fitted))
            }
        }
    }
}
