//! The `.bin` file.

use crate::sample;
use lgp::dataset::{Column, Dataset, Error, Origin, Split, check_name, check_text};
use proptest::prelude::*;
use std::path::{Path, PathBuf};

const MAGIC_AND_LENGTH: usize = 12;

fn saved() -> (tempfile::TempDir, PathBuf, Vec<u8>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sample.bin");
    sample().save(&path).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    (folder, path, bytes)
}

fn load_bytes(bytes: &[u8]) -> Error {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.bin");
    std::fs::write(&path, bytes).unwrap();
    let error = Dataset::load(&path).unwrap_err();
    assert!(error.to_string().contains("broken.bin"), "{error}");
    error
}

/// A file with this header and body and a checksum that is right.
fn sealed(header: &str, body: &[f32]) -> Vec<u8> {
    let mut bytes = b"LGPDATA1".to_vec();
    bytes.extend((header.len() as u32).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(body.iter().flat_map(|value| value.to_le_bytes()));
    let checksum = blake3::hash(&bytes);
    bytes.extend(checksum.as_bytes());
    bytes
}

fn header(version: u32, search_rows: u64) -> String {
    header_of(version, "", search_rows)
}

fn header_of(version: u32, recipe: &str, search_rows: u64) -> String {
    format!(
        "(version:{version},name:\"d\",recipe:{recipe:?},\
         inputs:[(name:\"x\",unit:\"\",domain:(0.0,1.0))],\
         outputs:[(name:\"y\",unit:\"\",domain:(0.0,1.0))],\
         search:(rows:{search_rows},weighted:false,grid:[]),\
         validation:(rows:1,weighted:false,grid:[]))"
    )
}

#[test]
fn saves_and_loads() {
    let (_folder, path, _) = saved();
    let loaded = Dataset::load(&path).unwrap();
    assert_eq!(loaded, sample());
    assert_eq!(loaded.hash(), sample().hash());
}

#[test]
fn saving_leaves_nothing_but_the_file_and_replaces_an_old_one() {
    let (folder, path, _) = saved();
    let mut other = sample();
    other.name = "other".into();
    other.save(&path).unwrap();
    assert_eq!(Dataset::load(&path).unwrap(), other);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    let nowhere = folder.path().join("no/such/folder.bin");
    assert!(matches!(other.save(&nowhere), Err(Error::Io { action: "written", .. })));
}

#[test]
fn hash_depends_on_all_that_makes_the_data_and_on_nothing_else() {
    let original = sample().hash();
    let elsewhere = Dataset {
        origin: Origin::Import { file: "table.csv".into(), renamed: Vec::new() },
        ..sample()
    };
    assert_eq!(elsewhere.hash(), original);
    assert_eq!(Dataset { claims: vec![], ..sample() }.hash(), original);
    let mut value = sample();
    value.search.columns[3][3] = 0.81;
    let mut weight = sample();
    weight.validation.weights = vec![];
    let mut name = sample();
    name.inputs[0].name = "nv".into();
    for changed in [value, weight, name] {
        assert_ne!(changed.hash(), original);
    }
}

/// `version_1.bin` is what the program made of a table of 16 rows when files had version 1.
#[test]
fn a_file_of_version_1_is_read_and_known_by_its_hash() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/dataset/version_1.bin");
    let old = Dataset::load(&path).unwrap();
    let of = Box::new(Origin::Import { file: "table.csv".into(), renamed: Vec::new() });
    assert_eq!(old.origin, Origin::Pruned { of, share: 0.01, kept: 8, rows: 13 });
    assert_eq!(old.origin.to_string(), "imported from table.csv // pruned at 0.01: 8 of 13 rows");
    assert_eq!((old.search.rows(), old.search.standard_errors.len()), (8, 1));
    assert!(old.has_hash("25194134bcec0277") && old.has_hash(&old.hash()));
    assert!(!old.has_hash("0123456789abcdef") && old.hash() != "25194134bcec0277");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new.bin");
    old.save(&path).unwrap();
    assert_eq!(Dataset::load(&path).unwrap(), old);
}

#[test]
fn an_import_keeps_what_columns_were_called() {
    let renamed = vec![("CO(GT)".to_owned(), "co_gt".to_owned())];
    let origin = Origin::Import { file: "table.csv".into(), renamed };
    assert_eq!(origin.to_string(), "imported from table.csv // `CO(GT)` is co_gt");
    let data = Dataset { origin, ..sample() };
    let bytes = data.to_bytes(Path::new("d.bin")).unwrap();
    assert_eq!(Dataset::parse(Path::new("d.bin"), &bytes).unwrap(), data);
}

#[test]
fn the_text_of_version_1_becomes_an_origin_that_says_the_same() {
    let target = "(target: \"dfg\", points: 64) // estimated error below 1e-8";
    let pruned = format!("{target}, pruned at 0.1: 7 of 64 rows");
    let scene = format!("{pruned}\n// scene mobile: roughness in [0, 1]");
    for (text, is_of_dfg) in [
        (target, true),
        (&pruned, true),
        (&scene, true),
        ("imported from a // b.csv", false),
        ("imported from a.csv // pruned at 1e-1: 7 of 64 rows", false),
        ("made by hand // pruned at noon", false),
        ("a\n// scene b\n// scene c", false),
        ("", false),
    ] {
        let bytes = sealed(&header_of(1, text, 1), &[0.0; 4]);
        let origin = Dataset::parse(Path::new("d.bin"), &bytes).unwrap().origin;
        assert_eq!(origin.to_string(), text);
        assert_eq!(origin.target().is_some(), is_of_dfg, "{text}");
    }
    assert!(matches!(load_bytes(&sealed(&header(2, 1), &[0.0; 4])), Error::Header { .. }));
}

