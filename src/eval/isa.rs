//! The instruction sets that kernels are compiled for.

use std::fmt;

/// An instruction set of this processor. Only those that it has can be made, so a value is proof.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Isa(pub(super) Level);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Level {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Isa {
    /// Plain code, compiled for the oldest processor of the architecture.
    pub const PORTABLE: Isa = Isa(Level::Portable);

    /// Returns all instruction sets of this processor, the widest last.
    pub fn available() -> Vec<Isa> {
        let mut available = vec![Isa::PORTABLE];
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            if avx2 {
                available.push(Isa(Level::Avx2));
            }
            let avx512 =
                is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq");
            if avx2 && avx512 {
                available.push(Isa(Level::Avx512));
            }
        }
        available
    }

    /// Returns the widest instruction set of this processor.
    pub fn best() -> Isa {
        static BEST: std::sync::OnceLock<Isa> = std::sync::OnceLock::new();
        *BEST.get_or_init(|| Isa::available().pop().unwrap_or(Isa::PORTABLE))
    }
}

impl fmt::Display for Isa {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self.0 {
            Level::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => "AVX2",
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => "AVX-512",
        })
    }
}

impl fmt::Debug for Isa {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// Defines `fn $name(isa: Isa, …)`, which runs `$generic::<L>(…)` compiled for that instruction
/// set, `L` being its register of [`super::BLOCK`] lanes.
macro_rules! by_isa {
    ($(#[$doc:meta])* fn $name:ident($($arg:ident: $type:ty),* $(,)?) -> $result:ty = $generic:ident) => {
        $(#[$doc])*
        #[allow(clippy::too_many_arguments)]
        fn $name(isa: $crate::eval::Isa, $($arg: $type),*) -> $result {
            use $crate::eval::isa::Level;
            use $crate::num::Many;
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx512f,avx512dq,avx2,fma")]
                #[allow(clippy::too_many_arguments)]
                fn avx512($($arg: $type),*) -> $result {
                    // SAFETY: the function's own target features are the register's.
                    unsafe { $generic::<$crate::num::Avx512>($($arg),*) }
                }
                #[target_feature(enable = "avx2,fma")]
                #[allow(clippy::too_many_arguments)]
                fn avx2($($arg: $type),*) -> $result {
                    // SAFETY: as above.
                    unsafe { $generic::<Many<$crate::num::Avx2, 2>>($($arg),*) }
                }
                match isa.0 {
                    // SAFETY: an `Isa` of this level exists only where the processor has it.
                    Level::Avx512 => return unsafe { avx512($($arg),*) },
                    // SAFETY: as above.
                    Level::Avx2 => return unsafe { avx2($($arg),*) },
                    Level::Portable => {}
                }
            }
            let _ = isa;
            // SAFETY: every processor has `f32`.
            unsafe { $generic::<Many<f32, { $crate::eval::BLOCK }>>($($arg),*) }
        }
    };
}
pub(super) use by_isa;
