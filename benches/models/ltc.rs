//! A scene under area lights, shaded by linearly transformed cosines: the page's shader, run on a
//! GPU, beside the fit that its formula stands for, tables of the fit, and GGX itself.

mod scene;
mod table;

use super::Outcome;
use super::formula::Formula;
use super::picture::{Panels, Pixel, apart};
use super::shader::Call;
use super::vulkan::Gpu;
use lgp::dataset::Dataset;
use lgp::report::maps::{self, Maps, OutputMaps, Plane};
use lgp::report::plot::Theme;
use lgp::report::spheres::Shape;
use rayon::prelude::*;
use scene::{CORNERS, F0, HEIGHTS, LAMP, ROUGHNESSES, SIZE, Surface};
use std::path::Path;
use table::Table;

/// Nodes along each axis of tables, as published.
const NODES: usize = 64;
/// Nodes along `sqrt(1 - n·v)` of what stands for the fit itself.
const FINE: usize = 512;
/// Which roughnesses, from which height, are drawn.
const DRAWN: [usize; 4] = [1, 4, 7, 11];
const HEIGHT: usize = 1;
const OUTPUTS: [&str; 6] = ["m11", "m13", "m31", "m33", "magnitude", "fresnel"];

/// Linear pictures of every roughness and height, in this order; none where no surface is.
type Pictures = Vec<Vec<Option<f64>>>;

/// `published`: nothing, or the files of the published matrices and magnitudes.
pub fn draw(gpu: &Gpu, folder: &Path, published: &[String]) -> Outcome<()> {
    surfaces(folder)?;
    let views: Vec<Vec<Option<Surface>>> = HEIGHTS.iter().map(|&h| scene::picture(h)).collect();
    let shaded = |table: &Table| {
        pictures(&views, |at, roughness| at.shade(table.at(at.n_dot_v(), roughness)))
    };
    let fit = shaded(&Table::fitted(ROUGHNESSES.to_vec(), FINE));
    let table = shaded(&Table::square(NODES));
    let formula = on_gpu(gpu, folder, &views)?;
    let truth = pictures(&views, Surface::truth);
    compare("the shader from its formula on a CPU", &formula, &on_cpu(folder, &views)?);
    compare("the shader from the fit", &formula, &fit);
    compare("a table of 64×64 from the fit", &table, &fit);
    compare("the shader from that table", &formula, &table);
    compare("the shader from GGX", &formula, &truth);
    compare("the table from GGX", &table, &truth);
    if let [matrix, norm] = published {
        compare("the published table from GGX", &shaded(&Table::published(matrix, norm)?), &truth);
    }
    paint(folder, [&truth, &table, &formula, &fit])
}

fn pictures(
    views: &[Vec<Option<Surface>>],
    shade: impl Fn(&Surface, f64) -> f64 + Sync,
) -> Pictures {
    let picture = |(roughness, view): (f64, &Vec<Option<Surface>>)| {
        view.par_iter().map(|at| at.map(|at| shade(&at, roughness))).collect()
    };
    each(views).map(picture).collect()
}

fn page_formula(folder: &Path) -> Outcome<Formula> {
    Formula::read(&folder.join("formula.txt"), &["n_dot_v", "roughness"], &OUTPUTS)
}

/// The entries that are fitted, and the formula's.
fn surfaces(folder: &Path) -> Outcome<()> {
    let data = Dataset::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets/ltc_ggx.bin"))?;
    let columns = &data.validation.columns;
    let plane = Plane::of(&data.validation).ok_or("the validation split is a grid")?;
    let rows: Vec<[f32; 2]> =
        plane.rows.iter().map(|&row| [columns[0][row], columns[1][row]]).collect();
    let made = page_formula(folder)?.values(&rows);
    let outputs = OUTPUTS.iter().zip(made).enumerate().map(|(index, (&name, made))| OutputMaps {
        name: name.to_owned(),
        columns: vec![made, plane.column(&columns[2 + index])],
    });
    let picture = Maps {
        title: "Linearly transformed cosines".to_owned(),
        subtitle: maps::axes(&data),
        columns: vec![["formula".into(), "of the page".into()], ["fit".into(), "to GGX".into()]],
        outputs: outputs.collect(),
        plane,
    };
    std::fs::write(folder.join("surfaces.png"), maps::picture(&picture, Theme::Light)?)?;
    Ok(())
}

fn each(views: &[Vec<Option<Surface>>]) -> impl Iterator<Item = (f64, &Vec<Option<Surface>>)> {
    ROUGHNESSES.iter().flat_map(move |&roughness| views.iter().map(move |view| (roughness, view)))
}

