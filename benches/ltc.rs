//! Shades a scene by linearly transformed cosines of GGX, with parameters from several sources, and
//! says how far the pictures are apart:
//!
//! ```text
//! cargo run --release --example ltc -- [--formula FILE]… [--published MATRIX.csv NORM.csv]
//!     [--truth] [FOLDER]
//! ```
//! The reference is a table of 64×64 of the target `ltc_ggx`, bilinear over roughness and
//! `sqrt(1 - n·v)` as published. `--formula` is the text of a formula of `n_dot_v` and `roughness`
//! for m11, m13, m31, m33, magnitude and fresnel; `--published` another table, with the rows
//! (roughness, root, m11, m31, m13, m33) and (roughness, root, magnitude, fresnel, …); `--truth`
//! samples the lights and GGX. Pictures go to FOLDER, if one is given.
//!
//! The scene: a floor and two spheres of one roughness, f0 = .5, under a rectangle and a sphere of
//! radiance 1, from three heights. A mirror shows them white, and nothing is brighter, so nothing
//! clips. Pixels are compared in 8-bit sRGB.

use glam::{DMat3, DVec2, DVec3};
use lgp::cost::Profile;
use lgp::microfacet::{fresnel, ggx};
use lgp::num::low_discrepancy::hammersley;
use lgp::program::{Names, Program, parse};
use lgp::quadrature::TanhSinh;
use lgp::targets::dfg::{Masking, integrate};
use lgp::targets::ltc_ggx::Fitter;
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::path::Path;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

const ROUGHNESSES: [f64; 12] = [0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];
/// Heights of the eye.
const HEIGHTS: [f64; 3] = [0.25, 1.2, 4.5];
const SIZE: [usize; 2] = [160, 100];
const F0: f64 = 0.5;
/// Nodes along each axis of tables, as published.
const NODES: usize = 64;
/// Directions from each of the lights and from the lobe, squared.
const SAMPLES: usize = 24;
/// Corners of the outline of a sphere. By hand: 48 change no pixel.
const OUTLINE: usize = 24;

/// m11, m13, m31, m33, magnitude, fresnel.
type Entries = [f64; 6];

/// Where entries come from, for n·v and roughness.
type Source<'a> = &'a (dyn Fn(f64, f64) -> Entries + Sync);

/// What an eye sees in a pixel.
#[derive(Clone, Copy)]
struct Surface {
    at: DVec3,
    normal: DVec3,
    view: DVec3,
}

const SPHERES: [(DVec3, f64); 2] =
    [(DVec3::new(-1.3, 0.6, 0.6), 0.6), (DVec3::new(1.0, -0.6, 0.4), 0.4)];
const LAMP: (DVec3, f64) = (DVec3::new(2.0, 1.6, 1.1), 0.4);
const CORNERS: [DVec3; 4] = [
    DVec3::new(-1.6, 3.0, 0.3),
    DVec3::new(0.8, 3.0, 0.3),
    DVec3::new(0.8, 2.6, 1.9),
    DVec3::new(-1.6, 2.6, 1.9),
];

fn hit_sphere(from: DVec3, along: DVec3, (centre, radius): (DVec3, f64)) -> Option<f64> {
    let to = centre - from;
    let nearest = to.dot(along);
    let square = nearest * nearest - to.length_squared() + radius * radius;
    (square > 0.0).then(|| nearest - square.sqrt()).filter(|distance| *distance > 1e-6)
}

fn hit_rectangle(from: DVec3, along: DVec3) -> Option<f64> {
    let [u, v] = [CORNERS[1] - CORNERS[0], CORNERS[3] - CORNERS[0]];
    let normal = u.cross(v);
    let distance = (CORNERS[0] - from).dot(normal) / along.dot(normal);
    let at = from + distance * along - CORNERS[0];
    let inside = |axis: DVec3| (0.0..=1.0).contains(&(at.dot(axis) / axis.length_squared()));
    (distance > 1e-6 && inside(u) && inside(v)).then_some(distance)
}

