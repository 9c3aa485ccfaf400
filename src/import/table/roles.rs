//! Which columns are inputs, outputs, weights and standard errors.

use super::layout::Holds;
use super::names::Heading;
use super::{InputColumns, Options};
use crate::dataset;
use crate::import::Error;
use std::path::Path;

/// The column that holds weights, unless it is named otherwise.
pub(super) const WEIGHT: &str = "weight";

/// The suffix of the name of a column of standard errors.
const STANDARD_ERROR: &str = "_se";

/// The columns of a table, by their place in the file.
pub(super) struct Columns<'a> {
    pub path: &'a Path,
    pub headings: &'a [Heading],
    pub holds: &'a [Holds],
    pub dropped: &'a [bool],
}

/// What each column is for.
#[derive(Debug, PartialEq)]
pub(super) struct Roles {
    pub inputs: Vec<usize>,
    pub outputs: Vec<usize>,
    /// The standard errors of each output.
    pub errors: Vec<Option<usize>>,
    pub weight: Option<usize>,
}

impl Roles {
    /// All columns that are read.
    pub fn all(&self) -> impl Iterator<Item = usize> {
        let errors = self.errors.iter().flatten();
        self.inputs.iter().chain(&self.outputs).chain(errors).chain(&self.weight).copied()
    }
}

