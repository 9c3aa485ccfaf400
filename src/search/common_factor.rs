//! Differences without a common factor: `1 - x` in place of `2.48 - 2.48*x`.
//!
//! Near x = 1 the product's rounding is all that is left of the second, and a root makes it large;
//! the first is exact there. Elsewhere in the formula a constant takes the factor up.

use crate::op::Op;
use crate::program::{Arg, Draft};

/// Two constants count as one if they differ by less than this share. By hand: fits leave that much
/// where the errors are.
const SAME: f32 = 1e-3;

/// Returns the draft with the common factor left out of each sum or difference of a constant and
/// its product; none if there is none. Its other constants are to be fitted again.
pub(super) fn without_common_factors(draft: &Draft) -> Option<Draft> {
    let mut found = false;
    let new = draft.rewritten(|new, _, instr| match factored(new, instr.op(), instr.args()) {
        Some(Factored { op, args }) => {
            found = true;
            let one = new.constant(1.0);
            let args = args.map(|arg| arg.unwrap_or(one));
            new.push(op, &args)
        }
        None => new.push_instr(instr),
    });
    found.then_some(new)
}

/// A sum or difference of a value and 1, which is none.
struct Factored {
    op: Op,
    args: [Option<Arg>; 2],
}

fn factored(draft: &Draft, op: Op, args: &[Arg]) -> Option<Factored> {
    let number = |arg: Arg| match arg {
        Arg::Const(index) => Some(draft.consts[usize::from(index)]),
        Arg::Input(_) | Arg::Result(_) => None,
    };
    // The factor and the other one of a product.
    let product = |arg: Arg| match arg {
        Arg::Result(index) => {
            let instr = draft.instrs[usize::from(index)];
            let [a, b] = *instr.args() else { return None };
            let is_product = instr.op() == Op::Mul;
            number(a).map(|factor| (factor, b)).or(number(b).map(|f| (f, a))).filter(|_| is_product)
        }
        Arg::Input(_) | Arg::Const(_) => None,
    };
    // As `factor * x + number`.
    let (factor, x, number) = match (op, args) {
        (Op::Add, &[a, b]) => match (product(a), number(b), product(b), number(a)) {
            (Some((factor, x)), Some(number), ..) | (.., Some((factor, x)), Some(number)) => {
                (factor, x, number)
            }
            _ => return None,
        },
        (Op::Sub, &[a, b]) => match (product(a), number(b), product(b), number(a)) {
            (Some((factor, x)), Some(number), ..) => (factor, x, -number),
            (.., Some((factor, x)), Some(number)) => (-factor, x, number),
            _ => return None,
        },
        (Op::Mad, &[a, b, c]) => {
            let (factor, x) = number(a).map(|f| (f, b)).or(number(b).map(|f| (f, a)))?;
            (factor, x, number(c)?)
        }
        _ => return None,
    };
    let is_same = (factor.abs() - number.abs()).abs() < SAME * factor.abs();
    if !is_same || factor.abs() == 1.0 {
        return None;
    }
    Some(match (factor > 0.0, number > 0.0) {
        (true, true) => Factored { op: Op::Add, args: [Some(x), None] },
        (true, false) => Factored { op: Op::Sub, args: [Some(x), None] },
        (false, true) => Factored { op: Op::Sub, args: [None, Some(x)] },
        // −x − 1: the sign is no gain.
        (false, false) => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{Names, Program, effective, parse, print};

    #[test]
    fn common_factors_are_left_out() {
        let names = Names::new(["x"], ["y"]);
        for (text, left) in [
            ("y = sqrt(2.48 - 2.4801*x)*(0.5 + x)", Some("y = sqrt(1 - x)*(0.5 + x)")),
            ("y = mad(3, x, -3)*x", Some("y = (x - 1)*x")),
            ("y = 2*x + 2", Some("y = x + 1")),
            ("y = x*0.5 - 0.5", Some("y = x - 1")),
            ("y = 2.48 - 2.5*x", None),
            ("y = 1 - x", None),
            ("y = 2 - x", None),
        ] {
            let draft = parse(text, &names).unwrap().into_draft();
            let text = without_common_factors(&draft)
                .map(|draft| print(&effective(&Program::verify(draft).unwrap()), &names));
            assert_eq!(text.as_deref(), left);
        }
    }
}
