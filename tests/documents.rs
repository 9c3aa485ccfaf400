//! What the README, the guide and the help texts say: every command in them is one, every link leads somewhere,
//! and the program in the guide is the one that is compiled.

#![cfg(feature = "cli")]

#[path = "../examples/sampled_function.rs"]
mod sampled_function;

use clap::error::ErrorKind;
use lgp::program::{Scope, parse_template};
use std::collections::BTreeSet;
use std::fs::read_to_string;
use std::path::{Path, PathBuf};

const GUIDE: &str = "docs/guide/src";

/// A command line, and the line of the document on which it begins.
struct Found {
    line: usize,
    words: Vec<String>,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The Markdown files below a folder of the repository.
fn markdown_in(folder: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in folder.read_dir().unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => folders.push(path),
                false if path.extension().is_some_and(|extension| extension == "md") => {
                    found.push(path);
                }
                false => {}
            }
        }
    }
    found.sort();
    found
}

fn documents() -> Vec<PathBuf> {
    let mut files = vec![root().join("README.md"), root().join("benches/README.md")];
    files.extend(markdown_in(GUIDE));
    files.extend(markdown_in("results"));
    files
}

/// The text with its fenced blocks empty, and the lines of the blocks.
fn apart(text: &str) -> (String, Vec<(usize, &str)>) {
    let (mut prose, mut blocks, mut inside) = (String::new(), Vec::new(), false);
    for (number, line) in (1..).zip(text.lines()) {
        let is_fence = line.trim_start().starts_with("```");
        if inside && !is_fence {
            blocks.push((number, line));
        }
        if !inside && !is_fence {
            prose += line;
        }
        inside ^= is_fence;
        prose.push('\n');
    }
    assert!(!inside, "a block has no end");
    (prose, blocks)
}

/// What stands between backticks, and on which line it begins.
fn inline_code(prose: &str) -> Vec<(usize, String)> {
    let mut parts = prose.split('`');
    let mut line = 1 + parts.next().unwrap_or_default().matches('\n').count();
    let mut found = Vec::new();
    while let (Some(code), between) = (parts.next(), parts.next()) {
        found.push((line, code.replace('\n', " ")));
        line += code.matches('\n').count() + between.unwrap_or_default().matches('\n').count();
    }
    found
}

/// The commands of a line of shell.
fn shell(text: &str) -> Vec<Vec<String>> {
    let (mut commands, mut words, mut word) = (Vec::new(), Vec::new(), None::<String>);
    let mut quote = None;
    for c in text.chars() {
        match (quote, c) {
            (Some(open), c) if c == open => quote = None,
            (Some(_), c) => word.get_or_insert_default().push(c),
            (None, '\'' | '"') => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            (None, '#') if word.is_none() => break,
            (None, c) if c.is_whitespace() => words.extend(word.take()),
            (None, '|' | ';' | '&' | '>' | '<') => {
                words.extend(word.take());
                commands.push(std::mem::take(&mut words));
            }
            (None, c) => word.get_or_insert_default().push(c),
        }
    }
    assert_eq!(quote, None, "{text}: a quote has no end");
    words.extend(word);
    commands.push(words);
    commands
}

/// The words after `lgp`, where a command is one of its.
fn of_lgp(words: Vec<String>) -> Option<Vec<String>> {
    let is_setting = |word: &String| word.contains('=') && !word.contains(['/', ' ']);
    let words: Vec<String> = words.into_iter().skip_while(is_setting).collect();
    let words = match words.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["$", ..] => words[1..].to_vec(),
        ["cargo", "run", options @ ..] if !options.contains(&"--example") => {
            words[words.iter().position(|word| word == "--")?..].to_vec()
        }
        _ => words,
    };
    let is_program = |word: &str| matches!(word, "lgp" | "target/release/lgp" | "--");
    words.first().is_some_and(|word| is_program(word)).then(|| words[1..].to_vec())
}

/// The commands of fenced blocks, those on several lines as one.
fn commands_of_blocks(blocks: &[(usize, &str)]) -> Vec<Found> {
    let mut found = Vec::new();
    let mut lines = blocks.iter();
    while let Some(&(line, text)) = lines.next() {
        let mut text = text.to_owned();
        while let Some(begun) = text.trim_end().strip_suffix('\\') {
            let more = lines.next().map_or("", |(_, more)| *more);
            text = format!("{begun}{more}");
        }
        if text.contains("lgp ") || text.contains("cargo run") {
            let words = shell(&text).into_iter().filter_map(of_lgp);
            found.extend(words.map(|words| Found { line, words }));
        }
    }
    found
}

