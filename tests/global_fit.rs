//! Global fits of programs' constants: minima that local fits miss, bounds, scales, samples.

#[allow(dead_code)]
#[path = "../benches/minimisers/problems/mod.rs"]
mod problems;

use lgp::dataset::Split;
use lgp::eval::{Evaluator, Samples, Tape};
use lgp::fit::{
    Bound, DifferentialEvolution, Finish, Fitter, GlobalFit, GlobalSettings, LocalFit, Measure,
    Parameter, RangeError, Scale, fit_globally, fit_model,
};
use lgp::program::{Draft, Names, Program, Scope, parse_template};
use problems::mgh;

/// Samples of a function of x on [0, 1].
fn sampled(rows: u32, f: impl Fn(f64) -> f64) -> Split {
    let xs: Vec<f64> = (0..rows).map(|i| (f64::from(i) + 0.5) / f64::from(rows)).collect();
    let ys = xs.iter().map(|x| f(*x) as f32).collect();
    let xs = xs.into_iter().map(|x| x as f32).collect();
    Split { columns: vec![xs, ys], ..Split::default() }
}

fn template(text: &str, bounds: &[[f32; 2]]) -> (Draft, Vec<Parameter>) {
    let names = Names::new(["x"], ["y"]);
    let parsed = parse_template(text, Scope::Dataset(&names)).unwrap();
    let free = parsed.free.iter().zip(bounds);
    let parameter = |(free, bounds): (&lgp::program::FreeConstant, &[f32; 2])| Parameter {
        bounds: *bounds,
        ..Parameter::unbounded(free.index.into())
    };
    let parameters = free.map(parameter).collect();
    (parsed.program.into_draft(), parameters)
}

fn globally(
    (draft, parameters): &mut (Draft, Vec<Parameter>),
    samples: &Samples,
    measure: Measure,
    settings: &GlobalSettings,
) -> GlobalFit {
    fit_globally(&mut Fitter::default(), draft, samples, parameters, measure, settings).unwrap()
}

fn constant((draft, parameters): &(Draft, Vec<Parameter>), which: usize) -> f32 {
    draft.consts[parameters[which].index]
}

const WAVE: &str = "y = $b*sin($a*x) + $c";
const WAVE_BOUNDS: [[f32; 2]; 3] = [[-3.0, 3.0], [0.0, 150.0], [-3.0, 3.0]];

#[test]
fn a_frequency_that_local_fits_miss_is_found_in_every_measure() {
    let split = sampled(300, |x| 1.5 * (83.0 * x).sin() - 0.25);
    for measure in Measure::ALL {
        let samples = measure.all_samples(&split, 1, &[1.0]);
        let mut model = template(WAVE, &WAVE_BOUNDS);
        let local = fit_model(&mut model.0.clone(), &samples, &model.1, measure, 4, 1);
        assert!(local.loss > 1e-2, "{measure}: {local:?}");
        let fit = globally(&mut model, &samples, measure, &GlobalSettings::default());
        // The largest error, too, is one of sin in `f32`.
        assert!(fit.loss < 1e-5, "{measure}: {fit:?} {:?}", model.0.consts);
        assert_eq!(fit.finish, Finish::Derivatives, "{measure}");
    }
}

