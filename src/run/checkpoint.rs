//! `checkpoint.bin`: all that a search needs to go on, in one file, so that its parts are always of
//! one moment.
//!
//! A line of text says which program wrote it, as `LGPSTATE9 lgp 0.1.0`; then come the parts, in
//! postcard's encoding, and a checksum of all before it. The encoding does not describe itself, and
//! random streams and rules of a search may change between versions, so a checkpoint is read only
//! by the version that wrote it, and by [`LAYOUT`] alone.

use super::folder::read_bytes;
use super::{Census, Followed, RecordError, Run, Trace, trace_csv};
use crate::fit::Measure;
use crate::search::State;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The layout's number, raised whenever what is serialised of a search changes:
/// `tests/checkpoint.rs` tells.
const LAYOUT: u32 = 9;

const MAGIC: &str = "LGPSTATE";

/// The largest checkpoint that is read, in bytes: a bound on memory where the file is no
/// checkpoint.
const MAX_BYTES: u64 = 2 << 30;

/// The state of a search, and the record of its run so far.
#[derive(Clone, Debug)]
pub struct Checkpoint {
    /// The record of the run.
    pub run: Run,
    /// The state of the search.
    pub state: State,
    /// The text of `trace.csv` so far.
    pub trace: String,
    /// The census of its formulas so far.
    pub census: Census,
    /// The samples that follow it, if they do.
    pub followed: Option<Followed>,
}

/// The parts after the line of text; the run is RON, which can leave out and fill in fields.
#[derive(Serialize)]
struct Written<'a>(&'a str, &'a str, &'a Census, &'a State, Option<&'a Followed>);

#[derive(Deserialize)]
struct Read(String, String, Census, State, Option<Followed>);

fn first_line() -> String {
    format!("{MAGIC}{LAYOUT} lgp {}\n", env!("CARGO_PKG_VERSION"))
}

impl Checkpoint {
    /// Returns the content of `checkpoint.bin`; `trace` is the text of `trace.csv`.
    pub fn bytes(
        run: &Run,
        state: &State,
        trace: &str,
        census: &Census,
        followed: Option<&Followed>,
    ) -> Vec<u8> {
        let mut bytes = first_line().into_bytes();
        let body = Written(&run.to_ron(), trace, &census.clone().pruned(), state, followed);
        bytes.extend(postcard::to_allocvec(&body).expect("plain data"));
        let checksum = blake3::hash(&bytes);
        bytes.extend(checksum.as_bytes());
        bytes
    }

    /// Returns the content of the file that this was read from.
    pub fn to_bytes(&self) -> Vec<u8> {
        let Checkpoint { run, state, trace, census, followed } = self;
        Checkpoint::bytes(run, state, trace, census, followed.as_ref())
    }

    /// Reads the content of a `checkpoint.bin` at `path`, and checks all of it.
    ///
    /// # Errors
    /// If it is not whole, not of this version, or no search could have left it.
    pub fn from_bytes(path: &Path, bytes: &[u8]) -> Result<Checkpoint, RecordError> {
        let refuse = |reason: String| RecordError::Checkpoint { path: path.into(), reason };
        let Some((content, checksum)) = bytes.split_last_chunk::<32>() else {
            return Err(refuse("too short for a checkpoint; start the search anew".into()));
        };
        if !content.starts_with(MAGIC.as_bytes()) {
            return Err(refuse("not a checkpoint; start the search anew".into()));
        }
        if blake3::hash(content).as_bytes() != checksum {
            let reason = "damaged (its checksum does not match); start the search anew";
            return Err(refuse(reason.into()));
        }
        let Some(body) = content.strip_prefix(first_line().as_bytes()) else {
            let line = content.split(|&byte| byte == b'\n').next().unwrap_or_default();
            return Err(refuse(format!(
                "a checkpoint of another version ({}; this program reads {}); start the search anew",
                String::from_utf8_lossy(&line[..line.len().min(40)]).escape_debug(),
                first_line().trim_end()
            )));
        };
        let (Read(run, trace, census, state, followed), rest) =
            postcard::take_from_bytes(body).map_err(|error| refuse(error.to_string()))?;
        let checked = || -> Result<Run, String> {
            let run = Run::from_ron(&run).map_err(|(_, reason)| format!("its run: {reason}"))?;
            if !rest.is_empty() {
                return Err("there is more than its parts".into());
            }
            run.goal.check(run.inputs.len(), run.outputs.len())?;
            state.check(&run.goal, &run.method, &run.goal.shape(&run.names())?)?;
            census.check(run.inputs.len())?;
            check_trace(&trace, run.goal.measure)?;
            Ok(run)
        };
        let run =
            checked().map_err(|reason| refuse(format!("not what a search writes: {reason}")))?;
        Ok(Checkpoint { run, state, trace, census, followed })
    }

    /// Reads `checkpoint.bin` of a run's folder.
    ///
    /// # Errors
    /// Those of [`Checkpoint::from_bytes`], or of reading the file.
    pub fn load(folder: &Path) -> Result<Checkpoint, RecordError> {
        let path = folder.join(super::folder::CHECKPOINT);
        Checkpoint::from_bytes(&path, &read_bytes(&path, MAX_BYTES)?)
    }
}

/// Checks that a trace is empty, or has the header that its next lines need.
fn check_trace(trace: &str, measure: Measure) -> Result<(), String> {
    if trace.is_empty() {
        return Ok(());
    }
    if !trace.starts_with(&trace_csv(&[], measure)) {
        return Err("its trace has another header".into());
    }
    Trace::parse(trace)
        .map(|_| ())
        .map_err(|(line, reason)| format!("its trace, line {line}: {reason}"))
}
