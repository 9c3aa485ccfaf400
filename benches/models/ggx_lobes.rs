//! GGX reflections as spherical Gaussians: figures 31, 33, 36 and 39 of Pesce and Iwanicki, "Approximate
//! Models for Physically Based Rendering", 2015.

use super::Outcome;
use super::environment::{LEVELS, SIDES, levels, radiance};
use super::picture::{Panels, Pixel, apart, display, displayed, sphere_normals};
use super::polar::{Curve, polar};
use super::shader::Call;
use super::vulkan::Gpu;
use glam::DVec3;
use lgp::lobes::fit::{self, Amplitude};
use lgp::lobes::{Fan, Lobe, Misfit, Response, SphericalGaussian, direction_at};
use lgp::microfacet::{ggx, half_vector, sampling};
use lgp::num::low_discrepancy::hammersley;
use lgp::report::maps::{self, Maps, OutputMaps, Plane};
use lgp::report::plot::Theme;
use lgp::report::spheres::Shape;
use rayon::prelude::*;
use std::path::Path;

const SIZE: usize = 160;
const ROUGHNESSES: [f64; 3] = [0.15, 0.3, 0.5];
/// Of the integrals at a pixel.
const SAMPLES: u64 = 1024;
/// Of the integrals of errors: the notes' 30,000 to 50,000.
const POINTS: usize = 40_000;
const EXPOSURE: f64 = 0.7;

pub fn draw(gpu: &Gpu, folder: &Path) -> Outcome<()> {
    lobes(folder)?;
    landscape(folder)?;
    spheres(gpu, folder)
}

/// Figures 33 and 36: the response in the plane of incidence, and what is fitted to it.
fn lobes(folder: &Path) -> Outcome<()> {
    println!(
        "share of the response's square that is left: one SG, ASG, 4 SGs side by side, 8, 4 free"
    );
    for (name, n_dot_v, roughness) in [("polar_rough", 0.5, 0.5), ("polar_grazing", 0.2, 0.4)] {
        let response = Response::new(n_dot_v, roughness * roughness);
        let misfit = Misfit::new(response, POINTS);
        let one = fit::fan(&misfit, 1, Amplitude::Free, &[]);
        let anisotropic = fit::anisotropic(&misfit, Amplitude::Free);
        let [four, eight] = [4, 8].map(|count| fit::fan(&misfit, count, Amplitude::Free, &[]));
        let free = fit::mixture(&misfit, &four.model.lobes());
        let errors = [
            one.relative_error,
            anisotropic.relative_error,
            four.relative_error,
            eight.relative_error,
            free.relative_error,
        ];
        let errors = errors.map(|error| format!("{error:.4}"));
        println!("n_dot_v {n_dot_v}, roughness {roughness}: {}", errors.join(", "));
        let sum = |lobes: Vec<SphericalGaussian>| {
            move |theta: f64| lobes.iter().map(|lobe| lobe.value(direction_at(theta))).sum::<f64>()
        };
        let response = Response::new(n_dot_v, roughness * roughness);
        let curves = [
            Curve::new("GGX", move |theta| response.value(direction_at(theta))),
            Curve::new("one SG", sum(one.model.lobes())),
            Curve::new("ASG", move |theta| anisotropic.model.value(direction_at(theta))),
            Curve::new("4 SGs side by side", sum(four.model.lobes())),
            Curve::new("8 SGs side by side", sum(eight.model.lobes())),
        ];
        let title = format!("n·v = {n_dot_v}, roughness {roughness}");
        std::fs::write(folder.join(name).with_extension("svg"), polar(&title, &curves))?;
    }
    Ok(())
}

