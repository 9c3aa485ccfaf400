//! Samples that follow a search, and errors over the whole domain.

#![cfg(feature = "cli")]

mod command;

use command::succeed;
use lgp::dataset::{Dataset, Split};
use lgp::fit::Measure;
use lgp::program::{Names, parse};
use lgp::run::{Budget, Census, Checkpoint, Followed, Session};
use lgp::search::{FrontMember, Goal, Method, Problem, Search, integrate};
use lgp::targets::{self, Recipe};
use lgp::truth::{DomainError, Mesh, Norm, Truth, parse_domain};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

fn truth(formula: &str, domain: &str) -> Truth {
    Truth::formula(formula, &[], &parse_domain(domain).unwrap()).unwrap()
}

fn sampled(truth: Truth, rows: usize) -> Mesh {
    let mut mesh = Mesh::new(truth, rows);
    assert!(mesh.sample(&|| false).unwrap());
    mesh
}

/// The weighted mean of a column.
fn mean(rows: &Split, column: usize) -> f64 {
    let products = rows.columns[column].iter().zip(&rows.weights).map(|(y, w)| f64::from(y * w));
    products.sum::<f64>() / rows.rows() as f64
}

/// The squares of a column.
fn squares(rows: &Split, column: usize) -> Vec<f64> {
    rows.columns[column].iter().map(|y| f64::from(*y).powi(2)).collect()
}

#[test]
fn weights_are_shares_of_the_domain() {
    for (formula, domain, exact, tolerance) in [
        ("y = x*x", "x=0..1", 1.0 / 3.0, 1e-6),
        ("y = x*x*z", "x=0..1,z=0..2", 1.0 / 3.0, 1e-6),
        ("y = x*z*w", "x=0..1,z=0..1,w=0..1", 0.125, 1e-6),
        ("y = x*z*w*v", "x=0..1,z=0..1,w=0..1,v=0..1", 0.0625, 2e-3),
        // Equidistant in the logarithm.
        ("y = log2(x)", "x=1..16:log", 2.0, 1e-5),
    ] {
        let mut mesh = sampled(truth(formula, domain), 4096);
        let column = mesh.truth().axes().len();
        for _ in 0..3 {
            let rows = mesh.rows();
            let off = (mean(&rows, column) / exact - 1.0).abs();
            assert!(off < tolerance, "{formula}: {off}");
            assert!(
                (mesh.tiles().iter().map(|tile| tile.volume()).sum::<f64>() - 1.0).abs() < 1e-12
            );
            mesh.refine(&[squares(&rows, column)], Norm::Mean);
            assert!(mesh.sample(&|| false).unwrap());
        }
    }
}

#[test]
fn ends_are_sampled_and_weigh_nothing() {
    let mesh = sampled(truth("y = x + z", "x=0..1,z=0..1"), 4096);
    let rows = mesh.rows();
    let corner =
        (0..rows.rows()).find(|&row| rows.columns[0][row] == 1.0 && rows.columns[1][row] == 0.0);
    assert_eq!(rows.weights[corner.expect("a corner")], 0.0);
    assert_eq!(rows.rows(), 66 * 66);
}

#[test]
fn samples_gather_where_formulas_err() {
    // A grid of 64² has 58 of its rows there.
    for (norm, least) in [(Norm::Mean, 500), (Norm::Largest, 200)] {
        let mut mesh =
            sampled(truth("y = exp2(-4000*(x - 0.7)^2 - 4000*(z - 0.2)^2)", "x=0..1,z=0..1"), 4096);
        let tiles = mesh.tiles().len();
        for _ in 0..6 {
            let squares = squares(&mesh.rows(), 2);
            mesh.refine(&[squares], norm);
            assert!(mesh.sample(&|| false).unwrap());
            assert!(mesh.tiles().len() <= tiles, "no more than there were");
        }
        let rows = mesh.rows();
        let is_near = |row: &usize| {
            (rows.columns[0][*row] - 0.7).abs() < 0.06 && (rows.columns[1][*row] - 0.2).abs() < 0.06
        };
        let near = (0..rows.rows()).filter(is_near).count();
        assert!(near > least, "{norm:?}: {near}");
        let exact = std::f64::consts::PI / (8000.0 * std::f64::consts::LN_2);
        let found = squares_mean(&rows);
        assert!((found / exact - 1.0).abs() < 5e-3, "{norm:?}: {found} {exact}");
    }
}

