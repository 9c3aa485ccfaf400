//! Spheres under an environment of nine spherical harmonics: figure 29 of Pesce and Iwanicki,
//! "Approximate Models for Physically Based Rendering", 2015.

use super::Outcome;
use super::formula::Formula;
use super::picture::{Panels, Pixel, apart, display, displayed, sphere_normals};
use super::shader::Call;
use super::vulkan::Gpu;
use glam::DVec3;
use lgp::microfacet::diffuse;
use lgp::quadrature::Rule;
use lgp::report::spheres::Shape;
use lgp::targets::disney_zh::project;
use std::f64::consts::{PI, TAU};
use std::path::Path;

const SIZE: usize = 220;
const ROUGHNESSES: [f64; 3] = [0.0, 0.5, 1.0];
/// Of what the pictures of differences show.
const DIFFERENCE_TIMES: f32 = 10.0;
/// The radiance of Grace Cathedral, in the order of the bands and of m: Ramamoorthi and Hanrahan, "An
/// Efficient Representation for Irradiance Environment Maps", 2001, table of coefficients. y is up.
const ENVIRONMENT: [[f64; 3]; 9] = [
    [0.79, 0.44, 0.54],
    [0.39, 0.35, 0.60],
    [-0.34, -0.18, -0.27],
    [-0.29, -0.06, 0.01],
    [-0.11, -0.05, -0.12],
    [-0.26, -0.22, -0.47],
    [-0.16, -0.09, -0.15],
    [0.56, 0.21, 0.14],
    [0.21, -0.05, -0.30],
];

pub fn draw(gpu: &Gpu, folder: &Path) -> Outcome<()> {
    let normals = sphere_normals(SIZE);
    let outputs = ["zh0", "zh1", "zh2", "beta"];
    let published = Formula::incumbents("disney_zh", &["n_dot_v", "roughness"], &outputs)?;
    let mut panels = Panels::new([
        "truth",
        "the model, on a GPU",
        "the notes' formulas",
        "Lambert",
        "|model - truth| × 10",
        "|notes - truth| × 10",
    ]);
    println!("RMSE of displayed colours, channels in [0, 1]");
    println!(
        "roughness    model    notes  lambert  exact parameters    largest of the model, in 255ths"
    );
    for roughness in ROUGHNESSES {
        let truth = shade(&normals, |n| exactly(n, roughness));
        let lambert = shade(&normals, |n| through(n, [0.282_094_8, 0.325_735, 0.157_695_8], 0.0));
        let places: Vec<[f32; 2]> =
            normals.iter().map(|n| [n.z as f32, roughness as f32]).collect();
        let lobes = published[0].values(&places);
        let notes = normals.iter().enumerate().map(|(pixel, &n)| {
            let [zh0, zh1, zh2, beta] = [0, 1, 2, 3].map(|output| f64::from(lobes[output][pixel]));
            display(through(n, [zh0, zh1, zh2], beta))
        });
        let notes: Vec<Pixel> = notes.collect();
        let rotated = shade(&normals, |n| {
            let lobe = project(n.z, roughness);
            through(n, lobe.zh, lobe.beta)
        });
        let model = on_gpu(gpu, folder, &normals, roughness)?;
        let [ours, theirs, none, exact] =
            [&model, &notes, &lambert, &rotated].map(|made| displayed(&truth, made, SIZE));
        println!(
            "{roughness:9} {:8.5} {:8.5} {:8.5} {:17.5}    {:.1}",
            ours.rmse,
            theirs.rmse,
            none.rmse,
            exact.rmse,
            255.0 * ours.largest
        );
        let [off, off_notes] = [&model, &notes].map(|made| apart(&truth, made, DIFFERENCE_TIMES));
        panels.push(roughness.to_string(), [truth, model, notes, lambert, off, off_notes]);
    }
    let heading = [
        "Disney diffuse under an SH environment",
        "Grace Cathedral, nine coefficients; roughness from left to right",
    ];
    panels.write(&folder.join("spheres.png"), heading, Shape::Sphere, SIZE)
}

