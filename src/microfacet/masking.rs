//! Masking and shadowing that shaders use instead of Smith's exact terms.

use super::Real;

/// Schlick's form of G1, with k = α/2 to come near Smith's for GGX (Karis, "Real
/// Shading in Unreal Engine 4", 2013): `c / (c (1 - k) + k)`. `alpha` in [0, 1].
pub fn g1_schlick<T: Real>(cosine: T, alpha: T) -> T {
    let k = T::HALF * alpha;
    if k <= T::ZERO {
        return T::ONE;
    }
    cosine / (cosine * (T::ONE - k) + k)
}

/// Hammon's approximation of the height-correlated G2 for GGX ("PBR Diffuse Lighting for GGX+Smith
/// Microsurfaces", 2017): `2 n·l n·v / lerp(2 n·l n·v, n·l + n·v, α)`, which follows from the Λ of
/// [`g1_schlick`]. Where that is 0/0, its limit: 1 if α is 0, else 0. `alpha` in [0, 1].
pub fn g2_hammon<T: Real>(n_dot_v: T, n_dot_l: T, alpha: T) -> T {
    if alpha <= T::ZERO {
        return T::ONE;
    }
    let twice_product = T::TWO * n_dot_l * n_dot_v;
    if twice_product <= T::ZERO {
        return T::ZERO;
    }
    twice_product / (twice_product + alpha * (n_dot_l + n_dot_v - twice_product))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hammon_is_schlick_correlated() {
        let lambda = |cosine: f64, alpha: f64| 1.0 / g1_schlick(cosine, alpha) - 1.0;
        for alpha in [0.01, 0.3, 1.0] {
            for (v, l) in [(0.1, 0.9), (0.5, 0.5), (1.0, 0.02)] {
                let expected = 1.0 / (1.0 + lambda(v, alpha) + lambda(l, alpha));
                assert!((g2_hammon(v, l, alpha) / expected - 1.0).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn limits_where_the_textbook_form_is_undefined() {
        assert_eq!(g2_hammon(0.0, 0.0, 0.5), 0.0);
        assert_eq!(g2_hammon(0.0, 0.0, 0.0), 1.0);
        assert_eq!(g2_hammon(0.0_f32, 0.5, 0.0), 1.0);
        assert_eq!(g1_schlick(0.0, 0.0), 1.0);
        assert_eq!(g1_schlick(0.0, 0.5), 0.0);
    }
}
