//! Symbolic regression for shaders: cheap closed-form formulas for sampled functions.
//!
//! In: samples of a function. Out: a Pareto front of formulas, error against GPU cycles, ready to
//! paste. The method is linear genetic programming as in Pesce & Iwanicki, "Approximate Models
//! for Physically Based Rendering" (SIGGRAPH 2015 course, §5): an individual is a short string of
//! instructions, each reading input columns, constants, or results of earlier instructions.
//!
//! # The map
//! Data flows downwards, and a module uses only those above it:
//!
//! | module | owns |
//! |---|---|
//! | [`deadline`] | when work ends before it is done |
//! | [`printable`], [`suggest`] | text from elsewhere made harmless; the nearest known name |
//! | [`num`] | registers of lanes, and mathematics with the same bits at every width; low-discrepancy points, sums |
//! | [`op`] | the one table of operations, and what they mean |
//! | [`program`] | instructions, verified programs, effective code, hashes, formula text |
//! | [`simplify`] | algebra on programs |
//! | [`dataset`] | tables of samples, their files, the incumbents |
//! | [`grammar`], [`cost`] | what may be written, what it costs on a GPU; their `.ron` files |
//! | [`eval`] | the data-parallel interpreter, losses, normal equations, scores; the same programs in f64, f16, intervals |
//! | [`fit`] | error measures; derivatives by constants, Levenberg–Marquardt, the least maximum; constants with few digits; models of one's own |
//! | [`stability`] | verdicts: what is proved of a formula over its whole domain, or refuted |
//! | [`scene`] | what a use needs of a dataset: ranges, fixed inputs, histograms, combined outputs |
//! | [`archive`], [`search`] | the Pareto archive; islands, variation, fronts; runs on disk, their union, what recurs |
//! | [`emit`] | formulas as HLSL, WGSL, GLSL, MSL, and back; as C, Rust, Python, LaTeX |
//! | [`quadrature`], [`microfacet`], [`targets`] | integration, BRDF models, ground truths |
//! | [`report`] | tables, plots, maps, the page of a run, spheres |
//! | [`cli`] | a file a subcommand |
//!
//! # A search in ten lines
//! ```
//! use lgp::{cost::Profile, dataset::{Column, Dataset, Split}, grammar::Grammar};
//! use lgp::search::{Front, Problem, Search, Settings};
//!
//! let column = |name: &str, domain| Column { name: name.into(), unit: "1".into(), domain };
//! let schlick = |i: u32| (1.0 - (i as f32 + 0.5) / 64.0).powi(5);
//! let cosines = (0..64).map(|i| (i as f32 + 0.5) / 64.0).collect();
//! let split = Split { columns: vec![cosines, (0..64).map(schlick).collect()], ..Split::default() };
//! let data = Dataset {
//!     name: "schlick".into(),
//!     recipe: "(1 - cos)^5".into(),
//!     inputs: vec![column("v_dot_h", [0.0, 1.0])],
//!     outputs: vec![column("weight", [0.0, 1.0])],
//!     search: split.clone(),
//!     validation: split,
//! };
//! let (grammar, gpu) = (Grammar::find("polynomial")?, Profile::find("gcn")?);
//! let settings = Settings { islands: 2, max_cost: 8.0, ..Settings::default() };
//! let problem = Problem::new(&data, &grammar, &gpu, &settings);
//! let mut search = Search::new(settings);
//! (0..10).for_each(|_| search.advance(&problem));
//! for formula in Front::of(&search, &problem).members {
//!     println!("{} cycles, RMSE {}: {}", formula.cost, formula.search_error().rmse, formula.formula);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod deadline;
pub mod printable;
pub mod suggest;

pub mod num;
pub mod op;
pub mod program;
pub mod simplify;

pub mod dataset;
pub mod grammar;

pub mod cost;
pub mod eval;
pub mod fit;
pub mod stability;

pub mod scene;

pub mod archive;
pub mod search;

pub mod emit;

pub mod microfacet;
pub mod quadrature;
pub mod targets;

pub mod report;

pub mod cli;
