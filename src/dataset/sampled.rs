//! Datasets of functions that are at hand.

use super::{Column, Dataset, Error, Split, domain_of};
use std::ops::RangeInclusive;

/// Points along each axis of a search grid: about 4096 in all where there are several inputs.
const POINTS: [usize; 4] = [256, 64, 16, 8];

/// An input of a function, and where it is sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub name: String,
    /// `1` where it has none.
    pub unit: String,
    pub domain: RangeInclusive<f64>,
}

/// An input without a unit.
pub fn axis(name: &str, domain: RangeInclusive<f64>) -> Axis {
    Axis { name: name.to_owned(), unit: "1".to_owned(), domain }
}

impl Axis {
    fn at(&self, u: f64) -> f32 {
        let (low, high) = (self.domain.start(), self.domain.end());
        (low + u * (high - low)) as f32
    }

    /// Centres of equal cells.
    fn centres(&self, cells: usize) -> Vec<f32> {
        (0..cells).map(|i| self.at((i as f64 + 0.5) / cells as f64)).collect()
    }

    /// From end to end; an odd number of intervals, so that none is a centre of an even number of cells.
    fn nodes(&self, intervals: usize) -> Vec<f32> {
        (0..=intervals).map(|k| self.at(k as f64 / intervals as f64)).collect()
    }
}

impl Dataset {
    /// A function of a few inputs, sampled on regular grids: at the centres of cells to search on, and to
    /// validate on a denser grid with the domain's edges. (Along an axis: 256 cells, 64 of two axes, 16 of
    /// three, 8 of more.)
    ///
    /// ```
    /// use lgp::dataset::{Dataset, axis};
    ///
    /// let axes = [axis("x", 0.0..=1.0), axis("roughness", 0.01..=1.0)];
    /// let data = Dataset::sampled(axes, ["y"], |[x, r]| [(-3.0 * x).exp() * (1.0 - 0.5 * r)])?;
    /// assert_eq!(data.search.rows(), 64 * 64);
    /// # Ok::<(), lgp::dataset::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error`]: names that are no identifiers, domains without extent, values that are not finite.
    pub fn sampled<const N: usize, const M: usize>(
        axes: [Axis; N],
        outputs: [&str; M],
        function: impl Fn([f64; N]) -> [f64; M],
    ) -> Result<Dataset, Error> {
        let cells = POINTS[N.clamp(1, POINTS.len()) - 1];
        let grid = |along: &dyn Fn(&Axis) -> Vec<f32>| {
            let along: Vec<Vec<f32>> = axes.iter().map(along).collect();
            let rows = along.iter().map(Vec::len).product();
            let mut split = Split {
                columns: vec![Vec::with_capacity(rows); N + M],
                grid: along.iter().map(Vec::len).collect(),
                ..Split::default()
            };
            for row in 0..rows {
                let mut point = [0.0; N];
                let mut rest = row;
                for (x, nodes) in point.iter_mut().zip(&along).rev() {
                    *x = f64::from(nodes[rest % nodes.len()]);
                    rest /= nodes.len();
                }
                let values = point.into_iter().chain(function(point));
                split.columns.iter_mut().zip(values).for_each(|(column, x)| column.push(x as f32));
            }
            split
        };
        let search = grid(&|axis| axis.centres(cells));
        let validation = grid(&|axis| axis.nodes(cells * 3 / 2 + 1));
        let input = |axis: &Axis| Column {
            name: axis.name.clone(),
            unit: axis.unit.clone(),
            domain: [*axis.domain.start(), *axis.domain.end()],
        };
        let output = |(name, index): (&str, usize)| Column {
            name: name.to_owned(),
            unit: "1".to_owned(),
            domain: domain_of(&search, &validation, index),
        };
        let dataset = Dataset {
            name: outputs.join("_"),
            recipe: "a function, sampled".to_owned(),
            inputs: axes.iter().map(input).collect(),
            outputs: outputs.into_iter().zip(N..).map(output).collect(),
            search,
            validation,
        };
        dataset.validate()?;
        Ok(dataset)
    }
}
