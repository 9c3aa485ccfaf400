//! A candidate's preparation, evaluation and fit allocate nothing once the memory is large enough.

use lgp::cost::{CostScratch, Profile};
use lgp::dataset::Split;
use lgp::eval::{ErrorSums, Evaluator, Samples, Tape, Values};
use lgp::fit::{Differentiated, Fitter, Stop};
use lgp::op::Op;
use lgp::program::{Arg, Constants, Draft, Program, effective_into, structural_hash};
use lgp::simplify::Simplifier;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The system's allocator, counting calls.
struct Counting;

static CALLS: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        CALLS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: promised by the caller.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: promised by the caller.
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        CALLS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: promised by the caller.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const STOP: Stop = Stop { max_steps: 4, min_gain: 1e-6 };

/// All that a worker owns.
struct Bench {
    program: Program,
    effective: Draft,
    simple: Draft,
    uses: Vec<u32>,
    hashes: Vec<u64>,
    simplifier: Simplifier,
    profile: Profile,
    cost: CostScratch,
    tape: Tape,
    derivative: Differentiated,
    evaluator: Evaluator,
    fitter: Fitter,
    loss: ErrorSums,
    values: Values,
}

impl Bench {
    fn new(first: &Draft) -> Bench {
        Bench {
            program: Program::verify(first.clone()).unwrap(),
            effective: Draft::default(),
            simple: Draft::default(),
            uses: Vec::new(),
            hashes: Vec::new(),
            simplifier: Simplifier::default(),
            profile: Profile::find("gcn").unwrap(),
            cost: CostScratch::default(),
            tape: Tape::default(),
            derivative: Differentiated::default(),
            evaluator: Evaluator::default(),
            fitter: Fitter::default(),
            loss: ErrorSums::default(),
            values: Values::default(),
        }
    }

    /// A candidate's whole life; adds the calls that each step made to the report.
    fn live(&mut self, candidate: &Draft, samples: &Samples, report: &mut [usize; 9]) {
        let mut last = CALLS.load(Ordering::Relaxed);
        let mut note = |step: usize| {
            let now = CALLS.load(Ordering::Relaxed);
            report[step] += now - last;
            last = now;
        };
        effective_into(candidate, &mut self.effective, &mut self.uses);
        note(0);
        self.simplifier.simplify(candidate, &mut self.simple);
        note(1);
        structural_hash(&self.simple, Constants::Ignored, &mut self.hashes);
        note(2);
        self.profile.cycles(&self.simple, &mut self.cost);
        note(3);
        if self.program.assign(&self.simple).is_err() {
            return; // a constant was folded to infinity
        }
        self.tape.prepare(&self.program);
        note(4);
        self.derivative.assign(&self.simple);
        note(5);
        self.evaluator.loss_into(&self.tape, samples, f64::INFINITY, &mut self.loss);
        note(6);
        self.evaluator.outputs_into(&self.tape, samples, &mut self.values);
        note(7);
        self.fitter.fit(&mut self.simple, samples, STOP);
        note(8);
    }
}

fn random_draft(rng: &mut ChaCha8Rng, outputs: usize) -> Draft {
    let mut draft = Draft { inputs: 2, ..Draft::default() };
    for i in 0..rng.random_range(4..24u16) {
        let op = Op::ALL[rng.random_range(0..Op::ALL.len())];
        let args: [Arg; 4] = std::array::from_fn(|_| match rng.random_range(0..4) {
            0 => Arg::Input(rng.random_range(0..2)),
            1 => draft.constant(rng.random_range(-2.0f32..2.0)),
            _ if i == 0 => Arg::Input(0),
            _ => Arg::Result(rng.random_range(0..i)),
        });
        draft.push(op, &args);
    }
    let last = draft.instrs.len();
    draft.outputs = (0..outputs).map(|o| Arg::Result((last - 1 - o) as u16)).collect();
    draft
}

#[test]
fn candidates_allocate_nothing_after_the_first_round() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let column = |f: fn(f32) -> f32| (0..700).map(|i| f(i as f32 / 700.0)).collect::<Vec<_>>();
    let columns = [column(|x| x), column(|x| 1.0 - x), column(f32::sqrt), column(|x| x * x)];
    let samples = [3, 4]
        .map(|n| Samples::new(&Split { columns: columns[..n].to_vec(), ..Split::default() }, 2));
    // The number of outputs alternates, as between searches it may.
    let drafts: Vec<Draft> = (0..400).map(|i| random_draft(&mut rng, 1 + i % 2)).collect();
    let mut bench = Bench::new(&drafts[0]);
    let mut report = [0; 9];
    for round in 0..3 {
        report = [0; 9];
        for (i, draft) in drafts.iter().enumerate() {
            bench.live(draft, &samples[i % 2], &mut report);
        }
        assert!(round > 0 || report.iter().sum::<usize>() > 0, "the allocator counts");
    }
    assert_eq!(
        report, [0; 9],
        "calls by: effective code, simplify, hash, cost, tape, derivative, loss, values, fit"
    );
}
