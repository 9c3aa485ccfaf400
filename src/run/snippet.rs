//! Members as functions ready to paste, each with a comment that describes it.

use super::Run;
use crate::dataset::Column;
use crate::emit::{self, Language, Snippet};
use crate::eval::OutputError;
use crate::fit::Measure;
use crate::num::Interval;
use crate::program::shortest;
use crate::search::{CostOf, FrontMember};
use crate::stability::half_loss;
use crate::truth::DomainError;
use crate::wording::examination::at_most;
use crate::wording::{cycles_text, error_text, number_text, title, verdict_lines};
use std::collections::BTreeSet;

/// Returns a member as a function ready to paste.
pub fn snippet(run: &Run, member: &FrontMember, language: Language) -> String {
    let (names, header) = (run.names(), header(run, member));
    emit::emit(language, &Snippet::new(&member.program, &names, &run.name).header(&header))
}

/// Returns a member in half precision except for some instructions, if the language has halves.
pub fn half_snippet(
    run: &Run,
    member: &FrontMember,
    language: Language,
    domain: &[Interval],
    stay_single: &[usize],
) -> Option<String> {
    let (names, mut header) = (run.names(), header(run, member));
    let (error, tried) = half_loss(&member.program, domain, stay_single);
    header
        .push("cost, errors and verdicts above are those of single precision; this is".to_owned());
    header.push(match stay_single.len() {
        0 => "in half precision throughout,".to_owned(),
        singles => {
            let total = member.program.instrs.len();
            format!("in half precision, {singles} of {total} operations in single,")
        }
    });
    header.push(format!("which adds an error of {}", at_most(&number_text(error), tried)));
    let snippet = Snippet::new(&member.program, &names, &run.name).header(&header);
    emit::emit_half(language, &snippet, stay_single)
}

/// Returns the comment above a member, as lines.
pub fn header(run: &Run, member: &FrontMember) -> Vec<String> {
    let names = run.names();
    let mut header = vec![
        format!("{} → {}", names.inputs.join(", "), names.outputs.join(", ")),
        format!("data: {} ({}), {}, lgp {}", run.name, run.dataset_hash, seeds(run), run.version),
        format!("domain: {}", domains(&run.inputs)),
        cost_line(member, run),
    ];
    header.extend(error_lines(run, member));
    if let Some(scene) = &run.scene {
        header.insert(2, format!("scene: {}: {}", scene.name, scene.summary()));
    }
    if names.outputs.len() > 1 {
        for (output, error) in names.outputs.iter().zip(&member.errors()) {
            header.push(format!("       {output}: {}", described(*error, run.goal.measure)));
        }
    }
    header.extend(verdict_lines(&member.verdict));
    header.push(emit::formula_line(&member.formula));
    if let Some(template) = run.goal.template.as_ref().filter(|_| !member.holes.is_empty()) {
        header.push(format!("template: {}", one_line(template)));
        header.extend(member.holes.iter().map(|hole| format!("with {hole}")));
    }
    header
}

/// Returns a line for the error over the whole domain, if it was integrated, else for each split.
fn error_lines(run: &Run, member: &FrontMember) -> Vec<String> {
    if let Some(error) = member.domain_error().filter(|_| member.is_integrated(run.goal.measure)) {
        let DomainError { rmse, rmse_within, max, max_within } = error;
        let [rmse, within, max, above] = [rmse, rmse_within, max, max_within].map(error_text);
        let line = format!("error: RMSE {rmse} ± {within}, max {max} + {above} over the domain");
        return vec![line];
    }
    let (search, validation) = (member.search_error(), member.validation_error());
    vec![
        format!("error: {} on the search split", described(search, run.goal.measure)),
        format!("       {} on the validation split", described(validation, run.goal.measure)),
    ]
}

/// Returns a formula text of several lines in one, without comments: a line's end is a statement's.
pub fn one_line(text: &str) -> String {
    let code = |line: &str| -> String {
        let end = line.find('#').into_iter().chain(line.find("//")).min();
        line[..end.unwrap_or(line.len())].trim().trim_end_matches(';').to_owned()
    };
    let lines: Vec<String> = text.lines().map(code).filter(|line| !line.is_empty()).collect();
    lines.join("; ")
}

/// Returns the seed of a search, or those of a union.
pub fn seeds(run: &Run) -> String {
    if run.sources.is_empty() {
        return format!("seed {}", run.method.seed);
    }
    let seeds: BTreeSet<u64> = run.sources.iter().map(|source| source.method.seed).collect();
    let seeds: Vec<String> = seeds.iter().map(u64::to_string).collect();
    format!("{} {}", if seeds.len() == 1 { "seed" } else { "seeds" }, seeds.join(", "))
}

fn cost_line(member: &FrontMember, run: &Run) -> String {
    let mut cycles = cycles_text(member.cost);
    if run.goal.cost_of == CostOf::Holes {
        let profile = run.profile();
        let whole = profile.map(|profile| profile.cost(&member.program).cycles);
        let whole = whole.map_or_else(|| "?".to_owned(), cycles_text);
        cycles = format!("{cycles} cycles of the template's holes, {whole} of the whole,");
        return match member.registers {
            Some(registers) => format!("cost: {cycles} {registers} registers on {}", run.gpu),
            None => format!("cost: {cycles} on {}", run.gpu),
        };
    }
    match member.registers {
        Some(1) => format!("cost: {cycles} cycles, 1 register on {}", run.gpu),
        Some(registers) => format!("cost: {cycles} cycles, {registers} registers on {}", run.gpu),
        None => format!("cost: {cycles} cycles on {}", run.gpu),
    }
}

/// Describes RMSE and maximum, after the measure that was minimised, if it is neither.
fn described(error: OutputError, measure: Measure) -> String {
    let usual = format!("RMSE {}, max {}", error_text(error.rmse), error_text(error.max));
    match measure {
        Measure::Rmse | Measure::Max => usual,
        _ => format!("{} {}, {usual}", title(measure), error_text(error.of(measure))),
    }
}

/// Lists domains as `a in [0, 1], b in [0, 2]`.
pub fn domains(inputs: &[Column]) -> String {
    let domain = |column: &Column| {
        let [low, high] = column.domain.map(shortest);
        format!("{} in [{low}, {high}]", column.name)
    };
    inputs.iter().map(domain).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::one_line;

    #[test]
    fn one_line_has_all_statements_and_no_comments() {
        let text = "# a lobe\na = r*r; // width\n\n  b = a + 1\ny = b # that is all\n";
        assert_eq!(one_line(text), "a = r*r; b = a + 1; y = b");
    }
}
