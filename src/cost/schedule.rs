//! Schedules instructions: when results are ready, and how many are alive at once.

use super::CostScratch;
use super::chip::Chip;
use super::form::Lowered;
use crate::op::Op;
use crate::program::{Arg, Draft};

/// Returns the longest chain of instructions that wait for each other, in cycles.
pub(super) fn critical_path(draft: &Draft, chip: &Chip, scratch: &CostScratch) -> f64 {
    let mut ready: Vec<f64> = Vec::with_capacity(draft.instrs.len());
    for (i, instr) in draft.instrs.iter().enumerate() {
        let at = |arg: &Arg| match arg {
            Arg::Result(j) => ready[usize::from(*j)],
            _ => 0.0,
        };
        let last = instr.args().iter().map(at).fold(0.0, f64::max);
        ready.push(last + chip.of_form(scratch.forms[i]).latency);
    }
    let at = |output: &Arg| match output {
        Arg::Result(i) => ready[usize::from(*i)],
        _ => 0.0,
    };
    draft.outputs.iter().map(at).fold(0.0, f64::max)
}

/// Returns the most results alive at once, in the better of two orders: the program's, and one that
/// always takes the instruction that leaves fewest alive. A result may replace an argument that is
/// read for the last time.
pub(super) fn registers(draft: &Draft, scratch: &CostScratch) -> u32 {
    let graph = Graph::of(draft, scratch);
    let as_written = graph.peak(|_, ready| ready[0]);
    let frugal = graph.peak(|alive, ready| {
        let growth = |i: usize| 1 - alive.dying(&graph, i) as i32;
        ready.iter().copied().min_by_key(|&i| growth(i)).expect("something is ready")
    });
    as_written.min(frugal)
}

/// The instructions that a compiler keeps.
struct Graph {
    /// For each instruction of the draft that is kept, the instructions whose results it reads,
    /// each once.
    reads: Vec<Option<Vec<usize>>>,
    /// For each, the instructions that read its result.
    readers: Vec<Vec<usize>>,
    outputs: Vec<usize>,
}

impl Graph {
    fn of(draft: &Draft, scratch: &CostScratch) -> Graph {
        let mut reads = Vec::with_capacity(draft.instrs.len());
        for (i, instr) in draft.instrs.iter().enumerate() {
            let args = match (scratch.forms[i], instr.op()) {
                (Lowered::Merged, _) => {
                    reads.push(None);
                    continue;
                }
                // The numerator is read by the sum that absorbs the product.
                (Lowered::Quotient { product: false, .. }, Op::Div) => &instr.args()[1..],
                _ => instr.args(),
            };
            let mut results = Vec::new();
            args.iter().for_each(|&arg| expand(draft, scratch, arg, &mut results));
            results.sort_unstable();
            results.dedup();
            reads.push(Some(results));
        }
        let mut readers = vec![Vec::new(); reads.len()];
        for (i, results) in reads.iter().enumerate() {
            results.iter().flatten().for_each(|&j: &usize| readers[j].push(i));
        }
        let mut outputs = Vec::new();
        draft.outputs.iter().for_each(|&arg| expand(draft, scratch, arg, &mut outputs));
        outputs.sort_unstable();
        outputs.dedup();
        Graph { reads, readers, outputs }
    }

    /// Returns the most results alive if `choose` picks the next of the instructions that are
    /// ready.
    fn peak(&self, choose: impl Fn(&Alive, &[usize]) -> usize) -> u32 {
        let mut alive = Alive::new(self);
        let mut ready: Vec<usize> = (0..self.reads.len())
            .filter(|&i| self.reads[i].as_ref().is_some_and(Vec::is_empty))
            .collect();
        let mut peak = 0;
        while !ready.is_empty() {
            let next = choose(&alive, &ready);
            ready.retain(|&i| i != next);
            for &reader in &self.readers[next] {
                alive.missing[reader] -= 1;
                if alive.missing[reader] == 0 {
                    let place = ready.partition_point(|&i| i < reader);
                    ready.insert(place, reader);
                }
            }
            alive.run(self, next);
            peak = peak.max(alive.count);
        }
        peak
    }

    fn reads_of(&self, i: usize) -> &[usize] {
        self.reads[i].as_deref().unwrap_or_default()
    }
}

/// Adds the results that `arg` is made of: merged instructions are replaced by what they read.
fn expand(draft: &Draft, scratch: &CostScratch, arg: Arg, results: &mut Vec<usize>) {
    let mut left = vec![arg];
    while let Some(arg) = left.pop() {
        let Arg::Result(i) = arg else { continue };
        let i = usize::from(i);
        let args = draft.instrs[i].args();
        match (scratch.forms[i], draft.instrs[i].op()) {
            (Lowered::Merged, _) => left.extend(args),
            (Lowered::Quotient { product: false, .. }, Op::Div) => {
                results.push(i);
                left.push(args[0]);
            }
            _ => results.push(i),
        }
    }
}

/// The results that are alive after some instructions.
struct Alive {
    /// The number of results that each instruction still waits for.
    missing: Vec<usize>,
    /// The number of instructions and outputs that have still to read each result.
    readers: Vec<u32>,
    count: u32,
}

impl Alive {
    fn new(graph: &Graph) -> Alive {
        let mut readers = vec![0; graph.reads.len()];
        let reads = graph.reads.iter().flatten().flatten().chain(&graph.outputs);
        reads.for_each(|&i| readers[i] += 1);
        let missing = graph.reads.iter().map(|reads| reads.as_ref().map_or(0, Vec::len)).collect();
        Alive { missing, readers, count: 0 }
    }

    /// Counts the arguments that an instruction is the last to read.
    fn dying(&self, graph: &Graph, i: usize) -> u32 {
        graph.reads_of(i).iter().filter(|&&j| self.readers[j] == 1).count() as u32
    }

    fn run(&mut self, graph: &Graph, i: usize) {
        self.count -= self.dying(graph, i);
        graph.reads_of(i).iter().for_each(|&j| self.readers[j] -= 1);
        self.count += u32::from(self.readers[i] > 0);
    }
}
