//! The resources that an entry point really uses, read from the validated module.

use naga::valid::ModuleInfo;
use naga::{AddressSpace, ArraySize, ImageClass, Module, Scalar, StorageAccess, TypeInner};

pub use naga::{ImageDimension, StorageFormat};

/// The pipeline stage of an entry point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// `@vertex`
    Vertex,
    /// `@fragment`
    Fragment,
    /// `@compute`
    Compute,
}

/// A resource that an entry point uses.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Binding {
    /// `@group`, Vulkan's descriptor set.
    pub group: u32,
    /// `@binding` in that group.
    pub binding: u32,
    /// The variable's name in WGSL.
    pub name: String,
    /// The kind of resource that is to be bound.
    pub kind: BindingKind,
    /// The format in which its elements can be read, where it is an array that is only read;
    /// see [`crate::Compiled::with_texels`].
    pub texel: Option<TexelFormat>,
}

/// The kind of resource that a binding takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BindingKind {
    /// A storage buffer.
    Storage {
        /// Whether it is declared `var<storage, read_write>` (the declaration counts, not
        /// whether a write is reached).
        writable: bool,
    },
    /// A storage texel buffer, to which [`crate::Compiled::with_texels`] changes a read-only storage buffer.
    Texels(TexelFormat),
    /// A uniform buffer.
    Uniform {
        /// Its size in bytes.
        bytes: u32,
    },
    /// An image that is sampled or loaded from.
    SampledImage {
        /// 1D, 2D, 3D or cube.
        dimension: ImageDimension,
        /// Whether it has layers.
        arrayed: bool,
        /// Whether it has several samples a texel.
        multisampled: bool,
        /// Whether it is a depth texture.
        depth: bool,
    },
    /// An image that is loaded from and stored to without a sampler.
    StorageImage {
        /// 1D, 2D or 3D.
        dimension: ImageDimension,
        /// Whether it has layers.
        arrayed: bool,
        /// Format of a texel.
        format: StorageFormat,
        /// Whether it is declared `read` or `read_write`.
        readable: bool,
        /// Whether it is declared `write` or `read_write`.
        writable: bool,
    },
    /// A sampler.
    Sampler {
        /// Whether it compares with a reference value.
        comparison: bool,
    },
}

/// Format of a texel of a texel buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TexelFormat {
    /// Its scalars.
    pub kind: TexelKind,
    /// How many of them: 1, 2 or 4.
    pub components: u32,
}

/// Scalars of a texel, 32 bits each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TexelKind {
    /// `f32`
    Float,
    /// `u32`
    Uint,
    /// `i32`
    Sint,
}

/// The bindings that the module's only entry point uses, by group and binding, and the size in
/// bytes of its `var<immediate>` (0 without one).
///
/// # Errors
/// The name of a variable whose kind no Vulkan binding here stands for (arrays of bindings).
pub fn bindings(module: &Module, info: &ModuleInfo) -> Result<(Vec<Binding>, u32), String> {
    let used = info.get_entry_point(0);
    let mut bindings = Vec::new();
    let mut immediate_bytes = 0;
    for (handle, variable) in module.global_variables.iter() {
        if used[handle].is_empty() {
            continue;
        }
        let inner = &module.types[variable.ty].inner;
        if variable.space == AddressSpace::Immediate {
            immediate_bytes = inner.size(module.to_ctx());
        }
        let Some(place) = &variable.binding else {
            continue;
        };
        let name = variable.name.clone().unwrap_or_default();
        let Some(kind) = kind(module, variable.space, inner) else {
            return Err(name);
        };
        bindings.push(Binding {
            group: place.group,
            binding: place.binding,
            name,
            kind,
            texel: texel(module, inner)
                .filter(|_| kind == BindingKind::Storage { writable: false }),
        });
    }
    bindings.sort_by_key(|binding| (binding.group, binding.binding));
    Ok((bindings, immediate_bytes))
}

fn kind(module: &Module, space: AddressSpace, inner: &TypeInner) -> Option<BindingKind> {
    match (space, inner) {
        (_, TypeInner::BindingArray { .. }) => None,
        (AddressSpace::Storage { access }, _) => Some(BindingKind::Storage {
            writable: access.contains(StorageAccess::STORE),
        }),
        (AddressSpace::Uniform, _) => Some(BindingKind::Uniform {
            bytes: inner.size(module.to_ctx()),
        }),
        (_, &TypeInner::Sampler { comparison }) => Some(BindingKind::Sampler { comparison }),
        (
            _,
            &TypeInner::Image {
                dim: dimension,
                arrayed,
                class,
            },
        ) => match class {
            ImageClass::Sampled { multi, .. } => Some(BindingKind::SampledImage {
                dimension,
                arrayed,
                multisampled: multi,
                depth: false,
            }),
            ImageClass::Depth { multi } => Some(BindingKind::SampledImage {
                dimension,
                arrayed,
                multisampled: multi,
                depth: true,
            }),
            ImageClass::Storage { format, access } => Some(BindingKind::StorageImage {
                dimension,
                arrayed,
                format,
                readable: access.contains(StorageAccess::LOAD),
                writable: access.contains(StorageAccess::STORE),
            }),
            ImageClass::External => None,
        },
        _ => None,
    }
}

/// The format of the texels that the elements of an array without a fixed length are made of, where one fits: of a scalar or a vector
/// itself, of a structure the widest that none of its members crosses.
fn texel(module: &Module, inner: &TypeInner) -> Option<TexelFormat> {
    let &TypeInner::Array {
        base,
        size: ArraySize::Dynamic,
        stride,
    } = inner
    else {
        return None;
    };
    let TypeInner::Struct { members, .. } = &module.types[base].inner else {
        let (kind, components) = scalars(&module.types[base].inner)?;
        return (components != 3).then_some(TexelFormat { kind, components });
    };
    let members: Option<Vec<_>> = members
        .iter()
        .map(|member| scalars(&module.types[member.ty].inner))
        .collect();
    let members = members?;
    let &(first, _) = members.first()?;
    let kind = match members.iter().all(|&(kind, _)| kind == first) {
        true => first,
        false => TexelKind::Uint,
    };
    let components = match members.iter().map(|&(_, components)| components).max()? {
        1 => 1,
        2 => 2,
        _ => 4,
    };
    stride
        .is_multiple_of(4 * components)
        .then_some(TexelFormat { kind, components })
}

/// The scalars of a scalar or vector of 32 bits, and how many they are.
fn scalars(inner: &TypeInner) -> Option<(TexelKind, u32)> {
    let (scalar, components) = match *inner {
        TypeInner::Scalar(scalar) => (scalar, 1),
        TypeInner::Vector { size, scalar } => (scalar, size as u32),
        _ => return None,
    };
    let kind = match scalar {
        Scalar::F32 => TexelKind::Float,
        Scalar::U32 => TexelKind::Uint,
        Scalar::I32 => TexelKind::Sint,
        _ => return None,
    };
    Some((kind, components))
}
