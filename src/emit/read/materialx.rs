//! MaterialX documents: a node's definition, and the graph of standard nodes that it is.

use super::lex::Comment;
use super::{Contract, Precision, Read, ReadBack, ReadError};
use crate::emit::Language;
use crate::emit::signature::returned_names;
use crate::op::Op;
use crate::program::{Arg, Draft, Names, Program, effective, use_counts};
use roxmltree::{Document, Node};
use std::collections::HashMap;

/// Reads the only graph of a document.
pub(super) fn read(text: &str) -> Read<ReadBack> {
    let document = Document::parse(text).map_err(|error| {
        let position = error.pos();
        let line = text.lines().nth(position.row as usize - 1).unwrap_or("");
        ReadError {
            line: position.row as usize,
            column: position.col as usize,
            message: error.to_string(),
            source_line: line.to_owned(),
        }
    })?;
    let root = document.root_element();
    let failed = |node: Node, message: String| failed(text, node, message);
    only_known(text, root)?;
    let elements = |name: &'static str| root.children().filter(move |node| node.has_tag_name(name));
    let graph = match elements("nodegraph").collect::<Vec<_>>().as_slice() {
        [graph] => *graph,
        graphs => {
            return failed(
                root,
                format!("{} graphs (`nodegraph`), where one is read", graphs.len()),
            );
        }
    };
    let definition = graph.attribute("nodedef").unwrap_or_default();
    let Some(definition) =
        elements("nodedef").find(|node| node.attribute("name") == Some(definition))
    else {
        return failed(graph, format!("no `nodedef` is called `{definition}`"));
    };
    let name_of = |node: &Node| node.attribute("name").unwrap_or_default().to_owned();
    let inputs: Vec<String> = definition
        .children()
        .filter(|node| node.has_tag_name("input"))
        .map(|n| name_of(&n))
        .collect();
    let declared: Vec<String> = definition
        .children()
        .filter(|node| node.has_tag_name("output"))
        .map(|n| name_of(&n))
        .collect();
    let mut reader = Graph {
        text,
        nodes: graph
            .children()
            .filter(Node::is_element)
            .map(|node| (name_of(&node), node))
            .collect(),
        draft: Draft { inputs: inputs.len(), ..Draft::default() },
        results: HashMap::new(),
        inputs,
        depth: 0,
    };
    let mut outputs = Vec::new();
    for output in graph.children().filter(|node| node.has_tag_name("output")) {
        let value = reader.source(output)?;
        reader.draft.outputs.push(value);
        outputs.push(name_of(&output));
    }
    if outputs != declared {
        let [outputs, declared] = [outputs, declared].map(|names| names.join(", "));
        return failed(
            graph,
            format!("its outputs are {outputs}, those of its definition {declared}"),
        );
    }
    let comments: Vec<Comment> = document
        .descendants()
        .filter(Node::is_comment)
        .map(|node| Comment { offset: node.range().start, text: node.text().unwrap_or("").trim() })
        .collect();
    let contract = Contract::of(text, &comments);
    let program =
        Program::verify(reader.draft).map_err(|error| ReadError::at(text, 0, error.to_string()))?;
    let mut counts = Vec::new();
    use_counts(&program, &mut counts);
    let program = effective(&program);
    let mut names = Names { inputs: reader.inputs, outputs };
    let written = names.clone();
    contract.restore(&mut names);
    let precisions = vec![Precision::Single; program.instrs.len()];
    let (variant, literal, language) = (None, None, Language::MaterialX);
    Ok(ReadBack {
        language,
        places: returned_names(names.outputs.len()),
        parameters: written.inputs.clone(),
        program,
        names,
        written,
        precisions,
        in_half: false,
        variant,
        literal,
        contract,
    })
}

fn failed<T>(text: &str, node: Node, message: String) -> Read<T> {
    Err(ReadError::at(text, node.range().start, message))
}

/// What a document may contain: elements and their attributes; all others are refused, as they may
/// mean something. Attributes that begin with `ui`, `doc` and places mean nothing for values.
const KNOWN: [(&str, &[&str]); 5] = [
    ("materialx", &["version"]),
    ("nodedef", &["name", "node", "nodegroup"]),
    ("nodegraph", &["name", "nodedef"]),
    ("input", &["name", "type", "value", "nodename", "interfacename"]),
    ("output", &["name", "type", "value", "nodename", "interfacename"]),
];

