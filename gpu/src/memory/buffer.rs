//! Buffers.

use std::sync::{Arc, Mutex, PoisonError};

use ash::vk;
use bytemuck::{AnyBitPattern, NoUninit};
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::Allocation;
use vitriol_shaders::{TexelFormat, TexelKind};

use super::{Spare, allocate, free, next_id};
use crate::GpuError;
use crate::device::{Core, lock};

/// A buffer on the device; cheap to clone.
///
/// Its contents are undefined until something is written. Its memory lives
/// until the last clone is gone and the device has finished every submission
/// that uses it.
#[derive(Clone)]
pub struct Buffer {
    pub(crate) inner: Arc<BufferInner>,
}

pub(crate) struct BufferInner {
    pub(crate) id: u64,
    pub(crate) handle: vk::Buffer,
    pub(crate) label: String,
    pub(crate) bytes: u64,
    pub(crate) usage: vk::BufferUsageFlags,
    /// Whether the host may read or write it. Some drivers map other buffers too;
    /// those stay closed, so that a program which works on one device works on all.
    pub(crate) is_host: bool,
    /// Views as texels, each made when it is first asked for.
    views: Mutex<Vec<(TexelFormat, vk::BufferView)>>,
    allocation: Allocation,
    /// Whether its memory is kept for the next readback buffer of its size.
    is_kept: bool,
    core: Arc<Core>,
}

/// Bytes of `count` elements of `T`, for a buffer's size.
pub const fn bytes_of_elements<T>(count: usize) -> u64 {
    size_of::<T>() as u64 * count as u64
}

impl Buffer {
    /// A device-local buffer of at least `bytes` bytes (rounded up to a
    /// multiple of 4, and to 16 at least, so that an empty one can be bound)
    /// that compute and raster passes read and write, that copies reach, and
    /// that can hold indirect arguments or indices.
    ///
    /// # Errors
    /// [`GpuError::BufferTooLarge`] over `maxStorageBufferRange`,
    /// [`GpuError::OutOfMemory`].
    pub fn storage(core: &Arc<Core>, label: &str, bytes: u64) -> Result<Self, GpuError> {
        let mut usage = vk::BufferUsageFlags::STORAGE_BUFFER
            | vk::BufferUsageFlags::INDIRECT_BUFFER
            | vk::BufferUsageFlags::INDEX_BUFFER;
        if core.info.reads_texels {
            usage |= vk::BufferUsageFlags::STORAGE_TEXEL_BUFFER;
        }
        let limit = core.info.limits.storage_bytes;
        Self::checked(core, label, bytes, usage, limit)
    }

    /// A device-local uniform buffer.
    ///
    /// # Errors
    /// [`GpuError::BufferTooLarge`] over `maxUniformBufferRange`,
    /// [`GpuError::OutOfMemory`].
    pub fn uniform(core: &Arc<Core>, label: &str, bytes: u64) -> Result<Self, GpuError> {
        let limit = core.info.limits.uniform_bytes;
        Self::checked(
            core,
            label,
            bytes,
            vk::BufferUsageFlags::UNIFORM_BUFFER,
            limit,
        )
    }

    /// A host-visible buffer that the host writes and copies read; for data
    /// that is sent again and again. One-off data goes through
    /// `Recorder::upload`.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`].
    pub fn staging(core: &Arc<Core>, label: &str, bytes: u64) -> Result<Self, GpuError> {
        Self::new(
            core,
            label,
            bytes,
            vk::BufferUsageFlags::empty(),
            MemoryLocation::CpuToGpu,
        )
    }

    /// A host-visible buffer that copies write and the host reads; for results
    /// that come every frame. One-off results come through
    /// `Recorder::read_back`.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`].
    pub fn readback(core: &Arc<Core>, label: &str, bytes: u64) -> Result<Self, GpuError> {
        let location = MemoryLocation::GpuToCpu;
        let usage = vk::BufferUsageFlags::empty();
        match core.spares.take(rounded(bytes)) {
            Some(spare) => Ok(Self::of(core, label, spare, copied(usage), location)),
            None => Self::new(core, label, bytes, usage, location),
        }
    }

    fn checked(
        core: &Arc<Core>,
        label: &str,
        bytes: u64,
        usage: vk::BufferUsageFlags,
        limit: u64,
    ) -> Result<Self, GpuError> {
        if bytes > limit {
            return Err(GpuError::BufferTooLarge {
                label: label.to_owned(),
                bytes,
                limit,
            });
        }
        Self::new(core, label, bytes, usage, MemoryLocation::GpuOnly)
    }

