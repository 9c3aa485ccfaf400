//! What is said of functions whose forms are known.

use lgp::dataset::{Axis, Column, Dataset, Origin, Split, axis};
use lgp::explore::{Departure, Finding, Form, OutputReport, Pairing, Verdict, explore};

/// The report of a function on a grid.
fn on_grid<const N: usize>(axes: [Axis; N], function: impl Fn([f64; N]) -> f64) -> OutputReport {
    let data = Dataset::sampled(axes, ["out"], |point| [function(point)]).unwrap();
    explore(&data).outputs.remove(0)
}

/// A function at points that are spread evenly (Roberts 2018, the R sequence), with normal noise.
fn scattered<const N: usize>(
    rows: usize,
    domains: [[f64; 2]; N],
    noise: f64,
    function: impl Fn([f64; N]) -> f64,
) -> Dataset {
    let mut root = 1.0f64;
    (0..50).for_each(|_| root = (1.0 + root).powf(1.0 / (N as f64 + 1.0)));
    let mut columns = vec![Vec::new(); N + 1];
    let mut state = 1u64;
    let mut uniform = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    for row in 0..rows {
        let point: [f64; N] = std::array::from_fn(|i| {
            let place = (0.5 + (row + 1) as f64 * root.powi(-(i as i32 + 1))).fract();
            let [low, high] = domains[i];
            f64::from((low + (high - low) * place) as f32)
        });
        let normal: f64 = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let value = function(point) + noise * normal;
        columns
            .iter_mut()
            .zip(point.into_iter().chain([value]))
            .for_each(|(c, v)| c.push(v as f32));
    }
    let standard_errors = if noise > 0.0 { vec![vec![noise as f32; rows]] } else { Vec::new() };
    let split = Split { columns, standard_errors, ..Split::default() };
    let names = ["x", "y", "z", "u", "v", "w"];
    let inputs = (0..N).map(|i| Column::new(names[i], domains[i])).collect();
    let origin = Origin::Formula { text: "a function, sampled".to_owned() };
    let splits = [split.clone(), split];
    Dataset::of_splits("scattered", origin, inputs, [("out", "1")], splits).unwrap()
}

fn report(data: &Dataset) -> OutputReport {
    explore(data).outputs.remove(0)
}

fn find<'a>(report: &'a OutputReport, form: &Form) -> &'a Finding {
    let found = report.forms.iter().find(|finding| finding.form == *form);
    found.unwrap_or_else(|| panic!("{form:?} was not tested"))
}

#[track_caller]
fn check(report: &OutputReport, form: &Form, verdict: Verdict) -> Departure {
    let finding = find(report, form);
    assert_eq!(finding.verdict, verdict, "{finding:?}, smooth {:?}", report.smooth);
    finding.departure
}

const UNIT: [f64; 2] = [0.0, 1.0];
const AWAY: [f64; 2] = [0.2, 1.0];
const AROUND: [f64; 2] = [-1.0, 1.0];

