//! Reflections as spherical Gaussians: lobes against their densities, the error integral and the
//! fits against another program's (`tests/reference/README.md`).

use glam::DVec3;
use lgp::lobes::fit::{self, Amplitude};
use lgp::lobes::{AnisotropicGaussian, Fan, Grid, Lobe, Misfit, Response, SphericalGaussian};
use lgp::lobes::{direction_at, upright_frame};
use lgp::quadrature::{Rule, change};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::{PI, TAU};
use std::path::Path;

const SAMPLES: usize = 100_000;
const RINGS: usize = 16;
const SECTORS: usize = 12;
/// A χ² as many standard deviations above its mean has a probability of about 1e-3.
const LIMIT: f64 = 3.3;

/// How many standard deviations Pearson's χ² of the samples against the density lies above its
/// mean, over cells about `axis`: rings within the cap `1 - cosine < depth`, of equal solid angles,
/// by sectors, and one cell for the rest of the sphere and the points that give no sample.
fn excess(
    axis: DVec3,
    depth: f64,
    sample: impl Fn([f64; 2]) -> Option<DVec3>,
    density: impl Fn(DVec3) -> f64,
) -> f64 {
    let frame = upright_frame(axis);
    let mut counts = vec![0_u32; RINGS * SECTORS + 1];
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    for _ in 0..SAMPLES {
        let local = sample(rng.random()).map(|direction| frame.transpose() * direction);
        let cell = match local {
            Some(local) if 1.0 - local.z < depth => {
                let ring = ((1.0 - local.z) / depth * RINGS as f64) as usize;
                let turn = (local.y.atan2(local.x) / TAU).rem_euclid(1.0);
                ring.min(RINGS - 1) * SECTORS + ((turn * SECTORS as f64) as usize).min(SECTORS - 1)
            }
            _ => RINGS * SECTORS,
        };
        counts[cell] += 1;
    }
    // Cells may hold the edge of an ellipse, which no rule of high order gains from.
    let rule = Rule::midpoint(40);
    let [ring_depth, sector] = [depth / RINGS as f64, 1.0 / SECTORS as f64];
    let expected = |cell: usize| {
        let low = [(cell / SECTORS) as f64 * ring_depth, (cell % SECTORS) as f64 * sector];
        let high = [low[0] + ring_depth, low[1] + sector];
        let in_cell = rule.integrate(low, high, |[below, turn]| {
            let sine = (below * (2.0 - below)).sqrt();
            let (sin, cos) = (TAU * turn).sin_cos();
            TAU * density(frame * DVec3::new(sine * cos, sine * sin, 1.0 - below))
        });
        in_cell.value * SAMPLES as f64
    };
    let mut cells: Vec<f64> = (0..RINGS * SECTORS).map(expected).collect();
    cells.push(SAMPLES as f64 - cells.iter().sum::<f64>());
    let (mut chi_squared, mut freedom, mut rest) = (0.0, -1.0, [0.0; 2]);
    for (&expected, &count) in cells.iter().zip(&counts) {
        if expected < 20.0 {
            rest = [rest[0] + expected, rest[1] + f64::from(count)];
            continue;
        }
        chi_squared += (f64::from(count) - expected).powi(2) / expected;
        freedom += 1.0;
    }
    // Few are expected there: a Poisson number, at six of its deviations.
    if (rest[1] - rest[0]).abs() > 6.0 * rest[0].max(1.0).sqrt() {
        return f64::INFINITY;
    }
    assert!(freedom > 20.0, "{freedom}");
    (chi_squared - freedom) / (2.0 * freedom).sqrt()
}

fn of_lobe(lobe: &impl Lobe, axis: DVec3, depth: f64) -> f64 {
    excess(axis, depth, |point| Some(lobe.sample(point)), |direction| lobe.density(direction))
}

#[test]
fn gaussians_are_drawn_by_their_density() {
    let axis = DVec3::new(0.48, 0.6, 0.64);
    for (lambda, depth) in [(0.0, 2.0), (1e-9, 2.0), (0.7, 2.0), (30.0, 0.2), (1e6, 6e-6)] {
        let found = of_lobe(&SphericalGaussian::new(axis, lambda, 3.0), axis, depth);
        assert!(found < LIMIT, "{lambda}: {found} standard deviations");
    }
}

fn anisotropic(lambda: f64, mu: f64) -> AnisotropicGaussian {
    AnisotropicGaussian { frame: upright_frame(direction_at(0.7)), lambda, mu, amplitude: 2.0 }
}

#[test]
fn anisotropic_gaussians_are_drawn_by_theirs() {
    // The last is cut off at the ellipse of -ln 1e-4 / λ.
    for (lambda, mu, depth) in [(0.0, 0.0, 1.0), (3.0, 40.0, 1.0), (100.0, 500.0, 0.05)] {
        let lobe = anisotropic(lambda, mu);
        let found = of_lobe(&lobe, direction_at(0.7), depth);
        assert!(found < LIMIT, "{lambda} {mu}: {found} standard deviations");
    }
}

