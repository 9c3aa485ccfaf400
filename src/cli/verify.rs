//! `lgp verify`: a shader file against the data and its own comment.

use super::truth::Sampled;
use super::{Common, Failure, against, argument};
use crate::dataset::{Dataset, Split};
use crate::emit::{
    CallError, Engine, Language, MAX_SNIPPET, ReadBack, Stated, StatedError, column_called,
    language_of, read_file, spread,
};
use crate::eval::{Evaluator, OutputError, Samples, Score, Tape};
use crate::program::{Names, Program};
use crate::run::Subject;
use crate::suggest::did_you_mean;
use crate::wording::error_text;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Check a shader file against the data, for your own CI
///
/// Reads the function back (straight-line code of floats or halves, as `lgp emit` writes it) and
/// evaluates it on every sample in that precision. Fails with exit code 4 if the error is too
/// large, or if the code does not compute the formula in the comment above it: the line marked by
/// `formula:`, or else the one that says `OUTPUT = …`. Code that compilers might understand
/// otherwise is refused with its line: integers, other types, lines of the preprocessor, a
/// backslash at a line's end.
///
/// With --against it compares with another function, or with --formula with a formula, over a
/// --domain.
///
/// For example: lgp verify dfg.wgsl datasets/dfg.bin --max-error 0.01
///
/// Or: lgp verify new.wgsl --against old.wgsl --domain n_dot_v=0..1 --max-error 0.001
#[derive(clap::Args)]
pub struct Args {
    #[arg(help = format!("A {} file with one function", extensions()))]
    pub(super) snippet: PathBuf,
    /// The dataset: a file from `lgp generate` or `lgp import`; not needed with --against or
    /// --formula
    #[arg(required_unless_present_any = ["against", "formula"])]
    dataset: Option<PathBuf>,
    /// In place of a dataset: a shader file, whose function is evaluated in double precision over
    /// the --domain. Then both files may hold any function: loops, branches, vectors
    #[arg(long, value_name = "FILE", conflicts_with_all = ["dataset", "formula"])]
    pub(super) against: Option<PathBuf>,
    /// The function of the --against file that is meant [default: as --entry]
    #[arg(long, value_name = "NAME", requires = "against")]
    pub(super) against_entry: Option<String>,
    #[command(flatten)]
    pub(super) sampled: Sampled,
    /// Evaluate on what a scene needs of the dataset: a scene beside it, or a .ron file
    #[arg(long, value_name = "S")]
    scene: Option<String>,
    /// The largest RMSE allowed, over the outputs, on the search split, as `lgp front` shows it
    #[arg(long, value_name = "E", value_parser = argument::error)]
    max_error: f64,
    /// An output that is computed of the data's columns, as for `lgp search`; the comment may say
    /// it, too
    #[arg(long, value_name = "NAME = EXPRESSION", requires = "dataset")]
    derive: Vec<String>,
    /// The columns that the function returns, in order [default: the names in the function]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub(super) outputs: Option<Vec<String>>,
}

#[derive(Serialize)]
struct Verified {
    met: bool,
    /// True for a function of halves, judged as one.
    half: bool,
    max_error_allowed: f64,
    rmse: f64,
    max_error: f64,
    validation: OutputError,
    /// The errors by output, on the search split.
    errors: BTreeMap<String, OutputError>,
    /// True if the code computes the formula in its comment; null where there is none.
    as_commented: Option<bool>,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    match &args.dataset {
        Some(dataset) => {
            args.sampled.refuse_all_but_lets()?;
            snippet_on(args, dataset, common)
        }
        None => against::run(args, common),
    }
}

