//! Which products of inputs have no unit, or an output's, by the units that columns state.

use crate::dataset::Column;
use serde::Serialize;
use std::collections::BTreeMap;

/// The highest power, and the most inputs of a product. By hand: longer ones are rarely meant.
const HIGHEST_POWER: i32 = 2;
const MOST_FACTORS: usize = 3;

/// The most products that are told. By hand: a hint, not a list.
const MOST: usize = 8;

/// A product of powers of inputs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Combination {
    /// As formula text.
    pub text: String,
    /// The output whose unit it has; null if it has none.
    pub unit_of: Option<String>,
    /// That unit.
    pub unit: String,
}

/// Powers of base units by their symbols.
type Dimension = BTreeMap<String, i32>;

/// Lists the products of powers of inputs with units that have none, and those that have an
/// output's unit. Empty where columns state no units. Symbols are compared as they stand, metres
/// apart from millimetres; angles and ratios (`rad`, `deg`, `sr`, `%`) have none.
pub fn combinations_by_unit(inputs: &[Column], outputs: &[Column]) -> Vec<Combination> {
    let with_units: Vec<(&str, Dimension)> = inputs
        .iter()
        .filter_map(|column| Some((column.name.as_str(), dimension(&column.unit)?)))
        .filter(|(_, dimension)| !dimension.is_empty())
        .collect();
    let mut products = Vec::new();
    chosen(&with_units, 0, &mut Vec::new(), &mut products);
    products.sort_by_key(|powers: &Vec<(usize, i32)>| {
        (powers.len(), powers.iter().map(|(_, power)| power.abs()).sum::<i32>())
    });
    let mut found = Vec::new();
    for powers in &products {
        let total = product(powers.iter().map(|&(at, power)| (&with_units[at].1, power)));
        let text = || text(powers, &with_units);
        // A power of a product says no more than the product.
        let whole = powers.iter().fold(0, |all, (_, power)| common_divisor(all, power.abs())) == 1;
        if total.is_empty() && powers[0].1 > 0 && whole {
            found.push(Combination { text: text(), unit_of: None, unit: "1".into() });
        }
        for output in outputs {
            if !total.is_empty() && dimension(&output.unit).as_ref() == Some(&total) {
                let (unit_of, unit) = (Some(output.name.clone()), output.unit.clone());
                found.push(Combination { text: text(), unit_of, unit });
            }
        }
    }
    found.truncate(MOST);
    found
}

fn chosen(
    columns: &[(&str, Dimension)],
    first: usize,
    powers: &mut Vec<(usize, i32)>,
    products: &mut Vec<Vec<(usize, i32)>>,
) {
    if !powers.is_empty() {
        products.push(powers.clone());
    }
    if powers.len() == MOST_FACTORS {
        return;
    }
    for at in first..columns.len() {
        for power in (-HIGHEST_POWER..=HIGHEST_POWER).filter(|power| *power != 0) {
            powers.push((at, power));
            chosen(columns, at + 1, powers, products);
            powers.pop();
        }
    }
}

fn common_divisor(a: i32, b: i32) -> i32 {
    if b == 0 { a } else { common_divisor(b, a % b) }
}

fn product<'a>(factors: impl Iterator<Item = (&'a Dimension, i32)>) -> Dimension {
    let mut total = Dimension::new();
    for (dimension, power) in factors {
        for (symbol, own) in dimension {
            *total.entry(symbol.clone()).or_default() += own * power;
        }
    }
    total.retain(|_, power| *power != 0);
    total
}

fn text(powers: &[(usize, i32)], columns: &[(&str, Dimension)]) -> String {
    let factor = |&(at, power): &(usize, i32)| match power.abs() {
        1 => columns[at].0.to_owned(),
        power => format!("{}^{power}", columns[at].0),
    };
    let part = |above: bool| -> Vec<String> {
        powers.iter().filter(|(_, power)| (*power > 0) == above).map(factor).collect()
    };
    let (above, below) = (part(true), part(false));
    let above = if above.is_empty() { "1".to_owned() } else { above.join("*") };
    below.iter().fold(above, |text, factor| format!("{text}/{factor}"))
}

/// Reads a unit such as `cd/m^2`, `W·m⁻²` or `kg m s-2`; none if it is not understood.
fn dimension(unit: &str) -> Option<Dimension> {
    let mut dimension = Dimension::new();
    let mut sign = 1;
    let mut symbols = unit.trim();
    while let Some(first) = symbols.chars().next() {
        if first.is_whitespace() || "*·⋅".contains(first) {
            symbols = &symbols[first.len_utf8()..];
        } else if first == '/' {
            sign = -1;
            symbols = &symbols[1..];
        } else {
            let is_symbol = |c: char| c.is_alphabetic() || "%°µ".contains(c);
            let end = symbols.find(|c| !is_symbol(c)).unwrap_or(symbols.len());
            let (symbol, rest) = symbols.split_at(end);
            if symbol.is_empty() && first != '1' {
                return None;
            }
            let rest = if symbol.is_empty() { &rest[1..] } else { rest };
            let (power, rest) = power(rest)?;
            symbols = rest;
            if !["", "rad", "deg", "sr", "%", "°"].contains(&symbol) {
                *dimension.entry(symbol.to_owned()).or_default() += sign * power;
            }
        }
    }
    dimension.retain(|_, power| *power != 0);
    Some(dimension)
}

/// Reads a power after a symbol, one if there is none.
fn power(text: &str) -> Option<(i32, &str)> {
    const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    const PLAIN: &str = "0123456789-";
    let marked = text.strip_prefix('^');
    let digits = marked.unwrap_or(text);
    let is_part = |c: char| PLAIN.contains(c) || RAISED.contains(c);
    let end = digits.find(|c| !is_part(c)).unwrap_or(digits.len());
    let plain = |c: char| {
        RAISED
            .chars()
            .position(|raised| raised == c)
            .map_or(c, |at| PLAIN.chars().nth(at).unwrap_or(c))
    };
    let written: String = digits[..end].chars().map(plain).collect();
    match (written.is_empty(), marked) {
        (true, None) => Some((1, text)),
        (true, Some(_)) => None,
        (false, _) => {
            Some((written.parse().ok().filter(|power: &i32| power.abs() < 100)?, &digits[end..]))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(name: &str, unit: &str) -> Column {
        Column { unit: unit.to_owned(), ..Column::new(name, [0.0, 1.0]) }
    }

    #[test]
    fn units_are_read_as_people_write_them() {
        let of = |unit: &str| dimension(unit).map(|d| format!("{d:?}"));
        assert_eq!(of("cd/m^2"), of("cd·m⁻²"));
        assert_eq!(of("kg m s-2"), of("kg*m/s2"));
        assert_eq!([of("1"), of(""), of("rad"), of("1/sr")], [(); 4].map(|()| Some("{}".into())));
        assert_eq!(of("m^"), None);
        assert_eq!(of("(m)"), None);
    }

    #[test]
    fn products_of_inputs_have_no_unit_or_an_outputs() {
        let inputs = [column("depth", "m"), column("falloff", "1/m"), column("angle", "rad")];
        let found = combinations_by_unit(&inputs, &[column("radius", "m")]);
        let texts: Vec<_> = found.iter().map(|c| (c.text.as_str(), c.unit_of.as_deref())).collect();
        assert_eq!(texts[..2], [("depth", Some("radius")), ("1/falloff", Some("radius"))]);
        assert!(texts.contains(&("depth*falloff", None)), "{texts:?}");
        assert!(combinations_by_unit(&inputs[2..], &[column("y", "1")]).is_empty());
    }
}
