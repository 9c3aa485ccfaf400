//! Reading a scene over a dataset's columns.

use super::histogram::Density;
use super::view::Input;
use super::{Error, Histogram, Scene, View};
use crate::dataset::{Column, Dataset};
use crate::program::{Arg, Names, parse};
use crate::suggest::did_you_mean;

/// The share of a domain by which a range or value may lie beyond it. Chosen by hand, unmeasured.
const SLACK: f64 = 1e-6;

impl Scene {
    /// Reads the scene over a dataset's columns.
    ///
    /// # Errors
    /// [`Error`]: a name that the dataset lacks, or that two parts contain; a range that is empty
    /// or reaches beyond the dataset's domain, or a fixed value outside it; no open input; a
    /// histogram whose counts are missing, all zero, or not one a bin; an invalid expression, tone
    /// map or number of bits.
    pub fn over<'a>(&'a self, whole: &'a Dataset) -> Result<View<'a>, Error> {
        let mut view = View {
            scene: self,
            whole,
            inputs: whole.inputs.iter().map(|input| Input::Open(input.domain)).collect(),
            values: Vec::new(),
            densities: Vec::new(),
            outputs: Vec::new(),
            steps: None,
        };
        view.fix_values()?;
        view.narrow_ranges()?;
        view.read_histograms()?;
        view.read_outputs()?;
        let quantisation = self.quantisation.as_ref();
        view.steps = quantisation.map(|steps| steps.steps(&self.name)).transpose()?;
        view.check_values_are_used()?;
        match view.open_inputs().count() {
            0 => Err(Error::NoInputs { scene: self.name.clone(), dataset: whole.name.clone() }),
            _ => Ok(view),
        }
    }
}

impl<'a> View<'a> {
    fn fix_values(&mut self) -> Result<(), Error> {
        for (name, value) in &self.scene.fixed {
            let Some(index) = self.place(name) else {
                self.values.push((name, *value));
                continue;
            };
            let domain = self.whole.inputs[index].domain;
            let [low, high] = widened(domain);
            if !(low..=high).contains(value) {
                return Err(Error::FixedOutside {
                    scene: self.scene.name.clone(),
                    input: name.clone(),
                    value: *value,
                    dataset: self.whole.name.clone(),
                    domain,
                });
            }
            self.inputs[index] = Input::Fixed(*value);
        }
        Ok(())
    }

    fn narrow_ranges(&mut self) -> Result<(), Error> {
        for (name, range) in &self.scene.ranges {
            let index = self.known_input("`ranges`", name)?;
            if self.inputs[index] != Input::Open(self.whole.inputs[index].domain) {
                return Err(self.twice(name, "`fixed`", "`ranges`"));
            }
            self.inputs[index] = Input::Open(self.within("range", index, *range)?);
        }
        Ok(())
    }

    /// Checks that the dataset covers a range of an input, and clips it to the domain.
    fn within(&self, what: &'static str, index: usize, range: [f64; 2]) -> Result<[f64; 2], Error> {
        let Column { name, domain, .. } = &self.whole.inputs[index];
        let (scene, input) = (self.scene.name.clone(), name.clone());
        let [low, high] = range;
        if low.partial_cmp(&high) != Some(std::cmp::Ordering::Less) {
            return Err(Error::EmptyRange { scene, input, low, high });
        }
        let [least, greatest] = widened(*domain);
        if low < least || high > greatest {
            let (dataset, domain) = (self.whole.name.clone(), *domain);
            return Err(Error::RangeOutside { scene, what, input, low, high, dataset, domain });
        }
        Ok([low.max(domain[0]), high.min(domain[1])])
    }

    fn read_histograms(&mut self) -> Result<(), Error> {
        let mut read: Vec<usize> = Vec::new();
        for histogram in &self.scene.histograms {
            histogram.check(&self.scene.name)?;
            let mut columns = Vec::new();
            for name in &histogram.inputs {
                let index = self.known_input("a histogram", name)?;
                if read.contains(&index) {
                    return Err(self.twice(name, "a histogram", "another"));
                }
                read.push(index);
                columns.push(index);
            }
            let over = self.narrow_to(histogram, &columns)?;
            let is_open = |input: &&Input| matches!(input, Input::Open(_));
            let open = |index: &usize| self.inputs[..*index].iter().filter(is_open).count();
            let columns: Vec<usize> = columns.iter().map(open).collect();
            self.densities.push(Density::new(histogram, &columns, &over));
        }
        Ok(())
    }

