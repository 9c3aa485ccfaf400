//! Domains as text: `x=0..1,a=1e-3..1:log`.

use super::Error;
use crate::dataset::{Axis, LONGEST_NAME, Spacing, axis};
use crate::eval::Double;
use crate::program::{Names, Scope, parse_template, shortest};
use crate::suggest::did_you_mean;

/// Parses axes: `name=low..high` with commas between, `:log` after a range whose samples are to be
/// equidistant in the logarithm. Ends are numbers, also `pi` and what is computed of it. A component
/// of a vector may be written `v.x`: its axis is `v_x`.
///
/// # Errors
/// [`Error::Domain`] says what is wrong, and what to write.
pub fn parse_domain(text: &str) -> Result<Vec<Axis>, Error> {
    let items = text.split(',').map(str::trim).filter(|item| !item.is_empty());
    let axes: Vec<Axis> = items.map(parse_axis).collect::<Result<_, _>>()?;
    let repeated = (1..axes.len()).find(|&i| axes[..i].iter().any(|a| a.name == axes[i].name));
    match repeated {
        Some(index) => Err(wrong(text, format!("`{}` has two ranges", axes[index].name))),
        None => Ok(axes),
    }
}

/// Writes axes as [`parse_domain`] reads them.
pub fn write_domain(axes: &[Axis]) -> String {
    let written = axes.iter().map(|axis| {
        let [low, high] = axis.domain;
        let scale = if axis.spacing == Spacing::Logarithmic { ":log" } else { "" };
        format!("{}={low:?}..{high:?}{scale}", axis.name)
    });
    written.collect::<Vec<_>>().join(",")
}

/// Returns the axis of each input, in order.
///
/// # Errors
/// An input without a range, or a range without an input; both say which there are.
pub fn axes_of(domain: &[Axis], inputs: &[String]) -> Result<Vec<Axis>, Error> {
    let known = || inputs.iter().map(String::as_str);
    if inputs.is_empty() {
        return Err(Error::NoInputs);
    }
    if let Some(unknown) = domain.iter().find(|axis| known().all(|name| name != axis.name)) {
        let hint = did_you_mean(&unknown.name, known());
        let inputs = inputs.join(", ");
        let message =
            format!("there is no input `{}`{hint}; the inputs are {inputs}", unknown.name);
        return Err(Error::Domain(message));
    }
    let of = |name: &str| domain.iter().find(|axis| axis.name == name).cloned();
    let missing: Vec<&String> = inputs.iter().filter(|name| of(name).is_none()).collect();
    if missing.is_empty() {
        return Ok(inputs.iter().filter_map(|name| of(name)).collect());
    }
    let ranges: Vec<String> = missing.iter().map(|name| format!("{name}=0..1")).collect();
    let missing = missing.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    let message =
        format!("{missing}: no range is given; add it, as in --domain {}", ranges.join(","));
    Err(Error::Domain(message))
}

fn parse_axis(item: &str) -> Result<Axis, Error> {
    let shape = "write NAME=LOW..HIGH, as in x=0..1 or alpha=1e-3..1:log";
    let Some((name, range)) = item.split_once('=') else {
        return Err(wrong(item, shape.into()));
    };
    let name = column_name(name.trim());
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let begins = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    if !(begins && name.chars().all(is_name) && name.len() <= LONGEST_NAME) {
        return Err(wrong(item, format!("`{name}` is not a name; {shape}")));
    }
    let (range, spacing) = match range.trim().rsplit_once(':') {
        None => (range.trim(), Spacing::Linear),
        Some((range, "log")) => (range, Spacing::Logarithmic),
        Some((range, "lin" | "linear")) => (range, Spacing::Linear),
        Some((_, other)) => {
            return Err(wrong(item, format!("`:{other}` is no scale; write `:log`, or nothing")));
        }
    };
    let Some((low, high)) = range.split_once("..") else {
        return Err(wrong(item, format!("one value is no range; {shape}")));
    };
    let end = |text: &str| match number(text) {
        Some(value) if (value as f32).is_finite() => Ok(value),
        Some(_) => Err(wrong(item, format!("`{text}` is beyond the numbers of 32 bits"))),
        None => Err(wrong(item, format!("`{text}` is not a number; {shape}"))),
    };
    let (low, high) = (end(low)?, end(high)?);
    if low as f32 >= high as f32 {
        let [low, high] = [low, high].map(shortest);
        return Err(wrong(item, format!("{low} is not below {high}; write the lower end first")));
    }
    if spacing == Spacing::Logarithmic && low <= 0.0 {
        let message = "a logarithmic range begins above 0, as in alpha=1e-3..1:log";
        return Err(wrong(item, message.into()));
    }
    Ok(Axis { spacing, ..axis(&name, low..=high) })
}

/// Returns the column of a parameter or of a component of it: `v_x` of `v.x`.
pub fn column_name(name: &str) -> String {
    name.replace(['.', '[', ']'], "_").trim_end_matches('_').to_owned()
}

/// Returns the value of a number, or of an expression of numbers and `pi`.
fn number(text: &str) -> Option<f64> {
    if let Ok(value) = text.trim().parse::<f64>() {
        return value.is_finite().then_some(value);
    }
    let names = Names::new(["pi"], ["y"]);
    let parsed = parse_template(&format!("y = {text}"), Scope::Dataset(&names)).ok()?;
    if !parsed.free.is_empty() {
        return None;
    }
    let value = Double.evaluate_exact(&parsed.program, &parsed.exact, &[std::f64::consts::PI])[0];
    value.is_finite().then_some(value)
}

fn wrong(item: &str, message: String) -> Error {
    Error::Domain(format!("`{item}`: {message}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn domains_are_read_and_written() {
        let axes = parse_domain("x=0..1, v.x = -1...5,a=1e-3..1:log,theta=0..pi/2").unwrap();
        let names: Vec<_> = axes.iter().map(|axis| axis.name.as_ref()).collect();
        assert_eq!(names, ["x", "v_x", "a", "theta"]);
        assert_eq!(axes[1].domain, [-1.0, 0.5]);
        assert_eq!(axes[2].spacing, Spacing::Logarithmic);
        assert_eq!(axes[3].domain, [0.0, std::f64::consts::FRAC_PI_2]);
        assert_eq!(parse_domain(&write_domain(&axes)).unwrap(), axes);
    }

    #[test]
    fn what_is_no_domain_is_refused_with_the_reason() {
        for (text, reason) in [
            ("x", "write NAME=LOW..HIGH"),
            ("x=1", "one value is no range"),
            ("x=1..0", "lower end first"),
            ("x=0..1:log", "begins above 0"),
            ("x=0..1:exp", "no scale"),
            ("x=0..y", "`y` is not a number"),
            ("x=0..1e39", "beyond the numbers"),
            ("x=0..1,x=0..2", "two ranges"),
            ("1x=0..1", "not a name"),
        ] {
            let error = parse_domain(text).unwrap_err().to_string();
            assert!(error.contains(reason), "{text}: {error}");
        }
    }
}
