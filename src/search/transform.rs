//! Outputs searched for through a function of them: where `1/y` or `log2 y` is the simpler surface
//! (Pesce & Iwanicki 2015, §4.3). The formula ends in the inverse, whose cost it pays, and its error is
//! measured on `y` all the same.

use crate::op::Op;
use crate::program::{Arg, Draft};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The function of an output that a search looks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Transform {
    /// `1/y`: the formula ends in a reciprocal or a quotient.
    Rcp,
    /// `log2 y`: the formula ends in `exp2`.
    Log2,
    /// `sqrt y`: the formula ends in a square.
    Sqrt,
}

impl FromStr for Transform {
    type Err = String;

    fn from_str(text: &str) -> Result<Transform, String> {
        match text {
            "rcp" => Ok(Transform::Rcp),
            "log2" => Ok(Transform::Log2),
            "sqrt" => Ok(Transform::Sqrt),
            _ => Err(format!("`{text}`: a transform is rcp, log2 or sqrt")),
        }
    }
}

impl fmt::Display for Transform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Transform::Rcp => "rcp",
            Transform::Log2 => "log2",
            Transform::Sqrt => "sqrt",
        })
    }
}

impl Transform {
    /// Whether an output ends in the transform's inverse, or is a constant.
    pub fn is_undone(self, draft: &Draft, output: usize) -> bool {
        let last = match draft.outputs[output] {
            Arg::Const(_) => return true,
            Arg::Input(_) => return false,
            Arg::Result(i) => draft.instrs[usize::from(i)],
        };
        match self {
            Transform::Rcp => matches!(last.op(), Op::Rcp | Op::Div),
            Transform::Log2 => last.op() == Op::Exp2,
            Transform::Sqrt => last.op() == Op::Mul && last.args()[0] == last.args()[1],
        }
    }

    /// Ends an output in the transform's inverse, unless it does already.
    pub fn undo(self, draft: &mut Draft, output: usize) {
        if self.is_undone(draft, output) {
            return;
        }
        let value = draft.outputs[output];
        draft.outputs[output] = match self {
            Transform::Rcp => draft.push(Op::Rcp, &[value]),
            Transform::Log2 => draft.push(Op::Exp2, &[value]),
            Transform::Sqrt => draft.push(Op::Mul, &[value, value]),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{Names, Program, parse, print};

    #[test]
    fn an_output_ends_in_the_inverse_once() {
        let names = Names::new(["x"], ["y"]);
        for (transform, wrapped) in [
            (Transform::Rcp, "y = rcp(x + 1)"),
            (Transform::Log2, "y = exp2(x + 1)"),
            (Transform::Sqrt, "t0 = x + 1; y = t0^2"),
        ] {
            let mut draft = parse("y = x + 1", &names).unwrap().into_draft();
            transform.undo(&mut draft, 0);
            transform.undo(&mut draft, 0);
            assert_eq!(print(&Program::verify(draft).unwrap(), &names), wrapped);
        }
    }
}
