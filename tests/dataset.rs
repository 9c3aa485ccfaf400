//! Datasets: the `.bin` file, CSV import, selection of columns, and every way
//! in which they refuse.

use lgp::dataset::{Column, Dataset, Error, InputColumns, Split, import_csv};
use proptest::prelude::*;
use std::path::{Path, PathBuf};

const MAGIC_AND_LENGTH: usize = 12;
const CHECKSUM: usize = 32;

fn column(name: &str) -> Column {
    Column {
        name: name.into(),
        unit: "1".into(),
        domain: [0.0, 1.0],
    }
}

fn sample() -> Dataset {
    Dataset {
        name: "sample".into(),
        recipe: "(target: \"none\")".into(),
        inputs: vec![column("n_dot_v"), column("roughness")],
        outputs: vec![column("scale"), column("bias")],
        search: Split {
            columns: vec![
                vec![0.0, 0.0, 1.0, 1.0],
                vec![0.0, 1.0, 0.0, 1.0],
                vec![0.1, 0.2, 0.3, 0.4],
                vec![0.5, 0.6, 0.7, 0.8],
            ],
            weights: vec![],
            grid: vec![2, 2],
        },
        validation: Split {
            columns: vec![vec![0.5], vec![0.25], vec![0.15], vec![0.65]],
            weights: vec![2.0],
            grid: vec![],
        },
    }
}

fn names(columns: &[Column]) -> Vec<&str> {
    columns.iter().map(|column| column.name.as_str()).collect()
}

fn strings(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.into()).collect()
}

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
    format!(
        "(version:{version},name:\"d\",recipe:\"\",\
         inputs:[(name:\"x\",unit:\"\",domain:(0.0,1.0))],\
         outputs:[(name:\"y\",unit:\"\",domain:(0.0,1.0))],\
         search:(rows:{search_rows},weighted:false,grid:[]),\
         validation:(rows:1,weighted:false,grid:[]))"
    )
}

#[test]
fn saves_and_loads() {
    let (_folder, path, bytes) = saved();
    let loaded = Dataset::load(&path).unwrap();
    assert_eq!(loaded, sample());
    assert_eq!(loaded.hash(), sample().hash());
    let checksum = blake3::Hash::from_slice(&bytes[bytes.len() - CHECKSUM..]).unwrap();
    assert_eq!(loaded.hash(), checksum.to_hex()[..16]);
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
    assert!(matches!(
        other.save(&nowhere),
        Err(Error::Io {
            action: "written",
            ..
        })
    ));
}

#[test]
fn hash_depends_on_every_part() {
    let original = sample().hash();
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

#[test]
fn weights_default_to_one() {
    let dataset = sample();
    assert_eq!((dataset.search.rows(), dataset.search.weight(3)), (4, 1.0));
    assert_eq!(
        (dataset.validation.rows(), dataset.validation.weight(0)),
        (1, 2.0)
    );
    assert_eq!(Split::default().rows(), 0);
}

#[test]
fn refuses_what_is_no_dataset() {
    let missing = Dataset::load(Path::new("no_such_file.bin")).unwrap_err();
    assert!(matches!(missing, Error::Missing { .. }), "{missing}");
    assert!(matches!(load_bytes(b""), Error::Empty { .. }));
    assert!(matches!(
        load_bytes(b"n_dot_v,roughness\n"),
        Error::Magic { .. }
    ));
    let folder = tempfile::tempdir().unwrap();
    assert!(matches!(
        Dataset::load(folder.path()),
        Err(Error::Io { action: "read", .. })
    ));
}

#[test]
fn refuses_another_version() {
    let error = load_bytes(&sealed(&header(2, 1), &[0.0; 4]));
    assert!(
        matches!(
            error,
            Error::Version {
                found: 2,
                supported: 1,
                ..
            }
        ),
        "{error}"
    );
    let newer = "(version:7,something:(new:[1,2]))";
    assert!(matches!(
        load_bytes(&sealed(newer, &[])),
        Error::Version { found: 7, .. }
    ));
}

#[test]
fn refuses_every_truncation_and_any_trailing_byte() {
    let (_folder, _, bytes) = saved();
    for length in 1..bytes.len() {
        let error = load_bytes(&bytes[..length]);
        assert!(
            matches!(error, Error::Truncated { .. }),
            "{length} bytes: {error}"
        );
    }
    let longer = [&bytes[..], &[0]].concat();
    assert!(matches!(
        load_bytes(&longer),
        Error::Trailing { extra: 1, .. }
    ));
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
            assert!(
                matches!(error, Error::Checksum { .. }),
                "byte {position}: {error}"
            );
        }
    }
}