    pub(crate) fn new(
        core: &Arc<Core>,
        label: &str,
        bytes: u64,
        usage: vk::BufferUsageFlags,
        location: MemoryLocation,
    ) -> Result<Self, GpuError> {
        let (bytes, usage) = (rounded(bytes), copied(usage));
        let (sharing, families) = core.sharing();
        let create = vk::BufferCreateInfo::default()
            .size(bytes)
            .usage(usage)
            .sharing_mode(sharing)
            .queue_family_indices(families);
        // SAFETY: the device is alive; size and usage are valid.
        let handle = unsafe { core.device.create_buffer(&create, None) }
            .map_err(GpuError::vulkan("vkCreateBuffer"))?;
        // SAFETY: `handle` was just made.
        let requirements = unsafe { core.device.get_buffer_memory_requirements(handle) };
        let bind = |allocation: Allocation| {
            // SAFETY: the memory is of this device, large enough and not used
            // by anything else; the buffer has none yet.
            unsafe {
                core.device
                    .bind_buffer_memory(handle, allocation.memory(), allocation.offset())
            }
            .map_err(GpuError::vulkan("vkBindBufferMemory"))
            .map(|()| allocation)
        };
        let allocation = allocate(core, label, requirements, location, true)
            .and_then(bind)
            // SAFETY: nothing uses the buffer.
            .inspect_err(|_| unsafe { core.device.destroy_buffer(handle, None) })?;
        let made = Spare {
            handle,
            allocation,
            bytes,
        };
        Ok(Self::of(core, label, made, usage, location))
    }

    /// A buffer from its handle and memory.
    fn of(
        core: &Arc<Core>,
        label: &str,
        made: Spare,
        usage: vk::BufferUsageFlags,
        location: MemoryLocation,
    ) -> Self {
        core.name(made.handle, label);
        Self {
            inner: Arc::new(BufferInner {
                id: next_id(),
                handle: made.handle,
                label: label.to_owned(),
                bytes: made.bytes,
                usage,
                is_host: location != MemoryLocation::GpuOnly,
                views: Mutex::default(),
                allocation: made.allocation,
                is_kept: location == MemoryLocation::GpuToCpu,
                core: core.clone(),
            }),
        }
    }

    /// Size in bytes, as rounded up at its making.
    pub fn bytes(&self) -> u64 {
        self.inner.bytes
    }

    /// Label given at its making.
    pub fn label(&self) -> &str {
        &self.inner.label
    }

    /// Raw handle, for a library that shares the device.
    pub fn handle(&self) -> vk::Buffer {
        self.inner.handle
    }

    /// Whether `other` is the same buffer.
    pub fn is(&self, other: &Self) -> bool {
        self.inner.id == other.inner.id
    }

    /// Writes a staging buffer from its start. The caller sees to it that no
    /// unfinished submission reads it.
    ///
    /// # Errors
    /// [`GpuError::NotHostVisible`], [`GpuError::OutOfRange`].
    pub fn write_host<T: NoUninit>(&self, data: &[T]) -> Result<(), GpuError> {
        self.inner.write_at(0, bytemuck::cast_slice(data))
    }

    /// Reads the first `count` elements of a readback buffer. The caller sees
    /// to it that the submission that wrote it has finished.
    ///
    /// # Errors
    /// [`GpuError::NotHostVisible`], [`GpuError::OutOfRange`].
    pub fn read_host<T: AnyBitPattern>(&self, count: usize) -> Result<Vec<T>, GpuError> {
        self.inner.read_at(0, count)
    }
}

impl BufferInner {
    /// Whether `bytes` bytes from `offset` are inside.
    pub(crate) fn check(&self, offset: u64, bytes: u64) -> Result<(), GpuError> {
        match offset.checked_add(bytes) {
            Some(end) if end <= self.bytes => Ok(()),
            _ => Err(GpuError::OutOfRange {
                label: self.label.clone(),
                offset,
                bytes,
                size: self.bytes,
            }),
        }
    }

    /// As [`Self::check`], at multiples of 4.
    pub(crate) fn check_word(&self, offset: u64, bytes: u64) -> Result<(), GpuError> {
        if offset.is_multiple_of(4) && bytes.is_multiple_of(4) {
            return self.check(offset, bytes);
        }
        Err(GpuError::OutOfRange {
            label: self.label.clone(),
            offset,
            bytes,
            size: self.bytes,
        })
    }

    /// The whole buffer as texels.
    pub(crate) fn texels(&self, format: TexelFormat) -> Result<vk::BufferView, GpuError> {
        let mut views = lock(&self.views);
        if let Some((_, view)) = views.iter().find(|(known, _)| *known == format) {
            return Ok(*view);
        }
        let limit = self.core.info.limits.texels * 4 * u64::from(format.components);
        if self.bytes > limit {
            return Err(GpuError::BufferTooLarge {
                label: self.label.clone(),
                bytes: self.bytes,
                limit,
            });
        }
        let create = vk::BufferViewCreateInfo::default()
            .buffer(self.handle)
            .format(texel_format(format))
            .range(vk::WHOLE_SIZE);
        // SAFETY: the buffer is alive and made for this use, and as long as the
        // limit allows; where texels are read, these formats are there for it.
        let view = unsafe { self.core.device.create_buffer_view(&create, None) }
            .map_err(GpuError::vulkan("vkCreateBufferView"))?;
        views.push((format, view));
        Ok(view)
    }

