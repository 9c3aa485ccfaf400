//! What a text has defined: its names, constants and results.

pub(super) use super::holes::HoleCall;
use super::holes::Holes;
use super::lex::Number;
use super::syntax::Value;
use super::{FreeConstant, Names, Parsed, Scope};
use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Draft, Instr, Program};
use crate::suggest::did_you_mean;
use std::collections::{HashMap, HashSet};

/// What the statements up to here have defined. Its errors are messages without a place, because
/// only the tokens have places.
pub(super) struct Definitions {
    draft: Draft,
    names: Names,
    /// The inputs' places in `names`.
    inputs: HashMap<String, usize>,
    outputs: HashSet<String>,
    open: bool,
    assigned: HashMap<String, Value>,
    /// The names assigned, in order.
    statements: Vec<String>,
    /// Those that a later statement reads.
    read: HashSet<String>,
    free: Vec<FreeConstant>,
    free_places: HashMap<String, Arg>,
    /// The draft's constants in double precision.
    exact: Vec<f64>,
    /// Numbers by the bits of that.
    constants: HashMap<u64, Arg>,
    /// Results by the instruction that computes them.
    results: HashMap<Instr, Arg>,
    /// What is to be found, if the text may leave functions and constants open.
    holes: Option<Holes>,
}

impl Definitions {
    pub(super) fn new(scope: Scope) -> Definitions {
        let names = match scope {
            Scope::Dataset(names) => names.clone(),
            Scope::Open { outputs } => Names { inputs: Vec::new(), outputs: outputs.to_vec() },
        };
        Definitions {
            draft: Draft::default(),
            inputs: first_places(&names.inputs),
            outputs: names.outputs.iter().cloned().collect(),
            names,
            open: matches!(scope, Scope::Open { .. }),
            assigned: HashMap::new(),
            statements: Vec::new(),
            read: HashSet::new(),
            free: Vec::new(),
            free_places: HashMap::new(),
            exact: Vec::new(),
            constants: HashMap::new(),
            results: HashMap::new(),
            holes: None,
        }
    }

    /// Definitions over vectors, each with its number of components: these are the inputs.
    pub(super) fn of_vectors(vectors: &[(String, usize)]) -> Definitions {
        let mut definitions = Definitions::new(Scope::Dataset(&Names::default()));
        for (name, size) in vectors {
            let first = definitions.draft.inputs;
            definitions.draft.inputs += size;
            let value: Value = (first..first + size).map(|i| Arg::Input(i as u16)).collect();
            definitions.names.inputs.push(name.clone());
            definitions.assigned.entry(name.clone()).or_insert(value);
        }
        definitions
    }

    /// Definitions in which functions that are called and nowhere defined are holes, and free
    /// constants are, too.
    pub(super) fn with_holes(names: &Names) -> Definitions {
        let columns = names.inputs.len();
        Definitions { holes: Some(Holes::new(columns)), ..Definitions::new(Scope::Dataset(names)) }
    }

    pub(super) fn has_holes(&self) -> bool {
        self.holes.is_some()
    }

    /// Returns the values of a hole.
    pub(super) fn hole(&mut self, call: HoleCall) -> Result<Value, String> {
        let Definitions { holes, draft, .. } = self;
        holes.as_mut().expect("asked for only where there are some").call(call, draft)
    }

    /// Returns a name that a statement may assign, as an example for messages.
    pub(super) fn example(&self) -> &str {
        self.names.outputs.first().map_or("y", String::as_str)
    }

    /// Returns true for the name of a value.
    pub(super) fn knows(&self, name: &str) -> bool {
        self.assigned.contains_key(name) || self.inputs.contains_key(name)
    }

