//! A swapchain and its images.

use openxr as xr;
use vitriol_gpu::ash::vk::Handle;
use vitriol_gpu::{Gpu, Image, ImageDesc, QueueKind, vk};

use super::convert::{CallFailure, failed};

/// A swapchain of one size and format.
pub(super) struct Chain {
    /// Views of the swapchain's images; declared before the swapchain, so that they are dropped first.
    images: Vec<Image>,
    chain: xr::Swapchain<xr::Vulkan>,
    /// Index of the acquired image, and whether the compositor has released it: until then it can be neither written nor given back.
    held: Option<(usize, bool)>,
    /// Whether an image has been given back, which is shown until the next is.
    has_shown: bool,
}

impl Chain {
    /// A swapchain whose images can be copied to.
    pub(super) fn new(
        gpu: &Gpu,
        session: &xr::Session<xr::Vulkan>,
        label: &str,
        extent: [u32; 2],
        layers: u32,
        format: vk::Format,
    ) -> Result<Self, CallFailure> {
        let depth = format == vk::Format::D32_SFLOAT;
        let (xr_use, usage, layout) = if depth {
            (
                xr::SwapchainUsageFlags::DEPTH_STENCIL_ATTACHMENT,
                vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT,
                vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
            )
        } else {
            (
                xr::SwapchainUsageFlags::COLOR_ATTACHMENT,
                vk::ImageUsageFlags::COLOR_ATTACHMENT,
                vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
            )
        };
        let chain = session
            .create_swapchain(&xr::SwapchainCreateInfo {
                create_flags: xr::SwapchainCreateFlags::EMPTY,
                usage_flags: xr_use
                    | xr::SwapchainUsageFlags::TRANSFER_DST
                    | xr::SwapchainUsageFlags::TRANSFER_SRC,
                format: format.as_raw() as u32,
                sample_count: 1,
                width: extent[0],
                height: extent[1],
                face_count: 1,
                array_size: layers,
                mip_count: 1,
            })
            .map_err(failed("xrCreateSwapchain"))?;
        let desc = ImageDesc {
            extent,
            layers,
            format,
            usage: usage | vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC,
        };
        let images = chain
            .enumerate_images()
            .map_err(failed("xrEnumerateSwapchainImages"))?
            .into_iter()
            .map(|handle| {
                // SAFETY: the runtime made the image on this device with these properties. It
                // lives until the swapchain is destroyed, before which `Live` waits for the
                // device; a view may be destroyed after its image.
                unsafe { Image::import(gpu, label, vk::Image::from_raw(handle), desc, layout) }
            })
            .collect::<Result<Vec<_>, _>>()?;
        if images.is_empty() {
            return Err(failed("xrEnumerateSwapchainImages")(
                xr::sys::Result::ERROR_VALIDATION_FAILURE,
            ));
        }
        Ok(Self {
            images,
            chain,
            held: None,
            has_shown: false,
        })
    }

    /// Acquires the image for this frame, and waits until the compositor has released it.
    pub(super) fn acquire(&mut self, gpu: &Gpu) -> Result<Image, CallFailure> {
        let (held, ours) = match self.held {
            Some(held) => held,
            None => {
                let index = gpu
                    .with_queue(QueueKind::Main, |_| self.chain.acquire_image())
                    .map_err(failed("xrAcquireSwapchainImage"))?;
                (index as usize % self.images.len(), false)
            }
        };
        // Before the wait, which may fail: the image stays acquired, and is waited for again.
        self.held = Some((held, ours));
        if !ours {
            self.chain
                .wait_image(xr::Duration::INFINITE)
                .map_err(failed("xrWaitSwapchainImage"))?;
            self.held = Some((held, true));
        }
        Ok(self.images[held].clone())
    }

    /// Gives the image back with the work that was submitted for it.
    pub(super) fn release(&mut self, gpu: &Gpu) -> Result<(), CallFailure> {
        if self.acquired().is_none() {
            return Ok(());
        }
        gpu.with_queue(QueueKind::Main, |_| self.chain.release_image())
            .map_err(failed("xrReleaseSwapchainImage"))?;
        // Where it was refused, the image is still ours, for the next frame.
        self.held = None;
        self.has_shown = true;
        Ok(())
    }

    /// Whether there is an image to be shown.
    pub(super) fn has_shown(&self) -> bool {
        self.has_shown
    }

    /// The image that can be written now.
    pub(super) fn acquired(&self) -> Option<&Image> {
        let (held, ours) = self.held?;
        ours.then(|| &self.images[held])
    }

    /// Size, format and usage of the images.
    pub(super) fn desc(&self) -> &ImageDesc {
        self.images[0].desc()
    }

    /// Width and height, pixels.
    pub(super) fn extent(&self) -> [u32; 2] {
        self.desc().extent
    }

    /// One layer of it, as composition layers name it.
    pub(super) fn part(&self, layer: u32) -> xr::SwapchainSubImage<'_, xr::Vulkan> {
        self.corner(layer, self.extent())
    }

    /// The upper left corner of one layer, so many pixels wide and high; what would reach beyond the
    /// image is cut off.
    pub(super) fn corner(
        &self,
        layer: u32,
        extent: [u32; 2],
    ) -> xr::SwapchainSubImage<'_, xr::Vulkan> {
        let held = self.extent();
        let [width, height] = [0, 1].map(|side| extent[side].min(held[side]));
        xr::SwapchainSubImage::new()
            .swapchain(&self.chain)
            .image_array_index(layer)
            .image_rect(xr::Rect2Di {
                offset: xr::Offset2Di { x: 0, y: 0 },
                extent: xr::Extent2Di {
                    width: width as i32,
                    height: height as i32,
                },
            })
    }
}
