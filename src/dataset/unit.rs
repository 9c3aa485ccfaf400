//! The magnitudes of columns: the sizes that count as large or small there.

use super::Column;

/// Columns whose largest magnitude is within `[1 / NATURAL, NATURAL]` are searched as they are:
/// angles, exponents and cosines mean something in their own unit. All committed datasets are
/// within; 380 nm is not. By hand.
const NATURAL: f64 = 16.0;

/// Returns the power of two that brings a column's largest magnitude into (1/2, 1]; one for columns
/// of a natural magnitude, and for those that are zero throughout.
///
/// Dividing values by a power of two rounds nothing.
pub fn unit(column: &Column) -> f64 {
    let [low, high] = column.domain;
    let largest = low.abs().max(high.abs());
    if largest == 0.0 || (1.0 / NATURAL..=NATURAL).contains(&largest) {
        return 1.0;
    }
    largest.log2().ceil().exp2()
}

/// Returns the [`unit()`] of each output.
pub fn output_units(outputs: &[Column]) -> Vec<f64> {
    outputs.iter().map(unit).collect()
}

/// Returns the unit of errors over all outputs: the outputs' unit if it is the same for all, else
/// one, each output's errors being relative to its own.
pub fn joint_unit(units: &[f64]) -> f64 {
    let alike = units.windows(2).all(|pair| pair[0] == pair[1]);
    units.first().copied().filter(|_| alike).unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_the_power_of_two_above_and_one_where_magnitudes_are_natural() {
        let of = |low: f64, high: f64| {
            unit(&Column { name: "x".into(), unit: String::new(), domain: [low, high] })
        };
        assert_eq!([of(0.0, 1.0), of(-3.2, 3.2), of(0.0, 0.0)], [1.0; 3]);
        assert_eq!(
            [of(380.0, 830.0), of(-1024.0, 3.0), of(0.0, 0.01)],
            [1024.0, 1024.0, 1.0 / 64.0]
        );
        for k in [-120, -60, -9, 9, 60, 120] {
            let k = f64::from(k).exp2();
            assert_eq!(of(0.0, k), k);
            assert_eq!(of(0.0, 0.75 * k), k);
        }
    }
}
