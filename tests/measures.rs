//! One error under one name: what a search makes small is what is shown of what it finds, in every measure.

use lgp::cost::Profile;
use lgp::dataset::{Column, Dataset, Split};
use lgp::fit::Measure;
use lgp::grammar::Grammar;
use lgp::program::{Names, Program};
use lgp::search::{
    Front, FrontMember, Goal, Method, Problem, Requirement, ScoredIncumbent, Search,
};
use lgp::wording::front_table;

/// Two outputs, the second `scale` times as large; weights that favour large inputs, and free errors.
fn dataset(scale: f32) -> Dataset {
    let split = |rows: u32, offset: f32| {
        let xs: Vec<f32> = (0..rows).map(|i| (i as f32 + offset) / rows as f32).collect();
        let column = |f: &dyn Fn(f32) -> f32| -> Vec<f32> { xs.iter().map(|&x| f(x)).collect() };
        let outputs = [column(&|x| 0.2 + (3.0 * x).sin()), column(&|x| scale * (x * x + 0.1))];
        let weights = column(&|x| 0.05 + 4.0 * x * x);
        let dead_zone = vec![column(&|x| 0.02 * x), column(&|x| 0.02 * scale * (1.0 - x))];
        let columns = [xs].into_iter().chain(outputs).collect();
        Split { columns, weights, dead_zone, ..Split::default() }
    };
    let column = |name, high| Column::new(name, [0.0, high]);
    Dataset {
        name: "two".into(),
        inputs: vec![column("x", 1.0)],
        outputs: vec![column("wave", 1.2), column("square", 1.1 * f64::from(scale))],
        search: split(120, 0.0),
        validation: split(77, 0.5),
        ..Dataset::default()
    }
}

fn searched(data: &Dataset, grammar: &str, goal: Goal, method: Method) -> Search {
    let grammar = Grammar::find(grammar).unwrap();
    let problem = Problem::of(data.clone()).grammar(grammar).goal(goal).build().unwrap();
    let mut search = Search::new(problem, method).unwrap();
    (0..4).for_each(|_| search.advance());
    search
}

#[test]
fn an_archives_loss_is_the_error_shown_in_every_measure() {
    let gpu = Profile::find("gcn").unwrap();
    for scale in [1.0, 1024.0, 1e6] {
        let data = dataset(scale);
        for measure in Measure::ALL {
            let goal = Goal { measure, max_cost: 12.0, ..Goal::default() };
            let method = Method { islands: 3, candidates: 60, ..Method::default() };
            let search = searched(&data, "shader", goal, method);
            let problem = search.problem();
            let mut compared = 0;
            for member in search.archive().members() {
                let program = Program::verify(problem.natural(&member.draft).into_owned()).unwrap();
                let shown = FrontMember::new(program, &data, &gpu, &data.names());
                let shown = shown.search_error().of(measure);
                let searched = problem.error(member.loss);
                assert!(
                    (shown - searched).abs() <= 1e-4 * searched + 1e-6,
                    "{measure}, {scale}: {shown} {searched}"
                );
                compared += usize::from(shown > 1e-3);
            }
            assert!(compared >= 3, "{measure}, {scale}: {compared}");
        }
    }
}

/// The samples that hold a formula to an end are no part of the error.
#[test]
fn what_is_required_of_ends_is_no_part_of_the_error() {
    let gpu = Profile::find("gcn").unwrap();
    let data = dataset(1.0).select(None, Some(&["square".to_owned()])).unwrap();
    for measure in [Measure::Rmse, Measure::Max, Measure::Weighted, Measure::Visible] {
        let goal = Goal {
            measure,
            max_cost: 6.0,
            requirements: vec![Requirement::Ends { output: None, input: 0 }],
            ..Goal::default()
        };
        let method = Method { islands: 3, ..Method::default() };
        let search = searched(&data, "polynomial", goal, method);
        let problem = search.problem();
        assert!(!search.archive().members().is_empty(), "{measure}");
        for member in search.archive().members() {
            let program = Program::verify(member.draft.clone()).unwrap();
            let shown = FrontMember::new(program, &data, &gpu, &data.names());
            let shown = shown.search_error().of(measure);
            let searched = problem.error(member.loss);
            assert!(
                (shown - searched).abs() <= 1e-4 * searched + 1e-6,
                "{measure}: {shown} {searched}"
            );
        }
    }
}

/// Of a front in any measure: its table has that measure's column, and published formulas are judged where
/// the front is.
#[test]
fn a_table_shows_and_judges_by_what_was_made_small() {
    let gpu = Profile::find("gcn").unwrap();
    let data = dataset(1.0).select(None, Some(&["wave".to_owned()])).unwrap();
    let names: Names = data.names();
    let member = |text: &str| {
        let program = lgp::program::parse(text, &names).unwrap();
        FrontMember::new(program, &data, &gpu, &names)
    };
    // The first fits where weights are small, the second where they are large.
    let (left, right) = (member("wave = 0.2 + 2.7*x"), member("wave = 1.9 - 1.6*x"));
    for (measure, better) in [(Measure::Weighted, &right), (Measure::Visible, &right)] {
        let worse = if better == &right { &left } else { &right };
        assert!(better.dominates(worse, measure) && !worse.dominates(better, measure));
        let front = Front::from_members(vec![better.clone()], measure);
        let known = ScoredIncumbent { name: "known".into(), member: worse.clone() };
        let table = front_table(&front, &[known], &names.outputs);
        let error = lgp::wording::error_text(better.validation_error().of(measure));
        let judged = format!("dominated by 1 (1 cycles, val. {measure} RMSE {error})");
        assert!(table.contains(&judged), "{judged}\n{table}");
        assert!(table.contains(&format!("{measure} RMSE")), "{table}");
    }
    let rmse = |member: &FrontMember| member.search_error().rmse;
    assert!(rmse(&left) != left.search_error().of(Measure::Weighted), "weights matter here");
}
