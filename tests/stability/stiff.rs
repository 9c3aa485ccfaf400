//! The hard points of the reference table: what goes wrong there is found, and named.

use lgp::eval::Half;
use lgp::num::Interval;
use lgp::program::{Names, Program, parse};
use lgp::stability::{
    Bound, Cause, Limits, Precision, PrecisionLoss, Property, Rounding, Status, half_error,
    must_stay_single, prove,
};

/// A row: inputs by name, the reference (none where it is words), and what single and half gave
/// there, each with its relative error.
struct Row {
    family: String,
    inputs: Vec<(String, f32)>,
    reference: Option<f64>,
    single: Option<f64>,
    half: Option<f64>,
    errors: [Option<f64>; 2],
}

/// What counts as wrong, in relative error, for single and half precision.
const WRONG: [f64; 2] = [1e-3, 5e-2];

fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            c => fields.last_mut().unwrap().push(c),
        }
    }
    fields
}

fn rows() -> Vec<Row> {
    let text = include_str!("../reference/stiff_cases.csv");
    let row = |line: &str| {
        let fields = fields(line);
        let number = |i: usize| fields[i].parse::<f64>().ok();
        let first = |text: &str| text.split(' ').next().unwrap().trim_end_matches('f').parse().ok();
        let inputs = match first(&fields[1]) {
            Some(x) => vec![("x".to_owned(), x)],
            None => {
                let pairs = fields[1].split(' ').filter_map(|pair| pair.split_once('='));
                let value = |text: &str| text.trim_end_matches('f').parse().ok();
                pairs.filter_map(|(name, x)| Some((name.to_owned(), value(x)?))).collect()
            }
        };
        Row {
            family: fields[0].clone(),
            inputs,
            reference: number(2),
            single: number(3),
            half: number(5),
            errors: [number(4), number(6)],
        }
    };
    text.lines().skip(1).map(row).collect()
}

/// The form that the table's family names; nothing of the rows that are words about `pow`.
fn form(family: &str) -> Option<&'static str> {
    Some(match family {
        // So that no square of alpha is flushed.
        "D_GGX stable f16" => {
            "t = (alpha*nh)^2 + (1 - nh)*(1 + nh); q = alpha/t; y = q*q/3.14159265"
        }
        "D_GGX naive f16" => return form("D_GGX naive"),
        "D_GGX naive" => "a2 = alpha*alpha; t = nh*nh*(a2 - 1) + 1; y = a2/(3.14159265*t*t)",
        "D_GGX stable" => {
            "a2 = alpha*alpha; t = a2*nh*nh + (1 - nh)*(1 + nh); y = a2/(3.14159265*t*t)"
        }
        "V_SmithCorr" => {
            "a2 = alpha*alpha; y = 0.5/(nl*sqrt(a2 + (1 - a2)*nv*nv) + nv*sqrt(a2 + (1 - a2)*nl*nl))"
        }
        family if family.starts_with("G2 Hammon") => "y = 2*nl*nv/lerp(2*nl*nv, nl + nv, alpha)",
        family if family.starts_with("area norm") => {
            "y = 1/(0.962406 + 0.375892*t/pow(alpha, 1.4841))"
        }
        "exp2" => "y = exp2(x)",
        "sqrt(1-c*c)" => "y = sqrt(1 - c*c)",
        "tan(w/2) from cos w = sqrt(1-c^2)/(1+c)" => "y = sqrt(1 - c*c)/(1 + c)",
        "tan(w/2) = sqrt((1-c)/(1+c))" => "y = sqrt((1 - c)/(1 + c))",
        "Lambda_GGX" => "a2 = alpha*alpha; y = (sqrt(a2 + (1 - a2)*cos*cos)/cos - 1)/2",
        "Lambda_GGX rationalised" => {
            "a2 = alpha*alpha; y = a2*(1 - cos*cos)/(2*cos*(sqrt(a2 + (1 - a2)*cos*cos) + cos))"
        }
        "D_Beckmann" => {
            "a2 = alpha*alpha; c2 = nh*nh; y = exp(-((1 - c2)/(c2*a2)))/(3.14159265*a2*c2*c2)"
        }
        family if family.starts_with("SG integral") => "y = 6.2831853*(1 - exp(-2*lambda))/lambda",
        family if family.starts_with("SG sample") => {
            "y = (lambda + log(1 + (exp(-2*lambda) - 1)*xi))/lambda"
        }
        "pow" => return None,
        other => panic!("no form for {other}"),
    })
}

fn program(row: &Row) -> Option<Program> {
    let names = Names::new(row.inputs.iter().map(|(name, _)| name.as_str()), ["y"]);
    Some(parse(form(&row.family)?, &names).unwrap())
}

/// The point itself: beside it the table's figures need not hold.
fn domain(row: &Row) -> Vec<Interval> {
    row.inputs.iter().map(|&(_, x)| Interval::new(x, x)).collect()
}

