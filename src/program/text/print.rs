//! Prints programs as formula text.

use super::Names;
use crate::op::Op;
use crate::program::spelling::{
    Spelling, Written, atom, filled, move_signs, negated_product, negation, power, product, sum,
};
use crate::program::{Arg, Program, use_counts};

const PARENTHESES: [&str; 2] = ["(", ")"];
const SIGNS: [&str; 2] = [" + ", " - "];

/// The operators; any other operation is written as a function.
fn spelling(op: Op) -> Option<Spelling> {
    Some(match op {
        Op::Add => sum("{a+} + {b*}"),
        Op::Sub => sum("{a+} - {b*}"),
        Op::Mul => product("{a*}*{b-}"),
        Op::Div => product("{a*}/{b-}"),
        Op::Neg => negation("-{a^}"),
        Op::Select => atom("select({a} < {b}, {c}, {d})"),
        _ => return None,
    })
}

/// Prints a program's effective code: a statement for each shared result and each output, separated
/// by `; `. Parsing it gives a program with the same effective code, up to the order of independent
/// instructions.
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

/// Prints a program's first output as one expression, without temporaries: a shared result is
/// written out each time it is read, so the text can be exponentially longer than the program.
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

/// Returns the shortest decimal that reads back as `value`.
pub fn format_constant(value: f32) -> String {
    let plain = format!("{value}");
    let scientific = format!("{value:e}");
    if scientific.len() + 2 < plain.len() { scientific } else { plain }
}

/// Returns the shortest decimal that reads back as `value`: as an `f32` where it is one, else as an
/// `f64`.
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

struct Printer<'a> {
    program: &'a Program,
    names: &'a Names,
    /// For each instruction, the text that a reader of its result writes.
    texts: Vec<Written>,
    statements: Vec<String>,
    temporaries: usize,
}

impl Printer<'_> {
    fn instruction(&mut self, i: usize, count: u32) {
        if count == 0 {
            self.texts.push(Written::name(String::new()));
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
                self.texts.push(Written::name(name));
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

    /// Adds the outputs that are inputs, constants, or another output's result.
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

    fn argument(&self, arg: Arg) -> Written {
        match arg {
            Arg::Input(i) => Written::name(self.names.inputs[usize::from(i)].clone()),
            Arg::Const(i) => Written::number(self.program.consts[usize::from(i)], format_constant),
            Arg::Result(i) => self.texts[usize::from(i)].clone(),
        }
    }

    fn expression(&self, i: usize) -> Written {
        let instr = &self.program.instrs[i];
        let (op, is_constant) = (instr.op(), |arg: Arg| matches!(arg, Arg::Const(_)));
        let mut args: Vec<Written> = instr.args().iter().map(|&arg| self.argument(arg)).collect();
        match (op, instr.args()) {
            (Op::Mul, [a, b]) if a == b => return written(&power("{a!}^2"), &args),
            // `2*x` reads better than `x*2`, and has the same bits.
            (Op::Mul, &[_, b]) if is_constant(b) => args.swap(0, 1),
            // A bare number after the sign would read as a negative constant.
            (Op::Neg, &[a]) if is_constant(a) && args[0].negated.is_none() => {
                let negated = Some((args[0].text.clone(), args[0].binding));
                return Written { negated, ..written(&negation("-({a})"), &args) };
            }
            (Op::Neg, _) => {
                if let Some(value) = args[0].turned() {
                    return value;
                }
            }
            _ => {}
        }
        let Some(spelling) = spelling(op) else {
            let args: Vec<String> = args.into_iter().map(|arg| arg.text).collect();
            return Written::name(format!("{op}({})", args.join(", ")));
        };
        move_signs(op, &mut args, Written::turned);
        let references: Vec<&Written> = args.iter().collect();
        let negated = match op {
            Op::Neg => Some((args[0].text.clone(), args[0].binding)),
            Op::Mul | Op::Div => negated_product(&spelling, &references, PARENTHESES, SIGNS),
            _ => None,
        };
        Written { negated, ..written(&spelling, &args) }
    }
}

fn written(spelling: &Spelling, args: &[Written]) -> Written {
    let args: Vec<&Written> = args.iter().collect();
    Written::new(filled(spelling, &args, PARENTHESES, SIGNS), spelling.binding)
}
