//! What is known to be wrong with published formulas is found, each with an input that does it.

use lgp::dataset::{Dataset, Incumbent, incumbents_for};
use lgp::num::Interval;
use lgp::program::{Names, parse};
use lgp::stability::{Bound, Limits, Property, Rounding, Status, prove};
use std::path::Path;

fn incumbent(name: &str) -> Incumbent {
    let path = Path::new("datasets/dfg.bin");
    let known = incumbents_for(path, &Dataset::load(path).unwrap()).unwrap();
    known.into_iter().map(|known| known.incumbent).find(|known| known.name == name).unwrap()
}

/// What becomes of a claim about an expression in the outputs and f0, all inputs in [0, 1].
fn claim(name: &str, expression: &str, bound: Bound, rounding: Rounding) -> Status {
    let text = incumbent(name).formula + "; claimed = " + expression;
    let names = Names::new(["n_dot_v", "roughness", "f0"], ["scale", "bias", "claimed"]);
    let program = parse(&text, &names).unwrap();
    let domain = [Interval::new(0.0, 1.0); 3];
    prove(&program, &domain, &[Property::of(2, bound)], &Limits::new(rounding)).remove(0)
}

/// The least excess that a refutation must show.
fn assert_refuted(name: &str, expression: &str, bound: Bound, least: f64) {
    for rounding in [Rounding::Exact, Rounding::Gpu] {
        let status = claim(name, expression, bound, rounding);
        let Status::Refuted { input, value } = status else {
            panic!("{name}: {expression}: {status:?}")
        };
        let excess = Property::of(0, bound).excess(value, 0.0);
        assert!(excess >= least, "{name}: {expression} is {value} at {input:?}");
    }
}

#[test]
fn karis_leaves_the_unit_interval() {
    // Published figures: scale down to −.044, bias up to 1.044.
    assert_refuted("karis_2014", "scale", Bound::AtLeast(0.0), 0.0436);
    assert_refuted("karis_2014", "bias", Bound::AtMost(1.0), 0.0436);
}

#[test]
fn materialx_reflects_more_light_than_falls_in() {
    // Published figure: 1.035.
    assert_refuted("materialx_rational", "scale + bias", Bound::AtMost(1.0), 0.0345);
    assert_refuted("materialx_rational", "f0*scale + bias", Bound::AtMost(1.0), 0.0345);
}

#[test]
fn unreals_energy_is_nan_at_the_corner() {
    for rounding in [Rounding::Exact, Rounding::Gpu] {
        let status = claim("ue5_ggx_energy", "scale", Bound::Finite, rounding);
        let Status::Refuted { input, value } = status else { panic!("{status:?}") };
        assert_eq!(input[..2], [0.0, 0.0]);
        assert!(value.is_nan());
    }
}

#[test]
fn what_is_right_is_proved() {
    let proved = [
        ("blender_workbench", "scale", Bound::AtLeast(0.0)),
        ("blender_workbench", "bias", Bound::AtMost(1.0)),
        ("blender_workbench", "scale + bias", Bound::AtMost(1.0)),
        ("narkowicz_2014_exp", "bias", Bound::AtMost(1.0)),
        ("karis_2014", "bias", Bound::Finite),
        ("materialx_rational", "scale", Bound::Finite),
        ("materialx_rational", "scale", Bound::AtMost(1.0)),
        ("rtg_ch32", "bias", Bound::Finite),
    ];
    for (name, expression, bound) in proved {
        for rounding in [Rounding::Exact, Rounding::Gpu] {
            let status = claim(name, expression, bound, rounding);
            assert_eq!(status, Status::Proved, "{name}: {expression} {bound:?} {rounding:?}");
        }
    }
}
