//! Outputs that read what they must not are made to read what they may.

use super::draw::random_constant;
use crate::program::{Arg, Draft, Reads, Shape, use_counts};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Gives each output of a draft that reads what its shape forbids code of its own, in which other
/// inputs or constants stand for what it must not read. Draws nothing if no output does.
pub(super) fn repair(rng: &mut ChaCha8Rng, draft: &mut Draft, shape: &Shape) {
    while let Some(output) = shape.violation(draft) {
        let mut instead: Vec<Option<Arg>> = vec![None; shape.inputs];
        let mut replaced = |draft: &mut Draft, arg: Arg| match arg {
            Arg::Input(i) if !shape.may_read(output, usize::from(i)) => {
                let place = &mut instead[usize::from(i)];
                *place.get_or_insert_with(|| allowed(rng, draft, shape, output))
            }
            _ => arg,
        };
        if matches!(shape.reads()[output], Reads::Constant(_)) {
            draft.outputs[output] = draft.constant(random_constant(rng));
            continue;
        }
        let wanted = Draft { outputs: vec![draft.outputs[output]], ..draft.clone() };
        let mut counts = Vec::new();
        use_counts(&wanted, &mut counts);
        let mut moved: Vec<Arg> = (0..wanted.instrs.len()).map(|i| Arg::Result(i as u16)).collect();
        for (i, &instr) in wanted.instrs.iter().enumerate().filter(|(i, _)| counts[*i] > 0) {
            let mut instr = instr;
            for arg in instr.args_mut() {
                *arg = match *arg {
                    Arg::Result(j) => moved[usize::from(j)],
                    other => replaced(draft, other),
                };
            }
            moved[i] = draft.push_instr(instr);
        }
        draft.outputs[output] = match wanted.outputs[0] {
            Arg::Result(i) => moved[usize::from(i)],
            other => replaced(draft, other),
        };
    }
}

/// Returns an input that the output may read; a new constant if there is none.
fn allowed(rng: &mut ChaCha8Rng, draft: &mut Draft, shape: &Shape, output: usize) -> Arg {
    let may: Vec<usize> = (0..shape.inputs).filter(|&i| shape.may_read(output, i)).collect();
    match may.is_empty() {
        true => draft.constant(random_constant(rng)),
        false => Arg::Input(may[rng.random_range(0..may.len())] as u16),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::op::Op;
    use rand::SeedableRng;

    #[test]
    fn what_is_shared_stays_where_it_may_be_read() {
        let shape =
            Shape::new(2, vec![Reads::Only(0b11), Reads::Only(0b10), Reads::Constant(None)]);
        let mut draft = Draft { inputs: 2, ..Draft::default() };
        let sum = draft.push(Op::Add, &[Arg::Input(0), Arg::Input(1)]);
        let root = draft.push(Op::Sqrt, &[sum]);
        draft.outputs = vec![root, root, sum];
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        repair(&mut rng, &mut draft, &shape);
        assert_eq!(shape.violation(&draft), None);
        assert_eq!(draft.outputs[0], root);
        let value =
            |x: [f32; 2]| crate::program::Program::verify(draft.clone()).unwrap().evaluate(&x);
        assert_eq!(value([3.0, 1.0])[..2], [2.0, 2f32.sqrt()]);
        assert!(matches!(draft.outputs[2], Arg::Const(_)));
    }

    #[test]
    fn what_is_as_it_should_be_draws_nothing() {
        let draft = Draft { inputs: 1, outputs: vec![Arg::Input(0)], ..Draft::default() };
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut same = draft.clone();
        repair(&mut rng, &mut same, &Shape::new(1, vec![Reads::Only(1)]));
        assert_eq!((same, rng.get_word_pos()), (draft, 0));
    }
}
