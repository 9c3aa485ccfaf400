//! A run's folder: the names of its files, who may write to it, and the order of writing, by which
//! nobody ever reads files of two runs.
//!
//! | file | is |
//! |---|---|
//! | `checkpoint.bin` | what `--resume` goes on with: all of it, in one file ([`super::Checkpoint`]) |
//! | `run.ron` | what is needed to repeat the run, and that it is whole ([`Run`]) |
//! | `front.json`, `front-max.json` | its fronts |
//! | `trace.csv`, `census.json` | how the search went on, what recurred in its formulas |
//! | `front.txt`, `snippets/`, pictures, `report.html` | what is made of the others |
//! | `data-….bin` | the samples of the function that it approximates, where that was no dataset |
//! | `lock` | while there is an owner: who it is |
//!
//! During a search only `checkpoint.bin` is written, always replaced whole, so a resumed run can be
//! read as it was until it ends anew. At the end all new files are first written beside the old
//! ones. Then `run.ron` and the files made of the old fronts are removed, and the new files are
//! moved into place, `run.ron` last. Whenever the process is killed, a folder with `run.ron` is a
//! whole run; one without it is a search that has not ended, and its checkpoint is whole. `run.ron`
//! lists the checksums of the files that are read with it, so that whoever reads during the
//! exchange gets an error.
//!
//! The lock is the operating system's, on an open file: it ends with the process, however that
//! ends. A file that is left behind means nothing.

use super::{Outcome, RecordError, Run, Trace, snippet};
use crate::dataset::Dataset;
use crate::emit::Language;
use crate::file::{StagedFile, TEMPORARY, remove_file, replace_file};
use crate::fit::Measure;
use crate::search::Front;
use std::ffi::OsStr;
use std::fs::{File, TryLockError};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// The record of a run.
pub(crate) const RUN: &str = "run.ron";
/// The state of a search that has not ended.
pub const CHECKPOINT: &str = "checkpoint.bin";
/// The front in the measure that was searched for.
pub const FRONT: &str = "front.json";
/// The front in maximum error.
pub(crate) const MINIMAX_FRONT: &str = "front-max.json";
/// The progress of the search.
pub(crate) const TRACE: &str = "trace.csv";
/// What recurs in its formulas.
pub(crate) const CENSUS: &str = "census.json";
/// The beginning of the name of a dataset that is kept with a run.
const DATA: &str = "data-";
const LOCK: &str = "lock";
const SNIPPETS: &str = "snippets";
/// The front as a table.
pub const FRONT_TABLE: &str = "front.txt";

/// The files of a page, tables and pictures of a run.
const MADE_OF_IT: [&str; 11] = [
    FRONT_TABLE,
    "front.svg",
    "front-dark.svg",
    "front.png",
    "convergence.svg",
    "convergence-dark.svg",
    "convergence.png",
    "maps.png",
    "maps-dark.png",
    "spheres.png",
    "report.html",
];

/// The largest text file that is read, in bytes: a bound on memory where the file is no run's.
const MAX_BYTES: u64 = 256 << 20;

/// The contents of a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holding {
    /// No run; perhaps other files.
    NoRun,
    /// A search that has not ended.
    Unfinished,
    /// A search or a union of searches.
    Finished,
}

impl Holding {
    /// Looks at the files of a folder, which need not exist.
    pub fn of(folder: &Path) -> Holding {
        let holds = |file: &str| folder.join(file).exists();
        match (holds(RUN), holds(FRONT), holds(CHECKPOINT)) {
            (true, true, _) => Holding::Finished,
            (false, false, false) => Holding::NoRun,
            _ => Holding::Unfinished,
        }
    }
}

/// Returns a file that is called as a run's files are in a folder that holds no run, and so is in
/// the way of one.
pub fn in_the_way(folder: &Path) -> Option<String> {
    let names = MADE_OF_IT.into_iter().chain(IDENTIFIED);
    let mut there = names.filter(|file| folder.join(file).exists()).map(str::to_owned);
    there.next().or_else(|| snippets_in(folder).into_iter().next())
}

/// A run's folder that this process alone may write to.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    _lock: Lock,
}

impl Outcome {
    /// Returns the run's files by name, without `run.ron`.
    pub(super) fn files(&self) -> Vec<(String, Vec<u8>)> {
        let mut files = front_files(&self.run, &self.front, &self.minimax);
        files.push((TRACE.to_owned(), self.trace.clone().into_bytes()));
        files.push((CENSUS.to_owned(), self.census.to_json().into_bytes()));
        files
    }
}

