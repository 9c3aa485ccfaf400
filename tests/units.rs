//! Units do not matter: whatever columns are multiplied by or lie away from zero, the same is found.

use lgp::dataset::{Column, Dataset, Split};
use lgp::op::Op;
use lgp::program::{Constants, structural_hash};
use lgp::search::{Front, Goal, Method, Problem, Search};

/// Values of `f` over a grid of two inputs, each input and output as `map` gives them.
fn dataset(
    name: &str,
    f: impl Fn(f32, f32) -> Vec<f32>,
    map_inputs: impl Fn(f32, f32) -> [f32; 2],
    map_output: impl Fn(usize, f32) -> f32,
) -> Dataset {
    let split = |side: u16| {
        let at = |i: u16| f32::from(i) / f32::from(side - 1);
        let points: Vec<(f32, f32)> =
            (0..side).flat_map(|i| (0..side).map(move |j| (at(i), at(j)))).collect();
        let outputs = f(0.0, 0.0).len();
        let mut columns = vec![Vec::new(); 2 + outputs];
        for &(x, z) in &points {
            let inputs = map_inputs(x, z);
            columns[0].push(inputs[0]);
            columns[1].push(inputs[1]);
            for (o, y) in f(x, z).into_iter().enumerate() {
                columns[2 + o].push(map_output(o, y));
            }
        }
        Split { columns, ..Split::default() }
    };
    let (search, validation) = (split(16), split(23));
    let column = |i: usize, name: String| {
        let values = search.columns[i].iter().chain(&validation.columns[i]);
        let domain = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &v| {
            [low.min(v.into()), high.max(v.into())]
        });
        Column { name, unit: "1".into(), domain }
    };
    let outputs = search.columns.len() - 2;
    Dataset {
        name: name.into(),
        inputs: vec![column(0, "x".into()), column(1, "z".into())],
        outputs: (0..outputs).map(|o| column(2 + o, format!("y{o}"))).collect(),
        search,
        validation,
        ..Dataset::default()
    }
}

fn front(data: &Dataset, generations: u64) -> Front {
    front_of(
        data,
        (
            Goal { max_cost: 16.0, ..Goal::default() },
            Method { islands: 3, candidates: 100, ..Method::default() },
        ),
        generations,
    )
}

fn front_of(data: &Dataset, asked: (Goal, Method), generations: u64) -> Front {
    let (goal, method) = asked;
    let problem = Problem::of(data.clone()).goal(goal).build().unwrap();
    let mut search = Search::new(problem, method).unwrap();
    (0..generations).for_each(|_| search.advance());
    Front::of(&search)
}

/// No short formula is exact, so that errors fall evenly with the cost.
fn lobe(x: f32, z: f32) -> Vec<f32> {
    vec![(-3.0 * x * (0.3 + z)).exp() * (1.0 - 0.4 * z) + 0.2 * x * (2.0 * z + x * x).sin()]
}

/// Cost, structure, and errors divided by the output's unit.
fn described(front: &Front, unit: f64) -> Vec<(f64, u64, u64, u64)> {
    let describe = |member: &lgp::search::FrontMember| {
        let hash = structural_hash(&member.program, Constants::Ignored, &mut Vec::new());
        let (search, validation) = (member.search_error(), member.validation_error());
        (member.cost, hash, (search.rmse / unit).to_bits(), (validation.max / unit).to_bits())
    };
    front.members.iter().map(describe).collect()
}

/// Whatever power of two inputs and outputs are multiplied by, so long as they are not of the order of one, the same
/// structures are found, with the same errors to the bit; and others among units so large that the square of an
/// input would leave `f32`.
#[test]
fn powers_of_two_change_nothing() {
    type Powers = fn(i32) -> [i32; 3];
    let scaled: [(&str, Powers); 3] =
        [("output", |k| [0, 0, k]), ("inputs", |k| [k, k, 0]), ("all", |k| [k, -k, k])];
    for (what, powers) in scaled {
        for powers_of_two in [&[-31, -17, 9, 31][..], &[-60, 44, 60]] {
            let found = powers_of_two.iter().map(|&k| {
                let [x_scale, z_scale, y_scale] = powers(k).map(|k| f64::from(k).exp2() as f32);
                let data =
                    dataset(what, lobe, |x, z| [x * x_scale, z * z_scale], |_, y| y * y_scale);
                (k, described(&front(&data, 12), y_scale.into()))
            });
            let found: Vec<_> = found.collect();
            assert!(found[0].1.len() >= 6, "{what}: {found:?}");
            for (k, front) in &found {
                assert_eq!(*front, found[0].1, "{what}, {k}");
            }
        }
    }
}

