//! Arrays of datasets: the way back.

use super::Array;
use crate::dataset::{Dataset, Split};

/// The most axes of a dataset that is written as a grid: those of numpy, but for one of channels.
const MOST_AXES: usize = 63;

impl Array {
    /// Returns the outputs of a dataset on a full grid of its inputs: the first input along x, ascending,
    /// the second along y, and so on; an input of one value is no axis. The grid is that of the
    /// search split if it is said to be one, else that of all rows of both splits, else that of the
    /// search split's rows; `None` if none is one. With `split`, it is that of its rows.
    pub fn of_grid(dataset: &Dataset, split: Option<&Split>) -> Option<Array> {
        if let Some(split) = split {
            return of_splits(dataset, &[split]);
        }
        let both = [&dataset.search, &dataset.validation];
        let (all, search) = (&both[..], &both[..1]);
        let first = if dataset.search.grid.is_empty() { all } else { search };
        [first, all, search].into_iter().find_map(|splits| of_splits(dataset, splits))
    }

    /// Returns the rows of splits as they are, all columns being channels of a texel: the inputs,
    /// then the outputs.
    pub fn of_rows(dataset: &Dataset, splits: &[&Split]) -> Array {
        let columns = dataset.inputs.iter().chain(&dataset.outputs);
        let rows = splits.iter().flat_map(|split| (0..split.rows()).map(move |row| (split, row)));
        let row = |(split, row): (&&Split, usize)| -> Vec<f32> {
            split.columns.iter().map(|column| column[row]).collect()
        };
        Array {
            kind: "rows".to_owned(),
            size: vec![splits.iter().map(|split| split.rows()).sum()],
            channels: columns.map(|column| column.name.clone()).collect(),
            values: rows.flat_map(row).collect(),
            ..Array::default()
        }
    }
}

fn of_splits(dataset: &Dataset, splits: &[&Split]) -> Option<Array> {
    let inputs = dataset.inputs.len();
    let places: Vec<Vec<f32>> = (0..inputs).map(|input| places(splits, input)).collect();
    let size: Vec<usize> = places.iter().map(Vec::len).collect();
    let rows: usize = splits.iter().map(|split| split.rows()).sum();
    let texels = size.iter().try_fold(1usize, |product, &along| product.checked_mul(along))?;
    if texels > rows || inputs > MOST_AXES {
        return None;
    }
    let outputs = dataset.outputs.len();
    let mut values = vec![f32::NAN; texels * outputs];
    let mut filled = vec![false; texels];
    for split in splits {
        for row in 0..split.rows() {
            let index = |input: usize| {
                let place = split.columns[input][row];
                places[input].partition_point(|&before| before < place)
            };
            let texel =
                (0..inputs).rev().fold(0, |texel, input| texel * size[input] + index(input));
            let texel_values = &mut values[texel * outputs..][..outputs];
            let row_values = (0..outputs).map(|output| split.columns[inputs + output][row]);
            // Small tables have all rows in both splits.
            if filled[texel] && !row_values.clone().eq(texel_values.iter().copied()) {
                return None;
            }
            texel_values.iter_mut().zip(row_values).for_each(|(value, row)| *value = row);
            filled[texel] = true;
        }
    }
    filled.iter().all(|&filled| filled).then(|| Array {
        kind: "grid".to_owned(),
        size: size.into_iter().filter(|&along| along != 1).collect(),
        channels: dataset.outputs.iter().map(|output| output.name.clone()).collect(),
        values,
        ..Array::default()
    })
}

/// Returns the values of an input, ascending, each once.
fn places(splits: &[&Split], input: usize) -> Vec<f32> {
    let values = splits.iter().flat_map(|split| split.columns[input].iter().copied());
    // Zeros of both signs are one place.
    let mut places: Vec<f32> = values.map(|value| value + 0.0).collect();
    places.sort_unstable_by(f32::total_cmp);
    places.dedup();
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::array::{Layout, Request, parse, to_exr, to_npy};

    fn grid() -> Array {
        Array {
            size: vec![12, 9],
            channels: vec!["a1".into(), "b1".into()],
            values: (0..216).map(|i| (i as f32 * 0.37).sin()).collect(),
            ..Array::default()
        }
    }

    #[test]
    fn a_grid_goes_through_a_dataset_and_files_and_back() {
        let (dataset, _) = Layout::default().dataset("grid.npy".as_ref(), &grid()).unwrap();
        let back = Array::of_grid(&dataset, None).unwrap();
        assert_eq!((&back.size, &back.values), (&grid().size, &grid().values));
        for (name, bytes) in [("g.npy", to_npy(&back)), ("g.exr", to_exr(&back).unwrap())] {
            let read = parse(name.as_ref(), &bytes, &Request::default()).unwrap().unwrap();
            assert_eq!((&read.size, &read.values), (&grid().size, &grid().values), "{name}");
        }
        let rows = Array::of_rows(&dataset, &[&dataset.search]);
        assert_eq!(rows.channels, ["u", "v", "a1", "b1"]);
        assert_eq!(rows.values.len(), 4 * dataset.search.rows());
    }

    #[test]
    fn a_curve_has_the_rows_of_both_splits() {
        let curve = Array { size: vec![40], channels: vec!["y".into()], ..grid() };
        let curve = Array { values: curve.values[..40].to_vec(), ..curve };
        let (dataset, _) = Layout::default().dataset("curve.npy".as_ref(), &curve).unwrap();
        assert_eq!(Array::of_grid(&dataset, None).unwrap().values, curve.values);
        let search = Array::of_rows(&dataset, &[&dataset.search]);
        assert!(search.size[0] < 40);
    }

    #[test]
    fn rows_with_a_hole_are_no_grid() {
        let (mut dataset, _) = Layout::default().dataset("grid.npy".as_ref(), &grid()).unwrap();
        dataset.search.columns.iter_mut().for_each(|column| column.truncate(column.len() - 1));
        assert_eq!(Array::of_grid(&dataset, None), None);
        assert!(to_exr(&Array { size: vec![2, 3, 4], ..Array::default() }).is_err());
    }
}
