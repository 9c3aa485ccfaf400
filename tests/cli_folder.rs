//! What a search leaves in its folder, whatever is there already and whatever becomes of the disk.

#![cfg(feature = "cli")]

mod command;

use command::{command, lgp, text};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const SHORT: [&str; 6] = ["search", "d.bin", "--generations", "2", "--islands", "1"];

fn succeed(folder: &Path, args: &[&str]) -> Output {
    let output = lgp(folder, args);
    assert!(output.status.success(), "{args:?}: {}", text(&output.stderr));
    output
}

fn refuse(folder: &Path, args: &[&str], code: i32, expected: &str) {
    let output = lgp(folder, args);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {message}");
    assert!(message.contains(expected), "{args:?}: {expected} is not in {message}");
    assert!(output.stdout.is_empty(), "{args:?}");
}

/// A folder with a dataset `d.bin`, `sqrt(x) + y/4`.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let value = |i: usize| (i as f32 + 0.5) / 8.0;
    let row = |i: usize| {
        let (x, y) = (value(i % 8), value(i / 8));
        format!("{x},{y},{}\n", x.sqrt() + 0.25 * y)
    };
    let rows: String = (0..64).map(row).collect();
    fs::write(folder.path().join("d.csv"), format!("x,y,z\n{rows}")).unwrap();
    succeed(folder.path(), &["import", "d.csv", "-o", "d.bin", "--inputs", "2", "--quiet"]);
    folder
}

