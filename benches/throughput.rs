//! Throughput against number of samples and program length: `results/eval/*.csv` and pictures.
//!
//! `cargo run --release --example throughput`; with `peers`, only writes the programs for
//! `benches/peers/time.py` to the standard output; with `sets`, only prints the three sets.

mod programs;

use lgp::eval::{CHUNK, Evaluator, Isa, Samples, Tape, Values};
use lgp::op::Op;
use lgp::program::{Arg, Program};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::fmt::Write;
use std::time::Instant;

/// The shortest of many runs, in seconds: what others do on the machine only adds to it.
fn shortest(seconds: f64, mut run: impl FnMut()) -> f64 {
    let (start, mut shortest) = (Instant::now(), f64::INFINITY);
    while start.elapsed().as_secs_f64() < seconds {
        let begin = Instant::now();
        run();
        shortest = shortest.min(begin.elapsed().as_secs_f64());
    }
    shortest
}

/// G op-evaluations a second, preparation included.
fn throughput(isa: Isa, programs: &[Program], samples: &Samples) -> f64 {
    let (mut evaluator, mut tape) = (Evaluator::new(isa), Tape::default());
    let mut values = Values::default();
    let seconds = shortest(1.0, || {
        for program in programs {
            tape.prepare(program);
            evaluator.outputs_into(&tape, samples, &mut values);
        }
    });
    (programs::operations(programs) * samples.rows()) as f64 / seconds * 1e-9
}

