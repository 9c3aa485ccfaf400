//! A `.bin` file but for its checksum: what is read, written and read again is the same.
#![no_main]

use lgp::dataset::Dataset;
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|content: &[u8]| {
    let path = Path::new("fuzzed.bin");
    let _ = Dataset::parse(path, content);
    let mut bytes = content.to_vec();
    bytes.extend_from_slice(blake3::hash(content).as_bytes());
    let Ok(dataset) = Dataset::parse(path, &bytes) else { return };
    let written = dataset.to_bytes(path).expect("what was read can be written");
    let again = Dataset::parse(path, &written).expect("what was written can be read");
    assert_eq!(again, dataset);
    assert_eq!(again.hash(), dataset.hash());
    let names = dataset.names();
    let alone = dataset.select(Some(&names.inputs[..1]), Some(&names.outputs[..1]));
    assert!(alone.is_ok_and(|alone| alone.validate().is_ok()), "one input and one output");
});