#[test]
fn starts_that_find_different_minima_disagree() {
    let samples =
        Measure::Rmse.all_samples(&sampled(300, |x| (83.0 * x).sin() + 0.1 * x), 1, &[1.0]);
    let fit = |text: &str, bounds: &[[f32; 2]]| -> LocalFit {
        let (mut draft, parameters) = template(text, bounds);
        fit_model(&mut draft, &samples, &parameters, Measure::Rmse, 24, 1)
    };
    let wave = fit(WAVE, &WAVE_BOUNDS);
    assert!(wave.starts_disagree() && (1..6).contains(&wave.reached), "{wave:?}");
    let line = fit("y = $a*x + $b", &[[-9.0, 9.0]; 2]);
    assert_eq!((line.reached, line.starts, line.starts_disagree()), (24, 24, false));
    // Met to rounding by one start only, it cannot be bettered.
    let samples = Measure::Rmse.all_samples(&sampled(300, |x| (9.0 * x).sin()), 1, &[1.0]);
    let (mut draft, parameters) = template("y = sin($a*x)", &[[0.0, 400.0]]);
    draft.consts[parameters[0].index] = 9.1;
    let exact = fit_model(&mut draft, &samples, &parameters, Measure::Rmse, 24, 1);
    assert!(exact.reached < 6 && exact.is_exact && !exact.starts_disagree(), "{exact:?}");
    let (mut draft, parameters) = template("y = log2(-$a - 10)", &[[0.0, 1.0]]);
    let never = fit_model(&mut draft, &samples, &parameters, Measure::Rmse, 24, 1);
    assert!(!never.loss.is_finite() && never.reached == 0 && never.starts_disagree(), "{never:?}");
}

#[test]
fn what_has_no_derivative_is_found_by_a_simplex() {
    let split = sampled(400, |x| if x > 0.37 { 2.0 } else { 0.5 });
    let samples = Measure::Rmse.all_samples(&split, 1, &[1.0]);
    let mut model = template("y = lerp($a, $b, step($c, x))", &[[-5.0, 5.0]; 3]);
    let fit = globally(&mut model, &samples, Measure::Rmse, &GlobalSettings::default());
    assert!(fit.loss < 1e-6, "{fit:?} {:?}", model.0.consts);
    assert!((constant(&model, 2) - 0.37).abs() < 1.0 / 300.0, "{:?}", model.0.consts);
    // Of the first individuals alone, least squares find the levels, and only the simplex the place.
    let few = GlobalSettings { rounds: 1, max_evaluations: 0, ..GlobalSettings::default() };
    let mut model = template("y = lerp($a, $b, step($c, x))", &[[-5.0, 5.0]; 3]);
    let fit = globally(&mut model, &samples, Measure::Rmse, &few);
    assert_eq!(fit.finish, Finish::Simplex, "{fit:?}");
    // No parameter has one.
    let mut model = template("y = 1.5*step($a, x) + 0.5", &[[-5.0, 5.0]]);
    let fit = globally(&mut model, &samples, Measure::Rmse, &GlobalSettings::default());
    assert!(matches!(fit.finish, Finish::Evolution | Finish::Simplex), "{fit:?}");
    assert!(fit.loss < 1e-6, "{fit:?} {:?}", model.0.consts);
}

#[test]
fn a_program_that_is_best_already_stays() {
    let split = sampled(300, |x| 1.5 * (83.0 * x).sin() - 0.25);
    let samples = Measure::Rmse.all_samples(&split, 1, &[1.0]);
    let mut model = template(WAVE, &WAVE_BOUNDS);
    // In the order of the text: the factor, the frequency, the offset.
    for (which, value) in [1.5, 83.0, -0.25].into_iter().enumerate() {
        model.0.consts[model.1[which].index] = value;
    }
    let before = model.0.consts.clone();
    let few = GlobalSettings { rounds: 1, max_evaluations: 0, ..GlobalSettings::default() };
    let fit = globally(&mut model, &samples, Measure::Rmse, &few);
    assert_eq!((fit.finish, model.0.consts), (Finish::Start, before));
    assert!(fit.loss < 1e-9, "{fit:?}");
}

