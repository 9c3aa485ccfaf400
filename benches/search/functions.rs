//! Functions that shader programmers approximate, with the published approximations.
//!
//! Each is a closed form in f64 rounded to f32, so its error is half a unit in the last place. The
//! search split is the cell centres of a grid over the domain; the validation split, disjoint from
//! them, has the domain's edges, its points weighted by the area that they stand for.

use lgp::dataset::{Column, Dataset, Origin, Split, grid_weights};
use lgp::microfacet::ggx;
use std::f64::consts::PI;

pub struct Function {
    pub name: &'static str,
    /// The definition and its source.
    pub definition: &'static str,
    pub inputs: &'static [(&'static str, [f64; 2])],
    pub output: &'static str,
    /// Along each input of the search split.
    points: usize,
    /// Cells of the validation split along each input, for each of the search split; odd, so that
    /// no corner of theirs is a centre.
    finer: usize,
    exact: fn(&[f64]) -> f64,
    /// Name, source and formula.
    pub published: &'static [(&'static str, &'static str, &'static str)],
}

pub const FUNCTIONS: &[Function] = &[
    Function {
        name: "fresnel",
        definition: "unpolarised reflectance of an interface with n = 1.5; Fresnel's equations in \
            the form of Cook and Torrance, A Reflectance Model for Computer Graphics, 1982, eq. 18",
        inputs: &[("v_dot_h", [0.0, 1.0])],
        output: "reflectance",
        points: 512,
        finer: 3,
        exact: |x| fresnel(x[0], 1.5),
        published: &[
            (
                "schlick_1994",
                "Schlick, An Inexpensive BRDF Model for Physically-based Rendering, 1994, eq. 15",
                "c = 1 - v_dot_h; reflectance = .04 + .96*c^5",
            ),
            (
                "lagarde_2012",
                "Lagarde, Spherical Gaussian approximation for Blinn-Phong, Phong and Fresnel, 2012; \
                 used by Karis, Real Shading in Unreal Engine 4, 2013",
                "reflectance = .04 + .96*exp2((-5.55473*v_dot_h - 6.98316)*v_dot_h)",
            ),
        ],
    },
    Function {
        name: "acos",
        definition: "arc cosine of the upper half of its domain; the lower half is pi minus it",
        inputs: &[("x", [0.0, 1.0])],
        output: "angle",
        points: 512,
        finer: 3,
        exact: |x| x[0].acos(),
        published: &[
            (
                "lagarde_2014",
                "Lagarde, Inverse trigonometric functions GPU optimization for AMD GCN \
                 architecture, 2014: Eberly's polynomial of degree 1",
                "angle = sqrt(1 - x)*(-.156583*x + 1.5707963)",
            ),
            (
                "eberly_degree_2",
                "Eberly, A Fast Approximation to Inverse Trigonometric Functions; \
                 Geometric Tools, ACosEstimate",
                "angle = sqrt(1 - x)*((.046887774*x - .20347054)*x + 1.5707963)",
            ),
            (
                "abramowitz_stegun_4_4_45",
                "Abramowitz and Stegun, Handbook of Mathematical Functions, 1964, 4.4.45",
                "angle = sqrt(1 - x)*(((-.0187293*x + .0742610)*x - .2121144)*x + 1.5707288)",
            ),
        ],
    },
    Function {
        name: "srgb",
        definition: "sRGB to linear, IEC 61966-2-1: c/12.92 up to .04045, then ((c + .055)/1.055)^2.4",
        inputs: &[("encoded", [0.0, 1.0])],
        output: "linear",
        points: 512,
        finer: 3,
        exact: |x| match x[0] {
            c if c <= 0.04045 => c / 12.92,
            c => ((c + 0.055) / 1.055).powf(2.4),
        },
        published: &[
            (
                "gamma_2_2",
                "the usual approximation; for example Gritz and d'Eon, The Importance of Being \
                 Linear, GPU Gems 3, 2007",
                "linear = pow(encoded, 2.2)",
            ),
            (
                "taylor_2012_power",
                "Taylor (Chilliant), sRGB Approximations for HLSL, 2012",
                "linear = pow(encoded, 2.233333333)",
            ),
            (
                "taylor_2012_cubic",
                "Taylor (Chilliant), sRGB Approximations for HLSL, 2012; Unity's GammaToLinearSpace",
                "linear = encoded*(encoded*(encoded*.305306011 + .682171111) + .012522878)",
            ),
        ],
    },
    Function {
        name: "agx",
        definition: "contrast curve of AgX over normalised log2 exposure: Smith's tunable sigmoid \
            through (20/33, 1/2) with slope 2, toe power 3, shoulder power 3.25; Sobotka, AgX, 2022",
        inputs: &[("exposure", [0.0, 1.0])],
        output: "display",
        points: 512,
        finer: 3,
        exact: |x| agx(x[0]),
        published: &[(
            "wrensch_2023",
            "Wrensch, Minimal AgX Implementation, 2023: of degree 6, fitted to the table of the curve",
            "x = exposure
             display = (((((15.5*x - 40.14)*x + 31.96)*x - 6.868)*x + .4298)*x + .1191)*x - .00232",
        )],
    },
    Function {
        name: "smith",
        definition: "visibility G2/(4 n_dot_l n_dot_v) of GGX with height-correlated masking and \
            shadowing; Heitz, Understanding the Masking-Shadowing Function in Microfacet-Based \
            BRDFs, 2014, eq. 99",
        inputs: &[("n_dot_l", [0.1, 1.0]), ("n_dot_v", [0.1, 1.0]), ("alpha", [0.1, 1.0])],
        output: "visibility",
        points: 16,
        finer: 1,
        exact: |x| ggx::g2_correlated(x[0], x[1], x[2]) / (4.0 * x[0] * x[1]),
        published: &[
            (
                "hammon_2017",
                "Hammon, PBR Diffuse Lighting for GGX+Smith Microsurfaces, GDC 2017; \
                 Filament's V_SmithGGXCorrelatedFast",
                "visibility = .5/lerp(2*n_dot_l*n_dot_v, n_dot_l + n_dot_v, alpha)",
            ),
            (
                "schlick_ggx",
                "Karis, Real Shading in Unreal Engine 4, 2013: Schlick's G1 with k = alpha/2",
                "a = 2 - alpha; visibility = 1/((n_dot_l*a + alpha)*(n_dot_v*a + alpha))",
            ),
        ],
    },
    Function {
        name: "henyey_greenstein",
        definition: "(1 - g^2)/(4 pi (1 + g^2 - 2 g cos_theta)^1.5); Henyey and Greenstein, Diffuse \
            Radiation in the Galaxy, 1941, eq. 2",
        inputs: &[("cos_theta", [-1.0, 1.0]), ("g", [0.0, 0.8])],
        output: "phase",
        points: 64,
        finer: 3,
        exact: |x| {
            let (cos_theta, g) = (x[0], x[1]);
            (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * cos_theta).powf(1.5))
        },
        published: &[(
            "schlick_1993",
            "Blasi, Le Saec and Schlick, A Rendering Algorithm for Discrete Volume Density Objects, \
             1993; k of Pharr and Humphreys, Physically Based Rendering, 2004",
            "k = g*(1.55 - .55*g*g); d = 1 - k*cos_theta; phase = .079577472*(1 - k*k)/(d*d)",
        )],
    },
];

