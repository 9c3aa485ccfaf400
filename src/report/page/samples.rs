//! The samples in a page.

use crate::dataset::Split;
use serde::Serialize;

/// The most rows in a page; more are thinned out. By hand, unmeasured.
const MAX_ROWS: usize = 16384;

/// Samples of a split; of a full grid only the places along its axes are stored.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SampleTable {
    /// Points along each input, the first varying slowest; empty if the rows are no grid.
    pub grid: Vec<usize>,
    /// The places along each axis of the grid, or each row's.
    pub inputs: Vec<Vec<f32>>,
    /// By output, the values of the rows.
    pub outputs: Vec<Vec<f32>>,
    /// The number of rows of the split, of which these may be some.
    pub of: usize,
}

impl SampleTable {
    /// Returns the rows of a split whose first columns are its inputs; evenly thinned out if they
    /// are too many for a page.
    pub fn of(split: &Split, inputs: usize) -> SampleTable {
        let rows = split.rows();
        let every = rows.div_ceil(MAX_ROWS);
        let thinned = |column: &Vec<f32>| column.iter().copied().step_by(every).collect();
        let (given, found) = split.columns.split_at(inputs);
        let outputs = found.iter().map(thinned).collect();
        if every > 1 || split.grid.is_empty() {
            let inputs = given.iter().map(thinned).collect();
            return SampleTable { grid: Vec::new(), inputs, outputs, of: rows };
        }
        let places = |(axis, column): (usize, &Vec<f32>)| {
            let below: usize = split.grid[axis + 1..].iter().product();
            (0..split.grid[axis]).map(|i| column[i * below]).collect()
        };
        let inputs = given.iter().enumerate().map(places).collect();
        SampleTable { grid: split.grid.clone(), inputs, outputs, of: rows }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_is_its_axes() {
        let columns = vec![
            vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
            vec![5.0, 6.0, 7.0, 5.0, 6.0, 7.0],
            vec![1.0; 6],
        ];
        let split = Split { columns, grid: vec![2, 3], ..Split::default() };
        let table = SampleTable::of(&split, 2);
        assert_eq!(table.inputs, [vec![0.0, 1.0], vec![5.0, 6.0, 7.0]]);
        let rows = SampleTable::of(&Split { grid: vec![], ..split }, 2);
        assert_eq!((rows.inputs[1].len(), rows.of), (6, 6));
    }

    #[test]
    fn many_rows_are_thinned_out() {
        let column: Vec<f32> = (0..40_000).map(|i| i as f32).collect();
        let split = Split { columns: vec![column.clone(), column], ..Split::default() };
        let table = SampleTable::of(&split, 1);
        assert_eq!(table.outputs[0][..3], [0.0, 3.0, 6.0]);
        assert_eq!((table.outputs[0].len(), table.of), (13_334, 40_000));
    }
}
