//! Views of some of a dataset's columns.

use super::{Column, Dataset, Error, Split, claims_over};
use crate::suggest::nearest;

impl Dataset {
    /// Selects some inputs and outputs, in the order asked for. An output column may be asked for
    /// as an input. Without `inputs`: all the dataset's inputs, never its other outputs. Without
    /// `outputs`: all its outputs except those asked for as inputs. The rows stay the same; a split
    /// stays a grid only if the inputs do; claims stay if their columns do.
    ///
    /// # Errors
    /// An unknown name (with a suggestion), a name given twice, a column that is both input and
    /// output, or no column left as an input or output.
    pub fn select(
        &self,
        inputs: Option<&[String]>,
        outputs: Option<&[String]>,
    ) -> Result<Dataset, Error> {
        let input_indices = match inputs {
            Some(names) => self.indices(names)?,
            None => (0..self.inputs.len()).collect(),
        };
        let output_indices = match outputs {
            Some(names) => self.indices(names)?,
            None => (self.inputs.len()..self.inputs.len() + self.outputs.len())
                .filter(|index| !input_indices.contains(index))
                .collect(),
        };
        if let Some(&index) = output_indices.iter().find(|i| input_indices.contains(i)) {
            let column = self.column(index).map(|c| c.name.clone()).unwrap_or_default();
            return Err(Error::InputIsOutput { path: self.origin(), column });
        }
        self.with_columns(&input_indices, &output_indices)
    }

    fn with_columns(&self, inputs: &[usize], outputs: &[usize]) -> Result<Dataset, Error> {
        let same_inputs = inputs.iter().copied().eq(0..self.inputs.len());
        let indices: Vec<usize> = inputs.iter().chain(outputs).copied().collect();
        let named = |indices: &[usize]| -> Vec<Column> {
            indices.iter().filter_map(|&index| self.column(index).cloned()).collect()
        };
        let mut selected = Dataset {
            name: self.name.clone(),
            origin: self.origin.clone(),
            inputs: named(inputs),
            outputs: named(outputs),
            claims: Vec::new(),
            search: self.pick(&self.search, &indices, inputs.len(), same_inputs),
            validation: self.pick(&self.validation, &indices, inputs.len(), same_inputs),
        };
        selected.claims = claims_over(&self.claims, &selected.names());
        selected.validate()?;
        Ok(selected)
    }

    /// Picks columns of a split, the first `inputs` of them inputs.
    fn pick(&self, split: &Split, indices: &[usize], inputs: usize, same_inputs: bool) -> Split {
        let column = |&index: &usize| split.columns.get(index).cloned();
        // Only outputs have columns beside them, and they stay outputs.
        let beside = |columns: &[Vec<f32>]| {
            let column =
                |&index: &usize| columns.get(index.checked_sub(self.inputs.len())?).cloned();
            indices[inputs..].iter().filter_map(column).collect()
        };
        Split {
            columns: indices.iter().filter_map(column).collect(),
            weights: split.weights.clone(),
            dead_zone: beside(&split.dead_zone),
            standard_errors: beside(&split.standard_errors),
            grid: if same_inputs { split.grid.clone() } else { Vec::new() },
        }
    }

    fn column(&self, index: usize) -> Option<&Column> {
        self.columns().nth(index)
    }

    fn indices(&self, names: &[String]) -> Result<Vec<usize>, Error> {
        names.iter().map(|name| self.index_of(name)).collect()
    }

    fn index_of(&self, name: &str) -> Result<usize, Error> {
        self.columns().position(|column| column.name == name).ok_or_else(|| {
            let names = self.columns().map(|column| column.name.as_str());
            unknown_column(self.origin(), name, names)
        })
    }
}

pub(crate) fn unknown_column<'a>(
    path: std::path::PathBuf,
    name: &str,
    available: impl Iterator<Item = &'a str>,
) -> Error {
    let available: Vec<&str> = available.collect();
    Error::UnknownColumn {
        path,
        column: name.into(),
        suggestion: nearest(name, available.iter().copied()).map(Into::into),
        available: available.join(", "),
    }
}
