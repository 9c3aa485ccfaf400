//! Sums of squares with their standard starts and minima: Moré, Garbow and Hillstrom, "Testing
//! unconstrained optimization software", ACM TOMS 7 (1981), by the numbers there.

use super::{Function, Problem};
use std::f64::consts::PI;

pub const BARD: [f64; 15] =
    [0.14, 0.18, 0.22, 0.25, 0.29, 0.32, 0.35, 0.39, 0.37, 0.58, 0.73, 0.96, 1.34, 2.10, 4.39];
pub const GAUSSIAN: [f64; 8] = [0.0009, 0.0044, 0.0175, 0.0540, 0.1295, 0.2420, 0.3521, 0.3989];
pub const MEYER: [f64; 16] = [
    34780.0, 28610.0, 23650.0, 19630.0, 16370.0, 13720.0, 11540.0, 9744.0, 8261.0, 7030.0, 6005.0,
    5147.0, 4427.0, 3820.0, 3307.0, 2872.0,
];
pub const KOWALIK: [(f64, f64); 11] = [
    (4.0, 0.1957),
    (2.0, 0.1947),
    (1.0, 0.1735),
    (0.5, 0.1600),
    (0.25, 0.0844),
    (0.167, 0.0627),
    (0.125, 0.0456),
    (0.1, 0.0342),
    (0.0833, 0.0323),
    (0.0714, 0.0235),
    (0.0625, 0.0246),
];
pub const OSBORNE_1: [f64; 33] = [
    0.844, 0.908, 0.932, 0.936, 0.925, 0.908, 0.881, 0.850, 0.818, 0.784, 0.751, 0.718, 0.685,
    0.658, 0.628, 0.603, 0.580, 0.558, 0.538, 0.522, 0.506, 0.490, 0.478, 0.467, 0.457, 0.448,
    0.438, 0.431, 0.424, 0.420, 0.414, 0.411, 0.406,
];
pub const OSBORNE_2: [f64; 65] = [
    1.366, 1.191, 1.112, 1.013, 0.991, 0.885, 0.831, 0.847, 0.786, 0.725, 0.746, 0.679, 0.608,
    0.655, 0.616, 0.606, 0.602, 0.626, 0.651, 0.724, 0.649, 0.649, 0.694, 0.644, 0.624, 0.661,
    0.612, 0.558, 0.533, 0.495, 0.500, 0.423, 0.395, 0.375, 0.372, 0.391, 0.396, 0.405, 0.428,
    0.429, 0.523, 0.562, 0.607, 0.653, 0.672, 0.708, 0.633, 0.668, 0.645, 0.632, 0.591, 0.559,
    0.597, 0.625, 0.739, 0.710, 0.729, 0.720, 0.636, 0.581, 0.428, 0.292, 0.162, 0.098, 0.054,
];

/// Residuals of i = 1, 2, …
fn each(count: u32, residual: impl Fn(f64) -> f64) -> Vec<f64> {
    (1..=count).map(|i| residual(f64::from(i))).collect()
}

fn rosenbrock(x: &[f64]) -> Vec<f64> {
    x.chunks(2).flat_map(|x| [10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]).collect()
}

fn freudenstein_roth(x: &[f64]) -> Vec<f64> {
    let (a, b) = (x[0], x[1]);
    vec![-13.0 + a + ((5.0 - b) * b - 2.0) * b, -29.0 + a + ((b + 1.0) * b - 14.0) * b]
}

fn powell_badly_scaled(x: &[f64]) -> Vec<f64> {
    vec![1e4 * x[0] * x[1] - 1.0, (-x[0]).exp() + (-x[1]).exp() - 1.0001]
}

fn brown_badly_scaled(x: &[f64]) -> Vec<f64> {
    vec![x[0] - 1e6, x[1] - 2e-6, x[0] * x[1] - 2.0]
}

fn beale(x: &[f64]) -> Vec<f64> {
    let given = [1.5, 2.25, 2.625];
    (1..).zip(given).map(|(i, y)| y - x[0] * (1.0 - x[1].powi(i))).collect()
}

fn jennrich_sampson(x: &[f64]) -> Vec<f64> {
    each(10, |i| 2.0 + 2.0 * i - ((i * x[0]).exp() + (i * x[1]).exp()))
}

