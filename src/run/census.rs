//! The inputs and subexpressions that recur in formulas, which say something of the data (Pesce &
//! Iwanicki 2015, §5: variables that are rarely used may not matter, subexpressions that are often
//! present may be a change of variable that the data calls for).

use super::folder::{CENSUS, load_text};
use super::{RecordError, Run};
use crate::op::Op;
use crate::program::{
    Arg, Constants, Draft, Instr, Names, Program, effective_into, print_expression, structural_hash,
};
use crate::search::not_negative;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The most operations of a subexpression that is counted, as a tree. By hand, unmeasured.
const MAX_OPERATIONS: u32 = 8;

/// The most subexpressions that are kept on disk. By hand, unmeasured.
const MAX_KEPT: usize = 1000;

/// Counts of formulas by the inputs and subexpressions that they contain.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Census {
    formulas: u64,
    inputs: Vec<u64>,
    /// Subexpressions by structural hash, constants ignored.
    expressions: BTreeMap<u64, Found>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Found {
    expression: String,
    operations: u32,
    count: u64,
    first: f64,
    /// Subexpressions that have this one as an argument.
    within: BTreeSet<u64>,
}

/// A subexpression that occurs in several formulas.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Recurring {
    /// Formula text, each constant written `c`.
    pub expression: String,
    /// The operations of the tree.
    pub operations: u32,
    /// The number of formulas that contain it.
    pub count: u64,
    /// The share of all formulas, in [0, 1].
    pub share: f64,
    /// The time it was first seen, in seconds.
    pub first: f64,
}

impl Census {
    /// Returns the number of formulas that were counted.
    pub fn formulas(&self) -> u64 {
        self.formulas
    }

    /// Returns how many formulas use each input.
    pub fn inputs(&self) -> &[u64] {
        &self.inputs
    }

    /// Counts a formula that was seen after some seconds.
    ///
    /// # Panics
    /// If `names` does not have a name for each input.
    pub fn count(&mut self, formula: &Draft, names: &Names, seconds: f64) {
        let draft = canonical(formula);
        self.formulas += 1;
        self.inputs.resize(draft.inputs.max(self.inputs.len()), 0);
        let read = |i: usize| arguments(&draft).any(|arg| arg == Arg::Input(i as u16));
        (0..draft.inputs).filter(|&i| read(i)).for_each(|i| self.inputs[i] += 1);
        let mut hashes = Vec::new();
        structural_hash(&draft, Constants::Ignored, &mut hashes);
        let operations = tree_operations(&draft);
        let mut counted = BTreeSet::new();
        for (i, instr) in draft.instrs.iter().enumerate() {
            if operations[i] > MAX_OPERATIONS || moved(instr).is_some() {
                continue;
            }
            let found = self.expressions.entry(hashes[i]).or_insert_with(|| Found {
                expression: expression(&draft, i, names),
                operations: operations[i],
                count: 0,
                first: seconds,
                within: BTreeSet::new(),
            });
            found.count += u64::from(counted.insert(hashes[i]));
            for part in instr.args().iter().filter_map(|&arg| unmoved(&draft, arg)) {
                if let Some(part) = self.expressions.get_mut(&hashes[part]) {
                    part.within.insert(hashes[i]);
                }
            }
        }
    }

    /// Returns the subexpressions that at least two formulas contain, the most frequent first; not
    /// those that occur only within a larger one, nor those that only move or scale another.
    pub fn recurring(&self) -> Vec<Recurring> {
        let count = |hash: &u64| self.expressions.get(hash).map_or(0, |found| found.count);
        let own = |found: &&Found| {
            found.count > 1 && found.within.iter().all(|hash| count(hash) < found.count)
        };
        let mut recurring: Vec<Recurring> = self
            .expressions
            .values()
            .filter(own)
            .map(|found| Recurring {
                expression: found.expression.clone(),
                operations: found.operations,
                count: found.count,
                share: found.count as f64 / self.formulas as f64,
                first: found.first,
            })
            .collect();
        recurring.sort_by(|a, b| {
            (b.count, b.operations)
                .cmp(&(a.count, a.operations))
                .then_with(|| a.expression.cmp(&b.expression))
        });
        recurring
    }

