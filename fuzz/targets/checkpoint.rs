//! A `checkpoint.bin` but for its last 32 bytes, and with its zeros told by their number ([`ZEROS`]): what is read
//! is written and read again, and a search of the usual settings goes on with it.
//!
//! With a path in `LGP_FUZZ_SEED`, an input that is a whole checkpoint is written there.
#![no_main]

use lgp::cost::Profile;
use lgp::dataset::{Column, Dataset, Split};
use lgp::grammar::Grammar;
use lgp::search::{Census, Checkpoint, Problem, Run, Search, Settings};
use libfuzzer_sys::fuzz_target;
use std::path::Path;
use std::sync::LazyLock;

/// Stands before a number of two bytes, the low one first, for so many zeros: the table of structures seen is
/// nearly all of a checkpoint, and nearly all zeros.
const ZEROS: [u8; 4] = *b"\xF5\xF6\xF7\xF8";

fn with_zeros(content: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut rest = content;
    while let Some((&first, after)) = rest.split_first() {
        match rest.strip_prefix(&ZEROS) {
            Some([low, high, after @ ..]) => {
                bytes.resize(bytes.len() + usize::from(u16::from_le_bytes([*low, *high])), 0);
                rest = after;
            }
            _ => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    bytes
}

fn without_zeros(bytes: &[u8]) -> Vec<u8> {
    let mut content = Vec::new();
    for part in bytes.chunk_by(|a, b| *a == 0 && *b == 0) {
        for part in part.chunks(usize::from(u16::MAX)) {
            match part.len() {
                1..8 => content.extend_from_slice(part),
                count => content.extend(ZEROS.iter().chain(&(count as u16).to_le_bytes())),
            }
        }
    }
    content
}

struct Bench {
    dataset: Dataset,
    grammar: Grammar,
    profile: Profile,
    settings: Settings,
}

static BENCH: LazyLock<Bench> = LazyLock::new(|| {
    let column = |name: &str| Column { name: name.into(), unit: "1".into(), domain: [0.0, 1.0] };
    let values: Vec<f32> = (0..8).map(|i| i as f32 / 7.0).collect();
    let squares = values.iter().map(|x| x * x).collect();
    let split = Split { columns: vec![values, squares], ..Split::default() };
    let dataset = Dataset {
        name: "square".into(),
        recipe: String::new(),
        inputs: vec![column("x")],
        outputs: vec![column("y")],
        search: split.clone(),
        validation: split,
    };
    let settings = Settings { islands: 1, candidates: 8, max_cost: 4.0, ..Settings::default() };
    let grammar = Grammar::find("polynomial").expect("built in");
    let profile = Profile::find("gcn").expect("built in");
    if let Some(seed) = std::env::var_os("LGP_FUZZ_SEED") {
        let mut search = Search::new(settings.clone());
        search.advance(&Problem::new(&dataset, &grammar, &profile, &settings));
        let run = Run {
            name: dataset.name.clone(),
            inputs: dataset.inputs.clone(),
            outputs: dataset.outputs.clone(),
            settings: settings.clone(),
            ..Run::default()
        };
        let whole = Checkpoint { run, search, trace: String::new(), census: Census::default() };
        let bytes = whole.to_bytes();
        let seed_written = std::fs::write(seed, without_zeros(&bytes[..bytes.len() - 32]));
        seed_written.expect("there is room");
    }
    Bench { dataset, grammar, profile, settings }
});

fuzz_target!(|content: &[u8]| {
    let Bench { dataset, grammar, profile, settings } = &*BENCH;
    let path = Path::new("checkpoint.bin");
    let content = with_zeros(content);
    let bytes = [&content, blake3::hash(&content).as_bytes().as_slice()].concat();
    let Ok(mut read) = Checkpoint::from_bytes(path, &bytes) else { return };
    let again = Checkpoint::from_bytes(path, &read.to_bytes());
    let again = again.expect("what was written can be read");
    assert_eq!(again.search.generation(), read.search.generation());
    assert_eq!(format!("{:?}", again.run), format!("{:?}", read.run));
    if read.search.settings() == settings && read.run.names() == dataset.names() {
        read.search.advance(&Problem::new(dataset, grammar, profile, settings));
    }
});