fn helical_valley(x: &[f64]) -> Vec<f64> {
    let turns = (x[1] / x[0]).atan() / (2.0 * PI) + if x[0] < 0.0 { 0.5 } else { 0.0 };
    vec![10.0 * (x[2] - 10.0 * turns), 10.0 * (x[0].hypot(x[1]) - 1.0), x[2]]
}

fn bard(x: &[f64]) -> Vec<f64> {
    let rows = (1..=15).map(f64::from).zip(BARD);
    let residual = |(u, y): (f64, f64)| {
        let v = 16.0 - u;
        y - (x[0] + u / (v * x[1] + u.min(v) * x[2]))
    };
    rows.map(residual).collect()
}

fn gaussian(x: &[f64]) -> Vec<f64> {
    each(15, |i| {
        let y = GAUSSIAN[(i.min(16.0 - i) - 1.0) as usize];
        x[0] * (-x[1] * ((8.0 - i) / 2.0 - x[2]).powi(2) / 2.0).exp() - y
    })
}

fn meyer(x: &[f64]) -> Vec<f64> {
    each(16, |i| x[0] * (x[1] / (45.0 + 5.0 * i + x[2])).exp() - MEYER[i as usize - 1])
}

fn gulf(x: &[f64]) -> Vec<f64> {
    each(99, |i| {
        let t = i / 100.0;
        let y = 25.0 + (-50.0 * t.ln()).powf(2.0 / 3.0);
        (-(y - x[1]).abs().powf(x[2]) / x[0]).exp() - t
    })
}

fn box_3(x: &[f64]) -> Vec<f64> {
    each(10, |i| {
        let t = 0.1 * i;
        (-t * x[0]).exp() - (-t * x[1]).exp() - x[2] * ((-t).exp() - (-10.0 * t).exp())
    })
}

fn powell_singular(x: &[f64]) -> Vec<f64> {
    let four = |x: &[f64]| {
        let (far, near) = (5f64.sqrt() * (x[2] - x[3]), (x[1] - 2.0 * x[2]).powi(2));
        [x[0] + 10.0 * x[1], far, near, 10f64.sqrt() * (x[0] - x[3]).powi(2)]
    };
    x.chunks(4).flat_map(four).collect()
}

fn wood(x: &[f64]) -> Vec<f64> {
    vec![
        10.0 * (x[1] - x[0] * x[0]),
        1.0 - x[0],
        90f64.sqrt() * (x[3] - x[2] * x[2]),
        1.0 - x[2],
        10f64.sqrt() * (x[1] + x[3] - 2.0),
        (x[1] - x[3]) / 10f64.sqrt(),
    ]
}

fn kowalik_osborne(x: &[f64]) -> Vec<f64> {
    let model = |u: f64| x[0] * (u * u + u * x[1]) / (u * u + u * x[2] + x[3]);
    KOWALIK.iter().map(|(u, y)| y - model(*u)).collect()
}

fn brown_dennis(x: &[f64]) -> Vec<f64> {
    each(20, |i| {
        let t = i / 5.0;
        (x[0] + t * x[1] - t.exp()).powi(2) + (x[2] + x[3] * t.sin() - t.cos()).powi(2)
    })
}

fn osborne_1(x: &[f64]) -> Vec<f64> {
    each(33, |i| {
        let t = 10.0 * (i - 1.0);
        OSBORNE_1[i as usize - 1] - (x[0] + x[1] * (-t * x[3]).exp() + x[2] * (-t * x[4]).exp())
    })
}

fn biggs_exp6(x: &[f64]) -> Vec<f64> {
    each(13, |i| {
        let t = 0.1 * i;
        let y = (-t).exp() - 5.0 * (-10.0 * t).exp() + 3.0 * (-4.0 * t).exp();
        x[2] * (-t * x[0]).exp() - x[3] * (-t * x[1]).exp() + x[5] * (-t * x[4]).exp() - y
    })
}

fn osborne_2(x: &[f64]) -> Vec<f64> {
    each(65, |i| {
        let t = (i - 1.0) / 10.0;
        let peak = |k: usize| x[k] * (-(t - x[k + 7]).powi(2) * x[k + 4]).exp();
        let sum = x[0] * (-t * x[4]).exp() + peak(1) + peak(2) + peak(3);
        OSBORNE_2[i as usize - 1] - sum
    })
}

