//! The error as a function of one or two parameters, at one place: what the minimisation has to find
//! its way in (course notes, figure 2).

use super::bench::{Bench, position, value_at};
use super::{Error, Place, Projection, Surfaces};
use crate::dataset::{joint_unit, output_units};
use crate::fit::Scale;
use rayon::prelude::*;

/// The error around a group's optimum, along one parameter or over two.
#[derive(Clone, Debug, PartialEq)]
pub struct Landscape {
    /// The group's place.
    pub at: Vec<f32>,
    /// The parameters that vary; the others stay at their optimum.
    pub parameters: Vec<usize>,
    /// The least and the greatest value of each.
    pub ranges: Vec<[f32; 2]>,
    /// Whether each is varied on a logarithmic scale.
    pub logarithmic: Vec<bool>,
    /// The optimum's place in each range, from 0 to 1.
    pub optimum: Vec<f32>,
    /// The root mean square at the optimum.
    pub residual: f32,
    /// Points along each.
    pub points: usize,
    /// The root mean squares, the second parameter varying slowest. Not finite where the model is
    /// not.
    pub errors: Vec<f32>,
}

/// The grid that the search split's places lie on, or most of it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceGrid {
    /// The values along each input, ascending.
    pub axes: Vec<Vec<f32>>,
    /// By combination of these, the last input varying fastest: the index of the place, unless it is
    /// missing.
    pub numbers: Vec<Option<usize>>,
}

/// How far from the optimum is looked where there are no bounds: in spreads of the parameter, and
/// in its own magnitude. By hand, unmeasured.
const SPREADS: f64 = 3.0;
const ONE_SIDED: f64 = 0.1;

/// Values of the other sign that are rounding, as a share of the largest. By hand.
const ROUNDING: f64 = 1e-5;

impl Projection {
    /// Computes the error over one parameter or two around the optimum of a group.
    pub fn landscape(
        &self,
        surfaces: &Surfaces,
        place: &Place,
        parameters: &[usize],
        points: usize,
    ) -> Landscape {
        let problem = self.problem();
        let ends = |&parameter: &usize| self.ends(surfaces, parameter, place.values[parameter]);
        let ends: Vec<[f64; 2]> = parameters.iter().map(ends).collect();
        let own = |parameter: usize| &self.model.parameters()[parameter];
        let at = |axis: usize, i: usize| {
            let [low, high] = ends[axis];
            let share = (i as f64 + 0.5) / points as f64;
            value_at(own(parameters[axis]), low + share * (high - low))
        };
        let is_search = (place.group as usize) < self.layout.searched;
        let split = if is_search { &self.dataset.search } else { &self.dataset.validation };
        let rows = &self.layout.groups[place.group as usize].rows;
        let unit = joint_unit(&output_units(&self.dataset.outputs));
        let count = points.pow(parameters.len() as u32);
        let lines = (0..count.div_ceil(points)).into_par_iter().map(|line| {
            let task = problem.task(split, rows);
            let mut bench = Bench::new(&problem);
            let error = |i: usize| {
                let mut values = place.values.clone();
                for (axis, &parameter) in parameters.iter().enumerate() {
                    values[parameter] = at(axis, if axis == 0 { i } else { line });
                }
                (bench.square(&task, &values).sqrt() * unit) as f32
            };
            (0..points).map(error).collect::<Vec<f32>>()
        });
        let errors = lines.collect::<Vec<Vec<f32>>>().concat();
        let share = |(axis, &parameter): (usize, &usize)| {
            let [low, high] = ends[axis];
            ((position(own(parameter), place.values[parameter]) - low) / (high - low)) as f32
        };
        let range =
            |(&parameter, ends): (&usize, &[f64; 2])| ends.map(|end| value_at(own(parameter), end));
        Landscape {
            at: place.at.clone(),
            residual: place.residual,
            logarithmic: parameters
                .iter()
                .map(|&parameter| own(parameter).scale == Scale::Logarithmic)
                .collect(),
            optimum: parameters.iter().enumerate().map(share).collect(),
            ranges: parameters.iter().zip(&ends).map(range).collect(),
            parameters: parameters.to_vec(),
            points,
            errors,
        }
    }

