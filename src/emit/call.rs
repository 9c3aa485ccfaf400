//! A program under another head: its inputs by other names, in another order, as components of
//! vectors, or computed from what is given; its outputs as what a caller expects.

use super::read::{call_line, let_line, name_line};
use super::signature::{Head, Signature, returned_names, vector_of, vectors};
use crate::program::{Arg, Draft, Names, ParseError, Program, effective, parse_expression};
use crate::suggest::did_you_mean;

/// What is said of inputs and results: `alpha = roughness*roughness` of a column, over parameters;
/// `return.x = bias` or `energy = scale + bias` of a result, over columns and parameters.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lets(Vec<(String, String)>);

/// A program as it is called.
#[derive(Clone, Debug)]
pub struct Call {
    /// The program, over the components of the parameters.
    pub program: Program,
    /// The names of these components and of the results.
    pub names: Names,
    /// The head.
    pub signature: Signature,
    /// The comment lines that say which column each component is, or how it is made.
    pub comments: Vec<String>,
}

/// A head that does not fit the program.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each message names its fields")]
pub enum CallError {
    /// A statement without `=`.
    #[error("`{text}`: expected `name = expression`, as in `alpha = roughness*roughness`")]
    NoStatement { text: String },
    /// Two statements of one name.
    #[error("`{name}` is given twice")]
    Twice { name: String },
    /// A column that no parameter is.
    #[error(
        "nothing says what `{column}` is: the parameters are {parameters}{hint}; rename one, or say it by \
         `--let \"{column} = …\"`"
    )]
    NoParameter { column: String, parameters: String, hint: String },
    /// A column that several parameters may be.
    #[error(
        "several parameters may be `{column}`: {parameters}; say which by `--let \"{column} = …\"`"
    )]
    Several { column: String, parameters: String },
    /// A statement about something else than a column or a result.
    #[error("`{target}` is neither an input ({inputs}) nor a result ({results}){hint}")]
    NoTarget { target: String, inputs: String, results: String, hint: String },
    /// An expression that cannot be read.
    #[error("`{target} = {text}`: {}", error.to_string().trim_start_matches("formula, line 1, "))]
    Expression { target: String, text: String, error: Box<ParseError> },
    /// A parameter that results leave by, which is called like no output.
    #[error(
        "nothing says what leaves by `{name}`: the outputs are {outputs}; say it by `--let \"{name} = …\"`"
    )]
    NoOutput { name: String, outputs: String },
    /// Other numbers of results than of outputs.
    #[error(
        "{}, but {} left for {} ({names}); say what {} by `--let \"{target} = {first}\"`",
        counted(*.returned, "value is", "values are") + " returned",
        counted(*.outputs, "output is", "outputs are"),
        if *.returned == 1 { "it" } else { "them" },
        if *.returned == 1 { "it is" } else { "they are" },
    )]
    Returned { returned: usize, outputs: usize, names: String, first: String, target: String },
    /// A function that gives no result.
    #[error("nothing is returned, and no result leaves by a parameter; the outputs are {outputs}")]
    NoResult { outputs: String },
    /// A value of another number of components than is said to be it.
    #[error(
        "`{target}` has {}, but is given {found}",
        counted(*.size, "component", "components")
    )]
    Width { target: String, size: usize, found: usize },
    /// No parameters make a column what it can be.
    #[error(
        "`{column} = {text}`: no values of the parameters make it one in [{low}, {high}], which is its domain"
    )]
    Unreachable { column: String, text: String, low: f64, high: f64 },
}

fn counted(count: usize, one: &str, several: &str) -> String {
    match count {
        0 => format!("no {one}"),
        1 => format!("1 {one}"),
        count => format!("{count} {several}"),
    }
}

impl Lets {
    /// Splits texts into statements, at `;` and line ends.
    ///
    /// # Errors
    /// [`CallError::NoStatement`], [`CallError::Twice`].
    pub fn parse(texts: &[String]) -> Result<Lets, CallError> {
        let mut lets = Lets::default();
        let statements = texts.iter().flat_map(|text| text.split([';', '\n']));
        for text in statements.map(str::trim).filter(|text| !text.is_empty()) {
            let no_statement = || CallError::NoStatement { text: text.to_owned() };
            let (target, expression) = text.split_once('=').ok_or_else(no_statement)?;
            let (target, expression) = (target.trim(), expression.trim());
            if target.is_empty() || expression.is_empty() {
                return Err(no_statement());
            }
            lets.add(target, expression.to_owned())?;
        }
        Ok(lets)
    }

