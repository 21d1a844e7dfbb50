//! Raster pipelines over dynamic rendering. Vertices are pulled from storage
//! buffers by `vertex_index`: particles and meshes lie there anyway, and one
//! way of binding is enough.

use std::ffi::CString;
use std::sync::Arc;

use ash::vk;
use vitriol_shaders::{Compiled, Stage};

use super::{Layout, Module, c_string, wrong_stage};
use crate::GpuError;
use crate::device::Core;

/// A raster pipeline; cheap to clone.
#[derive(Clone)]
pub struct RasterPipeline {
    pub(crate) inner: Arc<RasterInner>,
}

pub(crate) struct RasterInner {
    pub(crate) handle: vk::Pipeline,
    pub(crate) layout: Layout,
    pub(crate) label: CString,
    /// Format of the target.
    pub(crate) format: vk::Format,
    core: Arc<Core>,
}

impl RasterPipeline {
    /// Draws triangles, seen from either side, over a target of `format` in
    /// premultiplied colour: `new + old · (1 − α)`.
    ///
    /// # Errors
    /// [`GpuError::Shader`] where a shader is of another stage, has a declaration that cannot be bound, or contradicts the other stage.
    pub fn new(
        core: &Arc<Core>,
        vertex: &Compiled,
        fragment: &Compiled,
        format: vk::Format,
    ) -> Result<Self, GpuError> {
        if vertex.stage != Stage::Vertex {
            return Err(wrong_stage(vertex, "vertex"));
        }
        if fragment.stage != Stage::Fragment {
            return Err(wrong_stage(fragment, "fragment"));
        }
        let shaders = [vertex, fragment];
        let layout = Layout::new(core, vk::PipelineBindPoint::GRAPHICS, &shaders)?;
        let handle = create(core, shaders, format, &layout)?;
        core.name(handle, &fragment.label);
        Ok(Self {
            inner: Arc::new(RasterInner {
                handle,
                layout,
                label: c_string(&fragment.label),
                format,
                core: core.clone(),
            }),
        })
    }
}

fn create(
    core: &Core,
    [vertex, fragment]: [&Compiled; 2],
    format: vk::Format,
    layout: &Layout,
) -> Result<vk::Pipeline, GpuError> {
    let modules = [Module::new(core, vertex)?, Module::new(core, fragment)?];
    let entries = [c_string(&vertex.entry), c_string(&fragment.entry)];
    let flags = [vk::ShaderStageFlags::VERTEX, vk::ShaderStageFlags::FRAGMENT];
    let stages = [0, 1].map(|at| {
        vk::PipelineShaderStageCreateInfo::default()
            .stage(flags[at])
            .module(modules[at].handle)
            .name(&entries[at])
    });
    let vertex_input = vk::PipelineVertexInputStateCreateInfo::default();
    let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
        .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
    let viewport = vk::PipelineViewportStateCreateInfo::default()
        .viewport_count(1)
        .scissor_count(1);
    let rasterisation = vk::PipelineRasterizationStateCreateInfo::default()
        .polygon_mode(vk::PolygonMode::FILL)
        .cull_mode(vk::CullModeFlags::NONE)
        .line_width(1.0);
    let samples = vk::PipelineMultisampleStateCreateInfo::default()
        .rasterization_samples(vk::SampleCountFlags::TYPE_1);
    let attachments = [vk::PipelineColorBlendAttachmentState::default()
        .blend_enable(true)
        .src_color_blend_factor(vk::BlendFactor::ONE)
        .dst_color_blend_factor(vk::BlendFactor::ONE_MINUS_SRC_ALPHA)
        .color_blend_op(vk::BlendOp::ADD)
        .src_alpha_blend_factor(vk::BlendFactor::ONE)
        .dst_alpha_blend_factor(vk::BlendFactor::ONE_MINUS_SRC_ALPHA)
        .alpha_blend_op(vk::BlendOp::ADD)
        .color_write_mask(vk::ColorComponentFlags::RGBA)];
    let blending = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
    let dynamic = vk::PipelineDynamicStateCreateInfo::default()
        .dynamic_states(&[vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR]);
    let formats = [format];
    let mut rendering =
        vk::PipelineRenderingCreateInfo::default().color_attachment_formats(&formats);
    let create = vk::GraphicsPipelineCreateInfo::default()
        .stages(&stages)
        .vertex_input_state(&vertex_input)
        .input_assembly_state(&assembly)
        .viewport_state(&viewport)
        .rasterization_state(&rasterisation)
        .multisample_state(&samples)
        .color_blend_state(&blending)
        .dynamic_state(&dynamic)
        .layout(layout.handle)
        .push_next(&mut rendering);
    // SAFETY: everything that `create` points to lives through the call, and
    // the layout comes from the same shaders.
    let made = unsafe {
        core.device
            .create_graphics_pipelines(core.pipeline_cache, &[create], None)
    };
    let handles =
        made.map_err(|(_, result)| GpuError::vulkan("vkCreateGraphicsPipelines")(result))?;
    Ok(handles.first().copied().unwrap_or_default())
}

impl Drop for RasterInner {
    fn drop(&mut self) {
        // SAFETY: recorders and submissions hold clones until the device has
        // finished; this was the last.
        unsafe { self.core.device.destroy_pipeline(self.handle, None) };
    }
}
