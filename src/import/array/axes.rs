//! The names and the ends of an array's axes.

use super::{Array, Fault};
use crate::dataset::{Axis, Spacing};
use std::str::FromStr;

/// The names of axes where neither the file nor the user gives any.
const UNNAMED: [&str; 3] = ["u", "v", "w"];

/// What is said of an axis: `roughness=0.05..1:log`.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisName {
    /// The input's name.
    pub name: String,
    /// Its value at the axis's two ends, the first being that of the first texel; `None` for those of
    /// the file, or 0 to 1.
    pub ends: Option<[f64; 2]>,
    /// Whether texels are equidistant in the logarithm.
    pub logarithmic: bool,
}

/// What is said of all axes: `n_dot_v=0..1,roughness=0..1`, x first; empty if nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AxisNames(pub Vec<AxisName>);

impl FromStr for AxisNames {
    type Err = String;

    fn from_str(text: &str) -> Result<AxisNames, String> {
        text.split(',').map(|axis| axis_name(axis.trim())).collect::<Result<_, _>>().map(AxisNames)
    }
}

fn axis_name(text: &str) -> Result<AxisName, String> {
    let explained = "write axes as in n_dot_v=0..1,roughness=0.05..1:log, the one along x first";
    let (text, logarithmic) = match text.rsplit_once(':') {
        Some((rest, "log")) => (rest, true),
        Some((_, other)) => return Err(format!("`{other}` is no kind of axis; {explained}")),
        None => (text, false),
    };
    let (name, ends) = match text.split_once('=') {
        Some((name, ends)) => (name, Some(ends)),
        None => (text, None),
    };
    if name.trim().is_empty() {
        return Err(format!("an axis has no name; {explained}"));
    }
    let number =
        |text: &str| text.trim().parse::<f64>().ok().filter(|end| (*end as f32).is_finite());
    let pair = |text: &str| {
        let (first, last) = text.split_once("..")?;
        Some([number(first)?, number(last)?])
    };
    let ends = match ends.map(|text| (text, pair(text))) {
        Some((text, None)) => return Err(format!("`{text}` is no range; {explained}")),
        Some((_, ends)) => ends,
        None => None,
    };
    match ends {
        Some([first, last]) if first == last => {
            Err(format!("the axis {name} goes from {first} to {last}; its ends must differ"))
        }
        Some(ends) if logarithmic && ends.iter().any(|end| *end <= 0.0) => {
            Err(format!("the axis {name} is logarithmic; its ends must be above 0"))
        }
        None if logarithmic => {
            Err(format!("the axis {name} is logarithmic; say its ends; {explained}"))
        }
        ends => Ok(AxisName { name: name.trim().to_owned(), ends, logarithmic }),
    }
}

/// An axis of a dataset to be.
pub(super) struct Placed {
    pub axis: Axis,
    /// Whether neither the file nor the user named it.
    pub is_unnamed: bool,
    /// The input's value at each texel, in the array's order.
    pub places: Vec<f32>,
}

/// Places an array's texels along its axes.
///
/// # Errors
/// Another number of axes than the array has; texels that 32-bit floats do not tell apart.
pub(super) fn placed(
    array: &Array,
    names: &AxisNames,
    corners: bool,
) -> Result<Vec<Placed>, Fault> {
    let AxisNames(names) = names;
    let (found, size) = (names.len(), super::error::times(&array.size));
    if array.size.is_empty() {
        return Err(Fault::new("it is a single texel", "a search needs more"));
    }
    if found != 0 && found != array.size.len() {
        let axes = if found == 1 { "1 axis".into() } else { format!("{found} axes") };
        let problem = format!("it has {size} texels, and --axes names {axes}");
        return Err(Fault::new(problem, "name as many as it has, the one along x first"));
    }
    if array.size.len() > UNNAMED.len() && found == 0 && array.axes.is_empty() {
        let problem = format!("it has {} axes ({size})", array.size.len());
        return Err(Fault::new(problem, "name them with --axes, the fastest first"));
    }
    let of = |(index, &texels): (usize, &usize)| {
        let file = array.axes.get(index);
        let given = names.get(index);
        let name = given.map(|given| &given.name[..]).or(file.map(|file| &file.name[..]));
        let ends = given.and_then(|given| given.ends).or(file.map(|file| file.ends));
        let is_unnamed = name.is_none();
        let axis = Axis {
            name: name.unwrap_or_else(|| UNNAMED[index]).to_owned().into(),
            domain: ends.unwrap_or([0.0, 1.0]),
            spacing: match given.is_some_and(|given| given.logarithmic) {
                true => Spacing::Logarithmic,
                false => Spacing::Linear,
            },
            ..Axis::unit("")
        };
        let places = if corners { axis.nodes(texels - 1) } else { axis.centres(texels) };
        if let Some(pair) = places.windows(2).position(|pair| pair[0] == pair[1]) {
            let problem = format!(
                "texels {pair} and {} along {} are both at {} in 32-bit floats",
                pair + 1,
                axis.name,
                places[pair]
            );
            return Err(Fault::new(problem, "give the axis other ends, nearer to 0"));
        }
        Ok(Placed { axis, is_unnamed, places })
    };
    array.size.iter().enumerate().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_have_names_ends_and_scales() {
        let AxisNames(read) = "n_dot_v=0..1, roughness = 1..-0.5,d=1e-2..4:log,z".parse().unwrap();
        let axis =
            |name: &str, ends, logarithmic| AxisName { name: name.into(), ends, logarithmic };
        assert_eq!(
            read,
            [
                axis("n_dot_v", Some([0.0, 1.0]), false),
                axis("roughness", Some([1.0, -0.5]), false),
                axis("d", Some([0.01, 4.0]), true),
                axis("z", None, false)
            ]
        );
        for text in [
            "",
            "a,,b",
            "a=0",
            "a=0..",
            "a=0..nan",
            "a=0..1e60",
            "a=1..1",
            "a=0..1:log",
            "a:log",
            "a=0..1:lin",
        ] {
            assert!(text.parse::<AxisNames>().is_err(), "{text}");
        }
    }
}
