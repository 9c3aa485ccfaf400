//! Times the members of the committed front on a GPU, beside what profiles say they cost.
//!
//! ```text
//! cargo run --release --example gpu_time [-- DEVICE [PROFILE]…]
//! ```
//! DEVICE is a part of the device's name (`NVIDIA` unless given; `llvmpipe` tries the program out
//! on Mesa's software Vulkan, where the times are a processor's and mean nothing for a GPU).
//!
//! Each thread iterates a formula, its outputs becoming its inputs: one chain, so that each
//! evaluation waits for the one before (latency), or eight side by side (throughput). The time
//! of one evaluation is the difference between many iterations and few, in units of a
//! multiply-add timed in the same way just before.

#[path = "../tests/vulkan/mod.rs"]
mod vulkan;

use lgp::cost::Profile;
use lgp::emit::{Language, Snippet, emit};
use lgp::fit::Measure;
use lgp::program::{Names, Program, parse};
use lgp::run::Run;
use lgp::search::Front;
use std::path::Path;
use vulkan::Gpu;

const GROUP: u32 = 64;
/// Chains side by side.
const CHAINS: [usize; 2] = [1, 8];
const FEW: u32 = 64;
const REPEATS: u32 = 7;
/// Times that a formula and a multiply-add are timed beside each other; the median counts.
const ROUNDS: usize = 5;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let gpu = Gpu::open(arguments.first().map_or("NVIDIA", String::as_str))?;
    let chosen = arguments.get(1..).filter(|chosen| !chosen.is_empty());
    let chosen =
        chosen.map_or(vec!["turing", "ampere"], |c| c.iter().map(String::as_str).collect());
    let profiles = chosen.into_iter().map(Profile::find).collect::<Result<Vec<_>, _>>()?;
    let is_software = gpu.name.contains("llvmpipe");
    println!("device: {}", gpu.name);
    if is_software {
        println!("TRIAL: a processor's times, not a GPU's; they show that this program runs");
    }
    // A processor is occupied by one group.
    let load = match is_software {
        true => Load { groups: 1, many: 32768 },
        false => Load { groups: 2048, many: 4096 },
    };

    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/dfg");
    let run = Run::load(&folder)?;
    let names = run.names();
    let unit = parse("scale = mad(n_dot_v, .7, .1); bias = mad(roughness, .6, .2)", &names)?;
    // Two multiply-adds, one in each of two chains: twice the throughput, once the latency.
    let multiply_add = || -> Outcome<[f64; 2]> {
        let [latency, throughput] = time_of(&gpu, &load, &unit, &names)?;
        Ok([latency, throughput / 2.0])
    };
    let [latency, throughput] = multiply_add()?;
    println!("multiply-add: {latency:.4} ns latency, {throughput:.6} ns throughput");

    print!("member  latency  throughput");
    profiles.iter().for_each(|profile| print!("  {:>18}", profile.name.clone() + " cycles, path"));
    println!();
    let mut measured: Vec<[f64; 2]> = Vec::new();
    let mut promised: Vec<Vec<[f64; 2]>> = vec![Vec::new(); profiles.len()];
    let front = Front::load(&folder.join("front.json"), &run, Measure::Rmse)?;
    for (i, member) in front.members.iter().enumerate() {
        // A formula that ignores an input is no chain.
        if member.cost < 4.0 {
            continue;
        }
        // A GPU changes its clock as it likes.
        let mut rounds = Vec::new();
        for _ in 0..ROUNDS {
            let unit = multiply_add()?;
            let times = time_of(&gpu, &load, &member.program, &names)?;
            rounds.push([times[0] / unit[0], times[1] / unit[1]]);
        }
        let times = [0, 1].map(|k| median(column(&rounds, k)));
        print!("{:>6}  {:>7.2}  {:>10.2}", i + 1, times[0], times[1]);
        for (profile, promised) in profiles.iter().zip(&mut promised) {
            let cost = profile.cost(&member.program);
            print!("  {:>10.1}  {:>6.1}", cost.cycles, cost.critical_path);
            promised.push([cost.critical_path, cost.cycles]);
        }
        println!();
        measured.push(times);
    }
    for (profile, promised) in profiles.iter().zip(&promised) {
        let [latency, throughput] =
            [0, 1].map(|k| spearman(&column(&measured, k), &column(promised, k)));
        println!(
            "{}: Spearman {throughput:.3} of throughput with cycles, {latency:.3} of latency with \
             the critical path{}",
            profile.name,
            if is_software { " (TRIAL)" } else { "" }
        );
    }
    Ok(())
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

