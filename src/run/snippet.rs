//! Members as functions ready to paste, each with a comment that describes it.

use super::Run;
use crate::dataset::Column;
use crate::emit::{self, Arguments, Call, CallError, Engine, Head, Language, Lets, Snippet};
use crate::eval::OutputError;
use crate::fit::Measure;
use crate::num::Interval;
use crate::program::{Names, Program, format_constant, shortest};
use crate::search::{CostOf, FrontMember};
use crate::stability::{half_loss, unheld};
use crate::truth::DomainError;
use crate::wording::examination::at_most;
use crate::wording::{cycles_text, error_text, number_text, title, verdict_lines};
use std::collections::BTreeSet;

/// Returns a member as a function ready to paste.
pub fn snippet(run: &Run, member: &FrontMember, language: Language) -> String {
    let (names, header) = (run.names(), header(run, member));
    emit::emit(language, &Snippet::new(&member.program, &names, &run.name).header(&header))
}

/// What a member is written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// A language.
    Language(Language),
    /// An engine.
    Engine(Engine),
}

/// How a member is written.
#[derive(Clone, Debug)]
pub struct Form {
    /// The language or engine.
    pub target: Target,
    /// The function's name, if it is another than the run's.
    pub function: Option<String>,
    /// The function's head, if it is another than usual.
    pub head: Option<Head>,
    /// What is said of inputs and results.
    pub lets: Lets,
    /// True if inputs are clamped to their domain.
    pub clamp_inputs: bool,
    /// True if there are comments.
    pub comments: bool,
}

/// A member as it is called.
#[derive(Clone, Debug)]
pub struct Called {
    /// The program, over the parameters.
    pub program: Program,
    /// The names of its inputs and outputs.
    pub names: Names,
    /// The ranges of its inputs.
    pub domain: Vec<Interval>,
    /// The call, unless the function is as usual.
    call: Option<Call>,
}

impl Form {
    /// Returns the usual form in a language.
    pub fn of(language: Language) -> Form {
        let (function, head, lets) = (None, None, Lets::default());
        let target = Target::Language(language);
        Form { target, function, head, lets, clamp_inputs: false, comments: true }
    }

    /// Returns the language of the function.
    pub fn language(&self) -> Language {
        match self.target {
            Target::Language(language) => language,
            Target::Engine(engine) => engine.language(),
        }
    }

    /// Returns a member as this form calls it.
    ///
    /// # Errors
    /// [`CallError`] if a head does not fit.
    pub fn called(&self, run: &Run, member: &FrontMember) -> Result<Called, CallError> {
        let (names, program) = (run.names(), &member.program);
        let plain = self.function.is_none() && !self.clamp_inputs && self.lets.is_empty();
        let function = || match (&self.function, names.outputs.as_slice()) {
            (Some(function), _) => function.clone(),
            (None, [output]) => emit::of_output(&run.name, output),
            (None, _) => run.name.clone(),
        };
        let head = match (&self.head, self.target) {
            (Some(head), _) => Head {
                function: self.function.clone().unwrap_or_else(|| head.function.clone()),
                ..head.clone()
            },
            (None, Target::Engine(engine)) => engine.head(&function(), &names),
            (None, Target::Language(_)) if plain => {
                let domain = run.questions().domain;
                return Ok(Called { program: program.clone(), names, domain, call: None });
            }
            (None, Target::Language(language)) => language.head(&function(), &names),
        };
        self.under(head, run, program)
    }

    fn under(&self, head: Head, run: &Run, program: &Program) -> Result<Called, CallError> {
        let (names, mut lets) = (run.names(), self.lets.clone());
        if self.clamp_inputs {
            for column in &run.inputs {
                let value = match lets.of(&column.name) {
                    Some(text) => Some(text.to_owned()),
                    None => head.component(&column.name),
                };
                if let Some(value) = value {
                    lets.set(&column.name, clamped(&value, column.domain));
                }
            }
        }
        let call = emit::call(program, &names, &head, &lets)?;
        let arguments = Arguments::of(&call.names.inputs, &names.inputs, &head.columns, &lets)?;
        let domains: Vec<[f64; 2]> = run.inputs.iter().map(|column| column.domain).collect();
        arguments.reach(&names.inputs, &lets, &domains)?;
        let domain = arguments.domain(&domains);
        let domain =
            domain.iter().map(|[low, high]| Interval::new(*low as f32, *high as f32)).collect();
        let (program, names) = (call.program.clone(), call.names.clone());
        Ok(Called { program, names, domain, call: Some(call) })
    }