/// Reflectance at a cosine, for light in air on a medium with index `n`.
fn fresnel(cosine: f64, n: f64) -> f64 {
    let g = (n * n - 1.0 + cosine * cosine).sqrt();
    let (sum, difference) = (g + cosine, g - cosine);
    let ratio = (cosine * sum - 1.0) / (cosine * difference + 1.0);
    0.5 * (difference / sum).powi(2) * (1.0 + ratio * ratio)
}

/// On each side of the pivot `y = 1/2 + 2 d (1 + a |d|^p)^(-1/p)`, where `a` makes it end at 0 or 1.
fn agx(x: f64) -> f64 {
    let (pivot, slope) = (20.0 / 33.0, 2.0);
    let offset: f64 = x - pivot;
    let (width, power): (f64, f64) = if offset < 0.0 { (pivot, 3.0) } else { (1.0 - pivot, 3.25) };
    let scale = ((2.0 * slope * width).powf(power) - 1.0) / width.powf(power);
    0.5 + slope * offset * (1.0 + scale * offset.abs().powf(power)).powf(-1.0 / power)
}

impl Function {
    pub fn dataset(&self) -> Dataset {
        let cells = self.points * self.finer;
        let centres: Vec<f64> =
            (0..self.points).map(|i| (i as f64 + 0.5) / self.points as f64).collect();
        let corners: Vec<f64> = (0..=cells).map(|i| i as f64 / cells as f64).collect();
        let [search, mut validation] = [centres, corners].map(|places| self.split(&places));
        let lengths = (0..=cells).map(|i| if i == 0 || i == cells { 0.5 } else { 1.0 }).collect();
        validation.weights = grid_weights(&vec![lengths; self.inputs.len()]);
        let origin = Origin::Formula { text: self.definition.into() };
        let inputs = self.inputs.iter().map(|&(name, domain)| Column::new(name, domain)).collect();
        Dataset::of_splits(self.name, origin, inputs, [(self.output, "1")], [search, validation])
            .expect("finite values under identifiers")
    }