#[test]
fn refuses_a_header_that_lies_without_allocating() {
    for rows in [2, 1 << 40, u64::MAX] {
        let error = load_bytes(&sealed(&header(1, rows), &[0.0; 4]));
        assert!(
            matches!(error, Error::Header { .. }),
            "{rows} rows: {error}"
        );
    }
    assert!(matches!(
        load_bytes(&sealed("(version:1)", &[])),
        Error::Header { .. }
    ));
    assert!(matches!(
        load_bytes(&sealed("[", &[])),
        Error::Header { .. }
    ));
    let mut lying_length = sealed(&header(1, 1), &[0.0; 4]);
    lying_length[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(matches!(load_bytes(&lying_length), Error::Truncated { .. }));
    let no_columns = "(version:1,name:\"d\",recipe:\"\",inputs:[],outputs:[],\
        search:(rows:18446744073709551615,weighted:false,grid:[]),\
        validation:(rows:1,weighted:false,grid:[]))";
    assert!(matches!(
        load_bytes(&sealed(no_columns, &[])),
        Error::NoInputs { .. }
    ));
}

#[test]
fn refuses_values_that_are_not_finite() {
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let error = load_bytes(&sealed(&header(1, 2), &[0.0, 0.5, 1.0, value, 0.0, 0.0]));
        let Error::NotFinite {
            split: "search",
            column,
            row: 2,
            ..
        } = &error
        else {
            panic!("{error}");
        };
        assert_eq!(column, "y");
    }
}

#[test]
fn validate_names_each_defect() {
    type Case = (fn(&mut Dataset), fn(&Error) -> bool);
    let cases: [Case; 17] = [
        (
            |d| d.inputs.clear(),
            |e| matches!(e, Error::NoInputs { .. }),
        ),
        (
            |d| d.outputs.clear(),
            |e| matches!(e, Error::NoOutputs { .. }),
        ),
        (
            |d| d.search.columns.iter_mut().for_each(Vec::clear),
            |e| {
                matches!(
                    e,
                    Error::NoRows {
                        split: "search",
                        ..
                    }
                )
            },
        ),
        (
            |d| d.inputs[0].name = String::new(),
            |e| matches!(e, Error::ColumnName { .. }),
        ),
        (
            |d| d.inputs[0].name = "n·v (1)".into(),
            |e| matches!(e, Error::ColumnName { suggestion, .. } if suggestion == "n_v_1"),
        ),
        (
            |d| d.inputs[0].name = "2x".into(),
            |e| matches!(e, Error::ColumnName { suggestion, .. } if suggestion == "_2x"),
        ),
        (
            |d| d.outputs[0].name = "bias".into(),
            |e| matches!(e, Error::DuplicateColumn { column, .. } if column == "bias"),
        ),
        (
            |d| d.inputs[1].domain = [1.0, 0.0],
            |e| matches!(e, Error::Domain { .. }),
        ),
        (
            |d| d.inputs[1].domain[1] = f64::NAN,
            |e| matches!(e, Error::Domain { .. }),
        ),
        (
            |d| d.validation.columns.truncate(3),
            |e| {
                matches!(
                    e,
                    Error::ColumnCount {
                        split: "validation",
                        found: 3,
                        expected: 4,
                        ..
                    }
                )
            },
        ),
        (
            |d| d.search.columns[2].truncate(3),
            |e| matches!(e, Error::UnequalColumns { column, .. } if column == "scale"),
        ),
        (
            |d| d.search.columns[2][1] = f32::NAN,
            |e| matches!(e, Error::NotFinite { column, row: 2, .. } if column == "scale"),
        ),
        (
            |d| d.search.weights = vec![1.0; 3],
            |e| matches!(e, Error::UnequalColumns { .. }),
        ),
        (
            |d| d.search.weights = vec![1.0, -1.0, 1.0, 1.0],
            |e| matches!(e, Error::BadWeight { row: 2, .. }),
        ),
        (
            |d| d.search.weights = vec![f32::NAN; 4],
            |e| matches!(e, Error::BadWeight { .. }),
        ),
        (
            |d| d.search.weights = vec![0.0; 4],
            |e| matches!(e, Error::ZeroWeights { .. }),
        ),
        (
            |d| d.search.grid = vec![2, 3],
            |e| matches!(e, Error::Grid { .. }),
        ),
    ];
    sample().validate().unwrap();
    for (index, (spoil, expected)) in cases.into_iter().enumerate() {
        let mut dataset = sample();
        spoil(&mut dataset);
        let error = dataset.validate().unwrap_err();
        assert!(expected(&error), "case {index}: {error}");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("spoilt.bin");
        assert!(
            dataset
                .save(&path)
                .unwrap_err()
                .to_string()
                .contains("spoilt.bin")
        );
        assert!(!path.exists(), "case {index} was saved");
    }
}

