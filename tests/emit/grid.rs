//! All cases as one picture, for what draws: a pixel a row, with up to four inputs and outputs.

use crate::agreement::{Case, OF_FORMULAS, Tolerance, front, operations};
use crate::text;
use lgp::emit::Language;
use lgp::op::Op;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

pub struct Grid {
    pub cases: Vec<Case>,
}

/// How a language writes the function that chooses the case of a row.
pub struct Chosen {
    /// What comes before the choices; `row` and a point `p` are its parameters.
    pub open: &'static str,
    /// A choice, by the rows of the case and its values. None is within another: drivers can have
    /// so many within each other and no more.
    pub choice: fn(rows: Range<usize>, values: &str) -> String,
    pub close: &'static str,
    /// What makes four values of fewer, and zeros.
    pub vector: &'static str,
}

impl Grid {
    /// The operations and the front, on some of its rows: what a row is, compilers do not care.
    pub fn of_all() -> Grid {
        let members = front().into_iter().enumerate().map(|(i, mut case)| {
            // The operations are called `case0` and so on, too.
            case.function = format!("member{i}");
            for column in case.inputs.iter_mut().chain(&mut case.expected) {
                *column = column.iter().copied().step_by(16).collect();
            }
            case
        });
        Grid { cases: operations().into_iter().chain(members).collect() }
    }

    /// Each case with its rows.
    pub fn with_rows(&self) -> impl Iterator<Item = (&Case, Range<usize>)> {
        let ranges = self.cases.iter().scan(0, |end, case| {
            let start = *end;
            *end += case.rows();
            Some(start..*end)
        });
        self.cases.iter().zip(ranges)
    }

    /// Takes powers of zero away.
    pub fn without_powers_of_zero(mut self) -> Grid {
        for case in self.cases.iter_mut().filter(|case| case.op == Some(Op::Pow)) {
            for (expected, &base) in case.expected[0].iter_mut().zip(&case.inputs[0]) {
                *expected = if base == 0.0 { f32::NAN } else { *expected };
            }
        }
        self
    }

    /// Writes the inputs, zeros where there are fewer than four.
    pub fn write_points(&self, path: &Path) {
        let points: Vec<f32> = (self.cases.iter())
            .flat_map(|case| (0..case.rows()).map(move |row| (case, row)))
            .flat_map(|(case, row)| {
                [0, 1, 2, 3].map(|column| case.inputs.get(column).map_or(0.0, |x| x[row]))
            })
            .collect();
        std::fs::write(path, bytemuck::cast_slice(&points)).unwrap();
    }

    /// The functions of the cases.
    pub fn functions(&self, language: Language) -> Vec<String> {
        let one = |case: &Case| text(language, &case.program, &case.names, &case.function, &[]);
        self.cases.iter().map(one).collect()
    }

    /// The function that chooses among them.
    pub fn chosen(&self, chosen: &Chosen) -> String {
        let mut code = chosen.open.to_owned();
        for (case, rows) in self.with_rows() {
            let arguments = ["p.x", "p.y", "p.z", "p.w"][..case.inputs.len()].join(", ");
            let zeros = ", 0.0".repeat(4 - case.expected.len());
            let value = format!("{}({}({arguments}){zeros})", chosen.vector, called(case));
            code += &(chosen.choice)(rows, &value);
        }
        code + chosen.close
    }

    /// The outputs of each case, of values, four a row.
    pub fn outputs(&self, path: &Path) -> Vec<Vec<Vec<f32>>> {
        let bytes = std::fs::read(path).unwrap();
        let values: Vec<f32> =
            bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
        let of = |(case, rows): (&Case, Range<usize>)| {
            let rows = &values[4 * rows.start..4 * rows.end];
            let column = |o: usize| rows.iter().skip(o).step_by(4).copied().collect();
            (0..case.expected.len()).map(column).collect()
        };
        self.with_rows().map(of).collect()
    }

    /// Compares values, four a row, and says how far they are apart.
    pub fn compare(&self, what: &str, path: &Path, tolerance: fn(Op) -> Tolerance) {
        let mut worst = [("operations", 0.0f32), ("front", 0.0)];
        let mut by_op = BTreeMap::new();
        for (case, found) in self.cases.iter().zip(self.outputs(path)) {
            let apart = case.compare(&found, case.op.map_or(OF_FORMULAS, tolerance));
            let kind = &mut worst[usize::from(case.op.is_none())].1;
            *kind = kind.max(apart);
            if let Some(op) = case.op {
                let of_op = by_op.entry(op).or_insert(apart);
                *of_op = apart.max(*of_op);
            }
        }
        for (op, apart) in by_op {
            println!("{what}, {op}: {apart:.1e} apart at most");
        }
        for (kind, apart) in worst {
            println!("{what}, {kind}: {apart:.1e} apart at most");
        }
    }
}

/// The name of the function: that of a single output ends in its name.
pub fn called(case: &Case) -> String {
    match case.names.outputs.as_slice() {
        [output] => format!("{}_{output}", case.function),
        _ => case.function.clone(),
    }
}
