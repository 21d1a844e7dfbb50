//! Creation of this crate's compute pipelines.

use vitriol_gpu::{ComputePipeline, Gpu};
use vitriol_shaders::{Library, ShaderId};

use crate::RenderError;

/// The pipeline of a shader's entry point `main`, specialised by `constants`.
pub(crate) fn compute(
    gpu: &Gpu,
    library: &Library,
    shader: ShaderId,
    constants: &[(&str, f64)],
) -> Result<ComputePipeline, RenderError> {
    compute_of(gpu, library, (shader, "main"), constants)
}

/// The pipeline of a shader's entry point `entry`, specialised by `constants`; [`compute`] takes `main`.
pub(crate) fn compute_of(
    gpu: &Gpu,
    library: &Library,
    (shader, entry): (ShaderId, &str),
    constants: &[(&str, f64)],
) -> Result<ComputePipeline, RenderError> {
    let compiled = library.compile(&shader, entry, constants)?;
    Ok(ComputePipeline::new(gpu, &compiled)?)
}