/// Shades by the page's formula.
fn on_cpu(folder: &Path, views: &[Vec<Option<Surface>>]) -> Outcome<Pictures> {
    let formula = page_formula(folder)?;
    let picture = |(roughness, view): (f64, &Vec<Option<Surface>>)| {
        let rows: Vec<[f32; 2]> =
            view.iter().flatten().map(|at| [at.n_dot_v() as f32, roughness as f32]).collect();
        let values = formula.values(&rows);
        let entries = |row: usize| std::array::from_fn(|entry| f64::from(values[entry][row]));
        let mut row = 0..;
        view.iter().map(|at| at.map(|at| at.shade(entries(row.next().unwrap_or(0))))).collect()
    };
    Ok(each(views).map(picture).collect())
}

fn on_gpu(gpu: &Gpu, folder: &Path, views: &[Vec<Option<Surface>>]) -> Outcome<Pictures> {
    let corners: Vec<String> =
        CORNERS.iter().map(|c| format!("float3({}, {}, {}) - at", c.x, c.y, c.z)).collect();
    let (lamp, radius) = LAMP;
    let body = format!(
        "float3 at = float3(row(0), row(1), row(2));
    float3 n = float3(row(3), row(4), row(5)), v = float3(row(6), row(7), row(8));
    LtcView view = LtcOf(n, v, row(9), {F0});
    float3 corners[4] = {{{}}};
    float3 lamp = float3({}, {}, {}) - at;
    result(0, LtcQuad(view, corners) + LtcSphere(view, lamp, {radius}));",
        corners.join(", "),
        lamp.x,
        lamp.y,
        lamp.z,
    );
    let file = folder.join("ltc.hlsl");
    let call = Call { file: &file, before: "", body: &body, sizes: [10, 1] };
    let picture = |(roughness, view): (f64, &Vec<Option<Surface>>)| {
        let row = |at: &Surface| {
            let vectors = [at.at, at.normal, at.view].map(|vector| vector.to_array());
            let row = vectors.into_iter().flatten().chain([roughness]);
            row.map(|number| number as f32).collect::<Vec<f32>>()
        };
        let rows: Vec<f32> = view.iter().flatten().flat_map(row).collect();
        let mut made = call.run(gpu, &rows, &[])?.into_iter().map(f64::from);
        Ok(view.iter().map(|at| at.and_then(|_| made.next())).collect())
    };
    each(views).map(picture).collect()
}

/// The 8-bit code of a linear value, unrounded.
fn code(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    let encoded =
        if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    255.0 * encoded
}

/// Prints the largest and the root mean square difference of codes for every roughness and in all.
fn compare(what: &str, pictures: &Pictures, reference: &Pictures) {
    let measure = |pictures: &[Vec<Option<f64>>], reference: &[Vec<Option<f64>>]| {
        let pixels = pictures.iter().flatten().flatten().zip(reference.iter().flatten().flatten());
        let off: Vec<f64> = pixels.map(|(a, b)| (code(*a) - code(*b)).abs()).collect();
        let squares: f64 = off.iter().map(|off| off * off).sum();
        [off.iter().copied().fold(0.0, f64::max), (squares / off.len() as f64).sqrt()]
    };
    println!("{what}, in codes of 8-bit sRGB: roughness, largest, root mean square");
    let chunks = pictures.chunks(HEIGHTS.len()).zip(reference.chunks(HEIGHTS.len()));
    for ((pictures, reference), roughness) in chunks.zip(ROUGHNESSES) {
        let [largest, mean] = measure(pictures, reference);
        println!("{roughness:9} {largest:8.2} {mean:8.3}");
    }
    let [largest, mean] = measure(pictures, reference);
    println!("      all {largest:8.2} {mean:8.3}");
}

fn paint(folder: &Path, [truth, table, formula, fit]: [&Pictures; 4]) -> Outcome<()> {
    let mut panels = Panels::new([
        "GGX, sampled",
        "a table of 64 × 64",
        "formulas, on a GPU",
        "|formulas - what they fit| × 30",
    ]);
    for roughness in DRAWN {
        let displayed = |pictures: &Pictures| -> Vec<Pixel> {
            let picture = &pictures[roughness * HEIGHTS.len() + HEIGHT];
            picture.iter().map(|at| [(code(at.unwrap_or(0.0)) / 255.0) as f32; 3]).collect()
        };
        let [truth, table, formula, fit] = [truth, table, formula, fit].map(displayed);
        let off = apart(&fit, &formula, 30.0);
        panels.push(ROUGHNESSES[roughness].to_string(), [truth, table, formula, off]);
    }
    let heading = ["A rectangle and a sphere of light", "f0 = .5; roughness from left to right"];
    panels.write(&folder.join("scene.png"), heading, Shape::Square, SIZE)
}
