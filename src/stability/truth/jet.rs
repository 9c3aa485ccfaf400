//! Evaluates programs over boxes in real numbers, with first and second derivatives by the inputs.

use super::local::Local;
use crate::num::Span;
use crate::op::Op;
use crate::program::{Arg, Program};

/// How many derivatives to take.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Order {
    Value,
    Slopes,
    Curvatures,
}

/// A value over a box, its slopes along each of `n` inputs and, row by row, its `n(n + 1)/2`
/// curvatures, as far as they were asked for. The slopes are generalised gradients: across a kink,
/// all between those on either side. The mean-value theorem holds for them.
pub(super) type Jet = Vec<Span>;

/// The jets of a program's inputs and instructions over one box.
#[derive(Clone, Debug)]
pub(super) struct Jets {
    inputs: usize,
    order: Order,
    length: usize,
    values: Vec<Span>,
    scratch: [Jet; 4],
    /// The results within an operation that is made of others.
    steps: [Jet; 2],
}

/// Returns where the curvature by inputs `i ≤ j` of `n` stands among a jet's.
pub(super) fn curvature(n: usize, i: usize, j: usize) -> usize {
    1 + n + i * n - i * (i + 1) / 2 + j
}

impl Jets {
    pub fn new(inputs: usize, order: Order) -> Jets {
        let length = match order {
            Order::Value => 1,
            Order::Slopes => 1 + inputs,
            Order::Curvatures => 1 + inputs + inputs * (inputs + 1) / 2,
        };
        let jet = || vec![Span::ZERO; length];
        let (scratch, steps) = ([jet(), jet(), jet(), jet()], [jet(), jet()]);
        Jets { inputs, order, length, values: Vec::new(), scratch, steps }
    }

    /// Evaluates a program over a box; `constants` stand in place of its own. Returns the jet of
    /// its output of the index.
    pub fn evaluate(
        &mut self,
        program: &Program,
        constants: &[f64],
        domain: &[Span],
        output: usize,
    ) -> Jet {
        self.values.clear();
        for i in 0..program.instrs.len() {
            let instr = program.instrs[i];
            let mut args = std::mem::take(&mut self.scratch);
            for (to, &arg) in args.iter_mut().zip(instr.args()) {
                self.load(arg, constants, domain, to);
            }
            let same = instr.args().len() > 1 && instr.args()[0] == instr.args()[1];
            self.instruction(instr.op(), &args, same);
            self.scratch = args;
        }
        let mut jet = vec![Span::ZERO; self.length];
        self.load(program.outputs[output], constants, domain, &mut jet);
        jet
    }

    fn load(&self, arg: Arg, constants: &[f64], domain: &[Span], to: &mut Jet) {
        match arg {
            Arg::Result(i) => {
                let start = usize::from(i) * self.length;
                to.copy_from_slice(&self.values[start..start + self.length]);
            }
            Arg::Const(i) => {
                to.fill(Span::ZERO);
                to[0] = Span::point(constants[usize::from(i)]);
            }
            Arg::Input(i) => {
                to.fill(Span::ZERO);
                to[0] = domain[usize::from(i)];
                if self.order >= Order::Slopes {
                    to[1 + usize::from(i)] = Span::ONE;
                }
            }
        }
    }

