//! Scenes from a frame's log of its pixels' inputs.

use super::histogram::bin;
use super::{Error, Histogram, Scene};

/// The most inputs of a joint histogram: with more, most bins of a log are empty. Chosen by hand,
/// unmeasured.
const MAX_JOINT: usize = 3;

/// A column of a log: an input's value at each pixel.
#[derive(Clone, Copy, Debug)]
pub struct Logged<'a> {
    /// The name of the input.
    pub name: &'a str,
    /// Its value at each logged pixel.
    pub values: &'a [f32],
}

impl Scene {
    /// Makes the scene of logged pixels. Inputs that never change are fixed; each other one is
    /// counted in `bins` equal bins over the range that occurs. If `joint` and there are at most
    /// three, one histogram holds all of them, which keeps their correlations; otherwise each has
    /// its own. Each pixel counts by its weight, one if there are no weights; pixels of weight zero
    /// are ignored.
    ///
    /// # Errors
    /// [`Error::Histogram`] if no pixel has a weight above zero.
    ///
    /// # Panics
    /// If columns or weights differ in length, or `bins` is zero.
    pub fn logged(
        name: &str,
        columns: &[Logged],
        weights: Option<&[f32]>,
        bins: usize,
        joint: bool,
    ) -> Result<Scene, Error> {
        let pixels = columns.first().map_or(0, |column| column.values.len());
        let weight = |pixel: usize| weights.map_or(1.0, |weights| f64::from(weights[pixel]));
        let occurring: Vec<usize> = (0..pixels).filter(|&pixel| weight(pixel) > 0.0).collect();
        if occurring.is_empty() {
            let inputs = columns.iter().map(|column| column.name).collect::<Vec<_>>().join(", ");
            let problem = "no pixel has a weight above zero".to_owned();
            return Err(Error::Histogram { scene: name.to_owned(), inputs, problem });
        }
        let mut scene = Scene {
            name: name.to_owned(),
            description: format!("What {} logged pixels needed.", occurring.len()),
            ..Scene::default()
        };
        let mut varying: Vec<(Logged, [f64; 2])> = Vec::new();
        for column in columns {
            let values = || occurring.iter().map(|&pixel| column.values[pixel]);
            let low = values().fold(f32::INFINITY, f32::min);
            let high = values().fold(f32::NEG_INFINITY, f32::max);
            match low == high {
                true => scene.fixed.push((column.name.to_owned(), shortest(low))),
                false => varying.push((*column, [shortest(low), shortest(high)])),
            }
        }
        let groups: Vec<&[(Logged, [f64; 2])]> = match joint && varying.len() <= MAX_JOINT {
            true => vec![&varying[..]],
            false => varying.chunks(1).collect(),
        };
        for group in groups.into_iter().filter(|group| !group.is_empty()) {
            let mut counts = vec![0.0; bins.pow(group.len() as u32)];
            for &pixel in &occurring {
                let along =
                    group.iter().map(|(column, over)| bin(column.values[pixel], *over, bins));
                let place = along.fold(0, |place, along| place * bins + along.unwrap_or(0));
                counts[place] += weight(pixel);
            }
            scene.histograms.push(Histogram {
                inputs: group.iter().map(|(column, _)| column.name.to_owned()).collect(),
                over: group.iter().map(|(_, over)| *over).collect(),
                bins: vec![bins; group.len()],
                counts,
            });
        }
        Ok(scene)
    }
}

/// Returns the number with the shortest digits of an `f32`, without those of its rounding.
fn shortest(value: f32) -> f64 {
    value.to_string().parse().unwrap_or_else(|_| f64::from(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_become_counts() {
        let a = Logged { name: "a", values: &[0.0, 0.25, 1.0, 5.0, 0.9] };
        let b = Logged { name: "b", values: &[0.2, 0.1, 0.2, 0.1, 0.1] };
        let c = Logged { name: "c", values: &[0.3, 0.3, 0.3, 7.0, 0.3] };
        let weights = Some(&[1.0, 2.0, 0.5, 0.0, 4.0][..]);
        let scene = Scene::logged("s", &[a, b, c], weights, 2, true).unwrap();
        assert_eq!(scene.fixed, [("c".to_owned(), 0.3)]);
        let [histogram] = &scene.histograms[..] else { panic!("{scene:?}") };
        assert_eq!(histogram.inputs, ["a", "b"]);
        assert_eq!(histogram.over, [[0.0, 1.0], [0.1, 0.2]]);
        assert_eq!(histogram.counts, [2.0, 1.0, 4.0, 0.5]);
        let apart = Scene::logged("s", &[a, b, c], None, 2, false).unwrap();
        assert_eq!(apart.histograms[0].over, [[0.0, 5.0]]);
        assert_eq!(apart.histograms[0].counts, [4.0, 1.0]);
        assert_eq!(apart.histograms[1].counts, [3.0, 2.0]);
        assert!(Scene::logged("s", &[a], Some(&[0.0; 5]), 2, true).is_err());
    }
}
