//! What a browser lets a page do: run its own script and show its own style, and nothing else.

use super::STYLE;
use base64::{Engine, prelude::BASE64_STANDARD};
use sha2::{Digest, Sha256};

/// A template's values: the content security policy that allows no other style and script than the page's
/// own, no network and no forms, and those two.
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
