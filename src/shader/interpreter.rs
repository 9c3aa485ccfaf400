//! Interprets functions of a module: statements, calls, variables.

use super::budget::{MOST_KEPT, MOST_STEPS};
use super::machine::{Machine, Reason};
use super::paths::{Leaf, Paths, merged};
use super::value::{Pointer, Scalar, Value};
use naga::{
    AddressSpace, Block, Expression, Function, GlobalVariable, Handle, LocalVariable, Module, Span,
    Statement, SwitchValue, Type, TypeInner,
};

/// The most calls within each other. Shading languages have no recursion.
const DEEPEST_CALL: usize = 64;

/// The most blocks within each other, those of calls included: each takes some of the stack.
pub(super) const DEEPEST_BLOCK: usize = 400;

/// Why and where an evaluation stopped.
#[derive(Clone, Debug)]
pub(super) struct Stop {
    pub reason: Reason,
    pub span: Option<Span>,
}

impl From<Reason> for Stop {
    fn from(reason: Reason) -> Stop {
        Stop { reason, span: None }
    }
}

impl Stop {
    /// Adds the place, unless it is known from inside.
    pub fn at(self, span: Span) -> Stop {
        Stop { span: self.span.or(span.is_defined().then_some(span)), ..self }
    }
}

pub(super) type Step<T> = Result<T, Stop>;

/// How a block ended.
pub(super) enum Flow<M: Machine> {
    Next,
    Break,
    Continue,
    Return(Option<Value<M>>),
}

/// A call under way.
#[derive(Debug)]
pub(super) struct Frame<'a, M: Machine> {
    pub function: &'a Function,
    pub arguments: Vec<Value<M>>,
    pub locals: Vec<Value<M>>,
    /// The values of expressions, as far as they are evaluated.
    pub values: Vec<Option<Value<M>>>,
}

/// All variables at a time.
pub(super) struct Store<M: Machine> {
    pub globals: Vec<Value<M>>,
    pub locals: Vec<Vec<Value<M>>>,
}

/// An interpreter of one module.
pub(super) struct Interpreter<'a, 'm, M: Machine> {
    pub module: &'a Module,
    pub machine: &'m mut M,
    pub frames: Vec<Frame<'a, M>>,
    /// The module's global variables, then the places that the caller passes.
    pub globals: Vec<Value<M>>,
    /// The names of those places.
    pub places: Vec<String>,
    pub paths: Paths<M>,
    /// The values of the module's constants, as far as they were needed.
    pub constants: Vec<Option<Value<M>>>,
    pub steps: u64,
    pub most_steps: u64,
    /// The scalars in variables, and those in the variables that paths left behind.
    pub held: usize,
    pub kept: usize,
    /// The number of blocks and calls within each other.
    depth: usize,
}

impl<'a, 'm, M: Machine> Interpreter<'a, 'm, M> {
    /// Makes an interpreter; global variables have their initial values, and uniforms none.
    pub fn new(module: &'a Module, machine: &'m mut M) -> Step<Interpreter<'a, 'm, M>> {
        let mut new = Interpreter {
            module,
            machine,
            frames: Vec::new(),
            globals: Vec::new(),
            places: Vec::new(),
            paths: Paths::default(),
            constants: (0..module.constants.len()).map(|_| None).collect(),
            steps: 0,
            most_steps: MOST_STEPS,
            held: 0,
            kept: 0,
            depth: 0,
        };
        for (handle, global) in module.global_variables.iter() {
            let value = new.initial(global).and_then(|value| new.hold(&value).map(|()| value));
            let span = module.global_variables.get_span(handle);
            let value = value.map_err(|reason| Stop::from(reason).at(span))?;
            new.globals.push(value);
        }
        Ok(new)
    }

    /// Allows for so many steps.
    pub fn within(self, most_steps: u64) -> Self {
        Interpreter { most_steps, ..self }
    }

    fn initial(&mut self, global: &GlobalVariable) -> Result<Value<M>, Reason> {
        if let Some(init) = global.init {
            return self.constant(init);
        }
        match global.space {
            AddressSpace::Private | AddressSpace::WorkGroup => self.zero(global.ty),
            _ => self.unset(global.ty),
        }
    }

    /// Returns a value of a type in which nothing is set.
    pub fn unset(&mut self, ty: Handle<Type>) -> Result<Value<M>, Reason> {
        match &self.module.types[ty].inner {
            TypeInner::Image { .. } | TypeInner::Sampler { .. } => Ok(Value::Several(Vec::new())),
            // As many elements as are bound.
            TypeInner::Array { size: naga::ArraySize::Dynamic, .. } => {
                Ok(Value::Several(Vec::new()))
            }
            _ => self.zero(ty)?.map(&mut |_| Ok(Scalar::Unset)),
        }
    }

