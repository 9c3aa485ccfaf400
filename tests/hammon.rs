//! The path tracer of rough diffuse surfaces against another one
//! (`tests/reference/README.md`), against the laws that it must obey, and the
//! committed dataset.

use glam::DVec3;
use lgp::dataset::Dataset;
use lgp::microfacet::diffuse;
use lgp::quadrature::{Estimate, Rule};
use lgp::targets::hammon::{Lobe, Microsurface, Sampler, lobes};
use lgp::targets::{Recipe, generate};
use std::f64::consts::{FRAC_PI_2, PI};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

fn path(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(file)
}

fn direction(theta: f64, phi: f64) -> DVec3 {
    DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
}

/// A light and all that the reference has of it.
struct Row {
    sampler: Sampler,
    /// alpha and the light's angle as written.
    light: [String; 2],
    view: DVec3,
    /// Value and standard error of single and multi.
    expected: [[f64; 2]; 2],
}

fn reference() -> Vec<Row> {
    let text = std::fs::read_to_string(path("tests/reference/hammon.csv")).unwrap();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |cell: usize| -> f64 { cells[cell].parse().unwrap() };
        Row {
            sampler: if cells[0] == "exact" { Sampler::Exact } else { Sampler::Literal },
            light: [cells[1].into(), cells[2].into()],
            view: direction(number(3).to_radians(), number(4).to_radians()),
            expected: [[number(5), number(6)], [number(7), number(8)]],
        }
    };
    text.lines().skip(1).map(row).collect()
}

fn surface(row: &Row) -> (Microsurface, DVec3) {
    let [alpha, theta] = [0, 1].map(|i| row.light[i].parse::<f64>().unwrap());
    (Microsurface { alpha, sampler: row.sampler }, direction(theta.to_radians(), 0.0))
}

/// Differences from the reference, in units of the combined standard error.
fn differences(rows: &[Row], paths: usize) -> Vec<f64> {
    let mut differences = Vec::new();
    let same_light = |a: &Row, b: &Row| a.sampler == b.sampler && a.light == b.light;
    for (stream, rows) in rows.chunk_by(same_light).enumerate() {
        let (surface, l) = surface(&rows[0]);
        let views: Vec<DVec3> = rows.iter().map(|row| row.view).collect();
        let found = lobes(surface, l, &views, paths, stream as u64, &|| {});
        for (row, lobe) in rows.iter().zip(found) {
            for ([value, error], found) in row.expected.into_iter().zip([lobe.single, lobe.multi]) {
                let z = (found.value - value) / found.error.hypot(error);
                let place = format!("{:?} {:?} {}", row.sampler, row.light, row.view);
                assert!(z.abs() <= 5.0, "{place}: {found:?} and {value} ± {error}, z = {z}");
                differences.push(z);
            }
        }
    }
    differences
}

fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64
}

/// A view each of forty lights, exact and literal.
#[test]
fn forty_rows_agree_with_the_reference() {
    let rows: Vec<Row> = reference().into_iter().skip(36).step_by(73).collect();
    assert_eq!(rows.len(), 40);
    let square = mean_square(&differences(&rows, 60_000));
    println!("mean square {square:.3}");
    assert!(square > 0.5 && square < 1.6, "{square}");
}

/// One to two minutes on two cores: `cargo test --release --test hammon -- --ignored`.
#[test]
#[ignore = "minutes"]
fn the_whole_table_agrees_with_the_reference() {
    let rows = reference();
    assert_eq!(rows.len(), 2940);
    for sampler in [Sampler::Exact, Sampler::Literal] {
        let mut rows = reference();
        rows.retain(|row| row.sampler == sampler);
        let differences = differences(&rows, 400_000);
        let largest = differences.iter().fold(0.0, |largest: f64, z| largest.max(z.abs()));
        let square = mean_square(&differences);
        println!(
            "{sampler:?}: {} values, |z| <= {largest:.2}, mean square {square:.4}",
            differences.len()
        );
        assert!((0.9..1.1).contains(&square), "{sampler:?}: {square}");
    }
}

/// Lobes of light from `l` towards `v`.
fn lobe(sampler: Sampler, alpha: f64, l: DVec3, v: DVec3, paths: usize, stream: u64) -> Lobe {
    lobes(Microsurface { alpha, sampler }, l, &[v], paths, stream, &|| {})[0]
}

#[test]
fn exact_lobes_are_reciprocal_and_literal_ones_are_not() {
    let pairs =
        [(0.4, 20.0_f64, 65.0_f64, 45.0_f64), (1.0, 5.0, 75.0, 0.0), (0.8, 35.0, 50.0, 180.0)];
    let mut asymmetry = 0.0_f64;
    for (stream, (alpha, a, b, phi)) in pairs.into_iter().enumerate() {
        let a = direction(a.to_radians(), 0.0);
        let b = direction(b.to_radians(), phi.to_radians());
        let both = |sampler| {
            let there = lobe(sampler, alpha, a, b, 600_000, 2 * stream as u64);
            // The light stays in the plane of x.
            let turn = glam::DQuat::from_rotation_z(-phi.to_radians());
            let back = lobe(sampler, alpha, turn * b, turn * a, 600_000, 2 * stream as u64 + 1);
            [(there.single, back.single), (there.multi, back.multi)]
        };
        for (there, back) in both(Sampler::Exact) {
            let difference = (there.value - back.value).abs();
            assert!(difference <= 1e-3, "{alpha} {a} {b}: {there:?} {back:?}");
            assert!(difference <= 5.0 * there.error.hypot(back.error), "{there:?} {back:?}");
        }
        for (there, back) in both(Sampler::Literal) {
            asymmetry = asymmetry.max((there.value - back.value).abs() / there.value);
        }
    }
    println!("literal: asymmetry {asymmetry:.3}");
    assert!(asymmetry > 0.1, "{asymmetry}");
}

