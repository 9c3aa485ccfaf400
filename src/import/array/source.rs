//! Arrays of numbers in source files: C and C++, shading languages, JavaScript, Rust, Python, JSON.

use super::error::{counted, times};
use super::list::{Numbers, Reader, skip_parameters};
use super::shape::Shape;
use super::text::text;
use super::tokens::{Token, Tokens};
use super::{Array, Fault, Request, Scalar, which_array};
use half::f16;

pub(super) const EXTENSIONS: &[&str] = &[
    "h", "hh", "hpp", "hxx", "inc", "inl", "c", "cc", "cpp", "cxx", "hlsl", "hlsli", "fx", "fxh",
    "usf", "ush", "cginc", "glsl", "vert", "frag", "comp", "wgsl", "metal", "slang", "js", "mjs",
    "cjs", "ts", "json", "rs", "py", "cs", "java", "swift", "kt", "lua", "go",
];

/// The most bytes of a source file. By hand: numbers take ten bytes each, and a table of 512² texels
/// of four channels then fits.
const LONGEST: usize = 64 << 20;

/// The most tokens of a declaration that are kept, to find its name. By hand.
const LONGEST_DECLARATION: usize = 64;

pub(super) fn read(content: &[u8], request: &Request) -> Result<Array, Fault> {
    if content.len() > LONGEST {
        let problem = format!("a source file longer than {} MiB", LONGEST >> 20);
        return Err(Fault::new(
            problem,
            "write its numbers as .npy, or raw with --size and --format",
        ));
    }
    let text = text(content)?;
    let mut found = arrays(text);
    let good: Vec<&Found> = found.iter().filter(|found| found.numbers.is_ok()).collect();
    let names: Vec<String> = good.iter().map(|found| found.name.clone()).collect();
    let chosen = match &request.array {
        Some(asked) => found.iter().position(|found| found.name == *asked),
        None if good.len() == 1 => found.iter().position(|found| found.numbers.is_ok()),
        None if good.is_empty() && !found.is_empty() => Some(0),
        None => None,
    };
    if let Some(chosen) = chosen {
        let Found { name, declared, numbers } = found.swap_remove(chosen);
        return array(&name, declared, numbers?, request);
    }
    match found.is_empty() {
        false => Err(which_array("arrays", &names, request)),
        true => {
            let reader = Reader::new(Tokens::new(text));
            array("", Vec::new(), reader.all()?, request)
        }
    }
}

/// Makes an array of an array's numbers, and of the dimensions that its declaration has.
fn array(
    name: &str,
    declared: Vec<usize>,
    numbers: Numbers,
    request: &Request,
) -> Result<Array, Fault> {
    let Numbers { mut dimensions, mut values } = numbers;
    let is_flat = dimensions.iter().filter(|&&along| along != 1).count() == 1;
    let fits =
        declared.iter().try_fold(1usize, |n, &along| n.checked_mul(along)) == Some(values.len());
    if is_flat && fits {
        dimensions = declared;
    }
    let shape = match &request.size {
        Some(size) => Shape::of_size(size, request.axes)?,
        None => Shape::of_dimensions(&dimensions, request.axes)?,
    };
    if shape.values() != values.len() {
        let problem = format!(
            "{} of {}, and --size {}",
            counted(values.len(), "number"),
            times(&dimensions),
            times(request.size.as_deref().unwrap_or(&[]))
        );
        return Err(Fault::new(problem, "give a size of as many, or leave it out"));
    }
    let mut notes = Vec::new();
    match request.format {
        Some(Scalar::F16) => {
            values = halves(&values)?;
            notes.push("integers taken as the bits of 16-bit floats".to_owned());
        }
        Some(_) => {
            let problem = "the numbers of a source file have no --format, except integers that are the bits of f16";
            return Err(Fault::new(problem, "leave --format out"));
        }
        None => {}
    }
    if shape.size.len() == 1
        && shape.channels == 1
        && request.size.is_none()
        && request.axes.is_none()
    {
        notes.push(format!(
            "a flat list of {}: --size 8x8x2, for example, says that it is 8 × 8 texels of 2 channels",
            values.len()
        ));
    }
    let of = if name.is_empty() { String::new() } else { format!(" `{name}`") };
    Ok(Array {
        kind: format!("array{of} of a source file, {} numbers", times(&dimensions)),
        channels: Array::unnamed_channels(shape.channels),
        size: shape.size,
        values,
        notes,
        ..Array::default()
    })
}

fn halves(values: &[f32]) -> Result<Vec<f32>, Fault> {
    let half = |&value: &f32| {
        let bits = value as u16;
        (f32::from(bits) == value).then(|| f16::from_bits(bits).to_f32())
    };
    values.iter().map(half).collect::<Option<_>>().ok_or_else(|| {
        let problem =
            "--format f16 takes integers from 0 to 65535 as bits, and there are other numbers";
        Fault::new(problem, "leave --format out")
    })
}

