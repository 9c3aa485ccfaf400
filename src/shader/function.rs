//! A function of a shader over columns: which parameters are inputs, which are fixed or defined by
//! others, and what it returns.

use super::budget::MOST_STEPS;
use super::columns::{is_part_of, plain};
use super::definition::Definition;
use super::entry::{Entry, chosen};
use super::interpreter::{Interpreter, Step, Stop};
use super::machine::{Exact, Machine, Single};
use super::parameters::{Parameter, Role, arguments, as_kind, globals};
use super::source::Source;
use super::symbols::Symbols;
use super::value::{Pointer, Scalar, Value};
use super::{Error, Options};
use crate::program::Program;
use crate::truth::column_name;
use naga::{Module, ScalarKind};
use std::collections::HashSet;

/// The function of a file that is approximated.
#[derive(Clone, Debug)]
pub(super) struct Subject {
    pub source: Source,
    pub entry: Entry,
    pub name: String,
    pub parameters: Vec<Parameter>,
    /// The names of the scalars that it returns, through parameters, too.
    pub outputs: Vec<String>,
    /// Parameters, components of them, or global variables with fixed values.
    pub fixed: Vec<Definition>,
    /// Parameters that are functions of columns.
    pub defined: Vec<Definition>,
    /// Columns that are functions of parameters.
    pub derived: Vec<Definition>,
    /// The values that it is sampled over.
    pub sampled: Vec<String>,
    /// The inputs of formulas: the derived columns, and what is sampled and in none of them.
    pub columns: Vec<String>,
    /// The most steps of an evaluation.
    pub steps: u64,
}

impl Subject {
    pub fn new(source: Source, options: &Options) -> Result<Subject, Error> {
        let (entry, name) = chosen(&source, options.entry.as_deref())?;
        let module = &source.module;
        let whole = |message: String| source.error(naga::Span::default(), message);
        let mut parameters = arguments(module, entry.of(module)).map_err(whole)?;
        let declared = source.declaration(&name, parameters.len()).unwrap_or_default();
        for (parameter, declared) in parameters.iter_mut().zip(declared) {
            if parameter.role == Role::Place && !declared.is_out {
                parameter.role = Role::Copy;
            }
        }
        let of_stage = globals(module, &source.given).into_iter();
        // What an entry point is given it puts there itself.
        let named: HashSet<String> = parameters.iter().map(|p| p.name.clone()).collect();
        parameters.extend(of_stage.filter(|global| !named.contains(&global.name)));
        let mut subject = Subject {
            entry,
            name,
            outputs: Vec::new(),
            fixed: Vec::new(),
            defined: Vec::new(),
            derived: Vec::new(),
            sampled: Vec::new(),
            columns: Vec::new(),
            steps: MOST_STEPS,
            parameters,
            source,
        };
        for text in &options.set {
            subject.fix(text)?;
        }
        for text in &options.define {
            subject.define(text)?;
        }
        subject.find_columns(&options.ranged)?;
        subject.outputs = subject.output_names()?;
        Ok(subject)
    }

    pub fn module(&self) -> &Module {
        &self.source.module
    }

    pub fn refused(&self, message: String) -> Error {
        self.source.error(naga::Span::default(), message)
    }

    /// Evaluates the function in double precision, at a value for each name that is sampled;
    /// returns the derived columns, then the outputs.
    pub fn at(&self, point: &[f64]) -> Result<Vec<f64>, Error> {
        let evaluated = self.evaluated(&mut Exact::default(), point);
        evaluated.map_err(|stop| self.source.stopped(&stop))
    }

    /// Evaluates the function in single precision.
    pub fn at_in_single(&self, point: &[f32]) -> Result<Vec<f32>, Error> {
        let evaluated = self.evaluated(&mut Single::default(), point);
        evaluated.map_err(|stop| self.source.stopped(&stop))
    }

    /// Returns the function as a program over the columns, as a compiler would unroll it.
    ///
    /// # Errors
    /// The reason why it is none.
    pub fn program(&self) -> Result<Program, Error> {
        if !self.derived.is_empty() {
            let message = "columns are functions of its parameters".to_owned();
            return Err(self.refused(message));
        }
        let mut machine = Symbols::new(self.sampled.len());
        let inputs: Vec<_> = (0..self.sampled.len()).map(|i| machine.input(i)).collect();
        let outputs = self.evaluated(&mut machine, &inputs);
        let outputs = outputs.map_err(|stop| self.source.stopped(&stop))?;
        machine.program(outputs).map_err(|reason| self.refused(reason))
    }

