//! What is fitted to lobes on planes, and a striped wall reflected through a cube map's probe: figures
//! 42 and 44 of Pesce and Iwanicki, "Approximate Models for Physically Based Rendering", 2015.

use super::Outcome;
use super::picture::{Panels, Pixel, apart, display, rmse};
use super::shader::Call;
use super::vulkan::Gpu;
use glam::DVec3;
use lgp::microfacet::sampling;
use lgp::num::low_discrepancy::hammersley;
use lgp::report::maps::{self, Maps, OutputMaps, Plane};
use lgp::report::plot::Theme;
use lgp::report::spheres::Shape;
use lgp::targets::{Recipe, generate};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_3, PI};
use std::path::Path;

const SIZE: usize = 160;
const ROUGHNESSES: [f64; 3] = [0.2, 0.4, 0.6];
/// Directions of a lobe: enough that no noise shows.
const DIRECTIONS: u64 = 2048;
/// Of the stripes, in units of the probe's distance.
const PERIOD: f64 = 1.5;

pub fn draw(gpu: &Gpu, folder: &Path) -> Outcome<()> {
    surfaces(gpu, folder, "distance", "lobe_plane_fitted_roughness(row(0), row(1))")?;
    surfaces(gpu, folder, "angle", "tilt_fitted_roughness(row(0), max(cos(row(1)), 0.5))")?;
    walls(gpu, folder)
}

/// Figures 42 and 44: what is fitted, and the page's formula of the roughness.
fn surfaces(gpu: &Gpu, folder: &Path, over: &str, formula: &str) -> Outcome<()> {
    let recipe =
        format!("(target: \"lobe_plane\", over: \"{over}\", outputs: \"all\", points: 64)");
    let data = generate(&Recipe::parse(&recipe)?, &|_, _| ())?;
    let split = &data.validation;
    let plane = Plane::of(split).ok_or("the validation split is a grid")?;
    let rows: Vec<f32> =
        plane.rows.iter().flat_map(|&row| [split.columns[0][row], split.columns[1][row]]).collect();
    let file = folder.join("parallax.hlsl");
    let body = format!("result(0, {formula});");
    let call = Call { file: &file, before: "", body: &body, sizes: [2, 1] };
    let made = call.run(gpu, &rows, &[])?;
    let truth = plane.column(&split.columns[2]);
    let squares: f64 = made.iter().zip(&truth).map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>();
    println!("fitted roughness over {over}: RMSE {:.4}", (squares / truth.len() as f64).sqrt());
    let outputs = data.outputs.iter().enumerate().map(|(index, output)| {
        let truth = plane.column(&split.columns[2 + index]);
        let columns = if index == 0 { vec![made.clone(), truth] } else { vec![truth] };
        OutputMaps { name: output.name.clone(), columns }
    });
    let picture = Maps {
        title: format!("A lobe on a plane, over {over}"),
        subtitle: maps::axes(&data),
        columns: vec![["formula".into(), "on a GPU".into()], ["truth".into(), "fitted".into()]],
        outputs: outputs.collect(),
        plane,
    };
    let name = format!("{over}.png");
    std::fs::write(folder.join(name), maps::picture(&picture, Theme::Light)?)?;
    Ok(())
}

/// How the surface stands to the wall.
#[derive(Clone, Copy)]
struct View {
    /// From the wall, where the probe's is 1.
    distance: f64,
    /// From the wall's normal, of the ray that is reflected.
    angle: f64,
}

