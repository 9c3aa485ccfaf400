//! Projections: surfaces that are known, optima that are hard to find or jump, the same bytes
//! however the work was shared out or interrupted.

use lgp::dataset::{Column, Dataset, Origin, Split, axis};
use lgp::deadline::{Deadline, Stop};
use lgp::project::{Error, Projection, Settings, State, Surfaces};

fn names(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

fn bounds(name: &str, low: f32, high: f32) -> (String, [f32; 2]) {
    (name.to_owned(), [low, high])
}

fn done(projection: &Projection) -> Surfaces {
    let mut state = projection.begin();
    assert!(projection.advance(&mut state, &Deadline::NEVER, &mut |_, _| {}));
    projection.surfaces(&state).unwrap()
}

/// The values of a parameter, and those of a function of the places, over both splits.
fn pairs(surfaces: &Surfaces, parameter: usize, f: impl Fn(&[f32]) -> f64) -> Vec<(f64, f64)> {
    let all = surfaces.search.iter().chain(&surfaces.validation);
    all.map(|place| (place.values[parameter].into(), f(&place.at))).collect()
}

fn largest_error(pairs: &[(f64, f64)]) -> f64 {
    pairs.iter().map(|(found, exact)| (found - exact).abs()).fold(0.0, f64::max)
}

/// Rows of a function on a grid of points along each input, in both splits.
fn rows(inputs: &[(&str, Vec<f32>)], shift: f32, f: impl Fn(&[f64]) -> f64) -> Dataset {
    let columns: Vec<Column> =
        inputs.iter().map(|(name, _)| Column::new(name, [-9.0, 9.0])).collect();
    let split = |shift: f32| {
        let along: Vec<Vec<f32>> = inputs
            .iter()
            .map(|(_, values)| values.iter().map(|value| value + shift).collect())
            .collect();
        Split::on_grid(&along, |point| [f(point)])
    };
    let splits = [split(0.0), split(shift)];
    let origin = Origin::Formula { text: "rows".into() };
    Dataset::of_splits("rows", origin, columns, [("y", "1")], splits).unwrap()
}

fn evenly(count: u32, from: f32, to: f32) -> Vec<f32> {
    (0..count).map(|i| from + (to - from) * i as f32 / (count - 1) as f32).collect()
}

#[test]
fn surfaces_that_are_known_are_found() {
    let axes = [axis("x", -1.0..=1.0), axis("a", 0.1..=1.0), axis("b", 0.0..=2.0)];
    let amplitude = |at: &[f32]| f64::from(at[1]) + 0.5 * f64::from(at[0]).powi(2);
    let width = |at: &[f32]| 1.0 + 6.0 * f64::from(at[0]) + f64::from(at[1]);
    let data = Dataset::sampled(axes, ["y", "z"], |[x, a, b]| {
        let at = [a as f32, b as f32];
        let lobe = amplitude(&at) * (-width(&at) * x * x).exp2();
        [lobe, 2.0 * width(&at) * x]
    })
    .unwrap();
    // The last of --over varies fastest, however the data have them.
    for (over, swapped) in [(["a", "b"], false), (["b", "a"], true)] {
        let text = "y = $p*exp2(-$q*x^2)";
        let projection = Projection::new(&data, text, &names(&over), Settings::default()).unwrap();
        let surfaces = done(&projection);
        let plain = |at: &[f32]| if swapped { vec![at[1], at[0]] } else { at.to_vec() };
        assert!(largest_error(&pairs(&surfaces, 0, |at| amplitude(&plain(at)))) < 1e-5);
        assert!(largest_error(&pairs(&surfaces, 1, |at| width(&plain(at)))) < 1e-3);
        let found = surfaces.dataset(&projection).unwrap();
        assert_eq!(found.names().inputs, over);
        assert_eq!(found.names().outputs, ["p", "q", "residual"]);
        assert_eq!((found.search.grid.as_slice(), found.search.rows()), (&[16, 16][..], 256));
        assert_eq!(
            (found.validation.grid.as_slice(), found.validation.rows()),
            (&[26, 26][..], 676)
        );
        assert!(surfaces.notes.is_empty(), "{:?}", surfaces.notes);
        assert!(surfaces.rmse() < 1e-6);
    }
    // Two outputs share a parameter.
    let both = "y = $p*exp2(-$q*x^2); z = 2*$q*x";
    let projection =
        Projection::new(&data, both, &names(&["a", "b"]), Settings::default()).unwrap();
    assert_eq!(projection.model().outputs(), ["y", "z"]);
    assert!(largest_error(&pairs(&done(&projection), 1, width)) < 1e-5);
}

/// Waves, whose frequency has many local optima.
fn waves() -> (Dataset, Settings) {
    let inputs = [("a", evenly(9, 0.0, 1.0)), ("x", evenly(64, 0.0, 1.0))];
    let data = rows(&inputs, 0.007, |at| ((60.0 + 30.0 * at[0] * at[0]) * at[1]).sin());
    (data, Settings { bounds: vec![bounds("f", 0.0, 150.0)], ..Settings::default() })
}

#[test]
fn where_local_fits_miss_the_optimum_a_global_one_finds_it() {
    let (data, settings) = waves();
    let projection = Projection::new(&data, "y = sin($f*x)", &names(&["a"]), settings).unwrap();
    let found = pairs(&done(&projection), 0, |at| 60.0 + 30.0 * f64::from(at[0]).powi(2));
    assert!(largest_error(&found) < 1e-2, "{found:?}");
}

#[test]
fn from_coarse_to_fine_is_as_good_as_brute_force() {
    let inputs =
        [("a", evenly(12, 0.0, 1.0)), ("b", evenly(11, 0.0, 1.0)), ("x", evenly(48, -1.0, 1.0))];
    let data = rows(&inputs, 0.01, |at| {
        let [a, b, x] = [at[0], at[1], at[2]];
        (1.0 + a) * (-(2.0 + 8.0 * b) * (x - 0.5 * a + 0.2 * b).powi(2)).exp()
            + 0.05 * (9.0 * x).sin()
    });
    let text = "y = $p*exp(-$q*(x - $c)^2)";
    let settings = Settings {
        bounds: vec![bounds("p", 0.0, 5.0), bounds("q", 0.1, 40.0), bounds("c", -1.0, 1.0)],
        ..Settings::default()
    };
    let over = names(&["a", "b"]);
    let projection = Projection::new(&data, text, &over, settings.clone()).unwrap();
    let brute =
        Projection::new(&data, text, &over, Settings { everywhere: true, ..settings }).unwrap();
    let (levels, brute) = (done(&projection), done(&brute));
    for (one, other) in levels.search.iter().zip(&brute.search) {
        let apart = (one.residual - other.residual).abs();
        assert!(apart <= 1e-3 * other.residual, "{one:?} {other:?}");
        for (a, b) in one.values.iter().zip(&other.values) {
            assert!((a - b).abs() < 2e-2 * b.abs().max(0.1), "{one:?} {other:?}");
        }
    }
}

/// Two lobes in mirror image, of which first the one and then the other is the higher by little.
fn lobes(noise: f64) -> Dataset {
    let inputs = [("a", evenly(33, 0.0, 1.0)), ("x", evenly(65, -1.0, 1.0))];
    rows(&inputs, 0.004, |at| {
        let [a, x] = [at[0], at[1]];
        let lobe = |centre: f64| (-40.0 * (x - centre).powi(2)).exp();
        let lead = noise * (17.0 * a).sin();
        (1.0 + lead) * lobe(0.5 + 0.1 * a) + (1.0 - lead) * lobe(-0.5 - 0.1 * a)
    })
}

#[test]
fn smoothing_removes_jumps_between_optima_that_are_nearly_equal() {
    let data = lobes(0.01);
    let text = "y = exp(-40*(x - $c)^2)";
    let project = |smooth: f64| {
        let settings =
            Settings { bounds: vec![bounds("c", -1.0, 1.0)], smooth, ..Settings::default() };
        done(&Projection::new(&data, text, &names(&["a"]), settings).unwrap())
    };
    let jumps = |surfaces: &Surfaces| {
        let centres = surfaces.search.iter().map(|place| place.values[0]);
        let centres: Vec<f32> = centres.collect();
        centres.windows(2).filter(|pair| (pair[1] - pair[0]).abs() > 0.5).count()
    };
    let (rough, smooth) = (project(0.0), project(0.1));
    assert!(jumps(&rough) >= 4, "{}", jumps(&rough));
    assert_eq!(jumps(&smooth), 0);
    let side = smooth.search[0].values[0].signum();
    assert!(smooth.validation.iter().all(|place| place.values[0].signum() == side));
    // It costs no more than the difference of the lobes, and what remains is close to its optimum.
    assert!(smooth.rmse() < rough.rmse() * 1.1, "{} {}", smooth.rmse(), rough.rmse());
    for place in &smooth.search {
        let exact = 0.5 + 0.1 * place.at[0];
        assert!((place.values[0].abs() - exact).abs() < 0.03, "{place:?}");
    }
}

#[test]
fn equal_optima_continue_their_neighbours() {
    let data = lobes(0.0);
    let settings = Settings { bounds: vec![bounds("c", -1.0, 1.0)], ..Settings::default() };
    let text = "y = exp(-40*(x - $c)^2)";
    let surfaces = done(&Projection::new(&data, text, &names(&["a"]), settings).unwrap());
    let all = surfaces.search.iter().chain(&surfaces.validation);
    let sides: Vec<f32> = all.map(|place| place.values[0].signum()).collect();
    assert!(sides.windows(2).all(|pair| pair[0] == pair[1]), "{sides:?}");
}

#[test]
fn the_same_at_any_number_of_threads_and_wherever_it_was_interrupted() {
    let data = lobes(0.05);
    for smooth in [0.0, 1e-2] {
        let settings = Settings { smooth, ..Settings::default() };
        let text = "y = $p*exp(-40*(x - $c)^2)";
        let projection = Projection::new(&data, text, &names(&["a"]), settings).unwrap();
        let bytes = |surfaces: Surfaces| {
            surfaces.dataset(&projection).unwrap().to_bytes("p.bin".as_ref()).unwrap()
        };
        let whole = bytes(done(&projection));
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert!(pool.install(|| bytes(done(&projection))) == whole, "{threads}");
        }
        // Each run is stopped after its first look at what is done.
        let mut state: State = projection.begin();
        let mut stops = 0;
        loop {
            let stop = Stop::default();
            let deadline = Deadline::NEVER.or_request(&stop);
            let is_done = projection.advance(&mut state, &deadline, &mut |_, _| {
                stop.request();
            });
            state = projection.resume(&projection.save(&state)).unwrap();
            if is_done {
                break;
            }
            stops += 1;
        }
        assert!(stops >= 4, "{stops}");
        assert!(bytes(projection.surfaces(&state).unwrap()) == whole);
        let mut other = Settings { smooth: smooth + 1.0, ..Settings::default() };
        let refused = |settings: Settings| {
            let other = Projection::new(&data, text, &names(&["a"]), settings).unwrap();
            matches!(other.resume(&projection.save(&state)), Err(Error::OtherState))
        };
        assert!(refused(other.clone()));
        other.smooth = smooth;
        other.bounds.push(bounds("c", 0.0, 1.0));
        assert!(refused(other));
    }
}

