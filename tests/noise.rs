//! A member of a front wins by more than the rounding of its data: laws are found as they are.

use lgp::dataset::{Column, Dataset, Split};
use lgp::fit::Measure;
use lgp::program::{Names, parse};
use lgp::search::{Front, Goal, Method, Problem, Search};

/// Samples of laws, computed in f64 and rounded, at points spread over [1, 5] in each input.
fn sampled(inputs: &[&str], outputs: &[&str], laws: &[fn(&[f64]) -> f64]) -> Dataset {
    let split = |first: u32, rows: u32| {
        let at = |row: u32, i: usize| {
            let irrational = ((i + 2) as f64).sqrt();
            1.0 + 4.0 * (f64::from(first + row) * irrational).fract()
        };
        let mut columns: Vec<Vec<f32>> =
            (0..inputs.len()).map(|i| (0..rows).map(|row| at(row, i) as f32).collect()).collect();
        for law in laws {
            let point = |row| (0..inputs.len()).map(|i| at(row, i)).collect::<Vec<f64>>();
            columns.push((0..rows).map(|row| law(&point(row)) as f32).collect());
        }
        Split { columns, ..Split::default() }
    };
    let column = |name: &&str| Column::new(name, [1.0, 5.0]);
    Dataset {
        name: "law".into(),
        inputs: inputs.iter().map(column).collect(),
        outputs: outputs.iter().map(column).collect(),
        search: split(1, 200),
        validation: split(1000, 150),
        ..Dataset::default()
    }
}

/// The front of what a search that starts with guesses finds in a few generations.
fn front(data: &Dataset, guesses: &[&str], generations: u64, measure: Measure) -> Front {
    let (goal, method) = (
        Goal { max_cost: 12.0, measure, ..Goal::default() },
        Method { islands: 2, candidates: 100, ..Method::default() },
    );
    let problem = Problem::of(data.clone()).goal(goal).build().unwrap();
    let mut search = Search::new(problem, method).unwrap();
    let draft = |text: &&str| parse(text, &data.names()).unwrap().into_draft();
    search.inject(&guesses.iter().map(draft).collect::<Vec<_>>());
    (0..generations).for_each(|_| search.advance());
    Front::of(&search)
}

/// What a front's last member is, and the constants that it reads.
fn last(front: &Front, names: &Names) -> (String, Vec<f32>) {
    let formula = front.members.last().expect("a member").formula.clone();
    let mut constants = parse(&formula, names).unwrap().into_draft().consts;
    constants.sort_by(f32::total_cmp);
    (formula, constants)
}

#[test]
fn laws_carry_no_noise() {
    type Law =
        (&'static [&'static str], fn(&[f64]) -> f64, &'static [&'static str], &'static [f32]);
    let laws: [Law; 6] = [
        (&["x"], |x| 2.5 * x[0] - 0.75, &["y = 2.5000002*x - 0.75000024", "y = x"], &[0.75, 2.5]),
        (
            &["m", "z", "g"],
            |x| x[0] * x[1] * x[2],
            &["y = m*z*g - 8e-8", "y = m*z*g + 3e-9*m"],
            &[],
        ),
        (
            &["gamma", "pr", "rho"],
            |x| (x[0] * x[1] / x[2]).sqrt(),
            &["y = sqrt(gamma*pr/rho + 2e-8)", "y = 0.99999994*sqrt(gamma*pr/rho) - 1e-8"],
            &[],
        ),
        (
            &["x1", "y1", "x2", "y2", "x3", "y3"],
            |x| x[0] * x[1] + x[2] * x[3] + x[4] * x[5],
            &["y = x1*y1 + (x2*y2 + 2e-7 + x3*y3)"],
            &[],
        ),
        (&["q", "r"], |x| x[0] / (x[1] * x[1]) * 0.5, &["y = 0.5*q/(r*r + 1e-7) + 1e-8"], &[0.5]),
        (
            &["a", "b"],
            |x| x[0] - x[1],
            &["y = a - 1.0000001*b - 6e-8", "y = a - b + 1e-9*a*b"],
            &[],
        ),
    ];
    for (inputs, law, guesses, constants) in laws {
        let data = sampled(inputs, &["y"], &[law]);
        // Relative to a difference near 0 the inputs' own rounding is no noise of the output's.
        let cancels = inputs == ["a", "b"];
        for measure in [Measure::Rmse, Measure::Max, Measure::Relative] {
            if cancels && measure == Measure::Relative {
                continue;
            }
            let front = front(&data, guesses, 2, measure);
            let (formula, found) = last(&front, &data.names());
            assert_eq!(found, constants, "{measure}: {formula}");
            let largest = data.search.columns[inputs.len()].iter().fold(0.0f32, |a, b| a.max(*b));
            let error = front.members.last().unwrap().search_error().max / f64::from(largest);
            assert!(error < 1e-6, "{measure}: {formula} errs by {error}");
        }
    }
}