    fn evaluated<M: Machine>(&self, machine: &mut M, point: &[M::Float]) -> Step<Vec<M::Float>> {
        let arguments = self.arguments(machine, point)?;
        let mut row = Vec::new();
        for definition in &self.derived {
            let of = |name: &String| {
                let place = self.parameters.iter().position(|p| p.name == *name);
                place.map(|place| arguments[place].clone())
            };
            let over = definition.arguments.iter().filter_map(of).collect();
            row.push(definition.value(machine, over)?.float()?);
        }
        let module = self.module();
        let function = self.entry.of(module);
        let mut interpreter = Interpreter::new(module, machine)?.within(self.steps);
        let first = interpreter.globals.len();
        let mut passed = Vec::new();
        for (parameter, value) in self.parameters.iter().zip(arguments) {
            match parameter.role {
                Role::Argument | Role::BuiltIn => passed.push(value),
                Role::Global(index) => interpreter.globals[index] = value,
                Role::Place | Role::Copy => {
                    let variable = interpreter.globals.len();
                    passed.push(Value::Pointer(Pointer {
                        frame: None,
                        variable,
                        path: Vec::new(),
                    }));
                    interpreter.globals.push(value);
                    interpreter.places.push(parameter.name.clone());
                }
            }
        }
        let mut returned = Vec::new();
        if let Some(result) = interpreter.call(function, passed)? {
            returned.extend(result.flattened());
        }
        let places = self.parameters.iter().filter(|p| matches!(p.role, Role::Place | Role::Copy));
        for (parameter, written) in places.zip(&interpreter.globals[first..]) {
            if parameter.role == Role::Place {
                returned.extend(written.flattened());
            }
        }
        for (scalar, name) in returned.into_iter().zip(&self.outputs) {
            let unset = |reason| Stop::from(format!("`{name}`: {reason}"));
            let value = match scalar {
                Scalar::Bool(truth) => {
                    let (one, zero) = (machine.float(1.0), machine.float(0.0));
                    machine.choose(truth, one, zero)
                }
                scalar => as_kind(machine, scalar.checked().map_err(unset)?, ScalarKind::Float)
                    .and_then(|scalar| scalar.float()),
            };
            row.push(value.map_err(unset)?);
        }
        Ok(row)
    }

    /// Returns the arguments at a point.
    fn arguments<M: Machine>(&self, machine: &mut M, point: &[M::Float]) -> Step<Vec<Value<M>>> {
        let column = |name: &str| self.sampled.iter().position(|known| known == name);
        let mut arguments = Vec::new();
        for parameter in &self.parameters {
            let mut unset = Interpreter::new(self.module(), machine)?.unset(parameter.ty)?;
            let named = |definition: &&Definition| definition.name == parameter.name;
            let given = match self.defined.iter().find(named) {
                None => None,
                Some(definition) => {
                    let over = definition.arguments.iter().filter_map(|name| column(name));
                    let over = over.map(|i| Value::Scalar(Scalar::Float(point[i]))).collect();
                    Some(definition.value(machine, over)?)
                }
            };
            let mut scalars: Vec<Scalar<M>> = Vec::new();
            for (index, part) in parameter.scalars.iter().enumerate() {
                let scalar = if let Some(given) = &given {
                    one_of(given, index, parameter.scalars.len())?
                } else if let Some(i) = column(&plain(&part.column)) {
                    Scalar::Float(point[i])
                } else {
                    self.fixed_value(machine, parameter, index)?.unwrap_or(Scalar::Unset)
                };
                let name = &parameter.name;
                let scalar = as_kind(machine, scalar, part.kind);
                scalars.push(scalar.map_err(|reason| format!("`{name}`: {reason}"))?);
            }
            let mut rest = scalars.into_iter();
            unset =
                unset.map(&mut |_| rest.next().ok_or_else(|| "a component is missing".into()))?;
            arguments.push(unset);
        }
        Ok(arguments)
    }

    /// Returns the value that the last `--set` of a component gave.
    fn fixed_value<M: Machine>(
        &self,
        machine: &mut M,
        parameter: &Parameter,
        index: usize,
    ) -> Step<Option<Scalar<M>>> {
        let column = &parameter.scalars[index].column;
        let key = |definition: &Definition| column_name(&definition.name);
        let mut given = self.fixed.iter().rev();
        let Some(definition) = given.find(|one| is_part_of(column, &key(one))) else {
            return Ok(None);
        };
        let key = key(definition);
        let covered = parameter.scalars.iter().enumerate();
        let covered: Vec<usize> = covered
            .filter(|(_, part)| is_part_of(&part.column, &key))
            .map(|(index, _)| index)
            .collect();
        let place = covered.iter().position(|&one| one == index).unwrap_or(0);
        let value = definition.value(machine, Vec::new())?;
        Ok(Some(one_of(&value, place, covered.len())?))
    }
}

/// Returns a component of a given value; a scalar stands for each.
fn one_of<M: Machine>(given: &Value<M>, index: usize, of: usize) -> Result<Scalar<M>, String> {
    match given.flattened().as_slice() {
        [one] => Ok(*one),
        all if all.len() == of => Ok(all[index]),
        all => Err(format!("{} components are given for {of}", all.len())),
    }
}
