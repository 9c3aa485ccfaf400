//! Draws a page's pictures in `results/models` and measures its model: the page's shader, compiled by
//! glslang and run on a Vulkan device, beside the ground truth.
//!
//! ```text
//! cargo run --release --example models -- NAME [DEVICE [FILE…]]
//! ```
//! NAME is a folder of `results/models`. DEVICE is a part of the device's name; `llvmpipe`, Mesa's
//! software Vulkan, unless given. `ltc` takes two files, too: the published matrices and magnitudes.

#[path = "../../tests/vulkan/mod.rs"]
mod vulkan;

mod area_light;
mod disney_diffuse;
mod environment;
mod formula;
mod ggx_lobes;
mod ltc;
mod materials;
mod parallax;
mod picture;
mod polar;
mod shader;

use std::path::{Path, PathBuf};
use vulkan::Gpu;

pub type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Draws a page's pictures into its folder; some read files.
type Draw = fn(&Gpu, &Path, &[String]) -> Outcome<()>;

const MODELS: [(&str, Draw); 6] = [
    ("area_light", |gpu, folder, _| area_light::draw(gpu, folder)),
    ("disney_diffuse", |gpu, folder, _| disney_diffuse::draw(gpu, folder)),
    ("ggx_lobes", |gpu, folder, _| ggx_lobes::draw(gpu, folder)),
    ("ltc", ltc::draw),
    ("materials", |gpu, folder, _| materials::draw(gpu, folder)),
    ("parallax", |gpu, folder, _| parallax::draw(gpu, folder)),
];

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let names = MODELS.map(|(name, _)| name).join(", ");
    let Some(wanted) = arguments.first() else { return Err(format!("name one of {names}").into()) };
    let Some((name, draw)) = MODELS.iter().find(|(name, _)| name == wanted) else {
        return Err(format!("no model is called {wanted}; there are {names}").into());
    };
    let gpu = Gpu::open(arguments.get(1).map_or("llvmpipe", String::as_str))?;
    println!("shaders run on {}", gpu.name);
    draw(&gpu, &folder(name), arguments.get(2..).unwrap_or_default())
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("results/models").join(name)
}
