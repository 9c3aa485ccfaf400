//! `lgp check`: what is proved of formulas, or refuted.

use super::eval::{assigned_outputs, settled};
use super::run_folder::{self, Which};
use super::{Common, Failure};
use crate::dataset::{Column, Dataset};
use crate::program::{ALWAYS_ASKED, Claim, Names, Program, parse_open, shortest};
use crate::search::FrontMember;
use crate::stability::{ClaimRecord, Examination, Questions, TruthRecord, Verdict, VerdictRecord};
use crate::suggest::did_you_mean;
use crate::truth::{exact_formula, formula_of, read_formula};
use crate::wording::{claim_text, cycles_text, examination, truth_sentence};
use rayon::prelude::*;
use serde_json::json;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Prove that formulas are finite and in range over their whole domain, or refute it
///
/// Each claim is proved, refuted by an input, or left open, both for f32 as the interpreter
/// computes and for any GPU within the precision that WGSL and Vulkan state. For a single formula
/// it also shows what happens at the domain's edges and just outside, what f32 and f16 lose, where,
/// and in which operation, what compilers may change, and where the formula bends or jumps. The
/// exit code is 4 if a claim that was asked for is refuted: finite always, ranges with --range,
/// others with --claim. Where the formula approximates another (--truth, or data made by --formula),
/// the largest error over the whole domain is bounded, too.
///
/// For example: lgp check "y = x/(x + 1)" --domain x=0..1 --range 0..0.5
#[derive(clap::Args)]
pub struct Args {
    /// Statements `name = expression`, separated by `;`, or a folder that `lgp search` wrote
    #[arg(value_name = "FORMULA|DIR")]
    formula: String,
    /// The dataset that the formula is for: it gives the columns and their domains
    dataset: Option<PathBuf>,
    /// In place of a dataset: the domain of each input, as x=0..1
    #[arg(long, value_name = "INPUT=LOW..HIGH", value_delimiter = ',', conflicts_with = "dataset")]
    domain: Vec<String>,
    /// The range that all outputs must stay in, as 0..1, or one output, as bias=0..1 [default:
    /// 0..1, or 0 and above, if the data stays in it]
    #[arg(long, value_name = "LOW..HIGH", value_delimiter = ',')]
    range: Vec<String>,
    /// A claim, as "energy: f0*scale + bias <= 1 for f0 in 0..1", or the name of a claim that comes
    /// with the data; can be given several times
    #[arg(long, value_name = "CLAIM|NAME")]
    claim: Vec<String>,
    /// The function that the formula approximates, as a formula, to prove the largest error against
    /// [default: the one that the data are samples of]
    #[arg(long, value_name = "FORMULA")]
    truth: Option<String>,
    /// Fail with exit code 4 unless the error against the truth is proved to be at most this
    #[arg(long, value_name = "E")]
    max_error: Option<f64>,
    /// How far a value may leave its range
    #[arg(long, value_name = "S", default_value_t = 1e-5)]
    slack: f64,
    /// The largest absolute error at which half precision still counts as good enough
    #[arg(long, value_name = "E", default_value_t = 1e-2)]
    half: f64,
    /// Show everything about one formula of a folder: its number in the table
    #[arg(long, value_name = "N")]
    pick: Option<usize>,
    #[command(flatten)]
    which: Which,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    if !(args.slack >= 0.0 && args.half > 0.0) {
        return Err(Failure::usage("--slack is 0 or more, --half more than 0"));
    }
    let path = Path::new(&args.formula);
    if path.is_dir() || !args.formula.contains('=') {
        if args.dataset.is_some() || !args.domain.is_empty() {
            let message = "a folder's formulas are checked over the domain of its run; give a formula for a dataset or --domain";
            return Err(Failure::usage(message));
        }
        return check_front(args, path, common);
    }
    let (program, names, asked) = match &args.dataset {
        Some(dataset) => of_dataset(args, dataset)?,
        None => of_domain(args)?,
    };
    check_one(args, &program, &names, &asked, common)
}