#[test]
fn an_output_that_is_zero_is_zero() {
    let data = sampled(&["x"], &["y", "z"], &[|x| 3.0 * x[0], |_| 0.0]);
    let front = front(&data, &["y = 3*x; z = 5e-26", "y = 3*x; z = 1e-30*x"], 2, Measure::Rmse);
    let (formula, _) = last(&front, &data.names());
    assert_eq!(formula, "y = 3*x; z = 0");
}

#[test]
fn a_line_is_found_as_it_is() {
    let line = sampled(&["x"], &["y"], &[|x| 2.5 * x[0] - 0.75]);
    let found = front(&line, &[], 10, Measure::Rmse);
    assert_eq!(last(&found, &line.names()).0, "y = 2.5*x - 0.75");
}

/// What counts stays: a small term of a law is no noise.
#[test]
fn small_terms_that_count_stay() {
    let data = sampled(&["x"], &["y"], &[|x| x[0] * x[0] + 1e-4 * x[0]]);
    let front = front(&data, &["y = x*x + 0.0001*x", "y = x*x"], 0, Measure::Rmse);
    let formulas: Vec<&str> = front.members.iter().map(|m| m.formula.as_str()).collect();
    let (_, constants) = last(&front, &data.names());
    assert_eq!(constants, [1e-4], "{formulas:?}");
}

/// Of data with standard errors, no member fits their noise.
#[test]
fn members_win_by_more_than_standard_errors() {
    let mut data = sampled(&["x"], &["y"], &[|x| 2.5 * x[0] - 0.75]);
    const ERROR: f32 = 0.02;
    // Sums of twelve uniform numbers are nearly normal.
    let mut state = 1u64;
    let mut normal = || {
        let uniform = |_| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f32 / (1u32 << 24) as f32
        };
        (0..12).map(uniform).sum::<f32>() - 6.0
    };
    for split in [&mut data.search, &mut data.validation] {
        split.columns[1].iter_mut().for_each(|y| *y += ERROR * normal());
    }
    let plain = front(&data, &[], 12, Measure::Max);
    for split in [&mut data.search, &mut data.validation] {
        split.standard_errors = vec![vec![ERROR; split.columns[0].len()]];
    }
    for measure in [Measure::Rmse, Measure::Max, Measure::Relative] {
        let found = front(&data, &[], 12, measure);
        let costs: Vec<f64> = found.members.iter().map(|member| member.cost).collect();
        assert_eq!(costs, [0.0, 1.0], "{measure}: {found:?}");
    }
    assert!(plain.members.len() > 2, "noise is fitted where it is not told: {plain:?}");
}

/// Nothing is left of constants that met when what stood between them was dropped as idle.
#[test]
fn constants_that_meet_leave_no_noise() {
    let data = sampled(&["n", "h"], &["y"], &[|x| x[0] * x[1] / std::f64::consts::TAU]);
    let guess = "y = 0.159155*abs(-0.6 - h*n) - 0.0954935";
    let (formula, constants) = last(&front(&data, &[guess], 0, Measure::Rmse), &data.names());
    assert_eq!(constants.len(), 1, "{formula}");
}
