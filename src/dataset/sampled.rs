//! Makes datasets by sampling functions.

use super::{Column, Dataset, Error, Origin, Split, domain_of};
use std::borrow::Cow;
use std::ops::RangeInclusive;

/// The points along each axis of a search grid, by the number of axes: about 4096 in all where
/// there are several. By hand, unmeasured.
const POINTS: [usize; 4] = [256, 64, 16, 8];

/// An input of a function, and the places where it is sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// An identifier.
    pub name: Cow<'static, str>,
    /// `1` if dimensionless.
    pub unit: Cow<'static, str>,
    /// The low and the high end.
    pub domain: [f64; 2],
    /// The scale on which samples are equidistant.
    pub spacing: Spacing,
    /// A place to sample instead of the domain's low end, if the function has no value there.
    pub least: Option<f64>,
}

/// The scale on which samples are equidistant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spacing {
    /// The value itself.
    Linear,
    /// The logarithm, for a domain above 0.
    Logarithmic,
}

/// Makes a dimensionless input.
pub fn axis(name: &str, domain: RangeInclusive<f64>) -> Axis {
    let domain = [*domain.start(), *domain.end()];
    Axis { name: name.to_owned().into(), domain, ..Axis::unit("") }
}

impl Axis {
    /// Makes a dimensionless input on [0, 1].
    pub const fn unit(name: &'static str) -> Axis {
        let (name, unit) = (Cow::Borrowed(name), Cow::Borrowed("1"));
        Axis { name, unit, domain: [0.0, 1.0], spacing: Spacing::Linear, least: None }
    }

    /// Maps `u` from [0, 1] to the domain.
    pub fn at(&self, u: f64) -> f32 {
        let [low, high] = self.domain;
        let value = match self.spacing {
            Spacing::Linear => low + u * (high - low),
            Spacing::Logarithmic => low * (high / low).powf(u),
        };
        value as f32
    }

    /// As [`Axis::at`], but not below what stands for the lower end.
    pub fn inside(&self, u: f64) -> f32 {
        let least = self.least.map_or(f32::NEG_INFINITY, |least| least as f32);
        self.at(u).max(least)
    }

    /// Returns the centres of equal cells.
    pub fn centres(&self, cells: usize) -> Vec<f32> {
        (0..cells).map(|i| self.at((i as f64 + 0.5) / cells as f64)).collect()
    }

    /// Returns equidistant nodes from end to end. Nodes of an odd number of intervals are never
    /// centres of an even number of cells.
    pub fn nodes(&self, intervals: usize) -> Vec<f32> {
        let mut nodes: Vec<f32> =
            (0..=intervals).map(|k| self.at(k as f64 / intervals as f64)).collect();
        if let Some(least) = self.least {
            nodes[0] = least as f32;
        }
        nodes
    }

    /// Returns the column of its samples.
    pub fn column(&self) -> Column {
        Column { unit: self.unit.clone().into(), ..Column::new(&self.name, self.domain) }
    }
}

impl Dataset {
    /// Samples a function of a few inputs on regular grids: the search split at the centres of
    /// cells, the validation split on a denser grid with the domain's edges. (Along an axis: 256
    /// cells, 64 of two axes, 16 of three, 8 of more.)
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
    /// [`Error`]: names that are not identifiers, domains without extent, values that are not
    /// finite.
    pub fn sampled<const N: usize, const M: usize>(
        axes: [Axis; N],
        outputs: [&str; M],
        function: impl Fn([f64; N]) -> [f64; M],
    ) -> Result<Dataset, Error> {
        let cells = POINTS[N.clamp(1, POINTS.len()) - 1];
        let grid = |along: fn(&Axis, usize) -> Vec<f32>, points| {
            let along: Vec<Vec<f32>> = axes.iter().map(|axis| along(axis, points)).collect();
            Split::on_grid(&along, |point| function(std::array::from_fn(|i| point[i])))
        };
        let splits = [grid(Axis::centres, cells), grid(Axis::nodes, cells * 3 / 2 + 1)];
        let origin = Origin::Formula { text: "a function, sampled".to_owned() };
        let inputs = axes.iter().map(Axis::column).collect();
        Dataset::of_splits(
            &outputs.join("_"),
            origin,
            inputs,
            outputs.map(|name| (name, "1")),
            splits,
        )
    }

    /// Makes a dataset of a search and a validation split, under the inputs and the outputs' names
    /// and units. An output's domain is the range of its values.
    ///
    /// # Errors
    /// As [`Dataset::validate`].
    pub fn of_splits<'a>(
        name: &str,
        origin: Origin,
        inputs: Vec<Column>,
        outputs: impl IntoIterator<Item = (&'a str, &'a str)>,
        [search, validation]: [Split; 2],
    ) -> Result<Dataset, Error> {
        let output = |((name, unit), index): ((&str, &str), usize)| Column {
            name: name.to_owned(),
            unit: unit.to_owned(),
            domain: domain_of(&search, &validation, index),
        };
        let outputs = outputs.into_iter().zip(inputs.len()..).map(output).collect();
        let name = name.to_owned();
        let claims = Vec::new();
        let dataset = Dataset { name, origin, inputs, outputs, claims, search, validation };
        dataset.validate()?;
        Ok(dataset)
    }
}

impl Split {
    /// Evaluates a function at every combination of places along each input, the last input varying
    /// fastest.
    pub fn on_grid<const M: usize>(
        along: &[Vec<f32>],
        function: impl Fn(&[f64]) -> [f64; M],
    ) -> Split {
        let mut columns = vec![Vec::new(); along.len() + M];
        for point in combinations(along) {
            let exact: Vec<f64> = point.iter().copied().map(f64::from).collect();
            let row = point.into_iter().chain(function(&exact).map(|value| value as f32));
            columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
        }
        Split { columns, grid: along.iter().map(Vec::len).collect(), ..Split::default() }
    }
}

/// Returns every combination of one value per axis, the last axis varying fastest.
pub(crate) fn combinations(along: &[Vec<f32>]) -> Vec<Vec<f32>> {
    along.iter().fold(vec![Vec::new()], |points, values| {
        let longer = |point: &Vec<f32>, value| [point.as_slice(), &[value]].concat();
        points.iter().flat_map(|point| values.iter().map(move |&v| longer(point, v))).collect()
    })
}

/// Returns the weights of a grid's rows: products of the weights along each axis.
pub fn grid_weights(along: &[Vec<f64>]) -> Vec<f32> {
    let areas = along.iter().fold(vec![1.0], |areas: Vec<f64>, lengths| {
        areas.iter().flat_map(|area| lengths.iter().map(move |length| area * length)).collect()
    });
    areas.into_iter().map(|area| area as f32).collect()
}
