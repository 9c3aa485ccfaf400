//! A function over the data of columns, where its comments say how columns are made of its
//! parameters and its results of columns.

use super::ReadBack;
use crate::dataset::{Column, Dataset, Split};
use crate::emit::arguments::Arguments;
use crate::emit::signature::{Head, Parameter};
use crate::emit::{CallError, Lets, call};
use crate::program::{Arg, Draft, Names, Program};

/// The data of a function's own parameters and results.
#[derive(Clone, Debug)]
pub struct Over {
    /// Its inputs are the components of the parameters, its outputs the results.
    pub dataset: Dataset,
    head: Head,
    lets: Lets,
}

impl ReadBack {
    /// Returns the data of the function's own parameters and results, made of those of columns.
    ///
    /// # Errors
    /// [`CallError`] if what the comments say does not fit the function and the data.
    pub fn over(&self, dataset: &Dataset, outputs: &[String]) -> Result<Over, CallError> {
        let lets = self.lets()?;
        let names = |columns: &[Column]| columns.iter().map(|c| c.name.clone()).collect();
        let (inputs, known_outputs): (Vec<String>, Vec<String>) =
            (names(&dataset.inputs), names(&dataset.outputs));
        let components = &self.written.inputs;
        let renamed = self.names.inputs.iter().zip(components);
        let columns: Vec<(String, String)> =
            renamed.map(|(column, component)| (column.clone(), component.clone())).collect();
        let parameter = |out| move |name: &String| Parameter::float(name, out);
        let mut parameters: Vec<Parameter> = components.iter().map(parameter(false)).collect();
        parameters.extend(outputs.iter().map(parameter(true)));
        let (function, qualifiers) = ("f".to_owned(), None);
        let head = Head { function, qualifiers, parameters, returned: Some(0), columns };
        let results = of_truth(&inputs, &known_outputs, &head, &lets)?;
        let arguments = Arguments::of(components, &inputs, &head.columns, &lets)?;
        let column = |name: &String| Column::new(name, [0.0, 1.0]);
        let made = |split: &Split| {
            let mut columns = vec![Vec::with_capacity(split.rows()); components.len()];
            columns.extend(vec![Vec::with_capacity(split.rows()); outputs.len()]);
            for row in 0..split.rows() {
                let values: Vec<f32> = split.columns.iter().map(|column| column[row]).collect();
                let mut point = arguments
                    .at(&values[..inputs.len()], row)
                    .unwrap_or_else(|| vec![f32::NAN; components.len()]);
                let truth = &values[inputs.len()..];
                let all: Vec<f32> = point.iter().chain(truth).copied().collect();
                point.extend(results.evaluate(&all));
                columns.iter_mut().zip(point).for_each(|(column, value)| column.push(value));
            }
            Split { columns, weights: split.weights.clone(), ..Split::default() }
        };
        let dataset = Dataset {
            name: dataset.name.clone(),
            origin: dataset.origin.clone(),
            inputs: components.iter().map(column).collect(),
            outputs: outputs.iter().map(column).collect(),
            claims: Vec::new(),
            search: made(&dataset.search),
            validation: made(&dataset.validation),
        };
        Ok(Over { dataset, head, lets })
    }
}

impl Over {
    /// Returns a formula over columns as the function computes it: over its own parameters.
    ///
    /// # Errors
    /// As [`ReadBack::over`].
    pub fn called(&self, formula: &Program, names: &Names) -> Result<Program, CallError> {
        Ok(call(formula, names, &self.head, &self.lets)?.program)
    }

    /// Returns the outputs among columns that the results are, or are made of.
    pub fn outputs(&self, columns: &[Column]) -> Vec<String> {
        let names = columns.iter().map(|column| &column.name);
        let read = |name: &&String| {
            let said = |name| self.lets.about(name).and_then(|(about, _)| self.lets.of(about));
            self.dataset.outputs.iter().any(|result| match said(&result.name) {
                Some(text) => words(text).any(|word| word == *name),
                None => result.name == **name,
            })
        };
        names.filter(read).cloned().collect()
    }
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
}

/// Returns the results' true values, over the components and then the true values of the outputs.
fn of_truth(
    inputs: &[String],
    outputs: &[String],
    head: &Head,
    lets: &Lets,
) -> Result<Program, CallError> {
    let truth: Vec<String> = outputs.iter().map(|name| format!("{name}_of_data")).collect();
    let mut draft = Draft { inputs: inputs.len() + outputs.len(), ..Draft::default() };
    draft.outputs = (0..outputs.len()).map(|i| Arg::Input((inputs.len() + i) as u16)).collect();
    let identity = Program::verify(draft).expect("it has inputs alone");
    let names =
        Names { inputs: inputs.iter().chain(&truth).cloned().collect(), outputs: outputs.to_vec() };
    let mut head = head.clone();
    let place = head.parameters.iter().filter(|parameter| !parameter.out).count();
    let given = truth.iter().map(|name| Parameter::float(name, false));
    head.parameters.splice(place..place, given);
    Ok(call(&identity, &names, &head, lets)?.program)
}
