//! Errors of shaders and of requests to compile them.

/// An error in a WGSL file, or in a request to compile it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ShaderError {
    /// A WGSL file is wrong at a known place: an include that leads nowhere or in a circle, a
    /// syntax error, or a module that does not validate. Mend the named line.
    #[error("{file}:{line}:{column}: {message}")]
    Source {
        /// Path of the original (not the expanded) file, relative to the `wgsl` folder.
        file: String,
        /// Line in that file, from 1.
        line: u32,
        /// Column in that line in bytes, from 1.
        column: u32,
        /// What is wrong there.
        message: String,
    },
    /// No file of that path is in the library. Add it under `shaders/wgsl`.
    #[error("there is no shader '{path}' in the library: add it under shaders/wgsl")]
    UnknownShader {
        /// The path asked for, relative to the `wgsl` folder.
        path: String,
    },
    /// The shader has no entry point of that name. Use one of those listed.
    #[error("{shader} has no entry point '{entry}': it has {known}")]
    MissingEntry {
        /// Path of the shader.
        shader: String,
        /// The entry point asked for.
        entry: String,
        /// Names of those that exist, separated by commas.
        known: String,
    },
    /// The shader declares no override constant of that name. Use one of those listed.
    #[error("{shader} has no override constant '{name}': it has {known}")]
    UnknownConstant {
        /// Path of the shader.
        shader: String,
        /// The constant that was given a value.
        name: String,
        /// Names of those that exist, separated by commas.
        known: String,
    },
    /// An override constant without a default was given no value, or one that its type cannot
    /// hold. Give a value that fits.
    #[error("{shader}, entry point '{entry}': {message}: give the constant a value that fits")]
    Constant {
        /// Path of the shader.
        shader: String,
        /// The entry point being compiled.
        entry: String,
        /// What is wrong with the value.
        message: String,
    },
    /// A changed file binds something more or less than the program gives it, or gives a buffer
    /// another layout than the Rust struct that was generated when the program was built. Build
    /// the program anew.
    #[error("{shader}: the declaration of '{variable}' changed: build the program anew")]
    Layout {
        /// Path of the shader.
        shader: String,
        /// The buffer or immediate variable.
        variable: String,
    },
    /// The file has no line `const NAME: f32 = NUMBER;` with that name, or more than one. Name one that it has.
    #[error(
        "{file} has not exactly one line 'const {name}: f32 = NUMBER;': name a constant that it has"
    )]
    NoNumber {
        /// Path of the file, relative to the `wgsl` folder.
        file: String,
        /// The constant asked for.
        name: String,
    },
    /// The shader is valid as written, but not with these override constants, or naga cannot
    /// write it as SPIR-V. Change the constants or the construct named in the message.
    #[error("{shader}, entry point '{entry}', cannot be specialised: {message}")]
    Specialise {
        /// Path of the shader.
        shader: String,
        /// The entry point being compiled.
        entry: String,
        /// naga's message.
        message: String,
    },
    /// [`Compiled::spirv`](crate::Compiled::spirv) is no SPIR-V module, so that it cannot be changed. Take it from
    /// [`Library::compile`](crate::Library::compile).
    #[error("{shader}: its SPIR-V cannot be read ({message}): compile it from WGSL")]
    Spirv {
        /// Shader and entry point.
        shader: String,
        /// The parser's message.
        message: String,
    },
}
