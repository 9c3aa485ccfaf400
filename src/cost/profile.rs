//! GPU profiles: one chip, or a weighted mix of several.

use super::chip::{Chip, Evidence, File, KIND};
use crate::grammar::{FileError, file};
use serde::{Deserialize, Serialize};

/// The chips that come with the program, by name: the files of `grammar/gpu`.
const BUILT_IN: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/profiles.rs"));

/// The costs of formulas on a GPU, or on a weighted mix of GPUs. Serialised as its files' content,
/// and read back by the same rules.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "Kept", try_from = "Kept")]
pub struct Profile {
    /// The chip's name, or the mix as written.
    pub name: String,
    /// A sentence about it; may be empty.
    pub description: String,
    /// The chips and their shares of the whole, which sum to 1.
    pub(super) chips: Vec<(f64, Chip)>,
}

impl Profile {
    /// Returns the built-in profiles' names.
    pub fn built_in() -> impl Iterator<Item = &'static str> {
        BUILT_IN.iter().map(|(name, _)| *name)
    }

    /// Returns a built-in profile by name, or reads one from a `.ron` file; or a mix, as in
    /// `gcn:2,turing:1`: the weighted mean of their cycles.
    ///
    /// # Errors
    /// An unknown name; a file that cannot be read or is not a profile; a weight that is not
    /// positive.
    pub fn find(name_or_mix: &str) -> Result<Profile, FileError> {
        if let [single] = parts(name_or_mix)?.as_slice()
            && single.0 == name_or_mix
        {
            return Ok(Profile::single(chip(single.0)?));
        }
        let parts = parts(name_or_mix)?;
        let total: f64 = parts.iter().map(|(_, weight)| weight).sum();
        let chips = parts
            .iter()
            .map(|&(name, weight)| Ok((weight / total, chip(name)?)))
            .collect::<Result<Vec<_>, FileError>>()?;
        let described =
            |(share, chip): &(f64, Chip)| format!("{:.0} % {}", share * 100.0, chip.name);
        let description = chips.iter().map(described).collect::<Vec<_>>().join(", ");
        Ok(Profile { name: name_or_mix.to_owned(), description, chips })
    }

    /// Returns a built-in profile or a mix of such, by name, without opening a file.
    pub fn find_built_in(name_or_mix: &str) -> Option<Profile> {
        let known = |(name, _): &(&str, f64)| BUILT_IN.iter().any(|(known, _)| known == name);
        let only_known = parts(name_or_mix).is_ok_and(|parts| parts.iter().all(known));
        only_known.then(|| Profile::find(name_or_mix).ok()).flatten()
    }

    /// Returns a hash of all costs, whatever the names.
    pub fn fingerprint(&self) -> String {
        let chips = self.chips.iter().map(|(share, chip)| (*share, chip.nameless()));
        file::fingerprint(&chips.collect::<Vec<_>>())
    }

    /// Parses the text of a `.ron` file at `path`.
    ///
    /// # Errors
    /// A text that is not a profile.
    pub fn parse(path: &str, text: &str) -> Result<Profile, FileError> {
        Ok(Profile::single(Chip::parse(path, text)?))
    }

    /// Returns the evidence for a profile of one chip, if there is any.
    pub fn evidence(&self) -> Option<&Evidence> {
        match self.chips.as_slice() {
            [(_, chip)] => chip.file.evidence.as_ref(),
            _ => None,
        }
    }

    fn single(chip: Chip) -> Profile {
        Profile {
            name: chip.name.clone(),
            description: chip.description.clone(),
            chips: vec![(1.0, chip)],
        }
    }
}

/// A profile as data.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Kept {
    name: String,
    description: String,
    /// The chips' files, and their shares.
    chips: Vec<(f64, File)>,
}

impl From<Profile> for Kept {
    fn from(Profile { name, description, chips }: Profile) -> Kept {
        let chips = chips.into_iter().map(|(share, chip)| (share, chip.file)).collect();
        Kept { name, description, chips }
    }
}

impl TryFrom<Kept> for Profile {
    type Error = String;

    fn try_from(Kept { name, description, chips }: Kept) -> Result<Profile, String> {
        let total: f64 = chips.iter().map(|(share, _)| share).sum();
        let positive = chips.iter().all(|(share, _)| *share > 0.0);
        if !(positive && (total - 1.0).abs() < 1e-9) {
            return Err("the shares of a GPU profile's chips must sum to 1".to_owned());
        }
        let chip = |(share, file)| Ok((share, Chip::of(file)?));
        let chips = chips.into_iter().map(chip).collect::<Result<_, String>>()?;
        Ok(Profile { name, description, chips })
    }
}

fn chip(name_or_path: &str) -> Result<Chip, FileError> {
    Chip::parse(name_or_path, &file::find(KIND, name_or_path, BUILT_IN)?)
}

/// Splits a mix into names and weights.
fn parts(mix: &str) -> Result<Vec<(&str, f64)>, FileError> {
    let weighted = |part| match str::rsplit_once(part, ':') {
        None => Ok((part, 1.0)),
        // The colon of a path may follow a drive's letter.
        Some((_, rest)) if rest.contains(['/', '\\']) => Ok((part, 1.0)),
        Some((name, weight)) => match weight.parse::<f64>() {
            Ok(weight) if weight.is_finite() && weight > 0.0 => Ok((name, weight)),
            _ => Err(FileError::Content {
                kind: KIND,
                path: mix.to_owned(),
                reason: format!(
                    "`{weight}` is not a positive weight; write a mix as gcn:2,turing:1"
                ),
            }),
        },
    };
    mix.split(',').map(|part| weighted(part.trim())).collect()
}