fn squares_mean(rows: &Split) -> f64 {
    let weighted = squares(rows, 2).into_iter().zip(&rows.weights).map(|(y, w)| y * f64::from(*w));
    weighted.sum::<f64>() / rows.rows() as f64
}

#[test]
fn tiles_are_taken_up_again_only_if_they_cover_the_domain() {
    let mut mesh = sampled(truth("y = exp2(-64*x)", "x=0..1"), 64);
    mesh.refine(&[squares(&mesh.rows(), 1)], Norm::Mean);
    let tiles = mesh.tiles().to_vec();
    let again = Mesh::of_tiles(mesh.truth().clone(), 64, tiles.clone()).unwrap();
    assert_eq!(again.tiles(), tiles);
    assert!(Mesh::of_tiles(mesh.truth().clone(), 64, tiles[1..].to_vec()).is_none());
}

/// The errors of a formula over a domain.
fn domain_error(formula: &str, truth: Truth, rows: usize, evaluations: usize) -> DomainError {
    let names = Names::new(truth.inputs(), truth.outputs().to_vec());
    let data = truth.dataset(Some(4), &|_, _| ()).unwrap();
    let problem = Problem::of(data.clone()).build().unwrap();
    let program = parse(formula, &names).unwrap();
    let mut member = FrontMember::new(program, &data, problem.profile(), &names);
    let mesh = Mesh::new(truth, rows);
    assert!(integrate(&mut [&mut member], 1, &mesh, evaluations, &|| false).unwrap());
    member.domain_error().unwrap()
}

#[test]
fn errors_over_the_domain_are_integrals_with_bars() {
    // ∫ x⁴ = 1/5; narrow, at an end; narrow, within; a kink; a root, steepest at an end.
    for (formula, exact_mean, exact_max) in [
        ("y = x*x", 0.2, 1.0),
        ("y = exp2(-500*x)", 1.0 / (1000.0 * std::f64::consts::LN_2), 1.0),
        (
            "y = exp2(-1e5*(x - 0.3)^2)",
            (std::f64::consts::PI / (2e5 * std::f64::consts::LN_2)).sqrt(),
            1.0,
        ),
        ("y = abs(x - 1/3)", ((1.0f64 / 3.0).powi(3) + (2.0f64 / 3.0).powi(3)) / 3.0, 2.0 / 3.0),
        ("y = 1 - sqrt(x)", 1.0 / 6.0, 1.0),
    ] {
        let error = domain_error("y = 0", truth(formula, "x=0..1"), 256, 1 << 14);
        let rmse = exact_mean.sqrt();
        assert!(error.rmse_within < 2e-3 * rmse, "{formula}: {error:?}");
        assert!(
            (error.rmse - rmse).abs() <= error.rmse_within + 1e-7 * rmse,
            "{formula}: {error:?} {rmse}"
        );
        assert!(error.max <= exact_max + 1e-6, "{formula}: {error:?}");
        assert!(error.max + error.max_within >= exact_max * (1.0 - 2e-3), "{formula}: {error:?}");
    }
}

#[test]
fn error_bars_shrink_with_evaluations() {
    let peak = || truth("y = exp2(-4000*(x - 0.7)^2 - 4000*(z - 0.2)^2)", "x=0..1,z=0..1");
    let few = domain_error("y = 0", peak(), 1024, 0);
    let many = domain_error("y = 0", peak(), 1024, 1 << 14);
    assert!(many.rmse_within < 0.1 * few.rmse_within, "{few:?} {many:?}");
    let exact = (std::f64::consts::PI / (8000.0 * std::f64::consts::LN_2)).sqrt();
    assert!((many.rmse - exact).abs() <= many.rmse_within, "{many:?} {exact}");
}

