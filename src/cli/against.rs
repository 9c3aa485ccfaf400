//! `lgp verify --against`: a function of a shader file against another, or against a formula.

use super::verify::{Args, conclude, unusable};
use super::{Common, Failure};
use crate::eval::Score;
use crate::shader::Shader;
use crate::truth::Truth;
use std::cell::RefCell;
use std::path::Path;

/// Compares a function with another, in single precision against double.
pub(super) fn run(args: &Args, common: &Common) -> Result<(), Failure> {
    // What --set and --let say of the old function, formulas for it know nothing of.
    let new = args
        .sampled
        .shader(&args.snippet, None)
        .or_else(|failed| args.sampled.shader_over_columns(&args.snippet).map_err(|_| failed))?;
    let truth = match &args.against {
        Some(old) => {
            let entry = args.against_entry.as_deref();
            args.sampled.shader(old, entry)?.truth(&args.sampled.axes()?)?
        }
        None => {
            let formula = args.sampled.formula.as_deref().unwrap_or_default();
            let outputs = args.outputs.as_deref().unwrap_or_default();
            Truth::formula(formula, outputs, &args.sampled.axes()?)?
        }
    };
    let axes: Vec<String> = truth.axes().iter().map(|axis| axis.name.to_string()).collect();
    if axes != truth.inputs() {
        let message = "--let of an input by parameters: compare functions over their parameters";
        return Err(Failure::usage(message));
    }
    let order = order_of(&new, &axes, truth.outputs(), &args.snippet)?;
    let dataset = args.sampled.dataset(&truth, common)?;
    let failed = RefCell::new(None);
    let score = Score::of_values(&dataset, |split| {
        let mut outputs = vec![Vec::with_capacity(split.rows()); order.outputs.len()];
        for row in 0..split.rows() {
            let point: Vec<f32> =
                order.inputs.iter().map(|&column| split.columns[column][row]).collect();
            let values = new.at_in_single(&point).unwrap_or_else(|error| {
                failed.borrow_mut().get_or_insert(error);
                vec![f32::NAN; order.outputs.len()]
            });
            for (output, &place) in outputs.iter_mut().zip(&order.outputs) {
                output.push(values[place]);
            }
        }
        outputs
    });
    if let Some(error) = failed.into_inner() {
        return Err(error.into());
    }
    conclude(args, &score, truth.outputs(), false, None, common)
}

/// The places of a function's inputs among columns, and of columns among its outputs.
struct Order {
    inputs: Vec<usize>,
    outputs: Vec<usize>,
}

fn order_of(
    new: &Shader,
    inputs: &[String],
    outputs: &[String],
    path: &Path,
) -> Result<Order, Failure> {
    let place = |all: &[String], name: &String| all.iter().position(|other| other == name);
    let differ = |what: &str, mine: &[String], others: &[String]| {
        let (mine, others) = (mine.join(", "), others.join(", "));
        unusable(path, &format!("{what} {mine}, but the other function {what} {others}"))
    };
    let takes: Option<Vec<usize>> = new.inputs().iter().map(|name| place(inputs, name)).collect();
    let takes = takes.filter(|takes| takes.len() == inputs.len());
    let takes = takes.ok_or_else(|| differ("takes", new.inputs(), inputs))?;
    let named: Option<Vec<usize>> = outputs.iter().map(|name| place(new.outputs(), name)).collect();
    // Functions of other names return the same in the same order.
    let in_order = (new.outputs().len() == outputs.len()).then(|| (0..outputs.len()).collect());
    let returns = named.or(in_order).ok_or_else(|| differ("returns", new.outputs(), outputs))?;
    Ok(Order { inputs: takes, outputs: returns })
}
