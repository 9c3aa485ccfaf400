//! Ranges and ticks of the two axes.

/// The smallest and largest error drawn; others are drawn there.
const ERRORS: (f64, f64) = (1e-30, 1e30);
const MAX_CYCLES: f64 = 1e15;

/// The part of the axis of errors below the least of them where some are zero.
const ROOM_FOR_ZERO: f64 = 0.12;

/// A mark on an axis: its place, from 0 to 1, and its text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub place: f64,
    pub text: String,
}

/// Cycles, linear from zero to a whole number of steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cycles {
    step: f64,
    steps: u32,
}

impl Cycles {
    pub(super) fn over(cycles: impl Iterator<Item = f64>) -> Cycles {
        // Room for the marker of the most expensive one.
        let most = cycles.fold(0.0, f64::max).min(MAX_CYCLES) * 1.01;
        let mut steps = (0..).map(|i| mantissa(i) * 10f64.powi(i / 3));
        let step = steps.find(|step| step * 10.0 >= most).unwrap_or(MAX_CYCLES);
        Cycles { step, steps: ((most / step).ceil() as u32).max(4) }
    }

    pub(super) fn place(&self, cycles: f64) -> f64 {
        (cycles / (self.step * f64::from(self.steps))).clamp(0.0, 1.0)
    }

    pub(super) fn ticks(&self) -> Vec<Tick> {
        let tick = |i: u32| {
            let cycles = self.step * f64::from(i);
            Tick { place: self.place(cycles), text: cycles.to_string() }
        };
        (0..=self.steps).map(tick).collect()
    }
}

/// Errors, on a logarithmic axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Errors {
    /// The logarithm of the least, to the base 10.
    least: f64,
    most: f64,
    /// The part of the axis below the least.
    below: f64,
}

impl Errors {
    pub(super) fn over(errors: impl Iterator<Item = f64>) -> Errors {
        let (mut least, mut most, mut below) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
        for error in errors {
            match logarithm(error) {
                Some(logarithm) => (least, most) = (least.min(logarithm), most.max(logarithm)),
                None => below = ROOM_FOR_ZERO,
            }
        }
        if least > most {
            (least, most) = (-2.0, -1.0);
        }
        // Room for markers, and at least the 0.7 decades that always hold two ticks.
        let margin = (0.05 * (most - least)).max(0.4 - 0.5 * (most - least)).max(0.04);
        Errors { least: least - margin, most: most + margin, below }
    }

    pub(super) fn place(&self, error: f64) -> f64 {
        logarithm(error).map_or(0.0, |logarithm| self.place_of(logarithm))
    }

    fn place_of(&self, logarithm: f64) -> f64 {
        let part = (logarithm - self.least) / (self.most - self.least);
        self.below + (1.0 - self.below) * part.clamp(0.0, 1.0)
    }

    /// Returns ticks no closer than `closest`, a part of the axis: 1, 2 and 5 of each decade, or 1
    /// of every few.
    pub(super) fn ticks(&self, closest: f64) -> Vec<Tick> {
        let per_decade = (1.0 - self.below) / (self.most - self.least);
        let every = if 2f64.log10() * per_decade >= closest {
            1
        } else {
            3 * ((closest / per_decade).ceil() as i32).max(1)
        };
        let first = 3 * (self.least.floor() as i32);
        let last = 3 * (self.most.ceil() as i32);
        let zero = (self.below > 0.0).then(|| Tick { place: 0.0, text: "0".into() });
        let seen = |i: &i32| (self.least..=self.most).contains(&tick_logarithm(*i));
        let tick = |i: i32| Tick { place: self.place_of(tick_logarithm(i)), text: decimal(i) };
        let others = (first..=last).filter(|i| i.rem_euclid(every) == 0).filter(seen).map(tick);
        zero.into_iter().chain(others).collect()
    }
}

fn logarithm(error: f64) -> Option<f64> {
    let (least, most) = ERRORS;
    (error >= least).then(|| error.min(most).log10())
}

/// Returns 1, 2, 5 in turn.
fn mantissa(i: i32) -> f64 {
    [1.0, 2.0, 5.0][i.rem_euclid(3) as usize]
}

fn tick_logarithm(i: i32) -> f64 {
    mantissa(i).log10() + f64::from(i.div_euclid(3))
}

/// Formats a tick's number, such as .002, with a power of ten if zeros would have to be counted.
fn decimal(i: i32) -> String {
    let (mantissa, exponent) = (mantissa(i), i.div_euclid(3));
    match exponent {
        0..=4 => format!("{}", mantissa * 10f64.powi(exponent)),
        -4..=-1 => format!(".{mantissa:0>width$}", width = exponent.unsigned_abs() as usize),
        _ if mantissa == 1.0 => format!("10{}", superscript(exponent)),
        _ => format!("{mantissa}·10{}", superscript(exponent)),
    }
}

fn superscript(exponent: i32) -> String {
    let raised = |character| match character {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' => '⁰',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    exponent.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(ticks: Vec<Tick>) -> Vec<String> {
        ticks.into_iter().map(|tick| tick.text).collect()
    }

    #[test]
    fn cycles_end_on_a_tick() {
        let ticks = texts(Cycles::over([8.0, 49.0].into_iter()).ticks());
        assert_eq!(ticks, ["0", "5", "10", "15", "20", "25", "30", "35", "40", "45", "50"]);
        assert_eq!(texts(Cycles::over([].into_iter()).ticks()), ["0", "1", "2", "3", "4"]);
        assert!(Cycles::over([f64::MAX].into_iter()).ticks().len() <= 11);
    }

    #[test]
    fn errors_tick_at_one_two_and_five() {
        let ticks = texts(Errors::over([0.0062, 0.17].into_iter()).ticks(0.06));
        assert_eq!(ticks, [".01", ".02", ".05", ".1", ".2"]);
        let ticks = texts(Errors::over([0.0, 0.5, 12.0].into_iter()).ticks(0.06));
        assert_eq!(ticks, ["0", ".5", "1", "2", "5", "10"]);
        assert_eq!(texts(Errors::over([0.25].into_iter()).ticks(0.06)), [".1", ".2", ".5"]);
    }

    #[test]
    fn wide_ranges_tick_at_decades() {
        let ticks = texts(Errors::over([1.1e-12, 9e4].into_iter()).ticks(0.06));
        assert_eq!(ticks.first().map(String::as_str), Some("10⁻¹²"));
        assert!(ticks.iter().any(|text| text == ".01"));
        assert!(ticks.len() <= 17);
        let all = Errors::over([f64::MIN_POSITIVE, f64::MAX].into_iter()).ticks(0.06);
        assert!((3..=18).contains(&all.len()));
    }
}