fn snippet_on(args: &Args, dataset: &Path, common: &Common) -> Result<(), Failure> {
    named_after_a_language(&args.snippet)?;
    let text = snippet_text(&args.snippet)?;
    let read = read_file(&args.snippet, &text).expect("its name says what it is");
    let (language, mut code) = read.map_err(|error| unusable(&args.snippet, &error))?;
    code.add_lets(args.sampled.lets());
    let derived = [code.derived(), &args.derive].concat();
    let Subject { dataset: whole, .. } =
        Subject::load_with(dataset, args.scene.as_deref(), &derived, |data| Ok(data.clone()))?;
    let code = &code;
    let refused = |error: CallError| unusable(&args.snippet, &error);
    let known: Vec<String> = whole.inputs.iter().map(|column| column.name.clone()).collect();
    if !code.lets().map_err(refused)?.is_empty() || code.unread(&known).next().is_some() {
        return adapted(args, code, &whole, common);
    }
    let names = columns(code.names.clone(), args.outputs.as_deref(), &whole, &args.snippet)?;
    let dataset = whole.select(Some(&names.inputs), Some(&names.outputs))?;
    let score = score(code, &dataset);
    let stated = stated(code, &names).map_err(|error| unusable(&args.snippet, &error))?;
    // An equation does not say in what order its terms are computed.
    let tolerance = if language == Language::Latex { 1e-5 } else { 0.0 };
    let mismatch =
        stated.as_ref().and_then(|stated| mismatch(code, stated, &dataset, &names, tolerance));
    let agreement = stated.map(|_| code.misplaced().or(mismatch));
    conclude(args, &score, &names.outputs, code.in_half, agreement, common)
}

/// Verifies a function whose comments say how it makes columns of its parameters.
fn adapted(args: &Args, code: &ReadBack, whole: &Dataset, common: &Common) -> Result<(), Failure> {
    let refused = |error: CallError| unusable(&args.snippet, &error);
    let outputs = args.outputs.as_deref().unwrap_or(&code.names.outputs);
    let mut over = code.over(whole, outputs).map_err(refused)?;
    let rows = whole.search.rows() + whole.validation.rows();
    let (search, validation) = (made(&over.dataset.search), made(&over.dataset.validation));
    let left = search.rows() + validation.rows();
    if search.rows() == 0 || validation.rows() == 0 {
        let reason = "no parameters give the values of the data, by what its comments say (`let:`)";
        return Err(unusable(&args.snippet, &reason));
    }
    if left < rows {
        let share = 100.0 * left as f64 / rows as f64;
        common
            .note(&format!("verified on {share:.1} % of the data: no parameters give the others"));
    }
    (over.dataset.search, over.dataset.validation) = (search, validation);
    let score = score(code, &over.dataset);
    let columns = Names {
        inputs: whole.inputs.iter().map(|column| column.name.clone()).collect(),
        outputs: over.outputs(&whole.outputs),
    };
    let stated = code.stated_over(&columns).map_err(|error| unusable(&args.snippet, &error))?;
    let agreement = match stated {
        None => None,
        Some(Stated { line, program }) => {
            let program = over.called(&program, &columns).map_err(refused)?;
            let names = Names { inputs: code.written.inputs.clone(), outputs: outputs.to_vec() };
            let stated = Stated { line, program };
            let mismatch = || mismatch(code, &stated, &over.dataset, &names, 0.0);
            Some(code.misplaced().or_else(mismatch))
        }
    };
    conclude(args, &score, outputs, code.in_half, agreement, common)
}

/// Returns the rows that parameters were found for.
fn made(split: &Split) -> Split {
    let is_made = |row: &usize| split.columns.iter().all(|column| column[*row].is_finite());
    let rows: Vec<usize> = (0..split.rows()).filter(is_made).collect();
    let of = |column: &Vec<f32>| rows.iter().map(|&row| column[row]).collect();
    let weights = if split.weights.is_empty() { Vec::new() } else { of(&split.weights) };
    Split { columns: split.columns.iter().map(of).collect(), weights, ..Split::default() }
}

/// Shows the errors, and fails if they are too large or the code is not as its comment says:
/// `commented` is the reason, if it has such a comment.
pub(super) fn conclude(
    args: &Args,
    score: &Score,
    outputs: &[String],
    half: bool,
    commented: Option<Option<String>>,
    common: &Common,
) -> Result<(), Failure> {
    let as_commented = commented.as_ref().map(Option::is_none);
    let mismatch = commented.flatten();
    let (search, validation) = (score.joint_search(), score.joint_validation());
    let met = score.is_finite() && search.rmse <= args.max_error && mismatch.is_none();
    let verified = Verified {
        met,
        half,
        max_error_allowed: args.max_error,
        rmse: search.rmse,
        max_error: search.max,
        validation,
        errors: outputs.iter().cloned().zip(score.search.iter().copied()).collect(),
        as_commented,
    };
    common.result(&verified, &shown(&verified))?;
    let unmet = |reason: String| Err(unmet(&args.snippet, &reason));
    match mismatch {
        _ if !score.is_finite() => unmet("not finite on every sample".into()),
        _ if search.rmse > args.max_error => {
            unmet(format!("RMSE {}, more than {}", error_text(search.rmse), args.max_error))
        }
        Some(reason) => unmet(reason),
        None => Ok(()),
    }
}