/// Returns the files of both fronts: as they are read again, and as functions to paste.
pub fn front_files(run: &Run, front: &Front, minimax: &Front) -> Vec<(String, Vec<u8>)> {
    let names = run.names();
    let mut files = vec![
        (FRONT.to_owned(), front.to_json(&names)),
        (MINIMAX_FRONT.to_owned(), minimax.to_json(&names)),
    ];
    for (i, member) in front.members.iter().enumerate() {
        files.extend(Language::OF_RUNS.iter().map(|&language| {
            let file = format!("{SNIPPETS}/{:02}.{}", i + 1, language.extension());
            (file, snippet(run, member, language))
        }));
    }
    files.into_iter().map(|(file, text)| (file, text.into_bytes())).collect()
}

impl Folder {
    /// Makes the folder if there is none, becomes its owner, and removes what a killed process has
    /// left half-written.
    ///
    /// # Errors
    /// [`RecordError::Busy`] if it has an owner; [`RecordError::Unwritable`].
    pub fn claim(path: &Path) -> Result<Folder, RecordError> {
        std::fs::create_dir_all(path).map_err(unwritable(path))?;
        let folder = Folder { path: path.to_owned(), _lock: Lock::take(path)? };
        folder.sweep();
        StagedFile::new(&path.join(RUN), b"").map_err(unwritable(path))?;
        Ok(folder)
    }

    /// Returns the folder's path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Keeps a dataset beside the run that is made of it, under a name that no other has, so that
    /// what is there stays whole; returns its path from the folder, as the run notes it.
    /// [`Folder::exchange`] removes it when another run takes the place of its own.
    ///
    /// # Errors
    /// [`RecordError::Unwritable`], or a dataset that is none.
    pub fn keep_data(&self, dataset: &Dataset) -> Result<PathBuf, RecordError> {
        let name = PathBuf::from(format!("{DATA}{}.bin", &dataset.hash()[..12]));
        let path = self.path.join(&name);
        let bytes = dataset.to_bytes(&path).map_err(|error| {
            let reason = std::io::Error::other(error.to_string());
            RecordError::Unwritable { path: path.clone(), reason }
        })?;
        replace_file(&path, &bytes).map_err(unwritable(&path))?;
        Ok(name)
    }

    /// Replaces the checkpoint.
    ///
    /// # Errors
    /// [`RecordError::Unwritable`].
    pub fn checkpoint(&self, bytes: &[u8]) -> Result<(), RecordError> {
        let path = self.path.join(CHECKPOINT);
        replace_file(&path, bytes).map_err(unwritable(&path))
    }

    /// Removes the run that is there, and nothing else, beginning with the file that says that it
    /// is whole; then writes the checkpoint of another.
    ///
    /// # Errors
    /// [`RecordError::Unwritable`]: if the checkpoint could not be written, all is as it was.
    pub(crate) fn begin_anew(&self, checkpoint: &[u8]) -> Result<(), RecordError> {
        let snippets = snippets_in(&self.path);
        let path = self.path.join(CHECKPOINT);
        let staged = StagedFile::new(&path, checkpoint).map_err(unwritable(&path))?;
        self.remove([RUN])?;
        self.remove(MADE_OF_IT.into_iter().chain(snippets.iter().map(String::as_str)))?;
        self.remove(IDENTIFIED)?;
        staged.put_in_place().map_err(unwritable(&path))
    }

    /// Exchanges the run's files for others, which are all written first: `files` by name, and
    /// `run.ron`. What was made of the old ones and is not written again is removed.
    ///
    /// # Errors
    /// [`RecordError::Unwritable`]: if a file could not be written, all are as they were; if one
    /// could not be removed or put in its place, the folder holds no finished run.
    pub fn exchange(&self, run: &Run, files: &[(String, Vec<u8>)]) -> Result<(), RecordError> {
        let snippets = snippets_in(&self.path);
        let mut run = run.clone();
        let read_with_it = files.iter().filter(|(file, _)| IDENTIFIED.contains(&file.as_str()));
        run.files = read_with_it.map(|(file, bytes)| (file.clone(), checksum(bytes))).collect();
        let stage = |file: &str, bytes: &[u8]| {
            let path = self.path.join(file);
            self.make_folder_of(&path)?;
            StagedFile::new(&path, bytes).map_err(unwritable(&path))
        };
        let staged: Result<Vec<StagedFile>, RecordError> =
            files.iter().map(|(file, bytes)| stage(file, bytes)).collect();
        let (staged, last) = (staged?, stage(RUN, run.to_ron().as_bytes())?);
        self.remove([RUN])?;
        let written = |file: &&str| files.iter().any(|(written, _)| written == file);
        let old =
            MADE_OF_IT.into_iter().chain(snippets.iter().map(String::as_str)).chain(IDENTIFIED);
        self.remove(old.filter(|file| !written(file)))?;
        for file in staged.into_iter().chain([last]) {
            let path = file.path().to_owned();
            file.put_in_place().map_err(unwritable(&path))?;
        }
        let kept = run.dataset.file_name();
        let files = self.path.read_dir().into_iter().flatten().flatten();
        let stale = files.map(|file| file.path()).filter(|path| is_data(path));
        stale.filter(|path| path.file_name() != kept).for_each(|path| drop(remove_file(&path)));
        Ok(())
    }

