//! What a projection's parameters say, in words: the questions at the end of §4.2.2 of the course
//! notes (Pesce & Iwanicki 2015).

use crate::dataset::Column;
use crate::project::{Dependence, Place, Projection, Surfaces};
use crate::report::maps::end_text;
use crate::wording::error_text;

/// Says where parameters lie on their bounds, and what they hardly depend on.
pub fn findings(
    projection: &Projection,
    surfaces: &Surfaces,
    dependences: &[Dependence],
) -> Vec<String> {
    let mut found = Vec::new();
    for parameter in 0..surfaces.labels.len() {
        found.extend(on_bounds(projection, surfaces, parameter));
        let own = dependences.iter().filter(|one| one.parameter == parameter && one.is_weak);
        found.extend(independent(surfaces, parameter, own.collect()));
    }
    found
}

fn on_bounds(projection: &Projection, surfaces: &Surfaces, parameter: usize) -> Vec<String> {
    let name = &surfaces.labels[parameter];
    let bounds = projection.model().parameters()[parameter].bounds;
    let places = surfaces.on_bounds(projection, parameter);
    let all = surfaces.search.len();
    let sides = ["lower", "upper"].into_iter().zip(bounds).zip(places);
    let sentence = |((side, bound), places): ((&str, f32), Vec<&Place>)| {
        let (count, bound, region) = (places.len(), end_text(bound), region(surfaces, &places));
        (count > 0).then(|| {
            format!("{name} lies on its {side} bound {bound} in {count} of {all} groups: {region}")
        })
    };
    sides.filter_map(sentence).collect()
}

/// Returns the ranges that places span.
fn region(surfaces: &Surfaces, places: &[&Place]) -> String {
    let along = |(axis, column): (usize, &Column)| {
        let values = places.iter().map(|place| place.at[axis]);
        let least = values.clone().fold(f32::INFINITY, f32::min);
        let most = values.fold(f32::NEG_INFINITY, f32::max);
        match least == most {
            true => format!("{} {}", column.name, end_text(least)),
            false => format!("{} {}…{}", column.name, end_text(least), end_text(most)),
        }
    };
    let parts: Vec<String> = surfaces.over.iter().enumerate().map(along).collect();
    parts.join(", ")
}

fn independent(surfaces: &Surfaces, parameter: usize, weak: Vec<&Dependence>) -> Vec<String> {
    let name = &surfaces.labels[parameter];
    let was = error_text(surfaces.rmse());
    if let Some(constant) = weak.iter().find(|one| one.input.is_none()) {
        let rmse = error_text(constant.rmse);
        return vec![format!("{name} may as well be a constant: RMSE {rmse} in place of {was}")];
    }
    let sentence = |one: &&Dependence| {
        let (input, rmse) = (&surfaces.over[one.input?].name, error_text(one.rmse));
        Some(format!(
            "{name} hardly depends on {input}: with its mean over {input}, RMSE {rmse} in place of {was}"
        ))
    };
    weak.iter().filter_map(sentence).collect()
}
