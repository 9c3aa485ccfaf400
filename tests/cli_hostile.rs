//! The command line among files and names that mean it harm: nothing is written through, read for ever or
//! taken for something else.

#![cfg(feature = "cli")]
#![cfg(unix)]

use lgp::dataset::{Dataset, Origin, axis};
use std::ffi::{OsStr, OsString};
use std::os::unix::ffi::{OsStrExt, OsStringExt};
use std::os::unix::fs::{FileTypeExt, symlink};
use std::os::unix::net::UnixListener;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const FAILED: i32 = 1;
const USAGE: i32 = 2;
const INPUT: i32 = 3;

struct Said {
    code: i32,
    stdout: String,
    stderr: String,
}

/// Runs a command that is to end soon, whatever it is given.
fn lgp<S: AsRef<OsStr>>(folder: &Path, arguments: &[S]) -> Said {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lgp"));
    command.current_dir(folder).args(arguments).stdin(Stdio::null());
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > Duration::from_secs(60) {
            child.kill().unwrap();
            panic!("it does not end");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    let output = child.wait_with_output().unwrap();
    let [stdout, stderr] = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
    assert!(!stderr.contains("panicked"), "{stderr}");
    Said { code: output.status.code().expect("it was not killed"), stdout, stderr }
}

/// Names that are a path, a command of a terminal, or turn what is read.
const NAMES: [&str; 9] =
    ["../../x", "/etc/x", "", ".", "..", "a\0b", "\u{1b}[31mred", "\u{202e}gpj.exe", "a\nb"];

fn line() -> Dataset {
    let line = Dataset::sampled([axis("x", 0.0..=1.0)], ["y"], |x| x).unwrap();
    Dataset { name: "line".into(), ..line }
}

/// A folder with a dataset, a table, and a run of a generation.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    line().save(&folder.path().join("line.bin")).unwrap();
    std::fs::write(folder.path().join("line.csv"), "x,y\n0,0\n1,1\n").unwrap();
    let search = ["search", "line.bin", "--generations", "1", "--islands", "1", "--out", "run"];
    let said = lgp(folder.path(), &search);
    assert_eq!(said.code, 0, "{}", said.stderr);
    folder
}

/// Every command that writes a file, with where it is to write it last.
const WRITERS: [&[&str]; 4] = [
    &["import", "line.csv", "--inputs", "1", "-o"],
    &["generate", "fresnel", "-o"],
    &["report", "run", "run", "-o"],
    &["scene", "from", "line.csv", "--inputs", "x", "-o"],
];

#[test]
fn no_output_takes_the_place_of_what_is_no_file() {
    let folder = folder();
    let here = folder.path();
    std::fs::create_dir(here.join("sub")).unwrap();
    symlink("sub", here.join("link-to-sub")).unwrap();
    assert!(Command::new("mkfifo").arg(here.join("pipe")).status().unwrap().success());
    let _socket = UnixListener::bind(here.join("socket")).unwrap();
    for writer in WRITERS {
        for (target, reason) in [
            ("sub", "a folder"),
            ("link-to-sub", "a folder"),
            ("pipe", "a pipe"),
            ("socket", "a socket"),
        ] {
            let said = lgp(here, &[writer, &[target]].concat());
            assert_eq!(said.code, FAILED, "{writer:?} {target}: {}", said.stderr);
            assert!(said.stderr.contains(reason), "{writer:?} {target}: {}", said.stderr);
        }
    }
    let kind = |name: &str| here.join(name).symlink_metadata().unwrap().file_type();
    assert!(kind("sub").is_dir() && kind("link-to-sub").is_symlink());
    assert!(kind("pipe").is_fifo() && kind("socket").is_socket());
    assert_eq!(here.join("sub").read_dir().unwrap().count(), 0);
}