/// The commands within sentences; a subcommand's name by itself is none.
fn commands_of_prose(prose: &str) -> Vec<Found> {
    let command = lgp::cli::command();
    let mut found = Vec::new();
    for (line, code) in inline_code(prose) {
        if !code.starts_with("lgp ") && !code.starts_with("cargo run") {
            continue;
        }
        for words in shell(&code).into_iter().filter_map(of_lgp) {
            let named = words.iter().try_fold(&command, |at, word| at.find_subcommand(word));
            if named.is_none() {
                found.push(Found { line, words });
            }
        }
    }
    found
}

/// What is wrong with a command, if anything is.
fn fault(words: &[String]) -> Option<String> {
    let line = std::iter::once("lgp").chain(words.iter().map(String::as_str));
    match lgp::cli::command().try_get_matches_from(line) {
        Ok(_) => formula_fault(words),
        Err(error) if error.kind() == ErrorKind::DisplayHelp => None,
        Err(error) => Some(error.to_string()),
    }
}

/// What is wrong with a command's formula, if it has one.
fn formula_fault(words: &[String]) -> Option<String> {
    let takes_formula =
        ["eval", "cost", "check", "fit", "project", "specialize"].contains(&&*words[0]);
    let formula = words.get(1).filter(|word| takes_formula && word.contains('='))?;
    parse_template(formula, Scope::Open { outputs: &[] }).err().map(|error| error.to_string())
}

fn complain(place: &str, found: &[Found]) -> Vec<String> {
    let faulty = found.iter().filter_map(|one| Some((one, fault(&one.words)?)));
    faulty
        .map(|(Found { line, words }, fault)| format!("{place}:{line}: {words:?}: {fault}"))
        .collect()
}

