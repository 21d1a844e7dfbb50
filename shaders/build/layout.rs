//! Rust structs from naga's layouts.
//!
//! Only 32-bit scalars and what is made of them have a Rust type here. Every gap is an explicit
//! field, so that the structs are plain data (`bytemuck::Pod`), and every offset is asserted.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::comments::{Comments, comments};
use naga::{
    AddressSpace, ArraySize, Handle, Module, Scalar, ScalarKind, StructMember, Type, TypeInner,
    VectorSize,
};

/// One shader, as its structs are read from it.
#[derive(Clone, Copy)]
pub struct Shader<'a> {
    /// Path, for messages.
    pub file: &'a str,
    /// The expanded text, for comments.
    pub text: &'a str,
    /// The parsed text, for layouts.
    pub module: &'a Module,
}

/// The structs met so far, from one file after another.
#[derive(Default)]
pub struct Layouts {
    structs: BTreeMap<String, Generated>,
}

struct Generated {
    /// The definition without comments, by which two files' structs are compared.
    layout: String,
    code: String,
    file: String,
}

impl Layouts {
    /// Adds the structs that the uniform, storage and immediate variables of a module hold.
    ///
    /// # Errors
    /// A sentence, where a struct has a field without a Rust type or differs from one of the
    /// same name in another file.
    pub fn add(&mut self, shader: Shader) -> Result<(), String> {
        for (_, variable) in shader.module.global_variables.iter() {
            if matches!(
                variable.space,
                AddressSpace::Uniform | AddressSpace::Storage { .. } | AddressSpace::Immediate
            ) {
                self.visit(shader, variable.ty)?;
            }
        }
        Ok(())
    }

    /// The source text of all structs.
    pub fn code(&self) -> String {
        self.structs.values().map(|s| s.code.as_str()).collect()
    }

    fn visit(&mut self, shader: Shader, ty: Handle<Type>) -> Result<(), String> {
        match &shader.module.types[ty].inner {
            TypeInner::Array { base, .. } | TypeInner::BindingArray { base, .. } => {
                self.visit(shader, *base)
            }
            TypeInner::Struct { members, span } => {
                for member in members {
                    self.visit(shader, member.ty)?;
                }
                self.add_struct(shader, ty, members, *span)
            }
            _ => Ok(()),
        }
    }

    fn add_struct(
        &mut self,
        shader: Shader,
        ty: Handle<Type>,
        members: &[StructMember],
        span: u32,
    ) -> Result<(), String> {
        let name = shader.module.types[ty].name.clone().unwrap_or_default();
        let comments = comments(shader.text, &name);
        let fields =
            fields(shader.module, &comments, members, span).map_err(|e| format!("{name}.{e}"))?;
        let Some((fields, size)) = fields else {
            return Ok(());
        };
        let layout: String = fields
            .iter()
            .map(|f| format!("{}: {} @{}\n", f.name, f.ty, f.offset))
            .collect();
        if let Some(known) = self.structs.get(&name) {
            if known.layout != layout {
                return Err(format!(
                    "struct {name} is not the one of {}: give them one definition in common/, or \
                     two names",
                    known.file
                ));
            }
            return Ok(());
        }
        let generated = Generated {
            code: definition(shader.file, &comments, &name, &fields, size),
            layout,
            file: shader.file.to_owned(),
        };
        self.structs.insert(name, generated);
        Ok(())
    }
}

struct Field {
    name: String,
    ty: String,
    offset: u32,
    /// Lines of the comment; none marks padding.
    comment: Vec<String>,
}

/// Fields with padding between, and the size; `None` for a struct of nothing but a
/// runtime-sized array.
fn fields(
    module: &Module,
    comments: &Comments,
    members: &[StructMember],
    span: u32,
) -> Result<Option<(Vec<Field>, u32)>, String> {
    let mut fields = Vec::new();
    let mut end = 0;
    let mut size = span;
    for member in members {
        let name = member.name.clone().unwrap_or_default();
        pad(&mut fields, &mut end, member.offset);
        if let TypeInner::Array {
            size: ArraySize::Dynamic,
            ..
        } = module.types[member.ty].inner
        {
            size = member.offset;
            break;
        }
        let (ty_name, bytes) =
            rust_type(module, member.ty).map_err(|message| format!("{name}: {message}"))?;
        let comment = comments
            .fields
            .get(&name)
            .cloned()
            .unwrap_or_else(|| vec![format!(" Offset {} bytes.", member.offset)]);
        fields.push(Field {
            name: raw_identifier(&name),
            ty: ty_name,
            offset: member.offset,
            comment,
        });
        end = member.offset + bytes;
    }
    pad(&mut fields, &mut end, size);
    Ok((size > 0).then_some((fields, size)))
}

