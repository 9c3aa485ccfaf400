//! Parsers of values on the command line.

use crate::search::MAX_CYCLES;
use std::time::Duration;

/// Parses a time: `60s`, `10m`, `1.5h`, `500ms`, or seconds alone.
pub fn duration(text: &str) -> Result<Duration, String> {
    let units = [("ms", 1e-3), ("s", 1.0), ("m", 60.0), ("min", 60.0), ("h", 3600.0)];
    let digits = text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len());
    let (number, unit) = text.split_at(digits);
    let unit = if unit.is_empty() { "s" } else { unit };
    let seconds = units.iter().find(|(name, _)| *name == unit).map(|(_, seconds)| seconds);
    match (number.trim().parse::<f64>(), seconds) {
        (Ok(number), Some(seconds)) if number >= 0.0 && number * seconds <= 1e8 => {
            Ok(Duration::from_secs_f64(number * seconds))
        }
        _ => Err("write a time as in 60s, 10m, 1.5h or 500ms".into()),
    }
}

/// Parses an error that is allowed.
pub fn error(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(error) if error.is_finite() && error >= 0.0 => Ok(error),
        _ => Err("an error that is allowed is a number, 0 or more".into()),
    }
}

/// Parses a cost budget in cycles.
pub fn cycles(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(cost) if (0.0..=MAX_CYCLES).contains(&cost) => Ok(cost),
        _ => {
            Err(format!("a cost budget is 0 to {MAX_CYCLES} cycles; no formula costs less than 0"))
        }
    }
}

/// Parses a number from 0 to 1.
pub fn share(text: &str) -> Result<f64, String> {
    let share = text.parse().ok().filter(|share| (0.0..=1.0).contains(share));
    share.ok_or_else(|| "a share is from 0 to 1".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_understood() {
        for (text, seconds) in
            [("60s", 60.0), ("60", 60.0), ("10m", 600.0), ("1.5h", 5400.0), ("500ms", 0.5)]
        {
            assert_eq!(duration(text), Ok(Duration::from_secs_f64(seconds)));
        }
        for text in ["", "s", "-1s", "1 year", "nan", "1e300h", "infs"] {
            assert!(duration(text).is_err(), "{text}");
        }
    }
}
