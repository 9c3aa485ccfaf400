//! A function of a shader over columns: which parameters are inputs, which are fixed or defined by
//! others, and what it returns.

use super::definition::{Definition, free_names, split};
use super::interpreter::{Interpreter, MOST_STEPS, Step, Stop};
use super::machine::{Exact, Machine, Single};
use super::order::calls;
use super::parameters::{Parameter, Part, Role, arguments, as_kind, globals, parts, wgsl_type};
use super::source::Source;
use super::symbols::Symbols;
use super::value::{Pointer, Scalar, Value};
use super::{Error, Options};
use crate::program::Program;
use crate::suggest::did_you_mean;
use crate::truth::column_name;
use naga::{Function, Handle, Module, ScalarKind, Statement};
use std::collections::HashSet;

/// The function of a file that is approximated.
#[derive(Clone, Debug)]
pub(super) struct Subject {
    source: Source,
    entry: Entry,
    pub name: String,
    parameters: Vec<Parameter>,
    /// The names of the scalars that it returns, through parameters, too.
    pub outputs: Vec<String>,
    /// Parameters, components of them, or global variables with fixed values.
    fixed: Vec<Definition>,
    /// Parameters that are functions of columns.
    defined: Vec<Definition>,
    /// Columns that are functions of parameters.
    derived: Vec<Definition>,
    /// The values that it is sampled over.
    pub sampled: Vec<String>,
    /// The inputs of formulas: the derived columns, and what is sampled and in none of them.
    pub columns: Vec<String>,
    /// The most steps of an evaluation.
    pub steps: u64,
}

#[derive(Clone, Copy, Debug)]
enum Entry {
    Function(Handle<Function>),
    Point(usize),
}

impl Entry {
    fn of(self, module: &Module) -> &Function {
        match self {
            Entry::Function(handle) => &module.functions[handle],
            Entry::Point(index) => &module.entry_points[index].function,
        }
    }
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

    fn module(&self) -> &Module {
        &self.source.module
    }

    fn output_names(&self) -> Result<Vec<String>, Error> {
        let module = self.module();
        let mut outputs: Vec<Part> = Vec::new();
        if let Some(result) = &self.entry.of(module).result {
            let name = plain(&self.name);
            let found = parts(module, &name, result.ty);
            let mut found = found.map_err(|reason| self.refused(reason))?;
            // Members are called as the structure's author did.
            if let naga::TypeInner::Struct { .. } = module.types[result.ty].inner {
                for part in &mut found {
                    let member = part.column.strip_prefix(&format!("{name}_"));
                    part.column = member.unwrap_or(&part.column).to_owned();
                }
            }
            outputs.extend(found);
        }
        let places = self.parameters.iter().filter(|parameter| parameter.role == Role::Place);
        outputs.extend(places.flat_map(|parameter| parameter.scalars.clone()));
        if outputs.is_empty() {
            return Err(self.refused(format!("`{}` returns nothing", self.name)));
        }
        let inputs: HashSet<&str> =
            self.sampled.iter().chain(&self.columns).map(String::as_str).collect();
        let mut taken = HashSet::new();
        let name = |part: Part| {
            let mut name = plain(&part.column);
            while inputs.contains(name.as_str()) || !taken.insert(name.clone()) {
                name += "_out";
            }
            name
        };
        Ok(outputs.into_iter().map(name).collect())
    }

    fn refused(&self, message: String) -> Error {
        self.source.error(naga::Span::default(), message)
    }

    /// Fixes a parameter, a component of one, or a global variable.
    fn fix(&mut self, text: &str) -> Result<(), Error> {
        let (name, value) = split(text).map_err(Error::Set)?;
        let definition = Definition::parse(name, value, Vec::new()).map_err(Error::Set)?;
        let key = column_name(name);
        let parts = self.parameters.iter().flat_map(|parameter| &parameter.scalars);
        if !parts.clone().any(|part| is_part_of(&part.column, &key)) {
            let known: Vec<&str> = self
                .parameters
                .iter()
                .map(|parameter| parameter.name.as_str())
                .filter(|name| !name.is_empty())
                .chain(parts.map(|part| part.column.as_str()))
                .collect();
            let hint = did_you_mean(name, known.iter().copied());
            let known = if known.is_empty() { "none".into() } else { known.join(", ") };
            let message = format!(
                "{text}: there is no parameter or uniform `{name}`{hint} (there are: {known})"
            );
            return Err(Error::Set(message));
        }
        self.fixed.push(definition);
        Ok(())
    }

    /// Defines a parameter by columns, or a column by parameters.
    fn define(&mut self, text: &str) -> Result<(), Error> {
        let (name, expression) = split(text).map_err(Error::Let)?;
        let free = free_names(expression);
        let of_parameter = |name: &str| self.parameters.iter().find(|p| p.name == name);
        let typed = |name: &String| match of_parameter(name) {
            None => Ok((name.clone(), "f32".to_owned())),
            Some(parameter) => match wgsl_type(self.module(), parameter.ty) {
                Some(ty) => Ok((name.clone(), ty)),
                None => {
                    Err(Error::Let(format!("`{text}`: `{name}` is no scalar, vector or matrix")))
                }
            },
        };
        if of_parameter(name).is_some() {
            if let Some(other) = free.iter().find(|name| of_parameter(name).is_some()) {
                let message = format!(
                    "`{text}`: `{other}` is a parameter; define `{name}` by new names, which become the inputs"
                );
                return Err(Error::Let(message));
            }
            let arguments = free.iter().map(typed).collect::<Result<_, _>>()?;
            let definition = Definition::parse(name, expression, arguments).map_err(Error::Let)?;
            self.defined.push(definition);
            return Ok(());
        }
        if let Some(unknown) = free.iter().find(|name| of_parameter(name).is_none()) {
            let names = self.parameters.iter().map(|p| p.name.as_str());
            let hint = did_you_mean(unknown, names.clone());
            let names: Vec<&str> = names.collect();
            let message = format!(
                "`{text}`: neither `{name}` nor `{unknown}` is a parameter{hint} (parameters: {})",
                names.join(", ")
            );
            return Err(Error::Let(message));
        }
        let arguments = free.iter().map(typed).collect::<Result<_, _>>()?;
        self.derived.push(Definition::parse(name, expression, arguments).map_err(Error::Let)?);
        Ok(())
    }

