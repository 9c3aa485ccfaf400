//! "Did you mean": the known name nearest to an unknown one.

/// The candidate most like `name`, if one is close enough to be worth naming.
///
/// ```
/// assert_eq!(lgp::suggest::nearest("rougness", ["n_dot_v", "roughness"]), Some("roughness"));
/// assert_eq!(lgp::suggest::nearest("zzz", ["n_dot_v", "roughness"]), None);
/// ```
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    candidates
        .into_iter()
        .map(|candidate| (strsim::jaro_winkler(name, candidate), candidate))
        .filter(|(likeness, _)| *likeness > 0.72)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

/// `"; did you mean `x`?"`, or nothing.
pub fn did_you_mean<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, candidates).map_or_else(String::new, |n| format!("; did you mean `{n}`?"))
}
