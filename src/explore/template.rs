//! Templates that the forms found suggest, and what they would gain.

use super::departure::{Departure, Verdict};
use super::output::{Finding, Influence};
use super::suggested::Suggested;
use super::tested::Tested;
use crate::dataset::Dataset;
use rayon::prelude::*;
use serde::Serialize;

/// A formula with holes, for a search.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Template {
    /// Functions that it calls and does not define are to be found.
    pub formula: String,
    /// What the data say of it.
    pub verdict: Verdict,
    /// By how much they depart from it; its `residual` is what is left at best.
    pub departure: Departure,
    /// The number of functions to be found.
    pub holes: usize,
    /// The most arguments of one of them; the smooth fit's number of inputs without a template.
    pub most_arguments: usize,
    /// The number of inputs without a template.
    pub inputs: usize,
    /// The terms of polynomials in the holes, of the smooth fit's degree.
    pub terms: usize,
    /// The terms of the smooth fit, without a template.
    pub all_terms: usize,
}

/// Fits the templates that forms suggest; returns the best that holds, and one that is smaller
/// still but holds only nearly.
pub(super) fn templates(
    dataset: &Dataset,
    output: &str,
    tested: &Tested,
    influences: &[Influence],
    forms: &[Finding],
) -> Vec<Template> {
    let mut best: Vec<Template> = Vec::new();
    let all = influences.iter().filter(|influence| influence.first.is_some()).count();
    for level in [Verdict::Holds, Verdict::Nearly] {
        let suggested = Suggested { dataset, tested, forms, level, inputs: all };
        let needless = tested.needless(influences, level, &[]);
        let needed = tested.inputs.iter().copied().filter(|input| !needless.contains(input));
        let inputs: Vec<usize> = needed.collect();
        let fitted = suggested.candidates(&inputs).into_par_iter().map(|candidate| {
            let departure = suggested.departure(&candidate);
            candidate.template(dataset, output, departure, [tested.full.degree, all])
        });
        let mut fitted: Vec<Template> = fitted.collect();
        fitted.retain(|template| suggested.accepts(template.verdict));
        let size = |template: &Template| (template.most_arguments, template.terms);
        fitted.sort_by(|a, b| {
            let residuals = a.departure.residual.total_cmp(&b.departure.residual);
            size(a).cmp(&size(b)).then(residuals)
        });
        let smaller = |template: &Template| best.iter().all(|best| size(template) < size(best));
        let first = fitted.into_iter().next().filter(smaller);
        best.extend(first);
    }
    best
}
