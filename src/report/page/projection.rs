//! The page of a projection.

use super::{escaped, filled, own};
use crate::printable::printable;
use base64::{Engine, prelude::BASE64_STANDARD};

/// The contents of the page.
pub(in crate::report) struct ProjectionPage {
    pub title: String,
    pub subtitle: String,
    pub notes: Vec<String>,
    pub findings: Vec<String>,
    /// The names of the inputs of the parameters.
    pub inputs: Vec<String>,
    pub parameters: Vec<ParameterRow>,
    /// Name and bytes of each PNG.
    pub pictures: Vec<(&'static str, Vec<u8>)>,
    pub commands: Vec<String>,
}

/// A row of the table of parameters.
pub(in crate::report) struct ParameterRow {
    pub name: String,
    pub range: String,
    /// The groups in which it is on its lower and its upper bound.
    pub at_bounds: [usize; 2],
    /// For each input, and for all together.
    pub costs: Vec<String>,
}

const ABOUT_INPUTS: &str = "For each input: the share of the parameter’s variance along it, and the RMSE with the parameter’s mean over that input in its place.";
const ABOUT_CONSTANTS: &str = "As a constant: the RMSE with one constant in the parameter’s place.";

const TEMPLATE: &str = include_str!("projection.html");

/// Returns the page as HTML, which needs nothing else and has no script.
pub(in crate::report) fn projection_page(page: &ProjectionPage) -> String {
    let text = |text: &str| escaped(&printable(text));
    let [policy, style, _] = own("");
    let items = page.findings.iter().chain(&page.notes);
    let items: String = items.map(|item| format!("<p>{}</p>", text(item))).collect();
    let findings = match items.is_empty() {
        true => {
            "<p>No parameter lies on a bound, and each depends on all that it was asked to.</p>"
                .to_owned()
        }
        false => items,
    };
    let command = |line: &String| format!("<p class=\"command\"><code>{}</code></p>", text(line));
    let picture = |(name, png): &(&str, Vec<u8>)| {
        let data = BASE64_STANDARD.encode(png);
        format!(
            "<section class=\"card full\"><div class=\"scroll\"><img alt=\"{name}\" src=\"data:image/png;base64,{data}\"></div></section>"
        )
    };
    let about = match page.inputs.is_empty() {
        true => ABOUT_CONSTANTS.to_owned(),
        false => format!("{ABOUT_INPUTS} {ABOUT_CONSTANTS}"),
    };
    let values = [
        ("about", about),
        ("title", text(&page.title)),
        ("subtitle", text(&page.subtitle)),
        ("findings", findings),
        ("parameters", table(page)),
        ("pictures", page.pictures.iter().map(picture).collect()),
        ("commands", page.commands.iter().map(command).collect()),
        policy,
        style,
    ];
    filled(TEMPLATE, &values)
}

fn table(page: &ProjectionPage) -> String {
    let cells = |tag: &str, cells: &[String]| {
        let cell = |cell: &String| format!("<{tag}>{}</{tag}>", escaped(&printable(cell)));
        format!("<tr>{}</tr>", cells.iter().map(cell).collect::<String>())
    };
    let heading = |name: &str| name.to_owned();
    let mut head =
        ["parameter", "values", "on lower bound", "on upper bound"].map(heading).to_vec();
    head.extend(page.inputs.iter().cloned().chain(["as a constant".to_owned()]));
    let row = |row: &ParameterRow| {
        let [lower, upper] = row.at_bounds.map(|count| count.to_string());
        let mut line = vec![row.name.clone(), row.range.clone(), lower, upper];
        line.extend(row.costs.iter().cloned());
        cells("td", &line)
    };
    let rows: String = page.parameters.iter().map(row).collect();
    format!("<table><thead>{}</thead><tbody>{rows}</tbody></table>", cells("th", &head))
}
