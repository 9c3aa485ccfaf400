//! The options of `lgp import` that say what a texture, a lookup table or an array means.

use super::Failure;
use crate::dataset::Dataset;
use crate::import::array::{self, AxisNames, ChannelNames, Layout, Request, Scalar};
use std::path::Path;

/// What a texture, a lookup table or an array means.
#[derive(clap::Args)]
#[command(next_help_heading = "Options of textures and arrays")]
pub(super) struct Texture {
    /// The axes, the one along x (the fastest) first, and their ends [default: those of the file, or
    /// u, v, w from 0 to 1], as in n_dot_v=0..1,roughness=0.05..1:log
    #[arg(long, value_name = "NAMES")]
    axes: Option<AxisNames>,
    /// The first and last texels are at the ends of the axes, and not half a texel inside
    #[arg(long)]
    corners: bool,
    /// The outputs [default: all channels], as in scale,bias or scale=r,bias=g
    #[arg(long, value_name = "NAMES")]
    channels: Option<ChannelNames>,
    /// The last row is the first along the second axis
    #[arg(long)]
    flip_y: bool,
    /// Take one of N texels along each axis
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    every: Option<u16>,
    /// The size of numbers without one: texels along x, y, z, then channels, as in 64x64x2
    #[arg(long, value_name = "SIZE", value_parser = size)]
    size: Option<Size>,
    /// The kind of numbers without a header: f16, f32, f64; f16 of a source file: its integers are
    /// the bits of halves
    #[arg(long, value_name = "KIND", value_parser = scalar)]
    format: Option<Scalar>,
    /// Numbers without a header have their high bytes first
    #[arg(long)]
    big_endian: bool,
    /// Which array of a source file or an archive, or layer of an EXR file
    #[arg(long, value_name = "NAME")]
    array: Option<String>,
    /// Decode colours of 8 or 16 bits from sRGB; they are taken as they are otherwise
    #[arg(long)]
    srgb: bool,
}

/// A texture, a lookup table or an array that was read.
pub(super) enum Read {
    /// Its texels, and lines that say what was understood.
    Dataset(Box<Dataset>, Vec<String>),
    /// Its rows and columns, as CSV.
    Table(String),
}

/// Texels along each axis, then channels.
type Size = Vec<usize>;

impl Texture {
    /// Reads a file; `None` if it is a table by its kind. An array of rows and columns is made one,
    /// if `is_table`.
    pub(super) fn read(&self, path: &Path, is_table: bool) -> Result<Option<Read>, Failure> {
        let layout = Layout {
            axes: self.axes.clone().unwrap_or_default(),
            corners: self.corners,
            channels: self.channels.clone().unwrap_or_default(),
            flip_y: self.flip_y,
            every: self.every.unwrap_or(1).into(),
        };
        let axes = layout.axes.0.len();
        let request = Request {
            format: self.format,
            big_endian: self.big_endian,
            size: self.size.clone(),
            array: self.array.clone(),
            axes: Some(axes).filter(|&axes| axes > 0),
            srgb: self.srgb,
        };
        let array = array::read(path, &request)?;
        let Some(array) = array else {
            return match self.given() {
                None => Ok(None),
                Some(option) => Err(Failure::usage(format!(
                    "{option}: {} is read as a table, of which it says nothing; leave it out, or name the \
                     file as a texture or an array (.exr, .npy, .raw)",
                    path.display()
                ))),
            };
        };
        if !is_table {
            let (dataset, understood) = layout.dataset(path, &array)?;
            return Ok(Some(Read::Dataset(Box::new(dataset), understood)));
        }
        if axes > 0 {
            let message =
                "--axes names the inputs of a texture, --inputs those of a table; give one of them";
            return Err(Failure::usage(message));
        }
        Ok(Some(Read::Table(layout.table(path, &array)?)))
    }

    /// Returns the first option that is given.
    fn given(&self) -> Option<&'static str> {
        let given = [
            ("--axes", self.axes.is_some()),
            ("--corners", self.corners),
            ("--channels", self.channels.is_some()),
            ("--flip-y", self.flip_y),
            ("--every", self.every.is_some()),
            ("--size", self.size.is_some()),
            ("--format", self.format.is_some()),
            ("--big-endian", self.big_endian),
            ("--array", self.array.is_some()),
            ("--srgb", self.srgb),
        ];
        given.iter().find(|(_, given)| *given).map(|(option, _)| *option)
    }
}

fn size(text: &str) -> Result<Size, String> {
    let along =
        text.split(['x', '×', ',']).map(|along| along.trim().parse().ok().filter(|&n| n > 0));
    let size: Option<Size> = along.collect();
    size.ok_or_else(|| "write texels along x, y, z, then channels, as in 64x64x2".to_owned())
}

fn scalar(text: &str) -> Result<Scalar, String> {
    match text {
        "f16" => Ok(Scalar::F16),
        "f32" => Ok(Scalar::F32),
        "f64" => Ok(Scalar::F64),
        _ => Err("write f16, f32 or f64".to_owned()),
    }
}
