use super::columns::Columns;
use super::subject::Subject;
use super::{Common, Exit, Failure};
use crate::dataset::Dataset;
use crate::emit::{Language, read_back};
use crate::eval::{Evaluator, OutputError, Samples, Score, Tape};
use crate::op::Op;
use crate::program::{Arg, Names, Program, parse};
use crate::report::table::error_text;
use crate::suggest::did_you_mean;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Verify a shader file against the data, for your own CI
///
/// Reads the function back, straight-line code of floats as `lgp emit` writes it, and evaluates it on
/// every sample. It fails, with exit code 4, where the error is too large, and where the code does
/// not compute the formula in the comment above it, if there is one.
#[derive(clap::Args)]
pub struct Args {
    /// A .hlsl, .wgsl, .glsl or .metal file with one function
    snippet: PathBuf,
    /// A dataset, as `lgp generate` and `lgp import` write them
    dataset: PathBuf,
    /// On what a scene needs of the dataset: a scene beside it, or a .ron file
    #[arg(long, value_name = "S")]
    scene: Option<String>,
    /// The largest RMSE over the outputs, on the search split, as `lgp front` shows it
    #[arg(long, value_name = "E", value_parser = error_bound)]
    max_error: f64,
    /// The columns that the function returns, in order [default: the names of what it returns]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    outputs: Option<Vec<String>>,
}

#[derive(Serialize)]
struct Verified {
    met: bool,
    max_error_allowed: f64,
    rmse: f64,
    max_error: f64,
    validation: OutputError,
    /// By output, on the search split.
    errors: BTreeMap<String, OutputError>,
    /// Whether the code computes the formula in its comment; null where there is none.
    as_commented: Option<bool>,
}

fn error_bound(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(error) if error.is_finite() && error >= 0.0 => Ok(error),
        _ => Err("the largest RMSE is a number, 0 or more".into()),
    }
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let language = language_of(&args.snippet)?;
    let text = std::fs::read_to_string(&args.snippet)
        .map_err(|error| unusable(&args.snippet, &format!("cannot be read: {error}")))?;
    let (program, names) =
        read_back(language, &text).map_err(|error| unusable(&args.snippet, &error.to_string()))?;
    let Subject { dataset: whole, .. } =
        Subject::load(&args.dataset, args.scene.as_deref(), &Columns::default())?;
    let names = columns(names, args.outputs.as_deref(), &whole, &args.snippet)?;
    let dataset = whole.select(Some(&names.inputs), Some(&names.outputs))?;
    let score = Score::of(&program, &dataset, &mut Evaluator::default());
    let formula = commented(&text, &names);
    let mismatch =
        formula.as_ref().and_then(|formula| difference(&program, formula, &dataset, &names).err());
    let (search, validation) = (score.joint_search(), score.joint_validation());
    let met = score.is_finite() && search.rmse <= args.max_error && mismatch.is_none();
    let verified = Verified {
        met,
        max_error_allowed: args.max_error,
        rmse: search.rmse,
        max_error: search.max,
        validation,
        errors: names.outputs.iter().cloned().zip(score.search.iter().copied()).collect(),
        as_commented: formula.map(|_| mismatch.is_none()),
    };
    common.result(&verified, &shown(&verified))?;
    let path = args.snippet.display();
    let unmet =
        |reason: String| Err(Failure::new(Exit::Unmet, anyhow::anyhow!("{path}: {reason}")));
    match mismatch {
        _ if !score.is_finite() => unmet("not finite on every sample".into()),
        _ if search.rmse > args.max_error => {
            unmet(format!("RMSE {}, more than {}", error_text(search.rmse), args.max_error))
        }
        Some(where_) => unmet(format!(
            "the code does not compute the formula in its comment: {where_}; mend the code, or delete that line of the comment if the change is meant"
        )),
        None => Ok(()),
    }
}

fn unusable(path: &Path, reason: &str) -> Failure {
    Failure::new(Exit::Input, anyhow::anyhow!("{}: {reason}", path.display()))
}

fn language_of(path: &Path) -> Result<Language, Failure> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let found = Language::SHADING.iter().find(|language| language.extension() == extension);
    found.copied().ok_or_else(|| {
        unusable(path, "its name says no language that can be read: .hlsl, .wgsl, .glsl or .metal")
    })
}

/// The dataset's names for what the function takes and returns.
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
    // A function that returns an expression is called after the data and its output.
    for output in &mut names.outputs {
        let named = known.iter().find(|name| output.ends_with(&format!("_{name}")));
        if let Some(name) = named.filter(|_| !known.contains(output)) {
            output.clone_from(name);
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

/// The formula in a comment, as `lgp emit` leaves it.
fn commented(text: &str, names: &Names) -> Option<Program> {
    let comments = text.lines().filter_map(|line| line.trim().strip_prefix("//"));
    comments.filter_map(|line| parse(line.trim(), names).ok()).next_back()
}

/// The program with each `mad` as a product and a sum, as GLSL has it.
fn without_mad(program: &Program) -> Program {
    let mut draft = program.clone().into_draft();
    let mut moved = Vec::with_capacity(draft.instrs.len());
    let instrs = std::mem::take(&mut draft.instrs);
    let earlier = |arg: Arg, moved: &[Arg]| match arg {
        Arg::Result(i) => moved[usize::from(i)],
        other => other,
    };
    for instr in instrs {
        let args: Vec<Arg> = instr.args().iter().map(|&arg| earlier(arg, &moved)).collect();
        moved.push(match instr.op() {
            Op::Mad => {
                let product = draft.push(Op::Mul, &args[..2]);
                draft.push(Op::Add, &[product, args[2]])
            }
            op => draft.push(op, &args),
        });
    }
    for output in &mut draft.outputs {
        *output = earlier(*output, &moved);
    }
    // Only more instructions than a program can hold are refused.
    Program::verify(draft).unwrap_or_else(|_| program.clone())
}

/// Whether two programs compute the same on the data, bit for bit; if not, where not.
fn difference(
    program: &Program,
    formula: &Program,
    dataset: &Dataset,
    names: &Names,
) -> Result<(), String> {
    let mut evaluator = Evaluator::default();
    for split in [&dataset.search, &dataset.validation] {
        let samples = Samples::new(split, names.inputs.len());
        let [found, expected] =
            [program, formula].map(|p| evaluator.outputs(&Tape::new(&without_mad(p)), &samples));
        for (name, (found, expected)) in names.outputs.iter().zip(found.iter().zip(&expected)) {
            let differs =
                |(_, (f, e)): &(usize, (&f32, &f32))| !(f == e || f.is_nan() && e.is_nan());
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

fn shown(verified: &Verified) -> String {
    let line = |what: &str, rmse: f64, max: f64| {
        format!("{what}: RMSE {}, max {}\n", error_text(rmse), error_text(max))
    };
    let mut text = line("search split", verified.rmse, verified.max_error);
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