fn watson(x: &[f64]) -> Vec<f64> {
    let mut residuals = each(29, |i| {
        let t = i / 29.0;
        let (mut slope, mut value) = (0.0, 0.0);
        for (j, x) in (0..).zip(x) {
            if j > 0 {
                slope += f64::from(j) * x * t.powi(j - 1);
            }
            value += x * t.powi(j);
        }
        slope - value * value - 1.0
    });
    residuals.extend([x[0], x[1] - x[0] * x[0] - 1.0]);
    residuals
}

fn penalty_1(x: &[f64]) -> Vec<f64> {
    let mut residuals: Vec<f64> = x.iter().map(|x| 1e-5f64.sqrt() * (x - 1.0)).collect();
    residuals.push(x.iter().map(|x| x * x).sum::<f64>() - 0.25);
    residuals
}

fn penalty_2(x: &[f64]) -> Vec<f64> {
    let (n, root) = (x.len(), 1e-5f64.sqrt());
    let mut residuals = vec![x[0] - 0.2];
    for i in 1..n {
        let y = ((i + 1) as f64 / 10.0).exp() + (i as f64 / 10.0).exp();
        residuals.push(root * ((x[i] / 10.0).exp() + (x[i - 1] / 10.0).exp() - y));
    }
    residuals.extend(x[1..].iter().map(|x| root * ((x / 10.0).exp() - (-0.1f64).exp())));
    let weighted = (0..n).map(|j| (n - j) as f64 * x[j] * x[j]);
    residuals.push(weighted.sum::<f64>() - 1.0);
    residuals
}

fn variably_dimensioned(x: &[f64]) -> Vec<f64> {
    let mut residuals: Vec<f64> = x.iter().map(|x| x - 1.0).collect();
    let sum: f64 = (1..).zip(x).map(|(j, x)| f64::from(j) * (x - 1.0)).sum();
    residuals.extend([sum, sum * sum]);
    residuals
}

fn trigonometric(x: &[f64]) -> Vec<f64> {
    let sum: f64 = x.iter().map(|x| x.cos()).sum();
    let rest = x.len() as f64 - sum;
    let residual = |(i, x): (i32, &f64)| rest + f64::from(i) * (1.0 - x.cos()) - x.sin();
    (1..).zip(x).map(residual).collect()
}

fn brown_almost_linear(x: &[f64]) -> Vec<f64> {
    let sum: f64 = x.iter().sum();
    let (last, others) = (x.len() - 1, x.len() as f64 + 1.0);
    let mut residuals: Vec<f64> = x[..last].iter().map(|x| x + sum - others).collect();
    residuals.push(x.iter().product::<f64>() - 1.0);
    residuals
}

fn broyden_tridiagonal(x: &[f64]) -> Vec<f64> {
    let at = |i: usize| x.get(i).copied().unwrap_or(0.0);
    let before = |i: usize| if i == 0 { 0.0 } else { x[i - 1] };
    let residual = |i: usize| (3.0 - 2.0 * x[i]) * x[i] - before(i) - 2.0 * at(i + 1) + 1.0;
    (0..x.len()).map(residual).collect()
}

fn chebyquad(x: &[f64]) -> Vec<f64> {
    let chebyshev = |i: i32, x: f64| (f64::from(i) * (2.0 * x - 1.0).clamp(-1.0, 1.0).acos()).cos();
    let outside = |i: i32, x: f64| {
        let y = 2.0 * x - 1.0;
        let size = (f64::from(i) * y.abs().acosh()).cosh();
        if y < 0.0 && i % 2 == 1 { -size } else { size }
    };
    let polynomial = |i: i32, x: f64| match (0.0..=1.0).contains(&x) {
        true => chebyshev(i, x),
        false => outside(i, x),
    };
    let residual = |i: i32| {
        let mean = x.iter().map(|x| polynomial(i, *x)).sum::<f64>() / x.len() as f64;
        let integral = if i % 2 == 0 { -1.0 / f64::from(i * i - 1) } else { 0.0 };
        mean - integral
    };
    (1..=x.len() as i32).map(residual).collect()
}

fn problem(
    name: &'static str,
    residuals: fn(&[f64]) -> Vec<f64>,
    start: &[f64],
    least: f64,
    near: &[f64],
) -> Problem {
    let range = |x: &f64| [x - 10.0 * x.abs().max(1.0), x + 10.0 * x.abs().max(1.0)];
    Problem {
        name,
        function: Function::Squares(residuals),
        start: start.to_vec(),
        ranges: start.iter().map(range).collect(),
        least,
        near: (!near.is_empty()).then(|| near.to_vec()),
        tolerance: (1e-4 * least).max(1e-8),
    }
}

