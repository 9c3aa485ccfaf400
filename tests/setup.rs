//! Whatever is asked, and however it is to be searched: it is refused, or a search goes on without a panic.

use lgp::dataset::{Dataset, axis};
use lgp::fit::Measure;
use lgp::op::Op;
use lgp::search::{CostOf, Front, Goal, Method, Problem, Requirement, Search, Transform};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use std::sync::atomic::{AtomicUsize, Ordering};

fn dataset() -> Dataset {
    let axes = [axis("x", 0.0..=1.0), axis("u", -1.0..=2.0)];
    let mut data = Dataset::sampled(axes, ["y", "z"], |[x, u]| [x * u + 0.3, (3.0 * x).sin()]);
    let data = data.as_mut().unwrap();
    for split in [&mut data.search, &mut data.validation] {
        split.columns.iter_mut().for_each(|column| column.truncate(40));
        split.grid.clear();
    }
    data.clone()
}

/// Numbers that a caller may well give, and some that nobody means.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        12 => 0.0..50.0f64,
        1 => prop::sample::select(vec![
            f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -0.0, 1e300, 1000.0, 1e-300,
        ]),
    ]
}

fn count() -> impl Strategy<Value = usize> {
    prop_oneof![
        20 => 1..6usize,
        1 => prop::sample::select(vec![0, 256, 257, 100_000, usize::MAX]),
    ]
}

fn requirement() -> impl Strategy<Value = Requirement> {
    let place = || prop_oneof![12 => 0..2u16, 1 => 2..4u16];
    let output = || prop::option::of(place());
    prop_oneof![
        (output(), number(), number()).prop_map(|(output, low, high)| Requirement::Range {
            output,
            low: low as f32,
            high: high as f32
        }),
        (output(), place(), any::<bool>())
            .prop_map(|(output, input, rising)| Requirement::Monotone { output, input, rising }),
        (output(), place()).prop_map(|(output, input)| Requirement::Ends { output, input }),
        prop::sample::select(Op::ALL.to_vec()).prop_map(Requirement::Operation),
        place().prop_map(Requirement::Input),
        Just(Requirement::Finite),
        number().prop_map(|error| Requirement::Half { error }),
    ]
}

fn goal() -> impl Strategy<Value = Goal> {
    let transform = prop::sample::select(vec![
        None,
        Some(Transform::Rcp),
        Some(Transform::Log2),
        Some(Transform::Sqrt),
    ]);
    let measure = prop::sample::select(Measure::ALL.to_vec());
    let requirements = prop::collection::vec(requirement(), 0..3);
    let transforms = prop_oneof![
        12 => prop::collection::vec(transform.clone(), 0..3),
        1 => prop::collection::vec(transform, 3..5),
    ];
    let text = || {
        prop::sample::select(vec![
            "y = f(x)*$a; z = f(u)",
            "(y, z) = $M(f(x, u), g(x))",
            "y = f(x, u); z = g(f(x, u))",
        ])
    };
    let template = |text: &str| Some(text.to_owned());
    let cost_of = || prop::sample::select(vec![CostOf::Whole, CostOf::Holes]);
    let asked = prop_oneof![
        12 => transforms.clone().prop_map(|transforms| (transforms, None, CostOf::Whole)),
        4 => (text(), cost_of()).prop_map(move |(text, of)| (Vec::new(), template(text), of)),
        // What contradicts itself, or names what is not there.
        1 => (transforms, cost_of())
            .prop_map(move |(transforms, of)| (transforms, template("y = f(q)"), of)),
    ];
    (measure, requirements, asked, number()).prop_map(
        |(measure, requirements, (transforms, template, cost_of), max_cost)| Goal {
            measure,
            requirements,
            transforms,
            template,
            cost_of,
            max_cost,
        },
    )
}

fn method() -> impl Strategy<Value = Method> {
    let share = prop_oneof![12 => 0.0..=1.0f64, 1 => number()];
    (any::<u64>(), count(), count(), share, count(), count(), count()).prop_map(
        |(seed, islands, candidates, immigrants, bucket_size, migration_interval, subset)| Method {
            seed,
            islands,
            candidates,
            immigrants,
            bucket_size,
            migration_interval: migration_interval as u64,
            subset,
        },
    )
}

#[test]
fn whatever_is_asked_is_refused_or_searched_for() {
    let config = ProptestConfig { cases: 400, failure_persistence: None, ..Default::default() };
    let (searched, refused) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let tried = TestRunner::new(config).run(&(goal(), method()), |(goal, method)| {
        // Such as are allowed and take long.
        let is_long = method.islands > 8 || method.candidates > 8;
        let problem = Problem::of(dataset()).goal(goal).build();
        let search = problem.and_then(|problem| Search::new(problem, method));
        let Ok(mut search) = search else {
            refused.fetch_add(1, Ordering::Relaxed);
            return Ok(());
        };
        if !is_long {
            searched.fetch_add(1, Ordering::Relaxed);
            search.advance();
            let most = search.problem().goal().max_cost;
            let front = Front::of(&search);
            prop_assert!(front.members.iter().all(|member| member.cost <= most));
        }
        Ok(())
    });
    tried.unwrap();
    let (searched, refused) = (searched.into_inner(), refused.into_inner());
    assert!(searched > 100 && refused > 50, "{searched} searched, {refused} refused");
}

#[test]
fn what_can_be_meant_is_not_refused() {
    let goals = [
        Goal { max_cost: 0.0, ..Goal::default() },
        Goal { max_cost: 1000.0, transforms: vec![Some(Transform::Rcp)], ..Goal::default() },
        Goal {
            measure: Measure::Relative,
            requirements: vec![Requirement::Finite],
            ..Goal::default()
        },
    ];
    for goal in goals {
        let problem = Problem::of(dataset()).goal(goal).build().unwrap();
        let method =
            Method { islands: 1, candidates: 1, subset: 1, bucket_size: 1, ..Method::default() };
        Search::new(problem, method).unwrap().advance();
    }
}

#[test]
fn a_refusal_says_which_field_and_why() {
    let refused = |goal: Goal| Problem::of(dataset()).goal(goal).build().unwrap_err().to_string();
    let message = refused(Goal { max_cost: f64::NAN, ..Goal::default() });
    assert!(message.contains("`max_cost` is NaN"), "{message}");
    let message = refused(Goal { measure: Measure::Weighted, ..Goal::default() });
    assert!(message.contains("no weights"), "{message}");
    let requirements = vec![Requirement::Ends { output: None, input: 0 }];
    let message = refused(Goal { measure: Measure::Relative, requirements, ..Goal::default() });
    assert!(message.contains("not relative"), "{message}");
    let problem = Problem::of(dataset()).build().unwrap();
    let message = Search::new(problem, Method { subset: 0, ..Method::default() }).unwrap_err();
    assert!(message.to_string().contains("`subset` is 0"), "{message}");
}
