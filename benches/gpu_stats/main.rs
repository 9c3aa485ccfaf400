//! Our cycles beside those of Mesa's AMD compiler, which needs no GPU for it.
//!
//! ```sh
//! cargo run --release --example gpu_stats -- compile "y = exp2(-a*b) + c"
//! cargo run --release --example gpu_stats -- corpus 200 > tests/reference/gpu_corpus_fresh.csv
//! cargo run --release --example gpu_stats -- compare tests/reference/gpu_corpus.csv tests/reference/gpu_corpus_fresh.csv
//! ```
//! Debian: `apt-get install mesa-vulkan-drivers`. Formulas are over the inputs a, b, c.

mod corpus;
mod radv;
mod random;

use clap::Parser;
use corpus::{Corpus, cycles, nodes, pearson, spearman};
use lgp::cost::Profile;
use lgp::grammar::Grammar;
use lgp::program::{Draft, Program};
use lgp::simplify::Simplifier;
use std::error::Error;
use std::io::Write;
use std::process::{Command, Stdio};

type Done<T> = Result<T, Box<dyn Error>>;

/// Chips that Mesa's compiler can be asked for, and the profiles that answer to them.
const FAMILIES: [(&str, &str); 2] = [("vega10", "gcn"), ("navi21", "rdna2")];

#[derive(Parser)]
#[command(about = "Our cycles beside those of real compilers")]
enum Args {
    /// What Mesa's AMD compiler makes of formulas of a, b, c
    Compile { formulas: Vec<String> },
    /// A table of random formulas, compiled
    Corpus {
        count: usize,
        #[arg(long, default_value_t = 1)]
        seed: u64,
        #[arg(long, default_value = "benches/gpu_stats/grammar.ron")]
        grammar: String,
    },
    /// How well each profile agrees with such tables, in Markdown
    Compare { tables: Vec<String> },
    /// Cycles of the formulas on standard input, on the chip of RADV_FORCE_FAMILY
    #[command(hide = true)]
    Child,
}

fn main() -> Done<()> {
    match Args::parse() {
        Args::Compile { formulas } => compile(&formulas),
        Args::Corpus { count, seed, grammar } => {
            corpus(&random::formulas(&Grammar::find(&grammar)?, count, seed))
        }
        Args::Compare { tables } => compare(&tables),
        Args::Child => child(),
    }
}

fn compile(formulas: &[String]) -> Done<()> {
    let programs = formulas.iter().map(|formula| radv::program(formula));
    let programs = programs.collect::<Result<Vec<_>, _>>()?;
    let mut columns = Vec::new();
    for (family, gpu) in FAMILIES {
        columns.push((family, compiled(family, formulas)?));
        columns.push((gpu, cycles(&Profile::find(gpu)?, &programs)));
    }
    columns.iter().for_each(|(name, _)| print!("{name:>8} "));
    println!(" formula");
    for (i, formula) in formulas.iter().enumerate() {
        columns.iter().for_each(|(_, cycles)| print!("{:>8.2} ", cycles[i]));
        println!(" {formula}");
    }
    Ok(())
}

fn corpus(formulas: &[String]) -> Done<()> {
    let columns =
        FAMILIES.iter().map(|(family, _)| compiled(family, formulas)).collect::<Done<Vec<_>>>()?;
    println!("id,formula,gcn_vega10,rdna2_navi21");
    for (i, formula) in formulas.iter().enumerate() {
        println!("{},\"{formula}\",{:.3},{:.3}", i + 1, columns[0][i], columns[1][i]);
    }
    Ok(())
}

/// Cycles of each formula on a chip, in units of a multiply-add.
fn compiled(family: &str, formulas: &[String]) -> Done<Vec<f64>> {
    let driver = radv::driver().ok_or(
        "Mesa's AMD driver is missing: install mesa-vulkan-drivers, or name its radeon_icd*.json in VK_ICD_FILENAMES",
    )?;
    let mut child = Command::new(std::env::current_exe()?)
        .arg("child")
        .env("RADV_FORCE_FAMILY", family)
        .env("VK_ICD_FILENAMES", &driver)
        .env("MESA_SHADER_CACHE_DISABLE", "true")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()?;
    let mut stdin = child.stdin.take().expect("piped");
    let asked: String = formulas.iter().map(|formula| formula.replace('\n', ";") + "\n").collect();
    // The child writes while it reads: another thread keeps either pipe from filling up.
    let writer = std::thread::spawn(move || stdin.write_all(asked.as_bytes()));
    let output = child.wait_with_output()?;
    writer.join().expect("it does not panic")?;
    let text = String::from_utf8(output.stdout)?;
    let numbers = text.lines().map(str::parse).collect::<Result<Vec<f64>, _>>()?;
    match output.status.success() && numbers.len() == formulas.len() {
        true => Ok(numbers),
        false => Err(format!("the compiler for {family} failed").into()),
    }
}

fn child() -> Done<()> {
    let compiler = radv::Compiler::new()?;
    let unit = compiler.cycles_of_a_step()?;
    for formula in std::io::stdin().lines() {
        println!("{}", compiler.cycles(&radv::program(&formula?)?)? / unit);
    }
    Ok(())
}

fn compare(tables: &[String]) -> Done<()> {
    for table in tables {
        let corpus = Corpus::parse(&std::fs::read_to_string(table)?);
        let programs = corpus.programs();
        let simple: Vec<Program> = programs.iter().map(simplified).collect();
        println!("`{table}`, {} formulas\n", programs.len());
        println!(
            "| profile | compiled for | Spearman | Pearson | simplified first | counting nodes |"
        );
        println!("|---|---|---|---|---|---|");
        for gpu in Profile::built_in() {
            let profile = Profile::find(gpu)?;
            let columns = profile.evidence().map_or(&[][..], |evidence| &evidence.columns);
            if columns.is_empty() || !columns.iter().all(|one| corpus.targets.contains(one)) {
                continue;
            }
            let (ours, theirs) = (cycles(&profile, &programs), corpus.busiest(columns));
            let after = cycles(&profile, &simple);
            println!(
                "| {gpu} | {} | {:.4} | {:.4} | {:.4} / {:.4} | {:.4} / {:.4} |",
                columns.join(", "),
                spearman(&ours, &theirs),
                pearson(&ours, &theirs),
                spearman(&after, &theirs),
                pearson(&after, &theirs),
                spearman(&nodes(&programs), &theirs),
                pearson(&nodes(&programs), &theirs),
            );
        }
        println!();
    }
    Ok(())
}

fn simplified(program: &Program) -> Program {
    let mut draft = Draft::default();
    Simplifier::default().simplify(program, &mut draft);
    Program::verify(draft).unwrap_or_else(|_| program.clone())
}
