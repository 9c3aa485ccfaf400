//! Datasets: the `.bin` file, selection of columns, and every way
//! in which they refuse.

mod binary;
mod content;

use lgp::dataset::{Column, Dataset, Origin, Split};

pub fn column(name: &str) -> Column {
    Column::new(name, [0.0, 1.0])
}

pub fn sample() -> Dataset {
    Dataset {
        name: "sample".into(),
        origin: Origin::Target { recipe: "(target: \"none\")".into(), error: "none".into() },
        inputs: vec![column("n_dot_v"), column("roughness")],
        outputs: vec![column("scale"), column("bias")],
        claims: vec!["energy: f0*scale + bias <= 1 for f0 in 0..1".into(), "y: scale >= 0".into()],
        search: Split {
            columns: vec![
                vec![0.0, 0.0, 1.0, 1.0],
                vec![0.0, 1.0, 0.0, 1.0],
                vec![0.1, 0.2, 0.3, 0.4],
                vec![0.5, 0.6, 0.7, 0.8],
            ],
            grid: vec![2, 2],
            ..Split::default()
        },
        validation: Split {
            columns: vec![vec![0.5], vec![0.25], vec![0.15], vec![0.65]],
            weights: vec![2.0],
            ..Split::default()
        },
    }
}

pub fn names(columns: &[Column]) -> Vec<&str> {
    columns.iter().map(|column| column.name.as_str()).collect()
}

pub fn strings(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.into()).collect()
}