    /// Returns the ranges that a histogram's bins divide, by input, and narrows the inputs to them.
    fn narrow_to(
        &mut self,
        histogram: &Histogram,
        columns: &[usize],
    ) -> Result<Vec<[f64; 2]>, Error> {
        let mut over = Vec::new();
        for (place, &index) in columns.iter().enumerate() {
            let name = &histogram.inputs[place];
            let Input::Open(range) = self.inputs[index] else {
                return Err(self.twice(name, "`fixed`", "a histogram"));
            };
            let Some(&given) = histogram.over.get(place) else {
                over.push(range);
                continue;
            };
            let given = self.within("histogram", index, given)?;
            let [low, high] = [given[0].max(range[0]), given[1].min(range[1])];
            if low >= high {
                return Err(Error::EmptyRange {
                    scene: self.scene.name.clone(),
                    input: name.clone(),
                    low,
                    high,
                });
            }
            self.inputs[index] = Input::Open([low, high]);
            over.push(given);
        }
        Ok(over)
    }

    fn read_outputs(&mut self) -> Result<(), Error> {
        let scene = &self.scene.name;
        let columns = self.whole.inputs.iter().chain(&self.whole.outputs);
        let mut names: Vec<String> = columns.map(|column| column.name.clone()).collect();
        names.extend(self.values.iter().map(|(name, _)| (*name).to_owned()));
        // An output may have a column's name, but no statement may assign to a column.
        let mut target = "value".to_owned();
        while names.contains(&target) {
            target.push('_');
        }
        let over = Names { inputs: names, outputs: vec![target.clone()] };
        for (output, expression) in &self.scene.outputs {
            let text = format!("{target} = {expression}");
            let program = parse(&text, &over).map_err(|error| Error::Expression {
                scene: scene.clone(),
                output: output.clone(),
                error,
            })?;
            if self.open_inputs().any(|(column, _)| column.name == *output) {
                let (scene, output) = (scene.clone(), output.clone());
                return Err(Error::OutputIsInput { scene, output });
            }
            self.outputs.push((output.clone(), program));
        }
        if self.outputs.is_empty() {
            for column in &self.whole.outputs {
                let program = parse(&format!("{target} = {}", column.name), &over);
                // It fails if there are more fixed values than a program can read.
                let program = program.map_err(|error| Error::Expression {
                    scene: scene.clone(),
                    output: column.name.clone(),
                    error,
                })?;
                self.outputs.push((column.name.clone(), program));
            }
        }
        Ok(())
    }

    /// Checks that every fixed value is used: otherwise it is probably a misspelt input.
    fn check_values_are_used(&self) -> Result<(), Error> {
        let columns = self.whole.inputs.len() + self.whole.outputs.len();
        for (place, (name, _)) in self.values.iter().enumerate() {
            let value = Arg::Input((columns + place) as u16);
            let used = self.outputs.iter().any(|(_, program)| {
                let args = program.instrs.iter().flat_map(|instr| instr.args());
                args.chain(&program.outputs).any(|&arg| arg == value)
            });
            if !used {
                return Err(Error::UnusedValue {
                    scene: self.scene.name.clone(),
                    name: (*name).to_owned(),
                    dataset: self.whole.name.clone(),
                    known: self.known(name),
                });
            }
        }
        Ok(())
    }

    fn input_names(&self) -> impl Iterator<Item = &'a str> + use<'a> {
        self.whole.inputs.iter().map(|column| column.name.as_str())
    }

    /// Returns the name probably meant by an unknown one, and the known names.
    fn known(&self, name: &str) -> String {
        let inputs = self.input_names().collect::<Vec<_>>().join(", ");
        format!("{} (inputs: {inputs})", did_you_mean(name, self.input_names()))
    }

    fn place(&self, name: &str) -> Option<usize> {
        self.input_names().position(|known| known == name)
    }

    fn known_input(&self, part: &'static str, name: &str) -> Result<usize, Error> {
        self.place(name).ok_or_else(|| Error::UnknownInput {
            scene: self.scene.name.clone(),
            part,
            name: name.to_owned(),
            dataset: self.whole.name.clone(),
            known: self.known(name),
        })
    }

    fn twice(&self, input: &str, one: &'static str, other: &'static str) -> Error {
        Error::Twice { scene: self.scene.name.clone(), input: input.to_owned(), one, other }
    }
}

fn widened([low, high]: [f64; 2]) -> [f64; 2] {
    let slack = SLACK * (high - low);
    [low - slack, high + slack]
}