fn read(path: PathBuf) -> String {
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A search that goes on until it is told to stop, once it has written a checkpoint.
fn running(folder: &Path, out: &str) -> Child {
    let args = ["search", "d.bin", "--time", "60s", "--islands", "1", "--out", out];
    let mut command = command(folder, &args);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    await_checkpoint(&folder.join(out));
    child
}

fn await_checkpoint(run: &Path) {
    let start = Instant::now();
    while !run.join("checkpoint.bin").exists() {
        assert!(start.elapsed() < Duration::from_secs(20), "no checkpoint");
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn signal(child: &Child, signal: &str) {
    let kill = Command::new("kill").args([signal, &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
}

#[test]
fn a_finished_run_is_not_overwritten_unasked() {
    let folder = folder();
    let here = folder.path();
    succeed(here, &SHORT);
    let first = read(here.join("runs/d/run.ron"));
    let second = succeed(here, &[&SHORT[..], &["--seed", "2"]].concat());
    assert!(text(&second.stderr).contains("runs/d is taken; this run goes to runs/d-2"));
    assert_eq!(first, read(here.join("runs/d/run.ron")));
    assert!(read(here.join("runs/d-2/run.ron")).contains("seed: 2,"));

    let out = [&SHORT[..], &["--seed", "3", "--out", "runs/d"]].concat();
    refuse(here, &out, 2, "--resume, replace it by --force, or choose another --out");
    assert_eq!(first, read(here.join("runs/d/run.ron")));
    succeed(here, &[&out[..], &["--force"]].concat());
    assert!(read(here.join("runs/d/run.ron")).contains("seed: 3,"));
    succeed(here, &["front", "runs/d"]);

    fs::create_dir(here.join("mine")).unwrap();
    fs::write(here.join("mine/report.html"), "mine").unwrap();
    let mine = [&SHORT[..], &["--out", "mine", "--force"]].concat();
    refuse(here, &mine, 2, "`report.html`, which is no run's");
    refuse(here, &["merge", "runs/d", "--out", "mine"], 2, "`report.html`, which is no run's");
    assert_eq!(read(here.join("mine/report.html")), "mine");
}

#[test]
fn a_search_is_resumed_by_its_folder_alone() {
    let folder = folder();
    let here = folder.path();
    let whole =
        ["--generations", "4", "--islands", "2", "--require", "uses=y", "--gpu", "mine.ron"];
    let profile = Path::new(env!("CARGO_MANIFEST_DIR")).join("grammar/gpu/turing.ron");
    fs::copy(profile, here.join("mine.ron")).unwrap();
    let whole = |out, n| {
        let mut args = [&["search", "d.bin"], &whole[..], &["--out", out]].concat();
        args[3] = n;
        succeed(here, &args)
    };
    whole("whole", "4");
    whole("parts", "2");
    // The profile's file changes, and the data go elsewhere: the run has the one, and is told the other.
    fs::write(here.join("mine.ron"), "()").unwrap();
    fs::rename(here.join("d.bin"), here.join("e.bin")).unwrap();
    let resume = ["search", "--resume", "--out", "parts"];
    refuse(here, &[&resume[..], &["--generations", "4"]].concat(), 3, "d.bin");
    let resume = [&resume[..], &["e.bin"]].concat();
    for (options, code, expected) in [
        (&[][..], 2, "the run has ended"),
        (&["--generations", "1"], 2, "has done 2 already"),
        (&["--time", "0.001s"], 2, "is for all of it"),
        (&["--generations", "4", "--seed", "9"], 3, "--seed 1, not 9"),
        (&["--generations", "4", "--islands", "3"], 3, "--islands 2, not 3"),
        (&["--generations", "4", "--gpu", "gcn"], 3, "--gpu mine.ron (content"),
        (&["--generations", "4", "--grammar", "exp2"], 3, "--grammar shader (content"),
        (&["--generations", "4", "--require", "finite"], 3, "--require uses=y, not finite"),
        (&["--generations", "4", "--max-cost", "3"], 3, "--max-cost 40, not 3"),
        (&["--generations", "4", "--inputs", "x"], 3, "--inputs x,y, not x"),
        (&["--generations", "4", "--guess", "z = x"], 3, "no --guess, not z = x"),
        (&["--generations", "4", "--loss", "max"], 3, "--loss rmse, not max"),
    ] {
        refuse(here, &[&resume[..], options].concat(), code, expected);
    }
    let same = ["--generations", "4", "--seed", "1", "--inputs", "x,y", "--require", "uses=y"];
    succeed(here, &[&resume[..], &same].concat());
    assert_eq!(read(here.join("whole/front.json")), read(here.join("parts/front.json")));
    // What a run costs is known without the profile's file, and from anywhere.
    let parts = here.join("parts");
    let elsewhere = tempfile::tempdir().unwrap();
    for args in [&["front"][..], &["emit", "--lang", "wgsl"], &["report"], &["analyze"]] {
        succeed(elsewhere.path(), &[args, &[parts.to_str().unwrap()]].concat());
    }
    fs::rename(here.join("e.bin"), here.join("d.bin")).unwrap();
    let report = succeed(elsewhere.path(), &["report", parts.to_str().unwrap()]);
    assert!(!text(&report.stderr).contains("no maps"), "{}", text(&report.stderr));
}

#[test]
fn runs_are_compared_by_what_their_grammars_said() {
    let folder = folder();
    let here = folder.path();
    let grammar = |name: &str, op: &str| {
        let text = format!("(operations: {{\"add\": 1, \"{op}\": 1}}, max_instructions: 9)");
        fs::write(here.join(name), text).unwrap();
    };
    let search = |grammar: &str, out: &str| {
        let args = [&SHORT[..], &["--grammar", grammar, "--out", out, "--quiet"]].concat();
        succeed(here, &args);
    };
    grammar("my.ron", "mul");
    search("my.ron", "a");
    grammar("my.ron", "max");
    search("my.ron", "b");
    grammar("other.ron", "mul");
    search("other.ron", "c");
    refuse(here, &["merge", "a", "b", "--out", "all"], 3, "grammar: my.ron (content");
    succeed(here, &["merge", "a", "c", "--out", "all"]);
}

#[test]
fn one_process_owns_a_folder() {
    let folder = folder();
    let here = folder.path();
    let mut child = running(here, "runs/d");
    refuse(here, &["search", "--resume", "--out", "runs/d"], 1, &format!("process {}", child.id()));
    let other = [&SHORT[..], &["--out", "runs/d", "--force"]].concat();
    refuse(here, &other, 1, "in use by process");
    refuse(here, &["front", "runs/d"], 3, "--resume");
    // Unasked, a second search goes elsewhere.
    let second = succeed(here, &SHORT);
    assert!(text(&second.stderr).contains("this run goes to runs/d-2"));
    child.kill().unwrap();
    child.wait().unwrap();
    // The lock of a process that is gone means nothing.
    assert!(here.join("runs/d/lock").exists());
    succeed(here, &["search", "--resume", "--out", "runs/d", "--time", "2s"]);
    succeed(here, &["front", "runs/d"]);
    assert!(!here.join("runs/d/lock").exists());
}

#[cfg(unix)]
#[test]
fn signals_that_end_a_process_keep_what_was_found() {
    let folder = folder();
    let here = folder.path();
    let names = ["-INT", "-TERM", "-HUP"];
    for name in &names[..if hangups_are_ignored() { 2 } else { 3 }] {
        let child = running(here, name.trim_start_matches('-'));
        std::thread::sleep(Duration::from_millis(300));
        signal(&child, name);
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130), "{name}: {}", text(&output.stderr));
        assert!(text(&output.stdout).contains("cycles"), "{name}");
        succeed(here, &["front", name.trim_start_matches('-')]);
    }
}

/// Where the tests themselves run under `nohup`, what they start ignores hangups, too.
#[cfg(unix)]
fn hangups_are_ignored() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0) & 1 != 0
}

/// As under `nohup`: a closed terminal ends nothing, but what asks for an end is heard.
#[cfg(target_os = "linux")]
#[test]
fn where_hangups_are_ignored_other_signals_are_heard() {
    let folder = folder();
    let here = folder.path();
    let program = command(Path::new("."), &[]).get_program().to_owned();
    let script = format!(
        "trap '' HUP; exec '{}' search d.bin --time 60s --islands 1 --out run",
        program.display()
    );
    let mut command = Command::new("sh");
    command.current_dir(here).args(["-c", &script]).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    await_checkpoint(&here.join("run"));
    signal(&child, "-HUP");
    std::thread::sleep(Duration::from_millis(500));
    assert!(child.try_wait().unwrap().is_none(), "a hangup has ended it");
    signal(&child, "-TERM");
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("cycles"));
}

