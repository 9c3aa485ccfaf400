//! The parameters of a function, taken apart into scalars, each of which can be a column.

use super::order::blocks;
use super::value::Scalar;
use naga::{
    AddressSpace, ArraySize, Binding, Block, Expression, Function, Handle, Module, ScalarKind,
    Statement, Type, TypeInner,
};

/// The most scalars of a parameter or result. By hand: more are no function of values.
const MOST_SCALARS: usize = 1024;

/// A parameter of a function, or the result.
#[derive(Clone, Debug)]
pub(super) struct Parameter {
    pub name: String,
    /// Its type; that of what it points to, for an `out` parameter.
    pub ty: Handle<Type>,
    pub role: Role,
    pub scalars: Vec<Part>,
}

/// What a parameter is to the function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// An argument that it reads.
    Argument,
    /// One that the stage gives, of which it may read a component.
    BuiltIn,
    /// An argument that it may write to.
    Place,
    /// An argument that is passed as a place, but of which only the value counts.
    Copy,
    /// A global variable of this index that is given from outside.
    Global(usize),
}

/// A scalar of a parameter.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// As it is called as a column: `v_x`.
    pub column: String,
    pub kind: ScalarKind,
}

/// Returns the arguments of a function.
pub(super) fn arguments(module: &Module, function: &Function) -> Result<Vec<Parameter>, String> {
    let written = written(function);
    let each = function.arguments.iter().enumerate().map(|(index, argument)| {
        let name = argument.name.clone().unwrap_or_else(|| format!("input_{index}"));
        let (ty, role) = match module.types[argument.ty].inner {
            TypeInner::Pointer { base, .. } if written[index] => (base, Role::Place),
            TypeInner::Pointer { base, .. } => (base, Role::Copy),
            _ if matches!(argument.binding, Some(Binding::BuiltIn(_))) => {
                (argument.ty, Role::BuiltIn)
            }
            _ => (argument.ty, Role::Argument),
        };
        let scalars = parts(module, &name, ty)?;
        Ok(Parameter { name, ty, role, scalars })
    });
    each.collect()
}

/// Returns of each argument whether the function may write to where it points. Compilers to SPIR-V
/// pass places of all arguments.
fn written(function: &Function) -> Vec<bool> {
    let mut written = vec![false; function.arguments.len()];
    let mut places = Vec::new();
    places_written(&function.body, &mut places);
    for mut place in places {
        while let Expression::Access { base, .. } | Expression::AccessIndex { base, .. } =
            function.expressions[place]
        {
            place = base;
        }
        if let Expression::FunctionArgument(index) = function.expressions[place] {
            written[index as usize] = true;
        }
    }
    written
}

/// Collects what a block stores to, and what it passes on.
fn places_written(block: &Block, found: &mut Vec<Handle<Expression>>) {
    for statement in block.iter() {
        match statement {
            Statement::Store { pointer, .. } => found.push(*pointer),
            Statement::Call { arguments, .. } => found.extend(arguments),
            other => blocks(other).into_iter().for_each(|block| places_written(block, found)),
        }
    }
}

/// Returns the global variables that are given from outside: uniforms, buffers, and those whose
/// names are in `given`. Not textures, and not arrays without a length.
pub(super) fn globals(module: &Module, given: &[String]) -> Vec<Parameter> {
    let globals = module.global_variables.iter().filter_map(|(handle, global)| {
        let name = global.name.clone().unwrap_or_default();
        let is_own = matches!(global.space, AddressSpace::Private | AddressSpace::WorkGroup);
        if is_own && !given.contains(&name) {
            return None;
        }
        let (ty, role) = (global.ty, Role::Global(handle.index()));
        let scalars = parts(module, &name, ty).ok()?;
        Some(Parameter { name, ty, role, scalars })
    });
    globals.collect()
}

/// Returns the scalars of a type, called after the name of what is of that type.
pub(super) fn parts(module: &Module, name: &str, ty: Handle<Type>) -> Result<Vec<Part>, String> {
    let mut found = Vec::new();
    collect(module, name, ty, &mut found)?;
    Ok(found)
}

