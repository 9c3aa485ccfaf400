//! What a search leaves behind while it goes on and at its end, and how a command reads it.

use super::output::to_stderr;
use super::{Exit, Failure};
use crate::dataset::{Column, replace_file};
use crate::emit::{self, Language, Snippet};
use crate::eval::OutputError;
use crate::fit::Measure;
use crate::num::Interval;
use crate::program::shortest;
use crate::report::examination::at_most;
use crate::report::plot::{self, FrontPlot, PlotError, Theme};
use crate::report::table::{Published, axis_title, cycles_text, error_text, front_table, title};
use crate::report::verdict::{number_text, verdict_lines};
use crate::search::{
    CENSUS, Census, Checkpoint, FRONT, Front, FrontMember, MINIMAX_FRONT, Problem, Run, RunFolder,
    Search, TRACE, TracePoint, load_front, load_run, trace_csv,
};
use crate::stability::half_loss;
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::path::Path;
use std::time::{Duration, Instant};

/// Between checkpoints.
const CHECKPOINT_INTERVAL: Duration = Duration::from_secs(15);

/// Pixels: what a README shows, at twice the density.
const PLOT_WIDTH: u32 = 1600;

/// A run's folder before the run is done.
pub struct PartialRun {
    folder: RunFolder,
    /// Whether the folder still holds another run, which this one is to take the place of.
    replaces: bool,
    trace: Vec<TracePoint>,
    /// The lines of the run that this one goes on with.
    earlier_trace: String,
    census: Census,
    last_checkpoint: Instant,
    /// The last failure to write a checkpoint, as the user was told.
    warned: String,
}

impl PartialRun {
    /// A run in a folder; `replaces` another run that is there.
    pub fn new(folder: RunFolder, replaces: bool) -> PartialRun {
        PartialRun {
            folder,
            replaces,
            trace: Vec::new(),
            earlier_trace: String::new(),
            census: Census::default(),
            last_checkpoint: Instant::now(),
            warned: String::new(),
        }
    }

    /// A run that goes on with the one of the folder.
    pub fn resumed(folder: RunFolder, trace: String, census: Census) -> PartialRun {
        PartialRun { earlier_trace: trace, census, ..PartialRun::new(folder, false) }
    }

    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Notes a generation; checkpoints now and then, with what the run is so far.
    pub fn record(
        &mut self,
        point: TracePoint,
        search: &Search,
        problem: &Problem,
        so_far: impl FnOnce() -> Run,
    ) {
        // Later on little changes: points a twentieth apart are enough.
        let enough = self.trace.last().is_none_or(|last| point.seconds >= last.seconds * 1.05);
        let due = self.last_checkpoint.elapsed() >= CHECKPOINT_INTERVAL;
        if enough || due {
            let run = so_far();
            if enough {
                let names = run.names();
                for member in search.archive().members() {
                    self.census.count(&problem.natural(&member.draft), &names, point.seconds);
                }
                self.trace.push(point);
            }
            if due {
                self.checkpoint_or_warn(&run, search);
            }
        }
    }

    /// Writes what `--resume` goes on with. Where that fails the search goes on all the same: its end may
    /// still be written, and is shown in any case.
    pub fn checkpoint_or_warn(&mut self, run: &Run, search: &Search) {
        if let Err(failure) = self.checkpoint(run, search) {
            let warning = failure.error.to_string();
            if warning != self.warned {
                to_stderr(&format!(
                    "warning: {warning}\nthe search goes on, but could not be resumed from here"
                ));
                self.warned = warning;
            }
        }
        self.last_checkpoint = Instant::now();
    }

    fn checkpoint(&mut self, run: &Run, search: &Search) -> Result<(), Failure> {
        let checkpoint = Checkpoint {
            run: run.clone(),
            search: search.clone(),
            trace: self.trace_text(search.settings().measure),
            census: self.census.clone(),
        };
        let bytes = checkpoint.to_bytes();
        if self.replaces {
            self.folder.begin_anew(&bytes, &snippets_in(self.folder.path()))?;
            self.replaces = false;
            return Ok(());
        }
        Ok(self.folder.checkpoint(&bytes)?)
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
        &mut self,
        run: &Run,
        front: &Front,
        minimax: &Front,
        incumbents: &[Published],
        search: &Search,
    ) -> Result<(), Failure> {
        let checkpointed = self.checkpoint(run, search);
        let mut files = fronts(run, front, minimax, incumbents);
        let trace = self.trace_text(search.settings().measure);
        files.push((TRACE.to_owned(), trace.into_bytes()));
        files.push((CENSUS.to_owned(), self.census.to_json().into_bytes()));
        self.folder.exchange(run, &files, &snippets_in(self.folder.path()))?;
        checkpointed
    }
}

/// Both fronts, and the one searched for as text and snippets: the files and what is in them.
pub fn fronts(
    run: &Run,
    front: &Front,
    minimax: &Front,
    incumbents: &[Published],
) -> Vec<(String, Vec<u8>)> {
    let names = run.names();
    let mut files = vec![
        (FRONT.to_owned(), front.to_json(&names)),
        (MINIMAX_FRONT.to_owned(), minimax.to_json(&names)),
        ("front.txt".to_owned(), front_table(front, incumbents, &names.outputs)),
    ];
    for (i, member) in front.members.iter().enumerate() {
        files.extend(Language::ALL.iter().map(|&language| {
            let file = format!("snippets/{:02}.{}", i + 1, language.extension());
            (file, snippet(run, member, language))
        }));
    }
    files.into_iter().map(|(file, text)| (file, text.into_bytes())).collect()
}

/// What runs have written to a folder's `snippets`, and nothing else.
pub fn snippets_in(folder: &Path) -> Vec<String> {
    let part = |part: Option<&OsStr>| part.and_then(OsStr::to_str).unwrap_or_default().to_owned();
    let is_ours = |path: &Path| {
        let (stem, extension) = (part(path.file_stem()), part(path.extension()));
        stem.len() >= 2
            && stem.bytes().all(|byte| byte.is_ascii_digit())
            && Language::ALL.iter().any(|language| language.extension() == extension)
    };
    let folder = folder.join("snippets");
    if folder.is_symlink() {
        return Vec::new();
    }
    let files = folder.read_dir().into_iter().flatten().flatten();
    let ours = files.map(|file| file.path()).filter(|path| is_ours(path));
    ours.map(|path| format!("snippets/{}", part(path.file_name()))).collect()
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

/// The comment above a member, as lines.
pub(super) fn header(run: &Run, member: &FrontMember) -> Vec<String> {
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
    header.push(emit::formula_line(&member.formula));
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
        let [low, high] = column.domain.map(shortest);
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
    let run = load_run(folder)?;
    let front = load_front(folder, &run, which.minimax)?;
    Ok((run, front))
}
