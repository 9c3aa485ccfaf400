//! Functions of matrices.

use super::interpreter::Interpreter;
use super::machine::{Machine, Reason};
use super::math::wrong_arguments;
use super::value::Value;
use crate::op::Op;
use naga::MathFunction;

impl<M: Machine> Interpreter<'_, '_, M> {
    pub fn of_matrix(
        &mut self,
        function: MathFunction,
        matrix: &Value<M>,
    ) -> Result<Value<M>, Reason> {
        let Value::Several(columns) = matrix else { return Err(wrong_arguments()) };
        let columns: Vec<Vec<M::Float>> =
            columns.iter().map(Value::floats).collect::<Result<_, _>>()?;
        match function {
            MathFunction::Transpose => {
                let row = |i: usize| {
                    let row: Vec<_> = columns.iter().map(|column| column[i]).collect();
                    Value::of_floats(&row)
                };
                Ok(Value::Several((0..columns[0].len()).map(row).collect()))
            }
            MathFunction::Determinant => {
                Ok(Value::of_floats(&[determinant(&mut *self.machine, &columns)?]))
            }
            _ => {
                let determinant = determinant(&mut *self.machine, &columns)?;
                let inverse = self.machine.unary(Op::Rcp, determinant)?;
                let size = columns.len();
                let mut adjugate = Vec::with_capacity(size);
                for i in 0..size {
                    let mut column = Vec::with_capacity(size);
                    for j in 0..size {
                        let cofactor = cofactor(&mut *self.machine, &columns, j, i)?;
                        column.push(self.machine.binary(Op::Mul, cofactor, inverse)?);
                    }
                    adjugate.push(Value::of_floats(&column));
                }
                Ok(Value::Several(adjugate))
            }
        }
    }
}

/// Expands by the first column.
fn determinant<M: Machine>(machine: &mut M, columns: &[Vec<M::Float>]) -> Result<M::Float, Reason> {
    if columns.len() == 1 {
        return Ok(columns[0][0]);
    }
    let mut sum = None;
    for row in 0..columns.len() {
        let cofactor = cofactor(machine, columns, 0, row)?;
        sum = Some(match sum {
            None => machine.binary(Op::Mul, columns[0][row], cofactor)?,
            Some(sum) => machine.apply(Op::Mad, [columns[0][row], cofactor, sum, sum])?,
        });
    }
    sum.ok_or_else(wrong_arguments)
}

fn cofactor<M: Machine>(
    machine: &mut M,
    columns: &[Vec<M::Float>],
    column: usize,
    row: usize,
) -> Result<M::Float, Reason> {
    let others = columns.iter().enumerate().filter(|(index, _)| *index != column);
    let minor: Vec<Vec<M::Float>> = others
        .map(|(_, c)| {
            let rest = c.iter().enumerate().filter(|(index, _)| *index != row);
            rest.map(|(_, &value)| value).collect()
        })
        .collect();
    if minor.is_empty() {
        return Ok(machine.float(1.0));
    }
    let value = determinant(machine, &minor)?;
    match (row + column).is_multiple_of(2) {
        true => Ok(value),
        false => machine.unary(Op::Neg, value),
    }
}
