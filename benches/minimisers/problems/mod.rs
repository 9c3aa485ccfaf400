//! Functions whose minima are published, for the tests of minimisers and for their benchmark.

pub mod mgh;
pub mod multimodal;

/// The function to be minimised.
#[derive(Clone, Copy)]
pub enum Function {
    Value(fn(&[f64]) -> f64),
    /// The sum of the squares of residuals.
    Squares(fn(&[f64]) -> Vec<f64>),
}

pub struct Problem {
    pub name: &'static str,
    pub function: Function,
    /// The standard start; of a multimodal function, the middle of its ranges.
    pub start: Vec<f64>,
    pub ranges: Vec<[f64; 2]>,
    /// The least value, as published.
    pub least: f64,
    /// A point near a minimum, where one is published.
    pub near: Option<Vec<f64>>,
    /// What a value may exceed the least by and count as the minimum.
    pub tolerance: f64,
}

impl Problem {
    pub fn value(&self, x: &[f64]) -> f64 {
        match self.function {
            Function::Value(f) => f(x),
            Function::Squares(residuals) => residuals(x).iter().map(|r| r * r).sum(),
        }
    }

    pub fn is_reached(&self, value: f64) -> bool {
        value <= self.least + self.tolerance
    }

    /// The start of a seed: the standard one at seed 0, else moved by up to a tenth of each
    /// coordinate, or of 1 if that is less.
    pub fn start_of(&self, seed: u64) -> Vec<f64> {
        if seed == 0 {
            return self.start.clone();
        }
        let mut random = Random(seed);
        self.start
            .iter()
            .map(|x| x + 0.1 * x.abs().max(1.0) * (2.0 * random.unit() - 1.0))
            .collect()
    }
}

pub fn find(name: &str) -> Option<Problem> {
    multimodal::all().into_iter().chain(mgh::all()).find(|problem| problem.name == name)
}

/// Numbers that are the same in every program of the benchmark: SplitMix64 (Steele, Lea & Flood
/// 2014).
pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn point(&mut self, ranges: &[[f64; 2]]) -> Vec<f64> {
        ranges.iter().map(|[low, high]| low + (high - low) * self.unit()).collect()
    }
}