#[test]
fn losses_on_followed_samples_are_weighted_means() {
    let truth = truth("y = exp2(-30*x)", "x=0..1");
    let data = truth.dataset(None, &|_, _| ()).unwrap();
    for measure in [Measure::Rmse, Measure::Max, Measure::Relative] {
        let goal = Goal { measure, max_cost: 6.0, ..Goal::default() };
        let problem = Problem::of(data.clone()).goal(goal).build().unwrap();
        let method = Method { islands: 4, ..Method::default() };
        let mut search = Search::new(problem, method).unwrap();
        (0..3).for_each(|_| search.advance());
        let mut mesh = sampled(truth.clone(), 512);
        for _ in 0..3 {
            let norm = if measure == Measure::Max { Norm::Largest } else { Norm::Mean };
            mesh.refine(&search.squares(&mesh.rows()), norm);
            mesh.sample(&|| false).unwrap();
        }
        let rows = mesh.rows();
        search.sample_on(rows.clone()).unwrap();
        search.judge_anew(&lgp::deadline::Deadline::NEVER);
        (0..2).for_each(|_| search.advance());
        let all = search.squares(&rows);
        assert!(!all.is_empty());
        for (member, squares) in search.archive().members().iter().zip(all) {
            let loss = match measure {
                Measure::Max => squares.iter().copied().fold(0.0, f64::max),
                _ => {
                    let weighted = squares.iter().zip(&rows.weights);
                    weighted.map(|(e, w)| e * f64::from(*w)).sum::<f64>() / rows.rows() as f64
                }
            };
            let near = (member.loss / loss - 1.0).abs() < 1e-3;
            assert!(near, "{measure}: {} {loss}", member.loss);
        }
    }
}

/// A lobe that a grid of 64 points along each input hardly meets.
const LOBE: &str = "c = cos(t); a2 = a*a; y = a2*a2/(c*c*(a2 - 1) + 1)^2";
const DOMAIN: &str = "t=0..pi/2,a=.005..0.05";

fn search(folder: &Path, out: &str, more: &[&str]) -> String {
    let asked = [
        "search",
        "--formula",
        LOBE,
        "--outputs",
        "y",
        "--domain",
        DOMAIN,
        "--max-cost",
        "8",
        "--islands",
        "2",
    ];
    succeed(folder, &[&asked[..], &["--out", out], more].concat());
    std::fs::read_to_string(folder.join(out).join("front.json")).unwrap()
}

#[test]
fn a_search_that_samples_follow_repeats_and_can_be_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let front = search(folder.path(), "one", &["--generations", "20", "--threads", "1"]);
    let again = search(folder.path(), "two", &["--generations", "20", "--threads", "2"]);
    assert_eq!(front, again);
    // Stopped before the samples are first chosen, just then, and later.
    for stopped in ["5", "8", "11"] {
        search(folder.path(), stopped, &["--generations", stopped]);
        succeed(folder.path(), &["search", "--resume", "--out", stopped, "--generations", "20"]);
        let resumed =
            std::fs::read_to_string(folder.path().join(stopped).join("front.json")).unwrap();
        assert_eq!(front, resumed, "after {stopped}");
    }
    let fixed = search(folder.path(), "fixed", &["--generations", "20", "--fixed-samples"]);
    assert_ne!(front, fixed);
    // Both by their integrals, which are smaller where samples were where the errors are.
    let rmse = |front: &str| -> f64 {
        let front: Value = serde_json::from_str(front).unwrap();
        let last = front.as_array().unwrap().last().unwrap();
        last["domain_errors"]["y"]["rmse"].as_f64().unwrap()
    };
    assert!(rmse(&front) < rmse(&fixed), "{} {}", rmse(&front), rmse(&fixed));
}

