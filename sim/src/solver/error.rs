//! Why the solver could not be made or could not go on.

use thiserror::Error;
use vitriol_gpu::GpuError;
use vitriol_shaders::ShaderError;

/// An error of the solver.
#[derive(Debug, Error)]
pub enum SolverError {
    /// The device or its driver refused.
    #[error("the particle solver's device failed")]
    Gpu(#[from] GpuError),
    /// A pass could not be compiled.
    #[error("a pass of the particle solver could not be compiled")]
    Shader(#[from] ShaderError),
    /// More particles than can be counted.
    #[error("{0} particles are more than 32 bits count: use a larger spacing")]
    TooManyParticles(usize),
    /// A state that was taken of another scene or setting.
    #[error(
        "the state holds {found} words of {what} where this scene has {expected}: restore it into the scene and preset it was taken from"
    )]
    OtherState {
        /// Which part of the state.
        what: &'static str,
        /// Words in the state.
        found: usize,
        /// Words in this scene.
        expected: usize,
    },
}
