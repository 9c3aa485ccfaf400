//! Programs to emit.

use lgp::op::Op;
use lgp::program::{Arg, Draft, Names, Program};
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::path::Path;

/// Each operation once, those with constant arguments on a few of them.
pub const EVERY_OPERATION: &str = "a = saturate(mad(x, 3, -y)) + abs(x - y)*min(x, .5)/max(y, 1e-5); \
    b = rcp(x + 1) - sqrt(y)*rsqrt(y + 2) + exp2(-x) - log2(x + 1) + exp(y)*log(y + 3); \
    c = pow(x, 2.2) + sin(x)*cos(y) - tan(x/2) + asin(x)*acos(y) - atan(x) + atan2(y, x)*tanh(a); \
    d = lerp(x, y, a) - step(.5, x)*select(x < y, floor(b), fract(c)) + sign(x - .5)";

pub const SAMPLES: [[f32; 4]; 6] = [
    [0.3, 0.7, 0.1, 0.9],
    [0.0, -0.0, 1.0, 2.0],
    [-2.5, 1.0, -0.0, 3.0],
    [1e-30, 4e30, 7.5, -1e-40],
    [f32::NAN, 1.0, 0.5, 2.0],
    [f32::INFINITY, -1.0, 3.0, 1e10],
];

/// The operation on inputs, and on a constant in each place.
pub fn programs_of(op: Op) -> Vec<Program> {
    let inputs: Vec<Arg> = (0..4).map(Arg::Input).collect();
    let mut programs = Vec::new();
    for place in 0..=op.arity() {
        let mut draft = Draft { inputs: 4, ..Draft::default() };
        let mut args = inputs.clone();
        if place < op.arity() {
            args[place] = draft.constant(-0.75);
        }
        draft.outputs = vec![draft.push(op, &args)];
        programs.push(Program::verify(draft).unwrap());
    }
    programs
}

/// Names that mean something to one of the languages, or that none can declare.
const NASTY_NAMES: &str = "cos lambda half texture sample in out input output fn let ref gl_x a__b _ \
    __x float float3 vec2 vec2f mat3 saturate clamp rcp mad main line point matrix vector Texture2D \
    sampler2D const var return result t0 t1 infinity dfg dfg_outputs min16float int16_t precise \
    common packed buffer f32 i32 array bitcast frac fract lerp mix active from self target std \
    N·V 2d technique TECHNIQUE Pass double uint select and or sign step exp2 uintBitsToFloat \
    asfloat highp layout where shared patch linear noise1 dFdx static struct type x x_ X inverse \
    float3x3 dmat4x2 isampler2DArray smooth flat centroid mod move NULL None True def np yield unsafe \
    Some Self f32 INFINITY NAN sinf fminf y0 y1 gamma _Bool main_ metal threadgroup half3 \
    packed_float3 image1D image2D uimage3D iimageCube image2DMSArray image1DArray imageBuffer \
    image2DRect samplerCubeShadow imageLoad atomicAdd subpassInput M_PI_F FLT_MAX M_PI wchar_t _Atomic \
    InterlockedAdd device kernel as_type texture2d abs lambda_ loop match dyn complex and_eq int8_t";

pub fn nasty_columns() -> (Program, Names) {
    let inputs: Vec<&str> = NASTY_NAMES.split_whitespace().collect();
    let outputs = ["cos", "result", "texture", "infinity_bits", "float4", "half"];
    let mut draft = Draft { inputs: inputs.len(), ..Draft::default() };
    let mut sum = Arg::Input(0);
    for i in 1..inputs.len() {
        sum = draft.push(Op::Max, &[sum, Arg::Input(i as u16)]);
        sum = draft.push(Op::Cos, &[sum]);
    }
    let zero = draft.constant(0.0);
    let infinity = draft.push(Op::Rcp, &[zero]);
    sum = draft.push(Op::Min, &[sum, infinity]);
    draft.outputs = vec![sum, Arg::Result(3), Arg::Result(8), infinity, zero, Arg::Input(1)];
    (Program::verify(draft).unwrap(), Names::new(inputs, outputs))
}

/// The words of all lists of reserved words: each language's are names in the others.
pub fn words() -> BTreeSet<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/emit");
    let mut words = BTreeSet::new();
    for file in std::fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        let code = if path.is_file() { std::fs::read_to_string(path).unwrap() } else { continue };
        for list in code.split(": &str = \"").skip(1) {
            let list = list.split('"').next().expect("what is split has a first part");
            let plain = |word: &&str| word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
            words.extend(list.split_whitespace().filter(plain).map(str::to_owned));
        }
    }
    assert!(words.len() > 1000, "{}", words.len());
    words
}

/// Any operation, arguments taken modulo what exists, constants of every size and sign.
pub fn programs() -> impl Strategy<Value = Program> {
    let constant = prop_oneof![
        -10.0f32..10.0,
        Just(0.0),
        Just(-0.0),
        Just(1.0),
        Just(f32::MAX),
        prop::num::f32::NORMAL | prop::num::f32::SUBNORMAL,
    ];
    let instr = (0..Op::ALL.len(), prop::array::uniform4(0u16..1000));
    (
        prop::collection::vec(constant, 1..6),
        prop::collection::vec(instr, 1..40),
        prop::collection::vec(0u16..1000, 1..6),
    )
        .prop_map(|(consts, instrs, outputs)| {
            let mut draft = Draft { inputs: 2, consts, ..Draft::default() };
            let constants = draft.consts.len() as u16;
            let pick = |n: u16, earlier: u16| match n % (2 + constants + 4 * earlier) {
                k if k < 2 => Arg::Input(k),
                k if k < 2 + constants => Arg::Const(k - 2),
                k => Arg::Result((k - 2 - constants) / 4),
            };
            for (i, (op, args)) in instrs.into_iter().enumerate() {
                draft.push(Op::ALL[op], &args.map(|n| pick(n, i as u16)));
            }
            let instructions = draft.instrs.len() as u16;
            draft.outputs = outputs.into_iter().map(|n| pick(n, instructions)).collect();
            Program::verify(draft).expect("arguments are earlier ones")
        })
}

pub fn names(program: &Program) -> Names {
    let outputs = (0..program.outputs.len()).map(|i| format!("y{i}"));
    Names { inputs: vec!["n_dot_v".into(), "cos".into()], outputs: outputs.collect() }
}