/// An array that a file holds.
struct Found {
    name: String,
    /// The dimensions in its declaration, `[8][8]`, if they are numbers.
    declared: Vec<usize>,
    numbers: Result<Numbers, Fault>,
}

/// Finds what is set to more than one number. Lists with something in them that is no number are
/// among what is found, unless that is the first.
fn arrays(text: &str) -> Vec<Found> {
    let mut found = Vec::new();
    let mut tokens = Tokens::new(text);
    let mut before: Vec<(usize, Token)> = Vec::new();
    let mut brackets = 0usize;
    while let Some((line, token)) = tokens.next() {
        let is_named = matches!(before.last(), Some((_, Token::Word(_) | Token::Quoted(_))));
        let is_value = token == Token::Mark("=") || (token == Token::Mark(":") && is_named);
        if is_value && let Some((after, numbers)) = value(tokens.clone()) {
            let (name, declared) = declaration(&before);
            // What was read as a list is not looked through again.
            tokens = if numbers.is_ok() { after } else { tokens };
            found.push(Found { name, declared, numbers });
            before.clear();
            brackets = 0;
            continue;
        }
        match token {
            Token::Open('[') => brackets += 1,
            Token::Close(']') => brackets = brackets.saturating_sub(1),
            _ => {}
        }
        let ends = match token {
            Token::Mark(";") => brackets == 0,
            Token::Mark(",") => {
                brackets == 0 && before.iter().all(|(_, token)| *token != Token::Mark("<"))
            }
            Token::Open('{') | Token::Close('}') => true,
            _ => before.len() > LONGEST_DECLARATION,
        };
        if ends {
            before.clear();
            brackets = 0;
        } else {
            before.push((line, token));
        }
    }
    found
}

/// Returns the name that a declaration gives, and its dimensions: of what stands before a colon of
/// the same line (in Python, one may end the line before), or before brackets at the end.
fn declaration(before: &[(usize, Token)]) -> (String, Vec<usize>) {
    let last_line = before.last().map_or(0, |(line, _)| *line);
    let is_colon =
        |(line, token): &(usize, Token)| *token == Token::Mark(":") && *line == last_line;
    let colon = before.iter().position(is_colon).unwrap_or(before.len());
    let tokens: Vec<Token> = before[..colon].iter().map(|(_, token)| *token).collect();
    let mut left = tokens.as_slice();
    let mut declared = Vec::new();
    while let [rest @ .., Token::Open('['), Token::Number(along), Token::Close(']')] = left {
        declared.insert(0, *along as usize);
        left = rest;
    }
    while let [rest @ .., Token::Close(']')] = left {
        let open = rest.iter().rposition(|token| *token == Token::Open('['));
        left = &rest[..open.unwrap_or(0)];
        declared.clear();
    }
    match left.last() {
        Some(Token::Word(name) | Token::Quoted(name)) => ((*name).to_owned(), declared),
        _ => (String::new(), declared),
    }
}

/// Reads a value that is a list with a number in it, and returns what follows it.
fn value(mut tokens: Tokens) -> Option<(Tokens, Result<Numbers, Fault>)> {
    let mut after_word = false;
    loop {
        let (_, token) = tokens.next()?;
        match token {
            // Types, constructors and macros: `new Float32Array([`, `&vec![`, `np.array([`.
            Token::Word(_) | Token::Mark("." | "::" | "!" | "&") => {}
            Token::Mark("<") => skip_parameters(&mut tokens)?,
            Token::Open('[') if after_word && is_type(tokens.clone()) => {
                tokens.find(|(_, token)| *token == Token::Close(']'))?;
            }
            Token::Open('(') if matches!(tokens.clone().next()?.1, Token::Open('[' | '{')) => {}
            Token::Open(_) => break,
            _ => return None,
        }
        after_word = matches!(token, Token::Word(_) | Token::Open('['));
    }
    let mut reader = Reader::new(tokens);
    match reader.elements(1) {
        Ok(_) if reader.values.len() < 2 => None,
        Ok(dimensions) => Some((reader.tokens, Ok(Numbers { dimensions, values: reader.values }))),
        Err(_) if reader.values.is_empty() => None,
        Err(fault) => Some((reader.tokens, Err(fault))),
    }
}

