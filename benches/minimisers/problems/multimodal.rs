//! Functions with many minima, as collected by Surjanovic and Bingham, "Virtual library of
//! simulation experiments", and before by Dixon and Szegő (1978).

use super::{Function, Problem};
use std::f64::consts::{E, PI, TAU};

fn rastrigin(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x - 10.0 * (TAU * x).cos() + 10.0).sum()
}

fn ackley(x: &[f64]) -> f64 {
    let mean = |f: fn(&f64) -> f64| x.iter().map(f).sum::<f64>() / x.len() as f64;
    let (squares, waves) = (mean(|x| x * x), mean(|x| (TAU * x).cos()));
    20.0 + E - 20.0 * (-0.2 * squares.sqrt()).exp() - waves.exp()
}

fn griewank(x: &[f64]) -> f64 {
    let squares: f64 = x.iter().map(|x| x * x / 4000.0).sum();
    let waves: f64 = (1..).zip(x).map(|(i, x)| (x / f64::from(i).sqrt()).cos()).product();
    squares - waves + 1.0
}

fn schwefel(x: &[f64]) -> f64 {
    x.iter().map(|x| 418.982_887_272_433_7 - x * x.abs().sqrt().sin()).sum()
}

fn levy(x: &[f64]) -> f64 {
    let w: Vec<f64> = x.iter().map(|x| 1.0 + (x - 1.0) / 4.0).collect();
    let last = w[w.len() - 1];
    let middle = |w: &f64| (w - 1.0).powi(2) * (1.0 + 10.0 * (PI * w + 1.0).sin().powi(2));
    (PI * w[0]).sin().powi(2)
        + w[..w.len() - 1].iter().map(middle).sum::<f64>()
        + (last - 1.0).powi(2) * (1.0 + (TAU * last).sin().powi(2))
}

const FOXHOLES: [([f64; 4], f64); 10] = [
    ([4.0, 4.0, 4.0, 4.0], 0.1),
    ([1.0, 1.0, 1.0, 1.0], 0.2),
    ([8.0, 8.0, 8.0, 8.0], 0.2),
    ([6.0, 6.0, 6.0, 6.0], 0.4),
    ([3.0, 7.0, 3.0, 7.0], 0.4),
    ([2.0, 9.0, 2.0, 9.0], 0.6),
    ([5.0, 5.0, 3.0, 3.0], 0.3),
    ([8.0, 1.0, 8.0, 1.0], 0.7),
    ([6.0, 2.0, 6.0, 2.0], 0.5),
    ([7.0, 3.6, 7.0, 3.6], 0.5),
];

fn shekel<const M: usize>(x: &[f64]) -> f64 {
    let depth = |(at, width): &([f64; 4], f64)| {
        1.0 / (width + x.iter().zip(at).map(|(x, a)| (x - a).powi(2)).sum::<f64>())
    };
    -FOXHOLES[..M].iter().map(depth).sum::<f64>()
}

/// Four Gaussians: height, inverse squared widths, centre.
fn hartmann<const D: usize>(x: &[f64], terms: [(f64, [f64; D], [f64; D]); 4]) -> f64 {
    let term = |(height, widths, centre): &(f64, [f64; D], [f64; D])| {
        let along = x.iter().zip(widths).zip(centre);
        height * (-along.map(|((x, a), p)| a * (x - p).powi(2)).sum::<f64>()).exp()
    };
    -terms.iter().map(term).sum::<f64>()
}

fn hartmann_3(x: &[f64]) -> f64 {
    let (wide, narrow) = ([3.0, 10.0, 30.0], [0.1, 10.0, 35.0]);
    hartmann(
        x,
        [
            (1.0, wide, [0.3689, 0.1170, 0.2673]),
            (1.2, narrow, [0.4699, 0.4387, 0.7470]),
            (3.0, wide, [0.1091, 0.8732, 0.5547]),
            (3.2, narrow, [0.0381, 0.5743, 0.8828]),
        ],
    )
}

fn hartmann_6(x: &[f64]) -> f64 {
    let first = [10.0, 3.0, 17.0, 3.5, 1.7, 8.0];
    let second = [0.05, 10.0, 17.0, 0.1, 8.0, 14.0];
    let third = [3.0, 3.5, 1.7, 10.0, 17.0, 8.0];
    let fourth = [17.0, 8.0, 0.05, 10.0, 0.1, 14.0];
    hartmann(
        x,
        [
            (1.0, first, [0.1312, 0.1696, 0.5569, 0.0124, 0.8283, 0.5886]),
            (1.2, second, [0.2329, 0.4135, 0.8307, 0.3736, 0.1004, 0.9991]),
            (3.0, third, [0.2348, 0.1451, 0.3522, 0.2883, 0.3047, 0.6650]),
            (3.2, fourth, [0.4047, 0.8828, 0.8732, 0.5743, 0.1091, 0.0381]),
        ],
    )
}

