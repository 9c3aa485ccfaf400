//! A run's folder while it is written, and the snippets in it.

use super::{Exit, Failure};
use crate::dataset::{Column, Dataset, replace_file};
use crate::emit::{self, Language, Snippet};
use crate::eval::OutputError;
use crate::fit::Measure;
use crate::num::Interval;
use crate::report::examination::at_most;
use crate::report::plot::{self, FrontPlot, PlotError, Theme};
use crate::report::table::{Published, axis_title, cycles_text, error_text, front_table, title};
use crate::report::verdict::{number_text, verdict_lines};
use crate::search::{Census, Front, FrontMember, Problem, Run, Search, TracePoint, trace_csv};
use crate::stability::half_loss;
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The front in the measure that was searched for, and in maximum error.
const FRONT: &str = "front.json";
const MINIMAX_FRONT: &str = "front-max.json";

/// Between checkpoints.
const CHECKPOINT_INTERVAL: Duration = Duration::from_secs(15);

/// Pixels: what a README shows, at twice the density.
const PLOT_WIDTH: u32 = 1600;

/// Makes a run's folder, and makes sure that it can be written, before anything is searched.
pub fn create(folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder)
        .and_then(|()| tempfile::tempfile_in(folder).map(drop))
        .map_err(|error| Failure::unwritable(folder, error.kind()))
}

/// A run's folder before the run is done.
pub struct PartialRun {
    folder: PathBuf,
    trace: Vec<TracePoint>,
    /// The lines of the run that this one goes on with.
    earlier_trace: String,
    census: Census,
    last_checkpoint: Instant,
}

impl PartialRun {
    pub fn new(folder: &Path, resumed: bool) -> Result<PartialRun, Failure> {
        let earlier = resumed.then(|| std::fs::read_to_string(folder.join("trace.csv")).ok());
        let census = if resumed { Census::load(folder)? } else { None };
        Ok(PartialRun {
            folder: folder.to_owned(),
            trace: Vec::new(),
            earlier_trace: earlier.flatten().unwrap_or_default(),
            census: census.unwrap_or_default(),
            last_checkpoint: Instant::now(),
        })
    }

    /// Notes a generation; checkpoints now and then, with what the run is so far.
    pub fn record(
        &mut self,
        point: TracePoint,
        search: &Search,
        problem: &Problem,
        so_far: impl FnOnce() -> Run,
    ) -> Result<(), Failure> {
        // Later on little changes: points a twentieth apart are enough.
        let enough = self.trace.last().is_none_or(|last| point.seconds >= last.seconds * 1.05);
        if enough {
            let names = problem.dataset.names();
            for member in search.archive().members() {
                self.census.count(&problem.natural(&member.draft), &names, point.seconds);
            }
            self.trace.push(point);
        }
        if self.last_checkpoint.elapsed() >= CHECKPOINT_INTERVAL {
            self.checkpoint(&so_far(), search, problem.dataset)?;
            self.last_checkpoint = Instant::now();
        }
        Ok(())
    }

    /// Writes what `--resume` goes on with. Fronts that are there are of an earlier end, or run: without
    /// them the folder is known for that of a search that has not ended.
    fn checkpoint(&self, run: &Run, search: &Search, dataset: &Dataset) -> Result<(), Failure> {
        for file in [FRONT, MINIMAX_FRONT] {
            let _ = std::fs::remove_file(self.folder.join(file));
        }
        write(&self.folder, "trace.csv", self.trace_text(search.settings().measure).as_bytes())?;
        self.census.save(&self.folder)?;
        search.save(&self.folder, dataset)?;
        Ok(run.save(&self.folder)?)
    }

    fn trace_text(&self, measure: Measure) -> String {
        let trace = trace_csv(&self.trace, measure);
        match self.earlier_trace.is_empty() {
            true => trace,
            false => self.earlier_trace.clone() + trace.split_once('\n').map_or("", |(_, t)| t),
        }
    }

    /// Writes what the run leaves behind.
    pub fn finish(
        &self,
        run: &Run,
        front: &Front,
        minimax: &Front,
        incumbents: &[Published],
        search: &Search,
        dataset: &Dataset,
    ) -> Result<(), Failure> {
        self.checkpoint(run, search, dataset)?;
        write_fronts(&self.folder, run, front, minimax, incumbents)
    }
}

/// Writes both fronts, and the one searched for as text and snippets.
pub fn write_fronts(
    folder: &Path,
    run: &Run,
    front: &Front,
    minimax: &Front,
    incumbents: &[Published],
) -> Result<(), Failure> {
    let names = run.names();
    write(folder, FRONT, front.to_json(&names).as_bytes())?;
    write(folder, MINIMAX_FRONT, minimax.to_json(&names).as_bytes())?;
    write(folder, "front.txt", front_table(front, incumbents, &names.outputs).as_bytes())?;
    let snippets = folder.join("snippets");
    create(&snippets)?;
    remove_snippets(&snippets);
    for (i, member) in front.members.iter().enumerate() {
        for &language in Language::ALL {
            let file = format!("snippets/{:02}.{}", i + 1, language.extension());
            write(folder, &file, snippet(run, member, language).as_bytes())?;
        }
    }
    Ok(())
}

/// Removes what an earlier run has written there, and nothing else.
fn remove_snippets(folder: &Path) {
    let is_ours = |path: &PathBuf| {
        let part =
            |part: Option<&OsStr>| part.and_then(OsStr::to_str).unwrap_or_default().to_owned();
        let (stem, extension) = (part(path.file_stem()), part(path.extension()));
        stem.len() >= 2
            && stem.bytes().all(|byte| byte.is_ascii_digit())
            && Language::ALL.iter().any(|language| language.extension() == extension)
    };
    let paths = folder.read_dir().into_iter().flatten().flatten().map(|entry| entry.path());
    paths.filter(is_ours).for_each(|path| drop(std::fs::remove_file(path)));
}