/// Refuses elements, attributes and double names that a document is not read with.
fn only_known(text: &str, root: Node) -> Read<()> {
    for node in root.descendants().filter(|node| node.is_text()) {
        if !node.text().unwrap_or_default().trim().is_empty() {
            return failed(text, node, "text between elements".to_owned());
        }
    }
    for node in root.descendants().filter(Node::is_element) {
        let tag = node.tag_name().name();
        let parent = node.parent_element().map_or("", |parent| parent.tag_name().name());
        let is_node = parent == "nodegraph" && !["input", "output"].contains(&tag);
        let known =
            KNOWN.iter().find(|(known, _)| *known == tag).map(|(_, attributes)| *attributes);
        let in_place = match parent {
            "" => tag == "materialx",
            "materialx" => ["nodedef", "nodegraph"].contains(&tag),
            "nodedef" | "nodegraph" => true,
            _ => tag == "input",
        };
        let attributes = if is_node { Some(&["name", "type"][..]) } else { known };
        let Some(attributes) = attributes.filter(|_| in_place) else {
            return failed(text, node, format!("`{tag}` is not read here"));
        };
        let means_nothing =
            |name: &str| name.starts_with("ui") || ["doc", "xpos", "ypos"].contains(&name);
        for attribute in node.attributes() {
            let name = attribute.name();
            if !attributes.contains(&name) && !means_nothing(name) {
                return failed(text, node, format!("the attribute `{name}` is not read here"));
            }
        }
        if parent == "nodedef" && node.attribute("type") != Some("float") {
            return failed(text, node, "not of type `float`".to_owned());
        }
        let bindings = ["value", "nodename", "interfacename"];
        let bound = bindings.iter().filter(|name| node.attribute(**name).is_some()).count();
        if bound > 1 {
            return failed(
                text,
                node,
                "more than one of value, nodename, interfacename".to_owned(),
            );
        }
        let name = node.attribute("name");
        let twice = |other: &Node| name.is_some() && other.attribute("name") == name;
        if node.prev_siblings().skip(1).filter(Node::is_element).any(|other| twice(&other)) {
            let name = name.unwrap_or_default();
            return failed(text, node, format!("`{name}` is there twice"));
        }
    }
    match root.attribute("version").unwrap_or_default() {
        version if version.starts_with("1.39") => Ok(()),
        version => failed(text, root, format!("version `{version}`, where 1.39 is read")),
    }
}

struct Graph<'a, 'input> {
    text: &'a str,
    /// Nodes by their names.
    nodes: HashMap<String, Node<'a, 'input>>,
    draft: Draft,
    /// The results of nodes that were read.
    results: HashMap<String, Arg>,
    inputs: Vec<String>,
    depth: usize,
}

/// A longer chain of nodes is refused, before the recursion can exhaust the stack.
const MAX_DEPTH: usize = 2000;

impl Graph<'_, '_> {
    fn failed<T>(&self, node: Node, message: String) -> Read<T> {
        failed(self.text, node, message)
    }

    /// Reads where an input or an output of the graph comes from.
    fn source(&mut self, input: Node) -> Read<Arg> {
        if input.attribute("type") != Some("float") {
            return self.failed(input, "not of type `float`".to_owned());
        }
        if let Some(name) = input.attribute("interfacename") {
            let place = self.inputs.iter().position(|input| input == name);
            return match place {
                Some(i) => Ok(Arg::Input(i as u16)),
                None => self.failed(input, format!("the definition has no input `{name}`")),
            };
        }
        if let Some(name) = input.attribute("nodename") {
            return self.result(name.to_owned(), input);
        }
        let value = input.attribute("value").unwrap_or_default().trim();
        match value.parse::<f32>() {
            Ok(value) if value.is_finite() => Ok(self.draft.constant(value)),
            _ => self.failed(input, format!("`{value}` is no number")),
        }
    }

    fn result(&mut self, name: String, reader: Node) -> Read<Arg> {
        if let Some(&known) = self.results.get(&name) {
            return Ok(known);
        }
        let Some(&node) = self.nodes.get(&name) else {
            return self.failed(reader, format!("no node is called `{name}`"));
        };
        if self.depth == MAX_DEPTH {
            return self
                .failed(node, format!("a chain of more than {MAX_DEPTH} nodes, or a circle"));
        }
        self.depth += 1;
        let result = self.node(node)?;
        self.depth -= 1;
        self.results.insert(name, result);
        Ok(result)
    }

