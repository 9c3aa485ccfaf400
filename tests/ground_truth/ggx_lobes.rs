//! Lobes of a GGX surface: parts of the committed tables against what is computed again. The error
//! integral and the fits themselves are compared with another program's in `tests/lobes.rs`.

use crate::{assert_near, committed};
use lgp::dataset::Dataset;
use lgp::lobes::fit::{Amplitude, fan};
use lgp::lobes::{Fan, Misfit, Response};
use lgp::targets::{Recipe, generate};

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
        // From corner to corner.
        for place in [0, 1, 3, 4].map(|quarter| quarter * (split.rows() - 1) / 4) {
            let row: Vec<f32> = split.columns.iter().map(|column| column[place]).collect();
            let [n_dot_v, roughness] = [row[0], row[1]].map(f64::from);
            let misfit = Misfit::new(Response::new(n_dot_v, roughness * roughness), 864);
            let made = misfit.fan_moments(&committed_fan(&row));
            let again = fan(&misfit, 8, Amplitude::Free, &[]);
            let gained = 1.0 - again.error / made.error();
            assert!(gained < 0.01, "{row:?}: {:?} is better by {gained}", again.model);
            // The clamp of the spread, and lobes of least error are not far from the response's.
            assert!(row[3] <= row[2].acos() * 1.0001 + 1e-3, "{row:?}");
        }
    }
}

/// A small grid is made by the same steps.
#[test]
fn a_small_table_is_near_the_committed_one() {
    let recipe = Recipe::parse("(target: \"ggx_lobes\", points: 2)").unwrap();
    let small = generate(&recipe, &|_, _| ()).unwrap();
    let data = Dataset::load(&committed("ggx_lobes.bin")).unwrap();
    // Its centres are nodes of the other's validation split.
    for row in 0..small.search.rows() {
        let of = |split: &lgp::dataset::Split, row: usize| -> Vec<f32> {
            split.columns.iter().map(|column| column[row]).collect()
        };
        let found = of(&small.search, row);
        let [i, j] = [found[0], found[1]].map(|at| (16.0 * at) as usize);
        let made = of(&data.validation, i * 17 + j);
        assert_near(found[0], made[0], "n_dot_v");
        for output in 2..6 {
            assert!((found[output] - made[output]).abs() < 2e-3, "{found:?} {made:?}");
        }
    }
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
            let model: f64 =
                lobes.iter().map(|lobe| lgp::lobes::Lobe::value(lobe, direction)).sum();
            sum += f64::from(rows.weights[row]) * (value(5) - model).powi(2);
        }
        assert!((sum / expected - 1.0).abs() < 0.03, "{place:?}: {sum} {expected}");
    }
}
