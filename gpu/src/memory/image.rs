//! Images: 2-D with layers, one mip level.

use std::sync::Arc;

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::Allocation;

use super::{allocate, free, next_id};
use crate::GpuError;
use crate::device::Core;

/// Size, format and use of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageDesc {
    /// Width and height in texels.
    pub extent: [u32; 2],
    /// Layers; two for a stereo target.
    pub layers: u32,
    /// Texel format.
    pub format: vk::Format,
    /// Its usage; copies out of it and into it are always added.
    pub usage: vk::ImageUsageFlags,
}

impl ImageDesc {
    /// Whether the format is one of depth.
    pub fn is_depth(&self) -> bool {
        matches!(
            self.format,
            vk::Format::D16_UNORM | vk::Format::D32_SFLOAT | vk::Format::X8_D24_UNORM_PACK32
        )
    }

    pub(crate) fn aspect(&self) -> vk::ImageAspectFlags {
        if self.is_depth() {
            vk::ImageAspectFlags::DEPTH
        } else {
            vk::ImageAspectFlags::COLOR
        }
    }

    /// Layout between recorders. Every recorder finds and leaves an image in this layout, so that recorders are independent of each other.
    fn home(&self) -> vk::ImageLayout {
        if self.usage.contains(vk::ImageUsageFlags::STORAGE) {
            vk::ImageLayout::GENERAL
        } else if self.usage.contains(vk::ImageUsageFlags::SAMPLED) {
            vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL
        } else if self.usage.contains(vk::ImageUsageFlags::COLOR_ATTACHMENT) {
            vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL
        } else if self
            .usage
            .contains(vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT)
        {
            vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL
        } else {
            vk::ImageLayout::TRANSFER_SRC_OPTIMAL
        }
    }
}

/// An image on the device; cheap to clone.
#[derive(Clone)]
pub struct Image {
    pub(crate) inner: Arc<ImageInner>,
}

pub(crate) struct ImageInner {
    pub(crate) id: u64,
    pub(crate) handle: vk::Image,
    pub(crate) label: String,
    pub(crate) desc: ImageDesc,
    /// Layout between recorders.
    pub(crate) home: vk::ImageLayout,
    /// All layers, as a 2-D array.
    pub(crate) array_view: vk::ImageView,
    /// The first layer, as plain 2-D.
    pub(crate) plain_view: vk::ImageView,
    /// `None` for an imported image, which its owner destroys.
    allocation: Option<Allocation>,
    core: Arc<Core>,
}

impl Image {
    /// An image that is in no layout yet; `Image::new` brings it into one.
    pub(crate) fn without_layout(
        core: &Arc<Core>,
        label: &str,
        desc: ImageDesc,
    ) -> Result<Self, GpuError> {
        let desc = ImageDesc {
            usage: desc.usage
                | vk::ImageUsageFlags::TRANSFER_SRC
                | vk::ImageUsageFlags::TRANSFER_DST,
            ..desc
        };
        check(core, label, &desc)?;
        let (sharing, families) = core.sharing();
        let create = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(desc.format)
            .extent(vk::Extent3D {
                width: desc.extent[0],
                height: desc.extent[1],
                depth: 1,
            })
            .mip_levels(1)
            .array_layers(desc.layers)
            .samples(vk::SampleCountFlags::TYPE_1)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(desc.usage)
            .sharing_mode(sharing)
            .queue_family_indices(families)
            .initial_layout(vk::ImageLayout::UNDEFINED);
        // SAFETY: `check` asked the driver whether these parameters are valid.
        let handle = unsafe { core.device.create_image(&create, None) }
            .map_err(GpuError::vulkan("vkCreateImage"))?;
        // SAFETY: `handle` was just made.
        let requirements = unsafe { core.device.get_image_memory_requirements(handle) };
        let bind = |allocation: Allocation| {
            // SAFETY: the memory is of this device, large enough and not used
            // by anything else; the image has none yet.
            unsafe {
                core.device
                    .bind_image_memory(handle, allocation.memory(), allocation.offset())
            }
            .map_err(GpuError::vulkan("vkBindImageMemory"))
            .map(|()| allocation)
        };
        let allocation = allocate(core, label, requirements, MemoryLocation::GpuOnly, false)
            .and_then(bind)
            // SAFETY: nothing uses the image.
            .inspect_err(|_| unsafe { core.device.destroy_image(handle, None) })?;
        Self::wrap(core, label, desc, handle, desc.home(), Some(allocation))
    }

