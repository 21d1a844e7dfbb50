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
    let compiled = library.compile(&shader, "main", constants)?;
    Ok(ComputePipeline::new(gpu, &compiled)?)
}
