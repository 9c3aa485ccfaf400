//! Operations that a language spells by several of its own, found again: `x - floor(x)` is a
//! `fract` where there is no such function.

use super::{Precision, ReadBack, read_literal};
use crate::emit::{Language, Snippet, emit, emit_half};
use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Draft, Names, Program, use_counts};
use half::f16;
use std::sync::OnceLock;

/// The code that spells an operation: its last instruction gives the result.
struct Pattern {
    op: Op,
    program: Program,
    precisions: Vec<Precision>,
}

impl ReadBack {
    /// Puts operations in the place of what spells them; none if there are none.
    pub(super) fn with_operations(&self) -> Option<ReadBack> {
        let patterns = known_patterns(self.language);
        let Draft { inputs, instrs, consts, outputs } = &*self.program;
        let mut draft = Draft { inputs: *inputs, consts: consts.clone(), ..Draft::default() };
        let mut moved: Vec<Arg> = Vec::with_capacity(instrs.len());
        let now = |arg: Arg, moved: &[Arg]| match arg {
            Arg::Result(i) => moved[usize::from(i)],
            other => other,
        };
        let mut precisions = self.precisions.clone();
        let mut found = false;
        for (i, instr) in instrs.iter().enumerate() {
            let matched =
                patterns.iter().find_map(|pattern| Some((pattern.op, pattern.at(self, i)?)));
            if matched.is_some() {
                found = true;
                // What rounds the result of halves is an operation of halves.
                if precisions[i] == Precision::Rounding {
                    precisions[i] = Precision::Half;
                }
            }
            let as_it_is =
                || (instr.op(), instr.args().iter().map(|&arg| Bound::Value(arg)).collect());
            let (op, args): (Op, Vec<Bound>) = matched.unwrap_or_else(as_it_is);
            let mut place = |arg: &Bound| match *arg {
                Bound::Value(Arg::Result(i)) => moved[usize::from(i)],
                Bound::Value(arg) => arg,
                Bound::Number(value) => draft.constant(value),
            };
            let args: Vec<Arg> = args.iter().map(&mut place).collect();
            moved.push(draft.push(op, &args));
        }
        if !found {
            return None;
        }
        draft.outputs.extend(outputs.iter().map(|&output| now(output, &moved)));
        let mut counts = Vec::new();
        use_counts(&draft, &mut counts);
        let kept = precisions.iter().zip(&counts).filter(|(_, count)| **count > 0);
        let precisions = kept.map(|(precision, _)| *precision).collect();
        let program = crate::program::effective(&Program::verify(draft).ok()?);
        Some(ReadBack { program, precisions, literal: None, ..self.clone() })
    }
}

/// Returns the patterns of a language, which are made once.
fn known_patterns(language: Language) -> &'static [Pattern] {
    static KNOWN: [OnceLock<Vec<Pattern>>; Language::ALL.len()] =
        [const { OnceLock::new() }; Language::ALL.len()];
    let place = Language::ALL.iter().position(|&other| other == language);
    KNOWN[place.expect("every language is listed")].get_or_init(|| patterns(language))
}

/// Returns the patterns of a language, those of more instructions first.
fn patterns(language: Language) -> Vec<Pattern> {
    let names = Names::new(["p0", "p1", "p2", "p3"], ["p4"]);
    let mut patterns = Vec::new();
    for &op in Op::ALL {
        let mut draft = Draft { inputs: 4, ..Draft::default() };
        let args: Vec<Arg> = (0..4).map(Arg::Input).collect();
        draft.outputs = vec![draft.push(op, &args)];
        let Ok(program) = Program::verify(draft) else { continue };
        let snippet = Snippet::new(&program, &names, "p5").without_comments();
        let texts = [Some(emit(language, &snippet)), emit_half(language, &snippet, &[])];
        for text in texts.into_iter().flatten() {
            let Ok(ReadBack { program, precisions, .. }) = read_literal(language, &text) else {
                continue;
            };
            if program.instrs.len() > 1 && op != Op::Mad {
                patterns.push(Pattern { op, program, precisions });
            }
        }
    }
    patterns.sort_by_key(|pattern| std::cmp::Reverse(pattern.program.instrs.len()));
    patterns
}

