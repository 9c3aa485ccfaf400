//! What data say before a search, as a page.

use crate::dataset::Dataset;
use crate::explore::{
    Exploration, Finding, Form, OutputReport, Pairing, Template, Verdict, explore,
};
use serde::Serialize;
use std::fmt::Write;
use std::path::Path;

/// The most forms of which it is told that nothing can be told. By hand: a line.
const MOST_OPEN: usize = 4;

/// The departure of the nearest form that is told where none holds, in spreads. By hand.
const WORTH_TELLING: f64 = 0.3;

/// The departure that rounding to `f32` explains. By hand.
const ROUNDING: f64 = 1e-6;

/// An exploration, and the commands that make use of it.
#[derive(Serialize)]
pub struct Explored {
    #[serde(flatten)]
    found: Exploration,
    /// For each output, a command for each of its templates.
    commands: Vec<Vec<String>>,
}

impl Explored {
    /// Explores the search split of a dataset that is a file.
    pub fn of(dataset: &Dataset, path: &Path) -> Explored {
        let found = explore(dataset);
        let command = |output: &OutputReport, template: &Template| {
            let outputs = match dataset.outputs.len() {
                1 => String::new(),
                _ => format!(" --outputs {}", output.output),
            };
            let path = quoted(&path.display().to_string());
            format!("lgp search {path}{outputs} --template \"{}\"", template.formula)
        };
        let of = |output: &OutputReport| {
            output.templates.iter().map(|template| command(output, template)).collect()
        };
        let commands = found.outputs.iter().map(of).collect();
        Explored { found, commands }
    }

    /// Returns the page.
    pub fn page(&self) -> String {
        let Exploration { rows, fitted, grid, outputs, units } = &self.found;
        let mut page = format!("Search split: {rows} rows");
        page += if *grid { ", a grid" } else { "" };
        if fitted < rows {
            let _ = write!(page, "; smooth fits use {fitted} of them");
        }
        page.push('\n');
        for (output, commands) in outputs.iter().zip(&self.commands) {
            page.push('\n');
            page += &output_page(output, commands);
        }
        if !units.is_empty() {
            page += "\nBy their units\n";
        }
        for product in units {
            let of = match &product.unit_of {
                None => "has no unit".to_owned(),
                Some(output) => format!("has the unit of {output}, {}", product.unit),
            };
            let _ = writeln!(page, "  {} {of}", product.text);
        }
        page
    }
}

fn output_page(output: &OutputReport, commands: &[String]) -> String {
    let Some(smooth) = &output.smooth else {
        return format!("{}: constant\n", output.output);
    };
    let mut page = format!(
        "{}: spread {:.4}; a smooth fit leaves {} of it",
        output.output,
        output.spread,
        percent(smooth.residual)
    );
    if let Some(noise) = output.noise {
        let _ = write!(page, ", standard errors are {}", percent(noise));
    }
    page.push('\n');
    page += &inputs(output);
    page += &forms(output);
    for (template, command) in output.templates.iter().zip(commands) {
        page += &proposal(template);
        let _ = writeln!(page, "    {command}");
    }
    page
}

fn inputs(output: &OutputReport) -> String {
    let names = output.inputs.iter().map(|input| input.input.len());
    let width = names.max().unwrap_or(0).max("of the variance".len()).min(60);
    let mut text = format!("  {:<width$}  {:>8}  {:>8}\n", "of the variance", "alone", "in all");
    for input in &output.inputs {
        let share = |share: Option<f64>| share.map(percent).unwrap_or_default();
        let note = match (input.constant, input.first, input.verdict) {
            (true, ..) => "  constant",
            (_, None, _) => "  not looked at",
            _ if input.needless => "  can be left out",
            (.., Some(Verdict::Holds)) => "  can be left out if the others are there",
            _ => "",
        };
        let [alone, all] = [input.first, input.total].map(share);
        let _ = writeln!(text, "  {:<width$}  {alone:>8}  {all:>8}{note}", input.input);
    }
    let uncertain = output.inputs.iter().map(|input| input.uncertainty).fold(0.0, f64::max);
    if uncertain >= 0.01 {
        let _ = writeln!(text, "  (not explained at all: {})", percent(uncertain));
    }
    text
}

