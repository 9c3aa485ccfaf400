//! `lgp emit`: a formula of a run as code.

use super::run_folder::{self, Which};
use super::{Common, Failure, argument, tiers};
use crate::emit::{Engine, Language, Lets, read_head};
use crate::file::replace_file;
use crate::program::shortest;
use crate::run::{Called, Form, Run, Target};
use crate::search::{Front, FrontMember};
use crate::stability::{Unheld, must_stay_single, unheld};
use crate::wording::examination::expression;
use crate::wording::number_text;
use crate::wording::{cycles_text, error_text};
use serde::Serialize;
use std::path::PathBuf;

/// Print a formula of a run as a function to paste
///
/// Takes the knee of the front unless an option chooses another formula; `lgp front` shows the
/// table. `lgp verify` reads the function back. If a base and its exponent can both be 0, languages
/// differ: `pow(0, 0)` is NaN here, as in shaders that compute exp2(y*log2(x)); in C, Rust, Python
/// and MSL it is 1.
///
/// For example: lgp emit runs/dfg --lang wgsl --max-cost 16
///
/// Or: lgp emit runs/dfg --for unity -o Dfg.hlsl
///
/// Or: lgp emit runs/dfg --lang glsl --signature "vec2 EnvDFG(float roughness, float nov)"
#[derive(clap::Args)]
pub struct Args {
    /// A run: a folder that `lgp search` wrote
    run: PathBuf,
    #[command(flatten)]
    which: Which,
    #[arg(long, value_name = "L", value_parser = Language::from_name,
        required_unless_present = "engine", help = Language::names(Language::ALL, "or"))]
    lang: Option<Language>,
    /// An engine, in whose spelling and with whose names a file is written that drops in there
    #[arg(long = "for", value_name = "ENGINE", value_parser = Engine::from_name,
        conflicts_with = "lang", long_help = engine_help())]
    engine: Option<Engine>,
    /// The function's head, in the language: its parameters are the inputs, in any order and as
    /// components of vectors, under their names or such as `NoV`, `dotNV`, `perceptualRoughness`
    #[arg(long, value_name = "HEAD")]
    signature: Option<String>,
    /// What an input is of the parameters, or a result of the outputs: `alpha = roughness^2`,
    /// `n_dot_v = dot(n, v)`, `return.x = bias`, `return = f0*scale + bias`
    #[arg(long = "let", value_name = "NAME = EXPRESSION")]
    lets: Vec<String>,
    /// The function's name
    #[arg(long)]
    name: Option<String>,
    /// Keep inputs within their domain by clamps, whose cycles the comment states
    #[arg(long)]
    clamp_inputs: bool,
    /// Write no comments; then `lgp verify` knows the columns only by the names in the code
    #[arg(long)]
    no_comments: bool,
    /// Write to a file
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[arg(long, help = half_help())]
    half: bool,
    /// Use half precision, except for the fewest operations that must stay in single precision so
    /// that halves add an error of at most E anywhere in the domain
    #[arg(long, value_name = "E", conflicts_with = "half", value_parser = argument::error)]
    half_error: Option<f64>,
    /// The formula to take: its number in the table, or the knee [default: knee]
    #[arg(long, value_name = "knee|N", conflicts_with_all = ["max_cost", "max_error", "tier"])]
    pick: Option<String>,
    /// Take the most accurate formula that costs at most C cycles
    #[arg(long, value_name = "C")]
    max_cost: Option<f64>,
    /// Take the cheapest formula whose error (RMSE, or the measure of the front) is at most E
    #[arg(long, value_name = "E", value_parser = argument::error)]
    max_error: Option<f64>,
    /// Take the best formula that this tier of the run's scene can afford
    #[arg(long, value_name = "TIER", conflicts_with_all = ["max_cost", "max_error"])]
    tier: Option<String>,
}

fn half_help() -> String {
    format!(
        "Use half precision throughout ({}); refused if no half can hold some constant or value. The \
         function's comment says what accuracy is lost",
        Language::names(&Language::with_halves(), "and")
    )
}

fn engine_help() -> String {
    format!(
        "An engine, in whose spelling and with whose names a file is written that drops in there: {}",
        Engine::names("or")
    )
}

