//! MSL, the Metal shading language, under `using namespace metal`.

use super::c_family;
use super::language::{Entry, Form};
use super::syntax::{Readable, Syntax, half_decimal, is_word, product};
use crate::op::Op;

pub(super) const LANGUAGE: Entry = Entry {
    name: "msl",
    aliases: &["metal"],
    extension: "metal",
    form: Form::Function(&SYNTAX),
    half: Some(&HALF),
};

pub(super) const SYNTAX: Syntax = Syntax {
    types: &["float", "float2", "float3", "float4"],
    out_parameter: Some(|of, name| format!("thread {of} &{name}")),
    reserved,
    non_finite: |name, _, bits| {
        vec![format!("const float {name} = as_type<float>({bits:#010x}u);")]
    },
    float_of_bits: "as_type",
    readable: Readable {
        of_locals: &["const", "constexpr"],
        of_functions: &["static", "inline"],
        of_parameters: &["const"],
        ..c_family::SYNTAX.readable
    },
    ..c_family::SYNTAX
};

/// Half precision.
pub(super) const HALF: Syntax = Syntax {
    types: &["half", "half2", "half3", "half4"],
    spelling: |op| match op {
        Op::Rcp => product("1.0h/{a-}"),
        op => c_family::spelling(op),
    },
    half: true,
    literal: |value| half_decimal(value) + "h",
    non_finite: |name, _, bits| {
        vec![format!("const half {name} = half(as_type<float>({bits:#010x}u));")]
    },
    ..SYNTAX
};

fn reserved(name: &str) -> bool {
    name.starts_with('_')
        || name.contains("__")
        || is_word(KEYWORDS, name)
        || is_word(FUNCTIONS, name)
        || is_type(name)
        || is_macro(name)
}

/// Returns true for `float`, `half3`, `packed_float3`, `float3x2`, and so on.
fn is_type(name: &str) -> bool {
    let unpacked = name.strip_prefix("packed_").unwrap_or(name);
    let scalar = unpacked.trim_end_matches(|c: char| ('1'..='4').contains(&c) || c == 'x');
    is_word(SCALARS, scalar) || is_word(SCALARS, name)
}

/// Returns true for `M_PI_F`, `FLT_MAX`, `INT_MIN`, and so on (specification, §6.5 and its limits).
fn is_macro(name: &str) -> bool {
    let parts = ["M_", "FLT_", "DBL_", "HALF_", "FP_", "HUGE_", "MAX"];
    let limits = ["_MAX", "_MIN", "_BIT"];
    let capitals = !name.contains(|c: char| c.is_ascii_lowercase());
    // Few end in a number, so that replacement names can.
    let numbered = name.trim_end_matches(|c: char| c.is_ascii_digit()).ends_with('_');
    if numbered {
        return is_word("M_PI_2 M_PI_4 M_SQRT1_2", name);
    }
    capitals
        && (parts.iter().any(|part| name.starts_with(part))
            || limits.iter().any(|limit| name.ends_with(limit)))
}

const SCALARS: &str = "bool char short int long uchar ushort uint ulong half float double int8_t \
    int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t size_t ptrdiff_t vec matrix bfloat";

/// Keywords of C++14 (N4431, §2.11), and of the Metal Shading Language Specification 3.2 (§2.1
/// types, §4 address spaces, §5 attributes and functions).
const KEYWORDS: &str = "alignas alignof and and_eq asm atomic_bool atomic_int atomic_uint auto \
    bitand bitor break case catch char16_t char32_t class compl const const_cast constexpr \
    continue decltype default delete do dynamic_cast else enum explicit export extern false final \
    for friend goto if inline mutable namespace new noexcept not not_eq nullptr operator or or_eq \
    override private protected public register reinterpret_cast return signed sizeof static \
    static_assert static_cast struct switch template this thread_local throw true try typedef \
    typeid typename union unsigned using virtual void volatile wchar_t while xor xor_eq main metal \
    access array array_ref buffer constant coord device fragment function function_constant kernel \
    mesh patch ray_data raster_order_group sampler simdgroup threadgroup threadgroup_imageblock \
    thread user vertex visible texture1d \
    texture1d_array texture2d texture2d_array texture2d_ms texture2d_ms_array texture3d texturecube \
    texturecube_array texture_buffer depth2d depth2d_array depth2d_ms depth2d_ms_array depthcube \
    depthcube_array INFINITY NAN DefaultConstructible assert atomic atomic_float atomic_ulong \
    complex imaginary llong object_data quad restrict ullong";

/// Functions: §6 of the Metal Shading Language Specification 3.2.
const FUNCTIONS: &str = "abs absdiff acos acosh addsat all any as_type asin asinh atan atan2 atanh \
    ceil clamp clz copysign cos cosh cospi cross ctz determinant dfdx dfdy discard_fragment \
    distance distance_squared divide dot exp exp10 exp2 extract_bits faceforward fabs fast fdim \
    floor fma fmax fmax3 fmedian3 fmin fmin3 fmod fract frexp fwidth hadd ilogb insert_bits isfinite \
    isinf isnan isnormal isordered isunordered ldexp length length_squared log log10 log2 mad24 \
    madhi madsat max max3 median3 min min3 mix modf mul24 mulhi nextafter normalize popcount pow \
    powr precise quantize_to_f16 reflect refract reverse_bits rhadd rint rotate round rsqrt \
    saturate select sign signbit simd sin sincos sinh sinpi smoothstep sqrt step subsat tan tanh \
    tanpi transpose trunc";
