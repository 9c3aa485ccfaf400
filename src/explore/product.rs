//! Products of functions, fitted by turns.

use super::design::{BLOCK, Design};
use super::linear::Cholesky;
use super::rows::Rows;
use super::smooth::{AS_GOOD, Fit, Sums, folds, root_mean_square};

/// The most rounds in which each factor is fitted once, and the change of the sum of squares that
/// ends them. By hand: where a product holds, the first guess is nearly it.
const ROUNDS: usize = 8;
const SETTLED: f64 = 1e-3;

/// The degrees of factors that are tried, on one fold. By hand: each is half as good again as the one before.
const DEGREES: [usize; 6] = [2, 3, 5, 8, 12, 18];

/// The most terms of a factor, and the most rows that products are fitted to. By hand, for tenths of
/// a second: a fit of all factors takes as many fits of one as there are rounds and folds.
const MOST_TERMS: usize = 90;
pub(super) const MOST_ROWS: usize = 4096;

/// Turns of power iteration for the first guess. By hand, unmeasured.
const TURNS: usize = 30;

/// Fits a product of functions, each of some of the coordinates, to the first rows. `joint` is a
/// fit of all coordinates together, from whose coefficients the first guess comes; what its design
/// multiplies all terms by stands before the product.
pub(super) fn fit(rows: &Rows, parts: &[Vec<usize>], joint: (&Design, &Fit)) -> Fit {
    let Design { columns, factor, .. } = joint.0;
    let known = factor.clone().unwrap_or_else(|| vec![1.0; joint.0.rows]);
    let first = &folds(known.len())[0];
    let mut best: Option<(f64, usize, Vec<Factor>)> = None;
    for degree in DEGREES {
        let mut factors: Vec<Factor> =
            parts.iter().map(|part| Factor::new(columns, part, degree, joint)).collect();
        let values = alternate(rows, first, &known, &factors);
        let left = squares(rows, first, &product(&values, &known, None));
        let enough = AS_GOOD[0] * left + AS_GOOD[1] * first.len() as f64;
        if best.as_ref().is_some_and(|(least, ..)| *least <= enough) {
            break;
        }
        let capped = factors.iter().all(|factor| factor.design.ends.len() <= degree);
        factors.iter_mut().zip(values).for_each(|(factor, values)| factor.guess = values);
        best = Some((left, degree, factors));
        if capped {
            break;
        }
    }
    let (_, degree, factors) = best.expect("at least one degree is tried");
    validated(rows, &known, &factors, degree)
}

/// One factor: its terms, and its first guess by row.
struct Factor {
    design: Design,
    guess: Vec<f64>,
}

impl Factor {
    fn new(columns: &[Vec<f64>], part: &[usize], degree: usize, joint: (&Design, &Fit)) -> Factor {
        let mut design = Design::new(columns[0].len(), columns.to_vec(), &[part.to_vec()], None);
        design.truncate_to(MOST_TERMS);
        design.truncate(degree);
        let coefficients = leading(&design, part, joint);
        let guess = design.evaluated(&coefficients);
        Factor { design, guess }
    }
}

/// Returns the factor of the product that is nearest to a joint fit, as far as its coefficients,
/// those of polynomials of unit variance, tell: the leading singular vector of their matrix, terms
/// of the part by terms of the others.
fn leading(design: &Design, part: &[usize], (whole, fit): (&Design, &Fit)) -> Vec<f64> {
    let own = |term: &[u8]| -> Vec<u8> {
        let within = |(at, degree): (usize, &u8)| if part.contains(&at) { *degree } else { 0 };
        term.iter().enumerate().map(within).collect()
    };
    let place = |term: &Vec<u8>| {
        design.terms.binary_search_by(|known| {
            let total = |term: &[u8]| term.iter().map(|&degree| u32::from(degree)).sum::<u32>();
            (total(known), known).cmp(&(total(term), term))
        })
    };
    let mut others: Vec<Vec<u8>> = Vec::new();
    let mut entries = Vec::new();
    for (term, &coefficient) in whole.terms.iter().zip(&fit.coefficients) {
        let mine = own(term);
        let other: Vec<u8> = term.iter().zip(&mine).map(|(all, mine)| all - mine).collect();
        let Ok(row) = place(&mine) else { continue };
        let column = others.iter().position(|known| *known == other).unwrap_or_else(|| {
            others.push(other);
            others.len() - 1
        });
        entries.push((row, column, coefficient));
    }
    let mut vector = vec![0.0; design.terms.len()];
    entries.iter().for_each(|&(row, _, entry)| vector[row] += entry * entry);
    for _ in 0..TURNS {
        let mut across = vec![0.0; others.len()];
        entries.iter().for_each(|&(row, column, entry)| across[column] += entry * vector[row]);
        vector.fill(0.0);
        entries.iter().for_each(|&(row, column, entry)| vector[row] += entry * across[column]);
        let length = vector.iter().map(|v| v * v).sum::<f64>().sqrt();
        if length > 0.0 {
            vector.iter_mut().for_each(|entry| *entry /= length);
        }
    }
    vector
}