/// Whether brackets are of a type, `float[64](` or `new float[,] {`, and not of a list.
fn is_type(tokens: Tokens) -> bool {
    let mut inside = tokens.skip_while(|(_, token)| {
        matches!(token, Token::Number(_) | Token::Word(_) | Token::Mark(","))
    });
    let closed = inside.next().map(|(_, token)| token) == Some(Token::Close(']'));
    closed && matches!(inside.next(), Some((_, Token::Open(_))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Array, Fault> {
        read(text.as_bytes(), &Request::default())
    }

    fn named(text: &str, name: &str) -> Result<Array, Fault> {
        read(text.as_bytes(), &Request { array: Some(name.into()), ..Request::default() })
    }

    #[test]
    fn one_table_in_many_languages_is_the_same() {
        for text in [
            "static const float T[2][3] = { { 1, 2.0f, 3. }, { -4, +5, .6e1f }, };",
            "static const float T[6] = { 1, 2, 3, -4, 5, 6 };\n",
            "constexpr float T[2][3] = { 1, 2, 3, -4, 5, 6 };",
            "std::array<std::array<float, 3>, 2> T = {{ {1,2,3}, {-4,5,6} }};",
            "const T = new Float32Array([1, 2, 3, -4, 5, 6]);",
            "export const T = [[1,2,3],[-4,5,6]];",
            "pub static T: [[f32; 3]; 2] = [[1.0_f32, 2., 3.], [-4., 5., 6.]];",
            "let T: &'static [f32] = &[1., 2., 3., -4., 5., 6.];",
            "const T = array<vec3<f32>, 2>(vec3<f32>(1, 2, 3), vec3f(-4, 5, 6));",
            "const float[] T = float[](1., 2., 3., -4., 5., 6.);",
            "const vec3 T[2] = vec3[2](vec3(1, 2, 3), vec3(-4, 5, 6));",
            "static const float3 T[] = { float3(1, 2, 3), float3(-4, 5, 6) };",
            "half T[] = { half(1), half(2), half(3), half(-4), half(5), half(6) };",
            "float[,] T = new float[2, 3] { {1, 2, 3}, {-4, 5, 6} };",
            "static final float[][] T = new float[][] {{1, 2, 3}, {-4, 5, 6}};",
            "import numpy as np\nT = np.array([[1, 2, 3], [-4, 5, 6]], dtype=np.float32) # end",
            "{\"name\": \"x\", \"T\": [[1, 2, 3], [-4, 5, 6]]}",
            "T = { 1, 2, 3, -4, 5, 6 }",
            "#pragma once\n// 7, 8\nint n = 6; const char* s = \"= {1, 2}\";\nfloat T[] = {1,2,3,/*9,*/-4,5,6};",
        ] {
            let array = named(text, "T").unwrap_or_else(|fault| panic!("{text}: {fault}"));
            assert_eq!(array.values, [1.0, 2.0, 3.0, -4.0, 5.0, 6.0], "{text}");
            let nested = array.size == [2] && array.channels.len() == 3;
            assert!(nested || array.size == [6], "{text}: {:?}", array.size);
        }
    }

    #[test]
    fn files_that_are_only_numbers_are_read() {
        for text in ["1, 2,\n3, 4,", "{1, 2}, {3, 4}", "[[1, 2], [3, 4]]", "{{1,2},{3,4}};"] {
            assert_eq!(parsed(text).unwrap().values, [1.0, 2.0, 3.0, 4.0], "{text}");
        }
    }

    #[test]
    fn which_of_several_is_asked_for_by_name() {
        let text = "float a[] = {1, 2}; float b[2] = {3, 4};";
        assert_eq!(named(text, "b").unwrap().values, [3.0, 4.0]);
        let refused = parsed(text).unwrap_err().to_string();
        assert!(refused.contains("a, b") && refused.contains("--array"), "{refused}");
        let refused = named(text, "bb").unwrap_err().to_string();
        assert!(refused.contains("did you mean `b`"), "{refused}");
    }

    #[test]
    fn halves_are_taken_from_their_bits() {
        let request = Request { format: Some(Scalar::F16), ..Request::default() };
        let text = b"const DATA = new Uint16Array([0x3c00, 0x3800, 0xbc00]);";
        assert_eq!(read(text, &request).unwrap().values, [1.0, 0.5, -1.0]);
        assert!(read(b"float a[] = {0.5, 1};", &request).is_err());
    }

    #[test]
    fn what_is_no_array_of_numbers_is_refused_with_its_line() {
        for (text, says) in [
            ("int main() { return 0; }", "no array"),
            ("", "no array"),
            ("float a[] = { 1,\n 2, M_PI };", "line 2: `M_PI`"),
            ("float a[] = { 1.0/3.0, 2 };", "line 1: `/`"),
            ("float a[] = { 1, 2", "ends within a list"),
            ("float a[2][2] = { {1, 2},\n {3} };", "line 2: an element of 1 numbers"),
            ("float a[] = { 1, {2, 3} };", "an element of 2 numbers"),
            ("float a[] = { 1, 1e39 };", "too large"),
            ("float a[] = { 1 2 };", "line 1: `2`"),
            ("a = [[[[[[[[[1, 2]]]]]]]]]; b = [1, x]", "`x`"),
        ] {
            let refused = parsed(text).unwrap_err().to_string();
            assert!(refused.contains(says), "{text:?}: {refused}");
        }
    }
}
