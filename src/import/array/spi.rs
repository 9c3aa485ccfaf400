//! Lookup tables of Sony Pictures Imageworks (`.spi1d`, `.spi3d`).

use super::error::counted;
use super::shape::Shape;
use super::text::{exactly, lines, narrowed, size, text};
use super::{Array, Fault, FileAxis, Request};

const WRITE_AGAIN: &str = "write the table again";

pub(super) fn read_1d(content: &[u8], _: &Request) -> Result<Array, Fault> {
    let (mut ends, mut length, mut components) = ([0.0, 1.0], None, 1);
    let mut lines = lines(text(content)?);
    let mut last = 1;
    // The header ends where the numbers begin.
    let shape = loop {
        let Some((line, row)) = lines.next() else {
            return Err(Fault::at(last, "there are no numbers in { }", WRITE_AGAIN));
        };
        last = line;
        let (word, rest) = row.split_once(char::is_whitespace).unwrap_or((row, ""));
        match word.to_ascii_lowercase().as_str() {
            "version" if rest.trim() == "1" => {}
            "from" => ends = exactly(line, rest)?,
            "length" => length = Some(size(line, rest)?),
            "components" => components = channels(line, rest)?,
            "{" => {
                let advice = "write a line as in Length 1024 above the numbers";
                let length = length.ok_or_else(|| Fault::at(line, "no Length", advice))?;
                break Shape::new(vec![length], components)?;
            }
            _ => {
                let row = crate::printable::printable(row).into_owned();
                return Err(Fault::at(line, format!("`{row}` is not read"), WRITE_AGAIN));
            }
        }
    };
    let mut values = Vec::new();
    for (line, row) in lines {
        last = line;
        if row.starts_with('}') {
            break;
        }
        if values.len() == shape.values() {
            let problem = format!("more than {} of numbers", counted(shape.size[0], "row"));
            return Err(Fault::at(line, problem, WRITE_AGAIN));
        }
        values.extend(narrowed(line, row, components)?);
    }
    if values.len() < shape.values() {
        let problem = format!("truncated: {} of {} rows", values.len() / components, shape.size[0]);
        return Err(Fault::at(last, problem, WRITE_AGAIN));
    }
    Ok(Array {
        kind: "SPI 1D table".to_owned(),
        size: shape.size,
        channels: Array::unnamed_channels(components),
        values,
        axes: vec![FileAxis { name: "x".to_owned(), ends }],
        corners: true,
        ..Array::default()
    })
}

fn channels(line: usize, text: &str) -> Result<usize, Fault> {
    let channels = text.trim().parse().ok().filter(|channels| (1..=3).contains(channels));
    channels.ok_or_else(|| Fault::at(line, "Components is not 1, 2 or 3", WRITE_AGAIN))
}

pub(super) fn read_3d(content: &[u8], _: &Request) -> Result<Array, Fault> {
    let mut lines = lines(text(content)?);
    let mut header =
        || lines.next().ok_or_else(|| Fault::new("its header has not three lines", WRITE_AGAIN));
    let (line, first) = header()?;
    if !first.to_ascii_uppercase().starts_with("SPILUT") {
        return Err(Fault::at(line, "the first line is not `SPILUT 1.0`", WRITE_AGAIN));
    }
    let (line, counts) = header()?;
    if exactly(line, counts)? != [3.0, 3.0] {
        let problem = "it is not from three numbers to three (`3 3`)";
        return Err(Fault::at(line, problem, "write it as a 3D table"));
    }
    let (line, sizes) = header()?;
    let sizes: Vec<usize> =
        sizes.split_whitespace().map(|word| size(line, word)).collect::<Result<_, Fault>>()?;
    if sizes.len() != 3 {
        return Err(Fault::at(line, "three sizes should stand here", WRITE_AGAIN));
    }
    let shape = Shape::new(sizes, 3)?;
    let entries = shape.values() / 3;
    // The longest files have a row of at least 12 bytes for each entry.
    if content.len() < 12 * entries {
        let (expected, found) = (12 * entries as u64, content.len() as u64);
        return Err(Fault::Truncated { expected, found });
    }
    let mut values = vec![f32::NAN; shape.values()];
    let mut found = 0;
    for (line, row) in lines {
        let row = narrowed(line, row, 6)?;
        let at = place(&row[..3], &shape.size).ok_or_else(|| {
            Fault::at(line, "the first three numbers are no indices of the table", WRITE_AGAIN)
        })?;
        if !values[3 * at].is_nan() {
            return Err(Fault::at(line, "an entry that stands above, too", WRITE_AGAIN));
        }
        if row.iter().any(|value| value.is_nan()) {
            return Err(Fault::at(line, "a value is not a number", "repair it in the file"));
        }
        values[3 * at..][..3].copy_from_slice(&row[3..]);
        found += 1;
    }
    if found < entries {
        return Err(Fault::new(format!("truncated: {found} of {entries} entries"), WRITE_AGAIN));
    }
    let axis = |name: &str| FileAxis { name: name.to_owned(), ends: [0.0, 1.0] };
    Ok(Array {
        kind: "SPI 3D table".to_owned(),
        size: shape.size,
        channels: Array::unnamed_channels(3),
        values,
        axes: ["r", "g", "b"].map(axis).into(),
        corners: true,
        ..Array::default()
    })
}