#[derive(Serialize)]
struct Emitted<'a> {
    language: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    engine: Option<&'a str>,
    cost: f64,
    rmse: f64,
    formula: &'a str,
    code: &'a str,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let form = form(args)?;
    let (run, front) = run_folder::load(&args.run, args.which)?;
    let mut member = pick(args, &run, &front)?.clone();
    member.judge(&run.questions(), &run.names());
    let member = &member;
    let called = form.called(&run, member).map_err(|error| Failure::usage(error.to_string()))?;
    let half = match (args.half, args.half_error) {
        (false, None) => None,
        (_, bound) => Some(half(&form, &called, bound)?),
    };
    let code = form.written(&run, member, &called, half.as_deref());
    let language = form.language();
    let emitted = Emitted {
        language: language.name(),
        engine: args.engine.map(Engine::name),
        cost: member.cost,
        rmse: member.error().rmse,
        formula: &member.formula,
        code: &code,
    };
    let Some(path) = &args.output else { return common.result(&emitted, &code) };
    replace_file(path, code.as_bytes()).map_err(|error| Failure::unwritable(path, error))?;
    let cycles = cycles_text(member.cost);
    common.summary(&emitted, &format!("{}: a formula of {cycles} cycles", path.display()))
}

/// Reads how the function is to be written.
fn form(args: &Args) -> Result<Form, Failure> {
    let usage = |message: String| Failure::usage(message);
    let target = match (args.engine, args.lang) {
        (Some(engine), _) => Target::Engine(engine),
        (None, language) => Target::Language(language.unwrap_or(Language::Hlsl)),
    };
    let mut form = Form {
        target,
        function: args.name.clone(),
        head: None,
        lets: Lets::parse(&args.lets).map_err(|error| usage(format!("--let {error}")))?,
        clamp_inputs: args.clamp_inputs,
        comments: !args.no_comments,
    };
    let language = form.language();
    if let Some(name) = args.name.as_ref().filter(|name| !language.can_be_called(name)) {
        let message = format!("--name {name}: no name of a function in {language}; choose another");
        return Err(usage(message));
    }
    if let Some(text) = &args.signature {
        let (head, in_half) = read_head(language, text)
            .map_err(|error| usage(format!("--signature {}", error.alone())))?;
        if args.engine.is_some_and(Engine::has_both) && head.returned != Some(0) {
            let message = "--signature: a Custom Function node returns nothing: write `void`, and `out` before results";
            return Err(usage(message.to_owned()));
        }
        let halves = args.half || args.half_error.is_some();
        let tells = language.tells_halves() && !args.engine.is_some_and(Engine::has_both);
        if in_half != halves && tells {
            let message = match in_half {
                true => "--signature is of halves: give --half or --half-error, too",
                false => "--signature is of floats, but halves are asked for: write their types",
            };
            return Err(usage(message.to_owned()));
        }
        form.head = Some(head);
    }
    Ok(form)
}

/// Returns the operations that stay in single precision in a function of halves.
fn half(form: &Form, called: &Called, bound: Option<f64>) -> Result<Vec<usize>, Failure> {
    let has_halves = match form.target {
        Target::Language(language) => language.has_halves(),
        Target::Engine(engine) => engine.has_halves(),
    };
    if !has_halves {
        let known = Language::names(&Language::with_halves(), "and");
        let option = if bound.is_some() { "--half-error" } else { "--half" };
        let message = match form.target {
            Target::Language(language) => format!("{option}: {language} has no halves; {known} do"),
            Target::Engine(engine) => format!("{option}: {engine} has no halves"),
        };
        return Err(Failure::usage(message));
    }
    let stay_single = match bound {
        Some(bound) => stay_single(called, bound)?,
        None => Vec::new(),
    };
    if let Some(lost) = unheld(&called.program, &called.domain, &stay_single) {
        let remedy = match bound {
            Some(_) => "emit it without --half-error",
            None => {
                "--half-error E keeps such operations in single precision, where that is enough"
            }
        };
        return Err(Failure::unmet(format!("{}; {remedy}", unheld_text(&lost, called))));
    }
    Ok(stay_single)
}