/// Writing fails beyond so many bytes, as on a full disk.
#[cfg(unix)]
#[test]
fn a_front_is_shown_though_the_disk_is_full() {
    let folder = folder();
    let here = folder.path();
    let program = command(Path::new("."), &[]).get_program().to_owned();
    let script = format!(
        "trap '' XFSZ; ulimit -f 1; exec '{}' {} --out full",
        program.display(),
        SHORT.join(" ")
    );
    let search = || Command::new("sh").current_dir(here).args(["-c", &script]).output().unwrap();
    let output = search();
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("the search goes on") && message.contains("full/"), "{message}");
    assert!(text(&output.stdout).contains("RMSE"), "{message}");
    let left: Vec<_> = here.join("full").read_dir().unwrap().flatten().collect();
    assert!(left.iter().all(|file| file.path().is_dir()), "{left:?}");
    refuse(here, &["front", "full"], 3, "holds no whole run");

    // A run that is there stays as it was.
    succeed(here, &[&SHORT[..], &["--out", "full"]].concat());
    let (run, front) = (read(here.join("full/run.ron")), read(here.join("full/front.json")));
    let script = script
        .replace("search d.bin", "search --resume")
        .replace("--generations 2", "--generations 3");
    let script = script.replace("--islands 1", "");
    let output = Command::new("sh").current_dir(here).args(["-c", &script]).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("RMSE"));
    assert_eq!((run, front), (read(here.join("full/run.ron")), read(here.join("full/front.json"))));
    succeed(here, &["front", "full"]);
}