#[test]
fn a_grid_with_holes_still_works_and_says_which() {
    let inputs =
        [("a", evenly(5, 0.0, 1.0)), ("b", evenly(4, 0.0, 3.0)), ("x", evenly(9, 0.0, 1.0))];
    let mut data = rows(&inputs, 0.0, |at| (1.0 + at[0]) * at[2] + at[1]);
    for split in [&mut data.search, &mut data.validation] {
        let hole = |row: usize| split.columns[0][row] == 0.5 && split.columns[1][row] == 2.0;
        let kept: Vec<usize> = (0..split.rows()).filter(|&row| !hole(row)).collect();
        for column in &mut split.columns {
            *column = kept.iter().map(|&row| column[row]).collect();
        }
        split.grid.clear();
    }
    let text = "y = $p*x + $q";
    let projection =
        Projection::new(&data, text, &names(&["a", "b"]), Settings::default()).unwrap();
    let surfaces = done(&projection);
    assert!(largest_error(&pairs(&surfaces, 0, |at| 1.0 + f64::from(at[0]))) < 1e-5);
    let notes = surfaces.notes.join("\n");
    assert!(notes.contains("1 of 20 places of the grid have no group: a = 0.5, b = 2"), "{notes}");
    assert!(notes.contains("every fourth group is held back"), "{notes}");
    let found = surfaces.dataset(&projection).unwrap();
    assert!(found.search.grid.is_empty());
    assert_eq!(found.search.rows() + found.validation.rows(), 19);
    assert!((4..=6).contains(&found.validation.rows()), "{}", found.validation.rows());
}

