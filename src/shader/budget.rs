//! What an evaluation may take of time and memory.

use super::interpreter::{Interpreter, Store};
use super::machine::{Machine, Reason};
use super::value::Value;
use naga::{Expression, Handle};

/// The most steps of one evaluation: expressions, statements, iterations, and scalars of arrays that
/// are copied. By hand: about ten seconds.
pub(super) const MOST_STEPS: u64 = 100_000_000;
/// Fewer scalars are copied in the time of a step. By hand, unmeasured.
const COPIED_IN_A_STEP: usize = 16;
/// The most scalars in all variables at a time. By hand: the largest tables of shaders, twice; they
/// take some 40 MiB.
const MOST_HELD: usize = 1 << 19;
/// The most scalars in the variables of all paths at a time. By hand: a third of a gibibyte.
pub(super) const MOST_KEPT: usize = 1 << 22;
impl<M: Machine> Interpreter<'_, '_, M> {
    pub fn leave(&mut self) {
        let left = self.frames.pop();
        if let Some(frame) = left {
            let locals: usize = frame.locals.iter().map(Value::size).sum();
            self.held -= locals + frame.values.iter().flatten().map(weight).sum::<usize>();
        }
    }

    /// Keeps the value of an expression of the current call.
    pub fn keep(&mut self, handle: Handle<Expression>, value: Value<M>) -> Result<(), Reason> {
        let new = weight(&value);
        let old = self.frame().values[handle.index()].replace(value);
        self.held -= old.as_ref().map_or(0, weight);
        self.hold_more(new)
    }

    /// Counts the scalars of a new variable.
    pub fn hold(&mut self, value: &Value<M>) -> Result<(), Reason> {
        self.hold_more(value.size())
    }

    pub fn hold_more(&mut self, scalars: usize) -> Result<(), Reason> {
        self.held += scalars;
        match self.held > MOST_HELD {
            true => Err(format!("its variables are of more than {MOST_HELD} numbers")),
            false => Ok(()),
        }
    }

    pub fn step(&mut self) -> Result<(), Reason> {
        self.steps += 1;
        let most = self.most_steps;
        match self.steps > most {
            true => Err(format!("it takes more than {most} steps; a loop may have no end")),
            false => Ok(()),
        }
    }

    /// Takes the steps for copying so many scalars.
    pub fn copy(&mut self, scalars: usize) -> Result<(), Reason> {
        if scalars < COPIED_IN_A_STEP {
            return Ok(());
        }
        self.steps += scalars as u64;
        self.step()
    }

    pub fn store(&mut self) -> Result<Store<M>, Reason> {
        self.copy(3 * self.held)?;
        let locals = self.frames.iter().map(|frame| frame.locals.clone()).collect();
        Ok(Store { globals: self.globals.clone(), locals })
    }

    pub fn restore(&mut self, store: &Store<M>) {
        self.globals.clone_from(&store.globals);
        for (frame, locals) in self.frames.iter_mut().zip(&store.locals) {
            frame.locals.clone_from(locals);
        }
    }
}

/// Returns the scalars of a value, if it may be large.
fn weight<M: Machine>(value: &Value<M>) -> usize {
    match value {
        Value::Several(_) => value.size(),
        _ => 0,
    }
}