    /// Calls a function; in a machine that knows not all values, on every path through it.
    pub fn call(
        &mut self,
        function: &'a Function,
        arguments: Vec<Value<M>>,
    ) -> Step<Option<Value<M>>> {
        if self.frames.len() >= DEEPEST_CALL {
            let name = function.name.as_deref().unwrap_or("a function");
            return Err(format!("`{name}` is called {DEEPEST_CALL} deep: recursion").into());
        }
        if !M::SYMBOLIC {
            return self.called(function, arguments);
        }
        let before = self.store()?;
        self.paths.begin();
        let mut leaves = Vec::new();
        let kept = self.kept;
        loop {
            self.restore(&before);
            let result = self.called(function, arguments.clone())?;
            let decisions = self.paths.taken();
            self.kept += self.held;
            if self.kept > MOST_KEPT {
                return Err("it has too many paths for such large variables".to_owned().into());
            }
            leaves.push(Leaf { decisions, result, store: self.store()? });
            if !self.paths.next()? {
                break;
            }
        }
        self.paths.end();
        self.kept = kept;
        let Leaf { result, store, .. } = merged(self.machine, leaves, 0)?;
        self.restore(&store);
        Ok(result)
    }

    fn called(
        &mut self,
        function: &'a Function,
        arguments: Vec<Value<M>>,
    ) -> Step<Option<Value<M>>> {
        self.enter(function, arguments)?;
        let flow = self.block(&function.body)?;
        self.leave();
        match flow {
            Flow::Return(value) => Ok(value),
            _ => Ok(None),
        }
    }

    /// Returns the value that an expression has at the end of a function without branches.
    pub fn value_in(
        &mut self,
        function: &'a Function,
        arguments: Vec<Value<M>>,
        expression: Handle<Expression>,
    ) -> Step<Value<M>> {
        self.enter(function, arguments)?;
        self.block(&function.body)?;
        let value = self.value(expression);
        self.leave();
        value
    }

    fn enter(&mut self, function: &'a Function, arguments: Vec<Value<M>>) -> Step<()> {
        let values = (0..function.expressions.len()).map(|_| None).collect();
        self.frames.push(Frame { function, arguments, locals: Vec::new(), values });
        for (handle, local) in function.local_variables.iter() {
            let span = function.local_variables.get_span(handle);
            let value = self.initial_local(local).map_err(|stop| stop.at(span))?;
            self.hold(&value).map_err(|reason| Stop::from(reason).at(span))?;
            self.frame().locals.push(value);
        }
        Ok(())
    }

    fn initial_local(&mut self, local: &LocalVariable) -> Step<Value<M>> {
        match local.init {
            Some(init) => self.value(init),
            None => Ok(self.zero(local.ty)?),
        }
    }

