//! Error against run time of integrators on the DFG's `scale`: `results/quadrature/`.
//!
//! `cargo run --release --example integrators`

use lgp::microfacet::{fresnel, ggx};
use lgp::num::low_discrepancy::hammersley;
use lgp::quadrature::{Adaptive, Rule, TanhSinh, Technique, importance};
use lgp::report::plot::{Line, LinePlot, Theme, lines_png, lines_svg};
use lgp::targets::dfg::{self, Masking};
use std::cell::Cell;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;
use std::time::Instant;

const FOLDER: &str = "results/quadrature";

/// An entry of the table.
#[derive(Clone, Copy)]
struct Entry {
    name: &'static str,
    n_dot_v: f64,
    alpha: f64,
}

const ENTRIES: [Entry; 2] = [
    Entry { name: "easy", n_dot_v: 0.5, alpha: 0.5 * 0.5 },
    Entry { name: "stiff", n_dot_v: 1e-3, alpha: 0.02 * 0.02 },
];

/// A result and what it took.
struct Measured {
    value: f64,
    evaluations: usize,
    seconds: f64,
}

/// The shortest of repetitions, in seconds: what others do on the machine only adds to it.
fn measured(integrate: impl Fn() -> (f64, usize)) -> Measured {
    let (start, mut seconds) = (Instant::now(), f64::INFINITY);
    let mut repeats = 0;
    loop {
        let begin = Instant::now();
        let (value, evaluations) = std::hint::black_box(integrate());
        seconds = seconds.min(begin.elapsed().as_secs_f64());
        repeats += 1;
        if start.elapsed().as_secs_f64() > 0.2 && repeats >= 20 {
            return Measured { value, evaluations, seconds };
        }
    }
}

impl Entry {
    /// The BRDF times (1 - (1 - v·h)⁵) and the light's cosine, for a light at an elevation from the
    /// horizon and φ from the reflected direction's azimuth. By elevations, since 1 - n·h and v·h
    /// would cancel at grazing angles: with s and d half the sum and difference of those of l and v,
    /// (v·h)² = sin²s + cos l cos v sin²(φ/2), and n·h = sin s cos d / v·h.
    fn at_light(self, elevation: f64, phi: f64) -> f64 {
        let view = self.n_dot_v.asin();
        let (s, d) = (0.5 * (elevation + view), 0.5 * (elevation - view));
        let beside = elevation.cos() * view.cos() * (0.5 * phi).sin().powi(2);
        let v_dot_h_squared = s.sin().powi(2) + beside;
        let sin_h_squared = ((s.sin() * d.sin()).powi(2) + beside) / v_dot_h_squared;
        let t = self.alpha * (1.0 - sin_h_squared) + sin_h_squared / self.alpha;
        let g2 = ggx::g2_correlated(self.n_dot_v, elevation.sin(), self.alpha);
        let brdf_cosine = g2 / (PI * t * t * 4.0 * self.n_dot_v);
        brdf_cosine * (1.0 - fresnel::schlick_weight(v_dot_h_squared.sqrt().min(1.0)))
    }

    /// Over elevations in [0, π/2] and half of the azimuths.
    fn over_directions(self, integrate: impl Fn(&dyn Fn([f64; 2]) -> f64) -> f64) -> (f64, usize) {
        let evaluations = Cell::new(0);
        let f = |[elevation, phi]: [f64; 2]| {
            evaluations.set(evaluations.get() + 1);
            2.0 * elevation.cos() * self.at_light(elevation, phi)
        };
        (integrate(&f), evaluations.get())
    }

    fn midpoint(self, cells: usize) -> Measured {
        let rule = Rule::midpoint(cells);
        measured(|| self.over_directions(|f| rule.integrate([0.0; 2], [FRAC_PI_2, PI], f).value))
    }

    fn gauss_kronrod(self, tolerance: f64) -> Measured {
        let rule = Rule::gauss_kronrod(7);
        let adaptive = Adaptive::new(&rule, tolerance).most_evaluations(4_000_000);
        measured(|| self.over_directions(|f| adaptive.global([0.0; 2], [FRAC_PI_2, PI], f).value))
    }

    /// As the target does it: over the normals that the light can have, split where the horizon
    /// begins to cut.
    fn double_exponential(self, rule: &TanhSinh, tolerance: f64) -> Measured {
        let Entry { n_dot_v, alpha, .. } = self;
        measured(|| {
            let dfg = dfg::integrate_within(rule, tolerance, n_dot_v, alpha, Masking::Correlated);
            (dfg.scale, dfg.evaluations)
        })
    }