/// Returns the operations that must stay single to keep the error within `bound`.
fn stay_single(called: &Called, bound: f64) -> Result<Vec<usize>, Failure> {
    let Called { program, domain, .. } = called;
    must_stay_single(program, domain, bound).ok_or_else(|| {
        let all: Vec<usize> = (0..program.instrs.len()).collect();
        let message = match unheld(program, domain, &all) {
            Some(lost) => {
                let lost = unheld_text(&lost, called);
                format!("--half-error {bound}: {lost}; emit it without")
            }
            None => format!(
                "--half-error {bound}: even in single precision, with halves for arguments and outputs only, \
                 the error is larger; ask for more"
            ),
        };
        Failure::unmet(message)
    })
}

/// Describes the value that no half holds.
fn unheld_text(lost: &Unheld, called: &Called) -> String {
    let names = &called.names;
    let operation = |i: usize| expression(&called.program, i, names);
    let at = |input: &[f32]| {
        let pairs = names.inputs.iter().zip(input);
        pairs.map(|(name, x)| format!("{name} = {x:?}")).collect::<Vec<_>>().join(", ")
    };
    match lost {
        Unheld::Constant { value, instruction } => {
            let place = match instruction {
                Some(i) => format!(" in {}", operation(*i)),
                None => String::new(),
            };
            let becomes = if value.abs() > 1.0 { "is infinite" } else { "is 0" };
            format!(
                "the constant {value}{place} {becomes} as a half, which reaches from 6e-8 to 65504"
            )
        }
        Unheld::Input { input, value } => {
            format!(
                "the input `{}` reaches {value}, which is infinite as a half",
                names.inputs[*input]
            )
        }
        Unheld::Result { instruction, value, input } => format!(
            "{} is {} at {}, which is infinite as a half: 65504 is the largest",
            operation(*instruction),
            number_text(*value),
            at(input)
        ),
        Unheld::Output { output, found, exact, input } => format!(
            "in halves `{}` is {found} for {} at {}",
            names.outputs[*output],
            number_text(*exact),
            at(input)
        ),
    }
}

fn pick<'a>(args: &Args, run: &Run, front: &'a Front) -> Result<&'a FrontMember, Failure> {
    let unmet = |message: String| Failure::unmet(message);
    if args.max_cost.is_some() || args.max_error.is_some() {
        return front.within(args.max_cost, args.max_error).ok_or_else(|| {
            let limit = |limit: Option<f64>, what: &str| {
                limit.map(|limit| format!("{what} {}", shortest(limit)))
            };
            let limits = [
                limit(args.max_cost, "cycles of at most"),
                limit(args.max_error, "an error of at most"),
            ];
            let limits: Vec<String> = limits.into_iter().flatten().collect();
            unmet(format!(
                "no formula of the front has {}; {}",
                limits.join(" and "),
                least(args, front)
            ))
        });
    }
    if let Some(tier) = &args.tier {
        return tiers::pick(run, front, tier);
    }
    numbered(front, args.pick.as_deref())
}

/// Describes the member nearest to limits that none meets.
fn least(args: &Args, front: &Front) -> String {
    let Some(best) = front.within(args.max_cost, None) else {
        let cheapest = front.members.first().map_or("the front is empty".to_owned(), |member| {
            format!("the cheapest has {} cycles", cycles_text(member.cost))
        });
        return format!("{cheapest}; ask for less");
    };
    let error = error_text(best.error().of(front.measure));
    let within = args.max_cost.map(|cost| format!(" within {} cycles", cycles_text(cost)));
    format!(
        "the least error there is{} is {error}, at {} cycles; search longer, or ask for less",
        within.unwrap_or_default(),
        cycles_text(best.cost)
    )
}

/// Returns the member of a number in the table, or the knee.
pub(super) fn numbered<'a>(
    front: &'a Front,
    pick: Option<&str>,
) -> Result<&'a FrontMember, Failure> {
    let members = &front.members;
    let unmet = |message: String| Failure::unmet(message);
    match pick {
        None | Some("knee") => front.knee().ok_or_else(|| unmet("the front is empty".into())),
        Some(number) => {
            number.parse::<usize>().ok().and_then(|n| members.get(n.checked_sub(1)?)).ok_or_else(
                || {
                    Failure::usage(format!(
                        "--pick {number}: give `knee`, or a number from 1 to {} as in `lgp front`",
                        members.len()
                    ))
                },
            )
        }
    }
}