    /// Returns the current call.
    pub fn frame(&mut self) -> &mut Frame<'a, M> {
        self.frames.last_mut().expect("a call is under way")
    }

    fn block(&mut self, block: &'a Block) -> Step<Flow<M>> {
        self.depth += 1;
        if self.depth > DEEPEST_BLOCK {
            return Err(
                format!("blocks and calls are nested more than {DEEPEST_BLOCK} deep").into()
            );
        }
        let flow = self.statements(block);
        self.depth -= 1;
        flow
    }

    fn statements(&mut self, block: &'a Block) -> Step<Flow<M>> {
        for (statement, &span) in block.span_iter() {
            self.step().map_err(|reason| Stop::from(reason).at(span))?;
            match self.statement(statement).map_err(|stop| stop.at(span))? {
                Flow::Next => {}
                other => return Ok(other),
            }
        }
        Ok(Flow::Next)
    }

    fn statement(&mut self, statement: &'a Statement) -> Step<Flow<M>> {
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    self.step()?;
                    let value = self.expression(handle)?;
                    self.keep(handle, value)?;
                }
            }
            Statement::Block(block) => return self.block(block),
            Statement::If { condition, accept, reject } => {
                let condition = self.value(*condition)?.scalar()?.boolean()?;
                return self.branch(condition, accept, reject);
            }
            Statement::Switch { selector, cases } => {
                let selector = self.value(*selector)?.scalar()?.integer()?;
                let is_it = |value: SwitchValue| match value {
                    SwitchValue::I32(value) => i64::from(value) == selector,
                    SwitchValue::U32(value) => i64::from(value) == selector,
                    SwitchValue::Default => false,
                };
                let chosen = cases.iter().position(|case| is_it(case.value));
                let default = || cases.iter().position(|case| case.value == SwitchValue::Default);
                for case in cases.iter().skip(chosen.or_else(default).unwrap_or(cases.len())) {
                    match self.block(&case.body)? {
                        Flow::Next if case.fall_through => {}
                        Flow::Next | Flow::Break => break,
                        other => return Ok(other),
                    }
                }
            }
            Statement::Loop { body, continuing, break_if } => {
                return self.repeat(body, continuing, *break_if);
            }
            Statement::Break => return Ok(Flow::Break),
            Statement::Continue => return Ok(Flow::Continue),
            Statement::Return { value } => {
                let value = value.map(|value| self.value(value)).transpose()?;
                return Ok(Flow::Return(value));
            }
            Statement::Store { pointer, value } => {
                let (pointer, value) = (self.pointer(*pointer)?, self.value(*value)?);
                self.variable(&pointer).store(&pointer.path, value)?;
            }
            Statement::Call { function, arguments, result } => {
                let function = &self.module.functions[*function];
                let arguments = arguments.iter().map(|&argument| self.value(argument));
                let arguments = arguments.collect::<Step<Vec<_>>>()?;
                let returned = self.call(function, arguments)?;
                if let (Some(result), Some(returned)) = (result, returned) {
                    self.keep(*result, returned)?;
                }
            }
            // Of one invocation, barriers mean nothing.
            Statement::ControlBarrier(_) | Statement::MemoryBarrier(_) => {}
            Statement::Kill => {
                return Err("it discards the fragment; approximate what it returns"
                    .to_owned()
                    .into());
            }
            Statement::ImageStore { .. } | Statement::ImageAtomic { .. } => {
                return Err("it writes to a texture; return the value instead".to_owned().into());
            }
            Statement::Atomic { .. }
            | Statement::WorkGroupUniformLoad { .. }
            | Statement::SubgroupBallot { .. }
            | Statement::SubgroupGather { .. }
            | Statement::SubgroupCollectiveOperation { .. }
            | Statement::CooperativeStore { .. } => {
                let reason = "it depends on other invocations; approximate a function of values";
                return Err(reason.to_owned().into());
            }
            Statement::RayQuery { .. } | Statement::RayPipelineFunction(_) => {
                return Err("it traces rays; import a table of its results".to_owned().into());
            }
        }
        Ok(Flow::Next)
    }

    fn branch(
        &mut self,
        condition: M::Bool,
        accept: &'a Block,
        reject: &'a Block,
    ) -> Step<Flow<M>> {
        if let Some(decided) = self.machine.decided(condition) {
            return self.block(if decided { accept } else { reject });
        }
        if may_leave(accept) || may_leave(reject) {
            let taken = self.paths.decide(condition);
            return self.block(if taken { accept } else { reject });
        }
        let before = self.store()?;
        self.block(accept)?;
        let yes = self.store()?;
        self.restore(&before);
        self.block(reject)?;
        let no = self.store()?;
        let either = yes.or(no, self.machine, condition)?;
        self.restore(&either);
        Ok(Flow::Next)
    }

    fn repeat(
        &mut self,
        body: &'a Block,
        continuing: &'a Block,
        break_if: Option<Handle<Expression>>,
    ) -> Step<Flow<M>> {
        loop {
            self.step()?;
            match self.block(body)? {
                Flow::Next | Flow::Continue => {}
                Flow::Break => return Ok(Flow::Next),
                returned @ Flow::Return(_) => return Ok(returned),
            }
            self.block(continuing)?;
            if let Some(condition) = break_if {
                let condition = self.value(condition)?.scalar()?.boolean()?;
                let decided = self.machine.decided(condition);
                if decided.unwrap_or_else(|| self.paths.decide(condition)) {
                    return Ok(Flow::Next);
                }
            }
        }
    }

    /// Returns the variable that a pointer points into.
    pub fn variable(&mut self, pointer: &Pointer) -> &mut Value<M> {
        match pointer.frame {
            Some(frame) => &mut self.frames[frame].locals[pointer.variable],
            None => &mut self.globals[pointer.variable],
        }
    }
}

/// Returns true if a block may end otherwise than by its end.
fn may_leave(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Break | Statement::Continue | Statement::Return { .. } | Statement::Kill => true,
        Statement::Block(block) => may_leave(block),
        Statement::If { accept, reject, .. } => may_leave(accept) || may_leave(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|case| may_leave(&case.body)),
        // Its own `break` ends no more than it; but conditions in it may be undecided.
        Statement::Loop { .. } => true,
        _ => false,
    })
}