/// Whether the table has it wrong: no number, or too large an error where it has one.
fn wrong(value: Option<f64>, error: Option<f64>, reference: Option<f64>, limit: f64) -> bool {
    let Some(value) = value else { return false };
    let error = error.or(reference.map(|exact| ((value - exact) / exact).abs()));
    !value.is_finite() || error.is_some_and(|error| error.is_nan() || error.abs() > limit)
}

fn is_named(loss: &PrecisionLoss) -> bool {
    loss.blame.instruction.is_some() && loss.blame.cause != Cause::Rounding
}

#[test]
fn what_the_table_has_wrong_is_found_and_named_and_nothing_else() {
    let mut mismatches = Vec::new();
    let mut found = [0, 0];
    for row in rows() {
        let Some(program) = program(&row) else { continue };
        let domain = domain(&row);
        let claim = [Property::of(0, Bound::Finite)];
        let finite = prove(&program, &domain, &claim, &Limits::new(Rounding::Exact)).remove(0);
        let refuted = matches!(finite, Status::Refuted { .. });
        let single = Precision::single(&program, &domain);
        // The table's halves keep denormals.
        let half = Precision::in_halves(&program, &domain, &[Half::default()]);
        for (k, (what, value, worst)) in
            [("f32", row.single, single), ("f16", row.half, half)].into_iter().enumerate()
        {
            let loss = worst.not_finite.or(worst.relative).unwrap();
            let expected = wrong(value, row.errors[k], row.reference, WRONG[k]);
            if value.is_none() {
                continue;
            }
            let seen = refuted || !loss.found.is_finite() || loss.relative() > WRONG[k];
            found[k] += usize::from(seen);
            if seen != expected || seen && !refuted && !is_named(&loss) {
                mismatches.push(format!(
                    "{} {:?} {what}: table {value:?}, expected {expected}, relative error {:e}, {:?}",
                    row.family,
                    row.inputs,
                    loss.relative(),
                    loss
                ));
            }
        }
    }
    println!("found: {} in f32, {} in f16", found[0], found[1]);
    assert!(mismatches.is_empty(), "{} mismatches:\n{}", mismatches.len(), mismatches.join("\n"));
}

/// The same over neighbourhoods: whatever is wrong at a point is found in a box around it.
#[test]
fn what_is_wrong_at_a_point_is_found_in_its_neighbourhood() {
    for row in rows() {
        let Some(program) = program(&row) else { continue };
        if !wrong(row.single, row.errors[0], row.reference, WRONG[0]) {
            continue;
        }
        let around = |&(_, x): &(String, f32)| Interval::new(x - x.abs() * 1e-6, x);
        let domain: Vec<Interval> = row.inputs.iter().map(around).collect();
        let claim = [Property::of(0, Bound::Finite)];
        let finite = prove(&program, &domain, &claim, &Limits::new(Rounding::Exact)).remove(0);
        let worst = Precision::single(&program, &domain);
        let loses = worst.relative.as_ref().is_some_and(|loss| loss.relative() > WRONG[0]);
        let seen = matches!(finite, Status::Refuted { .. }) || worst.not_finite.is_some() || loses;
        assert!(seen, "{} {:?}: {worst:?}", row.family, row.inputs);
    }
}

#[test]
fn powers_of_zero_and_of_what_is_just_below() {
    let names = Names::new(["x", "y"], ["f"]);
    let program = parse("f = pow(x, y)", &names).unwrap();
    let finite = |x: [f32; 2], y: [f32; 2]| {
        let domain = [x, y].map(|[low, high]| Interval::new(low, high));
        let claim = [Property::of(0, Bound::Finite)];
        prove(&program, &domain, &claim, &Limits::new(Rounding::Gpu)).remove(0)
    };
    assert!(matches!(finite([0.0, 0.0], [0.0, 0.0]), Status::Refuted { .. }));
    assert!(matches!(finite([-1e-8, -1e-8], [5.0, 5.0]), Status::Refuted { .. }));
    assert_eq!(finite([0.0, 0.0], [5.0, 5.0]), Status::Proved);
    assert!(matches!(finite([0.0, 1.0], [0.0, 5.0]), Status::Refuted { .. }));
    assert_eq!(finite([0.0, 1.0], [0.5, 5.0]), Status::Proved);
}

#[test]
fn the_least_that_must_stay_in_single_precision_is_what_cancels() {
    let names = Names::new(["nh", "alpha"], ["d"]);
    let text = "a2 = alpha*alpha; t = nh*nh*(a2 - 1) + 1; d = 0.01*a2/(t*t)";
    let program = parse(text, &names).unwrap();
    let domain = [Interval::new(0.0, 1.0), Interval::new(0.1, 1.0)];
    let loose = must_stay_single(&program, &domain, 10.0).unwrap();
    assert!(loose.is_empty(), "{loose:?}");
    let tight = must_stay_single(&program, &domain, 0.01).unwrap();
    assert!(!tight.is_empty() && tight.len() < program.instrs.len(), "{tight:?}");
    assert_eq!(must_stay_single(&program, &domain, 0.0), None);
    let corner = [[1.0f32, 0.1]];
    assert!(half_error(&program, corner.iter().map(|point| &point[..])) > 0.01);
}