/// The surface in a pixel; none if the sky or a light is there.
fn seen(height: f64, pixel: usize) -> Option<Surface> {
    let eye = DVec3::new(0.3, -5.0, height);
    let forward = (DVec3::new(0.0, 0.6, 0.5) - eye).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let [width, rows] = SIZE.map(|size| size as f64);
    let x = ((pixel % SIZE[0]) as f64 + 0.5 - 0.5 * width) / width;
    let y = (0.5 * rows - (pixel / SIZE[0]) as f64 - 0.5) / width;
    let along = (forward + 0.85 * (x * right + y * up)).normalize();
    let floor = -eye.z / along.z;
    let mut found = (f64::INFINITY, DVec3::ZERO);
    if floor > 0.0 && floor < 14.0 {
        found = (floor, DVec3::Z);
    }
    for sphere in SPHERES {
        if let Some(distance) = hit_sphere(eye, along, sphere).filter(|d| *d < found.0) {
            found = (distance, (eye + distance * along - sphere.0) / sphere.1);
        }
    }
    let lights = [hit_sphere(eye, along, LAMP), hit_rectangle(eye, along)];
    let hidden = lights.into_iter().flatten().any(|distance| distance < found.0);
    let (distance, normal) = found;
    let surface = Surface { at: eye + distance * along, normal, view: -along };
    (distance.is_finite() && !hidden).then_some(surface)
}

impl Surface {
    fn n_dot_v(&self) -> f64 {
        self.normal.dot(self.view).clamp(1e-3, 1.0)
    }

    /// Directions to the frame of the normal and v.
    fn to_frame(self) -> DMat3 {
        let across = self.view - self.normal * self.normal.dot(self.view);
        let x = across.try_normalize().unwrap_or_else(|| self.normal.any_orthonormal_vector());
        DMat3::from_cols(x, self.normal.cross(x), self.normal).transpose()
    }

    /// The outlines of the lights, seen from here. Lights shine to both sides.
    fn outlines(&self) -> [Vec<DVec3>; 2] {
        let to = LAMP.0 - self.at;
        let axis = to.normalize();
        let x = axis.any_orthonormal_vector();
        let y = axis.cross(x);
        let sine = LAMP.1 / to.length();
        // The polygon of the outline's area.
        let corner = TAU / OUTLINE as f64;
        let tangent = sine / (1.0 - sine * sine).sqrt() * (corner / corner.sin()).sqrt();
        let lamp = (0..OUTLINE).map(|at| {
            let (sine, cosine) = (corner * at as f64).sin_cos();
            axis + tangent * (cosine * x + sine * y)
        });
        [CORNERS.map(|corner| corner - self.at).to_vec(), lamp.collect()]
    }

    /// The light towards the eye, by transformed cosines.
    fn shade(&self, entries: Entries) -> f64 {
        let [m11, m13, m31, m33, magnitude, fresnel] = entries;
        let inverse =
            DMat3::from_cols(DVec3::new(m11, 0.0, m31), DVec3::Y, DVec3::new(m13, 0.0, m33))
                * self.to_frame();
        let form: f64 = self.outlines().iter().map(|outline| cosine_of(outline, &inverse)).sum();
        (F0 * (magnitude - fresnel) + fresnel) * form
    }

