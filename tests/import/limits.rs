//! Large and strange tables end with a message, soon.

use crate::{read_text, refusal};
use lgp::dataset::MAX_COLUMNS;
use lgp::import::table::Options;
use std::time::{Duration, Instant};

#[test]
fn long_rows_and_many_columns_are_refused() {
    let start = Instant::now();
    let none = Options::default();
    let long = "0".repeat(100_000_000);
    assert!(refusal(&long, &none).contains("line 1: a row of more than 1 MiB"));
    assert!(refusal(&format!("x,y\n1,2\n\"{long}"), &none).contains("line 3"));
    let row = |cells: usize| vec!["1"; cells].join(",") + "\n";
    let said = refusal(&row(MAX_COLUMNS + 1).repeat(3), &none);
    assert!(said.contains("4097 columns; at most 4096"), "{said}");
    assert!(read_text(&row(MAX_COLUMNS).repeat(3), &none).is_ok());
    assert!(refusal(&row(100_000), &none).contains("16384 cells"));
    let names = vec!["a b"; 5000].join(",") + "\n" + &row(5000);
    assert!(refusal(&names, &none).contains("5000 columns"));
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
}

#[test]
fn strange_texts_are_refused() {
    for text in [
        "",
        "\n\n",
        "# only\n# comments\n",
        "\"",
        "\"\"\n",
        ";;;\n;;;\n",
        "-----\n",
        "x",
        "\u{feff}",
        "1",
    ] {
        let said = refusal(text, &Options::default());
        assert!(said.contains("table.csv"), "{text:?}: {said}");
    }
}