    /// Checks that a statement may assign the name.
    pub(super) fn check_assignable(&self, name: &str) -> Result<(), String> {
        if let Some((vector, _)) = name.split_once('.') {
            return Err(format!("components cannot be assigned; assign all of `{vector}`"));
        }
        if self.inputs.contains_key(name) {
            return Err(format!("`{name}` is an input, and cannot be assigned"));
        }
        if self.assigned.contains_key(name) {
            return Err(format!("`{name}` is assigned twice"));
        }
        Ok(())
    }

    pub(super) fn assign(&mut self, name: String, value: Value) {
        self.assigned.insert(name.clone(), value);
        self.statements.push(name);
    }

    pub(super) fn name(&mut self, name: String) -> Result<Value, String> {
        if let Some(value) = self.assigned.get(&name) {
            self.read.insert(name);
            return Ok(value.clone());
        }
        if let Some(&index) = self.inputs.get(&name) {
            return Ok(vec![Arg::Input(index as u16)]);
        }
        if self.outputs.contains(&name) {
            return Err(format!("output `{name}` is used before it is assigned"));
        }
        if self.open {
            let index = self.names.inputs.len();
            self.room(index, "inputs")?;
            self.inputs.insert(name.clone(), index);
            self.names.inputs.push(name);
            self.draft.inputs = index + 1;
            return Ok(vec![Arg::Input(index as u16)]);
        }
        let candidates = self.names.inputs.iter().chain(self.assigned.keys());
        let hint = did_you_mean(&name, candidates.map(String::as_str));
        let inputs = listed(&self.names.inputs);
        Err(format!("unknown name `{name}`{hint} (inputs: {inputs})"))
    }

    pub(super) fn constant(&mut self, value: Number) -> Result<Arg, String> {
        if let Some(&known) = self.constants.get(&value.exact.to_bits()) {
            return Ok(known);
        }
        self.room(self.draft.consts.len(), "numbers")?;
        let constant = self.draft.constant(value.rounded);
        self.exact.push(value.exact);
        self.constants.insert(value.exact.to_bits(), constant);
        Ok(constant)
    }

    /// Returns the free constant of this name, which starts at 1 unless its start is known.
    pub(super) fn free_constant(
        &mut self,
        name: String,
        start: Option<f32>,
    ) -> Result<Arg, String> {
        if let Some(holes) = &mut self.holes {
            return holes.constant(name, start);
        }
        if let Some(&known) = self.free_places.get(&name) {
            return Ok(known);
        }
        self.room(self.draft.consts.len(), "constants")?;
        let value = start.unwrap_or(1.0);
        let arg = self.draft.constant(value);
        self.exact.push(value.into());
        if let Arg::Const(index) = arg {
            self.free_places.insert(name.clone(), arg);
            self.free.push(FreeConstant { name, index });
        }
        Ok(arg)
    }

    /// Applies an operation, or returns the result if the formula has computed it already.
    pub(super) fn apply(&mut self, op: Op, args: &[Arg]) -> Result<Arg, String> {
        let instr = Instr::new(op, args);
        if let Some(&known) = self.results.get(&instr) {
            return Ok(known);
        }
        self.room(self.draft.instrs.len(), "operations")?;
        let result = self.draft.push(op, args);
        self.results.insert(instr, result);
        if let Some(holes) = &mut self.holes {
            holes.note(args);
        }
        Ok(result)
    }

    /// Writes out a formula over values of this one, and returns its first output.
    pub(super) fn write_out(&mut self, formula: &Parsed, inputs: &[Arg]) -> Result<Arg, String> {
        let program = &formula.program;
        let mut results = Vec::with_capacity(program.instrs.len());
        for instr in &program.instrs {
            let mut args = [Arg::Input(0); MAX_ARITY];
            for (to, &arg) in args.iter_mut().zip(instr.args()) {
                *to = self.written_out(arg, formula, inputs, &results)?;
            }
            results.push(self.apply(instr.op(), &args)?);
        }
        self.written_out(program.outputs[0], formula, inputs, &results)
    }

