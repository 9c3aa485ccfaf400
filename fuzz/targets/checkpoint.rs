//! A `checkpoint.bin` but for its last 32 bytes, and with its zeros told by their number ([`ZEROS`]): what is read
//! is written and read again, and a search of the usual settings goes on with it.
//!
//! With a path in `LGP_FUZZ_SEED`, an input that is a whole checkpoint is written there.
#![no_main]

use lgp::dataset::{Column, Dataset, Split};
use lgp::grammar::Grammar;
use lgp::run::{Census, Checkpoint, Run};
use lgp::search::{Method, Problem, Search};
use libfuzzer_sys::fuzz_target;
use std::path::Path;
use std::sync::{Arc, LazyLock};

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
    problem: Arc<Problem>,
    method: Method,
}

static BENCH: LazyLock<Bench> = LazyLock::new(|| {
    let column = |name| Column::new(name, [0.0, 1.0]);
    let values: Vec<f32> = (0..8).map(|i| i as f32 / 7.0).collect();
    let squares = values.iter().map(|x| x * x).collect();
    let split = Split { columns: vec![values, squares], ..Split::default() };
    let dataset = Dataset {
        name: "square".into(),
        inputs: vec![column("x")],
        outputs: vec![column("y")],
        search: split.clone(),
        validation: split,
        ..Dataset::default()
    };
    let method = Method { islands: 1, candidates: 8, ..Method::default() };
    let grammar = Grammar::find("polynomial").expect("built in");
    let problem = Problem::of(dataset).grammar(grammar).max_cost(4.0).build();
    let problem = Arc::new(problem.expect("a problem"));
    if let Some(seed) = std::env::var_os("LGP_FUZZ_SEED") {
        let mut search = Search::new(problem.clone(), method.clone()).expect("a method");
        search.advance();
        let run = Run::of(&problem, &method);
        let bytes = Checkpoint::bytes(&run, search.state(), "", &Census::default(), None);
        let seed_written = std::fs::write(seed, without_zeros(&bytes[..bytes.len() - 32]));
        seed_written.expect("there is room");
    }
    Bench { problem, method }
});

fuzz_target!(|content: &[u8]| {
    let Bench { problem, method } = &*BENCH;
    let path = Path::new("checkpoint.bin");
    let content = with_zeros(content);
    let bytes = [&content, blake3::hash(&content).as_bytes().as_slice()].concat();
    let Ok(read) = Checkpoint::from_bytes(path, &bytes) else { return };
    let again = Checkpoint::from_bytes(path, &read.to_bytes());
    let again = again.expect("what was written can be read");
    assert_eq!(again.state.generation(), read.state.generation());
    assert_eq!(format!("{:?}", again.run), format!("{:?}", read.run));
    let is_usual = &read.run.goal == problem.goal() && &read.run.method == method;
    if is_usual && read.run.names() == problem.dataset().names() {
        let search = Search::resume(problem.clone(), read.run.method, read.state);
        search.expect("as it was checked").advance();
    }
});
