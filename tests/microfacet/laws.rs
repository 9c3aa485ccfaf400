use glam::DVec3;
use lgp::microfacet::{beckmann, blinn_phong, diffuse, fresnel, ggx, half_vector, specular};
use lgp::quadrature::{Rule, TanhSinh};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

pub fn direction(cosine: f64, phi: f64) -> DVec3 {
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    DVec3::new(sine * phi.cos(), sine * phi.sin(), cosine)
}

/// `∫ f (n·l) dω` over the upper hemisphere, for a smooth `f` symmetric about the
/// plane of azimuth 0.
fn projected_integral(f: impl Fn(DVec3) -> f64) -> f64 {
    let integrand =
        |[theta, phi]: [f64; 2]| 2.0 * f(direction(theta.cos(), phi)) * theta.sin() * theta.cos();
    Rule::gauss_legendre(96).integrate([0.0; 2], [FRAC_PI_2, PI], integrand).value
}

/// `∫ D (n·h) dω` with the angle's tangent scaled by the width of the lobe.
fn norm(width: f64, distribution: impl Fn(f64) -> f64) -> f64 {
    let rule = TanhSinh::new();
    let integrand = |t: f64| {
        let cosine = 1.0 / (1.0 + (width * t).powi(2)).sqrt();
        TAU * distribution(cosine) * cosine.powi(4) * width * width * t
    };
    let near = rule.integrate(0.0, 1.0, 1e-11, |p| integrand(p.x)).value;
    near + rule.integrate(0.0, 1.0, 1e-11, |p| integrand(1.0 / p.x) / (p.x * p.x)).value
}

#[test]
fn distributions_are_normalised() {
    for alpha in [1e-4, 0.01, 0.2, 0.6, 1.0] {
        let exponent = blinn_phong::exponent(alpha);
        let norms = [
            norm(alpha, |c| ggx::distribution(c, alpha)),
            norm(alpha, |c| beckmann::distribution(c, alpha)),
            norm(alpha, |c| blinn_phong::distribution(c, exponent)),
        ];
        // One ulp of the cosine is 1e-16 of α²/2.
        let allowed = 1e-9 + 1e-15 / (alpha * alpha);
        assert!(norms.iter().all(|norm| (norm - 1.0).abs() < allowed), "{alpha}: {norms:?}");
    }
}

/// `∫ <v·h> D dω`, which G1 must take to n·v (Heitz 2014, eq. 14).
fn facing_area(n_dot_v: f64, distribution: impl Fn(f64) -> f64) -> f64 {
    let rule = TanhSinh::new();
    let sin_v = (1.0 - n_dot_v * n_dot_v).sqrt();
    // The integral over azimuth in closed form.
    let ring = |cos_h: f64| {
        let sin_h = ((1.0 - cos_h) * (1.0 + cos_h)).sqrt();
        let middle = n_dot_v * cos_h;
        let horizon = (-middle / (sin_v * sin_h)).clamp(-1.0, 1.0).acos();
        2.0 * (middle * horizon + sin_v * sin_h * horizon.sin()) * distribution(cos_h)
    };
    // Rings below sin_v are cut by the horizon of v.
    let below = rule.integrate(0.0, sin_v, 1e-11, |p| ring(p.x)).value;
    below + rule.integrate(sin_v, 1.0, 1e-11, |p| ring(p.x)).value
}

#[test]
fn visible_facets_add_up_to_the_projected_area() {
    for alpha in [0.1, 0.5, 1.0] {
        for n_dot_v in [0.05, 0.4, 0.9] {
            let by_ggx = facing_area(n_dot_v, |c| ggx::distribution(c, alpha));
            let visible = ggx::g1(n_dot_v, alpha) * by_ggx;
            assert!((visible - n_dot_v).abs() < 1e-9, "GGX {alpha} {n_dot_v}: {visible}");
            let by_beckmann = facing_area(n_dot_v, |c| beckmann::distribution(c, alpha));
            let visible = beckmann::g1(n_dot_v, alpha) * by_beckmann;
            assert!((visible - n_dot_v).abs() < 1e-9, "Beckmann {alpha} {n_dot_v}: {visible}");
        }
    }
}

fn pairs() -> impl Iterator<Item = (DVec3, DVec3)> {
    let cosines = [0.03, 0.3, 0.7, 0.99];
    let azimuths = [0.0, 0.4, 1.9, PI];
    cosines.into_iter().flat_map(move |l| {
        cosines.into_iter().flat_map(move |v| {
            azimuths.into_iter().map(move |phi| (direction(l, 0.2), direction(v, 0.2 + phi)))
        })
    })
}

