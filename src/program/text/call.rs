//! Calls: of operations, of functions that the text defines, of holes.

use super::definitions::HoleCall;
use super::functions::{self, Function, OfVectors};
use super::lex::Token;
use super::syntax::{Frame, Parse, Parser, Value, common_width};
use crate::op::Op;
use crate::program::Arg;
use crate::suggest::did_you_mean;

/// A function that a text defines: `name(parameter, …) = body`.
pub(super) struct Written {
    pub(super) parameters: Vec<String>,
    /// The index of the body's first token.
    pub(super) body: usize,
    /// The byte offset of the definition.
    pub(super) start: usize,
    pub(super) is_called: bool,
}

/// The most calls of a text's own functions that are written out: each may call others twice.
const MAX_CALLS: usize = 20_000;

impl Parser<'_> {
    /// Parses an expression of which so many components are wanted: a hole or a matrix that is all
    /// of it, or of an argument of the operation that is all of it, has as many.
    pub(super) fn wanting(&mut self, width: usize) -> Parse<Value> {
        let at = self.tokens.offset();
        if width > 1 && self.tokens.after_call().is_some() {
            match self.tokens.peek().cloned() {
                Some(Token::Free(name)) => {
                    self.tokens.skip(2);
                    return self.matrix(&name, at, Some(width));
                }
                Some(Token::Name(name)) => {
                    self.tokens.skip(2);
                    return self.nested(|parser| parser.call(&name, at, width));
                }
                _ => {}
            }
        }
        self.expression()
    }

    fn is_hole(&self, name: &str) -> bool {
        self.definitions.has_holes()
            && !self.written.contains_key(name)
            && functions::names().all(|known| known != name)
    }

    /// Parses the rest of a call, from its arguments on, of which so many components are wanted.
    pub(super) fn call(&mut self, name: &str, at: usize, width: usize) -> Parse<Value> {
        if let "add" | "sub" | "mul" | "div" | "neg" = name {
            let message = format!("`{name}` has no function form; write + - * /");
            return self.tokens.error(at, message);
        }
        if name == Op::Select.name() {
            return self.select();
        }
        if self.written.contains_key(name) {
            return self.written_function(name, at);
        }
        if self.is_hole(name) {
            return self.hole(name, at, width);
        }
        let Some(function) = Function::find(name) else {
            let mut known: Vec<&str> = functions::names().collect();
            known.extend(self.written.keys().map(String::as_str));
            let hint = did_you_mean(name, known);
            return self.tokens.error(at, format!("unknown operation `{name}`{hint}"));
        };
        let args = self.arguments(width)?;
        let function = function.of_arguments(args.len());
        self.check_count(name, at, args.len(), function.arity())?;
        match function {
            Function::Operation(op) => self.apply(op, &args),
            Function::Formula(formula) => {
                let width = self.tokens.placed(at, common_width(&args))?;
                let component =
                    |place: usize| self.definitions.write_out(&formula, &components(&args, place));
                let result = (0..width).map(component).collect();
                self.tokens.placed(at, result)
            }
            Function::OfVectors(_) if args.iter().any(|value| value.len() < 2) => {
                let message = format!("`{name}` is of vectors, not of single values");
                self.tokens.error(at, message)
            }
            Function::OfVectors(OfVectors::Dot) => self.dot(&args[0], &args[1]),
            Function::OfVectors(OfVectors::Length) => {
                let square = self.dot(&args[0], &args[0])?;
                self.apply(Op::Sqrt, &[square])
            }
            Function::OfVectors(OfVectors::Normalize) => {
                let square = self.dot(&args[0], &args[0])?;
                let scale = self.apply(Op::Rsqrt, &[square])?;
                self.apply(Op::Mul, &[args[0].clone(), scale])
            }
        }
    }

    fn dot(&mut self, a: &Value, b: &Value) -> Parse<Value> {
        let products = self.apply(Op::Mul, &[a.clone(), b.clone()])?;
        let (&first, others) = products.split_first().expect("a value has a component");
        let add = |sum, &product| self.apply(Op::Add, &[sum, vec![product]]);
        others.iter().try_fold(vec![first], add)
    }

    fn check_count(&self, name: &str, at: usize, given: usize, wanted: usize) -> Parse<()> {
        if given == wanted {
            return Ok(());
        }
        let plural = if wanted == 1 { "" } else { "s" };
        let message = format!("`{name}` takes {wanted} argument{plural}, not {given}");
        self.tokens.error(at, message)
    }

    /// Parses arguments, of each of which so many components are wanted.
    fn arguments(&mut self, width: usize) -> Parse<Vec<Value>> {
        let mut args = vec![self.wanting(width)?];
        while self.tokens.take_symbol(',') {
            args.push(self.wanting(width)?);
        }
        self.tokens.expect(')', "after the arguments")?;
        Ok(args)
    }

    /// Writes a function of the text out over its arguments. A vector that is its only argument is
    /// taken for as many parameters as it has components.
    fn written_function(&mut self, name: &str, at: usize) -> Parse<Value> {
        let parameters = self.written[name].parameters.clone();
        let is_only = self.tokens.after_call() == Some(&Token::Symbol(')'));
        let mut args = match is_only {
            true => {
                let only = self.wanting(parameters.len())?;
                self.tokens.expect(')', "after the arguments")?;
                vec![only]
            }
            false => self.arguments(1)?,
        };
        if let [vector] = args.as_slice()
            && parameters.len() > 1
            && vector.len() == parameters.len()
        {
            args = vector.iter().map(|&component| vec![component]).collect();
        }
        self.check_count(name, at, args.len(), parameters.len())?;
        let call = (name.to_owned(), args);
        if let Some(known) = self.returned.get(&call) {
            return Ok(known.clone());
        }
        let (name, args) = call.clone();
        let value = self.write_out(name, at, parameters.into_iter().zip(args).collect())?;
        self.returned.insert(call, value.clone());
        Ok(value)
    }

    /// Returns the value of a function of the text over the first so many inputs.
    pub(super) fn defined(&mut self, name: &str, inputs: usize) -> Parse<Value> {
        let written = &self.written[name];
        let (at, parameters) = (written.start, written.parameters.clone());
        let arguments = (0..inputs).map(|input| vec![Arg::Input(input as u16)]);
        self.write_out(name.to_owned(), at, parameters.into_iter().zip(arguments).collect())
    }

    fn write_out(&mut self, name: String, at: usize, values: Vec<(String, Value)>) -> Parse<Value> {
        let is_under_way = |frame: &Frame| frame.function.as_ref() == Some(&name);
        if self.frames.iter().any(is_under_way) {
            let message =
                format!("`{name}` is defined by itself; a definition cannot be recursive");
            return self.tokens.error(at, message);
        }
        if self.returned.len() >= MAX_CALLS {
            let message = format!("more than {MAX_CALLS} calls of functions that the text defines");
            return self.tokens.error(at, message);
        }
        let written = self.written.get_mut(&name).expect("it was found");
        written.is_called = true;
        let behind = self.tokens.go_to(written.body);
        self.frames.push(Frame { function: Some(name), values });
        let value = self.nested(Parser::expression)?;
        self.check_ended()?;
        self.frames.pop();
        self.tokens.go_to(behind);
        Ok(value)
    }

    /// Parses the arguments of a hole, and returns its values there: so many of single arguments,
    /// or one for each component of vectors.
    fn hole(&mut self, name: &str, at: usize, width: usize) -> Parse<Value> {
        if self.tokens.peek() == Some(&Token::Symbol(')')) {
            let message = format!("`{name}` has no argument; write `${name}` for a constant");
            return self.tokens.error(at, message);
        }
        let named = self.tokens.names_of_arguments();
        let args = self.arguments(1)?;
        let components_of_arguments = self.tokens.placed(at, common_width(&args))?;
        let (calls, values) = match components_of_arguments {
            1 => (1, width),
            several => (several, 1),
        };
        let component = |place: usize| {
            let (args, named) = (components(&args, place), named.clone());
            self.definitions.hole(HoleCall { name, args, named, values })
        };
        let result: Result<Vec<Value>, String> = (0..calls).map(component).collect();
        Ok(self.tokens.placed(at, result)?.concat())
    }

    /// Parses the arguments of a matrix of free constants, whose entries are called by row and
    /// column, and returns its product with them; it is square unless so many rows are wanted.
    pub(super) fn matrix(&mut self, name: &str, at: usize, rows: Option<usize>) -> Parse<Value> {
        let vector = self.arguments(1)?.concat();
        let rows = rows.unwrap_or(vector.len());
        if vector.len() < 2 || rows > MAX_WIDTH || vector.len() > MAX_WIDTH {
            let message = format!(
                "a matrix, as `${name}(x, y)`, takes 2 to {MAX_WIDTH} values; `${name}*x` is a product, and `f((x, y))` has a value for each of x, y"
            );
            return self.tokens.error(at, message);
        }
        let mut product = Vec::with_capacity(rows);
        for row in 0..rows {
            let mut sum: Option<Value> = None;
            for (column, &component) in vector.iter().enumerate() {
                let entry = format!("{name}{}{}", row + 1, column + 1);
                let start = Some(if row == column { 1.0 } else { 0.0 });
                let entry = self.tokens.placed(at, self.definitions.free_constant(entry, start))?;
                let term = self.apply(Op::Mul, &[vec![entry], vec![component]])?;
                sum = Some(match sum {
                    Some(sum) => self.apply(Op::Add, &[sum, term])?,
                    None => term,
                });
            }
            product.extend(sum.unwrap_or_default());
        }
        Ok(product)
    }
}

/// The most components that a matrix takes or gives: its entries are called by two digits.
const MAX_WIDTH: usize = 9;

/// Returns the components of this place; single values are the same at each.
fn components(values: &[Value], place: usize) -> Vec<Arg> {
    values.iter().map(|value| value[place % value.len()]).collect()
}
