//! Affine forms: what a value owes to each input of a box and to each earlier instruction's
//! curvature, and what is left.

use crate::num::{Interval, enclose};
use std::ops::Range;

/// Inputs whose share is kept apart, at most: a product looks at each pair of them.
const INPUTS: usize = 24;

/// The same, and instructions; what others owe is left over.
const TERMS: usize = 96;

/// What `f64` arithmetic on forms may lose, relative to the magnitudes that met: a few hundred
/// roundings of 2⁻⁵³.
const LOSS: f64 = 1e-13;

/// The terms of all forms on one box, one form's after the other's: a form is as long as what it
/// depends on is many, and made of others without moving them.
#[derive(Clone, Debug, Default)]
pub(super) struct Terms {
    values: Vec<f64>,
    /// Terms given out: first those of inputs.
    inputs: usize,
    used: usize,
}

/// `center + Σ terms[k]·u[k] ± fresh ± rest`, all `u[k]` in [−1, 1]: first the places of the inputs
/// within the box, then for instructions by how much they are not the straight line that stands for
/// them (Stolfi & de Figueiredo, "Self-Validated Numerical Methods and Applications", 1997, chapter 3).
/// `fresh` is that of the instruction at hand; `rest` is rounding, which two readers of one result need
/// not share, since a compiler may compute it twice.
#[derive(Clone, Copy, Debug)]
pub(super) struct AffineForm {
    center: f64,
    fresh: f64,
    rest: f64,
    /// Where its terms are, and the sum of their magnitudes.
    start: usize,
    count: usize,
    shared: f64,
}

impl Terms {
    /// For another box.
    pub fn clear(&mut self) {
        self.values.clear();
        (self.inputs, self.used) = (0, 0);
    }

    fn of(&self, form: &AffineForm) -> &[f64] {
        &self.values[form.range()]
    }

    /// The form with the terms from `start` on, which were put last.
    fn finished(&self, start: usize, form: AffineForm) -> AffineForm {
        let terms = &self.values[start..];
        AffineForm { start, count: terms.len(), shared: magnitudes(terms), ..form }
    }
}

/// The sum of the absolute values, by partial sums, so that they go into registers.
fn magnitudes(terms: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let chunks = terms.chunks_exact(8);
    let last = chunks.remainder();
    for chunk in chunks {
        sums.iter_mut().zip(chunk).for_each(|(sum, term)| *sum += term.abs());
    }
    sums.iter_mut().zip(last).for_each(|(sum, term)| *sum += term.abs());
    sums.iter().sum()
}

impl AffineForm {
    /// Any value of an interval; nothing where that is not bounded.
    pub fn around(bounds: Interval) -> Option<AffineForm> {
        let (low, high) = (f64::from(bounds.low()), f64::from(bounds.high()));
        (low.is_finite() && high.is_finite() && low <= high).then(|| AffineForm {
            center: low / 2.0 + high / 2.0,
            fresh: high / 2.0 - low / 2.0,
            rest: 0.0,
            start: 0,
            count: 0,
            shared: 0.0,
        })
    }

    /// An input; those of a box come before its instructions.
    pub fn input(bounds: Interval, terms: &mut Terms) -> Option<AffineForm> {
        let form = AffineForm::around(bounds)?;
        if form.fresh == 0.0 || terms.inputs >= INPUTS {
            return Some(form.unshared());
        }
        terms.inputs += 1;
        Some(form.settled(terms))
    }

    /// As the result of an instruction, whose curvature later ones can refer to.
    #[must_use]
    pub fn of_instruction(self, terms: &mut Terms) -> AffineForm {
        match self.fresh {
            0.0 => self,
            _ if terms.used < TERMS => self.settled(terms),
            _ => self.unshared(),
        }
    }

    fn settled(self, terms: &mut Terms) -> AffineForm {
        let start = terms.values.len();
        terms.values.extend_from_within(self.range());
        terms.values.resize(start + terms.used, 0.0);
        terms.values.push(self.fresh);
        terms.used += 1;
        terms.finished(start, AffineForm { fresh: 0.0, ..self }).padded(self.center.abs())
    }

    /// All that is fresh as what no two readers share.
    #[must_use]
    pub fn unshared(mut self) -> AffineForm {
        self.rest += self.fresh;
        self.fresh = 0.0;
        self
    }

    /// In place of another form of the same values: what its readers need not share, these neither.
    #[must_use]
    pub fn in_place_of(self, other: &AffineForm) -> AffineForm {
        AffineForm { fresh: self.fresh + other.rest, rest: other.rest, ..self }
    }

    fn range(&self) -> Range<usize> {
        self.start..self.start + self.count
    }

    /// How far the values reach from the centre.
    pub fn radius(&self) -> f64 {
        self.shared + self.fresh + self.rest
    }