    fn written_out(
        &mut self,
        arg: Arg,
        formula: &Parsed,
        inputs: &[Arg],
        results: &[Arg],
    ) -> Result<Arg, String> {
        match arg {
            Arg::Input(index) => Ok(inputs[usize::from(index)]),
            Arg::Result(index) => Ok(results[usize::from(index)]),
            Arg::Const(index) => {
                let place = usize::from(index);
                let rounded = formula.program.consts[place];
                self.constant(Number { rounded, exact: formula.exact[place] })
            }
        }
    }

    /// Returns the outputs that are assigned, in order.
    pub(super) fn outputs_assigned(&self) -> Vec<String> {
        let assigned = self.names.outputs.iter().filter(|name| self.assigned.contains_key(*name));
        assigned.cloned().collect()
    }

    /// Ends a text with holes: their values are further inputs of the program.
    pub(super) fn finish_with_holes(mut self) -> Result<(Parsed, Holes), String> {
        let holes = self.holes.take().expect("it began with holes");
        let slots = holes.slots();
        let outputs = listed(&self.names.outputs);
        let parsed = self.finish_over(slots)?;
        let is_output = |name: &String| parsed.names.outputs.contains(name);
        if let Some(idle) = parsed.unread.iter().find(|name| !is_output(name)) {
            return Err(format!(
                "`{idle}` is no output of the data, and nothing reads it (outputs: {outputs})"
            ));
        }
        holes.check_used(&parsed.program)?;
        Ok((parsed, holes))
    }

    /// Ends with these values as the outputs.
    pub(super) fn finish_with(mut self, outputs: Value) -> Result<Program, String> {
        self.draft.inputs = self.draft.inputs.max(self.names.inputs.len());
        self.draft.outputs = outputs;
        if let Some(free) = self.free.first() {
            return Err(format!("`${}` stands in a function; give it a value", free.name));
        }
        Program::verify(self.draft).map_err(|invalid| invalid.to_string())
    }

    pub(super) fn finish(self) -> Result<Parsed, String> {
        self.finish_over(0)
    }

    fn finish_over(mut self, slots: usize) -> Result<Parsed, String> {
        if self.open && self.names.outputs.is_empty() {
            let unread = self.statements.iter().filter(|name| !self.read.contains(*name));
            self.names.outputs.extend(unread.cloned());
        }
        if self.names.outputs.is_empty() {
            return Err("the formula has no statement".to_owned());
        }
        self.draft.inputs = self.names.inputs.len() + slots;
        for output in &self.names.outputs {
            match self.assigned.get(output).map(Vec::as_slice) {
                Some([value]) => self.draft.outputs.push(*value),
                Some(vector) => {
                    let width = vector.len();
                    return Err(format!(
                        "output `{output}` is one value, but a vector of {width} is assigned to it"
                    ));
                }
                None => {
                    let hint = did_you_mean(output, self.assigned.keys().map(String::as_str));
                    return Err(format!("output `{output}` is never assigned{hint}"));
                }
            }
        }
        let program = Program::verify(self.draft).map_err(|invalid| invalid.to_string())?;
        self.statements.retain(|name| !self.read.contains(name));
        let (exact, unread) = (self.exact, self.statements);
        Ok(Parsed { program, names: self.names, exact, unread, free: self.free })
    }

    /// Checks that a program can hold one more.
    fn room(&self, count: usize, what: &str) -> Result<(), String> {
        if count < usize::from(u16::MAX) {
            return Ok(());
        }
        Err(format!("too many {what}; a formula has at most {}", u16::MAX))
    }
}

fn first_places(names: &[String]) -> HashMap<String, usize> {
    let mut places = HashMap::new();
    for (place, name) in names.iter().enumerate() {
        places.entry(name.clone()).or_insert(place);
    }
    places
}

/// Lists the first few names.
fn listed(names: &[String]) -> String {
    const SHOWN: usize = 20;
    let shown = names[..names.len().min(SHOWN)].join(", ");
    if names.len() > SHOWN { format!("{shown}, …") } else { shown }
}