/// Figure 31: the error over two parameters, the others at their optimum.
fn landscape(folder: &Path) -> Outcome<()> {
    const SIDE: usize = 81;
    let misfit = Misfit::new(Response::new(0.5, 0.09), POINTS);
    let best = fit::fan(&misfit, 8, Amplitude::Free, &[]).model;
    let across = |index: usize| 2.0 * index as f64 / (SIDE - 1) as f64 - 1.0;
    let errors: Vec<f32> = (0..SIDE * SIDE)
        .into_par_iter()
        .map(|i| {
            let (theta, lambda) = (0.25 * across(i % SIDE), 2.0 * across(i / SIDE));
            let fan =
                Fan { theta: best.theta + theta, lambda: best.lambda * lambda.exp2(), ..best };
            misfit.fan_moments(&fan).relative_error().log10() as f32
        })
        .collect();
    let picture = Maps {
        title: "Error".into(),
        subtitle: "theta → lambda ↑".into(),
        columns: vec![["log10 of the share".into(), "n·v .5, roughness .3".into()]],
        plane: Plane { points: [SIDE, SIDE], rows: (0..SIDE * SIDE).collect() },
        outputs: vec![OutputMaps { name: "error".into(), columns: vec![errors] }],
    };
    std::fs::write(folder.join("landscape.png"), maps::picture(&picture, Theme::Light)?)?;
    Ok(())
}

/// Figure 39: a room in spheres.
fn spheres(gpu: &Gpu, folder: &Path) -> Outcome<()> {
    let normals = sphere_normals(SIZE);
    let environment = levels();
    let mut panels = Panels::new([
        "common approximation: lobe of v = n, times the albedo",
        "eight lobes by formulas, on a GPU, times the albedo",
        "the same, of free amplitude",
        "truth",
        "|common - truth| × 3",
        "|eight lobes - truth| × 3",
    ]);
    println!(
        "RMSE of displayed colours, channels in [0, 1]: common approximation, eight lobes times the albedo, of free amplitude"
    );
    for roughness in ROUGHNESSES {
        let alpha = roughness * roughness;
        let show = |lights: Vec<DVec3>| -> Vec<Pixel> {
            lights.into_iter().map(|light| display(EXPOSURE * light)).collect()
        };
        let albedos: Vec<f64> = normals.par_iter().map(|&n| albedo(n, alpha)).collect();
        let truth = show(normals.par_iter().map(|&n| reflected(n, alpha)).collect());
        let pairs = || normals.par_iter().zip(&albedos);
        let common = show(pairs().map(|(&n, &albedo)| albedo * prefiltered(n, alpha)).collect());
        let [mean, free] = on_gpu(gpu, folder, &normals, roughness, &environment)?;
        let mean =
            show(mean.into_iter().zip(&albedos).map(|(light, albedo)| *albedo * light).collect());
        let free = show(free);
        let rmse = [&common, &mean, &free].map(|image| displayed(&truth, image, SIZE).rmse);
        println!("roughness {roughness}: {}", rmse.map(|rmse| format!("{rmse:.4}")).join(", "));
        let off = [&common, &mean].map(|image| apart(&truth, image, 3.0));
        panels.push(roughness.to_string(), [vec![common, mean, free, truth], off.into()].concat());
    }
    let heading = ["A room reflected in GGX", "F = 1; roughness from left to right"];
    panels.write(&folder.join("spheres.png"), heading, Shape::Sphere, SIZE)
}

/// Normals that v sees, what they reflect, and the light's weight of each in the integral.
fn seen(n: DVec3, alpha: f64) -> impl Iterator<Item = (DVec3, f64)> {
    let cosine = n.z.clamp(1e-3, 1.0);
    let v = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
    let lambda_v = ggx::lambda(cosine, alpha);
    // From the normal's frame to the picture's, where v is z.
    let across = (DVec3::Z - n.z * n).try_normalize().unwrap_or(n.any_orthonormal_vector());
    let other = n.cross(across);
    (0..SAMPLES).filter_map(move |i| {
        let h = sampling::visible_ggx(hammersley::<2>(i, SAMPLES), v, alpha);
        let l = half_vector::reflect(v, h);
        let weight = (1.0 + lambda_v) / (1.0 + lambda_v + ggx::lambda(l.z.max(1e-9), alpha));
        (l.z > 0.0).then_some((l.x * across + l.y * other + l.z * n, weight))
    })
}