    /// The same of GGX, by samples of the lights and of the lobe.
    fn truth(&self, roughness: f64) -> f64 {
        let alpha = roughness * roughness;
        let to_frame = self.to_frame();
        let v = DVec3::new((1.0 - self.n_dot_v().powi(2)).sqrt(), 0.0, self.n_dot_v());
        let lobe = |l: DVec3| {
            let h = (l + v).normalize();
            if l.z <= 0.0 || h.z <= 0.0 {
                return [0.0; 2];
            }
            let d = ggx::distribution(h.z.min(1.0), alpha);
            let f = F0 + (1.0 - F0) * fresnel::schlick_weight(v.dot(h).min(1.0));
            let visible = ggx::visibility_correlated(v.z, l.z.min(1.0), alpha);
            [d * visible * l.z * f, 0.25 * d * h.z / v.dot(h)]
        };
        let lamp = LAMP.0 - self.at;
        let cap = 1.0 - (1.0 - (LAMP.1 / lamp.length()).powi(2)).sqrt();
        let [u, w] = [CORNERS[1] - CORNERS[0], CORNERS[3] - CORNERS[0]];
        let area = u.cross(w);
        // Densities of the two lights towards a direction, 0 where they are not.
        let densities = |direction: DVec3| {
            let in_lamp = direction.dot(lamp.normalize()) > 1.0 - cap;
            let rectangle = hit_rectangle(self.at, direction)
                .map_or(0.0, |distance| distance * distance / direction.dot(area).abs());
            [if in_lamp { 1.0 / (TAU * cap) } else { 0.0 }, rectangle]
        };
        let mut sum = 0.0;
        let mut add = |direction: DVec3| {
            let [value, density] = lobe(to_frame * direction);
            let of = densities(direction);
            let lights = of.iter().filter(|density| **density > 0.0).count() as f64;
            let total = density + of[0] + of[1];
            if value > 0.0 && lights > 0.0 {
                sum += lights * value / total;
            }
        };
        for index in 0..SAMPLES * SAMPLES {
            let [a, b] = hammersley::<2>(index as u64, (SAMPLES * SAMPLES) as u64);
            add((CORNERS[0] + a * u + b * w - self.at).normalize());
            let axis = lamp.normalize();
            let x = axis.any_orthonormal_vector();
            let cosine = 1.0 - a * cap;
            let spread = DVec2::from_angle(TAU * b) * (1.0 - cosine * cosine).sqrt();
            add(cosine * axis + spread.x * x + spread.y * axis.cross(x));
            let slope = DVec2::from_angle(TAU * b) * alpha * (a / (1.0 - a)).sqrt();
            let h = DVec3::new(slope.x, slope.y, 1.0).normalize();
            add(to_frame.transpose() * (2.0 * v.dot(h) * h - v));
        }
        sum / (SAMPLES * SAMPLES) as f64
    }
}

/// The integral of the cosine, over π, over a polygon that a matrix transforms, clipped at the
/// horizon: Lambert's formula as in Heitz et al. 2016, eq. 11.
fn cosine_of(outline: &[DVec3], inverse: &DMat3) -> f64 {
    let corners: Vec<DVec3> = outline.iter().map(|corner| *inverse * *corner).collect();
    let mut above: Vec<DVec3> = Vec::with_capacity(corners.len() + 1);
    for (index, &corner) in corners.iter().enumerate() {
        let next = corners[(index + 1) % corners.len()];
        if corner.z > 0.0 {
            above.push(corner.normalize());
        }
        if (corner.z > 0.0) != (next.z > 0.0) {
            let share = corner.z / (corner.z - next.z);
            above.push((corner + share * (next - corner)).with_z(0.0).normalize());
        }
    }
    let edge = |index: usize| {
        let (from, to) = (above[index], above[(index + 1) % above.len()]);
        let normal = from.cross(to);
        let sine = normal.length();
        if sine > 0.0 { normal.z / sine * sine.atan2(from.dot(to)) } else { 0.0 }
    };
    ((0..above.len()).map(edge).sum::<f64>() / TAU).abs()
}

/// A table over roughness and sqrt(1 - n·v), sampled bilinearly.
struct Table(Vec<Entries>);

