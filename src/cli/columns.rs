//! The columns of a dataset that a command takes.

use crate::dataset::{self, Dataset};

/// The options that choose columns.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Columns {
    /// Use only these inputs; an output can be an input, too [default: all inputs]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    inputs: Option<Vec<String>>,
    /// Use only these outputs [default: all outputs]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    outputs: Option<Vec<String>>,
}

impl Columns {
    /// Returns the inputs that were asked for, as one text.
    pub fn inputs(&self) -> Option<String> {
        self.inputs.as_ref().map(|names| names.join(","))
    }

    /// Returns the outputs that were asked for, as one text.
    pub fn outputs(&self) -> Option<String> {
        self.outputs.as_ref().map(|names| names.join(","))
    }

    /// Returns the outputs that were asked for.
    pub fn outputs_asked(&self) -> Option<&[String]> {
        self.outputs.as_deref()
    }

    /// Returns the dataset with only the columns chosen.
    pub fn of(&self, dataset: &Dataset) -> Result<Dataset, dataset::Error> {
        dataset.select(self.inputs.as_deref(), self.outputs.as_deref())
    }
}
