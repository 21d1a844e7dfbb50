//! Samplers.

use std::sync::Arc;

use ash::vk;

use crate::GpuError;
use crate::device::Core;

/// A sampler; cheap to clone.
#[derive(Clone)]
pub struct Sampler {
    pub(crate) inner: Arc<SamplerInner>,
}

pub(crate) struct SamplerInner {
    pub(crate) handle: vk::Sampler,
    core: Arc<Core>,
}

impl Sampler {
    /// Gives the weighted mean of the four nearest texels; outside the image,
    /// the texel at its edge.
    ///
    /// # Errors
    /// Out of memory.
    pub fn linear(core: &Arc<Core>) -> Result<Self, GpuError> {
        let create = vk::SamplerCreateInfo::default()
            .mag_filter(vk::Filter::LINEAR)
            .min_filter(vk::Filter::LINEAR)
            .address_mode_u(vk::SamplerAddressMode::CLAMP_TO_EDGE)
            .address_mode_v(vk::SamplerAddressMode::CLAMP_TO_EDGE)
            .address_mode_w(vk::SamplerAddressMode::CLAMP_TO_EDGE);
        // SAFETY: the device is alive and the parameters are valid everywhere.
        let handle = unsafe { core.device.create_sampler(&create, None) }
            .map_err(GpuError::vulkan("vkCreateSampler"))?;
        Ok(Self {
            inner: Arc::new(SamplerInner {
                handle,
                core: core.clone(),
            }),
        })
    }
}

impl Drop for SamplerInner {
    fn drop(&mut self) {
        // SAFETY: recorders and submissions hold clones until the device has
        // finished; this was the last.
        unsafe { self.core.device.destroy_sampler(self.handle, None) };
    }
}
