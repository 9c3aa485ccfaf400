//! Tables of fitted lines.

use super::line::{spread, write_bump};
use super::{Curves, Lines};
use crate::dataset::{Column, Dataset, Origin, Split};
use crate::eval::{Evaluator, Samples, Tape};
use crate::program::{Arg, Draft, Program};

/// The rows of a curve's table.
const TABLE: usize = 256;

/// The bumps by which its rows are weighed, and the least weight beside the largest.
const BUMPS: usize = 32;
const LEAST_WEIGHT: f64 = 1e-4;

/// The height of a bump, as a share of the range of the line's values. By hand: small beside what
/// is found, large beside rounding.
const BUMP: f32 = 1e-3;

impl Curves<'_> {
    /// Returns a line as a table over what it is called with, weighted by what its values do to the
    /// outputs; none if that is hardly anything.
    pub(super) fn table(&self, hole: usize, lines: &Lines) -> Option<Dataset> {
        let arguments = self.arguments(hole, &lines.child);
        let x = spread(&arguments, TABLE);
        let [low, high] = [*x.first()?, *x.last()?];
        let y = self.values(hole, &lines.child, &x)?;
        let height = BUMP
            * (y.iter().copied().fold(f32::MIN, f32::max)
                - y.iter().copied().fold(f32::MAX, f32::min));
        let weights = self.weights(hole, &lines.child, &arguments, &x, height);
        let split = Split { columns: vec![x, y], weights, ..Split::default() };
        let input = Column::new("x", [low.into(), high.into()]);
        let origin = Origin::Formula { text: "a curve of a template".to_owned() };
        let splits = [split.clone(), split];
        Dataset::of_splits("curve", origin, vec![input], [("y", "1")], splits).ok()
    }

    /// Returns a child's curve over some arguments.
    fn values(&self, hole: usize, child: &Draft, x: &[f32]) -> Option<Vec<f32>> {
        let curve = Draft { outputs: vec![child.outputs[hole]], ..child.clone() };
        let curve = Program::verify(curve).ok()?;
        let input = self.holes[hole].inputs()[0];
        let column = |i| if i == input { x.to_vec() } else { vec![0.0; x.len()] };
        let columns = (0..curve.inputs).map(column).collect();
        let samples = Samples::new(&Split { columns, ..Split::default() }, curve.inputs);
        let values = Evaluator::default().outputs(&Tape::new(&curve), &samples);
        Some(values.iter().flatten().copied().collect())
    }

    /// Returns a weight of each of some arguments: the sum of squares over all outputs that a bump
    /// around it makes, by how many arguments lie below the bump.
    fn weights(
        &self,
        hole: usize,
        child: &Draft,
        arguments: &[f32],
        x: &[f32],
        height: f32,
    ) -> Vec<f32> {
        let places = spread(arguments, BUMPS);
        let Some(formula) = self.outputs(child) else { return Vec::new() };
        let weight = |place: usize| {
            let [left, top, right] =
                [place.saturating_sub(1), place, (place + 1).min(places.len() - 1)]
                    .map(|i| places[i]);
            let below = arguments.iter().filter(|x| (left..=right).contains(x)).count();
            let mut bumpy = child.clone();
            let input = Arg::Input(self.holes[hole].inputs()[0] as u16);
            bumpy.outputs[hole] =
                write_bump(&mut bumpy, child.outputs[hole], input, [left, top, right], height);
            let changed = self.outputs(&bumpy)?;
            let squares = formula.iter().zip(&changed).map(|(a, b)| f64::from(a - b).powi(2));
            Some(squares.filter(|square| square.is_finite()).sum::<f64>() / below.max(1) as f64)
        };
        let Some(weights) = (0..places.len()).map(weight).collect::<Option<Vec<f64>>>() else {
            return Vec::new();
        };
        let largest = weights.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let nearest = |x: &f32| places.partition_point(|place| place < x).min(places.len() - 1);
        x.iter().map(|x| (weights[nearest(x)] / largest).max(LEAST_WEIGHT) as f32).collect()
    }

    /// Returns the outputs of a child on all rows, one after the other.
    fn outputs(&self, child: &Draft) -> Option<Vec<f32>> {
        let formula = Program::verify(self.template.outer().append(child)).ok()?;
        let values = Evaluator::default().outputs(&Tape::new(&formula), &self.rows);
        Some(values.iter().flatten().copied().collect())
    }
}
