//! Samplers.

use std::sync::Arc;

use ash::vk;

use crate::GpuError;
use crate::device::Core;

/// Between texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The nearest texel.
    #[default]
    Nearest,
    /// Weighted mean of four.
    Linear,
}

/// Outside the image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Address {
    /// The texel at the edge.
    #[default]
    Clamp,
    /// The image again.
    Repeat,
}

/// How a shader samples an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SamplerDesc {
    /// Between texels.
    pub filter: Filter,
    /// Outside the image.
    pub address: Address,
    /// For WGSL's `sampler_comparison`.
    pub compare: Option<vk::CompareOp>,
}

/// A sampler; cheap to clone.
#[derive(Clone)]
pub struct Sampler {
    pub(crate) inner: Arc<SamplerInner>,
}

pub(crate) struct SamplerInner {
    pub(crate) handle: vk::Sampler,
    pub(crate) compares: bool,
    core: Arc<Core>,
}

impl Sampler {
    /// # Errors
    /// Out of memory.
    pub fn new(core: &Arc<Core>, desc: SamplerDesc) -> Result<Self, GpuError> {
        let filter = match desc.filter {
            Filter::Nearest => vk::Filter::NEAREST,
            Filter::Linear => vk::Filter::LINEAR,
        };
        let address = match desc.address {
            Address::Clamp => vk::SamplerAddressMode::CLAMP_TO_EDGE,
            Address::Repeat => vk::SamplerAddressMode::REPEAT,
        };
        let create = vk::SamplerCreateInfo::default()
            .mag_filter(filter)
            .min_filter(filter)
            .address_mode_u(address)
            .address_mode_v(address)
            .address_mode_w(address)
            .compare_enable(desc.compare.is_some())
            .compare_op(desc.compare.unwrap_or(vk::CompareOp::NEVER));
        // SAFETY: the device is alive and the parameters are valid everywhere.
        let handle = unsafe { core.device.create_sampler(&create, None) }
            .map_err(GpuError::vulkan("vkCreateSampler"))?;
        Ok(Self {
            inner: Arc::new(SamplerInner {
                handle,
                compares: desc.compare.is_some(),
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
