//! GLSL: the common part of `#version 300 es` (WebGL2) and desktop versions.

use super::c_family;
use super::language::{Entry, Form};
use super::syntax::{
    Readable, Spelling, Syntax, WrittenHead, atom, half_decimal_outward, is_word, product, sum,
};
use crate::op::Op;

pub(super) const LANGUAGE: Entry = Entry {
    name: "glsl",
    aliases: &["opengl", "webgl", "webgl2", "gl"],
    extension: "glsl",
    form: Form::Function(&SYNTAX),
    half: Some(&HALF),
};

pub(super) const SYNTAX: Syntax = Syntax {
    types: &["float", "vec2", "vec3", "vec4"],
    out_parameter: Some(|of, name| format!("out {of} {name}")),
    spelling,
    reserved,
    // In ES 3.00 the initialiser of a `const` must be constant.
    local: |syntax, name, value| format!("{} {name} = {value};", syntax.types[0]),
    non_finite: |name, _, bits| vec![format!("float {name} = uintBitsToFloat({bits:#010x}u);")],
    close,
    float_of_bits: "uintBitsToFloat",
    readable: Readable {
        of_locals: &["const", "highp", "precise"],
        of_functions: &["highp", "precise"],
        of_parameters: &["const", "in", "highp"],
        suffixes: &[("hf", true), ("HF", true), ("f", false), ("F", false)],
        lines: &["#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require"],
        ..c_family::SYNTAX.readable
    },
    ..c_family::SYNTAX
};

/// Half precision, in desktop versions. `#extension` must come before anything else.
pub(super) const HALF: Syntax = Syntax {
    types: &["float16_t", "f16vec2", "f16vec3", "f16vec4"],
    spelling: |op| match op {
        Op::Saturate => atom("clamp({a}, 0.0hf, 1.0hf)"),
        Op::Rcp => product("1.0hf/{a-}"),
        op => spelling(op),
    },
    half: true,
    // glslang truncates.
    literal: |value| half_decimal_outward(value) + "hf",
    non_finite: |name, _, bits| {
        vec![format!("float16_t {name} = float16_t(uintBitsToFloat({bits:#010x}u));")]
    },
    open: |syntax, head, lines| {
        let extension = "#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require";
        lines.extend([extension.to_owned(), String::new()]);
        c_family::open(syntax, head, lines);
    },
    ..SYNTAX
};

fn spelling(op: Op) -> Spelling {
    match op {
        Op::Saturate => atom("clamp({a}, 0.0, 1.0)"),
        // There is no `fma` before ES 3.20 and GLSL 4.00.
        Op::Mad => sum("{a*}*{b-} + {c*}"),
        Op::Rsqrt => atom("inversesqrt({a})"),
        Op::Atan2 => atom("atan({a}, {b})"),
        op => c_family::spelling(op),
    }
}

fn close(syntax: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    if head.returned <= syntax.types.len() {
        return c_family::close(syntax, head, lines);
    }
    lines.extend(c_family::assigned_vectors(syntax, head));
    // ES 3.00 initialises a structure by its constructor.
    let values = head.outputs[..head.returned].join(", ");
    lines.push(format!("    return {}({values});", head.structure));
    lines.push("}".to_owned());
}

fn reserved(name: &str) -> bool {
    name.starts_with("gl_")
        || name.contains("__")
        || is_word(KEYWORDS, name)
        || is_word(FUNCTIONS, name)
        || is_opaque_type(name)
        || is_matrix_or_vector(name)
}

/// Returns true for `vec2`, `ivec4`, `hvec3`, `mat3`, `dmat4x2`, and so on.
fn is_matrix_or_vector(name: &str) -> bool {
    let unprefixed = name.strip_prefix(['i', 'u', 'b', 'd', 'h', 'f']).unwrap_or(name);
    let size = unprefixed.strip_prefix("vec").or_else(|| unprefixed.strip_prefix("mat"));
    size.is_some_and(|size| {
        matches!(size.as_bytes(), [b'2'..=b'4'] | [b'2'..=b'4', b'x', b'2'..=b'4'])
    })
}

/// Returns true for `sampler2D`, `usampler3D`, `imageCubeArray`, `textureBuffer`, and so on.
fn is_opaque_type(name: &str) -> bool {
    // `image2D` begins with a letter that is a prefix elsewhere.
    let unprefixed = name.strip_prefix(['i', 'u']).unwrap_or(name);
    [name, unprefixed].iter().any(|name| {
        ["sampler", "image", "texture", "subpassInput"].iter().any(|kind| {
            let rest = name.strip_prefix(kind);
            rest.is_some_and(|rest| {
                !rest.starts_with(|c: char| c.is_ascii_lowercase()) && !rest.contains('_')
            })
        })
    })
}

/// Keywords and reserved words of GLSL ES 3.00.6 and 3.20.6, and of GLSL 4.60.8 with
/// `GL_KHR_vulkan_glsl`: §3.6 of the former (§3.8 of ES 3.00), without those that are told by their
/// form.
const KEYWORDS: &str = "active asm atomic_uint attribute bool break buffer case cast centroid \
    class coherent common const continue default discard do double else enum extern external false \
    filter fixed flat float for fvec2 fvec3 fvec4 goto half highp if in inline inout input int \
    interface invariant isampler layout long lowp main mediump namespace noinline noperspective \
    out output packed partition patch precise precision public readonly resource restrict return \
    row_major sample shared short sizeof smooth static struct subroutine superp switch template \
    this true typedef uint uniform union unsigned using varying void volatile while writeonly";

/// Builtin functions: §8 of GLSL 4.60.8 and of ES 3.20.6, without those that begin as a type does
/// (`textureLod`, `imageLoad`), and those of GL_INTEL_shader_integer_functions2, which glslang has in all
/// versions.
const FUNCTIONS: &str = "abs acos acosh all any asin asinh atan atanh barrier bitCount \
    bitfieldExtract bitfieldInsert bitfieldReverse ceil clamp cos cosh cross dFdx dFdxCoarse \
    dFdxFine dFdy dFdyCoarse dFdyFine degrees determinant distance dot equal exp exp2 faceforward \
    findLSB findMSB floatBitsToInt floatBitsToUint floor fma fract frexp ftransform fwidth \
    fwidthCoarse fwidthFine greaterThan greaterThanEqual groupMemoryBarrier imulExtended \
    intBitsToFloat interpolateAtCentroid interpolateAtOffset interpolateAtSample inverse \
    inversesqrt isinf isnan ldexp length lessThan lessThanEqual log log2 matrixCompMult max \
    memoryBarrier min mix mod modf noise1 noise2 noise3 noise4 normalize not notEqual outerProduct \
    packDouble2x32 packHalf2x16 packSnorm2x16 packSnorm4x8 packUnorm2x16 packUnorm4x8 pow radians \
    reflect refract round roundEven shadow1D shadow2D sign sin sinh smoothstep sqrt step tan tanh \
    texelFetch texelFetchOffset transpose trunc uaddCarry uintBitsToFloat umulExtended \
    unpackDouble2x32 unpackHalf2x16 unpackSnorm2x16 unpackSnorm4x8 unpackUnorm2x16 unpackUnorm4x8 \
    usubBorrow countLeadingZeros countTrailingZeros absoluteDifference addSaturate \
    subtractSaturate average averageRounded multiply32x16";