#[test]
fn a_link_at_an_output_is_replaced_and_never_written_through() {
    let folder = folder();
    let here = folder.path();
    let elsewhere = TempDir::new().unwrap();
    let precious = elsewhere.path().join("precious");
    std::fs::write(&precious, "as it was").unwrap();
    for writer in WRITERS {
        for target in [precious.as_path(), Path::new("/dev/null")] {
            let link = here.join("link");
            let _ = std::fs::remove_file(&link);
            symlink(target, &link).unwrap();
            let said = lgp(here, &[writer, &["link"]].concat());
            assert_eq!(said.code, 0, "{writer:?}: {}", said.stderr);
            assert!(link.symlink_metadata().unwrap().is_file(), "{writer:?}");
        }
    }
    assert_eq!(std::fs::read_to_string(&precious).unwrap(), "as it was");
    assert!(Path::new("/dev/null").metadata().unwrap().file_type().is_char_device());
}

#[test]
fn a_run_writes_through_no_link_within_its_folder() {
    let folder = folder();
    let here = folder.path();
    let elsewhere = TempDir::new().unwrap();
    let precious = elsewhere.path().join("01.hlsl");
    std::fs::write(&precious, "as it was").unwrap();
    std::fs::create_dir(here.join("union")).unwrap();
    symlink(elsewhere.path(), here.join("union/snippets")).unwrap();
    let said = lgp(here, &["merge", "run", "--out", "union"]);
    assert!(said.code == 0 || said.code == FAILED, "{}", said.stderr);
    assert_eq!(std::fs::read_to_string(&precious).unwrap(), "as it was");
    assert_eq!(elsewhere.path().read_dir().unwrap().count(), 1);
}

#[test]
fn a_dataset_is_called_nothing_that_acts() {
    let folder = folder();
    let here = folder.path();
    for name in NAMES {
        let hostile = Dataset { name: name.into(), ..line() };
        assert!(hostile.save(&here.join("hostile.bin")).is_err(), "{name:?}");
        let mut hostile = line();
        hostile.inputs[0].name = name.into();
        assert!(hostile.save(&here.join("hostile.bin")).is_err(), "{name:?}");
    }
    let mut hostile = line();
    hostile.inputs[0].domain = [0.0, 1e300];
    let refused = hostile.save(&here.join("hostile.bin")).unwrap_err().to_string();
    assert!(refused.contains("[0, 1e300]"), "{refused}");
    // As a file that another program wrote.
    for (at, name) in NAMES.iter().enumerate().filter(|(_, name)| !name.is_empty()) {
        let path = here.join(format!("hostile{at}.bin"));
        std::fs::write(&path, renamed(&std::fs::read(here.join("line.bin")).unwrap(), name))
            .unwrap();
        for command in [&["info"][..], &["search", "--generations", "1"]] {
            let mut words: Vec<OsString> = command.iter().map(OsString::from).collect();
            words.insert(1, path.clone().into());
            let said = lgp(here, &words);
            assert_eq!(said.code, INPUT, "{name:?}: {}", said.stderr);
            assert!(said.stderr.contains("cannot be called"), "{name:?}: {}", said.stderr);
            assert_calm(&said);
            assert_eq!(said.stderr.trim_end().lines().count(), 1, "{name:?}: {}", said.stderr);
        }
    }
    assert!(!here.join("runs").exists());
}

/// The bytes of a dataset's file with another name, and the checksum of that.
fn renamed(bytes: &[u8], name: &str) -> Vec<u8> {
    let header = usize::try_from(u32::from_le_bytes(bytes[8..12].try_into().unwrap())).unwrap();
    let text = std::str::from_utf8(&bytes[12..12 + header]).unwrap();
    let text = text.replacen("\"line\"", &ron::to_string(name).unwrap(), 1);
    let mut made = bytes[..8].to_vec();
    made.extend_from_slice(&(text.len() as u32).to_le_bytes());
    made.extend_from_slice(text.as_bytes());
    made.extend_from_slice(&bytes[12 + header..bytes.len() - 32]);
    let checksum = blake3::hash(&made);
    made.extend_from_slice(checksum.as_bytes());
    made
}