    /// Appends the jet of one instruction's result.
    fn instruction(&mut self, op: Op, args: &[Jet; 4], same: bool) {
        let [a, b, c, d] = args;
        let mut steps = std::mem::take(&mut self.steps);
        let [first, second] = &mut steps;
        let start = self.values.len();
        self.values.resize(start + self.length, Span::ZERO);
        let mut result = std::mem::take(&mut self.values);
        let to = &mut result[start..];
        match op {
            Op::Mad => {
                self.basic(Op::Mul, a, b, same, first);
                self.basic(Op::Add, first, c, false, to);
            }
            Op::Lerp => {
                self.basic(Op::Sub, b, a, false, first);
                self.basic(Op::Mul, c, first, false, second);
                self.basic(Op::Add, a, second, false, to);
            }
            Op::Select => select(a[0], b[0], c, d, to),
            Op::Min | Op::Max => self.choice(op, a, b, to),
            Op::Add
            | Op::Sub
            | Op::Mul
            | Op::Div
            | Op::Neg
            | Op::Abs
            | Op::Saturate
            | Op::Rcp
            | Op::Sqrt
            | Op::Rsqrt
            | Op::Exp2
            | Op::Log2
            | Op::Exp
            | Op::Log
            | Op::Pow
            | Op::Sin
            | Op::Cos
            | Op::Tan
            | Op::Asin
            | Op::Acos
            | Op::Atan
            | Op::Atan2
            | Op::Tanh
            | Op::Step
            | Op::Floor
            | Op::Fract
            | Op::Sign => self.basic(op, a, b, same, to),
        }
        self.values = result;
        self.steps = steps;
    }

    /// Applies the chain rule to an operation of one or two arguments.
    fn basic(&self, op: Op, a: &[Span], b: &[Span], same: bool, to: &mut [Span]) {
        let local = Local::of(op, a[0], b[0], same);
        let Local { value, slopes: [by_a, by_b], curvatures: [aa, ab, bb] } =
            local.expect("an operation of one or two arguments");
        to[0] = value;
        let single = op.arity() == 1;
        for (to, (a, b)) in to.iter_mut().zip(a.iter().zip(b)).skip(1) {
            let first = by_a.times(*a);
            *to = if single { first } else { first.plus(by_b.times(*b)) };
        }
        if self.order < Order::Curvatures || [aa, ab, bb] == [Span::ZERO; 3] {
            return;
        }
        let n = self.inputs;
        for i in 0..n {
            for j in i..n {
                let [ai, aj, bi, bj] = [a[1 + i], a[1 + j], b[1 + i], b[1 + j]];
                let product = |x: Span, y: Span| if i == j { x.squared() } else { x.times(y) };
                let mut sum = aa.times(product(ai, aj));
                if !single {
                    let cross = match i == j {
                        true => ai.times(bi).times(Span::point(2.0)),
                        false => ai.times(bj).plus(aj.times(bi)),
                    };
                    sum = sum.plus(ab.times(cross)).plus(bb.times(product(bi, bj)));
                }
                let k = curvature(n, i, j);
                to[k] = to[k].plus(sum);
            }
        }
    }

    fn choice(&self, op: Op, a: &[Span], b: &[Span], to: &mut [Span]) {
        self.basic(op, a, b, false, to);
        let [x, y] = [a[0], b[0]];
        if x.high() <= y.low() || y.high() <= x.low() {
            return;
        }
        let n = self.inputs;
        let slopes = 1..to.len().min(1 + n);
        slopes.for_each(|k| to[k] = a[k].hull(b[k]));
        if self.order < Order::Curvatures {
            return;
        }
        // Along an input that neither depends on, there is no kink.
        let depends = |i: usize| [a, b].iter().any(|jet| jet[1 + i] != Span::ZERO);
        for i in 0..n {
            for j in i..n {
                let bends = depends(i) && depends(j);
                to[curvature(n, i, j)] = if bends { Span::ALL } else { Span::ZERO };
            }
        }
    }
}

/// Writes `yes` where `a < b`, else `no`.
fn select(a: Span, b: Span, yes: &[Span], no: &[Span], to: &mut [Span]) {
    if a.high() < b.low() {
        to.copy_from_slice(yes);
    } else if a.low() >= b.high() {
        to.copy_from_slice(no);
    } else {
        to.fill(Span::ALL);
        to[0] = yes[0].hull(no[0]);
    }
    to[0] = to[0].or_undefined_if(a.may_be_undefined() || b.may_be_undefined());
}
