//! Recording of one submission, pass by pass.

mod binder;
mod bundle;
mod copy_image;
mod pass;
mod raster;
mod submit;
mod transfer;

pub use bundle::Bundle;
pub use pass::Pass;
pub use raster::{Draw, Raster};
pub use transfer::{CopyRegion, Readback};

use crate::submission::Storage;
use crate::{ComputePipeline, Gpu, GpuError};

/// Records one submission. Resources that it uses live until the device has finished; dropped without submission, nothing happens on the
/// device.
pub struct Recorder {
    gpu: Gpu,
    queue: usize,
    /// Whether raster scopes may be recorded.
    graphics: bool,
    storage: Box<Storage>,
}

impl Recorder {
    /// A compute pass: name what it reads and writes, then its size.
    pub fn pass<'r>(&'r mut self, pipeline: &'r ComputePipeline) -> Pass<'r> {
        Pass::new(&mut self.storage, &pipeline.inner)
    }

    /// Puts what `f` records under one debug label.
    ///
    /// # Errors
    /// Those of `f`.
    pub fn group<T>(
        &mut self,
        label: &str,
        f: impl FnOnce(&mut Self) -> Result<T, GpuError>,
    ) -> Result<T, GpuError> {
        self.storage.open_label(label.as_bytes());
        let result = f(self);
        self.storage.close_label();
        result
    }
}