impl Columns<'_> {
    /// Finds a column by its name, or as the file has it.
    ///
    /// # Errors
    /// No column of this name, with a suggestion.
    pub fn place(&self, name: &str) -> Result<usize, Error> {
        let by_name = self.headings.iter().position(|heading| heading.name == name);
        let on_a_line = name.split_whitespace().collect::<Vec<_>>().join(" ");
        let written =
            || self.headings.iter().position(|h| !on_a_line.is_empty() && h.written == on_a_line);
        by_name.or_else(written).ok_or_else(|| {
            let names = self.headings.iter().map(|heading| heading.name.as_str());
            dataset::unknown_column(self.path.into(), name, names).into()
        })
    }

    /// Finds a column that can be read.
    fn usable(&self, name: &str) -> Result<usize, Error> {
        let place = self.place(name)?;
        let (path, column) = (self.path.to_path_buf(), self.headings[place].name.clone());
        match &self.holds[place] {
            _ if self.dropped[place] => Err(Error::Dropped { path, column }),
            Holds::Numbers => Ok(place),
            Holds::Nothing => {
                Err(Error::NoNumberColumn { path, column, line: 1, text: String::new() })
            }
            Holds::Text { line, text, .. } => {
                let (line, text) = (*line, text.clone());
                Err(Error::NoNumberColumn { path, column, line, text })
            }
        }
    }

    fn all_usable(&self, names: &[String]) -> Result<Vec<usize>, Error> {
        let mut places = Vec::new();
        for name in names {
            let place = self.usable(name)?;
            if places.contains(&place) {
                let (path, column) = (self.path.into(), name.clone());
                return Err(dataset::Error::DuplicateColumn { path, column }.into());
            }
            places.push(place);
        }
        Ok(places)
    }

    /// Gives each column its role: as the options say, or else the last one is the output and all
    /// others are inputs.
    pub fn roles(&self, options: &Options) -> Result<Roles, Error> {
        let named = match &options.inputs {
            Some(InputColumns::Names(names)) => Some(self.all_usable(names)?),
            _ => None,
        };
        let outputs = options.outputs.as_ref().map(|names| self.all_usable(names)).transpose()?;
        let is_named = |place: &usize| {
            named.iter().flatten().chain(outputs.iter().flatten()).any(|named| named == place)
        };
        let weight = match &options.weights {
            Some(name) => Some(self.usable(name)?),
            None => self.candidates().find(|&p| self.headings[p].name == WEIGHT),
        };
        let weight = weight.filter(|place| options.weights.is_some() || !is_named(place));
        if let Some(place) = weight.filter(is_named) {
            let (path, column) = (self.path.into(), self.headings[place].name.clone());
            return Err(dataset::Error::DuplicateColumn { path, column }.into());
        }
        let rest: Vec<usize> = self.candidates().filter(|place| Some(*place) != weight).collect();
        let inputs = match (&options.inputs, named) {
            (_, Some(named)) => named,
            (Some(InputColumns::Count(count)), _) => {
                self.first(*count, &rest, outputs.as_deref().unwrap_or_default())?
            }
            (None, None) => self.all_but_outputs(&rest, outputs.as_deref()),
            (Some(InputColumns::Names(_)), None) => Vec::new(),
        };
        let chosen: Vec<usize> = match &outputs {
            Some(outputs) => outputs.clone(),
            None => rest.iter().copied().filter(|place| !inputs.contains(place)).collect(),
        };
        let errors_of = |place: usize| {
            let found = self.errors_of(place, &rest)?;
            let is_output = outputs.as_ref().is_some_and(|outputs| outputs.contains(&found));
            (!inputs.contains(&found) && !is_output).then_some(found)
        };
        let errors: Vec<usize> = chosen.iter().filter_map(|&place| errors_of(place)).collect();
        let outputs: Vec<usize> =
            chosen.into_iter().filter(|place| !errors.contains(place)).collect();
        let errors = outputs.iter().map(|&place| errors_of(place)).collect();
        let roles = Roles { inputs, outputs, errors, weight };
        self.check(roles, rest.len())
    }

    fn check(&self, roles: Roles, usable: usize) -> Result<Roles, Error> {
        let path = self.path.to_path_buf();
        if let Some(&place) = roles.outputs.iter().find(|place| roles.inputs.contains(place)) {
            let column = self.headings[place].name.clone();
            return Err(dataset::Error::InputIsOutput { path, column }.into());
        }
        let left_out = self.left_out();
        if (roles.inputs.is_empty() || roles.outputs.is_empty())
            && usable < 2
            && !left_out.is_empty()
        {
            return Err(Error::TooFewColumns { path, left_out });
        }
        if roles.inputs.is_empty() {
            return Err(dataset::Error::NoInputs { path }.into());
        }
        if roles.outputs.is_empty() {
            return Err(dataset::Error::NoOutputs { path }.into());
        }
        Ok(roles)
    }

    /// The columns left out because of what they hold, in words.
    fn left_out(&self) -> String {
        let reason = |(heading, holds): (&Heading, &Holds)| match holds {
            Holds::Numbers => None,
            Holds::Nothing => Some(format!("`{}`, which is empty", heading.name)),
            Holds::Text { line, text, .. } => {
                Some(format!("`{}`, which holds text (line {line}: `{text}`)", heading.name))
            }
        };
        let reasons: Vec<String> =
            self.headings.iter().zip(self.holds).filter_map(reason).take(5).collect();
        reasons.join(", ")
    }

    /// The columns of numbers that are not dropped.
    pub fn candidates(&self) -> impl Iterator<Item = usize> {
        let holds = self.holds.iter().zip(self.dropped).enumerate();
        holds
            .filter(|(_, (holds, dropped))| **holds == Holds::Numbers && !**dropped)
            .map(|(p, _)| p)
    }

    /// The first `count` columns that are no outputs.
    fn first(&self, count: usize, rest: &[usize], outputs: &[usize]) -> Result<Vec<usize>, Error> {
        let free: Vec<usize> =
            rest.iter().copied().filter(|place| !outputs.contains(place)).collect();
        let path = self.path.to_path_buf();
        let most = rest.len() - usize::from(outputs.is_empty()).min(rest.len());
        if count == 0 {
            return Err(dataset::Error::NoInputs { path }.into());
        }
        if count > most.min(free.len()) {
            let left_out = self.left_out();
            return Err(match rest.len() < 2 && !left_out.is_empty() {
                true => Error::TooFewColumns { path, left_out },
                false => Error::TooManyInputs { path, asked: count, columns: rest.len() },
            });
        }
        Ok(free[..count].to_vec())
    }

    /// All columns but the outputs, or but the last, and but their standard errors.
    fn all_but_outputs(&self, rest: &[usize], outputs: Option<&[usize]>) -> Vec<usize> {
        let is_error =
            |place: &&usize| rest.iter().any(|&of| self.errors_of(of, rest) == Some(**place));
        let last = rest.iter().rev().find(|place| !is_error(place)).or(rest.last());
        let outputs = outputs.unwrap_or(last.map(std::slice::from_ref).unwrap_or_default());
        let errors: Vec<usize> =
            outputs.iter().filter_map(|&place| self.errors_of(place, rest)).collect();
        let is_input = |place: &usize| !outputs.contains(place) && !errors.contains(place);
        rest.iter().copied().filter(is_input).collect()
    }

    /// The column of a column's standard errors.
    fn errors_of(&self, place: usize, among: &[usize]) -> Option<usize> {
        let name = format!("{}{STANDARD_ERROR}", self.headings[place].name);
        among.iter().copied().find(|&other| self.headings[other].name == name)
    }
}
