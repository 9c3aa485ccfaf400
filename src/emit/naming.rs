//! Names that a language allows, without collisions.

use super::read::name_line;
use super::signature::{Parameter, Signature};
use super::syntax::WrittenHead;
use std::collections::HashSet;

/// The names of one function, and those already taken.
pub(super) struct Naming<'a> {
    reserved: fn(&str) -> bool,
    /// How a name looks: two names must not look alike.
    look: fn(&str) -> String,
    taken: HashSet<String>,
    signature: &'a Signature,
    outputs: &'a [String],
    /// The names of the function, its parameters, and the outputs that are none of them.
    written: Vec<String>,
    temporaries: usize,
}

impl<'a> Naming<'a> {
    pub fn new(
        reserved: fn(&str) -> bool,
        look: fn(&str) -> String,
        signature: &'a Signature,
        outputs: &'a [String],
    ) -> Naming<'a> {
        let (taken, written) = (HashSet::new(), Vec::new());
        let mut naming =
            Naming { reserved, look, taken, signature, outputs, written, temporaries: 0 };
        // A renamed name must not take one that another may keep.
        let kept: Vec<bool> = naming.wanted().iter().map(|name| naming.keep(name)).collect();
        naming.written = (naming.wanted().iter().zip(kept))
            .map(|(name, kept)| if kept { (*name).to_owned() } else { naming.rename(name) })
            .collect();
        naming
    }

    fn wanted(&self) -> Vec<&'a str> {
        let parameters = self.signature.parameters.iter().map(|parameter| &*parameter.name);
        let first = std::iter::once(&*self.signature.function).chain(parameters);
        first.chain(self.locals().map(String::as_str)).collect()
    }

    /// Returns the outputs that are no parameters by themselves.
    fn locals(&self) -> impl Iterator<Item = &'a String> + use<'a> {
        let Signature { parameters, returned, .. } = self.signature;
        let out = parameters.iter().filter(|parameter| parameter.out);
        let alone = out.flat_map(|parameter| vec![parameter.size == 1; parameter.size]);
        let alone = std::iter::repeat_n(false, *returned).chain(alone);
        self.outputs.iter().zip(alone).filter(|(_, alone)| !alone).map(|(output, _)| output)
    }

    pub fn head(&mut self, arithmetic: bool) -> WrittenHead {
        let Signature { qualifiers, parameters, returned, .. } = self.signature;
        let mut names = self.written.iter().cloned();
        let function = names.next().expect("a function has a name");
        let parameters: Vec<Parameter> = (parameters.iter().zip(names.by_ref()))
            .map(|(parameter, name)| Parameter { name, ..parameter.clone() })
            .collect();
        let components = |out| {
            let some = parameters.iter().filter(move |parameter| parameter.out == out);
            some.flat_map(move |parameter| match parameter.size {
                // Of a vector, locals hold the components until all are known.
                size if out && size > 1 => vec![None; size],
                _ => parameter.components().into_iter().map(Some).collect(),
            })
        };
        let inputs = components(false).flatten().collect();
        let outputs = std::iter::repeat_n(None, *returned).chain(components(true));
        let outputs = outputs
            .map(|name| name.unwrap_or_else(|| names.next().expect("a name for each local")))
            .collect();
        let structure = self.fresh(&format!("{function}_outputs"));
        let result = self.fresh("result");
        let returned = *returned;
        WrittenHead {
            function,
            qualifiers: qualifiers.clone(),
            parameters,
            inputs,
            outputs,
            returned,
            structure,
            result,
            arithmetic,
        }
    }

    /// Returns a line for each name that could not be kept.
    pub fn renamed(&self) -> Vec<String> {
        let names = self.wanted().into_iter().zip(&self.written);
        names
            .filter(|(wanted, written)| wanted != written)
            .map(|(wanted, written)| name_line(written, wanted))
            .collect()
    }

    /// Returns the next free one of `t0`, `t1`, ….
    pub fn temporary(&mut self) -> String {
        loop {
            let name = format!("t{}", self.temporaries);
            self.temporaries += 1;
            if self.keep(&name) {
                return name;
            }
        }
    }

    /// Returns `name`, or one like it that is free.
    pub fn fresh(&mut self, name: &str) -> String {
        if self.keep(name) { name.to_owned() } else { self.rename(name) }
    }

    /// Takes `name` as it is, and returns true, if that is allowed.
    fn keep(&mut self, name: &str) -> bool {
        is_identifier(name) && !(self.reserved)(name) && self.taken.insert((self.look)(name))
    }

    fn rename(&mut self, name: &str) -> String {
        let mut base = plain(name);
        // All names that begin with `x` may be reserved; none that begins with `x_` is.
        if (self.reserved)(&format!("{base}_2")) {
            base = format!("x_{base}");
        }
        let first = [base.clone(), format!("{base}_")];
        let mut candidates =
            first.into_iter().chain((2u32..).map(|number| format!("{base}_{number}")));
        candidates.find(|candidate| self.keep(candidate)).expect("some number is free")
    }
}

pub(super) fn is_identifier(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
}

/// Returns an identifier like `name` of a form that every language allows: it begins with a letter
/// but not with `gl_`, and has no double underscore.
fn plain(name: &str) -> String {
    let words: Vec<&str> =
        name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let name = words.join("_");
    match name.chars().next() {
        None => "x".to_owned(),
        Some(first) if first.is_ascii_digit() || name.starts_with("gl_") => format!("x_{name}"),
        Some(_) => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Names;

    #[test]
    fn any_text_becomes_a_plain_identifier() {
        for (name, expected) in [
            ("N·V", "N_V"),
            ("a__b_", "a_b"),
            ("gl_x", "x_gl_x"),
            ("2d", "x_2d"),
            ("roughness (alpha)", "roughness_alpha"),
        ] {
            assert_eq!(plain(name), expected);
        }
    }

    #[test]
    fn what_is_reserved_by_its_beginning_is_renamed() {
        let names = Names::new(["gl_", "gl__", "gl_2"], ["gl"]);
        let signature = Signature::of("gl", &names, false);
        let naming =
            Naming::new(|name| name.starts_with("gl_"), str::to_owned, &signature, &names.outputs);
        assert_eq!(naming.written, ["gl", "x_gl", "x_gl_", "x_gl_2", "x_gl_3"]);
    }

    #[test]
    fn a_renamed_name_takes_none_that_another_may_keep() {
        let names = Names::new(["cos", "cos_", "_", ""], ["cos_2", "cos"]);
        let reserved = |name: &str| name == "cos" || name == "_";
        let signature = Signature::of("cos", &names, false);
        let naming = Naming::new(reserved, str::to_owned, &signature, &names.outputs);
        assert_eq!(naming.written, ["cos_3", "cos_4", "cos_", "x", "x_", "cos_2", "cos_5"]);
    }
}
