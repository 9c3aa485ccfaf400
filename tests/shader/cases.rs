//! The functions beside this file, their domains, and how a shader calls them.

use lgp::shader::{Options, Shader};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::path::{Path, PathBuf};

/// A function that is written in a shading language and in C++.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub name: &'static str,
    /// The range of each input.
    pub domain: &'static [[f64; 2]],
    /// An expression of the inputs `a`, `b`, … that gives all outputs, as both languages write it.
    pub call: &'static str,
    /// What sets variables that it shares with other calls back, in both languages.
    pub before: &'static str,
    /// What follows it for each output.
    pub outputs: &'static [&'static str],
    /// Why it is no program, if it is none.
    pub no_program: Option<&'static str>,
    /// How far single precision may be off, relative to values above 1: the functions' own
    /// conditions times the errors that Vulkan allows.
    pub single: f64,
}

const UNIT: [f64; 2] = [0.0, 1.0];
const SIGNED: [f64; 2] = [-1.0, 1.0];
const ONE: &[&str] = &[""];
const TWO: &[&str] = &[".x", ".y"];
const THREE: &[&str] = &[".x", ".y", ".z"];
const FOUR: &[&str] = &[".x", ".y", ".z", ".w"];
const OF_AN_INTEGER: Option<&str> = Some("an integer depends on the inputs");

const fn case(
    name: &'static str,
    domain: &'static [[f64; 2]],
    call: &'static str,
    outputs: &'static [&'static str],
) -> Case {
    Case { name, domain, call, before: "", outputs, no_program: None, single: 1e-5 }
}

pub const CASES: [Case; 22] = [
    case("series", &[[-2.0, 2.0]], "series(a)", ONE),
    Case {
        no_program: OF_AN_INTEGER,
        single: 1e-3,
        ..case("hashed_noise", &[[-8.0, 8.0]; 2], "hashed_noise(vec2(a, b))", ONE)
    },
    // Fractions of products up to 20,000 of fractions of 5.
    Case { single: 0.05, ..case("fract_noise", &[[-2.0, 2.0]; 2], "fract_noise(vec2(a, b))", ONE) },
    // Near total reflection, a root of almost nothing.
    Case {
        single: 1e-3,
        ..case("bounce", &[SIGNED; 6], "bounce(vec3(a, b, c), vec3(d, e, f))", FOUR)
    },
    case("early", &[UNIT; 2], "early(a, b)", ONE),
    case("lobes", &[[0.01, 1.0]; 2], "all_lobes(a, b)", THREE),
    // Sines to 5e-4, as Vulkan allows; determinants of what they are multiplied with.
    Case {
        single: 1e-3,
        ..case(
            "matrices",
            &[SIGNED, SIGNED, SIGNED, [-3.0, 3.0]],
            "matrices(vec3(a, b, c), d)",
            FOUR,
        )
    },
    case("inverses", &[UNIT; 3], "inverses(vec2(a, b), c)", THREE),
    case(
        "material",
        &[UNIT; 4],
        "material(a, vec3(b, c, d))",
        &[".color.x", ".color.y", ".color.z", ".alpha"],
    ),
    case("cases", &[UNIT; 2], "cases(a, b)", ONE),
    Case { no_program: OF_AN_INTEGER, ..case("chosen", &[[-2.5, 3.5], UNIT], "chosen(a, b)", ONE) },
    case("loops", &[[0.0, 3.0]], "loops(a)", THREE),
    case("table", &[SIGNED; 2], "table(vec2(a, b))", ONE),
    Case { no_program: OF_AN_INTEGER, ..case("looked_up", &[[-0.5, 1.5]], "looked_up(a)", ONE) },
    Case { no_program: OF_AN_INTEGER, ..case("bits", &[[-900.0, 900.0]], "bits(a)", THREE) },
    case("nested", &[SIGNED; 2], "nested(a, b)", TWO),
    Case {
        // Sines and arcs to 5e-4.
        single: 3e-3,
        ..case("builtins", &[[-3.0, 3.0], [0.1, 2.0]], "builtins(a, b)", BUILTINS)
    },
    Case {
        no_program: Some("exponent of what depends on inputs"),
        ..case("taken_apart", &[[-20.0, 20.0]; 2], "taken_apart(a, b)", FOUR)
    },
    case("modulo", &[[-3.0, 3.0]; 3], "modulo(a, vec2(b, c))", FOUR),
    Case {
        before: "calls = 2; seed = vec2(0.5, 0.25); ",
        ..case("state", &[UNIT], "state(a)", TWO)
    },
    case("truths", &[UNIT; 6], "truths(vec3(a, b, c), vec3(d, e, f))", THREE),
    case("components", &[SIGNED; 4], "components(vec4(a, b, c, d))", FOUR),
];

const BUILTINS: &[&str] = &[
    ".rounded.x",
    ".rounded.y",
    ".rounded.z",
    ".rounded.w",
    ".parts.x",
    ".parts.y",
    ".parts.z",
    ".parts.w",
    ".powers.x",
    ".powers.y",
    ".powers.z",
    ".powers.w",
    ".angles.x",
    ".angles.y",
    ".angles.z",
    ".angles.w",
    ".blends.x",
    ".blends.y",
    ".blends.z",
    ".blends.w",
];

pub const LANGUAGES: [&str; 2] = ["wgsl", "glsl"];

/// Returns the folder of the functions.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/shader/functions")
}

impl Case {
    /// Returns the text in a language; none if the function is of the other alone.
    pub fn text(&self, language: &str) -> Option<String> {
        std::fs::read_to_string(folder().join(format!("{}.{language}", self.name))).ok()
    }

    pub fn read(&self, language: &str) -> Option<Shader> {
        let text = self.text(language)?;
        let options = Options { entry: Some(self.name.to_owned()), ..Options::default() };
        let file = format!("{}.{language}", self.name);
        let shader = Shader::parse(file.as_ref(), text.into(), &options);
        Some(shader.unwrap_or_else(|error| panic!("{file}: {error}")))
    }

    /// Returns points of the domain that single precision has, too.
    pub fn points(&self, count: usize) -> Vec<Vec<f64>> {
        let mut rng = ChaCha8Rng::seed_from_u64(11);
        let mut point = || {
            let along = self.domain.iter().map(|&[low, high]| rng.random_range(low..high) as f32);
            along.map(f64::from).collect()
        };
        (0..count).map(|_| point()).collect()
    }
}

#[test]
fn every_function_is_a_case() {
    for entry in std::fs::read_dir(folder()).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        assert!(name == "functions" || CASES.iter().any(|case| case.name == name), "{name}");
    }
}

#[test]
fn every_case_has_as_many_inputs_and_outputs_as_its_shaders() {
    for case in CASES {
        let shaders: Vec<Shader> = LANGUAGES.iter().filter_map(|l| case.read(l)).collect();
        assert!(!shaders.is_empty(), "{}", case.name);
        for shader in shaders {
            assert_eq!(shader.inputs().len(), case.domain.len(), "{}", case.name);
            assert_eq!(shader.outputs().len(), case.outputs.len(), "{}", case.name);
        }
    }
}