#[test]
fn responses_are_drawn_by_theirs() {
    for (n_dot_v, alpha, depth) in [(0.9, 0.8, 2.0), (0.3, 0.3, 0.15), (0.5, 0.02, 0.01)] {
        let response = Response::new(n_dot_v, alpha);
        let axis = direction_at(n_dot_v.acos());
        let density = |direction| response.density(direction);
        let found = excess(axis, depth, |point| response.sample(point), density);
        assert!(found < LIMIT, "{n_dot_v} {alpha}: {found} standard deviations");
    }
}

#[test]
fn a_wrong_density_is_found() {
    let axis = direction_at(0.3);
    let [drawn, other] = [30.0, 31.0].map(|lambda| SphericalGaussian::new(axis, lambda, 1.0));
    let found = excess(axis, 0.2, |point| Some(drawn.sample(point)), |at| other.density(at));
    assert!(found > 5.0, "{found}");
    let [drawn, other] = [anisotropic(30.0, 60.0), anisotropic(31.0, 60.0)];
    let axis = direction_at(0.7);
    assert!(of_lobe(&drawn, axis, 0.2) < LIMIT);
    let found = excess(axis, 0.2, |point| Some(drawn.sample(point)), |at| other.density(at));
    assert!(found > 5.0, "{found}");
}

#[test]
fn an_anisotropic_gaussian_has_its_value() {
    let lobe = anisotropic(3.0, 40.0);
    let [x, y, z] = [lobe.frame.x_axis, lobe.frame.y_axis, lobe.frame.z_axis];
    assert!((z - direction_at(0.7)).length() < 1e-15 && (y - DVec3::Y).length() < 1e-15);
    assert_eq!([lobe.value(z), lobe.value(x), lobe.value(-z)], [2.0, 0.0, 0.0]);
    let at = |x_part: f64, y_part: f64| {
        let z_part = (1.0 - x_part * x_part - y_part * y_part).sqrt();
        let expected = 2.0 * z_part * (-3.0 * x_part * x_part - 40.0 * y_part * y_part).exp();
        let found = lobe.value(x_part * x + y_part * y + z_part * z);
        assert!((found - expected).abs() < 1e-14, "{found} {expected}");
    };
    at(0.3, 0.1);
    at(-0.5, 0.4);
}

/// A row of the reference values.
struct Row {
    response: Response,
    amplitude: Amplitude,
    integral: f64,
    fan: Fan,
    error: f64,
    relative_error: f64,
}

fn reference() -> Vec<Row> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/ggx_lobes.csv");
    let text = std::fs::read_to_string(path).unwrap();
    let row = |line: &str| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let [nv, r, free, integral, theta, spread, lambda, amplitude, error, relative_error] =
            cells[..]
        else {
            panic!("{line}")
        };
        Row {
            response: Response::new(nv, r * r),
            amplitude: if free == 1.0 { Amplitude::Free } else { Amplitude::Normalised },
            integral,
            fan: Fan { count: 8, theta, spread, lambda, amplitude },
            error,
            relative_error,
        }
    };
    text.lines().skip(1).map(row).collect()
}

/// As many points from each distribution as tables are fitted with: 34 992 in all.
const POINTS: usize = 3888;

#[test]
fn the_error_integral_is_that_of_another_program() {
    for row in reference() {
        let misfit = Misfit::new(row.response, POINTS);
        assert!((misfit.integral() / row.integral - 1.0).abs() < 1.2e-5, "{}", misfit.integral());
        let moments = misfit.moments(&row.fan.lobes());
        let close = |found: f64, expected: f64, share: f64| {
            assert!((found / expected - 1.0).abs() < share, "{found} {expected} {:?}", row.fan);
        };
        close(moments.error(), row.error, 1e-3);
        close(moments.relative_error(), row.relative_error, 1e-3);
        close(moments.model, row.fan.integral(), 3e-5);
        if row.amplitude == Amplitude::Normalised {
            close(row.fan.integral(), row.integral, 1e-7);
        }
        // What is common to all lobes changes nothing.
        let fast = misfit.fan_moments(&row.fan);
        close(fast.error(), moments.error(), 1e-10);
        close(fast.model, moments.model, 1e-12);
    }
}

