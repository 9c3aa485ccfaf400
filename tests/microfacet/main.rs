//! Microfacet terms against references in 50 digits, against the laws that they
//! must obey, and samplers against their densities.

mod laws;
mod sampling;

use lgp::microfacet::{Real, beckmann, ggx};
use std::path::Path;

struct Case {
    family: String,
    cosine: f64,
    cosine_l: f64,
    alpha: f64,
    reference: f64,
}

fn cases() -> Vec<Case> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/stiff_microfacet.csv");
    let text = std::fs::read_to_string(file).unwrap();
    let case = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |cell: usize| cells[cell].parse().unwrap_or(0.0);
        let (cosine, cosine_l) = (number(1), number(2));
        let (alpha, reference) = (number(3), number(4));
        Case { family: cells[0].into(), cosine, cosine_l, alpha, reference }
    };
    text.lines().skip(1).map(case).collect()
}

fn term<T: Real>(case: &Case) -> T {
    let [cosine, cosine_l, alpha] = [case.cosine, case.cosine_l, case.alpha].map(T::of);
    match case.family.as_str() {
        "ggx_d" => ggx::distribution(cosine, alpha),
        "ggx_v" => ggx::visibility_correlated(cosine, cosine_l, alpha),
        "ggx_lambda" => ggx::lambda(cosine, alpha),
        "beckmann_d" => beckmann::distribution(cosine, alpha),
        family => panic!("{family}"),
    }
}

/// The same case with its inputs rounded to f32.
fn rounded(case: &Case) -> Case {
    let [cosine, cosine_l, alpha] =
        [case.cosine, case.cosine_l, case.alpha].map(|input| f64::from(input as f32));
    Case { family: case.family.clone(), cosine, cosine_l, alpha, reference: case.reference }
}

#[test]
fn stiff_points_in_double_precision() {
    let cases = cases();
    assert_eq!(cases.len(), 35);
    for case in cases {
        let found: f64 = if case.family == "ggx_v" { term(&rounded(&case)) } else { term(&case) };
        let error = (found - case.reference).abs();
        let place = format!("{} {} {}", case.family, case.cosine, case.alpha);
        assert!(error <= 1e-13 * case.reference, "{place}: {found} {}", case.reference);
    }
}

#[test]
fn stiff_points_in_single_precision() {
    for case in cases() {
        let case = rounded(&case);
        let found = f64::from(term::<f32>(&case));
        let exact: f64 = term(&case);
        // The exponent of the Beckmann point is 20.
        let allowed = if case.family == "beckmann_d" { 5e-6 } else { 5e-7 };
        let error = (found - exact).abs();
        let place = format!("{} {} {}", case.family, case.cosine, case.alpha);
        assert!(error <= allowed * exact + 1e-37, "{place}: {found} {exact}");
    }
}

#[test]
fn extreme_parameters_stay_finite() {
    for alpha in [1e-18_f32, 1e-6, 1e-3, 1.0] {
        for cosine in [0.0, 1e-20, 1e-4, 0.5, 1.0] {
            let distribution =
                [ggx::distribution(cosine, alpha), beckmann::distribution(cosine, alpha)];
            assert!(distribution.iter().all(|d| *d >= 0.0 && !d.is_nan()), "{alpha} {cosine}");
            let masking = [ggx::g1(cosine, alpha), beckmann::g1(cosine, alpha)];
            assert!(
                masking.iter().all(|g| (0.0..=1.0).contains(g)),
                "{alpha} {cosine} {masking:?}"
            );
            for other in [0.0, 1e-20, 0.5, 1.0] {
                let both = [
                    ggx::g2_correlated(cosine, other, alpha),
                    ggx::g2_separable(cosine, other, alpha),
                    beckmann::g2_correlated(cosine, other, alpha),
                    beckmann::g2_separable(cosine, other, alpha),
                    lgp::microfacet::masking::g2_hammon(cosine, other, alpha),
                ];
                assert!(
                    both.iter().all(|g| (0.0..=1.0).contains(g)),
                    "{alpha} {cosine} {other} {both:?}"
                );
            }
        }
    }
}
