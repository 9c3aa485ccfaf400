//! The statements of a function: locals and `return`.

use super::lex::Token;
use super::types::{Float, Type};
use super::{Read, Reader, Several, Value};
use crate::emit::Language;

impl Reader<'_> {
    /// Reads a statement; returns the outputs' names after a `return`.
    pub(super) fn statement(&mut self) -> Read<Option<Vec<String>>> {
        if self.take_word("return") {
            return self.returned().map(Some);
        }
        match self.language {
            Language::Wgsl => self.wgsl_local()?,
            _ => self.c_local()?,
        }
        Ok(None)
    }

    /// Reads `let t0 = x;`.
    fn wgsl_local(&mut self) -> Read<()> {
        let at = self.offset();
        let Some(word) = ["let", "var", "const"].into_iter().find(|word| self.take_word(word))
        else {
            return self.no_local(at);
        };
        let (at, name) = self.local_name()?;
        let declared = match self.take_symbol(':') {
            true => Some(self.local_type()?),
            false => None,
        };
        self.expect('=', "after the name of a local")?;
        let from = self.offset();
        let value = self.expression()?;
        let value = match (value, declared) {
            (Value::Float(value), _) if word == "const" && value.exact.is_none() => {
                return self.error(from, "a `const` is of numbers alone; write `let`");
            }
            (Value::Float(value), None) if value.of == Type::Integer => {
                return self.error(from, "an integer, and so is the local; write `2.0` for `2`");
            }
            // A `const` keeps the precision of numbers without a type.
            (Value::Float(value), None) if word == "const" => Value::Float(value),
            (Value::Float(value), None) => {
                let of = if value.of == Type::Open { Type::Single } else { value.of };
                Value::Float(self.local_value(value, of, from)?)
            }
            (Value::Float(value), Some(of)) => Value::Float(self.local_value(value, of, from)?),
            (_, Some(_)) => return self.error(from, "expected a float"),
            (value, None) => value,
        };
        self.expect(';', "after a statement")?;
        self.define(&name, value, at)
    }

    /// Reads `const float t0 = x;`.
    fn c_local(&mut self) -> Read<()> {
        let start = self.offset();
        let qualifiers = self.qualifiers(self.syntax.readable.of_locals);
        if self.is_symbol(1, '=') || !matches!(self.peek(), Some(Token::Name(_))) {
            return self.no_local(self.offset());
        }
        let type_at = self.offset();
        let type_name = self.type_name()?;
        let structure = self.structure.as_ref().is_some_and(|known| known.name == type_name);
        let known = self.known_type(&type_name);
        if !structure && known.is_none() {
            return self.unknown_type(&type_name, type_at, "a local");
        }
        let (at, name) = self.local_name()?;
        self.expect('=', "after the name of a local")?;
        let from = self.offset();
        let braces = structure && self.language != Language::Glsl;
        let value = match known {
            Some((of, 1)) => {
                let value = self.float()?;
                let must_be_known = match self.language {
                    Language::Glsl => qualifiers.iter().any(|word| word == "const"),
                    _ => qualifiers.iter().any(|word| word == "constexpr"),
                };
                if must_be_known && value.exact.is_none() {
                    return self.error(start, "in GLSL ES a `const` is of numbers alone, in MSL a `constexpr`; take the word away");
                }
                Value::Float(self.local_value(value, of, from)?)
            }
            _ if braces && self.take_symbol('{') => self.several(type_name, '}')?,
            _ => match self.expression()? {
                Value::Several(value) if value.of == type_name => Value::Several(value),
                _ => return self.error(from, format!("expected a `{type_name}`")),
            },
        };
        self.expect(';', "after a statement")?;
        self.define(&name, value, at)
    }

    fn local_value(&mut self, value: Float, of: Type, at: usize) -> Read<Float> {
        if of == Type::Half && self.of == Type::Single {
            let message = "a half in a function of floats, in which the formula loses digits; make it a float, \
                 or write the function in halves (`lgp emit --half`)";
            return self.error(at, message);
        }
        self.converted(value, of, at)
    }

    fn no_local<T>(&self, at: usize) -> Read<T> {
        if self.is_symbol(1, '=')
            && let Some(Token::Name(name)) = self.peek()
            && self.values.contains_key(name)
        {
            let message = format!("`{name}` is changed; give the new value a name of its own");
            return self.error(at, message);
        }
        self.error(at, "expected a local, or `return`")
    }

    fn local_name(&mut self) -> Read<(usize, String)> {
        let at = self.offset();
        match self.take_name() {
            Some(name) => Ok((at, name)),
            None => self.error(at, "expected the name of a local"),
        }
    }

    fn local_type(&mut self) -> Read<Type> {
        let at = self.offset();
        let name = self.type_name()?;
        match self.known_type(&name) {
            Some((of, 1)) => Ok(of),
            _ => self.unknown_type(&name, at, "a local"),
        }
    }

    pub(super) fn define(&mut self, name: &str, value: Value, at: usize) -> Read<()> {
        self.allowed(name, at)?;
        let taken = name == self.function
            || self.structure.as_ref().is_some_and(|structure| structure.name == name);
        if taken || self.values.contains_key(name) {
            return self.error(at, format!("`{name}` is declared twice"));
        }
        self.values.insert(name.to_owned(), value);
        Ok(())
    }

    pub(super) fn allowed(&self, name: &str, at: usize) -> Read<()> {
        if !(self.syntax.reserved)(name) {
            return Ok(());
        }
        let language = self.language.name();
        self.error(at, format!("`{name}` means something in {language}; choose another name"))
    }

    fn returned(&mut self) -> Read<Vec<String>> {
        let at = self.offset();
        let local = self.component_name();
        let components = match self.expression()? {
            Value::Float(value) => vec![(local.or(Some(self.function.clone())), value)],
            Value::Several(several) => several.components,
            _ => return self.error(at, "expected a float or a vector to return"),
        };
        self.expect(';', "after `return`")?;
        if components.len() != self.returned {
            let (has, returned) = (components.len(), self.returned);
            return self.error(at, format!("{has} values where the function returns {returned}"));
        }
        let mut names = Vec::new();
        for (i, (name, value)) in components.into_iter().enumerate() {
            let value = self.converted(value, self.of, at)?;
            self.draft.outputs.push(value.arg);
            names.push(name.unwrap_or_else(|| format!("output{i}")));
        }
        Ok(names)
    }

    /// Returns the name that is the whole of the expression ahead.
    fn component_name(&self) -> Option<String> {
        let ends = [',', ')', '}', ';'].iter().any(|&symbol| self.is_symbol(1, symbol));
        match self.peek() {
            Some(Token::Name(name)) if ends => Some(name.clone()),
            _ => None,
        }
    }

    /// Reads the components of a vector or a structure.
    pub(super) fn several(&mut self, of: String, close: char) -> Read<Value> {
        let at = self.offset();
        let (element, size) = match (&self.structure, self.known_type(&of)) {
            (_, Some(known)) => known,
            (Some(structure), None) => (structure.of, structure.members),
            _ => return self.unknown_type(&of, at, "a value"),
        };
        let mut components = Vec::new();
        loop {
            let name = self.component_name();
            let at = self.offset();
            let value = self.float()?;
            components.push((name, self.component(value, element, at)?));
            if self.take_symbol(close) {
                break;
            }
            self.expect(',', &format!("or `{close}` after a component"))?;
        }
        if components.len() != size {
            let found = components.len();
            return self.error(at, format!("{found} components, where `{of}` has {size}"));
        }
        Ok(Value::Several(Several { of, components }))
    }

    /// Converts a component: except in WGSL, a vector is made of integers and floats of any
    /// precision.
    fn component(&mut self, value: Float, of: Type, at: usize) -> Read<Float> {
        match self.language {
            Language::Wgsl => self.converted(value, of, at),
            _ => self.cast(value, of),
        }
    }
}
