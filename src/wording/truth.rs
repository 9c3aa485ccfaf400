//! Errors against the truth in words.

use super::verdict::{input_text, share_text, value_text};
use crate::stability::{ErrorRecord, TruthRecord};
use std::cmp::Ordering;

/// Says how far an output may be from the truth, and on GPUs where that differs: `|y − truth| ≤
/// 6.81e-5 on the whole domain: proved (largest seen 6.75e-5 at x = 0.31)`.
pub fn truth_sentence(record: &TruthRecord) -> String {
    let distance = format!("|{} − truth|", record.output);
    let exact = error_text(&distance, &record.exact);
    match &record.gpu {
        Some(gpu) if differs(&record.exact, gpu) => format!("{exact}; on GPUs {}", short_text(gpu)),
        _ => exact,
    }
}

/// Returns true if the status is another, or the bound in three digits.
fn differs(exact: &ErrorRecord, gpu: &ErrorRecord) -> bool {
    gpu.status != exact.status || gpu.most.map(rounded_up) != exact.most.map(rounded_up)
}

fn error_text(distance: &str, error: &ErrorRecord) -> String {
    match (error.status.as_str(), error.most, error.seen) {
        ("proved", Some(most), _) => {
            let most = rounded_up(most);
            format!("{distance} ≤ {most} on the whole domain{}: proved{}", gap(error), seen(error))
        }
        ("sampled", _, Some(seen)) => {
            let at = at(error).replacen(' ', "", 1);
            format!("{distance} ≤ {} on every sample (largest {at})", rounded_up(seen))
        }
        _ => format!("{distance}: {}", short_text(error)),
    }
}

/// Says the same without naming the distance.
fn short_text(error: &ErrorRecord) -> String {
    match (error.status.as_str(), error.most, &error.value) {
        ("proved", Some(most), _) => format!("≤ {}: proved", rounded_up(most)),
        ("refuted", _, Some(value)) => format!("refuted: {}{}", value_text(value), at(error)),
        ("open", ..) => {
            let share = match error.volume {
                Some(share) if share > 0.0 => {
                    format!("open in {} of the domain", share_text(share))
                }
                // A few single inputs have no share.
                _ => "open at single inputs".to_owned(),
            };
            format!("{share}{}", seen(error))
        }
        _ => error.status.clone(),
    }
}

fn at(error: &ErrorRecord) -> String {
    error.input.as_ref().map_or(String::new(), |input| format!(" at {}", input_text(input)))
}

fn seen(error: &ErrorRecord) -> String {
    let seen = |seen| format!(" (largest seen {}{})", rounded_down(seen), at(error));
    error.seen.map_or(String::new(), seen)
}

fn gap(error: &ErrorRecord) -> String {
    match (&error.gap, error.gaps) {
        (Some(input), 1) => {
            format!(", except at {}, where the truth may have no value", input_text(input))
        }
        (Some(input), gaps) => {
            let input = input_text(input);
            format!(", except at {gaps} inputs such as {input}, where the truth may have no value")
        }
        (None, _) => String::new(),
    }
}

/// Formats a number that is not negative with three significant digits, none of which makes it
/// smaller.
pub fn rounded_up(number: f64) -> String {
    rounded(number, Ordering::Less)
}

/// Formats a number that is not negative with three significant digits, none of which makes it
/// larger.
pub fn rounded_down(number: f64) -> String {
    rounded(number, Ordering::Greater)
}

