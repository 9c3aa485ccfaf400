//! The one table of operations, and their reference semantics.
//!
//! A row says what an operation computes, how accurately, and what kind of function it is; bounds,
//! proofs and tests read it here. All else that is known of an operation (bulk kernel, derivative,
//! cost, spelling in each language) is a `match` or a table keyed by [`Op`], complete by
//! construction or by test.
//!
//! ```
//! use lgp::op::Op;
//!
//! let mad = Op::from_name("mad").expect("a row of the table");
//! assert_eq!(mad.apply([2.0f32, 3.0, 1.0, 0.0]), 7.0);
//! assert!(mad.arity() == 3 && mad.commutes());
//! ```

mod accuracy;

pub use accuracy::{Accuracy, Tolerance};

use crate::num::{Lanes, math};
use accuracy::{EXACT, IN_STEPS, within, within_ulps as ulps};
use std::fmt;

/// The kind of function that an operation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Sums, products, signs, and mixtures of them.
    Arithmetic,
    /// A quotient of two, or the inverse of one.
    Quotient,
    /// Square roots and their inverses.
    Root,
    /// Exponentials, logarithms, and functions made of them.
    Exponential,
    /// Trigonometric functions and their inverses.
    Trigonometric,
    /// Choices between arguments, roundings to whole numbers, signs as numbers.
    Choice,
}

/// Calls `$then! { rows }` with the table: variant, name in formula text, arguments; then
/// `commutes` if the first two arguments may be swapped, `piecewise` if the function has a kink or
/// a jump, `needs_positive` if it is NaN for a negative first argument; family; the accuracy of the
/// interpreter, which `num::math` explains and measures, and the accuracy that GPUs owe (see
/// [`Op::gpu_accuracy`]); meaning over [`Lanes`].
macro_rules! operations {
    ($then:ident) => {
        $then! {
            /// `a + b`
            Add "add" (a, b) [commutes] Arithmetic (ulps(0.5), ulps(1.0)) = a + b;
            /// `a − b`
            Sub "sub" (a, b) [] Arithmetic (ulps(0.5), ulps(1.0)) = a - b;
            /// `a · b`
            Mul "mul" (a, b) [commutes] Arithmetic (ulps(0.5), ulps(1.0)) = a * b;
            /// `a / b`
            Div "div" (a, b) [] Quotient (ulps(0.5), ulps(2.5)) = a / b;
            /// `−a`
            Neg "neg" (a) [] Arithmetic (EXACT, EXACT) = a.neg();
            /// `|a|`
            Abs "abs" (a) [piecewise] Choice (EXACT, EXACT) = a.abs();
            /// The smaller; NaN if either is.
            Min "min" (a, b) [commutes piecewise] Choice (EXACT, EXACT) = a.minimum(b);
            /// The larger; NaN if either is.
            Max "max" (a, b) [commutes piecewise] Choice (EXACT, EXACT) = a.maximum(b);
            /// `min(max(a, 0), 1)`
            Saturate "saturate" (a) [piecewise] Choice (EXACT, EXACT) = math::saturate(a);
            /// `a · b + c`, rounded once
            Mad "mad" (a, b, c) [commutes] Arithmetic (ulps(0.5), ulps(1.0)) = a.fma(b, c);
            /// `1 / a`
            Rcp "rcp" (a) [] Quotient (ulps(0.5), ulps(2.5)) = math::rcp(a);
            /// `√a`
            Sqrt "sqrt" (a) [needs_positive] Root (ulps(0.5), ulps(4.6)) = a.sqrt();
            /// `1 / √a`
            Rsqrt "rsqrt" (a) [needs_positive] Root (ulps(1.5), ulps(2.0)) = math::rsqrt(a);
            /// `2^a`
            Exp2 "exp2" (a) [] Exponential (ulps(1.0), within(POWER)) = math::exp2(a);
            /// `log₂ a`
            Log2 "log2" (a) [needs_positive] Exponential (ulps(2.0), within(LOGARITHM)) = math::log2(a);
            /// `e^a`
            Exp "exp" (a) [] Exponential (ulps(2.0), within(POWER)) = math::exp(a);
            /// `ln a`
            Log "log" (a) [needs_positive] Exponential (ulps(2.0), within(LOGARITHM)) = math::log(a);
            /// `exp2(b · log2(a))`
            Pow "pow" (a, b) [needs_positive] Exponential (IN_STEPS, IN_STEPS) = math::pow(a, b);
            /// `sin a`, radians
            Sin "sin" (a) [] Trigonometric (within(WAVE), within(GPU_WAVE)) = math::sin(a);
            /// `cos a`, radians
            Cos "cos" (a) [] Trigonometric (within(WAVE), within(GPU_WAVE)) = math::cos(a);
            /// `tan a`, radians
            Tan "tan" (a) [] Trigonometric (within(WAVES_QUOTIENT), IN_STEPS) = math::tan(a);
            /// `asin a`
            Asin "asin" (a) [] Trigonometric (ulps(3.0), within(ASIN)) = math::asin(a);
            /// `acos a`
            Acos "acos" (a) [] Trigonometric (ulps(3.0), within(ACOS)) = math::acos(a);
            /// `atan a`
            Atan "atan" (a) [] Trigonometric (ulps(3.0), ulps(4096.0)) = math::atan(a);
            /// The angle of the point (b, a)
            Atan2 "atan2" (a, b) [piecewise] Trigonometric (ulps(4.0), ulps(4096.0)) = math::atan2(a, b);
            /// `tanh a`
            Tanh "tanh" (a) [] Exponential (ulps(3.0), within(TANH)) = math::tanh(a);
            /// `a + c (b − a)`
            Lerp "lerp" (a, b, c) [] Arithmetic (IN_STEPS, IN_STEPS) = math::lerp(a, b, c);
            /// 1 where `b ≥ a`, else 0
            Step "step" (a, b) [piecewise] Choice (EXACT, EXACT) = math::step(a, b);
            /// `c` where `a < b`, else `d`
            Select "select" (a, b, c, d) [piecewise] Choice (EXACT, EXACT) = L::select(a.lt(b), c, d);
            /// `⌊a⌋`
            Floor "floor" (a) [piecewise] Choice (EXACT, EXACT) = a.floor();
            /// `a − ⌊a⌋`
            Fract "fract" (a) [piecewise] Choice (ulps(0.5), ulps(1.0)) = math::fract(a);
            /// −1, 0 or 1
            Sign "sign" (a) [piecewise] Choice (EXACT, EXACT) = math::sign(a);
        }
    };
}
pub(crate) use operations;