/// A line of a plot: its name, and points with ascending abscissae.
type Line = (&'static str, Vec<(f64, f64)>);

fn against_samples() -> Vec<Line> {
    let sizes = [16, 64, 256, 512, 1024, 2048, 4096, 16384, 65536, 262_144, 1_000_000];
    let line = |set: &programs::Set| {
        let point = |&rows: &usize| {
            let programs = set.programs(if rows > 20_000 { 10 } else { 100 });
            let samples = Samples::new(&programs::samples(rows), programs::INPUTS);
            (rows as f64, throughput(Isa::best(), &programs, &samples))
        };
        (set.name, sizes.iter().map(point).collect())
    };
    programs::SETS.iter().map(line).collect()
}

fn against_length() -> Vec<Line> {
    let samples = Samples::new(&programs::samples(programs::SAMPLES), programs::INPUTS);
    let line = |set: &programs::Set| {
        let mut rng = ChaCha8Rng::seed_from_u64(programs::SEED);
        let mut points = Vec::new();
        for nodes in [3, 5, 9, 15, 21, 31, 41, 61] {
            let mut programs = Vec::new();
            while programs.len() < 40 {
                programs.extend(set.tree(&mut rng, nodes));
            }
            let operations = programs::operations(&programs) as f64 / 40.0;
            points.push((operations, throughput(Isa::best(), &programs, &samples)));
        }
        (set.name, points)
    };
    programs::SETS.iter().map(line).collect()
}

fn csv(abscissa: &str, lines: &[Line]) -> String {
    let mut text = format!("set,{abscissa},g_op_evaluations_per_second\n");
    for (name, points) in lines {
        for (x, y) in points {
            writeln!(text, "{name},{x},{y:.2}").expect("a string takes everything");
        }
    }
    text
}

/// A picture of the lines: abscissa logarithmic with a grid of powers of two, ordinate from zero.
fn svg(abscissa: &str, lines: &[Line]) -> String {
    const COLORS: [&str; 3] = ["#1b6ca8", "#c0392b", "#2e8b57"];
    let all = || lines.iter().flat_map(|(_, points)| points.iter());
    let low = all().map(|p| p.0).fold(f64::INFINITY, f64::min).log2();
    let high = all().map(|p| p.0).fold(0.0, f64::max).log2();
    let top = all().map(|p| p.1).fold(0.0, f64::max) * 1.05;
    let x = |value: f64| 50.0 + 570.0 * (value.log2() - low) / (high - low);
    let y = |value: f64| 360.0 - 340.0 * value / top;
    let mut body = String::new();
    let mut add = |piece: String| body.push_str(&(piece + "\n"));
    // Labels of six digits need the room of two octaves.
    let octaves = if high - low > 8.0 { 2 } else { 1 };
    for power in (low.ceil() as i32..=high.floor() as i32).step_by(octaves) {
        let (value, at) = (2f64.powi(power), x(2f64.powi(power)));
        add(format!(r##"<path d="M{at:.1} 20V360" stroke="#ddd"/>"##));
        add(format!(r#"<text x="{at:.1}" y="376" text-anchor="middle">{value}</text>"#));
    }
    for value in (0..=top as i32).step_by(2) {
        let at = y(f64::from(value));
        add(format!(r##"<path d="M50 {at:.1}H620" stroke="#ddd"/>"##));
        add(format!(r#"<text x="44" y="{:.1}" text-anchor="end">{value}</text>"#, at + 4.0));
    }
    let mut taken: Vec<f64> = Vec::new();
    for ((name, points), color) in lines.iter().zip(COLORS) {
        let corners: Vec<_> =
            points.iter().map(|p| format!("{:.1},{:.1}", x(p.0), y(p.1))).collect();
        let corners = corners.join(" ");
        add(format!(
            r#"<polyline points="{corners}" fill="none" stroke="{color}" stroke-width="2"/>"#
        ));
        let mut end = y(points[points.len() - 1].1) + 4.0;
        while taken.iter().any(|other| (end - other).abs() < 12.0) {
            end += 1.0;
        }
        taken.push(end);
        add(format!(r#"<text x="626" y="{end:.1}" fill="{color}">{name}</text>"#));
    }
    add(format!(r#"<text x="335" y="396" text-anchor="middle">{abscissa}</text>"#));
    add(r#"<text x="50" y="14">G op-evaluations/s</text>"#.to_owned());
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 700 404\" font-family=\"sans-serif\" font-size=\"11\">\n\
         <rect width=\"700\" height=\"404\" fill=\"#fff\"/>\n{body}</svg>\n"
    )
}

/// The programs as lines `set<TAB>operations<TAB>postfix`, so that each peer is timed on the same.
fn write_programs() {
    for set in &programs::SETS {
        for program in set.programs(200) {
            println!("{}\t{}\t{}", set.name, program.instrs.len(), postfix(&program));
        }
    }
}

/// Postfix notation: inputs `x0`…, constants as numbers, operations by name.
fn postfix(program: &Program) -> String {
    fn visit(program: &Program, arg: Arg, words: &mut Vec<String>) {
        match arg {
            Arg::Input(i) => words.push(format!("x{i}")),
            Arg::Const(i) => words.push(program.consts[usize::from(i)].to_string()),
            Arg::Result(i) => {
                let instr = program.instrs[usize::from(i)];
                instr.args().iter().for_each(|&arg| visit(program, arg, words));
                words.push(instr.op().name().to_owned());
            }
        }
    }
    let mut words = Vec::new();
    visit(program, program.outputs[0], &mut words);
    words.join(" ")
}

fn print_sets() {
    let samples = Samples::new(&programs::samples(programs::SAMPLES), programs::INPUTS);
    println!("chunk {CHUNK}");
    for set in &programs::SETS {
        let programs = set.programs(200);
        let mut tape = Tape::default();
        let preparation = shortest(0.3, || programs.iter().for_each(|p| tape.prepare(p)));
        let (programs_count, operations) = (programs.len(), programs::operations(&programs));
        for isa in Isa::available() {
            let speed = throughput(isa, &programs, &samples);
            println!("{:10} {isa:9} {speed:.2} G/s", set.name);
        }
        println!(
            "           {:.1} operations, preparation {:.0} ns",
            operations as f64 / programs_count as f64,
            preparation * 1e9 / programs_count as f64,
        );
        let of = |op: Op| programs.iter().flat_map(|p| &p.instrs).filter(|i| i.op() == op).count();
        let shares = set.operations.iter().map(|&op| format!("{op} {}", of(op)));
        println!("           {}", shares.collect::<Vec<_>>().join(", "));
    }
}

fn main() -> std::io::Result<()> {
    match std::env::args().nth(1).as_deref() {
        Some("peers") => write_programs(),
        Some("sets") => print_sets(),
        _ => draw()?,
    }
    Ok(())
}

fn draw() -> std::io::Result<()> {
    std::fs::create_dir_all("results/eval")?;
    for (file, abscissa, lines) in
        [("samples", "samples", against_samples()), ("length", "operations", against_length())]
    {
        std::fs::write(format!("results/eval/{file}.csv"), csv(abscissa, &lines))?;
        std::fs::write(format!("results/eval/{file}.svg"), svg(abscissa, &lines))?;
    }
    Ok(())
}
