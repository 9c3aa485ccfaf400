//! What a program costs on a GPU: cycles of its effective code, registers, the critical path.
//!
//! Shared results are paid once. What compilers merge is not paid at all: a product that only
//! sums read, signs of arguments, saturation of a result, the square root below a
//! fraction line, minima of three where the chip has them. Nor are constants and what does nothing, which
//! folding leaves out ([`crate::simplify`]). Nothing else is assumed of them: the folded program is costed as
//! it stands, and what algebra can do beyond that is to be done before.
//!
//! A chip has pipes that work beside each other; an instruction takes slots on one or more, and
//! the busiest decides. So cycles are for many threads or long code, which hide latency;
//! the critical path is what one thread alone would wait.

mod chip;
mod form;
mod profile;
mod schedule;

pub use profile::Profile;

use crate::op::Op;
use crate::program::{Arg, Draft};
use crate::simplify::{Simplifier, folded_draft};
use chip::{Chip, Slots, busiest};
use form::{Lowered, find_forms};
use serde::Serialize;
use std::collections::BTreeMap;

/// Scratch memory of [`Profile::cycles`].
#[derive(Clone, Debug, Default)]
pub struct CostScratch {
    /// How often each result is read.
    uses: Vec<u32>,
    /// How many sums absorb each product.
    absorbed: Vec<u32>,
    /// How often each result is divided by.
    divides: Vec<u32>,
    /// Values whose inverse is known.
    inverses: Vec<Arg>,
    forms: Vec<Lowered>,
    simplifier: Simplifier,
    folded: Draft,
}

impl CostScratch {
    /// Whether each reader of the result absorbs it.
    fn is_absorbed(&self, i: usize) -> bool {
        self.absorbed[i] == self.uses[i]
    }
}

/// What a program costs on one GPU.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cost {
    pub gpu: String,
    /// Slots of the busiest pipe.
    pub cycles: f64,
    /// That pipe.
    pub limit: String,
    /// The most results alive at once; inputs and constants are not counted.
    pub registers: u32,
    /// Cycles from the inputs to the last output, if nothing else runs.
    pub critical_path: f64,
    /// By operation, as written; and `constant`, on a chip where constants take instructions.
    pub ops: BTreeMap<&'static str, OpCost>,
}

/// An operation's share of the cost.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct OpCost {
    pub count: u32,
    /// Of these, those that are no instruction of their own.
    pub merged: u32,
    /// By pipe, those that are not zero.
    pub slots: BTreeMap<String, f64>,
}

impl Profile {
    /// The cycles of a draft's effective code, folded; for a mix the weighted mean. Equal constants count as
    /// different ones, since they may be fitted apart.
    pub fn cycles(&self, draft: &Draft, scratch: &mut CostScratch) -> f64 {
        if Simplifier::is_folded(draft) {
            return self.cycles_as_written(draft, scratch);
        }
        let mut folded = std::mem::take(&mut scratch.folded);
        scratch.simplifier.fold_constants(draft, &mut folded);
        let cycles = self.cycles_as_written(&folded, scratch);
        scratch.folded = folded;
        cycles
    }

    /// The cycles of a draft's effective code with nothing folded, whatever its constants happen to be.
    pub fn cycles_as_written(&self, draft: &Draft, scratch: &mut CostScratch) -> f64 {
        let weighted = |(share, chip): &(f64, Chip)| {
            find_forms(draft, &chip.merges, scratch);
            share * busiest(&slots(draft, chip, scratch))
        };
        self.chips.iter().map(weighted).sum()
    }

    /// The cost of a draft's effective code, folded; for a mix the weighted means, but the most registers,
    /// and the operations on its first GPU.
    pub fn cost(&self, draft: &Draft) -> Cost {
        let folded = folded_draft(draft);
        let mut costs = self.chips.iter().map(|(share, chip)| (*share, chip_cost(&folded, chip)));
        let (share, mut whole) = costs.next().expect("a profile has a chip");
        whole.cycles *= share;
        whole.critical_path *= share;
        for (share, cost) in costs {
            whole.cycles += share * cost.cycles;
            whole.critical_path += share * cost.critical_path;
            whole.registers = whole.registers.max(cost.registers);
        }
        whole.gpu.clone_from(&self.name);
        whole
    }

    /// The cycles of an operation by itself, with nothing merged.
    pub fn of(&self, op: Op) -> f64 {
        self.chips.iter().map(|(share, chip)| share * busiest(&chip.of_op(op).slots)).sum()
    }
}

/// The slots of all instructions.
fn slots(draft: &Draft, chip: &Chip, scratch: &CostScratch) -> Slots {
    let mut total = Slots::default();
    for &form in &scratch.forms {
        add(&mut total, &chip.of_form(form).slots, 1.0);
    }
    if let Some(literal) = &chip.literal {
        add(&mut total, literal, f64::from(literals(draft, scratch)));
    }
    total
}

fn add(total: &mut Slots, slots: &Slots, times: f64) {
    for (total, slots) in total.iter_mut().zip(slots) {
        *total += slots * times;
    }
}

/// The constants that need an instruction of their own on a chip that has room for them in sums
/// only.
fn literals(draft: &Draft, scratch: &CostScratch) -> u32 {
    let mut count = 0;
    for (instr, _) in draft.instrs.iter().zip(&scratch.uses).filter(|(_, uses)| **uses > 0) {
        if !matches!(instr.op(), Op::Add | Op::Sub) {
            count += instr.args().iter().filter(|arg| matches!(arg, Arg::Const(_))).count() as u32;
        }
    }
    count
}

fn chip_cost(draft: &Draft, chip: &Chip) -> Cost {
    let mut scratch = CostScratch::default();
    find_forms(draft, &chip.merges, &mut scratch);
    let mut ops: BTreeMap<&'static str, OpCost> = BTreeMap::new();
    for (i, instr) in draft.instrs.iter().enumerate().filter(|(i, _)| scratch.uses[*i] > 0) {
        let form = scratch.forms[i];
        let entry = ops.entry(instr.op().name()).or_default();
        entry.count += 1;
        entry.merged += u32::from(form == Lowered::Merged);
        entry.take(chip, &chip.of_form(form).slots, 1.0);
    }
    let literals = literals(draft, &scratch);
    if let Some(literal) = chip.literal.as_ref().filter(|_| literals > 0) {
        let entry = ops.entry("constant").or_default();
        entry.count = literals;
        entry.take(chip, literal, f64::from(literals));
    }
    let slots = slots(draft, chip, &scratch);
    let cycles = busiest(&slots);
    let limit = chip.pipes.iter().zip(slots).find(|(_, slots)| *slots == cycles);
    Cost {
        gpu: chip.name.clone(),
        cycles,
        limit: limit.map(|(pipe, _)| pipe.clone()).unwrap_or_default(),
        registers: schedule::registers(draft, &scratch),
        critical_path: schedule::critical_path(draft, chip, &scratch),
        ops,
    }
}

impl OpCost {
    fn take(&mut self, chip: &Chip, slots: &Slots, times: f64) {
        for (pipe, slots) in chip.pipes.iter().zip(slots).filter(|(_, slots)| **slots > 0.0) {
            *self.slots.entry(pipe.clone()).or_default() += slots * times;
        }
    }
}