#[test]
fn selects_columns() {
    let dataset = sample();
    assert_eq!(dataset.select(None, None).unwrap(), dataset);

    let scale = dataset.select(None, Some(&strings(&["scale"]))).unwrap();
    assert_eq!(names(&scale.inputs), ["n_dot_v", "roughness"]);
    assert_eq!(names(&scale.outputs), ["scale"]);
    assert_eq!(scale.search.columns.len(), 3);
    assert_eq!(scale.search.grid, [2, 2]);

    let inputs = strings(&["n_dot_v", "roughness", "bias"]);
    let given_bias = dataset
        .select(Some(&inputs), Some(&strings(&["scale"])))
        .unwrap();
    assert_eq!(names(&given_bias.inputs), ["n_dot_v", "roughness", "bias"]);
    assert_eq!(given_bias.search.columns[2], dataset.search.columns[3]);
    assert_eq!(given_bias.search.columns[3], dataset.search.columns[2]);
    assert_eq!(given_bias.validation.weights, [2.0]);
    assert!(given_bias.search.grid.is_empty());

    let rest = dataset.select(Some(&inputs), None).unwrap();
    assert_eq!(names(&rest.outputs), ["scale"]);
}

#[test]
fn select_refuses_and_suggests() {
    let dataset = sample();
    let error = dataset
        .select(None, Some(&strings(&["scael"])))
        .unwrap_err();
    assert!(
        error.to_string().contains("did you mean `scale`?"),
        "{error}"
    );
    let error = dataset.select(Some(&strings(&["nv"])), None).unwrap_err();
    assert!(
        error.to_string().contains("did you mean `n_dot_v`?"),
        "{error}"
    );
    let error = dataset
        .select(Some(&strings(&["temperature"])), None)
        .unwrap_err();
    assert!(
        error
            .to_string()
            .contains("n_dot_v, roughness, scale, bias"),
        "{error}"
    );

    let twice = dataset.select(Some(&strings(&["bias"])), Some(&strings(&["bias"])));
    assert!(matches!(twice, Err(Error::InputIsOutput { .. })));
    let twice = dataset.select(Some(&strings(&["n_dot_v", "n_dot_v"])), None);
    assert!(matches!(twice, Err(Error::DuplicateColumn { .. })));
    assert!(matches!(
        dataset.select(Some(&[]), None),
        Err(Error::NoInputs { .. })
    ));
    assert!(matches!(
        dataset.select(None, Some(&[])),
        Err(Error::NoOutputs { .. })
    ));
    let all = strings(&["n_dot_v", "scale", "bias"]);
    assert!(matches!(
        dataset.select(Some(&all), None),
        Err(Error::NoOutputs { .. })
    ));
}

fn import_text(text: &str, inputs: &InputColumns) -> Result<Dataset, Error> {
    import_bytes(text.as_bytes(), inputs)
}

fn import_bytes(bytes: &[u8], inputs: &InputColumns) -> Result<Dataset, Error> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.csv");
    std::fs::write(&path, bytes).unwrap();
    import_csv(&path, inputs)
}

