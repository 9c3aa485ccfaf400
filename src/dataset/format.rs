//! The `.bin` file: magic `LGPDATA1`, the header's length (u32, little-endian), the header in RON,
//! the columns as little-endian f32 (search columns, weights, dead zones and standard errors, then
//! the validation split's), and the 32-byte blake3 checksum of everything before it.

use super::{Column, Dataset, Error, LARGEST_FILE, Origin, Split};
use crate::file::{read_file, replace_file};
use ron::extensions::Extensions;
use serde::{Deserialize, Serialize};
use std::path::Path;

const MAGIC: &[u8; 8] = b"LGPDATA1";
const VERSION: u32 = 2;
const CHECKSUM: usize = 32;
const PREFIX: usize = MAGIC.len() + 4;

#[derive(Serialize, Deserialize)]
struct Header {
    version: u32,
    name: String,
    /// The origin in version 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    recipe: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    origin: Option<Origin>,
    inputs: Vec<Column>,
    outputs: Vec<Column>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    claims: Vec<String>,
    search: SplitHeader,
    validation: SplitHeader,
}

#[derive(Serialize, Deserialize)]
struct SplitHeader {
    rows: u64,
    weighted: bool,
    /// True if each output has a column of its dead zone.
    #[serde(alias = "free", default, skip_serializing_if = "std::ops::Not::not")]
    dead_zone: bool,
    /// True if each output has a column of standard errors.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    standard_errors: bool,
    grid: Vec<usize>,
}

impl SplitHeader {
    /// Columns beside inputs and outputs.
    fn beside(&self, outputs: usize) -> u128 {
        let by_output = u128::from(self.dead_zone) + u128::from(self.standard_errors);
        u128::from(self.weighted) + by_output * outputs as u128
    }
}

#[derive(Deserialize)]
struct VersionOnly {
    version: u32,
}

impl Dataset {
    /// Reads a `.bin` file.
    ///
    /// # Errors
    /// A file that is missing, empty, not a dataset, of another version, larger than
    /// [`LARGEST_FILE`], truncated, too long or damaged, or whose content [`Dataset::validate`]
    /// refuses. No allocation trusts an unverified header.
    pub fn load(path: &Path) -> Result<Dataset, Error> {
        let bytes = read_file(path, LARGEST_FILE).map_err(|source| Error::unread(path, source))?;
        Dataset::parse(path, &bytes)
    }

    /// Parses the bytes of a `.bin` file; errors name `path`.
    ///
    /// # Errors
    /// As [`Dataset::load`], about the content.
    pub fn parse(path: &Path, bytes: &[u8]) -> Result<Dataset, Error> {
        let dataset = parse(path, bytes)?;
        dataset.validate_as(path)?;
        Ok(dataset)
    }

    /// Writes a `.bin` file, replacing an old one as a whole.
    ///
    /// # Errors
    /// A dataset that [`Dataset::validate`] refuses, or a file that cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), Error> {
        let bytes = self.to_bytes(path)?;
        replace_file(path, &bytes).map_err(|source| Error::Io {
            path: path.into(),
            action: "written",
            source,
        })
    }

    /// Returns 16 hexadecimal digits, equal for equal names, columns and rows, whatever their
    /// origin and claims.
    pub fn hash(&self) -> String {
        self.hash_with(&self.header(0, None, None, &[]))
    }

    /// Returns true if a record's hash is that of this data; earlier versions recorded the hash of
    /// a file of version 1.
    pub fn has_hash(&self, hash: &str) -> bool {
        let version_1 = || self.header(1, Some(self.origin.to_string()), None, &[]);
        hash == self.hash() || hash == self.hash_with(&version_1())
    }

    fn hash_with(&self, header: &str) -> String {
        blake3::hash(&self.content(header)).to_hex().as_str()[..16].to_owned()
    }

    /// Returns the bytes of the `.bin` file; errors name `path`.
    ///
    /// # Errors
    /// A dataset that [`Dataset::validate`] refuses.
    pub fn to_bytes(&self, path: &Path) -> Result<Vec<u8>, Error> {
        self.validate_as(path)?;
        let header = self.header(VERSION, None, Some(self.origin.clone()), &self.claims);
        if u32::try_from(header.len()).is_err() {
            let problem = "names and origin are longer than 4 GiB".into();
            return Err(Error::Header { path: path.into(), problem });
        }
        let mut bytes = self.content(&header);
        let checksum = blake3::hash(&bytes);
        bytes.extend_from_slice(checksum.as_bytes());
        Ok(bytes)
    }

    fn header(
        &self,
        version: u32,
        recipe: Option<String>,
        origin: Option<Origin>,
        claims: &[String],
    ) -> String {
        let split = |split: &Split| SplitHeader {
            rows: split.rows() as u64,
            weighted: !split.weights.is_empty(),
            dead_zone: !split.dead_zone.is_empty(),
            standard_errors: !split.standard_errors.is_empty(),
            grid: split.grid.clone(),
        };
        let header = Header {
            version,
            name: self.name.clone(),
            recipe,
            origin,
            inputs: self.inputs.clone(),
            outputs: self.outputs.clone(),
            claims: claims.to_vec(),
            search: split(&self.search),
            validation: split(&self.validation),
        };
        notation().to_string(&header).expect("plain data")
    }

    fn content(&self, header: &str) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend_from_slice(&(header.len() as u32).to_le_bytes());
        bytes.extend_from_slice(header.as_bytes());
        for split in [&self.search, &self.validation] {
            let beside =
                [&split.weights].into_iter().chain(&split.dead_zone).chain(&split.standard_errors);
            for column in split.columns.iter().chain(beside) {
                bytes.extend(column.iter().flat_map(|value| value.to_le_bytes()));
            }
        }
        bytes
    }
}

