//! Slang: HLSL with other reserved words.

use super::hlsl;
use super::language::{Entry, Form};
use super::syntax::{Plain, Readable, Syntax, is_word};

pub(super) const LANGUAGE: Entry = Entry {
    name: "slang",
    aliases: &[],
    extension: "slang",
    form: Form::Function(&SYNTAX),
    half: Some(&HALF),
};

pub(super) const SYNTAX: Syntax = Syntax {
    reserved,
    readable: Readable { plain: Plain::Single, ..hlsl::SYNTAX.readable },
    ..hlsl::SYNTAX
};

/// Half precision; all its targets that have halves take it as it is.
pub(super) const HALF: Syntax = Syntax { reserved, readable: SYNTAX.readable, ..hlsl::HALF };

fn reserved(name: &str) -> bool {
    hlsl::reserved(name) || is_word(WORDS, name)
}

/// Slang's keywords, and names that its core modules declare. The compiler (2026.12) refuses only
/// few of them as names, but a local that hides one means something else: all are avoided.
const WORDS: &str = "This alignof as associatedtype bwd_diff constref copysign countof defer \
    detach dynamic_uniform each expand exp10 extension fwd_diff func functype get implementing \
    import init internal is let matrix_type module no_diff none nullptr optional \
    override property ref set some spirv_asm subscript throws type_param typealias uint8_t int8_t \
    intptr_t uintptr_t var where Array Optional Ptr Tuple";
