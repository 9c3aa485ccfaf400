//! Affine forms: the shares of a value that depend on each input of a box and on each earlier
//! instruction's curvature, and what is left.

use crate::num::{Interval, enclose};
use std::ops::Range;

/// The most inputs with terms of their own: products pair them all. Chosen by hand, unmeasured.
const INPUTS: usize = 24;

/// The most inputs and instructions with terms of their own; the others' shares go into `rest`.
/// Chosen by hand, unmeasured.
const TERMS: usize = 96;

/// The rounding error of `f64` arithmetic on forms, relative to the operands' magnitudes: a few
/// hundred roundings of 2⁻⁵³.
const LOSS: f64 = 1e-13;

/// The terms of all forms on one box, one form after another: each has only the terms it needs, and
/// is made from others without moving them.
#[derive(Clone, Debug, Default)]
pub(super) struct Terms {
    values: Vec<f64>,
    /// The number of terms given to inputs, which are the first.
    inputs: usize,
    /// The number of terms given to inputs and instructions.
    used: usize,
}

/// `center + Σ terms[k]·u[k] ± fresh ± rest`, all `u[k]` in [−1, 1]: first the inputs' positions in
/// the box, then the instructions' deviations from the straight lines that stand for them (Stolfi &
/// de Figueiredo, "Self-Validated Numerical Methods and Applications", 1997, chapter 3). `fresh` is
/// the deviation of the current instruction; `rest` is rounding, which two readers of one result
/// need not share, since a compiler may compute it twice.
#[derive(Clone, Copy, Debug)]
pub(super) struct AffineForm {
    center: f64,
    fresh: f64,
    rest: f64,
    /// The position of its terms in [`Terms`].
    start: usize,
    count: usize,
    /// The sum of the terms' magnitudes.
    shared: f64,
}

impl Terms {
    /// Clears the terms, for another box.
    pub fn clear(&mut self) {
        self.values.clear();
        (self.inputs, self.used) = (0, 0);
    }

    fn of(&self, form: &AffineForm) -> &[f64] {
        &self.values[form.range()]
    }

    /// Gives a form the terms from `start` on, which were added last.
    fn finished(&self, start: usize, form: AffineForm) -> AffineForm {
        let terms = &self.values[start..];
        AffineForm { start, count: terms.len(), shared: magnitudes(terms), ..form }
    }
}

/// Returns the sum of the absolute values; partial sums let it use vector registers.
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
    /// Makes the form of any value of an interval; none if that is empty or unbounded.
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

    /// Makes the form of an input; a box's inputs must come before its instructions.
    pub fn input(bounds: Interval, terms: &mut Terms) -> Option<AffineForm> {
        let form = AffineForm::around(bounds)?;
        if form.fresh == 0.0 || terms.inputs >= INPUTS {
            return Some(form.unshared());
        }
        terms.inputs += 1;
        Some(form.settled(terms))
    }

    /// Makes it the result of an instruction, to whose curvature later ones can refer.
    #[must_use]
    pub fn of_instruction(self, terms: &mut Terms) -> AffineForm {
        match self.fresh {
            0.0 => self,
            _ if terms.used < TERMS => self.settled(terms),
            _ => self.unshared(),
        }
    }

    /// Turns `fresh` into a new term.
    fn settled(self, terms: &mut Terms) -> AffineForm {
        let start = terms.values.len();
        terms.values.extend_from_within(self.range());
        terms.values.resize(start + terms.used, 0.0);
        terms.values.push(self.fresh);
        terms.used += 1;
        terms.finished(start, AffineForm { fresh: 0.0, ..self }).padded(self.center.abs())
    }

    /// Moves `fresh` into `rest`, as if no two readers shared it.
    #[must_use]
    pub fn unshared(mut self) -> AffineForm {
        self.rest += self.fresh;
        self.fresh = 0.0;
        self
    }

    /// Replaces another form of the same values: readers need not share that one's `rest`, either.
    #[must_use]
    pub fn in_place_of(self, other: &AffineForm) -> AffineForm {
        AffineForm { fresh: self.fresh + other.rest, rest: other.rest, ..self }
    }

    fn range(&self) -> Range<usize> {
        self.start..self.start + self.count
    }

    /// Returns how far the values reach from the centre.
    pub fn radius(&self) -> f64 {
        self.shared + self.fresh + self.rest
    }

    /// Returns the magnitude of an input's term, given the input's own form; 0 if there is none.
    pub fn slope(&self, input: &AffineForm, terms: &Terms) -> f64 {
        let own = input.count.checked_sub(1);
        own.and_then(|own| terms.of(self).get(own)).map_or(0.0, |term| term.abs())
    }

    pub fn magnitude(&self) -> f64 {
        self.center.abs() + self.radius()
    }

    /// Returns true if its reach is finite: differences of large numbers may overflow.
    pub fn is_finite(&self) -> bool {
        self.magnitude().is_finite()
    }

    pub fn bounds(&self) -> Interval {
        let radius = self.radius();
        let radius = radius + (self.center.abs() + radius) * LOSS;
        enclose(self.center - radius, self.center + radius)
    }

    /// Adds the rounding error of `f64` arithmetic on operands of a magnitude.
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

    /// Adds the other, times a sign.
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

    /// Returns `factor·self` plus any number in `[low, high]`; `magnitude` is that of the numbers
    /// from which these bounds were computed.
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
        // The product of the inputs' terms is bounded apart from that of the other terms.
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

    /// Returns a form of the values of either.
    #[must_use]
    pub fn hull(&self, other: &AffineForm, terms: &mut Terms) -> AffineForm {
        let apart = self.minus(other, terms).magnitude() / 2.0;
        self.plus(other, terms).mapped(0.5, [-apart, apart], apart, terms)
    }
}

/// Returns the centre and radius of the product of two sums of terms: the square of a `u` is in
/// [0, 1], the product of two different ones in [−1, 1].
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