    /// Returns the positions between which a parameter is varied: its bounds, or some way from an
    /// optimum, without a change of sign if it has the same everywhere: models of one sign often
    /// have no finite values for the other.
    fn ends(&self, surfaces: &Surfaces, parameter: usize, optimum: f32) -> [f64; 2] {
        let own = &self.model.parameters()[parameter];
        let values = surfaces.search.iter().map(|place| position(own, place.values[parameter]));
        let count = surfaces.search.len() as f64;
        let middle = values.clone().sum::<f64>() / count;
        let spread = (values.map(|value| (value - middle).powi(2)).sum::<f64>() / count).sqrt();
        let optimum = position(own, optimum);
        let [low, high] = own.bounds.map(|bound| position(own, bound));
        let values = surfaces.search.iter().map(|place| f64::from(place.values[parameter]));
        let [most_below, most_above] =
            values.fold([0.0f64; 2], |[below, above], value| [below.max(-value), above.max(value)]);
        let is_linear = own.scale == Scale::Linear;
        let is_positive = is_linear && most_below <= ROUNDING * most_above;
        let is_negative = is_linear && most_above <= ROUNDING * most_below;
        let least = if is_positive { 0.0 } else { f64::NEG_INFINITY };
        let most = if is_negative { 0.0 } else { f64::INFINITY };
        // Of one sign, a parameter may be small here and a thousand times larger elsewhere.
        let is_one_sided = is_positive || is_negative;
        let spreads = if is_one_sided { ONE_SIDED } else { SPREADS };
        let reach = (spreads * spread).max(optimum.abs()).max(f64::from(f32::EPSILON));
        let low = if low.is_finite() { low } else { (optimum - reach).max(least) };
        let high = if high.is_finite() { high } else { (optimum + reach).min(most) };
        if low < high { [low, high] } else { [low, low + 1.0] }
    }
}

impl Surfaces {
    /// Returns the group of the search split nearest to a place, given the values of some inputs;
    /// the others are in the middle.
    ///
    /// # Errors
    /// [`Error::UnknownPlace`]: an input that is none of the places'.
    pub fn nearest(&self, asked: &[(String, f32)]) -> Result<&Place, Error> {
        let names: Vec<&str> = self.over.iter().map(|column| column.name.as_str()).collect();
        let extents: Vec<[f64; 2]> = (0..names.len()).map(|axis| self.extent(axis)).collect();
        let mut wanted: Vec<f64> = extents.iter().map(|[low, high]| (low + high) / 2.0).collect();
        for (name, value) in asked {
            let axis = names.iter().position(|known| known == name).ok_or_else(|| {
                Error::UnknownPlace { name: name.clone(), over: names.join(", ") }
            })?;
            wanted[axis] = f64::from(*value);
        }
        let distance = |place: &Place| -> f64 {
            let apart = place.at.iter().zip(&wanted).zip(&extents).map(|((at, wanted), extent)| {
                ((f64::from(*at) - wanted) / (extent[1] - extent[0]).max(f64::MIN_POSITIVE)).powi(2)
            });
            apart.sum()
        };
        let nearest = self.search.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        Ok(nearest.expect("surfaces have groups"))
    }

    /// Returns the group of the search split whose residual is largest.
    pub fn worst(&self) -> &Place {
        let worst = self.search.iter().max_by(|a, b| a.residual.total_cmp(&b.residual));
        worst.expect("surfaces have groups")
    }

    /// Returns the least and the greatest value of an input.
    pub fn extent(&self, axis: usize) -> [f64; 2] {
        let values = self.search.iter().map(|place| f64::from(place.at[axis]));
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        })
    }

    /// Returns the grid that places lie on; none if they are scattered.
    pub fn table(&self) -> Option<PlaceGrid> {
        let lattice = self.lattice.as_ref()?;
        let grid = lattice.grid();
        let mut numbers = vec![None; grid.iter().product()];
        for (number, place) in self.search.iter().enumerate() {
            let at = &lattice.at[place.group as usize];
            let cell =
                at.iter().zip(&grid).fold(0, |cell, (&i, points)| cell * points + i as usize);
            numbers[cell] = Some(number);
        }
        Some(PlaceGrid { axes: lattice.axes.clone(), numbers })
    }
}
