//! What one submission needs on the host, recycled when the device has
//! finished: command pool, resource tracking, staging memory, queries.

use std::any::Any;
use std::collections::HashMap;
use std::sync::Arc;

use ash::vk;

use super::Submission;
use super::arena::Arena;
use super::timing::{Markers, Names, Queries};
use crate::GpuError;
use crate::barrier::{Planner, Scope, Use};
use crate::device::{Core, Options, Timestamps};
use crate::memory::ImageInner;
use crate::pipeline::{DescriptorData, LayoutPush};
use crate::{Buffer, Image};

/// An image and the layout that it has at this point of the recording.
pub(crate) struct ImageState {
    pub(crate) image: Arc<ImageInner>,
    pub(crate) slot: u32,
    pub(crate) layout: vk::ImageLayout,
}

/// One image's part in the pass being recorded.
#[derive(Clone, Copy)]
pub(crate) struct ImageUse {
    /// Index into [`Storage::images`].
    pub(crate) index: usize,
    pub(crate) layout: vk::ImageLayout,
    pub(crate) scope: Scope,
    /// Whether the pass overwrites all of it.
    pub(crate) discard: bool,
}

/// A buffer that the commands use.
pub(crate) struct BufferUse {
    pub(crate) buffer: Buffer,
    /// Its number in the planner.
    slot: u32,
    /// Every way in which they access it.
    pub(crate) scope: Scope,
}

/// A draw, kept until the scope's barrier is known.
pub(crate) struct DrawCommand {
    pub(crate) pipeline: vk::Pipeline,
    pub(crate) push: LayoutPush,
    pub(crate) descriptors: usize,
    pub(crate) constants: usize,
    pub(crate) indices: vk::Buffer,
    pub(crate) count: u32,
}

/// Everything that one submission needs on the host.
pub(crate) struct Storage {
    pub(crate) core: Arc<Core>,
    pool: vk::CommandPool,
    pub(crate) cmd: vk::CommandBuffer,
    pub(crate) submission: Arc<Submission>,
    /// Whether it holds a bundle, which is executed by submissions and never submitted.
    pub(crate) is_bundle: bool,
    /// Other resources that the commands use, beside buffers and images.
    retained: Vec<Arc<dyn Any + Send + Sync>>,
    pub(crate) planner: Planner,
    pub(crate) buffers: Vec<BufferUse>,
    buffer_indices: HashMap<u64, usize>,
    pub(crate) images: Vec<ImageState>,
    image_indices: HashMap<u64, usize>,
    /// Buffer uses of the pass being recorded.
    pub(crate) uses: Vec<Use>,
    pub(crate) image_uses: Vec<ImageUse>,
    pub(crate) descriptors: Vec<DescriptorData>,
    pub(crate) constants: Vec<u8>,
    pub(crate) draws: Vec<DrawCommand>,
    pub(crate) image_barriers: Vec<vk::ImageMemoryBarrier2<'static>>,
    /// Zero-terminated copy of a label.
    pub(crate) label: Vec<u8>,
    pub(crate) arena: Arena,
    pub(crate) names: Names,
    /// Bytes of the buffers that the pass in the making binds.
    pub(crate) pass_bytes: u64,
    pub(crate) queries: Option<Queries>,
    pub(crate) markers: Option<Markers>,
    pub(crate) bound: vk::Pipeline,
    /// Whether something was copied to memory that the host reads.
    pub(crate) host_reads: bool,
}

// SAFETY: the raw pointers in `image_barriers` are null (`p_next`), and the
// handles are used under `&mut self` only.
unsafe impl Send for Storage {}

impl Storage {
    /// Storage of a submission.
    pub(crate) fn new(core: &Arc<Core>, family: u32, options: &Options) -> Result<Self, GpuError> {
        let flags = vk::CommandPoolCreateFlags::TRANSIENT;
        let mut storage = Self::of(core, family, flags, vk::CommandBufferLevel::PRIMARY)?;
        if options.timestamps != Timestamps::None && core.info.timestamp_period > 0.0 {
            let of_passes = options.timestamps == Timestamps::Passes;
            storage.queries = Some(Queries::new(of_passes));
        }
        if options.markers {
            storage.markers = Some(Markers::new(core)?);
        }
        Ok(storage)
    }

    /// Storage of a bundle. It has neither times nor markers: those are a submission's.
    pub(crate) fn of_bundle(core: &Arc<Core>, family: u32) -> Result<Self, GpuError> {
        let flags = vk::CommandPoolCreateFlags::empty();
        Self::of(core, family, flags, vk::CommandBufferLevel::SECONDARY)
    }

