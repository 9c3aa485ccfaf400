//! The paths through a function whose conditions are not all decided.
//!
//! A call is interpreted once for each path, which is known by the decisions it took. What the
//! paths leave is merged by the conditions that they parted at.

use super::interpreter::Store;
use super::machine::{Machine, Reason};
use super::value::{Scalar, Value};

/// The most paths through one call. By hand: a loop of so many steps that may end at each.
const MOST_PATHS: usize = 256;

/// A condition and the side that was taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct Decision<M: Machine> {
    condition: M::Bool,
    taken: bool,
}

/// The path that is being taken through each call under way.
#[derive(Debug)]
pub(super) struct Paths<M: Machine> {
    calls: Vec<Path<M>>,
}

#[derive(Debug)]
struct Path<M: Machine> {
    decisions: Vec<Decision<M>>,
    /// The number of decisions met so far.
    met: usize,
    /// The number of paths taken before this one.
    before: usize,
}

/// What a path leaves.
pub(super) struct Leaf<M: Machine> {
    pub decisions: Vec<Decision<M>>,
    pub result: Option<Value<M>>,
    pub store: Store<M>,
}

impl<M: Machine> Default for Paths<M> {
    fn default() -> Self {
        Paths { calls: Vec::new() }
    }
}

impl<M: Machine> Paths<M> {
    pub fn begin(&mut self) {
        self.calls.push(Path { decisions: Vec::new(), met: 0, before: 0 });
    }

    pub fn end(&mut self) {
        self.calls.pop();
    }

    /// Returns the side that the current path takes.
    pub fn decide(&mut self, condition: M::Bool) -> bool {
        let Some(path) = self.calls.last_mut() else { return true };
        if path.met == path.decisions.len() {
            path.decisions.push(Decision { condition, taken: true });
        }
        path.met += 1;
        path.decisions[path.met - 1].taken
    }

    /// Returns the decisions of the path just taken.
    pub fn taken(&self) -> Vec<Decision<M>> {
        let path = self.calls.last();
        let decision = |d: &Decision<M>| Decision { condition: d.condition, taken: d.taken };
        path.map(|path| path.decisions.iter().map(decision).collect()).unwrap_or_default()
    }

    /// Goes on to the next path; false if there is none.
    pub fn next(&mut self) -> Result<bool, Reason> {
        let Some(path) = self.calls.last_mut() else { return Ok(false) };
        while path.decisions.pop_if(|last| !last.taken).is_some() {}
        let Some(last) = path.decisions.last_mut() else { return Ok(false) };
        last.taken = false;
        (path.met, path.before) = (0, path.before + 1);
        match path.before < MOST_PATHS {
            true => Ok(true),
            false => Err(format!("it has more than {MOST_PATHS} paths that depend on the inputs")),
        }
    }
}

/// Merges leaves, in the order of their paths, by the decisions from `depth` on.
pub(super) fn merged<M: Machine>(
    machine: &mut M,
    mut leaves: Vec<Leaf<M>>,
    depth: usize,
) -> Result<Leaf<M>, Reason> {
    if leaves.len() <= 1 {
        return leaves.pop().ok_or_else(|| "it has no path".into());
    }
    let condition = leaves[0].decisions[depth].condition;
    let split = leaves.iter().position(|leaf| !leaf.decisions[depth].taken);
    let rest = leaves.split_off(split.unwrap_or(leaves.len()));
    let yes = merged(machine, leaves, depth + 1)?;
    let no = merged(machine, rest, depth + 1)?;
    let result = match (yes.result, no.result) {
        (Some(yes), Some(no)) => Some(either(machine, condition, &yes, &no)?),
        _ => None,
    };
    Ok(Leaf { decisions: Vec::new(), result, store: yes.store.or(no.store, machine, condition)? })
}

impl<M: Machine> Store<M> {
    /// Returns what is stored here where a condition holds, and what the other stores elsewhere.
    pub fn or(
        self,
        other: Store<M>,
        machine: &mut M,
        condition: M::Bool,
    ) -> Result<Store<M>, Reason> {
        let mut choose = |yes: Vec<Value<M>>, no: Vec<Value<M>>| {
            let pairs = yes.iter().zip(&no).map(|(yes, no)| either(machine, condition, yes, no));
            pairs.collect::<Result<Vec<_>, Reason>>()
        };
        let globals = choose(self.globals, other.globals)?;
        let frames = self.locals.into_iter().zip(other.locals);
        let locals = frames.map(|(yes, no)| choose(yes, no)).collect::<Result<_, _>>()?;
        Ok(Store { globals, locals })
    }
}

/// Returns one value where the condition holds, and another elsewhere.
pub(super) fn either<M: Machine>(
    machine: &mut M,
    condition: M::Bool,
    yes: &Value<M>,
    no: &Value<M>,
) -> Result<Value<M>, Reason> {
    yes.zip(no, &mut |yes, no| {
        Ok(match (yes, no) {
            (Scalar::Float(yes), Scalar::Float(no)) => {
                Scalar::Float(machine.choose(condition, yes, no)?)
            }
            (Scalar::Bool(yes), Scalar::Bool(no)) => {
                let against = machine.not(condition);
                let (yes, no) = (machine.and(condition, yes), machine.and(against, no));
                Scalar::Bool(machine.or(yes, no))
            }
            (Scalar::Int(yes), Scalar::Int(no)) if yes == no => Scalar::Int(yes),
            (Scalar::Uint(yes), Scalar::Uint(no)) if yes == no => Scalar::Uint(yes),
            // Where one is unset, nobody may read it.
            (Scalar::Unset, set) | (set, Scalar::Unset) => set,
            _ => Scalar::Unknown,
        })
    })
}
