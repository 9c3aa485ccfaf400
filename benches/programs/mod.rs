//! The random programs that everything here is timed on: expression trees, since peers know no
//! other form, from one committed seed.
#![allow(dead_code)] // each bench uses a part

use lgp::dataset::Split;
use lgp::op::Op;
use lgp::program::{Arg, Draft, Program};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

pub const SEED: u64 = 20150406;
pub const SAMPLES: usize = 4096;
pub const INPUTS: usize = 3;

/// Nodes of a tree, leaves counted.
pub const NODES: std::ops::RangeInclusive<usize> = 10..=30;

/// A set of operations, each drawn as often.
pub struct Set {
    pub name: &'static str,
    pub operations: &'static [Op],
}

pub const SETS: [Set; 3] = [
    Set { name: "arith", operations: &[Op::Add, Op::Sub, Op::Mul] },
    Set { name: "arith_div", operations: &[Op::Add, Op::Sub, Op::Mul, Op::Div] },
    Set {
        name: "mixed",
        operations: &[
            Op::Add,
            Op::Sub,
            Op::Mul,
            Op::Div,
            Op::Min,
            Op::Max,
            Op::Sqrt,
            Op::Exp2,
            Op::Log2,
        ],
    },
];

impl Set {
    /// `count` programs of this set, the same at every call.
    pub fn programs(&self, count: usize) -> Vec<Program> {
        let mut rng = ChaCha8Rng::seed_from_u64(SEED);
        (0..count).map(|_| self.program(&mut rng)).collect()
    }

    fn program(&self, rng: &mut ChaCha8Rng) -> Program {
        loop {
            let nodes = rng.random_range(NODES);
            if let Some(program) = self.tree(rng, nodes) {
                return program;
            }
        }
    }

    /// A tree of `nodes` nodes; nothing where the operations drawn make no such tree.
    pub fn tree(&self, rng: &mut ChaCha8Rng, nodes: usize) -> Option<Program> {
        let mut operations = Vec::new();
        // Of a tree, every node but the root is an argument.
        let mut missing = nodes - 1;
        while missing > 0 {
            let op = self.operations[rng.random_range(0..self.operations.len())];
            missing = missing.checked_sub(op.arity())?;
            operations.push(op);
        }
        let draft = (0..10_000).find_map(|_| with_arguments(rng, &operations))?;
        Some(Program::verify(draft).expect("arguments are earlier ones"))
    }
}

/// The operations with arguments: inputs, constants or results that none has read yet, each kind
/// as likely. Nothing where that leaves more than one result unread, or a constant folds.
fn with_arguments(rng: &mut ChaCha8Rng, operations: &[Op]) -> Option<Draft> {
    let mut draft = Draft { inputs: INPUTS, ..Draft::default() };
    let mut unread: Vec<Arg> = Vec::new();
    for &op in operations {
        let mut args = [Arg::Input(0); 2];
        for arg in &mut args[..op.arity()] {
            *arg = match rng.random_range(0..3) {
                0 => Arg::Input(rng.random_range(0..INPUTS as u16)),
                1 => draft.constant(rng.random_range(0.1f32..2.0)),
                _ if unread.is_empty() => return None,
                _ => unread.swap_remove(rng.random_range(0..unread.len())),
            };
        }
        let args = &args[..op.arity()];
        if args.iter().all(|arg| matches!(arg, Arg::Const(_))) {
            return None;
        }
        unread.push(draft.push(op, args));
    }
    let is_tree = unread.len() == 1;
    draft.outputs = unread;
    is_tree.then_some(draft)
}

/// Input columns, uniform within (0.05, 1), and a target.
pub fn samples(rows: usize) -> Split {
    let mut rng = ChaCha8Rng::seed_from_u64(SEED + 1);
    let mut column = || (0..rows).map(|_| rng.random_range(0.05f32..1.0)).collect();
    Split { columns: (0..=INPUTS).map(|_| column()).collect(), ..Split::default() }
}

/// Operations of all programs for one sample each.
pub fn operations(programs: &[Program]) -> usize {
    programs.iter().map(|program| program.instrs.len()).sum()
}