/// Rounds to the nearest, and once more where that compares with the number as it must not.
fn rounded(number: f64, wrong: Ordering) -> String {
    if number == 0.0 || !number.is_finite() {
        return number.to_string();
    }
    let nearest = format!("{number:.2e}");
    let Some((digits, exponent)) = nearest.split_once('e') else { return nearest };
    let digits: i64 = digits.replace('.', "").parse().unwrap_or(0);
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let value = |tenths: i64| format!("{tenths}e{}", exponent - 3).parse().unwrap_or(number);
    let tenths = 10 * digits;
    let moved = match value(tenths).partial_cmp(&number) {
        Some(order) if order == wrong && wrong == Ordering::Less => tenths + 10,
        // Below 1.00 is 0.999.
        Some(order) if order == wrong => tenths - if digits == 100 { 1 } else { 10 },
        _ => tenths,
    };
    let text = format!("{:.2e}", value(moved));
    let exponent = text.split_once('e').and_then(|(_, exponent)| exponent.parse().ok());
    let exponent: i32 = exponent.unwrap_or(0);
    match (-3..4).contains(&exponent) {
        true => format!("{:.*}", (2 - exponent).max(0) as usize, value(moved)),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Names;
    use crate::stability::ErrorBound;

    fn names() -> Names {
        Names::new(["x"], ["y"])
    }

    fn bound(proved: f64, seen: f64) -> ErrorBound {
        ErrorBound {
            proved,
            seen,
            at: vec![0.31],
            value: 0.5,
            reach: seen,
            volume: 0.0,
            worst: vec![0.3],
            gap: None,
            gaps: 0,
            boxes: 100,
        }
    }

    fn sentence(exact: &ErrorBound, gpu: Option<&ErrorBound>) -> String {
        let record = |bound: &ErrorBound| ErrorRecord::new(bound, &names());
        let record =
            TruthRecord { output: "y".to_owned(), exact: record(exact), gpu: gpu.map(record) };
        let json = serde_json::to_string(&record).unwrap();
        assert_eq!(serde_json::from_str::<TruthRecord>(&json).unwrap(), record, "{json}");
        truth_sentence(&record)
    }

    #[test]
    fn bounds_are_rounded_up_and_what_was_seen_down() {
        let up = [6.8001e-5, 6.805e-5, 0.0231, 9.991, 9.999e-5, 0.0, 1234.5].map(rounded_up);
        assert_eq!(up, ["6.81e-5", "6.81e-5", "0.0231", "10.0", "1.00e-4", "0", "1240"]);
        let down = [6.8099e-5, 0.02319, 9.999, 1.0e-4, 1.0009, 1000.1].map(rounded_down);
        assert_eq!(down, ["6.80e-5", "0.0231", "9.99", "1.00e-4", "1.00", "1000"]);
        for i in 1..10_000 {
            let number = f64::from(i).sqrt() * 1e-6;
            let [up, down] = [rounded_up(number), rounded_down(number)].map(|x| x.parse().unwrap());
            assert!(number <= up && down <= number && up - down < 0.0101 * number, "{number}");
        }
    }

    #[test]
    fn sentences_say_what_is_proved_and_what_was_seen() {
        let proved = bound(6.8001e-5, 6.7999e-5);
        let text =
            "|y − truth| ≤ 6.81e-5 on the whole domain: proved (largest seen 6.79e-5 at x = 0.31)";
        assert_eq!(sentence(&proved, None), text);
        assert_eq!(sentence(&proved, Some(&bound(6.8002e-5, 6.7999e-5))), text);
        let gpu = bound(7e-5, 6.7999e-5);
        assert_eq!(sentence(&proved, Some(&gpu)), format!("{text}; on GPUs ≤ 7.00e-5: proved"));
        let open = ErrorBound { volume: 0.002, ..bound(f64::INFINITY, 6.7999e-5) };
        let open_text = "open in 0.20 % of the domain (largest seen 6.79e-5 at x = 0.31)";
        assert_eq!(sentence(&open, None), format!("|y − truth|: {open_text}"));
        assert_eq!(sentence(&proved, Some(&open)), format!("{text}; on GPUs {open_text}"));
        let gap = ErrorBound { gap: Some(vec![0.0]), gaps: 1, ..proved };
        assert!(
            sentence(&gap, None)
                .contains("domain, except at x = 0.0, where the truth may have no value: ")
        );
        let none = ErrorBound { value: f32::NAN, ..bound(f64::INFINITY, f64::INFINITY) };
        assert_eq!(sentence(&none, None), "|y − truth|: refuted: NaN at x = 0.31");
        let sampled = ErrorRecord::sampled(6.7999e-5, &[0.31], 0.5, &names());
        let record = TruthRecord { output: "y".to_owned(), exact: sampled, gpu: None };
        assert_eq!(
            truth_sentence(&record),
            "|y − truth| ≤ 6.80e-5 on every sample (largest at x = 0.31)"
        );
    }
}
