//! Views: scenes over a dataset's columns.

use super::histogram::Density;
use super::quantisation::Steps;
use super::{Error, Scene, fixed};
use crate::dataset::{Column, Dataset, Origin, Split, claims_over};
use crate::eval::{Arithmetic, Double};
use crate::program::Program;

/// A scene read over a dataset's columns ([`Scene::over`]).
#[derive(Clone, Debug)]
pub struct View<'a> {
    pub(super) scene: &'a Scene,
    pub(super) whole: &'a Dataset,
    /// One entry per input of the dataset.
    pub(super) inputs: Vec<Input>,
    /// The values of `fixed` that are no inputs, by name.
    pub(super) values: Vec<(&'a str, f64)>,
    pub(super) densities: Vec<Density>,
    /// The outputs, each over the dataset's inputs, its outputs, then `values`.
    pub(super) outputs: Vec<(String, Program)>,
    pub(super) steps: Option<Steps>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Input {
    /// An input of the view, within a range.
    Open([f64; 2]),
    Fixed(f64),
}

impl<'a> View<'a> {
    /// Returns the names of the inputs that are left.
    pub fn inputs(&self) -> Vec<String> {
        self.open_inputs().map(|(column, _)| column.name.clone()).collect()
    }

    /// Returns the inputs that are left, each with its range.
    pub(super) fn open_inputs(&self) -> impl Iterator<Item = (&'a Column, [f64; 2])> {
        self.whole.inputs.iter().zip(&self.inputs).filter_map(|(column, input)| match input {
            Input::Open(range) => Some((column, *range)),
            Input::Fixed(_) => None,
        })
    }

    /// Makes the dataset that the scene leaves: open inputs, combined outputs, and the rows that
    /// occur, their weights multiplied by the histograms' counts. Its name joins those of the
    /// dataset and the scene; its origin says what the scene did.
    ///
    /// # Errors
    /// [`Error`]: a split of which no row is left, or without rows at a fixed value; a combined
    /// output that is not finite; a tone map without a slope.
    pub fn dataset(&self) -> Result<Dataset, Error> {
        let search = self.split("search", &self.whole.search)?;
        let validation = self.split("validation", &self.whole.validation)?;
        let inputs: Vec<Column> = self
            .open_inputs()
            .map(|(column, domain)| Column { domain, ..column.clone() })
            .collect();
        let unit = |name: &str| {
            let same = self.whole.outputs.iter().find(|column| column.name == name);
            same.map_or("1", |column| &column.unit)
        };
        let outputs = self.outputs.iter().map(|(name, _)| (name.as_str(), unit(name)));
        let Scene { name, .. } = self.scene;
        let origin = Origin::View {
            of: Box::new(self.whole.origin.clone()),
            scene: format!("{name}: {}", self.scene.summary()),
        };
        let called = format!("{}_{}", self.whole.name, identifier(name));
        let dataset = Dataset::of_splits(&called, origin, inputs, outputs, [search, validation]);
        let mut dataset = dataset
            .map_err(|error| Error::Dataset { scene: name.clone(), error: Box::new(error) })?;
        dataset.claims = claims_over(&self.whole.claims, &dataset.names());
        Ok(dataset)
    }

    fn split(&self, which: &'static str, split: &Split) -> Result<Split, Error> {
        let mut taken = split.clone();
        // From the last, so that earlier columns keep their places.
        for index in (0..self.inputs.len()).rev() {
            let Input::Fixed(value) = self.inputs[index] else { continue };
            let Column { name, domain, .. } = &self.whole.inputs[index];
            taken =
                fixed::at(&taken, index, value, *domain).map_err(|nearest| Error::NoSuchRows {
                    scene: self.scene.name.clone(),
                    split: which,
                    dataset: self.whole.name.clone(),
                    input: name.clone(),
                    value,
                    nearest,
                })?;
        }
        self.combine(which, self.occurring(which, &taken)?)
    }

    /// Keeps the rows within the ranges that have a weight by the histograms. Fixed inputs are left
    /// out already.
    fn occurring(&self, which: &'static str, split: &Split) -> Result<Split, Error> {
        let ranges: Vec<_> =
            self.open_inputs().map(|(_, [low, high])| low as f32..=high as f32).collect();
        let in_range = |row: usize| {
            ranges.iter().zip(&split.columns).all(|(range, column)| range.contains(&column[row]))
        };
        let density = |row: usize| -> f64 {
            self.densities.iter().map(|density| density.of(&split.columns, row)).product()
        };
        let rows: Vec<usize> =
            (0..split.rows()).filter(|&row| in_range(row) && density(row) > 0.0).collect();
        let weight = |&row: &usize| density(row) * f64::from(split.weight(row));
        let total: f64 = rows.iter().map(weight).sum();
        if total <= 0.0 {
            return Err(Error::NoRows {
                scene: self.scene.name.clone(),
                split: which,
                dataset: self.whole.name.clone(),
            });
        }
        let mut taken = gather(split, &rows);
        if !self.densities.is_empty() {
            let mean = total / rows.len() as f64;
            taken.weights = rows.iter().map(|row| (weight(row) / mean) as f32).collect();
        }
        taken.grid = remaining_grid(split, &rows);
        Ok(taken)
    }

    /// Replaces the outputs by the scene's combinations.
    fn combine(&self, which: &'static str, split: Split) -> Result<Split, Error> {
        let open = self.open_inputs().count();
        let mut columns = split.columns[..open].to_vec();
        let mut row_values = Vec::new();
        let mut standard_errors = Vec::new();
        for (output, program) in &self.outputs {
            let mut combined = Vec::with_capacity(split.rows());
            let mut errors = Vec::new();
            for row in 0..split.rows() {
                self.row_into(&split, row, &mut row_values);
                let value = Double.evaluate(program, &row_values)[0];
                if !(value as f32).is_finite() {
                    return Err(Error::NotFinite {
                        scene: self.scene.name.clone(),
                        output: output.clone(),
                        value,
                        row: row + 1,
                        split: which,
                        dataset: self.whole.name.clone(),
                    });
                }
                combined.push(value as f32);
                if !split.standard_errors.is_empty() {
                    errors.push(self.standard_error(&split, row, program, &mut row_values) as f32);
                }
            }
            columns.push(combined);
            standard_errors.extend((!errors.is_empty()).then_some(errors));
        }
        let mut dead_zone = Vec::new();
        if let Some(steps) = &self.steps {
            for ((output, _), values) in self.outputs.iter().zip(&columns[open..]) {
                dead_zone.push(self.dead_zone(which, steps, output, values)?);
            }
        }
        Ok(Split { columns, dead_zone, standard_errors, ..split })
    }

    /// Returns the standard error of an expression to first order, if outputs err independently.
    fn standard_error(
        &self,
        split: &Split,
        row: usize,
        program: &Program,
        values: &mut Vec<f64>,
    ) -> f64 {
        self.row_into(split, row, values);
        let value = Double.evaluate(program, values)[0];
        let errors = split.standard_errors.iter().enumerate().map(|(output, errors)| {
            let place = self.inputs.len() + output;
            let known = values[place];
            values[place] += f64::from(errors[row]);
            let change = Double.evaluate(program, values)[0] - value;
            values[place] = known;
            change * change
        });
        errors.sum::<f64>().sqrt()
    }

    fn dead_zone(
        &self,
        which: &'static str,
        steps: &Steps,
        output: &str,
        values: &[f32],
    ) -> Result<Vec<f32>, Error> {
        let dead_zone = |(row, &value): (usize, &f32)| {
            steps.dead_zone(value).ok_or_else(|| Error::ToneMap {
                scene: self.scene.name.clone(),
                output: output.to_owned(),
                value,
                row: row + 1,
                split: which,
                dataset: self.whole.name.clone(),
            })
        };
        values.iter().enumerate().map(dead_zone).collect()
    }

    /// Writes the values that the outputs' expressions read on a row of a split whose fixed inputs
    /// are left out.
    fn row_into(&self, split: &Split, row: usize, values: &mut Vec<f64>) {
        values.clear();
        let mut columns = split.columns.iter().map(|column| f64::from(column[row]));
        for input in &self.inputs {
            match input {
                Input::Fixed(value) => values.push(*value),
                Input::Open(_) => values.extend(columns.next()),
            }
        }
        values.extend(columns);
        values.extend(self.values.iter().map(|(_, value)| value));
    }
}

/// Replaces all but ASCII letters and digits of a name by `_`.
fn identifier(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect()
}

/// Returns some rows of a split, without its grid and dead zones.
pub(super) fn gather(split: &Split, rows: &[usize]) -> Split {
    let pick = |values: &Vec<f32>| rows.iter().map(|&row| values[row]).collect::<Vec<f32>>();
    Split {
        columns: split.columns.iter().map(pick).collect(),
        weights: if split.weights.is_empty() { Vec::new() } else { pick(&split.weights) },
        standard_errors: split.standard_errors.iter().map(pick).collect(),
        ..Split::default()
    }
}

/// Returns the grid that some rows of a grid, in order, still form; empty if they form none.
fn remaining_grid(split: &Split, rows: &[usize]) -> Vec<usize> {
    let mut stride = split.rows();
    let mut remaining = Vec::new();
    for &points in &split.grid {
        stride /= points;
        let mut kept = vec![false; points];
        rows.iter().for_each(|row| kept[row / stride % points] = true);
        remaining.push(kept.into_iter().filter(|kept| *kept).count());
    }
    let whole = remaining.iter().product::<usize>() == rows.len();
    if whole { remaining } else { Vec::new() }
}
