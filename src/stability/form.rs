//! Affine forms: what a value owes to each input of a box and to each earlier instruction's
//! curvature, and what is left.

use crate::num::{Interval, enclose};

/// Inputs whose share is kept apart.
const INPUTS: usize = 8;

/// The same, and instructions; what others owe is left over.
const TERMS: usize = 96;

/// What `f64` arithmetic on forms may lose, relative to the magnitudes that met: a few hundred
/// roundings of 2⁻⁵³.
const LOSS: f64 = 1e-13;

/// `center + Σ terms[k]·u[k] ± fresh ± rest`, all `u[k]` in [−1, 1]: first the places of the inputs
/// within the box, then for each instruction by how much it is not the straight line that stands for
/// it (Stolfi & de Figueiredo, "Self-Validated Numerical Methods and Applications", 1997, chapter 3).
/// `fresh` is that of the instruction at hand; `rest` is rounding, which two readers of one result need
/// not share, since a compiler may compute it twice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Form {
    center: f64,
    /// How many of the terms are not zero, at most.
    used: usize,
    terms: [f64; TERMS],
    fresh: f64,
    rest: f64,
}

impl Form {
    /// Any value of an interval; nothing where that is not bounded.
    pub fn around(bounds: Interval) -> Option<Form> {
        let (low, high) = (f64::from(bounds.low()), f64::from(bounds.high()));
        (low.is_finite() && high.is_finite() && low <= high).then(|| Form {
            center: low / 2.0 + high / 2.0,
            used: 0,
            terms: [0.0; TERMS],
            fresh: high / 2.0 - low / 2.0,
            rest: 0.0,
        })
    }

    /// An input.
    pub fn input(index: usize, bounds: Interval) -> Option<Form> {
        let form = Form::around(bounds)?;
        Some(if index < INPUTS { form.settled(index) } else { form.unshared() })
    }

    /// As the result of an instruction, whose curvature later ones can refer to.
    #[must_use]
    pub fn of_instruction(self, index: usize) -> Form {
        if INPUTS + index < TERMS { self.settled(INPUTS + index) } else { self.unshared() }
    }

    fn settled(mut self, term: usize) -> Form {
        self.terms[term] = self.fresh;
        self.used = self.used.max(term + 1);
        self.fresh = 0.0;
        self.padded(self.center.abs())
    }

    /// All that is fresh as what no two readers share.
    #[must_use]
    pub fn unshared(mut self) -> Form {
        self.rest += self.fresh;
        self.fresh = 0.0;
        self
    }

    /// In place of another form of the same values: what its readers need not share, these neither.
    #[must_use]
    pub fn in_place_of(self, other: &Form) -> Form {
        Form { fresh: self.fresh + other.rest, rest: other.rest, ..self }
    }

    fn shared(&self) -> f64 {
        // Partial sums, so that they go into registers.
        let mut sums = [0.0; 8];
        for chunk in self.terms[..self.used.next_multiple_of(8)].chunks_exact(8) {
            sums.iter_mut().zip(chunk).for_each(|(sum, term)| *sum += term.abs());
        }
        sums.iter().sum()
    }

    /// How far the values reach from the centre.
    pub fn radius(&self) -> f64 {
        self.shared() + self.fresh + self.rest
    }

    /// What the place of an input changes.
    pub fn slope(&self, input: usize) -> f64 {
        if input < INPUTS { self.terms[input].abs() } else { 0.0 }
    }

    pub fn magnitude(&self) -> f64 {
        self.center.abs() + self.radius()
    }

    /// Whether it says anything: differences of large numbers overflow.
    pub fn is_finite(&self) -> bool {
        self.magnitude().is_finite()
    }

    pub fn bounds(&self) -> Interval {
        let radius = self.radius();
        let radius = radius + (self.center.abs() + radius) * LOSS;
        enclose(self.center - radius, self.center + radius)
    }

    fn padded(self, magnitude: f64) -> Form {
        self.widened(magnitude * LOSS)
    }

    #[must_use]
    pub fn widened(mut self, error: f64) -> Form {
        self.rest += error;
        self
    }

    #[must_use]
    pub fn negated(&self) -> Form {
        let mut form = *self;
        form.center = -form.center;
        form.terms[..form.used].iter_mut().for_each(|term| *term = -*term);
        form
    }

    #[must_use]
    pub fn plus(&self, other: &Form) -> Form {
        let mut sum = *self;
        sum.used = self.used.max(other.used);
        let terms = sum.terms.iter_mut().zip(&other.terms).take(sum.used);
        terms.for_each(|(to, from)| *to += from);
        sum.center += other.center;
        sum.fresh += other.fresh;
        sum.rest += other.rest;
        sum.padded(self.magnitude() + other.magnitude())
    }

    #[must_use]
    pub fn minus(&self, other: &Form) -> Form {
        self.plus(&other.negated())
    }

    /// `factor·self` plus anything in `[low, high]`; `magnitude` is that of the numbers from which
    /// they were computed.
    #[must_use]
    pub fn mapped(&self, factor: f64, low: f64, high: f64, magnitude: f64) -> Form {
        let mut form = *self;
        form.center = factor * self.center + (low / 2.0 + high / 2.0);
        form.terms[..form.used].iter_mut().for_each(|term| *term *= factor);
        form.fresh = factor.abs() * self.fresh + (high / 2.0 - low / 2.0);
        form.rest *= factor.abs();
        form.padded(factor.abs() * self.magnitude() + magnitude)
    }

    #[must_use]
    pub fn times(&self, other: &Form) -> Form {
        let (a, b) = (self, other);
        let (a_shared, b_shared) = (a.shared(), b.shared());
        let mut product = *a;
        product.used = a.used.max(b.used);
        for k in 0..product.used {
            product.terms[k] = a.center * b.terms[k] + b.center * a.terms[k];
        }
        product.center = a.center * b.center;
        // Of the product of both sums, that of the inputs' terms is taken apart: a square of u is in
        // [0, 1], a product of two different ones in [−1, 1].
        let of_inputs = |form: &Form| form.terms[..INPUTS].iter().map(|t| t.abs()).sum::<f64>();
        product.fresh = (a_shared * b_shared - of_inputs(a) * of_inputs(b)).max(0.0);
        for i in (0..INPUTS).filter(|&i| a.terms[i] != 0.0 || b.terms[i] != 0.0) {
            let square = a.terms[i] * b.terms[i] / 2.0;
            product.center += square;
            product.fresh += square.abs();
            for j in i + 1..INPUTS {
                product.fresh += (a.terms[i] * b.terms[j] + a.terms[j] * b.terms[i]).abs();
            }
        }
        let (a_sum, b_sum) = (a.center.abs() + a_shared, b.center.abs() + b_shared);
        product.fresh += a.fresh * (b_sum + b.fresh) + b.fresh * a_sum;
        product.rest = a.rest * b.magnitude() + b.rest * (a_sum + a.fresh);
        product.padded(a.magnitude() * b.magnitude())
    }

    /// Values of either.
    #[must_use]
    pub fn hull(&self, other: &Form) -> Form {
        let apart = self.minus(other).magnitude() / 2.0;
        self.plus(other).mapped(0.5, -apart, apart, apart)
    }
}
