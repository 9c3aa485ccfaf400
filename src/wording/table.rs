//! A front as a table of text, with published formulas on the same axes.

use super::truth::rounded_up;
use crate::fit::Measure;
use crate::search::{Front, FrontMember, ScoredIncumbent};
use crate::stability::TruthRecord;
use std::fmt::Write;

/// Returns the front by rising cost, each member's formula under its numbers, incumbents where
/// their cost puts them. Errors are over all outputs; errors by output follow if there are several.
pub fn front_table(front: &Front, incumbents: &[ScoredIncumbent], outputs: &[String]) -> String {
    let judged = front.members.iter().any(|member| member.verdict.is_judged());
    let is_integrated = front.is_integrated();
    let mut text = heading(outputs, front.measure, is_integrated, judged);
    let mut waiting: Vec<&ScoredIncumbent> = incumbents.iter().collect();
    waiting.sort_by(|a, b| a.member.cost.total_cmp(&b.member.cost));
    let mut waiting = waiting.into_iter().peekable();
    for (i, member) in front.members.iter().enumerate() {
        while let Some(known) = waiting.next_if(|known| known.member.cost < member.cost) {
            text += &incumbent_row(known, front);
        }
        let numbers = numbers(member, front.measure, is_integrated);
        let _ = writeln!(text, "{:>4}  {numbers}{}", i + 1, statuses(member));
        let _ = writeln!(text, "      {}", member.formula);
        for hole in &member.holes {
            let _ = writeln!(text, "      with {hole}");
        }
    }
    waiting.for_each(|known| text += &incumbent_row(known, front));
    if front.members.len() + incumbents.len() > 1 {
        text += &cut(front);
    }
    text
}

/// Says by which error formulas are on the front.
pub fn cut(front: &Front) -> String {
    let title = axis_title(front.measure);
    match front.measure {
        _ if front.is_integrated() => format!(
            "The front holds each formula that no cheaper one equals in {title} over the whole domain; errors are integrated adaptively, to within \"± RMSE\", and \"+ max\" is what the largest may be above what was found.\n"
        ),
        Measure::Max => format!(
            "The front holds each formula that no cheaper one equals in {title} on the search split, where {title} was minimised.\n"
        ),
        _ => format!(
            "The front holds each formula that no cheaper one equals in {title} on the validation split, to which no constant was fitted; {title} was minimised on the search split.\n"
        ),
    }
}

/// Returns true if the measure is none of those that every table has.
fn is_own_column(measure: Measure) -> bool {
    !matches!(measure, Measure::Rmse | Measure::Max)
}

fn heading(outputs: &[String], measure: Measure, is_integrated: bool, judged: bool) -> String {
    let mut text = format!("{:>4}  {:>6}  {:>8} {:>8}  ", "#", "cycles", "RMSE", "max");
    let [rmse, max] = if is_integrated { ["± RMSE", "+ max"] } else { ["val.RMSE", "val.max"] };
    let _ = write!(text, "{rmse:>8} {max:>8}");
    if outputs.len() > 1 {
        for output in outputs {
            let _ = write!(text, "  {:>17}", format!("{output} RMSE, max"));
        }
    }
    if is_own_column(measure) {
        let _ = write!(text, "  {:>13} {:>13}", title(measure), format!("val. {measure}"));
    }
    text + if judged { "  verdict\n" } else { "\n" }
}

/// Describes a member's verdict in a few words, what is proved first.
fn statuses(member: &FrontMember) -> String {
    let verdict = &member.verdict;
    if !verdict.is_judged() {
        return String::new();
    }
    let topics = verdict.topics();
    let of = |wanted: &str| -> Vec<&str> {
        topics.iter().filter(|(_, claim)| claim.exact.status == wanted).map(|(t, _)| *t).collect()
    };
    let words = ["proved", "open", "refuted"].map(|status| (status, of(status)));
    let said = words.iter().filter(|(_, topics)| !topics.is_empty());
    let said: Vec<String> =
        said.map(|(status, topics)| format!("{} {status}", topics.join(", "))).collect();
    let bound = |error: &TruthRecord| error.exact.most;
    let bounds: Option<Vec<f64>> = verdict.truth.iter().map(bound).collect();
    let largest = bounds.and_then(|all| all.into_iter().reduce(f64::max));
    let proved = largest.map(|most| format!("; error ≤ {} proved", rounded_up(most)));
    format!("  {}{}", said.join("; "), proved.unwrap_or_default())
}

