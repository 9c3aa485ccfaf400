//! MaterialX: a node's definition and the graph of standard nodes that it is, for version 1.39.
//!
//! Standard nodes have no `exp2`, `log2`, reciprocals or `tanh`: powers, natural logarithms,
//! quotients and exponentials stand for them. There is no infinity and no NaN: the largest float
//! and 0 do. The library's generators write six decimals of a number: one that needs more is a
//! quotient.

use super::Snippet;
use super::header::header_lines;
use super::language::{Entry, Form};
use super::naming::Naming;
use super::signature::Signature;
use super::syntax::{decimal, is_word};
use crate::op::Op;
use crate::program::{Arg, use_counts};

pub(super) const LANGUAGE: Entry = Entry {
    name: "materialx",
    aliases: &["mtlx"],
    extension: "mtlx",
    form: Form::Graph,
    half: None,
};

/// An input of a node: a number, another node's result, or an input of the graph.
#[derive(Clone, Debug)]
enum Source {
    Number(f32),
    Node(String),
    Input(String),
}

/// Writes the snippet as a document.
pub(super) fn written(snippet: &Snippet, function: &str) -> String {
    let Snippet { program, names, .. } = *snippet;
    let signature = Signature::of(function, names, false);
    let mut naming = Naming::new(reserved, str::to_owned, &signature, &names.outputs);
    let head = naming.head(false);
    let mut graph = Graph { lines: Vec::new(), naming: &mut naming };
    let mut counts = Vec::new();
    use_counts(program, &mut counts);
    let mut results: Vec<Source> = Vec::new();
    for (instr, &count) in program.instrs.iter().zip(&counts) {
        let args: Vec<Source> = instr
            .args()
            .iter()
            .map(|&arg| source(arg, &program.consts, &head.inputs, &results))
            .collect();
        let value =
            if count == 0 { Source::Number(0.0) } else { graph.operation(instr.op(), &args) };
        results.push(value);
    }
    let outputs: Vec<(String, String)> = (head.outputs.iter().zip(&program.outputs))
        .map(|(name, &arg)| {
            let value = source(arg, &program.consts, &head.inputs, &results);
            (name.clone(), graph.node_of(value))
        })
        .collect();
    let nodes = graph.lines;
    let mut lines = vec!["<?xml version=\"1.0\"?>".to_owned()];
    if let Some(header) = snippet.header {
        let comments = header_lines(header).into_iter().chain(header_lines(&naming.renamed()));
        // Two hyphens end a comment.
        lines.extend(comments.map(|line| format!("<!-- {} -->", line.replace("--", "- -"))));
    }
    lines.push("<materialx version=\"1.39\">".to_owned());
    lines.push(format!("  <nodedef name=\"ND_{0}\" node=\"{0}\">", head.function));
    lines.extend(
        head.inputs
            .iter()
            .map(|name| format!("    <input name=\"{name}\" type=\"float\" value=\"0.5\" />")),
    );
    let output =
        |(name, _): &(String, String)| format!("    <output name=\"{name}\" type=\"float\" />");
    lines.extend(outputs.iter().map(output));
    lines.push("  </nodedef>".to_owned());
    lines.push(format!("  <nodegraph name=\"NG_{0}\" nodedef=\"ND_{0}\">", head.function));
    lines.extend(nodes);
    lines.extend(outputs.iter().map(|(name, node)| {
        format!("    <output name=\"{name}\" type=\"float\" nodename=\"{node}\" />")
    }));
    lines.push("  </nodegraph>".to_owned());
    lines.push("</materialx>".to_owned());
    lines.join("\n") + "\n"
}

fn source(arg: Arg, consts: &[f32], inputs: &[String], results: &[Source]) -> Source {
    match arg {
        Arg::Input(i) => Source::Input(inputs[usize::from(i)].clone()),
        Arg::Const(i) => Source::Number(consts[usize::from(i)]),
        Arg::Result(i) => results[usize::from(i)].clone(),
    }
}

struct Graph<'a, 'n> {
    lines: Vec<String>,
    naming: &'a mut Naming<'n>,
}