fn pad(fields: &mut Vec<Field>, end: &mut u32, to: u32) {
    if to > *end {
        fields.push(Field {
            name: format!("_pad{end}"),
            ty: format!("[u32; {}]", (to - *end) / 4),
            offset: *end,
            comment: Vec::new(),
        });
        *end = to;
    }
}

/// The Rust type and its size in bytes.
fn rust_type(module: &Module, ty: Handle<Type>) -> Result<(String, u32), String> {
    let ty = &module.types[ty];
    match ty.inner {
        TypeInner::Scalar(scalar) | TypeInner::Atomic(scalar) => Ok((rust_scalar(scalar)?, 4)),
        TypeInner::Vector { size, scalar } => {
            let n = size as u32;
            Ok((format!("[{}; {n}]", rust_scalar(scalar)?), 4 * n))
        }
        TypeInner::Matrix {
            columns,
            rows,
            scalar,
        } => {
            // A column of three is followed by a gap.
            let rows = if rows == VectorSize::Tri {
                4
            } else {
                rows as u32
            };
            let columns = columns as u32;
            let column = format!("[{}; {rows}]", rust_scalar(scalar)?);
            Ok((format!("[{column}; {columns}]"), 4 * rows * columns))
        }
        TypeInner::Array {
            base,
            size: ArraySize::Constant(count),
            stride,
        } => {
            let element = match module.types[base].inner {
                TypeInner::Vector {
                    size: VectorSize::Tri,
                    scalar,
                } => format!("[{}; 4]", rust_scalar(scalar)?),
                _ => {
                    let (element, bytes) = rust_type(module, base)?;
                    if bytes != stride {
                        return Err(format!(
                            "array elements of {bytes} bytes every {stride} bytes"
                        ));
                    }
                    element
                }
            };
            Ok((format!("[{element}; {count}]"), stride * count.get()))
        }
        TypeInner::Struct { span, .. } => Ok((ty.name.clone().unwrap_or_default(), span)),
        ref other => Err(format!("no Rust type stands for {other:?}")),
    }
}

fn rust_scalar(scalar: Scalar) -> Result<String, String> {
    let name = match (scalar.kind, scalar.width) {
        (ScalarKind::Float, 4) => "f32",
        (ScalarKind::Sint, 4) => "i32",
        (ScalarKind::Uint, 4) => "u32",
        _ => return Err(format!("no Rust type stands for {scalar:?}")),
    };
    Ok(name.to_owned())
}

fn definition(file: &str, comments: &Comments, name: &str, fields: &[Field], size: u32) -> String {
    let mut code = String::new();
    for line in &comments.own {
        let _ = writeln!(code, "#[doc = {line:?}]");
    }
    if comments.own.is_empty() {
        let _ = writeln!(code, "#[doc = \" `{name}` of `{file}`, {size} bytes.\"]");
    }
    code.push_str("#[repr(C)]\n");
    code.push_str("#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]\n");
    let _ = writeln!(code, "pub struct {name} {{");
    for field in fields {
        if field.comment.is_empty() {
            code.push_str("    #[doc(hidden)]\n");
        }
        for line in &field.comment {
            let _ = writeln!(code, "    #[doc = {line:?}]");
        }
        let _ = writeln!(code, "    pub {}: {},", field.name, field.ty);
    }
    let _ = writeln!(
        code,
        "}}\nimpl Default for {name} {{\n    /// All zeros.\n    fn default() -> Self {{\n        \
         bytemuck::Zeroable::zeroed()\n    }}\n}}"
    );
    let _ = writeln!(
        code,
        "const _: () = assert!(size_of::<{name}>() == {size});"
    );
    for field in fields {
        let _ = writeln!(
            code,
            "const _: () = assert!(core::mem::offset_of!({name}, {}) == {});",
            field.name, field.offset
        );
    }
    code
}

/// Rust's keywords are reserved in WGSL too, but for these.
fn raw_identifier(name: &str) -> String {
    if ["box", "dyn", "gen", "in"].contains(&name) {
        format!("r#{name}")
    } else {
        name.to_owned()
    }
}