pub fn all() -> Vec<Problem> {
    let thirds: Vec<f64> = (1..=10).map(|j| 1.0 - f64::from(j) / 10.0).collect();
    let spread: Vec<f64> = (1..=8).map(|j| f64::from(j) / 9.0).collect();
    let [quarter, half] = [[0.25; 4], [0.5; 4]];
    let valleys = [-1.2, 1.0].repeat(5);
    let singular = [3.0, -1.0, 0.0, 1.0];
    vec![
        problem("rosenbrock", rosenbrock, &[-1.2, 1.0], 0.0, &[1.0, 1.0]),
        problem("freudenstein_roth", freudenstein_roth, &[0.5, -2.0], 0.0, &[5.0, 4.0]),
        problem("powell_badly_scaled", powell_badly_scaled, &[0.0, 1.0], 0.0, &[1.098e-5, 9.106]),
        problem("brown_badly_scaled", brown_badly_scaled, &[1.0, 1.0], 0.0, &[1e6, 2e-6]),
        problem("beale", beale, &[1.0, 1.0], 0.0, &[3.0, 0.5]),
        problem("jennrich_sampson", jennrich_sampson, &[0.3, 0.4], 124.362_18, &[0.2578, 0.2578]),
        problem("helical_valley", helical_valley, &[-1.0, 0.0, 0.0], 0.0, &[1.0, 0.0, 0.0]),
        problem("bard", bard, &[1.0, 1.0, 1.0], 8.214_87e-3, &[0.082_41, 1.133, 2.3437]),
        problem("gaussian", gaussian, &[0.4, 1.0, 0.0], 1.127_93e-8, &[]),
        problem(
            "meyer",
            meyer,
            &[0.02, 4000.0, 250.0],
            87.945_86,
            &[0.005_609_6, 6181.35, 345.224],
        ),
        problem("gulf", gulf, &[5.0, 2.5, 0.15], 0.0, &[50.0, 25.0, 1.5]),
        problem("box_3", box_3, &[0.0, 10.0, 20.0], 0.0, &[1.0, 10.0, 1.0]),
        problem("powell_singular", powell_singular, &singular, 0.0, &[0.0; 4]),
        problem("wood", wood, &[-3.0, -1.0, -3.0, -1.0], 0.0, &[1.0; 4]),
        problem("kowalik_osborne", kowalik_osborne, &[0.25, 0.39, 0.415, 0.39], 3.075_05e-4, &[]),
        problem("brown_dennis", brown_dennis, &[25.0, 5.0, -5.0, -1.0], 85_822.2, &[]),
        problem("osborne_1", osborne_1, &[0.5, 1.5, -1.0, 0.01, 0.02], 5.464_89e-5, &[]),
        problem(
            "biggs_exp6",
            biggs_exp6,
            &[1.0, 2.0, 1.0, 1.0, 1.0, 1.0],
            0.0,
            &[1.0, 10.0, 1.0, 5.0, 4.0, 3.0],
        ),
        problem(
            "osborne_2",
            osborne_2,
            &[1.3, 0.65, 0.65, 0.7, 0.6, 3.0, 5.0, 7.0, 2.0, 4.5, 5.5],
            4.013_77e-2,
            &[],
        ),
        problem("watson_6", watson, &[0.0; 6], 2.287_67e-3, &[]),
        problem("rosenbrock_10", rosenbrock, &valleys, 0.0, &[1.0; 10]),
        problem("powell_singular_8", powell_singular, &singular.repeat(2), 0.0, &[0.0; 8]),
        problem("penalty_1", penalty_1, &[1.0, 2.0, 3.0, 4.0], 2.249_97e-5, &quarter),
        problem("penalty_2", penalty_2, &half, 9.376_29e-6, &[]),
        problem("variably_dimensioned", variably_dimensioned, &thirds, 0.0, &[1.0; 10]),
        problem("trigonometric", trigonometric, &[0.1; 10], 0.0, &[0.0; 10]),
        problem("brown_almost_linear", brown_almost_linear, &half, 0.0, &[1.0; 4]),
        problem("broyden_tridiagonal", broyden_tridiagonal, &[-1.0; 10], 0.0, &[]),
        problem("chebyquad", chebyquad, &spread, 3.516_87e-3, &[]),
    ]
}
