//! Polar plots of functions of the angle from the normal, as SVG.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write;

pub struct Curve {
    name: &'static str,
    of: Box<dyn Fn(f64) -> f64>,
}

impl Curve {
    pub fn new(name: &'static str, of: impl Fn(f64) -> f64 + 'static) -> Curve {
        Curve { name, of: Box::new(of) }
    }
}

const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 400.0;
const RADIUS: f64 = 300.0;
const STEPS: usize = 720;
const COLOURS: [&str; 6] = ["#1f2328", "#d1242f", "#0969da", "#bf8700", "#1a7f37", "#8250df"];

/// Draws the curves over the upper half plane, 0 upwards, positive angles to the right.
pub fn polar(title: &str, curves: &[Curve]) -> String {
    let angle = |step: usize| FRAC_PI_2 * (2.0 * step as f64 / STEPS as f64 - 1.0);
    let values: Vec<Vec<f64>> = curves
        .iter()
        .map(|curve| (0..=STEPS).map(|step| (curve.of)(angle(step))).collect())
        .collect();
    let most = values.iter().flatten().copied().fold(0.0, f64::max);
    let (x0, y0) = (0.36 * WIDTH, HEIGHT - 30.0);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" \
         font-size=\"14\"><rect width=\"100%\" height=\"100%\" fill=\"white\"/>\
         <text x=\"20\" y=\"28\" font-weight=\"bold\">{title}</text>\
         <path d=\"M10 {y0}H{}M{x0} {y0}V50\" stroke=\"#d0d7de\"/>",
        WIDTH - 10.0
    );
    for (index, (curve, values)) in curves.iter().zip(&values).enumerate() {
        let colour = COLOURS[index % COLOURS.len()];
        let mut path = String::from("M");
        for (step, value) in values.iter().enumerate() {
            let length = RADIUS * value / most;
            let (sin, cos) = angle(step).sin_cos();
            let _ = write!(path, "{:.1} {:.1} ", x0 + length * sin, y0 - length * cos);
        }
        let width = if index == 0 { 3.0 } else { 1.5 };
        let y = 56 + 20 * index;
        let _ = write!(
            svg,
            "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"/>\
             <text x=\"20\" y=\"{y}\" fill=\"{colour}\">{}</text>",
            curve.name
        );
    }
    svg + "</svg>\n"
}
