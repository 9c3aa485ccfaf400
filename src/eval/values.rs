//! The values of a program's outputs on samples.

use super::samples::Block;
use super::{BLOCK, Samples};

/// The values of each output, by sample; evaluating into it again reuses the allocation.
#[derive(Clone, Debug, Default)]
pub struct Values {
    rows: usize,
    /// The columns, one after the other, of whole blocks.
    pub(super) blocks: Vec<Block>,
}

impl Values {
    /// Returns one output's values, by sample.
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
