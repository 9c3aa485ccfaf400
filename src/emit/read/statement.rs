//! The statements of a function: locals and `return`.

use super::lex::Token;
use super::types::{Float, Type};
use super::{Out, Read, Reader, Several, Value};
use crate::emit::Language;
use crate::emit::syntax::Style;

impl Reader<'_> {
    /// Reads a statement; returns the outputs' names after a `return`.
    pub(super) fn statement(&mut self) -> Read<Option<Vec<String>>> {
        self.local = self.of;
        let at = self.offset();
        if self.take_word("return") {
            let is_script = matches!(self.syntax.readable.style, Style::Script | Style::Nodes);
            if is_script && self.text[at..self.offset()].contains('\n') {
                return self.error(at, "`return` returns nothing where its line ends");
            }
            return self.returned().map(Some);
        }
        if self.assigned_parameter()? {
            return Ok(None);
        }
        match self.syntax.readable.style {
            Style::C => self.c_local()?,
            Style::Rust if !self.is_word("let") => return self.last_expression().map(Some),
            Style::Wgsl | Style::Rust => self.let_local(&["let", "var", "const"])?,
            Style::Script | Style::Nodes => self.let_local(&["const", "let"])?,
            Style::Python => self.python_local()?,
        }
        Ok(None)
    }

    /// Reads `scale = x;`, a result that leaves by a parameter. Returns false if there is none.
    fn assigned_parameter(&mut self) -> Read<bool> {
        let pointer = usize::from(self.syntax.out_by_pointer);
        let Some((_, Token::Name(name))) = self.tokens.get(self.next + pointer) else {
            return Ok(false);
        };
        let place = self.outs.iter().position(|out| out.name == *name);
        let is_assigned =
            self.is_symbol(pointer + 1, '=') && (pointer == 0 || self.is_symbol(0, '*'));
        let Some(place) = place.filter(|_| is_assigned) else { return Ok(false) };
        self.next += pointer + 2;
        let at = self.offset();
        let Out { name, of, size, .. } = &self.outs[place];
        let (name, of, size) = (name.clone(), *of, *size);
        if self.outs[place].value.is_some() {
            return self.error(at, format!("`{name}` is given a value twice"));
        }
        let local = self.component_name();
        let components = match self.expression()? {
            Value::Float(value) if size == 1 => vec![(local, self.local_value(value, of, at)?)],
            Value::Several(several) if several.components.len() == size => several.components,
            _ => return self.error(at, format!("expected a value of {size} components")),
        };
        self.expect(';', "after a statement")?;
        let value = match components.as_slice() {
            [(_, value)] => Value::Float(*value),
            _ => Value::Several(Several { of: String::new(), components: components.clone() }),
        };
        self.outs[place].value = Some(components);
        if pointer == 0 {
            self.values.insert(name, value);
        }
        Ok(true)
    }

    /// Reads the expression that a function of Rust ends with.
    fn last_expression(&mut self) -> Read<Vec<String>> {
        let at = self.offset();
        let local = self.component_name();
        if self.is_symbol(0, '(') && self.is_a_tuple() {
            self.next += 1;
            let components = self.components_until(')')?;
            return self.returning(components, at);
        }
        let value = self.float()?;
        self.returning(vec![(local.or(Some(self.function.clone())), value)], at)
    }

    /// Returns true if a comma stands in the parentheses that are next, and not deeper.
    fn is_a_tuple(&self) -> bool {
        let mut depth = 0;
        for (_, token) in &self.tokens[self.next..] {
            match token {
                Token::Symbol('(') => depth += 1,
                Token::Symbol(')') if depth == 1 => return false,
                Token::Symbol(')') => depth -= 1,
                Token::Symbol(',') if depth == 1 => return true,
                _ => {}
            }
        }
        false
    }

    /// Reads `t0 = x`, and the end of the line.
    fn python_local(&mut self) -> Read<()> {
        let at = self.offset();
        if !self.is_symbol(1, '=') {
            return self.error(at, "expected a local, or `return`");
        }
        let (at, name) = self.local_name()?;
        self.next += 1;
        let value = self.expression()?;
        self.expect(';', "or the end of the line")?;
        self.define(&name, value, at)
    }

    /// Reads `let t0 = x;`.
    fn let_local(&mut self, words: &[&'static str]) -> Read<()> {
        let at = self.offset();
        let Some(&word) = words.iter().find(|word| self.take_word(word)) else {
            return self.no_local(at);
        };
        let word = if self.language == Language::Wgsl { word } else { "let" };
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
        let braces = structure && !matches!(self.language, Language::Glsl | Language::GlslEs);
        let value = match known {
            Some((of, 1)) => {
                self.local = of;
                let value = self.float()?;
                let must_be_known = match self.language {
                    Language::Glsl | Language::GlslEs => {
                        qualifiers.iter().any(|word| word == "const")
                    }
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

    fn is_word(&self, word: &str) -> bool {
        matches!(self.peek(), Some(Token::Name(name)) if name == word)
    }

    pub(super) fn define(&mut self, name: &str, value: Value, at: usize) -> Read<()> {
        self.allowed(name, at)?;
        let taken = name == self.function
            || self.outs.iter().any(|out| out.name == name)
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
        let is_list = matches!(self.syntax.readable.style, Style::Script | Style::Nodes)
            && self.take_symbol('[');
        let mut components = match is_list {
            true => self.components_until(']')?,
            false => match self.expression()? {
                Value::Float(value) => vec![(local.or(Some(self.function.clone())), value)],
                Value::Several(several) => several.components,
                _ => return self.error(at, "expected a float or a vector to return"),
            },
        };
        while self.syntax.readable.style == Style::Python && self.take_symbol(',') {
            let name = self.component_name();
            components.push((name, self.float()?));
        }
        // Alone it is a value of the function's name; among others it is a local.
        if let [(first, _), _, ..] = components.as_mut_slice()
            && *first == Some(self.function.clone())
        {
            *first = None;
        }
        self.expect(';', "after `return`")?;
        self.returning(components, at)
    }

    /// Takes the components as what the function returns.
    fn returning(
        &mut self,
        components: Vec<(Option<String>, Float)>,
        at: usize,
    ) -> Read<Vec<String>> {
        if let Some(returned) = self.returned.filter(|returned| *returned != components.len()) {
            let has = components.len();
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
        // `float(y)` of a node is `y`.
        if let (Some(Token::Name(of)), Some((_, Token::Name(name)))) =
            (self.peek(), self.tokens.get(self.next + 2))
            && of == "float"
            && self.syntax.readable.style == Style::Nodes
            && self.is_symbol(1, '(')
            && self.is_symbol(3, ')')
        {
            return Some(name.clone());
        }
        let ends = [',', ')', '}', ']', ';'].iter().any(|&symbol| self.is_symbol(1, symbol));
        match self.peek() {
            Some(Token::Name(name)) if ends => Some(name.clone()),
            _ => None,
        }
    }

    /// Reads the components of a vector or a structure.
    pub(super) fn several(&mut self, of: String, close: char) -> Read<Value> {
        let at = self.offset();
        let (element, size) = match (&self.structure, self.made_by(&of)) {
            // A constructor's precision is that of what it is given.
            (_, Some((_, size))) if self.language == Language::GlslEs => (self.of, size),
            (_, Some(known)) => known,
            (Some(structure), None) => (structure.of, structure.members.len()),
            _ => return self.unknown_type(&of, at, "a value"),
        };
        let mut components = self.components_until(close)?;
        for (_, value) in &mut components {
            *value = self.component(*value, element, at)?;
        }
        if components.len() != size {
            let found = components.len();
            return self.error(at, format!("{found} components, where `{of}` has {size}"));
        }
        if let Some(structure) = self.structure.as_ref().filter(|known| known.name == of) {
            let names: Vec<&String> =
                components.iter().filter_map(|(name, _)| name.as_ref()).collect();
            let is_permuted = structure.members.iter().all(|member| names.contains(&member));
            let mut pairs = names.iter().zip(&structure.members);
            let other = pairs.find(|(name, member)| **name != *member);
            if let Some((name, member)) = other.filter(|_| is_permuted) {
                let message = format!("`{name}` stands where the member `{member}` is");
                return self.error(at, message);
            }
            // Callers know the members, not the locals.
            for ((name, _), member) in components.iter_mut().zip(&structure.members) {
                *name = Some(member.clone());
            }
        }
        Ok(Value::Several(Several { of, components }))
    }

    /// Reads values up to the closing symbol; a vector among them stands for its components.
    pub(super) fn components_until(&mut self, close: char) -> Read<Vec<(Option<String>, Float)>> {
        let mut components = Vec::new();
        loop {
            let (name, at) = (self.component_name(), self.offset());
            match self.expression()? {
                Value::Several(several) => components.extend(several.components),
                value => components.push((name, self.as_float(value, at)?)),
            }
            if self.take_symbol(close) {
                return Ok(components);
            }
            self.expect(',', &format!("or `{close}` after a component"))?;
        }
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