impl Graph<'_, '_> {
    /// Adds the nodes of an operation; what depends on numbers alone is a number.
    fn operation(&mut self, op: Op, args: &[Source]) -> Source {
        let numbers: Vec<f32> = args.iter().filter_map(Source::number).collect();
        if numbers.len() == args.len() {
            let mut values = [0.0; crate::op::MAX_ARITY];
            values[..numbers.len()].copy_from_slice(&numbers);
            return Source::Number(op.apply(values));
        }
        let one = Source::Number(1.0);
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| args.get(i).unwrap_or(&one));
        let two = |graph: &mut Self, node: &str, a: &Source, b: &Source| {
            graph.node(node, &[("in1", a), ("in2", b)])
        };
        match op {
            Op::Add => two(self, "add", a, b),
            Op::Sub => two(self, "subtract", a, b),
            Op::Mul => two(self, "multiply", a, b),
            Op::Div => two(self, "divide", a, b),
            Op::Min => two(self, "min", a, b),
            Op::Max => two(self, "max", a, b),
            Op::Pow => two(self, "power", a, b),
            Op::Neg => two(self, "multiply", a, &Source::Number(-1.0)),
            Op::Rcp => two(self, "divide", &one, a),
            Op::Exp2 => two(self, "power", &Source::Number(2.0), a),
            Op::Mad => {
                let product = two(self, "multiply", a, b);
                two(self, "add", &product, c)
            }
            Op::Rsqrt => {
                let root = self.node("sqrt", &[("in", a)]);
                two(self, "divide", &one, &root)
            }
            Op::Log2 => {
                let logarithm = self.node("ln", &[("in", a)]);
                two(self, "multiply", &logarithm, &Source::Number(std::f32::consts::LOG2_E))
            }
            Op::Fract => {
                let floor = self.node("floor", &[("in", a)]);
                two(self, "subtract", a, &floor)
            }
            Op::Tanh => self.tanh(a),
            Op::Saturate => {
                let (low, high) = (Source::Number(0.0), &one);
                self.node("clamp", &[("in", a), ("low", &low), ("high", high)])
            }
            Op::Atan => self.node("atan2", &[("iny", a), ("inx", &one)]),
            Op::Atan2 => self.node("atan2", &[("iny", a), ("inx", b)]),
            Op::Lerp => self.node("mix", &[("bg", a), ("fg", b), ("mix", c)]),
            Op::Step => {
                let zero = Source::Number(0.0);
                let inputs = [("value1", b), ("value2", a), ("in1", &one), ("in2", &zero)];
                self.node("ifgreatereq", &inputs)
            }
            Op::Select => {
                let inputs = [("value1", b), ("value2", a), ("in1", c), ("in2", d)];
                self.node("ifgreater", &inputs)
            }
            Op::Abs => self.node("absval", &[("in", a)]),
            Op::Sqrt => self.node("sqrt", &[("in", a)]),
            Op::Exp => self.node("exp", &[("in", a)]),
            Op::Log => self.node("ln", &[("in", a)]),
            Op::Sin => self.node("sin", &[("in", a)]),
            Op::Cos => self.node("cos", &[("in", a)]),
            Op::Tan => self.node("tan", &[("in", a)]),
            Op::Asin => self.node("asin", &[("in", a)]),
            Op::Acos => self.node("acos", &[("in", a)]),
            Op::Floor => self.node("floor", &[("in", a)]),
            Op::Sign => self.node("sign", &[("in", a)]),
        }
    }

    /// 1 - 2/(e^(2x) + 1)
    fn tanh(&mut self, x: &Source) -> Source {
        let [one, two] = [1.0, 2.0].map(Source::Number);
        let twice = self.node("multiply", &[("in1", x), ("in2", &two)]);
        let exponential = self.node("exp", &[("in", &twice)]);
        let above = self.node("add", &[("in1", &exponential), ("in2", &one)]);
        let quotient = self.node("divide", &[("in1", &two), ("in2", &above)]);
        self.node("subtract", &[("in1", &one), ("in2", &quotient)])
    }

    fn node(&mut self, category: &str, inputs: &[(&str, &Source)]) -> Source {
        let inputs: Vec<(&str, Source)> =
            inputs.iter().map(|&(input, source)| (input, self.exact(source))).collect();
        let name = self.naming.temporary();
        self.lines.push(format!("    <{category} name=\"{name}\" type=\"float\">"));
        for (input, source) in &inputs {
            let value = match source {
                Source::Number(value) => format!("value=\"{}\"", number(*value)),
                Source::Node(node) => format!("nodename=\"{node}\""),
                Source::Input(input) => format!("interfacename=\"{input}\""),
            };
            self.lines.push(format!("      <input name=\"{input}\" type=\"float\" {value} />"));
        }
        self.lines.push(format!("    </{category}>"));
        Source::Node(name)
    }

    /// Returns a number that six decimals do not tell from others as the quotient of two that they
    /// do, if there are such.
    fn exact(&mut self, source: &Source) -> Source {
        match source.number().and_then(quotient) {
            Some([a, b]) => {
                let [a, b] = [a, b].map(Source::Number);
                self.node("divide", &[("in1", &a), ("in2", &b)])
            }
            None => source.clone(),
        }
    }

    /// Returns the node whose result is the value: an output is of a node.
    fn node_of(&mut self, value: Source) -> String {
        let node = match self.exact(&value) {
            number @ Source::Number(_) => self.node("constant", &[("value", &number)]),
            input @ Source::Input(_) => self.node("dot", &[("in", &input)]),
            node => node,
        };
        match node {
            Source::Node(name) => name,
            _ => unreachable!("a node was made of it"),
        }
    }
}

