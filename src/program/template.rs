//! Templates: formulas in which some functions and constants are to be found.

use super::outer::{Call, Step};
use super::shape::Reads;
use super::text::{Holes, OpenCall, OpenFunction, assigned_by, parse_guess, parse_with_holes};
use super::{
    Arg, Draft, Names, Outer, ParseError, Parsed, Program, Shape, effective, format_constant, print,
};

/// A formula in which functions that are called and nowhere defined, and constants written `$a`, are
/// to be found: its holes.
///
/// Holes that are called equally often, and whose arguments do not depend on each other's values,
/// are outputs of one draft over all their arguments, and share what they compute of those that are
/// the same in each call.
///
/// ```
/// use lgp::program::{Names, Program, Template, parse, print};
///
/// let names = Names::new(["x", "r"], ["y"]);
/// let template = Template::parse("D(t, a) = exp2(a*t); y = D(x^2, f(r)) + $a", &names)?;
/// assert_eq!(template.holes()[0].signature(), "f(r)");
/// let child = template.guess("f(r) = 2*r; $a = 0.5")?;
/// let formula = Program::verify(template.outer().append(&child))?;
/// assert_eq!(print(&formula, &names), "y = exp2(2*r*x^2) + 0.5");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Template {
    text: String,
    outer: Outer,
    holes: Vec<Hole>,
}

/// A function or constant to be found.
#[derive(Clone, Debug, PartialEq)]
pub struct Hole {
    /// Its name; that of a constant without the `$`.
    pub name: String,
    /// The names of its parameters; a constant has none.
    pub parameters: Vec<String>,
    /// The number of calls that differ in their arguments.
    pub calls: usize,
    /// The child's input that is each parameter.
    inputs: Vec<usize>,
    /// The child's outputs that are its values.
    outputs: std::ops::Range<usize>,
}

impl Hole {
    /// Returns true if it is a constant.
    pub fn is_constant(&self) -> bool {
        self.parameters.is_empty()
    }

    /// Returns the child's input that is each parameter.
    pub fn inputs(&self) -> &[usize] {
        &self.inputs
    }

    /// Returns the child's outputs that are its values.
    pub fn outputs(&self) -> std::ops::Range<usize> {
        self.outputs.clone()
    }

    /// Returns `f(x, y)`, or `$a`.
    pub fn signature(&self) -> String {
        match self.is_constant() {
            true => format!("${}", self.name),
            false => format!("{}({})", self.name, self.parameters.join(", ")),
        }
    }
}

impl Template {
    /// Parses a text that assigns every output.
    ///
    /// # Errors
    /// [`ParseError`]: what is no formula; nothing to be found, or something that no output depends
    /// on; a hole that is called with two numbers of arguments, or in an argument of itself; holes
    /// of too many arguments.
    pub fn parse(text: &str, names: &Names) -> Result<Template, ParseError> {
        let (Parsed { program, .. }, holes) = parse_with_holes(text, names)?;
        let groups = groups(&program, names.inputs.len(), &holes);
        let arguments: usize = groups.iter().map(|group| group.arguments.len()).sum();
        if arguments > Shape::MAX_INPUTS {
            let most = Shape::MAX_INPUTS;
            let message =
                format!("the holes have {arguments} arguments; at most {most} can differ");
            return Err(ParseError::at(text, 0, message));
        }
        Ok(assembled(text.trim(), program, names.inputs.len(), &holes, &groups))
    }

    /// Returns those of the outputs that a text assigns.
    ///
    /// # Errors
    /// What is no formula.
    pub fn assigned(text: &str, names: &Names) -> Result<Vec<String>, ParseError> {
        assigned_by(text, names)
    }

    /// Returns the text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the outer form, which a child of its shape fills in.
    pub fn outer(&self) -> &Outer {
        &self.outer
    }

    /// Returns what is to be found: functions, then constants.
    pub fn holes(&self) -> &[Hole] {
        &self.holes
    }

    /// Finds a hole by its name.
    pub fn hole(&self, name: &str) -> Option<&Hole> {
        self.holes.iter().find(|hole| hole.name == name.trim_start_matches('$'))
    }