#[test]
fn targets_are_functions_too() {
    let recipe = Recipe::parse("(target: \"smith_g1\", points: 16)").unwrap();
    let data = targets::generate(&recipe, &|_, _| ()).unwrap();
    let truth = targets::truth(&recipe).unwrap();
    assert_eq!(truth.inputs(), data.names().inputs);
    let problem = Problem::of(data).max_cost(6.0).build().unwrap();
    let method = Method { islands: 2, ..Method::default() };
    let budget = Budget { generations: Some(9), ..Budget::default() };
    let mut session = Session::new(problem, method).unwrap().budget(budget);
    session = session.following(truth).unwrap();
    let outcome = session.run(|_| ()).unwrap();
    assert!(session.take_follow_error().is_none());
    let last = outcome.front.members.last().unwrap();
    let (domain, search) = (last.domain_error().unwrap(), last.search_error());
    assert!((domain.rmse / search.rmse - 1.0).abs() < 0.2, "{domain:?} {search:?}");
    assert!(domain.rmse_within < 0.01 * domain.rmse, "{domain:?}");
}

#[test]
fn every_value_of_a_targets_truth_is_that_of_its_data() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("datasets");
    let files = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
    let recipes = files.filter(|file| file.extension().is_some_and(|end| end == "ron"));
    let mut of_rows = BTreeSet::new();
    for file in recipes {
        let recipe = Recipe::load(&file).unwrap();
        let name = recipe.target().name;
        let Some(truth) = targets::truth(&recipe) else {
            of_rows.insert(name);
            continue;
        };
        let data = Dataset::load(&file.with_extension("bin")).unwrap();
        let inputs = data.inputs.len();
        for row in [0, data.search.rows() / 2, data.search.rows() - 1] {
            let column = |index: usize| data.search.columns[index][row];
            let point: Vec<f64> = (0..inputs).map(|index| column(index).into()).collect();
            for (index, value) in (inputs..).zip(truth.at(&point).unwrap()) {
                let (value, given) = (value as f32, column(index));
                // The functions of other machines differ in their last bits.
                let near = (value - given).abs() <= 2.0 * f32::EPSILON * given.abs();
                assert!(near, "{name}, {point:?}: {value} {given}");
            }
        }
    }
    // Their rows are not spread evenly over the domain.
    let expected = ["ggx_d", "ggx_lobes", "ggx_response", "hammon", "sphere_light"];
    assert_eq!(of_rows, BTreeSet::from(expected));
}

#[test]
fn damaged_records_of_samples_are_refused_or_harmless() {
    let data = truth("y = exp2(-30*x)", "x=0..1").dataset(Some(64), &|_, _| ()).unwrap();
    let truth = truth("y = exp2(-30*x)", "x=0..1");
    let problem = || Problem::of(data.clone()).max_cost(3.0).build().unwrap();
    let method = Method { islands: 1, candidates: 40, ..Method::default() };
    let mut search = Search::new(problem(), method.clone()).unwrap();
    search.advance();
    let resumed = |followed: &str| {
        let run = lgp::run::Run::of(&problem(), &method);
        let checkpoint = Checkpoint {
            run: lgp::run::Run { seconds: 1.0, ..run },
            state: search.state().clone(),
            trace: String::new(),
            census: Census::default(),
            followed: Some(ron::from_str::<Followed>(followed).unwrap()),
        };
        let budget = Budget { generations: Some(3), ..Budget::default() };
        let session = Session::resume(problem(), checkpoint).unwrap().budget(budget);
        session.following(truth.clone()).map(|mut session| session.run(|_| ()).unwrap())
    };
    // 0 never doubles; half of the domain.
    let outcome = resumed("(tiles: [(halves: [])], next: 0, has_begun: false)").unwrap();
    assert_eq!(outcome.run.generations, 3);
    let half = "(tiles: [(halves: [(axis: 0, upper: true)])], next: 16, has_begun: true)";
    assert!(resumed(half).unwrap_err().to_string().contains("cover the domain"));
}
