//! A texture, a lookup table or an array: the first byte says as what it is named. What is read is a
//! dataset, and is read back from what is written of it.
#![no_main]

use lgp::import::array::{Array, Layout, Request, Scalar, parse, to_exr, to_npy};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

/// Fuzzed files need not find what formats begin with.
const NAMES: [&str; 11] = [
    "t.png", "t.exr", "t.hdr", "t.dds", "t.ktx2", "t.npy", "t.npz", "t.cube", "t.spi1d", "t.spi3d",
    "t.h",
];

fuzz_target!(|content: &[u8]| {
    let Some((&first, content)) = content.split_first() else { return };
    let path = Path::new(NAMES[usize::from(first) % NAMES.len()]);
    let read = parse(path, content, &Request::default());
    if path.ends_with("t.h") {
        let request =
            Request { size: Some(vec![2, 2]), format: Some(Scalar::F16), ..Request::default() };
        let _ = parse(path, content, &request);
        let _ = parse(Path::new("t.raw"), content, &request);
    }
    let Ok(Some(array)) = read else { return };
    let texels: usize = array.size.iter().product();
    assert_eq!(array.values.len(), texels * array.channels.len());
    // Only small ones are taken further, for speed.
    if texels > 4096 {
        return;
    }
    let again = |name: &str, bytes: &[u8]| {
        let read = parse(
            Path::new(name),
            bytes,
            &Request { axes: Some(array.size.len()), ..Request::default() },
        );
        read.expect("what was written can be read").expect("as an array")
    };
    // Zeros keep their signs; a signalling NaN comes back quiet.
    let bits = |array: &Array| {
        let bits = |value: &f32| if value.is_nan() { f32::NAN } else { *value }.to_bits();
        array.values.iter().map(bits).collect::<Vec<_>>()
    };
    if !array.size.is_empty() {
        assert_eq!(bits(&again("t.npy", &to_npy(&array))), bits(&array));
    }
    if let Ok(bytes) = to_exr(&array) {
        assert_eq!(again("t.exr", &bytes).values.len(), array.values.len());
    }
    let Ok((dataset, understood)) = Layout::default().dataset(path, &array) else { return };
    assert!(!understood.is_empty());
    dataset.validate().expect("what is imported is a dataset");
    let grid = Array::of_grid(&dataset, None).expect("all texels are a grid");
    assert_eq!(grid.size, array.size);
});
