//! OpenEXR.

use super::error::counted;
use super::shape::Shape;
use super::{Array, Fault, MOST_VALUES, Request, Scalar, which_array};
use ::exr::compression::Compression;
use ::exr::error::Error;
use ::exr::image::read::image::ReadLayers;
use ::exr::image::read::layers::ReadChannels;
use ::exr::image::read::read as reading;
use ::exr::image::write::WritableImage;
use ::exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, Layers};
use ::exr::math::Vec2;
use ::exr::meta::MetaData;
use ::exr::meta::attribute::Text;
use ::exr::meta::header::{Header, LayerAttributes};
use std::io::Cursor;

/// The channels that are called and ordered as those of other textures.
const COLOURS: [(&str, &str); 5] = [("R", "r"), ("G", "g"), ("B", "b"), ("A", "a"), ("Y", "value")];

const LOSSLESS: &str = "save it as scan lines, compressed without loss (ZIP) or not at all";

pub(super) fn read(content: &[u8], request: &Request) -> Result<Array, Fault> {
    let headers =
        MetaData::read_from_buffered(Cursor::new(content), false).map_err(damaged)?.headers;
    if headers.iter().any(|header| header.deep) {
        return Err(Fault::new("it holds deep data", "flatten it first"));
    }
    let shapes: Vec<Shape> = headers.iter().map(shape).collect::<Result<_, Fault>>()?;
    // All layers are decoded.
    if shapes.iter().map(Shape::values).sum::<usize>() > MOST_VALUES {
        let problem = format!("{} are too many values", counted(shapes.len(), "layer"));
        return Err(Fault::new(problem, "write the layer of interest to a file of its own"));
    }
    // What is malformed makes some of the crate's decompressors panic.
    let decoded = std::panic::catch_unwind(|| decode(content));
    let image = decoded.unwrap_or_else(|_| {
        Err(Fault::new("damaged: its pixels cannot be decompressed", LOSSLESS))
    })?;
    let names: Vec<String> =
        image.layer_data.iter().map(|layer| name_of(&layer.attributes)).collect();
    let chosen = match &request.array {
        Some(asked) => names.iter().position(|name| name == asked),
        None => (names.len() == 1).then_some(0),
    };
    let layers = image.layer_data.into_iter().zip(shapes);
    match chosen.and_then(|chosen| layers.into_iter().nth(chosen)) {
        Some((layer, shape)) => {
            let lossy = lossy(layer.encoding.compression);
            let mut array = array(shape, layer.channel_data)?;
            array.notes.extend(lossy.map(|name| format!("compressed with loss ({name})")));
            Ok(array)
        }
        None => Err(which_array("layers", &names, request)),
    }
}

/// All layers of an image, at their full resolution.
type Decoded = Image<Layers<AnyChannels<FlatSamples>>>;

/// Decodes all layers, whose size has been checked.
fn decode(content: &[u8]) -> Result<Decoded, Fault> {
    reading()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(content))
        .map_err(damaged)
}

/// Returns the name of a compression that loses something.
fn lossy(compression: Compression) -> Option<String> {
    (compression == Compression::PXR24).then(|| compression.to_string())
}

fn name_of(layer: &LayerAttributes) -> String {
    layer.layer_name.as_ref().map(Text::to_string).unwrap_or_default()
}

/// Checks a header's size and channels before pixels are decoded.
fn shape(header: &Header) -> Result<Shape, Fault> {
    let Vec2(width, height) = header.layer_size;
    let channels = &header.channels.list;
    if let Some(channel) = channels.iter().find(|channel| channel.sampling != Vec2(1, 1)) {
        let problem =
            format!("its channel {} has fewer samples than there are pixels", channel.name);
        return Err(Fault::new(problem, "save it without subsampled channels (as RGB)"));
    }
    if matches!(header.compression, Compression::B44 | Compression::B44A) {
        let problem = format!("it is compressed with loss ({})", header.compression);
        return Err(Fault::new(problem, LOSSLESS));
    }
    Shape::new(vec![width, height], channels.len())
}

fn array(shape: Shape, channels: AnyChannels<FlatSamples>) -> Result<Array, Fault> {
    let mut channels: Vec<AnyChannel<FlatSamples>> = channels.list.into_iter().collect();
    // Files have them in the order of their names.
    let rank = |name: &str| COLOURS.iter().position(|(colour, _)| *colour == name);
    channels.sort_by_key(|channel| rank(&channel.name.to_string()).unwrap_or(COLOURS.len()));
    let name = |channel: &AnyChannel<FlatSamples>| {
        let name = channel.name.to_string();
        rank(&name).map_or(name, |colour| COLOURS[colour].1.to_owned())
    };
    let texels: usize = shape.size.iter().product();
    if channels.iter().any(|channel| channel.sample_data.len() != texels) {
        return Err(Fault::new("damaged: a channel has no value for each pixel", "write it again"));
    }
    let values = (0..texels).flat_map(|texel| {
        channels.iter().map(move |channel| channel.sample_data.value_by_flat_index(texel).to_f32())
    });
    Ok(Array {
        kind: format!("OpenEXR, {}", kind(&channels)),
        values: values.collect(),
        channels: channels.iter().map(name).collect(),
        size: shape.size.into_iter().filter(|&along| along != 1).collect(),
        is_picture: true,
        ..Array::default()
    })
}

/// Returns the kind of numbers.
fn kind(channels: &[AnyChannel<FlatSamples>]) -> String {
    let mut kinds: Vec<String> = Vec::new();
    for channel in channels {
        let scalar = match channel.sample_data {
            FlatSamples::F16(_) => Scalar::F16,
            FlatSamples::F32(_) => Scalar::F32,
            FlatSamples::U32(_) => Scalar::Unsigned(4),
        };
        kinds.push(scalar.name());
    }
    kinds.dedup();
    kinds.join(" and ")
}

fn damaged(error: Error) -> Fault {
    match error {
        Error::NotSupported(what) => {
            let what = what.replace("yet unimplemented compression method: ", "");
            Fault::new(format!("what it uses is not read ({what})"), LOSSLESS)
        }
        Error::Io(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            Fault::new("truncated: the file ends within its data", "copy or write it again")
        }
        error => Fault::new(format!("damaged: {error}"), "write it again"),
    }
}

/// Writes an array of two axes as OpenEXR in 32-bit floats, compressed without loss: x is the first
/// axis, from the left, y the second, from the top.
///
/// # Errors
/// [`Fault`]: another number of axes.
pub fn to_exr(array: &Array) -> Result<Vec<u8>, Fault> {
    let &[width, height] = array.size.as_slice() else {
        let problem = format!("a picture has two axes, and this array has {}", array.size.len());
        return Err(Fault::new(problem, "write it as .npy"));
    };
    let count = array.channels.len();
    let channel = |(index, name): (usize, &String)| {
        let values = array.values.iter().skip(index).step_by(count).copied().collect();
        AnyChannel::new(Text::new_or_none(name).unwrap_or_default(), FlatSamples::F32(values))
    };
    let channels = AnyChannels::sort(array.channels.iter().enumerate().map(channel).collect());
    let attributes = LayerAttributes::default();
    let layer = Layer::new((width, height), attributes, Encoding::SMALL_LOSSLESS, channels);
    let mut bytes = Cursor::new(Vec::new());
    let written = Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes);
    match written {
        Ok(()) => Ok(bytes.into_inner()),
        Err(error) => {
            Err(Fault::new(format!("it cannot be written as EXR: {error}"), "write it as .npy"))
        }
    }
}
