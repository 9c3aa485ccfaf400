//! The groups of both splits, the levels in which they are fitted, and their neighbours.

use super::groups::{Group, Lattice};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// Groups, those of the search split first.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub groups: Vec<Group>,
    /// The number of groups of the search split.
    pub searched: usize,
    /// The grid of the search split's groups.
    pub lattice: Option<Lattice>,
    /// The groups of each level, the coarsest first; the last level is the validation split's.
    pub levels: Vec<Vec<u32>>,
    /// By group, those around it of coarser levels.
    pub coarser: Vec<Vec<u32>>,
    /// By group of the search split, those next to it.
    pub beside: Vec<Vec<u32>>,
}

impl Layout {
    pub fn new(search: Vec<Group>, validation: Vec<Group>) -> Layout {
        let searched = search.len();
        let lattice = Lattice::of(&search);
        let (mut levels, mut coarser, beside) = match &lattice {
            Some(lattice) => on_lattice(lattice),
            None => scattered(&search),
        };
        let around = |group: &Group| {
            let corners =
                lattice.as_ref().map(|lattice| lattice.corners(&lattice.around(&group.place)));
            match corners.unwrap_or_default() {
                corners if corners.is_empty() => nearest(&search, &group.place, search.len()),
                corners => corners,
            }
        };
        coarser.extend(validation.par_iter().map(around).collect::<Vec<_>>());
        let groups: Vec<Group> = search.into_iter().chain(validation).collect();
        if groups.len() > searched {
            levels.push((searched as u32..groups.len() as u32).collect());
        }
        Layout { groups, searched, lattice, levels, coarser, beside }
    }
}

type Levels = (Vec<Vec<u32>>, Vec<Vec<u32>>, Vec<Vec<u32>>);

/// The first level is the group in the middle; each further one halves the distances.
fn on_lattice(lattice: &Lattice) -> Levels {
    let middle: Vec<i64> = lattice.axes.iter().map(|axis| axis.len() as i64 / 2).collect();
    let finest = |at: &Vec<u32>| {
        let zeros = at.iter().zip(&middle).map(|(&i, middle)| {
            let away = i64::from(i) - middle;
            if away == 0 { i64::BITS } else { away.trailing_zeros() }
        });
        zeros.min().unwrap_or(i64::BITS)
    };
    let fineness: Vec<u32> = lattice.at.iter().map(finest).collect();
    let mut steps = fineness.clone();
    steps.sort_unstable();
    steps.dedup();
    let of_level = |&step: &u32| {
        (0..fineness.len() as u32).filter(|&group| fineness[group as usize] == step).collect()
    };
    let levels = steps.iter().rev().map(of_level).collect();
    let coarser = |(at, &step): (&Vec<u32>, &u32)| {
        if step == i64::BITS {
            return Vec::new();
        }
        let apart = 2i64 << step;
        let along = |(&i, middle): (&u32, &i64)| {
            let below = middle + (i64::from(i) - middle).div_euclid(apart) * apart;
            let above = if below == i64::from(i) { below } else { below + apart };
            let mut both: Vec<u32> =
                [below, above].into_iter().filter_map(|i| u32::try_from(i).ok()).collect();
            both.dedup();
            both
        };
        let around: Vec<Vec<u32>> = at.iter().zip(&middle).map(along).collect();
        lattice.corners(&around)
    };
    let coarser = lattice.at.iter().zip(&fineness).map(coarser).collect();
    let beside = (0..lattice.at.len()).map(|group| lattice.beside(group)).collect();
    (levels, coarser, beside)
}

/// Each level has so many times the groups of all before it. By hand, unmeasured.
const TIMES: usize = 3;

/// Takes scattered groups in a random order, level by level.
fn scattered(groups: &[Group]) -> Levels {
    let mut order: Vec<u32> = (0..groups.len() as u32).collect();
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for place in (1..order.len()).rev() {
        order.swap(place, rng.random_range(0..=place));
    }
    let mut levels: Vec<Vec<u32>> = Vec::new();
    let mut rest = order.as_slice();
    let mut before = 0;
    while !rest.is_empty() {
        let (level, others) = rest.split_at((TIMES * before).clamp(1, rest.len()));
        levels.push(level.to_vec());
        before += level.len();
        rest = others;
    }
    let ordered: Vec<Group> = order.iter().map(|&group| groups[group as usize].clone()).collect();
    let mut coarser = vec![Vec::new(); groups.len()];
    let mut begun = 0;
    for level in &levels {
        let near = |&group: &u32| {
            let near = nearest(&ordered, &groups[group as usize].place, begun);
            near.into_iter().map(|place| order[place as usize]).collect::<Vec<u32>>()
        };
        let found: Vec<Vec<u32>> = level.par_iter().map(near).collect();
        level.iter().zip(found).for_each(|(&group, found)| coarser[group as usize] = found);
        begun += level.len();
    }
    (levels, coarser, mutual(groups))
}

/// Returns the nearest groups of each, and those that it is one of the nearest of.
fn mutual(groups: &[Group]) -> Vec<Vec<u32>> {
    let near = |group: &Group| nearest(groups, &group.place, groups.len());
    let found: Vec<Vec<u32>> = groups.par_iter().map(near).collect();
    let mut beside = found.clone();
    for (group, near) in found.iter().enumerate() {
        near.iter().for_each(|&other| beside[other as usize].push(group as u32));
    }
    for (group, near) in beside.iter_mut().enumerate() {
        near.sort_unstable();
        near.dedup();
        near.retain(|&other| other as usize != group);
    }
    beside
}

/// Returns the groups nearest to a place among the first ones, two for each axis and itself left
/// out; distances count in the extents of all.
fn nearest(groups: &[Group], place: &[f32], first: usize) -> Vec<u32> {
    let extent = |axis: usize| {
        let values = groups.iter().map(|group| group.place[axis]);
        let [low, high] = values.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        });
        if high > low { f64::from(high) - f64::from(low) } else { 1.0 }
    };
    let extents: Vec<f64> = (0..place.len()).map(extent).collect();
    let distance = |group: &Group| -> f64 {
        let apart = group.place.iter().zip(place).zip(&extents);
        apart.map(|((a, b), extent)| ((f64::from(*a) - f64::from(*b)) / extent).powi(2)).sum()
    };
    let most = 2 * place.len();
    let mut found: Vec<(f64, u32)> = Vec::new();
    for (group, number) in groups[..first].iter().zip(0..) {
        let distance = distance(group);
        if distance == 0.0 {
            continue;
        }
        let place = found.partition_point(|(other, _)| *other <= distance);
        if place < most {
            found.insert(place, (distance, number));
            found.truncate(most);
        }
    }
    found.into_iter().map(|(_, number)| number).collect()
}
