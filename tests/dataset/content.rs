//! What a dataset must be, and choosing some of its columns.

use crate::{names, sample, strings};
use lgp::dataset::{Dataset, Error, MAX_COLUMNS, NameFault, Split};

#[test]
fn weights_default_to_one() {
    let dataset = sample();
    assert_eq!((dataset.search.rows(), dataset.search.weight(3)), (4, 1.0));
    assert_eq!((dataset.validation.rows(), dataset.validation.weight(0)), (1, 2.0));
    assert_eq!(Split::default().rows(), 0);
}

#[test]
fn validate_names_each_defect() {
    type Case = (fn(&mut Dataset), fn(&Error) -> bool);
    let cases: [Case; 25] = [
        (|d| d.inputs.clear(), |e| matches!(e, Error::NoInputs { .. })),
        (|d| d.outputs.clear(), |e| matches!(e, Error::NoOutputs { .. })),
        (
            |d| d.search.columns.iter_mut().for_each(Vec::clear),
            |e| matches!(e, Error::NoRows { split: "search", .. }),
        ),
        (|d| d.inputs[0].name = String::new(), |e| matches!(e, Error::ColumnName { .. })),
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
        (|d| d.inputs[1].domain = [1.0, 0.0], |e| matches!(e, Error::Domain { .. })),
        (|d| d.inputs[1].domain[1] = f64::NAN, |e| matches!(e, Error::Domain { .. })),
        (|d| d.inputs[1].domain[1] = 1e300, |e| matches!(e, Error::Domain { .. })),
        (|d| d.outputs[0].domain = [-3.5e38, 0.0], |e| matches!(e, Error::Domain { .. })),
        (
            |d| d.name = "../../x".into(),
            |e| matches!(e, Error::Name { fault: NameFault::Path, .. }),
        ),
        (|d| d.name = "a\nb".into(), |e| matches!(e, Error::Name { fault: NameFault::Hidden, .. })),
        (
            |d| d.inputs[0].unit = "\u{1b}[31m".into(),
            |e| matches!(e, Error::Unit { column, fault: NameFault::Hidden, .. } if column == "n_dot_v"),
        ),
        (
            |d| d.outputs[1].unit = "x".repeat(1000),
            |e| matches!(e, Error::Unit { fault: NameFault::Long, .. }),
        ),
        (|d| d.inputs[0].name = "x".repeat(1000), |e| matches!(e, Error::ColumnName { .. })),
        (
            |d| d.inputs = (0..MAX_COLUMNS).map(|i| crate::column(&format!("x{i}"))).collect(),
            |e| matches!(e, Error::TooManyColumns { columns, .. } if *columns == MAX_COLUMNS + 2),
        ),
        (
            |d| d.validation.columns.truncate(3),
            |e| matches!(e, Error::ColumnCount { split: "validation", found: 3, expected: 4, .. }),
        ),
        (
            |d| d.search.columns[2].truncate(3),
            |e| matches!(e, Error::UnequalColumns { column, .. } if column == "scale"),
        ),
        (
            |d| d.search.columns[2][1] = f32::NAN,
            |e| matches!(e, Error::NotFinite { column, row: 2, .. } if column == "scale"),
        ),
        (|d| d.search.weights = vec![1.0; 3], |e| matches!(e, Error::UnequalColumns { .. })),
        (
            |d| d.search.weights = vec![1.0, -1.0, 1.0, 1.0],
            |e| matches!(e, Error::BadWeight { row: 2, .. }),
        ),
        (|d| d.search.weights = vec![f32::NAN; 4], |e| matches!(e, Error::BadWeight { .. })),
        (|d| d.search.weights = vec![0.0; 4], |e| matches!(e, Error::ZeroWeights { .. })),
        (|d| d.search.grid = vec![2, 3], |e| matches!(e, Error::Grid { .. })),
    ];
    sample().validate().unwrap();
    for (index, (spoil, expected)) in cases.into_iter().enumerate() {
        let mut dataset = sample();
        spoil(&mut dataset);
        let error = dataset.validate().unwrap_err();
        assert!(expected(&error), "case {index}: {error}");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("spoilt.bin");
        assert!(dataset.save(&path).unwrap_err().to_string().contains("spoilt.bin"));
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
    let given_bias = dataset.select(Some(&inputs), Some(&strings(&["scale"]))).unwrap();
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
    let error = dataset.select(None, Some(&strings(&["scael"]))).unwrap_err();
    assert!(error.to_string().contains("did you mean `scale`?"), "{error}");
    let error = dataset.select(Some(&strings(&["nv"])), None).unwrap_err();
    assert!(error.to_string().contains("did you mean `n_dot_v`?"), "{error}");
    let error = dataset.select(Some(&strings(&["temperature"])), None).unwrap_err();
    assert!(error.to_string().contains("n_dot_v, roughness, scale, bias"), "{error}");

    let twice = dataset.select(Some(&strings(&["bias"])), Some(&strings(&["bias"])));
    assert!(matches!(twice, Err(Error::InputIsOutput { .. })));
    let twice = dataset.select(Some(&strings(&["n_dot_v", "n_dot_v"])), None);
    assert!(matches!(twice, Err(Error::DuplicateColumn { .. })));
    assert!(matches!(dataset.select(Some(&[]), None), Err(Error::NoInputs { .. })));
    assert!(matches!(dataset.select(None, Some(&[])), Err(Error::NoOutputs { .. })));
    let all = strings(&["n_dot_v", "scale", "bias"]);
    assert!(matches!(dataset.select(Some(&all), None), Err(Error::NoOutputs { .. })));
}
