//! Calls of functions, and the operations that they spell.

use super::types::{Float, Type};
use super::{Comparison, Read, Reader, Several, Value};
use crate::emit::Language;
use crate::emit::syntax::{self, Style, Syntax};
use crate::op::{MAX_ARITY, Op};
use crate::program::Arg;
use crate::suggest::did_you_mean;

impl Reader<'_> {
    /// Reads a call of `name`, after its parenthesis.
    pub(super) fn call(&mut self, name: String, at: usize) -> Read<Value> {
        let by_name = matches!(self.language, Language::Glsl | Language::GlslEs | Language::Wgsl);
        let structure = self.structure.as_ref().is_some_and(|known| known.name == name);
        match self.made_by(&name) {
            Some((of, 1)) => return self.conversion(of),
            Some(_) => return self.several(name, ')'),
            None if self.is_identity(&name) => return self.conversion(Type::Single),
            None if self.is_vector_of_nodes(&name) => {
                let components = self.components_until(')')?;
                return Ok(Value::Several(Several { of: name, components }));
            }
            None if structure && by_name => return self.several(name, ')'),
            None => {}
        }
        let mut args = vec![self.expression()?];
        while self.take_symbol(',') {
            args.push(self.expression()?);
        }
        self.expect(')', "after the arguments")?;
        match args.as_slice() {
            [Value::Bits(bits)] if self.makes_a_float(&name) => {
                Ok(Value::Float(Float::single(self.float_of_bits(*bits)?)))
            }
            [Value::Float(a), Value::Float(b)] if name == "lessThan" => {
                Ok(Value::Compared(Comparison::Less(a.arg, b.arg)))
            }
            [Value::Compared(condition), Value::Float(x), Value::Float(y)]
                if ["select", "np.where"].contains(&name.as_str())
                    && matches!(self.syntax.readable.style, Style::Nodes | Style::Python) =>
            {
                self.choice(*condition, *x, *y, at)
            }
            _ => self.operation(&name, &args, at),
        }
    }

    /// Reads `float(x)` or `half(x)`.
    fn conversion(&mut self, to: Type) -> Read<Value> {
        let at = self.offset();
        let value = self.expression()?;
        self.expect(')', "after what is converted")?;
        match value {
            // `uint(0x7f800000)`
            Value::Bits(_) if self.syntax.readable.style == Style::Nodes => {
                if self.take_symbol('.') && !self.take_word("toVar") {
                    return self.error(self.offset(), "expected `toVar()`");
                }
                if self.take_symbol('(') {
                    self.expect(')', "after `toVar(`")?;
                }
                Ok(value)
            }
            // In GLSL ES a constructor keeps the precision.
            _ if self.language == Language::GlslEs => Ok(Value::Float(self.as_float(value, at)?)),
            _ => {
                let value = self.as_float(value, at)?;
                Ok(Value::Float(self.cast(value, to)?))
            }
        }
    }

    /// Returns true for what makes a float of a float: `float(x)` of a node, `np.float32(x)`.
    fn is_identity(&self, name: &str) -> bool {
        match self.syntax.readable.style {
            Style::Nodes => ["float", "uint"].contains(&name),
            Style::Python => name == "np.float32",
            _ => false,
        }
    }

    fn is_vector_of_nodes(&self, name: &str) -> bool {
        self.syntax.readable.style == Style::Nodes && ["vec2", "vec3", "vec4"].contains(&name)
    }

    fn makes_a_float(&self, name: &str) -> bool {
        name == match self.language {
            Language::Wgsl => "bitcast<f32>",
            Language::Msl => "as_type<float>",
            _ => self.syntax.float_of_bits,
        }
    }

    /// A program's constants are finite; infinities and NaNs are computed from them.
    pub(super) fn float_of_bits(&mut self, bits: u32) -> Read<Arg> {
        let value = f32::from_bits(bits);
        if value.is_finite() {
            return self.number(value);
        }
        let zero = self.number(0.0f32.copysign(value))?;
        match value.is_nan() {
            true => self.push(Op::Div, &[zero, zero], Type::Single),
            false => self.push(Op::Rcp, &[zero], Type::Single),
        }
    }

    fn operation(&mut self, name: &str, args: &[Value], at: usize) -> Read<Value> {
        // Functions of floats and of halves may have the same names, or not.
        let both = [Some(self.syntax), self.half];
        let calls = || {
            let syntaxes = both.into_iter().flatten();
            syntaxes.flat_map(|syntax| {
                Op::ALL.iter().filter_map(move |&op| Some((op, call_of(syntax, op)?)))
            })
        };
        let named = calls().filter(|(_, call)| call.name == name);
        let found = named.clone().find_map(|(op, call)| Some((op, self.matched(&call, args)?)));
        let of = self.meeting_of_arguments(&floats(args), at)?;
        match found {
            // Between 0 and 1 it is a saturation, and read as such.
            None if name == "clamp" => self.clamp(args, of, at),
            Some((op, args))
                if self.syntax.readable.style == Style::C && self.is_of_floats(name, op) =>
            {
                self.called(op, &args, Type::Single, Type::Single)
            }
            Some((Op::Sign, args)) if self.syntax.readable.integer_sign => {
                self.called(Op::Sign, &args, of, Type::Integer)
            }
            Some((op, args)) => self.called(op, &args, of, of),
            None if named.count() > 0 => self.other_arguments(name, at),
            None => {
                let known: Vec<&str> = calls().map(|(_, call)| call.name).collect();
                let hint = did_you_mean(name, known);
                self.error(at, format!("`{name}` is no function that can be read{hint}"))
            }
        }
    }

    /// Returns true for a function that makes a float of halves, as C's does: halves have another.
    fn is_of_floats(&self, name: &str, op: Op) -> bool {
        let Some(half) = self.half.filter(|_| self.language == Language::Cuda) else {
            return false;
        };
        call_of(half, op).is_none_or(|call| call.name != name)
    }

    fn other_arguments<T>(&self, name: &str, at: usize) -> Read<T> {
        self.error(at, format!("`{name}` is not read with these arguments"))
    }

    fn called(&mut self, op: Op, args: &[Arg], of: Type, is: Type) -> Read<Value> {
        let arg = self.push(op, args, of)?;
        Ok(Value::Float(Float { arg, of: is, exact: None }))
    }

    fn clamp(&mut self, args: &[Value], of: Type, at: usize) -> Read<Value> {
        let [Value::Float(x), Value::Float(low), Value::Float(high)] = args else {
            return self.other_arguments("clamp", at);
        };
        let raised = self.push(Op::Max, &[x.arg, low.arg], of)?;
        self.called(Op::Min, &[raised, high.arg], of, of)
    }

    pub(super) fn is_constant(&self, value: &Float, expected: f32) -> bool {
        matches!(value.arg, Arg::Const(i) if self.draft.consts[usize::from(i)] == expected)
    }

    /// Returns the operation's arguments, in its order.
    fn matched(&self, call: &Call, values: &[Value]) -> Option<Vec<Arg>> {
        let mut args = [None; MAX_ARITY];
        for (place, value) in call.places.iter().zip(values) {
            match (place, value) {
                (CallPart::Argument(i), Value::Float(value)) => args[*i] = Some(value.arg),
                (CallPart::Less(i, j), Value::Compared(Comparison::Less(a, b))) => {
                    (args[*i], args[*j]) = (Some(*a), Some(*b));
                }
                (CallPart::Literal(literal), Value::Float(value))
                    if self.is_constant(value, *literal) => {}
                _ => return None,
            }
        }
        (call.places.len() == values.len()).then(|| args.into_iter().flatten().collect())
    }
}

