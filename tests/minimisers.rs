//! Global and local minimisers: what each setting does, and functions whose minima are published.

// A test has no use for all that the benchmark has.
#[allow(dead_code)]
#[path = "../benches/minimisers/problems/mod.rs"]
mod problems;

use lgp::fit::{
    DifferentialEvolution, End, GlobalSettings, Minimum, NelderMead, Outside, Range, RangeError,
    Scale, Start, Strategy,
};
use problems::{Problem, mgh, multimodal};
use std::sync::Mutex;

const PATIENT: NelderMead =
    NelderMead { size: 0.1, shrinkage: 1e-9, restarts: 60, max_evaluations: 200_000 };

fn linear(low: f64, high: f64) -> Range {
    Range::new(low, high, Scale::Linear).unwrap()
}

fn ranges(problem: &Problem) -> Vec<Range> {
    problem.ranges.iter().map(|[low, high]| linear(*low, *high)).collect()
}

fn sphere(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum()
}

/// An evolution that goes on whatever the values, with four individuals.
const PLAIN: DifferentialEvolution = DifferentialEvolution {
    strategy: Strategy::Rand1Bin,
    weights: [0.5, 0.5],
    crossover: 0.5,
    outside: Outside::Clamp,
    start: Start::LatinHypercube,
    individuals: Some(4),
    value_spread: None,
    point_spread: None,
    max_evaluations: 40,
};

/// The points that are evaluated, generation by generation.
fn generations(
    evolution: &DifferentialEvolution,
    ranges: &[Range],
    f: impl Fn(&[f64]) -> f64,
) -> Vec<Vec<Vec<f64>>> {
    let mut points = Vec::new();
    let recorded = |x: &[f64]| {
        points.push(x.to_vec());
        f(x)
    };
    evolution.minimise(ranges, 1, recorded).unwrap();
    points.chunks(evolution.individuals.unwrap()).map(<[Vec<f64>]>::to_vec).collect()
}

