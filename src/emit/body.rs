//! The statements of a function.

use super::{Binding, Signature, Spelling, Syntax, naming::Naming};
use crate::op::MAX_ARITY;
use crate::program::{Arg, Program};

/// No expression is longer, unless its names are; with the declaration around it a line stays
/// within 100 columns.
const WIDTH: usize = 72;

/// One for each output, and for each result that is read more than once or too long to be read
/// in place.
pub(super) fn statements(
    syntax: &Syntax,
    program: &Program,
    signature: &Signature,
    naming: &mut Naming,
) -> Vec<String> {
    let folded = fold(program);
    let counts = use_counts(program, &folded);
    let mut body = Body {
        syntax,
        program,
        signature,
        naming,
        folded,
        codes: Vec::with_capacity(program.instrs.len()),
        statements: Vec::new(),
        non_finite: Vec::new(),
    };
    for (i, &count) in counts.iter().enumerate() {
        body.instruction(i, count);
    }
    body.remaining_outputs();
    body.statements
}

/// The value of each instruction that depends on no input.
fn fold(program: &Program) -> Vec<Option<f32>> {
    let mut folded: Vec<Option<f32>> = Vec::with_capacity(program.instrs.len());
    for instr in &program.instrs {
        let mut args = [0.0; MAX_ARITY];
        let known = args.iter_mut().zip(instr.args()).all(|(to, &arg)| {
            let value = match arg {
                Arg::Input(_) => None,
                Arg::Const(i) => Some(program.consts[usize::from(i)]),
                Arg::Result(i) => folded[usize::from(i)],
            };
            *to = value.unwrap_or(0.0);
            value.is_some()
        });
        folded.push(known.then(|| instr.op().apply(args)));
    }
    folded
}

/// How often each result is read by an output or by code that is not folded.
fn use_counts(program: &Program, folded: &[Option<f32>]) -> Vec<u32> {
    let mut counts = vec![0; program.instrs.len()];
    let count = |args: &[Arg], counts: &mut Vec<u32>| {
        for &arg in args {
            if let Arg::Result(i) = arg {
                counts[usize::from(i)] += 1;
            }
        }
    };
    count(&program.outputs, &mut counts);
    for (i, instr) in program.instrs.iter().enumerate().rev() {
        if counts[i] > 0 && folded[i].is_none() {
            count(instr.args(), &mut counts);
        }
    }
    counts
}

/// How a reader of a value writes it.
#[derive(Clone)]
struct Code {
    text: String,
    binding: Binding,
    /// Whether it is a whole expression, that could be given a name instead.
    in_place: bool,
}

impl Code {
    fn name(text: String) -> Code {
        Code { text, binding: Binding::Atom, in_place: false }
    }
}

struct Body<'a, 'n> {
    syntax: &'a Syntax,
    program: &'a Program,
    signature: &'a Signature,
    naming: &'a mut Naming<'n>,
    folded: Vec<Option<f32>>,
    codes: Vec<Code>,
    statements: Vec<String>,
    /// The bits and the name of each infinity or NaN declared so far.
    non_finite: Vec<(u32, String)>,
}

impl Body<'_, '_> {
    fn instruction(&mut self, i: usize, count: u32) {
        let output =
            self.program.outputs.iter().position(|&output| output == Arg::Result(i as u16));
        let code = match self.folded[i] {
            _ if count == 0 => Code::name(String::new()),
            Some(value) => self.constant(value),
            None => self.expression(i),
        };
        let name = match output {
            Some(output) => Some(self.signature.outputs[output].clone()),
            None if count > 1 && code.in_place => Some(self.naming.temporary()),
            None => None,
        };
        let code = match name {
            Some(name) => self.declare(name, &code.text),
            None => code,
        };
        self.codes.push(code);
    }

    fn declare(&mut self, name: String, value: &str) -> Code {
        self.statements.push((self.syntax.local)(&name, value));
        Code::name(name)
    }