fn forms(output: &OutputReport) -> String {
    let mut text = String::new();
    for (verdict, called) in [(Verdict::Holds, "holds"), (Verdict::Nearly, "nearly holds")] {
        for finding in told(output, verdict) {
            let _ = writeln!(text, "  {called}: {}, {}", finding.text, bounds(finding));
        }
    }
    if text.is_empty() && output.templates.is_empty() {
        text += "  no form holds";
        let nearest = told(output, Verdict::Fails).into_iter().next();
        if let Some(finding) = nearest.filter(|finding| finding.departure.estimate < WORTH_TELLING)
        {
            let off = percent(finding.departure.estimate);
            let _ = write!(text, "; nearest is {}, off by {off} of the spread", finding.text);
        }
        text.push('\n');
    }
    let open = told(output, Verdict::Open);
    if !open.is_empty() {
        let some: Vec<String> = open
            .iter()
            .take(MOST_OPEN)
            .map(|finding| {
                let [low, high] = [finding.departure.low, finding.departure.high].map(percent);
                format!("{} (off by {low} to {high})", finding.text)
            })
            .collect();
        let more = open.len() - some.len();
        let more = if more > 0 { format!("; {more} more") } else { String::new() };
        let _ = writeln!(text, "  cannot be told: {}{more}", some.join("; "));
    }
    text
}

/// Returns the findings of a verdict that others do not imply, the clearest first.
fn told(output: &OutputReport, verdict: Verdict) -> Vec<&Finding> {
    let holds = |form: Form| {
        output.forms.iter().any(|finding| finding.form == form && finding.verdict == verdict)
    };
    let implied = |form: &Form| match *form {
        Form::Symmetric(x, y) => [Pairing::Product, Pairing::Sum, Pairing::SumOfSquares]
            .into_iter()
            .any(|pairing| holds(Form::Through(pairing, x, y))),
        Form::PairSum(x, y) => holds(Form::Sum(x)) || holds(Form::Sum(y)),
        Form::PairProduct(x, y) => holds(Form::Product(x)) || holds(Form::Product(y)),
        _ => false,
    };
    let mut told: Vec<&Finding> = output
        .forms
        .iter()
        .filter(|finding| finding.verdict == verdict && !implied(&finding.form))
        .collect();
    told.sort_by(|a, b| a.departure.estimate.total_cmp(&b.departure.estimate));
    told
}

/// Words for a departure: its estimate, with its interval where that is wide.
fn bounds(finding: &Finding) -> String {
    let departure = &finding.departure;
    if departure.high <= ROUNDING {
        return "exactly".to_owned();
    }
    if departure.high <= 1.2 * departure.low.max(1e-5) {
        return format!("to {} of the spread", percent(departure.estimate));
    }
    match departure.low {
        0.0 => format!("to within {} of the spread", percent(departure.high)),
        low => format!("to {} … {} of the spread", percent(low), percent(departure.high)),
    }
}

fn proposal(template: &Template) -> String {
    let counted =
        |count: usize, one: &str| format!("{count} {one}{}", if count == 1 { "" } else { "s" });
    let inputs = match template.most_arguments == template.inputs {
        true => String::new(),
        false => format!(
            "{} of {} at most in place of one of {}; ",
            counted(template.holes, "function"),
            counted(template.most_arguments, "argument"),
            template.inputs
        ),
    };
    format!(
        "  template: {}\n    leaves {} of the spread; {inputs}{} in place of {}\n",
        template.formula,
        percent(template.departure.residual),
        counted(template.terms, "term"),
        template.all_terms
    )
}

/// Writes a share with two digits.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    match percent {
        0.0 => "0 %".to_owned(),
        p if p < 0.001 => "<0.001 %".to_owned(),
        p if p >= 9.95 => format!("{p:.0} %"),
        p => {
            let digits = (1.0 - p.log10().floor()).max(1.0) as usize;
            let text = format!("{p:.digits$}");
            format!("{} %", text.trim_end_matches('0').trim_end_matches('.'))
        }
    }
}

/// Writes a path so that a shell reads it as one word.
pub(super) fn quoted(path: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "/._-+:".contains(c);
    match !path.is_empty() && path.chars().all(plain) {
        true => path.to_owned(),
        false => format!("'{}'", path.replace('\'', "'\\''")),
    }
}
