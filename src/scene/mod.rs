//! Scenes: what a use needs of a dataset.
//!
//! A [`Scene`] says which values of the inputs occur, and how often; which inputs are fixed; and
//! which combination of the outputs a shader uses. [`Scene::over`] checks it against a dataset's
//! columns and returns a [`View`], which gives the smaller dataset, and rewrites formulas over the
//! whole dataset's columns as formulas over the view's.
//!
//! A scene is a `.ron` file:
//!
//! ```
//! # use lgp::dataset::{Column, Dataset, Origin, Split};
//! use lgp::scene::Scene;
//! let scene = Scene::parse("dielectric", r#"(
//!     ranges: {"roughness": (0.25, 0.75)},
//!     fixed: {"f0": 0.04},
//!     outputs: {"specular": "f0*scale + bias"},
//! )"#)?;
//! # let split = Split::on_grid(&[vec![0.0, 0.5, 1.0]], |x| [0.5 + 0.5*x[0], 0.5 - 0.5*x[0]]);
//! # let inputs = vec![Column::new("roughness", [0.0, 1.0])];
//! # let (outputs, splits) = ([("scale", "1"), ("bias", "1")], [split.clone(), split]);
//! # let dataset =
//! #     Dataset::of_splits("dfg", Origin::default(), inputs, outputs, splits).unwrap();
//! let view = scene.over(&dataset)?.dataset()?;
//! assert_eq!(view.outputs[0].name, "specular");
//! assert_eq!(view.search.columns, [[0.5], [0.28]]);
//! # Ok::<(), lgp::scene::Error>(())
//! ```

mod combine;
mod entries;
mod error;
mod fixed;
mod histogram;
mod idle;
mod logged;
mod quantisation;
mod read;
mod removal;
mod specialize;
mod view;

pub use error::Error;
pub use histogram::Histogram;
pub use idle::Evidence;
pub use logged::Logged;
pub use quantisation::Quantisation;
pub use specialize::{Change, Specialization, Step, specialize};
pub use view::View;

use crate::dataset::{check_name, check_text};
use crate::file::read_text;
use crate::grammar::{FileError, file};
use crate::program::shortest;
use crate::suggest::did_you_mean;
use serde::{Deserialize, Serialize};
use std::fmt::Write;
use std::path::Path;

const KIND: &str = "scene";

/// The needs of a use of a dataset; every part may be left out.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// The scene's name: that of its file, unless the file gives another.
    #[serde(default)]
    pub name: String,
    /// A sentence about the use; it may be empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// The least and greatest value that occurs, by input.
    #[serde(default, with = "entries", skip_serializing_if = "Vec::is_empty")]
    pub ranges: Vec<(String, [f64; 2])>,
    /// The values of inputs that never vary, and are no inputs of the view; and of further names
    /// that `outputs` uses.
    #[serde(default, with = "entries", skip_serializing_if = "Vec::is_empty")]
    pub fixed: Vec<(String, f64)>,
    /// The frequencies of inputs' values; an input occurs in at most one histogram.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub histograms: Vec<Histogram>,
    /// The outputs of the view, each an expression over the dataset's outputs, inputs and fixed
    /// values; if there are none, the dataset's own.
    #[serde(default, with = "entries", skip_serializing_if = "Vec::is_empty")]
    pub outputs: Vec<(String, String)>,
    /// The target's steps, which hide small errors.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quantisation: Option<Quantisation>,
    /// The limits of cost and error on each kind of machine.
    #[serde(default, with = "entries", skip_serializing_if = "Vec::is_empty")]
    pub tiers: Vec<(String, Tier)>,
}

/// The limits of a formula's cost and error, at least one of them, finite and not negative.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tier {
    /// The most cycles.
    pub max_cost: Option<f64>,
    /// The largest error, in the search's measure.
    pub max_error: Option<f64>,
}

impl Scene {
    /// Reads a scene by the path of its file, or by the name of one in the folder `scenes` beside
    /// the file of a dataset.
    ///
    /// # Errors
    /// A missing or unreadable file; those of [`Scene::parse`].
    pub fn find(name_or_path: &str, dataset: &Path) -> Result<Scene, Error> {
        let given = Path::new(name_or_path);
        let folder = dataset.parent().unwrap_or(Path::new("")).join("scenes");
        let named = folder.join(name_or_path).with_extension("ron");
        // A folder may have the scene's name.
        let exists = if named.is_file() { given.is_file() } else { given.exists() };
        let is_name = given.extension().is_none() && !exists;
        let path = if is_name { named.as_path() } else { given };
        if is_name && !path.is_file() {
            let known = names_in(&folder);
            return Err(Error::NoSuchScene {
                name: name_or_path.to_owned(),
                hint: did_you_mean(name_or_path, known.iter().map(String::as_str)),
                folder,
                known: known.join(", "),
            });
        }
        let text = read_text(path).map_err(|reason| FileError::Unreadable {
            kind: KIND,
            path: path.display().to_string(),
            reason,
        })?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        Scene::read(&path.display().to_string(), &stem, &text)
    }

