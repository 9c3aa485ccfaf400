//! Zonal harmonics of the Disney diffuse lobe.

use crate::reference;
use glam::DVec3;
use lgp::quadrature::{Rule, change};
use lgp::targets::disney_zh::{Lobe, project};
use std::f64::consts::PI;

#[test]
fn agrees_with_the_reference() {
    let mut largest = [0.0_f64; 4];
    for row in reference("disney_zh.csv") {
        let Lobe { zh: [zh0, zh1, zh2], beta } = project(row[0], row[1]);
        for (index, found) in [zh0, zh1, zh2, beta].into_iter().enumerate() {
            let error = (found - row[2 + index]).abs();
            assert!(error <= 1e-4, "{row:?}: {found}, {error:e}");
            largest[index] = largest[index].max(error);
        }
    }
    println!("zh0, zh1, zh2, beta: {largest:?}");
}

/// The definition, direction by direction.
#[test]
fn is_the_projection() {
    let rule = Rule::gauss_legendre(40);
    for (n_dot_v, roughness) in [(0.0, 1.0), (0.2, 0.3), (0.7, 0.9), (1.0, 0.0), (1.0, 1.0)] {
        let v = DVec3::new(f64::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v);
        let brdf = |l: DVec3| {
            let f = 0.5 + 2.0 * roughness * 0.5 * (1.0 + l.dot(v)) - 1.0;
            (1.0 + f * (1.0 - l.z).powi(5)) * (1.0 + f * (1.0 - v.z).powi(5)) / PI
        };
        let integral = |of: &dyn Fn(DVec3) -> f64| {
            let lobe = change::over(change::hemisphere, |l: DVec3| brdf(l) * l.z * of(l));
            rule.integrate([0.0; 2], [1.0; 2], lobe).value
        };
        let axis = DVec3::new(integral(&|l| l.x), integral(&|l| l.y), integral(&|l| l.z));
        let axis = axis.normalize();
        let legendre: [&dyn Fn(f64) -> f64; 3] = [&|_| 1.0, &|x| x, &|x| 0.5 * (3.0 * x * x - 1.0)];
        let found = project(n_dot_v, roughness);
        for (band, polynomial) in legendre.into_iter().enumerate() {
            let norm = ((2 * band + 1) as f64 / (4.0 * PI)).sqrt();
            let expected = norm * integral(&|l| polynomial(l.dot(axis)));
            assert!((found.zh[band] - expected).abs() < 1e-10, "{found:?}, {band}: {expected}");
        }
        let toward = (1.0 - found.beta) * DVec3::Z + found.beta * v;
        assert!(toward.cross(axis).length() < 1e-10, "{found:?}");
    }
}

#[test]
fn beta_has_its_limit_at_the_normal() {
    for roughness in [0.0, 0.5, 1.0] {
        let [limit, near] = [1.0, 1.0 - 1e-9].map(|n_dot_v| project(n_dot_v, roughness).beta);
        assert!(limit.is_finite() && (limit - near).abs() < 1e-8, "{limit} {near}");
    }
}

/// Without Fresnel terms the lobe is the cosine's: c₀ = √π/2, c₁ = √(π/3), c₂ = √(5π)/8, over π.
#[test]
fn is_near_the_cosine_where_the_fresnel_terms_vanish() {
    // At roughness = 1/2 and v = n, F - 1 is at most 1/2 (1 + n·l) - 1/2.
    let found = project(1.0, 0.5);
    let cosine = [0.5 * PI.sqrt(), (PI / 3.0).sqrt(), (5.0 * PI).sqrt() / 8.0].map(|c| c / PI);
    for (found, cosine) in found.zh.into_iter().zip(cosine) {
        assert!((found / cosine - 1.0).abs() < 0.02, "{found} {cosine}");
    }
}
