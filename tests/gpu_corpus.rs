//! Profiles against what real compilers make of the same formulas.

#[path = "../benches/gpu_stats/corpus.rs"]
mod corpus;

use corpus::{Corpus, cycles, nodes, pearson, spearman};
use lgp::cost::Profile;

/// Each profile, the columns of `tests/reference/gpu_corpus.csv` it answers to, and the rank
/// correlation it must reach.
const TARGETS: [(&str, &str, f64); 6] = [
    ("gcn", "gcn_vega10", 0.98),
    ("rdna2", "rdna2_navi21", 0.98),
    ("rdna3", "rdna3_navi31", 0.96),
    ("turing", "nvidia_sm80", 0.98),
    ("ampere", "nvidia_sm86", 0.98),
    ("valhall", "mali_g78_fma+mali_g78_cvt+mali_g78_sfu", 0.96),
];

#[test]
fn profiles_rank_formulas_as_compilers_do() {
    let corpus = Corpus::parse(include_str!("reference/gpu_corpus.csv"));
    let programs = corpus.programs();
    assert_eq!(programs.len(), 60);
    for (gpu, target, least) in TARGETS {
        let ours = cycles(&Profile::find(gpu).unwrap(), &programs);
        let theirs = corpus.column(target);
        let (found, counted) = (spearman(&ours, &theirs), spearman(&nodes(&programs), &theirs));
        assert!(found >= least, "{gpu}: {found}");
        assert!(found > counted, "{gpu}: {found}, {counted} by counting nodes");
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
