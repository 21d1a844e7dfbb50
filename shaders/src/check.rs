//! Parsing and validation by naga, with errors led back to the original file and line.

use std::error::Error;

use naga::valid::{Capabilities, ModuleInfo, ValidationError, ValidationFlags, Validator};
use naga::{Module, SourceLocation, Span, WithSpan};

use crate::error::ShaderError;
use crate::include::Expanded;

/// A valid module, its override constants still open.
#[derive(Debug)]
pub struct Checked {
    /// naga's intermediate representation, without the names of `let`s.
    pub module: Module,
    /// Results of its validation.
    pub info: ModuleInfo,
}

/// Features that a shader may use: all that naga's SPIR-V writer can write, except pipelines and types that this project does not have
/// (rays, meshes, cooperative matrices).
pub fn capabilities() -> Capabilities {
    naga::back::spv::supported_capabilities()
        - Capabilities::RAY_QUERY
        - Capabilities::RAY_HIT_VERTEX_POSITION
        - Capabilities::RAY_TRACING_PIPELINE
        - Capabilities::ACCELERATION_STRUCTURE_BINDING_ARRAY
        - Capabilities::MESH_SHADER
        - Capabilities::MESH_SHADER_POINT_TOPOLOGY
        - Capabilities::PER_VERTEX
        - Capabilities::COOPERATIVE_MATRIX
}

/// Parses and validates an expanded shader.
///
/// # Errors
/// [`ShaderError::Source`] with the place in the original file.
pub fn check(source: &Expanded) -> Result<Checked, ShaderError> {
    let mut module = naga::front::wgsl::parse_str(&source.text).map_err(|error| {
        let mut message = error.message().to_owned();
        let label = error.labels().next().map(|(_, label)| label.to_owned());
        for note in label.into_iter().chain(error.notes().map(str::to_owned)) {
            if !note.is_empty() {
                message.push_str("; ");
                message.push_str(&note);
            }
        }
        at(source, error.location(&source.text), message)
    })?;
    let info = Validator::new(ValidationFlags::all(), capabilities())
        .validate(&module)
        .map_err(|error| {
            let location = error.location(&source.text);
            let location = location.or_else(|| entry_location(error.as_inner(), &source.text));
            at(source, location, validation_message(&error))
        })?;
    forget_let_names(&mut module);
    Ok(Checked { module, info })
}

/// Drops the names of `let`s. They are for people only (the order of evaluation lies in the Emit
/// statements), but naga's `compact` takes a named expression for used, also in a dead branch,
/// and copying them is a good part of the time that specialising takes.
fn forget_let_names(module: &mut Module) {
    let functions = module.functions.iter_mut().map(|(_, function)| function);
    let entry_points = module.entry_points.iter_mut().map(|e| &mut e.function);
    for function in functions.chain(entry_points) {
        function.named_expressions.clear();
    }
}

/// naga's validation error with its causes, outermost first, in one line.
pub fn validation_message(error: &WithSpan<ValidationError>) -> String {
    let mut message = error.as_inner().to_string();
    let mut cause = error.as_inner().source();
    while let Some(inner) = cause {
        message.push_str(": ");
        message.push_str(&inner.to_string());
        cause = inner.source();
    }
    if let Some((_, label)) = error.spans().next() {
        message.push_str("; ");
        message.push_str(label);
    }
    message
}

/// naga gives no place for an entry point whose arguments or result are wrong.
fn entry_location(error: &ValidationError, text: &str) -> Option<SourceLocation> {
    let ValidationError::EntryPoint { name, .. } = error else {
        return None;
    };
    let start = text.find(&format!("fn {name}("))?;
    Some(Span::from(start..start).location(text))
}

fn at(source: &Expanded, location: Option<SourceLocation>, message: String) -> ShaderError {
    let (line, column) = location.map_or((1, 1), |l| (l.line_number, l.line_position));
    let (file, line) = source.origin(line);
    ShaderError::Source {
        file: file.to_owned(),
        line,
        column,
        message,
    }
}
