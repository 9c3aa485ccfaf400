//! WGSL.

use super::c_family;
use super::language::{Entry, Form};
use super::syntax::{
    Plain, Readable, Spelling, Style, Syntax, WrittenHead, atom, half_decimal, is_word,
};
use crate::op::Op;

pub(super) const LANGUAGE: Entry = Entry {
    name: "wgsl",
    aliases: &["webgpu", "wgpu"],
    extension: "wgsl",
    form: Form::Function(&SYNTAX),
    half: Some(&HALF),
};

pub(super) const SYNTAX: Syntax = Syntax {
    types: &["f32", "vec2<f32>", "vec3<f32>", "vec4<f32>"],
    parameter: |of, name| format!("{name}: {of}"),
    out_parameter: Some(|of, name| format!("{name}: ptr<function, {of}>")),
    out_by_pointer: true,
    spelling,
    reserved,
    local: |_, name, value| format!("let {name} = {value};"),
    // An infinite constant expression is an error; what a variable holds is no constant.
    non_finite: |name, bits_name, bits| {
        vec![
            format!("var {bits_name} = {bits:#010x}u;"),
            format!("let {name} = bitcast<f32>({bits_name});"),
        ]
    },
    open,
    close,
    float_of_bits: "bitcast",
    readable: Readable {
        style: Style::Wgsl,
        plain: Plain::Open,
        suffixes: &[("f", false), ("h", true)],
        ..c_family::SYNTAX.readable
    },
    ..c_family::SYNTAX
};

/// Half precision, where the device has `shader-f16`. `enable` must come before anything else.
pub(super) const HALF: Syntax = Syntax {
    types: &["f16", "vec2<f16>", "vec3<f16>", "vec4<f16>"],
    half: true,
    literal: |value| half_decimal(value) + "h",
    non_finite: |name, bits_name, bits| {
        vec![
            format!("var {bits_name} = {bits:#010x}u;"),
            format!("let {name} = f16(bitcast<f32>({bits_name}));"),
        ]
    },
    open: |syntax, head, lines| {
        lines.extend(["enable f16;".to_owned(), String::new()]);
        open(syntax, head, lines);
    },
    ..SYNTAX
};

fn spelling(op: Op) -> Spelling {
    match op {
        Op::Rsqrt => atom("inverseSqrt({a})"),
        // The value where the condition is false comes first.
        Op::Select => atom("select({d}, {c}, {a+} < {b+})"),
        op => c_family::spelling(op),
    }
}

fn open(syntax: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    let returned = c_family::returned_type(syntax, head);
    if returned == head.structure {
        lines.push(format!("struct {returned} {{"));
        let member = |name| format!("    {name}: {},", syntax.types[0]);
        lines.extend(head.outputs[..head.returned].iter().map(member));
        lines.push("}".to_owned());
    }
    let returned = if head.returned == 0 { String::new() } else { format!("-> {returned} ") };
    let (function, parameters) = (&head.function, c_family::parameters(syntax, head));
    lines.push(format!("fn {function}({parameters}) {returned}{{"));
}

fn close(syntax: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    lines.extend(c_family::assigned_vectors(syntax, head));
    let of_structure = || {
        let values = head.outputs[..head.returned].join(", ");
        (head.returned > 0).then(|| format!("    return {}({values});", head.structure))
    };
    lines.extend(c_family::returned_value(syntax, head).or_else(of_structure));
    lines.push("}".to_owned());
}

fn reserved(name: &str) -> bool {
    name == "_"
        || name.starts_with("__")
        || is_word(KEYWORDS, name)
        || is_word(TYPE_NAMES, name)
        || is_word(FUNCTIONS, name)
}

/// Keywords and words reserved for later: §15.2 and §15.3 of the W3C's draft of 2025-08-09.
const KEYWORDS: &str = "alias break case const const_assert continue continuing default diagnostic \
    discard else enable false fn for if let loop override requires return struct switch true var \
    while main NULL Self abstract active alignas alignof as asm asm_fragment async attribute auto \
    await become cast catch class co_await co_return co_yield coherent column_major common compile \
    compile_fragment concept const_cast consteval constexpr constinit crate debugger decltype \
    delete demote demote_to_helper do dynamic_cast enum explicit export extends extern external \
    fallthrough filter final finally friend from fxgroup get goto groupshared highp impl \
    implements import inline instanceof interface layout lowp macro macro_rules match mediump meta \
    mod module move mut mutable namespace new nil noexcept noinline nointerpolation non_coherent \
    noncoherent noperspective null nullptr of operator package packoffset partial partition pass patch \
    pixelfragment precise precision premerge priv protected pub public readonly ref regardless \
    register reinterpret_cast require resource restrict self set shared sizeof smooth snorm static \
    static_assert static_cast std subroutine super target template this thread_local throw trait \
    try type typedef typeid typename typeof union unless unorm unsafe unsized use using varying \
    virtual volatile wgsl where with writeonly yield";

/// Types and their generators (§6.9) and enumerants (§6.3.1) of the same draft, and those of
/// extensions that compilers know.
const TYPE_NAMES: &str = "bool i32 u32 f32 f16 i64 u64 f64 array atomic ptr sampler \
    sampler_comparison vec2 vec3 vec4 vec2i vec3i vec4i vec2u vec3u vec4u vec2f vec3f vec4f vec2h \
    vec3h vec4h mat2x2 mat2x3 mat2x4 mat3x2 mat3x3 mat3x4 mat4x2 mat4x3 mat4x4 mat2x2f mat2x3f \
    mat2x4f mat3x2f mat3x3f mat3x4f mat4x2f mat4x3f mat4x4f mat2x2h mat2x3h mat2x4h mat3x2h \
    mat3x3h mat3x4h mat4x2h mat4x3h mat4x4h texture_1d texture_2d texture_2d_array texture_3d \
    texture_cube texture_cube_array texture_multisampled_2d texture_depth_multisampled_2d \
    texture_external texture_storage_1d texture_storage_2d texture_storage_2d_array \
    texture_storage_3d texture_depth_2d texture_depth_2d_array texture_depth_cube \
    texture_depth_cube_array binding_array acceleration_structure ray_query function private \
    workgroup uniform storage read write read_write";

/// Builtin functions: §17 of the same draft.
const FUNCTIONS: &str = "abs acos acosh all any arrayLength asin asinh atan atan2 atanh bitcast \
    ceil clamp cos cosh countLeadingZeros countOneBits countTrailingZeros cross degrees \
    determinant distance dot dot4I8Packed dot4U8Packed dpdx dpdxCoarse dpdxFine dpdy dpdyCoarse \
    dpdyFine exp exp2 extractBits faceForward firstLeadingBit firstTrailingBit floor fma fract \
    frexp fwidth fwidthCoarse fwidthFine insertBits inverse inverseSqrt isinf isnan ldexp length \
    log log2 max min mix modf normalize outerProduct pow quantizeToF16 radians reflect refract \
    reverseBits round saturate select sign sin sinh smoothstep sqrt step storageBarrier tan tanh \
    textureDimensions textureGather textureGatherCompare textureLoad textureSample textureStore \
    transpose trunc workgroupBarrier workgroupUniformLoad";