    fn of(
        core: &Arc<Core>,
        family: u32,
        flags: vk::CommandPoolCreateFlags,
        level: vk::CommandBufferLevel,
    ) -> Result<Self, GpuError> {
        let create = vk::CommandPoolCreateInfo::default()
            .flags(flags)
            .queue_family_index(family);
        // SAFETY: the device is alive and was made with this family.
        let pool = unsafe { core.device.create_command_pool(&create, None) }
            .map_err(GpuError::vulkan("vkCreateCommandPool"))?;
        let mut storage = Self {
            core: core.clone(),
            pool,
            cmd: vk::CommandBuffer::null(),
            submission: Submission::new(0),
            is_bundle: level == vk::CommandBufferLevel::SECONDARY,
            retained: Vec::new(),
            planner: Planner::default(),
            buffers: Vec::new(),
            buffer_indices: HashMap::new(),
            images: Vec::new(),
            image_indices: HashMap::new(),
            uses: Vec::new(),
            image_uses: Vec::new(),
            descriptors: Vec::new(),
            constants: Vec::new(),
            draws: Vec::new(),
            image_barriers: Vec::new(),
            label: Vec::new(),
            arena: Arena::default(),
            names: Names::default(),
            pass_bytes: 0,
            queries: None,
            markers: None,
            bound: vk::Pipeline::null(),
            host_reads: false,
        };
        let allocate = vk::CommandBufferAllocateInfo::default()
            .command_pool(pool)
            .level(level)
            .command_buffer_count(1);
        // SAFETY: the pool was just made.
        let buffers = unsafe { core.device.allocate_command_buffers(&allocate) }
            .map_err(GpuError::vulkan("vkAllocateCommandBuffers"))?;
        storage.cmd = buffers.first().copied().unwrap_or_default();
        Ok(storage)
    }

    /// The image's index in [`Storage::images`]; holds the image from its first use on.
    pub(crate) fn image_index(&mut self, image: &Image) -> usize {
        let inner = &image.inner;
        if let Some(index) = self.image_indices.get(&inner.id) {
            return *index;
        }
        let index = self.images.len();
        self.images.push(ImageState {
            image: inner.clone(),
            slot: self.planner.add(),
            layout: inner.home,
        });
        self.image_indices.insert(inner.id, index);
        index
    }

    /// Adds a buffer to the pass being recorded; holds the buffer from its first
    /// use on.
    pub(crate) fn use_buffer(&mut self, buffer: &Buffer, scope: Scope) {
        let index = *self
            .buffer_indices
            .entry(buffer.inner.id)
            .or_insert_with(|| {
                self.buffers.push(BufferUse {
                    buffer: buffer.clone(),
                    slot: self.planner.add(),
                    scope: Scope::NONE,
                });
                self.buffers.len() - 1
            });
        let used = &mut self.buffers[index];
        used.scope = used.scope.union(scope);
        let slot = used.slot;
        self.uses.push(Use { slot, scope });
    }

    /// Adds an image to the pass being recorded.
    pub(crate) fn use_image(
        &mut self,
        image: &Image,
        layout: vk::ImageLayout,
        scope: Scope,
        discard: bool,
    ) -> Result<(), GpuError> {
        // A layout is known within one submission only.
        if self.is_bundle {
            return Err(GpuError::Bundle(format!(
                "\"{}\" is an image",
                image.inner.label
            )));
        }
        let index = self.image_index(image);
        if let Some(used) = self.image_uses.iter_mut().find(|used| used.index == index) {
            if used.layout != layout {
                return Err(GpuError::Raster {
                    pass: image.inner.label.clone(),
                    cause: "one pass uses the image in two ways that exclude each other; use two passes or two images".to_owned(),
                });
            }
            used.scope = used.scope.union(scope);
            return Ok(());
        }
        self.image_uses.push(ImageUse {
            index,
            layout,
            scope,
            discard,
        });
        Ok(())
    }

    pub(crate) fn retain(&mut self, object: Arc<dyn Any + Send + Sync>) {
        self.retained.push(object);
    }

    /// Clears the uses of the pass being recorded.
    pub(crate) fn clear_pass(&mut self) {
        self.pass_bytes = 0;
        self.uses.clear();
        self.image_uses.clear();
        self.descriptors.clear();
        self.constants.clear();
        self.draws.clear();
    }

    /// Call it when the device has finished: reads the times, releases all resources, and prepares for the next recording.
    pub(crate) fn recycle(&mut self, timestamp_mask: u64) -> Result<(), GpuError> {
        let read = match &mut self.queries {
            Some(queries) => queries.read(&self.core, &self.names, timestamp_mask),
            None => Ok(Vec::new()),
        };
        let (timings, read) = match read {
            Ok(timings) => (timings, Ok(())),
            Err(error) => (Vec::new(), Err(error)),
        };
        // Also where reading failed: a thread that asks for the times waits for this value. It is set already only where the times were
        // read before, and then they are the same.
        let _ = self.submission.timings.set(timings);
        read?;
        if let Some(markers) = &mut self.markers {
            markers.clear(self.names.len())?;
        }
        self.clear_pass();
        self.retained.clear();
        self.planner.clear();
        self.buffers.clear();
        self.buffer_indices.clear();
        self.images.clear();
        self.image_indices.clear();
        self.arena.clear();
        self.names.clear();
        // SAFETY: the device has finished the pool's command buffer.
        unsafe {
            self.core
                .device
                .reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty())
        }
        .map_err(GpuError::vulkan("vkResetCommandPool"))
    }

    /// Label of the last pass whose marker was written.
    pub(crate) fn last_marked(&self) -> Option<String> {
        let reached = self.markers.as_ref()?.reached(self.names.len())?;
        Some(self.names.get(reached).to_owned())
    }
}

impl Drop for Storage {
    fn drop(&mut self) {
        // SAFETY: either the commands were never submitted, or the device has
        // finished them.
        unsafe { self.core.device.destroy_command_pool(self.pool, None) };
        if let Some(queries) = &mut self.queries {
            queries.destroy(&self.core);
        }
    }
}
