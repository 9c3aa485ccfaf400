//! Groups of which every two are together.

/// Lists the largest sets of which every two are together (Bron & Kerbosch 1973, "Finding All
/// Cliques of an Undirected Graph").
pub(super) fn groups(together: &[Vec<bool>]) -> Vec<Vec<usize>> {
    let mut found = Vec::new();
    let all: Vec<usize> = (0..together.len()).collect();
    extend(together, &mut Vec::new(), &all, &[], &mut found);
    found
}

/// Extends a set by what is open, and not by what is done: sets with these are listed already.
fn extend(
    together: &[Vec<bool>],
    chosen: &mut Vec<usize>,
    open: &[usize],
    done: &[usize],
    found: &mut Vec<Vec<usize>>,
) {
    if open.is_empty() {
        if done.is_empty() {
            found.push(chosen.clone());
        }
        return;
    }
    let mut done = done.to_vec();
    for (at, &next) in open.iter().enumerate() {
        let beside = |others: &[usize]| -> Vec<usize> {
            others.iter().copied().filter(|&other| together[next][other]).collect()
        };
        chosen.push(next);
        extend(together, chosen, &beside(&open[at + 1..]), &beside(&done), found);
        chosen.pop();
        done.push(next);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_the_largest_and_may_share() {
        let of = |pairs: &[[usize; 2]]| {
            let beside = |a, b| a == b || pairs.contains(&[a, b]) || pairs.contains(&[b, a]);
            groups(&(0..3).map(|a| (0..3).map(|b| beside(a, b)).collect()).collect::<Vec<_>>())
        };
        assert_eq!(of(&[]), [vec![0], vec![1], vec![2]]);
        assert_eq!(of(&[[0, 2], [1, 2]]), [vec![0, 2], vec![1, 2]]);
        assert_eq!(of(&[[0, 1], [0, 2], [1, 2]]), [vec![0, 1, 2]]);
    }
}