    /// The function at places of [0, 1] along each input.
    fn split(&self, places: &[f64]) -> Split {
        let along = |&(_, [low, high]): &(&str, [f64; 2])| -> Vec<f32> {
            places.iter().map(|place| (low + place * (high - low)) as f32).collect()
        };
        let along: Vec<Vec<f32>> = self.inputs.iter().map(along).collect();
        Split::on_grid(&along, |point| {
            // The ends of a domain need not be numbers of f32.
            let inside =
                point.iter().zip(self.inputs).map(|(x, (_, [low, high]))| x.clamp(*low, *high));
            [(self.exact)(&inside.collect::<Vec<_>>())]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lgp::cost::Profile;

    fn errors(function: &str, formula: &str) -> (f64, f64) {
        let cases = crate::cases(&Profile::find("gcn").unwrap()).unwrap();
        let case = cases.iter().find(|case| case.name == function).unwrap();
        let known = case.published.iter().find(|known| known.name == formula).unwrap();
        let error = known.member.search_error();
        (error.rmse, error.max)
    }

    /// Errors that others state: for Schlick's on n = 1.5, .0163 and .0357 computed apart; for
    /// Abramowitz and Stegun's, |ε| at most 6.7e-5; for Eberly's, 1.1659e-2 relative to
    /// sqrt(1 - x).
    #[test]
    fn published_formulas_err_as_published() {
        let (rmse, max) = errors("fresnel", "schlick_1994");
        assert!((rmse - 0.0163).abs() < 5e-5 && (max - 0.0357).abs() < 5e-5, "{rmse} {max}");
        let (_, max) = errors("acos", "abramowitz_stegun_4_4_45");
        assert!((6e-5..6.7e-5).contains(&max), "{max}");
        let (_, max) = errors("acos", "lagarde_2014");
        assert!((5e-3..1.1659e-2).contains(&max), "{max}");
    }

    #[test]
    fn curves_are_what_their_definitions_say() {
        assert!(
            (fresnel(1.0, 1.5) - 0.04).abs() < 1e-15 && (fresnel(0.0, 1.5) - 1.0).abs() < 1e-15
        );
        // No light of one polarisation is reflected at Brewster's angle: half of ((n² - 1)/(n² + 1))².
        let brewster = 1.0 / (1.0f64 + 1.5 * 1.5).sqrt();
        assert!((fresnel(brewster, 1.5) - 0.5 * (1.25f64 / 3.25).powi(2)).abs() < 1e-15);
        assert!(agx(0.0).abs() < 1e-12 && (agx(1.0) - 1.0).abs() < 1e-12);
        let pivot = 20.0 / 33.0;
        assert!((agx(pivot) - 0.5).abs() < 1e-15);
        assert!(((agx(pivot + 1e-6) - agx(pivot - 1e-6)) / 2e-6 - 2.0).abs() < 1e-6);
    }

    #[test]
    fn splits_are_valid_and_disjoint() {
        for function in FUNCTIONS {
            let data = function.dataset();
            data.validate().unwrap();
            let rows = |split: &Split| -> std::collections::HashSet<Vec<u32>> {
                let row = |r: usize| {
                    split.columns[..function.inputs.len()].iter().map(|c| c[r].to_bits()).collect()
                };
                (0..split.rows()).map(row).collect()
            };
            assert!(rows(&data.search).is_disjoint(&rows(&data.validation)), "{}", function.name);
        }
    }
}