    /// Parses a guess: definitions of functions, `f(x) = …`, and constants, `$a = 0.5`. Holes that it
    /// leaves out are their first parameters, or constants as they start.
    ///
    /// # Errors
    /// [`ParseError`]: what is neither, or is of no hole.
    pub fn guess(&self, text: &str) -> Result<Draft, ParseError> {
        let shape = self.outer.shape();
        let mut child = Draft { inputs: shape.inputs, ..Draft::default() };
        let mut values = vec![None; shape.outputs()];
        for (hole, program) in parse_guess(text, &self.holes)? {
            let inputs: Vec<Arg> = hole.inputs.iter().map(|&i| Arg::Input(i as u16)).collect();
            for (output, value) in hole.outputs().zip(child.append(&program, &inputs)) {
                values[output] = Some(value);
            }
        }
        for hole in &self.holes {
            for output in hole.outputs() {
                let usual = match (hole.inputs.first(), shape.reads()[output]) {
                    (Some(&first), _) => Arg::Input(first as u16),
                    (None, Reads::Constant(Some(start))) => child.constant(start),
                    (None, _) => child.constant(1.0),
                };
                child.outputs.push(values[output].unwrap_or(usual));
            }
        }
        Ok(child)
    }

    /// Writes down what fills the holes in, as [`Template::guess`] reads it.
    ///
    /// # Panics
    /// If the child is not of the form's shape.
    pub fn written(&self, child: &Program) -> Vec<String> {
        self.holes.iter().map(|hole| written(hole, child)).collect()
    }
}

fn written(hole: &Hole, child: &Program) -> String {
    if let (true, Arg::Const(i)) = (hole.is_constant(), child.outputs[hole.outputs.start]) {
        return format!("${} = {}", hole.name, format_constant(child.consts[usize::from(i)]));
    }
    let mut own = Draft::clone(child);
    own.outputs = child.outputs[hole.outputs()].to_vec();
    let own = effective(&Program::verify(own).expect("some of a program's outputs"));
    let mut inputs = vec!["_".to_owned(); child.inputs];
    for (&input, parameter) in hole.inputs.iter().zip(&hole.parameters) {
        inputs[input].clone_from(parameter);
    }
    let outputs = match hole.outputs.len() {
        1 => vec![hole.name.clone()],
        width => (1..=width).map(|place| format!("{}{place}", hole.name)).collect(),
    };
    let names = Names { inputs, outputs };
    let text = print(&own, &names);
    let alone = format!("{} = ", hole.name);
    let body = match text.rsplit_once("; ") {
        None if hole.outputs.len() == 1 => text[alone.len()..].to_owned(),
        Some((before, last)) if last.starts_with(&alone) => {
            format!("({before}; {})", &last[alone.len()..])
        }
        _ => format!("({text}; {})", vector(&names.outputs)),
    };
    format!("{} = {body}", hole.signature())
}

fn vector(names: &[String]) -> String {
    match names {
        [only] => only.clone(),
        several => format!("({})", several.join(", ")),
    }
}

/// Functions that one draft computes: their calls go together, call by call.
struct Group {
    functions: Vec<usize>,
    /// What each of its draft's inputs is, call by call.
    arguments: Vec<Vec<Arg>>,
    /// The level of each call.
    levels: Vec<usize>,
}

/// The levels of a program's values: 0 for those that depend on no hole, else one more than the
/// arguments of the deepest hole that they depend on.
struct Levels {
    columns: usize,
    results: Vec<usize>,
    slots: Vec<usize>,
}

impl Levels {
    fn new(program: &Program, columns: usize, holes: &Holes) -> Levels {
        let slots = vec![0; holes.slots()];
        let mut levels = Levels { columns, results: vec![0; program.instrs.len()], slots };
        // A call's arguments come before it, and its values before what reads them: so many passes
        // at most.
        for _ in 0..=holes.slots() {
            let before = levels.slots.clone();
            for (i, instr) in program.instrs.iter().enumerate() {
                levels.results[i] = levels.highest(instr.args());
            }
            for function in &holes.functions {
                for call in &function.calls {
                    let level = levels.highest(&call.args) + 1;
                    levels.slots[call.slot..call.slot + function.values].fill(level);
                }
            }
            if levels.slots == before {
                break;
            }
        }
        levels
    }

    fn highest(&self, args: &[Arg]) -> usize {
        let of = |arg: &Arg| match *arg {
            Arg::Const(_) => 0,
            Arg::Result(i) => self.results[usize::from(i)],
            Arg::Input(i) => {
                let slot = usize::from(i).checked_sub(self.columns);
                slot.map_or(0, |slot| self.slots[slot])
            }
        };
        args.iter().map(of).max().unwrap_or(0)
    }

    fn of_calls(&self, calls: &[OpenCall]) -> Vec<usize> {
        calls.iter().map(|call| self.highest(&call.args)).collect()
    }
}