#[test]
fn a_minimum_on_a_bound_is_on_it_and_the_others_make_up_for_it() {
    let samples = Measure::Rmse.all_samples(&sampled(200, |x| 3.0 * x + 1.0), 1, &[1.0]);
    for measure in [Measure::Rmse, Measure::Max] {
        let mut model = template("y = $a*x + $b", &[[0.0, 2.0], [-9.0, 9.0]]);
        globally(&mut model, &samples, measure, &GlobalSettings::default());
        assert_eq!(constant(&model, 0), 2.0, "{measure}");
        // The middle of 3x + 1 − 2x, its mean.
        assert!((constant(&model, 1) - 1.5).abs() < 1e-4, "{measure} {:?}", model.0.consts);
        assert_eq!(model.1[0].bound(2.0), Some(Bound::Upper));
        assert_eq!(model.1[0].bound(0.0), Some(Bound::Lower));
        assert_eq!(model.1[1].bound(1.5), None);
    }
}

#[test]
fn a_parameter_with_one_value_keeps_it() {
    let samples = Measure::Rmse.all_samples(&sampled(200, |x| 3.0 * x + 1.0), 1, &[1.0]);
    let mut model = template("y = $a*x + $b", &[[2.0, 2.0], [-9.0, 9.0]]);
    globally(&mut model, &samples, Measure::Rmse, &GlobalSettings::default());
    assert_eq!(constant(&model, 0), 2.0);
    assert!((constant(&model, 1) - 1.5).abs() < 1e-4, "{:?}", model.0.consts);
}

#[test]
fn a_rate_is_found_over_orders_of_magnitude_on_a_logarithmic_scale() {
    // Where the rate is far off, the model is 0 or 1 and has no slope to follow.
    let samples = Measure::Rmse.all_samples(&sampled(300, |x| (-4000.0 * x).exp()), 1, &[1.0]);
    let loss = |scale: Scale| {
        let (mut draft, mut parameters) = template("y = exp(-$a*x)", &[[1e-3, 1e9]]);
        parameters[0].scale = scale;
        let few = GlobalSettings { rounds: 1, ..GlobalSettings::default() };
        let mut fitter = Fitter::default();
        let measure = Measure::Rmse;
        let fit = fit_globally(&mut fitter, &mut draft, &samples, &parameters, measure, &few);
        (fit.unwrap().loss, draft.consts[parameters[0].index])
    };
    let (found, rate) = loss(Scale::Logarithmic);
    assert!(found < 1e-9 && (rate - 4000.0).abs() < 1.0, "{found} {rate}");
    assert!(loss(Scale::Linear).0 > 1e-7, "{:?}", loss(Scale::Linear));
}

#[test]
fn starts_are_drawn_on_the_parameter_s_scale() {
    let samples = Measure::Rmse.all_samples(&sampled(300, |x| (-4000.0 * x).exp()), 1, &[1.0]);
    let reached = |scale: Scale| {
        let (mut draft, mut parameters) = template("y = exp(-$a*x)", &[[1e-3, 1e9]]);
        parameters[0].scale = scale;
        // From here there is no slope to follow.
        draft.consts[parameters[0].index] = 1e9;
        fit_model(&mut draft, &samples, &parameters, Measure::Rmse, 24, 1).loss
    };
    assert!(reached(Scale::Logarithmic) < 1e-9, "{}", reached(Scale::Logarithmic));
    assert!(reached(Scale::Linear) > 1e-7, "{}", reached(Scale::Linear));
}

#[test]
fn ranges_that_are_none_are_refused() {
    let samples = Measure::Rmse.all_samples(&sampled(30, |x| x), 1, &[1.0]);
    let refused = |bounds: [f32; 2], scale: Scale| {
        let (mut draft, mut parameters) = template("y = $a*x", &[bounds]);
        parameters[0].scale = scale;
        let (mut fitter, settings) = (Fitter::default(), GlobalSettings::default());
        let measure = Measure::Rmse;
        fit_globally(&mut fitter, &mut draft, &samples, &parameters, measure, &settings)
            .unwrap_err()
    };
    assert!(matches!(refused([1.0, 0.0], Scale::Linear), RangeError::OutOfOrder { .. }));
    assert!(matches!(refused([f32::NAN, 0.0], Scale::Linear), RangeError::OutOfOrder { .. }));
    for bounds in [[0.0, 1.0], [-2.0, -1.0], [1.0, f32::INFINITY]] {
        let error = refused(bounds, Scale::Logarithmic);
        assert!(matches!(error, RangeError::NotPositive { .. }), "{bounds:?}: {error}");
    }
}

