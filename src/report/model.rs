//! The contents of a run's page.

use super::page::{self, Code, CostAxis, Formula, Page, PageFront, PageSpheres, SampleTable};
use super::timing::Timing;
use super::{Error, Report};
use crate::cost::Profile;
use crate::dataset::Dataset;
use crate::emit::{self, Language, Snippet, header_lines};
use crate::eval::OutputError;
use crate::fit::Measure;
use crate::program::Program;
use crate::run::{self, Run};
use crate::search::{Front, FrontMember, ScoredIncumbent};
use crate::wording::{axis_title, cut};

/// Returns the page of a report.
pub(super) fn page(report: &Report) -> Result<Page, Error> {
    let Report { run, front, minimax, dataset, published, trace, timings } = report;
    let (profiles, own) = profiles(run)?;
    let priced = Priced { run, profiles: &profiles, timings };
    let names = run.names();
    let outputs = names.outputs.len();
    Ok(Page {
        title: format!("{}: {}", run.name, names.outputs.join(", ")),
        facts: facts(run, dataset.as_deref()),
        command: run.command.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" "),
        inputs: run.inputs.clone(),
        outputs: run.outputs.clone(),
        profiles: profiles.iter().map(cycles).chain(timings.iter().map(nanoseconds)).collect(),
        profile: own,
        fronts: match front.measure {
            Measure::Max => vec![priced.front(front)],
            _ => vec![priced.front(front), priced.front(minimax)],
        },
        published: published.iter().map(|known| priced.published(known)).collect(),
        lookup_tables: dataset
            .as_ref()
            .map(|data| page::lookup_tables(&data.search, outputs))
            .unwrap_or_default(),
        samples: dataset.as_ref().map(|data| SampleTable::of(&data.search, data.inputs.len())),
        trace: trace.clone(),
        spheres: dataset.as_deref().and_then(PageSpheres::of),
        languages: Language::OF_RUNS.iter().map(|language| language.name()).collect(),
    })
}

/// Returns the built-in GPU profiles and the run's own, and the index of the run's.
fn profiles(run: &Run) -> Result<(Vec<Profile>, usize), Error> {
    let mut profiles = Profile::built_in().map(Profile::find).collect::<Result<Vec<_>, _>>()?;
    let as_built_in = |profile: &Profile| {
        let same = |own: &Profile| own.fingerprint() == profile.fingerprint();
        profile.name == run.gpu && run.profile.as_ref().is_none_or(same)
    };
    let own = profiles.iter().position(as_built_in);
    let own = match (own, run.profile()) {
        (Some(own), _) => own,
        (None, Some(profile)) => {
            profiles.push(profile);
            profiles.len() - 1
        }
        // The record of an older version has only a file's name.
        (None, None) => 0,
    };
    Ok((profiles, own))
}

fn cycles(profile: &Profile) -> CostAxis {
    let (name, description) = (profile.name.clone(), profile.description.clone());
    CostAxis { name, description, unit: "cycles" }
}

fn nanoseconds(timing: &Timing) -> CostAxis {
    let (name, description) = (timing.device.clone(), timing.method.clone());
    CostAxis { name, description, unit: "ns an evaluation" }
}

/// The profiles and timings that price formulas.
struct Priced<'a> {
    run: &'a Run,
    profiles: &'a [Profile],
    timings: &'a [Timing],
}