/// How much larger the errors of `lobe` are in other units than in its own, in the mean over costs and seeds, where as many
/// cycles more may be spent as it takes to bring inputs and outputs to their own.
fn loss_by_units(
    map_inputs: fn(f32, f32) -> [f32; 2],
    map_output: fn(usize, f32) -> f32,
    cycles: f64,
) -> f64 {
    let searched =
        |map_inputs: fn(f32, f32) -> [f32; 2], map_output: fn(usize, f32) -> f32, seed| {
            let data = dataset("lobe", lobe, map_inputs, map_output);
            let [low, high] = data.outputs[0].domain;
            (
                front_of(
                    &data,
                    (
                        Goal { max_cost: 15.0, ..Goal::default() },
                        Method { seed, candidates: 100, ..Method::default() },
                    ),
                    16,
                ),
                high - low,
            )
        };
    let relative = |(front, range): &(Front, f64), cost: f64| {
        let affordable = front.members.iter().filter(|member| member.cost <= cost);
        let errors = affordable.map(|member| member.validation_error().rmse / range);
        errors.fold(f64::INFINITY, f64::min)
    };
    let costs = [4.0, 6.0, 8.0, 10.0, 12.0];
    let mean = |seed: u64| {
        let plain = searched(|x, z| [x, z], |_, y| y, seed);
        let moved = searched(map_inputs, map_output, seed);
        let loss = |cost: f64| (relative(&moved, cost + cycles) / relative(&plain, cost)).ln();
        costs.into_iter().map(loss).sum::<f64>() / costs.len() as f64
    };
    // Luck decides about single ones.
    let seeds = 1..=4;
    (seeds.clone().map(mean).sum::<f64>() / seeds.count() as f64).exp()
}

#[test]
fn large_inputs_and_outputs_are_fitted_as_well() {
    let loss = loss_by_units(|x, z| [1024.0 * x, z / 512.0], |_, y| 4096.0 * y, 3.0);
    assert!(loss < 1.5, "{loss}");
}

/// An offset of the outputs costs an addition at most.
#[test]
fn outputs_may_lie_off_zero() {
    let loss = loss_by_units(|x, z| [x, z], |_, y| y + 1.5, 1.0);
    assert!(loss < 1.5, "{loss}");
}

/// Nanometres, and a column at 1e9: constants inside the formula centre and scale them at once.
#[test]
fn inputs_may_lie_far_from_zero() {
    let nanometres = loss_by_units(|x, z| [380.0 + 450.0 * x, z], |_, y| y, 2.0);
    let far = |x: f32, z: f32| [1e9 + 64.0 * (16384.0 * x).round(), 1000.0 + z];
    let far = loss_by_units(far, |_, y| y, 3.0);
    assert!(nanometres < 1.5 && far < 1.5, "{nanometres} {far}");
}

/// Two outputs of very different magnitude are found as well as each alone would be.
#[test]
fn outputs_count_each_in_its_own_magnitude() {
    let two = |x: f32, z: f32| vec![0.3 + 0.5 * x, (z - 0.2) * (z - 0.2) + 0.1];
    let scales = [1e-6, 1e6];
    let found = front(&dataset("two", two, |x, z| [x, z], |o, y| y * scales[o]), 12);
    let best = found.members.last().unwrap();
    for (o, error) in best.score.search.iter().enumerate() {
        let relative = error.rmse / f64::from(scales[o]);
        assert!(relative < 1e-5, "output {o}: {relative}: {}", best.formula);
    }
}

/// An exact law keeps no factor of the scaling.
#[test]
fn a_law_in_large_units_has_no_constant() {
    let law = |x: f32, z: f32| vec![(1.0 + x) * (1.0 + z)];
    let found = front(
        &dataset("law", law, |x, z| [100.0 * (1.0 + x), 100.0 * (1.0 + z)], |_, y| 1e4 * y),
        10,
    );
    let product = found.members.iter().find(|member| member.cost == 1.0).unwrap();
    assert!(
        product.program.instrs.iter().all(|instr| instr.op() == Op::Mul),
        "{}",
        product.formula
    );
    assert!(product.program.consts.is_empty(), "{}", product.formula);
}

/// Laws have the constants that they have in their own units, not what scaling makes of them.
#[test]
fn laws_keep_short_constants_in_any_unit() {
    type Law = fn(f32) -> f32;
    let laws: [(Law, Law, &[f32]); 4] = [
        (|x| 380.0 + 450.0 * x, |x| 2.5 * x - 0.75, &[0.75, 2.5]),
        (|x| 1000.0 * x, |x| 0.002 * x * x + 7.0, &[0.002, 7.0]),
        (|x| x, |x| 3e-6 * x * x + 1e-6 * x, &[1e-6, 3e-6]),
        (|x| 1e6 * (x + 0.02), |x| x * (1e-6 * x), &[1e-6]),
    ];
    for (input, law, constants) in laws {
        let data = dataset("law", |_, _| vec![0.0], |x, z| [input(x), z], |_, _| 0.0);
        let mut data = Dataset { outputs: data.outputs.clone(), ..data };
        for split in [&mut data.search, &mut data.validation] {
            split.columns[2] = split.columns[0].iter().map(|&x| law(x)).collect();
        }
        let ends = [f64::INFINITY, f64::NEG_INFINITY];
        data.outputs[0].domain = data.search.columns[2]
            .iter()
            .fold(ends, |[low, high], &y| [low.min(y.into()), high.max(y.into())]);
        let found = front(&data, 10);
        let read = |one: &lgp::search::FrontMember| {
            let mut constants: Vec<f32> = one.program.consts.iter().map(|c| c.abs()).collect();
            constants.sort_by(f32::total_cmp);
            constants
        };
        let formulas: Vec<&str> = found.members.iter().map(|one| one.formula.as_str()).collect();
        assert!(found.members.iter().any(|one| read(one) == constants), "{formulas:?}");
    }
}
