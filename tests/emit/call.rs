//! Functions under heads of any order, names and vectors compute what the program computes.

use crate::bits;
use crate::programs::{SAMPLES, names, programs};
use lgp::emit::{
    Arguments, Head, Language, Lets, Parameter, Snippet, call, emit, emit_half, read_back,
    read_head,
};
use lgp::op::Op;
use lgp::program::{Names, Program};
use proptest::prelude::*;
use proptest::sample::Index;

const WITH_VECTORS: [Language; 7] = [
    Language::Hlsl,
    Language::Glsl,
    Language::GlslEs,
    Language::Msl,
    Language::Slang,
    Language::Wgsl,
    Language::Cuda,
];

/// What the parameters may be called, none of which any language reserves.
const NAMES: [&str; 8] = ["uv", "rough", "nov", "p", "q", "envArgs", "k_1", "Zeta"];

/// Random choices of a head.
#[derive(Clone, Debug)]
struct Choices {
    /// The sizes of parameters, until all components have a place.
    sizes: Vec<usize>,
    names: Vec<&'static str>,
    /// The places of inputs among the components.
    places: Vec<Index>,
    /// The output that each result is.
    results: Vec<Index>,
    /// True where results leave by parameters.
    by_parameters: bool,
    /// Factors by which parameters are multiplied; exact, so that values stay the same.
    scales: Vec<bool>,
}

fn choices() -> impl Strategy<Value = Choices> {
    (
        prop::collection::vec(1usize..=4, 4),
        Just(NAMES.to_vec()).prop_shuffle(),
        prop::collection::vec(any::<Index>(), 4),
        prop::collection::vec(any::<Index>(), 1..=4),
        any::<bool>(),
        prop::collection::vec(any::<bool>(), 4),
    )
        .prop_map(|(sizes, names, places, results, by_parameters, scales)| Choices {
            sizes,
            names,
            places,
            results,
            by_parameters,
            scales,
        })
}

/// A head, and what says which component each column is, and which output each result.
fn head(choices: &Choices, columns: &Names) -> (Head, Lets) {
    let parameter = |(name, size): (&&str, &usize)| Parameter {
        name: (*name).to_owned(),
        size: *size,
        out: false,
        qualifiers: String::new(),
    };
    let mut parameters: Vec<Parameter> =
        choices.names.iter().zip(&choices.sizes).map(parameter).collect();
    let mut components: Vec<String> = parameters.iter().flat_map(Parameter::components).collect();
    let mut lets = Lets::default();
    for ((column, place), scaled) in columns.inputs.iter().zip(&choices.places).zip(&choices.scales)
    {
        let component = components.remove(place.index(components.len()));
        let expression = if *scaled { format!("4*{component}") } else { component };
        lets.add(column, expression).unwrap();
    }
    let count = choices.results.len();
    let by_parameters = choices.by_parameters;
    let (name, qualifiers) = ("found".to_owned(), String::new());
    let out = Parameter { name, size: count, out: true, qualifiers };
    let returned = if by_parameters { 0 } else { count };
    let targets = match (by_parameters, count) {
        (true, _) => out.components(),
        (false, 1) => vec!["return".to_owned()],
        (false, _) => ["x", "y", "z", "w"][..count].iter().map(|c| format!("return.{c}")).collect(),
    };
    if by_parameters {
        parameters.push(out);
    }
    for (target, output) in targets.iter().zip(&choices.results) {
        let output = &columns.outputs[output.index(columns.outputs.len())];
        lets.add(target, output.clone()).unwrap();
    }
    let (function, qualifiers, columns) = ("adapted".to_owned(), None, Vec::new());
    (Head { function, qualifiers, parameters, returned: Some(returned), columns }, lets)
}

/// The head as the language writes it, by way of a function under it.
fn written_head(code: &str) -> String {
    let line =
        code.lines().find(|line| line.contains("adapted(") && !line.starts_with("//")).unwrap();
    line.trim_end_matches('{').to_owned()
}

/// Without multiply-adds, which some languages round twice.
fn exact(program: &Program) -> bool {
    program.instrs.iter().all(|instr| instr.op() != Op::Mad)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_order_names_and_swizzles_give_the_same_values(
        program in programs().prop_filter("exact", exact),
        choices in choices(),
    ) {
        let columns = Names {
            inputs: vec!["n_dot_v".to_owned(), "alpha".to_owned()],
            outputs: names(&program).outputs,
        };
        for language in WITH_VECTORS {
            let (head, lets) = head(&choices, &columns);
            let called = call(&program, &columns, &head, &lets).unwrap();
            let snippet = Snippet::new(&called.program, &called.names, "unused");
            let snippet = snippet.signature(&called.signature).header(&called.comments);
            let code = emit(language, &snippet);
            let read = read_back(language, &code);
            let read = read.map_err(|e| TestCaseError::fail(format!("{code}\n{e}")))?;
            let components = &read.written.inputs;
            let arguments = Arguments::of(components, &columns.inputs, &[], &lets).unwrap();
            for sample in SAMPLES.iter().filter(|sample| sample[..2].iter().all(|x| x.abs() < 4.0)) {
                let point = arguments.at(&sample[..2], 0).unwrap();
                let expected = program.evaluate(&sample[..2]);
                let expected: Vec<f32> = choices.results.iter()
                    .map(|output| expected[output.index(expected.len())]).collect();
                // A component may be found with an error of rounding, where a formula may jump.
                let back: Vec<f32> = components_of(&lets, &columns, components, &point);
                if back == sample[..2] {
                    prop_assert_eq!(bits(&read.evaluate(&point)), bits(&expected), "{}", code);
                }
            }
            // What was written is a head that can be asked for.
            let (again, _) = read_head(language, &written_head(&code)).unwrap();
            prop_assert_eq!(&again.parameters, &head.parameters, "{}", code);
            prop_assert_eq!(again.returned, head.returned, "{}", code);
        }
    }

    #[test]
    fn halves_under_any_head_are_read_back(program in programs(), choices in choices()) {
        let columns = Names {
            inputs: vec!["n_dot_v".to_owned(), "alpha".to_owned()],
            outputs: names(&program).outputs,
        };
        for language in WITH_VECTORS {
            // A vector of halves has two components there.
            let sizes = |head: &Head| head.parameters.iter().all(|parameter| parameter.size <= 2);
            let (head, lets) = head(&choices, &columns);
            if language == Language::Cuda && (!sizes(&head) || head.returned > Some(2)) {
                continue;
            }
            let called = call(&program, &columns, &head, &lets).unwrap();
            let snippet = Snippet::new(&called.program, &called.names, "unused");
            let snippet = snippet.signature(&called.signature);
            let code = emit_half(language, &snippet, &[]).unwrap();
            let read = read_back(language, &code);
            let read = read.map_err(|e| TestCaseError::fail(format!("{code}\n{e}")))?;
            let literal = read.literal.as_deref().cloned();
            let read = if read.is(&called.program) { read } else { literal.unwrap_or(read) };
            prop_assert!(read.in_half && read.is(&called.program), "{}", code);
        }
    }
}

/// The columns' values at a point of the components.
fn components_of(lets: &Lets, columns: &Names, components: &[String], point: &[f32]) -> Vec<f32> {
    let value = |column: &String| {
        let text = lets.of(column).unwrap();
        let (factor, name) = match text.strip_prefix("4*") {
            Some(name) => (4.0, name),
            None => (1.0, text),
        };
        factor * point[components.iter().position(|other| other == name).unwrap()]
    };
    columns.inputs.iter().map(value).collect()
}
