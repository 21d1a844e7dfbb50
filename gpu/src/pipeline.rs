//! Pipelines and their bindings, from the shaders' reflection.

mod compute;
mod layout;
mod raster;

use ash::vk;
use vitriol_shaders::Compiled;

pub use compute::ComputePipeline;
pub(crate) use compute::{ComputeInner, Shared};
pub(crate) use layout::{DescriptorData, Layout, LayoutPush, Slot};
pub(crate) use raster::RasterInner;
pub use raster::RasterPipeline;

use crate::GpuError;
use crate::device::Core;

/// A shader module that lives while a pipeline is made.
struct Module<'a> {
    handle: vk::ShaderModule,
    core: &'a Core,
}

impl<'a> Module<'a> {
    fn new(core: &'a Core, compiled: &Compiled) -> Result<Self, GpuError> {
        let create = vk::ShaderModuleCreateInfo::default().code(&compiled.spirv);
        // SAFETY: the words are SPIR-V that naga validated and wrote.
        let handle = unsafe { core.device.create_shader_module(&create, None) }
            .map_err(GpuError::vulkan("vkCreateShaderModule"))?;
        Ok(Self { handle, core })
    }
}

impl Drop for Module<'_> {
    fn drop(&mut self) {
        // SAFETY: pipelines keep what they need of a module.
        unsafe { self.core.device.destroy_shader_module(self.handle, None) };
    }
}

/// A label or entry name for Vulkan; one with a zero byte in it is cut there.
fn c_string(text: &str) -> std::ffi::CString {
    let clean: Vec<u8> = text.bytes().take_while(|byte| *byte != 0).collect();
    std::ffi::CString::new(clean).unwrap_or_default()
}

fn wrong_stage(compiled: &Compiled, wanted: &str) -> GpuError {
    GpuError::Shader {
        shader: compiled.label.clone(),
        cause: format!(
            "entry \"{}\" is of stage {:?}; give one of stage {wanted}",
            compiled.entry, compiled.stage
        ),
    }
}
