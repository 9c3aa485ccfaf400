//! Textures, lookup tables and arrays of numbers as ground truths.
//!
//! [`read`] makes an [`Array`] of a file, by what it begins with or its extension; [`Layout`] names its
//! axes and channels and makes a dataset of it. Each family of formats is a file of this module and a
//! row of the table of formats.
//!
//! ```
//! use lgp::import::array::{Layout, Request, parse};
//!
//! let text = b"const float ramp[2][3] = { { 0.0f, 0.1f, 0.2f }, { 0.5f, 0.6f, 0.7f } };";
//! let request = Request { axes: Some(2), ..Request::default() };
//! let array = parse("ramp.h".as_ref(), text, &request)?.expect("sources are read");
//! assert_eq!(array.size, [3, 2]);
//! let layout = Layout { axes: "x=0..3,y=0..2".parse()?, ..Layout::default() };
//! let (data, _) = layout.dataset("ramp.h".as_ref(), &array)?;
//! let [x, y, value] = [0, 1, 2].map(|column| &data.search.columns[column]);
//! assert_eq!((x[1], y[1], value[1]), (0.5, 1.5, 0.5));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axes;
mod bytes;
mod channels;
mod cube;
mod dds;
mod error;
mod exr;
mod grid;
mod hdr;
mod ktx2;
mod layout;
mod list;
mod npy;
mod npz;
mod png;
mod raw;
mod scalar;
mod shape;
mod source;
mod spi;
mod texels;
mod text;
mod tokens;

pub use axes::{AxisName, AxisNames};
pub use channels::{ChannelName, ChannelNames};
pub use error::{Error, Fault};
pub use exr::to_exr;
pub use layout::Layout;
pub use npy::to_npy;
pub use scalar::Scalar;

use crate::dataset::LARGEST_FILE;
use crate::file::read_file;
use crate::printable::printable;
use crate::suggest::nearest;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// The most texels of an array. By hand: a texture of 4096², whose import takes seconds and 1.2 GB.
pub const MOST_TEXELS: usize = 1 << 24;
/// The most values of all texels and channels: 256 MiB of them.
pub const MOST_VALUES: usize = 1 << 26;

/// Numbers on a regular grid of texels, as a file has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Array {
    /// The kind of file, for a person: `PNG, 16 bits`.
    pub kind: String,
    /// The texels along each axis, the first varying fastest: x, y, z of a texture. No axis has only
    /// one texel, so that a single texel has no axes.
    pub size: Vec<usize>,
    /// The channels' names in the file.
    pub channels: Vec<String>,
    /// The values, texel after texel, a texel's channels together.
    pub values: Vec<f32>,
    /// The names and the ends of the axes, if the file says them.
    pub axes: Vec<FileAxis>,
    /// Whether the first and the last texels are at the ends of the axes, as those of lookup tables
    /// are, and not half a texel inside.
    pub corners: bool,
    /// Whether rows run from the top of a picture.
    pub is_picture: bool,
    /// Whether values are integers that stand for 0 to 1, and so may be encoded as sRGB.
    pub is_unorm: bool,
    /// What else a person should know of how the file was read.
    pub notes: Vec<String>,
}

/// An axis as a file describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct FileAxis {
    /// An identifier.
    pub name: String,
    /// Its value at the first and at the last texel's outer ends, or at their centres
    /// ([`Array::corners`]).
    pub ends: [f64; 2],
}

/// What is said of a file beside its content. What a kind of files has no use for is refused, except
/// the number of axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// The kind of numbers of a file without a header. For a source file whose numbers are
    /// integers, [`Scalar::F16`] makes halves of their bits.
    pub format: Option<Scalar>,
    /// Whether numbers without a header have their high bytes first.
    pub big_endian: bool,
    /// The texels along x, y, z, then the channels, of numbers that have no shape or another.
    pub size: Option<Vec<usize>>,
    /// Which array of a file that holds several.
    pub array: Option<String>,
    /// The number of axes, if they are named: tells axes from channels.
    pub axes: Option<usize>,
    /// Whether to decode 8-bit and 16-bit integers from sRGB.
    pub srgb: bool,
}

impl Request {
    /// Returns the options of the command line that give it.
    fn options(&self) -> impl Iterator<Item = &'static str> {
        let given = [
            self.size.is_some(),
            self.format.is_some(),
            self.big_endian,
            self.array.is_some(),
            self.srgb,
        ];
        ALL.iter().copied().zip(given).filter_map(|(option, given)| given.then_some(option))
    }
}

