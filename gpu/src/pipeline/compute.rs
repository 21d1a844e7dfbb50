//! Compute pipelines.

use std::borrow::Cow;
use std::ffi::CString;
use std::sync::Arc;

use ash::vk;
use vitriol_shaders::{Compiled, ShaderError, Stage};

use super::{Layout, Module, c_string, wrong_stage};
use crate::GpuError;
use crate::device::Core;

/// A compute pipeline; cheap to clone.
#[derive(Clone)]
pub struct ComputePipeline {
    pub(crate) inner: Arc<ComputeInner>,
}

pub(crate) struct ComputeInner {
    pub(crate) handle: vk::Pipeline,
    pub(crate) layout: Layout,
    pub(crate) label: CString,
    pub(crate) workgroup_size: [u32; 3],
    core: Arc<Core>,
}

impl ComputePipeline {
    /// # Errors
    /// [`GpuError::Shader`] where the shader is of another stage or declares
    /// what cannot be bound; what the driver says otherwise.
    pub fn new(core: &Arc<Core>, compiled: &Compiled) -> Result<Self, GpuError> {
        if compiled.stage != Stage::Compute {
            return Err(wrong_stage(compiled, "compute"));
        }
        let compiled = &for_device(core, compiled).map_err(|error| GpuError::Shader {
            shader: compiled.label.clone(),
            cause: error.to_string(),
        })?;
        let layout = Layout::new(core, vk::PipelineBindPoint::COMPUTE, &[compiled])?;
        let module = Module::new(core, compiled)?;
        let entry = c_string(&compiled.entry);
        let create = vk::ComputePipelineCreateInfo::default()
            .stage(
                vk::PipelineShaderStageCreateInfo::default()
                    .stage(vk::ShaderStageFlags::COMPUTE)
                    .module(module.handle)
                    .name(&entry),
            )
            .layout(layout.handle);
        // SAFETY: module, entry and layout are of one reflection and live
        // through the call.
        let made = unsafe {
            core.device
                .create_compute_pipelines(core.pipeline_cache, &[create], None)
        };
        let handles =
            made.map_err(|(_, result)| GpuError::vulkan("vkCreateComputePipelines")(result))?;
        let handle = handles.first().copied().unwrap_or_default();
        core.name(handle, &compiled.label);
        Ok(Self {
            inner: Arc::new(ComputeInner {
                handle,
                layout,
                label: c_string(&compiled.label),
                workgroup_size: compiled.workgroup_size,
                core: core.clone(),
            }),
        })
    }

    /// Invocations of a workgroup, x, y, z.
    pub fn workgroup_size(&self) -> [u32; 3] {
        self.inner.workgroup_size
    }

    /// Names of its bindings, in the order of their numbers. Those that only a
    /// branch uses which specialisation removed are not among them.
    pub fn bindings(&self) -> impl Iterator<Item = &str> {
        self.inner
            .layout
            .slots
            .iter()
            .map(|slot| slot.name.as_str())
    }
}

/// The shader with what this device has better ways for.
fn for_device<'a>(core: &Core, compiled: &'a Compiled) -> Result<Cow<'a, Compiled>, ShaderError> {
    let mut compiled = Cow::Borrowed(compiled);
    if core.info.reads_texels {
        compiled = Cow::Owned(compiled.with_texels()?);
    }
    if core.info.features.maximal_reconvergence {
        compiled = Cow::Owned(compiled.reconverging()?);
    }
    Ok(compiled)
}

impl Drop for ComputeInner {
    fn drop(&mut self) {
        // SAFETY: recorders and submissions hold clones until the device has
        // finished; this was the last.
        unsafe { self.core.device.destroy_pipeline(self.handle, None) };
    }
}
