//! Outer forms: functions around formulas.

use super::{Arg, Draft, Program, Shape, use_counts};

/// Outputs as expressions over inputs and over values for which formulas are sought: its holes.
///
/// A child fills it in: a draft whose outputs are the formulas. It may be called several times, over
/// other arguments each time; each call has slots for its values, which are further inputs of the
/// form's program.
///
/// ```
/// use lgp::program::{Draft, Names, Outer, Program, parse, print};
///
/// let outer = Outer::new(parse("y = rcp(hole)", &Names::new(["x", "hole"], ["y"]))?, 1);
/// let child = parse("hole = x + 1", &Names::new(["x"], ["hole"]))?;
/// let formula = Program::verify(outer.append(&child))?;
/// assert_eq!(print(&formula, &Names::new(["x"], ["y"])), "y = rcp(x + 1)");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Outer {
    /// Its inputs are the formula's, then the slots.
    program: Program,
    inputs: usize,
    shape: Shape,
    calls: Vec<Call>,
    /// The outputs of a child that are constants, each with its slot.
    constants: Vec<(usize, usize)>,
    /// The order in which a formula is put together.
    steps: Vec<Step>,
}

/// A call of a child: its values over some arguments.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Call {
    /// What each of the child's inputs is there; those that the values do not depend on are not
    /// read.
    pub arguments: Vec<Arg>,
    /// The child's outputs that are asked for, each with its slot.
    pub values: Vec<(usize, usize)>,
}

/// A step in which a formula is put together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Step {
    /// The program's instruction of this index.
    Instruction(usize),
    /// The call of this index.
    Call(usize),
}

impl Outer {
    /// Makes an outer form of a program whose last inputs are the holes.
    ///
    /// # Panics
    /// If the program has fewer inputs than `holes`.
    pub fn new(program: Program, holes: usize) -> Outer {
        assert!(holes <= program.inputs, "a hole is an input of the outer form");
        let inputs = program.inputs - holes;
        let call = Call {
            arguments: (0..inputs).map(|input| Arg::Input(input as u16)).collect(),
            values: (0..holes).map(|hole| (hole, hole)).collect(),
        };
        let instructions = (0..program.instrs.len()).map(Step::Instruction);
        let steps = [Step::Call(0)].into_iter().chain(instructions).collect();
        let shape = Shape::open(inputs, holes);
        Outer { program, inputs, shape, calls: vec![call], constants: Vec::new(), steps }
    }

    /// Makes an outer form whose steps have been put in order.
    pub(super) fn of_calls(
        program: Program,
        shape: Shape,
        calls: Vec<Call>,
        constants: Vec<(usize, usize)>,
        steps: Vec<Step>,
    ) -> Outer {
        let slots = calls.iter().map(|call| call.values.len()).sum::<usize>() + constants.len();
        let inputs = program.inputs - slots;
        Outer { program, inputs, shape, calls, constants, steps }
    }

    /// Returns the shape of a child.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Returns the number of a child's outputs, each to be filled by a formula or a constant.
    pub fn holes(&self) -> usize {
        self.shape.outputs()
    }

    /// Returns the number of its constants, the last of what [`Outer::append`] returns.
    pub fn constants(&self) -> usize {
        self.program.consts.len()
    }

    /// Fills the holes with the outputs of a child. The child's constants come first and keep their
    /// indices, however often it is called.
    ///
    /// # Panics
    /// If the child is not of the form's shape.
    pub fn append(&self, child: &Draft) -> Draft {
        let (mut formula, filled) = self.filled(child);
        let first = child.consts.len() as u16;
        formula.outputs =
            self.program.outputs.iter().map(|&arg| self.moved(arg, &filled, first)).collect();
        formula
    }

    /// As [`Outer::append`], but the outputs are the values of one of the child's in each call.
    pub fn values_of(&self, output: usize, child: &Draft) -> Draft {
        let (mut formula, filled) = self.filled(child);
        let values = self.calls.iter().flat_map(|call| &call.values);
        let of = values.filter(|(of, _)| *of == output).map(|(_, slot)| filled.slots[*slot]);
        formula.outputs = of.collect();
        formula
    }