    /// An image that someone else made and will destroy, such as one of an XR
    /// runtime's swapchain. A recorder finds it in `layout` and leaves it so;
    /// `COLOR_ATTACHMENT_OPTIMAL` (`DEPTH_STENCIL_ATTACHMENT_OPTIMAL`) is what
    /// OpenXR asks for.
    ///
    /// # Errors
    /// A failure to make its views.
    ///
    /// # Safety
    /// `handle` is an image of this device with the properties in `desc`, and
    /// it outlives this [`Image`], its clones and all submissions that use it.
    pub unsafe fn import(
        core: &Arc<Core>,
        label: &str,
        handle: vk::Image,
        desc: ImageDesc,
        layout: vk::ImageLayout,
    ) -> Result<Self, GpuError> {
        Self::wrap(core, label, desc, handle, layout, None)
    }

    fn wrap(
        core: &Arc<Core>,
        label: &str,
        desc: ImageDesc,
        handle: vk::Image,
        home: vk::ImageLayout,
        allocation: Option<Allocation>,
    ) -> Result<Self, GpuError> {
        let mut inner = ImageInner {
            id: next_id(),
            handle,
            label: label.to_owned(),
            desc,
            home,
            array_view: vk::ImageView::null(),
            plain_view: vk::ImageView::null(),
            allocation,
            core: core.clone(),
        };
        core.name(handle, label);
        // A copy-only image may have no views; on failure `inner` cleans up.
        if desc.usage.intersects(VIEWED) {
            inner.array_view = view(core, &inner, vk::ImageViewType::TYPE_2D_ARRAY, desc.layers)?;
            inner.plain_view = view(core, &inner, vk::ImageViewType::TYPE_2D, 1)?;
        }
        Ok(Self {
            inner: Arc::new(inner),
        })
    }

    /// Size, format and use.
    pub fn desc(&self) -> &ImageDesc {
        &self.inner.desc
    }

    /// Label given at its making.
    pub fn label(&self) -> &str {
        &self.inner.label
    }

    /// Raw handle, for a library that shares the device.
    pub fn handle(&self) -> vk::Image {
        self.inner.handle
    }
}

/// Usages that go through a view.
const VIEWED: vk::ImageUsageFlags = vk::ImageUsageFlags::from_raw(
    vk::ImageUsageFlags::SAMPLED.as_raw()
        | vk::ImageUsageFlags::STORAGE.as_raw()
        | vk::ImageUsageFlags::COLOR_ATTACHMENT.as_raw()
        | vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT.as_raw(),
);

fn view(
    core: &Core,
    image: &ImageInner,
    kind: vk::ImageViewType,
    layers: u32,
) -> Result<vk::ImageView, GpuError> {
    let create = vk::ImageViewCreateInfo::default()
        .image(image.handle)
        .view_type(kind)
        .format(image.desc.format)
        .subresource_range(image.range().layer_count(layers));
    // SAFETY: the image is alive and has the format and the layers.
    unsafe { core.device.create_image_view(&create, None) }
        .map_err(GpuError::vulkan("vkCreateImageView"))
}

fn check(core: &Core, label: &str, desc: &ImageDesc) -> Result<(), GpuError> {
    let unsupported = |cause: String| GpuError::ImageUnsupported {
        label: label.to_owned(),
        cause,
    };
    // SAFETY: the physical device is alive.
    let limits = unsafe {
        core.instance.get_physical_device_image_format_properties(
            core.physical,
            desc.format,
            vk::ImageType::TYPE_2D,
            vk::ImageTiling::OPTIMAL,
            desc.usage,
            vk::ImageCreateFlags::empty(),
        )
    }
    .map_err(|_| {
        unsupported(format!(
            "the device has no {:?} for {:?}; choose another format",
            desc.format, desc.usage
        ))
    })?;
    let [width, height] = desc.extent;
    if width == 0 || height == 0 || desc.layers == 0 {
        return Err(unsupported(
            "width, height and layers must be at least 1".to_owned(),
        ));
    }
    if width > limits.max_extent.width
        || height > limits.max_extent.height
        || desc.layers > limits.max_array_layers
    {
        return Err(unsupported(format!(
            "{width}×{height}, {} layers is over the device's {}×{}, {} layers; choose a smaller picture",
            desc.layers, limits.max_extent.width, limits.max_extent.height, limits.max_array_layers
        )));
    }
    Ok(())
}

impl ImageInner {
    /// All layers.
    pub(crate) fn range(&self) -> vk::ImageSubresourceRange {
        vk::ImageSubresourceRange::default()
            .aspect_mask(self.desc.aspect())
            .level_count(1)
            .layer_count(self.desc.layers)
    }
}

impl Drop for ImageInner {
    fn drop(&mut self) {
        let device = &self.core.device;
        // SAFETY: recorders and submissions hold clones until the device has
        // finished; this was the last. Null views are ignored.
        unsafe {
            device.destroy_image_view(self.array_view, None);
            device.destroy_image_view(self.plain_view, None);
            if self.allocation.is_some() {
                device.destroy_image(self.handle, None);
            }
        }
        if let Some(allocation) = &mut self.allocation {
            free(&self.core, allocation);
        }
    }
}
