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
//! | [`mod@file`] | files read up to a limit, and written as a whole |
//! | [`num`] | registers of lanes, and mathematics with the same bits at every width; low-discrepancy points, sums |
//! | [`quadrature`] | integration: fixed, adaptive, by sampling |
//! | [`op`] | the one table of operations, and what they mean |
//! | [`program`] | instructions, verified programs, outer forms, effective code, hashes, formula text |
//! | [`simplify`] | algebra on programs |
//! | [`dataset`] | tables of samples, where they come from, what is claimed of them; their files, the incumbents |
//! | [`explore`] | what data say before a search: inputs that matter, separations that hold, templates |
//! | [`import`], [`export`] | other people's files made datasets; datasets made files for other programs |
//! | [`grammar`], [`cost`] | what may be written, what it costs on a GPU; their `.ron` files |
//! | [`eval`] | the data-parallel interpreter, losses, normal equations, scores; the same programs in f64, f16, intervals |
//! | [`fit`] | error measures; derivatives by constants, Levenberg–Marquardt, the least maximum; differential evolution, simplices; constants with few digits; models of one's own |
//! | [`stability`] | verdicts: what is proved of a formula over its whole domain, or refuted |
//! | [`archive`] | the Pareto archive |
//! | [`scene`] | what a use needs of a dataset: ranges, fixed inputs, histograms, combined outputs |
//! | [`truth`] | functions that can be evaluated anywhere; where they are sampled, on grids or by a mesh that follows a search; errors over a whole domain |
//! | [`search`] | problems and methods, islands, variation, fronts |
//! | [`project`] | models' parameters, point by point |
//! | [`emit`] | formulas in shading and other languages, as files for engines, under any head; and back |
//! | [`wording`] | fronts, verdicts and examinations in words |
//! | [`shader`] | functions of shaders as truths: read, interpreted, written down as formulas |
//! | [`run`] | a search under way, from its budget to its fronts; its record and folder; unions, what recurs |
//! | [`microfacet`], [`lobes`], [`targets`] | BRDF models, reflections as spherical Gaussians, ground truths |
//! | [`report`] | plots, maps, the page of a run, spheres |
//! | [`cli`] | a file a subcommand |
//!
//! The features `report` and `cli`, on by default, are the last two rows and all that only they
//! need; `shader` and `arrays`, which `cli` turns on, are what reads shaders, and what reads textures.
//! All is one crate, since a search needs every module above them; a test checks the order.
//!
//! # Words
//! | word | meaning |
//! |---|---|
//! | operation, instruction | a row of the one table ([`op::Op`]); an operation and its arguments: inputs, constants, *earlier* results |
//! | draft, program | a string of instructions with its constants and outputs; a draft that was verified, so that it can be evaluated, costed and emitted |
//! | effective code, intron | the instructions that an output depends on; any other instruction |
//! | dataset, search split, validation split | columns of samples; the rows that formulas are fitted to; other rows, denser, with the domain's edges, that decide about a front |
//! | dead zone | the error of a sample that nobody sees and that therefore does not count |
//! | outer form, hole, child | a function around what is searched ([`program::Outer`]); a value in it that a formula is to be found for; the draft that is varied and fills the holes |
//! | template, shape | a formula that is known but for its holes and free constants ([`program::Template`]); what each value of a child may read |
//! | offspring, mutation, crossover, immigrant | what variation makes of a parent; a random change of it; a piece of another parent; a random draft in place of offspring |
//! | individual, population, bucket, selection | a fitted child; an island's individuals, the best few at each cost; those of one cost; the choice of parents by rank in a bucket |
//! | island, migration, barrier | a population that evolves by itself; its best going on to the next island; the end of a generation, where that happens |
//! | local search | the fit of a candidate's constants ([`fit`]): Levenberg–Marquardt, or the least maximum error |
//! | archive, front | the best of a search under way, no member dominated in cost and loss; what is left of it, polished and judged |
//! | measure, loss, error | what is made small ([`fit::Measure`]); its value for a search, a mean square; its root, as it is shown |
//! | cost, profile | cycles on a GPU; the file that says what a GPU's instructions cost |
//! | problem, method, session, run | what is asked; how it is searched; a search under way; what it leaves behind |
//! | scene | what a use needs of a dataset: ranges, fixed inputs, histograms, combined outputs |
//! | claim, verdict | a comparison that is to hold for every input; proved, refuted with a counterexample, or open |
//! | projection, group, place | the parameters of a model fitted group by group ([`project`]); rows that share the values of some inputs; these values |
//! | incumbent | a published formula for the same data, scored as a member of a front would be |
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

#![deny(missing_docs)]

pub mod deadline;
pub mod file;
pub mod printable;
pub mod suggest;

pub mod num;
pub mod op;
pub mod program;
pub mod simplify;

pub mod dataset;
pub mod explore;
pub mod export;
pub mod grammar;
pub mod import;

pub mod cost;
pub mod eval;
pub mod fit;
pub mod stability;

pub mod archive;
pub mod scene;

pub mod truth;

pub mod search;

pub mod project;

pub mod emit;
pub mod wording;

#[cfg(feature = "shader")]
pub mod shader;

pub mod run;

pub mod lobes;
pub mod microfacet;
pub mod quadrature;
pub mod targets;

#[cfg(feature = "report")]
pub mod report;

#[cfg(feature = "cli")]
pub mod cli;
