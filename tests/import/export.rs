//! What is exported is read back.

use crate::{names, read_table, read_text};
use lgp::dataset::{Dataset, Split};
use lgp::export::{Rows, to_csv};
use lgp::import::table::{InputColumns, Options};

fn rows(splits: &[&Split]) -> Vec<Vec<u32>> {
    let mut rows: Vec<Vec<u32>> = Vec::new();
    for split in splits {
        rows.extend((0..split.rows()).map(|row| {
            let columns = split.columns.iter().map(|column| column[row].to_bits());
            let errors = split.standard_errors.iter().map(|column| column[row].to_bits());
            columns.chain([split.weight(row).to_bits()]).chain(errors).collect()
        }));
    }
    rows.sort();
    rows
}

fn read_back(data: &Dataset, which: Rows) -> Dataset {
    let inputs = names(&data.inputs).into_iter().map(String::from).collect();
    let options = Options::of_inputs(InputColumns::Names(inputs));
    read_text(&to_csv(data, which), &options).unwrap().0
}

#[test]
fn values_are_the_same() {
    let text: String = (0..64u32)
        .map(|i| {
            let of = |k: u32| {
                let bits = (i * 5 + k).wrapping_mul(0x9e37_79b9).rotate_left(7);
                f32::from_bits(bits & 0xbfff_ffff)
            };
            let error = if i % 2 == 0 { 0.5 } else { 1e-30 };
            format!("{},{:e},{},{},{error}\n", of(0), of(1), -of(2), of(3).abs())
        })
        .collect();
    let text = format!("a,b,y,weight,y_se\n{text}");
    let inputs = InputColumns::Names(vec!["a".into(), "b".into()]);
    let (data, _) = read_text(&text, &Options::of_inputs(inputs)).unwrap();
    assert!(!data.search.weights.is_empty() && data.search.standard_errors.len() == 1);
    let whole = read_back(&data, Rows::Both);
    assert_eq!(rows(&[&whole.search, &whole.validation]), rows(&[&data.search, &data.validation]));
    assert_eq!((&whole.inputs, &whole.outputs), (&data.inputs, &data.outputs));
    let part = read_back(&data, Rows::Validation);
    let splits = match part.search == part.validation {
        true => vec![&part.search],
        false => vec![&part.search, &part.validation],
    };
    assert_eq!(rows(&splits), rows(&[&data.validation]));
    assert_eq!(to_csv(&data, Rows::Search).lines().count(), 1 + data.search.rows());
}

#[test]
fn small_tables_are_written_once() {
    let (data, _) = read_text("x,y\n1,2\n3,4\n", &Options::default()).unwrap();
    assert_eq!(to_csv(&data, Rows::Both), "x,y\n1,2\n3,4\n");
    let tiny = to_csv(&read_table("tiny_values.csv").0, Rows::Both);
    assert!(tiny.contains("e-25"), "{tiny}");
}
