//! Samples laid out for the kernels.

use super::BLOCK;
use crate::dataset::Split;

/// The values of [`BLOCK`] lanes, aligned for the widest register.
#[derive(Clone, Copy, Debug, bytemuck::Zeroable, bytemuck::Pod)]
#[repr(C, align(64))]
pub(super) struct Block(pub [f32; BLOCK]);

/// Rows of a split, column-major, each column padded to whole blocks with its last value, at
/// weight 0. The default has no rows.
#[derive(Clone, Debug, Default)]
pub struct Samples {
    rows: usize,
    blocks: usize,
    inputs: usize,
    outputs: usize,
    /// Columns of `blocks`: inputs, outputs, the weights of each output, and, if any was set, the
    /// dead zones of each output.
    values: Vec<Block>,
    /// By output; empty if values are exact.
    standard_errors: Vec<Vec<f32>>,
    total_weight: f64,
}

impl Samples {
    /// Lays out all rows of a split whose first `inputs` columns are the inputs.
    ///
    /// # Panics
    /// As [`Samples::of_rows`].
    pub fn new(split: &Split, inputs: usize) -> Samples {
        let rows: Vec<u32> = (0..split.rows() as u32).collect();
        Samples::of_rows(split, inputs, &rows)
    }

    /// Lays out the given rows of a split, without its dead zones ([`Samples::set_dead_zone`]).
    ///
    /// # Panics
    /// If `rows` is empty or names a row that the split lacks.
    pub fn of_rows(split: &Split, inputs: usize, rows: &[u32]) -> Samples {
        assert!(!rows.is_empty(), "at least one row");
        let blocks = rows.len().div_ceil(BLOCK);
        let columns = split.columns.len();
        let outputs = columns - inputs;
        let mut values = Vec::with_capacity((columns + outputs) * blocks);
        for column in &split.columns {
            push_column(&mut values, rows, |row| column[row], |last| last);
        }
        for _ in 0..outputs {
            push_column(&mut values, rows, |row| split.weight(row), |_| 0.0);
        }
        let picked =
            |errors: &Vec<f32>| rows.iter().map(|&row| errors[row as usize]).collect::<Vec<f32>>();
        let total_weight: f64 = rows.iter().map(|&row| f64::from(split.weight(row as usize))).sum();
        Samples {
            rows: rows.len(),
            blocks,
            inputs,
            outputs,
            values,
            standard_errors: split.standard_errors.iter().map(picked).collect(),
            total_weight: total_weight * outputs as f64,
        }
    }

    /// Lays out some of the samples, with their weights, dead zones and standard errors. The total
    /// weight is the same share of this one's as the rows are of all.
    ///
    /// # Panics
    /// If `rows` is empty or names a sample that there is not.
    pub fn select(&self, rows: &[u32]) -> Samples {
        assert!(!rows.is_empty(), "at least one row");
        let blocks = rows.len().div_ceil(BLOCK);
        let columns = self.values.len() / self.blocks;
        let weights = self.inputs + self.outputs..self.inputs + 2 * self.outputs;
        let mut values = Vec::with_capacity(columns * blocks);
        for column in 0..columns {
            let given: &[f32] = bytemuck::cast_slice(self.column(column));
            let padding = |last| if weights.contains(&column) { 0.0 } else { last };
            push_column(&mut values, rows, |row| given[..self.rows][row], padding);
        }
        let picked =
            |errors: &Vec<f32>| rows.iter().map(|&row| errors[row as usize]).collect::<Vec<f32>>();
        Samples {
            rows: rows.len(),
            blocks,
            inputs: self.inputs,
            outputs: self.outputs,
            values,
            standard_errors: self.standard_errors.iter().map(picked).collect(),
            total_weight: self.total_weight * rows.len() as f64 / self.rows as f64,
        }
    }

    /// Returns these samples with further outputs, whose target is 0, and which count at the first
    /// sample alone: for what is to be small beside the errors.
    pub(crate) fn with_outputs(&self, more: usize) -> Samples {
        let [inputs, outputs] = [self.inputs, self.outputs];
        let nothing = vec![Block([0.0; BLOCK]); more * self.blocks];
        let mut once = nothing.clone();
        once.iter_mut().step_by(self.blocks).for_each(|first| first.0[0] = 1.0);
        let columns = |first: usize, last: usize| {
            self.values.get(first * self.blocks..last * self.blocks).unwrap_or_default()
        };
        let mut values = columns(0, inputs + outputs).to_vec();
        values.extend(&nothing);
        values.extend(columns(inputs + outputs, inputs + 2 * outputs));
        values.extend(&once);
        let dead_zones = columns(inputs + 2 * outputs, inputs + 3 * outputs);
        if !dead_zones.is_empty() {
            values.extend(dead_zones);
            values.extend(&nothing);
        }
        Samples { outputs: outputs + more, values, ..self.clone() }
    }