    /// Normals drawn with density D (n·h), on Hammersley's points.
    fn hammersley(self, count: u64) -> Measured {
        let sin_v = (1.0 - self.n_dot_v * self.n_dot_v).sqrt();
        let sample = |[u, turn]: [f64; 2]| {
            let tangent = self.alpha * (u / (1.0 - u)).sqrt();
            let n_dot_h = 1.0 / (1.0 + tangent * tangent).sqrt();
            (n_dot_h, tangent * n_dot_h, 2.0 * PI * turn)
        };
        let density =
            |&(n_dot_h, _, _): &(f64, f64, f64)| ggx::distribution(n_dot_h, self.alpha) * n_dot_h;
        let f = |&(n_dot_h, sin_h, phi): &(f64, f64, f64)| {
            let v_dot_h = (sin_v * sin_h * phi.cos() + self.n_dot_v * n_dot_h).min(1.0);
            let n_dot_l = 2.0 * v_dot_h * n_dot_h - self.n_dot_v;
            if n_dot_l <= 0.0 || v_dot_h <= 0.0 {
                return 0.0;
            }
            let g2 = ggx::g2_correlated(self.n_dot_v, n_dot_l.min(1.0), self.alpha);
            let brdf_cosine = ggx::distribution(n_dot_h, self.alpha) * g2 * v_dot_h / self.n_dot_v;
            brdf_cosine * (1.0 - fresnel::schlick_weight(v_dot_h))
        };
        let technique = Technique { sample: &sample, density: &density };
        measured(|| {
            let points = (0..count).map(|index| hammersley::<2>(index, count));
            let found = importance(&technique, points, f);
            (found.value, found.evaluations)
        })
    }
}

/// Name and measurements of a method, its effort rising.
type Series = (&'static str, Vec<Measured>);

fn series(entry: Entry) -> Vec<Series> {
    let rule = TanhSinh::new();
    let tolerances = |last: i32| (1..=last).map(|power| 10f64.powi(-power));
    vec![
        ("midpoint", (2..=6).map(|k| entry.midpoint(3usize.pow(k))).collect()),
        ("Gauss–Kronrod, adaptive", tolerances(10).map(|t| entry.gauss_kronrod(t)).collect()),
        (
            "double-exponential",
            tolerances(12).map(|t| entry.double_exponential(&rule, t)).collect(),
        ),
        ("Hammersley, GGX", (4..=18).map(|k| entry.hammersley(1 << k)).collect()),
    ]
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    std::fs::create_dir_all(FOLDER)?;
    let mut csv = String::from("entry,method,evaluations,microseconds,error\n");
    for entry in ENTRIES {
        let rule = TanhSinh::new();
        let truth =
            dfg::integrate_within(&rule, 1e-14, entry.n_dot_v, entry.alpha, Masking::Correlated);
        println!("{}: scale = {:.15}, estimated error {:e}", entry.name, truth.scale, truth.error);
        let series = series(entry);
        let mut lines = Vec::new();
        for (name, measurements) in &series {
            let mut points = Vec::new();
            for Measured { value, evaluations, seconds } in measurements {
                let error = (value - truth.scale).abs();
                let microseconds = seconds * 1e6;
                writeln!(
                    csv,
                    "{},\"{name}\",{evaluations},{microseconds:.2},{error:.2e}",
                    entry.name
                )?;
                // What is left below is the truth's own rounding.
                points.push((microseconds, error.max(1e-15)));
            }
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            lines.push(Line { name: (*name).into(), points, bounds: Vec::new() });
        }
        let title = format!("Error against run time: {} entry of the DFG", entry.name);
        let subtitle = format!(
            "scale at n·v = {}, roughness = {}, alpha = roughness², correlated Smith; one thread",
            entry.n_dot_v,
            entry.alpha.sqrt()
        );
        let plot = LinePlot {
            title: &title,
            subtitle: &subtitle,
            x_label: "microseconds",
            y_label: "absolute error",
            lines: &lines,
            theme: Theme::Light,
        };
        std::fs::write(format!("{FOLDER}/{}.svg", entry.name), lines_svg(&plot)?)?;
        std::fs::write(format!("{FOLDER}/{}.png", entry.name), lines_png(&plot, 1600)?)?;
    }
    std::fs::write(format!("{FOLDER}/integrators.csv"), csv)?;
    Ok(())
}
