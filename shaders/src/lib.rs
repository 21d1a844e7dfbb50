//! The WGSL files of Vitriol, the Rust structs reflected from them, and their compilation to
//! SPIR-V. There is no Vulkan here.
//!
//! A folder of `wgsl` mirrors one of Rust: `sim` has the passes of `sim/src/solver`, `render` with
//! its `fluid`, `hands`, `spheres` and `spray` those of `render/src`, `panel` and `mirror` one pass each. What several
//! passes share lies in `wgsl/common` and enters by a line `//!include common/folder/name.wgsl`:
//! - `maths`: no more than mathematics, for both;
//! - `liquid`: the particles, their records and Algorithm 1 (`sim/src/solver`);
//! - `chemistry`: properties that particles hold and exchange, and steam (`sim/src/chemistry`);
//! - `glass`: flasks, table and floor as the solver meets them (`sim/src/flask`);
//! - `picture`: everything that only the renderer needs.
//!
//! A buffer whose vectors hold several things is a record: the file of its name has the functions
//! that pack and unpack it.
//!
//! `build.rs` checks all files: a shader error is a cargo error with its line. For
//! `wgsl/sim/density.wgsl` there is [`ShaderId`] `sim::DENSITY`; for each struct of a buffer or of
//! `var<immediate>` there is one in [`layout`].
//!
//! A [`Library`] compiles: [`Library::compile`] takes an entry point and values for override constants, drops the branches that those rule
//! out, and returns the SPIR-V with the bindings that are left. [`Library::watching`] takes up changed files in a running development
//! build.
//!
//! Limits of naga 30: no `enable subgroups` line (the operations work without it); push constants
//! are `var<immediate>`; no float atomics in workgroup memory; `sample_mask` as an output is
//! invalid. Only `if` is folded, not `switch`, and not `select`, which evaluates both sides.

mod check;
mod compile;
mod error;
mod files;
mod fold;
mod include;
mod library;
mod number;
mod reflect;
mod reload;
mod spirv;

pub use compile::Compiled;
pub use error::ShaderError;
pub use library::Library;
pub use reflect::{
    Binding, BindingKind, ImageDimension, Stage, StorageFormat, TexelFormat, TexelKind,
};

/// Names a shader: the path of its file relative to the `wgsl` folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ShaderId(&'static str);

impl ShaderId {
    /// The shader at `path`, such as `sim/density.wgsl`. The project's own have constants.
    pub const fn new(path: &'static str) -> Self {
        Self(path)
    }

    /// The path relative to the `wgsl` folder.
    pub const fn path(&self) -> &'static str {
        self.0
    }
}

impl std::fmt::Display for ShaderId {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.0)
    }
}

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

/// The structs of buffers and immediates, generated from WGSL: same fields, same offsets.
///
/// Fields named `_pad…` are the gaps that WGSL's alignment leaves; `..Default::default()` fills
/// them. A struct that ends in a runtime-sized array is here without that array.
#[allow(
    clippy::all,
    rustdoc::all,
    reason = "names and comments are those of the WGSL files"
)]
pub mod layout {
    include!(concat!(env!("OUT_DIR"), "/layout.rs"));
}
