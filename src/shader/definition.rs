//! What `--set` and `--let` define: expressions in WGSL over names.

use super::Error;
use super::interpreter::{Interpreter, Step};
use super::machine::Machine;
use super::source::Source;
use super::text::Text;
use super::value::Value;
use naga::{Expression, Handle};
use std::path::Path;

/// A name, and the expression that it stands for.
#[derive(Clone, Debug)]
pub(super) struct Definition {
    pub name: String,
    /// The names in the expression that it is a function of, in order.
    pub arguments: Vec<String>,
    source: Source,
    result: Handle<Expression>,
}

/// The name of the result in the function that is made of an expression.
const RESULT: &str = "lgp_result";

/// Splits `name = expression`.
pub(super) fn split(text: &str) -> Result<(&str, &str), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok((name.trim(), value.trim()))
        }
        _ => Err(format!("`{text}`: write NAME=VALUE")),
    }
}

/// Returns the free names of an expression: those that are no function, type, member or constant.
pub(super) fn free_names(expression: &str) -> Vec<String> {
    const TYPES: [&str; 6] = ["f32", "i32", "u32", "bool", "true", "false"];
    let mut found: Vec<String> = Vec::new();
    for (at, word) in super::glsl::words(expression) {
        let after = expression[at + word.len()..].trim_start();
        let is_member = expression[..at].trim_end().ends_with('.');
        let is_type = TYPES.contains(&word)
            || (word.starts_with("vec") || word.starts_with("mat")) && after.starts_with('<');
        // The letters of a number: `1e3`, `0.5f`.
        let is_suffix = expression[..at].ends_with(|c: char| c.is_ascii_digit() || c == '.');
        let is_free = !(is_member || is_type || is_suffix || after.starts_with('('));
        if is_free && found.iter().all(|known| known != word) {
            found.push(word.to_owned());
        }
    }
    found
}

impl Definition {
    /// Parses an expression over arguments of given types, as WGSL writes them.
    pub fn parse(
        name: &str,
        expression: &str,
        arguments: Vec<(String, String)>,
    ) -> Result<Definition, String> {
        let list: Vec<String> =
            arguments.iter().map(|(name, ty)| format!("{name}: {ty}")).collect();
        let text =
            format!("fn lgp_function({}) {{\nlet {RESULT} = {expression};\n}}", list.join(", "));
        let source = Source::wgsl(Path::new("it"), &Text::of(text)).map_err(|error| {
            let reason = match error {
                Error::At { message, .. } => message,
                other => other.to_string(),
            };
            format!("`{name} = {expression}`: {reason}; write it in WGSL")
        })?;
        let function = source.module.functions.iter().next().map(|(_, function)| function);
        let named = function.and_then(|function| {
            let mut named = function.named_expressions.iter();
            named.find(|(_, name)| *name == RESULT).map(|(handle, _)| *handle)
        });
        let Some(result) = named else {
            return Err(format!("`{name} = {expression}`: write one expression in WGSL"));
        };
        let arguments = arguments.into_iter().map(|(name, _)| name).collect();
        Ok(Definition { name: name.to_owned(), arguments, source, result })
    }

    /// Evaluates it.
    pub fn value<M: Machine>(&self, machine: &mut M, arguments: Vec<Value<M>>) -> Step<Value<M>> {
        let module = &self.source.module;
        let Some((_, function)) = module.functions.iter().next() else {
            return Err("it is empty".to_owned().into());
        };
        Interpreter::new(module, machine)?.value_in(function, arguments, self.result)
    }
}
