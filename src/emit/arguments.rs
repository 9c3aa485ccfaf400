//! What a function is to be given for the values of columns: the parameters, where columns are
//! made of them.

use super::call::{CallError, Lets, component_of, value_over};
use crate::eval::{Arithmetic, Double};
use crate::program::{Arg, Program};

/// The components of a function's parameters, by columns.
#[derive(Clone, Debug)]
pub struct Arguments {
    components: Vec<String>,
    /// The column that each component is, if it is one.
    columns: Vec<Option<usize>>,
    /// How columns are made of components: the column, its value, and the components it reads.
    made: Vec<(usize, Program, Vec<usize>)>,
}

impl Arguments {
    /// Says what each component is: a column that `known` says or that is called alike, or what
    /// `lets` make columns of.
    ///
    /// # Errors
    /// [`CallError::Expression`].
    pub fn of(
        components: &[String],
        columns: &[String],
        known: &[(String, String)],
        lets: &Lets,
    ) -> Result<Arguments, CallError> {
        let mut arguments = Arguments {
            components: components.to_vec(),
            columns: vec![None; components.len()],
            made: Vec::new(),
        };
        for (i, column) in columns.iter().enumerate() {
            if let Some(text) = lets.of(column) {
                let program = value_over(column, text, components)?;
                let reads = (0..components.len()).filter(|&c| reads(&program, c)).collect();
                arguments.made.push((i, program, reads));
                continue;
            }
            let said = known.iter().find(|(known, _)| known == column);
            let said = said.and_then(|(_, name)| components.iter().position(|other| other == name));
            if let Some(place) = said.or_else(|| component_of(column, components)) {
                arguments.columns[place] = Some(i);
            }
        }
        // What makes a column is not one by itself.
        for (_, _, reads) in &arguments.made {
            for &component in reads.iter().filter(|_| reads.len() == 1) {
                arguments.columns[component] = None;
            }
        }
        Ok(arguments)
    }

    /// Checks that parameters make each column somewhere what it can be: at an end of its domain,
    /// or in the middle.
    ///
    /// # Errors
    /// [`CallError::Unreachable`].
    pub fn reach(
        &self,
        columns: &[String],
        lets: &Lets,
        domains: &[[f64; 2]],
    ) -> Result<(), CallError> {
        for (column, program, reads) in &self.made {
            let [low, high] = domains[*column];
            let reached = |target: f64| {
                let (last, others) = reads.split_last()?;
                let mut values = vec![None; self.components.len()];
                others.iter().for_each(|&other| values[other] = Some(self.usual(other, 0)));
                solved(program, &values, *last, target)
            };
            let constant = || {
                let value = Double.evaluate(program, &vec![0.0; self.components.len()])[0];
                reads.is_empty() && (low..=high).contains(&value)
            };
            if [low, high, 0.5 * (low + high)].into_iter().all(|x| reached(x).is_none())
                && !constant()
            {
                let column = columns[*column].clone();
                let text = lets.of(&column).unwrap_or_default().to_owned();
                return Err(CallError::Unreachable { column, text, low, high });
            }
        }
        Ok(())
    }

    /// Returns the components' values for a row of columns; none if some column cannot be made of
    /// any. What no column depends on takes values of a sequence, by the row's number.
    pub fn at(&self, row: &[f32], number: usize) -> Option<Vec<f32>> {
        // By hand: vectors that point away from each other have no large dot product.
        const TRIES: usize = 64;
        (0..TRIES).find_map(|i| self.tried(row, number.wrapping_add(i * 7919)))
    }

