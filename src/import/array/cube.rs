//! Lookup tables of Adobe and Resolve (`.cube`).

use super::error::counted;
use super::shape::Shape;
use super::text::{exactly, lines, narrowed, size, text};
use super::{Array, Fault, FileAxis, Request};

const INPUTS: [&str; 3] = ["r", "g", "b"];

/// What the lines before the numbers say.
#[derive(Default)]
struct Header {
    /// The number of axes, and the entries along each.
    size: Option<(usize, usize)>,
    domain: [Option<[f64; 3]>; 2],
}

pub(super) fn read(content: &[u8], _: &Request) -> Result<Array, Fault> {
    let mut header = Header::default();
    let mut shape = None;
    let mut values = Vec::new();
    for (line, row) in lines(text(content)?) {
        if header.takes(line, row)? {
            continue;
        }
        if shape.is_none() {
            shape = Some(header.shape(line)?);
        }
        let wanted = shape.as_ref().map_or(0, Shape::values);
        if values.len() >= wanted {
            let problem = format!("more than {} of numbers", counted(wanted / 3, "row"));
            return Err(Fault::at(line, problem, "write the table again"));
        }
        values.extend(narrowed(line, row, 3)?);
    }
    let shape = match shape {
        Some(shape) => shape,
        None => header.shape(1)?,
    };
    let (found, expected) = (values.len() / 3, shape.values() / 3);
    if found < expected {
        let problem = format!("truncated: {found} of {expected} rows of numbers");
        return Err(Fault::new(problem, "write it again"));
    }
    header.array(shape, values)
}

impl Header {
    /// Takes a line, if it is one of the header.
    fn takes(&mut self, line: usize, row: &str) -> Result<bool, Fault> {
        let (word, rest) = row.split_once(char::is_whitespace).unwrap_or((row, ""));
        match word {
            "TITLE" => {}
            "LUT_1D_SIZE" | "LUT_3D_SIZE" if self.size.is_some() => {
                let problem = "it holds two tables, one before the other";
                return Err(Fault::at(line, problem, "write each to a file of its own"));
            }
            "LUT_1D_SIZE" => self.size = Some((1, size(line, rest)?)),
            "LUT_3D_SIZE" => self.size = Some((3, size(line, rest)?)),
            "DOMAIN_MIN" => self.domain[0] = Some(exactly(line, rest)?),
            "DOMAIN_MAX" => self.domain[1] = Some(exactly(line, rest)?),
            "LUT_1D_INPUT_RANGE" | "LUT_3D_INPUT_RANGE" => {
                let ends: [f64; 2] = exactly(line, rest)?;
                self.domain = ends.map(|end| Some([end; 3]));
            }
            _ if word.starts_with(|c: char| c.is_ascii_alphabetic()) && word.len() > 3 => {
                let word = crate::printable::printable(word).into_owned();
                let problem = format!("`{word}` is not read");
                return Err(Fault::at(
                    line,
                    problem,
                    "take the line out if the table is right without it",
                ));
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn shape(&self, line: usize) -> Result<Shape, Fault> {
        let Some((axes, size)) = self.size else {
            let problem = "no LUT_1D_SIZE or LUT_3D_SIZE before the numbers";
            return Err(Fault::at(line, problem, "write a line as in LUT_3D_SIZE 33"));
        };
        Shape::new(vec![size; axes], 3)
    }

    fn array(&self, shape: Shape, values: Vec<f32>) -> Result<Array, Fault> {
        let [low, high] = [self.domain[0].unwrap_or([0.0; 3]), self.domain[1].unwrap_or([1.0; 3])];
        let axes = shape.size.len();
        let is_same = |ends: [f64; 3]| ends.iter().all(|&end| end == ends[0]);
        if axes == 1 && !(is_same(low) && is_same(high)) {
            let problem = "its channels have domains of their own";
            return Err(Fault::new(problem, "write each channel to a file of its own"));
        }
        let names: &[&str] = if axes == 1 { &["x"] } else { &INPUTS };
        let axis = |(index, name): (usize, &&str)| FileAxis {
            name: name.to_string(),
            ends: [low[index], high[index]],
        };
        Ok(Array {
            kind: format!("cube, {axes}D table"),
            size: shape.size,
            channels: Array::unnamed_channels(3),
            values,
            axes: names.iter().enumerate().map(axis).collect(),
            corners: true,
            ..Array::default()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_of_one_and_three_axes_are_read() {
        let rows: String = (0..8).map(|i| format!("{i} 0 {}.5\n", 7 - i)).collect();
        let text = format!("TITLE \"a b\"\n# c\nLUT_3D_SIZE 2\nDOMAIN_MIN -1 0 0\n{rows}");
        let cube = read(text.as_bytes(), &Request::default()).unwrap();
        assert_eq!(cube.size, [2, 2, 2]);
        assert_eq!(cube.values[3..6], [1.0, 0.0, 6.5]);
        assert_eq!(cube.axes[0].ends, [-1.0, 1.0]);
        assert!(cube.corners);
        let text = "LUT_1D_SIZE 2\r\nLUT_1D_INPUT_RANGE 0 4\r\n0 0 0\r\n1 1e-3 .5\r\n";
        let line = read(text.as_bytes(), &Request::default()).unwrap();
        assert_eq!((line.size, line.axes[0].ends), (vec![2], [0.0, 4.0]));
        assert_eq!(line.values[3..], [1.0, 0.001, 0.5]);
    }

    #[test]
    fn what_does_not_fit_is_refused_with_its_line() {
        for (text, says) in [
            ("LUT_1D_SIZE 2\n0 0 0\n1 1 1\n2 2 2\n", "line 4: more than 2 rows"),
            ("LUT_1D_SIZE 3\n0 0 0\n1 1 1\n", "2 of 3 rows"),
            ("0 0 0\n", "line 1: no LUT_1D_SIZE"),
            ("", "no LUT_1D_SIZE"),
            ("LUT_1D_SIZE 2\n0 0\n", "line 2: 2 numbers,"),
            ("LUT_1D_SIZE 2\n0 x 0\n", "line 2: `x` is not a number"),
            ("LUT_1D_SIZE 2\n0 1e39 0\n", "line 2: 1"),
            ("LUT_3D_SIZE 1\n", "line 1: `1` is no size"),
            ("LUT_3D_SIZE 4000\n0 0 0\n", "4000 × 4000 × 4000"),
            ("LUT_1D_SIZE 2\nLUT_3D_SIZE 2\n", "line 2: it holds two tables"),
            ("LUT_1D_SIZE 2\nDOMAIN_MAX 1 2 3\n0 0 0\n1 1 1\n", "domains of their own"),
            ("LUT_1D_SIZE 2\nWHATEVER 1\n", "`WHATEVER` is not read"),
        ] {
            let refused = read(text.as_bytes(), &Request::default()).unwrap_err().to_string();
            assert!(refused.contains(says), "{text:?}: {refused}");
        }
    }
}
