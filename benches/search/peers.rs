//! Error against time of other engines and of other ways to search: pictures of the tables that
//! `benches/peers/search.py` writes.

use super::record::Spread;
use lgp::file::replace_file;
use lgp::report::plot::{Line, LinePlot, Theme, lines_png, lines_svg};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::path::Path;

/// The cost that is drawn.
const COST: f64 = 16.0;

/// A formula of a front; other columns do not matter here.
#[derive(Deserialize)]
struct Row {
    engine: String,
    seed: u64,
    cost: f64,
    rmse: f64,
}

/// By engine: seconds, and the least error at [`COST`] for each seed.
type Times = BTreeMap<String, Vec<(f64, Vec<f64>)>>;

/// A picture for each dataset of which there are several times.
pub fn draw(folder: &Path) -> Result<(), Box<dyn Error>> {
    let mut data: BTreeMap<String, BTreeSet<u64>> = BTreeMap::new();
    for entry in folder.read_dir().into_iter().flatten() {
        let path = entry?.path();
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        if let Some((name, seconds)) = stem.rsplit_once('-')
            && path.extension().is_some_and(|extension| extension == "csv")
        {
            data.entry(name.to_owned()).or_default().insert(seconds.parse()?);
        }
    }
    for (name, seconds) in data.iter().filter(|(_, seconds)| seconds.len() > 1) {
        let mut times = Times::new();
        for &seconds in seconds {
            read(&folder.join(format!("{name}-{seconds}.csv")), seconds as f64, &mut times)?;
        }
        picture(folder, name, &times)?;
    }
    Ok(())
}

fn read(path: &Path, seconds: f64, times: &mut Times) -> Result<(), Box<dyn Error>> {
    let mut least: BTreeMap<(String, u64), f64> = BTreeMap::new();
    for row in csv::Reader::from_path(path)?.deserialize() {
        let Row { engine, seed, cost, rmse } = row?;
        let error = least.entry((engine, seed)).or_insert(f64::INFINITY);
        if cost <= COST {
            *error = error.min(rmse);
        }
    }
    for ((engine, _), error) in least {
        let engine = times.entry(engine).or_default();
        match engine.last_mut().filter(|last| last.0 == seconds) {
            Some((_, errors)) => errors.push(error),
            None => engine.push((seconds, vec![error])),
        }
    }
    Ok(())
}

fn picture(folder: &Path, name: &str, times: &Times) -> Result<(), Box<dyn Error>> {
    let line = |(engine, times): (&String, &Vec<(f64, Vec<f64>)>)| {
        let spread = |of: fn(&Spread) -> f64| -> Vec<(f64, f64)> {
            times.iter().map(|(time, errors)| (*time, of(&Spread::of(errors.clone())))).collect()
        };
        Line {
            name: engine.replace('_', " "),
            points: spread(|spread| spread.median),
            bounds: vec![spread(|spread| spread.best), spread(|spread| spread.worst)],
        }
    };
    let lines: Vec<Line> = times.iter().map(line).collect();
    for (theme, suffix) in [(Theme::Light, ""), (Theme::Dark, "-dark")] {
        let plot = LinePlot {
            title: name,
            subtitle: "median of the seeds, thin: best and worst · one thread",
            x_label: "seconds that each was given",
            y_label: &format!("RMSE on the search grid, at no more than {COST} cycles"),
            lines: &lines,
            theme,
        };
        let svg = folder.join(format!("{name}-time{suffix}.svg"));
        replace_file(&svg, lines_svg(&plot)?.as_bytes())?;
        if theme == Theme::Light {
            replace_file(&folder.join(format!("{name}-time.png")), &lines_png(&plot, 1600)?)?;
        }
    }
    Ok(())
}
