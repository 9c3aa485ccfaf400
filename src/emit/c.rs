//! C99 and later.

use super::c_family;
use super::language::{Entry, Form};
use super::syntax::{
    Plain, Readable, Spelling, Syntax, WrittenHead, atom, decimal, is_word, product, select, sum,
};
use crate::op::Op;

pub(super) const LANGUAGE: Entry = Entry {
    name: "c",
    aliases: &["c99"],
    extension: "c",
    form: Form::Function(&SYNTAX),
    half: None,
};

pub(super) const SYNTAX: Syntax = Syntax {
    types: &["float"],
    out_parameter: Some(|of, name| format!("{of} *{name}")),
    out_by_pointer: true,
    spelling,
    reserved,
    literal: |value| decimal(value) + "f",
    non_finite: |name, _, bits| vec![format!("const float {name} = {};", non_finite(bits))],
    open,
    readable: Readable {
        plain: Plain::Double,
        suffixes: &[("f", false), ("F", false)],
        lines: &["#include <math.h>"],
        of_locals: &["const"],
        of_functions: &["static", "inline"],
        of_parameters: &["const"],
        ..c_family::SYNTAX.readable
    },
    ..c_family::SYNTAX
};

fn spelling(op: Op) -> Spelling {
    match op {
        Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Neg => c_family::spelling(op),
        Op::Abs => atom("fabsf({a})"),
        Op::Min => atom("fminf({a}, {b})"),
        Op::Max => atom("fmaxf({a}, {b})"),
        Op::Saturate => atom("fminf(fmaxf({a}, 0.0f), 1.0f)"),
        Op::Mad => atom("fmaf({a}, {b}, {c})"),
        Op::Rcp => product("1.0f/{a-}"),
        Op::Sqrt => atom("sqrtf({a})"),
        Op::Rsqrt => product("1.0f/sqrtf({a})"),
        Op::Exp2 => atom("exp2f({a})"),
        Op::Log2 => atom("log2f({a})"),
        Op::Exp => atom("expf({a})"),
        Op::Log => atom("logf({a})"),
        Op::Pow => atom("powf({a}, {b})"),
        Op::Sin => atom("sinf({a})"),
        Op::Cos => atom("cosf({a})"),
        Op::Tan => atom("tanf({a})"),
        Op::Asin => atom("asinf({a})"),
        Op::Acos => atom("acosf({a})"),
        Op::Atan => atom("atanf({a})"),
        Op::Atan2 => atom("atan2f({a}, {b})"),
        Op::Tanh => atom("tanhf({a})"),
        Op::Lerp => atom("fmaf({c}, {b+} - {a*}, {a})"),
        Op::Step => select("({b+} >= {a+}) ? 1.0f : 0.0f"),
        Op::Select => select("({a+} < {b+}) ? {c+} : {d+}"),
        Op::Floor => atom("floorf({a})"),
        Op::Fract => sum("{a+} - floorf({a})"),
        Op::Sign => select("({a+} > 0.0f) ? 1.0f : ({a+} < 0.0f) ? -1.0f : {a+}"),
    }
}

pub(super) fn non_finite(bits: u32) -> &'static str {
    match f32::from_bits(bits) {
        f32::INFINITY => "INFINITY",
        f32::NEG_INFINITY => "-INFINITY",
        _ => "NAN",
    }
}

fn open(syntax: &Syntax, head: &WrittenHead, lines: &mut Vec<String>) {
    lines.extend(["#include <math.h>".to_owned(), String::new()]);
    let returned = c_family::returned_type(syntax, head);
    if returned == head.structure {
        lines.push("typedef struct {".to_owned());
        lines.extend(c_family::members(syntax, &head.outputs[..head.returned]));
        lines.push(format!("}} {returned};"));
        lines.push(String::new());
    }
    lines.push(c_family::first_line(syntax, head, &returned));
}