#[test]
fn lobes_are_reciprocal() {
    for (l, v) in pairs() {
        let (h, l_dot_v) = (half_vector::of_reflection(l, v), l.dot(v));
        let lobes = |l: DVec3, v: DVec3| {
            let hammon = diffuse::Hammon::new(l.z, v.z, h.z, l_dot_v, 0.6);
            [
                specular::brdf(l, v, 0.3, |c| fresnel::dielectric(1.5, c)),
                specular::brdf(l, v, 0.9, |c| fresnel::conductor(0.2, 3.0, c)),
                diffuse::under_interface(l.z, v.z, 0.04),
                hammon.single,
                hammon.total(0.8),
            ]
        };
        for (there, back) in lobes(l, v).into_iter().zip(lobes(v, l)) {
            assert!((there - back).abs() <= 1e-12 * there, "{l} {v}: {there} {back}");
        }
    }
}

#[test]
fn refraction_is_reciprocal_but_for_the_compression_of_light() {
    for eta in [1.5, 0.75, 2.4] {
        for (l, v) in pairs() {
            let l = DVec3::new(l.x, l.y, -l.z);
            let there = specular::btdf(l, v, 0.5, eta);
            let back = specular::btdf(v, l, 0.5, 1.0 / eta);
            assert!((there - eta * eta * back).abs() <= 1e-11 * there, "{eta}: {there} {back}");
        }
    }
}

#[test]
fn single_scattering_makes_no_light() {
    for alpha in [0.3, 0.6, 1.0] {
        for n_dot_v in [0.1, 0.5, 0.95] {
            let v = direction(n_dot_v, 0.0);
            let albedo = projected_integral(|l| specular::brdf(l, v, alpha, |_| 1.0));
            assert!(albedo < 1.0 && albedo > 0.3, "{alpha} {n_dot_v}: {albedo}");
        }
    }
}

/// `∫ f dω` over the sphere by a fine midpoint rule, for an `f` with an edge.
fn sphere_integral(f: impl Fn(DVec3) -> f64) -> f64 {
    let (rings, azimuths) = (800, 400);
    let mut sum = 0.0;
    for ring in 0..rings {
        let cosine = -1.0 + 2.0 * (f64::from(ring) + 0.5) / f64::from(rings);
        for azimuth in 0..azimuths {
            sum += f(direction(cosine, PI * (f64::from(azimuth) + 0.5) / f64::from(azimuths)));
        }
    }
    sum * 2.0 * TAU / f64::from(rings * azimuths)
}

/// What v's facets reflect if nothing shadows it, per solid angle of l.
fn unshadowed(l: DVec3, v: DVec3, alpha: f64, reflectance: impl Fn(f64) -> f64) -> f64 {
    let h = half_vector::of_reflection(l, v);
    if h.z <= 0.0 {
        return 0.0;
    }
    let lobe = ggx::distribution(h.z.min(1.0), alpha) * ggx::g1(v.z, alpha) / (4.0 * v.z);
    lobe * reflectance(v.dot(h).min(1.0))
}

#[test]
fn without_shadowing_single_scattering_loses_no_light() {
    // The weak white furnace (Heitz 2014, eq. 19).
    for alpha in [0.3, 0.6, 1.0] {
        for n_dot_v in [0.1, 0.5, 0.95] {
            let v = direction(n_dot_v, 0.0);
            let total = sphere_integral(|l| unshadowed(l, v, alpha, |_| 1.0));
            assert!((total - 1.0).abs() < 2e-3, "{alpha} {n_dot_v}: {total}");
        }
    }
    // Between dielectrics the light is reflected or refracted; the BTDF leaves out what
    // steep facets refract to the side that it came from.
    for eta in [1.5, 1.0 / 1.5] {
        for n_dot_v in [0.6, 0.9] {
            let (v, alpha) = (direction(n_dot_v, 0.0), 0.15);
            let total = sphere_integral(|l| {
                let refracted = specular::btdf(l, v, alpha, eta) / ggx::g1(l.z.abs(), alpha);
                unshadowed(l, v, alpha, |c| fresnel::dielectric(eta, c)) + refracted * l.z.abs()
            });
            assert!(total < 1.001 && total > 0.98, "{eta} {n_dot_v}: {total}");
        }
    }
}

#[test]
fn the_interior_sends_back_what_its_interface_transmits() {
    for n_dot_v in [0.05, 0.4, 0.8, 1.0] {
        let v = direction(n_dot_v, 0.0);
        // A white interior sends back what its interface does not reflect.
        let albedo = projected_integral(|l| diffuse::under_interface(l.z, v.z, 0.04));
        let expected = 1.0 - fresnel::schlick(0.04, n_dot_v);
        assert!((albedo - expected).abs() < 1e-12, "{n_dot_v}: {albedo} {expected}");
    }
}

#[test]
fn transmission_is_normalised_exactly() {
    let lobe = projected_integral(|l| fresnel::schlick_transmission(l.z));
    assert!((lobe * 21.0 / (20.0 * PI) - 1.0).abs() < 1e-13, "{lobe}");
    assert!((diffuse::transmission_norm::<f64>() - 21.0 / (20.0 * PI)).abs() < 1e-16);
}
