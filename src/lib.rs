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
//! | [`program`] | instructions, verified programs, outer forms, effective code, hashes, formula text |
//! | [`simplify`] | algebra on programs |
//! | [`dataset`] | tables of samples, their files, the incumbents |
//! | [`grammar`], [`cost`] | what may be written, what it costs on a GPU; their `.ron` files |
//! | [`eval`] | the data-parallel interpreter, losses, normal equations, scores; the same programs in f64, f16, intervals |
//! | [`fit`] | error measures; derivatives by constants, Levenberg–Marquardt, the least maximum; constants with few digits; models of one's own |
//! | [`stability`] | verdicts: what is proved of a formula over its whole domain, or refuted |
//! | [`archive`] | the Pareto archive |
//! | [`scene`] | what a use needs of a dataset: ranges, fixed inputs, histograms, combined outputs |
//! | [`search`] | problems and methods, islands, variation, fronts |
//! | [`emit`] | formulas as HLSL, WGSL, GLSL, MSL, Slang, and back; as C, Rust, Python, LaTeX |
//! | [`wording`] | fronts, verdicts and examinations in words |
//! | [`run`] | a search under way, from its budget to its fronts; its record and folder; unions, what recurs |
//! | [`quadrature`], [`microfacet`], [`targets`] | integration, BRDF models, ground truths |
//! | [`report`] | plots, maps, the page of a run, spheres |
//! | [`cli`] | a file a subcommand |
//!
//! # A search in ten lines
//! ```
//! use lgp::dataset::{Dataset, axis};
//! use lgp::emit::Language;
//! use lgp::run::{Budget, Session};
//! use lgp::search::{Method, Problem};
//!
//! let schlick = |[v_dot_h]: [f64; 1]| [(1.0 - v_dot_h).powi(5)];
//! let data = Dataset::sampled([axis("v_dot_h", 0.0..=1.0)], ["weight"], schlick)?;
//! let problem = Problem::of(data).gpu("gcn").max_cost(8.0).build()?;
//! let budget = Budget { generations: Some(10), ..Budget::default() };
//! let mut session = Session::new(problem, Method::default())?.budget(budget);
//! let outcome = session.run(|progress| eprintln!("{:.1} s", progress.point.seconds))?;
//! let best = outcome.front.within(Some(4.0), None).expect("a formula of 4 cycles");
//! println!("{}", outcome.snippet(best, Language::Wgsl));
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

pub mod archive;
pub mod scene;

pub mod search;

pub mod emit;
pub mod wording;

pub mod run;

pub mod microfacet;
pub mod quadrature;
pub mod targets;

pub mod report;

pub mod cli;
