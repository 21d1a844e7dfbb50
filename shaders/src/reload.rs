//! Whether a changed shader still fits the program that runs.

use naga::{AddressSpace, GlobalVariable, Handle, Module, Type, TypeInner};

use crate::compile::list;
use crate::error::ShaderError;

/// Refuses a new text that the running program cannot use: an entry point is gone (an editor may
/// have emptied the file and not yet written it; an empty module is valid WGSL), a binding came,
/// went or is accessed otherwise, or a buffer has another layout than the Rust struct generated
/// from the old text.
///
/// # Errors
/// [`ShaderError::MissingEntry`], [`ShaderError::Layout`].
pub fn fits(path: &str, old: &Module, new: &Module) -> Result<(), ShaderError> {
    for entry in &old.entry_points {
        if !new.entry_points.iter().any(|e| e.name == entry.name) {
            return Err(ShaderError::MissingEntry {
                shader: path.to_owned(),
                entry: entry.name.clone(),
                known: list(new.entry_points.iter().map(|e| e.name.as_str())),
            });
        }
    }
    let known = |variable: &GlobalVariable| bound(old).any(|v| v.name == variable.name);
    let added = bound(new).find(|variable| !known(variable));
    let changed = bound(old).find(|variable| {
        let renewed = bound(new).find(|v| v.name == variable.name);
        !renewed.is_some_and(|renewed| {
            renewed.space == variable.space && same_layout(old, variable.ty, new, renewed.ty)
        })
    });
    match added.or(changed) {
        None => Ok(()),
        Some(variable) => Err(ShaderError::Layout {
            shader: path.to_owned(),
            variable: variable.name.clone().unwrap_or_default(),
        }),
    }
}

/// Resources that the program gives a shader of `module`: buffers, images, samplers and immediates.
fn bound(module: &Module) -> impl Iterator<Item = &GlobalVariable> {
    module
        .global_variables
        .iter()
        .map(|(_, variable)| variable)
        .filter(|variable| {
            variable.binding.is_some() || matches!(variable.space, AddressSpace::Immediate)
        })
}

fn same_layout(old: &Module, old_ty: Handle<Type>, new: &Module, new_ty: Handle<Type>) -> bool {
    match (&old.types[old_ty].inner, &new.types[new_ty].inner) {
        (
            TypeInner::Array { base, size, stride },
            TypeInner::Array {
                base: new_base,
                size: new_size,
                stride: new_stride,
            },
        ) => size == new_size && stride == new_stride && same_layout(old, *base, new, *new_base),
        (
            TypeInner::Struct { members, span },
            TypeInner::Struct {
                members: new_members,
                span: new_span,
            },
        ) => {
            span == new_span
                && members.len() == new_members.len()
                && members.iter().zip(new_members).all(|(a, b)| {
                    a.name == b.name && a.offset == b.offset && same_layout(old, a.ty, new, b.ty)
                })
        }
        (old, new) => old == new,
    }
}
