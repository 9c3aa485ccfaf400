//! Truths: functions that can be evaluated anywhere, and the datasets of their values.
//!
//! A [`Truth`] is made of a formula, in double precision ([`Truth::formula`]), or of a function of a
//! shader. Its dataset is sampled on regular grids ([`Grids`]), or where there are more than three
//! inputs at low-discrepancy points.
//!
//! ```
//! use lgp::truth::{Truth, parse_domain};
//!
//! let domain = parse_domain("x=0..1,alpha=1e-3..1:log")?;
//! let truth = Truth::formula("y = (1 - cos(x*alpha))/(alpha*alpha)", &[], &domain)?;
//! let exact = truth.at(&[0.5, 1e-3])?[0];
//! assert!((exact - 0.125).abs() < 1e-8);
//! let data = truth.dataset(None, &|_, _| ())?;
//! assert_eq!(data.search.rows(), 66 * 66);
//! # Ok::<(), lgp::truth::Error>(())
//! ```

mod domain;
mod error;
mod formula;
mod mesh;
mod parallel;
mod sampling;
mod splits;

pub use domain::{axes_of, column_name, parse_domain, write_domain};
pub use error::Error;
pub use formula::{exact_formula, formula_of, read_formula};
pub use mesh::{DomainError, Formulas, Mesh, Norm, Tile};
pub use sampling::{MOST_AXES, Sampling};
pub use splits::{Grids, Progress, Value, scattered_splits};

use crate::dataset::{Axis, Column, Dataset, Origin, Split, domain_of};
use std::fmt;
use std::sync::Arc;

/// Evaluates a function at a point: its outputs, or the reason why it has none.
pub type Evaluate = Arc<dyn Fn(&[f64]) -> Result<Vec<f64>, String> + Send + Sync>;

/// A function that can be evaluated anywhere in its domain.
#[derive(Clone)]
pub struct Truth {
    name: String,
    axes: Vec<Axis>,
    /// Columns that the function returns before its outputs; then only the axes that are named
    /// here are columns, too.
    derived: Option<Derived>,
    outputs: Vec<String>,
    origin: Origin,
    function: Evaluate,
}

/// Inputs of formulas that are functions of what is sampled.
#[derive(Clone, Debug)]
struct Derived {
    names: Vec<String>,
    /// The axes that are inputs beside them.
    axes: Vec<usize>,
}

impl fmt::Debug for Truth {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Truth { name, axes, outputs, origin, .. } = self;
        let mut shown = f.debug_struct("Truth");
        shown.field("name", name).field("axes", axes).field("outputs", outputs);
        shown.field("origin", origin).finish_non_exhaustive()
    }
}

/// The points along each axis of a search grid, by the number of axes; and in all, where there are
/// more. By hand: one axis costs nothing, and the maximum error is at its ends; more axes have 4096
/// rows, as the built-in ground truths do.
const POINTS: [usize; 3] = [1024, 64, 16];
const SCATTERED: usize = 8192;
/// The most rows of a search split. By hand: minutes of a search for each generation.
const MOST_ROWS: usize = 1 << 24;

impl Truth {
    /// Makes a truth.
    ///
    /// # Errors
    /// More than [`MOST_AXES`] inputs, or none.
    pub fn new(
        name: String,
        axes: Vec<Axis>,
        outputs: Vec<String>,
        origin: Origin,
        function: Evaluate,
    ) -> Result<Truth, Error> {
        match axes.len() {
            0 => Err(Error::NoInputs),
            1..=MOST_AXES => Ok(Truth { name, axes, derived: None, outputs, origin, function }),
            inputs => Err(Error::TooManyInputs { inputs }),
        }
    }

    /// Takes the first values that the function returns as inputs of formulas, under these names,
    /// and beside them only those axes that are named, too.
    ///
    /// # Panics
    /// If a name is missing for what the function returns.
    pub fn over(mut self, columns: &[String]) -> Truth {
        let axis = |name: &String| self.axes.iter().position(|axis| axis.name == *name);
        let names = columns.iter().filter(|name| axis(name).is_none()).cloned().collect();
        let axes = columns.iter().filter_map(axis).collect();
        self.derived = Some(Derived { names, axes });
        self
    }

    /// Returns the names of the inputs of formulas.
    pub fn inputs(&self) -> Vec<String> {
        let axis = |axis: &Axis| axis.name.clone().into_owned();
        match &self.derived {
            None => self.axes.iter().map(axis).collect(),
            Some(Derived { names, axes }) => {
                let axes = axes.iter().map(|&index| axis(&self.axes[index]));
                names.iter().cloned().chain(axes).collect()
            }
        }
    }

    /// Returns its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns its inputs.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// Returns the names of its outputs.
    pub fn outputs(&self) -> &[String] {
        &self.outputs
    }

