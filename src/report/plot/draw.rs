//! The plot itself: heading, axes, front, incumbents.

use super::axis::{Cycles, Errors};
use super::canvas::{Anchor, Canvas, Point, Surface, WIDTH};
use super::frame::{FLOOR, Frame, MARGIN, Palette, SUBTITLE, TICK};
use super::labels::{Area, Label, Obstacle, place};
use super::text::Face;
use super::{FrontPlot, PlotError};

const NAME: Face = Face::regular(12.0);
const DOT: f64 = 4.0;
const DIAMOND: f64 = 6.0;
const OUTLINE: f64 = 1.5;
const LONGEST_NAME: f64 = 240.0;

/// The plot, and the places of its parts.
struct Layout<'a> {
    plot: &'a FrontPlot<'a>,
    frame: Frame<'a>,
    cycles: Cycles,
    errors: Errors,
    front: Vec<Point>,
    incumbents: Vec<(String, Point)>,
}

pub(super) fn front<S: Surface>(plot: &FrontPlot, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
    let layout = Layout::of(plot);
    layout.frame.paper(canvas)?;
    layout.dominated(canvas)?;
    layout.frame.grid(canvas, &layout.cycles.ticks(), &layout.errors)?;
    layout.frame.heading(canvas)?;
    layout.key(canvas)?;
    layout.footer(canvas)?;
    layout.front(canvas)?;
    layout.incumbents(canvas)
}