fn shade(normals: &[DVec3], light: impl Fn(DVec3) -> DVec3) -> Vec<Pixel> {
    normals.iter().map(|&n| display(light(n))).collect()
}

/// The light that the lobe reflects, by quadrature that is exact for the lobe's polynomials.
fn exactly(n: DVec3, roughness: f64) -> DVec3 {
    let v = DVec3::Z;
    let (x, y) = n.any_orthonormal_pair();
    let mut sum = DVec3::ZERO;
    const AZIMUTHS: usize = 24;
    for point in Rule::gauss_legendre(8).points() {
        // Gauss and Kronrod share a list: points of weight 0 belong to the other.
        if point.weight <= 0.0 {
            continue;
        }
        let n_dot_l = 0.5 * (1.0 + point.node);
        let sine = (1.0 - n_dot_l * n_dot_l).sqrt();
        for k in 0..AZIMUTHS {
            let phi = TAU * k as f64 / AZIMUTHS as f64;
            let l = n_dot_l * n + sine * (phi.cos() * x + phi.sin() * y);
            let lobe = diffuse::disney(n_dot_l, n.dot(v), l.dot(v), roughness) * n_dot_l;
            let area = PI * point.weight / AZIMUTHS as f64;
            sum += area * lobe * radiance(l);
        }
    }
    sum
}

/// The light that a rotated zonal-harmonic lobe reflects.
fn through(n: DVec3, zh: [f64; 3], beta: f64) -> DVec3 {
    let d = n.lerp(DVec3::Z, beta).normalize();
    let basis = harmonics(d);
    let band = |i: usize| [0, 1, 1, 1, 2, 2, 2, 2, 2][i];
    (0..9).fold(DVec3::ZERO, |sum, i| {
        let l = band(i);
        let rotated = zh[l] * (4.0 * PI / (2 * l + 1) as f64).sqrt() * basis[i];
        sum + rotated * DVec3::from(ENVIRONMENT[i])
    })
}

fn radiance(l: DVec3) -> DVec3 {
    harmonics(l).iter().zip(ENVIRONMENT).map(|(y, c)| *y * DVec3::from(c)).sum()
}

/// Real spherical harmonics without signs of Condon and Shortley, of a direction with y up: the axis of
/// the table is y.
fn harmonics(d: DVec3) -> [f64; 9] {
    let (x, y, z) = (d.z, d.x, d.y);
    [
        0.282_094_8,
        0.488_602_5 * y,
        0.488_602_5 * z,
        0.488_602_5 * x,
        1.092_548_4 * x * y,
        1.092_548_4 * y * z,
        0.315_391_6 * (3.0 * z * z - 1.0),
        1.092_548_4 * x * z,
        0.546_274_2 * (x * x - y * y),
    ]
}

/// The shader's light: its harmonics are of the axes x, y and z as the table's, and have the signs of
/// Condon and Shortley.
fn on_gpu(gpu: &Gpu, folder: &Path, normals: &[DVec3], roughness: f64) -> Outcome<Vec<Pixel>> {
    let file = folder.join("disney_diffuse.hlsl");
    let call = Call {
        file: &file,
        before: "",
        body: "
    float3 sh[9];
    for (uint i = 0; i < 9; ++i) sh[i] = float3(setting(3*i), setting(3*i + 1), setting(3*i + 2));
    float3 n = float3(row(0), row(1), row(2));
    float3 light = DisneyDiffuseSH(n, float3(1, 0, 0), row(3), sh);
    result(0, light.x); result(1, light.y); result(2, light.z);",
        sizes: [4, 3],
    };
    let rows: Vec<f32> =
        normals.iter().flat_map(|n| [n.z, n.x, n.y, roughness].map(|value| value as f32)).collect();
    const SIGNS: [f64; 9] = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0];
    let signed = ENVIRONMENT.iter().zip(SIGNS);
    let settings: Vec<f32> =
        signed.flat_map(|(colour, sign)| colour.map(|value| (sign * value) as f32)).collect();
    let light = call.run(gpu, &rows, &settings)?;
    let colours = light.chunks_exact(3).map(|c| DVec3::new(c[0].into(), c[1].into(), c[2].into()));
    Ok(colours.map(display).collect())
}