    /// Outputs that are inputs, constants, or another output's result.
    fn remaining_outputs(&mut self) {
        for (o, &arg) in self.program.outputs.iter().enumerate() {
            let first = self.program.outputs.iter().position(|&other| other == arg);
            if matches!(arg, Arg::Result(_)) && first == Some(o) {
                continue;
            }
            let value = self.argument(arg).text;
            self.declare(self.signature.outputs[o].clone(), &value);
        }
    }

    fn expression(&mut self, i: usize) -> Code {
        let instr = self.program.instrs[i];
        let spelling = (self.syntax.spelling)(instr.op());
        let mut args: Vec<Code> = instr.args().iter().map(|&arg| self.argument(arg)).collect();
        let mut text = filled(&spelling, &args);
        while text.len() > WIDTH {
            let in_place = args.iter_mut().filter(|arg| arg.in_place);
            let Some(longest) = in_place.max_by_key(|arg| arg.text.len()) else { break };
            let name = self.naming.temporary();
            *longest = self.declare(name, &longest.text);
            text = filled(&spelling, &args);
        }
        Code { text, binding: spelling.binding, in_place: true }
    }

    fn argument(&mut self, arg: Arg) -> Code {
        match arg {
            Arg::Input(i) => Code::name(self.signature.inputs[usize::from(i)].clone()),
            Arg::Const(i) => self.constant(self.program.consts[usize::from(i)]),
            Arg::Result(i) => self.codes[usize::from(i)].clone(),
        }
    }

    fn constant(&mut self, value: f32) -> Code {
        if !value.is_finite() {
            return self.non_finite(value);
        }
        let binding = if value.is_sign_negative() { Binding::Negation } else { Binding::Atom };
        Code { text: (self.syntax.literal)(value), binding, in_place: false }
    }

    fn non_finite(&mut self, value: f32) -> Code {
        let (value, name) = match value {
            _ if value.is_nan() => (f32::NAN, "not_a_number"),
            _ if value > 0.0 => (value, "infinity"),
            _ => (value, "minus_infinity"),
        };
        let bits = value.to_bits();
        if let Some((_, name)) = self.non_finite.iter().find(|(known, _)| *known == bits) {
            return Code::name(name.clone());
        }
        let name = self.naming.fresh(name);
        let bits_name = self.naming.fresh(&format!("{name}_bits"));
        self.statements.extend((self.syntax.non_finite)(&name, &bits_name, bits));
        self.non_finite.push((bits, name.clone()));
        Code::name(name)
    }
}

/// The template with the arguments in its places.
fn filled(spelling: &Spelling, args: &[Code]) -> String {
    let mut pieces = spelling.template.split('{');
    let mut text = pieces.next().unwrap_or("").to_owned();
    for piece in pieces {
        let (place, rest) = piece.split_once('}').unwrap_or((piece, ""));
        let (index, least) = argument_place(place);
        let arg = &args[index];
        if arg.binding >= least {
            text.push_str(&arg.text);
        } else {
            text.extend(["(", &arg.text, ")"]);
        }
        text.push_str(rest);
    }
    text
}

/// Which argument a template's `a*` stands for, and how tightly that must bind.
pub(super) fn argument_place(place: &str) -> (usize, Binding) {
    let (name, mark) = place.split_at(1);
    let least = match mark {
        "+" => Binding::Sum,
        "*" => Binding::Product,
        "-" => Binding::Negation,
        "!" => Binding::Atom,
        _ => Binding::Select,
    };
    (usize::from(name.as_bytes()[0] - b'a'), least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emit::Language;
    use crate::op::Op;

    #[test]
    fn every_spelling_writes_each_argument_once() {
        for language in Language::ALL {
            for &op in Op::ALL {
                let template = (language.syntax().spelling)(op).template;
                let mut places: Vec<usize> = (template.split('{').skip(1))
                    .map(|piece| argument_place(piece.split('}').next().unwrap()).0)
                    .collect();
                places.sort_unstable();
                assert!(places.into_iter().eq(0..op.arity()), "{op} in {language}: {template}");
            }
        }
    }
}
