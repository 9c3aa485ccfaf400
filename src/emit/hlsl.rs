//! HLSL, for shader model 5 and later.

use super::c_family;
use super::language::{Entry, Form};
use super::syntax::{
    Plain, Readable, Spelling, Syntax, atom, half_decimal, half_decimal_outward, is_word,
};
use crate::op::Op;

pub(super) const LANGUAGE: Entry = Entry {
    name: "hlsl",
    aliases: &["directx", "dx", "fx"],
    extension: "hlsl",
    form: Form::Function(&SYNTAX),
    half: Some(&HALF),
};

pub(super) const SYNTAX: Syntax = Syntax {
    types: &["float", "float2", "float3", "float4"],
    out_parameter: Some(|of, name| format!("out {of} {name}")),
    spelling,
    reserved,
    non_finite: |name, _, bits| vec![format!("const float {name} = asfloat({bits:#010x});")],
    float_of_bits: "asfloat",
    readable: Readable {
        plain: Plain::Open,
        of_locals: &["const", "precise"],
        of_functions: &["static", "inline", "precise"],
        of_parameters: &["const", "in"],
        semantics: true,
        integer_sign: true,
        ..c_family::SYNTAX.readable
    },
    ..c_family::SYNTAX
};

/// Half precision, with `-enable-16bit-types` and shader model 6.2; without, `half` is `float`.
pub(super) const HALF: Syntax = Syntax {
    types: &["half", "half2", "half3", "half4"],
    spelling: |op| match op {
        Op::Sign => atom("half(sign({a}))"),
        op => spelling(op),
    },
    half: true,
    // glslang truncates.
    literal: |value| half_decimal_outward(value) + "h",
    non_finite: |name, _, bits| vec![format!("const half {name} = half(asfloat({bits:#010x}));")],
    ..SYNTAX
};

/// Half precision for engines in which `half` is a macro of `float` elsewhere: there a suffix would
/// make another type.
pub(super) const HALF_BY_CAST: Syntax =
    Syntax { literal: |value| format!("half({})", half_decimal(value)), ..HALF };

fn spelling(op: Op) -> Spelling {
    match op {
        // DXC takes `fma` on doubles only.
        Op::Mad => atom("mad({a}, {b}, {c})"),
        Op::Rcp => atom("rcp({a})"),
        Op::Lerp => atom("lerp({a}, {b}, {c})"),
        Op::Fract => atom("frac({a})"),
        // `sign` is an int: the quotient of two would be rounded.
        Op::Sign => atom("float(sign({a}))"),
        op => c_family::spelling(op),
    }
}

/// Returns true for reserved names in any case: some keywords may be written in any (`Texture2D`,
/// `TECHNIQUE`).
pub(super) fn reserved(name: &str) -> bool {
    // `_Atomic` and `__attribute` are DXC's, as they are clang's.
    let of_the_compiler = name.starts_with("__")
        || name.strip_prefix('_').is_some_and(|rest| rest.starts_with(|c: char| c.is_uppercase()));
    // Shader Graph's own name of a result.
    if name == "Out" {
        return false;
    }
    let name = name.to_ascii_lowercase();
    of_the_compiler
        || is_word(KEYWORDS, &name)
        || is_word(FUNCTIONS, &name)
        || is_numeric_type(&name)
}

/// Returns true for `float`, `float3`, `float3x2`, and so on.
fn is_numeric_type(name: &str) -> bool {
    let scalar = name.trim_end_matches(|c: char| ('1'..='4').contains(&c) || c == 'x');
    // The digits of `int16_t` are part of its name, those of `min16float4` only the last.
    is_word(SCALARS, scalar) || is_word(SCALARS, name)
}

const SCALARS: &str = "bool int uint dword float half double min16float min10float min16int \
    min12int min16uint float16_t float32_t float64_t int16_t int32_t int64_t uint16_t uint32_t \
    uint64_t";

/// Keywords, in lower case: those and the reserved words of FXC (Microsoft's reference, "Keywords"
/// and "Reserved Words" in the appendix, as of 2021), and of DXC 1.8 (`TokenKinds.def` and
/// `HlslTypes.cpp`: C++ and HLSL).
const KEYWORDS: &str = "appendstructuredbuffer asm asm_fragment auto blendstate break buffer \
    byteaddressbuffer case catch cbuffer centroid char class column_major compile \
    compile_fragment compileshader computeshader const const_cast constantbuffer \
    consumestructuredbuffer continue default delete depthstencilstate depthstencilview discard do \
    domainshader decl dynamic_cast else enum explicit export extern false for friend fxgroup \
    geometryshader globallycoherent goto groupshared hullshader if in indices inline inout \
    inputpatch interface line lineadj linear linestream long main matrix mutable namespace new \
    nointerpolation noperspective null operator out outputpatch packoffset pass payload \
    pixelfragment pixelshader point pointstream precise primitives private protected public \
    rasterizerorderedbuffer rasterizerstate register reinterpret_cast rendertargetview return \
    row_major rwbuffer rwbyteaddressbuffer rwstructuredbuffer rwtexture1d rwtexture1darray \
    rwtexture2d rwtexture2darray rwtexture3d sample sampler sampler1d sampler2d sampler3d \
    sampler_state samplercomparisonstate samplercube samplerstate shared short signed sizeof \
    snorm std stateblock stateblock_state static static_cast string struct structuredbuffer switch \
    tbuffer technique technique10 technique11 template texture texture1d texture1darray texture2d \
    texture2darray texture2dms texture2dmsarray texture3d texturecube texturecubearray this throw \
    triangle triangleadj trianglestream true try typedef typeid typename uniform union unorm unroll \
    unsigned using vector vertexfragment vertexshader vertices virtual void volatile wchar_t while";

/// Intrinsics of shader model 5.1, in lower case, from the same reference.
const FUNCTIONS: &str = "abort abs acos all and any asdouble asfloat asin asint asuint atan atan2 \
    ceil clamp clip cos cosh countbits cross d3dcolortoubyte4 ddx ddx_coarse ddx_fine ddy \
    ddy_coarse ddy_fine degrees determinant distance dot dst errorf exp exp2 f16tof32 f32tof16 \
    faceforward firstbithigh firstbitlow floor fma fmod frac frexp fwidth isfinite isinf isnan \
    isnormal ldexp length lerp lit log log10 log2 mad max min modf msad4 mul noise normalize or \
    pow printf radians rcp reflect refract reversebits round rsqrt saturate select sign sin sincos \
    sinh smoothstep sqrt step tan tanh tex1d tex1dbias tex1dgrad tex1dlod tex1dproj tex2d \
    tex2dbias tex2dgrad tex2dlod tex2dproj tex3d tex3dbias tex3dgrad tex3dlod tex3dproj texcube \
    texcubebias texcubegrad texcubelod texcubeproj transpose trunc allmemorybarrier \
    allmemorybarrierwithgroupsync checkaccessfullymapped devicememorybarrier \
    devicememorybarrierwithgroupsync evaluateattributeatsample evaluateattributecentroid \
    evaluateattributesnapped getrendertargetsamplecount getrendertargetsampleposition \
    groupmemorybarrier groupmemorybarrierwithgroupsync interlockedadd interlockedand \
    interlockedcompareexchange interlockedcomparestore interlockedexchange interlockedmax \
    interlockedmin interlockedor interlockedxor process2dquadtessfactorsavg \
    process2dquadtessfactorsmax process2dquadtessfactorsmin processisolinetessfactors \
    processquadtessfactorsavg processquadtessfactorsmax processquadtessfactorsmin \
    processtritessfactorsavg processtritessfactorsmax processtritessfactorsmin";
