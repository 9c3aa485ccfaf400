//! Rows held out for validation.

use crate::dataset::Split;
use std::collections::HashSet;

/// Tables with fewer rows are validated on the rows they are searched on. By hand: a validation
/// split of fewer than four rows says little.
const MIN_ROWS_TO_SPLIT: usize = 16;

/// Cuts rows, whose first columns are `inputs` inputs, into a search and a validation split. One
/// row of each four consecutive ones, at a position scattered so that it does not follow the axes
/// of a grid, goes to the validation split. The first row at the minimum and at the maximum of each
/// input stays in the search split, so that validation never extrapolates. With fewer than 16 rows
/// both splits hold them all.
pub(crate) fn split_rows(whole: &Split, inputs: usize) -> (Split, Split) {
    let rows = whole.rows();
    if rows < MIN_ROWS_TO_SPLIT {
        return (whole.clone(), whole.clone());
    }
    let kept: HashSet<usize> =
        whole.columns.iter().take(inputs).flat_map(|c| extremes(c)).collect();
    let (validation, search): (Vec<usize>, Vec<usize>) =
        (0..rows).partition(|row| held_out(*row) && !kept.contains(row));
    if validation.is_empty() {
        let all = gather(whole, &search);
        return (all.clone(), all);
    }
    (gather(whole, &search), gather(whole, &validation))
}

fn extremes(values: &[f32]) -> [usize; 2] {
    let mut rows = [0, 0];
    for (row, &value) in values.iter().enumerate() {
        if value < values[rows[0]] {
            rows[0] = row;
        }
        if value > values[rows[1]] {
            rows[1] = row;
        }
    }
    rows
}

/// Returns true for the row of each block of four that goes to validation. Its position comes from
/// a hash of the block: every fourth row of a grid would be a few whole columns of the grid.
fn held_out(row: usize) -> bool {
    let block = (row / 4) as u64;
    // The output function of SplitMix64 (Steele, Lea, Flood 2014).
    let mut bits = block.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^= bits >> 31;
    bits % 4 == (row % 4) as u64
}

fn gather(whole: &Split, rows: &[usize]) -> Split {
    let pick = |values: &Vec<f32>| rows.iter().map(|&row| values[row]).collect::<Vec<f32>>();
    Split {
        columns: whole.columns.iter().map(pick).collect(),
        weights: if whole.weights.is_empty() { Vec::new() } else { pick(&whole.weights) },
        standard_errors: whole.standard_errors.iter().map(pick).collect(),
        ..Split::default()
    }
}
