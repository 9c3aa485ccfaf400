//! Placement of markers' names: beside them, over nothing, inside the plot.

use super::canvas::Point;

/// The distance between a marker's centre and its label.
const GAP: f64 = 9.0;
const SHIFTS: [f64; 7] = [0.0, 9.0, 18.0, 30.0, 44.0, 60.0, 80.0];
const ROUNDS: usize = 4;

/// The penalties of a label that is nearer to another's marker, and of a leader that crosses a
/// label. By hand, unmeasured.
const AMBIGUOUS: f64 = 25.0;
const CROSSED: f64 = 60.0;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Area {
    pub(super) fn around((x, y): Point, radius: f64) -> Area {
        Area { left: x - radius, top: y - radius, right: x + radius, bottom: y + radius }
    }

    /// Returns what a line between two points covers, along an axis.
    pub(super) fn along(from: Point, to: Point, radius: f64) -> Area {
        let (from, to) = (Area::around(from, radius), Area::around(to, radius));
        Area {
            left: from.left.min(to.left),
            top: from.top.min(to.top),
            right: from.right.max(to.right),
            bottom: from.bottom.max(to.bottom),
        }
    }

    fn overlap(&self, other: &Area) -> f64 {
        let width = self.right.min(other.right) - self.left.max(other.left);
        let height = self.bottom.min(other.bottom) - self.top.max(other.top);
        width.max(0.0) * height.max(0.0)
    }

    fn width(&self) -> f64 {
        self.right - self.left
    }

    fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// Returns the point of the area nearest to another.
    pub(super) fn nearest(&self, (x, y): Point) -> Point {
        (x.max(self.left).min(self.right), y.max(self.top).min(self.bottom))
    }

    pub(super) fn distance(&self, to: Point) -> f64 {
        let (x, y) = self.nearest(to);
        (x - to.0).hypot(y - to.1)
    }

    /// Moves the area inside another, as far as it fits.
    fn inside(&self, bounds: &Area) -> Area {
        let left = self.left.min(bounds.right - self.width()).max(bounds.left);
        let top = self.top.min(bounds.bottom - self.height()).max(bounds.top);
        Area { left, top, right: left + self.width(), bottom: top + self.height() }
    }
}

/// An area to keep free, and the penalty of writing over it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Obstacle {
    pub area: Area,
    pub weight: f64,
}

/// A marker and the size of its label.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Label {
    pub marker: Point,
    pub width: f64,
    pub height: f64,
}

/// Returns an area for each label: the best of three placements, which go through the labels from
/// the left, from the top and from the bottom.
pub(super) fn place(labels: &[Label], obstacles: &[Obstacle], bounds: &Area) -> Vec<Area> {
    let crowd = Crowd { labels, obstacles, bounds };
    let ordered = |key: fn(&Label) -> f64| {
        let mut order: Vec<usize> = (0..labels.len()).collect();
        order.sort_by(|a, b| key(&labels[*a]).total_cmp(&key(&labels[*b])));
        crowd.settled(&order)
    };
    let tries = [ordered(|l| l.marker.0), ordered(|l| l.marker.1), ordered(|l| -l.marker.1)];
    let total = |areas: &Vec<Area>| crowd.total(areas);
    tries.into_iter().min_by(|a, b| total(a).total_cmp(&total(b))).unwrap_or_default()
}

struct Crowd<'a> {
    labels: &'a [Label],
    obstacles: &'a [Obstacle],
    bounds: &'a Area,
}