/// Returns the number of the entry of these indices, the first index varying fastest.
fn place(indices: &[f32], size: &[usize]) -> Option<usize> {
    let mut place = 0;
    for (&index, &along) in indices.iter().zip(size).rev() {
        let whole = index as usize;
        if whole as f32 != index || whole >= along {
            return None;
        }
        place = place * along + whole;
    }
    Some(place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_read() {
        let text = "Version 1\nFrom -0.5 2\nLength 3\nComponents 2\n{\n 0 1\n 0.5 2\n 1 3\n}\n";
        let curve = read_1d(text.as_bytes(), &Request::default()).unwrap();
        assert_eq!((curve.size, curve.axes[0].ends), (vec![3], [-0.5, 2.0]));
        assert_eq!(curve.values, [0.0, 1.0, 0.5, 2.0, 1.0, 3.0]);
        for (from, to, says) in [
            ("Length 3", "Length 4", "3 of 4 rows"),
            ("Length 3", "Length 2", "line 8: more than 2 rows"),
            ("Length 3\n", "", "no Length"),
            ("Components 2", "Components 4", "line 4: Components"),
            ("\n 0.5 2", "\n 0.5", "line 7: 1 number,"),
            ("{", "", "`0 1` is not read"),
            ("Version 1", "Version 2", "line 1: `Version 2` is not read"),
        ] {
            let text = text.replacen(from, to, 1);
            let refused = read_1d(text.as_bytes(), &Request::default()).unwrap_err().to_string();
            assert!(refused.contains(says), "{to:?}: {refused}");
        }
    }

    #[test]
    fn entries_of_a_cube_stand_where_their_indices_say() {
        let mut text = "SPILUT 1.0\n3 3\n2 2 2\n".to_owned();
        for (r, g, b) in (0..8).map(|i| (i / 4, i / 2 % 2, i % 2)) {
            text += &format!("{r} {g} {b} {r}.25 {g}.5 {b}.75\n");
        }
        let cube = read_3d(text.as_bytes(), &Request::default()).unwrap();
        assert_eq!(cube.values[..6], [0.25, 0.5, 0.75, 1.25, 0.5, 0.75]);
        for (from, to, says) in [
            ("1 1 1 ", "1 1 2 ", "no indices"),
            ("1 1 1 ", "0 0 0 ", "stands above"),
            ("1 1 1 1.25 1.5 1.75\n", "", "7 of 8 entries"),
            ("3 3", "1 3", "line 2"),
            ("2 2 2", "2 2", "line 3"),
            ("2 2 2", "4000 4000 4000", "4000 × 4000 × 4000"),
            ("SPILUT", "LUT", "line 1"),
        ] {
            let text = text.replacen(from, to, 1);
            let refused = read_3d(text.as_bytes(), &Request::default()).unwrap_err().to_string();
            assert!(refused.contains(says), "{to:?}: {refused}");
        }
    }
}