    /// Writes a member as it is called; in half precision except for the instructions of `half`,
    /// if it is given.
    pub fn written(
        &self,
        run: &Run,
        member: &FrontMember,
        called: &Called,
        half: Option<&[usize]>,
    ) -> String {
        let mut header = header(run, member);
        if let Some(call) = &called.call {
            header.extend(cost_of_call(run, member, called));
            header.extend(call.comments.iter().cloned());
        }
        let stay_single = half.map(<[usize]>::to_vec).or_else(|| self.half_beside(called));
        if let Some(stay_single) = &stay_single {
            let only = half.is_none();
            header.extend(half_lines(&called.program, &called.domain, stay_single, only));
        }
        let header = self.comments.then_some(header.as_slice());
        match (self.target, &called.call) {
            (Target::Engine(engine), Some(call)) => {
                emit::emit_for(engine, call, header, stay_single.as_deref())
            }
            _ => {
                let mut snippet = Snippet::new(&called.program, &called.names, &run.name);
                if let Some(call) = &called.call {
                    snippet = snippet.signature(&call.signature);
                }
                let snippet = match header {
                    Some(header) => snippet.header(header),
                    None => snippet.without_comments(),
                };
                let language = self.language();
                let halves = stay_single.and_then(|s| emit::emit_half(language, &snippet, &s));
                halves.unwrap_or_else(|| emit::emit(language, &snippet))
            }
        }
    }

    /// Returns what stays in single precision in the function of halves that some engines' files
    /// have beside the one of floats: nothing, or all if halves do not hold it.
    fn half_beside(&self, called: &Called) -> Option<Vec<usize>> {
        let Target::Engine(engine) = self.target else { return None };
        if !engine.has_both() {
            return None;
        }
        let held = unheld(&called.program, &called.domain, &[]).is_none();
        Some(if held { Vec::new() } else { (0..called.program.instrs.len()).collect() })
    }
}

/// Returns the expression of an input that is kept within its domain.
fn clamped(value: &str, domain: [f64; 2]) -> String {
    let [low, high] = domain.map(|end| format_constant(end as f32));
    match domain {
        [0.0, 1.0] => format!("saturate({value})"),
        _ => format!("min(max({value}, {low}), {high})"),
    }
}

/// Returns the line on what the function costs as it is called, if that is something else.
fn cost_of_call(run: &Run, member: &FrontMember, called: &Called) -> Option<String> {
    let profile = run.profile()?;
    let cycles = |program| cycles_text(profile.cost(program).cycles);
    let cycles = [cycles(&member.program), cycles(&called.program)];
    let [_, called] = &cycles;
    (cycles[0] != *called).then(|| format!("as it is called here: {called} cycles on {}", run.gpu))
}

/// Describes what halves lose.
fn half_lines(
    program: &Program,
    domain: &[Interval],
    stay_single: &[usize],
    beside: bool,
) -> Vec<String> {
    let (error, tried) = half_loss(program, domain, stay_single);
    let subject = if beside { "the function of halves is" } else { "this is" };
    let total = program.instrs.len();
    vec![
        format!("cost, errors and verdicts above are those of single precision; {subject}"),
        match stay_single.len() {
            0 => "in half precision throughout,".to_owned(),
            singles => format!("in half precision, {singles} of {total} operations in single,"),
        },
        format!("which adds an error of {}", at_most(&number_text(error), tried)),
    ]
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
    let derived = run.derived.iter().map(|derived| emit::derived_line(&one_line(derived)));
    header.splice(2..2, derived);
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