    fn remove<'a>(&self, files: impl IntoIterator<Item = &'a str>) -> Result<(), RecordError> {
        for file in files {
            let path = self.path.join(file);
            remove_file(&path).map_err(unwritable(&path))?;
        }
        Ok(())
    }

    /// Makes the folder that a file goes into; refuses a link, which could lead out of the run's
    /// folder.
    fn make_folder_of(&self, path: &Path) -> Result<(), RecordError> {
        let folder = path.parent().unwrap_or(&self.path);
        if folder != self.path && folder.is_symlink() {
            let reason = std::io::Error::other("it is a link to elsewhere");
            return Err(unwritable(folder)(reason));
        }
        std::fs::create_dir_all(folder).map_err(unwritable(folder))
    }

    /// Removes temporaries: none is in use, since nobody else is the owner.
    fn sweep(&self) {
        let folders = [self.path.clone(), self.path.join(SNIPPETS)];
        for folder in folders.iter().filter(|folder| !folder.is_symlink()) {
            let files = folder.read_dir().into_iter().flatten().flatten();
            let names = files.map(|file| (file.file_name(), file.path()));
            let temporaries =
                names.filter(|(name, _)| name.to_string_lossy().starts_with(TEMPORARY));
            temporaries.for_each(|(_, path)| drop(remove_file(&path)));
        }
    }
}

/// Returns true for a file as [`Folder::keep_data`] names them.
fn is_data(path: &Path) -> bool {
    let name = path.file_name().and_then(OsStr::to_str).unwrap_or_default();
    let hash = name.strip_prefix(DATA).and_then(|name| name.strip_suffix(".bin"));
    hash.is_some_and(|hash| hash.len() == 12 && hash.bytes().all(|byte| byte.is_ascii_hexdigit()))
}

/// Lists what runs have written to a folder's `snippets`, and nothing else.
fn snippets_in(folder: &Path) -> Vec<String> {
    let part = |part: Option<&OsStr>| part.and_then(OsStr::to_str).unwrap_or_default().to_owned();
    let is_ours = |path: &Path| {
        let (stem, extension) = (part(path.file_stem()), part(path.extension()));
        stem.len() >= 2
            && stem.bytes().all(|byte| byte.is_ascii_digit())
            && Language::OF_RUNS.iter().any(|language| language.extension() == extension)
    };
    let folder = folder.join(SNIPPETS);
    if folder.is_symlink() {
        return Vec::new();
    }
    let files = folder.read_dir().into_iter().flatten().flatten();
    let ours = files.map(|file| file.path()).filter(|path| is_ours(path));
    ours.map(|path| format!("{SNIPPETS}/{}", part(path.file_name()))).collect()
}

/// The files that are read together with `run.ron`.
const IDENTIFIED: [&str; 4] = [FRONT, MINIMAX_FRONT, TRACE, CENSUS];

fn checksum(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().as_str()[..16].to_owned()
}

/// Reads the run of a folder.
///
/// # Errors
/// If the folder holds none, it has not ended, or it is not what a search writes.
pub fn load_run(folder: &Path) -> Result<Run, RecordError> {
    if !folder.exists() {
        return Err(RecordError::NoFolder { path: folder.into() });
    }
    match Holding::of(folder) {
        Holding::Finished => Run::load(folder),
        Holding::Unfinished if folder.join(CHECKPOINT).exists() => {
            Err(RecordError::Unfinished { path: folder.into() })
        }
        _ => Err(RecordError::NoRun { path: folder.into() }),
    }
}

/// Reads a front of a folder's run: the one in maximum error, or the one that was searched for.
///
/// # Errors
/// If it cannot be read, or is not the run's.
pub fn load_front(folder: &Path, run: &Run, minimax: bool) -> Result<Front, RecordError> {
    let (file, measure) = match minimax {
        true => (MINIMAX_FRONT, Measure::Max),
        false => (FRONT, run.goal.measure),
    };
    let text = load_text(folder, run, file)?.ok_or_else(|| RecordError::Unreadable {
        path: folder.join(file),
        reason: std::io::ErrorKind::NotFound.into(),
    })?;
    Front::parse(&folder.join(file), &text, run, measure)
}

