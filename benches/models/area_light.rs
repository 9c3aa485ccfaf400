//! Spheres lit by a spherical light: the integral, the page's shader, and published models.

use super::Outcome;
use super::formula::Formula;
use super::picture::{Panels, Pixel, apart, display, displayed, sphere_normals};
use super::shader::Call;
use super::vulkan::Gpu;
use glam::DVec3;
use lgp::quadrature::TanhSinh;
use lgp::report::spheres::Shape;
use lgp::targets::sphere_light::Place;
use rayon::prelude::*;
use std::path::Path;

const SIZE: usize = 160;
const ROUGHNESSES: [f64; 4] = [0.15, 0.3, 0.5, 0.8];
const COLUMNS: [&str; 5] = ["sin_half_omega", "roughness", "n_dot_v", "n_dot_l", "r_dot_l"];
/// Radius over distance of a light half a radian wide, and where it is.
const RADIUS: f64 = 0.25;
const LIGHT: DVec3 = DVec3::new(0.5, 0.55, 0.67);
/// Of a highlight's brightest place, about.
const EXPOSURE: f64 = 0.8;

pub fn draw(gpu: &Gpu, folder: &Path) -> Outcome<()> {
    let normals = sphere_normals(SIZE);
    let published = Formula::incumbents("sphere_light", &COLUMNS, &["lobe"])?;
    let titles = ["truth", "the model, on a GPU"].map(String::from).into_iter();
    let titles = titles.chain(published.iter().map(|formula| formula.name.clone()));
    let mut titles: Vec<String> = titles.collect();
    let differences = titles[1..].iter().map(|title| format!("|{title} - truth| × 3"));
    titles.extend(differences.collect::<Vec<_>>());
    let mut panels = Panels::new(titles.clone());
    println!(
        "RMSE of displayed colours, channels in [0, 1]: {}",
        titles[1..=published.len() + 1].join(", ")
    );
    for roughness in ROUGHNESSES {
        let columns: Vec<[f32; 5]> = normals.iter().map(|&n| columns_at(n, roughness)).collect();
        let rule = TanhSinh::new();
        let integral = |at: &[f32; 5]| Place::of(at).integrate(&rule).value;
        let truth = shown(&columns, columns.par_iter().map(integral).collect());
        let mut made = vec![shown(&columns, on_gpu(gpu, folder, &columns)?)];
        made.extend(published.iter().map(|formula| {
            let lobes = formula.values(&columns).swap_remove(0);
            shown(&columns, lobes.into_iter().map(f64::from).collect())
        }));
        let rmse: Vec<String> =
            made.iter().map(|made| format!("{:.4}", displayed(&truth, made, SIZE).rmse)).collect();
        println!("{roughness}: {}", rmse.join(", "));
        let off: Vec<Vec<Pixel>> = made.iter().map(|made| apart(&truth, made, 3.0)).collect();
        panels.push(roughness.to_string(), [vec![truth], made, off].concat());
    }
    let subtitle = format!("radius {RADIUS} of the distance; roughness from left to right");
    let heading = ["Spherical light on GGX", &subtitle];
    panels.write(&folder.join("spheres.png"), heading, Shape::Sphere, SIZE)
}

/// The dataset's inputs at a normal, within its domain.
fn columns_at(n: DVec3, roughness: f64) -> [f32; 5] {
    let n_dot_v = n.z.max(0.1);
    let r = 2.0 * n.z * n - DVec3::Z;
    let l = LIGHT.normalize();
    [RADIUS, roughness, n_dot_v, n.dot(l), r.dot(l)].map(|value| value as f32)
}

/// The light that is displayed: of a highlight without its growth at grazing angles, dark where the
/// light is below the horizon.
fn shown(columns: &[[f32; 5]], lobes: Vec<f64>) -> Vec<Pixel> {
    let pixel = |(at, lobe): (&[f32; 5], f64)| {
        let is_lit = at[3] >= 0.05;
        display(DVec3::splat(if is_lit { EXPOSURE * lobe } else { 0.0 }))
    };
    columns.iter().zip(lobes).map(pixel).collect()
}

fn on_gpu(gpu: &Gpu, folder: &Path, columns: &[[f32; 5]]) -> Outcome<Vec<f64>> {
    let file = folder.join("area_light.hlsl");
    let call = Call {
        file: &file,
        before: "",
        body: "result(0, sphere_light_lobe(row(0), row(1), row(2), row(3), row(4)));",
        sizes: [5, 1],
    };
    let rows: Vec<f32> = columns.iter().flatten().copied().collect();
    Ok(call.run(gpu, &rows, &[])?.into_iter().map(f64::from).collect())
}