    /// Adds a statement.
    ///
    /// # Errors
    /// [`CallError::Twice`].
    pub fn add(&mut self, target: &str, expression: String) -> Result<(), CallError> {
        if self.of(target).is_some() {
            return Err(CallError::Twice { name: target.to_owned() });
        }
        self.0.push((target.to_owned(), expression));
        Ok(())
    }

    /// Sets the expression of a name.
    pub fn set(&mut self, target: &str, expression: String) {
        self.0.retain(|(name, _)| name != target);
        self.0.push((target.to_owned(), expression));
    }

    /// Returns the expression of a name.
    pub fn of(&self, target: &str) -> Option<&str> {
        self.0.iter().find(|(name, _)| name == target).map(|(_, expression)| &**expression)
    }

    /// Returns what is said of a result: of itself, or of the vector that it is a component of.
    pub(super) fn about<'a>(&self, name: &'a str) -> Option<(&'a str, usize)> {
        let itself = || self.of(name).map(|_| (name, 0));
        itself().or_else(|| vector_of(name).filter(|(vector, _)| self.of(vector).is_some()))
    }

    fn target(&self, name: &str) -> Option<Target> {
        let (about, place) = self.about(name)?;
        Some(Target::Let { name: name.to_owned(), about: about.to_owned(), place })
    }

    /// Returns true if there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn lines(&self) -> impl Iterator<Item = String> {
        self.0.iter().map(|(target, expression)| let_line(target, expression))
    }
}

/// Puts the program under a head. `returned` is the number of values that it returns, or none if it
/// returns all outputs that nothing else takes.
///
/// # Errors
/// [`CallError`] says what does not fit, and how it can be said.
pub fn call(program: &Program, names: &Names, head: &Head, lets: &Lets) -> Result<Call, CallError> {
    let components: Vec<String> = head.components(false);
    let mut draft = Draft { inputs: components.len(), ..Draft::default() };
    let (inputs, mut comments) = inputs(&mut draft, program, names, head, lets)?;
    let outputs = draft.append(program, &inputs);
    let targets = targets(head, names, lets, &mut comments)?;
    known_targets(lets, names, head, &targets)?;
    let scope = Scope::default().and(&names.outputs, &outputs);
    let scope = scope.or(Scope::of_components(&components)).and(&names.inputs, &inputs);
    let mut results = Vec::new();
    // The statement that was read last, whose components follow each other.
    let mut said: Option<(String, Vec<Arg>)> = None;
    for target in &targets {
        let (value, name) = match target {
            Target::Output(output) => (outputs[*output], names.outputs[*output].clone()),
            Target::Let { name, about, place } => {
                if said.as_ref().is_none_or(|(known, _)| known != about) {
                    let text = lets.of(about).unwrap_or_default();
                    said = Some((about.clone(), scope.values(&mut draft, about, text)?));
                }
                let values = said.as_ref().map_or(&[][..], |(_, values)| values);
                let size = targets.iter().filter(|other| other.is_about(about)).count();
                (component(about, values, *place, size)?, name.clone())
            }
        };
        draft.outputs.push(value);
        results.push(name);
    }
    comments.extend(lets.lines());
    let parameters: Vec<&str> = head.parameters.iter().map(|one| one.name.as_str()).collect();
    comments.push(call_line(&head.function, &parameters));
    let out = head.parameters.iter().filter(|parameter| parameter.out);
    let returned = targets.len() - out.map(|parameter| parameter.size).sum::<usize>();
    let signature = Signature {
        function: head.function.clone(),
        qualifiers: head.qualifiers.clone(),
        parameters: head.parameters.clone(),
        returned,
    };
    let program = effective(&Program::verify(draft).expect("programs make a program"));
    let names = Names { inputs: components, outputs: results };
    Ok(Call { program, names, signature, comments })
}

/// What a result is.
#[derive(Clone, Debug, PartialEq)]
enum Target {
    Output(usize),
    /// What a statement says: about itself, or about the vector of which it is the component at
    /// this place.
    Let {
        name: String,
        about: String,
        place: usize,
    },
}

impl Target {
    fn is_about(&self, name: &str) -> bool {
        matches!(self, Target::Let { about, .. } if about == name)
    }
}

