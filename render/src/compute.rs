//! How every pass of this crate gets its pipeline.

use vitriol_gpu::{ComputePipeline, Gpu};
use vitriol_shaders::{Library, ShaderId};

use crate::RenderError;

/// The pipeline of a shader, specialised by `constants`.
pub(crate) fn compute(
    gpu: &Gpu,
    library: &Library,
    shader: ShaderId,
    constants: &[(&str, f64)],
) -> Result<ComputePipeline, RenderError> {
    compute_of(gpu, library, (shader, "main"), constants)
}

/// The same of another entry point.
pub(crate) fn compute_of(
    gpu: &Gpu,
    library: &Library,
    (shader, entry): (ShaderId, &str),
    constants: &[(&str, f64)],
) -> Result<ComputePipeline, RenderError> {
    let compiled = library.compile(&shader, entry, constants)?;
    Ok(ComputePipeline::new(gpu, &compiled)?)
}
