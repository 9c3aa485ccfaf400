//! Which function of a module is meant.

use super::Error;
use super::order::calls;
use super::source::Source;
use crate::suggest::did_you_mean;
use naga::{Function, Handle, Module, Statement};
use std::collections::HashSet;

/// The most functions that a message names.
const MOST_NAMED: usize = 16;

/// A function, or an entry point.
#[derive(Clone, Copy, Debug)]
pub(super) enum Entry {
    Function(Handle<Function>),
    Point(usize),
}

impl Entry {
    pub fn of(self, module: &Module) -> &Function {
        match self {
            Entry::Function(handle) => &module.functions[handle],
            Entry::Point(index) => &module.entry_points[index].function,
        }
    }
}

/// Returns the function of this name, or the only one that no other calls.
pub(super) fn chosen(source: &Source, name: Option<&str>) -> Result<(Entry, String), Error> {
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
            let more = match names.len().saturating_sub(MOST_NAMED) {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            let named = names[..names.len().min(MOST_NAMED)].join(", ");
            whole(format!(
                "it has several functions: {named}{more}; say which, as in --entry {first}"
            ))
        }
    }
}
