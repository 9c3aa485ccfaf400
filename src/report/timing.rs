//! The time of an evaluation on a processor, measured once and kept beside the run: the page is
//! made of what is kept, so that it stays the same.

use super::{Error, Report, write_file};
use crate::eval::{Evaluator, Isa, Samples, Tape};
use crate::file::read_text;
use crate::program::Program;
use crate::run::RecordError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::{Duration, Instant};

const FILE: &str = "timing.json";

/// The time spent on each formula. By hand, unmeasured.
const SPENT: Duration = Duration::from_millis(30);

/// The time of evaluations on a device, by formula text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// The processor's name.
    pub device: String,
    /// The method of measurement.
    pub method: String,
    /// Nanoseconds by formula text.
    pub ns: BTreeMap<String, f64>,
}

impl Timing {
    /// Returns the nanoseconds of a formula, if it was measured.
    pub fn of(&self, formula: &str) -> Option<f64> {
        self.ns.get(formula).copied()
    }
}

impl Report {
    /// Measures all formulas on this processor, by the interpreter on one thread, and writes the
    /// file; what it holds of other devices stays.
    ///
    /// # Errors
    /// [`Error::NoData`]; [`Error::Record`].
    pub fn measure(&mut self, folder: &Path) -> Result<(), Error> {
        let timing = measured(self)?;
        self.timings.retain(|known| known.device != timing.device);
        self.timings.push(timing);
        let text = serde_json::to_string_pretty(&self.timings).expect("plain data") + "\n";
        write_file(folder, FILE, text.as_bytes())
    }
}

fn measured(report: &Report) -> Result<Timing, Error> {
    let dataset = report.dataset.as_ref().ok_or(Error::NoData)?;
    let samples = Samples::new(&dataset.search, dataset.inputs.len());
    let mut evaluator = Evaluator::default();
    let members = report.front.members.iter().chain(&report.minimax.members);
    let all = members.chain(report.published.iter().map(|known| &known.member));
    Ok(Timing {
        device: format!("CPU, {}", Isa::best()),
        method: "the interpreter on one thread, the shortest of many runs over the search split"
            .to_owned(),
        ns: all
            .map(|member| {
                let ns = nanoseconds(&member.program, &samples, &mut evaluator);
                // Four digits are more than is known.
                (member.formula.clone(), format!("{ns:.3e}").parse().unwrap_or(ns))
            })
            .collect(),
    })
}

fn nanoseconds(program: &Program, samples: &Samples, evaluator: &mut Evaluator) -> f64 {
    let tape = Tape::new(program);
    let mut values = crate::eval::Values::default();
    let (begun, mut shortest) = (Instant::now(), f64::INFINITY);
    while begun.elapsed() < SPENT {
        let start = Instant::now();
        evaluator.outputs_into(&tape, samples, &mut values);
        shortest = shortest.min(start.elapsed().as_secs_f64());
    }
    1e9 * shortest / samples.rows() as f64
}

/// Loads earlier measurements; none if there is no file.
pub(super) fn load(folder: &Path) -> Result<Vec<Timing>, Error> {
    let path = folder.join(FILE);
    if !path.exists() {
        return Ok(Vec::new());
    }
    let text = read_text(&path)
        .map_err(|reason| RecordError::Unreadable { path: path.clone(), reason })?;
    let damaged = |error: serde_json::Error| RecordError::Damaged {
        path,
        line: error.line(),
        reason: error.to_string(),
    };
    Ok(serde_json::from_str(&text).map_err(damaged)?)
}
