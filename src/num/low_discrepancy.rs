//! Spreads points over the unit cube more evenly than random ones do, or on grids.
//!
//! Sources: Hammersley, "Monte Carlo methods for solving multivariable
//! problems", 1960; Halton, 1960; Sobol', "On the distribution of points in a cube", 1967,
//! with the direction numbers of Joe and Kuo, "Constructing Sobol sequences
//! with better two-dimensional projections", 2008 (`new-joe-kuo-6`).
//!
//! A point is a function of its index, so that threads can share a sequence.
//! All coordinates are in [0, 1).

use rand::{Rng, RngExt};

/// The most dimensions of [`hammersley`], [`halton`] and [`Sobol`]; the direction numbers below go
/// no further.
pub(crate) const MAX_DIMENSIONS: usize = 16;

const PRIMES: [u64; MAX_DIMENSIONS] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53];

/// Mirrors the digits of `index`, in a base of at least 2, at the point: 6 = 110₂ becomes 0.011₂ =
/// 3/8.
fn radical_inverse(base: u64, mut index: u64) -> f64 {
    let (mut mirrored, mut unit) = (0.0, 1.0);
    while index > 0 {
        unit /= base as f64;
        mirrored += (index % base) as f64 * unit;
        index /= base;
    }
    // The sum may round up to 1.
    mirrored.min(1.0 - f64::EPSILON / 2.0)
}

/// Returns point `index` of Hammersley's set of `count` points: `index / count`, then radical
/// inverses in the first primes.
pub fn hammersley<const D: usize>(index: u64, count: u64) -> [f64; D] {
    const { assert!(D <= MAX_DIMENSIONS) };
    std::array::from_fn(|axis| match axis {
        0 => index as f64 / count as f64,
        _ => radical_inverse(PRIMES[axis - 1], index),
    })
}

/// Returns point `index` of Halton's sequence: radical inverses in the first primes (Halton, "On the
/// efficiency of certain quasi-random sequences of points", 1960). The first is the origin.
pub fn halton<const D: usize>(index: u64) -> [f64; D] {
    const { assert!(D <= MAX_DIMENSIONS) };
    std::array::from_fn(|axis| radical_inverse(PRIMES[axis], index))
}

/// Bits of a coordinate and of an index: those of an `f64`'s significand.
const BITS: usize = 53;

/// For the second and later dimensions: coefficients of the primitive
/// polynomial between its first and last, as bits, and the first direction
/// integers, as many as its degree.
const JOE_KUO: [(u64, &[u64]); MAX_DIMENSIONS - 1] = [
    (0, &[1]),
    (1, &[1, 3]),
    (1, &[1, 3, 1]),
    (2, &[1, 1, 1]),
    (1, &[1, 1, 3, 3]),
    (4, &[1, 3, 5, 13]),
    (2, &[1, 1, 5, 5, 17]),
    (4, &[1, 1, 5, 5, 5]),
    (7, &[1, 1, 7, 11, 19]),
    (11, &[1, 1, 5, 1, 1]),
    (13, &[1, 1, 1, 3, 11]),
    (14, &[1, 3, 5, 5, 31]),
    (1, &[1, 3, 3, 9, 7, 49]),
    (13, &[1, 1, 1, 15, 21, 21]),
    (16, &[1, 3, 1, 13, 27, 49]),
];

/// Sobol's sequence: each of the 2ᵏ equal intervals of each axis holds one of the first 2ᵏ points.
#[derive(Clone, Debug)]
pub struct Sobol<const D: usize> {
    directions: [[u64; BITS]; D],
}

impl<const D: usize> Default for Sobol<D> {
    fn default() -> Sobol<D> {
        Sobol::new()
    }
}

impl<const D: usize> Sobol<D> {
    /// Computes the direction numbers. Make one and use it for many points.
    pub fn new() -> Sobol<D> {
        const { assert!(D <= MAX_DIMENSIONS) };
        Sobol { directions: std::array::from_fn(directions) }
    }

    /// Returns point `index` < 2⁵³, in the order of the Gray code, as Joe and Kuo's generator gives
    /// them. The first is the origin.
    pub fn point(&self, index: u64) -> [f64; D] {
        let gray = index ^ (index >> 1);
        self.directions.map(|directions| {
            let chosen = (0..BITS).filter(|bit| gray >> bit & 1 == 1);
            let bits = chosen.fold(0, |bits, bit| bits ^ directions[bit]);
            bits as f64 / (1u64 << BITS) as f64
        })
    }
}

/// Computes the direction numbers of one axis, as multiples of 2⁻⁵³ (Joe and Kuo, eq. 2).
fn directions(axis: usize) -> [u64; BITS] {
    let mut directions = [0; BITS];
    if axis == 0 {
        return std::array::from_fn(|bit| 1 << (BITS - 1 - bit));
    }
    let (polynomial, first) = JOE_KUO[axis - 1];
    let degree = first.len();
    for bit in 0..BITS {
        directions[bit] = match first.get(bit) {
            Some(integer) => integer << (BITS - 1 - bit),
            None => {
                let last = directions[bit - degree];
                let taps = (1..degree).filter(|k| polynomial >> (degree - 1 - k) & 1 == 1);
                taps.fold(last ^ (last >> degree), |sum, k| sum ^ directions[bit - k])
            }
        };
    }
    directions
}