/// Returns the name of a member; those of a nameless block are called without it.
fn member(of: &str, name: &str) -> String {
    if of.is_empty() { name.to_owned() } else { format!("{of}_{name}") }
}

const COMPONENTS: [char; 4] = ['x', 'y', 'z', 'w'];

fn collect(
    module: &Module,
    name: &str,
    ty: Handle<Type>,
    found: &mut Vec<Part>,
) -> Result<(), String> {
    if found.len() > MOST_SCALARS {
        return Err(format!("`{name}` has more than {MOST_SCALARS} components"));
    }
    match &module.types[ty].inner {
        TypeInner::Scalar(kind) => {
            found.push(Part { column: name.to_owned(), kind: kind.kind });
        }
        TypeInner::Vector { size, scalar } => {
            let components = COMPONENTS[..*size as usize].iter();
            let part = |c| Part { column: format!("{name}_{c}"), kind: scalar.kind };
            found.extend(components.map(part));
        }
        TypeInner::Matrix { columns, rows, scalar } => {
            for column in 0..*columns as usize {
                let components = COMPONENTS[..*rows as usize].iter();
                let part = |c| Part { column: format!("{name}_{column}_{c}"), kind: scalar.kind };
                found.extend(components.map(part));
            }
        }
        TypeInner::Array { base, size: ArraySize::Constant(size), .. } => {
            for index in 0..size.get() {
                collect(module, &format!("{name}_{index}"), *base, found)?;
            }
        }
        TypeInner::Struct { members, .. } => {
            for (index, member) in members.iter().enumerate() {
                let member_name = member.name.clone().unwrap_or_else(|| index.to_string());
                collect(module, &self::member(name, &member_name), member.ty, found)?;
            }
        }
        TypeInner::Image { .. } | TypeInner::Sampler { .. } => {
            return Err(format!(
                "`{name}` is a texture, of which there is no value; import it as data (`lgp import`)"
            ));
        }
        _ => return Err(format!("the type of `{name}` is not understood")),
    }
    Ok(())
}

/// Returns a type as WGSL writes it, if it is a scalar, vector or matrix.
pub(super) fn wgsl_type(module: &Module, ty: Handle<Type>) -> Option<String> {
    let scalar = |kind: naga::Scalar| match kind.kind {
        ScalarKind::Float => "f32",
        ScalarKind::Sint => "i32",
        ScalarKind::Uint => "u32",
        _ => "bool",
    };
    Some(match module.types[ty].inner {
        TypeInner::Scalar(kind) => scalar(kind).to_owned(),
        TypeInner::Vector { size, scalar: kind } => format!("vec{}<{}>", size as u8, scalar(kind)),
        TypeInner::Matrix { columns, rows, .. } => {
            format!("mat{}x{}<f32>", columns as u8, rows as u8)
        }
        _ => return None,
    })
}

/// Returns a number as a scalar of a kind.
pub(super) fn as_kind<M: super::machine::Machine>(
    machine: &mut M,
    value: Scalar<M>,
    kind: ScalarKind,
) -> Result<Scalar<M>, String> {
    Ok(match (value, kind) {
        (Scalar::Float(_), ScalarKind::Float)
        | (Scalar::Bool(_), ScalarKind::Bool)
        | (Scalar::Int(_), ScalarKind::Sint)
        | (Scalar::Uint(_), ScalarKind::Uint)
        | (Scalar::Unset, _) => value,
        (Scalar::Int(_) | Scalar::Uint(_), ScalarKind::Float) => {
            Scalar::Float(machine.float(value.integer()? as f64))
        }
        (Scalar::Uint(value), ScalarKind::Sint) => Scalar::Int(value as i32),
        (Scalar::Int(value), ScalarKind::Uint) => Scalar::Uint(value as u32),
        _ => return Err("its value is of another type".into()),
    })
}