fn groups(program: &Program, columns: usize, holes: &Holes) -> Vec<Group> {
    let levels = Levels::new(program, columns, holes);
    let mut groups: Vec<Group> = Vec::new();
    for (place, function) in holes.functions.iter().enumerate() {
        let own = levels.of_calls(&function.calls);
        match groups.iter_mut().find(|group| group.levels == own) {
            Some(group) => group.functions.push(place),
            None => {
                groups.push(Group { functions: vec![place], arguments: Vec::new(), levels: own });
            }
        }
    }
    for group in &mut groups {
        for &place in &group.functions {
            for argument in by_parameter(&holes.functions[place]) {
                if !group.arguments.contains(&argument) {
                    group.arguments.push(argument);
                }
            }
        }
    }
    groups
}

/// Returns what each parameter of a function is, call by call.
fn by_parameter(function: &OpenFunction) -> impl Iterator<Item = Vec<Arg>> {
    let parameters = 0..function.parameters.len();
    parameters.map(|place| function.calls.iter().map(|call| call.args[place]).collect())
}

fn assembled(
    text: &str,
    program: Program,
    columns: usize,
    open: &Holes,
    groups: &[Group],
) -> Template {
    let inputs: usize = groups.iter().map(|group| group.arguments.len()).sum();
    let (mut reads, mut holes, mut calls, mut levels) = (vec![], vec![], vec![], vec![]);
    let mut first_input = 0;
    for group in groups {
        let first_call = calls.len();
        for (call, &level) in group.levels.iter().enumerate() {
            let mut arguments = vec![Arg::Input(0); inputs];
            for (place, argument) in group.arguments.iter().enumerate() {
                arguments[first_input + place] = argument[call];
            }
            calls.push(Call { arguments, values: Vec::new() });
            levels.push(level);
        }
        for function in group.functions.iter().map(|&place| &open.functions[place]) {
            let known = |argument: Vec<Arg>| {
                let place = group.arguments.iter().position(|known| *known == argument);
                first_input + place.expect("it was collected")
            };
            let own: Vec<usize> = by_parameter(function).map(known).collect();
            let first = reads.len();
            let may_read = own.iter().fold(0, |all, input| all | 1 << input);
            reads.resize(first + function.values, Reads::Only(may_read));
            for (call, of) in function.calls.iter().enumerate() {
                let values = (0..function.values).map(|value| (first + value, of.slot + value));
                calls[first_call + call].values.extend(values);
            }
            holes.push(Hole {
                name: function.name.clone(),
                parameters: parameter_names(&function.parameters),
                calls: function.calls.len(),
                inputs: own,
                outputs: first..first + function.values,
            });
        }
        first_input += group.arguments.len();
    }
    // In the order of the text, for whoever reads about them.
    holes.sort_by_key(|hole| open.functions.iter().position(|known| known.name == hole.name));
    let mut constants = Vec::new();
    for constant in &open.constants {
        let output = reads.len();
        reads.push(Reads::Constant(constant.start));
        constants.push((output, constant.slot));
        let (name, outputs) = (constant.name.clone(), output..output + 1);
        let (parameters, inputs) = (Vec::new(), Vec::new());
        holes.push(Hole { name, parameters, calls: 1, inputs, outputs });
    }
    let steps = in_order(&program, columns, open, &levels);
    let outer = Outer::of_calls(program, Shape::new(inputs, reads), calls, constants, steps);
    Template { text: text.to_owned(), outer, holes }
}

/// Returns the instructions and calls, each after what it reads: level by level.
fn in_order(program: &Program, columns: usize, open: &Holes, calls: &[usize]) -> Vec<Step> {
    let levels = Levels::new(program, columns, open);
    let deepest = calls.iter().chain(&levels.results).max().copied().unwrap_or(0);
    let mut steps = Vec::new();
    for level in 0..=deepest {
        let instrs = (0..program.instrs.len()).filter(|&i| levels.results[i] == level);
        steps.extend(instrs.map(Step::Instruction));
        let now = (0..calls.len()).filter(|&call| calls[call] == level);
        steps.extend(now.map(Step::Call));
    }
    steps
}

/// Returns the names of parameters, with letters for those that have none.
fn parameter_names(known: &[Option<String>]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for (place, name) in known.iter().enumerate() {
        let is_taken =
            |name: &String| names.contains(name) || known.iter().flatten().any(|one| one == name);
        let name = match name {
            Some(name) if !names.contains(name) => name.clone(),
            _ => {
                let letters = ["x", "y", "z", "u", "v", "w"].map(str::to_owned).into_iter();
                let mut numbered = (place..).map(|number| format!("x{number}"));
                let free = letters.clone().find(|letter| !is_taken(letter));
                free.or_else(|| numbered.find(|name| !is_taken(name))).expect("numbers do not end")
            }
        };
        names.push(name);
    }
    names
}
