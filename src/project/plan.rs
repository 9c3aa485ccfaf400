//! The order of fits: stages, whose fits do not depend on each other.

use super::layout::Layout;

/// Fits that read only what earlier stages have found.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stage {
    pub kind: Kind,
    pub groups: Vec<u32>,
}

/// What is done with each group of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// From the optima around it, and globally where it is told to or these do not suffice.
    Level { globally: bool },
    /// Again, from neighbours' optima that are far from its own.
    Compare { first: bool },
    /// From coarser groups, pulled towards them.
    PulledLevel,
    /// Pulled towards its neighbours; `first` of a sweep over all groups.
    Sweep { round: u32, first: bool },
}

/// The number of groups that are all fitted globally before any is trusted to its neighbours. By
/// hand: a grid of 8 by 8.
const GLOBALLY: usize = 64;

/// The most comparisons with neighbours. By hand, unmeasured.
const COMPARISONS: u32 = 4;

/// The most sweeps. By hand: the coarser levels leave little to them.
const SWEEPS: u32 = 24;

/// Plans the fits. Groups that are `thin` have too few rows for a fit that nothing pulls.
pub(super) fn plan(
    layout: &Layout,
    thin: impl Fn(u32) -> bool,
    smooth: bool,
    everywhere: bool,
) -> Vec<Stage> {
    let fat = |groups: &[u32]| groups.iter().copied().filter(|&g| !thin(g)).collect::<Vec<u32>>();
    let of_search = |group: &u32| (*group as usize) < layout.searched;
    let (levels, last): (Vec<&Vec<u32>>, Vec<&Vec<u32>>) =
        layout.levels.iter().partition(|level| level.iter().all(of_search));
    let mut stages = Vec::new();
    let mut begun = 0;
    for level in &levels {
        begun += level.len();
        let kind = Kind::Level { globally: everywhere || begun <= GLOBALLY };
        stages.push(Stage { kind, groups: fat(level) });
    }
    let all: Vec<u32> = (0..layout.searched as u32).collect();
    for round in 0..COMPARISONS {
        stages.push(Stage { kind: Kind::Compare { first: round == 0 }, groups: fat(&all) });
    }
    let validation = last.iter().flat_map(|level| fat(level)).collect::<Vec<u32>>();
    stages.push(Stage { kind: Kind::Level { globally: everywhere }, groups: validation.clone() });
    if smooth {
        let pulled = |groups| Stage { kind: Kind::PulledLevel, groups };
        stages.extend(levels.iter().map(|level| pulled(fat(level))));
        stages.push(pulled(all.iter().copied().filter(|&group| thin(group)).collect()));
        let colours = colours(&layout.beside);
        for round in 0..SWEEPS {
            stages.extend(colours.iter().enumerate().map(|(place, groups)| Stage {
                kind: Kind::Sweep { round, first: place == 0 },
                groups: groups.clone(),
            }));
        }
        stages.push(pulled(validation));
    }
    stages.retain(|stage| !stage.groups.is_empty());
    stages
}

/// Parts groups so that no two neighbours are in one part.
fn colours(beside: &[Vec<u32>]) -> Vec<Vec<u32>> {
    let mut colour = vec![usize::MAX; beside.len()];
    let mut parts: Vec<Vec<u32>> = Vec::new();
    for (group, near) in beside.iter().enumerate() {
        let taken: Vec<usize> = near.iter().map(|&other| colour[other as usize]).collect();
        let free = (0..).find(|free| !taken.contains(free)).unwrap_or_default();
        colour[group] = free;
        if free == parts.len() {
            parts.push(Vec::new());
        }
        parts[free].push(group as u32);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_never_swept_together() {
        let chain = [vec![1], vec![0, 2], vec![1, 3], vec![2, 0], vec![]];
        let parts = colours(&chain);
        for part in &parts {
            for group in part {
                assert!(
                    !chain[*group as usize].iter().any(|near| part.contains(near)),
                    "{parts:?}"
                );
            }
        }
        assert_eq!(parts.iter().map(Vec::len).sum::<usize>(), 5);
    }
}
