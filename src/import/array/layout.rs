//! What an array's axes and channels mean, and the dataset of it.

use super::axes::{AxisNames, Placed, placed};
use super::channels::{ChannelNames, Chosen, chosen};
use super::error::{counted, times};
use super::{Array, Error, Fault};
use crate::dataset::{Column, Dataset, Origin, Split, domain_of};
use crate::import::split_rows;
use crate::printable::printable;
use crate::program::shortest;
use std::path::Path;

/// More rows than a search needs, so that fewer are suggested. By hand: thousands are usual.
const MANY_ROWS: usize = 100_000;

/// What an array's axes and channels mean.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    /// The axes, x first; those of the file, or `u`, `v`, `w` from 0 to 1, if empty.
    pub axes: AxisNames,
    /// Whether the first and last texels are at the ends of the axes, and not half a texel inside.
    /// Lookup tables that say their domain always are ([`Array::corners`]).
    pub corners: bool,
    /// The outputs; all channels, but for an alpha that is 1 throughout, if empty.
    pub channels: ChannelNames,
    /// Whether the last row is the first along y.
    pub flip_y: bool,
    /// Which texels are rows of the dataset: every nth along each axis; 0 and 1 for all.
    pub every: usize,
}

impl Layout {
    /// Makes a dataset of an array: a row a texel, the first axis varying slowest. The axes are inputs
    /// whose domains reach from end to end; the channels are outputs. Rows go to the two splits as
    /// those of a table do: one of four to validation, scattered, the ends of each axis to the search
    /// split. Errors name `path`, and the dataset is called as its file.
    ///
    /// Returns lines for a person, too: what was understood.
    ///
    /// # Errors
    /// [`Error`]: another number of axes than the array has; no such channel; a value that is not
    /// finite; names that are no identifiers or occur twice; nothing left by `every`.
    pub fn dataset(&self, path: &Path, array: &Array) -> Result<(Dataset, Vec<String>), Error> {
        self.made(path, array).map_err(|fault| fault.of(path))
    }

    /// Makes a table, as CSV, of an array of rows and columns, columns varying fastest: one axis and
    /// its channels, or two axes. The columns are called as [`Layout::channels`] says. No other field
    /// counts.
    ///
    /// # Errors
    /// [`Error`]: pictures and arrays of more axes; no such channel; a value that is not finite.
    pub fn table(&self, path: &Path, array: &Array) -> Result<String, Error> {
        let columns = match (array.size.as_slice(), array.channels.len()) {
            ([_], _) => array.channels.clone(),
            (&[columns, _], 1) if !array.is_picture => Array::unnamed_channels(columns),
            (size, channels) => {
                let channels = counted(channels, "channel");
                let problem = format!(
                    "{} texels of {channels} are no table of rows and columns",
                    times(size)
                );
                let advice = "leave --inputs out: the axes are the inputs (--axes names them)";
                return Err(Fault::new(problem, advice).of(path));
            }
        };
        let rows = array.values.len() / columns.len();
        let array = &Array { size: vec![rows], channels: columns, ..array.clone() };
        let chosen = chosen(array, &self.channels, &[]).map_err(|fault| fault.of(path))?;
        check_finite(array, &chosen).map_err(|fault| fault.of(path))?;
        let names: Vec<&str> = chosen.iter().map(|chosen| chosen.name.as_str()).collect();
        let mut text = names.join(",") + "\n";
        for row in array.values.chunks_exact(array.channels.len()) {
            let cells: Vec<String> =
                chosen.iter().map(|chosen| format!("{:?}", row[chosen.channel])).collect();
            text += &cells.join(",");
            text.push('\n');
        }
        Ok(text)
    }

