//! What a projection has found: parameters as functions of places.

use super::bench::Point;
use super::groups::Lattice;
use super::model::RESIDUAL;
use super::{Error, Projection, State};
use crate::dataset::{Column, Dataset, Origin, Split, joint_unit, output_units};
use crate::fit::Bound;

/// The parameters of one group.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The values of the inputs.
    pub at: Vec<f32>,
    /// The parameters' values.
    pub values: Vec<f32>,
    /// The root of the mean square of the errors.
    pub residual: f32,
    /// The weight of its rows together, if rows have weights; else 1.
    pub weight: f32,
    /// The number of the group.
    pub(super) group: u32,
}

/// The parameters of all groups, and which of them are missing.
#[derive(Clone, Debug, PartialEq)]
pub struct Surfaces {
    /// The inputs that places are of.
    pub over: Vec<Column>,
    /// The parameters' names.
    pub labels: Vec<String>,
    /// The groups of the search split.
    pub search: Vec<Place>,
    /// The groups of the validation split; empty if it has too few of its own.
    pub validation: Vec<Place>,
    /// The number of points along each input, if the search split's places are a full grid.
    pub grid: Vec<usize>,
    /// What a reader should know: groups that were left out, places that are missing.
    pub notes: Vec<String>,
    pub(super) lattice: Option<Lattice>,
}

/// The most places that a note names. By hand: a line.
const NAMED: usize = 4;

/// Every so many groups one is held back, and of a diagonal the one at this remainder: not the first,
/// so that corners stay.
const HELD_BACK: (usize, usize) = (4, 2);

impl Projection {
    /// Returns what a state that is done holds.
    ///
    /// # Errors
    /// [`Error::NotFinite`]: there are not two groups with a finite fit.
    pub fn surfaces(&self, state: &State) -> Result<Surfaces, Error> {
        let mut notes = Vec::new();
        let searched = self.layout.searched;
        let all: Vec<Option<Place>> = state
            .current
            .iter()
            .enumerate()
            .map(|(group, point)| point.as_ref().and_then(|point| self.place(group, point)))
            .collect();
        let (search, validation) = all.split_at(searched);
        self.note_thin(&mut notes);
        let groups = &self.layout.groups[..searched];
        let smoothed = self.settings.smooth > 0.0;
        let unfit = groups
            .iter()
            .zip(search)
            .filter(|(group, place)| place.is_none() && (smoothed || !self.is_thin(group)));
        let unfit: Vec<&[f32]> = unfit.map(|(group, _)| group.place.as_slice()).collect();
        if !unfit.is_empty() {
            let count = unfit.len();
            let which = self.named(&unfit);
            notes.push(format!(
                "in {count} groups the model is finite from no start: {which}; they are left out"
            ));
        }
        let places = |places: &[Option<Place>]| places.iter().flatten().cloned().collect();
        let (search, validation): (Vec<Place>, Vec<Place>) = (places(search), places(validation));
        if search.len() < 2 {
            return Err(Error::NotFinite { groups: searched });
        }
        let is_full =
            search.len() == searched && self.layout.lattice.as_ref().is_some_and(Lattice::is_full);
        self.note_grid(is_full, &mut notes);
        if validation.is_empty() {
            notes.push("the data's validation split has too few groups at other places: every fourth group is held back for validation".into());
        }
        let lattice = self.layout.lattice.clone();
        let grid = match &lattice {
            Some(lattice) if is_full => lattice.grid(),
            _ => Vec::new(),
        };
        let over = self.over.iter().map(|&column| self.dataset.inputs[column].clone()).collect();
        let labels = self.model.labels().to_vec();
        Ok(Surfaces { over, labels, search, validation, grid, notes, lattice })
    }

    fn place(&self, group: usize, point: &Point) -> Option<Place> {
        let unit = joint_unit(&output_units(&self.dataset.outputs));
        let residual = (point.square.sqrt() * unit) as f32;
        let own = &self.layout.groups[group];
        let is_search = group < self.layout.searched;
        let split = if is_search { &self.dataset.search } else { &self.dataset.validation };
        let weight = match split.weights.is_empty() {
            true => 1.0,
            false => own.rows.iter().map(|&row| split.weight(row as usize)).sum(),
        };
        let place = Place {
            at: own.place.clone(),
            values: point.values.clone(),
            residual,
            weight,
            group: group as u32,
        };
        residual.is_finite().then_some(place)
    }

    fn note_thin(&self, notes: &mut Vec<String>) {
        let groups = &self.layout.groups[..self.layout.searched];
        let thin: Vec<&[f32]> = groups
            .iter()
            .filter(|group| self.is_thin(group))
            .map(|group| group.place.as_slice())
            .collect();
        if !thin.is_empty() {
            let (count, all, which) = (thin.len(), groups.len(), self.named(&thin));
            let parameters = self.model.labels().len();
            let so = match self.settings.smooth > 0.0 {
                true => "their neighbours determine them",
                false => "they are left out; --smooth would determine them by their neighbours",
            };
            notes.push(format!(
                "{count} of {all} groups have fewer values than the {parameters} parameters: {which}; {so}"
            ));
        }
    }