/// Returns the value of each column, and comments on those that are called otherwise.
fn inputs(
    draft: &mut Draft,
    program: &Program,
    names: &Names,
    head: &Head,
    lets: &Lets,
) -> Result<(Vec<Arg>, Vec<String>), CallError> {
    let used = reads(program);
    let components = &head.components(false);
    let (mut values, mut comments) = (Vec::new(), Vec::new());
    for (i, column) in names.inputs.iter().enumerate() {
        if let Some(text) = lets.of(column) {
            values.push(Scope::of_components(components).value(draft, column, text)?);
            continue;
        }
        let known = head.columns.iter().find(|(known, _)| known == column);
        let known = known.and_then(|(_, component)| place_of(component, components));
        let Some(place) = known.or_else(|| component_of(column, components)) else {
            // What nothing reads needs no value.
            if !used[i] {
                values.push(draft.constant(0.0));
                continue;
            }
            let alike = alike(column, components);
            if alike.len() > 1 {
                let (column, parameters) = (column.clone(), alike.join(", "));
                return Err(CallError::Several { column, parameters });
            }
            return Err(CallError::NoParameter {
                column: column.clone(),
                parameters: listed(components),
                hint: did_you_mean(column, components.iter().map(String::as_str)),
            });
        };
        values.push(Arg::Input(place as u16));
        if components[place] != *column {
            comments.push(name_line(&components[place], column));
        }
    }
    Ok((values, comments))
}

fn reads(program: &Program) -> Vec<bool> {
    let mut read = vec![false; program.inputs];
    let args = program.instrs.iter().flat_map(|instr| instr.args()).chain(&program.outputs);
    for arg in args {
        if let Arg::Input(i) = arg {
            read[usize::from(*i)] = true;
        }
    }
    read
}

fn place_of(name: &str, components: &[String]) -> Option<usize> {
    components.iter().position(|component| component == name)
}

/// Returns the component that is called as the column, or as such a quantity is called elsewhere.
pub(super) fn component_of(column: &str, components: &[String]) -> Option<usize> {
    place_of(column, components).or_else(|| match alike(column, components).as_slice() {
        [only] => place_of(only, components),
        _ => None,
    })
}

fn alike<'a>(column: &str, components: &'a [String]) -> Vec<&'a str> {
    let alike = components.iter().filter(|name| quantity(name) == quantity(column));
    alike.map(String::as_str).collect()
}

/// Returns the column that a parameter of this name is, if it is called as such a quantity is
/// elsewhere: `n_dot_v` for `NoV`.
pub fn column_called(parameter: &str, columns: &[String]) -> Option<String> {
    component_of(parameter, columns).map(|place| columns[place].clone())
}

/// Returns one name for the names that engines have for a quantity: `n_dot_v`, `NoV`, `dotNV`.
fn quantity(name: &str) -> String {
    let plain: String = name.to_ascii_lowercase().chars().filter(|c| *c != '_').collect();
    let plain = plain.strip_prefix("perceptual").map_or(plain.clone(), str::to_owned);
    match plain.strip_prefix("dot").map(str::as_bytes) {
        Some([a, b]) => format!("{}o{}", char::from(*a), char::from(*b)),
        _ => plain.replace("dot", "o"),
    }
}

/// Returns what each result is: first what is returned, then what leaves by parameters.
fn targets(
    head: &Head,
    names: &Names,
    lets: &Lets,
    comments: &mut Vec<String>,
) -> Result<Vec<Target>, CallError> {
    let outs = head.components(true);
    let mut left: Vec<usize> = (0..names.outputs.len()).collect();
    let mut by_parameters = Vec::new();
    for name in &outs {
        by_parameters.push(match (lets.target(name), component_of(name, &names.outputs)) {
            (Some(target), _) => target,
            (None, Some(output)) => {
                left.retain(|other| *other != output);
                if *name != names.outputs[output] {
                    comments.push(name_line(name, &names.outputs[output]));
                }
                Target::Output(output)
            }
            (None, None) => {
                let outputs = listed(&names.outputs);
                return Err(CallError::NoOutput { name: name.clone(), outputs });
            }
        });
    }
    let named = |count: usize| {
        let names = returned_names(count);
        names.iter().map(|name| lets.target(name)).collect::<Vec<_>>()
    };
    let count = head.returned.unwrap_or_else(|| {
        let itself = |name: &String| lets.of(name).is_some();
        let said = (1..=4).rev().find(|&n| returned_names(n).iter().all(itself));
        said.unwrap_or(left.len())
    });
    let said = named(count);
    // What is said of one is not left for the others.
    let named = |output: usize| {
        let is_it = |about: &str| lets.of(about) == Some(names.outputs[output].as_str());
        said.iter()
            .flatten()
            .any(|target| matches!(target, Target::Let { about, .. } if is_it(about)))
    };
    left.retain(|&output| !named(output));
    let unsaid = said.iter().filter(|target| target.is_none()).count();
    let returns_none = count == 0 && head.returned == Some(0);
    if (unsaid > 0 || said.is_empty()) && unsaid != left.len() && !returns_none {
        let places = returned_names(count.max(1));
        let place = said.iter().position(Option::is_none).unwrap_or(0);
        return Err(wrong_count(unsaid, &left, names, &places[place]));
    }
    let mut rest = left.iter();
    let mut targets: Vec<Target> = said
        .into_iter()
        .filter_map(|target| target.or_else(|| Some(Target::Output(*rest.next()?))))
        .collect();
    targets.extend(by_parameters);
    match targets.is_empty() {
        true => Err(CallError::NoResult { outputs: listed(&names.outputs) }),
        false => Ok(targets),
    }
}