    /// Finds the counted subexpression of that text.
    pub fn find(&self, expression: &str) -> Option<Recurring> {
        let found = self.expressions.values().find(|found| found.expression == expression)?;
        Some(Recurring {
            expression: found.expression.clone(),
            operations: found.operations,
            count: found.count,
            share: found.count as f64 / self.formulas as f64,
            first: found.first,
        })
    }

    /// Keeps the most frequent subexpressions, as on disk.
    pub(super) fn pruned(mut self) -> Census {
        let mut counts: Vec<u64> = self.expressions.values().map(|found| found.count).collect();
        counts.sort_unstable_by(|a, b| b.cmp(a));
        let least = counts.get(MAX_KEPT).map_or(0, |count| count + 1);
        self.expressions.retain(|_, found| found.count >= least);
        self
    }

    /// Returns the text of `census.json`: the most frequent subexpressions.
    pub fn to_json(&self) -> String {
        serde_json::to_string(&self.clone().pruned()).expect("plain data") + "\n"
    }

    /// Reads `census.json` from a run's folder; none if there is no such file.
    ///
    /// # Errors
    /// If it cannot be read, or is not the run's.
    pub fn load(folder: &Path, run: &Run) -> Result<Option<Census>, RecordError> {
        let Some(text) = load_text(folder, run, CENSUS)? else { return Ok(None) };
        let damaged =
            |line, reason| RecordError::Damaged { path: folder.join(CENSUS), line, reason };
        let census: Census = serde_json::from_str(&text)
            .map_err(|error| damaged(error.line(), error.to_string()))?;
        census.check(run.inputs.len()).map_err(|reason| damaged(1, reason))?;
        Ok(Some(census))
    }

    /// Checks that formulas of so many inputs could have been counted so.
    pub(super) fn check(&self, inputs: usize) -> Result<(), String> {
        let counts = self.inputs.iter().chain(self.expressions.values().map(|one| &one.count));
        if self.inputs.len() > inputs || counts.into_iter().any(|count| *count > self.formulas) {
            return Err("it counts more than there is".into());
        }
        for found in self.expressions.values() {
            not_negative("first", found.first)?;
            if found.expression.chars().any(char::is_control) {
                return Err("an expression is not one".into());
            }
        }
        Ok(())
    }
}

fn arguments(draft: &Draft) -> impl Iterator<Item = Arg> {
    let instrs = draft.instrs.iter().flat_map(|instr| instr.args().iter().copied());
    instrs.chain(draft.outputs.iter().copied())
}

/// Returns effective code with signs moved into constants where they can be (`x − c` is `x + c`,
/// and `y − c·x` is `y + c·x`), and commuting operands in order: constants first in products, last
/// elsewhere.
fn canonical(formula: &Draft) -> Draft {
    let mut draft = Draft::default();
    effective_into(formula, &mut draft, &mut Vec::new());
    for i in 0..draft.instrs.len() {
        let instr = draft.instrs[i];
        let takes_sign = |arg: Arg| match arg {
            Arg::Const(_) => true,
            Arg::Result(j) => {
                let product = draft.instrs[usize::from(j)];
                product.op() == Op::Mul && product.args().iter().any(is_constant)
            }
            Arg::Input(_) => false,
        };
        if instr.op() == Op::Sub && takes_sign(instr.args()[1]) {
            draft.instrs[i] = Instr::new(Op::Add, instr.args());
        }
    }
    let mut hashes = Vec::new();
    structural_hash(&draft, Constants::Ignored, &mut hashes);
    for instr in draft.instrs.iter_mut().filter(|instr| instr.op().commutes()) {
        let constants = if instr.op() == Op::Mul { 0 } else { 3 };
        instr.args_mut()[..2].sort_by_key(|arg| match arg {
            Arg::Input(j) => (1, u64::from(*j)),
            Arg::Result(j) => (2, hashes[usize::from(*j)]),
            Arg::Const(_) => (constants, 0),
        });
    }
    draft
}

fn is_constant(arg: &Arg) -> bool {
    matches!(arg, Arg::Const(_))
}

