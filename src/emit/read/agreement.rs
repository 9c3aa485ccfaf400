//! Comparison of code in halves with a formula, operation by operation.
//!
//! A formula does not say which operations stay in single precision, and numbers are rounded, so
//! values would differ although the code is the formula. The two are compared as graphs instead.

use super::{Precision, ReadBack, applied};
use crate::eval::{Arithmetic, Half};
use crate::op::{MAX_ARITY, Op};
use crate::program::{Arg, Program};
use half::f16;
use std::collections::HashMap;

impl ReadBack {
    /// Returns true if each operation is one of the formula's, on the same arguments, and numbers
    /// are the formula's, rounded to halves where they meet halves. Signs may stand elsewhere, and
    /// multiply-adds may be split.
    pub fn is(&self, formula: &Program) -> bool {
        self.is_literally(formula)
            || self.respelled(formula).is_some_and(|formula| self.is_literally(&formula))
    }

    fn is_literally(&self, formula: &Program) -> bool {
        let sides = self.program.inputs == formula.inputs
            && self.program.outputs.len() == formula.outputs.len();
        let mut comparison = Comparison {
            code: self,
            formula,
            code_constants: constants(&self.program, &|i, op, args| {
                applied(op, args, self.precisions[i])
            }),
            singles: constants(formula, &|_, op, args| op.apply(args)),
            rounded: constants(formula, &|_, op, args| {
                Half::default().apply(op, args.map(f16::from_f32)).to_f32()
            }),
            known: HashMap::new(),
            depth: 0,
        };
        sides
            && self.program.outputs.iter().zip(&formula.outputs).all(|(&code, &formula)| {
                comparison.same(Term::Value(code), Term::Value(formula), false, self.in_half)
            })
    }
}

/// Returns the values of instructions that depend on no input.
fn constants(
    program: &Program,
    apply: &dyn Fn(usize, Op, [f32; MAX_ARITY]) -> f32,
) -> Vec<Option<f32>> {
    let mut values: Vec<Option<f32>> = Vec::with_capacity(program.instrs.len());
    for (i, instr) in program.instrs.iter().enumerate() {
        let mut args = [0.0; MAX_ARITY];
        let known = args.iter_mut().zip(instr.args()).all(|(to, &arg)| {
            let value = match arg {
                Arg::Input(_) => None,
                Arg::Const(i) => Some(program.consts[usize::from(i)]),
                Arg::Result(i) => values[usize::from(i)],
            };
            *to = value.unwrap_or(0.0);
            value.is_some()
        });
        values.push(known.then(|| apply(i, instr.op(), args)));
    }
    values
}

/// A value, or the product in a multiply-add.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Term {
    Value(Arg),
    Product(u16),
}

/// The computation of a term.
enum View {
    Input(u16),
    /// Terms, each with whether it is subtracted.
    Sum([(Term, bool); 2]),
    Product([Term; 2]),
    /// Dividend and divisor; without a dividend, a reciprocal.
    Quotient(Option<Term>, Term),
    Other(Op, Vec<Term>),
    Constant,
}

struct Comparison<'a> {
    code: &'a ReadBack,
    formula: &'a Program,
    code_constants: Vec<Option<f32>>,
    /// The formula's constants, in single precision and in halves.
    singles: Vec<Option<f32>>,
    rounded: Vec<Option<f32>>,
    known: HashMap<(Term, Term, bool, bool), bool>,
    depth: usize,
}

/// The deepest nesting that is compared: more than anyone writes, and no stack overflow.
const MAX_DEPTH: usize = 2000;

