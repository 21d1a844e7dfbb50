//! Replaces every `if` whose condition is constant by the branch that is taken.
//!
//! After override constants are applied, a pipeline's switches (`if HEAT { ... }`) are constants.
//! The driver would drop the dead branch too, but only after the bindings in it were demanded of
//! the pipeline's layout; dropped here, a pipeline holds only what its scene asks for.

use std::collections::HashMap;

use naga::{
    Arena, BinaryOperator, Block, Constant, Expression, Function, Handle, Literal, LocalVariable,
    Module, Span, Statement, TypeInner, UnaryOperator,
};

/// Folds all functions and entry points of a module without open override constants. The result
/// is valid, but still holds what only dead branches used: naga's `compact` removes that, given
/// that no `let` has a name.
pub fn fold_constant_ifs(module: &mut Module) {
    let mut functions = std::mem::take(&mut module.functions);
    for (_, function) in functions.iter_mut() {
        fold_function(module, function);
    }
    module.functions = functions;
    let mut entry_points = std::mem::take(&mut module.entry_points);
    for entry in &mut entry_points {
        fold_function(module, &mut entry.function);
    }
    module.entry_points = entry_points;
}

fn fold_function(module: &Module, function: &mut Function) {
    let body = std::mem::take(&mut function.body);
    let mut folder = Folder {
        module,
        expressions: &function.expressions,
        locals: &function.local_variables,
        known: HashMap::new(),
    };
    function.body = folder.block(body).0;
}

struct Folder<'a> {
    module: &'a Module,
    expressions: &'a Arena<Expression>,
    locals: &'a Arena<LocalVariable>,
    /// naga lowers `a && b` to `var t: bool; if a { t = b } else { t = false }` and a load of
    /// `t`, and `||` likewise. For each such `t`: the one constant that all its live stores hold,
    /// or `None` where they differ. All stores to a `t` stand before all loads of it, so one
    /// pass in the order of the text sees them in time, in loops too.
    known: HashMap<Handle<LocalVariable>, Option<bool>>,
}

impl Folder<'_> {
    /// The folded block, and whether control never runs past its end.
    fn block(&mut self, block: Block) -> (Block, bool) {
        let mut out = Block::with_capacity(block.len());
        for (statement, span) in block.span_into_iter() {
            if self.statement(statement, span, &mut out) {
                // The rest of the block is dead, and its bindings must not be kept.
                return (out, true);
            }
        }
        (out, false)
    }

    fn statement(&mut self, statement: Statement, span: Span, out: &mut Block) -> bool {
        let (statement, ends) = match statement {
            Statement::If {
                condition,
                accept,
                reject,
            } => match self.value(condition) {
                Some(taken) => {
                    let (mut taken, ends) = self.block(if taken { accept } else { reject });
                    out.append(&mut taken);
                    return ends;
                }
                None => {
                    let (accept, accept_ends) = self.block(accept);
                    let (reject, reject_ends) = self.block(reject);
                    let folded = Statement::If {
                        condition,
                        accept,
                        reject,
                    };
                    (folded, accept_ends && reject_ends)
                }
            },
            Statement::Block(block) => {
                let (block, ends) = self.block(block);
                (Statement::Block(block), ends)
            }
            Statement::Switch {
                selector,
                mut cases,
            } => {
                for case in &mut cases {
                    case.body = self.block(std::mem::take(&mut case.body)).0;
                }
                (Statement::Switch { selector, cases }, false)
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => {
                let body = self.block(body).0;
                let continuing = self.block(continuing).0;
                let folded = Statement::Loop {
                    body,
                    continuing,
                    break_if,
                };
                (folded, false)
            }
            Statement::Store { pointer, value } => {
                self.note_store(pointer, value);
                (Statement::Store { pointer, value }, false)
            }
            end @ (Statement::Return { .. }
            | Statement::Kill
            | Statement::Break
            | Statement::Continue) => (end, true),
            other => (other, false),
        };
        out.push(statement, span);
        ends
    }

    fn note_store(&mut self, pointer: Handle<Expression>, value: Handle<Expression>) {
        if let Expression::LocalVariable(local) = self.expressions[pointer]
            && self.is_operand(local)
        {
            let value = self.value(value);
            self.known
                .entry(local)
                .and_modify(|known| {
                    if *known != value {
                        *known = None;
                    }
                })
                .or_insert(value);
        }
    }

    /// Whether a local variable is one that naga made for `&&` or `||`: those of WGSL have names.
    fn is_operand(&self, local: Handle<LocalVariable>) -> bool {
        let local = &self.locals[local];
        local.name.is_none() && local.init.is_none()
    }

    fn value(&self, expression: Handle<Expression>) -> Option<bool> {
        match self.expressions[expression] {
            Expression::Load { pointer } => match self.expressions[pointer] {
                Expression::LocalVariable(local) => self.known.get(&local).copied().flatten(),
                _ => None,
            },
            ref expression => constant(expression, self.module, &|inner| self.value(inner)),
        }
    }
}

/// The value of a Boolean expression where it is constant. naga evaluates most of these when it
/// applies the override constants; what is left are those over the operands of `&&` and `||`.
fn constant(
    expression: &Expression,
    module: &Module,
    value: &dyn Fn(Handle<Expression>) -> Option<bool>,
) -> Option<bool> {
    match *expression {
        Expression::Literal(Literal::Bool(value)) => Some(value),
        Expression::ZeroValue(ty) => match module.types[ty].inner {
            TypeInner::Scalar(scalar) if scalar.kind == naga::ScalarKind::Bool => Some(false),
            _ => None,
        },
        Expression::Constant(handle) => {
            let Constant { init, .. } = module.constants[handle];
            global_value(module, init)
        }
        Expression::Unary {
            op: UnaryOperator::LogicalNot,
            expr,
        } => value(expr).map(|value| !value),
        Expression::Binary { op, left, right } => {
            let (left, right) = (value(left), value(right));
            match op {
                BinaryOperator::LogicalAnd | BinaryOperator::And => match (left, right) {
                    (Some(false), _) | (_, Some(false)) => Some(false),
                    (Some(true), Some(true)) => Some(true),
                    _ => None,
                },
                BinaryOperator::LogicalOr | BinaryOperator::InclusiveOr => match (left, right) {
                    (Some(true), _) | (_, Some(true)) => Some(true),
                    (Some(false), Some(false)) => Some(false),
                    _ => None,
                },
                BinaryOperator::Equal => Some(left? == right?),
                BinaryOperator::NotEqual => Some(left? != right?),
                _ => None,
            }
        }
        _ => None,
    }
}

fn global_value(module: &Module, expression: Handle<Expression>) -> Option<bool> {
    constant(&module.global_expressions[expression], module, &|inner| {
        global_value(module, inner)
    })
}
