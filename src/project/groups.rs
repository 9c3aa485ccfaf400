//! Groups of rows, and how they lie to each other.

use crate::dataset::Split;
use rayon::prelude::*;
use std::cmp::Ordering;
use std::collections::HashMap;

/// The rows that have the same values of some inputs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Group {
    /// The values.
    pub place: Vec<f32>,
    pub rows: Vec<u32>,
}

/// Groups the rows of a split by some inputs, in ascending order, the last input fastest. Rows of
/// no weight are in no group.
pub(super) fn groups_of(split: &Split, over: &[usize]) -> Vec<Group> {
    let value = |row: u32, column: usize| plain(split.columns[column][row as usize]);
    let by_place = |a: u32, b: u32| {
        let orders = over.iter().map(|&column| value(a, column).total_cmp(&value(b, column)));
        orders.fold(Ordering::Equal, Ordering::then)
    };
    let mut rows: Vec<u32> = (0..split.rows() as u32).collect();
    rows.retain(|&row| split.weight(row as usize) > 0.0);
    rows.par_sort_unstable_by(|&a, &b| by_place(a, b).then(a.cmp(&b)));
    let same = |a: &u32, b: &u32| by_place(*a, *b) == Ordering::Equal;
    let group = |rows: &[u32]| Group {
        place: over.iter().map(|&column| value(rows[0], column)).collect(),
        rows: rows.to_vec(),
    };
    rows.chunk_by(same).map(group).collect()
}

/// Negative zero is zero.
fn plain(value: f32) -> f32 {
    value + 0.0
}

/// The regular grid that places lie on, or most of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Lattice {
    /// The values along each axis, ascending.
    pub axes: Vec<Vec<f32>>,
    /// The coordinates of each group.
    pub at: Vec<Vec<u32>>,
    by_place: HashMap<Vec<u32>, u32>,
}

/// The least share of a grid's places that groups must take for it to be one with holes, as one in
/// so many; fewer are scattered. By hand.
const ONE_IN: usize = 2;

impl Lattice {
    /// Finds the grid of places; none if they are scattered.
    pub fn of(groups: &[Group]) -> Option<Lattice> {
        let inputs = groups.first()?.place.len();
        let axes: Vec<Vec<f32>> = (0..inputs).map(|axis| values_along(groups, axis)).collect();
        let points = axes.iter().try_fold(1usize, |all, axis| all.checked_mul(axis.len()))?;
        if points > groups.len().saturating_mul(ONE_IN) {
            return None;
        }
        let coordinate = |axis: &Vec<f32>, value: &f32| axis.partition_point(|v| v < value) as u32;
        let at = |group: &Group| -> Vec<u32> {
            axes.iter().zip(&group.place).map(|(axis, value)| coordinate(axis, value)).collect()
        };
        let at: Vec<Vec<u32>> = groups.iter().map(at).collect();
        let by_place = at.iter().cloned().zip(0..).collect();
        Some(Lattice { axes, at, by_place })
    }

    /// Returns the number of points along each axis.
    pub fn grid(&self) -> Vec<usize> {
        self.axes.iter().map(Vec::len).collect()
    }

    /// Returns true if no group is missing.
    pub fn is_full(&self) -> bool {
        self.grid().iter().product::<usize>() == self.at.len()
    }

    /// Returns the group at some coordinates.
    pub fn group(&self, at: &[u32]) -> Option<u32> {
        self.by_place.get(at).copied()
    }

    /// Lists the places that have no group, at most so many.
    pub fn missing(&self, most: usize) -> Vec<Vec<f32>> {
        let grid = self.grid();
        let coordinates = |mut place: usize| -> Vec<u32> {
            let mut at = vec![0; grid.len()];
            for (coordinate, points) in at.iter_mut().zip(&grid).rev() {
                *coordinate = (place % points) as u32;
                place /= points;
            }
            at
        };
        let values = |at: Vec<u32>| -> Vec<f32> {
            at.iter().zip(&self.axes).map(|(&i, axis)| axis[i as usize]).collect()
        };
        let all = (0..grid.iter().product()).map(coordinates);
        all.filter(|at| self.group(at).is_none()).take(most).map(values).collect()
    }