fn wrong_count(returned: usize, left: &[usize], names: &Names, target: &str) -> CallError {
    let left_names: Vec<String> = left.iter().map(|&i| names.outputs[i].clone()).collect();
    CallError::Returned {
        returned,
        outputs: left.len(),
        names: listed(&left_names),
        first: names.outputs.first().cloned().unwrap_or_default(),
        target: target.to_owned(),
    }
}

/// Refuses statements about names that are nothing here.
fn known_targets(
    lets: &Lets,
    names: &Names,
    head: &Head,
    targets: &[Target],
) -> Result<(), CallError> {
    for (target, _) in &lets.0 {
        let is_input = names.inputs.contains(target);
        if is_input || targets.iter().any(|known| known.is_about(target)) {
            continue;
        }
        let count = targets.len() - head.components(true).len();
        let mut results = returned_names(count);
        results.extend(head.components(true));
        let known = names.inputs.iter().chain(&results).map(String::as_str);
        return Err(CallError::NoTarget {
            target: target.clone(),
            hint: did_you_mean(target, known),
            inputs: listed(&names.inputs),
            results: listed(&results),
        });
    }
    Ok(())
}

fn listed(names: &[String]) -> String {
    match names {
        [] => "none".to_owned(),
        names => names.join(", "),
    }
}

/// What an expression may read: names, each with its values.
#[derive(Default)]
struct Scope(Vec<(String, Vec<Arg>)>);

impl Scope {
    /// The parameters: values and vectors.
    fn of_components(components: &[String]) -> Scope {
        let mut next = 0;
        let vectors = vectors(components).into_iter().map(|(name, size)| {
            let values = (next..next + size).map(|i| Arg::Input(i as u16)).collect();
            next += size;
            (name, values)
        });
        Scope(vectors.collect())
    }

    /// Adds the names of another scope that are not known yet.
    fn or(mut self, other: Scope) -> Scope {
        let new = |(name, _): &(String, Vec<Arg>)| self.0.iter().all(|(known, _)| known != name);
        let new: Vec<_> = other.0.into_iter().filter(new).collect();
        self.0.extend(new);
        self
    }

    /// Adds names that are not known yet.
    fn and(self, names: &[String], values: &[Arg]) -> Scope {
        let named = names.iter().zip(values);
        self.or(Scope(named.map(|(name, value)| (name.clone(), vec![*value])).collect()))
    }

    /// Appends an expression to the draft, and returns its components.
    fn values(&self, draft: &mut Draft, target: &str, text: &str) -> Result<Vec<Arg>, CallError> {
        let vectors: Vec<(String, usize)> =
            self.0.iter().map(|(name, values)| (name.clone(), values.len())).collect();
        let failed = |error| CallError::Expression {
            target: target.to_owned(),
            text: text.to_owned(),
            error: Box::new(error),
        };
        let program = parse_expression(text, &vectors).map_err(failed)?;
        let values: Vec<Arg> = self.0.iter().flat_map(|(_, values)| values).copied().collect();
        Ok(draft.append(&program, &values))
    }

    /// Appends an expression of one value.
    fn value(&self, draft: &mut Draft, target: &str, text: &str) -> Result<Arg, CallError> {
        component(target, &self.values(draft, target, text)?, 0, 1)
    }
}

/// Returns the component of a value for a target of so many; a single value is each component.
fn component(target: &str, values: &[Arg], place: usize, size: usize) -> Result<Arg, CallError> {
    match values {
        [value] => Ok(*value),
        values if values.len() == size => Ok(values[place]),
        values => Err(CallError::Width { target: target.to_owned(), size, found: values.len() }),
    }
}

/// Returns an expression over components.
pub(super) fn value_over(
    target: &str,
    text: &str,
    components: &[String],
) -> Result<Program, CallError> {
    let mut draft = Draft { inputs: components.len(), ..Draft::default() };
    let value = Scope::of_components(components).value(&mut draft, target, text)?;
    draft.outputs.push(value);
    Ok(Program::verify(draft).expect("an expression makes a program"))
}
