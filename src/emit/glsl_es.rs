//! GLSL ES 3.00 with precision qualifiers: `highp`, and `mediump` for halves.
//!
//! A qualifier belongs to a variable. An operation is as precise as the most precise of its
//! arguments (GLSL ES 3.00.6, §4.5.2), so what goes from one precision to the other goes by a local.

use super::language::{Entry, Form};
use super::syntax::{Conversion, Plain, Readable, Syntax, half_decimal};
use super::{c_family, glsl};

pub(super) const LANGUAGE: Entry = Entry {
    name: "glsl-es",
    aliases: &["essl", "gles"],
    extension: "es.glsl",
    form: Form::Function(&SYNTAX),
    half: Some(&HALF),
};

pub(super) const SYNTAX: Syntax = Syntax {
    types: &["highp float", "highp vec2", "highp vec3", "highp vec4"],
    constructors: CONSTRUCTORS,
    conversion: Conversion::Local,
    non_finite: |name, _, bits| {
        vec![format!("highp float {name} = uintBitsToFloat({bits:#010x}u);")]
    },
    readable: Readable {
        plain: Plain::Open,
        suffixes: &[("f", false), ("F", false)],
        of_locals: &["const"],
        of_parameters: &["const", "in"],
        ..c_family::SYNTAX.readable
    },
    ..glsl::SYNTAX
};

/// At least half precision; a GPU may compute in more.
pub(super) const HALF: Syntax = Syntax {
    types: &["mediump float", "mediump vec2", "mediump vec3", "mediump vec4"],
    half: true,
    literal: half_decimal,
    non_finite: |name, _, bits| {
        vec![format!("mediump float {name} = uintBitsToFloat({bits:#010x}u);")]
    },
    ..SYNTAX
};

const CONSTRUCTORS: &[&str] = &["float", "vec2", "vec3", "vec4"];
