//! Costs against figures published by others.

use lgp::cost::{CostScratch, Profile};
use lgp::program::parse_open;

fn cycles(text: &str, outputs: &[&str]) -> f64 {
    let outputs: Vec<String> = outputs.iter().map(|&s| s.to_owned()).collect();
    let parsed = parse_open(text, &outputs).unwrap();
    Profile::find("gcn").unwrap().cycles(&parsed.program, &mut CostScratch::default())
}

/// Earl Hammon, "PBR Diffuse Lighting for GGX+Smith Microsurfaces", GDC 2017: GCN cycles.
#[test]
fn hammons_figures() {
    let half = "hx = lx + vx; hy = ly + vy; hz = lz + vz;
                s = rsqrt(hx*hx + hy*hy + hz*hz); nx_ = hx*s; ny_ = hy*s; nz_ = hz*s;";
    let n_dot_h = "n_dot_h = nx*nx_ + ny*ny_ + nz*nz_;";
    let l_dot_h = "l_dot_h = lx*nx_ + ly*ny_ + lz*nz_;";
    assert_eq!(cycles(half, &["nx_", "ny_", "nz_"]), 13.0);
    assert_eq!(cycles(&format!("{half}{n_dot_h}"), &["n_dot_h"]), 16.0);
    assert_eq!(cycles(&format!("{half}{n_dot_h}{l_dot_h}"), &["n_dot_h", "l_dot_h"]), 19.0);
    let identities = "s = rsqrt(2*l_dot_v + 2); n_dot_h = (n_dot_l + n_dot_v)*s;";
    assert_eq!(cycles(identities, &["n_dot_h"]), 7.0);
    let both = format!("{identities} l_dot_h = l_dot_v*s + s");
    assert_eq!(cycles(&both, &["n_dot_h", "l_dot_h"]), 8.0);
    assert_eq!(cycles("g1 = (nl*(2-a)+a)*(nv*(2-a)+a)", &[]), 4.0);
    assert_eq!(cycles("g2 = 2*lerp(2*nl*nv, nl+nv, a)", &[]), 6.0);
}

#[test]
fn sharing_fusion_and_modifiers() {
    for (text, expected) in [
        ("y = a*b + c", 1.0),
        ("y = c - a*b", 1.0),
        ("y = -(a*b) + c", 1.0),
        ("y = a*b + c*d", 2.0),
        ("t = a*b; y = (t + c)*(t + d)", 3.0), // fused with both sums
        ("t = a*b; y = (t + c)*t", 3.0),       // the product is needed by itself
        ("y = abs(a)*-b", 1.0),                // modifiers of arguments
        ("y = saturate(a + b)", 1.0),          // modifier of a result
        ("y = saturate(a)", 1.0),              // of an input: an instruction
        ("y = -a", 1.0),
        ("t = a + b; y = saturate(t)*t", 3.0), // both the clamped and the raw result are read
        ("y = 1/a", 4.0),
        ("y = a/b", 5.0),
        ("y = a/b + c/b", 6.0), // one reciprocal, a product, a fused one
        ("y = 1/a + b*c", 5.0),
        ("y = a/2", 1.0),
        ("y = pow(a, b)", 9.0),
        ("y = a^5", 3.0),
        ("y = sin(a)", 5.0),
        ("y = lerp(a, b, c)", 2.0),
        ("y = select(a < b, c, d)", 2.0),
        ("unused = exp2(a); y = a", 0.0),
    ] {
        assert_eq!(cycles(text, &["y"]), expected, "{text}");
    }
}
