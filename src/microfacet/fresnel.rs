//! The reflectance of a smooth interface, unpolarised.

use super::{Real, sine_squared};

/// `(1 - v_dot_h)^5`: the weight of full reflectance in Schlick's
/// approximation (Schlick, "An Inexpensive BRDF Model for Physically-based
/// Rendering", 1994, eq. 15). `v_dot_h` in [0, 1].
pub fn schlick_weight<T: Real>(v_dot_h: T) -> T {
    let complement = T::ONE - v_dot_h;
    let square = complement * complement;
    square * square * complement
}

/// `1 - (1 - v_dot_h)^5`: the transmittance in Schlick's approximation over that
/// at normal incidence. `v_dot_h` in [0, 1].
pub fn schlick_transmission<T: Real>(v_dot_h: T) -> T {
    // Multiplied out: the difference cancels at grazing.
    let c = v_dot_h;
    let ten = T::of(10.0);
    c * (T::of(5.0) - c * (ten - c * (ten - c * (T::of(5.0) - c))))
}

/// Schlick's approximation of the reflectance; `f0` in [0, 1] is that at normal
/// incidence.
pub fn schlick<T: Real>(f0: T, v_dot_h: T) -> T {
    f0 + (T::ONE - f0) * schlick_weight(v_dot_h)
}

/// Fresnel's equations between dielectrics. `eta` > 0 is the index of refraction
/// behind the interface over that in front of it; 1 under total internal
/// reflection. `v_dot_h` in [0, 1].
pub fn dielectric<T: Real>(eta: T, v_dot_h: T) -> T {
    let eta_squared = eta * eta;
    let transmitted_squared = T::ONE - sine_squared(v_dot_h) / eta_squared;
    if transmitted_squared <= T::ZERO {
        return T::ONE;
    }
    let transmitted = transmitted_squared.sqrt();
    // (c - η c') / (c + η c') and (η c - c') / (η c + c'), each with its
    // conjugate: the differences cancel for η near 1.
    let contrast = (eta - T::ONE) * (eta + T::ONE);
    let cosine_squared = v_dot_h * v_dot_h;
    let across = contrast / (v_dot_h + eta * transmitted).squared();
    let along = contrast * (cosine_squared * eta_squared - sine_squared(v_dot_h))
        / (eta_squared * (eta * v_dot_h + transmitted).squared());
    T::HALF * (across * across + along * along)
}

/// Fresnel's equations at the surface of a conductor of complex index
/// `eta + i k` (over that of the medium in front); `eta` > 0, `k` ≥ 0. At k = 0
/// it is a dielectric. `v_dot_h` in [0, 1].
pub fn conductor<T: Real>(eta: T, k: T, v_dot_h: T) -> T {
    let sine_squared = sine_squared(v_dot_h);
    // (a + ib)² = (η + ik)² - sin²: Born and Wolf, "Principles of Optics", §14.2.
    let real = (eta - k) * (eta + k) - sine_squared;
    let imaginary = T::TWO * eta * k;
    let modulus = (real * real + imaginary * imaginary).sqrt();
    let larger = (T::HALF * (modulus + real.abs())).sqrt();
    let smaller = if larger > T::ZERO { T::HALF * imaginary / larger } else { T::ZERO };
    let (a, b) = if real < T::ZERO { (smaller, larger) } else { (larger, smaller) };
    let across = ((a - v_dot_h).squared() + b * b) / ((a + v_dot_h).squared() + b * b);
    let (shifted, damped) = (a * v_dot_h, (b * v_dot_h).squared());
    let ratio = ((shifted - sine_squared).squared() + damped)
        / ((shifted + sine_squared).squared() + damped);
    T::HALF * across * (T::ONE + ratio)
}

/// Cook and Torrance's form ("A Reflectance Model for Computer Graphics", 1982,
/// eq. 18): [`dielectric`] with the index that reflects `f0` in [0, 1] at
/// normal incidence.
pub fn cook_torrance<T: Real>(f0: T, v_dot_h: T) -> T {
    if f0 >= T::ONE {
        return T::ONE;
    }
    dielectric(eta_of_f0(f0), v_dot_h)
}

