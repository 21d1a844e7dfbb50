//! Fills, uploads, copies and readbacks.

use std::sync::Arc;

use ash::vk;
use bytemuck::{AnyBitPattern, NoUninit};

use super::Recorder;
use crate::barrier::Scope;
use crate::submission::{Storage, Submission};
use crate::{Buffer, Gpu, GpuError, Image, ImageDesc, QueueKind, Ticket};

/// A piece of a copy, in bytes; all multiples of 4.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CopyRegion {
    /// Offset in the source.
    pub from: u64,
    /// Offset in the destination.
    pub to: u64,
    /// Number of bytes.
    pub bytes: u64,
}

/// A copy on its way to the host.
pub struct Readback {
    gpu: Gpu,
    buffer: Buffer,
    bytes: u64,
    submission: Arc<Submission>,
}

impl Readback {
    /// The bytes as elements; bytes at the end that make no whole element are
    /// left out.
    ///
    /// # Errors
    /// [`GpuError::NotDone`] before the submission has finished.
    pub fn get<T: AnyBitPattern>(&self) -> Result<Vec<T>, GpuError> {
        if !self.gpu.inner.has_finished(&self.submission)? {
            return Err(GpuError::NotDone);
        }
        let count = self.bytes.checked_div(size_of::<T>() as u64).unwrap_or(0);
        self.buffer.read_host(count as usize)
    }
}

impl Recorder {
    /// Sets every 32-bit word of `buffer` to `value`.
    ///
    /// # Errors
    /// Device failures only.
    pub fn fill(&mut self, buffer: &Buffer, value: u32) -> Result<(), GpuError> {
        let storage = &mut *self.storage;
        storage.clear_pass();
        storage.use_buffer(buffer, Scope::COPY_WRITE);
        storage.open_pass(b"fill")?;
        // SAFETY: the buffer is held and can be copied to.
        unsafe {
            storage.core.device.cmd_fill_buffer(
                storage.cmd,
                buffer.inner.handle,
                0,
                vk::WHOLE_SIZE,
                value,
            );
        }
        storage.close_pass()
    }

    /// Writes `data` to the start of `buffer`, in order with the passes around
    /// it. The data is copied at once.
    ///
    /// # Errors
    /// [`GpuError::OutOfRange`] past the buffer's end,
    /// [`GpuError::OutOfMemory`].
    pub fn upload<T: NoUninit>(&mut self, buffer: &Buffer, data: &[T]) -> Result<(), GpuError> {
        let bytes: &[u8] = bytemuck::cast_slice(data);
        buffer.inner.check(0, bytes.len() as u64)?;
        if bytes.is_empty() {
            return Ok(());
        }
        let core = self.storage.core.clone();
        let (staging, offset) = self.storage.arena.place(&core, bytes)?;
        self.storage.retain(staging.inner.clone());
        // The staging memory is new to the device: it needs no ordering.
        let region = vk::BufferCopy {
            src_offset: offset,
            dst_offset: 0,
            size: bytes.len() as u64,
        };
        let storage = &mut *self.storage;
        storage.clear_pass();
        storage.use_buffer(buffer, Scope::COPY_WRITE);
        storage.copy_pass(b"upload", &staging, buffer, &[region])
    }

    /// Copies pieces of one buffer to another. A destination made with
    /// `Buffer::readback` can be read when the submission has finished.
    ///
    /// # Errors
    /// [`GpuError::OutOfRange`] past either end or unaligned;
    /// [`GpuError::CopyToItself`] within one buffer.
    pub fn copy(
        &mut self,
        from: &Buffer,
        to: &Buffer,
        regions: &[CopyRegion],
    ) -> Result<(), GpuError> {
        if from.is(to) {
            return Err(GpuError::CopyToItself(from.label().to_owned()));
        }
        let mut pieces = Vec::with_capacity(regions.len());
        for region in regions.iter().filter(|region| region.bytes > 0) {
            from.inner.check_word(region.from, region.bytes)?;
            to.inner.check_word(region.to, region.bytes)?;
            pieces.push(vk::BufferCopy {
                src_offset: region.from,
                dst_offset: region.to,
                size: region.bytes,
            });
        }
        if pieces.is_empty() {
            return Ok(());
        }
        let storage = &mut *self.storage;
        storage.clear_pass();
        storage.use_buffer(from, Scope::COPY_READ);
        storage.use_buffer(to, Scope::COPY_WRITE);
        storage.host_reads |= to.inner.is_host;
        storage.copy_pass(b"copy", from, to, &pieces)
    }