impl Priced<'_> {
    fn front(&self, front: &Front) -> PageFront {
        let knee = front.knee().and_then(|knee| front.members.iter().position(|m| m == knee));
        PageFront {
            measure: front.measure.to_string(),
            title: axis_title(front.measure).to_owned(),
            cut: cut(front).trim_end().to_owned(),
            option: if front.measure == Measure::Max { "--minimax" } else { "" },
            members: front.members.iter().map(|member| self.member(member)).collect(),
            knee: knee.unwrap_or(0),
        }
    }

    fn member(&self, member: &FrontMember) -> Formula {
        let template = self.run.goal.template.iter().map(|text| run::one_line(text));
        Formula {
            template: template.chain(member.holes.iter().cloned()).collect(),
            code: self.code(&member.program),
            header: header_lines(&run::header(self.run, member)),
            verdict: serde_json::to_value(&member.verdict).expect("plain data"),
            ..self.formula(member)
        }
    }

    fn published(&self, known: &ScoredIncumbent) -> Formula {
        Formula {
            name: Some(known.name.clone()),
            code: self.code(&known.member.program),
            ..self.formula(&known.member)
        }
    }

    /// Returns the code in each language, without the header.
    fn code(&self, program: &Program) -> Vec<Code> {
        let names = self.run.names();
        let snippet = Snippet::new(program, &names, &self.run.name);
        let code = |&language: &Language| Code {
            comment: language.comment(),
            body: emit::emit(language, &snippet),
        };
        Language::OF_RUNS.iter().map(code).collect()
    }

    fn formula(&self, member: &FrontMember) -> Formula {
        let (names, program) = (self.run.names(), &member.program);
        let snippet = Snippet::new(program, &names, &self.run.name);
        let costs: Vec<_> = self.profiles.iter().map(|profile| profile.cost(program)).collect();
        let measured = self.timings.iter().map(|timing| timing.of(&member.formula));
        let of = self.run.goal.measure;
        let errors = |error: &OutputError| [error.rmse, error.max, error.of(of)];
        Formula {
            name: None,
            costs: costs.iter().map(|cost| Some(cost.cycles)).chain(measured).collect(),
            registers: costs.iter().map(|cost| Some(cost.registers)).collect(),
            errors: member.score.search.iter().map(errors).collect(),
            error: errors(&member.error()),
            bars: member.domain_error().map(|error| [error.rmse_within, error.max_within]),
            search: errors(&member.search_error()),
            validation: errors(&member.validation_error()),
            verdict: serde_json::Value::Null,
            formula: member.formula.clone(),
            template: Vec::new(),
            header: Vec::new(),
            code: Vec::new(),
            mathml: emit::mathml(&snippet),
            script: emit::javascript(program),
        }
    }
}

fn facts(run: &Run, dataset: Option<&Dataset>) -> Vec<(String, String)> {
    let mut facts =
        vec![("dataset".to_owned(), format!("{}, hash {}", run.name, run.dataset_hash))];
    let mut fact = |name: &str, value: String| facts.push((name.to_owned(), value));
    if let Some(dataset) = dataset {
        fact("made by", dataset.origin.to_string());
        let rows = [dataset.search.rows(), dataset.validation.rows()];
        fact("samples", format!("{} to search on, {} to validate", rows[0], rows[1]));
    }
    if let Some(scene) = &run.scene {
        fact("scene", format!("{}: {}", scene.name, scene.summary()));
    }
    fact("domain", run::domains(&run.inputs));
    if !run.derived.is_empty() {
        fact("derived outputs", run.derived.join("; "));
    }
    if let Some(template) = &run.goal.template {
        fact("template", run::one_line(template));
        fact("cost of", run.goal.cost_of.to_string());
    }
    if !run.claims.is_empty() {
        fact("claims", run.claims.join("; "));
    }
    fact("grammar, GPU", format!("{}, {}", run.grammar, run.gpu));
    fact("seed", run::seeds(run));
    fact("minimised error", run.goal.measure.to_string());
    fact("search", format!("{} generations in {:.1} s", run.generations, run.seconds));
    let counts = [run.counts.considered, run.counts.seen, run.counts.fitted, run.counts.admitted];
    fact(
        "candidates",
        format!(
            "{} considered; {} of a structure seen before; {} fitted; {} admitted",
            counts[0], counts[1], counts[2], counts[3]
        ),
    );
    fact("machine", format!("{}; {} threads", run.machine, run.threads));
    fact("lgp", run.version.clone());
    facts
}

/// Quotes a word for a shell.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:+@%".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn words_are_quoted_where_a_shell_would_take_them_apart() {
        assert_eq!(quoted("--outputs=a,b"), "--outputs=a,b");
        assert_eq!(quoted("b = x*y"), "'b = x*y'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
    }
}
