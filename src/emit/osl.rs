//! Open Shading Language 1.12.
//!
//! A division by zero is 0 there, as is a root of what is negative; logarithms and powers are kept
//! finite. There is no infinity and no NaN: the largest float and 0 stand for them.

use super::c_family;
use super::language::{Entry, Form};
use super::syntax::{
    Conversion, Readable, Spelling, Syntax, WrittenHead, atom, decimal, is_word, select, sum,
};
use crate::op::Op;

pub(super) const LANGUAGE: Entry = Entry {
    name: "osl",
    aliases: &["openshadinglanguage"],
    extension: "osl",
    form: Form::Function(&SYNTAX),
    half: None,
};

pub(super) const SYNTAX: Syntax = Syntax {
    types: &["float"],
    conversion: Conversion::Cast,
    out_parameter: Some(|of, name| format!("output {of} {name}")),
    outputs_by_parameters: true,
    spelling,
    reserved,
    local: |_, name, value| format!("float {name} = {value};"),
    non_finite: |name, _, bits| vec![format!("float {name} = {};", finite(bits))],
    close,
    readable: Readable { suffixes: &[], ..c_family::SYNTAX.readable },
    ..c_family::SYNTAX
};

/// A shader with its parameters' default values, for renderers' nodes.
pub(super) const SHADER: Syntax = Syntax {
    open: |_, head, lines| {
        let parameters = head.parameters.iter().map(|parameter| match parameter.out {
            true => format!("output float {} = 0.0", parameter.name),
            false => format!("float {} = 0.5", parameter.name),
        });
        let parameters = parameters.collect::<Vec<_>>().join(", ");
        lines.push(format!("shader {}({parameters}) {{", head.function));
    },
    ..SYNTAX
};

fn spelling(op: Op) -> Spelling {
    match op {
        Op::Saturate => atom("clamp({a}, 0.0, 1.0)"),
        Op::Mad => sum("{a*}*{b-} + {c*}"),
        Op::Rsqrt => atom("inversesqrt({a})"),
        Op::Fract => sum("{a+} - floor({a})"),
        Op::Select => select("({a+} < {b+}) ? {c+} : {d+}"),
        op => c_family::spelling(op),
    }
}

fn finite(bits: u32) -> String {
    match f32::from_bits(bits) {
        f32::INFINITY => decimal(f32::MAX),
        f32::NEG_INFINITY => decimal(f32::MIN),
        _ => decimal(0.0),
    }
}

fn close(syntax: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    if head.returned <= syntax.types.len() {
        return c_family::close(syntax, head, lines);
    }
    let WrittenHead { structure, result, .. } = head;
    let values = head.outputs[..head.returned].join(", ");
    lines.push(format!("    {structure} {result} = {{ {values} }};"));
    lines.push(format!("    return {result};"));
    lines.push("}".to_owned());
}

fn reserved(name: &str) -> bool {
    name.contains("__") || is_word(KEYWORDS, name) || is_word(FUNCTIONS, name)
}

/// Keywords and reserved words (specification of 1.12, §3.2), global variables (§4.8), the types and
/// macros of its standard header, and the macros of its compiler, as of 1.14 in Cycles 4.5.
const KEYWORDS: &str = "and break closure color continue do else emit float for if illuminance \
    illuminate int matrix normal not or output point public return string struct vector void while \
    bool case catch char class const delete default double enum extern false friend goto inline \
    long new operator private protected short signed sizeof static switch template this throw true \
    try typedef uniform union unsigned varying virtual volatile shader surface displacement volume \
    P I N Ng dPdu dPdv Ps u v time dtime dPdtime Ci M_PI M_PI_2 M_PI_4 M_2_PI M_2PI M_4PI \
    M_2_SQRTPI M_E M_LN2 M_LN10 M_LOG2E M_LOG10E M_SQRT2 M_SQRT1_2 M_1_PI vector2 vector4 color2 \
    color4 main BUILTIN BUILTIN_DERIV STDOSL_H OSL_VERSION OSL_VERSION_MAJOR OSL_VERSION_MINOR \
    OSL_VERSION_PATCH FLT_MAX";

/// Functions: §7 of the same specification.
const FUNCTIONS: &str = "abs acos area arraylength asin atan atan2 backfacing bitwise_and blackbody \
    bump calculatenormal cbrt ceil cell cellnoise clamp concat cos cosh cross deltau deltav \
    determinant dict_find dict_next dict_value diffuse displace distance dot Dx Dy Dz emission \
    endswith erf erfc error exit exp exp2 expm1 fabs faceforward filterwidth floor fmod format \
    fprintf fresnel getattribute getchar getmatrix getmessage gettextureinfo hash hypot inversesqrt \
    isconnected isconstant isfinite isinf isnan length linearstep log log10 log2 logb luminance max \
    min mix mod noise normalize oren_nayar phong pnoise pointcloud_get pointcloud_search \
    pointcloud_write pow printf psnoise radians raytype reflect reflection refract refraction \
    regex_match regex_search rotate round select setmessage sign sin sincos sinh smooth_linearstep \
    smoothstep snoise spline splineinverse split sqrt startswith step stof stoi strlen strtof \
    strtoi substr surfacearea tan tanh texture texture3d trace transform transformc translucent \
    transparent transpose trunc ward warning wavelength_color degrees environment holdout \
    background debug microfacet";
