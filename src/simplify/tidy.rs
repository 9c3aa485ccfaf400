//! Brings a formula to the form in which it is shown: the same bits, fewer signs.

use crate::op::Op;
use crate::program::{Arg, Draft, Instr, Program};

/// Writes sums with negative constants, or with products and quotients of them, as differences, and
/// vice versa: `x + −c` as `x − c`, `−c·x + y` as `y − c·x`, `y − −c/x` as `y + c/x`. Signs are
/// exact in IEEE-754, so every value keeps its bits.
pub fn tidy(program: &Program) -> Program {
    let mut draft = program.clone().into_draft();
    for i in 0..draft.instrs.len() {
        let args = draft.instrs[i].args().to_vec();
        let rewritten = match draft.instrs[i].op() {
            Op::Add => positive(&mut draft, args[1], i)
                .map(|b| (Op::Sub, [args[0], b]))
                .or_else(|| positive(&mut draft, args[0], i).map(|a| (Op::Sub, [args[1], a]))),
            Op::Sub => positive(&mut draft, args[1], i).map(|b| (Op::Add, [args[0], b])),
            _ => None,
        };
        if let Some((op, args)) = rewritten {
            draft.instrs[i] = Instr::new(op, &args);
        }
    }
    program.or_longer(draft)
}

/// Negates `arg`, if it is a negative constant, or a product or quotient of one that only
/// instruction `reader` reads; the product is changed in place.
fn positive(draft: &mut Draft, arg: Arg, reader: usize) -> Option<Arg> {
    match arg {
        Arg::Input(_) => None,
        Arg::Const(c) => {
            let value = draft.consts[usize::from(c)];
            value.is_sign_negative().then(|| draft.constant(-value))
        }
        Arg::Result(i) => {
            let product = draft.instrs[usize::from(i)];
            if !matches!(product.op(), Op::Mul | Op::Div) || !is_read_once(draft, arg, reader) {
                return None;
            }
            let place = product.args().iter().position(|a| matches!(a, Arg::Const(_)))?;
            let constant = positive(draft, product.args()[place], reader)?;
            draft.instrs[usize::from(i)].args_mut()[place] = constant;
            Some(arg)
        }
    }
}

fn is_read_once(draft: &Draft, arg: Arg, reader: usize) -> bool {
    let reads = |i: usize| draft.instrs[i].args().iter().filter(|&&a| a == arg).count();
    let elsewhere = (0..draft.instrs.len()).filter(|&i| i != reader && reads(i) > 0).count();
    reads(reader) == 1 && elsewhere == 0 && !draft.outputs.contains(&arg)
}
