//! Rules on equidistant nodes (Abramowitz & Stegun, 25.4).

use super::Rule;

impl Rule {
    /// The midpoint rule on `cells` equal cells: exact for straight lines, error O(cells⁻²). The
    /// coarser rule has a third of the cells, whose centres are among them, or, if `cells` is not a
    /// multiple of 3, half of them.
    ///
    /// # Panics
    /// If `cells` is 0.
    pub fn midpoint(cells: usize) -> Rule {
        assert!(cells > 0, "a rule needs a cell");
        let coarser = if cells.is_multiple_of(3) { cells / 3 } else { cells.div_ceil(2) };
        Rule::new(&centres(cells), &centres(coarser))
    }

    /// The trapezoidal rule on `cells` equal cells: exact for straight lines,
    /// error O(cells⁻²). The coarser rule has half the cells (rounded up).
    ///
    /// # Panics
    /// If `cells` is 0.
    pub fn trapezoid(cells: usize) -> Rule {
        assert!(cells > 0, "a rule needs a cell");
        Rule::new(&trapezoids(cells), &trapezoids(cells.div_ceil(2)))
    }

    /// Simpson's rule on `cells` equal cells, an even number: exact for cubic
    /// polynomials, error O(cells⁻⁴). The coarser rule is the trapezoidal one
    /// on the same nodes, or Simpson's on half the cells where that is even.
    ///
    /// # Panics
    /// If `cells` is odd or 0.
    pub fn simpson(cells: usize) -> Rule {
        assert!(
            cells > 0 && cells.is_multiple_of(2),
            "Simpson's rule needs an even number of cells"
        );
        let coarse = match cells.is_multiple_of(4) {
            true => parabolas(cells / 2),
            false => trapezoids(cells),
        };
        Rule::new(&parabolas(cells), &coarse)
    }
}

fn centres(cells: usize) -> Vec<(f64, f64)> {
    let width = 2.0 / cells as f64;
    // Counted from the middle, so that nested centres agree to the last bits.
    let node = |i: usize| (2 * i + 1) as f64 / cells as f64 - 1.0;
    (0..cells).map(|i| (node(i), width)).collect()
}

fn equidistant(cells: usize, weight: impl Fn(usize) -> f64) -> Vec<(f64, f64)> {
    let width = 2.0 / cells as f64;
    let node = |i: usize| (2 * i) as f64 / cells as f64 - 1.0;
    (0..=cells).map(|i| (node(i), width * weight(i))).collect()
}

fn trapezoids(cells: usize) -> Vec<(f64, f64)> {
    equidistant(cells, |i| if i == 0 || i == cells { 0.5 } else { 1.0 })
}

fn parabolas(cells: usize) -> Vec<(f64, f64)> {
    equidistant(cells, |i| match i {
        _ if i == 0 || i == cells => 1.0 / 3.0,
        _ if i.is_multiple_of(2) => 2.0 / 3.0,
        _ => 4.0 / 3.0,
    })
}

#[cfg(test)]
mod tests {
    use super::super::rule::tests::assert_degree;
    use super::*;

    #[test]
    fn degrees() {
        for cells in [1, 2, 3, 6, 7] {
            assert_degree(&Rule::midpoint(cells), 1);
            assert_degree(&Rule::trapezoid(cells), 1);
        }
        for cells in [2, 4, 6, 12] {
            assert_degree(&Rule::simpson(cells), 3);
        }
    }

    #[test]
    fn nested_nodes_are_evaluated_once() {
        let evaluations = |rule: Rule| rule.integrate([0.0], [1.0], |[x]| x).evaluations;
        assert_eq!(evaluations(Rule::midpoint(27)), 27);
        assert_eq!(evaluations(Rule::trapezoid(64)), 65);
        assert_eq!(evaluations(Rule::simpson(64)), 65);
        assert_eq!(evaluations(Rule::midpoint(10)), 10 + 5);
    }

    #[test]
    fn errors_fall_with_the_order() {
        let error = |rule: Rule| {
            let found = rule.integrate([0.0], [1.0], |[x]| 1.0 / (1.0 + x));
            let error = (found.value - 2.0_f64.ln()).abs();
            assert!(error <= found.error, "{error:e} > {found:?}");
            error
        };
        type Family = (fn(usize) -> Rule, f64);
        let families: [Family; 3] =
            [(Rule::midpoint, 4.0), (Rule::trapezoid, 4.0), (Rule::simpson, 16.0)];
        for (family, expected) in families {
            let ratio = error(family(32)) / error(family(64));
            assert!((ratio / expected - 1.0).abs() < 0.02, "{ratio}");
        }
    }
}
