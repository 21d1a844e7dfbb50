//! A raster scope: one colour target, then draws into it, each one expression.

use std::sync::Arc;

use ash::vk;
use bytemuck::NoUninit;

use super::Recorder;
use super::binder::{Asked, Binder};
use crate::barrier::Scope;
use crate::pipeline::RasterInner;
use crate::submission::{DrawCommand, Storage};
use crate::{Buffer, GpuError, Image, RasterPipeline};

/// An open raster scope.
pub struct Raster<'r> {
    storage: &'r mut Storage,
    target: &'r Image,
}

impl Recorder {
    /// Fills `target`, an image of one layer, with the colour `clear` and draws the draws that `f` records over it. All draws of a scope
    /// come after all passes before it. `label` appears in timings, markers and debuggers.
    ///
    /// # Errors
    /// [`GpuError::Raster`] where the target does not fit the queue or the
    /// draws; those of `f`, and then nothing is drawn.
    pub fn raster(
        &mut self,
        label: &str,
        target: &Image,
        clear: [f32; 4],
        f: impl FnOnce(&mut Raster<'_>) -> Result<(), GpuError>,
    ) -> Result<(), GpuError> {
        let refuse = |cause: String| GpuError::Raster {
            pass: label.to_owned(),
            cause,
        };
        if !self.graphics {
            let cause = "recorded for the async queue; use QueueKind::Main";
            return Err(refuse(cause.to_owned()));
        }
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT;
        if !target.desc().usage.contains(usage) {
            return Err(refuse(format!(
                "image \"{}\" was not made for {usage:?}",
                target.label()
            )));
        }
        if target.desc().layers != 1 {
            return Err(refuse(format!(
                "image \"{}\" has {} layers; draw to an image of one",
                target.label(),
                target.desc().layers
            )));
        }
        let storage = &mut *self.storage;
        storage.clear_pass();
        let layout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
        storage.use_image(target, layout, Scope::COLOUR, true)?;
        f(&mut Raster { storage, target })?;
        storage.open_pass(label.as_bytes())?;
        storage.begin_rendering(target, clear);
        storage.replay_draws();
        // SAFETY: rendering was begun above.
        unsafe { storage.core.device.cmd_end_rendering(storage.cmd) };
        storage.close_pass()
    }
}

impl Raster<'_> {
    /// A draw: name what it reads, then its vertices.
    pub fn draw<'d>(&'d mut self, pipeline: &'d RasterPipeline) -> Draw<'d> {
        let inner = &pipeline.inner;
        let mut binder = Binder::new(self.storage, &inner.layout, inner.label.as_bytes());
        if inner.format != self.target.desc().format {
            let error = GpuError::Raster {
                pass: binder.label_text(),
                cause: "the pipeline was made for another format than the scope's target"
                    .to_owned(),
            };
            binder.fail(error);
        }
        Draw {
            storage: self.storage,
            pipeline: inner,
            binder,
        }
    }
}

/// A draw in the making; as [`crate::Pass`], and ends with its vertices.
#[must_use = "a draw is recorded by its size: indexed"]
pub struct Draw<'d> {
    storage: &'d mut Storage,
    pipeline: &'d Arc<RasterInner>,
    binder: Binder<'d>,
}

impl Draw<'_> {
    /// A storage buffer that the shaders declare `read`.
    pub fn read(mut self, name: &str, buffer: &Buffer) -> Self {
        self.binder.buffer(self.storage, name, buffer, Asked::Read);
        self
    }

    /// The shaders' `var<immediate>`, of exactly its size.
    pub fn constants<T: NoUninit>(mut self, value: &T) -> Self {
        self.binder.constants(self.storage, value);
        self
    }

    /// Draws `count` vertices, whose numbers are 32-bit values in `indices`.
    ///
    /// # Errors
    /// [`GpuError::Binding`], [`GpuError::Constants`], [`GpuError::Raster`],
    /// [`GpuError::OutOfRange`].
    pub fn indexed(mut self, indices: &Buffer, count: u32) -> Result<(), GpuError> {
        indices.inner.check(0, 4 * u64::from(count))?;
        indices
            .inner
            .check_usage(vk::BufferUsageFlags::INDEX_BUFFER)?;
        self.binder.check(self.storage)?;
        self.storage.use_buffer(indices, Scope::INDEX);
        self.storage.retain(self.pipeline.clone());
        self.storage.draws.push(DrawCommand {
            pipeline: self.pipeline.handle,
            push: self.pipeline.layout.push(),
            descriptors: self.binder.descriptors,
            constants: self.binder.constants,
            indices: indices.inner.handle,
            count,
        });
        Ok(())
    }
}

impl Storage {
    fn begin_rendering(&self, target: &Image, clear: [f32; 4]) {
        let [width, height] = target.desc().extent;
        let colours = [vk::RenderingAttachmentInfo::default()
            .image_view(target.inner.plain_view)
            .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::STORE)
            .clear_value(vk::ClearValue {
                color: vk::ClearColorValue { float32: clear },
            })];
        let area = vk::Rect2D::default().extent(vk::Extent2D { width, height });
        let info = vk::RenderingInfo::default()
            .render_area(area)
            .layer_count(1)
            .color_attachments(&colours);
        let viewport = vk::Viewport {
            x: 0.0,
            y: 0.0,
            width: width as f32,
            height: height as f32,
            min_depth: 0.0,
            max_depth: 1.0,
        };
        // SAFETY: the buffer is recording, the image is held by the storage, in
        // the named layout and made for this use.
        unsafe {
            let device = &self.core.device;
            device.cmd_begin_rendering(self.cmd, &info);
            device.cmd_set_viewport(self.cmd, 0, &[viewport]);
            device.cmd_set_scissor(self.cmd, 0, &[area]);
        }
    }
}