fn numbers(member: &FrontMember, measure: Measure, is_integrated: bool) -> String {
    let (shown, validation) = match is_integrated {
        true => (member.error(), member.validation_error()),
        false => (member.search_error(), member.validation_error()),
    };
    let beside = match (is_integrated, member.domain_error()) {
        (false, _) => [validation.rmse, validation.max].map(error),
        (true, Some(domain)) => [domain.rmse_within, domain.max_within].map(error),
        // On the samples alone.
        (true, None) => [(); 2].map(|()| format!("{:>8}", "?")),
    };
    let mut text = format!(
        "{:>6}  {} {}  {} {}",
        cycles_text(member.cost),
        error(shown.rmse),
        error(shown.max),
        beside[0],
        beside[1]
    );
    if member.score.search.len() > 1 {
        for output in if is_integrated { member.errors() } else { member.score.search.clone() } {
            let _ = write!(text, "  {} {}", error(output.rmse), error(output.max));
        }
    }
    if is_own_column(measure) {
        let [search, validation] = [shown, validation].map(|error| error_text(error.of(measure)));
        let _ = write!(text, "  {search:>13} {validation:>13}");
    }
    text
}

fn incumbent_row(known: &ScoredIncumbent, front: &Front) -> String {
    let standing = match dominating(known, front) {
        Some((i, member)) => format!(
            "dominated by {} ({} cycles, {} {})",
            i + 1,
            cycles_text(member.cost),
            deciding_title(front),
            error_text(member.deciding_error(front.measure))
        ),
        None => "not dominated".to_owned(),
    };
    let numbers = numbers(&known.member, front.measure, front.is_integrated());
    format!("   *  {numbers}\n      {}: {standing}\n", known.name)
}

/// Returns a measure's name in tables and plots.
pub fn title(measure: Measure) -> &'static str {
    match measure {
        Measure::Rmse => "RMSE",
        Measure::Max => "max",
        Measure::Weighted => "weighted RMSE",
        Measure::Relative => "relative RMSE",
        Measure::Visible => "visible RMSE",
    }
}

/// Returns the name of the error that decides about a front in this measure.
fn deciding_title(front: &Front) -> String {
    match front.measure {
        measure if measure == Measure::Max || front.is_integrated() => title(measure).to_owned(),
        measure => format!("val. {}", title(measure)),
    }
}

/// Returns a measure's name beside a plot's axis.
pub fn axis_title(measure: Measure) -> &'static str {
    match measure {
        Measure::Max => "maximum error",
        _ => title(measure),
    }
}

/// Returns the cheapest member that dominates an incumbent, and its index.
pub(crate) fn dominating<'a>(
    known: &ScoredIncumbent,
    front: &'a Front,
) -> Option<(usize, &'a FrontMember)> {
    front
        .members
        .iter()
        .enumerate()
        .find(|(_, member)| member.dominates(&known.member, front.measure))
}

/// Formats cycles with two decimals at most, as a mix of GPUs has them.
pub fn cycles_text(cycles: f64) -> String {
    let text = format!("{cycles:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Formats an error in eight columns.
fn error(value: f64) -> String {
    format!("{:>8}", error_text(value))
}

/// Formats an error with five decimals, or two significant digits if that would say little.
pub fn error_text(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        v if !(1e-4..1e3).contains(&v) => format!("{v:.1e}"),
        v => format!("{v:.5}"),
    }
}
