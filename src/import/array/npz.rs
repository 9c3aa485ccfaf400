//! NPZ, several arrays of numpy in a ZIP archive.

use super::npy::Header;
use super::{Array, Fault, Request, which_array};
use flate2::read::DeflateDecoder;
use rawzip::{CompressionMethod, ZipArchive, ZipFileHeaderRecord};
use std::io::Read;

const SAVE_AGAIN: &str = "save it again with numpy.savez";

/// The most arrays of an archive. By hand: no table has as many.
const MOST_ARRAYS: usize = 4096;

pub(super) fn read(content: &[u8], request: &Request) -> Result<Array, Fault> {
    let archive = ZipArchive::from_slice(content).map_err(damaged)?;
    let mut entries = archive.entries();
    let (mut names, mut chosen) = (Vec::new(), None);
    while let Some(entry) = entries.next_entry().map_err(damaged)? {
        let path = String::from_utf8_lossy(entry.file_path().as_bytes()).into_owned();
        let Some(name) = path.strip_suffix(".npy") else { continue };
        if names.len() == MOST_ARRAYS {
            return Err(Fault::new(format!("more than {MOST_ARRAYS} arrays"), SAVE_AGAIN));
        }
        if request.array.as_ref().is_none_or(|asked| asked == name) {
            chosen.get_or_insert(place(&entry));
        }
        names.push(name.to_owned());
    }
    let several = names.len() > 1 && request.array.is_none();
    let Some((method, wayfinder)) = chosen.filter(|_| !several) else {
        return Err(match names.is_empty() {
            true => Fault::new("it holds no arrays (no .npy)", SAVE_AGAIN),
            false => which_array("arrays", &names, request),
        });
    };
    let entry = archive.get_entry(wayfinder).map_err(damaged)?;
    match method {
        CompressionMethod::Store => array(entry.data(), request),
        CompressionMethod::Deflate => array(DeflateDecoder::new(entry.data()), request),
        other => {
            let problem = format!("its arrays are compressed by {other:?}");
            Err(Fault::new(problem, "save them with numpy.savez or savez_compressed"))
        }
    }
}

fn place(entry: &ZipFileHeaderRecord) -> (CompressionMethod, rawzip::ZipArchiveEntryWayfinder) {
    (entry.compression_method(), entry.wayfinder())
}

/// Reads an array from a stream that may go on for ever: as much as its header says.
fn array(mut stream: impl Read, request: &Request) -> Result<Array, Fault> {
    let mut start = Vec::new();
    take(&mut stream, 12, &mut start)?;
    let length = Header::length_of(&start)?;
    take(&mut stream, length.saturating_sub(12), &mut start)?;
    let header = Header::of(&start)?;
    let shape = header.shape(request)?;
    let mut data = start.split_off(header.length.min(start.len()));
    let expected = header.values() * header.scalar.bytes();
    data.truncate(expected);
    take(&mut stream, expected - data.len(), &mut data)?;
    let mut array = header.array(shape, &data)?;
    array.kind = array.kind.replacen("NPY", "NPZ", 1);
    Ok(array)
}

fn take(stream: &mut impl Read, count: usize, bytes: &mut Vec<u8>) -> Result<(), Fault> {
    let read = stream.by_ref().take(count as u64).read_to_end(bytes);
    let read = read.map_err(|error| Fault::new(format!("damaged: {error}"), SAVE_AGAIN))?;
    match read == count {
        true => Ok(()),
        false => Err(Fault::Truncated { expected: count as u64, found: read as u64 }),
    }
}

fn damaged(error: rawzip::Error) -> Fault {
    Fault::new(format!("damaged: {error}"), SAVE_AGAIN)
}
