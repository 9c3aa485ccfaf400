//! `lgp render`: spheres shaded with the truth, a formula, and their difference.

use super::run_folder::{self, Which};
use super::{Common, Failure, emit, output};
use crate::file::replace_file;
use crate::report::plot::Theme;
use crate::report::spheres::{Environment, Settings};
use crate::report::{Drawing, ROUGHNESSES, SIZE};
use crate::run::{Folder, Subject};
use crate::wording::cycles_text;
use serde::Serialize;
use std::path::PathBuf;

/// Draw spheres shaded with the truth, with a formula, and their difference, as a PNG
///
/// One row each, roughness rising from left to right, displayed in sRGB. Works for runs with the
/// columns of dfg, area_light, area_norm, fresnel, smith_g1, smith_g2 or disney_zh (zh0).
///
/// For example: lgp render runs/dfg --environment studio
#[derive(clap::Args)]
pub struct Args {
    /// A run: a folder that `lgp search` or `lgp merge` wrote
    run: PathBuf,
    #[command(flatten)]
    which: Which,
    /// The formula to draw: its number in the table, or the knee
    #[arg(long, value_name = "knee|N", default_value = "knee")]
    pick: String,
    /// The surroundings that light the spheres: uniform, sky or studio
    #[arg(long, value_name = "E", default_value_t)]
    environment: Environment,
    /// Perceptual roughness of each column of spheres
    #[arg(long, value_name = "R,…", value_delimiter = ',', value_parser = unit)]
    #[arg(default_values_t = ROUGHNESSES)]
    roughness: Vec<f32>,
    /// Reflectance at normal incidence
    #[arg(long, value_name = "F", default_value_t = Settings::default().f0, value_parser = unit)]
    f0: f32,
    /// Full angle of the cone of a spherical light, in radians
    #[arg(long, value_name = "A", default_value_t = Settings::default().omega, value_parser = unit)]
    omega: f32,
    /// Exposure, in stops
    #[arg(long, value_name = "S", default_value_t = Settings::default().exposure, value_parser = stops)]
    #[arg(allow_hyphen_values = true)]
    exposure: f32,
    /// Pixels across a sphere
    #[arg(long, value_name = "N", default_value_t = SIZE)]
    #[arg(value_parser = clap::value_parser!(u16).range(16..=1024))]
    size: u16,
    /// Draw the spheres alone, side by side, without text
    #[arg(long)]
    bare: bool,
    /// The picture to write [default: spheres.png in the run's folder]
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The dataset, if it is no longer where the run found it
    #[arg(long, value_name = "FILE")]
    dataset: Option<PathBuf>,
}

fn unit(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(value) if (0.0..=1.0).contains(&value) => Ok(value),
        _ => Err("give a number from 0 to 1".into()),
    }
}

fn stops(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(value) if value.abs() <= 20.0 => Ok(value),
        _ => Err("give a number of stops, from -20 to 20".into()),
    }
}

#[derive(Serialize)]
struct Written {
    #[serde(serialize_with = "crate::cli::output::readable")]
    picture: PathBuf,
    /// The root mean square of displayed differences over all spheres, channels in [0, 1].
    displayed_rmse: f64,
}

pub fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    let (mut run, front) = run_folder::load(&args.run, args.which)?;
    let member = emit::numbered(&front, Some(&args.pick))?;
    let Subject { dataset, .. } = match &args.dataset {
        Some(path) => Subject::of_run_at(&run, path)?,
        None => Subject::of_run(&mut run, &args.run).map_err(|problem| {
            let message = format!("{problem}; give its path with --dataset");
            Failure::input(message)
        })?,
    };
    let _owned = match &args.output {
        Some(_) => None,
        None => Some(Folder::claim(&args.run)?),
    };
    let path = args.output.clone().unwrap_or_else(|| args.run.join("spheres.png"));
    output::check_writable(&path)?;
    let settings =
        Settings { f0: args.f0, omega: args.omega, exposure: args.exposure, ..Settings::default() };
    let drawing = Drawing {
        run: &run,
        dataset: &dataset,
        environment: args.environment,
        settings,
        roughness: &args.roughness,
        size: args.size.into(),
    };
    let name = format!("formula, {} cycles on {}", cycles_text(member.cost), run.gpu);
    let theme = (!args.bare).then_some(Theme::Light);
    let (png, displayed_rmse) = drawing.png(&member.program, &name, theme)?;
    replace_file(&path, &png).map_err(|error| Failure::unwritable(&path, error))?;
    let text =
        format!("{}: displayed colours differ by {displayed_rmse:.4} (RMSE)", path.display());
    common.summary(&Written { picture: path, displayed_rmse }, &text)
}
