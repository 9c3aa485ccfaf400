//! Searches that are cut: what is there is kept, and what is paused goes on as if it never stopped.

use lgp::dataset::{Column, Dataset, Split};
use lgp::deadline::{Deadline, Stop};
use lgp::fit::Measure;
use lgp::run::{Census, Checkpoint, Run};
use lgp::search::{Enumeration, Front, Goal, Method, Problem, Search, Work};
use std::sync::Arc;
use std::time::Duration;

/// A function of so many inputs on [0, 1], rows spread by golden ratios.
fn dataset(inputs: usize, rows: u32, f: fn(&[f32]) -> Vec<f32>) -> Dataset {
    let column = |name: String| Column { name, unit: "1".into(), domain: [0.0, 1.0] };
    let at = |row: u32, i: usize| ((row + 1) as f32 * (0.618 + 0.414 * i as f32)).fract();
    let rows: Vec<Vec<f32>> =
        (0..rows).map(|row| (0..inputs).map(|i| at(row, i)).collect()).collect();
    let values: Vec<Vec<f32>> = rows.iter().map(|row| f(row)).collect();
    let outputs = values[0].len();
    let by_column = |rows: &[Vec<f32>], columns: usize| -> Vec<Vec<f32>> {
        (0..columns).map(|i| rows.iter().map(|row| row[i]).collect()).collect()
    };
    let columns = [by_column(&rows, inputs), by_column(&values, outputs)].concat();
    let split = Split { columns, ..Split::default() };
    Dataset {
        name: "cut".into(),
        inputs: (0..inputs).map(|i| column(format!("x{i}"))).collect(),
        outputs: (0..outputs).map(|i| column(format!("y{i}"))).collect(),
        search: split.clone(),
        validation: split,
        ..Dataset::default()
    }
}

fn curve(x: &[f32]) -> Vec<f32> {
    vec![(-2.0 * x[0]).exp() * (1.0 - x[1])]
}

/// A deadline that is past.
fn past() -> Deadline {
    let stop = Stop::default();
    let deadline = Deadline::NEVER.or_request(&stop);
    stop.request();
    deadline
}

#[test]
fn a_generation_that_is_paused_goes_on_as_if_it_never_stopped() {
    let data = dataset(2, 300, curve);
    for measure in [Measure::Rmse, Measure::Max] {
        let (goal, method) = (
            Goal { max_cost: 12.0, measure, ..Goal::default() },
            Method { islands: 3, candidates: 60, migration_interval: 2, ..Method::default() },
        );
        let problem = Arc::new(Problem::of(data.clone()).goal(goal).build().unwrap());
        let mut whole = Search::new(problem.clone(), method.clone()).unwrap();
        (0..4).for_each(|_| whole.advance());
        let run = Run::of(&problem, &method);
        let mut paused = Search::new(problem.clone(), method.clone()).unwrap();
        let mut pauses = 0;
        while paused.generation() < 4 {
            // At first next to nothing is done; so that it ends on any machine, more and more.
            let time = Duration::from_micros(50 << (pauses / 8).min(20));
            if !paused.advance_until(&Deadline::NEVER.pausing_in(time)) {
                pauses += 1;
                let bytes = Checkpoint::bytes(&run, paused.state(), "", &Census::default(), None);
                let read = Checkpoint::from_bytes("checkpoint.bin".as_ref(), &bytes).unwrap();
                paused = Search::resume(problem.clone(), method.clone(), read.state).unwrap();
            }
        }
        assert!(pauses > 3, "{pauses}");
        let state = |search: &Search| (search.counts(), search.archive().clone());
        assert_eq!(state(&paused), state(&whole));
    }
}

#[test]
fn a_stop_from_the_start_leaves_the_best_constant() {
    let data = dataset(2, 2000, curve);
    let (goal, method) = (Goal::default(), Method::default());
    let problem = Problem::of(data.clone()).goal(goal).build().unwrap();
    let mut search = Search::new(problem, method).unwrap();
    let (cost, most) = Enumeration::USUAL;
    search.enumerate_until(cost, most, &past());
    assert_eq!(search.enumeration(), None);
    assert!(!search.advance_until(&past()));
    assert_eq!((search.generation(), search.counts().considered), (0, 0));
    let work = Work { deadline: past(), progress: &|_| {} };
    let front = Front::polished(&search, &work);
    let [constant] = front.members.as_slice() else { panic!("{} members", front.members.len()) };
    let values = &data.search.columns[2];
    let mean = values.iter().map(|&y| f64::from(y)).sum::<f64>() / values.len() as f64;
    let square = |y: &f32| (f64::from(*y) - mean).powi(2);
    let deviation = (values.iter().map(square).sum::<f64>() / values.len() as f64).sqrt();
    assert!((constant.search_error().rmse - deviation).abs() < 1e-5 * deviation);
    let second = Front::polished_in(&search, Measure::Max, &front, &work);
    assert_eq!(second.members, front.members);
}

#[test]
fn what_was_found_before_a_stop_is_on_the_front() {
    let data = dataset(2, 2000, curve);
    for measure in [Measure::Rmse, Measure::Max] {
        let (goal, method) = (
            Goal { max_cost: 12.0, measure, ..Goal::default() },
            Method { islands: 2, ..Method::default() },
        );
        let problem = Problem::of(data.clone()).goal(goal).build().unwrap();
        let mut search = Search::new(problem, method).unwrap();
        search.advance();
        let work = Work { deadline: past(), progress: &|_| {} };
        let cut = Front::polished(&search, &work);
        let error = |place: usize| cut.members[place].search_error().of(measure);
        let best = cut.members.len() - 1;
        assert!(best > 0 && error(best) < 0.5 * error(0), "{cut:?}");
        let mut judged = cut.clone();
        judged
            .judge_until(&search.problem().questions(), &data.names(), &|| work.deadline.is_past());
        assert_eq!(judged, cut, "there is no time for verdicts");
    }
}

#[test]
fn many_inputs_and_outputs_are_too_many_to_try_all() {
    let sum = |x: &[f32]| vec![x.iter().sum(), x[0] * x[1], x[2], x[0], x[3], x[4] + x[5], x[6]];
    for inputs in [40, 64, 200] {
        let data = dataset(inputs, 50, sum);
        let (goal, method) = (
            Goal { max_cost: 10.0, ..Goal::default() },
            Method { islands: 1, ..Method::default() },
        );
        let problem = Problem::of(data.clone()).goal(goal).build().unwrap();
        let mut search = Search::new(problem, method).unwrap();
        let (cost, most) = Enumeration::USUAL;
        search.enumerate(cost, most);
        assert_eq!(search.enumeration(), None);
        search.advance();
        let front = Front::polished(&search, &Work::TO_THE_END);
        assert!(!front.members.is_empty());
    }
}