    /// Copies all of `buffer` to the host.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`]; [`GpuError::Bundle`] in a bundle.
    pub fn read_back(&mut self, buffer: &Buffer) -> Result<Readback, GpuError> {
        if self.storage.is_bundle {
            let cause = format!("\"{}\" is read back", buffer.label());
            return Err(GpuError::Bundle(cause));
        }
        let readback = Buffer::readback(&self.gpu, "readback", buffer.bytes())?;
        let region = CopyRegion {
            from: 0,
            to: 0,
            bytes: buffer.bytes(),
        };
        self.copy(buffer, &readback, &[region])?;
        Ok(self.readback(readback, buffer.bytes()))
    }

    /// Copies all of `image` to the host: layer by layer, row by row, without
    /// padding.
    ///
    /// # Errors
    /// [`GpuError::ImageUnsupported`] for a format whose texel size is not
    /// known here; [`GpuError::OutOfMemory`].
    pub fn read_back_image(&mut self, image: &Image) -> Result<Readback, GpuError> {
        let bytes = image_bytes(image, "cannot be read back")?;
        let readback = Buffer::readback(&self.gpu, "readback", bytes)?;
        let storage = &mut *self.storage;
        storage.clear_pass();
        storage.use_buffer(&readback, Scope::COPY_WRITE);
        storage.use_image(
            image,
            vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
            Scope::COPY_READ,
            false,
        )?;
        storage.open_pass(b"read back")?;
        let region = whole_image(image.desc());
        // SAFETY: both are held, the buffer is as large as the layers, and the
        // image is in the named layout.
        unsafe {
            storage.core.device.cmd_copy_image_to_buffer(
                storage.cmd,
                image.inner.handle,
                vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
                readback.inner.handle,
                &[region],
            );
        }
        storage.host_reads = true;
        storage.close_pass()?;
        Ok(self.readback(readback, bytes))
    }

    fn readback(&self, buffer: Buffer, bytes: u64) -> Readback {
        Readback {
            gpu: self.gpu.clone(),
            buffer,
            bytes,
            submission: self.storage.submission.clone(),
        }
    }
}

impl Storage {
    fn copy_pass(
        &mut self,
        label: &[u8],
        from: &Buffer,
        to: &Buffer,
        regions: &[vk::BufferCopy],
    ) -> Result<(), GpuError> {
        self.open_pass(label)?;
        // SAFETY: both buffers are held, and the regions are within them.
        unsafe {
            self.core
                .device
                .cmd_copy_buffer(self.cmd, from.inner.handle, to.inner.handle, regions);
        }
        self.close_pass()
    }
}

impl Gpu {
    /// Reads all of a buffer; waits for everything on the main queue.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`], device loss.
    pub fn read<T: AnyBitPattern>(&self, buffer: &Buffer) -> Result<Vec<T>, GpuError> {
        let mut rec = self.recorder(QueueKind::Main)?;
        let readback = rec.read_back(buffer)?;
        self.submit(rec)?.wait()?;
        readback.get()
    }

    /// Writes to the start of a buffer and waits.
    ///
    /// # Errors
    /// [`GpuError::OutOfRange`], [`GpuError::OutOfMemory`], device loss.
    pub fn write<T: NoUninit>(&self, buffer: &Buffer, data: &[T]) -> Result<(), GpuError> {
        self.write_ahead(buffer, data)?.wait()
    }