impl Comparison<'_> {
    /// Returns true if the code's term is the formula's, or its negative, where halves or singles
    /// read it.
    fn same(&mut self, code: Term, formula: Term, negative: bool, half: bool) -> bool {
        let (code, flipped) = self.bare(code);
        let (formula, turned) = stripped(self.formula, &self.singles, formula);
        let negative = negative ^ flipped ^ turned;
        let key = (code, formula, negative, half);
        if let Some(&known) = self.known.get(&key) {
            return known;
        }
        self.depth += 1;
        let same = self.depth < MAX_DEPTH && self.compared(code, formula, negative, half);
        self.depth -= 1;
        self.known.insert(key, same);
        same
    }

    /// Strips operations that only round a term.
    fn bare(&self, term: Term) -> (Term, bool) {
        let (mut term, mut negative) = stripped(&self.code.program, &self.code_constants, term);
        while let Term::Value(Arg::Result(i)) = term {
            let instr = &self.code.program.instrs[usize::from(i)];
            if self.code.precisions[usize::from(i)] != Precision::Rounding {
                break;
            }
            let (inner, flipped) =
                stripped(&self.code.program, &self.code_constants, Term::Value(instr.args()[0]));
            (term, negative) = (inner, negative ^ flipped);
        }
        (term, negative)
    }

    /// Returns the formula's constant term as operations of singles or of halves compute it.
    fn numbers(&self, term: Term) -> Vec<f32> {
        let Term::Product(i) = term else {
            let known =
                [&self.singles, &self.rounded].map(|known| value(self.formula, known, term));
            return known.into_iter().flatten().collect();
        };
        let args = self.formula.instrs[usize::from(i)].args();
        let [a, b] = [args[0], args[1]].map(|arg| self.numbers(Term::Value(arg)));
        let in_half = |x: f32| f16::from_f32(x).to_f32();
        let pairs = a.iter().flat_map(|&a| b.iter().map(move |&b| (a, b)));
        pairs.flat_map(|(a, b)| [a * b, in_half(a) * in_half(b)]).collect()
    }

    fn compared(&mut self, code: Term, formula: Term, negative: bool, half: bool) -> bool {
        let reads_halves = match code {
            Term::Value(Arg::Result(i)) | Term::Product(i) => {
                self.code.precisions[usize::from(i)] != Precision::Single
            }
            Term::Value(_) => half,
        };
        let code_value = value(&self.code.program, &self.code_constants, code);
        let single = value(self.formula, &self.singles, formula);
        let products = matches!((code, formula), (Term::Product(_), Term::Product(_)));
        match (code_value, single) {
            (Some(found), Some(_)) if !products => {
                let numbers = self.numbers(formula);
                return numbers.into_iter().any(|number| is_number(found, number, negative, half));
            }
            (None, None) => {}
            _ if products => {}
            _ => return false,
        }
        let views = (view(&self.code.program, code), view(self.formula, formula));
        let mut all = |pairs: &[(Term, Term, bool)]| {
            pairs
                .iter()
                .all(|&(code, formula, negative)| self.same(code, formula, negative, reads_halves))
        };
        match views {
            (View::Input(a), View::Input(b)) => a == b && !negative,
            (View::Sum([a, b]), View::Sum([c, d])) => {
                let pair = |x: (Term, bool), y: (Term, bool)| (x.0, y.0, negative ^ x.1 ^ y.1);
                all(&[pair(a, c), pair(b, d)]) || all(&[pair(a, d), pair(b, c)])
            }
            (View::Product([a, b]), View::Product([c, d])) => {
                [(c, d), (d, c)].into_iter().any(|(c, d)| {
                    [false, true]
                        .into_iter()
                        .any(|sign| all(&[(a, c, sign), (b, d, sign ^ negative)]))
                })
            }
            (View::Quotient(a, b), View::Quotient(c, d)) => match (a, c) {
                (None, None) => all(&[(b, d, negative)]),
                (Some(a), Some(c)) => [false, true]
                    .into_iter()
                    .any(|sign| all(&[(a, c, sign), (b, d, sign ^ negative)])),
                // A reciprocal is a quotient of 1.
                (Some(one), None) => {
                    let one = value(&self.code.program, &self.code_constants, one);
                    one.is_some_and(|one| one.abs() == 1.0)
                        && self.same(b, d, negative ^ (one < Some(0.0)), reads_halves)
                }
                (None, Some(one)) => {
                    let one = value(self.formula, &self.singles, one);
                    one.is_some_and(|one| one.abs() == 1.0)
                        && self.same(b, d, negative ^ (one < Some(0.0)), reads_halves)
                }
            },
            (View::Other(op, args), View::Other(other, others)) if op == other && !negative => {
                let pairs = |order: &[usize]| -> Vec<(Term, Term, bool)> {
                    order.iter().enumerate().map(|(i, &k)| (args[i], others[k], false)).collect()
                };
                match op {
                    Op::Min | Op::Max => all(&pairs(&[0, 1])) || all(&pairs(&[1, 0])),
                    _ => all(&pairs(&[0, 1, 2, 3][..args.len()])),
                }
            }
            _ => false,
        }
    }
}

/// Returns true if the code's number is the formula's.
fn is_number(found: f32, number: f32, negative: bool, half: bool) -> bool {
    let in_half = |x: f32| f16::from_f32(x).to_f32();
    let found = if negative { -found } else { found };
    let equal = |a: f32, b: f32| a == b || a.is_nan() && b.is_nan();
    equal(found, number) || half && equal(in_half(found), in_half(number))
}

/// Strips the signs before a term, unless it is a number.
fn stripped(program: &Program, constants: &[Option<f32>], mut term: Term) -> (Term, bool) {
    let mut negative = false;
    while let Term::Value(Arg::Result(i)) = term {
        let instr = &program.instrs[usize::from(i)];
        if instr.op() != Op::Neg || constants[usize::from(i)].is_some() {
            break;
        }
        term = Term::Value(instr.args()[0]);
        negative = !negative;
    }
    (term, negative)
}

/// Returns the term's value, if it depends on no input.
fn value(program: &Program, constants: &[Option<f32>], term: Term) -> Option<f32> {
    match term {
        Term::Value(Arg::Input(_)) => None,
        Term::Value(Arg::Const(i)) => Some(program.consts[usize::from(i)]),
        Term::Value(Arg::Result(i)) => constants[usize::from(i)],
        Term::Product(i) => {
            let args = program.instrs[usize::from(i)].args();
            let [a, b] = [args[0], args[1]].map(|arg| value(program, constants, Term::Value(arg)));
            Some(a? * b?)
        }
    }
}

fn view(program: &Program, term: Term) -> View {
    let (i, product) = match term {
        Term::Value(Arg::Input(i)) => return View::Input(i),
        Term::Value(Arg::Const(_)) => return View::Constant,
        Term::Value(Arg::Result(i)) => (i, false),
        Term::Product(i) => (i, true),
    };
    let instr = &program.instrs[usize::from(i)];
    let args: Vec<Term> = instr.args().iter().map(|&arg| Term::Value(arg)).collect();
    match instr.op() {
        Op::Mad if product => View::Product([args[0], args[1]]),
        Op::Mad => View::Sum([(Term::Product(i), false), (args[2], false)]),
        Op::Add => View::Sum([(args[0], false), (args[1], false)]),
        Op::Sub => View::Sum([(args[0], false), (args[1], true)]),
        Op::Mul => View::Product([args[0], args[1]]),
        Op::Rcp => View::Quotient(None, args[0]),
        Op::Div => View::Quotient(Some(args[0]), args[1]),
        op => View::Other(op, args),
    }
}
