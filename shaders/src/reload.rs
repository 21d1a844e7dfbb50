//! Whether a changed shader still fits the program that runs.

use naga::{AddressSpace, Handle, Module, Type, TypeInner};

use crate::compile::list;
use crate::error::ShaderError;

/// Refuses a new text that the running program cannot use: an entry point is gone (an editor may
/// have emptied the file and not yet written it; an empty module is valid WGSL), or a buffer has
/// another layout than the Rust struct generated from the old text.
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
    for (_, variable) in old.global_variables.iter() {
        if !matches!(
            variable.space,
            AddressSpace::Uniform | AddressSpace::Storage { .. } | AddressSpace::Immediate
        ) {
            continue;
        }
        let renewed = new
            .global_variables
            .iter()
            .find(|v| v.1.name == variable.name);
        if let Some((_, renewed)) = renewed
            && !same_layout(old, variable.ty, new, renewed.ty)
        {
            return Err(ShaderError::Layout {
                shader: path.to_owned(),
                variable: variable.name.clone().unwrap_or_default(),
            });
        }
    }
    Ok(())
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
