//! Each table beside this file is read as its kind should be, or refused with the remedy.

use crate::{names, read_table, sorted, table};
use lgp::import::table::{InputColumns, Options, Role, read};

/// A table that is read without options: its inputs, outputs, rows, and parts of what is said.
type AsRead<'a> = (&'a str, &'a [&'a str], &'a [&'a str], usize, &'a [&'a str]);

const READ: [AsRead; 32] = [
    (
        "semicolon_decimal_comma.csv",
        &["Nr", "Einfallswinkel", "Rauheit"],
        &["Albedo"],
        24,
        &["separator `;`, decimal comma", "`Nr` counts the rows (1 to 24)", "--drop Nr"],
    ),
    (
        "trailing_separators.csv",
        &["Winkel", "Rauheit"],
        &["co_gt"],
        24,
        &["`CO(GT)` → co_gt", "2 empty rows"],
    ),
    ("output_first.tsv", &["target", "x"], &["y"], 24, &["separator tabs"]),
    (
        "units_in_names.csv",
        &["wavelength", "e"],
        &["temp_annual"],
        24,
        &["`Wavelength (nm)` → wavelength in nm", "e in W/m^2/nm", "temp_annual in %"],
    ),
    (
        "title_and_units_rows.csv",
        &["cos_theta", "roughness"],
        &["albedo"],
        24,
        &[
            "names in line 3, units in line 4",
            "1 row above the table (line 1)",
            "column `note` left out: it is empty",
        ],
    ),
    ("cr_only.csv", &["x"], &["y"], 24, &[]),
    ("comment_lines.csv", &["x"], &["y"], 24, &["left out: 3 comments"]),
    ("no_header.csv", &["x0"], &["y"], 24, &["no names"]),
    ("numeric_headers.csv", &["wavelength", "_1"], &["_2"], 24, &["`1` → _1", "`2` → _2"]),
    ("text_column.csv", &["x"], &["y"], 24, &["column `filter` left out: it holds text"]),
    ("bom_quoted.csv", &["n_dot_v"], &["albedo"], 24, &[]),
    ("blanks.csv", &["x"], &["y"], 24, &[]),
    (
        "metadata_block.txt",
        &["nm"],
        &["value"],
        24,
        &["4 rows above the table (lines 1 to 5)", "names in line 6"],
    ),
    (
        "integers_beyond_f32.csv",
        &["unix_time_minus_1700000000"],
        &["y"],
        64,
        &["`unix_time` → unix_time_minus_1700000000", "63 of the 64 values"],
    ),
    ("tiny_values.csv", &["x"], &["cross_section"], 24, &[]),
    ("huge_values.csv", &["x"], &["radiance"], 24, &[]),
    ("constant_zero.csv", &["x", "y"], &["unused"], 24, &[]),
    (
        "german.csv",
        &["wellenlaenge"],
        &["strahldichte"],
        24,
        &["Windows-1252", "decimal comma", "`Strahldichte (W/m²)` → strahldichte in W/m²"],
    ),
    ("unicode.txt", &["Winkel"], &["Wert"], 24, &["UTF-16"]),
    ("ocean.txt", &["x0"], &["y"], 24, &["lines 1 to 9", "1 row below the table"]),
    (
        "kaggle.csv",
        &["id", "price", "sqft"],
        &["rating"],
        24,
        &["`100,000.00` in line 2 is 100000", "column `date` left out"],
    ),
    ("pandas.csv", &["column_1", "x"], &["y"], 24, &["`column_1` counts the rows (0 to 23)"]),
    ("numpy.txt", &["x"], &["y"], 24, &["names in the comment in line 1"]),
    ("fortran.dat", &["LAMBDA"], &["FLUX"], 24, &["separator blanks"]),
    ("aligned.txt", &["wavelength"], &["intensity"], 24, &["intensity in a.u."]),
    ("excel_multiline.csv", &["temperature"], &["resistance"], 24, &["from line 4", "°C"]),
    ("jd.csv", &["jd_minus_2459000"], &["mag"], 24, &["shifted by that"]),
    ("markdown.txt", &["angle"], &["value"], 24, &["separator `|`", "angle in deg"]),
    ("quoted_comma.csv", &["x"], &["y"], 24, &["separator `,`, decimal comma"]),
    ("nbsp.csv", &["x"], &["y"], 24, &["separator `;`, decimal comma"]),
    ("gonio.dat", &["Angle"], &["Value"], 24, &["lines 1 to 2"]),
    ("group.csv", &["a", "b", "c"], &["d"], 24, &["names in line 2", "(line 1)"]),
];

#[test]
fn tables_are_read_as_their_kind() {
    for (file, inputs, outputs, rows, parts) in READ {
        let (data, understood) = read_table(file);
        assert_eq!(names(&data.inputs), inputs, "{file}");
        assert_eq!(names(&data.outputs), outputs, "{file}");
        let held = data.search.rows() + data.validation.rows();
        assert_eq!((held, understood.rows), (rows, rows), "{file}");
        let said = understood.sentences().join("\n");
        assert!(parts.iter().all(|part| said.contains(part)), "{file}: {said}");
        assert_eq!(parts.is_empty(), said.is_empty(), "{file}: {said}");
    }
}

/// The albedo of all tables that hold it, at half a step.
const FIRST: f32 = 0.929_628;

