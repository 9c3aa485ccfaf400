//! The light on a sphere, and the meaning of a dataset's columns there, as formula text.
//!
//! The environments are analytic, and blurred by roughness in closed form. That is no exact
//! convolution, but the same for the truth and for a formula, which are compared.

use crate::dataset::Column;
use crate::program::{Names, Program, parse};
use std::fmt;
use std::str::FromStr;

/// The surroundings of the sphere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Environment {
    /// Radiance 1 from everywhere: the directional albedo itself.
    Uniform,
    /// A blue sky, its horizon, dark ground, and the sun.
    #[default]
    Sky,
    /// Softboxes in a dark room.
    Studio,
}

impl Environment {
    /// All environments.
    pub const ALL: [Environment; 3] = [Environment::Uniform, Environment::Sky, Environment::Studio];

    fn text(self) -> &'static str {
        match self {
            Environment::Uniform => UNIFORM,
            Environment::Sky => SKY,
            Environment::Studio => STUDIO,
        }
    }
}

impl fmt::Display for Environment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Environment::Uniform => "uniform",
            Environment::Sky => "sky",
            Environment::Studio => "studio",
        })
    }
}

impl FromStr for Environment {
    type Err = String;

    fn from_str(text: &str) -> Result<Environment, String> {
        let found = Environment::ALL.into_iter().find(|known| known.to_string() == text);
        found.ok_or_else(|| "an environment is one of uniform, sky, studio".to_owned())
    }
}

/// The normal, and the settings.
const PIXEL: [&str; 7] = [
    "normal_x",
    "normal_y",
    "normal_z",
    "turned_roughness",
    "turned_f0",
    "turned_omega",
    "turned_exposure",
];

/// The columns known at a pixel; a point light stands to the upper left, before the sphere. The
/// normal's own reflection of v is (2xz, 2yz, 2z² − 1).
const GIVEN: &str = "
    at_n_dot_v = max(normal_z, .001)
    at_v_dot_h = at_n_dot_v
    at_roughness = turned_roughness
    at_alpha = max(turned_roughness^2, .001)
    at_f0 = turned_f0
    at_omega = turned_omega
    at_n_dot_l = saturate(-.5*normal_x + .55*normal_y + .669*normal_z)
    at_n_dot_h = saturate(-.2736*normal_x + .301*normal_y + .9135*normal_z)
    at_l_dot_v = .669
    toward = -.5*(2*normal_x*normal_z) + .55*(2*normal_y*normal_z) + .669*(2*normal_z^2 - 1)
    at_theta = acos(min(max(toward, 0), 1))
";

const UNIFORM: &str = "
    env_red = 1; env_green = 1; env_blue = 1";

/// The sky; the sun is a spherical Gaussian, its sharpness that of the lobe and the disc together.
const SKY: &str = "
    blur = .03 + .9*width
    t = saturate(.5 + .5*ry/blur)
    s = t*t*(3 - 2*t)
    k = sqrt(saturate(ry) + .02)
    sharp = 2/(width*width + .002)
    glow = .15*sharp*exp2(1.442695*sharp*(.5*rx + .6*ry + .6245*rz - 1))
    env_red = lerp(.16, lerp(.95, .16, k), s) + glow
    env_green = lerp(.14, lerp(.97, .34, k), s) + .93*glow
    env_blue = lerp(.12, lerp(1, .85, k), s) + .8*glow";

/// The studio: a large softbox to the left, a narrow one to the right, a strip above, with edges as
/// soft as the lobe is wide.
const STUDIO: &str = "
    blur = .04 + 1.1*width
    key = -.62*rx + .48*ry + .62*rz
    key_u = (.62*rx + .784*rz - .15*key)/max(key, .08)
    key_v = (.34*rx + .877*ry - .27*rz)/max(key, .08)
    key_box = saturate((.5 - abs(key_u))/blur + .5)*saturate((.6 - abs(key_v))/blur + .5)*saturate(8*key)
    rim = .88*rx + .1*ry + .46*rz
    rim_u = (-.46*rx + .88*rz)/max(rim, .08)
    rim_v = ry/max(rim, .08)
    rim_box = saturate((.16 - abs(rim_u))/blur + .5)*saturate((.9 - abs(rim_v))/blur + .5)*saturate(8*rim)
    strip_u = rx/max(ry, .08)
    strip_v = (rz + .35)/max(ry, .08)
    strip = saturate((.9 - abs(strip_u))/blur + .5)*saturate((.1 - abs(strip_v))/blur + .5)*saturate(8*ry)
    far = 1/(1 + 2*width)
    env_red = .05 + far*(3.2*key_box + 1.1*rim_box + 2*strip)
    env_green = .055 + far*(3*key_box + 1.4*rim_box + 2*strip)
    env_blue = .065 + far*(2.7*key_box + 1.9*rim_box + 2*strip)";

const REFLECTED: &str = "
    width = turned_roughness^2
    rx = 2*normal_x*normal_z
    ry = 2*normal_y*normal_z
    rz = 2*normal_z^2 - 1";

/// Directional albedo, that of the split sum, times the reflected light.
const ALBEDO: &str = "
    linear_red = env_red*albedo; linear_green = env_green*albedo; linear_blue = env_blue*albedo";