/// The front as a picture, in its measure.
pub fn write_plots(
    folder: &Path,
    run: &Run,
    front: &Front,
    incumbents: &[Published],
) -> Result<(), Failure> {
    let measure = front.measure;
    let error = |member: &FrontMember| member.search_error().of(measure);
    let point = |member: &FrontMember| (member.cost, error(member));
    let front: Vec<_> = front.members.iter().map(point).collect();
    let incumbents: Vec<_> = incumbents
        .iter()
        .map(|known| (known.name.clone(), known.member.cost, error(&known.member)))
        .collect();
    let names = run.names();
    let plot = FrontPlot {
        title: &format!("{}: {}", run.name, names.outputs.join(", ")),
        subtitle: &format!("{} · {}", domains(&run.inputs), seeds(run)),
        x_label: &format!("GPU cycles ({})", run.gpu),
        y_label: &format!("{} on the search split", axis_title(measure)),
        front: &front,
        incumbents: &incumbents,
        theme: Theme::Light,
    };
    let failed = |error: PlotError| Failure::new(Exit::Failed, error);
    write(folder, "front.svg", plot::svg(&plot).map_err(failed)?.as_bytes())?;
    write(folder, "front.png", &plot::png(&plot, PLOT_WIDTH).map_err(failed)?)?;
    let dark = FrontPlot { theme: Theme::Dark, ..plot };
    write(folder, "front-dark.svg", plot::svg(&dark).map_err(failed)?.as_bytes())
}

fn write(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), Failure> {
    let path = folder.join(name);
    replace_file(&path, bytes).map_err(|error| Failure::unwritable(&path, error))
}

/// A member as a function ready to paste.
pub fn snippet(run: &Run, member: &FrontMember, language: Language) -> String {
    let (names, header) = (run.names(), header(run, member));
    emit::emit(
        language,
        &Snippet { program: &member.program, names: &names, function: &run.name, header: &header },
    )
}

/// A member in half precision but for some instructions, in a language that has it.
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
    let snippet =
        Snippet { program: &member.program, names: &names, function: &run.name, header: &header };
    emit::emit_half(language, &snippet, stay_single)
}

fn header(run: &Run, member: &FrontMember) -> Vec<String> {
    let names = run.names();
    let (search, validation) = (member.search_error(), member.validation_error());
    let mut header = vec![
        format!("{} → {}", names.inputs.join(", "), names.outputs.join(", ")),
        format!("data: {} ({}), {}, lgp {}", run.name, run.dataset_hash, seeds(run), run.version),
        format!("domain: {}", domains(&run.inputs)),
        cost_line(member, run),
        format!("error: {} on the search split", described(search, run.settings.measure)),
        format!("       {} on the validation split", described(validation, run.settings.measure)),
    ];
    if let Some(scene) = &run.scene {
        header.insert(2, format!("scene: {}: {}", scene.name, scene.summary()));
    }
    if names.outputs.len() > 1 {
        for (output, error) in names.outputs.iter().zip(&member.score.search) {
            header.push(format!("       {output}: {}", described(*error, run.settings.measure)));
        }
    }
    header.extend(verdict_lines(&member.verdict));
    header.push(member.formula.clone());
    header
}

/// The seed of a search, or those of a union.
pub(super) fn seeds(run: &Run) -> String {
    if run.sources.is_empty() {
        return format!("seed {}", run.settings.seed);
    }
    let seeds: BTreeSet<u64> = run.sources.iter().map(|source| source.settings.seed).collect();
    let seeds: Vec<String> = seeds.iter().map(u64::to_string).collect();
    format!("{} {}", if seeds.len() == 1 { "seed" } else { "seeds" }, seeds.join(", "))
}

fn cost_line(member: &FrontMember, run: &Run) -> String {
    let cycles = cycles_text(member.cost);
    match member.registers {
        Some(1) => format!("cost: {cycles} cycles, 1 register on {}", run.gpu),
        Some(registers) => format!("cost: {cycles} cycles, {registers} registers on {}", run.gpu),
        None => format!("cost: {cycles} cycles on {}", run.gpu),
    }
}

/// RMSE and maximum; and first what was made small, if it is neither.
fn described(error: OutputError, measure: Measure) -> String {
    let usual = format!("RMSE {}, max {}", error_text(error.rmse), error_text(error.max));
    match measure {
        Measure::Rmse | Measure::Max => usual,
        _ => format!("{} {}, {usual}", title(measure), error_text(error.of(measure))),
    }
}

pub(super) fn domains(inputs: &[Column]) -> String {
    let domain = |column: &Column| {
        let [low, high] = column.domain;
        format!("{} in [{low}, {high}]", column.name)
    };
    inputs.iter().map(domain).collect::<Vec<_>>().join(", ")
}

/// Which of a run's fronts.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub struct Which {
    /// The front in maximum error, its constants fitted for that, in place of the one searched for
    #[arg(long)]
    pub minimax: bool,
}

/// The run and a front of a folder that `lgp search` wrote.
pub fn load(folder: &Path, which: Which) -> Result<(Run, Front), Failure> {
    if !folder.is_dir() {
        let message =
            format!("{}: no such folder; give one that `lgp search` wrote", folder.display());
        return Err(Failure::new(Exit::Input, anyhow::Error::msg(message)));
    }
    let run = Run::load(folder)?;
    let (file, measure) = match which.minimax {
        true => (MINIMAX_FRONT, Measure::Max),
        false => (FRONT, run.settings.measure),
    };
    let front = Front::load(&folder.join(file), &run, measure)?;
    Ok((run, front))
}
