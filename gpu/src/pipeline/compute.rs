//! Compute pipelines.

use std::borrow::Cow;
use std::collections::HashMap;
use std::ffi::CString;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, Mutex, PoisonError, Weak};

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

/// A device's compute pipelines by their shader, as long as something holds them. Most shaders of two solvers or two renderers are the
/// same, and a driver without a cache compiles each again: Mesa 22.3 takes 0.4 s for the largest.
#[derive(Default)]
pub(crate) struct Shared(Mutex<HashMap<u64, Weak<ComputeInner>>>);

impl Shared {
    /// Hash of `compiled`, names of bindings included: 64 bits, so that two of a thousand are mistaken for each other once in 10¹³ times.
    fn key(compiled: &Compiled) -> u64 {
        let mut hasher = DefaultHasher::new();
        compiled.hash(&mut hasher);
        hasher.finish()
    }

    fn find(&self, key: u64) -> Option<Arc<ComputeInner>> {
        let all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.get(&key)?.upgrade()
    }

    /// Stores `inner`, unless another thread has stored the same meanwhile; returns the stored one.
    fn keep(&self, key: u64, inner: Arc<ComputeInner>) -> Arc<ComputeInner> {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(other) = all.get(&key).and_then(Weak::upgrade) {
            return other;
        }
        all.retain(|_, held| held.strong_count() > 0);
        all.insert(key, Arc::downgrade(&inner));
        inner
    }
}

impl ComputePipeline {
    /// The pipeline of a shader: an existing one of the device, if any is held.
    ///
    /// # Errors
    /// [`GpuError::Shader`] where the shader is of another stage or has a declaration that cannot be bound; otherwise the driver's error.
    pub fn new(core: &Arc<Core>, compiled: &Compiled) -> Result<Self, GpuError> {
        if compiled.stage != Stage::Compute {
            return Err(wrong_stage(compiled, "compute"));
        }
        let key = Shared::key(compiled);
        if let Some(inner) = core.shared.find(key) {
            return Ok(Self { inner });
        }
        let compiled = &for_device(core, compiled).map_err(|error| GpuError::Shader {
            shader: compiled.label.clone(),
            cause: error.to_string(),
        })?;
        let layout = Layout::new(core, vk::PipelineBindPoint::COMPUTE, &[compiled])?;
        let module = Module::new(core, compiled)?;
        let entry = c_string(&compiled.entry);
        // Traces each; a test checks by it that a scene's second bench needs no more of them.
        tracing::trace!(target: "vitriol_gpu::compile", shader = compiled.label, "compiles");
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
        let inner = Arc::new(ComputeInner {
            handle,
            layout,
            label: c_string(&compiled.label),
            workgroup_size: compiled.workgroup_size,
            core: core.clone(),
        });
        let inner = core.shared.keep(key, inner);
        Ok(Self { inner })
    }

    /// Invocations of a workgroup, x, y, z.
    pub fn workgroup_size(&self) -> [u32; 3] {
        self.inner.workgroup_size
    }

    /// Names of its bindings, in the order of their numbers, without those in branches that specialisation removed.
    pub fn bindings(&self) -> impl Iterator<Item = &str> {
        self.inner
            .layout
            .slots
            .iter()
            .map(|slot| slot.name.as_str())
    }
}

/// The shader with changes that suit this device.
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

/// Whether both are one pipeline of the device.
impl PartialEq for ComputePipeline {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.inner, &other.inner)
    }
}

impl Drop for ComputeInner {
    fn drop(&mut self) {
        // SAFETY: recorders and submissions hold clones until the device has
        // finished; this was the last.
        unsafe { self.core.device.destroy_pipeline(self.handle, None) };
    }
}
