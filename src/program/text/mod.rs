//! Parses and prints formula text: `name = expression` statements.
//!
//! ```
//! use lgp::program::{Names, parse, print};
//! let names = Names::new(["n_dot_v", "roughness"], ["bias"]);
//! let program = parse("bias = exp2(-(7*n_dot_v + 4*roughness^2))", &names)?;
//! assert_eq!(print(&program, &names), "bias = exp2(-(7*n_dot_v + 4*roughness^2))");
//! # Ok::<(), lgp::program::ParseError>(())
//! ```

mod call;
mod claim;
mod definitions;
mod excerpt;
mod functions;
mod guess;
mod holes;
mod lex;
mod parse;
mod print;
mod statements;
mod syntax;

pub use claim::{ALWAYS_ASKED, Claim};
pub(crate) use excerpt::{place, plain, pointed};
pub(super) use guess::parse_guess;
pub(super) use holes::{Holes, OpenCall, OpenFunction};
pub(crate) use parse::parse_expression;
pub use parse::{
    FreeConstant, MAX_FORMULA, ParseError, Parsed, Scope, parse, parse_open, parse_template,
};
pub(super) use parse::{assigned_by, parse_with_holes};
pub use print::{format_constant, print, print_expression, shortest};

use serde::{Deserialize, Serialize};

/// The names of a program's inputs and outputs, in column order.
#[derive(Clone, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Names {
    /// The inputs' names.
    pub inputs: Vec<String>,
    /// The outputs' names.
    pub outputs: Vec<String>,
}

impl Names {
    /// Collects the names.
    pub fn new<S: Into<String>>(
        inputs: impl IntoIterator<Item = S>,
        outputs: impl IntoIterator<Item = S>,
    ) -> Names {
        Names {
            inputs: inputs.into_iter().map(Into::into).collect(),
            outputs: outputs.into_iter().map(Into::into).collect(),
        }
    }
}
