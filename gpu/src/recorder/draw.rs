//! A draw as one expression.

use std::sync::Arc;

use ash::vk;
use bytemuck::NoUninit;

use super::binder::{Asked, Binder};
use crate::barrier::{Scope, Use};
use crate::pipeline::RasterInner;
use crate::submission::{DrawCommand, DrawCount, Storage};
use crate::{Buffer, GpuError, Image, Sampler};

/// A draw in the making; as [`crate::Pass`], and ends with its vertices.
#[must_use = "a draw is recorded by its size: vertices, instances, indexed or indirect"]
pub struct Draw<'d> {
    storage: &'d mut Storage,
    pipeline: &'d Arc<RasterInner>,
    binder: Binder<'d>,
}

impl<'d> Draw<'d> {
    pub(crate) fn new(
        storage: &'d mut Storage,
        pipeline: &'d Arc<RasterInner>,
        binder: Binder<'d>,
    ) -> Self {
        Self {
            storage,
            pipeline,
            binder,
        }
    }

    /// A storage buffer that the shaders declare `read`.
    pub fn read(mut self, name: &str, buffer: &Buffer) -> Self {
        self.binder.buffer(self.storage, name, buffer, Asked::Read);
        self
    }

    /// A storage buffer that the fragment shader declares `read_write`.
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

    /// An image that a shader samples or loads from as a texture.
    pub fn sampled(mut self, name: &str, image: &Image) -> Self {
        self.binder.image(self.storage, name, image, false);
        self
    }

    /// An image that a shader declares `texture_storage_…`.
    pub fn storage_image(mut self, name: &str, image: &Image) -> Self {
        self.binder.image(self.storage, name, image, true);
        self
    }

    /// A sampler.
    pub fn sampler(mut self, name: &str, sampler: &Sampler) -> Self {
        self.binder.sampler(self.storage, name, sampler);
        self
    }

    /// The shaders' `var<immediate>`, of exactly its size.
    pub fn constants<T: NoUninit>(mut self, value: &T) -> Self {
        self.binder.constants(self.storage, value);
        self
    }

    /// Draws vertices 0 to `count`.
    ///
    /// # Errors
    /// [`GpuError::Binding`], [`GpuError::Constants`], [`GpuError::Raster`].
    pub fn vertices(self, count: u32) -> Result<(), GpuError> {
        self.instances(count, 1)
    }

    /// Draws `vertices` vertices of each of `instances` instances.
    ///
    /// # Errors
    /// As [`Draw::vertices`].
    pub fn instances(self, vertices: u32, instances: u32) -> Result<(), GpuError> {
        self.record(DrawCount::Vertices {
            vertices,
            instances,
        })
    }

    /// Draws `count` vertices, whose numbers are 32-bit values in `indices`.
    ///
    /// # Errors
    /// As [`Draw::vertices`], and [`GpuError::OutOfRange`].
    pub fn indexed(self, indices: &Buffer, count: u32, instances: u32) -> Result<(), GpuError> {
        indices.inner.check(0, 4 * u64::from(count))?;
        indices
            .inner
            .check_usage(vk::BufferUsageFlags::INDEX_BUFFER)?;
        let slot = self.storage.buffer_slot(indices);
        self.storage.uses.push(Use {
            slot,
            scope: Scope::INDEX,
        });
        self.record(DrawCount::Indexed {
            indices: indices.inner.handle,
            count,
            instances,
        })
    }

    /// Draws what a `VkDrawIndirectCommand` (vertices, instances, first of
    /// each) at `offset` in `arguments` says when the device gets there.
    ///
    /// # Errors
    /// As [`Draw::vertices`], and [`GpuError::OutOfRange`].
    pub fn indirect(self, arguments: &Buffer, offset: u64) -> Result<(), GpuError> {
        arguments.inner.check_indirect(offset, 16)?;
        let slot = self.storage.buffer_slot(arguments);
        self.storage.uses.push(Use {
            slot,
            scope: Scope::INDIRECT,
        });
        self.record(DrawCount::Indirect {
            arguments: arguments.inner.handle,
            offset,
        })
    }

    fn record(mut self, count: DrawCount) -> Result<(), GpuError> {
        self.binder.check(self.storage)?;
        self.storage.retain(self.pipeline.clone());
        self.storage.draws.push(DrawCommand {
            pipeline: self.pipeline.handle,
            push: self.pipeline.layout.push(),
            descriptors: self.binder.descriptors,
            constants: self.binder.constants,
            count,
        });
        Ok(())
    }
}