/// The light reflected with F = 1.
fn reflected(n: DVec3, alpha: f64) -> DVec3 {
    let light = seen(n, alpha).map(|(l, weight)| weight * radiance(l));
    light.sum::<DVec3>() / SAMPLES as f64
}

/// What is reflected of light of 1 from everywhere.
fn albedo(n: DVec3, alpha: f64) -> f64 {
    seen(n, alpha).map(|(_, weight)| weight).sum::<f64>() / SAMPLES as f64
}

/// The room convolved by the lobe of v = n around the mirrored direction (Karis, "Real Shading in Unreal
/// Engine 4", 2013).
fn prefiltered(n: DVec3, alpha: f64) -> DVec3 {
    let r = 2.0 * n.z * n - DVec3::Z;
    let (x, y) = r.any_orthonormal_pair();
    let (mut light, mut total) = (DVec3::ZERO, 0.0);
    for i in 0..SAMPLES {
        let h = sampling::ggx(hammersley::<2>(i, SAMPLES), alpha);
        let l = 2.0 * h.z * h - DVec3::Z;
        if l.z > 0.0 {
            light += l.z * radiance(l.x * x + l.y * y + l.z * r);
            total += l.z;
        }
    }
    light / total
}

/// The shader's mean of the environment, and its light of free amplitude.
fn on_gpu(
    gpu: &Gpu,
    folder: &Path,
    normals: &[DVec3],
    roughness: f64,
    environment: &[f32],
) -> Outcome<[Vec<DVec3>; 2]> {
    let [columns, rows] = SIDES;
    let file = folder.join("multilobe.hlsl");
    let before = format!(
        "
#define ENVIRONMENT_DEFINED
float3 Texel(int level, int column, int row) {{
    int last = {rows} - 1;
    uint at = 3*((level*{rows} + clamp(row, 0, last))*{columns} + (column + {columns}) % {columns});
    return float3(setting(at), setting(at + 1), setting(at + 2));
}}
float3 Level(int level, float3 d) {{
    float column = frac(atan2(d.z, d.x)/6.2831853 + 1.0)*{columns} - 0.5;
    float row = acos(clamp(d.y, -1.0, 1.0))/3.14159265*{rows} - 0.5;
    int x = (int)floor(column), y = (int)floor(row);
    float2 t = float2(column - x, row - y);
    return lerp(lerp(Texel(level, x, y), Texel(level, x + 1, y), t.x),
                lerp(Texel(level, x, y + 1), Texel(level, x + 1, y + 1), t.x), t.y);
}}
float3 SampleEnvironment(float3 direction, float lambda) {{
    float level = clamp(0.5*(14.0 - log2(lambda)), 0.0, {LEVELS} - 1.001);
    int below = (int)level;
    return lerp(Level(below, direction), Level(below + 1, direction), level - below);
}}
"
    );
    let call = Call {
        file: &file,
        before: &before,
        body: "
    float3 n = float3(row(0), row(1), row(2));
    float3 light[2] = {ReflectedEnvironment(n, float3(0, 0, 1), row(3)),
                       SpecularBrdfApprox(0.0, n, float3(0, 0, 1), row(3))};
    for (int i = 0; i < 6; ++i) result(i, light[i/3][i%3]);",
        sizes: [4, 6],
    };
    let values: Vec<f32> =
        normals.iter().flat_map(|n| [n.x, n.y, n.z, roughness].map(|v| v as f32)).collect();
    let light = call.run(gpu, &values, environment)?;
    let colour = |from: &[f32]| DVec3::new(from[0].into(), from[1].into(), from[2].into());
    Ok([0, 3].map(|at| light.chunks_exact(6).map(|both| colour(&both[at..at + 3])).collect()))
}
