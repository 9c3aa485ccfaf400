//! The findings of `lgp check` on a formula, as text and as JSON.

use super::truth::truth_sentence;
use super::verdict::{number_text, share_text, status_text};
use crate::program::{Arg, Names, Program, effective, print_expression};
use crate::stability::{
    At, Blame, Break, Cause, ClaimRecord, Examination, Extreme, Finding, JUMP, Liberty,
    PrecisionLoss, Status, Trend, Tried, VerdictRecord,
};
use serde_json::{Value, json};
use std::fmt::Write;

/// Returns the examination as text, a paragraph for each question.
pub fn text(examination: &Examination, names: &Names) -> String {
    let page = Page { examination, names };
    [
        page.claims(),
        page.truth(),
        page.extremes(),
        page.precision(),
        page.liberties(),
        page.smoothness(),
    ]
    .concat()
}

struct Page<'a> {
    examination: &'a Examination,
    names: &'a Names,
}

impl Page<'_> {
    fn output(&self, output: usize) -> &str {
        &self.names.outputs[output]
    }

    fn input<X: std::fmt::Debug>(&self, input: &[X]) -> String {
        let pairs = self.names.inputs.iter().zip(input);
        pairs.map(|(name, x)| format!("{name} = {x:?}")).collect::<Vec<_>>().join(", ")
    }

    fn operation(&self, instruction: usize) -> String {
        expression(&self.examination.program, instruction, self.names)
    }

    fn claims(&self) -> String {
        let findings = &self.examination.verdict.findings;
        let claim = |finding: &Finding| finding.text(self.names) + &finding.given();
        let width = findings.iter().map(|finding| claim(finding).chars().count()).max();
        // A width in a format has 16 bits.
        let width = width.unwrap_or(0).min(60);
        let mut text = format!("{:<width$}  {:<8}  GPUs\n", "claim", "f32");
        for finding in findings {
            let record = ClaimRecord::new(finding, self.names);
            let word = |status: &Status| match status {
                Status::Proved => "proved",
                Status::Refuted { .. } => "refuted",
                Status::Open { .. } => "open",
            };
            let claim = claim(finding);
            let detail = match (&finding.exact, &finding.gpu) {
                (Status::Refuted { .. }, _) => {
                    let text = status_text(&record.exact);
                    text.trim_start_matches("refuted: ").to_owned()
                }
                (Status::Open { volume }, _) | (_, Status::Open { volume }) => {
                    format!("open in {} of the domain", share_text(*volume))
                }
                _ => String::new(),
            };
            let [exact, gpu] = [&finding.exact, &finding.gpu].map(word);
            let line = format!("{claim:<width$}  {exact:<8}  {gpu:<8}  {detail}");
            text += line.trim_end();
            text.push('\n');
        }
        text
    }

    fn truth(&self) -> String {
        let record = VerdictRecord::new(&self.examination.verdict, self.names);
        let sentences = record.truth.iter().map(|error| format!("{}\n", truth_sentence(error)));
        sentences.collect()
    }

    fn extremes(&self) -> String {
        let mut text = String::from("\nedges\n");
        for extent in &self.examination.extremes {
            let place = match extent.place {
                Extreme::Edge => "on edges and corners",
                Extreme::JustOutside => "1 ulp or 1e-7 outside",
                Extreme::Outside => "5 % outside",
                Extreme::Zero => "at +0 and -0",
                Extreme::Denormal => "at denormals",
            };
            let number = |at: &Option<At>| at.as_ref().map(|at| number_text(at.value.into()));
            let range = match (number(&extent.least), number(&extent.largest)) {
                (Some(least), Some(largest)) => format!("{least} … {largest}"),
                _ => "no number".to_owned(),
            };
            let name = self.output(extent.output);
            let _ = write!(text, "  {place:<22} {name} {range}");
            if let Some(at) = &extent.not_finite {
                let _ = write!(text, "; {} at {}", at.value, self.input(&at.input));
            }
            text.push('\n');
        }
        text
    }

    fn precision(&self) -> String {
        let Examination { single, half, half_bound, half_tried, stay_single, .. } =
            self.examination;
        let mut text = String::from("\nprecision, worst found\n");
        for (what, worst) in [("f32", single), ("f16", half)] {
            for (kind, loss) in [("absolute", &worst.absolute), ("relative", &worst.relative)] {
                if let Some(loss) = loss {
                    text += &self.loss(&format!("{what} {kind}"), loss);
                }
            }
            if let Some(loss) = &worst.not_finite {
                let (name, input) = (self.output(loss.output), self.input(&loss.input));
                let _ = writeln!(text, "  {what} no number  {name} is {} at {input}", loss.found);
                if let Some(blame) = self.blame(&loss.blame) {
                    let _ = writeln!(text, "  {:<13} {blame}", "");
                }
            }
        }
        let bound = number_text(*half_bound);
        text += &match stay_single {
            Some(none) if none.is_empty() => {
                format!("  f16 throughout errs by {}\n", at_most(&bound, *half_tried))
            }
            Some(some) => {
                let total = self.examination.program.instrs.len();
                let each: Vec<String> =
                    some.iter().map(|&i| format!("    {}\n", self.operation(i))).collect();
                let each = each.concat();
                let count = some.len();
                format!(
                    "  in f16, to err by {}, {count} of {total} operations must stay f32:\n{each}",
                    at_most(&bound, *half_tried)
                )
            }
            None => format!(
                "  even f32, with halves for arguments and outputs only, does not come within {bound}\n"
            ),
        };
        text
    }

    fn loss(&self, what: &str, loss: &PrecisionLoss) -> String {
        let (absolute, relative) = (loss.absolute(), loss.relative());
        let size = match () {
            () if absolute == 0.0 && relative == 0.0 => return format!("  {what:<13} none\n"),
            () if what.ends_with("absolute") && what.starts_with("f32") => {
                format!("{} ({} ulp)", number_text(absolute), number_text(loss.ulps()))
            }
            () if what.ends_with("absolute") => number_text(absolute),
            () => number_text(relative),
        };
        let (name, input) = (self.output(loss.output), self.input(&loss.input));
        let (found, exact) = (loss.found, loss.exact);
        let found = format!("{} for {}", number_text(found), number_text(exact));
        let mut text = format!("  {what:<13} {size}: {name} is {found} at {input}\n");
        if let Some(blame) = self.blame(&loss.blame) {
            let _ = writeln!(text, "  {:<13} {blame}", "");
        }
        text
    }

    fn blame(&self, blame: &Blame) -> Option<String> {
        let place = self.operation(blame.instruction?);
        Some(match blame.cause {
            Cause::Rounding => return None,
            Cause::Cancellation | Cause::Condition => {
                let times = number_text(blame.condition);
                format!("{} in {place}: an error is multiplied by {times}", cause(blame.cause))
            }
            other => format!("{} in {place}", cause(other)),
        })
    }

    fn liberties(&self) -> String {
        let mut text = String::from("\nwhat compilers may change\n");
        for spread in &self.examination.spreads {
            let what = match spread.liberty {
                Liberty::Unfused => "mad in two steps",
                Liberty::Fused => "a*b + c fused",
                Liberty::Reciprocal => "a/b as a*rcp(b)",
                Liberty::Reassociated => "sums regrouped",
            };
            let size = spread.size();
            let _ = write!(text, "  {what:<17} ");
            text += &match size {
                0.0 => "nothing\n".to_owned(),
                size => format!(
                    "{}: {} at {}\n",
                    number_text(size),
                    self.output(spread.output),
                    self.input(&spread.input)
                ),
            };
        }
        text
    }

    fn smoothness(&self) -> String {
        let smoothness = &self.examination.smoothness;
        let mut text = String::from("\nsmoothness\n");
        for (output, trends) in smoothness.trends.iter().enumerate() {
            for (input, trend) in self.names.inputs.iter().zip(trends) {
                let goes = match trend {
                    Trend::Constant => "does not depend on",
                    Trend::Rising => "never falls with",
                    Trend::Falling => "never rises with",
                    Trend::Neither => "rises and falls with",
                };
                let _ = writeln!(text, "  {} {goes} {input}", self.output(output));
            }
        }
        for one in &smoothness.breaks {
            let (name, along) = (self.output(one.output), &self.names.inputs[one.along]);
            let place = format!(
                "{}, in {}",
                self.input(&single(&one.input)),
                self.operation(one.instruction)
            );
            let what = match one.jump.abs() > JUMP {
                true => format!("jumps by {}", number_text(one.jump)),
                false => format!("bends: its slope changes by {}", number_text(one.kink)),
            };
            let _ = writeln!(text, "  {name} along {along} {what} at {place}");
        }
        text
    }
}