/// `((η - 1) / (η + 1))²`, the reflectance at normal incidence.
pub fn f0_of_eta<T: Real>(eta: T) -> T {
    ((eta - T::ONE) / (eta + T::ONE)).squared()
}

/// The index of refraction above 1 that reflects `f0` in [0, 1) at normal
/// incidence.
pub fn eta_of_f0<T: Real>(f0: T) -> T {
    let root = f0.sqrt();
    (T::ONE + root) / (T::ONE - root)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schlick_runs_from_f0_to_one() {
        assert_eq!(schlick(0.04, 1.0), 0.04);
        assert_eq!(schlick(0.04, 0.0), 1.0);
        assert!((schlick(0.0_f64, 0.5) - 0.03125).abs() < 1e-16);
        assert_eq!(schlick_transmission(1.0), 1.0);
        assert!((schlick_transmission(0.3) + schlick_weight(0.3) - 1.0_f64).abs() < 1e-15);
        assert!((schlick_transmission(1e-9_f64) / 5e-9 - 1.0).abs() < 3e-9);
    }

    /// Cook and Torrance's eq. 18 as printed.
    fn printed(eta: f64, c: f64) -> f64 {
        let g = (eta * eta + c * c - 1.0).sqrt();
        let ratio = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
        0.5 * ((g - c) / (g + c)).powi(2) * (1.0 + ratio * ratio)
    }

    #[test]
    fn dielectric_is_the_textbook_form() {
        for eta in [1.33, 1.5, 2.42] {
            for i in 0..=100 {
                let c = f64::from(i) / 100.0;
                let found = dielectric(eta, c);
                assert!((found - printed(eta, c)).abs() < 1e-14, "{eta} {c}: {found}");
                assert!((cook_torrance(f0_of_eta(eta), c) - found).abs() < 1e-13);
                assert!((conductor(eta, 0.0, c) - found).abs() < 1e-14, "{eta} {c}");
                let single = f64::from(dielectric(eta as f32, c as f32));
                let exact = dielectric(f64::from(eta as f32), f64::from(c as f32));
                assert!((single - exact).abs() < 1e-6, "{eta} {c}: {single} {exact}");
            }
        }
    }

    #[test]
    fn limits_of_the_dielectric() {
        assert_eq!(dielectric(1.0, 0.3), 0.0);
        assert!((dielectric(1.5_f64, 0.0) - 1.0).abs() < 1e-15);
        assert_eq!(dielectric(1.0 / 1.5, 0.5), 1.0, "total internal reflection");
        assert_eq!(cook_torrance(1.0, 0.5), 1.0);
        // Brewster's angle: only one polarisation is reflected.
        let c = 1.0 / (1.0 + 1.5_f64.powi(2)).sqrt();
        let across = (1.0 - 2.25) / (1.0 + 2.25);
        assert!((dielectric(1.5, c) - 0.5 * across * across).abs() < 1e-15);
        // A faint interface, where the textbook form has no digit left.
        let contrast = 2.0_f64.powi(-30);
        let expected = (contrast / (2.0 + contrast)).powi(2);
        assert!((dielectric(1.0 + contrast, 1.0) / expected - 1.0).abs() < 1e-14);
    }

    #[test]
    fn light_is_refracted_as_much_from_either_side() {
        let (eta, c) = (1.5, 0.6_f64);
        let behind = (1.0 - (1.0 - c * c) / (eta * eta)).sqrt();
        assert!((dielectric(eta, c) - dielectric(1.0 / eta, behind)).abs() < 1e-15);
    }

    #[test]
    fn conductor_at_normal_incidence_and_at_grazing() {
        for (eta, k) in [(0.2_f64, 3.4_f64), (1.5, 7.6), (2.9, 3.1)] {
            let normal = ((eta - 1.0).powi(2) + k * k) / ((eta + 1.0).powi(2) + k * k);
            assert!((conductor(eta, k, 1.0) - normal).abs() < 1e-14);
            assert_eq!(conductor(eta, k, 0.0), 1.0);
        }
        // Inside glass, slightly absorbing outside: total reflection but for a trace.
        let absorbed = 1.0 - conductor(0.66, 1e-6, 0.5_f64);
        assert!((0.0..1e-5).contains(&absorbed) && absorbed > 1e-7, "{absorbed:e}");
    }
}
