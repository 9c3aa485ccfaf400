//! Pixels of pictures.

use super::Outcome;
use glam::DVec3;
use lgp::report::spheres::{self, Labels, Shape};
use std::path::Path;

/// A displayed colour, channels in [0, 1].
pub type Pixel = [f32; 3];

/// The radius of a sphere, where half the width of a picture is 1: that of `lgp render`.
const RADIUS: f64 = 0.94;

/// The normals of a sphere at each pixel's centre, row by row from the top: x to the right, y up, z
/// to the viewer. Outside the sphere, that of the nearest place on its rim.
pub fn sphere_normals(size: usize) -> Vec<DVec3> {
    let at = |i: usize| (2.0 * (i as f64 + 0.5) / size as f64 - 1.0) / RADIUS;
    let pixel = |i: usize| {
        let (x, y) = (at(i % size), -at(i / size));
        let beyond = x.hypot(y).max(1.0);
        let (x, y) = (x / beyond, y / beyond);
        DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt())
    };
    (0..size * size).map(pixel).collect()
}

/// sRGB of linear light.
pub fn display(light: DVec3) -> Pixel {
    light.to_array().map(|linear| {
        let linear = linear.clamp(0.0, 1.0);
        let encoded = match linear <= 0.003_130_8 {
            true => 12.92 * linear,
            false => 1.055 * linear.powf(1.0 / 2.4) - 0.055,
        };
        encoded as f32
    })
}

/// How far apart two pictures are, within their spheres.
pub struct Displayed {
    pub rmse: f64,
    pub largest: f64,
}

pub fn displayed(truth: &[Pixel], made: &[Pixel], size: usize) -> Displayed {
    let within = |i: &usize| {
        let centre = |i: usize| 2.0 * (i as f64 + 0.5) / size as f64 - 1.0;
        centre(i % size).hypot(centre(i / size)) < RADIUS
    };
    let differences = (0..size * size)
        .filter(within)
        .flat_map(|i| [0, 1, 2].map(|c| f64::from((truth[i][c] - made[i][c]).abs())));
    let (mut squares, mut largest, mut count) = (0.0, 0.0f64, 0);
    for difference in differences {
        squares += difference * difference;
        largest = largest.max(difference);
        count += 1;
    }
    Displayed { rmse: (squares / f64::from(count)).sqrt(), largest }
}

/// Magnified absolute differences.
pub fn apart(truth: &[Pixel], made: &[Pixel], times: f32) -> Vec<Pixel> {
    let each = |(a, b): (&Pixel, &Pixel)| [0, 1, 2].map(|c| (times * (a[c] - b[c]).abs()).min(1.0));
    truth.iter().zip(made).map(each).collect()
}

/// The root mean square difference of two pictures of squares.
pub fn rmse(truth: &[Pixel], made: &[Pixel]) -> f64 {
    let squares =
        truth.iter().zip(made).flat_map(|(a, b)| [0, 1, 2].map(|c| (a[c] - b[c]).powi(2)));
    (squares.map(f64::from).sum::<f64>() / (3 * truth.len()) as f64).sqrt()
}

/// Pictures in rows and columns, each with a title.
pub struct Panels {
    titles: Vec<String>,
    rows: Vec<Vec<Vec<Pixel>>>,
    columns: Vec<String>,
}

impl Panels {
    pub fn new<T: Into<String>>(titles: impl IntoIterator<Item = T>) -> Panels {
        let titles: Vec<String> = titles.into_iter().map(Into::into).collect();
        Panels { rows: vec![Vec::new(); titles.len()], titles, columns: Vec::new() }
    }

    /// Adds a column, a picture for each row.
    pub fn push(&mut self, title: String, pictures: impl IntoIterator<Item = Vec<Pixel>>) {
        self.columns.push(title);
        self.rows.iter_mut().zip(pictures).for_each(|(row, picture)| row.push(picture));
    }

    /// Writes a PNG, each picture of `size` pixels each way; `heading` is its two lines.
    pub fn write(self, file: &Path, heading: [&str; 2], shape: Shape, size: usize) -> Outcome<()> {
        let [title, subtitle] = heading.map(String::from);
        let (rows, columns) = (self.titles, self.columns);
        let labels = Labels { title, subtitle, rows, columns, ..Labels::default() };
        std::fs::write(file, spheres::picture(&self.rows, size, shape, Some(&labels))?)?;
        Ok(())
    }
}