/// Nothing that was said acts on a terminal.
fn assert_calm(said: &Said) {
    for text in [&said.stdout, &said.stderr] {
        let acts = |c: char| c.is_control() && c != '\n' || ('\u{202a}'..='\u{202e}').contains(&c);
        assert!(!text.contains(acts), "{text:?}");
    }
}

#[test]
fn what_is_said_of_hostile_text_is_escaped() {
    let folder = folder();
    let here = folder.path();
    let hostile = "\u{1b}]0;owned\u{7}\u{202e}";
    let file = format!("{hostile}.bin");
    std::fs::write(here.join(&file), "no dataset").unwrap();
    std::fs::write(here.join("hostile.csv"), format!("x,{hostile}\n0,0\n")).unwrap();
    std::fs::write(here.join("cell.csv"), format!("x,y\n0,{hostile}\n")).unwrap();
    std::fs::write(here.join("grammar.ron"), format!("(operations: [\"{hostile}\"])")).unwrap();
    std::fs::write(here.join("recipe.ron"), format!("(target: \"{hostile}\")")).unwrap();
    let formula = format!("y = {hostile}");
    let missing = format!("{hostile}/none.csv");
    for words in [
        &["info", &file][..],
        &["info", hostile],
        &["import", "cell.csv", "--inputs", "1", "-o", "x.bin"],
        &["import", &missing, "--inputs", "1", "-o", "x.bin"],
        &["search", "line.bin", "--grammar", "grammar.ron"],
        &["search", "line.bin", "--gpu", "grammar.ron"],
        &["search", "line.bin", "--scene", hostile],
        &["generate", "recipe.ron"],
        &["eval", &formula, "line.bin"],
        &["cost", &formula],
        &["front", hostile],
        &["verify", hostile, "line.bin"],
        &["emit", "run", "--lang", "hlsl", "--pick", hostile],
    ] {
        let said = lgp(here, words);
        assert!(said.code == USAGE || said.code == INPUT, "{words:?}: {}", said.stderr);
        assert_calm(&said);
    }
    // Names that are no identifiers are mapped, and said.
    for words in [&["import", "hostile.csv", "-o", "x.bin"][..], &["info", "x.bin"]] {
        let said = lgp(here, words);
        assert_eq!(said.code, 0, "{}", said.stderr);
        assert!(said.stdout.contains("_0_owned"), "{}", said.stdout);
        assert_calm(&said);
    }
    let text = format!("made by {hostile}\nand more");
    let recipe = Dataset { origin: Origin::Formula { text }, ..line() };
    recipe.save(&here.join("recipe.bin")).unwrap();
    for words in [&["info", "recipe.bin"][..], &["info", "recipe.bin", "--json"]] {
        let said = lgp(here, words);
        assert_eq!(said.code, 0, "{}", said.stderr);
        assert_calm(&said);
    }
    let said = lgp(here, &["info", "recipe.bin", "--json"]);
    let said: serde_json::Value = serde_json::from_str(&said.stdout).unwrap();
    assert_eq!(said["recipe"], recipe.origin.to_string(), "escaped JSON says the same");
}

/// Every command that reads a file, with what it is given of it last.
const READERS: [&[&str]; 12] = [
    &["info"],
    &["search", "--generations", "1", "--out", "other"],
    &["import", "--inputs", "1", "-o", "x.bin"],
    &["eval", "y = x"],
    &["fit", "y = $a*x"],
    &["check", "y = x"],
    &["search", "line.bin", "--generations", "1", "--out", "other", "--grammar"],
    &["search", "line.bin", "--generations", "1", "--out", "other", "--gpu"],
    &["search", "line.bin", "--generations", "1", "--out", "other", "--scene"],
    &["cost", "y = x", "--gpu"],
    &["scene", "from", "-o", "scene.ron"],
    &["report", "run", "--dataset"],
];

