//! Numbers: vectors of lanes and the mathematics on them.
//!
//! [`Lanes`] is a register of `f32`s. [`math`] is written once over it, and so gives the same bits
//! at every width: one `f32` (the scalar reference), sixteen in plain code, in two AVX2 registers,
//! or in one AVX-512 register. [`Interval`] bounds what a computation can give, [`Span`] a real
//! number. [`low_discrepancy`] spreads points over a cube, and [`CompensatedSum`] adds without
//! losing digits.

mod directed;
mod interval;
mod lanes;
pub mod low_discrepancy;
mod many;
pub mod math;
mod span;
mod sum;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use interval::{Interval, enclose, inside};
pub use lanes::Lanes;
pub use many::Many;
pub use span::Span;
pub use sum::CompensatedSum;
#[cfg(target_arch = "x86_64")]
pub use x86::{Avx2, Avx512};