#[test]
fn groups_with_too_few_rows_are_left_out_or_smoothed() {
    let inputs = [("a", evenly(9, 0.0, 1.0)), ("x", evenly(8, 0.0, 1.0))];
    let mut data = rows(&inputs, 0.01, |at| (1.0 + at[0]) * at[1] + 0.5);
    // One row of the third group is left.
    let split = &mut data.search;
    let kept: Vec<usize> = (0..split.rows()).filter(|row| row / 8 != 2 || row % 8 == 3).collect();
    for column in &mut split.columns {
        *column = kept.iter().map(|&row| column[row]).collect();
    }
    split.grid.clear();
    let project = |data: &Dataset, smooth: f64| {
        let settings = Settings { smooth, ..Settings::default() };
        Projection::new(data, "y = $p*x + $q", &names(&["a"]), settings)
    };
    let alone = done(&project(&data, 0.0).unwrap());
    assert_eq!((alone.search.len(), alone.grid.len()), (8, 0));
    assert!(
        alone.notes[0].contains("1 of 9 groups have fewer values than the 2 parameters: a = 0.25")
    );
    let smooth = done(&project(&data, 1e-6).unwrap());
    assert_eq!((smooth.search.len(), smooth.grid.as_slice()), (9, &[9][..]));
    assert!((smooth.search[2].values[0] - 1.25).abs() < 0.02, "{:?}", smooth.search[2]);
    let mut thin = rows(&[("a", evenly(9, 0.0, 1.0)), ("x", vec![0.5])], 0.01, |at| at[0]);
    assert!(matches!(
        project(&thin, 0.0),
        Err(Error::AllThin { groups: 9, most: 1, parameters: 2 })
    ));
    assert!(matches!(project(&thin, 1.0), Err(Error::AllThin { .. })));
    thin.search.columns[0].fill(1.0);
    assert!(matches!(project(&thin, 0.0), Err(Error::OneGroup { .. })));
}

