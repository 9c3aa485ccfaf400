//! `lgp list`: targets, datasets, grammars, GPU profiles.

use super::inventory::{self, Entry};
use super::{Common, Failure};
use crate::targets::{Choices, Parameter, Target, targets};
use serde::Serialize;
use std::fmt::Write;

/// Show the targets, datasets, scenes, grammars and GPU profiles there are
///
/// Targets are built in, and so are some grammars and GPU profiles. Datasets, incumbents and scenes
/// are looked for in ./datasets, more grammars and GPU profiles in ./grammar.
#[derive(clap::Args)]
pub struct Args {}

#[derive(Serialize)]
struct Inventory {
    targets: Vec<TargetInfo>,
    datasets: Vec<Entry>,
    grammars: Vec<Entry>,
    gpu_profiles: Vec<Entry>,
    incumbents: Vec<Entry>,
    scenes: Vec<Entry>,
}

#[derive(Serialize)]
struct TargetInfo {
    name: &'static str,
    description: &'static str,
    columns: &'static str,
    parameters: Vec<ParameterInfo>,
}

#[derive(Serialize)]
struct ParameterInfo {
    name: &'static str,
    description: &'static str,
    default: &'static str,
    choices: String,
}

pub fn run(_: &Args, common: &Common) -> Result<(), Failure> {
    let inventory = Inventory {
        targets: targets().iter().map(target_info).collect(),
        datasets: inventory::datasets(),
        grammars: inventory::grammars(),
        gpu_profiles: inventory::gpu_profiles(),
        incumbents: inventory::incumbents(),
        scenes: inventory::scenes(),
    };
    common.result(&inventory, &page(&inventory))
}

fn target_info(target: &Target) -> TargetInfo {
    TargetInfo {
        name: target.name,
        description: target.description,
        columns: target.columns,
        parameters: target.parameters.iter().map(parameter_info).collect(),
    }
}

fn parameter_info(parameter: &Parameter) -> ParameterInfo {
    let choices = match parameter.choices {
        Choices::OneOf(choices) => choices.join("|"),
        Choices::Count { least, most } => format!("{least}..={most}"),
    };
    ParameterInfo {
        name: parameter.name,
        description: parameter.description,
        default: parameter.default,
        choices,
    }
}

fn page(inventory: &Inventory) -> String {
    let mut page = String::from("Targets (lgp generate NAME)\n");
    for target in &inventory.targets {
        let _ =
            writeln!(page, "  {}  {}\n      {}", target.name, target.description, target.columns);
        for ParameterInfo { name, description, default, choices } in &target.parameters {
            let _ = writeln!(page, "      --set {name}={choices}  [{default}]  {description}");
        }
    }
    let sections = [
        ("Datasets", "datasets", &inventory.datasets),
        ("Grammars", "grammar", &inventory.grammars),
        ("GPU profiles", "grammar/gpu", &inventory.gpu_profiles),
        ("Incumbents", "datasets/incumbents", &inventory.incumbents),
        ("Scenes", "datasets/scenes", &inventory.scenes),
    ];
    for (title, folder, entries) in sections {
        let _ = writeln!(page, "\n{title}");
        if entries.is_empty() {
            let _ = writeln!(page, "  none in ./{folder}");
        }
        entries.iter().for_each(|entry| page += &line(entry));
    }
    page
}

fn line(entry: &Entry) -> String {
    match entry.usable {
        true => format!("  {}  {}\n", entry.path.display(), entry.description),
        // The reason begins with the path.
        false => format!("  unusable: {}\n", entry.description),
    }
}
