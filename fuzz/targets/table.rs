//! A table, the first byte saying with which options: what is imported is a dataset, is read back
//! from its file, and comes back from a table that it is exported as.
#![no_main]

use lgp::dataset::Dataset;
use lgp::export::{Rows, to_csv};
use lgp::import::table::{Decimal, InputColumns, Options, Separator, parse};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

/// The options that a byte stands for.
fn options(byte: u8) -> Options {
    let separators = [None, Some(';'), Some(','), Some('\t')];
    let separator = separators[usize::from(byte & 3)].map(Separator::Character);
    let decimals = [None, Some(Decimal::Comma), Some(Decimal::Point), None];
    Options {
        separator,
        decimal: decimals[usize::from(byte >> 2 & 3)],
        skip: (byte & 16 != 0).then_some(1),
        rows: (byte & 32 != 0).then_some(3),
        no_header: byte & 64 != 0,
        inputs: (byte & 128 != 0).then_some(InputColumns::Count(1)),
        ..Options::default()
    }
}

fuzz_target!(|content: &[u8]| {
    let path = Path::new("fuzzed.csv");
    let Some((first, rest)) = content.split_first() else { return };
    let Ok((dataset, understood)) = parse(path, rest.to_vec(), &options(*first)) else { return };
    assert!(understood.rows > 0);
    assert!(understood.sentences().iter().all(|sentence| !sentence.is_empty()));
    dataset.validate().expect("what is imported is a dataset");
    let written = dataset.to_bytes(path).expect("and can be written");
    assert_eq!(Dataset::parse(path, &written).expect("and read"), dataset);
    let text = to_csv(&dataset, Rows::Both);
    let inputs = dataset.inputs.iter().map(|column| column.name.clone()).collect();
    let names = Options::of_inputs(InputColumns::Names(inputs));
    // Values that lie together are shifted, and weights or errors may get columns of their names.
    if let Ok((back, _)) = parse(path, text.into_bytes(), &names) {
        let rows = |data: &Dataset| match data.search == data.validation {
            true => data.search.rows(),
            false => data.search.rows() + data.validation.rows(),
        };
        assert_eq!(rows(&back), rows(&dataset));
    }
});