/// Returns the values that are computed with; of a condition and the values that it chooses from,
/// the latter.
fn floats(values: &[Value]) -> Vec<Float> {
    let floats = values.iter().filter_map(|value| match value {
        Value::Float(value) => Some(*value),
        _ => None,
    });
    floats.collect()
}

/// An operation that is written as a function.
struct Call {
    name: &'static str,
    places: Vec<CallPart>,
}

/// The content between two commas of a call.
enum CallPart {
    Argument(usize),
    Less(usize, usize),
    Literal(f32),
}

/// Returns the operation's spelling, if that is a call.
fn call_of(syntax: &Syntax, op: Op) -> Option<Call> {
    let template = (syntax.spelling)(op).template;
    let template = match template.strip_prefix("float(") {
        Some(converted) => converted.strip_suffix(')')?,
        None => template,
    };
    let (name, rest) = template.split_once('(')?;
    let is_part = |b: u8| b.is_ascii_alphanumeric() || b"_.:".contains(&b);
    let is_name = !name.is_empty() && name.bytes().all(is_part);
    let places = rest.strip_suffix(')').filter(|_| is_name)?;
    Some(Call { name, places: places.split(", ").map(place).collect::<Option<_>>()? })
}

fn place(text: &str) -> Option<CallPart> {
    let argument = |text: &str| match syntax::place(text) {
        Some((place, length)) if length == text.len() => Some(place.argument),
        _ => None,
    };
    match text.split_once(" < ") {
        Some((a, b)) => Some(CallPart::Less(argument(a)?, argument(b)?)),
        None => argument(text)
            .map(CallPart::Argument)
            .or_else(|| Some(CallPart::Literal(text.parse().ok()?))),
    }
}
