//! Whatever the files of a run's folder hold, a command that reads them ends with a message, or does what it is for.

#![cfg(feature = "cli")]

mod command;

use command::{lgp, succeed};
use lgp::emit::{self, Language, Snippet};
use lgp::run::{Census, RecordError, load_front, load_run, merge};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A folder with data, their scene, and a run of them that says nothing of its files' checksums, as those of older
/// versions do.
fn searched() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let row = |i: usize| format!("{},{},{}\n", i % 8, i / 8, (i as f32).sqrt());
    let rows: String = (0..64).map(row).collect();
    std::fs::write(here.join("d.csv"), format!("x,u,y\n{rows}")).unwrap();
    std::fs::create_dir(here.join("scenes")).unwrap();
    let scene = "(ranges: {\"x\": (1, 6)}, tiers: {\"low\": (max_cost: 5)})";
    std::fs::write(here.join("scenes/part.ron"), scene).unwrap();
    for args in [
        &["import", "d.csv", "-o", "d.bin", "--inputs", "2"][..],
        &["search", "d.bin", "--scene", "part", "--generations", "2", "--islands", "1"],
    ] {
        let args = if args[0] == "search" {
            [args, &["--max-cost", "5", "--require", "range=-9..9,uses=x", "--out", "run"]].concat()
        } else {
            args.to_vec()
        };
        succeed(here, &args);
    }
    let path = here.join("run/run.ron");
    let text = std::fs::read_to_string(&path).unwrap();
    let start = text.find("    files: {").unwrap();
    let end = start + text[start..].find("    },\n").unwrap() + "    },\n".len();
    std::fs::write(&path, text[..start].to_owned() + &text[end..]).unwrap();
    folder
}

/// Numbers that follow from a seed.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % most.max(1)
    }

    fn of<'a>(&mut self, all: &[&'a str]) -> &'a str {
        all[self.below(all.len())]
    }
}

const EXTREMES: [&str; 18] = [
    "0",
    "-1",
    "1e39",
    "-1e400",
    "1e-320",
    "NaN",
    "inf",
    "-inf",
    "4294967296",
    "18446744073709551615",
    "0.5",
    "null",
    "\"\"",
    "[]",
    "{}",
    "()",
    "None",
    "Some(3)",
];

/// Changes a text in one way: a byte, a number, a word, a line.
fn mutated(text: &str, numbers: &mut Numbers) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    let place = numbers.below(bytes.len());
    match numbers.below(6) {
        0 => bytes[place] ^= 1 << numbers.below(8),
        1 => bytes.truncate(place),
        2 => {
            let is_word = |byte: &u8| byte.is_ascii_alphanumeric() || b".-+_".contains(byte);
            let start =
                place - bytes[..place].iter().rev().take_while(|byte| is_word(byte)).count();
            let end = place + bytes[place..].iter().take_while(|byte| is_word(byte)).count();
            bytes.splice(start..end, numbers.of(&EXTREMES).bytes());
        }
        3 => {
            let lines: Vec<&str> = text.lines().collect();
            let (from, to) = (numbers.below(lines.len()), numbers.below(lines.len()));
            let mut lines: Vec<&str> = lines;
            match numbers.below(3) {
                0 => drop(lines.remove(from)),
                1 => lines.insert(to, lines[from]),
                _ => lines.swap(from, to),
            }
            bytes = lines.join("\n").into_bytes();
        }
        4 => {
            let formula =
                numbers.of(&["y = u/x", "y = 3", "x = y", "y = t", "y = sqrt(-1)", "y = 1e39"]);
            let old = text.find("y = ").unwrap_or(0);
            let end = old + text[old..].find('"').unwrap_or(0);
            bytes.splice(old..end, formula.bytes());
        }
        _ => {
            let other = numbers.below(bytes.len());
            let (start, end) = (place.min(other), place.max(other).min(place.min(other) + 40));
            let part = bytes[start..end].to_vec();
            bytes.splice(place..place, part);
        }
    }
    bytes
}

const FILES: [&str; 5] = ["run.ron", "front.json", "front-max.json", "trace.csv", "census.json"];

/// What commands do with a folder, without drawing.
fn used(folder: &Path) -> Result<(), RecordError> {
    let run = load_run(folder)?;
    let names = run.names();
    let census = Census::load(folder, &run)?;
    let _ = census.map(|census| census.recurring());
    let _ = (run.requirements(), run.to_ron(), run.profile(), run.grammar());
    let _ = run.scene.as_ref().map(|scene| (scene.summary(), scene.max_cost()));
    for minimax in [false, true] {
        let front = load_front(folder, &run, minimax)?;
        let _ = (front.knee(), front.within(Some(3.0), None), front.to_json(&names));
        for member in &front.members {
            let program = &member.program;
            let snippet = Snippet::new(program, &names, &run.name);
            Language::ALL.iter().for_each(|&language| drop(emit::emit(language, &snippet)));
        }
        let _ = merge(vec![(run.clone(), front.clone()), (run.clone(), front)]);
    }
    Ok(())
}

