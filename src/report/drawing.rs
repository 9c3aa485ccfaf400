//! Spheres of a run: the truth, a formula, and how they differ.

use super::Error;
use super::plot::Theme;
use super::spheres::{
    DIFFERENCE_TIMES, Environment, Labels, Material, Settings, Shape, SphereTable, Spheres,
    difference, displayed_rmse, picture,
};
use crate::dataset::Dataset;
use crate::program::Program;
use crate::run::Run;

/// The usual roughness of each column of spheres.
pub const ROUGHNESSES: [f32; 6] = [0.05, 0.2, 0.4, 0.6, 0.8, 1.0];
/// The usual width of a sphere's square, in pixels.
pub const SIZE: u16 = 200;

/// The settings of a picture of spheres, without the formula.
pub struct Drawing<'a> {
    /// The run that the formula is of.
    pub run: &'a Run,
    /// The run's columns.
    pub dataset: &'a Dataset,
    /// The surroundings that light the spheres.
    pub environment: Environment,
    /// The settings of each sphere; `roughness` replaces theirs.
    pub settings: Settings,
    /// The roughness of each column of spheres.
    pub roughness: &'a [f32],
    /// The width of a sphere's square, in pixels.
    pub size: usize,
}

impl Drawing<'_> {
    /// Returns the picture as a PNG, with labels if there is a theme, and the root mean square of
    /// displayed differences over all spheres, channels in [0, 1].
    ///
    /// # Errors
    /// [`Error::NoSphere`]; [`Error::Plot`].
    pub fn png(
        &self,
        formula: &Program,
        name: &str,
        theme: Option<Theme>,
    ) -> Result<(Vec<u8>, f64), Error> {
        let Run { inputs, outputs, .. } = self.run;
        let refused = |reason: String| Error::NoSphere { run: self.run.name.clone(), reason };
        let spheres = Spheres::of(inputs, outputs, self.environment).ok_or_else(|| {
            let names = self.run.names();
            let (inputs, outputs) = (names.inputs.join(", "), names.outputs.join(", "));
            refused(format!(
                "no sphere is known for {inputs} → {outputs}; `lgp render --help` says for which"
            ))
        })?;
        let table = SphereTable::of(self.dataset).ok_or_else(|| {
            refused(
                "its samples are no evenly spaced grid, so the truth is not known between".into(),
            )
        })?;
        let mut rows = [const { Vec::new() }; 3];
        for &roughness in self.roughness {
            let settings = Settings { roughness, ..self.settings };
            let truth = spheres.shade(Material::Table(&table), &settings, self.size);
            let made = spheres.shade(Material::Formula(formula), &settings, self.size);
            let apart = difference(&truth, &made);
            rows.iter_mut().zip([truth, made, apart]).for_each(|(row, square)| row.push(square));
        }
        let squares = rows[0]
            .iter()
            .zip(&rows[1])
            .map(|(truth, made)| displayed_rmse(truth, made, self.size).powi(2));
        let rmse = (squares.sum::<f64>() / rows[0].len() as f64).sqrt();
        let labels = theme.map(|theme| self.labels(name, spheres.uses_f0(), theme));
        Ok((picture(&rows, self.size, Shape::Sphere, labels.as_ref())?, rmse))
    }

    fn labels(&self, name: &str, uses_f0: bool, theme: Theme) -> Labels {
        let Settings { f0, omega, exposure, .. } = self.settings;
        let names = self.run.names();
        let mut given = Vec::new();
        if Spheres::has_environments(&names.outputs) {
            given.push(format!("environment {}", self.environment));
        }
        if uses_f0 {
            let own = self.run.inputs.iter().find(|input| input.name == "f0");
            let [least, most] = own.map_or([0.0, 1.0], |input| input.domain).map(|end| end as f32);
            given.push(format!("F0 {}", f0.clamp(least, most)));
        }
        if names.inputs.iter().any(|input| input == "omega") {
            given.push(format!("light's full angle {omega} rad"));
        }
        if exposure != 0.0 {
            given.push(format!("exposure {exposure:+} stops"));
        }
        Labels {
            title: format!("{}: {}", self.run.name, names.outputs.join(", ")),
            subtitle: (given.into_iter())
                .chain(["roughness from left to right".to_owned()])
                .collect::<Vec<_>>()
                .join("; "),
            rows: vec![
                "truth".to_owned(),
                name.to_owned(),
                format!("|difference| of displayed colours × {DIFFERENCE_TIMES}"),
            ],
            columns: self.roughness.iter().map(f32::to_string).collect(),
            theme,
        }
    }
}
