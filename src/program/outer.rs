//! Outer forms: functions around formulas.

use super::{Arg, Draft, Program};

/// Outputs as expressions over inputs and over values for which formulas are sought: its holes.
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
    program: Program,
    holes: usize,
}

impl Outer {
    /// Makes an outer form of a program whose last inputs are the holes.
    ///
    /// # Panics
    /// If the program has fewer inputs than `holes`.
    pub fn new(program: Program, holes: usize) -> Outer {
        assert!(holes <= program.inputs, "a hole is an input of the outer form");
        Outer { program, holes }
    }

    /// Returns the number of holes, each to be filled by a formula.
    pub fn holes(&self) -> usize {
        self.holes
    }

    /// Returns the number of its constants, the last of what [`Outer::append`] returns.
    pub fn constants(&self) -> usize {
        self.program.consts.len()
    }

    /// Fills the holes with the outputs of a child, which reads the inputs. The child's
    /// instructions and constants come first and keep their indices.
    ///
    /// # Panics
    /// If the child's number of inputs is not the form's, or its number of outputs not that of
    /// holes.
    pub fn append(&self, child: &Draft) -> Draft {
        let (inputs, holes) = (child.inputs, child.outputs.len());
        assert_eq!((inputs + holes, holes), (self.program.inputs, self.holes), "what is filled in");
        let inputs = (0..inputs).map(|input| Arg::Input(input as u16));
        let arguments: Vec<Arg> = inputs.chain(child.outputs.iter().copied()).collect();
        let mut formula = child.clone();
        formula.outputs = formula.append(&self.program, &arguments);
        formula
    }
}
