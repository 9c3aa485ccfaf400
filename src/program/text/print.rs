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
    printer.argument(program.outputs[0]).0
}

/// The shortest decimal that reads back as `value`.
pub fn format_constant(value: f32) -> String {
    let plain = format!("{value}");
    let scientific = format!("{value:e}");
    if scientific.len() + 2 < plain.len() { scientific } else { plain }
}

struct Printer<'a> {
    program: &'a Program,
    names: &'a Names,
    /// For each instruction, how a reader of its result writes it.
    texts: Vec<(String, Binding)>,
    statements: Vec<String>,
    temporaries: usize,
}

impl Printer<'_> {
    fn instruction(&mut self, i: usize, count: u32) {
        if count == 0 {
            self.texts.push((String::new(), Binding::Atom));
            return;
        }
        let (text, binding) = self.expression(i);
        let output =
            self.program.outputs.iter().position(|&output| output == Arg::Result(i as u16));
        let name = match output {
            Some(output) => Some(self.names.outputs[output].clone()),
            None if count > 1 => Some(self.temporary()),
            None => None,
        };
        match name {
            Some(name) => {
                self.statements.push(format!("{name} = {text}"));
                self.texts.push((name, Binding::Atom));
            }
            None => self.texts.push((text, binding)),
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
            let (text, _) = self.argument(arg);
            self.statements.push(format!("{} = {text}", self.names.outputs[o]));
        }
    }

    fn argument(&self, arg: Arg) -> (String, Binding) {
        match arg {
            Arg::Input(i) => (self.names.inputs[usize::from(i)].clone(), Binding::Atom),
            Arg::Const(i) => {
                let value = self.program.consts[usize::from(i)];
                let binding =
                    if value.is_sign_negative() { Binding::Negation } else { Binding::Atom };
                (format_constant(value), binding)
            }
            Arg::Result(i) => self.texts[usize::from(i)].clone(),
        }
    }

    /// The argument, in parentheses unless it binds at least as tightly as `least`.
    fn operand(&self, arg: Arg, least: Binding) -> String {
        let (text, binding) = self.argument(arg);
        if binding >= least { text } else { format!("({text})") }
    }

    fn expression(&self, i: usize) -> (String, Binding) {
        let instr = &self.program.instrs[i];
        let mut args = instr.args().to_vec();
        // `2*x` reads better than `x*2`, and means the same bits.
        if instr.op() == Op::Mul && matches!(args[1], Arg::Const(_)) {
            args.swap(0, 1);
        }
        let infix = |symbol: &str, own: Binding, right: Binding| {
            let left = self.operand(args[0], own);
            let right = self.operand(args[1], right);
            (format!("{left}{symbol}{right}"), own)
        };
        match instr.op() {
            Op::Add => infix(" + ", Binding::Sum, Binding::Product),
            Op::Sub => infix(" - ", Binding::Sum, Binding::Product),
            Op::Mul if args[0] == args[1] => {
                (format!("{}^2", self.operand(args[0], Binding::Atom)), Binding::Power)
            }
            Op::Mul => infix("*", Binding::Product, Binding::Negation),
            Op::Div => infix("/", Binding::Product, Binding::Negation),
            Op::Neg => {
                // A bare number after the sign would read as a negative constant.
                let text = match args[0] {
                    Arg::Const(_) => format!("({})", self.argument(args[0]).0),
                    _ => self.operand(args[0], Binding::Power),
                };
                (format!("-{text}"), Binding::Negation)
            }
            Op::Select => {
                let [a, b, x, y] = [0, 1, 2, 3].map(|k| self.argument(args[k]).0);
                (format!("select({a} < {b}, {x}, {y})"), Binding::Atom)
            }
            op => {
                let args: Vec<String> = args.iter().map(|&arg| self.argument(arg).0).collect();
                (format!("{op}({})", args.join(", ")), Binding::Atom)
            }
        }
    }
}
