//! Each module uses only those above it in this list.

use std::path::{Path, PathBuf};

const LAYERS: [&str; 32] = [
    "deadline",
    "file",
    "printable",
    "suggest",
    "num",
    "quadrature",
    "op",
    "program",
    "simplify",
    "dataset",
    "explore",
    "import",
    "export",
    "grammar",
    "cost",
    "eval",
    "fit",
    "stability",
    "archive",
    "scene",
    "truth",
    "search",
    "project",
    "emit",
    "wording",
    "shader",
    "run",
    "microfacet",
    "lobes",
    "targets",
    "report",
    "cli",
];

fn layer(module: &str) -> Option<usize> {
    LAYERS.iter().position(|known| *known == module)
}

/// Uses in a module's source that its layer does not allow, each with its line. The binary and
/// the root of the library, which are not in the list, may use all that are.
fn violations(module: &str, source: &str) -> Vec<(usize, String)> {
    let own = layer(module).unwrap_or(LAYERS.len());
    let wrong = |name: &str| match layer(name) {
        None => Some(format!("`{name}` is not on the list of modules")),
        Some(used) if used > own => Some(format!("`{module}` uses `{name}`, which is below it")),
        Some(_) => None,
    };
    let uses = modules_used(source).into_iter();
    uses.filter_map(|(line, name)| wrong(&name).map(|problem| (line, problem))).collect()
}

/// The first segment of each path from the crate's root, with its line.
fn modules_used(source: &str) -> Vec<(usize, String)> {
    let code = without_comments(source);
    let mut found = Vec::new();
    for root in ["crate::", "lgp::"] {
        for (start, _) in code.match_indices(root) {
            if code[..start].ends_with(|c: char| c.is_alphanumeric() || c == '_') {
                continue;
            }
            let path = start + root.len();
            for name in first_segments(&code, path) {
                let line = 1 + code[..name].matches('\n').count();
                found.push((line, identifier(&code[name..]).to_owned()));
            }
        }
    }
    found.retain(|(_, name)| name != "self");
    found.sort();
    found
}

/// Where the names of a path begin: one, or those directly inside `{ … }`.
fn first_segments(code: &str, path: usize) -> Vec<usize> {
    let path = path + spaces(&code[path..]);
    let Some(group) = code[path..].strip_prefix('{') else { return vec![path] };
    let mut starts = Vec::new();
    let mut depth = 1;
    let mut expected = true;
    for (at, character) in group.char_indices() {
        match character {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 1 => expected = true,
            c if expected && !c.is_whitespace() => {
                starts.push(path + 1 + at);
                expected = false;
            }
            _ => {}
        }
        if depth == 0 {
            break;
        }
    }
    starts
}

fn spaces(text: &str) -> usize {
    text.len() - text.trim_start().len()
}

fn identifier(text: &str) -> &str {
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len());
    &text[..end]
}

/// Comments often name modules that the code does not use.
fn without_comments(source: &str) -> String {
    let code = |line: &'_ str| line.split_once("//").map_or(line, |(code, _)| code).to_owned();
    source.lines().map(code).collect::<Vec<_>>().join("\n")
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// The module at the top of a file's path below `src`.
fn module_of(path: &Path) -> String {
    let first = path.iter().next().unwrap();
    Path::new(first).file_stem().unwrap().to_str().unwrap().to_owned()
}

#[test]
fn modules_use_only_those_above_them() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut problems = Vec::new();
    for file in sources(&folder) {
        let path = file.strip_prefix(&folder).unwrap();
        let module = module_of(path);
        if layer(&module).is_none() && !["main", "lib"].contains(&module.as_str()) {
            problems.push(format!("src/{}: not on the list of modules", path.display()));
        }
        for (line, problem) in violations(&module, &std::fs::read_to_string(&file).unwrap()) {
            problems.push(format!("src/{}:{line}: {problem}", path.display()));
        }
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

#[test]
fn a_use_of_a_lower_module_is_found() {
    let source = "\
use crate::op::Op; // as crate::search does
use crate::{
    num::{Lanes, eval},
    fit::levenberg_marquardt,
    self,
};
fn f() { $crate::eval::isa(); my_crate::cli::run() }
/// [`crate::report`]
pub(crate) fn g() -> crate::program::Program {}
";
    let lines: Vec<(usize, String)> = modules_used(source);
    let names: Vec<(usize, &str)> = lines.iter().map(|(line, name)| (*line, &name[..])).collect();
    assert_eq!(names, [(1, "op"), (3, "num"), (4, "fit"), (7, "eval"), (9, "program")]);
    let found = violations("program", source);
    assert_eq!(found.iter().map(|(line, _)| *line).collect::<Vec<_>>(), [4, 7]);
    assert_eq!(found[0].1, "`program` uses `fit`, which is below it");
    assert!(violations("fit", source).is_empty());
    assert!(violations("main", "fn main() { lgp::cli::run() }").is_empty());
    assert_eq!(violations("main", "fn main() { lgp::helpers::run() }").len(), 1);
    assert_eq!(violations("search", "use crate::search_space::X;").len(), 1);
    assert_eq!(violations("cost", "use crate::{cost::Cost, cli::{Common, run}};").len(), 1);
}

#[test]
fn files_belong_to_the_module_at_the_top_of_their_path() {
    let listed: Vec<&str> = LAYERS.to_vec();
    let mut sorted = listed.clone();
    sorted.sort_unstable();
    sorted.dedup();
    assert_eq!(sorted.len(), listed.len(), "a module occurs twice");
    assert_eq!(module_of(Path::new("dataset/incumbent.rs")), "dataset");
    assert_eq!(module_of(Path::new("suggest.rs")), "suggest");
}