    /// Returns the groups next to one along each axis, beyond a hole of one place, too.
    pub fn beside(&self, group: usize) -> Vec<u32> {
        let at = &self.at[group];
        let next = |axis: usize, steps: &[i64]| {
            steps.iter().find_map(|step| {
                let mut beside = at.clone();
                beside[axis] = u32::try_from(i64::from(at[axis]) + step).ok()?;
                self.group(&beside)
            })
        };
        let both = |axis: usize| [next(axis, &[-1, -2]), next(axis, &[1, 2])];
        (0..at.len()).flat_map(both).flatten().collect()
    }

    /// Returns the groups at corners of a cell, given the coordinates around each axis.
    pub fn corners(&self, around: &[Vec<u32>]) -> Vec<u32> {
        let longer = |corners: Vec<Vec<u32>>, along: &Vec<u32>| {
            let extended = |corner: &Vec<u32>, &next| [corner.as_slice(), &[next]].concat();
            let each = |corner| along.iter().map(move |next| extended(corner, next));
            corners.iter().flat_map(each).collect()
        };
        let corners = around.iter().fold(vec![Vec::new()], longer);
        corners.iter().filter_map(|corner| self.group(corner)).collect()
    }

    /// Returns the coordinates around a place along each axis: one, or two next to each other.
    pub fn around(&self, place: &[f32]) -> Vec<Vec<u32>> {
        let along = |(axis, value): (&Vec<f32>, &f32)| {
            let above = axis.partition_point(|v| v < value);
            let last = axis.len() - 1;
            match above {
                above if above > last => vec![last as u32],
                above if above == 0 || axis[above] == *value => vec![above as u32],
                above => vec![above as u32 - 1, above as u32],
            }
        };
        self.axes.iter().zip(place).map(along).collect()
    }
}

/// Returns the values that places have along an axis, ascending.
pub(super) fn values_along(groups: &[Group], axis: usize) -> Vec<f32> {
    let mut values: Vec<f32> = groups.iter().map(|group| group.place[axis]).collect();
    values.sort_unstable_by(f32::total_cmp);
    values.dedup();
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(columns: [&[f32]; 3]) -> Split {
        Split { columns: columns.map(<[f32]>::to_vec).to_vec(), ..Split::default() }
    }

    #[test]
    fn rows_of_equal_values_are_a_group_and_zero_has_no_sign() {
        let mut rows = split([&[0.0, 1.0, -0.0, 1.0], &[5.0, 5.0, 5.0, 4.0], &[9.0; 4]]);
        let found = groups_of(&rows, &[0, 1]);
        let places: Vec<&[f32]> = found.iter().map(|group| group.place.as_slice()).collect();
        assert_eq!(places, [[0.0, 5.0], [1.0, 4.0], [1.0, 5.0]]);
        assert_eq!(found[0].rows, [0, 2]);
        rows.weights = vec![1.0, 0.0, 0.0, 1.0];
        assert_eq!(groups_of(&rows, &[1]).iter().map(|group| group.rows.len()).max(), Some(1));
    }

    #[test]
    fn a_grid_with_few_holes_is_one_and_says_which() {
        let groups: Vec<Group> = [[0.0, 0.0], [0.0, 1.0], [2.0, 0.0], [4.0, 0.0], [4.0, 1.0]]
            .map(|place| Group { place: place.to_vec(), rows: vec![0] })
            .to_vec();
        let lattice = Lattice::of(&groups).unwrap();
        assert_eq!((lattice.grid(), lattice.is_full()), (vec![3, 2], false));
        assert_eq!(lattice.missing(9), [[2.0, 1.0]]);
        // Beyond the hole at (2, 1).
        assert_eq!(lattice.beside(1), [4, 0]);
        assert_eq!(lattice.corners(&lattice.around(&[1.0, 0.5])), [0, 1, 2]);
        assert_eq!(lattice.corners(&lattice.around(&[9.0, 1.0])), [4]);
        let scattered: Vec<Group> = (0..9)
            .map(|i| Group {
                place: vec![i as f32, (i * i % 7) as f32 + 0.1 * i as f32],
                rows: vec![],
            })
            .collect();
        assert_eq!(Lattice::of(&scattered), None);
    }
}
