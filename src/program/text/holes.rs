//! What a template leaves open: functions that it calls and nowhere defines, and free constants.
//!
//! The values that they are to give are further inputs of its program: a slot each.

use crate::program::{Arg, Draft, Program};
use std::collections::HashMap;

/// A function to be found.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct OpenFunction {
    pub name: String,
    /// Its parameters' names: those of what it is called with, where these are single names, the
    /// same in each call.
    pub parameters: Vec<Option<String>>,
    /// The number of its values.
    pub values: usize,
    pub calls: Vec<OpenCall>,
}

/// A call of a function to be found.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct OpenCall {
    pub args: Vec<Arg>,
    /// The first slot of its values.
    pub slot: usize,
}

/// A constant to be found.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct OpenConstant {
    pub name: String,
    /// The value to start from, if one is known.
    pub start: Option<f32>,
    pub slot: usize,
}

/// A call as it is written.
pub(super) struct HoleCall<'a> {
    pub name: &'a str,
    pub args: Vec<Arg>,
    /// The arguments' names, if they are only that.
    pub named: Vec<Option<String>>,
    pub values: usize,
}

/// All that a text leaves open.
#[derive(Clone, Debug)]
pub(in crate::program) struct Holes {
    columns: usize,
    slots: usize,
    pub functions: Vec<OpenFunction>,
    pub constants: Vec<OpenConstant>,
    places: HashMap<String, usize>,
    /// The functions that each slot and each instruction depend on, a bit each.
    of_slots: Vec<u64>,
    of_results: Vec<u64>,
}

/// The most functions, a bit each.
const MAX_FUNCTIONS: usize = 64;

/// The most slots.
const MAX_SLOTS: usize = 10_000;

impl Holes {
    pub fn new(columns: usize) -> Holes {
        Holes {
            columns,
            slots: 0,
            functions: Vec::new(),
            constants: Vec::new(),
            places: HashMap::new(),
            of_slots: Vec::new(),
            of_results: Vec::new(),
        }
    }

    /// Returns the number of slots.
    pub fn slots(&self) -> usize {
        self.slots
    }

    /// Notes the arguments of an instruction that was added.
    pub fn note(&mut self, args: &[Arg]) {
        let depends = args.iter().fold(0, |all, &arg| all | self.functions_of(arg));
        self.of_results.push(depends);
    }

    fn functions_of(&self, arg: Arg) -> u64 {
        match arg {
            Arg::Const(_) => 0,
            Arg::Result(i) => self.of_results[usize::from(i)],
            Arg::Input(i) => {
                let slot = usize::from(i).checked_sub(self.columns);
                slot.map_or(0, |slot| self.of_slots[slot])
            }
        }
    }

    fn new_slots(&mut self, count: usize, depends: u64) -> Result<usize, String> {
        let first = self.slots;
        self.slots += count;
        if self.slots > MAX_SLOTS {
            return Err("too many values are to be found".into());
        }
        self.of_slots.resize(self.slots, depends);
        Ok(first)
    }

    fn input(&self, slot: usize) -> Arg {
        Arg::Input((self.columns + slot) as u16)
    }

    /// Returns a constant to be found.
    pub fn constant(&mut self, name: String, start: Option<f32>) -> Result<Arg, String> {
        if let Some(known) = self.constants.iter().find(|known| known.name == name) {
            return Ok(self.input(known.slot));
        }
        let slot = self.new_slots(1, 0)?;
        self.constants.push(OpenConstant { name, start, slot });
        Ok(self.input(slot))
    }

