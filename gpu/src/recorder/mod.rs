//! Recording of one submission, pass by pass.

mod binder;
mod copy_image;
mod draw;
mod pass;
mod raster;
mod submit;
mod transfer;

use ash::vk;

pub use draw::Draw;
pub use pass::Pass;
pub use raster::{ColourTarget, DepthTarget, Load, Raster, RasterTarget};
pub use transfer::{CopyRegion, Readback};

use crate::barrier::{Scope, Use};
use crate::submission::Storage;
use crate::{Buffer, ComputePipeline, Gpu, GpuError};

/// Records one submission. What it uses lives until the device has finished;
/// dropped without submission, nothing happens on the device.
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

    /// Runs the dispatches and draws that `f` records only if the 32-bit value
    /// at `offset` in `condition` is not zero when the device gets there.
    /// Copies and fills run in any case.
    ///
    /// # Errors
    /// [`GpuError::Unsupported`] where `EnabledFeatures::conditional` is off
    /// or another condition is open; [`GpuError::OutOfRange`]; those of `f`.
    pub fn conditional<T>(
        &mut self,
        condition: &Buffer,
        offset: u64,
        f: impl FnOnce(&mut Self) -> Result<T, GpuError>,
    ) -> Result<T, GpuError> {
        let Some(functions) = self.gpu.conditional.clone() else {
            return Err(GpuError::Unsupported {
                feature: "VK_EXT_conditional_rendering",
                remedy: "use indirect dispatches whose size a pass sets to zero",
            });
        };
        if self.storage.in_condition {
            return Err(GpuError::Unsupported {
                feature: "condition within a condition",
                remedy: "combine both conditions in one value",
            });
        }
        condition.inner.check_word(offset, 4)?;
        condition
            .inner
            .check_usage(vk::BufferUsageFlags::CONDITIONAL_RENDERING_EXT)?;
        let slot = self.storage.buffer_slot(condition);
        self.storage.order(&[Use {
            slot,
            scope: Scope::CONDITIONAL,
        }]);
        let begin = vk::ConditionalRenderingBeginInfoEXT::default()
            .buffer(condition.inner.handle)
            .offset(offset);
        // SAFETY: the buffer has the usage, is held by the storage, and the
        // value lies in it at a multiple of 4; no condition is open.
        unsafe { (functions.fp().cmd_begin_conditional_rendering_ext)(self.storage.cmd, &begin) };
        self.storage.in_condition = true;
        let result = f(self);
        self.storage.in_condition = false;
        // SAFETY: the condition opened above is still open.
        unsafe { (functions.fp().cmd_end_conditional_rendering_ext)(self.storage.cmd) };
        result
    }
}
