//! The split-integral DFG terms.

use crate::{assert_near, committed, reference};
use lgp::dataset::Dataset;
use lgp::quadrature::TanhSinh;
use lgp::targets::Recipe;
use lgp::targets::dfg::{self, Masking};
use std::f64::consts::{FRAC_PI_2, PI};

const ACCURACY: f64 = 1e-6;

/// Largest absolute difference between a search split and a table whose rows
/// are in the same order.
fn largest_difference(dataset: &Dataset, table: &[Vec<f64>]) -> f64 {
    assert_eq!(dataset.search.rows(), table.len());
    let mut largest = 0.0_f64;
    for (row, expected) in table.iter().enumerate() {
        let found: Vec<f64> =
            dataset.search.columns.iter().map(|column| f64::from(column[row])).collect();
        assert!((found[0] - expected[0]).abs() < 1e-9 && (found[1] - expected[1]).abs() < 1e-9);
        for output in [2, 3] {
            largest = largest.max((found[output] - expected[output]).abs());
        }
    }
    largest
}

#[test]
fn committed_dfg_agrees_with_the_reference() {
    for (file, table) in [("dfg.bin", "dfg_a_corr_r2.csv"), ("dfg_paper.bin", "dfg_p_sep_r4.csv")] {
        let dataset = Dataset::load(&committed(file)).unwrap();
        let largest = largest_difference(&dataset, &reference(table));
        println!("{file}: largest difference {largest:e}");
        assert!(largest <= ACCURACY, "{file}: {largest:e}");
    }
}

#[test]
fn dfg_agrees_with_the_reference_up_to_the_edges() {
    let rule = TanhSinh::new();
    let mut largest = [0.0_f64; 2];
    let mut claimed = 0.0_f64;
    for row in reference("dfg_nodes33.csv") {
        let (n_dot_v, alpha) = (row[0], row[1] * row[1]);
        for (index, masking) in [Masking::Correlated, Masking::Separable].into_iter().enumerate() {
            let dfg = dfg::integrate(&rule, n_dot_v, alpha, masking);
            let [scale, bias] = [row[2 + 2 * index], row[3 + 2 * index]];
            let error = (dfg.scale - scale).abs().max((dfg.bias - bias).abs());
            assert!(error <= ACCURACY, "{masking:?} at {n_dot_v}, {alpha}: {dfg:?}, {error:e}");
            largest[index] = largest[index].max(error);
            claimed = claimed.max(dfg.error);
        }
    }
    println!("correlated {:e}, separable {:e}, claimed {claimed:e}", largest[0], largest[1]);
    assert!(claimed <= dfg::ALLOWED_ERROR);
}

/// The same integrals over directions of light, by the trapezoidal rule in azimuth and the midpoint
/// rule in the polar angle: for wide lobes.
#[test]
fn schlick_masking_agrees_with_an_integral_over_light() {
    const STEPS: usize = 400;
    let rule = TanhSinh::new();
    for n_dot_v in [0.1, 0.5, 0.9_f64] {
        let sin_v = (1.0 - n_dot_v * n_dot_v).sqrt();
        for alpha in [0.4, 0.7, 1.0_f64] {
            let [mut scale, mut bias] = [0.0, 0.0];
            for i in 0..STEPS {
                let theta = (i as f64 + 0.5) / STEPS as f64 * FRAC_PI_2;
                let (sin_l, n_dot_l) = theta.sin_cos();
                for k in 0..STEPS {
                    let phi = (k as f64 + 0.5) / STEPS as f64 * PI;
                    let l_dot_v = sin_l * sin_v * phi.cos() + n_dot_l * n_dot_v;
                    let length = (2.0 + 2.0 * l_dot_v).sqrt();
                    let n_dot_h = (n_dot_l + n_dot_v) / length;
                    let v_dot_h = length / 2.0;
                    let spread = n_dot_h * n_dot_h * (alpha * alpha - 1.0) + 1.0;
                    let d = alpha * alpha / (PI * spread * spread);
                    let g = |x: f64| x / (x * (1.0 - alpha / 2.0) + alpha / 2.0);
                    let brdf_cos = d * g(n_dot_v) * g(n_dot_l) / (4.0 * n_dot_v);
                    let fresnel = (1.0 - v_dot_h).powi(5);
                    // Both halves of the azimuth, and the steps.
                    let weight = 2.0 * (FRAC_PI_2 / STEPS as f64) * (PI / STEPS as f64) * sin_l;
                    scale += brdf_cos * (1.0 - fresnel) * weight;
                    bias += brdf_cos * fresnel * weight;
                }
            }
            let dfg = dfg::integrate(&rule, n_dot_v, alpha, Masking::Schlick);
            let error = (dfg.scale - scale).abs().max((dfg.bias - bias).abs());
            assert!(error < 2e-5, "{n_dot_v}, {alpha}: {dfg:?}, not {scale}, {bias}");
        }
    }
}