impl Source {
    fn number(&self) -> Option<f32> {
        match self {
            Source::Number(value) => Some(*value),
            _ => None,
        }
    }
}

fn number(value: f32) -> String {
    decimal(finite(value))
}

fn finite(value: f32) -> f32 {
    if value.is_nan() { 0.0 } else { value.clamp(f32::MIN, f32::MAX) }
}

/// Returns two numbers of six decimals whose quotient is the value, if that has more.
fn quotient(value: f32) -> Option<[f32; 2]> {
    let value = finite(value);
    let in_six_decimals = |value: f64| format!("{value:.6}").parse::<f32>().ok();
    let is_exact = |value: f32| in_six_decimals(value.into()) == Some(value);
    if is_exact(value) {
        return None;
    }
    let quotients = (1..=38).filter_map(|power| {
        let scale = 10f32.powi(power);
        Some([in_six_decimals(f64::from(value) * f64::from(scale))?, scale])
    });
    let exact = |&[a, b]: &[f32; 2]| a.is_finite() && is_exact(a) && a / b == value;
    quotients.into_iter().find(exact)
}

/// Names that the code generated of a graph would not declare, in all its languages.
fn reserved(name: &str) -> bool {
    use crate::emit::{glsl, hlsl, msl, osl, wgsl};
    [glsl::SYNTAX, hlsl::SYNTAX, msl::SYNTAX, osl::SYNTAX, wgsl::SYNTAX]
        .iter()
        .any(|syntax| (syntax.reserved)(name))
        || is_word(NODES, name)
        || is_word("in in1 in2 low high value1 value2 iny inx bg fg mix value", name)
        || name.starts_with('_')
        || name.ends_with('_')
}

/// Nodes of the standard library (1.39.5, `stdlib_defs.mtlx`).
const NODES: &str = "absval acos add and asin atan2 bitangent blur bump burn ceil cellnoise2d cellnoise3d \
    checkerboard circle clamp cloverleaf colorcorrect combine2 combine3 combine4 constant \
    contrast convert cos creatematrix crosshatch crossproduct determinant difference \
    disjointover distance divide dodge dot dotproduct exp extract flake2d flake3d floor fract \
    fractal2d fractal3d frame geomcolor geompropvalue geompropvalueuniform grid heighttonormal \
    hexagon hextiledimage hextilednormalmap hsvadjust hsvtorgb ifequal ifgreater ifgreatereq \
    image in inside invert invertmatrix latlongimage line ln luminance magnitude mask matte max \
    min minus mix modulo multiply noise2d noise3d normal normalize normalmap not or out outside \
    over overlay place2d plus position power premult ramp ramp4 ramp_gradient ramplr ramptb \
    randomcolor randomfloat range reflect refract remap rgbtohsv rotate2d rotate3d round \
    safepower saturate screen separate2 separate3 separate4 sign sin smoothstep splitlr splittb \
    sqrt subtract surface_unlit surfacematerial switch tan tangent texcoord tiledcircles \
    tiledcloverleafs tiledhexagons tiledimage time transformmatrix transformnormal \
    transformpoint transformvector transpose trianglewave triplanarprojection unifiednoise2d \
    unifiednoise3d unpremult volumematerial worleynoise2d worleynoise3d xor";
