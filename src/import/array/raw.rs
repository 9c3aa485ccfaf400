//! Numbers without a header.

use super::error::{counted, times};
use super::shape::Shape;
use super::{Array, Fault, Request, Scalar};

pub(super) fn read(content: &[u8], request: &Request) -> Result<Array, Fault> {
    let (Some(size), Some(scalar)) = (&request.size, request.format) else {
        let problem = "numbers without a header, whose size and format nothing says";
        let advice =
            "say them, as in --size 64x64x2 --format f32 (texels along x, along y, channels)";
        return Err(Fault::new(problem, advice));
    };
    let shape = Shape::of_size(size, request.axes)?;
    let expected = shape.values() * scalar.bytes();
    if content.len() != expected {
        let problem = format!(
            "{} of {}, but --size {} has {expected}",
            counted(content.len(), "byte"),
            Scalar::name(scalar),
            times(size)
        );
        return Err(Fault::new(problem, "give another size or --format"));
    }
    let order = if request.big_endian { "high bytes first" } else { "low bytes first" };
    Ok(Array {
        kind: format!("raw {}, {order}", scalar.name()),
        channels: Array::unnamed_channels(shape.channels),
        values: scalar.values(content, request.big_endian)?,
        size: shape.size,
        ..Array::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn size_and_format_are_needed_and_must_fit() {
        let request = |size: &[usize], format| Request {
            size: Some(size.to_vec()),
            format: Some(format),
            ..Request::default()
        };
        let bytes = [0.5f32, 1.5, 2.5, 3.5, 4.5, 5.5].map(f32::to_le_bytes).concat();
        let array = read(&bytes, &request(&[3, 2], Scalar::F32)).unwrap();
        assert_eq!((array.size, array.channels.len()), (vec![3], 2));
        let array = read(&bytes, &Request { axes: Some(2), ..request(&[3, 2], Scalar::F32) });
        assert_eq!(array.unwrap().size, [3, 2]);
        let big = [0.5f32, 1.5].map(f32::to_be_bytes).concat();
        let array = read(&big, &Request { big_endian: true, ..request(&[2], Scalar::F32) });
        assert_eq!(array.unwrap().values, [0.5, 1.5]);
        assert!(read(&bytes, &request(&[3, 2], Scalar::F16)).is_err());
        assert!(read(&bytes, &request(&[1 << 40, 1 << 40], Scalar::F16)).is_err());
        assert!(read(&bytes, &Request::default()).unwrap_err().to_string().contains("--size"));
    }
}
