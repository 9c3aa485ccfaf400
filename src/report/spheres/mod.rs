//! Spheres shaded with a formula, and with the table that it stands for.
//!
//! The inputs of the formula at a pixel, and the light made of its outputs, are formula text
//! themselves. This one source is evaluated here and emitted as GLSL for the page, so both draw the
//! same spheres. Directions: x to the right, y up, z to the viewer, who is far away, so v = (0, 0,
//! 1).

mod picture;
mod shading;
mod table;

pub use picture::{Labels, Shape, picture};
pub use shading::Environment;
pub use table::SphereTable;

use crate::dataset::{Column, Split};
use crate::emit::{Language, Snippet, emit};
use crate::eval::{Evaluator, Samples, Tape};
use crate::program::{Arg, Names, Program, effective};
use serde::Serialize;

/// Settings that a reader of the page can change.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Settings {
    /// Perceptual roughness; alpha = roughness².
    pub roughness: f32,
    /// Reflectance at normal incidence.
    pub f0: f32,
    /// Full angle of a spherical light's cone, in radians.
    pub omega: f32,
    /// Exposure, in stops.
    pub exposure: f32,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings { roughness: 0.4, f0: 0.5, omega: 0.4, exposure: 0.0 }
    }
}

/// The source of a sphere's material.
#[derive(Clone, Copy, Debug)]
pub enum Material<'a> {
    /// A formula over the dataset's columns.
    Formula(&'a Program),
    /// The dataset itself, interpolated.
    Table(&'a SphereTable),
}

/// The shading of spheres with a dataset's columns.
#[derive(Clone, Debug)]
pub struct Spheres {
    /// From a pixel to the dataset's inputs.
    given: (Program, Names),
    /// From a pixel and the dataset's outputs to what is displayed.
    light: (Program, Names),
}

/// The radius of a sphere, where half the width of a picture is 1.
pub(crate) const RADIUS: f32 = 0.94;

impl Spheres {
    /// Returns none if no material is known for the columns. Inputs are clamped to their domains.
    pub fn of(inputs: &[Column], outputs: &[Column], environment: Environment) -> Option<Spheres> {
        let outputs: Vec<String> = outputs.iter().map(|column| column.name.clone()).collect();
        let given = shading::given(inputs)?;
        let light = shading::light(&outputs, environment)?;
        Some(Spheres { given, light })
    }

    /// Returns true if the picture depends on [`Settings::f0`].
    pub fn uses_f0(&self) -> bool {
        let f0 = Arg::Input(4);
        [&self.given.0, &self.light.0].into_iter().any(|program| {
            let program = effective(program);
            program.instrs.iter().flat_map(|instr| instr.args()).any(|arg| *arg == f0)
        })
    }

    /// Returns true if the picture depends on the environment.
    pub(crate) fn has_environments(outputs: &[String]) -> bool {
        shading::has_environment(outputs)
    }

    /// Returns the displayed colour, in [0, 1], of each pixel of a square, row by row from the top;
    /// outside the sphere, the colour of the nearest place on its rim.
    pub fn shade(&self, material: Material, settings: &Settings, size: usize) -> Vec<[f32; 3]> {
        let pixels = pixels(size);
        let constant = |value: f32| vec![value; size * size];
        let mut columns = pixels.to_vec();
        columns.extend(
            [settings.roughness, settings.f0, settings.omega, settings.exposure].map(constant),
        );
        let inputs = values(&self.given.0, columns.clone());
        columns.extend(match material {
            Material::Formula(program) => values(program, inputs),
            Material::Table(table) => table.read(&inputs),
        });
        let displayed = values(&self.light.0, columns);
        (0..size * size).map(|i| [0, 1, 2].map(|channel| displayed[channel][i])).collect()
    }

    /// Returns the GLSL before and after a formula: two functions, `sphere_given` and
    /// `sphere_light`.
    pub fn glsl(&self) -> [String; 2] {
        let function = |(program, names): &(Program, Names), function: &str| {
            emit(Language::Glsl, &Snippet::new(program, names, function))
        };
        [function(&self.given, "sphere_given"), function(&self.light, "sphere_light")]
    }
}

/// Returns x, y and z of the normal at each pixel's centre.
fn pixels(size: usize) -> [Vec<f32>; 3] {
    let mut normal = [const { Vec::new() }; 3];
    for row in 0..size {
        for column in 0..size {
            let at = |i: usize| (2.0 * (i as f32 + 0.5) / size as f32 - 1.0) / RADIUS;
            let (x, y) = (at(column), -at(row));
            let beyond = (x * x + y * y).sqrt().max(1.0);
            let (x, y) = (x / beyond, y / beyond);
            let z = (1.0 - x * x - y * y).max(0.0).sqrt();
            normal.iter_mut().zip([x, y, z]).for_each(|(to, value)| to.push(value));
        }
    }
    normal
}

fn values(program: &Program, columns: Vec<Vec<f32>>) -> Vec<Vec<f32>> {
    let inputs = columns.len();
    let split = Split { columns, ..Split::default() };
    Evaluator::default().outputs(&Tape::new(program), &Samples::new(&split, inputs))
}

/// Returns the root mean square difference of two pictures' colours, within the spheres.
pub fn displayed_rmse(a: &[[f32; 3]], b: &[[f32; 3]], size: usize) -> f64 {
    let within = |i: &usize| {
        let centre = |i: usize| i as f32 + 0.5 - size as f32 / 2.0;
        centre(i % size).hypot(centre(i / size)) < RADIUS * size as f32 / 2.0
    };
    let square = |i: usize| (0..3).map(move |c| f64::from(a[i][c] - b[i][c]).powi(2)).sum::<f64>();
    let squares: Vec<f64> = (0..size * size).filter(within).map(square).collect();
    (squares.iter().sum::<f64>() / (3 * squares.len()) as f64).sqrt()
}

/// The magnification of differences of displayed colours. By hand, unmeasured.
pub(crate) const DIFFERENCE_TIMES: f32 = 3.0;

/// Returns the magnified absolute difference of two pictures.
pub fn difference(a: &[[f32; 3]], b: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let each = |(a, b): (&[f32; 3], &[f32; 3])| {
        [0, 1, 2].map(|c| (DIFFERENCE_TIMES * (a[c] - b[c]).abs()).min(1.0))
    };
    a.iter().zip(b).map(each).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::parse;

    fn columns(names: &[&str]) -> Vec<Column> {
        let column = |name: &&str| Column::new(name, [0.0, 1.0]);
        names.iter().map(column).collect()
    }

    fn dfg(environment: Environment) -> Spheres {
        let (inputs, outputs) = (columns(&["n_dot_v", "roughness"]), columns(&["scale", "bias"]));
        Spheres::of(&inputs, &outputs, environment).unwrap()
    }

    fn program(text: &str) -> Program {
        parse(text, &Names::new(["n_dot_v", "roughness"], ["scale", "bias"])).unwrap()
    }

    #[test]
    fn a_perfect_mirror_in_a_uniform_environment_is_white_and_half_of_it_is_not() {
        let spheres = dfg(Environment::Uniform);
        let white = program("scale = 0; bias = 1");
        let shaded = spheres.shade(Material::Formula(&white), &Settings::default(), 8);
        assert!(shaded.iter().flatten().all(|value| (value - 1.0).abs() < 1e-5), "{shaded:?}");
        let half = program("scale = n_dot_v/n_dot_v; bias = 0");
        let shaded = spheres.shade(Material::Formula(&half), &Settings::default(), 8);
        // sRGB of a half (IEC 61966-2-1): 0.7354.
        assert!(shaded.iter().flatten().all(|value| (value - 0.7354).abs() < 1e-3), "{shaded:?}");
    }

    #[test]
    fn every_environment_is_displayable_at_every_roughness() {
        let program = program("scale = 1; bias = 0.01*n_dot_v*roughness");
        for environment in Environment::ALL {
            let spheres = dfg(environment);
            for roughness in [0.0, 0.05, 0.5, 1.0] {
                let settings = Settings { roughness, f0: 1.0, ..Settings::default() };
                let shaded = spheres.shade(Material::Formula(&program), &settings, 24);
                assert!(shaded.iter().flatten().all(|v| (0.0..=1.0).contains(v)), "{environment}");
                assert!(shaded.iter().any(|pixel| pixel[1] > 0.3), "{environment} at {roughness}");
            }
        }
    }

    #[test]
    fn columns_without_a_material_have_none() {
        let scene = |inputs: &[&str], outputs: &[&str]| {
            Spheres::of(&columns(inputs), &columns(outputs), Environment::Sky).is_some()
        };
        assert!(scene(&["n_dot_v", "roughness"], &["bias"]));
        assert!(scene(&["omega", "roughness", "theta"], &["lobe"]));
        assert!(scene(&["n_dot_v", "roughness"], &["zh0"]));
        assert!(dfg(Environment::Sky).uses_f0());
        assert!(!scene(&["a"], &["g1"]) && !scene(&["n_dot_v"], &["visibility"]));
    }
}
