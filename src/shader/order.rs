//! The order of functions: after those that they call, which GLSL does not demand of its prototypes.

use naga::{Arena, Block, Expression, Function, Handle, Module, Span, Statement};
use std::collections::HashSet;

/// Puts each function after those that it calls.
///
/// # Errors
/// The place of a function that calls itself, by way of others, too; and what to say of it.
pub(super) fn ordered(mut module: Module) -> Result<Module, (Span, String)> {
    let called = module.functions.iter().map(|(_, function)| {
        let mut called = HashSet::new();
        calls(&function.body, &mut called);
        let mut called: Vec<usize> = called.into_iter().map(Handle::index).collect();
        called.sort_unstable();
        called
    });
    let called: Vec<Vec<usize>> = called.collect();
    let is_ordered = called.iter().enumerate().all(|(at, called)| called.iter().all(|c| *c < at));
    if is_ordered {
        return Ok(module);
    }
    let handles: Vec<Handle<Function>> = module.functions.iter().map(|(h, _)| h).collect();
    let order = after_called(&called).map_err(|at| {
        let function = handles[at];
        let name = module.functions[function].name.as_deref().unwrap_or("a function");
        let message = format!("`{name}` calls itself: no shading language has recursion");
        (module.functions.get_span(function), message)
    })?;
    let mut functions = Arena::new();
    let mut new = vec![handles[0]; handles.len()];
    for at in order {
        let function = std::mem::take(&mut module.functions[handles[at]]);
        new[at] = functions.append(function, module.functions.get_span(handles[at]));
    }
    module.functions = functions;
    let all = module.functions.iter_mut().map(|(_, function)| function);
    for function in all.chain(module.entry_points.iter_mut().map(|point| &mut point.function)) {
        redirect(function, &new);
    }
    Ok(module)
}

/// Returns the indices such that each stands after those that it calls; the index of one that calls
/// itself, if any does.
fn after_called(called: &[Vec<usize>]) -> Result<Vec<usize>, usize> {
    let mut order = Vec::with_capacity(called.len());
    let (mut begun, mut done) = (vec![false; called.len()], vec![false; called.len()]);
    for start in 0..called.len() {
        // Chains of calls may be longer than a stack is deep.
        let mut under_way = vec![(start, 0)];
        while let Some((at, next)) = under_way.pop() {
            if done[at] {
                continue;
            }
            begun[at] = true;
            match called[at].get(next) {
                Some(&callee) => {
                    under_way.push((at, next + 1));
                    if begun[callee] && !done[callee] {
                        return Err(callee);
                    }
                    under_way.push((callee, 0));
                }
                None => {
                    done[at] = true;
                    order.push(at);
                }
            }
        }
    }
    Ok(order)
}

/// Collects the functions that a block calls.
pub(super) fn calls(block: &Block, called: &mut HashSet<Handle<Function>>) {
    for statement in block.iter() {
        if let Statement::Call { function, .. } = statement {
            called.insert(*function);
        }
        blocks(statement).into_iter().for_each(|block| calls(block, called));
    }
}

/// Returns the number of blocks within each other, where they are most.
pub(super) fn deepest(module: &Module) -> usize {
    let functions = module.functions.iter().map(|(_, function)| function);
    let all = functions.chain(module.entry_points.iter().map(|point| &point.function));
    all.map(|function| depth(&function.body)).max().unwrap_or(0)
}

fn depth(block: &Block) -> usize {
    1 + block.iter().flat_map(blocks).map(depth).max().unwrap_or(0)
}

/// Returns the blocks within a statement.
pub(super) fn blocks(statement: &Statement) -> Vec<&Block> {
    match statement {
        Statement::Block(block) => vec![block],
        Statement::If { accept, reject, .. } => vec![accept, reject],
        Statement::Switch { cases, .. } => cases.iter().map(|case| &case.body).collect(),
        Statement::Loop { body, continuing, .. } => vec![body, continuing],
        _ => Vec::new(),
    }
}

/// Has calls reach functions at their new places.
fn redirect(function: &mut Function, new: &[Handle<Function>]) {
    for (_, expression) in function.expressions.iter_mut() {
        if let Expression::CallResult(called) = expression {
            *called = new[called.index()];
        }
    }
    redirect_calls(&mut function.body, new);
}

fn redirect_calls(block: &mut Block, new: &[Handle<Function>]) {
    for statement in block.iter_mut() {
        match statement {
            Statement::Call { function, .. } => *function = new[function.index()],
            Statement::Block(block) => redirect_calls(block, new),
            Statement::If { accept, reject, .. } => {
                redirect_calls(accept, new);
                redirect_calls(reject, new);
            }
            Statement::Switch { cases, .. } => {
                cases.iter_mut().for_each(|case| redirect_calls(&mut case.body, new));
            }
            Statement::Loop { body, continuing, .. } => {
                redirect_calls(body, new);
                redirect_calls(continuing, new);
            }
            _ => {}
        }
    }
}
