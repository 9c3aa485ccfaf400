//! A program to formula text.

use super::Names;
use crate::op::Op;
use crate::program::{Arg, Program, use_counts};

/// How tightly a piece of text binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Negation,
    Power,
    Atom,
}

/// The formula of a program's effective code: a statement for each shared result and each
/// output, separated by `; `. Parsing it gives a program with the same effective code, up to
/// the order of independent instructions.
///
/// # Panics
/// If `names` does not have a name for each input and output.
pub fn print(program: &Program, names: &Names) -> String {
    assert_eq!(names.inputs.len(), program.inputs, "a name for each input");
    assert_eq!(names.outputs.len(), program.outputs.len(), "a name for each output");
    let mut counts = Vec::new();
    use_counts(program, &mut counts);
    let mut printer = Printer {
        program,
        names,
        texts: Vec::with_capacity(program.instrs.len()),
        statements: Vec::new(),
        temporaries: 0,
    };
    for (i, &count) in counts.iter().enumerate() {
        printer.instruction(i, count);
    }
    printer.remaining_outputs();
    printer.statements.join("; ")
}

/// The expression of a program's first output, without temporaries: what is shared is written out
/// as often as it is read, so the text can be exponentially longer than the program.
///
/// # Panics
/// If `names` does not have a name for each input.
pub fn print_expression(program: &Program, names: &Names) -> String {
    assert_eq!(names.inputs.len(), program.inputs, "a name for each input");
    let mut printer = Printer {
        program,
        names,
        texts: Vec::with_capacity(program.instrs.len()),
        statements: Vec::new(),
        temporaries: 0,
    };
    for i in 0..program.instrs.len() {
        let text = printer.expression(i);
        printer.texts.push(text);
    }
    printer.argument(program.outputs[0]).text
}

/// The shortest decimal that reads back as `value`.
pub fn format_constant(value: f32) -> String {
    let plain = format!("{value}");
    let scientific = format!("{value:e}");
    if scientific.len() + 2 < plain.len() { scientific } else { plain }
}

/// The shortest decimal that reads back as `value`: as an `f32` where it is one, else as an `f64`.
///
/// ```
/// use lgp::program::shortest;
/// assert_eq!(shortest(f64::from(0.1f32)), "0.1");
/// assert_eq!(shortest(0.1), "0.1");
/// assert_eq!(shortest(1e30), "1e30");
/// ```
pub fn shortest(value: f64) -> String {
    let narrow = value as f32;
    if f64::from(narrow) == value {
        return format_constant(narrow);
    }
    let (plain, scientific) = (format!("{value}"), format!("{value:e}"));
    if scientific.len() + 2 < plain.len() { scientific } else { plain }
}

/// How a reader of a value writes it.
#[derive(Clone)]
struct Text {
    text: String,
    binding: Binding,
    /// The negated value, where that takes a sign away.
    negated: Option<(String, Binding)>,
}

impl Text {
    fn plain(text: String, binding: Binding) -> Text {
        Text { text, binding, negated: None }
    }

    fn turned(&self) -> Option<Text> {
        let (text, binding) = self.negated.clone()?;
        Some(Text::plain(text, binding))
    }

    /// In parentheses unless it binds at least as tightly as `least`.
    fn operand(&self, least: Binding) -> String {
        if self.binding >= least { self.text.clone() } else { format!("({})", self.text) }
    }
}

struct Printer<'a> {
    program: &'a Program,
    names: &'a Names,
    /// For each instruction, how a reader of its result writes it.
    texts: Vec<Text>,
    statements: Vec<String>,
    temporaries: usize,
}

