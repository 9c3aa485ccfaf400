//! The page of a run: one HTML file that needs nothing else, not even a network.
//!
//! The page holds the samples and each formula as JavaScript in f32
//! arithmetic ([`crate::emit::javascript()`]), and computes maps, profiles and histograms when they
//! are looked at. It depends only on its arguments: no clock, no random number.

mod compare;
mod lookup;
mod policy;
pub(super) mod projection;
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

/// The contents of a page.
#[derive(Clone, Debug, Serialize)]
pub struct Page {
    /// The heading.
    pub title: String,
    /// Facts about the run: name and value.
    #[serde(skip)]
    pub facts: Vec<(String, String)>,
    /// The command line that makes the run again.
    #[serde(skip)]
    pub command: String,
    /// The input columns.
    pub inputs: Vec<Column>,
    /// The output columns.
    pub outputs: Vec<Column>,
    /// The axes of costs.
    pub profiles: Vec<CostAxis>,
    /// The index of the run's own profile in `profiles`.
    pub profile: usize,
    /// The fronts, the one searched for first.
    pub fronts: Vec<PageFront>,
    /// Published formulas.
    pub published: Vec<Formula>,
    /// Textures to compare with.
    pub lookup_tables: Vec<LookupTable>,
    /// The search split; none if the dataset is no longer there.
    pub samples: Option<SampleTable>,
    /// The progress of the search, if it was recorded.
    pub trace: Option<Trace>,
    /// The spheres, if a material is known for the columns.
    pub spheres: Option<PageSpheres>,
    /// The names of the languages of each formula's code.
    pub languages: Vec<&'static str>,
}

/// An axis of costs: cycles on a GPU, or nanoseconds measured.
#[derive(Clone, Debug, Serialize)]
pub struct CostAxis {
    /// The profile or device.
    pub name: String,
    /// A longer description.
    pub description: String,
    /// The unit of costs.
    pub unit: &'static str,
}

/// A front, and its measure.
#[derive(Clone, Debug, Serialize)]
pub struct PageFront {
    /// The measure, as `--loss` takes it.
    pub measure: String,
    /// The measure's name.
    pub title: String,
    /// Says by which error formulas are on the front.
    pub cut: String,
    /// The option with which `lgp emit` and `lgp front` take this front.
    pub option: &'static str,
    /// The formulas, costs rising.
    pub members: Vec<Formula>,
    /// The index of the member to begin with.
    pub knee: usize,
}

/// A formula of a front, or a published one.
#[derive(Clone, Debug, Serialize)]
pub struct Formula {
    /// The name of a published formula.
    pub name: Option<String>,
    /// The costs by profile; null where not measured.
    pub costs: Vec<Option<f64>>,
    /// Registers by profile; null where not counted.
    pub registers: Vec<Option<u32>>,
    /// RMSE, maximum, and the minimised measure, by output, on the search split.
    pub errors: Vec<[f64; 3]>,
    /// The same over all outputs: over the whole domain, as far as that was integrated.
    pub error: [f64; 3],
    /// The error bars of RMSE and maximum over the whole domain, if they were integrated.
    pub bars: Option<[f64; 2]>,
    /// The same over all outputs, on the search split.
    pub search: [f64; 3],
    /// The same over all outputs, on the validation split.
    pub validation: [f64; 3],
    /// The verdict as `front.json` has it; null for published formulas.
    pub verdict: serde_json::Value,
    /// The formula's text.
    pub formula: String,
    /// The run's template and what fills its holes, if it has one; none for published formulas.
    pub template: Vec<String>,
    /// Lines of the comment above each function.
    pub header: Vec<String>,
    /// The code in each language.
    pub code: Vec<Code>,
    /// The formula as MathML.
    pub mathml: String,
    /// The formula as a JavaScript function.
    #[serde(skip)]
    pub script: String,
}

/// A function in some language, and the text that begins a comment in each line of the header above
/// it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Code {
    /// The beginning of a comment.
    pub comment: &'static str,
    /// The function.
    pub body: String,
}

const TEMPLATE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// The scripts in order: each uses those above it.
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

/// Returns the page as HTML.
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

/// Makes JSON harmless within a `<script>`: nothing ends the element, and hidden characters are
/// seen.
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

/// Returns a JavaScript array of functions for each front, and one for the published formulas.
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
