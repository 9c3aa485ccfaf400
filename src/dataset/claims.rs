//! What is claimed of a dataset's outputs.

use super::{Dataset, Error, check_text};
use crate::program::{Claim, Names};
use std::path::Path;

/// Claims of a dataset.
const MOST: usize = 64;

impl Dataset {
    /// Claims something more of its outputs, [`Claim::parse`] saying how, in place of what has the same name.
    ///
    /// # Errors
    /// [`Error::Claim`].
    pub fn claim(&mut self, text: &str) -> Result<(), Error> {
        let names = self.names();
        Claim::add(&mut self.claims, text, &names)
            .map_err(|error| Error::Claim { path: self.origin(), problem: error.to_string() })
    }
}

/// The texts among those of claims that are over these columns.
pub(crate) fn claims_over(claims: &[String], names: &Names) -> Vec<String> {
    claims.iter().filter(|text| Claim::parse(text, names).is_ok()).cloned().collect()
}

/// Checks that claims are over columns, and each called otherwise.
///
/// # Errors
/// The first violation found, at `path`.
pub fn check_claims(path: &Path, claims: &[String], names: &Names) -> Result<(), Error> {
    let refused = |problem: String| Error::Claim { path: path.into(), problem };
    if claims.len() > MOST {
        return Err(refused(format!("{} claims are more than {MOST}", claims.len())));
    }
    for (i, text) in claims.iter().enumerate() {
        check_text(text).map_err(|fault| refused(format!("the claim {text:?}: {fault}")))?;
        let Claim { name, .. } =
            Claim::parse(text, names).map_err(|error| refused(error.to_string()))?;
        if claims[..i].iter().any(|other| Claim::name_of(other) == name) {
            return Err(refused(format!("two claims are called `{name}`")));
        }
    }
    Ok(())
}
