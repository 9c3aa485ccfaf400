//! The page of a projection, and its pictures: surfaces of parameters, the distance of data and
//! model, errors over parameters (Pesce & Iwanicki 2015, course notes, figures 1 and 2).

mod panels;
mod pictures;

use super::page::projection::{ParameterRow, ProjectionPage, projection_page};
use super::plot::Theme;
use super::{Error, PAGE, write_file};
use crate::program::format_constant;
use crate::project::{Dependence, Landscape, Place, Projection, Surfaces};
use crate::wording::error_text;
use std::path::Path;

/// The pictures' file names.
pub const PICTURES: [&str; 2] = ["parameters.png", "errors.png"];

/// The points along each parameter of an error surface. By hand: one for two pixels.
const POINTS: usize = 100;

/// The most pairs of parameters whose errors are shown. By hand.
const PAIRS: usize = 4;

/// The report of a projection.
#[derive(Clone, Debug)]
pub struct ProjectionReport<'a> {
    /// What was asked.
    pub projection: &'a Projection,
    /// What was found.
    pub surfaces: &'a Surfaces,
    /// The places whose errors over parameters are shown.
    pub places: Vec<&'a Place>,
    /// The command lines to go on with.
    pub commands: Vec<String>,
}

impl ProjectionReport<'_> {
    /// Writes the page and the pictures into a folder that exists.
    ///
    /// # Errors
    /// [`Error::Record`] if something cannot be written; [`Error::Plot`].
    pub fn write(&self, folder: &Path) -> Result<(), Error> {
        let model = self.projection.model();
        let title = format!("Parameters of {}", model.text());
        let landscapes = self.landscapes();
        let mut shown = Vec::new();
        let surfaces = pictures::surfaces(self.surfaces, &title, Theme::Light)?;
        let errors = pictures::landscapes(&landscapes, self.surfaces, &title, Theme::Light)?;
        for (name, png) in PICTURES.into_iter().zip([surfaces, Some(errors)]) {
            if let Some(png) = png {
                write_file(folder, name, &png)?;
                shown.push((name, png));
            }
        }
        let dependences = self.projection.dependences(self.surfaces);
        let page = ProjectionPage {
            title,
            subtitle: self.subtitle(),
            notes: self.surfaces.notes.clone(),
            findings: findings(self.projection, self.surfaces, &dependences),
            inputs: self.surfaces.over.iter().map(|column| column.name.clone()).collect(),
            parameters: self.rows(&dependences),
            pictures: shown,
            commands: self.commands.clone(),
        };
        write_file(folder, PAGE, projection_page(&page).as_bytes())
    }

    fn subtitle(&self) -> String {
        let Surfaces { over, search, .. } = self.surfaces;
        let over: Vec<&str> = over.iter().map(|column| column.name.as_str()).collect();
        let rmse = error_text(self.surfaces.rmse());
        let spread = error_text(self.projection.spread_of_outputs());
        format!(
            "{} groups over {}; RMSE over all {rmse}, the data's spread {spread}",
            search.len(),
            over.join(", ")
        )
    }

    /// Returns the errors at each place over each pair of parameters.
    fn landscapes(&self) -> Vec<Vec<Landscape>> {
        let count = self.surfaces.labels.len();
        let mut pairs: Vec<Vec<usize>> =
            (0..count).flat_map(|a| (a + 1..count).map(move |b| vec![a, b])).collect();
        if pairs.is_empty() {
            pairs.push(vec![0]);
        }
        pairs.truncate(PAIRS);
        let at = |place: &&Place| {
            let of =
                |pair: &Vec<usize>| self.projection.landscape(self.surfaces, place, pair, POINTS);
            pairs.iter().map(of).collect()
        };
        self.places.iter().map(at).collect()
    }

    fn rows(&self, dependences: &[Dependence]) -> Vec<ParameterRow> {
        let row = |(place, name): (usize, &String)| {
            let values = self.surfaces.search.iter().map(|found| found.values[place]);
            let least = values.clone().fold(f32::INFINITY, f32::min);
            let most = values.fold(f32::NEG_INFINITY, f32::max);
            let cost = |input: Option<usize>| {
                let found = dependences.iter().find(|d| d.parameter == place && d.input == input);
                found.map_or("–".to_owned(), |d| match input {
                    Some(_) => format!("{:.1} %; {}", 100.0 * d.share, error_text(d.rmse)),
                    None => error_text(d.rmse),
                })
            };
            let inputs = 0..self.surfaces.over.len();
            ParameterRow {
                name: name.clone(),
                range: format!("{} … {}", format_constant(least), format_constant(most)),
                at_bounds: self.surfaces.on_bounds(self.projection, place),
                costs: inputs.map(Some).chain([None]).map(cost).collect(),
            }
        };
        self.surfaces.labels.iter().enumerate().map(row).collect()
    }
}

/// Says where parameters lie on their bounds, and what they hardly depend on.
pub fn findings(
    projection: &Projection,
    surfaces: &Surfaces,
    dependences: &[Dependence],
) -> Vec<String> {
    let mut found = Vec::new();
    let all = surfaces.search.len();
    let was = error_text(surfaces.rmse());
    for (place, name) in surfaces.labels.iter().enumerate() {
        let [lower, upper] = surfaces.on_bounds(projection, place);
        for (count, bound) in [(lower, "lower"), (upper, "upper")] {
            if count > 0 {
                found.push(format!("{name} lies on its {bound} bound in {count} of {all} groups"));
            }
        }
        let own = || dependences.iter().filter(|one| one.parameter == place && one.is_weak);
        if let Some(constant) = own().find(|one| one.input.is_none()) {
            let rmse = error_text(constant.rmse);
            found.push(format!("{name} may as well be a constant: RMSE {rmse} for {was}"));
            continue;
        }
        for one in own() {
            let Some(input) = one.input.and_then(|input| surfaces.over.get(input)) else {
                continue;
            };
            let rmse = error_text(one.rmse);
            found.push(format!(
                "{name} hardly depends on {}: with its mean over it, RMSE {rmse} for {was}",
                input.name
            ));
        }
    }
    found
}
