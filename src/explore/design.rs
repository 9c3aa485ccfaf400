//! Products of Legendre polynomials as the terms of a fit.

use std::collections::BTreeSet;

/// The rows whose terms are computed together. By hand: terms of a block stay in the cache.
pub(super) const BLOCK: usize = 64;

/// The most terms of a fit, and the highest degree. By hand: the time of a fit rises with the
/// square of the first, and 64 points along an axis hold a degree of 32.
const MOST_TERMS: usize = 240;
const HIGHEST_DEGREE: usize = 32;

/// The least rows for each term. By hand, unmeasured.
const ROWS_A_TERM: usize = 4;

/// The terms of a fit: those of a low total degree come first.
pub(super) struct Design {
    pub rows: usize,
    /// Coordinates within [-1, 1], by row.
    pub columns: Vec<Vec<f64>>,
    /// The degree in each coordinate.
    pub terms: Vec<Vec<u8>>,
    /// The number of terms up to each total degree.
    pub ends: Vec<usize>,
    /// What all terms are multiplied by, by row.
    pub factor: Option<Vec<f64>>,
    /// Coordinates whose degrees are exchanged in a second product that is added to each term.
    pub symmetric: Option<(usize, usize)>,
}

impl Design {
    /// Makes the terms whose coordinates are all in one of the parts, as many whole degrees as the
    /// rows bear.
    pub fn new(
        rows: usize,
        columns: Vec<Vec<f64>>,
        parts: &[Vec<usize>],
        symmetric: Option<(usize, usize)>,
    ) -> Design {
        let most = MOST_TERMS.min(rows / ROWS_A_TERM).max(1);
        let mut terms = Vec::new();
        let mut ends = Vec::new();
        for degree in 0..=HIGHEST_DEGREE {
            let next = terms_of(degree, parts, columns.len(), symmetric);
            if terms.len() + next.len() > most || next.is_empty() {
                break;
            }
            terms.extend(next);
            ends.push(terms.len());
        }
        Design { rows, columns, terms, ends, factor: None, symmetric }
    }

    /// Drops the terms beyond a total degree.
    pub fn truncate(&mut self, degree: usize) {
        self.ends.truncate(degree + 1);
        self.terms.truncate(self.ends.last().copied().unwrap_or(0));
    }

    /// Drops whole degrees until there are no more terms than a number, but for the constant one.
    pub fn truncate_to(&mut self, terms: usize) {
        let degree = self.ends.iter().rposition(|&end| end <= terms).unwrap_or(0);
        self.truncate(degree);
    }

    /// Computes the terms of some rows, at most a block: of each term a block of values.
    pub fn fill(&self, rows: &[usize], values: &mut Vec<f64>) {
        values.clear();
        values.resize(self.terms.len() * BLOCK, 0.0);
        let highest = self.ends.len();
        let tables: Vec<Vec<f64>> =
            self.columns.iter().map(|column| legendre(column, rows, highest)).collect();
        for (term, values) in self.terms.iter().zip(values.chunks_exact_mut(BLOCK)) {
            product(&tables, term, values);
            if let Some((a, b)) = self.symmetric.filter(|&(a, b)| term[a] != term[b]) {
                let mut exchanged = term.clone();
                exchanged.swap(a, b);
                let mut second = [0.0; BLOCK];
                product(&tables, &exchanged, &mut second);
                values.iter_mut().zip(second).for_each(|(value, second)| *value += second);
            }
            if let Some(factor) = &self.factor {
                values.iter_mut().zip(rows).for_each(|(value, &row)| *value *= factor[row]);
            }
            // The last block is rarely full.
            values[rows.len()..].fill(0.0);
        }
    }
}

/// Returns how many terms a fit of parts has up to a total degree, where each coordinate's own
/// degree counts as often as it says.
pub(super) fn terms_up_to(degree: usize, parts: &[Vec<usize>], counts: &[usize]) -> usize {
    let total = |term: &Vec<u8>| -> usize {
        term.iter().zip(counts).map(|(own, count)| usize::from(*own) * count).sum()
    };
    let all = (0..=degree).flat_map(|degree| terms_of(degree, parts, counts.len(), None));
    all.filter(|term| total(term) <= degree).count()
}

fn terms_of(
    degree: usize,
    parts: &[Vec<usize>],
    coordinates: usize,
    symmetric: Option<(usize, usize)>,
) -> Vec<Vec<u8>> {
    let mut terms = BTreeSet::new();
    for part in parts {
        let mut term = vec![0; coordinates];
        spread(degree, part, &mut term, &mut terms);
    }
    terms.retain(|term| symmetric.is_none_or(|(a, b)| term[a] >= term[b]));
    terms.into_iter().collect()
}

/// Adds every way to share a degree among coordinates.
fn spread(degree: usize, among: &[usize], term: &mut Vec<u8>, terms: &mut BTreeSet<Vec<u8>>) {
    if degree == 0 {
        terms.insert(term.clone());
        return;
    }
    let Some((&first, others)) = among.split_first() else { return };
    for own in (0..=degree).rev() {
        term[first] = own as u8;
        spread(degree - own, others, term, terms);
    }
    term[first] = 0;
}

/// Computes Legendre polynomials of unit variance: for each degree a block of values.
fn legendre(column: &[f64], rows: &[usize], degrees: usize) -> Vec<f64> {
    let mut table = vec![0.0; degrees.max(2) * BLOCK];
    for (at, &row) in rows.iter().enumerate() {
        let x = column[row];
        let (mut last, mut this) = (1.0, x);
        table[at] = 1.0;
        for k in 1..degrees {
            let degree = k as f64;
            table[k * BLOCK + at] = this * (2.0 * degree + 1.0).sqrt();
            let next = ((2.0 * degree + 1.0) * x * this - degree * last) / (degree + 1.0);
            (last, this) = (this, next);
        }
    }
    table
}

fn product(tables: &[Vec<f64>], term: &[u8], values: &mut [f64]) {
    values.fill(1.0);
    for (table, &degree) in tables.iter().zip(term).filter(|(_, degree)| **degree > 0) {
        let factors = &table[usize::from(degree) * BLOCK..];
        values.iter_mut().zip(factors).for_each(|(value, factor)| *value *= factor);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_are_those_within_a_part() {
        assert_eq!(terms_up_to(3, &[vec![0, 1]], &[1, 1]), 10);
        assert_eq!(terms_up_to(3, &[vec![0], vec![1]], &[1, 1]), 7);
        assert_eq!(terms_up_to(2, &[vec![0, 2], vec![1, 2]], &[1; 3]), 9);
        assert_eq!(terms_up_to(4, &[vec![0]], &[2]), 3);
    }

    #[test]
    fn polynomials_have_unit_variance() {
        let points = 20_000;
        let column: Vec<f64> =
            (0..points).map(|i| 2.0 * (f64::from(i) + 0.5) / f64::from(points) - 1.0).collect();
        let mut sums = [0.0; 5];
        for rows in (0..column.len()).collect::<Vec<_>>().chunks(BLOCK) {
            let table = legendre(&column, rows, 5);
            for (k, sum) in sums.iter_mut().enumerate() {
                *sum += table[k * BLOCK..][..rows.len()].iter().map(|v| v * v).sum::<f64>();
            }
        }
        for sum in sums {
            assert!((sum / f64::from(points) - 1.0).abs() < 1e-6, "{sum}");
        }
    }
}
