//! The statements of a function, in one precision or two.

use super::naming::Naming;
use super::syntax::{Binding, Conversion, Spelling, Syntax, Written, WrittenHead, pieces, power};
use crate::eval::{Arithmetic, Half};
use crate::op::{MAX_ARITY, Op};
use crate::program::spelling::{filled, move_signs, negated_product};
use crate::program::{Arg, Program};
use half::f16;
use std::collections::HashMap;

/// Returns a statement for each output, and for each result that is read or written more than once,
/// or too long to stand where it is read.
pub(super) fn statements(
    syntaxes: Syntaxes,
    program: &Program,
    head: &WrittenHead,
    naming: &mut Naming,
) -> Vec<String> {
    let forms = forms(program, syntaxes);
    let counts = use_counts(program, &forms);
    let mut body = Body {
        syntaxes,
        program,
        head,
        naming,
        forms,
        codes: Vec::with_capacity(program.instrs.len()),
        statements: Vec::new(),
        non_finite: Vec::new(),
        converted: HashMap::new(),
    };
    for (i, &count) in counts.iter().enumerate() {
        body.instruction(i, count);
    }
    body.remaining_outputs();
    body.statements
}

/// The syntax of a function, and of those instructions that stay in single precision within a
/// function of halves.
#[derive(Clone, Copy)]
pub(super) struct Syntaxes<'a> {
    pub function: &'static Syntax,
    pub single: &'static Syntax,
    pub stay_single: &'a [usize],
}

impl Syntaxes<'_> {
    pub fn one(syntax: &'static Syntax) -> Syntaxes<'static> {
        Syntaxes { function: syntax, single: syntax, stay_single: &[] }
    }

    fn of_instruction(&self, i: usize) -> &'static Syntax {
        if self.stay_single.contains(&i) { self.single } else { self.function }
    }

    fn of_halves(&self, half: bool) -> &'static Syntax {
        if half == self.function.half { self.function } else { self.single }
    }
}

/// The form in which an instruction is written.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// The value of an instruction that depends on no input.
    Constant(f32),
    /// A value to an integer power.
    Power(Arg, u32),
    Operation,
}

