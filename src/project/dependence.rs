//! What parameters depend on: the questions at the end of §4.2.2 of the course notes (Pesce &
//! Iwanicki 2015), "which dimensions strongly correlate with the parameters of the model?".

use super::bench::{Bench, Problem, mean};
use super::{Place, Projection, Surfaces};
use crate::dataset::{joint_unit, output_units};
use rayon::prelude::*;
use std::collections::HashMap;

/// What it costs that a parameter does not follow an input: its mean along that input stands for
/// it, the others staying as they are. They could make up for some of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Dependence {
    /// The parameter.
    pub parameter: usize,
    /// The input of `over`; none for all of them, where one constant stands for the parameter.
    pub input: Option<usize>,
    /// The share of the parameter's variance that is along the input: its total index after Sobol.
    pub share: f64,
    /// The root mean square of the errors over all groups.
    pub rmse: f64,
    /// Whether that is hardly more than with the parameter as it is.
    pub is_weak: bool,
}

/// How much larger an error may be and count as hardly larger: by a share of itself, and of the
/// outputs' spread. By hand: neither is seen in a picture.
const HARDLY: f64 = 0.1;
const SMALL: f64 = 1e-3;

impl Projection {
    /// Returns, for each parameter, what it costs that it does not follow each input, and any.
    /// Scattered places have no lines along an input, and only the last is told.
    pub fn dependences(&self, surfaces: &Surfaces) -> Vec<Dependence> {
        let inputs = surfaces.lattice.as_ref().map_or(0, |lattice| lattice.axes.len());
        let axes: Vec<Option<usize>> = match inputs {
            1 => vec![None],
            inputs => (0..inputs).map(Some).chain([None]).collect(),
        };
        let asked: Vec<(usize, Option<usize>)> = (0..surfaces.labels.len())
            .flat_map(|parameter| axes.iter().map(move |&input| (parameter, input)))
            .collect();
        let means: Vec<Vec<f32>> = asked
            .iter()
            .map(|&(parameter, input)| self.means(surfaces, parameter, input))
            .collect();
        let problem = self.problem();
        let squares = |bench: &mut Bench, (number, place): (usize, &Place)| -> Vec<f64> {
            self.squares(&problem, bench, place, &asked, |which| means[which][number])
        };
        let places = surfaces.search.par_iter().enumerate();
        let all: Vec<Vec<f64>> = places
            .map_init(|| Bench::new(&problem), |bench, place| squares(bench, place))
            .collect();
        let unit = joint_unit(&output_units(&self.dataset.outputs));
        let enough = (1.0 + HARDLY) * surfaces.rmse() + SMALL * self.spread_of_outputs();
        let found = asked.iter().enumerate().map(|(which, &(parameter, input))| {
            let sum: f64 = all.iter().map(|squares| squares[which]).sum();
            let rmse = (sum / all.len() as f64).sqrt() * unit;
            let share = share(surfaces, parameter, &means[which]);
            Dependence { parameter, input, share, rmse, is_weak: rmse <= enough }
        });
        found.collect()
    }

    /// Returns the mean squares of a group with each parameter asked for replaced.
    fn squares(
        &self,
        problem: &Problem,
        bench: &mut Bench,
        place: &Place,
        asked: &[(usize, Option<usize>)],
        mean: impl Fn(usize) -> f32,
    ) -> Vec<f64> {
        let rows = &self.layout.groups[place.group as usize].rows;
        let task = problem.task(&self.dataset.search, rows);
        let with = |(which, &(parameter, _)): (usize, &(usize, Option<usize>))| {
            let mut values = place.values.clone();
            values[parameter] = mean(which);
            bench.square(&task, &values)
        };
        asked.iter().enumerate().map(with).collect()
    }

    /// Returns, by place, a parameter's mean over the places that differ in nothing but an input.
    fn means(&self, surfaces: &Surfaces, parameter: usize, input: Option<usize>) -> Vec<f32> {
        let line = |place: &Place| match (input, &surfaces.lattice) {
            (Some(input), Some(lattice)) => {
                let mut at = lattice.at[place.group as usize].clone();
                at[input] = 0;
                at
            }
            _ => Vec::new(),
        };
        let mut lines: HashMap<Vec<u32>, Vec<usize>> = HashMap::new();
        for (number, place) in surfaces.search.iter().enumerate() {
            lines.entry(line(place)).or_default().push(number);
        }
        let mut means = vec![0.0; surfaces.search.len()];
        let own = &self.model.parameters()[parameter..][..1];
        for numbers in lines.values() {
            let values: Vec<&[f32]> =
                numbers.iter().map(|&n| &surfaces.search[n].values[parameter..][..1]).collect();
            let mean = mean(own, &values)[0];
            numbers.iter().for_each(|&number| means[number] = mean);
        }
        means
    }

    /// Returns the standard deviation of the outputs.
    pub fn spread_of_outputs(&self) -> f64 {
        self.variance.sqrt() * joint_unit(&output_units(&self.dataset.outputs))
    }
}

/// Returns the share of a parameter's variance that is around some means.
fn share(surfaces: &Surfaces, parameter: usize, means: &[f32]) -> f64 {
    let values = || surfaces.search.iter().map(|place| f64::from(place.values[parameter]));
    let middle = values().sum::<f64>() / means.len() as f64;
    let whole: f64 = values().map(|value| (value - middle).powi(2)).sum();
    let around: f64 =
        values().zip(means).map(|(value, mean)| (value - f64::from(*mean)).powi(2)).sum();
    if whole > 0.0 { around / whole } else { 0.0 }
}