    /// Returns the form that is nothing but its calls, each over arguments of its own: what a child
    /// costs by itself.
    pub fn calls_alone(&self) -> Outer {
        let mut draft = Draft::default();
        let mut calls = self.calls.clone();
        let mut next = 0;
        for argument in calls.iter_mut().flat_map(|call| &mut call.arguments) {
            *argument = Arg::Input(next);
            next += 1;
        }
        let slots = self.program.inputs - self.inputs;
        draft.inputs = usize::from(next) + slots;
        draft.outputs = (0..slots).map(|slot| Arg::Input(next + slot as u16)).collect();
        let steps = (0..calls.len()).map(Step::Call).collect();
        let program = Program::verify(draft).expect("slots are inputs");
        Outer::of_calls(program, self.shape.clone(), calls, self.constants.clone(), steps)
    }

    /// Returns a formula without outputs, and where the program's values are in it.
    fn filled(&self, child: &Draft) -> (Draft, Filled) {
        let (inputs, holes) = (child.inputs, child.outputs.len());
        let wanted = (self.shape.inputs, self.shape.outputs());
        assert_eq!((inputs, holes), wanted, "what is filled in");
        let mut formula = Draft {
            inputs: self.inputs,
            consts: [&child.consts[..], &self.program.consts].concat(),
            instrs: Vec::with_capacity(
                self.calls.len() * child.instrs.len() + self.program.instrs.len(),
            ),
            outputs: Vec::new(),
        };
        let nothing = Arg::Input(0);
        let mut filled = Filled {
            slots: vec![nothing; self.program.inputs - self.inputs],
            results: vec![nothing; self.program.instrs.len()],
        };
        for &(output, slot) in &self.constants {
            filled.slots[slot] = child.outputs[output];
        }
        let first = child.consts.len() as u16;
        let mut callee = Callee::default();
        for &step in &self.steps {
            match step {
                Step::Instruction(i) => {
                    let mut instr = self.program.instrs[i];
                    let args = instr.args_mut().iter_mut();
                    args.for_each(|arg| *arg = self.moved(*arg, &filled, first));
                    filled.results[i] = formula.push_instr(instr);
                }
                Step::Call(i) => {
                    let call = &self.calls[i];
                    let arguments = call.arguments.iter();
                    let arguments: Vec<Arg> =
                        arguments.map(|&arg| self.moved(arg, &filled, first)).collect();
                    callee.only(child, &call.values);
                    callee.write(child, &arguments, &mut formula);
                    for &(output, slot) in &call.values {
                        filled.slots[slot] = callee.moved(child.outputs[output], &arguments);
                    }
                }
            }
        }
        (formula, filled)
    }

    /// Returns what an argument of the program is in a formula whose own constants end at `first`.
    fn moved(&self, arg: Arg, filled: &Filled, first: u16) -> Arg {
        match arg {
            Arg::Const(i) => Arg::Const(i + first),
            Arg::Result(i) => filled.results[usize::from(i)],
            Arg::Input(i) => match usize::from(i).checked_sub(self.inputs) {
                Some(slot) => filled.slots[slot],
                None => arg,
            },
        }
    }
}

/// Where the program's values are in a formula.
struct Filled {
    slots: Vec<Arg>,
    results: Vec<Arg>,
}

/// A child while it is written into a formula.
#[derive(Default)]
struct Callee {
    counts: Vec<u32>,
    wanted: Draft,
    results: Vec<Arg>,
}

impl Callee {
    /// Finds the instructions on which some outputs depend.
    fn only(&mut self, child: &Draft, values: &[(usize, usize)]) {
        self.wanted.outputs.clear();
        self.wanted.outputs.extend(values.iter().map(|(output, _)| child.outputs[*output]));
        self.wanted.instrs.clone_from(&child.instrs);
        use_counts(&self.wanted, &mut self.counts);
    }

    fn write(&mut self, child: &Draft, arguments: &[Arg], formula: &mut Draft) {
        self.results.clear();
        for (&instr, &count) in child.instrs.iter().zip(&self.counts) {
            let mut instr = instr;
            let result = match count {
                0 => Arg::Input(0),
                _ => {
                    let args = instr.args_mut().iter_mut();
                    args.for_each(|arg| *arg = self.moved(*arg, arguments));
                    formula.push_instr(instr)
                }
            };
            self.results.push(result);
        }
    }

    fn moved(&self, arg: Arg, arguments: &[Arg]) -> Arg {
        match arg {
            Arg::Input(i) => arguments[usize::from(i)],
            Arg::Result(i) => self.results[usize::from(i)],
            Arg::Const(_) => arg,
        }
    }
}