#[test]
fn scattered_groups_are_projected_from_the_nearest() {
    let mut columns = vec![Vec::new(); 4];
    for group in 0..60u32 {
        let a = (0.618_034 * f64::from(group)).fract() as f32;
        let b = (0.754_878 * f64::from(group)).fract() as f32;
        for i in 0..12 {
            let x = i as f32 / 11.0;
            let y = (1.0 + a + b) * (-3.0 * b * x).exp();
            columns.iter_mut().zip([a, b, x, y]).for_each(|(column, value)| column.push(value));
        }
    }
    let split = Split { columns, ..Split::default() };
    let inputs = ["a", "b", "x"].map(|name| Column::new(name, [0.0, 1.0])).to_vec();
    let origin = Origin::Formula { text: "rows".into() };
    let splits = [split.clone(), split];
    let data = Dataset::of_splits("rows", origin, inputs, [("y", "1")], splits).unwrap();
    let settings = Settings { smooth: 1e-9, ..Settings::default() };
    let over = names(&["a", "b"]);
    let projection = Projection::new(&data, "y = $p*exp(-$q*x)", &over, settings).unwrap();
    let surfaces = done(&projection);
    let exact = |at: &[f32]| f64::from(1.0 + at[0] + at[1]);
    assert!(largest_error(&pairs(&surfaces, 0, exact)) < 1e-2);
    assert!(surfaces.notes[0].contains("on no grid"), "{:?}", surfaces.notes);
    let found = surfaces.dataset(&projection).unwrap();
    assert_eq!([found.search.rows(), found.validation.rows()], [45, 15]);
}

#[test]
fn a_proposal_has_functions_of_what_parameters_depend_on() {
    let inputs =
        [("a", evenly(9, 0.25, 1.0)), ("b", evenly(8, 0.0, 1.0)), ("x", evenly(16, 0.0, 1.0))];
    let proposal = |text: &str, f: &dyn Fn(&[f64]) -> f64| {
        let data = rows(&inputs, 0.01, f);
        let over = names(&["a", "b"]);
        let projection = Projection::new(&data, text, &over, Settings::default()).unwrap();
        let surfaces = done(&projection);
        let found = projection.proposal(&surfaces, &projection.dependences(&surfaces));
        (found.template.unwrap(), found.guess)
    };
    // A sum of both, a power of one.
    let lobe = |at: &[f64]| (1.5 + 2.0 * at[0] - at[1]) * (-at[0].powi(-2) * at[2].powi(2)).exp2();
    let (template, guess) = proposal("y = $p*exp2(-$q*x^2)", &lobe);
    assert_eq!(template, "y = p(a, b)*exp2(-q(a)*x^2)");
    assert!(guess.starts_with("p(a, b) = 1.5 + 2*a - 1*b; q(a) = exp2("), "{guess}");
    assert!(guess.ends_with("- 2*log2(a))"), "{guess}");
    // An exponential, a constant, names that are taken.
    let (template, guess) =
        proposal("p = $max*x; y = p + $q", &|at| (3.0 * at[1]).exp2() * at[2] + 0.5);
    assert_eq!(template, "p = max_(b)*x; y = p + $q");
    assert!(guess.contains("max_(b) = exp2(") && guess.contains("+ 3*b)"), "{guess}");
    assert!(guess.contains("$q = 0.5"), "{guess}");
}