    /// Returns the values of a function to be found.
    pub(super) fn call(&mut self, call: HoleCall, draft: &Draft) -> Result<Vec<Arg>, String> {
        let HoleCall { name, args, named, values } = call;
        debug_assert_eq!(self.of_results.len(), draft.instrs.len(), "all are noted");
        let place = self.function(name, &args, named, values)?;
        let known = self.functions[place].calls.iter().find(|known| known.args == args);
        let first = match known {
            Some(known) => known.slot,
            None => {
                let within = args.iter().fold(0, |all, &arg| all | self.functions_of(arg));
                if within >> place & 1 == 1 {
                    return Err(format!(
                        "`{name}` is called in an argument of itself; a hole within a hole must be another"
                    ));
                }
                let slot = self.new_slots(values, within | 1 << place)?;
                self.functions[place].calls.push(OpenCall { args, slot });
                slot
            }
        };
        Ok((first..first + values).map(|slot| self.input(slot)).collect())
    }

    /// Returns the place of a function, which is new or has been called like this before.
    fn function(
        &mut self,
        name: &str,
        args: &[Arg],
        named: Vec<Option<String>>,
        values: usize,
    ) -> Result<usize, String> {
        let Some(&place) = self.places.get(name) else {
            if self.functions.len() == MAX_FUNCTIONS {
                return Err(format!("more than {MAX_FUNCTIONS} functions are to be found"));
            }
            let (name, place) = (name.to_owned(), self.functions.len());
            self.places.insert(name.clone(), place);
            let calls = Vec::new();
            self.functions.push(OpenFunction { name, parameters: named, values, calls });
            return Ok(place);
        };
        let known = &mut self.functions[place];
        if known.parameters.len() != args.len() {
            let (given, before) = (counted(args.len(), "argument"), known.parameters.len());
            return Err(format!("`{name}` is called with {given} here, but with {before} before"));
        }
        if known.values != values {
            let (given, before) = (counted(values, "value"), known.values);
            return Err(format!("`{name}` has {given} here, but {before} before"));
        }
        for (parameter, name) in known.parameters.iter_mut().zip(named) {
            if *parameter != name {
                *parameter = None;
            }
        }
        Ok(place)
    }

    /// Checks that there is something to be found, and that an output depends on all of it.
    pub(super) fn check_used(&self, program: &Program) -> Result<(), String> {
        if self.functions.is_empty() && self.constants.is_empty() {
            return Err("nothing is to be found: call a function that is nowhere defined, as `f(x)`, or write a constant as `$a`".into());
        }
        let mut counts = Vec::new();
        crate::program::use_counts(program, &mut counts);
        let instrs = program.instrs.iter().zip(&counts).filter(|(_, count)| **count > 0);
        let mut read: Vec<Arg> = program.outputs.clone();
        read.extend(instrs.flat_map(|(instr, _)| instr.args()));
        // What an output reads of a call, it reads of its arguments.
        let mut is_read = vec![false; self.slots];
        let mut places: Vec<Arg> = read;
        while let Some(arg) = places.pop() {
            match arg {
                Arg::Input(i) => {
                    let Some(slot) = usize::from(i).checked_sub(self.columns) else { continue };
                    if !std::mem::replace(&mut is_read[slot], true) {
                        places.extend(self.arguments_of(slot));
                    }
                }
                Arg::Result(i) if counts[usize::from(i)] == 0 => {
                    counts[usize::from(i)] = 1;
                    places.extend(program.instrs[usize::from(i)].args());
                }
                Arg::Result(_) | Arg::Const(_) => {}
            }
        }
        if let Some(idle) = self.constants.iter().find(|one| !is_read[one.slot]) {
            return Err(format!("no output depends on `${}`", idle.name));
        }
        let is_idle = |one: &&OpenFunction| {
            let mut slots = one.calls.iter().flat_map(|call| call.slot..call.slot + one.values);
            !slots.any(|slot| is_read[slot])
        };
        match self.functions.iter().find(is_idle) {
            Some(idle) => Err(format!("no output depends on `{}`", idle.name)),
            None => Ok(()),
        }
    }

    fn arguments_of(&self, slot: usize) -> Vec<Arg> {
        let calls = self.functions.iter().flat_map(|one| {
            one.calls.iter().filter(move |call| (call.slot..call.slot + one.values).contains(&slot))
        });
        calls.flat_map(|call| call.args.iter().copied()).collect()
    }
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}
