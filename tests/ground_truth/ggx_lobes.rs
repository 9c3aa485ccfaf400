//! Lobes of a GGX surface: parts of the committed tables against what is computed again. The error
//! integral and the fits themselves are compared with another program's in `tests/lobes.rs`.

use crate::committed;
use lgp::dataset::Dataset;
use lgp::lobes::fit::{Amplitude, fan};
use lgp::lobes::{Fan, Grid, Lobe, Misfit, Response};
use lgp::targets::{Recipe, generate};
use std::sync::atomic::{AtomicUsize, Ordering};

fn committed_fan(row: &[f32]) -> Fan {
    let [cosine, spread, log_amplitude, log_lambda] = [2, 3, 4, 5].map(|i| f64::from(row[i]));
    let (amplitude, lambda) = (log_amplitude.exp(), log_lambda.exp());
    Fan { count: 8, theta: cosine.acos(), spread, lambda, amplitude }
}

#[test]
fn committed_fans_are_of_least_error() {
    let data = Dataset::load(&committed("ggx_lobes.bin")).unwrap();
    let recipe = Recipe::load(&committed("ggx_lobes.ron")).unwrap();
    assert_eq!(Recipe::parse(&data.origin.source()).unwrap(), recipe);
    assert_eq!((&data.search.grid[..], &data.validation.grid[..]), (&[16, 16][..], &[17, 17][..]));
    for split in [&data.search, &data.validation] {
        // From corner to corner; enough points to know the error of narrow lobes better than that.
        for place in [0, 1, 3, 4].map(|quarter| quarter * (split.rows() - 1) / 4) {
            let row: Vec<f32> = split.columns.iter().map(|column| column[place]).collect();
            let [n_dot_v, roughness] = [row[0], row[1]].map(f64::from);
            let misfit = Misfit::new(Response::new(n_dot_v, roughness * roughness), 1728);
            let made = misfit.fan_moments(&committed_fan(&row));
            let again = fan(&misfit, 8, Amplitude::Free, &[]);
            let gained = 1.0 - again.error / made.error();
            assert!(gained < 0.01, "{row:?}: {:?} is better by {gained}", again.model);
            // The clamp of the spread, and lobes of least error are not far from the response's.
            assert!(row[3] <= row[2].acos() * 1.0001 + 1e-3, "{row:?}");
        }
    }
}

/// A place by itself, which neighbours can but improve.
#[test]
fn a_place_is_fitted_again() {
    let data = Dataset::load(&committed("ggx_lobes.bin")).unwrap();
    let grid = Grid { n_dot_v: &[0.5], roughness: &[0.25] };
    let fan = grid.fans(8, Amplitude::Free, &|| ())[0].model;
    // Node 8 of 16 along one axis, 4 of 16 along the other.
    let row: Vec<f32> = data.validation.columns.iter().map(|column| column[8 * 17 + 4]).collect();
    let found = [fan.theta.cos(), fan.spread, fan.amplitude.ln(), fan.lambda.ln()];
    assert_eq!(row[..2], [0.5, 0.25]);
    for (found, &made) in found.into_iter().zip(&row[2..]) {
        assert!((found - f64::from(made)).abs() < 2e-3, "{found} {row:?}");
    }
}

#[test]
fn small_tables_have_their_rows() {
    let recipe = "(target: \"ggx_lobes\", amplitude: \"normalised\", lobes: 1, points: 2)";
    let done = AtomicUsize::new(0);
    let small = generate(&Recipe::parse(recipe).unwrap(), &|_, total| {
        assert_eq!(total, 4 + 9);
        done.fetch_add(1, Ordering::Relaxed);
    });
    let small = small.unwrap();
    assert_eq!(done.into_inner(), 13);
    assert_eq!((&small.search.grid[..], &small.validation.grid[..]), (&[2, 2][..], &[3, 3][..]));
    assert_eq!(small.search.columns[0], [0.25, 0.25, 0.75, 0.75]);
    assert_eq!(small.validation.columns[1], [0.03, 0.5, 1.0].repeat(3));
    assert_eq!(small.validation.weights[..4], [0.25, 0.5, 0.25, 0.5]);
    assert_eq!(small.search.columns[3], [0.0; 4], "one lobe is not spread");
    let misfit = Misfit::new(Response::new(0.25, 0.75 * 0.75), 864);
    let row: Vec<f32> = small.search.columns.iter().map(|column| column[1]).collect();
    let lobe = Fan { count: 1, ..committed_fan(&row) };
    assert!((lobe.integral() / misfit.integral() - 1.0).abs() < 1e-5);
}

/// The weighted squares of a model are its error as a share of the response's own squares.
#[test]
fn responses_are_weighted_as_an_integral() {
    let recipe = Recipe::parse("(target: \"ggx_response\", points: 2, directions: 8000)").unwrap();
    let data = generate(&recipe, &|_, _| ()).unwrap();
    let rows = &data.search;
    let places = [[0.25, 0.25], [0.25, 0.75], [0.75, 0.25], [0.75, 0.75]];
    for place in places {
        let response = Response::new(place[0], place[1] * place[1]);
        let misfit = Misfit::new(response, 3888);
        let near = fan(&Misfit::new(response, 216), 8, Amplitude::Free, &[]).model;
        let lobes = near.lobes();
        let expected = misfit.fan_moments(&near).relative_error();
        let mut sum = 0.0;
        for row in 0..rows.rows() {
            let value = |column: usize| f64::from(rows.columns[column][row]);
            if [value(0), value(1)] != place {
                continue;
            }
            let direction = glam::DVec3::new(value(2), value(3), value(4)).normalize();
            let model: f64 = lobes.iter().map(|lobe| lobe.value(direction)).sum();
            sum += f64::from(rows.weights[row]) * (value(5) - model).powi(2);
        }
        assert!((sum / expected - 1.0).abs() < 0.03, "{place:?}: {sum} {expected}");
    }
}
