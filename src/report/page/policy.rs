//! The content security policy of a page, which allows its own script and style and nothing else.

use super::STYLE;
use base64::{Engine, prelude::BASE64_STANDARD};
use sha2::{Digest, Sha256};

/// Returns a template's values: the page's script and style, and the policy that allows no others,
/// no network and no forms.
pub(super) fn own(script: &str) -> [(&'static str, String); 3] {
    let script = unix(&format!("\n\"use strict\";\n(() => {{\n{script}\n}})();\n"));
    let style = unix(STYLE);
    let policy = format!(
        "default-src 'none'; script-src '{}'; style-src '{}'; img-src data:; base-uri 'none'; form-action 'none'",
        hash(&script),
        hash(&style)
    );
    [("policy", policy), ("style", style), ("script", script)]
}

/// Returns the hash of an element's text, as a content security policy spells it.
fn hash(text: &str) -> String {
    format!("sha256-{}", BASE64_STANDARD.encode(Sha256::digest(text)))
}

/// Ends lines in `\n`, as a browser does before it hashes.
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
