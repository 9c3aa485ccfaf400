//! CUDA C++: a function for device and host.

use super::c;
use super::c_family;
use super::language::{Entry, Form};
use super::syntax::{Readable, Spelling, Syntax, WrittenHead, atom, half_decimal, is_word, sum};
use crate::op::Op;

pub(super) const LANGUAGE: Entry = Entry {
    name: "cuda",
    aliases: &["cu"],
    extension: "cu",
    form: Form::Function(&SYNTAX),
    half: Some(&HALF),
};

pub(super) const SYNTAX: Syntax = Syntax {
    types: &["float", "float2", "float3", "float4"],
    constructors: &["float", "make_float2", "make_float3", "make_float4"],
    spelling,
    reserved,
    out_parameter: Some(|of, name| format!("{of} &{name}")),
    out_by_pointer: false,
    open: |syntax, head, lines| {
        open(syntax, head, "__host__ __device__ inline", lines);
    },
    readable: Readable {
        lines: &["#include <cuda_fp16.h>"],
        of_functions: &["__host__", "__device__", "__forceinline__", "inline", "static"],
        ..c::SYNTAX.readable
    },
    ..c::SYNTAX
};

/// Half precision, with `cuda_fp16.h`, on the device: the host has no functions of halves.
pub(super) const HALF: Syntax = Syntax {
    types: &["__half", "__half2"],
    constructors: &["__half", "__halves2half2"],
    spelling: half_spelling,
    half: true,
    literal: |value| format!("__half({}f)", half_decimal(value)),
    non_finite: |name, _, bits| {
        vec![format!("const __half {name} = __half({});", c::non_finite(bits))]
    },
    open: |syntax, head, lines| {
        lines.extend(["#include <cuda_fp16.h>".to_owned(), String::new()]);
        open(syntax, head, "__device__ inline", lines);
    },
    ..SYNTAX
};

fn spelling(op: Op) -> Spelling {
    match op {
        Op::Rsqrt => atom("rsqrtf({a})"),
        op => (c::SYNTAX.spelling)(op),
    }
}

/// What has no function of halves is computed in single precision.
fn half_spelling(op: Op) -> Spelling {
    match op {
        Op::Abs => atom("__habs({a})"),
        Op::Min => atom("__hmin({a}, {b})"),
        Op::Max => atom("__hmax({a}, {b})"),
        Op::Saturate => atom("__hmin(__hmax({a}, __half(0.0f)), __half(1.0f))"),
        Op::Mad => atom("__hfma({a}, {b}, {c})"),
        Op::Rcp => atom("hrcp({a})"),
        Op::Sqrt => atom("hsqrt({a})"),
        Op::Rsqrt => atom("hrsqrt({a})"),
        Op::Exp2 => atom("hexp2({a})"),
        Op::Log2 => atom("hlog2({a})"),
        Op::Exp => atom("hexp({a})"),
        Op::Log => atom("hlog({a})"),
        Op::Pow => atom("__half(powf(float({a}), float({b})))"),
        Op::Sin => atom("hsin({a})"),
        Op::Cos => atom("hcos({a})"),
        Op::Tan => atom("__half(tanf(float({a})))"),
        Op::Asin => atom("__half(asinf(float({a})))"),
        Op::Acos => atom("__half(acosf(float({a})))"),
        Op::Atan => atom("__half(atanf(float({a})))"),
        Op::Atan2 => atom("__half(atan2f(float({a}), float({b})))"),
        Op::Tanh => atom("__half(tanhf(float({a})))"),
        Op::Lerp => atom("__hfma({c}, {b+} - {a*}, {a})"),
        Op::Step => atom("(({b+} >= {a+}) ? __half(1.0f) : __half(0.0f))"),
        Op::Select => atom("(({a+} < {b+}) ? {c+} : {d+})"),
        Op::Floor => atom("hfloor({a})"),
        Op::Fract => sum("{a+} - hfloor({a})"),
        Op::Sign => atom(
            "(({a+} > __half(0.0f)) ? __half(1.0f) : ({a+} < __half(0.0f)) ? __half(-1.0f) : {a+})",
        ),
        op => c_family::spelling(op),
    }
}

fn open(syntax: &Syntax, head: &WrittenHead, kind: &str, lines: &mut Vec<String>) {
    let from = lines.len();
    c_family::open(syntax, head, lines);
    let first = lines[from..].iter().position(|line| line.ends_with(") {")).expect("a first line");
    if head.qualifiers.is_none() {
        lines[from + first].insert_str(0, &format!("{kind} "));
    }
}

fn reserved(name: &str) -> bool {
    (c::SYNTAX.reserved)(name)
        || is_word(WORDS, name)
        || name.starts_with("make_")
        || name.starts_with("cuda")
        || is_vector(name)
}

/// Returns true for `float2`, `uchar4`, `dim3`, and so on.
fn is_vector(name: &str) -> bool {
    let scalar = name.trim_end_matches(|c: char| ('1'..='4').contains(&c));
    scalar != name
        && is_word(
            "char uchar short ushort int uint long ulong longlong ulonglong float double half dim",
            scalar,
        )
}

/// Types, variables and functions that the compiler declares beside those of C (CUDA C++ Programming Guide 12,
/// §10; `cuda_fp16.h`).
const WORDS: &str = "half half2 nv_half nv_half2 threadIdx blockIdx blockDim gridDim warpSize rsqrt \
    rsqrtf rcbrt rcbrtf saturate norm normf norm3d norm3df norm4d norm4df rnorm rnormf rhypot \
    rhypotf sincospi sincospif sinpi sinpif cospi cospif erfinv erfinvf erfcinv erfcinvf erfcx \
    erfcxf normcdf normcdff normcdfinv normcdfinvf cyl_bessel_i0 cyl_bessel_i0f cyl_bessel_i1 \
    cyl_bessel_i1f hsin hcos hexp hexp2 hexp10 hlog hlog2 hlog10 hsqrt hrsqrt hrcp hfloor hceil \
    hrint htrunc h2sin h2cos h2exp h2exp2 h2exp10 h2log h2log2 h2log10 h2sqrt h2rsqrt h2rcp h2floor \
    h2ceil h2rint h2trunc clock clock64 nanosleep min max umin umax llmin llmax ullmin ullmax \
    abs labs llabs fdividef fdivide assert malloc free memcpy memset printf atomicAdd atomicSub \
    atomicExch atomicMin atomicMax atomicInc atomicDec atomicCAS atomicAnd atomicOr atomicXor all \
    any ballot syncthreads tex1D tex2D tex3D surfaceReference textureReference uchar ushort uint \
    ulong";