/// Stripes on a wall, reflected: further from the wall than the probe towards the top, or tilted more.
fn walls(gpu: &Gpu, folder: &Path) -> Outcome<()> {
    let mut panels = Panels::new([
        "truth",
        "corrected, on a GPU",
        "not corrected",
        "|corrected - truth| × 3",
        "|not corrected - truth| × 3",
    ]);
    println!("RMSE of displayed values, channels in [0, 1]: corrected, not corrected");
    for over in ["distance", "angle"] {
        for roughness in ROUGHNESSES {
            let view = |row: usize| {
                let height = 1.0 - (row as f64 + 0.5) / SIZE as f64;
                match over {
                    "distance" => View { distance: 0.25 * 16.0_f64.powf(height), angle: 0.0 },
                    _ => View { distance: 1.0, angle: FRAC_PI_3 * height },
                }
            };
            let views: Vec<View> = (0..SIZE).map(view).collect();
            let corrected = corrected(gpu, folder, &views, roughness)?;
            let probe = View { distance: 1.0, angle: 0.0 };
            let truth = image(|row| (views[row], roughness));
            let made = image(|row| (probe, corrected[row]));
            let plain = image(|_| (probe, roughness));
            let [ours, none] = [&made, &plain].map(|image| rmse(&truth, image));
            println!("{over}, roughness {roughness}: {ours:.4}, {none:.4}");
            let off = [&made, &plain].map(|image| apart(&truth, image, 3.0));
            let all = [vec![truth, made, plain], off.into()].concat();
            panels.push(format!("{over}, {roughness}"), all);
        }
    }
    let heading = [
        "A striped wall reflected through a probe",
        "distance .25 to 4 of the probe's, angle 0 to 60°, both upwards; roughness",
    ];
    panels.write(&folder.join("walls.png"), heading, Shape::Square, SIZE)
}

/// The page's roughness for each view.
fn corrected(gpu: &Gpu, folder: &Path, views: &[View], roughness: f64) -> Outcome<Vec<f64>> {
    let file = folder.join("parallax.hlsl");
    let call = Call {
        file: &file,
        before: "",
        body: "result(0, ParallaxRoughness(row(0), row(1), row(2), 1.0, 1.0));",
        sizes: [3, 1],
    };
    let row = |view: &View| [roughness, view.distance, view.angle.cos()].map(|value| value as f32);
    let rows: Vec<f32> = views.iter().flat_map(row).collect();
    Ok(call.run(gpu, &rows, &[])?.into_iter().map(f64::from).collect())
}

/// An image whose rows have a view and a roughness.
fn image(of: impl Fn(usize) -> (View, f64) + Sync) -> Vec<Pixel> {
    let line = |row: usize| {
        let (view, roughness) = of(row);
        let hits = hits(view, roughness);
        let total: f64 = hits.iter().map(|hit| hit.weight).sum();
        let pixel = move |column: usize| {
            let x = 2.0 * PERIOD * (column as f64 + 0.5) / SIZE as f64;
            let light: f64 = hits.iter().map(|hit| hit.weight * stripes(x + hit.x)).sum();
            display(DVec3::splat(light / total))
        };
        (0..SIZE).map(pixel).collect::<Vec<Pixel>>()
    };
    (0..SIZE).into_par_iter().flat_map_iter(line).collect()
}

/// Where a direction of a lobe meets the wall, from where the lobe's axis does, along the stripes' change.
struct Hit {
    x: f64,
    weight: f64,
}

/// Directions of the lobe D(θ/2) cos θ, drawn by GGX normals: D/4 is their density.
fn hits(view: View, roughness: f64) -> Vec<Hit> {
    let (sin, cos) = view.angle.sin_cos();
    let hit = |index: u64| {
        let h = sampling::ggx(hammersley::<2>(index, DIRECTIONS), roughness * roughness);
        let l = 2.0 * h.z * h - DVec3::Z;
        let towards = l.z * cos - l.x * sin;
        let along = l.z * sin + l.x * cos;
        let met = l.z > 0.0 && towards > 0.0;
        met.then(|| Hit { x: view.distance * (along / towards - sin / cos), weight: l.z })
    };
    (0..DIRECTIONS).filter_map(hit).collect()
}

/// Soft stripes, in [0, 1].
fn stripes(x: f64) -> f64 {
    0.5 + 0.5 * (4.0 * (2.0 * PI * x / PERIOD).sin()).clamp(-1.0, 1.0)
}
