//! The types of values, and each language's conversions between them.

use super::lex::Token;
use super::{Precision, Read, Reader};
use crate::emit::Language;
use crate::emit::syntax::Plain;
use crate::op::Op;
use crate::program::Arg;
use half::f16;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    Single,
    Half,
    Integer,
    /// The type of a number without a suffix, where it takes the type of what it meets.
    Open,
}

/// A value to compute with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Float {
    pub arg: Arg,
    pub of: Type,
    /// The value as a compiler that folds in double precision knows it, if it is made of numbers
    /// alone.
    pub exact: Option<f64>,
}

impl Float {
    pub fn single(arg: Arg) -> Float {
        Float { arg, of: Type::Single, exact: None }
    }
}

impl Reader<'_> {
    /// Reads `float`, `vec2<f32>`, or `mediump float`.
    pub(super) fn type_name(&mut self) -> Read<String> {
        let at = self.offset();
        let Some(name) = self.take_name() else {
            return self.error(at, "expected a type");
        };
        if self.language == Language::GlslEs && ["highp", "mediump"].contains(&name.as_str()) {
            let Some(of) = self.take_name() else {
                return self.error(self.offset(), format!("expected a type after `{name}`"));
            };
            return Ok(format!("{name} {of}"));
        }
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
            // Without a qualifier it is highp, in vertex shaders by itself and else by a statement.
            Language::GlslEs => [self.syntax.constructors, &[]],
            _ => [&[], &[]],
        };
        of(self.syntax.types, Type::Single)
            .or_else(|| of(self.half?.types, Type::Half))
            .or_else(|| of(short[0], Type::Single))
            .or_else(|| of(short[1], Type::Half))
    }

    /// Returns what a call of a type or of a constructor makes.
    pub(super) fn made_by(&self, name: &str) -> Option<(Type, usize)> {
        let of = |names: &[&str], of: Type| {
            let size = names.iter().position(|known| *known == name)?;
            Some((of, size + 1))
        };
        of(self.syntax.constructors, Type::Single)
            .or_else(|| of(self.half?.constructors, Type::Half))
            .or_else(|| self.known_type(name))
    }

    pub(super) fn unknown_type<T>(&self, name: &str, at: usize, what: &str) -> Read<T> {
        let float = self.syntax.types.first().copied().unwrap_or("float");
        let why = match name {
            "int" | "uint" | "i32" | "u32" | "short" | "long" | "bool" => {
                ": it holds no fractions, so the code would compute something else"
            }
            "double" | "mediump" | "lowp" | "f64" => ": it has another precision than a float",
            _ => "",
        };
        self.error(at, format!("`{name}` cannot be the type of {what}{why}; write `{float}`"))
    }

    /// Returns the type of a number without a suffix.
    pub(super) fn plain_type(&self) -> Type {
        match self.syntax.readable.plain {
            Plain::Open => Type::Open,
            _ => Type::Single,
        }
    }

    /// Returns the type in which two values meet in arithmetic.
    pub(super) fn meeting(&self, a: Type, b: Type, at: usize) -> Read<Type> {
        use Type::{Half, Integer, Open, Single};
        let refused = |message: &str| self.error(at, message);
        match (a, b) {
            (Integer, Integer) => refused(
                "arithmetic of integers, which is another than that of floats (19/80 is 0); \
                 write them as floats, `19.0/80.0`",
            ),
            _ if a == b => Ok(a),
            (Integer, other) | (other, Integer) => match self.language {
                Language::Glsl | Language::GlslEs => refused(
                    "an integer meets a float, which GLSL ES does not take; write `2.0` for `2`",
                ),
                Language::Rust => refused(
                    "an integer meets a float, which Rust does not take; write `2.0` for `2`",
                ),
                Language::Hlsl if other == Open => Ok(Single),
                _ => Ok(other),
            },
            (Open, Half) | (Half, Open) if self.language == Language::Hlsl => refused(
                "a number without a suffix meets a half: compilers differ in what it is; \
                 write `0.5h` or `0.5f`",
            ),
            (Open, other) | (other, Open) => Ok(other),
            _ if self.language == Language::Wgsl => {
                refused("an f16 meets an f32, which WGSL does not take; convert one")
            }
            _ => Ok(Single),
        }
    }

    /// Returns the type of a call's result from its arguments' types.
    pub(super) fn meeting_of_arguments(&self, args: &[Float], at: usize) -> Read<Type> {
        let integers = args.iter().filter(|arg| arg.of == Type::Integer).count();
        let several =
            self.syntax.readable.plain == Plain::Open && self.language != Language::GlslEs;
        if integers > 0 && (integers == args.len() || !several) {
            let name = self.language.name();
            return self.error(
                at,
                format!(
                    "an integer as an argument, which is ambiguous in {name}; write `2.0` for `2`"
                ),
            );
        }
        let mut types = args.iter().map(|arg| arg.of);
        let first = types.next().unwrap_or(Type::Single);
        types.try_fold(first, |met, of| self.meeting(met, of, at))
    }

    /// Converts the value to a local, a parameter or a component of the type.
    pub(super) fn converted(&mut self, value: Float, to: Type, at: usize) -> Read<Float> {
        let narrows = to == Type::Half && value.of == Type::Single;
        let widens = to == Type::Single && value.of == Type::Half;
        match self.language {
            Language::Wgsl if narrows || widens => {
                self.error(at, "WGSL converts no f16 to f32, nor back, by itself")
            }
            Language::Glsl if narrows => {
                self.error(at, "GLSL makes no half of a float by itself; convert it")
            }
            Language::Glsl | Language::GlslEs | Language::Rust if value.of == Type::Integer => {
                self.error(at, "an integer where a float belongs; write `2.0` for `2`")
            }
            _ => self.cast(value, to),
        }
    }

    /// Converts the value as an explicit cast does.
    pub(super) fn cast(&mut self, value: Float, to: Type) -> Read<Float> {
        let arg = match (to, value.of, value.arg) {
            (Type::Half, Type::Half, _) => value.arg,
            (Type::Half, _, Arg::Const(i)) => {
                let rounded = f16::from_f32(self.draft.consts[usize::from(i)]);
                if rounded.is_infinite() {
                    let at = self.offset();
                    return self.error(at, "a number that no half holds (at most 65504)");
                }
                self.number(rounded.to_f32())?
            }
            (Type::Half, _, arg) => self.rounded(arg)?,
            _ => value.arg,
        };
        Ok(Float { arg, of: to, exact: None })
    }

    /// Rounds a value to halves, as the maximum of it and itself in halves.
    fn rounded(&mut self, arg: Arg) -> Read<Arg> {
        let rounded = self.push(Op::Max, &[arg, arg], Type::Half)?;
        if let Some(last) = self.precisions.last_mut() {
            *last = Precision::Rounding;
        }
        Ok(rounded)
    }

    /// Adds an arithmetic operation on two values.
    pub(super) fn arithmetic(&mut self, op: Op, [a, b]: [Float; 2], at: usize) -> Read<Float> {
        let of = self.meeting(a.of, b.of, at)?;
        let exact = match (a.exact, b.exact) {
            (Some(a), Some(b)) => Some(match op {
                Op::Add => a + b,
                Op::Sub => a - b,
                Op::Mul => a * b,
                _ => a / b,
            }),
            _ => None,
        };
        if let Some(exact) = exact {
            self.folds_alike(op, [a, b], of, exact, at)?;
        }
        let arg = self.push(op, &[a.arg, b.arg], of)?;
        Ok(Float { arg, of, exact })
    }

    /// Returns true where arithmetic of numbers is defined as that of all other values: in the
    /// languages of processors.
    fn folds_as_it_computes(&self) -> bool {
        use Language::{C, Cpp, Cuda, Js, Python, Rust};
        [C, Cpp, Cuda, Js, Python, Rust].contains(&self.language)
    }

    /// Refuses numbers that compilers fold differently: some in double precision, some in that of
    /// their type.
    fn folds_alike(&self, op: Op, args: [Float; 2], of: Type, exact: f64, at: usize) -> Read<()> {
        let [a, b] = args.map(|arg| arg.exact.unwrap_or(f64::NAN));
        let (typed, folded) = match of {
            Type::Half => {
                let [a, b] = [a, b].map(|x| f16::from_f64(x).to_f32());
                let typed = f16::from_f32(op.apply([a, b, 0.0, 0.0]));
                (typed.to_f32(), f16::from_f64(exact).to_f32())
            }
            _ => (op.apply([a as f32, b as f32, 0.0, 0.0]), exact as f32),
        };
        if !typed.is_finite() || !folded.is_finite() {
            return self
                .error(at, "numbers that make no finite one, which is an error in some languages");
        }
        if typed.to_bits() == folded.to_bits() || self.folds_as_it_computes() {
            return Ok(());
        }
        self.error(
            at,
            format!(
                "compilers differ in the precision in which they compute with numbers \
                 ({typed} or {folded}); write the result"
            ),
        )
    }
}
