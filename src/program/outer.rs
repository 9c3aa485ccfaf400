//! Functions around formulas.

use super::{Arg, Draft, Program};

/// Outputs as expressions over inputs and over values for which formulas are to be found: its holes.
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
    /// A program whose last inputs are the holes.
    ///
    /// # Panics
    /// If the program has fewer inputs than there are to be holes.
    pub fn new(program: Program, holes: usize) -> Outer {
        assert!(holes <= program.inputs, "a hole is an input of the outer form");
        Outer { program, holes }
    }

    /// How many formulas are to be found.
    pub fn holes(&self) -> usize {
        self.holes
    }

    /// The outputs that a child, which computes the holes from the inputs, becomes. The child's instructions and
    /// constants come first and keep their places.
    ///
    /// # Panics
    /// If the child has other numbers of inputs than the form or of outputs than it has holes.
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