fn forms(program: &Program, syntaxes: Syntaxes) -> Vec<Form> {
    let mut forms: Vec<Form> = Vec::with_capacity(program.instrs.len());
    for (i, instr) in program.instrs.iter().enumerate() {
        let syntax = syntaxes.of_instruction(i);
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

/// Rounds a constant to the language's precision.
fn rounded(value: f32, syntax: &Syntax) -> f32 {
    if syntax.half { f16::from_f32(value).to_f32() } else { value }
}

/// Counts how often each result is read, by an output or by what is written.
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

/// The text of a value, as its reader writes it.
#[derive(Clone)]
struct Code {
    written: Written,
    /// True for a whole expression, which could be given a name instead.
    in_place: bool,
    /// True if the value is a half.
    half: bool,
}

impl Code {
    fn name(text: String, syntax: &Syntax) -> Code {
        Code { written: Written::name(text), in_place: false, half: syntax.half }
    }

    /// Returns the negated value, if that takes a sign away.
    fn turned(&self) -> Option<Code> {
        Some(Code { written: self.written.turned()?, ..*self })
    }
}

struct Body<'a, 'n> {
    syntaxes: Syntaxes<'a>,
    program: &'a Program,
    head: &'a WrittenHead,
    naming: &'a mut Naming<'n>,
    forms: Vec<Form>,
    codes: Vec<Code>,
    statements: Vec<String>,
    /// Infinities and NaNs declared so far: bits, whether a half, and name.
    non_finite: Vec<(u32, bool, String)>,
    /// The locals that are values of the other precision, by those and by whether a half.
    converted: HashMap<(String, bool), String>,
}

impl Body<'_, '_> {
    fn instruction(&mut self, i: usize, count: u32) {
        let output =
            self.program.outputs.iter().position(|&output| output == Arg::Result(i as u16));
        let syntax = self.syntaxes.of_instruction(i);
        let mut code = match self.forms[i] {
            _ if count == 0 => Code::name(String::new(), syntax),
            Form::Constant(value) => self.constant(value, syntax),
            Form::Power(base, count) => self.power(base, count, syntax),
            Form::Operation => {
                let instr = &self.program.instrs[i];
                self.operation(instr.op(), instr.args(), syntax)
            }
        };
        let same = syntax.half == self.syntaxes.function.half;
        let by_pointer = self.syntaxes.function.out_by_pointer;
        let is_read = |output: &usize| count > 1 && by_pointer && self.head.is_parameter(*output);
        if let Some(output) = output.filter(|output| same && is_read(output)) {
            self.name(&mut code);
            let value = code.written.text.clone();
            self.output(output, &value, syntax);
        } else if let Some(output) = output.filter(|_| same) {
            code = self.output(output, &code.written.text, syntax);
        } else if count > 1 && code.in_place {
            self.name(&mut code);
        }
        if let Some(output) = output.filter(|_| !same) {
            let value = self.converted(code.clone(), self.syntaxes.function).written.text;
            self.output(output, &value, self.syntaxes.function);
        }
        self.codes.push(code);
    }

    /// Declares an output, or assigns it to its parameter.
    fn output(&mut self, output: usize, value: &str, syntax: &Syntax) -> Code {
        let name = self.head.outputs[output].clone();
        if !self.head.is_parameter(output) {
            return self.declare(name, value, syntax);
        }
        let sign = if self.syntaxes.function.out_by_pointer { "*" } else { "" };
        self.statements.push(format!("{sign}{name} = {value};"));
        Code::name(name, syntax)
    }

    fn declare(&mut self, name: String, value: &str, syntax: &Syntax) -> Code {
        let name = (syntax.written)(&name);
        self.statements.push((syntax.local)(syntax, &name, value));
        Code::name(name, syntax)
    }

    /// Writes the outputs that are inputs, constants, or another output's result.
    fn remaining_outputs(&mut self) {
        for (o, &arg) in self.program.outputs.iter().enumerate() {
            let first = self.program.outputs.iter().position(|&other| other == arg);
            if matches!(arg, Arg::Result(_)) && first == Some(o) {
                continue;
            }
            let syntax = self.syntaxes.function;
            let value = self.argument(arg, syntax).written.text;
            self.output(o, &value, syntax);
        }
    }

    fn power(&mut self, base: Arg, count: u32, syntax: &'static Syntax) -> Code {
        let template = syntax.power.expect("powers are formed where they can be written");
        let mut code = self.expression(power(template), &[base], syntax);
        code.written.text = code.written.text.replace("{#}", &count.to_string());
        code
    }

    fn operation(&mut self, op: Op, args: &[Arg], syntax: &'static Syntax) -> Code {
        if let (Op::Mad, Some(product)) = (op, self.known_product(args, syntax)) {
            let added = [self.constant(product, syntax), self.argument(args[2], syntax)];
            return self.written(Op::Add, added.to_vec(), syntax);
        }
        let args = args.iter().map(|&arg| self.argument(arg, syntax)).collect();
        self.written(op, args, syntax)
    }

    /// Returns the product of two numbers in a multiply-add that is written as a product and a sum:
    /// compilers would compute it in different precisions.
    fn known_product(&self, args: &[Arg], syntax: &Syntax) -> Option<f32> {
        if (syntax.spelling)(Op::Mad).binding == Binding::Atom {
            return None;
        }
        let known = |arg: Arg| match arg {
            Arg::Input(_) => None,
            Arg::Const(i) => Some(rounded(self.program.consts[usize::from(i)], syntax)),
            Arg::Result(i) => match self.forms[usize::from(i)] {
                Form::Constant(value) => Some(rounded(value, syntax)),
                _ => None,
            },
        };
        Some(rounded(known(args[0])? * known(args[1])?, syntax))
    }

    fn written(&mut self, op: Op, mut args: Vec<Code>, syntax: &'static Syntax) -> Code {
        if let (Op::Neg, Some(code)) = (op, args[0].turned()) {
            return code;
        }
        move_signs(op, &mut args, Code::turned);
        let mut code = self.expression_of((syntax.spelling)(op), &mut args, syntax);
        code.written.negated = match op {
            Op::Neg => Some((args[0].written.text.clone(), args[0].written.binding)),
            Op::Mul | Op::Div => {
                let Syntax { parentheses, signs, .. } = *self.syntaxes.function;
                negated_product(&(syntax.spelling)(op), &writings(&args), parentheses, signs)
            }
            _ => None,
        };
        code
    }

    fn expression(&mut self, spelling: Spelling, args: &[Arg], syntax: &'static Syntax) -> Code {
        let mut args: Vec<Code> = args.iter().map(|&arg| self.argument(arg, syntax)).collect();
        self.expression_of(spelling, &mut args, syntax)
    }

    /// Writes the instruction's expression; arguments may have become locals by now.
    fn expression_of(
        &mut self,
        spelling: Spelling,
        args: &mut [Code],
        syntax: &'static Syntax,
    ) -> Code {
        for (i, arg) in args.iter_mut().enumerate() {
            let places = pieces(spelling.template).0;
            let written = places.iter().filter(|(_, place)| place.argument == i).count();
            if written > 1 && arg.in_place {
                self.name(arg);
            }
        }
        let mut text = self.filled(&spelling, args);
        while text.len() > syntax.width {
            let in_place = args.iter_mut().filter(|arg| arg.in_place);
            let Some(longest) = in_place.max_by_key(|arg| arg.written.text.len()) else { break };
            self.name(longest);
            text = self.filled(&spelling, args);
        }
        let written = Written::new(text, spelling.binding);
        Code { written, in_place: true, half: syntax.half }
    }

    /// Turns the expression into a local.
    fn name(&mut self, code: &mut Code) {
        let name = self.naming.temporary();
        *code = self.declare(name, &code.written.text, self.syntaxes.of_halves(code.half));
    }

    /// Converts the value to its reader's precision.
    fn converted(&mut self, code: Code, to: &Syntax) -> Code {
        if code.half == to.half {
            return code;
        }
        if to.conversion == Conversion::Local {
            let mut code = code;
            // Numbers have the precision of what they meet, which need not be the operation's.
            if code.in_place {
                self.name(&mut code);
            }
            let key = (code.written.text, to.half);
            if let Some(name) = self.converted.get(&key) {
                return Code::name(name.clone(), to);
            }
            let name = self.naming.temporary();
            let code = self.declare(name.clone(), &key.0, to);
            self.converted.insert(key, name);
            return code;
        }
        let written = Written::name(format!("{}({})", to.constructor(1), code.written.text));
        Code { written, in_place: true, half: to.half }
    }

    fn filled(&self, spelling: &Spelling, args: &[Code]) -> String {
        let Syntax { parentheses, signs, .. } = *self.syntaxes.function;
        filled(spelling, &writings(args), parentheses, signs)
    }

    fn argument(&mut self, arg: Arg, to: &'static Syntax) -> Code {
        match arg {
            Arg::Input(i) => {
                let name = &self.head.inputs[usize::from(i)];
                let function = self.syntaxes.function;
                self.converted(Code::name((function.written)(name), function), to)
            }
            Arg::Const(i) => self.constant(self.program.consts[usize::from(i)], to),
            Arg::Result(i) => match self.forms[usize::from(i)] {
                Form::Constant(value) if self.codes[usize::from(i)].half != to.half => {
                    self.constant(value, to)
                }
                _ => self.converted(self.codes[usize::from(i)].clone(), to),
            },
        }
    }

    fn constant(&mut self, value: f32, syntax: &'static Syntax) -> Code {
        let value = rounded(value, syntax);
        if !value.is_finite() {
            return self.non_finite(value, syntax);
        }
        let written = Written::number(value, syntax.literal);
        Code { written, in_place: false, half: syntax.half }
    }

    fn non_finite(&mut self, value: f32, syntax: &'static Syntax) -> Code {
        let (value, name) = match value {
            _ if value.is_nan() => (f32::NAN, "not_a_number"),
            _ if value > 0.0 => (value, "infinity"),
            _ => (value, "minus_infinity"),
        };
        let bits = value.to_bits();
        let known =
            |(known, half, _): &&(u32, bool, String)| (*known, *half) == (bits, syntax.half);
        if let Some((.., name)) = self.non_finite.iter().find(known) {
            return Code::name(name.clone(), syntax);
        }
        let name = self.naming.fresh(name);
        let bits_name = self.naming.fresh(&format!("{name}_bits"));
        self.statements.extend((syntax.non_finite)(&name, &bits_name, bits));
        let name = (syntax.written)(&name);
        self.non_finite.push((bits, syntax.half, name.clone()));
        Code::name(name, syntax)
    }
}

fn writings(args: &[Code]) -> Vec<&Written> {
    args.iter().map(|arg| &arg.written).collect()
}