macro_rules! define_operations {
    ($($(#[$doc:meta])* $op:ident $name:literal ($($arg:ident),*) [$($property:ident)*] $family:ident ($interpreter:expr, $gpu:expr) = $meaning:expr;)*) => {
        /// An operation: a row of the table.
        #[derive(
            Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize,
        )]
        #[repr(u8)]
        pub enum Op { $($(#[$doc])* $op,)* }

        impl Op {
            /// Every operation, in table order.
            pub const ALL: &'static [Op] = &[$(Op::$op),*];

            /// The name in formula text, grammars and profiles.
            pub const fn name(self) -> &'static str {
                match self { $(Op::$op => $name),* }
            }

            /// The number of arguments, 1 to 4.
            pub const fn arity(self) -> usize {
                match self { $(Op::$op => [$(stringify!($arg)),*].len()),* }
            }

            const fn properties(self) -> Properties {
                match self { $(Op::$op => Properties { $($property: true,)* ..Properties::NONE }),* }
            }

            /// Returns the kind of function that it is.
            pub const fn family(self) -> Family {
                match self { $(Op::$op => Family::$family),* }
            }

            /// Returns how far the interpreter's results may be off those of the function, as the
            /// conformance tests measure.
            pub const fn accuracy(self) -> Accuracy {
                match self { $(Op::$op => $interpreter),* }
            }

            /// Returns how far results may be off on a GPU that keeps to WGSL's and Vulkan's
            /// specifications: "Floating Point Accuracy" of the one, "Precision and Operation of
            /// SPIR-V Instructions" of the other. Where these define an operation by others, their
            /// errors are composed.
            pub const fn gpu_accuracy(self) -> Accuracy {
                match self { $(Op::$op => $gpu),* }
            }

            /// Computes the result, by the reference semantics; arguments beyond the arity are
            /// ignored.
            #[inline(always)]
            pub fn apply<L: Lanes>(self, arguments: [L; 4]) -> L {
                match self {
                    $(Op::$op => {
                        let mut arguments = arguments.into_iter();
                        $(let $arg = arguments.next().expect("four arguments");)*
                        $meaning
                    })*
                }
            }
        }
    };
}
operations!(define_operations);

/// A row's words in brackets.
struct Properties {
    commutes: bool,
    piecewise: bool,
    needs_positive: bool,
}

impl Properties {
    const NONE: Properties =
        Properties { commutes: false, piecewise: false, needs_positive: false };
}

/// WGSL's exp2: 3 + 2|x| ulp. No argument of a finite result is beyond ±200.
const POWER: Tolerance =
    Tolerance { ulps_per_unit: 2.0, most_units: 200.0, ..Tolerance::of_ulps(3.0) };

/// WGSL's log: an absolute error for arguments within [0.5, 2], where the result is near zero, and
/// 3 ulp elsewhere.
const LOGARITHM: Tolerance = Tolerance {
    absolute: 1.0 / (1 << 21) as f64,
    absolute_within: [0.5, 2.0],
    ..Tolerance::of_ulps(3.0)
};

/// The interpreter's reduction of angles is exact enough up to 10⁴.
const WAVE: Tolerance = Tolerance { up_to: 1e4, ..Tolerance::of_ulps(2.0) };
const WAVES_QUOTIENT: Tolerance = Tolerance { up_to: 1e4, ..Tolerance::of_ulps(4.0) };

/// Beyond ±π the specifications promise nothing.
const GPU_WAVE: Tolerance =
    Tolerance { up_to: std::f32::consts::PI, ..Tolerance::of_size(1.0 / (1 << 11) as f64) };

/// WGSL's asin: as atan2(x, sqrt(1 − x²)). The root may be off by 2.5e-4 near x = 1, and atan2 by
/// 4096 ulp, of an angle up to π/2 or π.
const ASIN: Tolerance = Tolerance::of_size(1.1e-3);
const ACOS: Tolerance = Tolerance::of_size(1.8e-3);

/// WGSL's tanh: as sinh(x)/cosh(x), four exponentials and a quotient. Beyond ±89 both are infinite.
const TANH: Tolerance =
    Tolerance { ulps_per_unit: 4.0, most_units: 89.0, absolute: 1e-5, ..Tolerance::of_ulps(13.0) };

/// The most arguments of an operation.
pub const MAX_ARITY: usize = 4;

impl Op {
    /// Returns the operation of this name.
    pub fn from_name(name: &str) -> Option<Op> {
        Op::ALL.iter().copied().find(|op| op.name() == name)
    }

    /// Returns true if the first two arguments may be swapped.
    pub const fn commutes(self) -> bool {
        self.properties().commutes
    }

    /// Returns true if the function has a kink or a jump.
    pub const fn is_piecewise(self) -> bool {
        self.properties().piecewise
    }

    /// Returns true if it is NaN of a negative first argument.
    pub const fn needs_positive(self) -> bool {
        self.properties().needs_positive
    }
}

impl fmt::Display for Op {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_consistent() {
        for &op in Op::ALL {
            assert_eq!(Op::from_name(op.name()), Some(op));
            assert!((1..=MAX_ARITY).contains(&op.arity()));
            assert!(!op.commutes() || op.arity() >= 2);
        }
        assert_eq!(Op::Select.arity(), 4);
        assert!(Op::Min.commutes() && Op::Min.is_piecewise() && !Op::Sub.commutes());
    }

    #[test]
    fn what_needs_a_positive_argument_is_nan_of_negative_ones() {
        for &op in Op::ALL {
            let negative = [-0.25, -0.5, -0.75].map(|x: f32| op.apply([x, 0.5, 0.25, 0.125]));
            assert_eq!(op.needs_positive(), negative.iter().all(|y| y.is_nan()), "{op}");
        }
    }

    #[test]
    fn no_gpu_owes_more_than_the_interpreter_gives() {
        for &op in Op::ALL {
            if let (Accuracy::Within(own), Accuracy::Within(gpu)) =
                (op.accuracy(), op.gpu_accuracy())
            {
                assert!(own.absolute <= gpu.absolute && own.up_to >= gpu.up_to, "{op}");
                assert!(own.ulps <= gpu.ulps || gpu.absolute > 0.0, "{op}");
            }
            assert_eq!(
                op.accuracy() == Accuracy::Exact,
                op.gpu_accuracy() == Accuracy::Exact,
                "{op}"
            );
        }
    }

    #[test]
    fn commuting_operations_commute_bit_for_bit() {
        let values = [0.0f32, -0.0, 1.5, -2.25, 1e-40, f32::INFINITY, 3.0e38];
        for &op in Op::ALL.iter().filter(|op| op.commutes()) {
            for a in values {
                for b in values {
                    let ab = op.apply([a, b, 0.5, 0.0]);
                    let ba = op.apply([b, a, 0.5, 0.0]);
                    assert!(ab.to_bits() == ba.to_bits() || (ab.is_nan() && ba.is_nan()));
                }
            }
        }
    }

    #[test]
    fn a_clamp_hides_no_nan_and_orders_zeros() {
        let apply = |op: Op, a: f32, b: f32| op.apply([a, b, 0.0, 0.0]);
        assert!(apply(Op::Min, f32::NAN, 1.0).is_nan() && apply(Op::Min, 1.0, f32::NAN).is_nan());
        assert!(apply(Op::Max, f32::NAN, 1.0).is_nan() && apply(Op::Max, 1.0, f32::NAN).is_nan());
        assert!(apply(Op::Saturate, f32::NAN, 0.0).is_nan());
        assert!(apply(Op::Min, 0.0, -0.0).is_sign_negative());
        assert!(apply(Op::Max, -0.0, 0.0).is_sign_positive());
        assert!(apply(Op::Pow, 0.0, 0.0).is_nan() && apply(Op::Pow, -1.0, 2.0).is_nan());
    }
}
