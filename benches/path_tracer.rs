//! Error of the rough diffuse path tracer against the number of paths:
//! `results/hammon/paths.csv` and pictures.
//!
//! `cargo run --release --example path_tracer`

use glam::DVec3;
use lgp::quadrature::Estimate;
use lgp::report::plot::{Line, LinePlot, Theme, lines_png, lines_svg};
use lgp::targets::hammon::{Lobe, Microsurface, Sampler, lobes};
use std::fmt::Write;
use std::time::Instant;

const FOLDER: &str = "results/hammon";
/// Paths from each light; the last run is what the others are measured against.
const PATHS: [usize; 7] = [100, 300, 1_000, 3_000, 10_000, 30_000, 100_000];
const CONVERGED: usize = 3_000_000;
const ALPHAS: [f64; 2] = [0.3, 1.0];
const ANGLES: [f64; 5] = [5.0, 35.0, 50.0, 65.0, 75.0];
const AZIMUTHS: [f64; 5] = [0.0, 45.0, 90.0, 135.0, 180.0];

fn direction(angle: f64, azimuth: f64) -> DVec3 {
    let (angle, azimuth) = (angle.to_radians(), azimuth.to_radians());
    DVec3::new(angle.sin() * azimuth.cos(), angle.sin() * azimuth.sin(), angle.cos())
}

/// The lobes of every width, light and view, with random numbers from `stream` on.
fn trace(paths: usize, stream: usize) -> Vec<Lobe> {
    let views: Vec<DVec3> =
        ANGLES.iter().flat_map(|&a| AZIMUTHS.map(|b| direction(a, b))).collect();
    let lights = ALPHAS.iter().flat_map(|&alpha| ANGLES.map(|angle| (alpha, angle)));
    let of = |(light, (alpha, angle)): (usize, (f64, f64))| {
        let surface = Microsurface { alpha, sampler: Sampler::Exact };
        lobes(surface, direction(angle, 0.0), &views, paths, (stream + light) as u64, &|| {})
    };
    lights.enumerate().flat_map(of).collect()
}

/// Root of the mean square, over all rows, of the difference from `exact` and of the
/// standard error, both relative to it.
fn relative(found: &[Lobe], exact: &[Lobe], of: fn(&Lobe) -> Estimate) -> [f64; 2] {
    let mut squares = [0.0; 2];
    for (found, exact) in found.iter().zip(exact) {
        let (found, exact) = (of(found), of(exact).value);
        squares[0] += ((found.value - exact) / exact).powi(2);
        squares[1] += (found.error / exact).powi(2);
    }
    squares.map(|sum| (sum / found.len() as f64).sqrt())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let outputs: [fn(&Lobe) -> Estimate; 2] = [|lobe| lobe.single, |lobe| lobe.multi];
    let exact = trace(CONVERGED, 0);
    let mut lines: Vec<Line> = ["single", "single, claimed", "multi", "multi, claimed"]
        .map(|name| Line { name: name.into(), ..Line::default() })
        .to_vec();
    let mut csv = String::from("paths,seconds,single,single_claimed,multi,multi_claimed\n");
    for (run, paths) in PATHS.into_iter().enumerate() {
        let start = Instant::now();
        let found = trace(paths, 1000 * (run + 1));
        let seconds = start.elapsed().as_secs_f64();
        let errors = outputs.map(|of| relative(&found, &exact, of));
        let errors = [errors[0][0], errors[0][1], errors[1][0], errors[1][1]];
        for (line, error) in lines.iter_mut().zip(errors) {
            line.points.push((paths as f64, error));
        }
        writeln!(
            csv,
            "{paths},{seconds:.4},{:.5},{:.5},{:.5},{:.5}",
            errors[0], errors[1], errors[2], errors[3]
        )?;
    }
    std::fs::create_dir_all(FOLDER)?;
    std::fs::write(format!("{FOLDER}/paths.csv"), &csv)?;
    let plot = LinePlot {
        title: "Path tracer of rough diffuse surfaces",
        subtitle: "root mean square over 250 lights and views, alpha .3 and 1; claimed: standard errors",
        x_label: "paths from each light",
        y_label: "relative error",
        lines: &lines,
        theme: Theme::Light,
    };
    std::fs::write(format!("{FOLDER}/paths.svg"), lines_svg(&plot)?)?;
    std::fs::write(format!("{FOLDER}/paths.png"), lines_png(&plot, 1200)?)?;
    print!("{csv}");
    Ok(())
}