impl ReadBack {
    /// Returns a formula with the operations that this language spells by several in the place of
    /// what spells them: code that is read has lost which of the two it was.
    pub fn respelled(&self, formula: &Program) -> Option<Program> {
        let precisions = vec![Precision::Single; formula.instrs.len()];
        let (in_half, variant, literal) = (false, None, None);
        let of_formula = ReadBack {
            program: formula.clone(),
            precisions,
            in_half,
            variant,
            literal,
            ..self.clone()
        };
        Some(of_formula.with_operations()?.program)
    }
}

/// What stands in an argument's place.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Bound {
    Value(Arg),
    /// The number itself: the code may have the negated one.
    Number(f32),
}

impl Bound {
    fn of(code: &ReadBack, arg: Arg) -> Bound {
        match arg {
            Arg::Const(i) => Bound::Number(code.program.consts[usize::from(i)]),
            other => Bound::Value(other),
        }
    }

    /// Returns true for a value that is a half.
    fn is_half(self, code: &ReadBack) -> bool {
        match self {
            Bound::Number(value) => f16::from_f32(value).to_f32() == value,
            Bound::Value(Arg::Result(i)) => code.precisions[usize::from(i)] != Precision::Single,
            Bound::Value(_) => code.in_half,
        }
    }
}

impl Pattern {
    /// Returns the operation's arguments where the pattern ends with the instruction of this index.
    fn at(&self, code: &ReadBack, index: usize) -> Option<Vec<Bound>> {
        let mut bound = [None; MAX_ARITY];
        let last = Arg::Result(self.program.instrs.len() as u16 - 1);
        let same = self.program.outputs == [last]
            && self.same(last, code, Arg::Result(index as u16), &mut bound);
        if !same {
            return None;
        }
        let args: Vec<Bound> = bound[..self.op.arity()].iter().copied().collect::<Option<_>>()?;
        let is_rounded = self.precisions.last() == Some(&Precision::Rounding);
        (!is_rounded || args.iter().all(|arg| arg.is_half(code))).then_some(args)
    }

    fn same(
        &self,
        pattern: Arg,
        code: &ReadBack,
        arg: Arg,
        bound: &mut [Option<Bound>; MAX_ARITY],
    ) -> bool {
        match (pattern, arg) {
            (Arg::Input(i), _) => binds(bound, i, Bound::of(code, arg)),
            (Arg::Const(i), Arg::Const(k)) => {
                let [a, b] = [(&self.program, i), (&code.program, k)]
                    .map(|(program, i)| program.consts[usize::from(i)]);
                a.to_bits() == b.to_bits()
            }
            (Arg::Result(i), Arg::Result(k)) => {
                let (i, k) = (usize::from(i), usize::from(k));
                let [a, b] = [&self.program.instrs[i], &code.program.instrs[k]];
                if self.precisions[i] != code.precisions[k] {
                    return false;
                }
                match (a.op(), b.op(), a.args(), b.args()) {
                    // A difference from a negative number is written as a sum.
                    (Op::Sub, Op::Add, &[x, Arg::Input(i)], &[y, negated @ Arg::Const(_)]) => {
                        let Bound::Number(number) = Bound::of(code, negated) else { return false };
                        self.same(x, code, y, bound) && binds(bound, i, Bound::Number(-number))
                    }
                    (a, b, xs, ys) => {
                        a == b && xs.iter().zip(ys).all(|(&x, &y)| self.same(x, code, y, bound))
                    }
                }
            }
            _ => false,
        }
    }
}

/// Puts a value in an argument's place, and returns true if no other stands there.
fn binds(bound: &mut [Option<Bound>; MAX_ARITY], place: u16, value: Bound) -> bool {
    let first = *bound[usize::from(place)].get_or_insert(value);
    match (first, value) {
        (Bound::Number(a), Bound::Number(b)) => a.to_bits() == b.to_bits(),
        (a, b) => a == b,
    }
}
