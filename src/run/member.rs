//! `front.json` and `front-max.json`: members as they are written and read back.

use super::folder::read;
use super::{RecordError, Run};
use crate::dataset::output_units;
use crate::eval::{OutputError, Score};
use crate::fit::Measure;
use crate::program::{Names, parse};
use crate::search::{Front, FrontMember};
use crate::stability::VerdictRecord;
use crate::truth::DomainError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// A member as `front.json` has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MemberRecord {
    /// Cycles on the run's GPU profile.
    pub cost: f64,
    /// Registers; null in records of a version that did not count them.
    pub registers: Option<u32>,
    /// The RMSE over all outputs, on the search split.
    pub rmse: f64,
    /// The maximum error over all outputs, on the search split.
    pub max_error: f64,
    /// The errors over all outputs, on the validation split.
    pub validation: OutputError,
    /// The errors by output, on the search split.
    pub errors: BTreeMap<String, OutputError>,
    /// The errors by output, on the validation split.
    pub validation_errors: BTreeMap<String, OutputError>,
    /// The errors over the whole domain, by output, if they were integrated.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub domain_errors: BTreeMap<String, DomainError>,
    /// The verdict.
    #[serde(default)]
    pub verdict: VerdictRecord,
    /// Its text.
    pub formula: String,
    /// What fills the holes of the template, if there is one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holes: Vec<String>,
}

impl MemberRecord {
    /// Records a member.
    pub fn new(member: &FrontMember, names: &Names) -> MemberRecord {
        fn by_output<E: Copy>(names: &Names, errors: &[E]) -> BTreeMap<String, E> {
            names.outputs.iter().cloned().zip(errors.iter().copied()).collect()
        }
        MemberRecord {
            cost: member.cost,
            registers: member.registers,
            rmse: member.search_error().rmse,
            max_error: member.search_error().max,
            validation: member.validation_error(),
            errors: by_output(names, &member.score.search),
            validation_errors: by_output(names, &member.score.validation),
            domain_errors: by_output(names, &member.domain),
            verdict: member.verdict.clone(),
            formula: member.formula.clone(),
            holes: member.holes.clone(),
        }
    }

    fn into_member(self, run: &Run) -> Result<FrontMember, String> {
        let names = &run.names();
        let program = parse(&self.formula, names).map_err(|error| error.to_string())?;
        fn errors<E: Copy>(names: &Names, map: &BTreeMap<String, E>) -> Result<Vec<E>, String> {
            let of = |name: &String| map.get(name).copied();
            let errors: Option<Vec<E>> = names.outputs.iter().map(of).collect();
            errors.ok_or_else(|| "an output's errors are missing".to_owned())
        }
        let score = Score {
            search: errors(names, &self.errors)?,
            validation: errors(names, &self.validation_errors)?,
            units: output_units(&run.outputs),
        };
        let member = FrontMember {
            program,
            cost: self.cost,
            registers: self.registers,
            score,
            domain: match self.domain_errors.is_empty() {
                true => Vec::new(),
                false => errors(names, &self.domain_errors)?,
            },
            verdict: self.verdict,
            formula: self.formula,
            holes: self.holes,
        };
        member.check()?;
        let template = run.goal.template(names)?;
        for hole in &member.holes {
            let read = template.as_ref().map(|template| template.guess(hole));
            read.ok_or("the run has no template")?.map_err(|error| error.to_string())?;
        }
        Ok(member)
    }
}

impl Front {
    /// Returns the text of `front.json`.
    pub fn to_json(&self, names: &Names) -> String {
        let members: Vec<_> = self.members.iter().map(|m| MemberRecord::new(m, names)).collect();
        serde_json::to_string_pretty(&members).expect("plain data") + "\n"
    }

    /// Reads `front.json` or `front-max.json` from a run's folder, in the measure that it was made
    /// in.
    ///
    /// # Errors
    /// If it cannot be read, or is not a front of the run.
    pub fn load(path: &Path, run: &Run, measure: Measure) -> Result<Front, RecordError> {
        Front::parse(path, &read(path)?, run, measure)
    }

    /// Parses the text of the file at `path`, as [`Front::load`] does.
    pub fn parse(
        path: &Path,
        text: &str,
        run: &Run,
        measure: Measure,
    ) -> Result<Front, RecordError> {
        let damaged = |line, reason| RecordError::Damaged { path: path.to_owned(), line, reason };
        let records: Vec<MemberRecord> =
            serde_json::from_str(text).map_err(|error| damaged(error.line(), error.to_string()))?;
        let mut members = Vec::with_capacity(records.len());
        for (number, record) in (1..).zip(records) {
            let member = record.into_member(run).map_err(|reason| {
                damaged(line_of_member(text, number), format!("formula {number}: {reason}"))
            })?;
            members.push(member);
        }
        if !members.is_sorted_by(|a, b| a.cost <= b.cost) {
            return Err(damaged(1, "the formulas are not by rising cost".into()));
        }
        Ok(Front { measure, members })
    }
}

/// Returns the line of a member's first field, its cost; 1 if that cannot be found.
fn line_of_member(text: &str, number: usize) -> usize {
    let mut lines = (1..).zip(text.lines());
    let costs = lines.by_ref().filter(|(_, line)| line.trim_start().starts_with("\"cost\""));
    costs.map(|(line, _)| line).nth(number - 1).unwrap_or(1)
}
