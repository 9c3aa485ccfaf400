//! The layout of `checkpoint.bin`. A checkpoint that was written before must be read as it was, or be
//! refused as one of another version.
//!
//! Where this fails because what is serialised of a search has changed: raise `LAYOUT` in
//! `src/search/checkpoint.rs`, and write `tests/checkpoint/golden.bin` anew by `LGP_WRITE_GOLDEN=1 cargo test
//! --test checkpoint`.

use lgp::cost::Profile;
use lgp::dataset::{Column, Dataset, Split};
use lgp::fit::Measure;
use lgp::grammar::Grammar;
use lgp::run::{Census, Checkpoint, Followed, Run, TracePoint, trace_csv};
use lgp::search::{Goal, Method, Problem, Search};
use std::path::{Path, PathBuf};

fn golden() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/checkpoint/golden.bin")
}

fn dataset() -> Dataset {
    let column = |name| Column::new(name, [0.0, 1.0]);
    let xs: Vec<f32> = (0..16).map(|i| i as f32 / 15.0).collect();
    let split = Split { columns: vec![xs.clone(), xs.clone(), xs], ..Split::default() };
    Dataset {
        name: "golden".into(),
        inputs: vec![column("x"), column("u")],
        outputs: vec![column("y")],
        search: split.clone(),
        validation: split,
        ..Dataset::default()
    }
}

/// A checkpoint in which every part of a search has some content.
fn written() -> Vec<u8> {
    let data = dataset();
    let names = data.names();
    let (goal, method) = (
        Goal { max_cost: 3.0, transforms: vec![None], ..Goal::default() },
        Method { islands: 1, candidates: 40, ..Method::default() },
    );
    let problem = Problem::of(data.clone()).goal(goal).build().unwrap();
    let mut search = Search::new(problem, method).unwrap();
    search.enumerate(1.0, 4000);
    search.advance();
    let run = Run {
        name: data.name.clone(),
        inputs: data.inputs.clone(),
        outputs: data.outputs.clone(),
        goal: search.problem().goal().clone(),
        method: search.method().clone(),
        rules: Some(Grammar::clone(search.problem().grammar())),
        profile: Some(Profile::clone(search.problem().profile())),
        ..Run::default()
    };
    let mut census = Census::default();
    search.archive().members().iter().for_each(|one| census.count(&one.draft, &names, 0.5));
    let trace = trace_csv(&[TracePoint::of(&search, 0.5)], Measure::Rmse);
    let followed = "(tiles: [(halves: [(axis: 0, upper: false)]), (halves: [(axis: 0, upper: true)])], next: 16, has_begun: true)";
    let followed: Followed = ron::from_str(followed).unwrap();
    Checkpoint::bytes(&run, search.state(), &trace, &census, Some(&followed))
}

fn read(bytes: &[u8]) -> Result<Checkpoint, String> {
    Checkpoint::from_bytes("checkpoint.bin".as_ref(), bytes).map_err(|error| error.to_string())
}

#[test]
fn a_committed_checkpoint_is_read_as_it_was_written() {
    if std::env::var_os("LGP_WRITE_GOLDEN").is_some() {
        std::fs::write(golden(), written()).unwrap();
    }
    let bytes = std::fs::read(golden()).unwrap();
    let checkpoint = read(&bytes).expect("raise LAYOUT, and write the golden checkpoint anew");
    assert!(checkpoint.to_bytes() == bytes, "raise LAYOUT, and write the golden checkpoint anew");
    assert_eq!(checkpoint.state.generation(), 1);
    assert!(!checkpoint.state.archive().members().is_empty());
}

fn with_checksum(mut content: Vec<u8>) -> Vec<u8> {
    let checksum = blake3::hash(&content);
    content.extend(checksum.as_bytes());
    content
}

#[test]
fn a_checkpoint_of_another_version_is_refused_as_such() {
    let bytes = std::fs::read(golden()).unwrap();
    let content = &bytes[..bytes.len() - 32];
    let end = content.iter().position(|&byte| byte == b'\n').unwrap();
    for line in ["LGPSTATE4 lgp 0.0.9", "LGPSTATE99 lgp 0.1.0", "LGPSTATE3", "LGPSTATE\u{1b}[2J"] {
        let other = [line.as_bytes(), &content[end..]].concat();
        let message = read(&with_checksum(other)).unwrap_err();
        assert!(message.contains("another version"), "{message}");
        assert!(!message.contains('\u{1b}'));
    }
    for content in [&b"PNG"[..], b"", &[0; 100]] {
        let message = read(&with_checksum(content.to_vec())).unwrap_err();
        assert!(message.contains("not a checkpoint"), "{message}");
    }
    assert!(read(&bytes[..20]).unwrap_err().contains("too short"));
}

/// What a report is made of at the end of the search that goes on.
#[test]
fn a_trace_that_no_search_wrote_is_refused() {
    let Checkpoint { run, state, trace, census, .. } = read(&written()).unwrap();
    let with = |trace: &str| read(&Checkpoint::bytes(&run, &state, trace, &census, None));
    assert!(with(&trace).is_ok() && with("").is_ok());
    for other in ["seconds\n", &trace.replace("rmse_5", "max_5"), &(trace.clone() + "1,2\n")] {
        let message = with(other).unwrap_err();
        assert!(message.contains("its trace"), "{message}");
    }
}

/// Whatever bytes a checkpoint is made of, it is refused, or the search goes on without a panic.
#[test]
fn a_checkpoint_that_was_tampered_with_is_refused_or_whole() {
    let bytes = std::fs::read(golden()).unwrap();
    let content = &bytes[..bytes.len() - 32];
    let data = dataset();
    // Most of it is what the island remembers; the rest decides.
    let zeros = |window: &[u8]| window.iter().all(|&byte| byte == 0);
    let places: Vec<usize> =
        (20..content.len() - 8).filter(|&i| !zeros(&content[i - 8..i + 8])).collect();
    let mut state = 1u64;
    let mut next = |most: usize| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize % most
    };
    let (mut refused, mut read_all) = (0, 0);
    for _ in 0..1500 {
        let mut content = content.to_vec();
        for _ in 0..1 + next(2) {
            let place = places[next(places.len())];
            match next(6) {
                0..3 => content[place] ^= 1 << next(8),
                3 => content[place] = [0, 1, 127, 128, 255][next(5)],
                4 => drop(content.remove(place)),
                _ => content.insert(place, next(256) as u8),
            }
        }
        match read(&with_checksum(content)) {
            Err(_) => refused += 1,
            Ok(Checkpoint { run, state, .. }) => {
                read_all += 1;
                let same = run.names() == data.names();
                if same && run.method.candidates <= 100 {
                    let problem = Problem::of(data.clone()).goal(run.goal).build().unwrap();
                    Search::resume(problem, run.method, state).unwrap().advance();
                }
            }
        }
    }
    assert!(refused > 300 && read_all > 30, "{refused} refused, {read_all} read");
}
