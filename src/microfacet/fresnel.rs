//! Reflectance of a smooth interface.

/// `(1 - v_dot_h)^5`: the weight of full reflectance in Schlick's
/// approximation (Schlick, "An Inexpensive BRDF Model for Physically-based
/// Rendering", 1994, eq. 15). `v_dot_h` in [0, 1].
pub fn schlick_weight(v_dot_h: f64) -> f64 {
    let complement = 1.0 - v_dot_h;
    let square = complement * complement;
    square * square * complement
}

/// Schlick's approximation of the reflectance; `f0` in [0, 1] is that at normal
/// incidence.
pub fn schlick(f0: f64, v_dot_h: f64) -> f64 {
    f0 + (1.0 - f0) * schlick_weight(v_dot_h)
}

#[cfg(test)]
mod tests {
    use super::schlick;

    #[test]
    fn schlick_runs_from_f0_to_one() {
        assert_eq!(schlick(0.04, 1.0), 0.04);
        assert_eq!(schlick(0.04, 0.0), 1.0);
        assert!((schlick(0.0, 0.5) - 0.03125).abs() < 1e-16);
    }
}
