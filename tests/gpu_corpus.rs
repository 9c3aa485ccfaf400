//! Profiles against what real compilers make of the same formulas.

#[path = "../benches/gpu_stats/corpus.rs"]
mod corpus;

#[path = "../benches/gpu_stats/radv.rs"]
mod radv;

use corpus::{Corpus, cycles, nodes, pearson, spearman};
use lgp::cost::{Evidence, Profile};
use std::io::Write;
use std::process::Command;

#[test]
fn profiles_rank_formulas_as_compilers_do() {
    let corpus = Corpus::parse(include_str!("reference/gpu_corpus.csv"));
    assert_eq!(corpus.rows.len(), 60);
    for gpu in Profile::built_in() {
        ranks_as_promised(gpu, &corpus);
    }
}

fn ranks_as_promised(gpu: &str, corpus: &Corpus) {
    let (programs, profile) = (corpus.programs(), Profile::find(gpu).unwrap());
    let Evidence { columns, rank_correlation } = profile.evidence().unwrap_or_else(|| {
        panic!("grammar/gpu/{gpu}.ron has no `evidence`: name columns of tests/reference/gpu_corpus.csv")
    });
    let (ours, theirs) = (cycles(&profile, &programs), corpus.busiest(columns));
    let (found, counted) = (spearman(&ours, &theirs), spearman(&nodes(&programs), &theirs));
    assert!(found >= *rank_correlation, "{gpu}: {found}");
    assert!(found > counted, "{gpu}: {found}, {counted} by counting nodes");
}

/// Profiles, and what Mesa calls their chips.
const MESA: [(&str, &str); 2] = [("gcn", "vega10"), ("rdna2", "navi21")];

/// The same of formulas that no figure of a profile was chosen by.
#[test]
fn profiles_rank_fresh_formulas_as_compilers_do() {
    let corpus = Corpus::parse(include_str!("reference/gpu_corpus_fresh.csv"));
    assert_eq!(corpus.rows.len(), 200);
    for (gpu, _) in MESA {
        ranks_as_promised(gpu, &corpus);
    }
}

/// The compiler that is installed ranks formulas as the one that the committed table is from, and so do
/// the profiles.
#[test]
fn the_compiler_at_hand_agrees() {
    let Some(driver) = radv::driver() else {
        let line =
            "SKIPPED: mesa-vulkan-drivers is not installed; no formula was compiled for a GPU";
        assert!(std::env::var("LGP_REQUIRE_TOOLS").as_deref() != Ok("1"), "{line}");
        // The test harness captures what the print macros write, but not this.
        let _ = std::io::stderr().write_all(format!("\n{line}\n").as_bytes());
        return;
    };
    let corpus = Corpus::parse(include_str!("reference/gpu_corpus_fresh.csv"));
    let programs = corpus.programs();
    for (gpu, family) in MESA {
        let profile = Profile::find(gpu).unwrap();
        let Evidence { columns, rank_correlation } = profile.evidence().unwrap();
        // The variables are read when Vulkan is loaded: a process for each chip.
        let child = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "cycles_on_the_chip_of_the_environment", "--ignored", "--nocapture"])
            .env("RADV_FORCE_FAMILY", family)
            .env("VK_ICD_FILENAMES", &driver)
            .env("MESA_SHADER_CACHE_DISABLE", "true")
            .output()
            .unwrap();
        let text = String::from_utf8_lossy(&child.stdout);
        let number = |line: &str| line.strip_prefix("cycles: ").map(|text| text.parse().unwrap());
        let compiled: Vec<f64> = text.lines().filter_map(number).collect();
        assert_eq!(compiled.len(), programs.len(), "{family}: {text}");
        let recorded = spearman(&compiled, &corpus.busiest(columns));
        assert!(recorded >= 0.98, "{family}: {recorded}");
        let ours = spearman(&compiled, &cycles(&profile, &programs));
        assert!(ours >= *rank_correlation, "{family}: {ours}");
    }
}

#[test]
#[ignore = "a part of `the_compiler_at_hand_agrees`, which sets its environment"]
fn cycles_on_the_chip_of_the_environment() {
    let compiler = radv::Compiler::new().unwrap();
    let unit = compiler.cycles_of_a_step().unwrap();
    let corpus = Corpus::parse(include_str!("reference/gpu_corpus_fresh.csv"));
    println!();
    for row in &corpus.rows {
        let program = radv::program(&row.formula).unwrap();
        println!("cycles: {}", compiler.cycles(&program).unwrap() / unit);
    }
}

#[test]
fn correlations_are_those_of_a_textbook() {
    // Spearman 1904's statistic, by hand: ranks 1, 2.5, 2.5, 4 and 1, 3, 2, 4.
    let (a, b) = ([1.0, 5.0, 5.0, 9.0], [0.0, 7.0, 6.0, 100.0]);
    assert!((spearman(&a, &b) - 4.5 / (4.5f64 * 5.0).sqrt()).abs() < 1e-12);
    assert!((pearson(&[1.0, 2.0, 3.0], &[2.0, 4.0, 6.0]) - 1.0).abs() < 1e-12);
    assert!((pearson(&[1.0, 2.0, 3.0], &[1.0, 0.0, -1.0]) + 1.0).abs() < 1e-12);
}
