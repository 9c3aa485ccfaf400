//! The text of a formula: what is read is printed, and read again is the same; it is evaluated, costed,
//! simplified and written in every language.
#![no_main]

use lgp::cost::Profile;
use lgp::emit::{Language, Snippet, emit, emit_half};
use lgp::program::{Draft, Program, effective, parse, parse_open, print};
use lgp::simplify::Simplifier;
use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;

static PROFILE: LazyLock<Profile> = LazyLock::new(|| Profile::find("gcn").expect("built in"));
const VALUES: [f32; 9] = [0.0, -0.0, 1.0, -1.5, 1e-40, f32::MAX, f32::MIN, f32::INFINITY, f32::NAN];

fuzz_target!(|content: &[u8]| {
    let Ok(text) = std::str::from_utf8(content) else { return };
    let Ok(read) = parse_open(text, &[]) else { return };
    // A template's constants are not printed by name, and `y = x + y` has an input and an output `y`.
    let twice = read.names.outputs.iter().any(|name| read.names.inputs.contains(name));
    if twice || !read.free.is_empty() {
        return;
    }
    let (program, names) = (read.program, read.names);
    let printed = print(&program, &names);
    let again = parse(&printed, &names).expect("what was printed can be read");
    let small = effective(&program);
    let mut simple = Draft::default();
    Simplifier::default().simplify(&program.clone().into_draft(), &mut simple);
    let simple = Program::verify(simple).expect("what is simplified is a program");
    for shift in 0..VALUES.len() {
        let inputs: Vec<f32> =
            (0..program.inputs).map(|i| VALUES[(i + shift) % VALUES.len()]).collect();
        let values = program.evaluate(&inputs);
        for other in [&again, &small] {
            let bits = |values: &[f32]| -> Vec<u32> {
                let bits = |v: &f32| if v.is_nan() { f32::NAN.to_bits() } else { v.to_bits() };
                values.iter().map(bits).collect()
            };
            assert_eq!(bits(&other.evaluate(&inputs)), bits(&values), "{text:?}, {printed:?}");
        }
        assert_eq!(simple.evaluate(&inputs).len(), values.len());
    }
    let cost = PROFILE.cost(&program);
    assert!(cost.cycles >= 0.0, "{text:?} costs {}", cost.cycles);
    let snippet = Snippet::new(&program, &names, "f");
    for &language in Language::ALL {
        emit(language, &snippet);
        emit_half(language, &snippet, &[]);
    }
});
