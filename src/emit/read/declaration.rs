//! Structures, functions and their parameters.

use super::lex::Token;
use super::types::{Float, Type};
use super::{Read, Reader, Structure, Value};
use crate::emit::Language;
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
        let inputs = match self.language {
            Language::Wgsl => self.wgsl_head()?,
            _ => self.c_head()?,
        };
        self.draft.inputs = inputs.len();
        self.expect('{', "and the body of the function")?;
        loop {
            if let Some(outputs) = self.statement()? {
                self.expect('}', "after `return`, to end the function")?;
                if self.peek().is_some() {
                    return self.error(self.offset(), "expected no more than one function");
                }
                return Ok(Names { inputs, outputs });
            }
        }
    }

    /// Reads the structure that the function may return.
    fn structure(&mut self) -> Read<()> {
        if !self.take_word("struct") {
            return Ok(());
        }
        let Some(name) = self.take_name() else {
            return self.error(self.offset(), "expected the name of a structure");
        };
        self.expect('{', "and the members of the structure")?;
        let (mut members, mut types) = (0, Vec::new());
        while !self.take_symbol('}') {
            let at = self.offset();
            let (_, of) = self.typed_name("a member")?;
            types.push(of);
            if types[0] != of {
                return self.error(at, "members of floats and of halves in one structure");
            }
            members += 1;
            match self.language {
                Language::Wgsl if self.is_symbol(0, '}') => {}
                Language::Wgsl => self.expect(',', "after a member")?,
                _ => self.expect(';', "after a member")?,
            }
        }
        if self.language != Language::Wgsl {
            self.expect(';', "after the structure")?;
        }
        let of = types.first().copied().unwrap_or(Type::Single);
        self.structure = Some(Structure { name, members, of });
        Ok(())
    }

    /// Reads `fn f(x: f32) -> f32`.
    fn wgsl_head(&mut self) -> Read<Vec<String>> {
        if !self.take_word("fn") {
            return self.error(self.offset(), "expected a function, `fn f(x: f32) -> f32`");
        }
        self.function_name()?;
        let inputs = self.parameters()?;
        self.expect('-', "and `>`, before the type that the function returns")?;
        self.expect('>', "before the type that the function returns")?;
        self.returned_type()?;
        self.same_types(&inputs)?;
        Ok(inputs)
    }

    /// Reads `float f(float x)`.
    fn c_head(&mut self) -> Read<Vec<String>> {
        self.qualifiers(self.syntax.readable.of_functions);
        if self.peek().is_none() {
            return self.error(self.offset(), "expected a function");
        }
        self.returned_type()?;
        self.function_name()?;
        let inputs = self.parameters()?;
        self.semantic()?;
        self.same_types(&inputs)?;
        Ok(inputs)
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
        (self.of, self.returned) = match (&self.structure, self.known_type(&name)) {
            (Some(structure), None) if structure.name == name => (structure.of, structure.members),
            (_, Some(known)) => known,
            _ => return self.unknown_type(&name, at, "what a function returns"),
        };
        Ok(())
    }

    fn parameters(&mut self) -> Read<Vec<String>> {
        let mut names: Vec<String> = Vec::new();
        while !self.take_symbol(')') {
            let at = self.offset();
            self.qualifiers(self.syntax.readable.of_parameters);
            let (name, of) = self.typed_name("a parameter")?;
            if names.len() >= usize::from(u16::MAX) {
                return self.error(at, "a function has no more than 65535 parameters");
            }
            let float = Float { arg: Arg::Input(names.len() as u16), of, exact: None };
            self.define(&name, Value::Float(float), at)?;
            names.push(name);
            self.semantic()?;
            if !self.is_symbol(0, ')') {
                self.expect(',', "or `)` after a parameter")?;
            }
        }
        Ok(names)
    }

    /// Reads where a value comes from or goes to: `: TEXCOORD0`.
    fn semantic(&mut self) -> Read<()> {
        let semantics = self.syntax.readable.semantics;
        if semantics && self.take_symbol(':') && self.take_name().is_none() {
            return self.error(self.offset(), "expected a semantic after `:`");
        }
        Ok(())
    }

    fn same_types(&self, inputs: &[String]) -> Read<()> {
        let differs = |name: &&String| match self.values.get(*name) {
            Some(Value::Float(float)) => float.of != self.of,
            _ => false,
        };
        match inputs.iter().find(differs) {
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

    /// Reads `x: f32` in WGSL, `float x` elsewhere.
    fn typed_name(&mut self, what: &str) -> Read<(String, Type)> {
        let mut at = self.offset();
        let expected = |reader: &Self| reader.error(reader.offset(), format!("expected {what}"));
        let (name, written) = if self.language == Language::Wgsl {
            let Some(name) = self.take_name() else { return expected(self) };
            self.expect(':', &format!("and the type of {what}"))?;
            at = self.offset();
            (name, self.type_name()?)
        } else {
            if !matches!(self.peek(), Some(Token::Name(_))) {
                return expected(self);
            }
            let written = self.type_name()?;
            let Some(name) = self.take_name() else { return expected(self) };
            (name, written)
        };
        match self.known_type(&written) {
            Some((of, 1)) => Ok((name, of)),
            _ => self.unknown_type(&written, at, what),
        }
    }

    /// Reads `float`, or `vec2<f32>`.
    pub(super) fn type_name(&mut self) -> Read<String> {
        let Some(name) = self.take_name() else {
            return self.error(self.offset(), "expected a type");
        };
        Ok(self.with_element(name))
    }

    /// Appends `<f32>` to the name, if it follows.
    pub(super) fn with_element(&mut self, name: String) -> String {
        let element = match self.tokens.get(self.next + 1) {
            Some((_, Token::Name(element))) => element.clone(),
            _ => return name,
        };
        if !self.is_symbol(0, '<') || !self.is_symbol(2, '>') {
            return name;
        }
        self.next += 3;
        format!("{name}<{element}>")
    }

    /// Returns the type of a type's components, and their number.
    pub(super) fn known_type(&self, name: &str) -> Option<(Type, usize)> {
        let of = |types: &[&str], of: Type| {
            let size = types.iter().position(|known| *known == name)?;
            Some((of, size + 1))
        };
        let short: [&[&str]; 2] = match self.language {
            Language::Wgsl => {
                [&["f32", "vec2f", "vec3f", "vec4f"], &["f16", "vec2h", "vec3h", "vec4h"]]
            }
            _ => [&[], &[]],
        };
        of(self.syntax.types, Type::Single)
            .or_else(|| of(self.half.types, Type::Half))
            .or_else(|| of(short[0], Type::Single))
            .or_else(|| of(short[1], Type::Half))
    }

    pub(super) fn unknown_type<T>(&self, name: &str, at: usize, what: &str) -> Read<T> {
        let float = self.syntax.types[0];
        let why = match name {
            "int" | "uint" | "i32" | "u32" | "short" | "long" | "bool" => {
                ": it holds no fractions, so the code would compute something else"
            }
            "double" | "mediump" | "lowp" | "f64" => ": it has another precision than a float",
            _ => "",
        };
        self.error(at, format!("`{name}` cannot be the type of {what}{why}; write `{float}`"))
    }
}
