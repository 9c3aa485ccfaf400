//! Checks of a record that was read: its values obey the same rules as typed ones, wherever the
//! file came from.

use super::Run;
use crate::dataset::{check_claims, check_columns, check_name};
use crate::search::not_negative;
use std::path::Path;

impl Run {
    /// Checks that a search could have left this record: columns as a dataset has them, settings
    /// within their bounds, requirements on existing columns, finite times.
    ///
    /// # Errors
    /// The first violation found, with the name of its field.
    pub fn check(&self) -> Result<(), String> {
        if self.inputs.is_empty() || self.outputs.is_empty() {
            return Err("`inputs` and `outputs` must name at least one column each".into());
        }
        check_name(&self.name).map_err(|fault| format!("`name` is {:?}: {fault}", self.name))?;
        check_columns(Path::new("columns"), self.inputs.iter().chain(&self.outputs))
            .map_err(|error| error.to_string())?;
        check_claims(Path::new("`claims`"), &self.claims, &self.names())
            .map_err(|error| error.to_string())?;
        self.goal.check(self.inputs.len(), self.outputs.len())?;
        self.goal.template(&self.names())?;
        self.method.check()?;
        not_negative("seconds", self.seconds)?;
        let enumerated = self.enumeration.map(|enumeration| enumeration.cost);
        for (name, number) in [
            ("enumeration", enumerated),
            ("exhaustive", self.exhaustive),
            ("budget", self.budget.seconds),
        ] {
            number.map_or(Ok(()), |number| not_negative(name, number))?;
        }
        if let Some(scene) = &self.scene {
            scene.check().map_err(|error| error.to_string())?;
        }
        for source in &self.sources {
            if !source.sources.is_empty() {
                return Err("`sources`: the union of runs lists searches, not unions".into());
            }
            source.check().map_err(|reason| format!("`sources`: {reason}"))?;
            if source.names() != self.names() {
                return Err("`sources`: they have other columns than their union".into());
            }
        }
        Ok(())
    }
}