fn unmet(path: &Path, reason: &dyn Display) -> Failure {
    Failure::unmet(format!("{}: {reason}", path.display()))
}

/// Reads the file, up to the longest possible snippet.
fn snippet_text(path: &Path) -> Result<String, Failure> {
    let cannot = |error: std::io::Error| unusable(path, &format!("cannot be read: {error}"));
    let mut text = Vec::new();
    let file = std::fs::File::open(path).map_err(cannot)?;
    file.take(MAX_SNIPPET as u64 + 1).read_to_end(&mut text).map_err(cannot)?;
    if text.len() > MAX_SNIPPET {
        return Err(unusable(path, &"longer than a snippet can be (1 MiB)"));
    }
    String::from_utf8(text).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].iter().filter(|&&byte| byte == b'\n').count() + 1;
        unusable(path, &format!("line {line}: not UTF-8 text"))
    })
}

/// Scores the code in its own precision.
fn score(code: &ReadBack, dataset: &Dataset) -> Score {
    if !code.in_half {
        return Score::of(&code.program, dataset, &mut Evaluator::default());
    }
    Score::of_values(dataset, |split| {
        let mut outputs = vec![Vec::with_capacity(split.rows()); code.program.outputs.len()];
        for row in 0..split.rows() {
            let inputs: Vec<f32> =
                split.columns[..code.program.inputs].iter().map(|column| column[row]).collect();
            for (output, value) in outputs.iter_mut().zip(code.evaluate(&inputs)) {
                output.push(value);
            }
        }
        outputs
    })
}

pub(super) fn unusable(path: &Path, reason: &dyn Display) -> Failure {
    Failure::input(format!("{}: {reason}", path.display()))
}

/// Refuses a file whose name says no language, before it is read.
fn named_after_a_language(path: &Path) -> Result<(), Failure> {
    if language_of(path).is_some() {
        return Ok(());
    }
    let known = extensions();
    Err(unusable(path, &format!("its name says no language that can be read: {known}")))
}

/// Lists the file extensions that can be read.
fn extensions() -> String {
    let languages = Language::ALL.iter().map(|language| language.extension());
    let engines = Engine::ALL.iter().map(|engine| engine.extension());
    let all: Vec<String> = languages.chain(engines).map(|name| format!(".{name}")).collect();
    all.join(", ")
}

/// Returns the dataset's names for what the function takes and returns.
fn columns(
    mut names: Names,
    outputs: Option<&[String]>,
    dataset: &Dataset,
    path: &Path,
) -> Result<Names, Failure> {
    if let Some(given) = outputs {
        if given.len() != names.outputs.len() {
            let (returned, given) = (names.outputs.len(), given.len());
            return Err(Failure::usage(format!(
                "--outputs names {given} columns, but {} returns {returned}",
                path.display()
            )));
        }
        names.outputs = given.to_vec();
    }
    let columns = dataset.inputs.iter().chain(&dataset.outputs);
    let known: Vec<String> = columns.map(|column| column.name.clone()).collect();
    // A function that returns an expression is named after the data and its output.
    for output in &mut names.outputs {
        let named = known.iter().find(|name| output.ends_with(&format!("_{name}")));
        if let Some(name) = named.filter(|_| !known.contains(output)) {
            output.clone_from(name);
        }
    }
    // Without comments, inputs are told by the names that engines have for them.
    for input in names.inputs.iter_mut().filter(|name| !known.contains(name)) {
        if let Some(name) = column_called(input, &known) {
            *input = name;
        }
    }
    for (what, name) in names
        .inputs
        .iter()
        .map(|name| ("takes", name))
        .chain(names.outputs.iter().map(|name| ("returns", name)))
    {
        if !known.contains(name) {
            let hint = did_you_mean(name, known.iter().map(String::as_str));
            let advice = if what == "returns" { "; name its columns with --outputs" } else { "" };
            return Err(unusable(
                path,
                &format!("{what} `{name}`, which is no column of the dataset{hint}{advice}"),
            ));
        }
    }
    Ok(names)
}

/// Returns the formula in the comment, which names outputs as the dataset does, or as the function.
fn stated(code: &ReadBack, names: &Names) -> Result<Option<Stated>, StatedError> {
    let as_function = || code.stated(&code.names.outputs);
    match code.stated(&names.outputs) {
        Ok(None) => as_function(),
        Err(error) => as_function().ok().flatten().map(Some).ok_or(error),
        found => found,
    }
}