#[test]
fn unbounded_parameters_are_searched_ten_times_as_far_as_what_is_known() {
    let (infinite, none) = (f32::INFINITY, f32::NEG_INFINITY);
    for (bounds, start, range) in [
        ([none, infinite], 2.0, [-20.0, 20.0]),
        ([none, infinite], 0.0, [-10.0, 10.0]),
        ([0.0, infinite], 1.0, [0.0, 10.0]),
        ([5.0, infinite], 5.0, [5.0, 50.0]),
        ([none, -3.0], -3.0, [-30.0, -3.0]),
        ([-7.0, 2.0], 1.0, [-7.0, 2.0]),
    ] {
        let parameter = Parameter { bounds, ..Parameter::unbounded(0) };
        assert_eq!(parameter.range(start).unwrap().bounds(), range, "{bounds:?}");
    }
    let parameter = Parameter::unbounded(0);
    assert_eq!(parameter.range(f32::MAX).unwrap().bounds()[1], f64::from(f32::MAX));
}

/// The loss of all samples, evaluated anew.
fn loss(draft: &Draft, samples: &Samples) -> f64 {
    let tape = Tape::new(&Program::verify(draft.clone()).unwrap());
    Evaluator::default().loss(&tape, samples, f64::INFINITY).total()
}

#[test]
fn few_samples_come_first_and_all_decide() {
    let noisy = |x: f64| 1.5 * (83.0 * x).sin() - 0.25 + 0.2 * (7919.0 * x).sin();
    let samples = Measure::Rmse.all_samples(&sampled(6000, noisy), 1, &[1.0]);
    let of = |first_rows: usize, max_evaluations: u64| {
        let mut model = template(WAVE, &WAVE_BOUNDS);
        let settings =
            GlobalSettings { first_rows, max_evaluations, rounds: 1, ..GlobalSettings::default() };
        let fit = globally(&mut model, &samples, Measure::Rmse, &settings);
        let again = loss(&model.0, &samples);
        assert!((fit.loss / again - 1.0).abs() < 1e-6, "{first_rows}: {fit:?} {again}");
        fit
    };
    let whole = of(6000, 20_000);
    assert_eq!(whole.sampled, 6000 * whole.evaluations);
    let growing = of(100, 20_000);
    // Most evaluations see a hundred samples, two hundred, and so on to sixteen hundred.
    assert!(growing.sampled < 6000 * growing.evaluations / 8, "{growing:?}");
    assert!((growing.loss / whole.loss - 1.0).abs() < 1e-3, "{growing:?} {whole:?}");
    // Cut off while it still sees a few: what it has is judged on all the same.
    let cut = of(100, 200);
    assert!(cut.sampled < 6000 * cut.evaluations / 2, "{cut:?}");
    assert!(cut.evaluations <= 200 + 30 + 1, "{cut:?}");
}

#[test]
fn some_samples_weigh_and_forgive_as_they_did_among_all() {
    let mut split = sampled(100, |x| x * x);
    split.weights = (0..100).map(|i| 1.0 + i as f32).collect();
    split.dead_zone = vec![(0..100).map(|i| 1e-3 * i as f32).collect()];
    let rows: Vec<u32> = [3, 99, 20, 21, 7, 55].into();
    let draft = template("y = 0.5*x", &[]).0;
    for measure in Measure::ALL {
        let all = measure.all_samples(&split, 1, &[2.0]);
        let some = all.select(&rows);
        let given = measure.samples(&split, 1, &rows, &[2.0]);
        assert_eq!(loss(&draft, &some), loss(&draft, &given), "{measure}");
        assert_eq!(some.total_weight(), all.total_weight() * 0.06, "{measure}");
    }
}