impl Crowd<'_> {
    /// Gives each label in turn the best place that the others leave, several times over.
    fn settled(&self, order: &[usize]) -> Vec<Area> {
        let mut placed: Vec<Option<Area>> = vec![None; self.labels.len()];
        for i in (0..ROUNDS).flat_map(|_| order.iter().copied()) {
            let rank = |(place, area)| (self.cost(i, &area, &placed) + 0.1 * place as f64, area);
            let places = candidates(&self.labels[i], self.bounds).into_iter().enumerate();
            let best = places.map(rank).min_by(|a, b| a.0.total_cmp(&b.0));
            placed[i] = best.map(|(_, area)| area);
        }
        placed.into_iter().flatten().collect()
    }

    fn total(&self, areas: &[Area]) -> f64 {
        let placed: Vec<Option<Area>> = areas.iter().copied().map(Some).collect();
        areas.iter().enumerate().map(|(i, area)| self.cost(i, area, &placed)).sum()
    }

    /// Returns the penalty of an area for a label, given the places of the others.
    fn cost(&self, i: usize, area: &Area, placed: &[Option<Area>]) -> f64 {
        let own = area.distance(self.labels[i].marker);
        let over = |o: &Obstacle| o.weight * area.overlap(&o.area);
        let others = self.labels.iter().zip(placed).enumerate().filter(|(j, _)| *j != i);
        let beside = |(_, (other, at)): (usize, (&Label, &Option<Area>))| {
            let nearer = area.distance(other.marker) + 1.0 < own;
            (if nearer { AMBIGUOUS } else { 0.0 })
                + at.map_or(0.0, |at| against(&self.labels[i], area, other, &at))
        };
        self.obstacles.iter().map(over).sum::<f64>()
            + others.map(beside).sum::<f64>()
            + 1.5 * (own - GAP).max(0.0)
    }
}

/// Returns the penalty of one label over another, or over its leader.
fn against(label: &Label, area: &Area, other: &Label, at: &Area) -> f64 {
    let over = |from: &Label, way: &Area, met: &Area| {
        if crosses(from.marker, way.nearest(from.marker), met) { CROSSED } else { 0.0 }
    };
    20.0 * area.overlap(at) + over(label, area, at) + over(other, at, area)
}

/// Returns true if the leader from a marker to its label crosses another label.
fn crosses(from: Point, to: Point, other: &Area) -> bool {
    (1..=16).any(|i| {
        let part = f64::from(i) / 17.0;
        let on = (from.0 + part * (to.0 - from.0), from.1 + part * (to.1 - from.1));
        other.nearest(on) == on
    })
}

/// Returns the places right, left, above and below, then the same ever further away.
fn candidates(label: &Label, bounds: &Area) -> Vec<Area> {
    let (x, y) = label.marker;
    let (width, height) = (label.width, label.height);
    let at = |left: f64, top: f64| Area { left, top, right: left + width, bottom: top + height };
    let mut areas = Vec::new();
    for shift in SHIFTS {
        let (right, left) = (x + GAP, x - GAP - width);
        let (above, below) = (y - GAP - height - shift, y + GAP + shift);
        let sides = if shift == 0.0 { &[0.0][..] } else { &[-shift, shift][..] };
        for side in sides {
            let level = y - height / 2.0 + side;
            areas.extend([at(right, level), at(left, level)]);
        }
        for left in [x - width / 2.0, x - GAP, x + GAP - width] {
            areas.extend([at(left, above), at(left, below)]);
        }
    }
    areas.iter().map(|area| area.inside(bounds)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Area = Area { left: 0.0, top: 0.0, right: 700.0, bottom: 300.0 };

    #[test]
    fn labels_of_crowded_markers_do_not_overlap() {
        let marker = |i: usize| (640.0 + 7.0 * (i % 3) as f64, 20.0 + 6.0 * i as f64);
        let label = |i| Label { marker: marker(i), width: 120.0, height: 14.0 };
        let labels: Vec<Label> = (0..8).map(label).collect();
        let obstacle = |l: &Label| Obstacle { area: Area::around(l.marker, 6.0), weight: 4.0 };
        let obstacles: Vec<Obstacle> = labels.iter().map(obstacle).collect();
        let placed = place(&labels, &obstacles, &BOUNDS);
        assert_eq!(placed.len(), labels.len());
        for (i, area) in placed.iter().enumerate() {
            assert_eq!(*area, area.inside(&BOUNDS));
            for other in &placed[..i] {
                assert_eq!(area.overlap(other), 0.0, "{area:?} and {other:?}");
            }
        }
    }

    #[test]
    fn a_lone_label_is_to_the_right_or_else_to_the_left() {
        let alone =
            |x| place(&[Label { marker: (x, 90.0), width: 80.0, height: 14.0 }], &[], &BOUNDS);
        assert!(alone(100.0)[0].left > 100.0);
        let own = Obstacle { area: Area::around((695.0, 90.0), 6.0), weight: 4.0 };
        let label = Label { marker: (695.0, 90.0), width: 80.0, height: 14.0 };
        assert!(place(&[label], &[own], &BOUNDS)[0].right < 695.0);
    }
}
