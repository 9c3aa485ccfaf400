//! A search is killed before each of its file operations: what is left is whole, and of one run.
//!
//! The process that is killed is this test itself, started again. `LGP_KILLS=all` kills at every operation, not
//! at some spread evenly.

#![cfg(feature = "cli")]

use lgp::file::witness_file_operations;
use lgp::run::{Checkpoint, Holding, load_front, load_run};
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The operation before which the process ends, and the command that it runs.
const KILL_AT: &str = "LGP_KILL_AT";
const WORDS: &str = "LGP_WORDS";

/// Kills of each kind, unless all are asked for.
const KILLS: usize = 33;

static OPERATIONS: AtomicUsize = AtomicUsize::new(0);
static LAST: AtomicUsize = AtomicUsize::new(usize::MAX);

/// Not a test, but the process that is killed.
#[test]
fn the_process() {
    let (Ok(kill_at), Ok(words)) = (std::env::var(KILL_AT), std::env::var(WORDS)) else { return };
    LAST.store(kill_at.parse().unwrap(), Ordering::Relaxed);
    witness_file_operations(|_, _| {
        if OPERATIONS.fetch_add(1, Ordering::Relaxed) == LAST.load(Ordering::Relaxed) {
            std::process::abort();
        }
    });
    let _ = lgp::cli::run_words(words.split(' ').map(Into::into));
    println!("operations: {}", OPERATIONS.load(Ordering::Relaxed));
}

/// Runs a command in a folder up to an operation; its end, and how many operations it did.
fn run(folder: &Path, words: &str, kill_at: usize) -> (ExitStatus, Option<usize>) {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.current_dir(folder).args(["--exact", "the_process", "--nocapture"]);
    command.env(KILL_AT, kill_at.to_string()).env(WORDS, format!("lgp {words}"));
    let output = command.stderr(Stdio::null()).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let count = text.lines().find_map(|line| line.strip_prefix("operations: ")?.parse().ok());
    (output.status, count)
}

fn whole(folder: &Path, words: &str) -> usize {
    let (status, count) = run(folder, words, usize::MAX - 1);
    assert!(status.success(), "{words}");
    count.expect("it has ended")
}

const SHORT: &str = "search d.bin --islands 1 --threads 1 --max-cost 4 --quiet --out run";

fn dataset(folder: &Path) {
    let row = |i: usize| format!("{i},{}\n", (i as f32).sqrt());
    let rows: String = (0..40).map(row).collect();
    std::fs::write(folder.join("d.csv"), format!("x,y\n{rows}")).unwrap();
    whole(folder, "import d.csv -o d.bin --inputs 1 --quiet");
}

/// A whole run's generations, seed, and fronts; nothing where there is none.
#[derive(Clone, Debug, PartialEq)]
struct Left {
    seed: u64,
    generations: u64,
    fronts: [String; 2],
}

fn left(folder: &Path) -> Option<Left> {
    let run = match load_run(folder) {
        Ok(run) => run,
        Err(error) => {
            let message = error.to_string();
            assert!(Holding::of(folder) != Holding::Finished, "{message}");
            assert!(message.contains("holds no whole run") || message.contains("no such folder"));
            return None;
        }
    };
    let names = run.names();
    let front = |minimax| load_front(folder, &run, minimax).unwrap().to_json(&names);
    let text = std::fs::read_to_string(folder.join("front.json")).unwrap();
    let fronts = [front(false), front(true)];
    assert_eq!(fronts[0], text);
    let snippets = folder.join("snippets").read_dir().unwrap().flatten();
    let whole = |file: &std::fs::DirEntry| !file.file_name().to_string_lossy().starts_with('.');
    let snippets = snippets.filter(whole).count();
    let languages = lgp::emit::Language::OF_RUNS.len();
    assert_eq!(snippets, languages * text.matches("\"formula\"").count(), "of another front");
    Some(Left { seed: run.method.seed, generations: run.generations, fronts })
}

/// Kills `words` again and again, from the state that `before` makes. What is left is what was there before, what
/// is there without a kill, or a search that can be resumed to the same end.
fn killed(before: &[&str], words: &str) -> usize {
    let state = || {
        let folder = tempfile::tempdir().unwrap();
        dataset(folder.path());
        before.iter().for_each(|words| {
            whole(folder.path(), words);
        });
        folder
    };
    let folder = state();
    let old = left(&folder.path().join("run"));
    let operations = whole(folder.path(), words);
    let new = left(&folder.path().join("run"));
    assert!(new.is_some() && new != old);
    let all = std::env::var("LGP_KILLS").is_ok_and(|kills| kills == "all");
    let kills = if all { operations } else { KILLS.min(operations) };
    for kill in 0..kills {
        let at = kill * operations / kills;
        let folder = state();
        let (status, count) = run(folder.path(), words, at);
        let run_folder = folder.path().join("run");
        // A picture of how the search went on is drawn only if that took long enough.
        if let Some(fewer) = count {
            assert!(status.success() && at + 9 >= operations, "{words}: {fewer} operations");
            assert_eq!(left(&run_folder), new);
            continue;
        }
        assert!(!status.success(), "{words}: not killed at {at}");
        let found = left(&run_folder);
        assert!(found.is_none() || found == old || found == new, "{words}: killed at {at}");
        let checkpoint = run_folder.join("checkpoint.bin").exists();
        let loaded = checkpoint.then(|| Checkpoint::load(&run_folder).unwrap());
        assert!(checkpoint || (found.is_none() && old.is_none()), "{words}: lost at {at}");
        if let Some(Checkpoint { run: begun, .. }) = loaded {
            // To the end that it was to have.
            let goes_on = if Some(begun.method.seed) == new.as_ref().map(|new| new.seed) {
                &new
            } else {
                &old
            };
            let resume = match (goes_on == &new, &goes_on) {
                (true, Some(new)) => {
                    format!("search --resume --quiet --out run --generations {}", new.generations)
                }
                _ => "search --resume --quiet --out run".to_owned(),
            };
            let (_, count) = run(folder.path(), &resume, usize::MAX - 1);
            assert!(count.is_some());
            assert_eq!(&left(&run_folder), goes_on, "{words}: resumed after a kill at {at}");
        }
        let names =
            run_folder.read_dir().into_iter().flatten().flatten().map(|file| file.file_name());
        let temporary = |name: &std::ffi::OsString| name.to_string_lossy().starts_with(".lgp-");
        assert!(!checkpoint || !names.into_iter().any(|name| temporary(&name)), "litter, {at}");
    }
    eprintln!("{words}: {kills} kills in {operations} operations");
    kills
}

#[test]
fn a_search_that_is_killed_leaves_what_is_whole() {
    killed(&[], &format!("{SHORT} --generations 2"));
}

#[test]
fn a_search_that_goes_on_and_is_killed_leaves_what_is_whole() {
    let first = format!("{SHORT} --generations 1");
    killed(&[&first], "search --resume --quiet --out run --threads 1 --generations 3");
}

#[test]
fn a_search_that_replaces_another_and_is_killed_leaves_one_of_them() {
    let first = format!("{SHORT} --generations 1");
    killed(&[&first], &format!("{SHORT} --generations 2 --seed 2 --force"));
}

#[test]
fn a_search_with_a_template_that_is_killed_leaves_what_is_whole() {
    killed(&[], &format!("{SHORT} --template y=f(x)*$a+1 --generations 2"));
}