/// A file system of each size up to one on which all fits: the front is shown, what is left is whole, and with
/// more space the search goes on. Only where this user may mount one.
#[cfg(target_os = "linux")]
#[test]
fn a_small_disk_fills_up_at_any_file() {
    let may_mount = || {
        let script = "mount -t tmpfs tmpfs /mnt";
        Command::new("unshare")
            .args(["-rm", "sh", "-c", script])
            .output()
            .ok()?
            .status
            .success()
            .then_some(())
    };
    if may_mount().is_none() {
        eprintln!("SKIPPED: this user may not mount a file system");
        return;
    }
    let folder = folder();
    let here = folder.path();
    fs::create_dir(here.join("disk")).unwrap();
    let program = command(Path::new("."), &[]).get_program().to_owned();
    let script = format!(
        "mount -t tmpfs -o size=$SIZE tmpfs disk; '{0}' {1} --out disk/run; echo code $?; '{0}' front disk/run; \
         echo code $?; mount -o remount,size=8m disk; '{0}' search --resume --generations 3 --out disk/run; \
         echo code $?; '{0}' front disk/run; echo code $?",
        program.display(),
        SHORT.join(" ")
    );
    let mut ends = Vec::new();
    for kilobytes in [20, 100, 180, 300, 450, 700, 900, 2000] {
        let mut command = Command::new("unshare");
        command.current_dir(here).env("SIZE", format!("{kilobytes}k"));
        let output = command.args(["-rm", "sh", "-c", &script]).output().unwrap();
        let (shown, said) = (text(&output.stdout), text(&output.stderr));
        let codes: Vec<&str> =
            shown.lines().filter_map(|line| line.strip_prefix("code ")).collect();
        let end = codes.join(" ");
        assert!(
            shown.starts_with("   #  cycles"),
            "{kilobytes} kB: the front is not shown: {said}"
        );
        assert!(codes[0] == "0" || said.contains("free some space"), "{kilobytes} kB: {said}");
        assert!(!said.contains("panicked"), "{kilobytes} kB: {said}");
        // All fitted; all but some pictures; a search to go on with; not even that.
        let known = ["0 0 0 0", "1 0 0 0", "1 3 0 0", "1 3 3 3"];
        assert!(known.contains(&end.as_str()), "{kilobytes} kB: {end}: {said}");
        ends.push(end);
    }
    assert!(ends[0] == "1 3 3 3" && ends.last().unwrap() == "0 0 0 0", "{ends:?}");
    assert!(ends.contains(&"1 3 0 0".to_owned()), "{ends:?}");
}

#[test]
fn what_cannot_be_found_is_said() {
    let folder = folder();
    let here = folder.path();
    let polynomial = [&SHORT[..], &["--grammar", "polynomial"]].concat();
    let uses = [&polynomial[..], &["--require", "uses=tan"]].concat();
    refuse(here, &uses, 2, "the grammar polynomial has no `tan` (it has add, sub, mul)");
    refuse(here, &[&SHORT[..], &["--loss", "weighted"]].concat(), 2, "has no weights");
    let guess =
        succeed(here, &[&polynomial[..], &["--guess", "z = tan(x)", "--out", "g"]].concat());
    assert!(text(&guess.stderr).contains("the grammar polynomial has no `tan`"));

    let narrow = ["--require", "uses=exp2", "--max-cost", "0", "--out", "none"];
    let output = lgp(here, &[&SHORT[..], &narrow].concat());
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(4), "{message}");
    assert!(message.contains("no formula was found: "), "{message}");

    refuse(here, &["front", "nowhere"], 3, "no such folder");
    fs::create_dir(here.join("empty")).unwrap();
    fs::write(here.join("empty/lock"), "1 1").unwrap();
    refuse(here, &["front", "empty"], 3, "holds no whole run");
    let emit = ["emit", "g", "--lang", "hlsl", "--max-error", "1e-12"];
    refuse(here, &emit, 4, "the least error there is");
}