/// Returns true for keywords, functions, macros, and names that begin with an underscore, which
/// belong to the compiler.
fn reserved(name: &str) -> bool {
    let double = name.strip_suffix(['f', 'l']).unwrap_or(name);
    name.starts_with('_')
        || name.contains("__")
        || is_word(KEYWORDS, name)
        || is_word(MACROS, name)
        || is_word(FUNCTIONS, name)
        || is_word(FUNCTIONS, double)
}

/// Keywords of C23 (§6.4.1) and of C++20 ([lex.key]), macros that compilers predefine, and types that
/// headers of C++ and of glibc declare beside their own.
const KEYWORDS: &str = "alignas alignof and and_eq asm atomic_cancel atomic_commit \
    atomic_noexcept auto bitand bitor bool break case catch char char8_t char16_t char32_t class \
    co_await co_return co_yield compl concept const const_cast consteval constexpr constinit \
    continue decltype default delete do double dynamic_cast else enum explicit export extern \
    false float for friend goto if inline int long mutable namespace new noexcept not not_eq \
    nullptr operator or or_eq private protected public reflexpr register reinterpret_cast requires \
    restrict return short signed sizeof static static_assert static_cast struct switch \
    synchronized template this thread_local throw true try typedef typeid typename typeof \
    typeof_unqual union unsigned using virtual void volatile wchar_t while xor xor_eq main std \
    double_t float_t fortran linux unix int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t \
    uint64_t intptr_t uintptr_t intmax_t uintmax_t size_t ssize_t ptrdiff_t max_align_t nullptr_t \
    uint ulong ushort";

/// Macros of `math.h` in C23 (§7.12) and in glibc 2.36.
const MACROS: &str = "INFINITY NAN HUGE_VAL HUGE_VALF HUGE_VALL FP_INFINITE FP_NAN FP_NORMAL \
    FP_SUBNORMAL FP_ZERO FP_FAST_FMA FP_FAST_FMAF FP_FAST_FMAL FP_ILOGB0 FP_ILOGBNAN MAXFLOAT \
    MATH_ERRNO MATH_ERREXCEPT math_errhandling M_E M_LOG2E M_LOG10E M_LN2 M_LN10 M_PI M_PI_2 \
    M_PI_4 M_1_PI M_2_PI M_2_SQRTPI M_SQRT2 M_SQRT1_2 NULL fpclassify isfinite isgreater \
    isgreaterequal isinf isless islessequal islessgreater isnan isnormal isunordered signbit \
    issignaling issubnormal iszero signgam";

/// Functions of doubles in `math.h` of C23 (§7.12) and of glibc 2.36, of integers in `stdlib.h`, and
/// those that GCC knows without a header ("Other Builtins" of its manual).
const FUNCTIONS: &str = "acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh drem \
    erf erfc exp exp10 exp2 expm1 fabs fdim finite floor fma fmax fmin fmod frexp gamma hypot ilogb \
    j0 j1 jn ldexp lgamma lgamma_r llrint llround log log10 log1p log2 logb lrint lround modf nan \
    nearbyint nextafter nexttoward pow pow10 remainder remquo rint round scalb scalbln scalbn \
    significand sin sincos sinh sqrt tan tanh tgamma trunc y0 y1 yn abs labs llabs div ldiv \
    abort alloca bcmp bcopy bzero calloc exit ffs fprintf fputc fputs free fscanf fwrite \
    isalnum isalpha isascii isblank iscntrl isdigit isgraph islower isprint ispunct isspace isupper \
    isxdigit malloc memchr memcmp memcpy memmove mempcpy memset printf putc putchar puts realloc \
    rindex scanf snprintf sprintf sscanf stpcpy stpncpy strcasecmp strcat strchr strcmp strcpy \
    strcspn strdup strftime strlen strncasecmp strncat strncmp strncpy strndup strpbrk strrchr \
    strspn strstr toascii tolower toupper vfprintf vprintf vscanf vsnprintf vsprintf";