/// A name, a form, the domains of two inputs, and a function of them that has the form.
type Known = (&'static str, Form, [[f64; 2]; 2], fn([f64; 2]) -> f64);

fn known() -> Vec<Known> {
    let through = |pairing| Form::Through(pairing, 0, 1);
    vec![
        ("product", Form::Product(0), [UNIT, UNIT], |[x, y]| (-2.0 * x).exp() * (1.0 + y * y)),
        ("odd product", Form::Product(0), [AROUND, AROUND], |[x, y]| x * (3.0 * y).sin()),
        ("sum", Form::Sum(0), [UNIT, UNIT], |[x, y]| (3.0 * x).sin() + y.exp()),
        ("x*y", through(Pairing::Product), [UNIT, UNIT], |[x, y]| (4.0 * x * y).sin()),
        ("x/y", through(Pairing::Quotient), [AWAY, AWAY], |[x, y]| 1.0 / (1.0 + (x / y).powi(2))),
        ("x + y", through(Pairing::Sum), [UNIT, UNIT], |[x, y]| (2.0 * (x + y)).sin().exp()),
        ("x - y", through(Pairing::Difference), [UNIT, UNIT], |[x, y]| (4.0 * (x - y)).sin()),
        ("length", through(Pairing::SumOfSquares), [UNIT, UNIT], |[x, y]| (-x * x - y * y).exp()),
        ("symmetric", Form::Symmetric(0, 1), [UNIT, UNIT], |[x, y]| {
            (x * y * 3.0).exp() * (1.0 + x + y).sqrt()
        }),
        ("even", Form::Even(0, 0.0), [AROUND, UNIT], |[x, y]| (x * x * y + y).cos()),
        ("odd", Form::Odd(0, 0.0), [AROUND, UNIT], |[x, y]| (2.0 * x).sin() * (x * x * y).exp()),
    ]
}

#[test]
fn forms_of_known_functions_are_found_on_grids_and_on_scattered_rows() {
    for (name, form, [a, b], function) in known() {
        let axes = [axis("x", a[0]..=a[1]), axis("y", b[0]..=b[1])];
        let report = report(&scattered(3000, [a, b], 0.0, function));
        for report in [on_grid(axes, function), report] {
            let departure = check(&report, &form, Verdict::Holds);
            assert!(departure.residual < 1e-3, "{name}: {departure:?}");
            assert!(!report.templates.is_empty() || name == "symmetric", "{name}");
        }
    }
}

/// Each function with a hundredth of its spread of something else is reported with that figure.
#[test]
fn near_misses_are_told_with_their_size() {
    let known = known().into_iter().filter(|(_, form, ..)| !matches!(form, Form::Product(_)));
    for (name, form, [a, b], function) in known {
        let other = |[x, y]: [f64; 2]| (5.0 * x * y + 2.0 * x + 0.3).sin() - 0.7 * y * (x - 0.2);
        let axes = [axis("x", a[0]..=a[1]), axis("y", b[0]..=b[1])];
        let spread = on_grid(axes.clone(), function).spread;
        let size = on_grid(axes.clone(), other);
        // What of the other function the form itself takes up is not off.
        let share = find(&size, &form).departure.estimate * size.spread;
        let off = |point| function(point) + 0.01 * spread / share * other(point);
        let report = report(&scattered(3000, [a, b], 0.0, off));
        for report in [on_grid(axes, off), report] {
            let departure = check(&report, &form, Verdict::Nearly);
            assert!((departure.estimate - 0.01).abs() < 0.002, "{name}: {departure:?}");
            assert!(departure.low <= 0.011 && departure.high >= 0.009, "{name}: {departure:?}");
        }
    }
}

/// The second term is orthogonal to all changes of the factors, and what is off is all of it.
#[test]
fn a_product_that_is_nearly_one_is_told_with_its_size() {
    for size in [1e-3, 1e-2] {
        let function = |[x, y]: [f64; 2]| {
            x * (3.0 * y).sin() + size * (x * x - 1.0 / 3.0) * (y * y - 1.0 / 3.0)
        };
        let scattered = report(&scattered(3000, [AROUND, AROUND], 0.0, function));
        for report in [on_grid([axis("x", -1.0..=1.0), axis("y", -1.0..=1.0)], function), scattered]
        {
            let expected = size * 4.0 / 45.0 / report.spread;
            let departure = find(&report, &Form::Product(0)).departure;
            assert!((departure.estimate / expected - 1.0).abs() < 0.05, "{departure:?} {expected}");
        }
    }
}

#[test]
fn what_a_function_has_not_fails() {
    let report = on_grid([axis("x", 0.2..=1.0), axis("y", 0.2..=1.0)], |[x, y]| {
        (3.0 * x - y * y).sin() + x * y.exp()
    });
    assert!(report.forms.iter().all(|finding| finding.verdict == Verdict::Fails), "{report:#?}");
    assert!(report.templates.is_empty());
}

#[test]
fn noise_hides_what_is_smaller_and_nothing_else() {
    let product = |[x, y]: [f64; 2]| (-2.0 * x).exp() * (1.0 + y * y);
    let noisy = report(&scattered(4000, [UNIT, UNIT], 0.05, product));
    let noise = noisy.noise.unwrap();
    let departure = check(&noisy, &Form::Product(0), Verdict::Holds);
    assert!((departure.residual / noise - 1.0).abs() < 0.1, "{departure:?}, noise {noise}");
    let off = |[x, y]: [f64; 2]| product([x, y]) + 0.15 * (5.0 * x * y).sin();
    let off = report(&scattered(4000, [UNIT, UNIT], 0.05, off));
    let departure = check(&off, &Form::Product(0), Verdict::Fails);
    assert!(departure.low < departure.estimate && departure.estimate < departure.high);
    // Without standard errors, noise may be structure: nothing can be told.
    let mut unstated = scattered(4000, [UNIT, UNIT], 0.05, product);
    unstated.search.standard_errors.clear();
    check(&report(&unstated), &Form::Product(0), Verdict::Open);
}

#[test]
fn noise_on_a_grid_is_taken_off_where_it_is_stated() {
    let mut state = 7u64;
    let axes = [axis("x", 0.0..=1.0), axis("y", 0.0..=1.0)];
    let mut data = Dataset::sampled(axes, ["z"], |[x, y]| [(1.0 + x) * (2.0 - y).exp()]).unwrap();
    for value in &mut data.search.columns[2] {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        *value += 0.1 * ((state >> 40) as f32 / (1u32 << 24) as f32 - 0.5) * 12f32.sqrt();
    }
    data.search.standard_errors = vec![vec![0.1; data.search.rows()]];
    check(&report(&data), &Form::Product(0), Verdict::Holds);
}

#[test]
fn shares_are_those_of_sobol() {
    // Of x·(1 + 2y): the means over y are 2x, those over x (1 + 2y)/2; and what both leave.
    let function = |[x, y, _]: [f64; 3]| x + 2.0 * x * y;
    let variance = 4.0 / 12.0 + 1.0 / 12.0 + 4.0 / 144.0;
    let expected = [[4.0 / 12.0, 4.0 / 12.0 + 4.0 / 144.0], [1.0 / 12.0, 1.0 / 12.0 + 4.0 / 144.0]];
    let axes = [axis("x", 0.0..=1.0), axis("y", 0.0..=1.0), axis("z", 0.0..=1.0)];
    let by_fit = report(&scattered(3000, [UNIT; 3], 0.0, function));
    for (report, tolerance) in [(on_grid(axes, function), 0.01), (by_fit, 0.02)] {
        for (input, [first, total]) in report.inputs.iter().zip(expected) {
            assert!((input.first.unwrap() - first / variance).abs() < tolerance, "{input:?}");
            assert!((input.total.unwrap() - total / variance).abs() < tolerance, "{input:?}");
            assert!(!input.needless);
        }
        assert!(report.inputs[2].needless && report.inputs[2].total.unwrap() < 1e-6);
        assert_eq!(report.templates[0].formula, "out = f(x)*g(y)");
    }
}

#[test]
fn an_input_that_others_determine_can_be_left_out_but_not_all_of_them() {
    let mut data = scattered(3000, [UNIT; 3], 0.0, |[x, y, _]| (3.0 * x).sin() * y + x);
    let sum: Vec<f32> =
        (0..3000).map(|i| data.search.columns[0][i] + data.search.columns[1][i]).collect();
    data.search.columns[2] = sum;
    let report = report(&data);
    let [x, y, z] = &report.inputs[..] else { panic!() };
    assert!([x, y, z].iter().all(|input| input.verdict == Some(Verdict::Holds)));
    assert_eq!([x, y, z].iter().filter(|input| input.needless).count(), 1);
}

#[test]
fn several_forms_make_one_template() {
    let formula = |report: OutputReport| report.templates.first().map(|t| t.formula.clone());
    let domains = [AROUND, UNIT, UNIT];
    let axes = || [axis("x", -1.0..=1.0), axis("r", 0.0..=1.0), axis("v", 0.0..=1.0)];
    let even = |[x, r, v]: [f64; 3]| (-x * x).exp() * (1.0 + r * v).ln();
    let found = formula(on_grid(axes(), even)).unwrap();
    assert!(found == "out = f(abs(x))*g(r*v)" || found == "out = f(r*v)*g(abs(x))", "{found}");
    let odd = |[x, r, v]: [f64; 3]| (2.0 * x).sin() * (r - v).exp() * (1.0 + r);
    let data = scattered(4000, domains, 0.0, odd);
    assert_eq!(formula(report(&data)).unwrap(), "out = x*f(x^2)*g(y)*h(z)");
    let masking = |[l, v, a]: [f64; 3]| 1.0 / ((1.0 + l * a) * (1.0 + v * a));
    let axes = [axis("l", 0.0..=1.0), axis("v", 0.0..=1.0), axis("f", 0.0..=1.0)];
    // The hole is not called like the column `f`.
    assert_eq!(formula(on_grid(axes, masking)).unwrap(), "out = g(l, f)*g(v, f)");
}

#[test]
fn periods_are_found_on_grids_and_scattered_rows() {
    let wave = |[x, y]: [f64; 2]| ((7.3 * x).sin() + 0.5 * (14.6 * x).cos()) * (1.0 + y);
    let axes = [axis("x", 0.0..=3.0), axis("y", 0.0..=1.0)];
    let data = scattered(4000, [[0.0, 3.0], UNIT], 0.0, wave);
    for report in [on_grid(axes, wave), report(&data)] {
        let period = report.forms.iter().find_map(|finding| match finding.form {
            Form::Periodic(0, period) => Some(period),
            _ => None,
        });
        let period = period.expect("a period");
        assert!((period - std::f64::consts::TAU / 7.3).abs() < 1e-3, "{period}");
    }
}

#[test]
fn rough_functions_are_separated_on_grids_and_open_elsewhere() {
    let rough =
        |[x, y]: [f64; 2]| ((37.0 * x).sin().signum() + 2.0) * ((41.0 * y).cos().signum() + 3.0);
    let axes = [axis("x", 0.0..=1.0), axis("y", 0.0..=1.0)];
    check(&on_grid(axes, rough), &Form::Product(0), Verdict::Holds);
    check(&report(&scattered(3000, [UNIT, UNIT], 0.0, rough)), &Form::Product(0), Verdict::Open);
}

#[test]
fn weights_say_which_rows_count() {
    let axes = [axis("x", 0.0..=1.0), axis("y", 0.0..=1.0)];
    let function =
        |[x, y]: [f64; 2]| if x > 0.8 { 1.0 + x * x + (9.0 * x * y).sin() } else { (1.0 + x) * y };
    let mut data = Dataset::sampled(axes, ["z"], |point| [function(point)]).unwrap();
    check(&report(&data), &Form::Product(0), Verdict::Fails);
    data.search.weights =
        data.search.columns[0].iter().map(|&x| f32::from(u8::from(x <= 0.8))).collect();
    check(&report(&data), &Form::Product(0), Verdict::Holds);
    data.search.grid.clear();
    check(&report(&data), &Form::Product(0), Verdict::Holds);
}

#[test]
fn constants_and_single_inputs_are_no_trouble() {
    let one = on_grid([axis("x", -1.0..=1.0)], |[x]| (x * x).exp());
    check(&one, &Form::Even(0, 0.0), Verdict::Holds);
    assert_eq!(one.templates[0].formula, "out = f(abs(x))");
    let flat = on_grid([axis("x", 0.0..=1.0)], |_| 3.0);
    assert!(flat.smooth.is_none() && flat.forms.is_empty() && flat.templates.is_empty());
    let mut data = scattered(500, [UNIT, UNIT], 0.0, |[x, _]| x.exp());
    data.search.columns[1].fill(0.5);
    let report = report(&data);
    assert!(report.inputs[1].constant && report.inputs[1].first.is_none());
    assert!(report.inputs[0].first.unwrap() > 0.999);
}

#[test]
fn few_rows_many_inputs_and_many_outputs_are_no_trouble() {
    for rows in 1..12 {
        report(&scattered(rows, [UNIT, UNIT], 0.0, |[x, y]| x + y));
    }
    let names: Vec<String> = (0..40).map(|i| format!("x{i}")).collect();
    let mut data = scattered(2000, [UNIT; 6], 0.0, |[x, y, z, ..]| x * y + z);
    let row = |i: usize, row: usize| ((row as f32 + 1.0) * (0.37 + 0.011 * i as f32)).fract();
    let mut columns: Vec<Vec<f32>> =
        (0..34).map(|i| (0..2000).map(|at| row(i, at)).collect()).collect();
    columns.append(&mut data.search.columns);
    data.search.columns = columns;
    data.validation = data.search.clone();
    data.inputs = names.iter().map(|name| Column::new(name, UNIT)).collect();
    data.validate().unwrap();
    let found = report(&data);
    assert!(found.inputs[34].first.is_some(), "{:?}", found.inputs[34]);
    assert_eq!(found.inputs.iter().filter(|input| input.first.is_some()).count(), 20);
}

#[test]
fn the_same_data_give_the_same_report() {
    let data = scattered(3000, [UNIT, AWAY, UNIT], 0.02, |[x, y, z]| (x * y).sin() + z);
    assert_eq!(explore(&data), explore(&data));
}