/// What is done with a kind of files.
enum Reading {
    /// They are read.
    By(fn(&[u8], &Request) -> Result<Array, Fault>),
    /// They are refused, with this advice.
    Refused(&'static str),
}

/// A kind of files.
struct Format {
    name: &'static str,
    extensions: &'static [&'static str],
    /// What such files begin with, one or the other; empty if anything.
    magic: &'static [&'static [u8]],
    reading: Reading,
    /// The options of the command line that say something of such files.
    takes: &'static [&'static str],
}

const LOSSY: &str = "its values are not exact: save the original as PNG or EXR";
const ALL: &[&str] = &["--size", "--format", "--big-endian", "--array", "--srgb"];
const AS_PNG: &str = "save it as PNG (integers) or EXR (floats)";

/// All kinds of files that are known, in the order in which they are tried.
#[rustfmt::skip]
static FORMATS: [Format; 17] = [
    read_by("PNG", &["png"], &[b"\x89PNG\r\n\x1a\n"], png::read, &["--srgb"]),
    read_by("OpenEXR", &["exr"], &[b"\x76\x2f\x31\x01"], exr::read, &["--array"]),
    read_by("Radiance HDR", &["hdr", "rgbe"], &[b"#?RADIANCE", b"#?RGBE"], hdr::read, &[]),
    read_by("DDS", &["dds"], &[b"DDS "], dds::read, &["--srgb"]),
    read_by("KTX2", &["ktx2"], &[b"\xabKTX 20\xbb\r\n\x1a\n"], ktx2::read, &["--srgb"]),
    read_by("NPY", &["npy"], &[b"\x93NUMPY"], npy::read, &["--size"]),
    read_by("NPZ", &["npz"], &[b"PK\x03\x04", b"PK\x05\x06"], npz::read, &["--size", "--array"]),
    read_by("SPI 1D", &["spi1d"], &[], spi::read_1d, &[]),
    read_by("SPI 3D", &["spi3d"], &[], spi::read_3d, &[]),
    read_by("cube", &["cube"], &[], cube::read, &[]),
    read_by("raw", &["raw", "f32", "f16"], &[], raw::read, &["--size", "--format", "--big-endian"]),
    read_by("source", source::EXTENSIONS, &[], source::read, &["--size", "--format", "--array"]),
    refused("KTX 1", &["ktx"], &[b"\xabKTX 11\xbb"], "convert it to KTX2 or EXR"),
    refused("JPEG", &["jpg", "jpeg"], &[b"\xff\xd8\xff"], LOSSY),
    refused("TIFF", &["tif", "tiff"], &[b"II*\0", b"MM\0*"], AS_PNG),
    refused("GIF, WebP or BMP", &["gif", "webp", "bmp"], &[b"GIF8"], AS_PNG),
    refused("TGA or PSD", &["tga", "psd"], &[b"8BPS"], AS_PNG),
];

const fn read_by(
    name: &'static str,
    extensions: &'static [&'static str],
    magic: &'static [&'static [u8]],
    read: fn(&[u8], &Request) -> Result<Array, Fault>,
    takes: &'static [&'static str],
) -> Format {
    Format { name, extensions, magic, reading: Reading::By(read), takes }
}

const fn refused(
    name: &'static str,
    extensions: &'static [&'static str],
    magic: &'static [&'static [u8]],
    advice: &'static str,
) -> Format {
    Format { name, extensions, magic, reading: Reading::Refused(advice), takes: ALL }
}

/// Reads an array from a file of at most 1 GiB; `None` if the file is no array as far as its first
/// bytes, its extension and the request say.
///
/// # Errors
/// [`Error`]: a file that cannot be read, is not what it is named as, is damaged or of a kind that is
/// not read; more texels than [`MOST_TEXELS`] or values than [`MOST_VALUES`], before they are decoded;
/// no texels; several arrays, none of them asked for; values that 32-bit floats do not hold.
pub fn read(path: &Path, request: &Request) -> Result<Option<Array>, Error> {
    let unread = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => Fault::Missing.of(path),
        _ => Fault::Unread(error).of(path),
    };
    let mut start = Vec::new();
    if path.is_file() {
        File::open(path).and_then(|file| file.take(16).read_to_end(&mut start)).map_err(unread)?;
    }
    if format_of(path, &start, request).is_none() {
        return Ok(None);
    }
    parse(path, &read_file(path, LARGEST_FILE).map_err(unread)?, request)
}