/// Reads the trace of a folder's run; none if it was not recorded.
///
/// # Errors
/// If it cannot be read, or is not the run's.
pub fn load_trace(folder: &Path, run: &Run) -> Result<Option<Trace>, RecordError> {
    let Some(text) = load_text(folder, run, TRACE)? else { return Ok(None) };
    let damaged = |(line, reason)| RecordError::Damaged { path: folder.join(TRACE), line, reason };
    Ok(Some(Trace::parse(&text).map_err(damaged)?))
}

/// Reads a text file that goes with a run; none if there is no such file.
///
/// # Errors
/// If it cannot be read, or is not the one that the run was written with.
pub(crate) fn load_text(
    folder: &Path,
    run: &Run,
    file: &str,
) -> Result<Option<String>, RecordError> {
    let path = folder.join(file);
    if !path.exists() && !run.files.contains_key(file) {
        return Ok(None);
    }
    let text = read(&path)?;
    match run.files.get(file) {
        Some(known) if *known != checksum(text.as_bytes()) => {
            Err(RecordError::OfAnotherRun { path })
        }
        _ => Ok(Some(text)),
    }
}

/// Reads a text file, which must not be too large.
pub(super) fn read(path: &Path) -> Result<String, RecordError> {
    let bytes = read_bytes(path, MAX_BYTES)?;
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        RecordError::Damaged {
            path: path.into(),
            line: 1 + valid.iter().filter(|byte| **byte == b'\n').count(),
            reason: "not text in UTF-8".into(),
        }
    })
}

pub(super) fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>, RecordError> {
    let unreadable = |reason| RecordError::Unreadable { path: path.into(), reason };
    let file = File::open(path).map_err(unreadable)?;
    if !file.metadata().map_err(unreadable)?.is_file() {
        return Err(unreadable(std::io::Error::other("it is not a file")));
    }
    let mut bytes = Vec::new();
    file.take(most + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    match bytes.len() as u64 <= most {
        true => Ok(bytes),
        false => {
            let reason = format!("it has more than {} MiB, which no run leaves", most >> 20);
            Err(unreadable(std::io::Error::other(reason)))
        }
    }
}

pub(super) fn unwritable(path: &Path) -> impl FnOnce(std::io::Error) -> RecordError {
    let path = path.to_owned();
    move |reason| RecordError::Unwritable { path, reason }
}

/// A folder's lock.
#[derive(Debug)]
struct Lock {
    path: PathBuf,
    /// The locked file; none if the file system has no locks.
    file: Option<File>,
}

impl Lock {
    fn take(folder: &Path) -> Result<Lock, RecordError> {
        let path = folder.join(LOCK);
        loop {
            if path.symlink_metadata().is_ok_and(|known| !known.is_file()) {
                let reason = std::io::Error::other("it is not a file; remove it");
                return Err(unwritable(&path)(reason));
            }
            let mut options = File::options();
            let file = options.read(true).write(true).create(true).truncate(false).open(&path);
            let file = file.map_err(unwritable(&path))?;
            match file.try_lock() {
                Ok(()) if is_at(&file, &path) => {
                    introduce(&file);
                    return Ok(Lock { path, file: Some(file) });
                }
                // The previous owner has removed the file in between.
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    let owner = described(&std::fs::read_to_string(&path).unwrap_or_default());
                    return Err(RecordError::Busy { path: folder.into(), owner });
                }
                Err(TryLockError::Error(_)) => return Ok(Lock { path, file: None }),
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Removed before it is unlocked, so that it is no other's.
        if self.file.is_some() {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

/// Writes the owner into the lock, for messages only.
fn introduce(mut file: &File) {
    let text = format!("{} {}\n", std::process::id(), now().as_secs());
    let _ = file.set_len(0).and_then(|()| file.write_all(text.as_bytes()));
}

/// Describes an owner as `process 1234, for 12 s`, as far as it is known.
fn described(text: &str) -> String {
    let mut words = text.split_whitespace().map_while(|word| word.parse::<u64>().ok());
    match (words.next(), words.next()) {
        (Some(process), Some(since)) => {
            format!("process {process}, for {} s", now().as_secs().saturating_sub(since))
        }
        _ => "another process".to_owned(),
    }
}

fn now() -> Duration {
    SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default()
}

/// Returns true if the file is still the one at the path.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |known: std::fs::Metadata| (known.dev(), known.ino());
    let there = path.symlink_metadata().map(identity);
    file.metadata().map(identity).is_ok_and(|own| there.is_ok_and(|there| own == there))
}

/// Returns true: there, an open file cannot be removed.
#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> bool {
    true
}