impl Printer<'_> {
    fn instruction(&mut self, i: usize, count: u32) {
        if count == 0 {
            self.texts.push(Text::plain(String::new(), Binding::Atom));
            return;
        }
        let text = self.expression(i);
        let output =
            self.program.outputs.iter().position(|&output| output == Arg::Result(i as u16));
        let name = match output {
            Some(output) => Some(self.names.outputs[output].clone()),
            None if count > 1 => Some(self.temporary()),
            None => None,
        };
        match name {
            Some(name) => {
                self.statements.push(format!("{name} = {}", text.text));
                self.texts.push(Text::plain(name, Binding::Atom));
            }
            None => self.texts.push(text),
        }
    }

    fn temporary(&mut self) -> String {
        loop {
            let name = format!("t{}", self.temporaries);
            self.temporaries += 1;
            if !self.names.inputs.contains(&name) && !self.names.outputs.contains(&name) {
                return name;
            }
        }
    }

    /// Outputs that are inputs, constants, or another output's result.
    fn remaining_outputs(&mut self) {
        for (o, &arg) in self.program.outputs.iter().enumerate() {
            let first = self.program.outputs.iter().position(|&other| other == arg);
            if matches!(arg, Arg::Result(_)) && first == Some(o) {
                continue;
            }
            let text = self.argument(arg).text;
            self.statements.push(format!("{} = {text}", self.names.outputs[o]));
        }
    }

    fn argument(&self, arg: Arg) -> Text {
        match arg {
            Arg::Input(i) => Text::plain(self.names.inputs[usize::from(i)].clone(), Binding::Atom),
            Arg::Const(i) => {
                let value = self.program.consts[usize::from(i)];
                let text = Text::plain(format_constant(value), Binding::Atom);
                if !value.is_sign_negative() {
                    return text;
                }
                let negated = Some((format_constant(-value), Binding::Atom));
                Text { binding: Binding::Negation, negated, ..text }
            }
            Arg::Result(i) => self.texts[usize::from(i)].clone(),
        }
    }

    /// Signs stand where there are fewest of them. That is exact: a rounded result is that of the
    /// negated arguments, negated, and a sum is the difference from the negated term.
    fn expression(&self, i: usize) -> Text {
        let instr = &self.program.instrs[i];
        let mut args: Vec<Text> = instr.args().iter().map(|&arg| self.argument(arg)).collect();
        let turned: Vec<Option<Text>> = args.iter().map(Text::turned).collect();
        match (instr.op(), instr.args(), turned.as_slice()) {
            (Op::Add | Op::Sub, _, [_, _]) => sum(instr.op(), args),
            (Op::Mul, &[a, b], _) if a == b => {
                Text::plain(format!("{}^2", args[0].operand(Binding::Atom)), Binding::Power)
            }
            (Op::Mul | Op::Div, &[_, b], _) => {
                // `2*x` reads better than `x*2`, and means the same bits.
                if instr.op() == Op::Mul && matches!(b, Arg::Const(_)) {
                    args.swap(0, 1);
                }
                quotient_or_product(instr.op(), args)
            }
            (Op::Neg, _, [Some(value)]) => value.clone(),
            (Op::Neg, &[arg], _) => {
                // A bare number after the sign would read as a negative constant.
                let value = &args[0];
                let text = match arg {
                    Arg::Const(_) => format!("({})", value.text),
                    _ => value.operand(Binding::Power),
                };
                let negated = Some((value.text.clone(), value.binding));
                Text { text: format!("-{text}"), binding: Binding::Negation, negated }
            }
            (Op::Select, ..) => {
                let [a, b, x, y] = [0, 1, 2, 3].map(|k| &args[k].text);
                Text::plain(format!("select({a} < {b}, {x}, {y})"), Binding::Atom)
            }
            (op, ..) => {
                let args: Vec<String> = args.into_iter().map(|arg| arg.text).collect();
                Text::plain(format!("{op}({})", args.join(", ")), Binding::Atom)
            }
        }
    }
}

fn sum(op: Op, mut args: Vec<Text>) -> Text {
    match (op, args[0].turned(), args[1].turned()) {
        (Op::Add, Some(_), None) => args.swap(0, 1),
        (Op::Sub, Some(a), Some(b)) => args = vec![b, a],
        _ => {}
    }
    let turned = args[1].turned();
    let plus = (op == Op::Add) ^ turned.is_some();
    let left = args[0].operand(Binding::Sum);
    let right = turned.as_ref().unwrap_or(&args[1]).operand(Binding::Product);
    let sign = if plus { "+" } else { "-" };
    Text::plain(format!("{left} {sign} {right}"), Binding::Sum)
}

fn quotient_or_product(op: Op, mut args: Vec<Text>) -> Text {
    let symbol = if op == Op::Mul { "*" } else { "/" };
    let written = |args: &[Text]| {
        let left = args[0].operand(Binding::Product);
        format!("{left}{symbol}{}", args[1].operand(Binding::Negation))
    };
    if let [Some(a), Some(b)] = [args[0].turned(), args[1].turned()] {
        return Text::plain(written(&[a, b]), Binding::Product);
    }
    let text = written(&args);
    let first = args.iter().position(|arg| arg.negated.is_some());
    let negated = first.and_then(|i| {
        args[i] = args[i].turned()?;
        Some((written(&args), Binding::Product))
    });
    Text { text, binding: Binding::Product, negated }
}
