//! The statements of a function.

use super::naming::Naming;
use super::syntax::{Binding, Signature, Spelling, Syntax, pieces, power};
use crate::eval::{Arithmetic, Half};
use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Program};
use half::f16;

/// One for each output, and for each result that is read or written more than once or too long
/// to be read in place.
pub(super) fn statements(
    syntax: &Syntax,
    program: &Program,
    signature: &Signature,
    naming: &mut Naming,
) -> Vec<String> {
    let forms = forms(program, syntax);
    let counts = use_counts(program, &forms);
    let mut body = Body {
        syntax,
        program,
        signature,
        naming,
        forms,
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

/// What is written for an instruction.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// Its value, as it depends on no input.
    Constant(f32),
    /// So many factors of the same value.
    Power(Arg, u32),
    Operation,
}

fn forms(program: &Program, syntax: &Syntax) -> Vec<Form> {
    let mut forms: Vec<Form> = Vec::with_capacity(program.instrs.len());
    for instr in &program.instrs {
        let constant = |arg: Arg| match arg {
            Arg::Input(_) => None,
            Arg::Const(i) => Some(rounded(program.consts[usize::from(i)], syntax)),
            Arg::Result(i) => match forms[usize::from(i)] {
                Form::Constant(value) => Some(value),
                _ => None,
            },
        };
        let factors = |arg: Arg| match arg {
            Arg::Result(i) => match forms[usize::from(i)] {
                Form::Power(base, count) => (base, count),
                _ => (arg, 1),
            },
            _ => (arg, 1),
        };
        let mut values = [0.0; MAX_ARITY];
        let known = values.iter_mut().zip(instr.args()).all(|(to, &arg)| {
            let value = constant(arg);
            *to = value.unwrap_or(0.0);
            value.is_some()
        });
        forms.push(match (instr.op(), instr.args()) {
            (op, _) if known && syntax.half => {
                Form::Constant(Half::default().apply(op, values.map(f16::from_f32)).to_f32())
            }
            (op, _) if known => Form::Constant(op.apply(values)),
            (Op::Mul, &[a, b]) if syntax.power.is_some() && factors(a).0 == factors(b).0 => {
                Form::Power(factors(a).0, factors(a).1 + factors(b).1)
            }
            _ => Form::Operation,
        });
    }
    forms
}

/// A constant in the language's precision.
fn rounded(value: f32, syntax: &Syntax) -> f32 {
    if syntax.half { f16::from_f32(value).to_f32() } else { value }
}

/// How often each result is read by an output or by what is written.
fn use_counts(program: &Program, forms: &[Form]) -> Vec<u32> {
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
        match forms[i] {
            _ if counts[i] == 0 => {}
            Form::Constant(_) => {}
            Form::Power(base, _) => count(&[base], &mut counts),
            Form::Operation => count(instr.args(), &mut counts),
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
    forms: Vec<Form>,
    codes: Vec<Code>,
    statements: Vec<String>,
    /// The bits and the name of each infinity or NaN declared so far.
    non_finite: Vec<(u32, String)>,
}

impl Body<'_, '_> {
    fn instruction(&mut self, i: usize, count: u32) {
        let output =
            self.program.outputs.iter().position(|&output| output == Arg::Result(i as u16));
        let code = match self.forms[i] {
            _ if count == 0 => Code::name(String::new()),
            Form::Constant(value) => self.constant(value),
            Form::Power(base, count) => self.power(base, count),
            Form::Operation => {
                let instr = &self.program.instrs[i];
                self.expression((self.syntax.spelling)(instr.op()), instr.args())
            }
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
        let name = (self.syntax.written)(&name);
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

    fn power(&mut self, base: Arg, count: u32) -> Code {
        let template = self.syntax.power.expect("powers are formed where they can be written");
        let mut code = self.expression(power(template), &[base]);
        code.text = code.text.replace("{n}", &count.to_string());
        code
    }

    fn expression(&mut self, spelling: Spelling, args: &[Arg]) -> Code {
        let mut args: Vec<Code> = args.iter().map(|&arg| self.argument(arg)).collect();
        for (i, arg) in args.iter_mut().enumerate() {
            let places = pieces(spelling.template).0;
            let written = places.iter().filter(|(_, place)| place.argument == i).count();
            if written > 1 && arg.in_place {
                self.name(arg);
            }
        }
        let mut text = self.filled(&spelling, &args);
        while text.len() > self.syntax.width {
            let in_place = args.iter_mut().filter(|arg| arg.in_place);
            let Some(longest) = in_place.max_by_key(|arg| arg.text.len()) else { break };
            self.name(longest);
            text = self.filled(&spelling, &args);
        }
        Code { text, binding: spelling.binding, in_place: true }
    }

    /// Makes the expression a local.
    fn name(&mut self, code: &mut Code) {
        let name = self.naming.temporary();
        *code = self.declare(name, &code.text);
    }

    /// The template with the arguments in its places.
    fn filled(&self, spelling: &Spelling, args: &[Code]) -> String {
        let [open, close] = self.syntax.parentheses;
        let (places, rest) = pieces(spelling.template);
        let mut text = String::new();
        for (before, place) in places {
            text.push_str(before);
            let arg = &args[place.argument];
            if arg.binding >= place.least {
                text.push_str(&arg.text);
            } else {
                text.extend([open, &arg.text, close]);
            }
        }
        text + rest
    }

    fn argument(&mut self, arg: Arg) -> Code {
        match arg {
            Arg::Input(i) => {
                Code::name((self.syntax.written)(&self.signature.inputs[usize::from(i)]))
            }
            Arg::Const(i) => self.constant(self.program.consts[usize::from(i)]),
            Arg::Result(i) => self.codes[usize::from(i)].clone(),
        }
    }

    fn constant(&mut self, value: f32) -> Code {
        let value = rounded(value, self.syntax);
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
        let name = (self.syntax.written)(&name);
        self.non_finite.push((bits, name.clone()));
        Code::name(name)
    }
}
