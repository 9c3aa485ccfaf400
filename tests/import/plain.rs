//! Plain tables: roles of columns, splits, and what is refused.

use crate::{names, strings};
use lgp::dataset::{self, Dataset};
use lgp::import::Error;
use lgp::import::table::{InputColumns, Options, read};
use std::path::Path;

fn import_text(text: &str, inputs: &InputColumns) -> Result<Dataset, Error> {
    import_bytes(text.as_bytes(), inputs)
}

fn import_bytes(bytes: &[u8], inputs: &InputColumns) -> Result<Dataset, Error> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.csv");
    std::fs::write(&path, bytes).unwrap();
    Ok(read(&path, &Options::of_inputs(inputs.clone()))?.0)
}

fn named(names: &[&str]) -> InputColumns {
    InputColumns::Names(strings(names))
}

#[test]
fn imports_a_small_table_into_both_splits() {
    let text = "\u{feff} x , \"y\",half\r\n\r\n 1, -2.5e-1,\"3\"\r\n   \n2,0,.5\n\n";
    let dataset = import_text(text, &InputColumns::Count(2)).unwrap();
    assert_eq!(dataset.name, "table");
    assert_eq!(dataset.origin.to_string(), "imported from table.csv");
    assert_eq!(names(&dataset.inputs), ["x", "y"]);
    assert_eq!(names(&dataset.outputs), ["half"]);
    assert_eq!(dataset.search.columns, [[1.0, 2.0], [-0.25, 0.0], [3.0, 0.5]]);
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
fn imports_standard_errors() {
    let text = "x,y_se,y,z\n1,0.5,3,9\n2,1.5,4,8\n";
    let dataset = import_text(text, &InputColumns::Count(1)).unwrap();
    assert_eq!(names(&dataset.outputs), ["y", "z"]);
    assert_eq!(dataset.search.standard_errors, [[0.5, 1.5], [0.0, 0.0]]);
    // Where there is no output of that name, or it is asked for as an input, it is a column as others.
    let other = import_text("x,w_se,y\n1,2,3\n4,5,6\n", &InputColumns::Count(1)).unwrap();
    assert_eq!(names(&other.outputs), ["w_se", "y"]);
    let as_input = import_text(text, &named(&["y_se"])).unwrap();
    assert_eq!(names(&as_input.outputs), ["x", "y", "z"]);
    assert!(as_input.search.standard_errors.is_empty());
    let negative = import_text("x,y,y_se\n1,1,3\n\n1,1,-3\n", &InputColumns::Count(1));
    let negative = negative.unwrap_err().to_string();
    assert!(negative.contains("line 4, column `y_se`: -3 is negative"), "{negative}");
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
    let negative = import_text("x,weight,y\n1,1,3\n\n1,-1,3\n", &InputColumns::Count(1));
    assert!(matches!(negative, Err(Error::NegativeWeight { line: 4, .. })));
}

#[test]
fn import_splits_disjointly_and_keeps_the_extremes_for_the_search() {
    let rows = 4096;
    let text: String = (0..rows)
        .map(|row| format!("{},{},{row}\n", row / 64, row % 64))
        .fold("x,y,z\n".into(), |text, line| text + &line);
    let dataset = import_text(&text, &InputColumns::Count(2)).unwrap();
    let [search, validation] = [&dataset.search, &dataset.validation].map(|s| &s.columns[2]);
    assert!((1020..=1024).contains(&validation.len()), "{}", validation.len());
    let mut all = [&search[..], &validation[..]].concat();
    all.sort_by(f32::total_cmp);
    assert!(all.iter().enumerate().all(|(row, &value)| value == row as f32));
    assert_eq!(all.len(), rows);
    assert!(search.contains(&0.0) && search.contains(&63.0));
    for fast in 0..64 {
        let held_out = validation.iter().filter(|&&z| z as usize % 64 == fast).count();
        assert!((4..=32).contains(&held_out), "{held_out} of 64 rows at y = {fast}");
    }
}

#[test]
fn import_refuses_with_line_and_column() {
    let one = InputColumns::Count(1);
    let cases: [(&str, &str); 23] = [
        ("", "is empty"),
        (" \n\n", "is empty"),
        ("x,y\n", "no rows"),
        ("x,x\n1,2\n", "`x` occurs more than once"),
        ("x,y\n1,2\n\n1,red\n", "line 4, column `y`: `red` is not a number"),
        ("x,y\n1,2\n1,\n", "line 3, column `y`: the cell is empty"),
        ("x,y\n1,\n", "`y`, which is empty"),
        ("x,y\n1,red\n", "`y`, which holds text (line 2: `red`)"),
        ("x,y\n1,2\nnan,2\n", "line 3, column `x`: `nan` is not finite"),
        ("x,y\n1,2\n1,-inf\n", "line 3, column `y`: `-inf` is not finite"),
        ("x,y\n1,1e39\n", "line 2, column `y`: `1e39` is too large"),
        ("x,y\n1,1e999\n", "line 2, column `y`: `1e999` is too large"),
        ("x,y\n1,2,3\n", "line 2: a row of length 3 under a header of 2"),
        ("x,y\n1,2\n1\n", "line 3: a row of length 1 under"),
        ("x\n1\n", "at least one must be left as an output"),
        ("x,weight\n1,1\n", "at least one must be left as an output"),
        ("x,y\n1,2\n0x10,2\n", "line 3, column `x`: `0x10` is not a number"),
        ("x,y\n1,2\na,b\n3,4\n", "line 3: `a b` stands amid the rows of numbers"),
        ("x,y\n1,2\na,b\n3,4\n", "--rows 1, those below it with --skip 2"),
        ("x,y\n1,\"2\n3,4\n", "line 2: a quote is opened and never closed"),
        ("x,y\n1,1,234.5\n", "line 2"),
        ("<html>\n<body>\n", "no row of numbers below line 1 (`<html>`)"),
        ("x,y\n1,2\n3,4 5\n", "line 3, column `y`: `4 5` is not a number"),
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
    assert!(error.to_string().contains("did you mean `roughness`?"), "{error}");
    let all = import_text(text, &named(&["n_dot_v", "roughness", "scale"]));
    assert!(matches!(all, Err(Error::Dataset(dataset::Error::NoOutputs { .. }))));
    let twice = import_text(text, &named(&["n_dot_v", "n_dot_v"]));
    assert!(matches!(twice, Err(Error::Dataset(dataset::Error::DuplicateColumn { .. }))));
    for none in [named(&[]), InputColumns::Count(0)] {
        let none = import_text(text, &none);
        assert!(matches!(none, Err(Error::Dataset(dataset::Error::NoInputs { .. }))));
    }
    let error = import_text(text, &InputColumns::Count(3));
    assert!(matches!(error, Err(Error::TooManyInputs { asked: 3, columns: 3, .. })));
    let missing = read(Path::new("no_such_table.csv"), &Options::default());
    assert!(matches!(missing, Err(Error::Dataset(dataset::Error::Missing { .. }))));
    let binary = import_bytes(b"x,y\n1,2\n1,\0\n", &InputColumns::Count(1));
    assert!(matches!(binary, Err(Error::NotText { line: 3, .. })));
}
