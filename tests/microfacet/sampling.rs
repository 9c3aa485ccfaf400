use crate::laws::direction;
use glam::DVec3;
use lgp::microfacet::{beckmann, blinn_phong, diffuse, fresnel, ggx, sampling};
use lgp::quadrature::Rule;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::{PI, TAU};

const SAMPLES: usize = 200_000;
const RINGS: usize = 20;
const SECTORS: usize = 24;

/// How many standard deviations Pearson's χ² of the samples against the density
/// lies above its mean, over cells of the upper hemisphere; `edges` are the
/// cosines between the rings, ascending from 0 to 1.
fn excess(
    edges: &[f64],
    sample: impl Fn([f64; 2]) -> DVec3,
    density: impl Fn(DVec3) -> f64,
) -> f64 {
    let mut counts = vec![0_u32; RINGS * SECTORS];
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..SAMPLES {
        let found = sample(rng.random());
        let ring = edges[1..RINGS].partition_point(|&edge| edge < found.z);
        let turn = (found.y.atan2(found.x) / TAU).rem_euclid(1.0);
        counts[ring * SECTORS + ((turn * SECTORS as f64) as usize).min(SECTORS - 1)] += 1;
    }
    let rule = Rule::gauss_legendre(24);
    let (mut chi_squared, mut cells) = (0.0, 0);
    let mut rest = (0.0, 0.0);
    for (cell, &count) in counts.iter().enumerate() {
        let (ring, sector) = (cell / SECTORS, (cell % SECTORS) as f64);
        let step = TAU / SECTORS as f64;
        let (low, high) = ([edges[ring], sector * step], [edges[ring + 1], (sector + 1.0) * step]);
        let in_cell = rule.integrate(low, high, |[cosine, phi]| density(direction(cosine, phi)));
        let expected = in_cell.value * SAMPLES as f64;
        if expected < 10.0 {
            rest = (rest.0 + expected, rest.1 + f64::from(count));
            continue;
        }
        chi_squared += (f64::from(count) - expected).powi(2) / expected;
        cells += 1;
    }
    if rest.0 >= 10.0 {
        chi_squared += (rest.1 - rest.0).powi(2) / rest.0;
        cells += 1;
    } else {
        assert!(rest.1 < 30.0, "{rest:?}");
    }
    assert!(cells > 30);
    let freedom = f64::from(cells - 1);
    (chi_squared - freedom) / (2.0 * freedom).sqrt()
}

/// Rings that hold equal numbers of GGX normals.
fn rings(alpha: f64) -> Vec<f64> {
    let edge = |ring: usize| sampling::ggx([0.0, 1.0 - ring as f64 / RINGS as f64], alpha).z;
    let mut edges: Vec<f64> = (1..RINGS).map(edge).collect();
    edges.insert(0, 0.0);
    edges.push(1.0);
    edges
}

fn assert_drawn_from(name: &str, excess: f64) {
    assert!(excess.abs() < 4.0, "{name}: {excess} standard deviations");
}

#[test]
fn normals_follow_their_distributions() {
    for alpha in [0.05, 0.4, 1.0] {
        let edges = rings(alpha);
        let found =
            excess(&edges, |u| sampling::ggx(u, alpha), |h| ggx::distribution(h.z, alpha) * h.z);
        assert_drawn_from("GGX", found);
        let density = |h: DVec3| beckmann::distribution(h.z, alpha) * h.z;
        assert_drawn_from("Beckmann", excess(&edges, |u| sampling::beckmann(u, alpha), density));
        let exponent = blinn_phong::exponent(alpha);
        let density = |h: DVec3| blinn_phong::distribution(h.z, exponent) * h.z;
        let sample = |u| sampling::blinn_phong(u, exponent);
        assert_drawn_from("Blinn–Phong", excess(&edges, sample, density));
    }
}

#[test]
fn visible_normals_follow_theirs() {
    for alpha in [0.1, 0.5, 1.0] {
        let edges = rings(alpha);
        for cosine in [0.02, 0.5, 0.95, 1.0] {
            let v = direction(cosine, 0.7);
            let density = |h: DVec3| {
                let distribution = ggx::distribution(h.z, alpha);
                sampling::visible_density(v, h, distribution, ggx::lambda(v.z, alpha))
            };
            let found = excess(&edges, |u| sampling::visible_ggx(u, v, alpha), density);
            assert_drawn_from(&format!("GGX {alpha} {cosine}"), found);
            let density = |h: DVec3| {
                let distribution = beckmann::distribution(h.z, alpha);
                sampling::visible_density(v, h, distribution, beckmann::lambda(v.z, alpha))
            };
            let found = excess(&edges, |u| sampling::visible_beckmann(u, v, alpha), density);
            assert_drawn_from(&format!("Beckmann {alpha} {cosine}"), found);
        }
    }
}

#[test]
fn normals_seen_from_below_follow_theirs() {
    let alpha = 0.8;
    for cosine in [-0.1, -0.6] {
        let v = direction(cosine, 0.7);
        // Projected area of the facets that face v: |n·v| Λ(|n·v|), as n·v (1 + Λ(v)) with
        // Λ(-v) = -1 - Λ(v).
        let area = -cosine * ggx::lambda(-cosine, alpha);
        let density = |h: DVec3| v.dot(h).max(0.0) * ggx::distribution(h.z, alpha) / area;
        let found = excess(&rings(alpha), |u| sampling::visible_ggx(u, v, alpha), density);
        assert_drawn_from(&format!("{cosine}"), found);
    }
}

#[test]
fn diffuse_lobes_follow_their_densities() {
    let edges: Vec<f64> = (0..=RINGS).map(|ring| ring as f64 / RINGS as f64).collect();
    assert_drawn_from("cosine", excess(&edges, sampling::cosine, |l| l.z / PI));
    let norm = diffuse::transmission_norm::<f64>();
    let density = |l: DVec3| norm * fresnel::schlick_transmission(l.z) * l.z;
    assert_drawn_from("transmitted", excess(&edges, sampling::transmitted, density));
}

#[test]
fn a_wrong_density_is_found() {
    let v = direction(0.3, 0.7);
    let density = |h: DVec3| {
        let distribution = ggx::distribution(h.z, 0.5);
        sampling::visible_density(v, h, distribution, ggx::lambda(v.z, 0.5))
    };
    assert!(excess(&rings(0.5), |u| sampling::visible_ggx(u, v, 0.55), density) > 20.0);
    let lambert = |l: DVec3| l.z / PI;
    let edges: Vec<f64> = (0..=RINGS).map(|ring| ring as f64 / RINGS as f64).collect();
    assert!(excess(&edges, sampling::transmitted, lambert) > 20.0);
}