fn parse(path: &Path, bytes: &[u8]) -> Result<Dataset, Error> {
    let found = bytes.len() as u64;
    if bytes.is_empty() {
        return Err(Error::Empty { path: path.into() });
    }
    let start = &bytes[..bytes.len().min(MAGIC.len())];
    if !MAGIC.starts_with(start) {
        return Err(Error::Magic { path: path.into() });
    }
    let length = bytes.get(MAGIC.len()..PREFIX).and_then(|b| <[u8; 4]>::try_from(b).ok());
    let Some(length) = length.map(u32::from_le_bytes) else {
        let expected = (PREFIX + CHECKSUM) as u64;
        return Err(Error::Truncated { path: path.into(), expected, found });
    };
    let body = PREFIX as u64 + u64::from(length);
    let least = body + CHECKSUM as u64;
    if found < least {
        return Err(Error::Truncated { path: path.into(), expected: least, found });
    }
    let (content, checksum) = bytes.split_at(bytes.len() - CHECKSUM);
    let intact = blake3::hash(content).as_bytes() == checksum;
    let body = PREFIX + length as usize;
    let (header, origin) = read_header(path, &content[PREFIX..body], intact)?;
    check_length(path, &header, body, found, intact)?;
    if !intact {
        return Err(Error::Checksum { path: path.into() });
    }
    Ok(assemble(header, origin, &content[body..]))
}

fn read_header(path: &Path, bytes: &[u8], intact: bool) -> Result<(Header, Origin), Error> {
    // An unreadable header in a damaged file is only a symptom.
    let unusable = |problem: String| match intact {
        true => Error::Header { path: path.into(), problem },
        false => Error::Checksum { path: path.into() },
    };
    let text = std::str::from_utf8(bytes).map_err(|error| unusable(error.to_string()))?;
    let VersionOnly { version } =
        ron::from_str(text).map_err(|error| unusable(error.to_string()))?;
    if !(1..=VERSION).contains(&version) {
        return Err(Error::Version { path: path.into(), found: version, supported: VERSION });
    }
    let mut header: Header =
        notation().from_str(text).map_err(|error| unusable(error.to_string()))?;
    let origin = match version {
        1 => header.recipe.as_deref().map(Origin::of_text),
        _ => header.origin.take(),
    };
    let origin =
        origin.ok_or_else(|| unusable("it does not say where the rows come from".into()))?;
    Ok((header, origin))
}

/// The notation of headers: an optional value is written as it is, or not at all.
fn notation() -> ron::Options {
    ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME)
}

fn check_length(
    path: &Path,
    header: &Header,
    body: usize,
    found: u64,
    intact: bool,
) -> Result<(), Error> {
    let columns = (header.inputs.len() + header.outputs.len()) as u128;
    let outputs = header.outputs.len();
    let values = |split: &SplitHeader| u128::from(split.rows) * (columns + split.beside(outputs));
    let values = values(&header.search) + values(&header.validation);
    let expected = (body + CHECKSUM) as u128 + 4 * values;
    if expected == u128::from(found) {
        return Ok(());
    }
    if intact {
        let problem = format!("it promises {expected} bytes, but the file has {found}");
        return Err(Error::Header { path: path.into(), problem });
    }
    match u64::try_from(expected) {
        Ok(expected) if expected < found => {
            Err(Error::Trailing { path: path.into(), extra: found - expected })
        }
        Ok(expected) => Err(Error::Truncated { path: path.into(), expected, found }),
        Err(_) => Err(Error::Checksum { path: path.into() }),
    }
}

/// Cuts the body, whose length has been checked, into columns.
fn assemble(header: Header, origin: Origin, body: &[u8]) -> Dataset {
    let columns = header.inputs.len() + header.outputs.len();
    let outputs = header.outputs.len();
    let mut words = body.as_chunks::<4>().0.iter().map(|&word| f32::from_le_bytes(word));
    let mut split = |split: SplitHeader| {
        let rows = split.rows as usize;
        let mut column = || words.by_ref().take(rows).collect::<Vec<f32>>();
        Split {
            columns: (0..columns).map(|_| column()).collect(),
            weights: if split.weighted { column() } else { Vec::new() },
            dead_zone: (0..if split.dead_zone { outputs } else { 0 }).map(|_| column()).collect(),
            standard_errors: (0..if split.standard_errors { outputs } else { 0 })
                .map(|_| column())
                .collect(),
            grid: split.grid,
        }
    };
    Dataset {
        search: split(header.search),
        validation: split(header.validation),
        name: header.name,
        origin,
        inputs: header.inputs,
        outputs: header.outputs,
        claims: header.claims,
    }
}