#[test]
fn a_folder_that_was_tampered_with_is_refused_or_read() {
    let folder = searched();
    let run = folder.path().join("run");
    let whole = FILES.map(|file| std::fs::read_to_string(run.join(file)).unwrap());
    let rounds = std::env::var("LGP_MUTATIONS").ok().and_then(|rounds| rounds.parse().ok());
    let (mut numbers, mut refused, mut read) = (Numbers(7), 0, 0);
    for round in 0..rounds.unwrap_or(3000) {
        let chosen = numbers.below(FILES.len() + 2).saturating_sub(2);
        let path = run.join(FILES[chosen]);
        std::fs::write(&path, mutated(&whole[chosen], &mut numbers)).unwrap();
        match used(&run) {
            Ok(()) => read += 1,
            Err(error) => {
                refused += 1;
                assert!(error.to_string().contains("run"), "{error}");
            }
        }
        // The commands themselves, now and then: they take longer.
        if round % 150 == 0 {
            for args in COMMANDS {
                ends_clearly(folder.path(), args);
            }
        }
        std::fs::write(&path, &whole[chosen]).unwrap();
    }
    assert!(refused > 100 && read > 100, "{refused} refused, {read} read");
}

const COMMANDS: [&[&str]; 8] = [
    &["front", "run"],
    &["emit", "run", "--lang", "wgsl"],
    &["analyze", "run"],
    &["check", "run"],
    &["report", "run"],
    &["merge", "run", "--out", "all"],
    &["render", "run"],
    &["search", "--resume", "--out", "run"],
];

fn ends_clearly(folder: &Path, args: &[&str]) {
    let output = lgp(folder, args);
    let message = String::from_utf8_lossy(&output.stderr);
    let code = output.status.code();
    assert!(code.is_some_and(|code| code < 5), "{args:?}: {code:?} {message}");
    assert!(!message.contains("panicked"), "{args:?}: {message}");
}

/// Folders whose domains and names no search leaves.
#[test]
fn runs_of_impossible_columns_are_refused_by_every_command() {
    let folder = searched();
    let here = folder.path();
    let path = here.join("run/run.ron");
    let whole = std::fs::read_to_string(&path).unwrap();
    for (from, to, expected) in [
        ("domain: (1.0, 6.0)", "domain: (4294967296, 1.0)", "domain"),
        ("domain: (1.0, 6.0)", "domain: (0, 1e999)", "domain"),
        ("name: \"x\"", "name: \"</script><script>alert(4)</script>\"", "identifier"),
        ("name: \"x\"", "name: \"../../x\"", "identifier"),
        ("name: \"x\"", "name: \"u\"", "more than once"),
        ("islands: 1,", "islands: 4000000000,", "`islands`"),
        ("islands: 1,", "islands: 0,", "`islands`"),
        ("max_cost: 5.0", "max_cost: 1e300", "`max_cost`"),
        ("subset: 256", "subset: 0", "`subset`"),
        ("Input(0)", "Input(7)", "`requirements`"),
        ("low: -9.0", "low: 90.0", "`requirements`"),
        ("max_instructions: ", "max_instructions: 99", "max_instructions"),
    ] {
        assert!(whole.contains(from), "{from} is not in\n{whole}");
        std::fs::write(&path, whole.replace(from, to)).unwrap();
        for args in COMMANDS {
            if args[0] == "search" {
                continue;
            }
            let output = lgp(here, args);
            let message = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(3), "{to}, {args:?}: {message}");
            assert!(message.contains("run.ron, line "), "{to}: {message}");
            assert!(message.contains(expected), "{to}: {message}");
        }
    }
}

/// What a file of a run may be in its place.
#[cfg(unix)]
#[test]
fn files_without_end_and_links_to_elsewhere_are_refused() {
    let folder = searched();
    let here = folder.path();
    let run = here.join("run");
    let link = |file: &str, to: &str| {
        let path = run.join(file);
        let _ = std::fs::remove_file(&path);
        std::os::unix::fs::symlink(to, &path).unwrap();
        path
    };
    let refused = |args: &[&str], expected: &str| {
        let output = lgp(here, args);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(message.contains(expected), "{args:?}: {message}");
        assert!([Some(1), Some(3)].contains(&output.status.code()), "{message}");
    };
    link("census.json", "/dev/zero");
    refused(&["analyze", "run"], "it is not a file");
    for file in FILES[..4].iter().rev() {
        link(file, "/dev/zero");
        refused(&["report", "run"], "it is not a file");
    }
    let victim = here.join("victim");
    std::fs::write(&victim, "mine").unwrap();
    let lock: PathBuf = link("lock", victim.to_str().unwrap());
    refused(&["search", "--resume", "--out", "run"], "it is not a file");
    std::fs::remove_file(lock).unwrap();
    assert_eq!(std::fs::read_to_string(&victim).unwrap(), "mine");

    let out = here.join("new");
    std::fs::create_dir_all(here.join("elsewhere")).unwrap();
    std::fs::create_dir_all(&out).unwrap();
    std::os::unix::fs::symlink(here.join("elsewhere"), out.join("snippets")).unwrap();
    refused(&["search", "d.bin", "--generations", "1", "--islands", "1", "--out", "new"], "a link");
    assert_eq!(here.join("elsewhere").read_dir().unwrap().count(), 0);
}