impl Table {
    fn fitted() -> Table {
        let (rule, fitter) = (TanhSinh::new(), Fitter::new());
        let node = |index: usize| {
            let [roughness, root] =
                [index / NODES, index % NODES].map(|at| at as f64 / (NODES - 1) as f64);
            let n_dot_v = (1.0 - root * root).max(1e-3);
            let alpha = roughness * roughness;
            let albedo = integrate(&rule, n_dot_v, alpha, Masking::Correlated);
            let magnitude = albedo.scale + albedo.bias;
            let [m11, m13, m31, m33] = fitter.fit(n_dot_v, alpha, magnitude).into();
            [m11, m13, m31, m33, magnitude, albedo.bias]
        };
        Table((0..NODES * NODES).into_par_iter().map(node).collect())
    }

    /// Reads the published tables: their second and third entry are ours in another order.
    fn published(matrix: &str, norm: &str) -> Outcome<Table> {
        let rows = |path: &str| -> Outcome<Vec<Vec<f64>>> {
            let text = std::fs::read_to_string(path)?;
            let row = |line: &str| line.split(',').map(str::parse).collect::<Result<Vec<_>, _>>();
            Ok(text.lines().skip(1).map(row).collect::<Result<_, _>>()?)
        };
        let mut entries = vec![[0.0; 6]; NODES * NODES];
        for (matrix, norm) in rows(matrix)?.iter().zip(&rows(norm)?) {
            let &[roughness, root, m11, m31, m13, m33] = &matrix[..] else {
                return Err("six columns of a matrix".into());
            };
            let [row, column] = [roughness, root].map(|at| (at * (NODES - 1) as f64).round());
            entries[row as usize * NODES + column as usize] =
                [m11, m13, m31, m33, norm[2], norm[3]];
        }
        Ok(Table(entries))
    }

    fn at(&self, n_dot_v: f64, roughness: f64) -> Entries {
        let place = [roughness, (1.0 - n_dot_v).sqrt()].map(|at| at * (NODES - 1) as f64);
        let [row, column] = place.map(|at| (at as usize).min(NODES - 2));
        let [down, right] = [place[0] - row as f64, place[1] - column as f64];
        let node = |rows: usize, columns: usize| self.0[(row + rows) * NODES + column + columns];
        std::array::from_fn(|entry| {
            let along = |rows: usize| {
                let [a, b] = [node(rows, 0)[entry], node(rows, 1)[entry]];
                a + right * (b - a)
            };
            let [a, b] = [along(0), along(1)];
            a + down * (b - a)
        })
    }
}

/// Pictures of every roughness (rows) and height (columns), linear; NaN where no surface is.
fn pictures(shade: &(dyn Fn(&Surface, f64) -> f64 + Sync)) -> Vec<Vec<f64>> {
    let views = ROUGHNESSES.iter().flat_map(|&r| HEIGHTS.map(|height| (r, height)));
    let picture = |(roughness, height): (f64, f64)| {
        let pixels = (0..SIZE[0] * SIZE[1]).into_par_iter();
        let of = |pixel| seen(height, pixel).map_or(f64::NAN, |at| shade(&at, roughness));
        pixels.map(of).collect()
    };
    views.map(picture).collect()
}

/// The 8-bit code of a linear value, unrounded.
fn code(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    let encoded =
        if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    255.0 * encoded
}

/// Prints the largest and the root mean square difference of codes for every roughness and in all.
fn compare(what: &str, pictures: &[Vec<f64>], reference: &[Vec<f64>]) {
    println!("{what}, in codes of 8-bit sRGB:");
    println!("roughness      max      rms");
    let mut all = (0.0_f64, 0.0, 0.0);
    for (row, roughness) in ROUGHNESSES.iter().enumerate() {
        let (mut max, mut square, mut count) = (0.0_f64, 0.0, 0.0);
        let views = row * HEIGHTS.len()..(row + 1) * HEIGHTS.len();
        for (pixels, expected) in pictures[views.clone()].iter().zip(&reference[views]) {
            let known = pixels.iter().zip(expected).filter(|(_, expected)| !expected.is_nan());
            for (found, expected) in known {
                let off = (code(*found) - code(*expected)).abs();
                max = max.max(off);
                square += off * off;
                count += 1.0;
            }
        }
        println!("{roughness:9} {max:8.2} {:8.3}", f64::sqrt(square / count));
        all = (all.0.max(max), all.1 + square, all.2 + count);
    }
    println!("      all {:8.2} {:8.3}\n", all.0, f64::sqrt(all.1 / all.2));
}