/// The questions, and the inputs they range over.
struct Asked {
    inputs: Vec<Column>,
    questions: Questions,
}

fn of_dataset(args: &Args, path: &Path) -> Result<(Program, Names, Asked), Failure> {
    let dataset = Dataset::load(path)?;
    let (program, names) = settled(assigned_outputs(&args.formula, &dataset.names())?)?;
    let dataset = dataset.select(Some(&names.inputs), Some(&names.outputs))?;
    let questions = questions(args, &dataset.inputs, &dataset.outputs, &dataset.claims)?;
    let questions = against(args, questions, formula_of(&dataset), &names)?;
    Ok((program, names, Asked { inputs: dataset.inputs, questions }))
}

fn of_domain(args: &Args) -> Result<(Program, Names, Asked), Failure> {
    let (program, names) = settled(parse_open(&args.formula, &[])?)?;
    let column = |name: &String, domain| Column::new(name, domain);
    let mut inputs = Vec::new();
    for name in &names.inputs {
        let given = args.domain.iter().find_map(|text| {
            text.split_once('=').filter(|(input, _)| input == name).map(|(_, range)| range)
        });
        let given = given.ok_or_else(|| {
            let message = format!(
                "`{name}` can be anything; give a dataset that has it, or --domain {name}=0..1"
            );
            Failure::usage(message)
        })?;
        let [low, high] = range(given)?;
        if !((low as f32).is_finite() && (high as f32).is_finite()) {
            return Err(Failure::usage(format!("--domain {name}: both ends must be finite f32s")));
        }
        inputs.push(column(name, [low, high]));
    }
    for text in &args.domain {
        let name = text.split('=').next().unwrap_or_default();
        if !names.inputs.iter().any(|input| input == name) {
            let hint = did_you_mean(name, names.inputs.iter().map(String::as_str));
            return Err(Failure::usage(format!(
                "--domain {text}: the formula has no input `{name}`{hint}"
            )));
        }
    }
    let anything = [f64::NEG_INFINITY, f64::INFINITY];
    let outputs: Vec<Column> = names.outputs.iter().map(|name| column(name, anything)).collect();
    let questions = against(args, questions(args, &inputs, &outputs, &[])?, None, &names)?;
    Ok((program, names, Asked { inputs, questions }))
}

/// Returns the questions that the columns suggest, changed by the command line.
fn questions(
    args: &Args,
    inputs: &[Column],
    outputs: &[Column],
    claims: &[String],
) -> Result<Questions, Failure> {
    let claims = claimed(args, inputs, outputs, claims)?;
    let mut questions = Questions { slack: args.slack, ..Questions::of(inputs, outputs, &claims) };
    for text in &args.range {
        let (name, bounds) = match text.split_once('=') {
            Some((name, bounds)) => (Some(name), range(bounds)?),
            None => (None, range(text)?),
        };
        let known = |name: &str| outputs.iter().any(|output| output.name == name);
        if let Some(name) = name.filter(|name| !known(name)) {
            let hint = did_you_mean(name, outputs.iter().map(|output| output.name.as_str()));
            return Err(Failure::usage(format!(
                "--range {text}: there is no output `{name}`{hint}"
            )));
        }
        for (output, range) in outputs.iter().zip(&mut questions.ranges) {
            if name.is_none_or(|name| name == output.name) {
                *range = bounds;
            }
        }
    }
    Ok(questions)
}

/// Adds the truth, which `--truth` gives, or the data.
fn against(
    args: &Args,
    questions: Questions,
    known: Option<String>,
    names: &Names,
) -> Result<Questions, Failure> {
    let truth = match (&args.truth, known) {
        (Some(text), _) => {
            // A single expression is the only output.
            let text = match names.outputs.as_slice() {
                [output] if !text.contains('=') => format!("{output} = {text}"),
                _ => text.clone(),
            };
            read_formula(&text, &names.outputs)?;
            let truth = exact_formula(&text, names).ok_or_else(|| {
                let inputs = names.inputs.join(", ");
                Failure::usage(format!("--truth: it must be over the formula's inputs: {inputs}"))
            })?;
            Some(truth)
        }
        (None, Some(text)) => exact_formula(&text, names),
        (None, None) => None,
    };
    match (&truth, args.max_error) {
        (None, Some(_)) => Err(Failure::usage(
            "--max-error needs a truth: give it by --truth, or data made by --formula",
        )),
        _ => Ok(Questions { truth, ..questions }),
    }
}