#[test]
fn a_global_fit_does_not_depend_on_threads() {
    let samples = Measure::Rmse.all_samples(&sampled(5000, |x| 1.5 * (83.0 * x).sin()), 1, &[1.0]);
    let settings = GlobalSettings { rounds: 2, max_evaluations: 2000, ..GlobalSettings::default() };
    let of = |threads: usize, measure: Measure| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut model = template(WAVE, &WAVE_BOUNDS);
            let fit = globally(&mut model, &samples, measure, &settings);
            (fit, model.0.consts)
        })
    };
    for measure in [Measure::Rmse, Measure::Max] {
        assert_eq!(of(1, measure), of(3, measure), "{measure}");
    }
}

#[test]
fn a_fitter_serves_one_fit_after_the_other() {
    let (mut fitter, settings) = (Fitter::default(), GlobalSettings::default());
    for slope in [1.0, -2.0, 3.0] {
        let samples = Measure::Rmse.all_samples(&sampled(40, |x| slope * x), 1, &[1.0]);
        let (mut draft, parameters) = template("y = $a*x", &[[-9.0, 9.0]]);
        let measure = Measure::Rmse;
        fit_globally(&mut fitter, &mut draft, &samples, &parameters, measure, &settings).unwrap();
        assert_eq!(f64::from(draft.consts[parameters[0].index]), slope);
    }
}

/// Moré, Garbow and Hillstrom's curves, in `f32`: the published sums of squares.
#[test]
fn published_curves_are_fitted_as_published() {
    let rows = |points: Vec<(f64, f64)>| {
        let (xs, ys) = points.into_iter().map(|(x, y)| (x as f32, y as f32)).unzip();
        Split { columns: vec![xs, ys], ..Split::default() }
    };
    let osborne = mgh::OSBORNE_1.iter().enumerate().map(|(i, y)| (10.0 * i as f64, *y)).collect();
    let bard = (1..).zip(mgh::BARD).map(|(i, y)| (f64::from(i), y)).collect();
    for (name, text, bounds, split) in [
        (
            "kowalik_osborne",
            "y = $a*(x*x + x*$b)/(x*x + x*$c + $d)",
            vec![[0.0, 1.0]; 4],
            rows(mgh::KOWALIK.to_vec()),
        ),
        (
            "osborne_1",
            "y = $a + $b*exp(-$c*x) + $d*exp(-$e*x)",
            vec![[0.0, 1.0], [0.0, 4.0], [0.0, 0.1], [-4.0, 0.0], [0.0, 0.1]],
            rows(osborne),
        ),
        ("bard", "y = $a + x/((16 - x)*$b + min(x, 16 - x)*$c)", vec![[0.0, 5.0]; 3], rows(bard)),
    ] {
        let samples = Measure::Rmse.all_samples(&split, 1, &[1.0]);
        let mut model = template(text, &bounds);
        let fit = globally(&mut model, &samples, Measure::Rmse, &GlobalSettings::default());
        let published = problems::find(name).unwrap().least;
        assert!((fit.loss / published - 1.0).abs() < 1e-3, "{name}: {fit:?} for {published}");
    }
}

#[test]
fn evolution_settings_reach_the_fit() {
    let samples = Measure::Rmse.all_samples(&sampled(60, |x| x), 1, &[1.0]);
    let evaluations = |individuals: usize| {
        let evolution = DifferentialEvolution {
            individuals: Some(individuals),
            max_evaluations: 0,
            ..DifferentialEvolution::default()
        };
        let settings = GlobalSettings { evolution, rounds: 1, ..GlobalSettings::default() };
        let mut model = template("y = $a*x + $b", &[[-9.0, 9.0]; 2]);
        globally(&mut model, &samples, Measure::Rmse, &settings).evaluations
    };
    assert_eq!(evaluations(30) - evaluations(10), 20);
}