    /// Evaluates it at a point, one value for each axis: the inputs that are functions of these
    /// ([`Truth::over`]), then the outputs.
    ///
    /// # Errors
    /// A value that is not finite or beyond `f32`, or one that cannot be computed.
    pub fn at(&self, point: &[f64]) -> Result<Vec<f64>, Error> {
        let place = || {
            let places =
                self.axes.iter().zip(point).map(|(axis, at)| format!("{} = {at}", axis.name));
            places.collect::<Vec<_>>().join(", ")
        };
        let values = (self.function)(point)
            .map_err(|reason| Error::Evaluation { point: place(), reason })?;
        let derived = self.derived.iter().flat_map(|derived| &derived.names);
        let mut named = derived.chain(&self.outputs).zip(&values);
        match named.find(|(_, value)| !(**value as f32).is_finite()) {
            None => Ok(values),
            Some((output, &value)) => {
                Err(Error::NotFinite { output: output.clone(), value, point: place() })
            }
        }
    }

    /// Returns the truth of these outputs alone, in this order; none if it lacks one.
    pub fn choose(&self, outputs: &[String]) -> Option<Truth> {
        let derived = self.derived.as_ref().map_or(0, |derived| derived.names.len());
        let place = |name: &String| self.outputs.iter().position(|output| output == name);
        let places: Vec<usize> = outputs.iter().map(place).collect::<Option<_>>()?;
        if places.iter().copied().eq(0..self.outputs.len()) {
            return Some(self.clone());
        }
        let function = Arc::clone(&self.function);
        let chosen = move |point: &[f64]| {
            let values = function(point)?;
            let inputs = values[..derived].iter();
            Ok(inputs
                .chain(places.iter().map(|&place| &values[derived + place]))
                .copied()
                .collect())
        };
        Some(Truth { outputs: outputs.to_vec(), function: Arc::new(chosen), ..self.clone() })
    }

    /// Evaluates it at a point as rows have it, one value for each axis: the inputs of formulas,
    /// and the outputs.
    ///
    /// # Errors
    /// As [`Truth::at`].
    fn row(&self, point: &[f32]) -> Result<(Vec<f32>, Vec<f64>), Error> {
        let exact: Vec<f64> = point.iter().copied().map(f64::from).collect();
        let mut values = self.at(&exact)?;
        let Some(Derived { names, axes }) = &self.derived else {
            return Ok((point.to_vec(), values));
        };
        let outputs = values.split_off(names.len());
        let derived = values.iter().map(|&value| value as f32);
        Ok((derived.chain(axes.iter().map(|&axis| point[axis])).collect(), outputs))
    }

    /// Samples it: `points` along each axis of the search grid and its ends, or in all if there are more than
    /// three inputs. By default 1024, 64, 16, and 8192 in all.
    ///
    /// # Errors
    /// As [`Truth::at`]; too many rows; names that are no columns'.
    pub fn dataset(&self, points: Option<usize>, progress: Progress) -> Result<Dataset, Error> {
        let function = |point: &[f64]| -> Result<Value, Error> {
            Ok(Value { outputs: self.at(point)?, error: 0.0 })
        };
        let axes = self.axes.len();
        let usual = POINTS.get(axes - 1).copied();
        let points = points.or(usual).unwrap_or(SCATTERED);
        let rows = usual.map_or(Some(points), |_| points.checked_pow(axes as u32));
        if points < 2 || rows.is_none_or(|rows| rows > MOST_ROWS) {
            return Err(Error::Points { points, inputs: axes, most: MOST_ROWS });
        }
        let (splits, _) = match usual {
            None => scattered_splits(&self.axes, points, progress, &function)?,
            Some(_) => {
                let sampling = Sampling::Regular;
                // Half as dense again as the search grid, as those of the targets are.
                let intervals = points * 3 / 2;
                let axes = &self.axes;
                let grids =
                    Grids { axes, points, ends: true, intervals, sampling, seed: 0, progress };
                grids.splits(&function)?
            }
        };
        let outputs = self.outputs.iter().map(|name| (name.as_str(), "1"));
        let (inputs, splits) = match &self.derived {
            None => (self.axes.iter().map(Axis::column).collect(), splits),
            Some(derived) => self.over_derived(derived, splits),
        };
        Ok(Dataset::of_splits(&self.name, self.origin.clone(), inputs, outputs, splits)?)
    }

    /// Leaves of rows over the axes those over the inputs of formulas, which are on no grid.
    fn over_derived(&self, derived: &Derived, splits: [Split; 2]) -> (Vec<Column>, [Split; 2]) {
        let first = self.axes.len();
        let outputs = first + derived.names.len();
        let order: Vec<usize> = (first..outputs)
            .chain(derived.axes.iter().copied())
            .chain(outputs..outputs + self.outputs.len())
            .collect();
        let splits = splits.map(|mut split| {
            let columns = order.iter().map(|&index| std::mem::take(&mut split.columns[index]));
            Split { columns: columns.collect(), grid: Vec::new(), ..split }
        });
        let names = derived.names.iter().enumerate();
        let columns =
            names.map(|(index, name)| Column::new(name, domain_of(&splits[0], &splits[1], index)));
        let axes = derived.axes.iter().map(|&index| self.axes[index].column());
        (columns.chain(axes).collect(), splits)
    }
}
