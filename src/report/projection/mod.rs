//! The page of a projection, and its pictures: surfaces of parameters, the distance of data and
//! model, errors over parameters (Pesce & Iwanicki 2015, course notes, figures 1 and 2).

mod findings;
mod panels;
mod pictures;
mod scale;

pub use findings::findings;

use super::maps::end_text;
use super::page::projection::{ParameterRow, ProjectionPage, projection_page};
use super::plot::Theme;
use super::{Error, PAGE, write_file};
use crate::project::{Dependence, Landscape, Place, Projection, Surfaces};
use crate::wording::error_text;
use std::path::Path;

/// The pictures' file names.
pub const PICTURES: [&str; 2] = ["parameters.png", "errors.png"];

/// The points along each parameter of an error surface. By hand: one for two pixels.
const POINTS: usize = 100;

/// Errors above so many times the outputs' spread are drawn as that: models are far off there. By
/// hand.
const ENOUGH: f32 = 3.0;

/// The most pairs of parameters whose errors are shown. By hand.
const PAIRS: usize = 4;

/// The report of a projection.
#[derive(Clone, Debug)]
pub struct ProjectionReport<'a> {
    /// What was asked.
    pub projection: &'a Projection,
    /// What was found.
    pub surfaces: &'a Surfaces,
    /// What the parameters depend on.
    pub dependences: &'a [Dependence],
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
        let pictures = self.pictures(&title)?;
        for (name, png) in &pictures {
            write_file(folder, name, png)?;
        }
        let page = ProjectionPage {
            title,
            subtitle: self.subtitle(),
            notes: self.surfaces.notes.clone(),
            findings: findings(self.projection, self.surfaces, self.dependences),
            inputs: self.inputs().map(|input| self.surfaces.over[input].name.clone()).collect(),
            parameters: self.rows(),
            pictures,
            commands: self.commands.clone(),
        };
        write_file(folder, PAGE, projection_page(&page).as_bytes())
    }

    fn pictures(&self, title: &str) -> Result<Vec<(&'static str, Vec<u8>)>, Error> {
        let surfaces = pictures::surfaces(self.surfaces, title, Theme::Light)?;
        let others = match self.surfaces.labels.len() {
            1 => "Errors over the parameter",
            2 => "Errors over both parameters",
            _ => "Errors over pairs of parameters, the others at their optimum",
        };
        let subtitle = format!("{others}; the RMSE on a logarithmic scale, the optimum a cross");
        let most = ENOUGH * self.projection.spread_of_outputs() as f32;
        let words = [title, &subtitle];
        let found = self.landscapes();
        let errors = pictures::landscapes(&found, self.surfaces, most, words, Theme::Light)?;
        Ok(PICTURES.into_iter().zip([surfaces, errors]).collect())
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

    /// Returns the inputs that something is said of apart: of one alone all is said with a constant.
    fn inputs(&self) -> impl Iterator<Item = usize> + '_ {
        let is_told = |input: &usize| self.dependences.iter().any(|one| one.input == Some(*input));
        (0..self.surfaces.over.len()).filter(is_told)
    }

    fn rows(&self) -> Vec<ParameterRow> {
        let row = |(place, name): (usize, &String)| {
            let values = self.surfaces.search.iter().map(|found| found.values[place]);
            let least = values.clone().fold(f32::INFINITY, f32::min);
            let most = values.fold(f32::NEG_INFINITY, f32::max);
            let cost = |input: Option<usize>| {
                let found =
                    self.dependences.iter().find(|d| d.parameter == place && d.input == input);
                found.map_or("–".to_owned(), |d| match input {
                    Some(_) => format!("{:.1} %; {}", 100.0 * d.share, error_text(d.rmse)),
                    None => error_text(d.rmse),
                })
            };
            ParameterRow {
                name: name.clone(),
                range: format!("{} … {}", end_text(least), end_text(most)),
                at_bounds: self.surfaces.on_bounds(self.projection, place).map(|on| on.len()),
                costs: self.inputs().map(Some).chain([None]).map(cost).collect(),
            }
        };
        self.surfaces.labels.iter().enumerate().map(row).collect()
    }
}
