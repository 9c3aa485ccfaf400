//! What a program's outputs are on every sample.

use super::samples::Block;
use super::{BLOCK, Samples};

/// The values of each output, by sample. Evaluating into it again reuses the allocation.
#[derive(Clone, Debug, Default)]
pub struct Values {
    rows: usize,
    /// Columns of whole blocks, one after the other.
    pub(super) blocks: Vec<Block>,
}

impl Values {
    /// One output's values, one for each sample.
    ///
    /// # Panics
    /// If there is no such output.
    pub fn column(&self, output: usize) -> &[f32] {
        let blocks = self.rows.div_ceil(BLOCK);
        let column = &self.blocks[output * blocks..(output + 1) * blocks];
        &bytemuck::cast_slice(column)[..self.rows]
    }

    pub(super) fn lay_out(&mut self, samples: &Samples, outputs: usize) {
        self.rows = samples.rows();
        self.blocks.resize(samples.blocks() * outputs, Block([0.0; BLOCK]));
    }
}
