//! What of a function's parameters is an input, what is fixed, what is defined by others; what its
//! outputs are called.

use super::Error;
use super::definition::{Definition, free_names, split};
use super::function::Subject;
use super::parameters::{Part, Role, parts, wgsl_type};
use crate::suggest::did_you_mean;
use crate::truth::column_name;
use naga::ScalarKind;
use std::collections::HashSet;

impl Subject {
    pub fn output_names(&self) -> Result<Vec<String>, Error> {
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

    /// Fixes a parameter, a component of one, or a global variable.
    pub fn fix(&mut self, text: &str) -> Result<(), Error> {
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
    pub fn define(&mut self, text: &str) -> Result<(), Error> {
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
    pub fn find_columns(&mut self, ranged: &[String]) -> Result<(), Error> {
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
}

/// Returns true for the column of a name, or of a component of what it names.
pub(super) fn is_part_of(column: &str, key: &str) -> bool {
    column.strip_prefix(key).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
}

/// Makes a column's name of a name in a shader.
pub(super) fn plain(name: &str) -> String {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let name: String = name.chars().map(|c| if is_part(c) { c } else { '_' }).collect();
    match name.starts_with(|c: char| c.is_ascii_digit()) || name.is_empty() {
        true => format!("_{name}"),
        false => name,
    }
}