    /// Finds what is sampled: names in definitions of parameters, and all components of parameters
    /// that are not given; those of `out` parameters only if they have a range.
    fn find_columns(&mut self, ranged: &[String]) -> Result<(), Error> {
        let mut sampled: Vec<String> = Vec::new();
        let mut in_derived: HashSet<String> = HashSet::new();
        for parameter in &self.parameters {
            let is = |definition: &&Definition| definition.name == parameter.name;
            if let Some(definition) = self.defined.iter().find(is) {
                for name in &definition.arguments {
                    if !sampled.contains(name) {
                        sampled.push(name.clone());
                    }
                }
                continue;
            }
            for part in &parameter.scalars {
                let is_it =
                    |fixed: &Definition| is_part_of(&part.column, &column_name(&fixed.name));
                let has_range = ranged.contains(&plain(&part.column));
                let is_optional =
                    matches!(parameter.role, Role::Place | Role::Global(_) | Role::BuiltIn);
                if self.fixed.iter().any(is_it) || is_optional && !has_range {
                    continue;
                }
                if part.kind != ScalarKind::Float {
                    let name = &part.column;
                    let kind =
                        if part.kind == ScalarKind::Bool { "a truth value" } else { "an integer" };
                    let value = if part.kind == ScalarKind::Bool { "true" } else { "3" };
                    return Err(self.refused(format!(
                        "`{name}` is {kind}, which formulas have not; fix it, as in --set {name}={value}"
                    )));
                }
                let used = self.derived.iter().any(|d| d.arguments.contains(&parameter.name));
                if used {
                    in_derived.insert(plain(&part.column));
                }
                sampled.push(plain(&part.column));
            }
        }
        let derived = self.derived.iter().map(|definition| definition.name.clone());
        let rest = sampled.iter().filter(|name| !in_derived.contains(*name)).cloned();
        self.columns = derived.chain(rest).collect();
        self.sampled = sampled;
        Ok(())
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

/// Returns true for the column of a name, or of a component of what it names.
fn is_part_of(column: &str, key: &str) -> bool {
    column.strip_prefix(key).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
}

/// Makes a column's name of a name in a shader.
fn plain(name: &str) -> String {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let name: String = name.chars().map(|c| if is_part(c) { c } else { '_' }).collect();
    match name.starts_with(|c: char| c.is_ascii_digit()) || name.is_empty() {
        true => format!("_{name}"),
        false => name,
    }
}

/// Returns the function of this name, or the only one that no other calls.
fn chosen(source: &Source, name: Option<&str>) -> Result<(Entry, String), Error> {
    let module = &source.module;
    let functions = module.functions.iter().map(|(handle, function)| {
        (Entry::Function(handle), function.name.clone().unwrap_or_default())
    });
    let points = module.entry_points.iter().enumerate();
    let points = points.map(|(index, point)| (Entry::Point(index), point.name.clone()));
    // SPIR-V from GLSL and HLSL has the types in names: `f(f1;vf3;`; that from Slang a number.
    let short = |name: &str| {
        let name = name.split('(').next().unwrap_or(name);
        let is_numbered = source.numbers_names && name.ends_with("_0");
        name[..name.len() - 2 * usize::from(is_numbered)].to_owned()
    };
    let all: Vec<(Entry, String)> =
        points.chain(functions).map(|(entry, name)| (entry, short(&name))).collect();
    let whole = |message: String| Err(source.error(naga::Span::default(), message));
    if let Some(name) = name {
        if let Some(found) = all.iter().find(|(_, known)| known == name) {
            return Ok(found.clone());
        }
        let names = || all.iter().map(|(_, name)| name.as_str()).filter(|name| !name.is_empty());
        let hint = did_you_mean(name, names());
        let known = names().collect::<Vec<_>>().join(", ");
        return whole(format!("there is no function `{name}`{hint} (there are: {known})"));
    }
    let mut called = HashSet::new();
    for (entry, _) in &all {
        calls(&entry.of(module).body, &mut called);
    }
    let is_empty = |entry: Entry| {
        entry.of(module).body.iter().all(|s| matches!(s, Statement::Return { value: None }))
    };
    let open: Vec<&(Entry, String)> = all
        .iter()
        .filter(|(_, name)| !(source.lacks_main && name == "main"))
        .filter(|(entry, _)| match entry {
            Entry::Function(handle) => !called.contains(handle),
            Entry::Point(_) => !is_empty(*entry),
        })
        .collect();
    match open.as_slice() {
        [only] => Ok((*only).clone()),
        [] => whole("it has no function".into()),
        several => {
            let names: Vec<&str> = several.iter().map(|(_, name)| name.as_str()).collect();
            let first = names.first().copied().unwrap_or_default();
            whole(format!(
                "it has several functions: {}; say which, as in --entry {first}",
                names.join(", ")
            ))
        }
    }
}