/// Explains how the code differs from the formula in its comment.
fn mismatch(
    code: &ReadBack,
    stated: &Stated,
    dataset: &Dataset,
    names: &Names,
    tolerance: f32,
) -> Option<String> {
    let differs = |code: &ReadBack| match code.in_half {
        true if code.is(&stated.program) => None,
        true => Some("its operations and numbers are others".to_owned()),
        false => {
            let differs = |formula: &Program| {
                difference(&code.program, formula, dataset, names, tolerance).err()
            };
            let reason = differs(&stated.program)?;
            let respelled = code.respelled(&stated.program);
            respelled.is_none_or(|formula| differs(&formula).is_some()).then_some(reason)
        }
    };
    let of_one = |code: &ReadBack| {
        let reason = differs(code)?;
        code.literal.as_ref().is_none_or(|code| differs(code).is_some()).then_some(reason)
    };
    // Both functions of a file in two precisions are the formula.
    let reason = of_one(code).or_else(|| code.variant.as_deref().and_then(of_one))?;
    Some(format!(
        "the code does not compute the formula in its comment (line {}): {reason}; mend the code, or delete \
         that line of the comment if the change is meant",
        stated.line
    ))
}

/// Checks that two programs compute the same on the data, bit for bit or within a share of the
/// value; the error says where not.
fn difference(
    program: &Program,
    formula: &Program,
    dataset: &Dataset,
    names: &Names,
    tolerance: f32,
) -> Result<(), String> {
    let mut evaluator = Evaluator::default();
    let around = around(&dataset.validation, names.inputs.len());
    let exact = tolerance == 0.0;
    for split in [&dataset.search, &dataset.validation].into_iter().chain(exact.then_some(&around))
    {
        let samples = Samples::new(split, names.inputs.len());
        let [found, expected] =
            [program, formula].map(|p| evaluator.outputs(&Tape::new(&p.unfused()), &samples));
        for (name, (found, expected)) in names.outputs.iter().zip(found.iter().zip(&expected)) {
            let differs = |(_, (f, e)): &(usize, (&f32, &f32))| {
                let near = tolerance > 0.0 && (*f - *e).abs() <= tolerance * e.abs().max(1.0);
                !(f == e || f.is_nan() && e.is_nan() || near)
            };
            if let Some((row, (f, e))) = found.iter().zip(expected).enumerate().find(differs) {
                let at = names.inputs.iter().zip(&split.columns);
                let at: Vec<String> =
                    at.map(|(name, column)| format!("{name} = {}", column[row])).collect();
                return Err(format!("{name} is {f}, not {e}, at {}", at.join(", ")));
            }
        }
    }
    Ok(())
}

/// Returns points in and around the domain, where code that differs from its formula only between the
/// samples or outside, as by a clamp, differs.
fn around(split: &Split, inputs: usize) -> Split {
    // By hand.
    const POINTS: usize = 1024;
    let ends = |column: &Vec<f32>| {
        let finite = column.iter().copied().filter(|x| x.is_finite());
        finite.fold([f32::MAX, f32::MIN], |[low, high], x| [low.min(x), high.max(x)])
    };
    let columns = split.columns[..inputs].iter().enumerate().map(|(i, column)| {
        let [low, high] = ends(column);
        let at = |n: usize| low + (high - low) * (3.0 * spread(i, n) as f32 - 1.0);
        (0..POINTS).map(at).collect()
    });
    Split { columns: columns.collect(), ..Split::default() }
}

fn shown(verified: &Verified) -> String {
    let line = |what: &str, rmse: f64, max: f64| {
        format!("{what}: RMSE {}, max {}\n", error_text(rmse), error_text(max))
    };
    let mut text = if verified.half { "in half precision\n" } else { "" }.to_owned();
    text += &line("search split", verified.rmse, verified.max_error);
    text += &line("validation split", verified.validation.rmse, verified.validation.max);
    if verified.errors.len() > 1 {
        for (name, error) in &verified.errors {
            text += &line(&format!("  {name}"), error.rmse, error.max);
        }
    }
    text + match verified.as_commented {
        Some(true) => "computes the formula in its comment\n",
        Some(false) => "does not compute the formula in its comment\n",
        None => "no formula in its comment\n",
    }
}