    fn tried(&self, row: &[f32], number: usize) -> Option<Vec<f32>> {
        let mut values: Vec<Option<f64>> =
            self.columns.iter().map(|column| column.map(|i| f64::from(row[i]))).collect();
        let mut left: Vec<&(usize, Program, Vec<usize>)> = self.made.iter().collect();
        while !left.is_empty() {
            let unknown = |reads: &[usize]| reads.iter().filter(|&&c| values[c].is_none()).count();
            left.sort_by_key(|(_, _, reads)| unknown(reads));
            let (column, program, reads) = left.remove(0);
            let unknown: Vec<usize> =
                reads.iter().copied().filter(|&component| values[component].is_none()).collect();
            let Some((&last, others)) = unknown.split_last() else { continue };
            for &other in others {
                values[other] = Some(self.usual(other, number));
            }
            values[last] = Some(solved(program, &values, last, f64::from(row[*column]))?);
        }
        let free = |component: usize| spread(component, number);
        let values = values.iter().enumerate();
        Some(values.map(|(i, value)| value.unwrap_or_else(|| free(i)) as f32).collect())
    }

    /// Returns the range of each component over a domain of columns, of its corners and middle.
    pub fn domain(&self, columns: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut ranges = vec![[f64::INFINITY, f64::NEG_INFINITY]; self.components.len()];
        let corners = 1usize << columns.len().min(10);
        for corner in 0..=corners {
            let at = |(i, [low, high]): (usize, &[f64; 2])| match corner {
                _ if corner == corners => 0.5 * (low + high),
                _ if corner >> i & 1 == 1 => *high,
                _ => *low,
            };
            let row: Vec<f32> = columns.iter().enumerate().map(|pair| at(pair) as f32).collect();
            let Some(values) = self.at(&row, corner) else { continue };
            for (range, value) in ranges.iter_mut().zip(values) {
                *range = [range[0].min(value.into()), range[1].max(value.into())];
            }
        }
        let free = |i: usize| {
            self.columns[i].is_none() && !self.made.iter().any(|(_, _, reads)| reads.contains(&i))
        };
        let ranges = ranges.into_iter().enumerate();
        let ranges = ranges.map(|(i, range)| match range[0] <= range[1] && !free(i) {
            true => range,
            false => [0.0, 1.0],
        });
        ranges.collect()
    }

    /// Returns the value of a component that may have any: of each row others, so that none may be
    /// left out unseen; vectors point along z, more or less, and are of length 1, more or less.
    fn usual(&self, component: usize, number: usize) -> f64 {
        let share = spread(component, number);
        match self.components[component].rsplit_once('.') {
            Some((_, "z")) => 0.75 + 0.5 * share,
            Some(_) => 0.5 * (share - 0.5),
            None => share,
        }
    }
}

/// Returns values in [0, 1) that fill it evenly: multiples of the golden ratio, others for each
/// component.
pub fn spread(component: usize, number: usize) -> f64 {
    let golden = 0.618_033_988_749_894_9;
    (golden * (number + 1) as f64 + 0.3 * component as f64).fract()
}

fn reads(program: &Program, component: usize) -> bool {
    let args = program.instrs.iter().flat_map(|instr| instr.args()).chain(&program.outputs);
    args.into_iter().any(|arg| *arg == Arg::Input(component as u16))
}

/// Ranges in which a component is looked for, the likely ones first.
const RANGES: [[f64; 2]; 6] =
    [[0.0, 1.0], [-1.0, 1.0], [0.0, 16.0], [-64.0, 64.0], [0.0, 65504.0], [-1e6, 1e6]];

/// Returns the value of a component with which the program's value is `target`.
fn solved(program: &Program, values: &[Option<f64>], component: usize, target: f64) -> Option<f64> {
    let mut point: Vec<f64> = values.iter().map(|value| value.unwrap_or(0.0)).collect();
    let mut difference = |x: f64| {
        point[component] = x;
        Double.evaluate(program, &point)[0] - target
    };
    // The value that a clamp maps to itself, if it does.
    if difference(target) == 0.0 {
        return Some(target);
    }
    for [low, high] in RANGES {
        const STEPS: usize = 64;
        let at = |i: usize| low + (high - low) * i as f64 / STEPS as f64;
        let mut before = difference(low);
        if before == 0.0 {
            return Some(low);
        }
        for i in 1..=STEPS {
            let after = difference(at(i));
            if after == 0.0 {
                return Some(at(i));
            }
            if before.is_finite() && after.is_finite() && (before < 0.0) != (after < 0.0) {
                return Some(bisected(&mut difference, [at(i - 1), at(i)], before < 0.0));
            }
            before = after;
        }
    }
    // Nothing is that far: the nearest end of the likely range, if it is near.
    let [low, high] = [0.0, 1.0].map(|x| difference(x).abs());
    (low.min(high) < 1e-6).then_some(if low < high { 0.0 } else { 1.0 })
}