    fn note_grid(&self, is_full: bool, notes: &mut Vec<String>) {
        match &self.layout.lattice {
            _ if is_full => {}
            None => notes.push("the groups are on no grid: neighbours are the nearest ones".into()),
            Some(lattice) => {
                let all = lattice.grid().iter().product::<usize>();
                let missing = lattice.missing(NAMED + 1);
                if !missing.is_empty() {
                    let missing: Vec<&[f32]> = missing.iter().map(Vec::as_slice).collect();
                    let count = all - lattice.at.len();
                    let which = self.named(&missing);
                    notes.push(format!(
                        "{count} of {all} places of the grid have no group: {which}"
                    ));
                }
                notes.push("the parameters' data are no grid, since groups are missing".into());
            }
        }
    }

    fn named(&self, places: &[&[f32]]) -> String {
        let shown = places.iter().take(NAMED).map(|at| {
            let names = self.over.iter().map(|&column| &self.dataset.inputs[column].name);
            let parts: Vec<String> =
                names.zip(*at).map(|(name, value)| format!("{name} = {value}")).collect();
            parts.join(", ")
        });
        let more = if places.len() > NAMED { "; …" } else { "" };
        shown.collect::<Vec<_>>().join("; ") + more
    }
}

impl Surfaces {
    /// Returns the parameters and the residual as a dataset over the places.
    ///
    /// # Errors
    /// As [`Dataset::validate`].
    pub fn dataset(&self, projection: &Projection) -> Result<Dataset, Error> {
        let splits = match self.validation.is_empty() {
            false => [
                self.split(self.search.iter(), self.grid.clone()),
                self.split(self.validation.iter(), self.validation_grid()),
            ],
            true => {
                let is_held_back =
                    |place: &Place| self.diagonal(place) % HELD_BACK.0 == HELD_BACK.1;
                let (mut back, mut kept): (Vec<&Place>, Vec<&Place>) =
                    self.search.iter().partition(|place| is_held_back(place));
                if back.is_empty() {
                    back.extend(kept.pop());
                }
                [kept, back].map(|places| self.split(places.into_iter(), Vec::new()))
            }
        };
        let model = projection.model();
        let over: Vec<&str> = self.over.iter().map(|column| column.name.as_str()).collect();
        let text = format!(
            "parameters of `{}` over {}, fitted to {}: {}",
            model.text(),
            over.join(", "),
            projection.dataset.name,
            projection.dataset.origin.source()
        );
        let names = self.labels.iter().map(String::as_str).chain([RESIDUAL]);
        let outputs = names.map(|name| (name, "1"));
        let origin = Origin::Formula { text };
        let name = format!("{}_parameters", projection.dataset.name);
        Ok(Dataset::of_splits(&name, origin, self.over.clone(), outputs, splits)?)
    }

    fn split<'a>(&self, places: impl Iterator<Item = &'a Place>, grid: Vec<usize>) -> Split {
        let mut split = Split {
            columns: vec![Vec::new(); self.over.len() + self.labels.len() + 1],
            grid,
            ..Split::default()
        };
        for place in places {
            let row = place.at.iter().chain(&place.values).chain([&place.residual]);
            split.columns.iter_mut().zip(row).for_each(|(column, value)| column.push(*value));
            split.weights.push(place.weight);
        }
        if split.weights.iter().all(|weight| *weight == 1.0) {
            split.weights.clear();
        }
        split
    }

    /// Returns the points along each input, if the validation split's places are a full grid.
    fn validation_grid(&self) -> Vec<usize> {
        let along = |axis: usize| {
            let mut values: Vec<f32> = self.validation.iter().map(|place| place.at[axis]).collect();
            values.sort_unstable_by(f32::total_cmp);
            values.dedup();
            values.len()
        };
        let grid: Vec<usize> = (0..self.over.len()).map(along).collect();
        let points = grid.iter().try_fold(1usize, |all, points| all.checked_mul(*points));
        if points == Some(self.validation.len()) { grid } else { Vec::new() }
    }

    /// Returns the number of the diagonal that a place is on.
    fn diagonal(&self, place: &Place) -> usize {
        match &self.lattice {
            Some(lattice) => lattice.at[place.group as usize].iter().map(|&i| i as usize).sum(),
            None => place.group as usize,
        }
    }

    /// Returns the root mean square of the search split's residuals.
    pub fn rmse(&self) -> f64 {
        let squares = self.search.iter().map(|place| f64::from(place.residual).powi(2));
        (squares.sum::<f64>() / self.search.len() as f64).sqrt()
    }

    /// Returns the groups in which a parameter lies on its lower bound, and on its upper one.
    pub fn on_bounds(&self, projection: &Projection, parameter: usize) -> [Vec<&Place>; 2] {
        let known = projection.model().parameters()[parameter];
        let bound = |place: &Place| known.bound(place.values[parameter]);
        [Bound::Lower, Bound::Upper]
            .map(|one| self.search.iter().filter(|place| bound(place) == Some(one)).collect())
    }
}
