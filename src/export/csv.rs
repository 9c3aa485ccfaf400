//! Tables in CSV that [`crate::import`] reads back.

use super::Rows;
use crate::dataset::{Column, Dataset, Split};
use crate::program::format_constant;

/// Writes rows of a dataset as CSV in UTF-8: inputs, outputs, `weight` where the rows have weights,
/// and `y_se` for each output `y` whose standard errors are known. Numbers have as many digits as
/// tell 32-bit floats apart. Units, domains, claims and dead zones are not in it.
///
/// ```
/// use lgp::dataset::{Dataset, axis};
/// use lgp::export::{Rows, to_csv};
///
/// let data = Dataset::sampled([axis("x", 0.0..=1.0)], ["y"], |[x]| [2.0 * x])?;
/// assert!(to_csv(&data, Rows::Search).starts_with("x,y\n0.001953125,0.00390625\n"));
/// # Ok::<(), lgp::dataset::Error>(())
/// ```
pub fn to_csv(dataset: &Dataset, rows: Rows) -> String {
    let splits = rows.of(dataset);
    let has_weights = splits.iter().any(|split| !split.weights.is_empty());
    let with_errors: Vec<usize> =
        (0..dataset.outputs.len()).filter(|&output| has_errors(&splits, output)).collect();
    let columns = dataset.inputs.iter().chain(&dataset.outputs);
    let mut names: Vec<String> = columns.map(|column| column.name.clone()).collect();
    names.extend(has_weights.then(|| "weight".into()));
    let errors_of = |output: &usize| format!("{}_se", name(&dataset.outputs, *output));
    names.extend(with_errors.iter().map(errors_of));
    let mut text = names.join(",") + "\n";
    for split in splits {
        for row in 0..split.rows() {
            let mut cells: Vec<f32> = split.columns.iter().map(|column| column[row]).collect();
            cells.extend(has_weights.then(|| split.weight(row)));
            let error = |output: &usize| split.standard_errors.get(*output).map_or(0.0, |e| e[row]);
            cells.extend(with_errors.iter().map(error));
            for (index, value) in cells.into_iter().enumerate() {
                text += if index > 0 { "," } else { "" };
                text += &format_constant(value);
            }
            text.push('\n');
        }
    }
    text
}

fn has_errors(splits: &[&Split], output: usize) -> bool {
    let errors = splits.iter().filter_map(|split| split.standard_errors.get(output));
    errors.flatten().any(|error| *error > 0.0)
}

fn name(columns: &[Column], index: usize) -> &str {
    columns.get(index).map_or("", |column| &column.name)
}
