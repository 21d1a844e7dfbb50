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

/// How a fragment's colour meets what is there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Blend {
    /// Replaces it.
    #[default]
    Replace,
    /// `new + old · (1 − α)`, for premultiplied colour.
    Premultiplied,
}

/// One colour target of a pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColourFormat {
    /// Texel format.
    pub format: vk::Format,
    /// Blending.
    pub blend: Blend,
}

/// The depth target of a pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthFormat {
    /// Texel format.
    pub format: vk::Format,
    /// Which fragments pass; `ALWAYS` for no test.
    pub compare: vk::CompareOp,
    /// Whether those that pass write their depth.
    pub write: bool,
}

/// What a raster pipeline of triangles, seen from either side, is made of.
#[derive(Clone, Copy, Debug)]
pub struct RasterDesc<'a> {
    /// Vertex shader.
    pub vertex: &'a Compiled,
    /// Fragment shader; none for depth alone.
    pub fragment: Option<&'a Compiled>,
    /// Colour targets in order of `@location`.
    pub colours: &'a [ColourFormat],
    /// Depth target.
    pub depth: Option<DepthFormat>,
    /// Bit per view (multiview); 0 for one picture. The shader reads
    /// `@builtin(view_index)`.
    pub view_mask: u32,
}

/// A raster pipeline; cheap to clone.
#[derive(Clone)]
pub struct RasterPipeline {
    pub(crate) inner: Arc<RasterInner>,
}

pub(crate) struct RasterInner {
    pub(crate) handle: vk::Pipeline,
    pub(crate) layout: Layout,
    pub(crate) label: CString,
    pub(crate) colours: Vec<vk::Format>,
    pub(crate) depth: Option<vk::Format>,
    pub(crate) view_mask: u32,
    core: Arc<Core>,
}

impl RasterPipeline {
    /// # Errors
    /// [`GpuError::Shader`] where a shader is of another stage, declares what
    /// cannot be bound, or the stages contradict each other;
    /// [`GpuError::Unsupported`] for more views than the device has.
    pub fn new(core: &Arc<Core>, desc: &RasterDesc<'_>) -> Result<Self, GpuError> {
        if desc.vertex.stage != Stage::Vertex {
            return Err(wrong_stage(desc.vertex, "vertex"));
        }
        if let Some(fragment) = desc.fragment
            && fragment.stage != Stage::Fragment
        {
            return Err(wrong_stage(fragment, "fragment"));
        }
        if 32 - desc.view_mask.leading_zeros() > core.info.max_views {
            return Err(GpuError::Unsupported {
                feature: "multiview with so many views",
                remedy: "render fewer views at once",
            });
        }
        let shaders: Vec<&Compiled> = std::iter::once(desc.vertex).chain(desc.fragment).collect();
        let layout = Layout::new(core, vk::PipelineBindPoint::GRAPHICS, &shaders)?;
        let handle = create(core, desc, &shaders, &layout)?;
        let label = &desc.fragment.unwrap_or(desc.vertex).label;
        core.name(handle, label);
        Ok(Self {
            inner: Arc::new(RasterInner {
                handle,
                layout,
                label: c_string(label),
                colours: desc.colours.iter().map(|colour| colour.format).collect(),
                depth: desc.depth.map(|depth| depth.format),
                view_mask: desc.view_mask,
                core: core.clone(),
            }),
        })
    }
}

fn create(
    core: &Core,
    desc: &RasterDesc<'_>,
    shaders: &[&Compiled],
    layout: &Layout,
) -> Result<vk::Pipeline, GpuError> {
    let mut modules = Vec::new();
    for shader in shaders {
        modules.push((Module::new(core, shader)?, c_string(&shader.entry)));
    }
    let flags = [vk::ShaderStageFlags::VERTEX, vk::ShaderStageFlags::FRAGMENT];
    let stages: Vec<_> = modules
        .iter()
        .zip(flags)
        .map(|((module, entry), stage)| {
            vk::PipelineShaderStageCreateInfo::default()
                .stage(stage)
                .module(module.handle)
                .name(entry)
        })
        .collect();
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
    let depth = desc
        .depth
        .map_or_else(Default::default, |depth| depth_state(&depth));
    let attachments: Vec<_> = desc
        .colours
        .iter()
        .map(|colour| blend(colour.blend))
        .collect();
    let blending = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
    let dynamic = vk::PipelineDynamicStateCreateInfo::default()
        .dynamic_states(&[vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR]);
    let formats: Vec<_> = desc.colours.iter().map(|colour| colour.format).collect();
    let mut rendering = vk::PipelineRenderingCreateInfo::default()
        .view_mask(desc.view_mask)
        .color_attachment_formats(&formats);
    if let Some(depth) = desc.depth {
        rendering = rendering.depth_attachment_format(depth.format);
    }
    let create = vk::GraphicsPipelineCreateInfo::default()
        .stages(&stages)
        .vertex_input_state(&vertex_input)
        .input_assembly_state(&assembly)
        .viewport_state(&viewport)
        .rasterization_state(&rasterisation)
        .multisample_state(&samples)
        .depth_stencil_state(&depth)
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
    match made {
        Ok(handles) => Ok(handles.first().copied().unwrap_or_default()),
        Err((_, result)) => Err(GpuError::vulkan("vkCreateGraphicsPipelines")(result)),
    }
}

fn depth_state(depth: &DepthFormat) -> vk::PipelineDepthStencilStateCreateInfo<'static> {
    vk::PipelineDepthStencilStateCreateInfo::default()
        .depth_test_enable(depth.compare != vk::CompareOp::ALWAYS || depth.write)
        .depth_write_enable(depth.write)
        .depth_compare_op(depth.compare)
}

fn blend(blend: Blend) -> vk::PipelineColorBlendAttachmentState {
    use vk::BlendFactor as F;
    let (source, destination) = match blend {
        Blend::Replace => (F::ONE, F::ZERO),
        Blend::Premultiplied => (F::ONE, F::ONE_MINUS_SRC_ALPHA),
    };
    // Alpha itself is always covered as if premultiplied.
    let source_alpha = F::ONE;
    vk::PipelineColorBlendAttachmentState::default()
        .blend_enable(blend != Blend::Replace)
        .src_color_blend_factor(source)
        .dst_color_blend_factor(destination)
        .color_blend_op(vk::BlendOp::ADD)
        .src_alpha_blend_factor(source_alpha)
        .dst_alpha_blend_factor(destination)
        .alpha_blend_op(vk::BlendOp::ADD)
        .color_write_mask(vk::ColorComponentFlags::RGBA)
}

impl Drop for RasterInner {
    fn drop(&mut self) {
        // SAFETY: recorders and submissions hold clones until the device has
        // finished; this was the last.
        unsafe { self.core.device.destroy_pipeline(self.handle, None) };
    }
}