/// The response of a smooth rule: no sampling at all.
#[test]
fn the_error_integral_is_that_of_a_product_rule() {
    let response = Response::new(0.6, 0.6);
    let fan = Fan { count: 3, theta: 0.7, spread: 0.4, lambda: 3.0, amplitude: 0.2 };
    let lobes = fan.lobes();
    let model = |at: DVec3| lobes.iter().map(|lobe| lobe.value(at)).sum::<f64>();
    let rule = Rule::gauss_legendre(120);
    let below = |at: DVec3| DVec3::new(at.x, at.y, -at.z);
    let above = |f: &dyn Fn(DVec3) -> f64| {
        rule.integrate([0.0; 2], [1.0; 2], change::over(change::hemisphere, f)).value
    };
    let error = above(&|at| (response.value(at) - model(at)).powi(2))
        + above(&|at| model(below(at)).powi(2));
    let misfit = Misfit::new(response, 16 * POINTS);
    let found = misfit.moments(&lobes);
    assert!((found.error() / error - 1.0).abs() < 2e-4, "{} {error}", found.error());
    let integral = above(&|at| response.value(at));
    assert!((misfit.integral() / integral - 1.0).abs() < 1e-5, "{integral}");
    let whole = above(&|at| model(at) + model(below(at)));
    assert!((fan.integral() / whole - 1.0).abs() < 1e-9, "{whole}");
    let fast = misfit.fan_moments(&fan);
    assert!((fast.error() / found.error() - 1.0).abs() < 1e-10);
}

/// Noise would show in differences of second order, which steps a tenth as long make a hundred
/// times as large.
#[test]
fn the_landscape_is_smooth() {
    let misfit = Misfit::new(Response::new(0.3, 0.1), 864);
    let fan = Fan { count: 8, theta: 1.2, spread: 0.15, lambda: 250.0, amplitude: 3.0 };
    let directions: [fn(&mut Fan, f64); 4] = [
        |fan, by| fan.theta += 0.1 * by,
        |fan, by| fan.spread += 0.1 * by,
        |fan, by| fan.lambda *= by.exp(),
        |fan, by| fan.amplitude *= by.exp(),
    ];
    for (index, direction) in directions.iter().enumerate() {
        let at = |by: f64| {
            let mut moved = fan;
            direction(&mut moved, by);
            misfit.fan_moments(&moved).error()
        };
        let curvature = |step: f64| (at(step) - 2.0 * at(0.0) + at(-step)) / (step * step);
        let [long, short] = [1e-2, 1e-3].map(curvature);
        assert!((long / short - 1.0).abs() < 0.01, "{index}: {long} {short}");
    }
}

#[test]
fn fits_are_no_worse_than_another_programs() {
    for row in reference() {
        let coarse = Misfit::new(row.response, 432);
        let near = fit::fan(&coarse, 8, row.amplitude, &[]).model;
        assert!(near.spread <= near.theta);
        let fine = Misfit::new(row.response, POINTS);
        let theirs = fine.fan_moments(&row.fan).error();
        let ours = fine.fan_moments(&match row.amplitude {
            Amplitude::Normalised => near.of_integral(fine.integral()),
            Amplitude::Free => near,
        });
        assert!(ours.error() < theirs * 1.001, "{} {theirs} {near:?}", ours.error());
        let close = |found: f64, expected: f64| (found / expected - 1.0).abs() < 0.03;
        assert!(close(near.theta, row.fan.theta) && close(near.lambda, row.fan.lambda), "{near:?}");
    }
}

#[test]
fn models_are_ranked_as_expected() {
    let misfit = Misfit::new(Response::new(0.3, 0.16), 216);
    let fan = |count| fit::fan(&misfit, count, Amplitude::Free, &[]);
    let [one, three, eight] = [1, 3, 8].map(fan);
    assert!(eight.error < three.error && three.error < one.error);
    assert_eq!(one.model.spread, 0.0);
    let normalised = fit::fan(&misfit, 8, Amplitude::Normalised, &[]);
    assert!(eight.error < normalised.error);
    let integral = normalised.model.integral();
    assert!((integral / misfit.integral() - 1.0).abs() < 1e-12, "{integral}");
    // Lobes with bandwidths of their own do what a common one cannot: a long tail.
    let mixture = fit::mixture(&misfit, &three.model.lobes());
    assert!(mixture.error < 0.7 * eight.error, "{} {}", mixture.error, eight.error);
    let anisotropic = fit::anisotropic(&misfit, Amplitude::Free);
    assert!(anisotropic.error < eight.error, "{anisotropic:?} {}", eight.error);
    assert!(anisotropic.model.mu > 3.0 * anisotropic.model.lambda);
}

#[test]
fn grids_are_the_same_on_any_number_of_threads() {
    let grid = Grid { n_dot_v: &[0.4, 0.6], roughness: &[0.5] };
    let fans = || grid.fans(2, Amplitude::Free, &|| ());
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(fans);
    let three = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap().install(fans);
    assert_eq!(alone, three);
    assert!(alone[0].model.theta > alone[1].model.theta);
    assert!(PI > alone[0].model.theta);
}