    fn made(&self, path: &Path, array: &Array) -> Result<(Dataset, Vec<String>), Fault> {
        if self.flip_y && array.size.len() < 2 {
            return Err(Fault::new(
                "it has one axis, and --flip-y turns the second",
                "leave it out",
            ));
        }
        let axes = placed(array, &self.axes, self.corners || array.corners)?;
        let inputs: Vec<&str> = axes.iter().map(|placed| &placed.axis.name[..]).collect();
        let chosen = chosen(array, &self.channels, &inputs)?;
        check_finite(array, &chosen)?;
        let taken = self.taken(array)?;
        let whole =
            Split { columns: self.columns(array, &axes, &chosen, &taken), ..Split::default() };
        let (search, validation) = split_rows(&whole, axes.len());
        let output = |(index, chosen): (usize, &Chosen)| {
            Column::new(&chosen.name, domain_of(&search, &validation, axes.len() + index))
        };
        let lossy = |part: Option<&std::ffi::OsStr>| {
            part.unwrap_or_default().to_string_lossy().into_owned()
        };
        let dataset = Dataset {
            name: lossy(path.file_stem()),
            origin: Origin::Import { file: lossy(path.file_name()), renamed: Vec::new() },
            inputs: axes.iter().map(Placed::column).collect(),
            outputs: chosen.iter().enumerate().map(output).collect(),
            search,
            validation,
            ..Dataset::default()
        };
        dataset.validate_as(path).map_err(Fault::Dataset)?;
        Ok((dataset, self.understood(array, &axes, &chosen, &taken)))
    }

    /// Returns the indices of the texels that are taken along each axis.
    fn taken(&self, array: &Array) -> Result<Vec<Vec<usize>>, Fault> {
        let step = self.every.max(1);
        let first = if self.corners || array.corners { 0 } else { (step - 1) / 2 };
        let along = |&texels: &usize| (first..texels).step_by(step).collect::<Vec<_>>();
        let taken: Vec<Vec<usize>> = array.size.iter().map(along).collect();
        match taken.iter().position(|along| along.len() < 2) {
            None => Ok(taken),
            Some(axis) => {
                let problem = format!(
                    "--every {step} leaves {} of {} along an axis",
                    taken[axis].len(),
                    counted(array.size[axis], "texel")
                );
                Err(Fault::new(problem, "take more of them"))
            }
        }
    }

    /// Returns the inputs' columns and the outputs'.
    fn columns(
        &self,
        array: &Array,
        axes: &[Placed],
        chosen: &[Chosen],
        taken: &[Vec<usize>],
    ) -> Vec<Vec<f32>> {
        let rows = taken.iter().map(Vec::len).product();
        let mut columns = vec![Vec::with_capacity(rows); axes.len() + chosen.len()];
        let mut strides = vec![1; axes.len()];
        for axis in 1..axes.len() {
            strides[axis] = strides[axis - 1] * array.size[axis - 1];
        }
        let mut index = vec![0; axes.len()];
        for _ in 0..rows {
            let mut texel = 0;
            for (axis, &along) in index.iter().enumerate() {
                let place = taken[axis][along];
                columns[axis].push(axes[axis].places[place]);
                let turned = self.flip_y && axis == 1;
                texel += strides[axis] * if turned { array.size[1] - 1 - place } else { place };
            }
            for (column, chosen) in columns[axes.len()..].iter_mut().zip(chosen) {
                column.push(array.values[texel * array.channels.len() + chosen.channel]);
            }
            for axis in (0..index.len()).rev() {
                index[axis] += 1;
                if index[axis] < taken[axis].len() {
                    break;
                }
                index[axis] = 0;
            }
        }
        columns
    }

