//! What a browser lets a page do: run its own script and show its own style, and nothing else.

use super::STYLE;
use base64::{Engine, prelude::BASE64_STANDARD};
use minijinja::{Value, context};
use sha2::{Digest, Sha256};

/// A page's own style and script, and the content security policy that allows no others, no network and
/// no forms.
pub(super) fn own(script: &str) -> Value {
    let script = unix(&format!("\n\"use strict\";\n(() => {{\n{script}\n}})();\n"));
    let style = unix(STYLE);
    let policy = format!(
        "default-src 'none'; script-src '{}'; style-src '{}'; img-src data:; base-uri 'none'; form-action 'none'",
        hash(&script),
        hash(&style)
    );
    let safe = Value::from_safe_string;
    context! { policy => safe(policy), style => safe(style), script => safe(script) }
}

/// As a content security policy names the text of an element.
fn hash(text: &str) -> String {
    format!("sha256-{}", BASE64_STANDARD.encode(Sha256::digest(text)))
}

/// A browser hashes what it has read, in which a line ends in `\n`.
fn unix(text: &str) -> String {
    text.replace("\r\n", "\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_are_those_of_browsers() {
        // The example of the standard's text, https://www.w3.org/TR/CSP3/#external-hash.
        let expected = "sha256-qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng=";
        assert_eq!(hash("alert('Hello, world.');"), expected);
    }
}
