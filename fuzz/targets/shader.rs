//! A function in a shading language, the first byte saying which: what is read back is written in the same
//! language, and read again is the same function.
#![no_main]

use lgp::emit::{Language, ReadBack, Snippet, emit, read_back};
use libfuzzer_sys::fuzz_target;

/// Those in which what is written computes the same bits: all infinities, and one order of terms.
const LANGUAGES: [Language; 5] =
    [Language::Hlsl, Language::Wgsl, Language::Glsl, Language::Msl, Language::Slang];

const VALUES: [f32; 6] = [0.0, 1.0, -1.5, 0.3, 7.25, 1e20];

fuzz_target!(|content: &[u8]| {
    let Some((first, rest)) = content.split_first() else { return };
    let Ok(text) = std::str::from_utf8(rest) else { return };
    let language = LANGUAGES[usize::from(*first) % LANGUAGES.len()];
    let Ok(ReadBack { program, names, .. }) = read_back(language, text) else { return };
    let snippet = Snippet::new(&program, &names, "f");
    let written = emit(language, &snippet);
    let again = read_back(language, &written)
        .unwrap_or_else(|error| panic!("what was written can be read: {error}\n{written}"))
        .program;
    assert_eq!((again.inputs, again.outputs.len()), (program.inputs, program.outputs.len()));
    for shift in 0..VALUES.len() {
        let inputs: Vec<f32> =
            (0..program.inputs).map(|i| VALUES[(i + shift) % VALUES.len()]).collect();
        for (a, b) in program.evaluate(&inputs).iter().zip(&again.evaluate(&inputs)) {
            assert!(
                a == b || a.is_nan() && b.is_nan(),
                "{a} and {b} at {inputs:?}\n{text}\n{written}"
            );
        }
    }
});
