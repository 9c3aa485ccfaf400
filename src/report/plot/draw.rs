//! The plot itself: heading, axes, front, incumbents.

use super::axis::{Cycles, Errors};
use super::canvas::{Anchor, Canvas, HEIGHT, Point, Surface, WIDTH};
use super::labels::{Area, Label, Obstacle, place};
use super::text::Face;
use super::{FrontPlot, PlotError, Theme};
use plotters::style::RGBColor;

const MARGIN: f64 = 24.0;
const TITLE: Face = Face::bold(18.0);
const SUBTITLE: Face = Face::regular(12.5);
const NAME: Face = Face::regular(12.0);
const TICK: Face = Face::regular(11.5);

/// Lower edge of the axes.
const FLOOR: f64 = HEIGHT - 56.0;
const DOT: f64 = 4.0;
const DIAMOND: f64 = 6.0;
const OUTLINE: f64 = 1.5;
/// The least distance between ticks of errors.
const TICKS_APART: f64 = 20.0;
const LONGEST_NAME: f64 = 240.0;

struct Palette {
    paper: RGBColor,
    ink: RGBColor,
    faint: RGBColor,
    grid: RGBColor,
    /// Dominated by the front.
    dominated: RGBColor,
    front: RGBColor,
    incumbent: RGBColor,
}

/// Front and incumbents are of the palette of Okabe and Ito.
const LIGHT: Palette = Palette {
    paper: RGBColor(255, 255, 255),
    ink: RGBColor(31, 35, 40),
    faint: RGBColor(89, 99, 110),
    grid: RGBColor(226, 230, 235),
    dominated: RGBColor(243, 248, 252),
    front: RGBColor(0, 114, 178),
    incumbent: RGBColor(213, 94, 0),
};

const DARK: Palette = Palette {
    paper: RGBColor(13, 17, 23),
    ink: RGBColor(230, 237, 243),
    faint: RGBColor(145, 152, 161),
    grid: RGBColor(38, 44, 53),
    dominated: RGBColor(17, 25, 35),
    front: RGBColor(86, 180, 233),
    incumbent: RGBColor(230, 159, 0),
};

/// What is drawn, and where.
struct Layout<'a> {
    plot: &'a FrontPlot<'a>,
    palette: &'static Palette,
    axes: Area,
    cycles: Cycles,
    errors: Errors,
    front: Vec<Point>,
    incumbents: Vec<(String, Point)>,
}