#[test]
fn values_and_units_are_those_of_the_file() {
    for file in ["semicolon_decimal_comma.csv", "trailing_separators.csv", "cr_only.csv"] {
        let (data, _) = read_table(file);
        let last = data.inputs.len();
        assert_eq!(sorted(&data, last)[0], FIRST, "{file}");
    }
    for (file, scale) in [("tiny_values.csv", 5e-25), ("huge_values.csv", 1e20)] {
        let first = sorted(&read_table(file).0, 1)[0];
        assert!((f64::from(first) / (f64::from(FIRST) * scale) - 1.0).abs() < 1e-5, "{file}");
    }
    let (data, _) = read_table("integers_beyond_f32.csv");
    assert_eq!(sorted(&data, 0), (0..64).map(|i| i as f32).collect::<Vec<_>>());
    assert_eq!(data.inputs[0].domain, [0.0, 63.0]);
    let units = |file: &str| {
        let (data, _) = read_table(file);
        data.inputs.iter().chain(&data.outputs).map(|c| c.unit.clone()).collect::<Vec<_>>()
    };
    assert_eq!(units("units_in_names.csv"), ["nm", "W/m^2/nm", "%"]);
    assert_eq!(units("title_and_units_rows.csv"), ["", "", "1"]);
    assert_eq!(sorted(&read_table("nbsp.csv").0, 0)[..2], [1000.0, 1100.0]);
    assert_eq!(sorted(&read_table("jd.csv").0, 0)[..2], [0.5, 0.51]);
    let kaggle = read_table("kaggle.csv").0;
    assert_eq!(sorted(&kaggle, 1)[1], 101_000.0);
    let origin = read_table("trailing_separators.csv").0.origin.to_string();
    assert_eq!(origin, "imported from trailing_separators.csv // `CO(GT)` is co_gt");
}

#[test]
fn what_is_unclear_is_refused_with_the_option_that_decides() {
    let comma = Options { decimal: Some(lgp::import::table::Decimal::Comma), ..Options::default() };
    let point = Options { decimal: Some(lgp::import::table::Decimal::Point), ..Options::default() };
    let (as_point, _) = read(&table("thousands.csv"), &point).unwrap();
    let (as_comma, _) = read(&table("thousands.csv"), &comma).unwrap();
    assert_eq!((sorted(&as_point, 1)[0], sorted(&as_comma, 1)[0]), (100_250.0, 100.25));
    for (file, parts) in [
        ("thousands.csv", &["line 2", "`100,250`", "--decimal comma or --decimal point"][..]),
        ("refractiveindex.csv", &["line 26", "`wl k`", "--rows 24", "--skip 25"]),
        ("r.txt", &["line 2", "--skip 1 --columns \"column_1,x,y\""]),
        ("below.csv", &["column `y`", "--scale y=1e47"]),
        ("beyond.csv", &["column `y`", "--scale y=1e-300"]),
        ("one.csv", &["line 2", "`0,0208`", "--columns"]),
        ("missing.csv", &["line 9, column `y`", "`NA`", "remove the row"]),
    ] {
        let error = read(&table(file), &Options::default()).unwrap_err().to_string();
        assert!(parts.iter().all(|part| error.contains(part)), "{file}: {error}");
    }
}

#[test]
fn the_remedies_work() {
    let options = |change: fn(&mut Options)| {
        let mut options = Options::default();
        change(&mut options);
        options
    };
    let read = |file: &str, change| read(&table(file), &options(change)).unwrap().0;
    let n = read("refractiveindex.csv", |options| options.rows = Some(24));
    let k = read("refractiveindex.csv", |options| options.skip = Some(25));
    assert_eq!((names(&n.outputs), names(&k.outputs)), (vec!["n"], vec!["k"]));
    assert_eq!((sorted(&n, 1).len(), sorted(&k, 1).len()), (24, 24));
    let of_r = read("r.txt", |options| {
        options.skip = Some(1);
        options.columns = Some(crate::strings(&["row", "x", "y"]));
        options.drop = vec!["row".into()];
    });
    assert_eq!((names(&of_r.inputs), of_r.search.rows() + of_r.validation.rows()), (vec!["x"], 24));
    let small = read("below.csv", |options| options.scales = vec![("y".into(), 47)]);
    assert_eq!(names(&small.outputs), ["y_times_1e47"]);
    assert_eq!(sorted(&small, 1)[0], 9.394);
    let large = read("beyond.csv", |options| options.scales = vec![("y".into(), -300)]);
    assert_eq!((names(&large.outputs), sorted(&large, 1)[0]), (vec!["y_over_1e300"], 0.9394));
    let first = read("output_first.tsv", |options| options.outputs = Some(vec!["target".into()]));
    assert_eq!((names(&first.inputs), names(&first.outputs)), (vec!["x", "y"], vec!["target"]));
}

#[test]
fn a_column_of_text_is_refused_where_it_is_asked_for() {
    let asked = Options::of_inputs(InputColumns::Names(vec!["filter".into(), "x".into()]));
    let error = read(&table("text_column.csv"), &asked).unwrap_err().to_string();
    assert!(error.contains("column `filter` holds no numbers"), "{error}");
    assert!(error.contains("narrow`") || error.contains("wide`"), "{error}");
    let (_, understood) = read_table("text_column.csv");
    assert!(matches!(understood.columns[0].role, Role::LeftOut(_)));
    assert_eq!(understood.columns[1].role, Role::Input);
}