#[test]
fn published_minima_are_minima() {
    let mut wrong = Vec::new();
    for problem in multimodal::all().iter().chain(&mgh::all()) {
        let free = vec![Range::ANY; problem.start.len()];
        let near = problem.near.as_ref().unwrap_or(&problem.start);
        let minimum = PATIENT.minimise(near, &free, 1, |x| problem.value(x));
        if (minimum.value - problem.least).abs() > problem.tolerance {
            wrong.push(format!("{}: {} for {}", problem.name, minimum.value, problem.least));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn global_minima_are_found_from_any_seed() {
    let reliable = ["branin", "goldstein_price", "rastrigin_2", "hartmann_3", "bard", "beale"];
    for name in reliable {
        let problem = problems::find(name).unwrap();
        for seed in 1..=5 {
            let settings = GlobalSettings { seed, ..GlobalSettings::default() };
            let minimum = settings.minimise(&ranges(&problem), |x| problem.value(x)).unwrap();
            assert!(problem.is_reached(minimum.value), "{name}, seed {seed}: {minimum:?}");
            assert!(minimum.evaluations < 12_000, "{name}, seed {seed}: {minimum:?}");
        }
    }
}

/// The weights between `least` and `greatest` with which every trial of a generation that is within
/// its range is a mutation of other individuals; none where they do not tell.
fn weights(before: &[Vec<f64>], trials: &[Vec<f64>]) -> Option<Vec<f64>> {
    let mut common: Option<Vec<f64>> = None;
    for (own, trial) in trials.iter().enumerate().filter(|(_, trial)| trial[0].abs() < 1.0) {
        let mut possible = Vec::new();
        let other = |i: &usize| *i != own;
        for a in (0..before.len()).filter(other) {
            for b in (0..before.len()).filter(other).filter(|b| *b != a) {
                for c in (0..before.len()).filter(other).filter(|c| *c != a && *c != b) {
                    possible.push((trial[0] - before[a][0]) / (before[b][0] - before[c][0]));
                }
            }
        }
        // A difference of equal individuals, weighted by anything.
        if possible.iter().any(|w| w.is_nan()) {
            continue;
        }
        let is_possible = |w: &f64| possible.iter().any(|other| (w - other).abs() < 1e-9);
        common = Some(match common {
            None => possible,
            Some(known) => known.into_iter().filter(is_possible).collect(),
        });
    }
    common
}

#[test]
fn trials_are_mutations_by_one_weight_a_generation() {
    // Of equal values every trial takes its individual's place: generations are populations.
    let of = |weights: [f64; 2]| {
        let evolution = DifferentialEvolution { weights, individuals: Some(6), ..PLAIN };
        let evolution = DifferentialEvolution { max_evaluations: 60, ..evolution };
        generations(&evolution, &[linear(-1.0, 1.0)], |_| 0.0)
    };
    let found = |weights_between: [f64; 2]| -> Vec<Vec<f64>> {
        of(weights_between).windows(2).filter_map(|pair| weights(&pair[0], &pair[1])).collect()
    };
    let has = |found: &Vec<f64>, w: f64| found.iter().any(|other| (w - other).abs() < 1e-9);
    let fixed = found([0.5, 0.5]);
    assert!(fixed.len() > 3 && fixed.iter().all(|found| has(found, 0.5)), "{fixed:?}");
    let mut dithered = found([0.6, 1.0]);
    dithered.iter_mut().for_each(|found| found.retain(|w| (0.6..1.0).contains(w)));
    assert!(dithered.len() > 3 && dithered.iter().all(|found| !found.is_empty()), "{dithered:?}");
    let first = dithered[0][0];
    assert!(!dithered.iter().all(|found| has(found, first)), "{dithered:?}");
}

#[test]
fn the_best_strategy_starts_from_the_best() {
    let from_best = |strategy: Strategy| {
        let evolution = DifferentialEvolution { strategy, max_evaluations: 8, ..PLAIN };
        let generations = generations(&evolution, &[linear(-1.0, 1.0)], sphere);
        let [before, trials] = &generations[..] else { panic!("{generations:?}") };
        let best = before.iter().min_by(|a, b| sphere(a).total_cmp(&sphere(b))).unwrap()[0];
        let is_from_best = |trial: &&Vec<f64>| {
            let mut pairs = before.iter().flat_map(|b| before.iter().map(move |c| b[0] - c[0]));
            pairs.any(|difference| (trial[0] - best - 0.5 * difference).abs() < 1e-12)
        };
        trials.iter().filter(is_from_best).count()
    };
    assert_eq!(from_best(Strategy::Best1Bin), 4);
    assert!(from_best(Strategy::Rand1Bin) < 4);
}

#[test]
fn crossover_says_how_many_coordinates_change() {
    let changed = |crossover: f64| -> Vec<usize> {
        let evolution = DifferentialEvolution { crossover, max_evaluations: 8, ..PLAIN };
        let generations = generations(&evolution, &[linear(-1.0, 1.0); 10], sphere);
        let pairs = generations[0].iter().zip(&generations[1]);
        pairs.map(|(x, y)| x.iter().zip(y).filter(|(x, y)| x != y).count()).collect()
    };
    assert_eq!(changed(0.0), [1; 4]);
    assert_eq!(changed(1.0), [10; 4]);
    let half: usize = changed(0.5).iter().sum();
    assert!((10..30).contains(&half), "{half} of 40");
}

#[test]
fn coordinates_outside_their_ranges_are_clamped_or_drawn_anew() {
    let slope = |x: &[f64]| x[0];
    let of = |outside: Outside| {
        let evolution = DifferentialEvolution { outside, max_evaluations: 400, ..PLAIN };
        let points = generations(&evolution, &[linear(2.0, 3.0)], slope).concat();
        assert!(points.iter().all(|x| (2.0..=3.0).contains(&x[0])));
        points.iter().filter(|x| x[0] == 2.0).count()
    };
    assert!(of(Outside::Clamp) > 10);
    assert_eq!(of(Outside::Reinitialise), 0);
}

#[test]
fn a_latin_hypercube_has_one_individual_a_slice() {
    let fills = |start: Start| {
        let evolution =
            DifferentialEvolution { start, individuals: Some(20), max_evaluations: 0, ..PLAIN };
        let first = generations(&evolution, &[linear(0.0, 20.0); 3], sphere).swap_remove(0);
        (0..3).all(|axis| {
            let mut slices: Vec<u32> = first.iter().map(|x| x[axis] as u32).collect();
            slices.sort_unstable();
            slices.iter().copied().eq(0..20)
        })
    };
    assert!(fills(Start::LatinHypercube));
    assert!(!fills(Start::Random));
}

#[test]
fn there_are_ten_individuals_a_coordinate_and_at_most_forty() {
    let first = |dimensions: usize| {
        let evolution = DifferentialEvolution { individuals: None, max_evaluations: 0, ..PLAIN };
        evolution.minimise(&vec![linear(0.0, 1.0); dimensions], 1, sphere).unwrap().evaluations
    };
    assert_eq!([1, 2, 4, 7].map(first), [10, 20, 40, 40]);
}

#[test]
fn an_evolution_ends_when_values_or_points_agree_or_evaluations_are_spent() {
    let ranges = [linear(-1.0, 2.0); 2];
    let evolution = DifferentialEvolution { max_evaluations: 3000, ..PLAIN };
    let evolution = DifferentialEvolution { individuals: Some(20), ..evolution };
    let end = |evolution: DifferentialEvolution, f: fn(&[f64]) -> f64| {
        let minimum = evolution.minimise(&ranges, 1, f).unwrap();
        (minimum.end, minimum.evaluations)
    };
    let raised: fn(&[f64]) -> f64 = |x| 1.0 + sphere(x);
    assert_eq!(end(evolution, raised), (End::Evaluations, 3000));
    let by_values = DifferentialEvolution { value_spread: Some(1e-3), ..evolution };
    let (why, loose) = end(by_values, raised);
    assert_eq!(why, End::ValuesAgree);
    let by_values = DifferentialEvolution { value_spread: Some(1e-6), ..evolution };
    assert!(loose < end(by_values, raised).1);
    let by_points = DifferentialEvolution { point_spread: Some(1e-2), ..evolution };
    let (why, loose) = end(by_points, raised);
    assert_eq!(why, End::PointsAgree);
    let by_points = DifferentialEvolution { point_spread: Some(1e-4), ..evolution };
    assert!(loose < end(by_points, raised).1);
}

#[test]
fn a_logarithmic_scale_finds_what_is_orders_of_magnitude_away() {
    let f = |x: &[f64]| (x[0].ln() - 3e-5f64.ln()).powi(2);
    let found = |scale: Scale| {
        let evolution = DifferentialEvolution { max_evaluations: 120, ..Default::default() };
        evolution.minimise(&[Range::new(1e-6, 1e4, scale).unwrap()], 1, f).unwrap().value
    };
    assert!(found(Scale::Logarithmic) < 1e-2 * found(Scale::Linear));
}

#[test]
fn nan_is_worse_than_any_value_and_all_nan_is_infinite() {
    let half = |x: &[f64]| (x[0] - 1.0).sqrt();
    let minimum = GlobalSettings::default().minimise(&[linear(-9.0, 9.0)], half).unwrap();
    assert!(minimum.value < 1e-2, "{minimum:?}");
    let evolution = DifferentialEvolution::default();
    let alone = evolution.minimise(&[linear(-9.0, 9.0)], 1, half).unwrap();
    assert!(alone.value < 1e-2, "{alone:?}");
    let nowhere = |_: &[f64]| f64::NAN;
    let few = DifferentialEvolution { max_evaluations: 100, ..evolution };
    let alone = few.minimise(&[linear(-9.0, 9.0)], 1, nowhere).unwrap();
    assert_eq!(alone.value, f64::INFINITY);
    let minimum = GlobalSettings::default().minimise(&[linear(-9.0, 9.0)], nowhere).unwrap();
    assert_eq!(minimum.value, f64::INFINITY);
}

#[test]
fn a_function_of_no_coordinates_has_its_value() {
    let minimum = GlobalSettings::default().minimise(&[], |_| 3.0).unwrap();
    assert_eq!((minimum.value, minimum.at.len()), (3.0, 0));
}

#[test]
fn ranges_without_an_end_are_refused() {
    let half = Range::new(0.0, f64::INFINITY, Scale::Linear).unwrap();
    for ranges in [[half, linear(0.0, 1.0)], [linear(0.0, 1.0), Range::ANY]] {
        let refused = DifferentialEvolution::default().minimise(&ranges, 1, sphere);
        assert!(matches!(refused, Err(RangeError::Infinite { .. })), "{refused:?}");
        assert!(GlobalSettings::default().minimise(&ranges, sphere).is_err());
    }
}

#[test]
fn restarts_go_on_where_a_simplex_has_collapsed() {
    let problem = problems::find("rosenbrock_10").unwrap();
    let value = |restarts: u32| {
        let simplex = NelderMead { restarts, shrinkage: 1e-2, max_evaluations: 100_000, size: 0.1 };
        let free = [Range::ANY; 10];
        let minimum = simplex.minimise(&problem.start, &free, 1, |x| problem.value(x));
        assert_eq!(minimum.end, End::PointsAgree);
        minimum.value
    };
    assert!(value(20) < 1e-3 * value(0), "{} {}", value(20), value(0));
}

#[test]
fn a_simplex_keeps_to_its_ranges_and_evaluations() {
    let simplex = NelderMead { max_evaluations: 60, ..NelderMead::default() };
    let mut count = 0;
    let slope = |x: &[f64]| {
        count += 1;
        assert!(x.iter().all(|x| (1.0..=4.0).contains(x)), "{x:?}");
        x[0] - x[1]
    };
    let minimum = simplex.minimise(&[2.0, 3.9], &[linear(1.0, 4.0); 2], 1, slope);
    assert_eq!((&minimum.at[..], minimum.evaluations), (&[1.0, 4.0][..], count));
    let simplex = NelderMead { max_evaluations: 30, ..NelderMead::default() };
    let minimum = simplex.minimise(&[2.0, 2.0], &[Range::ANY; 2], 1, sphere);
    assert_eq!(minimum.end, End::Evaluations);
    assert!((30..36).contains(&minimum.evaluations), "{}", minimum.evaluations);
}

#[test]
fn several_starts_find_what_one_misses() {
    let problem = problems::find("rastrigin_2").unwrap();
    let ranges = ranges(&problem);
    let starts: Vec<Vec<f64>> =
        (0..49).map(|i| vec![f64::from(i % 7) - 3.2, f64::from(i / 7) - 2.9]).collect();
    let simplex = NelderMead { size: 0.03, ..NelderMead::default() };
    let from =
        |starts: &[Vec<f64>]| simplex.minimise_from(starts, &ranges, 1, |x| problem.value(x));
    assert!(from(&starts[..1]).value > 1.0);
    let all = from(&starts);
    assert!(problem.is_reached(all.value), "{all:?}");
    assert!(all.evaluations > 10 * from(&starts[..1]).evaluations);
    // Equal starts have simplices of their own.
    let twice = [starts[0].clone(), starts[0].clone()];
    assert_ne!(from(&twice).evaluations, 2 * from(&twice[..1]).evaluations);
}

#[test]
fn results_do_not_depend_on_threads() {
    let problem = problems::find("ackley_10").unwrap();
    let ranges = ranges(&problem);
    let f = |x: &[f64]| problem.value(x);
    let evolution = DifferentialEvolution { max_evaluations: 2000, ..Default::default() };
    let settings = GlobalSettings { max_evaluations: 3000, ..GlobalSettings::default() };
    let simplex = NelderMead { max_evaluations: 300, ..NelderMead::default() };
    let starts = vec![vec![9.0; 10], vec![-3.0; 10], vec![1.5; 10]];
    let found = |threads: usize| -> [Minimum; 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            [
                evolution.minimise_in_parallel(&ranges, 7, f).unwrap(),
                settings.minimise(&ranges, f).unwrap(),
                simplex.minimise_from(&starts, &ranges, 7, f),
            ]
        })
    };
    let one = found(1);
    assert_eq!(one[0], evolution.minimise(&ranges, 7, f).unwrap());
    assert_ne!(one[0], evolution.minimise(&ranges, 8, f).unwrap());
    for threads in [2, 5] {
        assert_eq!(found(threads), one, "{threads}");
    }
}

#[test]
fn rounds_end_when_two_agree() {
    let count = Mutex::new(0);
    let counted = |x: &[f64]| {
        *count.lock().unwrap() += 1;
        1.0 + sphere(x)
    };
    let ranges = [linear(-1.0, 2.0); 2];
    let settings = GlobalSettings::default();
    let once = GlobalSettings { rounds: 1, ..settings }.minimise(&ranges, counted).unwrap();
    assert_eq!(once.evaluations, *count.lock().unwrap());
    let agreed = settings.minimise(&ranges, counted).unwrap();
    assert!((once.evaluations + 1..4 * once.evaluations).contains(&agreed.evaluations));
    // Rounds that do not agree go on to the last evaluation.
    let problem = problems::find("griewank_10").unwrap();
    let few = GlobalSettings { max_evaluations: 9000, rounds: 99, ..settings };
    let minimum = few.minimise(&self::ranges(&problem), |x| problem.value(x)).unwrap();
    assert!((9000..20_000).contains(&minimum.evaluations), "{minimum:?}");
}
