//! Structures, functions and their parameters.

use super::lex::Token;
use super::types::{Float, Type};
use super::{Out, Read, Reader, Several, Structure, Value};
use crate::emit::Language;
use crate::emit::signature::{COMPONENTS, Parameter};
use crate::emit::syntax::Style;
use crate::program::{Arg, Names};

impl Reader<'_> {
    pub(super) fn function(&mut self) -> Read<Names> {
        if self.language == Language::Wgsl && self.take_word("enable") {
            if !self.take_word("f16") {
                return self.error(self.offset(), "expected `f16` after `enable`");
            }
            self.expect(';', "after `enable f16`")?;
        }
        self.structure()?;
        let inputs = self.head()?;
        self.draft.inputs = inputs.len();
        let at = self.offset();
        let outputs = self.body()?;
        if outputs.is_empty() {
            return self.error(at, "the function gives no value");
        }
        self.end()?;
        Ok(Names { inputs, outputs })
    }

    /// Reads a head without a body.
    pub(super) fn head_alone(&mut self) -> Read<()> {
        let style = self.syntax.readable.style;
        match style {
            Style::C => drop(self.c_signature()?),
            Style::Wgsl | Style::Rust => drop(self.fn_signature()?),
            Style::Nodes if self.is_word_ahead("const") => drop(self.nodes_signature()?),
            Style::Script | Style::Nodes | Style::Python => {
                self.of_function = self.qualifiers(&["export"]);
                self.qualifiers(&["function", "def"]);
                self.function_name()?;
                self.names_of_parameters(')')?;
            }
        }
        match self.peek() {
            None | Some(Token::Symbol(';')) => Ok(()),
            Some(_) => self.error(self.offset(), "expected the end of the signature"),
        }
    }

    fn head(&mut self) -> Read<Vec<String>> {
        match self.syntax.readable.style {
            Style::C => self.c_head(),
            Style::Wgsl | Style::Rust => self.fn_head(),
            Style::Script => self.word_head("function"),
            Style::Python => self.word_head("def"),
            Style::Nodes => self.nodes_head(),
        }
    }

    /// Reads statements up to the one that returns, and assigns what leaves by parameters.
    fn body(&mut self) -> Read<Vec<String>> {
        let mut outputs = None;
        while outputs.is_none() && !self.ends_without_returning() {
            outputs = self.statement()?;
        }
        let mut outputs = outputs.unwrap_or_default();
        for out in std::mem::take(&mut self.outs) {
            let Some(components) = out.value else {
                let message = format!("the function ends, but `{}` has no value", out.name);
                return self.error(self.offset(), message);
            };
            let many = components.len() > 1;
            for (i, (name, value)) in components.into_iter().enumerate() {
                self.draft.outputs.push(value.arg);
                outputs.push(match name.filter(|_| many) {
                    Some(name) => name,
                    None if many => format!("{}.{}", out.name, COMPONENTS[i]),
                    None => out.name.clone(),
                });
            }
        }
        Ok(outputs)
    }

    /// A function that returns nothing ends with its last statement.
    fn ends_without_returning(&self) -> bool {
        self.returned == Some(0) && self.is_symbol(0, '}')
    }

    fn end(&mut self) -> Read<()> {
        match self.syntax.readable.style {
            Style::Python => {}
            Style::Nodes => {
                self.expect('}', "after `return`, to end the function")?;
                if self.closes_a_call {
                    self.expect(')', "to end `Fn(`")?;
                }
                self.take_symbol(';');
            }
            _ => {
                self.expect('}', "after `return`, to end the function")?;
                // What ends a shader in OSL may be followed by a semicolon.
                if self.language == Language::Osl {
                    self.take_symbol(';');
                }
            }
        }
        if self.peek().is_some() && self.variant().is_none() {
            return self.error(self.offset(), "expected no more than one function");
        }
        Ok(())
    }

    /// Returns the offset of a function of the same name in the other precision: `f_half` behind
    /// `f_float`.
    pub(super) fn variant(&self) -> Option<usize> {
        let name = self.function.strip_suffix("_float")?;
        let follows = self.tokens.get(self.next + 1);
        let is_variant =
            matches!(follows, Some((_, Token::Name(other))) if *other == format!("{name}_half"));
        (self.language == Language::Hlsl && is_variant).then(|| self.offset())
    }

    /// Reads the structure that the function may return.
    fn structure(&mut self) -> Read<()> {
        let typedef = self.language == Language::C && self.take_word("typedef");
        if !self.take_word("struct") {
            return Ok(());
        }
        let first = self.take_name();
        if first.is_none() && !typedef {
            return self.error(self.offset(), "expected the name of a structure");
        }
        self.expect('{', "and the members of the structure")?;
        let (mut members, mut types) = (Vec::new(), Vec::new());
        while !self.take_symbol('}') {
            let at = self.offset();
            let (member, of) = self.typed_name("a member")?;
            types.push(of);
            if types[0] != of {
                return self.error(at, "members of floats and of halves in one structure");
            }
            members.push(member);
            match self.language {
                Language::Wgsl if self.is_symbol(0, '}') => {}
                Language::Wgsl => self.expect(',', "after a member")?,
                _ => self.expect(';', "after a member")?,
            }
        }
        let name = if typedef { self.take_name() } else { first };
        let Some(name) = name else {
            return self.error(self.offset(), "expected the name of a structure");
        };
        if self.language != Language::Wgsl {
            self.expect(';', "after the structure")?;
        }
        let of = types.first().copied().unwrap_or(Type::Single);
        self.structure = Some(Structure { name, members, of });
        Ok(())
    }

    /// Reads `fn f(x: f32) -> f32 {`.
    fn fn_head(&mut self) -> Read<Vec<String>> {
        let inputs = self.fn_signature()?;
        self.expect('{', "and the body of the function")?;
        Ok(inputs)
    }

    fn fn_signature(&mut self) -> Read<Vec<String>> {
        self.of_function = self.qualifiers(self.syntax.readable.of_functions);
        if !self.take_word("fn") {
            return self.error(self.offset(), "expected a function, `fn f(x: f32) -> f32`");
        }
        self.function_name()?;
        let inputs = self.parameters()?;
        if self.outs.is_empty() || self.is_symbol(0, '-') {
            self.expect('-', "and `>`, before the type that the function returns")?;
            self.expect('>', "before the type that the function returns")?;
            match self.language == Language::Rust && self.take_symbol('(') {
                true => self.tuple_type()?,
                false => self.returned_type()?,
            }
        } else {
            self.returned = Some(0);
        }
        self.of_outputs()?;
        Ok(inputs)
    }

    /// Reads `f32, f32)`.
    fn tuple_type(&mut self) -> Read<()> {
        let mut size = 0;
        while !self.take_symbol(')') {
            let at = self.offset();
            let name = self.type_name()?;
            if self.known_type(&name) != Some((Type::Single, 1)) {
                return self.unknown_type(&name, at, "what a function returns");
            }
            size += 1;
            if !self.is_symbol(0, ')') {
                self.expect(',', "or `)` after a type")?;
            }
        }
        (self.of, self.returned) = (Type::Single, Some(size));
        Ok(())
    }

    /// Reads `float f(float x) {`.
    fn c_head(&mut self) -> Read<Vec<String>> {
        let inputs = self.c_signature()?;
        self.expect('{', "and the body of the function")?;
        Ok(inputs)
    }

    fn c_signature(&mut self) -> Read<Vec<String>> {
        self.of_function = self.qualifiers(self.syntax.readable.of_functions);
        if self.peek().is_none() {
            return self.error(self.offset(), "expected a function");
        }
        let nothing = self.syntax.out_parameter.is_some() && self.take_word("void");
        let is_shader = self.language == Language::Osl && self.take_word("shader");
        match nothing || is_shader {
            true => self.returned = Some(0),
            false => self.returned_type()?,
        }
        self.function_name()?;
        let inputs = self.parameters()?;
        self.semantic()?;
        self.of_outputs()?;
        Ok(inputs)
    }

    /// Takes the outputs' type from the parameters that they leave by, if none is returned.
    fn of_outputs(&mut self) -> Read<()> {
        if let (Some(0), Some(first)) = (self.returned, self.outs.first()) {
            self.of = first.of;
        }
        self.same_types()
    }

    /// Reads `export function f(x) {` or `def f(x):`.
    fn word_head(&mut self, word: &str) -> Read<Vec<String>> {
        self.of_function = self.qualifiers(self.syntax.readable.of_functions);
        if !self.take_word(word) {
            return self.error(self.offset(), format!("expected a function, `{word} f(x)`"));
        }
        self.function_name()?;
        let inputs = self.names_of_parameters(')')?;
        match word {
            "def" => self.expect(':', "and the body of the function")?,
            _ => self.expect('{', "and the body of the function")?,
        }
        Ok(inputs)
    }

    /// Returns true for the word, or for it after `export`.
    fn is_word_ahead(&self, word: &str) -> bool {
        let name = |ahead: usize| match self.tokens.get(self.next + ahead) {
            Some((_, Token::Name(name))) => Some(name.as_str()),
            _ => None,
        };
        name(0) == Some(word) || name(0) == Some("export") && name(1) == Some(word)
    }

    fn nodes_head(&mut self) -> Read<Vec<String>> {
        let inputs = self.nodes_signature()?;
        self.expect('{', "and the body of the function")?;
        Ok(inputs)
    }

    /// Reads `export const f = Fn(([x]) =>`, or `export const f = (x) =>`.
    fn nodes_signature(&mut self) -> Read<Vec<String>> {
        self.of_function = self.qualifiers(self.syntax.readable.of_functions);
        let at = self.offset();
        let name = if self.take_word("const") { self.take_name() } else { None };
        let Some(name) = name else {
            return self.error(at, "expected a function, `export const f = Fn(([x]) => {`");
        };
        self.allowed(&name, at)?;
        self.function = name;
        self.expect('=', "and the function")?;
        self.closes_a_call = self.take_word("Fn");
        if self.closes_a_call {
            self.expect('(', "after `Fn`")?;
        }
        self.expect('(', "and the parameters of a function")?;
        let inputs = match self.closes_a_call {
            true => {
                self.expect('[', "and the parameters of a function")?;
                let inputs = self.names_of_parameters(']')?;
                self.expect(')', "after the parameters")?;
                inputs
            }
            false => self.names_of_parameters(')')?,
        };
        self.expect('=', "and `>`, before the body of the function")?;
        self.expect('>', "before the body of the function")?;
        Ok(inputs)
    }

    /// Reads names without types.
    fn names_of_parameters(&mut self, close: char) -> Read<Vec<String>> {
        let mut names = Vec::new();
        while !self.take_symbol(close) {
            let at = self.offset();
            let Some(name) = self.take_name() else {
                return self.error(at, "expected a parameter");
            };
            self.parameter(&name, 1, Type::Single, &mut names, at)?;
            if !self.is_symbol(0, close) {
                self.expect(',', &format!("or `{close}` after a parameter"))?;
            }
        }
        Ok(names)
    }

    fn function_name(&mut self) -> Read<()> {
        let at = self.offset();
        let Some(name) = self.take_name() else {
            return self.error(at, "expected the name of a function");
        };
        self.allowed(&name, at)?;
        self.function = name;
        self.expect('(', "and the parameters of a function")
    }

    /// Reads the returned type, and how many outputs it holds.
    fn returned_type(&mut self) -> Read<()> {
        let at = self.offset();
        let name = self.type_name()?;
        let (of, returned) = match (&self.structure, self.known_type(&name)) {
            (Some(structure), None) if structure.name == name => {
                (structure.of, structure.members.len())
            }
            (_, Some(known)) => known,
            _ => return self.unknown_type(&name, at, "what a function returns"),
        };
        (self.of, self.returned) = (of, Some(returned));
        Ok(())
    }

    fn parameters(&mut self) -> Read<Vec<String>> {
        let mut names: Vec<String> = Vec::new();
        while !self.take_symbol(')') {
            let at = self.offset();
            let qualifiers = self.qualifiers(self.syntax.readable.of_parameters).join(" ");
            let prefix = self.out_prefix();
            let marked = prefix.is_some_and(|word| self.take_word(word));
            let (name, written, reference) = self.typed("a parameter")?;
            let Some((of, size)) = self.known_type(&written) else {
                return self.unknown_type(&written, at, "a parameter");
            };
            let is_out = if prefix.is_some() { marked } else { reference };
            if is_out {
                self.allowed(&name, at)?;
                let parameter = Parameter { size, ..Parameter::float(&name, true) };
                self.parameters.push(Parameter { qualifiers, ..parameter });
                self.outs.push(Out { name, of, size, value: None });
            } else {
                self.parameter(&name, size, of, &mut names, at)?;
                self.parameters.last_mut().expect("it was just added").qualifiers = qualifiers;
            }
            self.semantic()?;
            self.default_value()?;
            if !self.is_symbol(0, ')') {
                self.expect(',', "or `)` after a parameter")?;
            }
        }
        Ok(names)
    }

    /// Returns the word before a parameter that results leave by, if the language has one.
    fn out_prefix(&self) -> Option<&'static str> {
        let written = self.syntax.out_parameter?("T", "n");
        ["out", "output", "thread"]
            .into_iter()
            .find(|word| written.starts_with(&format!("{word} ")))
    }

    /// Reads the value of a shader's parameter that nothing is connected to.
    fn default_value(&mut self) -> Read<()> {
        if self.language != Language::Osl || !self.take_symbol('=') {
            return Ok(());
        }
        self.take_symbol('-');
        match self.peek() {
            Some(Token::Number(_)) => {
                self.next += 1;
                Ok(())
            }
            _ => self.error(self.offset(), "expected a number"),
        }
    }

    /// Defines a parameter, whose components are the next inputs.
    fn parameter(
        &mut self,
        name: &str,
        size: usize,
        of: Type,
        names: &mut Vec<String>,
        at: usize,
    ) -> Read<()> {
        if names.len() + size > usize::from(u16::MAX) {
            return self.error(at, "a function has no more than 65535 parameters");
        }
        self.parameters.push(Parameter { size, ..Parameter::float(name, false) });
        let float = |i: usize| Float { arg: Arg::Input(i as u16), of, exact: None };
        if size == 1 {
            self.define(name, Value::Float(float(names.len())), at)?;
            names.push(name.to_owned());
            return Ok(());
        }
        let components: Vec<_> = (0..size).map(|i| (None, float(names.len() + i))).collect();
        let types = if of == Type::Half { self.half } else { Some(self.syntax) };
        let of = types.map_or("", |syntax| syntax.types[size - 1]).to_owned();
        self.define(name, Value::Several(Several { of, components }), at)?;
        names.extend(COMPONENTS[..size].iter().map(|component| format!("{name}.{component}")));
        Ok(())
    }

    /// Reads where a value comes from or goes to: `: TEXCOORD0`.
    fn semantic(&mut self) -> Read<()> {
        let semantics = self.syntax.readable.semantics;
        if semantics && self.take_symbol(':') && self.take_name().is_none() {
            return self.error(self.offset(), "expected a semantic after `:`");
        }
        Ok(())
    }

    fn same_types(&self) -> Read<()> {
        let differs = |value: &Value| match value {
            Value::Float(float) => float.of != self.of,
            Value::Several(several) => several.components[0].1.of != self.of,
            _ => false,
        };
        let values = self.values.iter().filter(|(_, value)| differs(value));
        let outs = self.outs.iter().filter(|out| out.of != self.of);
        let names = values.map(|(name, _)| name).chain(outs.map(|out| &out.name));
        match names.min() {
            None => Ok(()),
            Some(name) => self.error(
                self.offset(),
                format!("`{name}` and what is returned are not both floats, or both halves"),
            ),
        }
    }

    pub(super) fn qualifiers(&mut self, allowed: &[&str]) -> Vec<String> {
        let mut found = Vec::new();
        while let Some(&word) = allowed.iter().find(|word| self.take_word(word)) {
            found.push(word.to_owned());
        }
        found
    }

    /// Reads a type, or one that results leave by: `ptr<function, f32>`, `&mut f32`.
    fn type_or_reference(&mut self) -> Read<(String, bool)> {
        if self.language == Language::Rust && self.take_symbol('&') {
            if !self.take_word("mut") {
                return self.error(self.offset(), "expected `mut`: results leave by `&mut f32`");
            }
            return Ok((self.type_name()?, true));
        }
        let is_pointer = self.language == Language::Wgsl && self.is_symbol(1, '<');
        if !is_pointer || !self.take_word("ptr") {
            return Ok((self.type_name()?, false));
        }
        self.expect('<', "after `ptr`")?;
        if !self.take_word("function") {
            return self.error(self.offset(), "expected `function`, as in `ptr<function, f32>`");
        }
        self.expect(',', "after `function`")?;
        let written = self.type_name()?;
        self.expect('>', "after the type that is pointed to")?;
        Ok((written, true))
    }

    /// Reads the name and the type of a float.
    fn typed_name(&mut self, what: &str) -> Read<(String, Type)> {
        let at = self.offset();
        let (name, written, _) = self.typed(what)?;
        match self.known_type(&written) {
            Some((of, 1)) => Ok((name, of)),
            _ => self.unknown_type(&written, at, what),
        }
    }

    /// Reads `x: f32` or `float x`: the name, the type, and whether it is a reference.
    fn typed(&mut self, what: &str) -> Read<(String, String, bool)> {
        let expected = |reader: &Self| reader.error(reader.offset(), format!("expected {what}"));
        if matches!(self.syntax.readable.style, Style::Wgsl | Style::Rust) {
            let Some(name) = self.take_name() else { return expected(self) };
            self.expect(':', &format!("and the type of {what}"))?;
            let (written, reference) = self.type_or_reference()?;
            return Ok((name, written, reference));
        }
        if !matches!(self.peek(), Some(Token::Name(_))) {
            return expected(self);
        }
        let written = self.type_name()?;
        let out_parameter = self.syntax.out_parameter.map(|out| out("T", "n")).unwrap_or_default();
        let sign = ['&', '*'].into_iter().find(|&sign| out_parameter.contains(sign));
        let reference = sign.is_some_and(|sign| self.take_symbol(sign));
        let Some(name) = self.take_name() else { return expected(self) };
        Ok((name, written, reference))
    }
}
