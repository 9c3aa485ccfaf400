//! Calls of functions, and which operation is written as which.

use super::{Read, Reader, Value};
use crate::emit::syntax::{self, Syntax};
use crate::op::{MAX_ARITY, Op};
use crate::program::Arg;
use crate::suggest::did_you_mean;

impl Reader<'_> {
    pub(super) fn constant(&mut self, value: f32) -> Read<Arg> {
        if self.draft.consts.len() >= usize::from(u16::MAX) {
            return self.error(self.offset(), "more than 65535 constants");
        }
        Ok(self.draft.constant(value))
    }

    pub(super) fn call(&mut self, name: &str, at: usize) -> Read<Value> {
        let is_vector = ["float2", "float3", "float4", "vec2", "vec3", "vec4"].contains(&name);
        if is_vector || self.structure.as_deref() == Some(name) {
            return self.components(')').map(Value::Several);
        }
        let mut args = vec![self.expression()?];
        while self.take_symbol(',') {
            args.push(self.expression()?);
        }
        self.expect(')', "after the arguments")?;
        match args.as_slice() {
            [Value::Bits(bits)] if name == self.syntax.float_of_bits => {
                self.float_of_bits(*bits).map(Value::Float)
            }
            // A conversion, of what is a float here.
            [Value::Float(arg)] if name == "float" || name == "f32" => Ok(Value::Float(*arg)),
            _ => self.operation(name, &args, at),
        }
    }

    /// A constant of a program is finite; what is not is computed from such.
    fn float_of_bits(&mut self, bits: u32) -> Read<Arg> {
        let value = f32::from_bits(bits);
        if value.is_finite() {
            return self.constant(value);
        }
        let zero = self.constant(0.0f32.copysign(value))?;
        Ok(match value.is_nan() {
            true => self.draft.push(Op::Div, &[zero, zero]),
            false => self.draft.push(Op::Rcp, &[zero]),
        })
    }

    fn operation(&mut self, name: &str, args: &[Value], at: usize) -> Read<Value> {
        let calls = || Op::ALL.iter().filter_map(|&op| Some((op, call_of(self.syntax, op)?)));
        let named = calls().filter(|(_, call)| call.name == name);
        // Between 0 and 1 it is a saturation, which is found as such.
        if let ("clamp", [Value::Float(x), Value::Float(low), Value::Float(high)]) = (name, args)
            && !self.is_unit(*low, *high)
        {
            let raised = self.draft.push(Op::Max, &[*x, *low]);
            return Ok(Value::Float(self.draft.push(Op::Min, &[raised, *high])));
        }
        let found = named.clone().find_map(|(op, call)| Some((op, self.matched(&call, args)?)));
        match found {
            Some((op, args)) => Ok(Value::Float(self.draft.push(op, &args))),
            None if named.count() > 0 => {
                self.error(at, format!("`{name}` is not read with these arguments"))
            }
            None => {
                let known: Vec<&str> = calls().map(|(_, call)| call.name).collect();
                let hint = did_you_mean(name, known);
                self.error(at, format!("`{name}` is no function that can be read{hint}"))
            }
        }
    }

    fn is_unit(&self, low: Arg, high: Arg) -> bool {
        let is =
            |arg, value| matches!(arg, Arg::Const(i) if self.draft.consts[usize::from(i)] == value);
        is(low, 0.0) && is(high, 1.0)
    }

    /// The operation's arguments, in its order.
    fn matched(&self, call: &Call, values: &[Value]) -> Option<Vec<Arg>> {
        let mut args = [None; MAX_ARITY];
        for (place, value) in call.places.iter().zip(values) {
            match (place, value) {
                (Place::Argument(i), Value::Float(arg)) => args[*i] = Some(*arg),
                (Place::Less(i, j), Value::Less(a, b)) => {
                    (args[*i], args[*j]) = (Some(*a), Some(*b));
                }
                (Place::Literal(literal), Value::Float(Arg::Const(i)))
                    if self.draft.consts[usize::from(*i)] == *literal => {}
                _ => return None,
            }
        }
        (call.places.len() == values.len()).then(|| args.into_iter().flatten().collect())
    }
}

/// An operation that is written as a function.
struct Call {
    name: &'static str,
    places: Vec<Place>,
}

/// What stands between two commas of a call.
enum Place {
    Argument(usize),
    Less(usize, usize),
    Literal(f32),
}

/// The operation's spelling, if that is a call.
fn call_of(syntax: &Syntax, op: Op) -> Option<Call> {
    let template = (syntax.spelling)(op).template;
    let template = match template.strip_prefix("float(") {
        Some(converted) => converted.strip_suffix(')')?,
        None => template,
    };
    let (name, rest) = template.split_once('(')?;
    let is_name = !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric());
    let places = rest.strip_suffix(')').filter(|_| is_name)?;
    Some(Call { name, places: places.split(", ").map(place).collect::<Option<_>>()? })
}

fn place(text: &str) -> Option<Place> {
    let argument = |text: &str| match syntax::place(text) {
        Some((place, length)) if length == text.len() => Some(place.argument),
        _ => None,
    };
    match text.split_once(" < ") {
        Some((a, b)) => Some(Place::Less(argument(a)?, argument(b)?)),
        None => {
            argument(text).map(Place::Argument).or_else(|| Some(Place::Literal(text.parse().ok()?)))
        }
    }
}
