use super::run_folder::{self, Which};
use super::{Common, Exit, Failure, tiers};
use crate::emit::Language;
use crate::search::{Front, FrontMember, Run};
use crate::stability::{Questions, must_stay_single};
use serde::Serialize;
use std::path::PathBuf;

/// Write a formula of a run as a function ready to paste
#[derive(clap::Args)]
pub struct Args {
    /// A folder that `lgp search` wrote
    run: PathBuf,
    #[command(flatten)]
    which: Which,
    /// hlsl, wgsl, glsl, msl, c, rust, python or latex
    #[arg(long, value_name = "L", value_parser = Language::from_name)]
    lang: Language,
    /// In half precision throughout (hlsl, wgsl, glsl, msl); `lgp check` says what that costs in
    /// accuracy
    #[arg(long)]
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
    member.judge(&Questions::of(&run.inputs, &run.outputs), &run.names());
    let member = &member;
    let code = match (args.half, args.half_error) {
        (false, None) => run_folder::snippet(&run, member, args.lang),
        (_, bound) => {
            let stay_single = match bound {
                Some(bound) => stay_single(&run, member, bound)?,
                None => Vec::new(),
            };
            run_folder::half_snippet(&run, member, args.lang, &stay_single).ok_or_else(|| {
                Failure::usage(format!(
                    "--half: {} has no halves; hlsl, wgsl, glsl and msl do",
                    args.lang
                ))
            })?
        }
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

/// The operations that cannot be halves for that error.
fn stay_single(run: &Run, member: &FrontMember, bound: f64) -> Result<Vec<usize>, Failure> {
    let domain = Questions::of(&run.inputs, &run.outputs).domain;
    must_stay_single(&member.program, &domain, bound).ok_or_else(|| {
        let message = format!(
            "--half-error {bound}: even in single precision, with halves for arguments and outputs only, \
             the error is larger; ask for more"
        );
        Failure::new(Exit::Unmet, anyhow::Error::msg(message))
    })
}

fn pick<'a>(args: &Args, run: &Run, front: &'a Front) -> Result<&'a FrontMember, Failure> {
    let unmet = |message: String| Failure::new(Exit::Unmet, anyhow::Error::msg(message));
    if args.max_cost.is_some() || args.max_error.is_some() {
        return front.within(args.max_cost, args.max_error).ok_or_else(|| {
            let (cost, error) = (args.max_cost.unwrap_or(f64::INFINITY), args.max_error.unwrap_or(f64::INFINITY));
            unmet(format!("no formula of the front costs at most {cost} cycles with an error of at most {error}; search longer, or ask for less"))
        });
    }
    if let Some(tier) = &args.tier {
        return tiers::pick(run, front, tier);
    }
    numbered(front, args.pick.as_deref())
}

/// The member of a number in the table, or the knee.
pub(super) fn numbered<'a>(
    front: &'a Front,
    pick: Option<&str>,
) -> Result<&'a FrontMember, Failure> {
    let members = &front.members;
    let unmet = |message: String| Failure::new(Exit::Unmet, anyhow::Error::msg(message));
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
