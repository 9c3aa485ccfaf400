//! The pictures beside a page: front, maps, spheres, progress.

use super::maps::{self, Maps, OutputMaps, Plane};
use super::plot::{self, FrontPlot, Line, LinePlot, Theme};
use super::spheres::{Environment, Settings};
use super::{Drawing, Error, ROUGHNESSES, Report, SIZE, write_file};
use crate::dataset::Dataset;
use crate::deadline::Deadline;
use crate::eval::{Evaluator, Samples, Tape};
use crate::program::Program;
use crate::run::{self, Run, Trace};
use crate::search::{Front, FrontMember, ScoredIncumbent};
use crate::wording::{axis_title, cycles_text, error_text};
use std::path::Path;

/// The width of pictures, in pixels: what a README shows, at twice the density.
const WIDTH: u32 = 1600;

/// Writes the pictures; returns true if there was time for all.
pub(super) fn write(report: &Report, folder: &Path, deadline: &Deadline) -> Result<bool, Error> {
    let Report { run, front, dataset, published, trace, .. } = report;
    write_plots(folder, run, front, published)?;
    let shown = trace.as_ref().filter(|trace| trace.seconds.len() > 1 && !deadline.is_past());
    if let Some(trace) = shown {
        write_convergence(report, trace, folder)?;
    }
    let (Some(dataset), Some(knee)) = (dataset, front.knee()) else { return Ok(true) };
    if deadline.is_past() {
        return Ok(false);
    }
    if let Some(maps) = maps(report, dataset, knee) {
        for (file, theme) in [("maps.png", Theme::Light), ("maps-dark.png", Theme::Dark)] {
            write_file(folder, file, &maps::picture(&maps, theme)?)?;
        }
    }
    if deadline.is_past() {
        return Ok(false);
    }
    let drawing = Drawing {
        run,
        dataset,
        environment: Environment::default(),
        settings: Settings::default(),
        roughness: &ROUGHNESSES,
        size: SIZE.into(),
    };
    let name = format!("formula, {} cycles on {}", cycles_text(knee.cost), run.gpu);
    // For most columns no material is known.
    if let Ok((png, _)) = drawing.png(&knee.program, &name, Some(Theme::Light)) {
        write_file(folder, "spheres.png", &png)?;
    }
    Ok(true)
}

/// Draws the front in its measure.
pub fn write_plots(
    folder: &Path,
    run: &Run,
    front: &Front,
    incumbents: &[ScoredIncumbent],
) -> Result<(), Error> {
    let measure = front.measure;
    let error = |member: &FrontMember| member.error().of(measure);
    let place = if front.is_integrated() { "over the domain" } else { "on the search split" };
    let point = |member: &FrontMember| (member.cost, error(member));
    let front: Vec<_> = front.members.iter().map(point).collect();
    let incumbents: Vec<_> = incumbents
        .iter()
        .map(|known| (known.name.clone(), known.member.cost, error(&known.member)))
        .collect();
    let names = run.names();
    let plot = FrontPlot {
        title: &format!("{}: {}", run.name, names.outputs.join(", ")),
        subtitle: &format!("{} · {}", run::domains(&run.inputs), run::seeds(run)),
        x_label: &format!("GPU cycles ({})", run.gpu),
        y_label: &format!("{} {place}", axis_title(measure)),
        front: &front,
        incumbents: &incumbents,
        theme: Theme::Light,
    };
    write_file(folder, "front.svg", plot::svg(&plot)?.as_bytes())?;
    write_file(folder, "front.png", &plot::png(&plot, WIDTH)?)?;
    let dark = FrontPlot { theme: Theme::Dark, ..plot };
    write_file(folder, "front-dark.svg", plot::svg(&dark)?.as_bytes())
}

fn write_convergence(report: &Report, trace: &Trace, folder: &Path) -> Result<(), Error> {
    let line = |(cost, errors): (&f64, &Vec<f64>)| Line {
        name: format!("≤ {cost} cycles"),
        points: trace.seconds.iter().copied().zip(errors.iter().copied()).collect(),
        bounds: Vec::new(),
    };
    // As many lines as there are colours to tell them apart.
    let every = trace.costs.len().div_ceil(7).max(1);
    let lines: Vec<Line> = trace.costs.iter().zip(&trace.errors).step_by(every).map(line).collect();
    let run = &report.run;
    let measure = run.goal.measure;
    let plot = LinePlot {
        title: &format!("{}: how the search went on", run.name),
        subtitle: &format!("{} · {}", run::seeds(run), run.machine),
        x_label: "seconds",
        y_label: &format!("{} on the search split, before polishing", axis_title(measure)),
        lines: &lines,
        theme: Theme::Light,
    };
    write_file(folder, "convergence.png", &plot::lines_png(&plot, WIDTH)?)?;
    write_file(folder, "convergence.svg", plot::lines_svg(&plot)?.as_bytes())?;
    let dark = LinePlot { theme: Theme::Dark, ..plot };
    let dark = plot::lines_svg(&dark)?;
    write_file(folder, "convergence-dark.svg", dark.as_bytes())
}

/// Returns maps of the most accurate published formula, the knee, and the truth.
fn maps(report: &Report, dataset: &Dataset, knee: &FrontMember) -> Option<Maps> {
    let plane = Plane::of(&dataset.search)?;
    let inputs = dataset.inputs.len();
    let rmse = |known: &&ScoredIncumbent| known.member.error().rmse;
    let finite = report.published.iter().filter(|known| rmse(known).is_finite());
    let best = finite.min_by(|a, b| rmse(a).total_cmp(&rmse(b)));
    let described = |name: &str, member: &FrontMember| {
        let (cycles, error) = (cycles_text(member.cost), error_text(member.error().rmse));
        [name.to_owned(), format!("{cycles} cycles, RMSE {error}")]
    };
    let shown: Vec<([String; 2], &FrontMember)> = best
        .map(|known| (described(&known.name, &known.member), &known.member))
        .into_iter()
        .chain([(described("found", knee), knee)])
        .collect();
    let samples = Samples::new(&dataset.search, inputs);
    let values = |program: &Program| Evaluator::default().outputs(&Tape::new(program), &samples);
    let made: Vec<Vec<Vec<f32>>> = shown.iter().map(|(_, one)| values(&one.program)).collect();
    let output = |(o, column): (usize, &crate::dataset::Column)| OutputMaps {
        name: column.name.clone(),
        columns: made
            .iter()
            .map(|values| &values[o])
            .chain([&dataset.search.columns[inputs + o]])
            .map(|values| plane.column(values))
            .collect(),
    };
    let axes = maps::axes(dataset);
    let errors = if dataset.outputs.len() > 1 { ", RMSE over all outputs" } else { "" };
    Some(Maps {
        title: format!("{}: formulas and the truth", report.run.name),
        subtitle: format!("{axes}; cycles on {}{errors}", report.run.gpu),
        columns: shown
            .iter()
            .map(|(lines, _)| lines.clone())
            .chain([["truth".to_owned(), String::new()]])
            .collect(),
        outputs: dataset.outputs.iter().enumerate().map(output).collect(),
        plane,
    })
}