    /// Writes to the start of a buffer, before all that is submitted to the main queue from now on. Does not wait: behind pictures a wait
    /// takes as long as they do. What goes to another queue has to come after the ticket.
    ///
    /// # Errors
    /// [`GpuError::OutOfRange`], [`GpuError::OutOfMemory`], device loss.
    pub fn write_ahead<T: NoUninit>(
        &self,
        buffer: &Buffer,
        data: &[T],
    ) -> Result<Ticket, GpuError> {
        let mut rec = self.recorder(QueueKind::Main)?;
        rec.upload(buffer, data)?;
        self.submit(rec)
    }
}

impl Image {
    /// An image with undefined contents, brought into the layout in which recorders find it, before all that is submitted to the main
    /// queue from now on. Does not wait; another queue may use it once the main queue has finished something submitted later.
    ///
    /// # Errors
    /// [`GpuError::ImageUnsupported`] where size, format or usage is not
    /// possible on the device, [`GpuError::OutOfMemory`].
    pub fn new(gpu: &Gpu, label: &str, desc: ImageDesc) -> Result<Self, GpuError> {
        let image = Self::without_layout(gpu, label, desc)?;
        let mut rec = gpu.recorder(QueueKind::Main)?;
        let index = rec.storage.image_index(&image);
        rec.storage.images[index].layout = vk::ImageLayout::UNDEFINED;
        gpu.submit(rec)?;
        Ok(image)
    }
}

/// All layers of an image, next to each other in a buffer.
pub(super) fn whole_image(desc: &ImageDesc) -> vk::BufferImageCopy {
    let [width, height] = desc.extent;
    vk::BufferImageCopy::default()
        .image_subresource(
            vk::ImageSubresourceLayers::default()
                .aspect_mask(desc.aspect())
                .layer_count(desc.layers),
        )
        .image_extent(vk::Extent3D {
            width,
            height,
            depth: 1,
        })
}

/// Bytes of all layers of an image without padding. For a format whose texel size is not known, the error says that it `refused`: "takes
/// no copy", for example.
pub(super) fn image_bytes(image: &Image, refused: &str) -> Result<u64, GpuError> {
    let desc = image.desc();
    let texel = texel_bytes(desc.format).ok_or_else(|| GpuError::ImageUnsupported {
        label: image.label().to_owned(),
        cause: format!("{:?} {refused}; use an 8, 16 or 32-bit format", desc.format),
    })?;
    let [width, height] = desc.extent;
    Ok(texel * u64::from(width) * u64::from(height) * u64::from(desc.layers))
}

/// Bytes of a texel of the uncompressed colour and depth formats in use.
pub(super) fn texel_bytes(format: vk::Format) -> Option<u64> {
    Some(match format {
        vk::Format::R8_UNORM | vk::Format::R8_UINT => 1,
        vk::Format::R8G8_UNORM
        | vk::Format::R16_SFLOAT
        | vk::Format::R16_UINT
        | vk::Format::D16_UNORM => 2,
        vk::Format::R8G8B8A8_UNORM
        | vk::Format::R8G8B8A8_SRGB
        | vk::Format::R8G8B8A8_UINT
        | vk::Format::B8G8R8A8_UNORM
        | vk::Format::B8G8R8A8_SRGB
        | vk::Format::A2B10G10R10_UNORM_PACK32
        | vk::Format::R16G16_SFLOAT
        | vk::Format::R32_SFLOAT
        | vk::Format::R32_UINT
        | vk::Format::R32_SINT
        | vk::Format::D32_SFLOAT => 4,
        vk::Format::R16G16B16A16_SFLOAT | vk::Format::R32G32_SFLOAT | vk::Format::R32G32_UINT => 8,
        vk::Format::R32G32B32A32_SFLOAT | vk::Format::R32G32B32A32_UINT => 16,
        _ => return None,
    })
}