fn save(folder: &Path, name: &str, pictures: &[Vec<f64>]) -> Outcome<()> {
    let [width, height] = [SIZE[0] * HEIGHTS.len(), SIZE[1] * ROUGHNESSES.len()];
    let mut bytes = vec![0_u8; width * height];
    for (view, picture) in pictures.iter().enumerate() {
        let [row, column] = [view / HEIGHTS.len(), view % HEIGHTS.len()];
        for (pixel, value) in picture.iter().enumerate() {
            let (x, y) = (column * SIZE[0] + pixel % SIZE[0], row * SIZE[1] + pixel / SIZE[0]);
            bytes[y * width + x] = if value.is_nan() { 0 } else { code(*value).round() as u8 };
        }
    }
    std::fs::create_dir_all(folder)?;
    let file = std::fs::File::create(folder.join(format!("{name}.png")))?;
    let mut encoder = png::Encoder::new(std::io::BufWriter::new(file), width as u32, height as u32);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header()?.write_image_data(&bytes)?;
    Ok(())
}

fn formula(path: &str) -> Outcome<Program> {
    let names =
        Names::new(["n_dot_v", "roughness"], ["m11", "m13", "m31", "m33", "magnitude", "fresnel"]);
    Ok(parse(&std::fs::read_to_string(path)?, &names)?)
}

fn main() -> Outcome<()> {
    let mut arguments = std::env::args().skip(1);
    let (mut sources, mut folder, mut truth) = (Vec::new(), None, false);
    while let Some(argument) = arguments.next() {
        let mut next = || arguments.next().ok_or("a path is missing");
        match &argument[..] {
            "--formula" => {
                let path = next()?;
                let program = formula(&path)?;
                let cycles = Profile::find("gcn")?.cost(&program).cycles;
                let name = format!("{path}, {cycles} cycles");
                let of = move |n_dot_v: f64, roughness: f64| -> Entries {
                    let values = program.evaluate(&[n_dot_v as f32, roughness as f32]);
                    std::array::from_fn(|entry| f64::from(values[entry]))
                };
                sources.push((name, Box::new(of) as Box<dyn Fn(f64, f64) -> Entries + Sync>));
            }
            "--published" => {
                let table = Table::published(&next()?, &next()?)?;
                let of = move |n_dot_v: f64, roughness: f64| table.at(n_dot_v, roughness);
                sources.push(("published".into(), Box::new(of)));
            }
            "--truth" => truth = true,
            _ => folder = Some(argument),
        }
    }
    let start = std::time::Instant::now();
    let table = Table::fitted();
    println!("fitted {NODES}x{NODES} matrices in {:.1} s\n", start.elapsed().as_secs_f64());
    let shaded = |source: Source| pictures(&|at, r| at.shade(source(at.n_dot_v(), r)));
    let reference = shaded(&|n_dot_v, roughness| table.at(n_dot_v, roughness));
    let mut made = vec![("table".to_owned(), reference.clone())];
    for (name, source) in &sources {
        let found = shaded(&**source);
        compare(&format!("{name} against the table"), &found, &reference);
        made.push((format!("source_{}", made.len()), found));
    }
    if truth {
        let found = pictures(&|at, roughness| at.truth(roughness));
        compare("the table against GGX", &reference, &found);
        for ((name, _), (_, pictures)) in sources.iter().zip(&made[1..]) {
            compare(&format!("{name} against GGX"), pictures, &found);
        }
        made.push(("truth".to_owned(), found));
    }
    if let Some(folder) = &folder {
        made.iter().try_for_each(|(name, pictures)| save(Path::new(folder), name, pictures))?;
    }
    Ok(())
}