/// All light that comes in goes out, by what each view gets as by counting paths.
#[test]
fn exact_lobes_conserve_energy() {
    let rule = Rule::gauss_legendre(12);
    for (stream, (alpha, theta)) in [(0.3, 0.3), (0.6, 0.9), (1.0, 1.3)].into_iter().enumerate() {
        let surface = Microsurface { alpha, sampler: Sampler::Exact };
        let mut views = Vec::new();
        for u in rule.points() {
            for w in rule.points() {
                let (theta, phi) = (0.5 * FRAC_PI_2 * (1.0 + u.node), 0.5 * PI * (1.0 + w.node));
                // Both halves of the azimuths; θ and φ from [-1, 1].
                let measure = 2.0 * theta.sin() * theta.cos() * 0.5 * FRAC_PI_2 * 0.5 * PI;
                views.push((direction(theta, phi), u.weight * w.weight * measure));
            }
        }
        let directions: Vec<DVec3> = views.iter().map(|view| view.0).collect();
        let found =
            lobes(surface, direction(theta, 0.0), &directions, 40_000, stream as u64, &|| {});
        let integral = |of: fn(&Lobe) -> Estimate| -> f64 {
            found.iter().zip(&views).map(|(lobe, view)| of(lobe).value * view.1).sum()
        };
        let [specular, single, multi] = [
            integral(|lobe| lobe.specular),
            integral(|lobe| lobe.single),
            integral(|lobe| lobe.multi),
        ];
        let total = specular + single + multi;
        println!("{alpha} {theta}: {specular:.4} + {single:.4} + {multi:.4} = {total:.5}");
        assert!((total - 1.0).abs() < 5e-3, "{alpha} {theta}: {total}");
        assert!((single + multi - (1.0 - specular)).abs() < 5e-3);
    }
}

#[test]
fn smooth_surfaces_are_a_flat_interface_over_a_white_interior() {
    for (theta_l, theta_v) in [(0.2, 0.4), (0.9, 0.5)] {
        let (l, v) = (direction(theta_l, 0.0), direction(theta_v, 2.0));
        let found = lobe(Sampler::Exact, 0.003, l, v, 20_000, 7);
        let expected = diffuse::under_interface(l.z, v.z, 0.02);
        assert!((found.single.value - expected).abs() < 3e-3, "{found:?} {expected}");
        assert!(found.multi.value < 1e-3);
    }
}

#[test]
fn threads_change_nothing() {
    let (l, views) = (direction(0.5, 0.0), [direction(1.0, 0.3), direction(0.1, 2.0)]);
    let surface = Microsurface { alpha: 0.7, sampler: Sampler::Exact };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| lobes(surface, l, &views, 1000, 3, &|| {}))
    };
    assert_eq!(on(1), on(3));
    assert_ne!(on(1), lobes(surface, l, &views, 1000, 4, &|| {}));
}

#[test]
fn the_dataset_is_as_its_recipe_says() {
    let recipe = Recipe::load(&path("datasets/hammon.ron")).unwrap();
    let made = Dataset::load(&path("datasets/hammon.bin")).unwrap();
    assert_eq!(Recipe::parse(&made.origin.source()).unwrap(), recipe);
    assert_eq!([made.search.rows(), made.validation.rows()], [3584, 6561]);
    for split in [&made.search, &made.validation] {
        let lengths = split.standard_errors.iter().map(Vec::len);
        assert_eq!(lengths.collect::<Vec<_>>(), [split.rows(); 2]);
    }
    // A quick run differs by its noise alone.
    let mut quick = recipe;
    quick.set("paths", "2000").unwrap();
    quick.set("standard_errors", "columns").unwrap();
    let calls = AtomicUsize::new(0);
    let quick = generate(&quick, &|done, total| {
        assert!(done <= total);
        calls.fetch_add(1, Ordering::Relaxed);
    });
    let quick = quick.unwrap();
    assert!(calls.into_inner() > 0);
    assert_eq!(quick.search.columns[..5], made.search.columns[..5]);
    for output in [5, 6] {
        let rows = 0..made.search.rows();
        let z = rows.map(|row| {
            let [found, error] =
                [output, output + 2].map(|c| f64::from(quick.search.columns[c][row]));
            (found - f64::from(made.search.columns[output][row])) / error
        });
        // Few paths underestimate their own error where light is rare.
        let z: Vec<f64> = z.map(|z| z.clamp(-5.0, 5.0)).collect();
        let square = mean_square(&z);
        println!("output {output}: mean square {square:.3}");
        assert!((0.8..1.5).contains(&square), "{square}");
    }
}