fn named(names: &[&str]) -> InputColumns {
    InputColumns::Names(strings(names))
}

#[test]
fn imports_a_small_table_into_both_splits() {
    let text = "\u{feff} x , \"y\",half\r\n\r\n 1, -2.5e-1,\"3\"\r\n   \n2,0,.5\n\n";
    let dataset = import_text(text, &InputColumns::Count(2)).unwrap();
    assert_eq!(dataset.name, "table");
    assert_eq!(dataset.recipe, "imported from table.csv");
    assert_eq!(names(&dataset.inputs), ["x", "y"]);
    assert_eq!(names(&dataset.outputs), ["half"]);
    assert_eq!(
        dataset.search.columns,
        [[1.0, 2.0], [-0.25, 0.0], [3.0, 0.5]]
    );
    assert_eq!(dataset.inputs[1].domain, [-0.25, 0.0]);
    assert_eq!(dataset.search, dataset.validation);
}

#[test]
fn imports_columns_called_like_operations_in_the_order_asked_for() {
    let text = "cos,lambda,half\n1,2,3\n4,5,6\n";
    let dataset = import_text(text, &named(&["half", "cos"])).unwrap();
    assert_eq!(names(&dataset.inputs), ["half", "cos"]);
    assert_eq!(names(&dataset.outputs), ["lambda"]);
    assert_eq!(dataset.search.columns, [[3.0, 6.0], [1.0, 4.0], [2.0, 5.0]]);
}

#[test]
fn imports_weights() {
    let text = "x,weight,y\n1,0.5,3\n2,1.5,4\n";
    let dataset = import_text(text, &InputColumns::Count(1)).unwrap();
    assert_eq!(names(&dataset.outputs), ["y"]);
    assert_eq!(dataset.search.weights, [0.5, 1.5]);
    let as_input = import_text(text, &named(&["weight"])).unwrap();
    assert_eq!(names(&as_input.outputs), ["x", "y"]);
    assert!(as_input.search.weights.is_empty());
    let negative = import_text("x,weight,y\n1,-1,3\n", &InputColumns::Count(1));
    assert!(matches!(negative, Err(Error::BadWeight { .. })));
}

#[test]
fn import_splits_disjointly_and_keeps_the_extremes_for_the_search() {
    let rows = 4096;
    let text: String = (0..rows)
        .map(|row| format!("{},{},{row}\n", row / 64, row % 64))
        .fold("x,y,z\n".into(), |text, line| text + &line);
    let dataset = import_text(&text, &InputColumns::Count(2)).unwrap();
    let [search, validation] = [&dataset.search, &dataset.validation].map(|s| &s.columns[2]);
    assert!(
        (1020..=1024).contains(&validation.len()),
        "{}",
        validation.len()
    );
    let mut all = [&search[..], &validation[..]].concat();
    all.sort_by(f32::total_cmp);
    assert!(
        all.iter()
            .enumerate()
            .all(|(row, &value)| value == row as f32)
    );
    assert_eq!(all.len(), rows);
    assert!(search.contains(&0.0) && search.contains(&63.0));
    for fast in 0..64 {
        let held_out = validation
            .iter()
            .filter(|&&z| z as usize % 64 == fast)
            .count();
        assert!(
            (4..=32).contains(&held_out),
            "{held_out} of 64 rows at y = {fast}"
        );
    }
}