pub(super) fn front<S: Surface>(plot: &FrontPlot, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
    let layout = Layout::of(plot);
    canvas.rectangle((0.0, 0.0), (WIDTH, HEIGHT), layout.palette.paper)?;
    layout.dominated(canvas)?;
    layout.grid(canvas)?;
    layout.heading(canvas)?;
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
        let palette = match plot.theme {
            Theme::Light => &LIGHT,
            Theme::Dark => &DARK,
        };
        let axes = axes(plot, &errors);
        let mut layout =
            Layout { plot, palette, axes, cycles, errors, front: vec![], incumbents: vec![] };
        layout.front = front.into_iter().map(|point| layout.at(point)).collect();
        let placed = incumbents.into_iter().map(|(name, point)| (name, layout.at(point)));
        layout.incumbents = placed.collect();
        layout
    }

    fn at(&self, (cycles, error): Point) -> Point {
        (self.x(self.cycles.place(cycles)), self.y(self.errors.place(error)))
    }

    fn x(&self, place: f64) -> f64 {
        self.axes.left + place * (self.axes.right - self.axes.left)
    }

    fn y(&self, place: f64) -> f64 {
        self.axes.bottom - place * (self.axes.bottom - self.axes.top)
    }

    /// The least error for each budget of cycles, from the first formula to the right edge.
    fn steps(&self) -> Vec<Point> {
        let mut corners = Vec::new();
        for (i, &(x, y)) in self.front.iter().enumerate() {
            corners.push((x, y));
            let next = self.front.get(i + 1).map_or(self.axes.right, |next| next.0);
            corners.push((next, y));
        }
        corners
    }

    fn dominated<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        for step in self.steps().chunks_exact(2) {
            canvas.rectangle((step[0].0, self.axes.top), step[1], self.palette.dominated)?;
        }
        Ok(())
    }

    fn grid<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        let Palette { grid, faint, .. } = *self.palette;
        let Area { left, top, right, bottom } = self.axes;
        for tick in self.cycles.ticks() {
            let x = self.x(tick.place);
            canvas.rectangle((x - 0.5, top), (x + 0.5, bottom), grid)?;
            canvas.write(&tick.text, TICK, faint, Anchor::Middle, (x, bottom + 18.0))?;
        }
        for tick in self.errors.ticks(TICKS_APART / (bottom - top)) {
            let y = self.y(tick.place);
            canvas.rectangle((left, y - 0.5), (right, y + 0.5), grid)?;
            canvas.write(&tick.text, TICK, faint, Anchor::Right, (left - 8.0, y + 4.0))?;
        }
        canvas.rectangle((left, bottom - 0.5), (right, bottom + 0.5), faint)
    }

    fn heading<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        let Palette { ink, faint, .. } = *self.palette;
        let FrontPlot { title, subtitle, x_label, y_label, .. } = *self.plot;
        let width = WIDTH - 2.0 * MARGIN;
        let mut left = |text: &str, face: Face, colour, y| {
            canvas.write(&face.fitted(text, width), face, colour, Anchor::Left, (MARGIN, y))
        };
        left(title, TITLE, ink, 38.0)?;
        left(subtitle, SUBTITLE, faint, 59.0)?;
        left(&TICK.fitted(y_label, width / 2.0), TICK, faint, self.axes.top - 14.0)?;
        let x_label = TICK.fitted(x_label, width / 2.0);
        let below = (self.axes.right, FLOOR + 39.0);
        canvas.write(&x_label, TICK, faint, Anchor::Right, below)
    }

    /// What the two kinds of marker are. A front alone needs no key.
    fn key<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        if self.front.is_empty() || self.incumbents.is_empty() {
            return Ok(());
        }
        let Palette { faint, front, incumbent, .. } = *self.palette;
        let baseline = self.axes.top - 14.0;
        let (published, found) = ("published formulas", "Pareto front");
        let mut x = self.axes.right - TICK.width(published);
        canvas.write(published, TICK, faint, Anchor::Left, (x, baseline))?;
        x -= 12.0;
        canvas.diamond((x, baseline - 4.0), 5.5, incumbent)?;
        x -= 22.0 + TICK.width(found);
        canvas.write(found, TICK, faint, Anchor::Left, (x, baseline))?;
        x -= 16.0;
        canvas.line(&[(x - 9.0, baseline - 4.0), (x + 9.0, baseline - 4.0)], 2.0, front)?;
        canvas.disc((x, baseline - 4.0), DOT, front)
    }

    /// Incumbents that have no place on the axes.
    fn footer<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        let infinite = |cycles: f64, error: f64| !(cycles.is_finite() && error.is_finite());
        let left_out = self.plot.incumbents.iter().filter(|i| infinite(i.1, i.2));
        let names: Vec<&str> = left_out.map(|i| i.0.as_str()).collect();
        if names.is_empty() {
            return Ok(());
        }
        let text = format!("not finite: {}", names.join(", "));
        let text = TICK.fitted(&text, WIDTH / 2.0);
        canvas.write(&text, TICK, self.palette.faint, Anchor::Left, (MARGIN, FLOOR + 39.0))
    }

    fn front<S: Surface>(&self, canvas: &mut Canvas<S>) -> Result<(), PlotError> {
        if self.front.is_empty() {
            let middle = (self.x(0.5), self.y(0.5));
            let nothing = if self.incumbents.is_empty() { "no formulas" } else { "" };
            return canvas.write(nothing, SUBTITLE, self.palette.faint, Anchor::Middle, middle);
        }
        canvas.line(&self.steps(), 2.0, self.palette.front)?;
        for dot in &self.front {
            canvas.disc(*dot, DOT + OUTLINE, self.palette.paper)?;
            canvas.disc(*dot, DOT, self.palette.front)?;
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
        let areas = place(&labels, &self.obstacles(), &self.axes);
        for ((_, marker), area) in self.incumbents.iter().zip(&areas) {
            self.leader(canvas, *marker, area)?;
        }
        for (_, marker) in &self.incumbents {
            canvas.diamond(*marker, DIAMOND + OUTLINE, self.palette.paper)?;
            canvas.diamond(*marker, DIAMOND, self.palette.incumbent)?;
        }
        for ((name, _), area) in self.incumbents.iter().zip(&areas) {
            let baseline = (area.left + 2.0, area.bottom - 4.0);
            canvas.write(name, NAME, self.palette.ink, Anchor::Left, baseline)?;
        }
        Ok(())
    }

    /// From a marker to a name that is not right beside it.
    fn leader<S: Surface>(
        &self,
        canvas: &mut Canvas<S>,
        marker: Point,
        area: &Area,
    ) -> Result<(), PlotError> {
        if area.distance(marker) < 15.0 {
            return Ok(());
        }
        canvas.line(&[marker, area.nearest(marker)], 1.0, self.palette.incumbent)
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

/// As wide as the ticks of errors leave, as high as the heading does.
fn axes(plot: &FrontPlot, errors: &Errors) -> Area {
    let top = if plot.subtitle.is_empty() { 82.0 } else { 104.0 };
    let ticks = errors.ticks(TICKS_APART / (FLOOR - top));
    let widest = ticks.iter().map(|tick| TICK.width(&tick.text)).fold(0.0, f64::max);
    let right = WIDTH - MARGIN - 4.0;
    Area { left: (MARGIN + widest + 8.0).round(), top, right, bottom: FLOOR }
}
