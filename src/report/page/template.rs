//! Templates of HTML, in which each `{{ name }}` stands for a value.

/// Fills a template with values, which are HTML.
///
/// # Panics
/// If a value is missing: the templates are part of the program.
pub(super) fn filled(template: &str, values: &[(&str, String)]) -> String {
    let mut pieces = template.strip_suffix('\n').unwrap_or(template).split("{{ ");
    let mut html = pieces.next().expect("one at least").to_owned();
    for piece in pieces {
        let (name, after) = piece.split_once(" }}").expect("a name ends");
        let known = values.iter().find(|(known, _)| *known == name);
        html += &known.unwrap_or_else(|| panic!("`{name}` has a value")).1;
        html += after;
    }
    html
}

/// Escapes text for HTML, attributes included.
pub(super) fn escaped(text: &str) -> String {
    let mut html = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => html += "&amp;",
            '<' => html += "&lt;",
            '>' => html += "&gt;",
            '"' => html += "&quot;",
            '\'' => html += "&#x27;",
            '/' => html += "&#x2f;",
            other => html.push(other),
        }
    }
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_put_in_as_it_is_and_no_name_in_it_is_looked_for() {
        let values = [("title", escaped("a<b & \"{{ data }}\"")), ("data", "[]".to_owned())];
        let html = filled("<h1>{{ title }}</h1>\n<p>{{ data }}</p>\n", &values);
        assert_eq!(html, "<h1>a&lt;b &amp; &quot;{{ data }}&quot;</h1>\n<p>[]</p>");
    }
}
