//! A compute pass as one expression.

use std::sync::Arc;

use ash::vk;
use bytemuck::NoUninit;

use super::binder::{Asked, Binder};
use crate::barrier::Scope;
use crate::pipeline::ComputeInner;
use crate::submission::Storage;
use crate::{Buffer, GpuError, Image, Sampler};

/// A compute pass in the making: name every binding of the shader once, give its immediates if it has any, and end with its size, which
/// returns the first mistake.
#[must_use = "a pass is recorded by its size: invocations, workgroups or indirect"]
pub struct Pass<'r> {
    storage: &'r mut Storage,
    pipeline: &'r Arc<ComputeInner>,
    binder: Binder<'r>,
}

impl<'r> Pass<'r> {
    pub(crate) fn new(storage: &'r mut Storage, pipeline: &'r Arc<ComputeInner>) -> Self {
        storage.clear_pass();
        let binder = Binder::new(storage, &pipeline.layout, pipeline.label.as_bytes());
        Self {
            storage,
            pipeline,
            binder,
        }
    }

    /// Replaces the shader's label in timings, markers, debuggers and messages.
    pub fn label(mut self, label: &'r str) -> Self {
        self.binder.set_label(label.as_bytes());
        self
    }

    /// A storage buffer that the shader declares `read`.
    pub fn read(mut self, name: &str, buffer: &Buffer) -> Self {
        self.binder.buffer(self.storage, name, buffer, Asked::Read);
        self
    }

    /// A storage buffer that the shader declares `read_write`; counts as both.
    pub fn write(mut self, name: &str, buffer: &Buffer) -> Self {
        self.binder.buffer(self.storage, name, buffer, Asked::Write);
        self
    }

    /// A uniform buffer.
    pub fn uniform(mut self, name: &str, buffer: &Buffer) -> Self {
        self.binder
            .buffer(self.storage, name, buffer, Asked::Uniform);
        self
    }

    /// An image that the shader samples or loads from as a texture.
    pub fn sampled(mut self, name: &str, image: &Image) -> Self {
        self.binder.image(self.storage, name, image, false);
        self
    }

    /// An image that the shader declares `texture_storage_…`.
    pub fn storage_image(mut self, name: &str, image: &Image) -> Self {
        self.binder.image(self.storage, name, image, true);
        self
    }

    /// A sampler.
    pub fn sampler(mut self, name: &str, sampler: &Sampler) -> Self {
        self.binder.sampler(self.storage, name, sampler);
        self
    }

    /// The shader's `var<immediate>`, of exactly its size.
    pub fn constants<T: NoUninit>(mut self, value: &T) -> Self {
        self.binder.constants(self.storage, value);
        self
    }

    /// Invocations of a workgroup along x.
    pub fn workgroup_size(&self) -> u32 {
        self.pipeline.workgroup_size[0]
    }

    /// Records the pass with at least `count` invocations along x: whole
    /// workgroups, so the shader leaves out those past `count`. None for 0.
    ///
    /// # Errors
    /// [`GpuError::Binding`], [`GpuError::Constants`],
    /// [`GpuError::TooManyWorkgroups`].
    pub fn invocations(self, count: u32) -> Result<(), GpuError> {
        let groups = count.div_ceil(self.pipeline.workgroup_size[0].max(1));
        self.workgroups([groups, 1, 1])
    }

    /// As [`Pass::invocations`], along x and y, for passes over an image.
    ///
    /// # Errors
    /// As [`Pass::invocations`].
    pub fn invocations_2d(self, extent: [u32; 2]) -> Result<(), GpuError> {
        let size = self.pipeline.workgroup_size;
        self.workgroups([
            extent[0].div_ceil(size[0].max(1)),
            extent[1].div_ceil(size[1].max(1)),
            1,
        ])
    }

    /// Records the pass with this many workgroups.
    ///
    /// # Errors
    /// As [`Pass::invocations`].
    pub fn workgroups(mut self, groups: [u32; 3]) -> Result<(), GpuError> {
        self.binder.check(self.storage)?;
        let limit = self.storage.core.info.limits.workgroups;
        if groups
            .iter()
            .zip(limit)
            .any(|(count, limit)| *count > limit)
        {
            return Err(GpuError::TooManyWorkgroups {
                pass: self.binder.label_text(),
                groups,
                limit,
            });
        }
        if groups.contains(&0) {
            self.storage.clear_pass();
            return Ok(());
        }
        self.bind()?;
        // SAFETY: pipeline, descriptors and immediates are bound, the
        // resources are held by the storage, the size is within the limits.
        unsafe {
            self.storage.core.device.cmd_dispatch(
                self.storage.cmd,
                groups[0],
                groups[1],
                groups[2],
            );
        }
        self.storage.close_pass()
    }

    /// Records the pass with the workgroups that three 32-bit values at
    /// `offset` in `arguments` hold when the device gets there.
    ///
    /// # Errors
    /// As [`Pass::invocations`], and [`GpuError::OutOfRange`].
    pub fn indirect(mut self, arguments: &Buffer, offset: u64) -> Result<(), GpuError> {
        self.binder.check(self.storage)?;
        arguments.inner.check_indirect(offset, 12)?;
        self.storage.use_buffer(arguments, Scope::INDIRECT);
        self.bind()?;
        // SAFETY: as in `workgroups`; the arguments lie in a buffer made for
        // them, at a multiple of 4.
        unsafe {
            self.storage.core.device.cmd_dispatch_indirect(
                self.storage.cmd,
                arguments.inner.handle,
                offset,
            );
        }
        self.storage.close_pass()
    }

    fn bind(&mut self) -> Result<(), GpuError> {
        let label = self.binder.label();
        self.storage.open_pass(label)?;
        let pipeline = self.pipeline;
        if self.storage.bound != pipeline.handle {
            self.storage.bound = pipeline.handle;
            self.storage.retain(pipeline.clone());
            // SAFETY: the buffer is recording; the pipeline is held.
            unsafe {
                self.storage.core.device.cmd_bind_pipeline(
                    self.storage.cmd,
                    vk::PipelineBindPoint::COMPUTE,
                    pipeline.handle,
                );
            }
        }
        self.storage.bind(
            &pipeline.layout.push(),
            self.binder.descriptors,
            self.binder.constants,
        );
        Ok(())
    }
}
