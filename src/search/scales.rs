//! The columns as a search sees them: of natural magnitude, and not far from zero for their spread.
//!
//! First constants, steps of fits and sums of squares are all of order one; at 380 … 830 nanometres
//! or 1e9 they would succeed only by luck. So inputs and outputs that are not of a natural
//! magnitude are divided by a power of two, and inputs far from zero are centred first. Formulas
//! are searched for over the scaled columns, but costed and shown over the dataset's own. A power
//! of two rounds nothing, so the search is the same in whatever unit the data come.

use crate::dataset::{Column, Dataset, Split, output_units, unit};
use crate::program::Draft;
use crate::simplify::{InputScale, Placement, rescaled};

/// The least distance from zero of the middle of an input's domain, in half its width, at which the
/// input is centred. Chosen by hand, unmeasured.
const FAR: f64 = 4.0;

/// The scaling of an input, which is `centre + unit · scaled`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Input {
    centre: f32,
    unit: f64,
}

impl Input {
    fn of(column: &Column) -> Input {
        let [low, high] = column.domain;
        let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
        if half == 0.0 || middle.abs() < FAR * half {
            return Input { centre: 0.0, unit: unit(column) };
        }
        // With few digits, so that differences from it are exact.
        let step = half.log2().floor().exp2();
        let centre = ((middle / step).round() * step) as f32;
        let spread = Column {
            domain: [low - f64::from(centre), high - f64::from(centre)],
            ..column.clone()
        };
        Input { centre, unit: unit(&spread) }
    }

    fn scaled(&self, x: f32) -> f32 {
        (f64::from(x - self.centre) / self.unit) as f32
    }
}

/// The scaling of a dataset's columns.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scales {
    inputs: Vec<Input>,
    outputs: Vec<f64>,
}

fn exponent(unit: f64) -> i32 {
    unit.log2().round() as i32
}

impl Scales {
    pub fn of(dataset: &Dataset) -> Scales {
        Scales {
            inputs: dataset.inputs.iter().map(Input::of).collect(),
            outputs: output_units(&dataset.outputs),
        }
    }

    /// Returns true if all columns are searched as they are.
    pub fn are_natural(&self) -> bool {
        let natural = |input: &Input| *input == Input { centre: 0.0, unit: 1.0 };
        self.inputs.iter().all(natural) && self.outputs.iter().all(|unit| *unit == 1.0)
    }

    /// Returns the dataset over scaled columns.
    pub fn scaled(&self, dataset: &Dataset) -> Dataset {
        let mut scaled = dataset.clone();
        for split in [&mut scaled.search, &mut scaled.validation] {
            self.scale_split(split);
        }
        for (column, input) in scaled.inputs.iter_mut().zip(&self.inputs) {
            column.domain = column.domain.map(|end| f64::from(input.scaled(end as f32)));
        }
        for (column, unit) in scaled.outputs.iter_mut().zip(&self.outputs) {
            column.domain = column.domain.map(|end| end / unit);
        }
        scaled
    }

    fn scale_split(&self, split: &mut Split) {
        let (inputs, outputs) = split.columns.split_at_mut(self.inputs.len());
        for (column, input) in inputs.iter_mut().zip(&self.inputs) {
            column.iter_mut().for_each(|x| *x = input.scaled(*x));
        }
        for columns in [outputs, &mut split.dead_zone, &mut split.standard_errors] {
            for (column, unit) in columns.iter_mut().zip(&self.outputs) {
                column.iter_mut().for_each(|y| *y = (f64::from(*y) / unit) as f32);
            }
        }
    }

    /// Rewrites a formula over scaled columns as one over the dataset's own.
    pub fn natural(&self, draft: &Draft, placement: Placement) -> Draft {
        let input =
            |input: &Input| InputScale { offset: -input.centre, exponent: exponent(input.unit) };
        let outputs: Vec<i32> = self.outputs.iter().map(|unit| exponent(*unit)).collect();
        rescaled(draft, &self.inputs.iter().map(input).collect::<Vec<_>>(), &outputs, placement)
    }

    /// Rewrites a formula over the dataset's own columns as one over scaled columns.
    pub fn searched(&self, draft: &Draft) -> Draft {
        let input = |input: &Input| InputScale {
            offset: (f64::from(input.centre) / input.unit) as f32,
            exponent: -exponent(input.unit),
        };
        let outputs: Vec<i32> = self.outputs.iter().map(|unit| -exponent(*unit)).collect();
        let inputs: Vec<InputScale> = self.inputs.iter().map(input).collect();
        rescaled(draft, &inputs, &outputs, Placement::Constants)
    }
}
