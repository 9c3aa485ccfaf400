use super::run_folder::{self, Which};
use super::{Common, Failure, tiers};
use crate::emit::Language;
use crate::num::Interval;
use crate::program::{Names, shortest};
use crate::run::{self, Run};
use crate::search::{Front, FrontMember};
use crate::stability::{Unheld, must_stay_single, unheld};
use crate::wording::examination::expression;
use crate::wording::number_text;
use crate::wording::{cycles_text, error_text};
use serde::Serialize;
use std::path::PathBuf;

/// Write a formula of a run as a function ready to paste
///
/// `lgp verify` reads it back. Where a base and an exponent may both be 0, languages differ: `pow(0, 0)`
/// counts as NaN here, as in shaders that compute exp2(y*log2(x)); C, Rust, Python and MSL say 1.
#[derive(clap::Args)]
pub struct Args {
    /// A folder that `lgp search` wrote
    run: PathBuf,
    #[command(flatten)]
    which: Which,
    #[arg(long, value_name = "L", value_parser = Language::from_name,
        help = Language::names(Language::ALL, "or"))]
    lang: Language,
    #[arg(long, help = half_help())]
    half: bool,
    /// In half precision, but for as few operations as must stay in single for halves to add an
    /// error of at most E anywhere in the domain
    #[arg(long, value_name = "E", conflicts_with = "half")]
    half_error: Option<f64>,
    /// Which one: its number in the table, or the knee [default: knee]
    #[arg(long, value_name = "knee|N", conflicts_with_all = ["max_cost", "max_error", "tier"])]
    pick: Option<String>,
    /// The most accurate that costs at most C cycles
    #[arg(long, value_name = "C")]
    max_cost: Option<f64>,
    /// The cheapest whose error (RMSE, or what the front was searched by) is at most E
    #[arg(long, value_name = "E")]
    max_error: Option<f64>,
    /// What this tier of the run's scene can afford
    #[arg(long, value_name = "TIER", conflicts_with_all = ["max_cost", "max_error"])]
    tier: Option<String>,
}

fn half_help() -> String {
    format!(
        "In half precision throughout ({}), unless a constant or value is one that no half holds; the \
         comment says what that costs in accuracy",
        Language::names(Language::SHADING, "and")
    )
}

#[derive(Serialize)]
struct Emitted<'a> {
    language: &'a str,
    cost: f64,
    rmse: f64,
    formula: &'a str,
    code: &'a str,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let (run, front) = run_folder::load(&args.run, args.which)?;
    let mut member = pick(args, &run, &front)?.clone();
    member.judge(&run.questions(), &run.names());
    let member = &member;
    let code = match (args.half, args.half_error) {
        (false, None) => run::snippet(&run, member, args.lang),
        (_, bound) => half(args, &run, member, bound)?,
    };
    let emitted = Emitted {
        language: args.lang.name(),
        cost: member.cost,
        rmse: member.search_error().rmse,
        formula: &member.formula,
        code: &code,
    };
    common.result(&emitted, &code)
}

/// The member in halves: throughout, or but for what the bound asks for.
fn half(
    args: &Args,
    run: &Run,
    member: &FrontMember,
    bound: Option<f64>,
) -> Result<String, Failure> {
    if !Language::SHADING.contains(&args.lang) {
        let known = Language::names(Language::SHADING, "and");
        let message = format!("--half: {} has no halves; {known} do", args.lang);
        return Err(Failure::usage(message));
    }
    let domain = run.questions().domain;
    let stay_single = match bound {
        Some(bound) => stay_single(run, member, &domain, bound)?,
        None => Vec::new(),
    };
    if let Some(lost) = unheld(&member.program, &domain, &stay_single) {
        let remedy = match bound {
            Some(_) => "emit it without --half-error",
            None => {
                "--half-error E keeps such operations in single precision, where that is enough"
            }
        };
        let message = format!("{}; {remedy}", unheld_text(&lost, member, &run.names()));
        return Err(Failure::unmet(message));
    }
    let code = run::half_snippet(run, member, args.lang, &domain, &stay_single);
    Ok(code.expect("shading languages have halves"))
}

/// The operations that cannot be halves for that error.
fn stay_single(
    run: &Run,
    member: &FrontMember,
    domain: &[Interval],
    bound: f64,
) -> Result<Vec<usize>, Failure> {
    let program = &member.program;
    must_stay_single(program, domain, bound).ok_or_else(|| {
        let all: Vec<usize> = (0..program.instrs.len()).collect();
        let message = match unheld(program, domain, &all) {
            Some(lost) => {
                let lost = unheld_text(&lost, member, &run.names());
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

/// What no half holds, in words.
fn unheld_text(lost: &Unheld, member: &FrontMember, names: &Names) -> String {
    let operation = |i: usize| expression(&member.program, i, names);
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

/// What comes nearest to the limits that no member is within.
fn least(args: &Args, front: &Front) -> String {
    let Some(best) = front.within(args.max_cost, None) else {
        let cheapest = front.members.first().map_or("the front is empty".to_owned(), |member| {
            format!("the cheapest has {} cycles", cycles_text(member.cost))
        });
        return format!("{cheapest}; ask for less");
    };
    let error = error_text(best.search_error().of(front.measure));
    let within = args.max_cost.map(|cost| format!(" within {} cycles", cycles_text(cost)));
    format!(
        "the least error there is{} is {error}, at {} cycles; search longer, or ask for less",
        within.unwrap_or_default(),
        cycles_text(best.cost)
    )
}

/// The member of a number in the table, or the knee.
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
