//! The page of a run: one file of HTML that needs nothing else, no network either.
//!
//! What can be computed is: the page holds the samples and each formula as JavaScript in f32
//! arithmetic ([`crate::emit::javascript()`]), and makes maps, profiles and histograms of them when
//! they are looked at. It depends on what it is given alone: no clock, no random number.

mod compare;
mod lookup;
mod policy;
mod samples;
mod spheres;
mod template;

pub use compare::{ComparedRun, Comparison, Group, comparison};
pub use lookup::{LookupTable, lookup_tables};
pub use samples::SampleTable;
pub use spheres::PageSpheres;

use policy::own;
use template::{escaped, filled};

use crate::dataset::Column;
use crate::printable::{is_hidden, printable, printable_lines};
use crate::run::Trace;
use serde::Serialize;

/// What a page shows.
#[derive(Clone, Debug, Serialize)]
pub struct Page {
    pub title: String,
    /// Lines about the run: what, and its value.
    #[serde(skip)]
    pub facts: Vec<(String, String)>,
    /// The command line that makes the run again.
    #[serde(skip)]
    pub command: String,
    pub inputs: Vec<Column>,
    pub outputs: Vec<Column>,
    pub profiles: Vec<CostAxis>,
    /// The place of the run's own profile in `profiles`.
    pub profile: usize,
    pub fronts: Vec<PageFront>,
    /// Published formulas.
    pub published: Vec<Formula>,
    pub lookup_tables: Vec<LookupTable>,
    /// The search split; none if the dataset is no longer there.
    pub samples: Option<SampleTable>,
    pub trace: Option<Trace>,
    pub spheres: Option<PageSpheres>,
    pub languages: Vec<&'static str>,
}

/// What a formula may cost, on an axis of the plot: cycles on a GPU, or nanoseconds measured.
#[derive(Clone, Debug, Serialize)]
pub struct CostAxis {
    pub name: String,
    pub description: String,
    pub unit: &'static str,
}

/// A front, and the measure that it is of.
#[derive(Clone, Debug, Serialize)]
pub struct PageFront {
    /// As `--loss` takes it.
    pub measure: String,
    pub title: String,
    /// By what formulas are on it or off it.
    pub cut: String,
    /// What `lgp emit` and `lgp front` are told to take it.
    pub option: &'static str,
    pub members: Vec<Formula>,
    /// The place of the member to begin with.
    pub knee: usize,
}

/// A formula of a front, or a published one.
#[derive(Clone, Debug, Serialize)]
pub struct Formula {
    /// Of a published formula.
    pub name: Option<String>,
    /// By profile; null where it was not measured.
    pub costs: Vec<Option<f64>>,
    pub registers: Vec<Option<u32>>,
    /// RMSE, maximum, and what the search made small, by output, on the search split.
    pub errors: Vec<[f64; 3]>,
    /// Over all outputs.
    pub error: [f64; 3],
    pub validation: [f64; 3],
    /// As `front.json` has it; null of published formulas.
    pub verdict: serde_json::Value,
    pub formula: String,
    /// Lines of the comment above each function.
    pub header: Vec<String>,
    /// By language.
    pub code: Vec<Code>,
    pub mathml: String,
    /// A function in JavaScript.
    #[serde(skip)]
    pub script: String,
}

/// A function in some language, and what begins a comment of each line of the header above it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Code {
    pub comment: &'static str,
    pub body: String,
}

const TEMPLATE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// In order: each uses what is above it.
const SCRIPTS: [&str; 10] = [
    include_str!("script/elements.js"),
    include_str!("script/base.js"),
    include_str!("script/chart.js"),
    include_str!("script/samples.js"),
    include_str!("script/front.js"),
    include_str!("script/formula.js"),
    include_str!("script/maps.js"),
    include_str!("script/curves.js"),
    include_str!("script/spheres.js"),
    include_str!("script/main.js"),
];

/// The page as HTML.
pub fn html(page: &Page) -> String {
    let data = serde_json::to_string(page).expect("plain data");
    let [policy, style, script] = own(&format!("{}\n{}", functions(page), SCRIPTS.concat()));
    let values = [
        ("title", escaped(&printable(&page.title))),
        ("command", escaped(&printable(&page.command))),
        ("facts", page.facts.iter().map(fact).collect()),
        ("data", within_script(&data)),
        policy,
        style,
        script,
    ];
    filled(TEMPLATE, &values)
}

fn fact((name, value): &(String, String)) -> String {
    let value = printable_lines(value);
    format!("<dt>{}</dt><dd>{}</dd>", escaped(name), escaped(&value))
}

/// JSON in which nothing ends a `<script>`, and hidden characters are seen.
fn within_script(json: &str) -> String {
    let mut text = String::with_capacity(json.len());
    for character in json.chars() {
        match character {
            '<' => text += "\\u003c",
            hidden if is_hidden(hidden) => text += &format!("\\\\u{{{:x}}}", u32::from(hidden)),
            other => text.push(other),
        }
    }
    text
}

/// An array of functions for each front, and one for the published formulas.
fn functions(page: &Page) -> String {
    let listed = |formulas: &[Formula]| {
        let scripts: Vec<&str> = formulas.iter().map(|formula| formula.script.as_str()).collect();
        format!("[{}]", scripts.join(","))
    };
    let fronts: Vec<String> = page.fronts.iter().map(|front| listed(&front.members)).collect();
    format!(
        "const f32 = Math.fround;\nconst FUNCTIONS = {{fronts: [{}], published: {}}};",
        fronts.join(",\n"),
        listed(&page.published)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_data_ends_its_script() {
        assert_eq!(within_script("[\"</script>\"]"), "[\"\\u003c/script>\"]");
    }
}