/// Returns the claims that come with the data, then those of the command line.
fn claimed(
    args: &Args,
    inputs: &[Column],
    outputs: &[Column],
    known: &[String],
) -> Result<Vec<String>, Failure> {
    let names = |columns: &[Column]| columns.iter().map(|c| c.name.clone()).collect::<Vec<_>>();
    let names = Names::new(names(inputs), names(outputs));
    let mut claims = known.to_vec();
    for text in &args.claim {
        if text.contains(':') {
            Claim::add(&mut claims, text, &names)
                .map_err(|error| Failure::usage(format!("--claim: {error}")))?;
        } else if !claims.iter().any(|claim| Claim::name_of(claim) == text) {
            let hint = did_you_mean(text, claims.iter().map(|claim| Claim::name_of(claim)));
            let message = format!(
                "--claim {text}: the data comes with no such claim{hint}; write it out, as in \"{text}: {} <= 1\"",
                names.outputs[0]
            );
            return Err(Failure::usage(message));
        }
    }
    Ok(claims)
}

/// Parses `0..1`, `0..` or `..1`.
fn range(text: &str) -> Result<[f64; 2], Failure> {
    let end = |text: &str, otherwise: f64| match text {
        "" => Some(otherwise),
        text => text.parse().ok().filter(|x: &f64| !x.is_nan()),
    };
    text.split_once("..")
        .and_then(|(low, high)| Some([end(low, f64::NEG_INFINITY)?, end(high, f64::INFINITY)?]))
        .filter(|[low, high]| low <= high)
        .ok_or_else(|| Failure::usage(format!("`{text}`: a range is LOW..HIGH, as in 0..1")))
}

fn check_one(
    args: &Args,
    program: &Program,
    names: &Names,
    Asked { inputs, questions }: &Asked,
    common: &Common,
) -> Result<(), Failure> {
    let examination = Examination::of(program, questions, args.half);
    let verdict = VerdictRecord::new(&examination.verdict, names);
    let mut value = examination::json(&examination, names);
    value["verdict"] = json!(verdict);
    let sides = inputs.iter().map(|Column { name, domain: [low, high], .. }| {
        format!("{name} in [{}, {}]", shortest(*low), shortest(*high))
    });
    let sides = sides.collect::<Vec<_>>().join(", ");
    let text = format!(
        "domain: {sides}; slack {}\n\n{}",
        args.slack,
        examination::text(&examination, names)
    );
    common.result(&value, &text)?;
    match (refuted(args, &verdict), beyond(args, &verdict)) {
        (Some(claim), _) => Err(Failure::unmet(claim_text(claim))),
        (None, Some(error)) => Err(Failure::unmet(error)),
        (None, None) => Ok(()),
    }
}

/// Returns the first claim that was asked for and is refuted.
fn refuted<'a>(args: &Args, verdict: &'a VerdictRecord) -> Option<&'a ClaimRecord> {
    let [finite, range] = ALWAYS_ASKED;
    let asked = |topic: &str| {
        topic == finite
            || topic == range && !args.range.is_empty()
            || args.claim.iter().any(|claim| Claim::name_of(claim) == topic)
    };
    let topics = verdict.topics().into_iter().filter(|(topic, _)| asked(topic));
    topics.map(|(_, claim)| claim).find(|claim| claim.exact.status == "refuted")
}

/// Returns the first error that is not proved to be as small as asked.
fn beyond(args: &Args, verdict: &VerdictRecord) -> Option<String> {
    let most = args.max_error?;
    let is_within = |error: &TruthRecord| error.exact.most.is_some_and(|proved| proved <= most);
    let beyond = verdict.truth.iter().find(|error| !is_within(error))?;
    Some(format!("an error of at most {most} is not proved: {}", truth_sentence(beyond)))
}

