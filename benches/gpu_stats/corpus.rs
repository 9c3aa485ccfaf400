//! Tables of formulas and what compilers made of them, and how well a column of costs agrees.

use lgp::cost::{CostScratch, Profile};
use lgp::program::{Program, parse_open, use_counts};

/// Formulas by line, and a column of numbers for each target.
pub struct Corpus {
    pub targets: Vec<String>,
    pub rows: Vec<Row>,
}

pub struct Row {
    pub formula: String,
    /// As many as there are targets.
    pub measured: Vec<f64>,
}

impl Corpus {
    /// Reads `id,formula,target…`, formulas perhaps in quotes.
    ///
    /// # Panics
    /// If the text is no such table.
    pub fn parse(text: &str) -> Corpus {
        let mut lines = text.lines().filter(|line| !line.starts_with('#'));
        let header = lines.next().expect("a header");
        let targets: Vec<String> = header.split(',').skip(2).map(str::to_owned).collect();
        let row = |line: &str| {
            let (_, rest) = line.split_once(',').expect("a row number");
            let mut fields: Vec<&str> = rest.rsplitn(targets.len() + 1, ',').collect();
            let formula = fields.pop().expect("a formula").trim_matches('"').to_owned();
            let numbers = fields.iter().rev().map(|field| field.parse().expect("a number"));
            Row { formula, measured: numbers.collect() }
        };
        Corpus { rows: lines.map(row).collect(), targets }
    }

    /// The largest of some measured columns, which are pipes beside each other.
    ///
    /// # Panics
    /// If the table lacks one.
    pub fn busiest(&self, columns: &[String]) -> Vec<f64> {
        let place = |column| self.targets.iter().position(|known| known == column);
        let places: Vec<usize> =
            columns.iter().map(|column| place(column).expect("a column of the table")).collect();
        let busiest = |row: &Row| places.iter().map(|&i| row.measured[i]).fold(0.0, f64::max);
        self.rows.iter().map(busiest).collect()
    }

    pub fn programs(&self) -> Vec<Program> {
        let parse = |row: &Row| parse_open(&row.formula, &[]).expect("a formula").program;
        self.rows.iter().map(parse).collect()
    }
}

/// A profile's cycles for each program.
pub fn cycles(profile: &Profile, programs: &[Program]) -> Vec<f64> {
    let mut scratch = CostScratch::default();
    programs.iter().map(|program| profile.cycles(program, &mut scratch)).collect()
}

/// How many operations each program has: the cost model of other engines.
pub fn nodes(programs: &[Program]) -> Vec<f64> {
    let mut uses = Vec::new();
    let count = |program: &Program| {
        use_counts(program, &mut uses);
        uses.iter().filter(|uses| **uses > 0).count() as f64
    };
    programs.iter().map(count).collect()
}

/// Pearson's correlation.
pub fn pearson(a: &[f64], b: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let sum = |f: &dyn Fn(f64, f64) -> f64| -> f64 {
        a.iter().zip(b).map(|(&a, &b)| f(a - mean_a, b - mean_b)).sum()
    };
    sum(&|a, b| a * b) / (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt()
}

/// Spearman's rank correlation: Pearson's of the ranks, equal values sharing the mean of theirs.
pub fn spearman(a: &[f64], b: &[f64]) -> f64 {
    pearson(&ranks(a), &ranks(b))
}

fn ranks(values: &[f64]) -> Vec<f64> {
    let below = |value: f64| values.iter().filter(|&&other| other < value).count();
    let equal = |value: f64| values.iter().filter(|&&other| other == value).count();
    values.iter().map(|&v| below(v) as f64 + (equal(v) as f64 - 1.0) / 2.0).collect()
}