/// Returns a random point of cell `index` of a regular grid of `cells` along each axis, the last
/// axis varying fastest.
pub fn jittered_grid<const D: usize>(
    cells: [u64; D],
    mut index: u64,
    rng: &mut impl Rng,
) -> [f64; D] {
    let mut point = [0.0; D];
    for axis in (0..D).rev() {
        let place = (index % cells[axis]) as f64 + rng.random::<f64>();
        index /= cells[axis];
        point[axis] = (place / cells[axis] as f64).min(1.0 - f64::EPSILON / 2.0);
    }
    point
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    const POINTS: u64 = 1024;

    /// Warnock's formula for the L2 star discrepancy of points in the unit
    /// square ("Computational investigations of low-discrepancy point sets",
    /// 1972).
    fn discrepancy(points: &[[f64; 2]]) -> f64 {
        let count = points.len() as f64;
        let single = |p: &[f64; 2]| p.iter().map(|x| 0.5 * (1.0 - x * x)).product::<f64>();
        let pair = |p: &[f64; 2], q: &[f64; 2]| (1.0 - p[0].max(q[0])) * (1.0 - p[1].max(q[1]));
        let singles: f64 = points.iter().map(single).sum();
        let pairs: f64 = points.iter().flat_map(|p| points.iter().map(move |q| pair(p, q))).sum();
        (1.0 / 9.0 - 2.0 / count * singles + pairs / (count * count)).sqrt()
    }

    fn random() -> Vec<[f64; 2]> {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        (0..POINTS).map(|_| [rng.random(), rng.random()]).collect()
    }

    #[test]
    fn digits_are_mirrored() {
        assert_eq!([1, 2, 3, 4, 6].map(|i| radical_inverse(2, i)), [0.5, 0.25, 0.75, 0.125, 0.375]);
        let thirds = [1, 2, 3, 4].map(|i| radical_inverse(3, i));
        let expected = [1.0 / 3.0, 2.0 / 3.0, 1.0 / 9.0, 4.0 / 9.0];
        assert!(thirds.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15));
        assert!(radical_inverse(53, u64::MAX) < 1.0);
        assert_eq!(hammersley::<2>(3, 4), [0.75, 0.75]);
    }

    #[test]
    fn sobol_begins_as_published() {
        // The first points of Joe and Kuo's own program, to three dimensions.
        let sobol = Sobol::<3>::new();
        let expected = [
            [0.0, 0.0, 0.0],
            [0.5, 0.5, 0.5],
            [0.75, 0.25, 0.25],
            [0.25, 0.75, 0.75],
            [0.375, 0.375, 0.625],
            [0.875, 0.875, 0.125],
            [0.625, 0.125, 0.875],
            [0.125, 0.625, 0.375],
        ];
        for (index, point) in (0..).zip(expected) {
            assert_eq!(sobol.point(index), point, "{index}");
        }
    }

    #[test]
    fn sobol_fills_every_interval_of_every_axis_once() {
        let sobol = Sobol::<MAX_DIMENSIONS>::new();
        let points: Vec<_> = (0..POINTS).map(|index| sobol.point(index)).collect();
        for axis in 0..MAX_DIMENSIONS {
            let mut hits = vec![0; POINTS as usize];
            points.iter().for_each(|p| hits[(p[axis] * POINTS as f64) as usize] += 1);
            assert!(hits.iter().all(|&hits| hits == 1), "axis {axis}");
        }
    }

    #[test]
    fn the_first_two_axes_of_sobol_are_a_net() {
        // Each elementary interval of area 2⁻¹⁰ holds one of the first 2¹⁰ points.
        let sobol = Sobol::<2>::new();
        for bits in 0..=10 {
            let (columns, rows) = (1u64 << bits, POINTS >> bits);
            let mut hits = vec![0; POINTS as usize];
            for [x, y] in (0..POINTS).map(|index| sobol.point(index)) {
                let cell = (x * columns as f64) as u64 * rows + (y * rows as f64) as u64;
                hits[cell as usize] += 1;
            }
            assert!(hits.iter().all(|&hits| hits == 1), "{columns} by {rows}");
        }
    }

    #[test]
    fn polynomials_are_primitive() {
        // x has order 2ˢ - 1 modulo a primitive polynomial of degree s.
        for (middle, first) in JOE_KUO {
            let degree = first.len() as u32;
            let polynomial = (1 << degree) | (middle << 1) | 1;
            let mut power = 1u64;
            let mut order = 0;
            loop {
                power <<= 1;
                if power >> degree & 1 == 1 {
                    power ^= polynomial;
                }
                order += 1;
                if power == 1 || order > 64 {
                    break;
                }
            }
            assert_eq!(order, (1u64 << degree) - 1, "{polynomial:b}");
            let odd_and_small = |(k, &m): (usize, &u64)| m % 2 == 1 && m < 2 << k;
            assert!(first.iter().enumerate().all(odd_and_small), "{first:?}");
        }
    }

    #[test]
    fn discrepancies_are_ordered() {
        let sobol = Sobol::<2>::new();
        let mut rng = ChaCha8Rng::seed_from_u64(2);
        let of = |point: &mut dyn FnMut(u64) -> [f64; 2]| {
            discrepancy(&(0..POINTS).map(point).collect::<Vec<_>>())
        };
        let random = discrepancy(&random());
        let jittered = of(&mut |index| jittered_grid([32, 32], index, &mut rng));
        let [hammersley, sobol] =
            [of(&mut |index| hammersley(index, POINTS)), of(&mut |index| sobol.point(index))];
        // Expected of random points: sqrt((1/4 - 1/9) / n) = .0116.
        assert!((0.004..0.03).contains(&random), "{random}");
        assert!(jittered < 0.5 * random, "{jittered} {random}");
        for even in [hammersley, sobol] {
            assert!(even < 0.3 * random, "{even} {random}");
        }
    }

    #[test]
    fn grids_have_a_point_in_each_cell() {
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        for index in 0..12 {
            let [x, y] = jittered_grid([3, 4], index, &mut rng);
            assert_eq!([(x * 3.0) as u64, (y * 4.0) as u64], [index / 4, index % 4]);
        }
    }
}