#[test]
fn dfg_tends_to_its_limit_for_narrow_lobes() {
    let rule = TanhSinh::new();
    for masking in [Masking::Correlated, Masking::Separable, Masking::Schlick] {
        for n_dot_v in [0.001, 0.0078125, 0.25, 0.75, 1.0] {
            let limit = dfg::integrate(&rule, n_dot_v, 0.0, masking);
            assert!((limit.bias - (1.0 - n_dot_v).powi(5)).abs() < 1e-15);
            assert!((limit.scale + limit.bias - 1.0).abs() < 1e-15);
            let mut before = f64::INFINITY;
            for alpha in [1e-4, 1e-6, 3.7e-9, 1e-12] {
                let dfg = dfg::integrate(&rule, n_dot_v, alpha, masking);
                let error = (dfg.scale - limit.scale).abs().max((dfg.bias - limit.bias).abs());
                assert!(error <= before.max(1e-9), "{masking:?} {n_dot_v} {alpha}: {dfg:?}");
                assert!(dfg.error <= dfg::ALLOWED_ERROR, "{masking:?} {n_dot_v} {alpha}: {dfg:?}");
                before = error;
            }
            assert!(before < 1e-9, "{masking:?} {n_dot_v}: {before:e}");
        }
    }
}

#[test]
fn committed_datasets_are_what_their_recipes_define() {
    let rule = TanhSinh::new();
    for (name, masking, power) in [
        ("dfg", Masking::Correlated, 2),
        ("dfg_paper", Masking::Separable, 4),
        ("dfg_schlick", Masking::Schlick, 2),
        ("dfg_alpha", Masking::Correlated, 1),
    ] {
        let recipe = Recipe::load(&committed(&format!("{name}.ron"))).unwrap();
        let made = Dataset::load(&committed(&format!("{name}.bin"))).unwrap();
        assert_eq!(made.name, name);
        assert_eq!(Recipe::parse(&made.origin.source()).unwrap(), recipe, "{name}");
        for split in [&made.search, &made.validation] {
            for row in (0..split.rows()).step_by(17) {
                let [n_dot_v, roughness] = [0, 1].map(|input| f64::from(split.columns[input][row]));
                let dfg = dfg::integrate(&rule, n_dot_v, roughness.powi(power), masking);
                assert_near(dfg.scale as f32, split.columns[2][row], name);
                assert_near(dfg.bias as f32, split.columns[3][row], name);
            }
        }
    }
}

#[test]
fn dfg_splits_are_as_documented() {
    let dataset = Dataset::load(&committed("dfg.bin")).unwrap();
    let [search, validation] = [&dataset.search, &dataset.validation];
    assert_eq!((&search.grid[..], &validation.grid[..]), (&[64, 64][..], &[101, 101][..]));
    assert!(search.weights.is_empty());
    assert!(search.columns[1].iter().all(|r| !validation.columns[1].contains(r)));
    let [n_dot_v, roughness] = [&validation.columns[0], &validation.columns[1]];
    assert_eq!([n_dot_v[0], n_dot_v[101], n_dot_v[10_200]], [0.001, 0.01, 1.0]);
    assert_eq!([roughness[0], roughness[1], roughness[100]], [0.0, 0.01, 1.0]);
    let [edge, inside] = [validation.weight(50), validation.weight(50 * 101 + 50)];
    assert!((edge / inside - 0.45).abs() < 1e-5, "{edge} {inside}");
    let names: Vec<&str> =
        dataset.inputs.iter().chain(&dataset.outputs).map(|column| &column.name[..]).collect();
    assert_eq!(names, ["n_dot_v", "roughness", "scale", "bias"]);
    assert!(dataset.inputs.iter().all(|column| column.domain == [0.0, 1.0]));
}