fn bisected(
    difference: &mut impl FnMut(f64) -> f64,
    [mut low, mut high]: [f64; 2],
    rises: bool,
) -> f64 {
    // A double has 53 bits.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (difference(middle) < 0.0) == rises {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arguments(components: &[&str], columns: &[&str], lets: &[&str]) -> Arguments {
        let [components, columns, lets] =
            [components, columns, lets].map(|names| names.iter().map(|n| n.to_string()).collect());
        let components: Vec<String> = components;
        let (columns, lets): (Vec<String>, Vec<String>) = (columns, lets);
        Arguments::of(&components, &columns, &[], &Lets::parse(&lets).unwrap()).unwrap()
    }

    #[test]
    fn parameters_are_found_for_columns_made_of_them() {
        let arguments =
            arguments(&["roughness", "nov"], &["n_dot_v", "alpha"], &["alpha = roughness^2"]);
        let found = arguments.at(&[0.25, 0.49], 0).unwrap();
        assert!((found[0] - 0.7).abs() < 1e-6 && found[1] == 0.25, "{found:?}");
        assert_eq!(arguments.domain(&[[0.0, 1.0], [0.0, 4.0]]), [[0.0, 2.0], [0.0, 1.0]]);
    }

    #[test]
    fn vectors_have_the_dot_product_that_is_asked_for_and_what_is_free_is_anything() {
        let lets = ["n_dot_v = dot(n, v)"];
        let components = ["n.x", "n.y", "n.z", "v.x", "v.y", "v.z", "f0"];
        let arguments = arguments(&components, &["n_dot_v"], &lets);
        let found = arguments.at(&[0.3], 5).unwrap();
        let dot: f32 = (0..3).map(|i| found[i] * found[3 + i]).sum();
        assert!((dot - 0.3).abs() < 1e-6 && (0.0..1.0).contains(&found[6]), "{found:?}");
        assert!(found[..5].iter().all(|component| component.abs() > 1e-3), "{found:?}");
    }

    #[test]
    fn normalised_vectors_reach_all_of_the_domain() {
        let components = ["n.x", "n.y", "n.z", "v.x", "v.y", "v.z"];
        let lets = ["n_dot_v = saturate(dot(n, normalize(v)))"];
        let arguments = arguments(&components, &["n_dot_v"], &lets);
        for row in 0..=200 {
            assert!(arguments.at(&[row as f32 / 200.0], row).is_some(), "row {row}");
        }
    }

    #[test]
    fn a_column_that_is_never_in_its_domain_is_refused() {
        let text = "alpha = roughness/0";
        let lets = Lets::parse(&[text.to_owned()]).unwrap();
        let names = |name: &str| vec![name.to_owned()];
        let (components, columns) = (names("roughness"), names("alpha"));
        let arguments = Arguments::of(&components, &columns, &[], &lets).unwrap();
        let error = arguments.reach(&columns, &lets, &[[0.0, 1.0]]).unwrap_err().to_string();
        assert!(error.contains("no values of the parameters make it one in [0, 1]"), "{error}");
    }

    #[test]
    fn a_clamp_keeps_what_it_does_not_change() {
        let arguments = arguments(&["x"], &["x"], &["x = saturate(x)"]);
        for x in [0.0, 0.1, 1.0] {
            assert_eq!(arguments.at(&[x], 0).unwrap(), [x]);
        }
    }
}