/// Returns the argument that an instruction only moves or scales by constants.
fn moved(instr: &Instr) -> Option<Arg> {
    let arithmetic = [Op::Add, Op::Sub, Op::Mul, Op::Div, Op::Neg];
    let mut others = instr.args().iter().filter(|arg| !is_constant(arg));
    let other = others.next().filter(|_| arithmetic.contains(&instr.op()));
    other.filter(|_| others.next().is_none()).copied()
}

/// Returns the instruction whose result an argument is, perhaps moved and scaled.
fn unmoved(draft: &Draft, arg: Arg) -> Option<usize> {
    let Arg::Result(i) = arg else { return None };
    match moved(&draft.instrs[usize::from(i)]) {
        Some(arg) => unmoved(draft, arg),
        None => Some(usize::from(i)),
    }
}

/// Counts the operations of each instruction's result, written out as a tree.
fn tree_operations(draft: &Draft) -> Vec<u32> {
    let mut operations: Vec<u32> = Vec::with_capacity(draft.instrs.len());
    for instr in &draft.instrs {
        let of = |arg: &Arg| match arg {
            Arg::Result(j) => operations[usize::from(*j)],
            _ => 0,
        };
        let total = instr.args().iter().map(of).fold(1, u32::saturating_add);
        operations.push(total);
    }
    operations
}

/// Returns an instruction's result as text, each constant written `c`.
fn expression(draft: &Draft, i: usize, names: &Names) -> String {
    let whole = Draft { outputs: vec![Arg::Result(i as u16)], ..draft.clone() };
    let mut part = Draft::default();
    effective_into(&whole, &mut part, &mut Vec::new());
    let inputs = part.inputs as u16;
    let named = part.instrs.iter_mut().flat_map(|instr| instr.args_mut());
    for arg in named {
        if let Arg::Const(_) = arg {
            *arg = Arg::Input(inputs);
        }
    }
    part.inputs += 1;
    part.consts.clear();
    let names = names.inputs.iter().cloned().chain(["c".to_owned()]);
    let program = Program::verify(part).expect("a part of a program");
    print_expression(&program, &Names::new(names, []))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::parse;

    fn census(formulas: &[&str]) -> Census {
        let names = Names::new(["a", "b"], ["y"]);
        let mut census = Census::default();
        for (i, formula) in formulas.iter().enumerate() {
            census.count(&parse(formula, &names).unwrap(), &names, i as f64);
        }
        census
    }

    #[test]
    fn what_recurs_is_found_whatever_its_constants_signs_and_order() {
        let census = census(&[
            "y = 3*max(a, b)^2 + 1",
            "t = max(b, a); y = exp2(2 - t*t)",
            "y = max(a - 0.5, 0.1)",
            "y = sqrt(max(a + 0.7, 0.2))",
        ]);
        assert_eq!(census.formulas(), 4);
        assert_eq!(census.inputs(), [4, 2]);
        let found: Vec<_> =
            census.recurring().into_iter().map(|r| (r.expression, r.count, r.first)).collect();
        assert_eq!(found, [("max(a, b)^2".into(), 2, 0.0), ("max(a + c, c)".into(), 2, 2.0)]);
    }

    #[test]
    fn a_part_is_told_where_it_also_occurs_alone() {
        let census = census(&["y = max(a, b)^2", "y = max(a, b)^2", "y = exp2(max(a, b))"]);
        let found: Vec<_> =
            census.recurring().into_iter().map(|r| (r.expression, r.count)).collect();
        assert_eq!(found, [("max(a, b)".into(), 3), ("max(a, b)^2".into(), 2)]);
    }

    #[test]
    fn what_is_only_moved_or_scaled_is_not_told_apart() {
        let census = census(&["y = 1 + 2*max(b, a)", "y = 3*a - 4*(max(a, b) + 5)", "y = b + 2*a"]);
        let found: Vec<_> = census.recurring().into_iter().map(|r| r.expression).collect();
        assert_eq!(found, ["max(a, b)"]);
    }

    #[test]
    fn deep_sharing_is_no_burden() {
        let squares = (1..60).map(|i| format!("t{i} = t{}*t{}", i - 1, i - 1));
        let text = format!("t0 = a + b; {}; y = t59", squares.collect::<Vec<_>>().join("; "));
        assert!(census(&[&text, &text]).recurring().iter().all(|r| r.operations <= 8));
    }
}