    pub(crate) fn check_usage(&self, usage: vk::BufferUsageFlags) -> Result<(), GpuError> {
        if self.usage.contains(usage) {
            return Ok(());
        }
        Err(GpuError::WrongBuffer {
            label: self.label.clone(),
            usage,
        })
    }

    /// Whether indirect arguments of `bytes` bytes can lie at `offset`.
    pub(crate) fn check_indirect(&self, offset: u64, bytes: u64) -> Result<(), GpuError> {
        self.check_usage(vk::BufferUsageFlags::INDIRECT_BUFFER)?;
        self.check_word(offset, bytes)
    }

    fn mapped(&self) -> Result<*mut u8, GpuError> {
        self.allocation
            .mapped_ptr()
            .filter(|_| self.is_host)
            .map(|pointer| pointer.as_ptr().cast())
            .ok_or_else(|| GpuError::NotHostVisible {
                label: self.label.clone(),
            })
    }

    pub(crate) fn write_at(&self, offset: u64, data: &[u8]) -> Result<(), GpuError> {
        self.check(offset, data.len() as u64)?;
        let start = self.mapped()?;
        // SAFETY: the range is inside the mapping (checked above), which lives
        // as long as the buffer and is coherent. Raw bytes are copied, so a
        // device that reads meanwhile gives torn data, not undefined behaviour.
        unsafe {
            std::ptr::copy_nonoverlapping(data.as_ptr(), start.add(offset as usize), data.len());
        }
        Ok(())
    }

    pub(crate) fn read_at<T: AnyBitPattern>(
        &self,
        offset: u64,
        count: usize,
    ) -> Result<Vec<T>, GpuError> {
        let bytes = (count as u64).saturating_mul(size_of::<T>() as u64);
        self.check(offset, bytes)?;
        let start = self.mapped()?;
        let mut out = vec![T::zeroed(); count];
        // SAFETY: the range is inside the mapping, `out` has as many bytes, and
        // every bit pattern is a `T`.
        unsafe {
            std::ptr::copy_nonoverlapping(
                start.add(offset as usize),
                out.as_mut_ptr().cast::<u8>(),
                bytes as usize,
            );
        }
        Ok(out)
    }
}

impl Drop for BufferInner {
    fn drop(&mut self) {
        let views = self.views.get_mut().unwrap_or_else(PoisonError::into_inner);
        for (_, view) in views.drain(..) {
            // SAFETY: recorders and submissions hold clones until the device has
            // finished; this was the last.
            unsafe { self.core.device.destroy_buffer_view(view, None) };
        }
        let own = Spare {
            handle: self.handle,
            allocation: std::mem::take(&mut self.allocation),
            bytes: self.bytes,
        };
        let gone = match self.is_kept {
            true => self.core.spares.put(own),
            false => vec![own],
        };
        gone.into_iter().for_each(|spare| spare.destroy(&self.core));
    }
}

impl Spare {
    /// Frees handle and memory.
    pub(crate) fn destroy(mut self, core: &Core) {
        // SAFETY: nobody holds the buffer any more, and the device has finished what used it.
        unsafe { core.device.destroy_buffer(self.handle, None) };
        free(core, &mut self.allocation);
    }
}

/// Size of a buffer that is asked for with `bytes`.
fn rounded(bytes: u64) -> u64 {
    bytes.next_multiple_of(4).max(16)
}

/// This usage with copies.
fn copied(usage: vk::BufferUsageFlags) -> vk::BufferUsageFlags {
    usage | vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST
}

fn texel_format(format: TexelFormat) -> vk::Format {
    use TexelKind::{Float, Sint, Uint};
    match (format.kind, format.components) {
        (Float, 1) => vk::Format::R32_SFLOAT,
        (Float, 2) => vk::Format::R32G32_SFLOAT,
        (Float, _) => vk::Format::R32G32B32A32_SFLOAT,
        (Uint, 1) => vk::Format::R32_UINT,
        (Uint, 2) => vk::Format::R32G32_UINT,
        (Uint, _) => vk::Format::R32G32B32A32_UINT,
        (Sint, 1) => vk::Format::R32_SINT,
        (Sint, 2) => vk::Format::R32G32_SINT,
        (Sint, _) => vk::Format::R32G32B32A32_SINT,
    }
}