    /// Says what was made of the array.
    fn understood(
        &self,
        array: &Array,
        axes: &[Placed],
        chosen: &[Chosen],
        taken: &[Vec<usize>],
    ) -> Vec<String> {
        let texels = counted(array.size.iter().product(), "texel");
        let size =
            if array.size.len() > 1 { format!("{} texels", times(&array.size)) } else { texels };
        let channels = counted(array.channels.len(), "channel");
        let mut lines = vec![format!("understood: {}: {size}, {channels}", printable(&array.kind))];
        for (index, placed) in axes.iter().enumerate() {
            lines.push(format!("  {}", self.axis(array, index, placed)));
        }
        let names = chosen.iter().map(|chosen| {
            let of = printable(&array.channels[chosen.channel]);
            if of == chosen.name { chosen.name.clone() } else { format!("{} = {of}", chosen.name) }
        });
        let mut outputs = format!("  outputs: {}", names.collect::<Vec<_>>().join(", "));
        let is_left_out = |index: &usize| chosen.iter().all(|chosen| chosen.channel != *index);
        let left_out = (0..array.channels.len()).filter(is_left_out);
        let left_out: Vec<_> = left_out.map(|index| printable(&array.channels[index])).collect();
        if !left_out.is_empty() {
            outputs += &format!("; left out: {}", left_out.join(", "));
        }
        lines.push(outputs);
        if self.every > 1 {
            let left: Vec<usize> = taken.iter().map(Vec::len).collect();
            lines.push(format!("  one of {} texels along each axis: {}", self.every, times(&left)));
        }
        let rows: usize = taken.iter().map(Vec::len).product();
        if rows > MANY_ROWS {
            lines.push(format!(
                "  {rows} rows, and a search takes time for each: --every takes fewer"
            ));
        }
        lines.extend(chosen.iter().filter_map(|chosen| constant(array, chosen)));
        lines.extend(array.notes.iter().map(|note| format!("  {}", printable(note))));
        if axes.iter().any(|placed| placed.is_unnamed) {
            let example =
                ["n_dot_v=0..1", "roughness=0..1", "f0=0..1"][..axes.len().min(3)].join(",");
            lines.push(format!("  nothing names the axes: --axes \"{example}\" does, for example"));
        }
        lines
    }

    fn axis(&self, array: &Array, index: usize, placed: &Placed) -> String {
        let place = match (index, array.is_picture) {
            _ if array.size.len() == 1 => "x",
            (0, true) => "x, from the left",
            (1, true) if self.flip_y => "y, from the bottom",
            (1, true) => "y, from the top",
            (0, false) => "x, which varies fastest",
            (1, false) if self.flip_y => "y, from its end",
            (1, _) => "y",
            (2, _) => "z",
            _ => "an axis that varies more slowly",
        };
        let [first, last] = placed.axis.domain;
        let kind = match self.corners || array.corners {
            true => "the first and last texels are the ends",
            false => "texel centres",
        };
        let scale = match placed.axis.spacing {
            crate::dataset::Spacing::Linear => "",
            crate::dataset::Spacing::Logarithmic => ", logarithmic",
        };
        let ends = format!("{} to {}", shortest(first), shortest(last));
        format!("{} along {place}: {ends}, {kind}{scale}", placed.axis.name)
    }
}

impl Placed {
    fn column(&self) -> Column {
        let [first, last] = self.axis.domain;
        Column { domain: [first.min(last), first.max(last)], ..self.axis.column() }
    }
}

/// Says that an output has one value throughout.
fn constant(array: &Array, chosen: &Chosen) -> Option<String> {
    let mut values = array.values.iter().skip(chosen.channel).step_by(array.channels.len());
    let first = values.next()?;
    let name = &chosen.name;
    values.all(|value| value == first).then(|| {
        format!("  {name} is {first} throughout; --channels says which channels are outputs")
    })
}

/// Checks the values of the channels that are used.
fn check_finite(array: &Array, chosen: &[Chosen]) -> Result<(), Fault> {
    let count = array.channels.len();
    let is_used = |channel: usize| chosen.iter().any(|chosen| chosen.channel == channel);
    let mut wrong =
        (0..array.values.len()).filter(|&at| !array.values[at].is_finite() && is_used(at % count));
    let Some(first) = wrong.next() else { return Ok(()) };
    let mut rest = first / count;
    let place = |&along: &usize| {
        let index = rest % along;
        rest /= along;
        index
    };
    Err(Fault::NotFinite {
        texel: array.size.iter().map(place).collect(),
        channel: array.channels[first % count].clone(),
        value: array.values[first],
        count: 1 + wrong.count(),
    })
}