#[test]
fn every_command_in_the_documents_is_understood() {
    let (mut faults, mut count) = (Vec::new(), 0);
    for file in documents() {
        let text = read_to_string(&file).unwrap();
        let (prose, blocks) = apart(&text);
        let mut found = commands_of_blocks(&blocks);
        found.extend(commands_of_prose(&prose));
        count += found.len();
        faults.extend(complain(&file.display().to_string(), &found));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(count > 60, "{count}");
}

#[test]
fn every_command_in_the_help_texts_is_understood() {
    let (mut faults, mut count) = (Vec::new(), 0);
    let mut waiting = vec![lgp::cli::command()];
    while let Some(mut command) = waiting.pop() {
        waiting.extend(command.get_subcommands().cloned());
        let help = command.render_long_help().to_string();
        let mut found = commands_of_prose(&help);
        for (line, text) in (1..).zip(help.lines()) {
            let example =
                text.find("For example: ").map_or(text.trim_start(), |at| &text[at + 13..]);
            // What a command does stands behind it.
            let example = example.split("   ").next().unwrap_or_default();
            if example.starts_with("lgp ") {
                let words = shell(example).into_iter().filter_map(of_lgp);
                found.extend(words.map(|words| Found { line, words }));
            }
        }
        count += found.len();
        faults.extend(complain(&format!("lgp {} --help", command.get_name()), &found));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(count > 10, "{count}");
}

#[test]
fn a_wrong_command_is_seen_wherever_it_stands() {
    let wrong = "```sh\n$ lgp search datasets/dfg.bin \\\n    --tim 5s | tail\n```\n\
        Write `lgp emit runs/dfg\n--lang nim` or `lgp emit` or `lgp --help`.\n\
        ```sh\ncargo run --release -- lst   # what there is\nlgp cost \"y = 1 +\"\n```\n";
    let (prose, blocks) = apart(wrong);
    let mut found = commands_of_blocks(&blocks);
    found.extend(commands_of_prose(&prose));
    let faulty = complain("d.md", &found);
    let places: Vec<_> = faulty.iter().map(|fault| fault.split('[').next().unwrap()).collect();
    assert_eq!(places, ["d.md:2: ", "d.md:8: ", "d.md:9: ", "d.md:5: "], "{faulty:?}");
}

#[test]
fn every_option_named_in_the_guide_exists() {
    let command = lgp::cli::command();
    let options = |command: &clap::Command| -> Vec<String> {
        command
            .get_arguments()
            .filter_map(|argument| argument.get_long())
            .map(str::to_owned)
            .collect()
    };
    let mut known: BTreeSet<String> = options(&command).into_iter().collect();
    known.extend(command.get_subcommands().flat_map(options));
    known.extend(["from"].into_iter().flat_map(|name| {
        options(
            command.find_subcommand("scene").and_then(|scene| scene.find_subcommand(name)).unwrap(),
        )
    }));
    known.extend(["help", "version"].map(str::to_owned));
    for file in markdown_in(GUIDE).into_iter().chain([root().join("README.md")]) {
        let text = read_to_string(&file).unwrap();
        for (line, code) in inline_code(&apart(&text).0) {
            let Some(option) = code.strip_prefix("--") else { continue };
            let option = option.split([' ', '=']).next().unwrap_or_default();
            assert!(known.contains(option), "{}:{line}: --{option}", file.display());
        }
    }
}

/// What the text of a heading is called in an address.
fn slug(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
    heading
        .trim()
        .to_lowercase()
        .chars()
        .filter(kept)
        .map(|c| if c == ' ' { '-' } else { c })
        .collect()
}

/// Where links and pictures point to, and on which line.
fn targets(prose: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    for (number, line) in (1..).zip(prose.lines()) {
        for (begin, end) in [("](", ')'), ("src=\"", '"'), ("srcset=\"", '"'), ("href=\"", '"')] {
            let parts = line.split(begin).skip(1);
            found.extend(parts.filter_map(|part| Some((number, &part[..part.find(end)?]))));
        }
    }
    found
}

#[test]
fn every_link_leads_somewhere() {
    let mut count = 0;
    for file in documents() {
        let text = read_to_string(&file).unwrap();
        for (line, target) in targets(&apart(&text).0) {
            if target.contains("://") {
                continue;
            }
            count += 1;
            let place = format!("{}:{line}: {target}", file.display());
            let (path, heading) = target.split_once('#').unwrap_or((target, ""));
            let there = match path {
                "" => file.clone(),
                path => file.parent().unwrap().join(path),
            };
            assert!(there.exists(), "{place}: there is no such file");
            if !heading.is_empty() {
                let text = read_to_string(&there).unwrap();
                let (prose, _) = apart(&text);
                let mut headings = prose.lines().filter(|line| line.starts_with('#'));
                let is_it = |line: &str| slug(line.trim_start_matches('#')) == heading;
                assert!(headings.any(is_it), "{place}: there is no such heading");
            }
        }
    }
    assert!(count > 100, "{count}");
}

#[test]
fn every_page_of_the_guide_is_in_its_summary_once() {
    let summary = read_to_string(root().join(GUIDE).join("SUMMARY.md")).unwrap();
    let mut listed: Vec<&str> = targets(&summary).into_iter().map(|(_, target)| target).collect();
    let page = |path: &PathBuf| {
        path.strip_prefix(root().join(GUIDE)).unwrap().to_string_lossy().replace('\\', "/")
    };
    let mut pages: Vec<String> = markdown_in(GUIDE).iter().map(page).collect();
    pages.retain(|page| page != "SUMMARY.md");
    listed.sort_unstable();
    pages.sort_unstable();
    assert_eq!(listed, pages);
}

#[test]
fn the_readme_is_short_and_lines_are_no_longer_than_a_screen() {
    let readme = read_to_string(root().join("README.md")).unwrap();
    assert!(readme.lines().count() <= 120, "{}", readme.lines().count());
    for file in markdown_in(GUIDE).into_iter().chain([root().join("README.md")]) {
        let text = read_to_string(&file).unwrap();
        for (number, line) in (1..).zip(apart(&text).0.lines()) {
            let is_prose = !line.starts_with('|') && !line.contains("![");
            let is_short = line.chars().count() <= 100;
            assert!(is_short || !is_prose, "{}:{number}: {line}", file.display());
        }
    }
}

#[test]
fn the_program_in_the_guide_is_the_one_that_is_compiled_and_runs() {
    let program = read_to_string(root().join("examples/sampled_function.rs")).unwrap();
    let page = read_to_string(root().join(GUIDE).join("library.md")).unwrap();
    assert!(page.contains(&format!("```rust\n{program}```\n")), "{program}");
    assert!(program.lines().count() <= 20);
    sampled_function::main().unwrap();
}

#[test]
fn the_command_line_is_consistent() {
    lgp::cli::command().debug_assert();
}