impl<'a> Layout<'a> {
    fn of(plot: &'a FrontPlot<'a>) -> Layout<'a> {
        let finite = |cycles: f64, error: f64| cycles.is_finite() && error.is_finite();
        let front: Vec<Point> = plot.front.iter().copied().filter(|p| finite(p.0, p.1)).collect();
        let shown = plot.incumbents.iter().filter(|(_, cycles, error)| finite(*cycles, *error));
        let incumbents: Vec<(String, Point)> = shown
            .map(|(name, cycles, error)| (NAME.fitted(name, LONGEST_NAME), (*cycles, *error)))
            .collect();
        let all = || front.iter().chain(incumbents.iter().map(|(_, point)| point));
        let cycles = Cycles::over(all().map(|point| point.0));
        let errors = Errors::over(all().map(|point| point.1));
        let frame = Frame {
            title: plot.title,
            subtitle: plot.subtitle,
            x_label: plot.x_label,
            y_label: plot.y_label,
            palette: Palette::of(plot.theme),
            axes: Frame::axes(plot.subtitle, &errors, 0.0),
        };
        let mut layout = Layout { plot, frame, cycles, errors, front: vec![], incumbents: vec![] };
        layout.front = front.into_iter().map(|point| layout.at(point)).collect();
        let placed = incumbents.into_iter().map(|(name, point)| (name, layout.at(point)));
        layout.incumbents = placed.collect();
        layout
    }

    fn at(&self, (cycles, error): Point) -> Point {
        (self.frame.x(self.cycles.place(cycles)), self.frame.y(self.errors.place(error)))
    }

    /// Returns the least error for each budget of cycles, from the first formula to the right edge.
    fn steps(&self) -> Vec<Point> {
        let mut corners = Vec::new();
        for (i, &(x, y)) in self.front.iter().enumerate() {
            corners.push((x, y));
            let next = self.front.get(i + 1).map_or(self.frame.axes.right, |next| next.0);
            corners.push((next, y));
        }
        corners
    }

    fn dominated<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        for step in self.steps().chunks_exact(2) {
            canvas.rectangle(
                (step[0].0, self.frame.axes.top),
                step[1],
                self.frame.palette.dominated,
            )?;
        }
        Ok(())
    }

    /// Draws the key of the two kinds of marker. A front alone needs none.
    fn key<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        if self.front.is_empty() || self.incumbents.is_empty() {
            return Ok(());
        }
        let Palette { faint, front, incumbent, .. } = *self.frame.palette;
        let baseline = self.frame.axes.top - 14.0;
        let (published, found) = ("published formulas", "Pareto front");
        let mut x = self.frame.axes.right - TICK.width(published);
        canvas.write(published, TICK, faint, Anchor::Left, (x, baseline))?;
        x -= 12.0;
        canvas.diamond((x, baseline - 4.0), 5.5, incumbent)?;
        x -= 22.0 + TICK.width(found);
        canvas.write(found, TICK, faint, Anchor::Left, (x, baseline))?;
        x -= 16.0;
        canvas.line(&[(x - 9.0, baseline - 4.0), (x + 9.0, baseline - 4.0)], 2.0, front)?;
        canvas.disc((x, baseline - 4.0), DOT, front)
    }

    /// Names the incumbents that have no place on the axes.
    fn footer<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        let infinite = |cycles: f64, error: f64| !(cycles.is_finite() && error.is_finite());
        let left_out = self.plot.incumbents.iter().filter(|i| infinite(i.1, i.2));
        let names: Vec<&str> = left_out.map(|i| i.0.as_str()).collect();
        if names.is_empty() {
            return Ok(());
        }
        let text = format!("not finite: {}", names.join(", "));
        let text = TICK.fitted(&text, WIDTH / 2.0);
        canvas.write(&text, TICK, self.frame.palette.faint, Anchor::Left, (MARGIN, FLOOR + 39.0))
    }

    fn front<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        if self.front.is_empty() {
            let middle = (self.frame.x(0.5), self.frame.y(0.5));
            let nothing = if self.incumbents.is_empty() { "no formulas" } else { "" };
            return canvas.write(
                nothing,
                SUBTITLE,
                self.frame.palette.faint,
                Anchor::Middle,
                middle,
            );
        }
        canvas.line(&self.steps(), 2.0, self.frame.palette.front)?;
        for dot in &self.front {
            canvas.disc(*dot, DOT + OUTLINE, self.frame.palette.paper)?;
            canvas.disc(*dot, DOT, self.frame.palette.front)?;
        }
        Ok(())
    }

    fn incumbents<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        let label = |(name, marker): &(String, Point)| Label {
            marker: *marker,
            width: NAME.width(name) + 4.0,
            height: NAME.size + 3.0,
        };
        let labels: Vec<Label> = self.incumbents.iter().map(label).collect();
        let areas = place(&labels, &self.obstacles(), &self.frame.axes);
        for ((_, marker), area) in self.incumbents.iter().zip(&areas) {
            self.leader(canvas, *marker, area)?;
        }
        for (_, marker) in &self.incumbents {
            canvas.diamond(*marker, DIAMOND + OUTLINE, self.frame.palette.paper)?;
            canvas.diamond(*marker, DIAMOND, self.frame.palette.incumbent)?;
        }
        for ((name, _), area) in self.incumbents.iter().zip(&areas) {
            let baseline = (area.left + 2.0, area.bottom - 4.0);
            canvas.write(name, NAME, self.frame.palette.ink, Anchor::Left, baseline)?;
        }
        Ok(())
    }

    /// Draws a line from a marker to a name that is not right beside it.
    fn leader<S: Surface>(
        &self,
        canvas: &mut Canvas<S>,
        marker: Point,
        area: &Area,
    ) -> Result<(), PlotError> {
        if area.distance(marker) < 15.0 {
            return Ok(());
        }
        canvas.line(&[marker, area.nearest(marker)], 1.0, self.frame.palette.incumbent)
    }

    fn obstacles(&self) -> Vec<Obstacle> {
        let line = |ends: &[Point]| Area::along(ends[0], ends[1], 2.0);
        let steps = self.steps();
        let lines = steps.windows(2).map(|ends| Obstacle { area: line(ends), weight: 2.0 });
        let dot = |centre: &Point| Area::around(*centre, DOT + 2.0);
        let dots = self.front.iter().map(|d| Obstacle { area: dot(d), weight: 3.0 });
        let diamond = |centre: &Point| Area::around(*centre, DIAMOND + 1.0);
        let diamonds =
            self.incumbents.iter().map(|i| Obstacle { area: diamond(&i.1), weight: 10.0 });
        lines.chain(dots).chain(diamonds).collect()
    }
}
