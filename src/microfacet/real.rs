//! The numbers that scalar terms are computed with.

use std::fmt::{Debug, LowerExp};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The two precisions, f32 and f64, in which the scalar terms are computed.
pub trait Real:
    Copy
    + Debug
    + LowerExp
    + PartialOrd
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    /// 0
    const ZERO: Self;
    /// 1
    const ONE: Self;
    /// 2
    const TWO: Self;
    /// ½
    const HALF: Self;
    /// π
    const PI: Self;

    /// The nearest number of this precision.
    fn of(value: f64) -> Self;
    /// The magnitude.
    fn abs(self) -> Self;
    /// The square root.
    fn sqrt(self) -> Self;
    /// `e^self`
    fn exp(self) -> Self;
    /// `self^exponent`
    fn powf(self, exponent: Self) -> Self;
    /// `ln(1 + self)`, accurate near 0.
    fn ln_1p(self) -> Self;
    /// The complementary error function.
    fn erfc(self) -> Self;
    /// The smaller; the other one if one is NaN.
    fn min(self, other: Self) -> Self;
    /// The larger; the other one if one is NaN.
    fn max(self, other: Self) -> Self;

    /// `self²`
    fn squared(self) -> Self {
        self * self
    }
}

macro_rules! real {
    ($type:ident, $erfc:path) => {
        impl Real for $type {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const TWO: Self = 2.0;
            const HALF: Self = 0.5;
            const PI: Self = std::$type::consts::PI;

            fn of(value: f64) -> Self {
                value as Self
            }
            fn abs(self) -> Self {
                self.abs()
            }
            fn sqrt(self) -> Self {
                self.sqrt()
            }
            fn exp(self) -> Self {
                self.exp()
            }
            fn powf(self, exponent: Self) -> Self {
                self.powf(exponent)
            }
            fn ln_1p(self) -> Self {
                self.ln_1p()
            }
            fn erfc(self) -> Self {
                $erfc(self)
            }
            fn min(self, other: Self) -> Self {
                self.min(other)
            }
            fn max(self, other: Self) -> Self {
                self.max(other)
            }
        }
    };
}

real!(f32, libm::erfcf);
real!(f64, libm::erfc);

/// `1 - cosine²` without the cancellation near 1; 0 for a cosine that rounding
/// has taken above 1.
pub fn sine_squared<T: Real>(cosine: T) -> T {
    ((T::ONE - cosine) * (T::ONE + cosine)).max(T::ZERO)
}

#[cfg(test)]
mod tests {
    use super::sine_squared;

    #[test]
    fn a_cosine_rounded_above_one_has_no_sine() {
        assert_eq!(sine_squared(1.000_000_1_f32), 0.0);
        let small = 2.0_f64.powi(-40);
        assert_eq!(sine_squared(1.0 - small), small * (2.0 - small));
    }
}