#[test]
fn import_refuses_with_line_and_column() {
    let one = InputColumns::Count(1);
    let cases: [(&str, &str); 21] = [
        ("", "is empty"),
        (" \n\n", "is empty"),
        ("x,y\n", "no rows"),
        ("1,2\n3,4\n", "line 1: the first line holds only numbers"),
        ("x,x\n1,2\n", "`x` occurs more than once"),
        (
            "n.v,y\n1,2\n",
            "line 1: column name `n.v` is not an identifier",
        ),
        ("n.v,y\n1,2\n", "to `n_v`"),
        ("x,\n1,2\n", "column name `` is not an identifier"),
        ("x;y\n1;2\n", "line 1: columns are separated by semicolons"),
        ("x\ty\n1\t2\n", "separated by tabs"),
        (
            "x,y\n1,2\n\n1,red\n",
            "line 4, column `y`: `red` is not a number",
        ),
        ("x,y\n1,\n", "line 2, column `y`: the cell is empty"),
        (
            "x,y\n1,2\nnan,2\n",
            "line 3, column `x`: `nan` is not finite",
        ),
        ("x,y\n1,-inf\n", "line 2, column `y`: `-inf` is not finite"),
        ("x,y\n1,1e39\n", "line 2, column `y`: `1e39` is too large"),
        ("x,y\n1,1e999\n", "line 2, column `y`: `1e999` is too large"),
        (
            "x,y\n1,2,3\n",
            "line 2: a row of length 3 under a header of 2",
        ),
        ("x,y\n1,2\n1\n", "line 3: a row of length 1 under"),
        ("x\n1\n", "at least one must be left as an output"),
        ("x,weight\n1,1\n", "at least one must be left as an output"),
        (
            "x,y\n0x10,2\n",
            "line 2, column `x`: `0x10` is not a number",
        ),
    ];
    for (text, expected) in cases {
        let error = import_text(text, &one).unwrap_err().to_string();
        assert!(error.contains(expected), "{text:?}: {error}");
        assert!(error.contains("table.csv"), "{text:?}: {error}");
    }
}

#[test]
fn import_refuses_unusable_inputs() {
    let text = "n_dot_v,roughness,scale\n1,2,3\n";
    let error = import_text(text, &named(&["rougness"])).unwrap_err();
    assert!(
        error.to_string().contains("did you mean `roughness`?"),
        "{error}"
    );
    let all = import_text(text, &named(&["n_dot_v", "roughness", "scale"]));
    assert!(matches!(all, Err(Error::NoOutputs { .. })));
    let twice = import_text(text, &named(&["n_dot_v", "n_dot_v"]));
    assert!(matches!(twice, Err(Error::DuplicateColumn { .. })));
    for none in [named(&[]), InputColumns::Count(0)] {
        assert!(matches!(
            import_text(text, &none),
            Err(Error::NoInputs { .. })
        ));
    }
    let error = import_text(text, &InputColumns::Count(3));
    assert!(matches!(
        error,
        Err(Error::TooManyInputs {
            asked: 3,
            columns: 3,
            ..
        })
    ));
    let missing = import_csv(Path::new("no_such_table.csv"), &InputColumns::Count(1));
    assert!(matches!(missing, Err(Error::Missing { .. })));
    let latin1 = import_bytes(b"x,y\n1,2\n1,\xb5\n", &InputColumns::Count(1));
    assert!(matches!(latin1, Err(Error::NotText { line: 3, .. })));
}

fn finite() -> impl Strategy<Value = f32> {
    use proptest::num::f32::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    NORMAL | SUBNORMAL | ZERO | POSITIVE | NEGATIVE
}

fn split(columns: usize) -> impl Strategy<Value = Split> {
    (1usize..20, any::<bool>()).prop_flat_map(move |(rows, weighted)| {
        let values = proptest::collection::vec(proptest::collection::vec(finite(), rows), columns);
        let weights = proptest::collection::vec(0.25f32..4.0, if weighted { rows } else { 0 });
        (values, weights).prop_map(|(columns, weights)| Split {
            columns,
            weights,
            grid: vec![],
        })
    })
}

fn datasets() -> impl Strategy<Value = Dataset> {
    (1usize..4, 1usize..4, any::<String>(), any::<String>()).prop_flat_map(
        |(inputs, outputs, name, unit)| {
            let columns = inputs + outputs;
            (split(columns), split(columns), -1e9..0.0, 0.0..1e9).prop_map(
                move |(search, validation, low, high)| {
                    let described = |index: usize| Column {
                        name: format!("column_{index}"),
                        unit: unit.clone(),
                        domain: [low, high],
                    };
                    Dataset {
                        name: name.clone(),
                        recipe: format!("({name:?})"),
                        inputs: (0..inputs).map(described).collect(),
                        outputs: (inputs..columns).map(described).collect(),
                        search,
                        validation,
                    }
                },
            )
        },
    )
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
