//! Claims of a dataset's outputs.

use super::{Dataset, Error, check_text};
use crate::program::{Claim, Names};
use std::path::Path;

/// The most claims of a dataset. By hand: each costs a proof.
const MOST: usize = 64;

impl Dataset {
    /// Adds a claim, as [`Claim::parse`] describes it, in place of one of the same name.
    ///
    /// # Errors
    /// [`Error::Claim`] if the text is not a claim over the dataset's columns.
    pub fn claim(&mut self, text: &str) -> Result<(), Error> {
        let names = self.names();
        Claim::add(&mut self.claims, text, &names)
            .map_err(|error| Error::Claim { path: self.origin(), problem: error.to_string() })
    }
}

/// Selects the claims that are over these columns.
pub(crate) fn claims_over(claims: &[String], names: &Names) -> Vec<String> {
    claims.iter().filter(|text| Claim::parse(text, names).is_ok()).cloned().collect()
}

/// Checks that there are not too many claims, that they are over the columns, and that their names
/// differ.
///
/// # Errors
/// [`Error::Claim`]: the first violation, at `path`.
pub fn check_claims(path: &Path, claims: &[String], names: &Names) -> Result<(), Error> {
    let refused = |problem: String| Error::Claim { path: path.into(), problem };
    if claims.len() > MOST {
        return Err(refused(format!("{} claims; at most {MOST} are allowed", claims.len())));
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
