//! Costs against figures published by others.

use lgp::cost::{CostScratch, Profile};
use lgp::program::{Program, parse_open};

fn program(text: &str, outputs: &[&str]) -> Program {
    let outputs: Vec<String> = outputs.iter().map(|&s| s.to_owned()).collect();
    parse_open(text, &outputs).unwrap().program
}

fn cycles_on(gpu: &str, text: &str, outputs: &[&str]) -> f64 {
    let profile = Profile::find(gpu).unwrap();
    profile.cycles(&program(text, outputs), &mut CostScratch::default())
}

fn cycles(text: &str, outputs: &[&str]) -> f64 {
    cycles_on("gcn", text, outputs)
}

/// Earl Hammon, "PBR Diffuse Lighting for GGX+Smith Microsurfaces", GDC 2017: GCN cycles and
/// registers.
#[test]
fn hammons_figures() {
    let half = "hx = lx + vx; hy = ly + vy; hz = lz + vz;
                s = rsqrt(hx*hx + hy*hy + hz*hz); nx_ = hx*s; ny_ = hy*s; nz_ = hz*s;";
    let n_dot_h = "n_dot_h = nx*nx_ + ny*ny_ + nz*nz_;";
    let l_dot_h = "l_dot_h = lx*nx_ + ly*ny_ + lz*nz_;";
    let identities = "s = rsqrt(2*l_dot_v + 2); n_dot_h = (n_dot_l + n_dot_v)*s;";
    let both = format!("{identities} l_dot_h = l_dot_v*s + s");
    let gcn = Profile::find("gcn").unwrap();
    let figures = |text: &str, outputs: &[&str]| {
        let cost = gcn.cost(&program(text, outputs));
        (cost.cycles, cost.registers)
    };
    assert_eq!(figures(half, &["nx_", "ny_", "nz_"]), (13.0, 4));
    assert_eq!(figures(&format!("{half}{n_dot_h}"), &["n_dot_h"]), (16.0, 4));
    let dots = format!("{half}{n_dot_h}{l_dot_h}");
    assert_eq!(figures(&dots, &["n_dot_h", "l_dot_h"]), (19.0, 4));
    assert_eq!(figures(identities, &["n_dot_h"]), (7.0, 2));
    assert_eq!(figures(&both, &["n_dot_h", "l_dot_h"]), (8.0, 2));
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

/// Cycles on `gcn`, `rdna2`, `rdna3`, `turing`, `ampere`, `valhall`.
#[test]
fn what_each_compiler_merges() {
    for (text, expected) in [
        ("y = a*b + c", [1.0, 1.0, 0.5, 1.0, 1.0, 1.0]),
        ("y = exp2(a)", [4.0, 4.0, 4.0, 4.0, 8.0, 4.0]),
        // Beside the transcendental pipe, three sums take no longer.
        ("y = exp2(a) + b + c + d", [7.0, 4.0, 4.0, 7.0, 11.0, 4.0]),
        ("y = min(a, b)", [1.0, 1.0, 0.5, 1.0, 2.0, 1.0]),
        // Minima of three, and clamps between constants.
        ("y = min(min(a, b), c)", [1.0, 1.0, 1.0, 2.0, 4.0, 2.0]),
        ("y = min(min(min(a, b), c), d)", [2.0, 2.0, 1.5, 3.0, 6.0, 3.0]),
        ("t = min(a, b); y = min(t, c)*t", [3.0, 3.0, 1.5, 3.0, 5.0, 2.0]),
        ("y = min(max(a, .2), .7)", [1.0, 1.0, 1.0, 2.0, 4.0, 4.0]),
        ("y = min(max(a, b), c)", [2.0, 2.0, 1.0, 2.0, 4.0, 2.0]),
        // Saturation of what is no multiply-add.
        ("y = saturate(min(a, b))", [1.0, 1.0, 0.5, 2.0, 3.0, 1.0]),
        ("y = saturate(rsqrt(a))", [4.0, 4.0, 4.0, 5.0, 9.0, 4.0]),
        ("y = saturate(a*b)", [1.0, 1.0, 0.5, 1.0, 1.0, 1.0]),
        // Output modifiers.
        ("y = (a + b)*2", [2.0, 1.0, 0.5, 2.0, 2.0, 2.0]),
        ("y = (a + b)*3", [2.0, 2.0, 1.0, 2.0, 2.0, 2.0]),
        // The inverse of a root is one operation; its own value another.
        ("y = 1/sqrt(a)", [4.0, 4.0, 4.0, 4.0, 8.0, 4.0]),
        ("y = b/sqrt(a)", [5.0, 4.0, 4.0, 5.0, 9.0, 4.0]),
        ("y = b/rsqrt(a)", [5.0, 4.0, 4.0, 5.0, 9.0, 8.0]),
        ("t = sqrt(a); y = b/t + c/t", [6.0, 4.0, 4.0, 6.0, 10.0, 4.0]),
        ("t = sqrt(a); y = b/t + t", [9.0, 8.0, 8.0, 9.0, 17.0, 12.0]),
        // Powers: only 2 and 4 are expanded.
        ("y = pow(a, 2)", [1.0, 1.0, 0.5, 1.0, 1.0, 1.0]),
        ("y = pow(a, 4)", [2.0, 2.0, 1.0, 2.0, 2.0, 2.0]),
        ("y = pow(a, 0.5)", [4.0, 4.0, 4.0, 4.0, 8.0, 8.0]),
        ("y = pow(2.2, a)", [5.0, 4.0, 4.0, 5.0, 9.0, 4.0]),
        ("y = pow(a, 5)", [9.0, 8.0, 8.0, 9.0, 17.0, 8.0]),
        ("y = a^5", [3.0, 3.0, 1.5, 3.0, 3.0, 3.0]),
        ("y = lerp(.2, .7, a)", [1.0, 1.0, 0.5, 1.0, 1.0, 2.0]),
    ] {
        let gpus = ["gcn", "rdna2", "rdna3", "turing", "ampere", "valhall"];
        assert_eq!(gpus.map(|gpu| cycles_on(gpu, text, &["y"])), expected, "{text}");
    }
}

/// What compilers compute, or leave out.
#[test]
fn constants_and_what_does_nothing_are_free() {
    for (text, expected) in [
        ("y = a*(0.5 - 1)", 1.0),
        ("y = a + sqrt(2)", 1.0),
        ("y = a*b + sqrt(exp2(3)/7)", 1.0),
        ("y = a - a", 0.0),
        ("y = 0*exp2(a) + b", 0.0),
        ("y = 1*a + 0", 0.0),
        ("y = pow(a, 1)/1", 0.0),
        ("t = a - a; y = b/(1 + t)", 0.0),
        ("y = mad(a, 1, b)", 1.0),
        ("y = select(1 < 2, a, exp2(b))", 0.0),
        ("y = exp2(2*a) + exp2(2*a)", 6.0),
    ] {
        let profile = Profile::find("gcn").unwrap();
        assert_eq!(cycles(text, &["y"]), expected, "{text}");
        assert_eq!(profile.cost(&program(text, &["y"])).cycles, expected, "{text}");
    }
}

#[test]
fn profiles_are_called_like_their_files_the_default_first() {
    assert_eq!(Profile::built_in().next(), Some("gcn"));
    for name in Profile::built_in() {
        assert_eq!(Profile::find(name).unwrap().name, name);
    }
}

#[test]
fn a_mix_is_the_weighted_mean() {
    let text = "y = exp2(a) + b";
    let mixed = cycles_on("gcn:2,turing:1, ampere", text, &["y"]);
    assert_eq!(mixed, (2.0 * 5.0 + 5.0 + 9.0) / 4.0);
    assert_eq!(cycles_on("gcn:3", text, &["y"]), 5.0);
    for (mix, expected) in [
        ("gcn:0", "`0` is not a positive weight"),
        ("gcn:2,turing:x", "`x` is not a positive weight"),
        ("gcn,turin", "did you mean `turing`?"),
        ("gcn,", "no GPU profile is called ``"),
    ] {
        let message = Profile::find(mix).unwrap_err().to_string();
        assert!(message.contains(expected), "{mix}: {message}");
    }
}

#[test]
fn registers_and_the_critical_path() {
    let gcn = Profile::find("gcn").unwrap();
    let rdna2 = Profile::find("rdna2").unwrap();
    for (text, registers, [on_gcn, on_rdna2]) in [
        ("y = a", 0, [0.0, 0.0]),
        ("y = a + b", 1, [1.0, 5.0]),
        // Two chains that do not wait for each other.
        ("y = exp2(a)*exp2(b)", 2, [5.0, 15.0]),
        ("y = exp2(exp2(a))", 1, [8.0, 20.0]),
        // Written breadth first, computed depth first.
        ("p = exp2(a); q = exp2(b); r = exp2(c); s = exp2(d); y = p + q + r + s", 2, [7.0, 25.0]),
        ("y = exp2(a)*exp2(b) + exp2(c)", 3, [5.0, 15.0]),
        // A merged product keeps its arguments alive, not itself.
        ("p = exp2(a); q = exp2(b); t = p*q; y = t + p", 2, [5.0, 15.0]),
        ("y = saturate(-(a + b))", 1, [1.0, 5.0]),
        ("y = a/b + c", 1, [5.0, 15.0]),
    ] {
        let program = program(text, &["y"]);
        let (cost, other) = (gcn.cost(&program), rdna2.cost(&program));
        assert_eq!(cost.registers, registers, "{text}");
        assert_eq!([cost.critical_path, other.critical_path], [on_gcn, on_rdna2], "{text}");
        assert_eq!(cost.cycles, gcn.cycles(&program, &mut CostScratch::default()), "{text}");
    }
}

#[test]
fn the_breakdown_names_each_operation() {
    let cost = Profile::find("rdna2").unwrap().cost(&program("y = a*b + exp2(-c)*d", &["y"]));
    let found: Vec<_> = cost.ops.iter().map(|(&op, cost)| (op, cost.count, cost.merged)).collect();
    assert_eq!(found, [("add", 1, 0), ("exp2", 1, 0), ("mul", 2, 1), ("neg", 1, 1)]);
    assert_eq!(cost.ops["exp2"].slots["transcendental"], 4.0);
    assert_eq!(cost.ops["mul"].slots["issue"], 1.0);
}

#[test]
fn unusable_profiles_say_why() {
    let gcn = include_str!("../grammar/gpu/gcn.ron");
    for (from, to, expected) in [
        ("slots: [4]", "slots: [4, 1]", "\"transcendental\": `slots`"),
        ("slots: [4]", "slots: [0]", "not all of them 0"),
        ("latency: 4", "latency: -4", "`latency` must be"),
        ("Some(\"full\")", "Some(\"fulll\")", "`min3`: no instruction is called \"fulll\""),
        ("\"exp2\": {\"transc", "\"exp2\": {\"trance", "no instruction is called"),
        ("\"sqrt\":", "\"sqt\":", "did you mean `sqrt`?"),
        ("\"sqrt\": {\"transcendental\": 1}, ", "", "operation \"sqrt\" is missing"),
        ("pipes: [\"vector\"]", "pipes: []", "1 to 4 pipes"),
        ("Every", "Evry", "line 16"),
    ] {
        assert!(gcn.contains(from), "{from}");
        let message = Profile::parse("my.ron", &gcn.replace(from, to)).unwrap_err().to_string();
        assert!(message.starts_with("GPU profile my.ron"), "{message}");
        assert!(message.contains(expected), "{from}: {message}");
    }
}