struct Load {
    groups: u32,
    many: u32,
}

/// Nanoseconds of one evaluation: in one chain, a thread's; in eight, all threads' together.
fn time_of(gpu: &Gpu, load: &Load, program: &Program, names: &Names) -> Outcome<[f64; 2]> {
    let mut times = [0.0; 2];
    for (time, chains) in times.iter_mut().zip(CHAINS) {
        // Latency is one group's: others would hide it.
        let groups = if chains == 1 { 1 } else { load.groups };
        let shortest = |iterations| -> Outcome<f64> {
            let spirv = chain(program, names, chains, iterations)?;
            let threads = (groups * GROUP) as usize;
            let mut shortest = f64::INFINITY;
            for _ in 0..REPEATS {
                let ran = gpu.run(&spirv, &[0.5, 0.001], threads, groups)?;
                shortest = shortest.min(ran.seconds);
            }
            Ok(shortest)
        };
        let difference = shortest(load.many)? - shortest(FEW)?;
        let evaluations = f64::from(load.many - FEW) * chains as f64;
        let together = if chains == 1 { 1.0 } else { f64::from(groups * GROUP) };
        *time = difference * 1e9 / evaluations / together;
    }
    Ok(times)
}

/// A shader that iterates the program: two inputs, two outputs.
fn chain(program: &Program, names: &Names, chains: usize, iterations: u32) -> Outcome<Vec<u32>> {
    let snippet = Snippet::new(program, names, "formula");
    let each = |line: &dyn Fn(usize) -> String| (0..chains).map(line).collect::<String>();
    let source = format!(
        "{}
@group(0) @binding(0) var<storage, read> start: array<f32>;
@group(0) @binding(1) var<storage, read_write> results: array<f32>;
@compute @workgroup_size({GROUP})
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let x = start[0] + start[1]*f32(id.x & 63u);
{}    for (var i = 0u; i < {iterations}u; i++) {{
{}    }}
    results[id.x] = {};
}}
",
        emit(Language::Wgsl, &snippet),
        each(&|c| format!("    var v{c} = vec2<f32>(x + 0.0{c}1, x);\n")),
        each(&|c| format!("        v{c} = formula(v{c}.x, v{c}.y);\n")),
        (0..chains).map(|c| format!("v{c}.x + v{c}.y")).collect::<Vec<_>>().join(" + ")
    );
    let module = naga::front::wgsl::parse_str(&source)?;
    let mut validator = naga::valid::Validator::new(
        naga::valid::ValidationFlags::all(),
        naga::valid::Capabilities::empty(),
    );
    let info = validator.validate(&module)?;
    // A counter of naga's own would be timed as well.
    let options = naga::back::spv::Options { force_loop_bounding: false, ..Default::default() };
    Ok(naga::back::spv::write_vec(&module, &info, &options, None)?)
}

fn column(pairs: &[[f64; 2]], k: usize) -> Vec<f64> {
    pairs.iter().map(|pair| pair[k]).collect()
}

/// The correlation of ranks, those of equal values being their mean.
fn spearman(a: &[f64], b: &[f64]) -> f64 {
    let [a, b] = [a, b].map(|values| {
        let rank = |x: &f64| {
            let below = values.iter().filter(|y| *y < x).count() as f64;
            let equal = values.iter().filter(|y| *y == x).count() as f64;
            below + (equal + 1.0) / 2.0
        };
        values.iter().map(rank).collect::<Vec<f64>>()
    });
    let mean = (a.len() as f64 + 1.0) / 2.0;
    let product = |a: &[f64], b: &[f64]| -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - mean) * (b - mean)).sum()
    };
    product(&a, &b) / (product(&a, &a) * product(&b, &b)).sqrt()
}
