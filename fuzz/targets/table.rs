//! A table in CSV: what is imported is a dataset, and is read back from its file.
#![no_main]

use lgp::dataset::{Dataset, InputColumns, Table};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|content: &[u8]| {
    let path = Path::new("fuzzed.csv");
    let Ok(text) = std::str::from_utf8(content) else { return };
    let Ok(table) = Table::parse(path, text) else { return };
    assert!(table.columns.iter().all(|column| column.len() == table.lines.len()));
    let named = InputColumns::Names(table.names.iter().take(1).cloned().collect());
    for inputs in [InputColumns::Count(1), InputColumns::Count(2), named] {
        let Ok(dataset) = table.clone().dataset(path, &inputs) else { continue };
        dataset.validate().expect("what is imported is a dataset");
        let written = dataset.to_bytes(path).expect("and can be written");
        assert_eq!(Dataset::parse(path, &written).expect("and read"), dataset);
    }
});