fn check_front(args: &Args, folder: &Path, common: &Common) -> Result<(), Failure> {
    let (run, front) = run_folder::load(folder, args.which)?;
    let names = run.names();
    let questions = questions(args, &run.inputs, &run.outputs, &run.claims)?;
    let questions = against(args, questions, run.truth.clone(), &names)?;
    if let Some(number) = args.pick {
        let member = number.checked_sub(1).and_then(|i| front.members.get(i)).ok_or_else(|| {
            Failure::usage(format!(
                "--pick {number}: give a number from 1 to {}",
                front.members.len()
            ))
        })?;
        let asked = Asked { inputs: run.inputs.clone(), questions };
        return check_one(args, &member.program, &names, &asked, common);
    }
    let judge = |member: &FrontMember| {
        VerdictRecord::new(&Verdict::of(&member.program, &questions), &names)
    };
    let verdicts: Vec<VerdictRecord> = front.members.par_iter().map(judge).collect();
    let pairs = || front.members.iter().zip(&verdicts);
    let records: Vec<_> = pairs()
        .map(|(member, verdict)| {
            json!({"cost": member.cost, "formula": member.formula, "verdict": verdict})
        })
        .collect();
    let mut text = format!("{:>4}  {:>6}  verdict\n", "#", "cycles");
    for (i, (member, verdict)) in pairs().enumerate() {
        text += &rows(i + 1, member, verdict);
    }
    text += &totals(&verdicts);
    common.result(&records, &text)?;
    let fails = |verdict: &&VerdictRecord| {
        refuted(args, verdict).is_some() || beyond(args, verdict).is_some()
    };
    let failed = verdicts.iter().filter(fails).count();
    if failed > 0 {
        let message = format!("{failed} of {} formulas fail in what was asked for", verdicts.len());
        return Err(Failure::unmet(message));
    }
    Ok(())
}

/// Returns a line for each topic that is not proved, or a single line.
fn rows(number: usize, member: &FrontMember, verdict: &VerdictRecord) -> String {
    let (good, bad): (Vec<_>, Vec<_>) =
        verdict.topics().into_iter().partition(|(_, claim)| claim.claim.is_none());
    let words: Vec<&str> = good.iter().map(|(topic, _)| *topic).collect();
    let proved = (!words.is_empty()).then(|| format!("{} proved", words.join(", ")));
    let lines = proved.into_iter().chain(bad.iter().map(|(_, claim)| claim_text(claim)));
    let lines = lines.chain(verdict.truth.iter().map(truth_sentence));
    let mut text = String::new();
    for (i, line) in lines.enumerate() {
        let _ = match i {
            0 => writeln!(text, "{number:>4}  {:>6}  {line}", cycles_text(member.cost)),
            _ => writeln!(text, "{:>4}  {:>6}  {line}", "", ""),
        };
    }
    text
}

/// Counts the formulas that are proved, refuted and open, by topic.
fn totals(verdicts: &[VerdictRecord]) -> String {
    let mut text = String::from("\n              proved  refuted     open\n");
    let topics = verdicts.first().map(VerdictRecord::topics).unwrap_or_default();
    for (place, (topic, _)) in topics.iter().enumerate() {
        let claims: Vec<_> = verdicts.iter().map(|verdict| verdict.topics()[place].1).collect();
        let exact = claims.iter().map(|claim| &claim.exact.status).collect::<Vec<_>>();
        let gpu = claims.iter().flat_map(|claim| &claim.gpu).map(|gpu| &gpu.status).collect();
        for (arithmetic, found) in [("f32", exact), ("GPUs", gpu)] {
            let [proved, refuted, open] = ["proved", "refuted", "open"]
                .map(|status| found.iter().filter(|found| **found == status).count());
            let _ =
                writeln!(text, "{topic:<7} {arithmetic:<5} {proved:>6}   {refuted:>6}   {open:>6}");
        }
    }
    text
}