/// Reads an array from the content of a file, as [`read`] does; errors name `path`.
///
/// # Errors
/// As [`read`], about the content.
pub fn parse(path: &Path, content: &[u8], request: &Request) -> Result<Option<Array>, Error> {
    let Some(format) = format_of(path, content, request) else { return Ok(None) };
    if content.is_empty() {
        return Err(Fault::Empty.of(path));
    }
    let is_read = matches!(format.reading, Reading::By(_));
    if is_read && !format.magic.is_empty() && !begins_as(format, content) {
        return Err(Fault::Magic { format: format.name }.of(path));
    }
    if let Some(option) = request.options().find(|option| !format.takes.contains(option)) {
        let problem = format!("{option} says nothing of {} files", format.name);
        return Err(Fault::new(problem, "leave it out").of(path));
    }
    let read = match format.reading {
        Reading::By(read) => read(content, request),
        Reading::Refused(advice) => {
            Err(Fault::new(format!("{} files are not read", format.name), advice))
        }
    };
    let decoded =
        read.and_then(|array| if request.srgb { array.decoded_from_srgb() } else { Ok(array) });
    decoded.map(Some).map_err(|fault| fault.of(path))
}

/// Returns the kind of a file: what its first bytes say, else its extension, else the request.
fn format_of(path: &Path, start: &[u8], request: &Request) -> Option<&'static Format> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let named = |name: &str| FORMATS.iter().find(|format| format.extensions.contains(&name));
    let by_content = FORMATS.iter().find(|format| begins_as(format, start));
    by_content.or_else(|| named(&extension)).or_else(|| match request {
        Request { array: Some(_), .. } => named("h"),
        Request { format: Some(_), .. } | Request { size: Some(_), .. } => named("raw"),
        _ => None,
    })
}

fn begins_as(format: &Format, content: &[u8]) -> bool {
    format.magic.iter().any(|magic| content.starts_with(magic))
}

/// The fault of a file of several arrays of which none is asked for, or one that it does not hold.
fn which_array(what: &str, names: &[String], request: &Request) -> Fault {
    // More would fill the screen.
    let shown: Vec<String> =
        names.iter().take(12).map(|name| printable(name).into_owned()).collect();
    let rest = if names.len() > shown.len() { ", …" } else { "" };
    let held = format!("{}{rest}", shown.join(", "));
    match &request.array {
        Some(asked) => {
            let near = nearest(asked, names.iter().map(String::as_str));
            let near = near.map(|near| format!(" (did you mean `{}`?)", printable(near)));
            let problem = format!("it holds no `{}`{}", printable(asked), near.unwrap_or_default());
            Fault::new(problem, format!("its {what} are {held}"))
        }
        None => Fault::new(format!("it holds several {what}: {held}"), "say which: --array NAME"),
    }
}

impl Array {
    /// Returns the channels' names where a file has none: `value` of one, `r`, `g`, `b`, `a` of up to
    /// four, `c0`, `c1`, … of more.
    fn unnamed_channels(count: usize) -> Vec<String> {
        match count {
            1 => vec!["value".to_owned()],
            2..=4 => ["r", "g", "b", "a"][..count].iter().map(ToString::to_string).collect(),
            _ => (0..count).map(|index| format!("c{index}")).collect(),
        }
    }

    /// Decodes all channels but alpha from sRGB (IEC 61966-2-1).
    fn decoded_from_srgb(mut self) -> Result<Array, Fault> {
        if !self.is_unorm {
            let problem = format!("{}: values are not 8-bit or 16-bit colours", self.kind);
            return Err(Fault::new(problem, "leave --srgb out: they are taken as they are"));
        }
        let decoded = |value: f32| {
            let value = f64::from(value);
            let linear = match value <= 0.04045 {
                true => value / 12.92,
                false => ((value + 0.055) / 1.055).powf(2.4),
            };
            linear as f32
        };
        let count = self.channels.len();
        for (index, value) in self.values.iter_mut().enumerate() {
            if self.channels[index % count] != "a" {
                *value = decoded(*value);
            }
        }
        self.notes.push("decoded from sRGB".to_owned());
        Ok(self)
    }
}