fn validated(rows: &Rows, known: &[f64], factors: &[Factor], degree: usize) -> Fit {
    let mut errors = vec![0.0; known.len()];
    for fold in &folds(known.len()) {
        let values = product(&alternate(rows, fold, known, factors), known, None);
        fold.iter().for_each(|&row| errors[row] = rows.output[row] - values[row]);
    }
    let terms = factors.iter().map(|factor| factor.design.terms.len()).sum();
    let residual = root_mean_square(&errors, &rows.weights);
    Fit { degree, terms, coefficients: Vec::new(), errors, residual }
}

/// Fits each factor in turn, the others held, to all rows but those of one fold; returns the factors
/// in every row.
fn alternate(rows: &Rows, fold: &[usize], known: &[f64], factors: &[Factor]) -> Vec<Vec<f64>> {
    let folds = folds(known.len());
    let others = folds.iter().filter(|other| other.as_slice() != fold);
    let fitted: Vec<usize> = others.flatten().copied().collect();
    let mut values: Vec<Vec<f64>> = factors.iter().map(|factor| factor.guess.clone()).collect();
    let mut last = f64::INFINITY;
    for _ in 0..ROUNDS {
        for (own, factor) in factors.iter().enumerate() {
            let scale = product(&values, known, Some(own));
            let sums =
                Sums::of(&factor.design, &fitted, [&rows.output, &rows.weights], Some(&scale));
            let solver = Cholesky::new(&sums.matrix, factor.design.terms.len());
            let solved = solver.back(&solver.forward(&sums.vector), factor.design.terms.len());
            values[own] = factor.design.evaluated(&solved);
            normalise(&mut values[own]);
        }
        // The last factor fitted has lost its size to the normalisation; one number gives it back.
        let size = best_size(rows, &fitted, &product(&values, known, None));
        if let Some(first) = values.first_mut() {
            first.iter_mut().for_each(|value| *value *= size);
        }
        let left = squares(rows, &fitted, &product(&values, known, None));
        if left >= last * (1.0 - SETTLED) {
            break;
        }
        last = left;
    }
    values
}

/// Returns the weighted sum of squares that values leave of the output in some rows.
fn squares(rows: &Rows, of: &[usize], values: &[f64]) -> f64 {
    of.iter().map(|&row| rows.weights[row] * (rows.output[row] - values[row]).powi(2)).sum()
}

fn product(values: &[Vec<f64>], known: &[f64], except: Option<usize>) -> Vec<f64> {
    let mut whole = known.to_vec();
    for (_, values) in values.iter().enumerate().filter(|(at, _)| Some(*at) != except) {
        whole.iter_mut().zip(values).for_each(|(whole, value)| *whole *= value);
    }
    whole
}

fn normalise(values: &mut [f64]) {
    let square = values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64;
    if square > 0.0 {
        values.iter_mut().for_each(|value| *value /= square.sqrt());
    }
}

fn best_size(rows: &Rows, fitted: &[usize], whole: &[f64]) -> f64 {
    let sum = |value: &dyn Fn(usize) -> f64| -> f64 {
        fitted.iter().map(|&row| rows.weights[row] * whole[row] * value(row)).sum()
    };
    let square = sum(&|row| whole[row]);
    if square > 0.0 { sum(&|row| rows.output[row]) / square } else { 0.0 }
}

impl Design {
    /// Returns the sum of terms with these coefficients, by row.
    fn evaluated(&self, coefficients: &[f64]) -> Vec<f64> {
        let all: Vec<usize> = (0..self.rows).collect();
        let mut values = Vec::new();
        let mut sums = Vec::with_capacity(all.len());
        for block in all.chunks(BLOCK) {
            self.fill(block, &mut values);
            let sum = |at: usize| -> f64 {
                coefficients
                    .iter()
                    .zip(values.iter().skip(at).step_by(BLOCK))
                    .map(|(c, v)| c * v)
                    .sum()
            };
            sums.extend((0..block.len()).map(sum));
        }
        sums
    }
}
