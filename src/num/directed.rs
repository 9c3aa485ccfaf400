//! Arithmetic rounded downward in `f64`: exact results stay as they are.

/// How far the platform's elementary functions may be off, relative to their results: 4 units in
/// the last place. Those of the C libraries in use are within one.
const LOOSENESS: f64 = 4.0 * f64::EPSILON;

/// Below this, the residuals of products are not exact.
const TINY: f64 = 1e-280;

/// Moves down a result that has overflowed or is not a number.
fn lower(x: f64) -> Option<f64> {
    if x.is_nan() {
        Some(f64::NEG_INFINITY)
    } else if x == f64::INFINITY {
        Some(f64::MAX)
    } else if x == f64::NEG_INFINITY {
        Some(x)
    } else {
        None
    }
}

/// Returns a lower bound of `a + b`: the sum itself where that is exact (Knuth's two-sum).
pub(super) fn sum_below(a: f64, b: f64) -> f64 {
    let sum = a + b;
    if let Some(bound) = lower(sum) {
        return bound;
    }
    let other = sum - a;
    let error = (a - (sum - other)) + (b - other);
    if error < 0.0 { sum.next_down() } else { sum }
}

/// Returns a lower bound of `a · b`: the product itself where that is exact.
pub(super) fn product_below(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 {
        return 0.0;
    }
    let product = a * b;
    if let Some(bound) = lower(product) {
        return bound;
    }
    if product.abs() < TINY {
        let positive = (a > 0.0) == (b > 0.0);
        return if positive { product.next_down().max(0.0) } else { product.next_down() };
    }
    if a.mul_add(b, -product) < 0.0 { product.next_down() } else { product }
}

/// Returns a lower bound of `a / b` for a positive `b`: the quotient itself where that is exact.
pub(super) fn quotient_below(a: f64, b: f64) -> f64 {
    if a == 0.0 {
        return 0.0;
    }
    let quotient = a / b;
    if let Some(bound) = lower(quotient) {
        return bound;
    }
    let exact = quotient.abs() > TINY && a.abs() > TINY;
    if exact && (-quotient).mul_add(b, a) >= 0.0 {
        return quotient;
    }
    if a > 0.0 { quotient.next_down().max(0.0) } else { quotient.next_down() }
}

pub(super) fn root_below(x: f64) -> f64 {
    let root = x.sqrt();
    match lower(root) {
        Some(bound) => bound,
        None if x > TINY && (-root).mul_add(root, x) < 0.0 => root.next_down(),
        None if x > TINY => root,
        None => root.next_down().max(0.0),
    }
}

pub(super) fn root_above(x: f64) -> f64 {
    let root = x.sqrt();
    if x == 0.0 || root == f64::INFINITY || (x > TINY && (-root).mul_add(root, x) <= 0.0) {
        return root;
    }
    root.next_up()
}

pub(super) fn loosely_below(x: f64) -> f64 {
    match lower(x) {
        Some(bound) => bound,
        None if x == 0.0 => 0.0,
        None => (x - x.abs() * LOOSENESS).next_down(),
    }
}