/// Rounds an input to f32, the digits that matter.
fn single(input: &[f64]) -> Vec<f32> {
    input.iter().map(|&x| x as f32).collect()
}

/// Returns a bound on the error of halves in words; it is certain only if all inputs were tried.
pub fn at_most(error: &str, tried: Tried) -> String {
    let Tried { points, exhaustive } = tried;
    match exhaustive {
        true => format!(
            "{error} at most (all {points} inputs that halves hold tried, denormals kept and flushed)"
        ),
        false => {
            format!(
                "no more than {error} at the worst of {points} points, denormals kept and flushed"
            )
        }
    }
}

fn cause(cause: Cause) -> &'static str {
    match cause {
        Cause::Cancellation => "cancellation",
        Cause::Overflow => "overflow",
        Cause::Underflow => "underflow",
        Cause::Undefined => "no value",
        Cause::Condition => "steepness",
        Cause::Rounding => "rounding",
    }
}

/// Returns an instruction's expression, shortened in the middle if it is long.
pub fn expression(program: &Program, instruction: usize, names: &Names) -> String {
    const LONG: usize = 72;
    const DEEP: usize = 14;
    let mut draft = program.clone().into_draft();
    draft.outputs = vec![Arg::Result(instruction as u16)];
    let op = program.instrs[instruction].op();
    let Ok(alone) = Program::verify(draft) else { return op.to_string() };
    let alone = effective(&alone);
    if alone.instrs.len() > DEEP {
        return format!("the {op} of instruction {}", instruction + 1);
    }
    let text = print_expression(&alone, names);
    if text.len() <= LONG || !text.is_ascii() {
        return format!("`{text}`");
    }
    format!("`{}…{}`", &text[..LONG / 2], &text[text.len() - LONG / 2..])
}