    /// Returns the number of samples.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Returns the number of inputs.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// Returns the number of outputs.
    pub fn outputs(&self) -> usize {
        self.outputs
    }

    /// Returns the divisor that makes a mean of a sum of squares over samples and outputs: the sum
    /// of all weights, unless [`Samples::set_total_weight`] set another.
    pub fn total_weight(&self) -> f64 {
        self.total_weight
    }

    pub(super) fn blocks(&self) -> usize {
        self.blocks
    }

    /// Returns all columns, one after the other, as in `values`.
    pub(super) fn columns(&self) -> &[Block] {
        &self.values
    }

    /// Returns a whole column by its place in `values`.
    pub(super) fn column(&self, index: usize) -> &[Block] {
        &self.values[index * self.blocks..(index + 1) * self.blocks]
    }

    /// Replaces the samples' weights for one output.
    ///
    /// # Panics
    /// If there are fewer weights than samples, or no such output.
    pub fn set_weights(&mut self, output: usize, weights: &[f32]) {
        assert!(output < self.outputs, "one of the outputs");
        let first = (self.inputs + self.outputs + output) * self.blocks;
        let lanes: &mut [f32] =
            bytemuck::cast_slice_mut(&mut self.values[first..first + self.blocks]);
        let change: f64 = lanes[..self.rows]
            .iter_mut()
            .zip(&weights[..self.rows])
            .map(|(lane, &weight)| f64::from(weight) - f64::from(std::mem::replace(lane, weight)))
            .sum();
        self.total_weight += change;
    }

    /// Sets the divisor that makes a mean of a sum of squares, for weights that do not state
    /// importance: they make errors relative, or hold a formula to some samples.
    pub fn set_total_weight(&mut self, total: f64) {
        self.total_weight = total;
    }

    /// Sets the dead zone of an output at each sample: only the part of an error beyond it counts
    /// in sums of squares.
    ///
    /// # Panics
    /// If there are fewer errors than samples, or no such output.
    pub fn set_dead_zone(&mut self, output: usize, errors: &[f32]) {
        assert!(output < self.outputs, "one of the outputs");
        let first = (self.inputs + 2 * self.outputs) * self.blocks;
        self.values.resize(first + self.outputs * self.blocks, Block([0.0; BLOCK]));
        let lanes: &mut [f32] =
            bytemuck::cast_slice_mut(&mut self.values[first + output * self.blocks..]);
        lanes[..self.rows].copy_from_slice(&errors[..self.rows]);
    }

    /// Returns the values that an output should have, by sample.
    ///
    /// # Panics
    /// If there is no such output.
    pub fn targets(&self, output: usize) -> &[f32] {
        &bytemuck::cast_slice(self.target(output))[..self.rows]
    }

    /// Returns the samples' weights for an output.
    ///
    /// # Panics
    /// If there is no such output.
    pub fn weights(&self, output: usize) -> &[f32] {
        &bytemuck::cast_slice(self.weight(output))[..self.rows]
    }

    /// Returns the standard errors of an output's values, by sample; none if values are exact.
    pub fn standard_errors(&self, output: usize) -> Option<&[f32]> {
        self.standard_errors.get(output).map(Vec::as_slice)
    }

    pub(super) fn weight(&self, output: usize) -> &[Block] {
        self.column(self.inputs + self.outputs + output)
    }

    /// Returns the dead zone of an output, if any was set.
    pub(super) fn dead_zone(&self, output: usize) -> Option<&[Block]> {
        let first = (self.inputs + 2 * self.outputs + output) * self.blocks;
        self.values.get(first..first + self.blocks)
    }

    pub(super) fn target(&self, output: usize) -> &[Block] {
        self.column(self.inputs + output)
    }
}

fn push_column(
    values: &mut Vec<Block>,
    rows: &[u32],
    value: impl Fn(usize) -> f32,
    padding: impl Fn(f32) -> f32,
) {
    for chunk in rows.chunks(BLOCK) {
        let last = value(chunk[chunk.len() - 1] as usize);
        let mut block = Block([padding(last); BLOCK]);
        for (to, &row) in block.0.iter_mut().zip(chunk) {
            *to = value(row as usize);
        }
        values.push(block);
    }
}
