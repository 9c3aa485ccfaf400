//! Checks the names of datasets, columns' units and published formulas. Names become folders,
//! titles, comments and rows of tables, and must be harmless in all of them.

use crate::printable::is_hidden;

/// The most bytes of a name. File systems allow 255; extensions need some.
pub const LONGEST_NAME: usize = 200;

/// Names of devices on some system, whatever their extension.
const DEVICES: &str = "con prn aux nul com0 com1 com2 com3 com4 com5 com6 com7 com8 com9 lpt0 lpt1 lpt2 \
    lpt3 lpt4 lpt5 lpt6 lpt7 lpt8 lpt9";

/// The reason why a text cannot be a name.
#[allow(missing_docs, reason = "the messages say it")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NameFault {
    #[error("it is empty")]
    Empty,
    #[error("it is longer than {LONGEST_NAME} bytes")]
    Long,
    #[error("it holds a control character, or one that turns the direction of text")]
    Hidden,
    #[error("it is a path, and must be a name within a folder")]
    Path,
    #[error("some systems reserve it for a device")]
    Device,
}

/// Checks that a text can name a dataset, a run or a scene: one line that names a file within a
/// folder on every system.
///
/// # Errors
/// [`NameFault`]: what is wrong with it.
pub fn check_name(name: &str) -> Result<(), NameFault> {
    check_text(name)?;
    let stem = name.split('.').next().unwrap_or_default().trim_end().to_ascii_lowercase();
    match name {
        "" => Err(NameFault::Empty),
        "." | ".." => Err(NameFault::Path),
        _ if name.contains(['/', '\\']) => Err(NameFault::Path),
        _ if DEVICES.split_whitespace().any(|device| device == stem) => Err(NameFault::Device),
        _ => Ok(()),
    }
}

/// Checks that a text can be a unit, or the name of something that is not a file.
///
/// # Errors
/// [`NameFault`]: what is wrong with it.
pub fn check_text(text: &str) -> Result<(), NameFault> {
    match text {
        _ if text.len() > LONGEST_NAME => Err(NameFault::Long),
        _ if text.contains(is_hidden) => Err(NameFault::Hidden),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_files_within_a_folder() {
        for name in ["dfg", "a b", "ünï 😀", "<script>", "v1.5", ".hidden", "console", "x;y"] {
            assert_eq!(check_name(name), Ok(()), "{name}");
        }
        let long = "x".repeat(LONGEST_NAME + 1);
        for (name, fault) in [
            ("", NameFault::Empty),
            ("..", NameFault::Path),
            (".", NameFault::Path),
            ("../../x", NameFault::Path),
            ("/etc/x", NameFault::Path),
            (r"C:\x", NameFault::Path),
            ("a\0", NameFault::Hidden),
            ("a\nb", NameFault::Hidden),
            ("\u{1b}[31m", NameFault::Hidden),
            ("\u{202e}gpj.x", NameFault::Hidden),
            ("NUL", NameFault::Device),
            ("com1.x", NameFault::Device),
            (&long, NameFault::Long),
        ] {
            assert_eq!(check_name(name), Err(fault), "{name}");
        }
    }
}