#[test]
fn refuses_what_is_no_dataset() {
    let missing = Dataset::load(Path::new("no_such_file.bin")).unwrap_err();
    assert!(matches!(missing, Error::Missing { .. }), "{missing}");
    assert!(matches!(load_bytes(b""), Error::Empty { .. }));
    assert!(matches!(load_bytes(b"n_dot_v,roughness\n"), Error::Magic { .. }));
    let folder = tempfile::tempdir().unwrap();
    assert!(matches!(Dataset::load(folder.path()), Err(Error::Io { action: "read", .. })));
}

#[test]
fn refuses_another_version() {
    let error = load_bytes(&sealed(&header(3, 1), &[0.0; 4]));
    assert!(matches!(error, Error::Version { found: 3, supported: 2, .. }), "{error}");
    let newer = "(version:7,something:(new:[1,2]))";
    assert!(matches!(load_bytes(&sealed(newer, &[])), Error::Version { found: 7, .. }));
}

#[test]
fn refuses_every_truncation_and_any_trailing_byte() {
    let (_folder, _, bytes) = saved();
    for length in 1..bytes.len() {
        let error = load_bytes(&bytes[..length]);
        assert!(matches!(error, Error::Truncated { .. }), "{length} bytes: {error}");
    }
    let longer = [&bytes[..], &[0]].concat();
    assert!(matches!(load_bytes(&longer), Error::Trailing { extra: 1, .. }));
}

#[test]
fn refuses_every_flipped_bit() {
    let (_folder, _, bytes) = saved();
    for position in 0..bytes.len() {
        let mut flipped = bytes.clone();
        flipped[position] ^= 1 << (position % 8);
        let error = load_bytes(&flipped);
        let header = u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize;
        if position >= MAGIC_AND_LENGTH + header {
            assert!(matches!(error, Error::Checksum { .. }), "byte {position}: {error}");
        }
    }
}

#[test]
fn refuses_a_header_that_lies_without_allocating() {
    for rows in [2, 1 << 40, u64::MAX] {
        let error = load_bytes(&sealed(&header(1, rows), &[0.0; 4]));
        assert!(matches!(error, Error::Header { .. }), "{rows} rows: {error}");
    }
    assert!(matches!(load_bytes(&sealed("(version:1)", &[])), Error::Header { .. }));
    assert!(matches!(load_bytes(&sealed("[", &[])), Error::Header { .. }));
    let mut lying_length = sealed(&header(1, 1), &[0.0; 4]);
    lying_length[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(matches!(load_bytes(&lying_length), Error::Truncated { .. }));
    let no_columns = "(version:1,name:\"d\",recipe:\"\",inputs:[],outputs:[],\
        search:(rows:18446744073709551615,weighted:false,grid:[]),\
        validation:(rows:1,weighted:false,grid:[]))";
    assert!(matches!(load_bytes(&sealed(no_columns, &[])), Error::NoInputs { .. }));
}

#[test]
fn refuses_values_that_are_not_finite() {
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let error = load_bytes(&sealed(&header(1, 2), &[0.0, 0.5, 1.0, value, 0.0, 0.0]));
        let Error::NotFinite { split: "search", column, row: 2, .. } = &error else {
            panic!("{error}");
        };
        assert_eq!(column, "y");
    }
}

fn finite() -> impl Strategy<Value = f32> {
    use proptest::num::f32::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    NORMAL | SUBNORMAL | ZERO | POSITIVE | NEGATIVE
}

fn split(columns: usize, outputs: usize) -> impl Strategy<Value = Split> {
    (1usize..20, any::<bool>()).prop_flat_map(move |(rows, weighted)| {
        let values = proptest::collection::vec(proptest::collection::vec(finite(), rows), columns);
        let weights = proptest::collection::vec(0.25f32..4.0, if weighted { rows } else { 0 });
        (values, weights).prop_map(move |(columns, weights)| {
            // Errors of each output, where rows weigh something.
            let outputs = if weighted { outputs } else { 0 };
            let standard_errors = vec![weights.clone(); outputs];
            Split { columns, weights, standard_errors, ..Split::default() }
        })
    })
}

fn datasets() -> impl Strategy<Value = Dataset> {
    let names = any::<String>().prop_filter("a name", |name| check_name(name).is_ok());
    let units = any::<String>().prop_filter("a unit", |unit| check_text(unit).is_ok());
    (1usize..4, 1usize..4, names, units).prop_flat_map(|(inputs, outputs, name, unit)| {
        let columns = inputs + outputs;
        (split(columns, outputs), split(columns, outputs), -1e9..0.0, 0.0..1e9).prop_map(
            move |(search, validation, low, high)| {
                let described = |index: usize| Column {
                    name: format!("column_{index}"),
                    unit: unit.clone(),
                    domain: [low, high],
                };
                Dataset {
                    name: name.clone(),
                    origin: Origin::Formula { text: format!("({name:?})") },
                    inputs: (0..inputs).map(described).collect(),
                    outputs: (inputs..columns).map(described).collect(),
                    claims: vec![format!("all: column_{inputs} >= 0")],
                    search,
                    validation,
                }
            },
        )
    })
}

proptest! {
    #[test]
    fn round_trips(dataset in datasets()) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("any.bin");
        dataset.save(&path).unwrap();
        prop_assert_eq!(Dataset::load(&path).unwrap(), dataset);
    }
}