/// Returns the examination as JSON; numbers that are not finite become null.
pub fn json(examination: &Examination, names: &Names) -> Value {
    let page = Page { examination, names };
    let input = |input: &[f32]| -> Value {
        names.inputs.iter().cloned().zip(input.iter().map(|&x| Value::from(x))).collect()
    };
    let loss = |loss: &Option<PrecisionLoss>| {
        let Some(loss) = loss else { return Value::Null };
        json!({
            "absolute": loss.absolute(), "relative": loss.relative(), "ulps": loss.ulps(),
            "output": page.output(loss.output), "input": input(&loss.input),
            "found": loss.found, "exact": loss.exact,
            "operation": loss.blame.instruction.map(|i| page.operation(i)),
            "cause": loss.blame.cause, "condition": loss.blame.condition,
        })
    };
    let claims = examination.verdict.findings.iter().map(|finding| {
        let mut record = json!(ClaimRecord::new(finding, names));
        record["claim"] = finding.text(names).into();
        record
    });
    let at = |at: &Option<At>| {
        at.as_ref().map(|at| json!({"value": at.value, "input": input(&at.input)}))
    };
    let extremes = examination.extremes.iter().map(|extent| {
        json!({
            "place": extent.place, "output": page.output(extent.output),
            "least": at(&extent.least), "largest": at(&extent.largest),
            "not_finite": at(&extent.not_finite),
        })
    });
    let spreads = examination.spreads.iter().map(|spread| {
        json!({
            "liberty": spread.liberty, "size": spread.size(), "output": page.output(spread.output),
            "input": input(&spread.input), "values": spread.values,
        })
    });
    let breaks = examination.smoothness.breaks.iter().map(|one: &Break| {
        let place: Value =
            names.inputs.iter().cloned().zip(one.input.iter().map(|&x| Value::from(x))).collect();
        json!({
            "output": page.output(one.output), "along": names.inputs[one.along], "input": place,
            "operation": page.operation(one.instruction), "jump": one.jump, "kink": one.kink,
        })
    });
    let trends = examination.smoothness.trends.iter().enumerate().map(|(output, trends)| {
        let trends: Value =
            names.inputs.iter().cloned().zip(trends.iter().map(|trend| json!(trend))).collect();
        (page.output(output).to_owned(), trends)
    });
    let stay_single = examination.stay_single.as_ref();
    json!({
        "claims": claims.collect::<Vec<_>>(),
        "extremes": extremes.collect::<Vec<_>>(),
        "f32": {"absolute": loss(&examination.single.absolute), "relative": loss(&examination.single.relative), "not_finite": loss(&examination.single.not_finite)},
        "f16": {
            "absolute": loss(&examination.half.absolute), "relative": loss(&examination.half.relative), "not_finite": loss(&examination.half.not_finite),
            "bound": examination.half_bound, "points": examination.half_tried.points,
            "exhaustive": examination.half_tried.exhaustive,
            "stay_f32": stay_single.map(|all| all.iter().map(|&i| page.operation(i)).collect::<Vec<_>>()),
        },
        "liberties": spreads.collect::<Vec<_>>(),
        "trends": trends.collect::<serde_json::Map<_, _>>(),
        "breaks": breaks.collect::<Vec<_>>(),
    })
}