    /// What the place of an input changes, given the input's own form.
    pub fn slope(&self, input: &AffineForm, terms: &Terms) -> f64 {
        let own = input.count.checked_sub(1);
        own.and_then(|own| terms.of(self).get(own)).map_or(0.0, |term| term.abs())
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

    fn padded(self, magnitude: f64) -> AffineForm {
        self.widened(magnitude * LOSS)
    }

    #[must_use]
    pub fn widened(mut self, error: f64) -> AffineForm {
        self.rest += error;
        self
    }

    #[must_use]
    pub fn negated(&self, terms: &mut Terms) -> AffineForm {
        let start = terms.values.len();
        terms.values.extend_from_within(self.range());
        terms.values[start..].iter_mut().for_each(|term| *term = -*term);
        AffineForm { start, center: -self.center, ..*self }
    }

    #[must_use]
    pub fn plus(&self, other: &AffineForm, terms: &mut Terms) -> AffineForm {
        self.with(other, 1.0, terms)
    }

    #[must_use]
    pub fn minus(&self, other: &AffineForm, terms: &mut Terms) -> AffineForm {
        self.with(other, -1.0, terms)
    }

    /// The other added, times a sign.
    fn with(&self, other: &AffineForm, sign: f64, terms: &mut Terms) -> AffineForm {
        let start = terms.values.len();
        terms.values.extend_from_within(self.range());
        terms.values.resize(start + self.count.max(other.count), 0.0);
        let (before, sum) = terms.values.split_at_mut(start);
        sum.iter_mut().zip(&before[other.range()]).for_each(|(to, from)| *to += sign * from);
        let form = AffineForm {
            center: self.center + sign * other.center,
            fresh: self.fresh + other.fresh,
            rest: self.rest + other.rest,
            ..*self
        };
        terms.finished(start, form).padded(self.magnitude() + other.magnitude())
    }

    /// `factor·self` plus anything in `[low, high]`; `magnitude` is that of the numbers from which
    /// they were computed.
    #[must_use]
    pub fn mapped(
        &self,
        factor: f64,
        [low, high]: [f64; 2],
        magnitude: f64,
        terms: &mut Terms,
    ) -> AffineForm {
        let start = terms.values.len();
        if factor != 0.0 {
            terms.values.extend_from_within(self.range());
            terms.values[start..].iter_mut().for_each(|term| *term *= factor);
        }
        let form = AffineForm {
            center: factor * self.center + (low / 2.0 + high / 2.0),
            fresh: factor.abs() * self.fresh + (high / 2.0 - low / 2.0),
            rest: factor.abs() * self.rest,
            ..*self
        };
        terms.finished(start, form).padded(factor.abs() * self.magnitude() + magnitude)
    }

    #[must_use]
    pub fn times(&self, other: &AffineForm, terms: &mut Terms) -> AffineForm {
        let (a, b) = (self, other);
        let inputs = terms.inputs;
        let start = terms.values.len();
        terms.values.extend_from_within(a.range());
        terms.values.resize(start + a.count.max(b.count), 0.0);
        let (before, product) = terms.values.split_at_mut(start);
        product.iter_mut().for_each(|term| *term *= b.center);
        let b_terms = &before[b.range()];
        product.iter_mut().zip(b_terms).for_each(|(to, term)| *to += a.center * term);
        let of_inputs =
            |form: &AffineForm| &before[form.start..form.start + form.count.min(inputs)];
        let (center, fresh) = quadratic(of_inputs(a), of_inputs(b));
        // Of the product of both sums, that of the inputs' terms is taken apart.
        let others = a.shared * b.shared - magnitudes(of_inputs(a)) * magnitudes(of_inputs(b));
        let (a_sum, b_sum) = (a.center.abs() + a.shared, b.center.abs() + b.shared);
        let form = AffineForm {
            center: a.center * b.center + center,
            fresh: others.max(0.0) + fresh + a.fresh * (b_sum + b.fresh) + b.fresh * a_sum,
            rest: a.rest * b.magnitude() + b.rest * (a_sum + a.fresh),
            ..*a
        };
        terms.finished(start, form).padded(a.magnitude() * b.magnitude())
    }

    /// Values of either.
    #[must_use]
    pub fn hull(&self, other: &AffineForm, terms: &mut Terms) -> AffineForm {
        let apart = self.minus(other, terms).magnitude() / 2.0;
        self.plus(other, terms).mapped(0.5, [-apart, apart], apart, terms)
    }
}

/// Centre and radius of the product of two sums of terms: a square of u is in [0, 1], a product of two
/// different ones in [−1, 1].
fn quadratic(a: &[f64], b: &[f64]) -> (f64, f64) {
    let at = |terms: &[f64], i: usize| terms.get(i).copied().unwrap_or(0.0);
    let (mut center, mut radius) = (0.0, 0.0);
    let count = a.len().max(b.len());
    for i in 0..count {
        let (ai, bi) = (at(a, i), at(b, i));
        if ai == 0.0 && bi == 0.0 {
            continue;
        }
        let square = ai * bi / 2.0;
        center += square;
        radius += square.abs();
        for j in i + 1..count {
            radius += (ai * at(b, j) + at(a, j) * bi).abs();
        }
    }
    (center, radius)
}