#[test]
fn what_is_no_file_is_not_read_and_what_is_endless_not_to_its_end() {
    let folder = folder();
    let here = folder.path();
    assert!(Command::new("mkfifo").arg(here.join("pipe")).status().unwrap().success());
    std::fs::create_dir(here.join("sub.ron")).unwrap();
    let huge = std::fs::File::create(here.join("huge.ron")).unwrap();
    huge.set_len(1 << 40).unwrap();
    for reader in READERS {
        for (file, reason) in [
            ("/dev/zero", "a device"),
            ("pipe", "a pipe"),
            ("./sub.ron", "a folder"),
            ("./huge.ron", "longer than"),
        ] {
            // A name without an extension is looked for among those built in.
            let start = Instant::now();
            let said = lgp(here, &[reader, &[file]].concat());
            assert_eq!(said.code, INPUT, "{reader:?} {file}: {}", said.stderr);
            assert!(said.stderr.contains(reason), "{reader:?} {file}: {}", said.stderr);
            assert!(start.elapsed() < Duration::from_secs(10), "{reader:?} {file}");
        }
    }
}

#[test]
fn words_that_are_no_text_are_refused_or_taken_as_paths() {
    let folder = folder();
    let here = folder.path();
    let odd = OsString::from_vec(b"odd\xff.bin".to_vec());
    std::fs::copy(here.join("line.bin"), here.join(&odd)).unwrap();
    let word = |text: &str| OsString::from(text);
    let search = |more: &[OsString]| {
        let mut words = vec![word("search"), odd.clone()];
        words.extend(["--generations", "1", "--islands", "1", "--out"].map(OsString::from));
        words.extend_from_slice(more);
        lgp(here, &words)
    };
    let said = search(&[OsString::from_vec(b"run\xfe".to_vec())]);
    assert!(said.code == 0 || said.code == INPUT, "{}", said.stderr);
    for words in [
        vec![word("info"), odd.clone()],
        vec![word("info"), odd.clone(), word("--json")],
        vec![word("eval"), OsString::from_vec(b"y = \xff".to_vec()), odd.clone()],
        vec![OsString::from_vec(b"\xff".to_vec())],
    ] {
        let said = lgp(here, &words);
        let known = [0, USAGE, INPUT];
        assert!(known.contains(&said.code), "{words:?}: {} {}", said.code, said.stderr);
    }
    assert!(here.join(OsStr::from_bytes(b"odd\xff.bin")).is_file());
}

#[test]
fn bounds_beyond_single_precision_are_refused() {
    let folder = folder();
    let fit = |option: &str, value: &str| {
        lgp(folder.path(), &["fit", "y = $a*x", "line.bin", option, value])
    };
    for (option, value) in [
        ("--bounds", "a=1e39..1e40"),
        ("--bounds", "a=-1e40..-1e39"),
        ("--bounds", "a=inf.."),
        ("--bounds", "a=nan..1"),
        ("--bounds", "a=0..nan"),
        ("--start", "a=1e39"),
        ("--start", "a=nan"),
    ] {
        let said = fit(option, value);
        assert_eq!(said.code, USAGE, "{option} {value}: {}", said.stderr);
    }
    let said = fit("--bounds", "a=..0.5");
    assert_eq!(said.code, 0, "{}", said.stderr);
}

#[test]
fn a_closed_terminal_is_no_panic() {
    let folder = folder();
    for words in [
        &["search", "line.bin", "--generations", "1", "--islands", "1", "--out", "other"][..],
        &["merge", "run", "--out", "union"],
        &["report", "run"],
        &["info", "none.bin"],
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lgp"));
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        command.current_dir(folder.path()).args(words).stdout(Stdio::null()).stderr(writer);
        let code = command.status().unwrap().code();
        assert!([Some(0), Some(INPUT)].contains(&code), "{words:?}: {code:?}");
    }
}
