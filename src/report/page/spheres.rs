//! The spheres of a page: the parts of their shader.

use crate::dataset::Dataset;
use crate::report::spheres::{
    DIFFERENCE_TIMES, Environment, RADIUS, Settings, SphereTable, Spheres,
};
use serde::Serialize;

/// All of the shader except the formula.
#[derive(Clone, Debug, Serialize)]
pub struct PageSpheres {
    environments: Vec<Surroundings>,
    /// The index of the environment to begin with.
    environment: usize,
    table: SphereTable,
    settings: Settings,
    uses_f0: bool,
    radius: f32,
    difference_times: f32,
}

#[derive(Clone, Debug, Serialize)]
struct Surroundings {
    name: String,
    given: String,
    light: String,
}

/// The components of a GLSL vector.
const MAX_INPUTS: usize = 4;

impl PageSpheres {
    /// Returns none if no material is known for the columns, or the samples are no even grid.
    pub fn of(dataset: &Dataset) -> Option<PageSpheres> {
        let Dataset { inputs, outputs, .. } = dataset;
        if inputs.len() > MAX_INPUTS {
            return None;
        }
        let surroundings = |&environment: &Environment| {
            let [given, light] = Spheres::of(inputs, outputs, environment)?.glsl();
            Some(Surroundings { name: environment.to_string(), given, light })
        };
        let several = Spheres::has_environments(&dataset.names().outputs);
        let environments = if several { &Environment::ALL[..] } else { &Environment::ALL[..1] };
        let environments: Vec<_> = environments.iter().filter_map(surroundings).collect();
        let uses_f0 = Spheres::of(inputs, outputs, Environment::default())?.uses_f0();
        let usual = Environment::default().to_string();
        Some(PageSpheres {
            environment: environments.iter().position(|known| known.name == usual).unwrap_or(0),
            uses_f0,
            environments,
            table: SphereTable::of(dataset)?,
            settings: Settings::default(),
            radius: RADIUS,
            difference_times: DIFFERENCE_TIMES,
        })
    }
}