/// The warm light of a lamp.
const LAMP: &str = "
    linear_red = lit; linear_green = .94*lit; linear_blue = .82*lit";

/// The displayed colour: exposed, clipped, and encoded as sRGB (IEC 61966-2-1).
const DISPLAYED: &str = "
    gain = exp2(turned_exposure)
    r = saturate(gain*linear_red)
    g = saturate(gain*linear_green)
    b = saturate(gain*linear_blue)
    red = saturate(select(r < .0031308, 12.92*r, 1.055*pow(max(r, .00001), .41666667) - .055))
    green = saturate(select(g < .0031308, 12.92*g, 1.055*pow(max(g, .00001), .41666667) - .055))
    blue = saturate(select(b < .0031308, 12.92*b, 1.055*pow(max(b, .00001), .41666667) - .055))";

/// Outputs, true if the environment lights them, and the light made of them.
const SCENES: [(&[&str], bool, &str); 9] = [
    (&["scale", "bias"], true, "albedo = turned_f0*scale + bias"),
    (&["scale"], true, "albedo = turned_f0*scale"),
    (&["bias"], true, "albedo = bias"),
    (&["reflectance"], true, "albedo = reflectance"),
    // An albedo of .6 in uniform light, of which band 0 sends back √(4π) zh0.
    (&["zh0"], false, "lit = .6*3.5449077*zh0"),
    (&["lobe"], false, "lit = lobe*saturate(4*(-.5*normal_x + .55*normal_y + .669*normal_z))"),
    // The lobe of Karis' representative point, smoothed as the dataset is, times its normalisation.
    (
        &["norm"],
        false,
        "toward = -.5*(2*normal_x*normal_z) + .55*(2*normal_y*normal_z) + .669*(2*normal_z^2 - 1)
         theta = acos(min(max(toward, 0), 1))
         q = max(tan(.5*turned_omega)/max(sin(theta), .0001), .0001)
         f = pow(1 + 1/(q*q*q), -.33333333)
         nearer = .5*atan2(sin(theta)*(1 - f), cos(theta))
         a2 = max(turned_roughness^4, .000001)
         d = cos(nearer)^2 + sin(nearer)^2/a2
         lit = norm/(d*d)*saturate(4*(-.5*normal_x + .55*normal_y + .669*normal_z))",
    ),
    (
        &["g2"],
        false,
        "nh = saturate(-.2736*normal_x + .301*normal_y + .9135*normal_z)
         a2 = max(turned_roughness^4, .000001)
         d = nh^2*(a2 - 1) + 1
         lit = turned_f0*6*a2/(3.1415927*d*d)*g2/(4*max(normal_z, .001))",
    ),
    (
        &["g1"],
        false,
        "nh = saturate(-.2736*normal_x + .301*normal_y + .9135*normal_z)
         a2 = max(turned_roughness^4, .000001)
         d = nh^2*(a2 - 1) + 1
         lit = turned_f0*6*a2/(3.1415927*d*d)*g1*saturate(-.5*normal_x + .55*normal_y + .669*normal_z)/(4*max(normal_z, .001))",
    ),
];

/// Returns the program from a pixel to columns, each within its domain.
pub(super) fn given(inputs: &[Column]) -> Option<(Program, Names)> {
    let names = Names::new(PIXEL, inputs.iter().map(|input| input.name.as_str()));
    let clamped = inputs.iter().map(|Column { name, domain: [low, high], .. }| {
        format!("{name} = min(max(at_{name}, {low}), {high})\n")
    });
    let text = GIVEN.to_owned() + &clamped.collect::<String>();
    Some((parse(&text, &names).ok()?, names))
}

pub(super) fn has_environment(outputs: &[String]) -> bool {
    SCENES.iter().any(|(known, environment, _)| *environment && outputs == *known)
}

/// Returns the program from a pixel and outputs to the displayed colour.
pub(super) fn light(outputs: &[String], environment: Environment) -> Option<(Program, Names)> {
    let (_, lit_by_it, made) = SCENES.iter().find(|(known, _, _)| outputs == *known)?;
    let parts = match lit_by_it {
        true => [REFLECTED, environment.text(), "\n", made, ALBEDO, DISPLAYED].concat(),
        false => [made, LAMP, DISPLAYED].concat(),
    };
    let inputs = PIXEL.into_iter().chain(outputs.iter().map(String::as_str));
    let names = Names::new(inputs, ["red", "green", "blue"]);
    Some((parse(&parts, &names).ok()?, names))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_material_is_a_program_in_every_environment() {
        for (outputs, _, _) in SCENES {
            let outputs: Vec<String> = outputs.iter().map(|&output| output.to_owned()).collect();
            for environment in Environment::ALL {
                assert!(light(&outputs, environment).is_some(), "{outputs:?} in {environment}");
            }
        }
    }

    #[test]
    fn environments_are_read_as_they_are_written() {
        for environment in Environment::ALL {
            assert_eq!(environment.to_string().parse(), Ok(environment));
        }
        assert!("cave".parse::<Environment>().is_err());
    }
}
