//! Lines on two logarithmic axes, each named at its right end.

use super::axis::Errors;
use super::canvas::{Anchor, Canvas, Point, Surface};
use super::frame::{Frame, Palette};
use super::text::Face;
use super::{LinePlot, PlotError};

const NAME: Face = Face::regular(12.0);
const LONGEST_NAME: f64 = 150.0;
/// The distances between a line's end and its name, and between two names.
const GAP: f64 = 7.0;
const LEADING: f64 = 15.0;
/// The least distance between ticks of the abscissa.
const TICKS_APART: f64 = 44.0;

pub(super) fn lines<S: Surface>(plot: &LinePlot, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
    let finite = |&(x, y): &Point| x.is_finite() && x > 0.0 && y.is_finite() && y >= 0.0;
    let named: Vec<(String, Vec<Point>, Vec<Vec<Point>>)> = plot
        .lines
        .iter()
        .map(|line| {
            let kept = |points: &[Point]| points.iter().copied().filter(finite).collect();
            let thin = line.bounds.iter().map(|bound| kept(bound)).collect();
            (NAME.fitted(&line.name, LONGEST_NAME), kept(&line.points), thin)
        })
        .collect();
    let all =
        || named.iter().flat_map(|(_, points, thin)| points.iter().chain(thin.iter().flatten()));
    let (abscissae, errors) = (Errors::over(all().map(|p| p.0)), Errors::over(all().map(|p| p.1)));
    let widest = named.iter().map(|(name, _, _)| NAME.width(name)).fold(0.0, f64::max);
    let frame = Frame {
        title: plot.title,
        subtitle: plot.subtitle,
        x_label: plot.x_label,
        y_label: plot.y_label,
        palette: Palette::of(plot.theme),
        axes: Frame::axes(plot.subtitle, &errors, widest + GAP),
    };
    let closest = TICKS_APART / (frame.axes.right - frame.axes.left);
    frame.paper(canvas)?;
    frame.grid(canvas, &abscissae.ticks(closest), &errors)?;
    frame.heading(canvas)?;
    let colours = frame.palette.lines.iter().cycle();
    let at = |&(x, y): &Point| (frame.x(abscissae.place(x)), frame.y(errors.place(y)));
    let mut ends = Vec::new();
    for ((name, points, thin), &colour) in named.iter().zip(colours) {
        for bound in thin.iter().filter(|bound| bound.len() > 1) {
            canvas.line(&bound.iter().map(at).collect::<Vec<_>>(), 0.5, colour)?;
        }
        let points: Vec<Point> = points.iter().map(at).collect();
        if points.len() > 1 {
            canvas.line(&points, 2.0, colour)?;
        }
        ends.extend(points.last().map(|end| (name, colour, end.1)));
    }
    ends.sort_by(|a, b| a.2.total_cmp(&b.2));
    let heights = apart(&ends.iter().map(|end| end.2).collect::<Vec<_>>(), LEADING);
    for ((name, colour, _), y) in ends.iter().zip(heights) {
        canvas.write(name, NAME, *colour, Anchor::Left, (frame.axes.right + GAP, y + 4.0))?;
    }
    Ok(())
}

/// Moves ascending places so that each is at least `leading` below the one before, close to where
/// they were: those that are too near share the move.
fn apart(places: &[f64], leading: f64) -> Vec<f64> {
    // Groups: first place and number; a group that meets the one before joins it.
    let mut groups: Vec<(f64, usize)> = Vec::new();
    for &place in places {
        let mut group = (place, 1);
        while let Some(&(first, count)) = groups.last() {
            if first + count as f64 * leading <= group.0 {
                break;
            }
            groups.pop();
            let middle = |(first, count): (f64, usize)| first + (count - 1) as f64 * leading / 2.0;
            let total = count + group.1;
            let mean = (middle((first, count)) * count as f64 + middle(group) * group.1 as f64)
                / total as f64;
            group = (mean - (total - 1) as f64 * leading / 2.0, total);
        }
        groups.push(group);
    }
    let spread = |(first, count): (f64, usize)| (0..count).map(move |i| first + i as f64 * leading);
    groups.into_iter().flat_map(spread).collect()
}

#[cfg(test)]
mod tests {
    use super::apart;

    #[test]
    fn names_that_are_too_near_move_apart_and_others_stay() {
        assert_eq!(apart(&[10.0, 100.0], 15.0), [10.0, 100.0]);
        assert_eq!(apart(&[50.0, 50.0], 10.0), [45.0, 55.0]);
        let moved = apart(&[10.0, 12.0, 21.0, 90.0], 10.0);
        assert!(moved.windows(2).all(|pair| pair[1] - pair[0] >= 10.0), "{moved:?}");
        assert_eq!(moved[3], 90.0);
    }
}