    /// Parses the text of a `.ron` file; `name` is the scene's name unless the text gives another.
    ///
    /// # Errors
    /// Text that is no scene; those of [`Scene::check`]. [`Scene::over`] checks the rest.
    pub fn parse(name: &str, text: &str) -> Result<Scene, Error> {
        Scene::read(name, name, text)
    }

    fn read(file: &str, name: &str, text: &str) -> Result<Scene, Error> {
        let mut scene: Scene = file::parse(KIND, file, text)?;
        if scene.name.is_empty() {
            scene.name = name.to_owned();
        }
        scene.check()?;
        Ok(scene)
    }

    /// Checks all that can be checked without a dataset.
    ///
    /// # Errors
    /// An unusable name; a number that is not finite as `f32`; a tier without limits, or with a
    /// negative or infinite one.
    pub fn check(&self) -> Result<(), Error> {
        self.check_names()?;
        self.check_numbers()?;
        self.check_tiers()
    }

    /// Returns a line that says what the scene does to a dataset.
    pub fn summary(&self) -> String {
        let mut parts = Vec::new();
        parts.extend(
            self.fixed.iter().map(|(name, value)| format!("{name} = {}", shortest(*value))),
        );
        let range = |(name, ends): &(String, [f64; 2])| {
            let [low, high] = ends.map(shortest);
            format!("{name} in [{low}, {high}]")
        };
        parts.extend(self.ranges.iter().map(range));
        parts.extend(self.outputs.iter().map(|(name, text)| format!("{name} = {text}")));
        parts.extend(self.histograms.iter().map(|histogram| {
            let bins: Vec<String> = histogram.bins().iter().map(ToString::to_string).collect();
            format!("weighted by {} ({} bins)", histogram.inputs.join(", "), bins.join("×"))
        }));
        parts.extend(self.quantisation.iter().map(Quantisation::summary));
        parts.join("; ")
    }

    /// Returns the text of a `.ron` file of the scene.
    pub fn to_ron(&self) -> String {
        let mut text = String::new();
        let pretty = ron::ser::PrettyConfig::default().depth_limit(2);
        let _ = writeln!(text, "// {}", self.description.replace('\n', " "));
        let bare = Scene { description: String::new(), ..self.clone() };
        text += &ron::ser::to_string_pretty(&bare, pretty).expect("plain data");
        text + "\n"
    }

    /// Returns the largest cost that a tier allows; none unless every tier has one.
    pub fn max_cost(&self) -> Option<f64> {
        let costs: Option<Vec<f64>> = self.tiers.iter().map(|(_, tier)| tier.max_cost).collect();
        costs?.into_iter().reduce(f64::max)
    }

    /// Checks the name, which becomes part of the view's name, and those of tiers, which appear in
    /// tables.
    fn check_names(&self) -> Result<(), Error> {
        let named = |name: &str, fault| Error::Name { name: name.to_owned(), fault };
        check_name(&self.name).map_err(|fault| named(&self.name, fault))?;
        for tier in self.tiers.iter().map(|(tier, _)| tier) {
            check_text(tier).map_err(|fault| named(tier, fault))?;
        }
        Ok(())
    }

    fn check_numbers(&self) -> Result<(), Error> {
        let fixed = self.fixed.iter().map(|(name, value)| ("fixed", name.clone(), *value));
        let ranges = self
            .ranges
            .iter()
            .flat_map(|(name, ends)| ends.map(|end| ("ranges", name.clone(), end)));
        let histograms = self.histograms.iter().flat_map(|histogram| {
            let ends = histogram.over.iter().flatten();
            let numbers = ends.chain(&histogram.counts);
            numbers.map(|&number| ("histograms", histogram.inputs.join(", "), number))
        });
        for (part, name, value) in fixed.chain(ranges).chain(histograms) {
            if !(value as f32).is_finite() {
                return Err(Error::Number { scene: self.name.clone(), part, name, value });
            }
        }
        Ok(())
    }

    fn check_tiers(&self) -> Result<(), Error> {
        for (tier, limits) in &self.tiers {
            let given: Vec<f64> =
                [limits.max_cost, limits.max_error].into_iter().flatten().collect();
            let usable = given.iter().all(|limit| limit.is_finite() && *limit >= 0.0);
            if given.is_empty() || !usable {
                return Err(Error::Tier { scene: self.name.clone(), tier: tier.clone() });
            }
        }
        Ok(())
    }
}

fn names_in(folder: &Path) -> Vec<String> {
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let paths = files.map(|file| file.path());
    let scenes = paths.filter(|path| path.extension().is_some_and(|extension| extension == "ron"));
    let mut names: Vec<String> =
        scenes.filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned())).collect();
    names.sort();
    names
}
