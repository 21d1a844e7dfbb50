//! Copies to whole images, such as of a picture to an XR runtime's swapchain.

use ash::vk;

use super::Recorder;
use super::transfer::{image_bytes, texel_bytes, whole_image};
use crate::barrier::Scope;
use crate::{Buffer, GpuError, Image};

/// The part of an image that is copied.
#[derive(Clone, Copy)]
enum Part {
    Whole,
    /// The upper left corner.
    Corner,
}

impl Part {
    /// Whether an image of `held` texels has one of `wanted`.
    fn fits(self, held: [u32; 2], wanted: [u32; 2]) -> bool {
        match self {
            Self::Whole => held == wanted,
            Self::Corner => wanted[0] <= held[0] && wanted[1] <= held[1],
        }
    }
}

impl Recorder {
    /// Copies all of `from` to `to`, texel by texel and bit by bit: both have the
    /// same extent, layers and aspect, and texels of the same size, so that sRGB and
    /// linear formats of the same channels may be mixed.
    ///
    /// # Errors
    /// [`GpuError::ImageUnsupported`] where the two do not fit each other.
    pub fn copy_image(&mut self, from: &Image, to: &Image) -> Result<(), GpuError> {
        let layers = from.desc().layers;
        self.copy_layers(from, [0, layers], to, Part::Whole)
    }

    /// Copies the upper left corner of `from`, which may be larger, to all of `to`; else as [`Recorder::copy_image`] does.
    ///
    /// # Errors
    /// As for [`Recorder::copy_image`].
    pub fn copy_corner(&mut self, from: &Image, to: &Image) -> Result<(), GpuError> {
        self.copy_layers(from, [0, from.desc().layers], to, Part::Corner)
    }

    /// Copies one layer of `from` to all of `to`, which has no other, as [`Recorder::copy_image`] does.
    ///
    /// # Errors
    /// As for [`Recorder::copy_image`].
    pub fn copy_layer(&mut self, from: &Image, layer: u32, to: &Image) -> Result<(), GpuError> {
        self.copy_layers(from, [layer, 1], to, Part::Whole)
    }

    /// A part of `count` layers of `from` beginning with `first`, to all of `to`.
    fn copy_layers(
        &mut self,
        from: &Image,
        [first, count]: [u32; 2],
        to: &Image,
        part: Part,
    ) -> Result<(), GpuError> {
        let (source, target) = (*from.desc(), *to.desc());
        let fits = part.fits(source.extent, target.extent)
            && count == target.layers
            && first.saturating_add(count) <= source.layers
            && source.aspect() == target.aspect()
            && texel_bytes(source.format).is_some()
            && texel_bytes(source.format) == texel_bytes(target.format)
            // Vulkan copies depth between equal formats only.
            && (!source.is_depth() || source.format == target.format);
        if !fits || from.handle() == to.handle() {
            return Err(GpuError::ImageUnsupported {
                label: to.label().to_owned(),
                cause: format!(
                    "it takes no copy of {count} layers of \"{}\" from layer {first} on ({source:?} to \
                     {target:?}); as many layers of a fitting extent and the same size of texel are needed",
                    from.label()
                ),
            });
        }
        let (reads, writes) = (
            vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
            vk::ImageLayout::TRANSFER_DST_OPTIMAL,
        );
        let storage = &mut *self.storage;
        storage.clear_pass();
        storage.use_image(from, reads, Scope::COPY_READ, false)?;
        storage.use_image(to, writes, Scope::COPY_WRITE, true)?;
        storage.open_pass(b"copy image")?;
        let layers = vk::ImageSubresourceLayers::default()
            .aspect_mask(source.aspect())
            .layer_count(count);
        let region = vk::ImageCopy::default()
            .src_subresource(layers.base_array_layer(first))
            .dst_subresource(layers)
            .extent(vk::Extent3D {
                width: target.extent[0],
                height: target.extent[1],
                depth: 1,
            });
        // SAFETY: both are held, `from` no smaller than `to`, and of formats that may be copied, and
        // in the named layouts.
        unsafe {
            storage.core.device.cmd_copy_image(
                storage.cmd,
                from.inner.handle,
                reads,
                to.inner.handle,
                writes,
                &[region],
            );
        }
        storage.close_pass()
    }

    /// Copies texels from the start of `from` to all of `to`: layer by layer, row by row,
    /// without padding.
    ///
    /// # Errors
    /// [`GpuError::OutOfRange`] where the buffer is too short;
    /// [`GpuError::ImageUnsupported`] for a format whose texel size is not known here.
    pub fn copy_to_image(&mut self, from: &Buffer, to: &Image) -> Result<(), GpuError> {
        from.inner.check(0, image_bytes(to, "takes no copy")?)?;
        let layout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        let storage = &mut *self.storage;
        storage.clear_pass();
        storage.use_buffer(from, Scope::COPY_READ);
        storage.use_image(to, layout, Scope::COPY_WRITE, true)?;
        storage.open_pass(b"copy to image")?;
        let region = whole_image(to.desc());
        // SAFETY: both are held, the buffer is as large as the layers, and the image is in the
        // named layout.
        unsafe {
            storage.core.device.cmd_copy_buffer_to_image(
                storage.cmd,
                from.inner.handle,
                to.inner.handle,
                layout,
                &[region],
            );
        }
        storage.close_pass()
    }
}