fn goldstein_price(x: &[f64]) -> f64 {
    let (a, b) = (x[0], x[1]);
    let first = 19.0 - 14.0 * a + 3.0 * a * a - 14.0 * b + 6.0 * a * b + 3.0 * b * b;
    let second = 18.0 - 32.0 * a + 12.0 * a * a + 48.0 * b - 36.0 * a * b + 27.0 * b * b;
    (1.0 + (a + b + 1.0).powi(2) * first) * (30.0 + (2.0 * a - 3.0 * b).powi(2) * second)
}

fn branin(x: &[f64]) -> f64 {
    let bend = x[1] - 5.1 / (4.0 * PI * PI) * x[0] * x[0] + 5.0 / PI * x[0] - 6.0;
    bend.powi(2) + 10.0 * (1.0 - 1.0 / (8.0 * PI)) * x[0].cos() + 10.0
}

fn six_hump_camel(x: &[f64]) -> f64 {
    let (a, b) = (x[0] * x[0], x[1] * x[1]);
    (4.0 - 2.1 * a + a * a / 3.0) * a + x[0] * x[1] + (4.0 * b - 4.0) * b
}

fn problem(
    name: &'static str,
    f: fn(&[f64]) -> f64,
    ranges: Vec<[f64; 2]>,
    least: f64,
    near: &[f64],
) -> Problem {
    let start = ranges.iter().map(|[low, high]| 0.5 * (low + high)).collect();
    let near = Some((0..ranges.len()).map(|axis| near[axis % near.len()]).collect());
    let tolerance = 1e-6 * least.abs().max(1.0);
    Problem { name, function: Function::Value(f), start, ranges, least, near, tolerance }
}

pub fn all() -> Vec<Problem> {
    let cube = |half: f64, dimensions: usize| vec![[-half, half]; dimensions];
    let foxholes = || vec![[0.0, 10.0]; 4];
    let deep = [420.968_746_359_982];
    let camel = vec![[-3.0, 3.0], [-2.0, 2.0]];
    let bends = vec![[-5.0, 10.0], [0.0, 15.0]];
    let third = [0.114_614, 0.555_649, 0.852_547];
    let sixth = [0.201_69, 0.150_011, 0.476_874, 0.275_332, 0.311_652, 0.657_3];
    vec![
        problem("branin", branin, bends, 0.397_887_357_729_739, &[PI, 2.275]),
        problem(
            "six_hump_camel",
            six_hump_camel,
            camel,
            -1.031_628_453_489_877,
            &[0.0898, -0.7126],
        ),
        problem("goldstein_price", goldstein_price, cube(2.0, 2), 3.0, &[0.0, -1.0]),
        problem("rastrigin_2", rastrigin, cube(5.12, 2), 0.0, &[0.0]),
        problem("ackley_2", ackley, cube(32.768, 2), 0.0, &[0.0]),
        problem("griewank_2", griewank, cube(600.0, 2), 0.0, &[0.0]),
        problem("schwefel_2", schwefel, cube(500.0, 2), 0.0, &deep),
        problem("levy_2", levy, cube(10.0, 2), 0.0, &[1.0]),
        problem("hartmann_3", hartmann_3, vec![[0.0, 1.0]; 3], -3.862_782_147_820_756, &third),
        problem("shekel_5", shekel::<5>, foxholes(), -10.153_199_679_058_23, &[4.0]),
        problem("shekel_7", shekel::<7>, foxholes(), -10.402_940_566_818_66, &[4.0]),
        problem("shekel_10", shekel::<10>, foxholes(), -10.536_409_816_692_05, &[4.0]),
        problem("rastrigin_5", rastrigin, cube(5.12, 5), 0.0, &[0.0]),
        problem("schwefel_5", schwefel, cube(500.0, 5), 0.0, &deep),
        problem("hartmann_6", hartmann_6, vec![[0.0, 1.0]; 6], -3.322_368_011_415_515, &sixth),
        problem("rastrigin_10", rastrigin, cube(5.12, 10), 0.0, &[0.0]),
        problem("ackley_10", ackley, cube(32.768, 10), 0.0, &[0.0]),
        problem("griewank_10", griewank, cube(600.0, 10), 0.0, &[0.0]),
        problem("schwefel_10", schwefel, cube(500.0, 10), 0.0, &deep),
        problem("levy_10", levy, cube(10.0, 10), 0.0, &[1.0]),
    ]
}