    fn node(&mut self, node: Node) -> Read<Arg> {
        if node.attribute("type") != Some("float") {
            return self.failed(node, "a node that is not of type `float`".to_owned());
        }
        let (op, inputs): (Op, &[&str]) = match node.tag_name().name() {
            "add" => (Op::Add, &["in1", "in2"]),
            "subtract" => (Op::Sub, &["in1", "in2"]),
            "multiply" => (Op::Mul, &["in1", "in2"]),
            "divide" => (Op::Div, &["in1", "in2"]),
            "min" => (Op::Min, &["in1", "in2"]),
            "max" => (Op::Max, &["in1", "in2"]),
            "power" => (Op::Pow, &["in1", "in2"]),
            "absval" => (Op::Abs, &["in"]),
            "sqrt" => (Op::Sqrt, &["in"]),
            "exp" => (Op::Exp, &["in"]),
            "ln" => (Op::Log, &["in"]),
            "sin" => (Op::Sin, &["in"]),
            "cos" => (Op::Cos, &["in"]),
            "tan" => (Op::Tan, &["in"]),
            "asin" => (Op::Asin, &["in"]),
            "acos" => (Op::Acos, &["in"]),
            "atan2" => (Op::Atan2, &["iny", "inx"]),
            "floor" => (Op::Floor, &["in"]),
            "fract" => (Op::Fract, &["in"]),
            "sign" => (Op::Sign, &["in"]),
            "mix" => (Op::Lerp, &["bg", "fg", "mix"]),
            // The first where value1 is greater.
            "ifgreater" => (Op::Select, &["value2", "value1", "in1", "in2"]),
            "ifgreatereq" => (Op::Step, &["value2", "value1", "in1", "in2"]),
            "clamp" => (Op::Saturate, &["in", "low", "high"]),
            "dot" => (Op::Max, &["in"]),
            "constant" => (Op::Max, &["value"]),
            other => return self.failed(node, format!("the node `{other}` is not read")),
        };
        let names = node.children().filter(Node::is_element).filter_map(|n| n.attribute("name"));
        if let Some(other) = names.into_iter().find(|name| !inputs.contains(name)) {
            return self.failed(node, format!("the input `{other}` is not read here"));
        }
        match node.tag_name().name() {
            "ifgreatereq" => return self.step(node),
            "clamp" => return self.clamp(node),
            "dot" | "constant" => return self.input(node, inputs[0]),
            _ => {}
        }
        let args: Vec<Arg> =
            inputs.iter().map(|name| self.input(node, name)).collect::<Read<_>>()?;
        Ok(self.draft.push(op, &args))
    }

    fn input(&mut self, node: Node, name: &str) -> Read<Arg> {
        let input = node.children().find(|child| child.attribute("name") == Some(name));
        match input {
            Some(input) => self.source(input),
            None => self.failed(node, format!("the node has no input `{name}`")),
        }
    }

    fn step(&mut self, node: Node) -> Read<Arg> {
        let [edge, x] = [self.input(node, "value2")?, self.input(node, "value1")?];
        let [one, zero] = [self.input(node, "in1")?, self.input(node, "in2")?];
        if !self.is(one, 1.0) || !self.is(zero, 0.0) {
            return self.failed(node, "`ifgreatereq` between other values than 1 and 0".to_owned());
        }
        Ok(self.draft.push(Op::Step, &[edge, x]))
    }

    fn clamp(&mut self, node: Node) -> Read<Arg> {
        let [x, low, high] =
            [self.input(node, "in")?, self.input(node, "low")?, self.input(node, "high")?];
        if self.is(low, 0.0) && self.is(high, 1.0) {
            return Ok(self.draft.push(Op::Saturate, &[x]));
        }
        let raised = self.draft.push(Op::Max, &[x, low]);
        Ok(self.draft.push(Op::Min, &[raised, high]))
    }

    fn is(&self, arg: Arg, value: f32) -> bool {
        matches!(arg, Arg::Const(i) if self.draft.consts[usize::from(i)] == value)
    }
}
