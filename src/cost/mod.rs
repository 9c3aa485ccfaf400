//! Costs programs on a GPU: cycles of their effective code, registers, the critical path.
//!
//! Shared results are paid once. Whatever compilers merge is free: a product that only sums read,
//! signs of arguments, saturation of a result, the square root below a fraction line, minima of
//! three where the chip has them. So are constants and operations that do nothing, which folding
//! removes ([`crate::simplify`]). The folded program is costed as it stands: any further algebra
//! must be done before.
//!
//! A chip has pipes that work in parallel; an instruction takes slots on one or more, and the
//! busiest pipe decides. Cycles are thus for many threads or long code, which hide latency; the
//! critical path is the wait of one thread alone.
//!
//! ```
//! use lgp::cost::Profile;
//! use lgp::program::{Names, parse};
//!
//! let program = parse("y = exp2(x) + x*x", &Names::new(["x"], ["y"]))?;
//! let cost = Profile::find("gcn")?.cost(&program);
//! assert_eq!((cost.cycles, cost.registers), (5.0, 1));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chip;
mod form;
mod profile;
mod schedule;

pub use chip::Evidence;
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
    /// The number of readers of each result.
    uses: Vec<u32>,
    /// The number of sums that absorb each product.
    absorbed: Vec<u32>,
    /// The number of divisions by each result.
    divides: Vec<u32>,
    /// The values whose inverse is known.
    inverses: Vec<Arg>,
    forms: Vec<Lowered>,
    simplifier: Simplifier,
    folded: Draft,
}

impl CostScratch {
    /// Returns true if each reader of the result absorbs it.
    fn is_absorbed(&self, i: usize) -> bool {
        self.absorbed[i] == self.uses[i]
    }
}

/// The cost of a program by a profile.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// The profile's name.
    pub gpu: String,
    /// Cycles: the slots of the busiest pipe.
    pub cycles: f64,
    /// The name of that pipe.
    pub limit: String,
    /// The most results alive at once, without inputs and constants.
    pub registers: u32,
    /// Cycles from the inputs to the last output, if nothing else runs.
    pub critical_path: f64,
    /// The shares by operation, as written; on a chip where constants take instructions, also by
    /// `constant`.
    pub ops: BTreeMap<&'static str, OpCost>,
}

/// An operation's share of the cost.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct OpCost {
    /// The number of such operations.
    pub count: u32,
    /// The number of these that merge into others.
    pub merged: u32,
    /// The slots by pipe, without zeros.
    pub slots: BTreeMap<String, f64>,
}

impl Profile {
    /// Returns the cycles of a draft's effective code, folded; for a mix, the weighted mean. Equal
    /// constants count as different ones, since they may be fitted apart.
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

    /// Returns the cycles of a draft's effective code with nothing folded, whatever the constants'
    /// values.
    pub fn cycles_as_written(&self, draft: &Draft, scratch: &mut CostScratch) -> f64 {
        let weighted = |(share, chip): &(f64, Chip)| {
            find_forms(draft, &chip.merges, scratch);
            share * busiest(&slots(draft, chip, scratch))
        };
        self.chips.iter().map(weighted).sum()
    }

    /// Returns the cost of a draft's effective code, folded; for a mix, the weighted means, the
    /// most registers, and the operations on its first GPU.
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

    /// Returns the cycles of an operation by itself, with nothing merged.
    pub fn of(&self, op: Op) -> f64 {
        self.chips.iter().map(|(share, chip)| share * busiest(&chip.of_op(op).slots)).sum()
    }
}

/// Sums the slots of all instructions.
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

/// Counts the constants that need an instruction of their own, on a chip that has room for them in
/// sums only.
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
