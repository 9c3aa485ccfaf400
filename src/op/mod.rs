//! The one table of operations, and their reference semantics.
//!
//! Everything else that is known of an operation (bulk kernel, derivative, cost,
//! spelling in each language) is a `match` or a table keyed by [`Op`], complete by
//! construction or by test.

use crate::num::{Lanes, math};
use std::fmt;

/// What can go wrong in an operation although its arguments are finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hazard {
    /// Nothing but overflow to infinity.
    Overflow,
    /// Nothing at all: finite arguments give a finite result.
    None,
    /// Not finite where a divisor is zero.
    ZeroDivisor,
    /// NaN where an argument is negative.
    Negative,
    /// NaN where an argument is negative, infinite at zero.
    NegativeOrZero,
    /// NaN outside [−1, 1].
    OutsideUnit,
}

/// Calls `$then! { rows }` with the table: variant, name in formula text, arguments,
/// `commutes` where the first two arguments may be swapped, `piecewise` where the
/// function has a kink or a jump, hazard, meaning over [`Lanes`].
macro_rules! operations {
    ($then:ident) => {
        $then! {
            /// `a + b`
            Add "add" (a, b) [commutes] Overflow = a + b;
            /// `a − b`
            Sub "sub" (a, b) [] Overflow = a - b;
            /// `a · b`
            Mul "mul" (a, b) [commutes] Overflow = a * b;
            /// `a / b`
            Div "div" (a, b) [] ZeroDivisor = a / b;
            /// `−a`
            Neg "neg" (a) [] None = a.neg();
            /// `|a|`
            Abs "abs" (a) [piecewise] None = a.abs();
            /// The smaller; NaN if either is.
            Min "min" (a, b) [commutes piecewise] None = a.minimum(b);
            /// The larger; NaN if either is.
            Max "max" (a, b) [commutes piecewise] None = a.maximum(b);
            /// `min(max(a, 0), 1)`
            Saturate "saturate" (a) [piecewise] None = math::saturate(a);
            /// `a · b + c`, rounded once
            Mad "mad" (a, b, c) [commutes] Overflow = a.fma(b, c);
            /// `1 / a`
            Rcp "rcp" (a) [] ZeroDivisor = math::rcp(a);
            /// `√a`
            Sqrt "sqrt" (a) [] Negative = a.sqrt();
            /// `1 / √a`
            Rsqrt "rsqrt" (a) [] NegativeOrZero = math::rsqrt(a);
            /// `2^a`
            Exp2 "exp2" (a) [] Overflow = math::exp2(a);
            /// `log₂ a`
            Log2 "log2" (a) [] NegativeOrZero = math::log2(a);
            /// `e^a`
            Exp "exp" (a) [] Overflow = math::exp(a);
            /// `ln a`
            Log "log" (a) [] NegativeOrZero = math::log(a);
            /// `exp2(b · log2(a))`
            Pow "pow" (a, b) [] NegativeOrZero = math::pow(a, b);
            /// `sin a`, radians
            Sin "sin" (a) [] None = math::sin(a);
            /// `cos a`, radians
            Cos "cos" (a) [] None = math::cos(a);
            /// `tan a`, radians
            Tan "tan" (a) [] ZeroDivisor = math::tan(a);
            /// `asin a`
            Asin "asin" (a) [] OutsideUnit = math::asin(a);
            /// `acos a`
            Acos "acos" (a) [] OutsideUnit = math::acos(a);
            /// `atan a`
            Atan "atan" (a) [] None = math::atan(a);
            /// The angle of the point (b, a)
            Atan2 "atan2" (a, b) [piecewise] None = math::atan2(a, b);
            /// `tanh a`
            Tanh "tanh" (a) [] None = math::tanh(a);
            /// `a + c (b − a)`
            Lerp "lerp" (a, b, c) [] Overflow = math::lerp(a, b, c);
            /// 1 where `b ≥ a`, else 0
            Step "step" (a, b) [piecewise] None = math::step(a, b);
            /// `c` where `a < b`, else `d`
            Select "select" (a, b, c, d) [piecewise] None = L::select(a.lt(b), c, d);
            /// `⌊a⌋`
            Floor "floor" (a) [piecewise] None = a.floor();
            /// `a − ⌊a⌋`
            Fract "fract" (a) [piecewise] None = math::fract(a);
            /// −1, 0 or 1
            Sign "sign" (a) [piecewise] None = math::sign(a);
        }
    };
}
pub(crate) use operations;

macro_rules! define_operations {
    ($($(#[$doc:meta])* $op:ident $name:literal ($($arg:ident),*) [$($property:ident)*] $hazard:ident = $meaning:expr;)*) => {
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

            /// What can go wrong on finite arguments.
            pub const fn hazard(self) -> Hazard {
                match self { $(Op::$op => Hazard::$hazard),* }
            }

            /// Whether the first two arguments may be swapped.
            pub const fn commutes(self) -> bool {
                match self { $(Op::$op => has_property(&[$(stringify!($property)),*], b'c')),* }
            }

            /// Whether the function has a kink or a jump.
            pub const fn is_piecewise(self) -> bool {
                match self { $(Op::$op => has_property(&[$(stringify!($property)),*], b'p')),* }
            }

            /// The reference semantics; arguments beyond the arity are not looked at.
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

/// Whether one of the words of a table row starts with `initial`.
const fn has_property(words: &[&str], initial: u8) -> bool {
    let mut i = 0;
    while i < words.len() {
        if words[i].as_bytes()[0] == initial {
            return true;
        }
        i += 1;
    }
    false
}

/// The most arguments an operation has.
pub const MAX_ARITY: usize = 4;

impl Op {
    /// The operation of this name.
    pub fn from_name(name: &str) -> Option<Op> {
        Op::ALL.iter().copied().find(|op| op.name() == name)
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
