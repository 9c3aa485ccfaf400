//! What 32-bit floats keep of a column.

use super::read::{Source, Wanted};
use crate::import::Error;
use std::path::Path;

/// A column and what was done to it.
pub(super) struct Kept {
    pub values: Vec<f32>,
    /// What was subtracted from each value.
    pub base: f64,
    pub note: Option<String>,
}

/// Whole numbers up to here are floats.
const WHOLE: f64 = 16_777_216.0;
/// Whole numbers up to here are doubles.
const WHOLE_DOUBLE: f64 = 9_007_199_254_740_992.0;
/// Values in a range this small beside their magnitude have few of a float's digits. By hand.
const NARROW: f64 = 256.0;
/// The share of values that may fall together: data of seven digits have some that do. By hand.
const LOST: f64 = 0.01;

/// Checks that columns keep their values; those in a narrow range far from zero are shifted to it.
pub(super) fn keep(
    source: &Source,
    wanted: &[Wanted],
    columns: Vec<Vec<f32>>,
) -> Result<Vec<Kept>, Error> {
    let rows = columns.first().map_or(0, Vec::len);
    let in_doubt: Vec<bool> = columns.iter().map(|column| is_in_doubt(column)).collect();
    let asked: Vec<&Wanted> =
        wanted.iter().zip(&in_doubt).filter(|(_, doubt)| **doubt).map(|(w, _)| w).collect();
    let mut wide = match asked.is_empty() {
        true => Vec::new(),
        false => source.read_wide(&asked, rows)?,
    }
    .into_iter();
    let mut kept = Vec::new();
    for ((values, wanted), doubt) in columns.into_iter().zip(wanted).zip(in_doubt) {
        let wide = if doubt { wide.next() } else { None };
        kept.push(match wide {
            Some(wide) => judged(source.path, values, &wide, wanted)?,
            None => Kept { values, base: 0.0, note: None },
        });
    }
    Ok(kept)
}

/// Returns true for a column of which floats may keep too little.
fn is_in_doubt(column: &[f32]) -> bool {
    let wide = column.iter().map(|value| f64::from(*value));
    let [low, high] =
        wide.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
    let largest = low.abs().max(high.abs());
    (largest > WHOLE && largest <= WHOLE_DOUBLE)
        || (largest > 0.0 && high - low < largest / NARROW && column.len() > 1)
        || largest < f64::from(f32::MIN_POSITIVE)
}

fn judged(path: &Path, values: Vec<f32>, wide: &[f64], wanted: &Wanted) -> Result<Kept, Error> {
    let [low, high] =
        wide.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], &v| [l.min(v), h.max(v)]);
    let largest = low.abs().max(high.abs());
    let column = wanted.name.clone();
    if largest > 0.0 && largest < f64::from(f32::MIN_POSITIVE) {
        let remedy = format!("1e{}", wanted.scale.unwrap_or(0) - largest.log10().floor() as i32);
        return Err(Error::TooSmall { path: path.into(), column, largest, remedy });
    }
    let mut sorted = wide.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    let of = sorted.len();
    let lost = |base: f64| of - distinct(&sorted, base);
    let plain = lost(0.0);
    let much = |lost: usize| lost as f64 > LOST * of as f64;
    if plain == 0 {
        return Ok(Kept { values, base: 0.0, note: None });
    }
    let together =
        format!("{plain} of the {of} values of `{column}` fall together in 32-bit floats");
    if !much(plain) {
        return Ok(Kept { values, base: 0.0, note: Some(together) });
    }
    if let Some(base) = base(low, high).filter(|base| !much(lost(*base))) {
        let values = wide.iter().map(|value| (value - base) as f32).collect();
        let note = format!("{together}, and none less {base}: `{column}` is shifted by that");
        return Ok(Kept { values, base, note: Some(note) });
    }
    match wide.iter().all(|value| value.fract() == 0.0) {
        true => Err(Error::FallTogether { path: path.into(), column, lost: plain, of }),
        false => Ok(Kept { values, base: 0.0, note: Some(together) }),
    }
}

/// Counts the floats that sorted values less `base` become.
fn distinct(sorted: &[f64], base: f64) -> usize {
    let mut last = None;
    let is_new = |value: &&f64| {
        let narrow = (**value - base) as f32;
        last.replace(narrow) != Some(narrow)
    };
    sorted.iter().filter(is_new).count()
}

/// Returns the whole number with most zeros at its end that lies near the values, towards zero.
fn base(low: f64, high: f64) -> Option<f64> {
    let near = if low > 0.0 { low } else { -high };
    let range = high - low;
    (0..=15).rev().map(|power| 10f64.powi(power)).find_map(|unit| {
        let base = (near / unit).floor() * unit;
        // By hand: a digit more in the base is worth a factor of 16.
        let is_near = near - base <= 16.0 * range.max(1.0);
        (base > 0.0 && is_near).then_some(if low > 0.0 { base } else { -base })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bases_are_round_numbers_near_the_values() {
        assert_eq!(base(1_700_000_000.0, 1_700_000_063.0), Some(1_700_000_000.0));
        assert_eq!(base(1_700_000_963.0, 1_700_001_963.0), Some(1_700_000_000.0));
        assert_eq!(base(2_459_000.5, 2_459_001.25), Some(2_459_000.0));
        assert_eq!(base(-1_700_000_063.0, -1_700_000_000.0), Some(-1_700_000_000.0));
        assert_eq!(base(0.5, 0.500_001), None);
        assert_eq!(base(-1e9, 1e9), None);
    }
}
