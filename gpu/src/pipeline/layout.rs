//! Descriptor and pipeline layouts from reflection: one set of push
//! descriptors, filled through an update template. Push descriptors because a
//! pass then costs no allocation and no set has to be recycled; the template
//! because it takes plain data, without a write structure per binding.

use std::sync::Arc;

use ash::vk;
use vitriol_shaders::{BindingKind, Compiled, Stage};

use crate::GpuError;
use crate::barrier::Scope;
use crate::device::Core;

/// Data of one binding for the update template.
#[derive(Clone, Copy)]
#[repr(C)]
pub(crate) union DescriptorData {
    pub(crate) buffer: vk::DescriptorBufferInfo,
    pub(crate) image: vk::DescriptorImageInfo,
    pub(crate) texels: vk::BufferView,
}

impl DescriptorData {
    pub(crate) const EMPTY: Self = Self {
        buffer: vk::DescriptorBufferInfo {
            buffer: vk::Buffer::null(),
            offset: 0,
            range: 0,
        },
    };
}

/// One binding of a pipeline.
pub(crate) struct Slot {
    pub(crate) name: String,
    pub(crate) binding: u32,
    pub(crate) kind: BindingKind,
    /// How the pipeline accesses it, all stages together.
    pub(crate) scope: Scope,
    stages: vk::ShaderStageFlags,
}

/// The parts of a layout that are needed to push descriptors and immediates.
#[derive(Clone, Copy)]
pub(crate) struct LayoutPush {
    pub(crate) handle: vk::PipelineLayout,
    /// Null without bindings.
    pub(crate) template: vk::DescriptorUpdateTemplate,
    pub(crate) immediate_stages: vk::ShaderStageFlags,
    pub(crate) immediate_bytes: usize,
}

/// Bindings, immediates and their Vulkan objects.
pub(crate) struct Layout {
    pub(crate) slots: Vec<Slot>,
    pub(crate) immediate_bytes: u32,
    /// Names that the shaders declare and, as specialised, do not use.
    unused: Vec<String>,
    immediate_stages: vk::ShaderStageFlags,
    pub(crate) handle: vk::PipelineLayout,
    set: vk::DescriptorSetLayout,
    template: vk::DescriptorUpdateTemplate,
    core: Arc<Core>,
}

impl Layout {
    /// # Errors
    /// [`GpuError::Shader`] where the shaders have a declaration that cannot be bound.
    pub(crate) fn new(
        core: &Arc<Core>,
        bind_point: vk::PipelineBindPoint,
        shaders: &[&Compiled],
    ) -> Result<Self, GpuError> {
        let slots = merge(core, shaders)?;
        let unused = shaders.iter().flat_map(|shader| shader.unused.clone());
        let mut layout = Self {
            slots,
            immediate_bytes: 0,
            unused: unused.collect(),
            immediate_stages: vk::ShaderStageFlags::empty(),
            handle: vk::PipelineLayout::null(),
            set: vk::DescriptorSetLayout::null(),
            template: vk::DescriptorUpdateTemplate::null(),
            core: core.clone(),
        };
        for shader in shaders.iter().filter(|shader| shader.immediate_bytes > 0) {
            let limit = core.info.limits.immediate_bytes;
            if shader.immediate_bytes > limit {
                return Err(GpuError::Shader {
                    shader: shader.label.clone(),
                    cause: format!(
                        "{} bytes of immediates are over the device's {limit}; move some to a uniform",
                        shader.immediate_bytes
                    ),
                });
            }
            layout.immediate_bytes = layout.immediate_bytes.max(shader.immediate_bytes);
            layout.immediate_stages |= stage_flag(shader.stage);
        }
        layout.create(bind_point)?;
        Ok(layout)
    }

    /// Whether `name` is declared but was ruled out by the specialisation, so
    /// that a pass which names it binds nothing.
    pub(crate) fn is_unused(&self, name: &str) -> bool {
        self.unused.iter().any(|unused| unused == name)
    }

    /// Whether the shaders declare immediates and, as specialised, read none.
    pub(crate) fn drops_immediates(&self) -> bool {
        self.immediate_bytes == 0 && !self.unused.is_empty()
    }

    pub(crate) fn push(&self) -> LayoutPush {
        LayoutPush {
            handle: self.handle,
            template: self.template,
            immediate_stages: self.immediate_stages,
            immediate_bytes: self.immediate_bytes as usize,
        }
    }

    fn create(&mut self, bind_point: vk::PipelineBindPoint) -> Result<(), GpuError> {
        let bindings: Vec<_> = self
            .slots
            .iter()
            .map(|slot| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(slot.binding)
                    .descriptor_type(descriptor_type(&slot.kind))
                    .descriptor_count(1)
                    .stage_flags(slot.stages)
            })
            .collect();
        let create = vk::DescriptorSetLayoutCreateInfo::default()
            .flags(vk::DescriptorSetLayoutCreateFlags::PUSH_DESCRIPTOR_KHR)
            .bindings(&bindings);
        let device = &self.core.device;
        // SAFETY: the bindings are distinct and within the push limit.
        self.set = unsafe { device.create_descriptor_set_layout(&create, None) }
            .map_err(GpuError::vulkan("vkCreateDescriptorSetLayout"))?;
        let sets = [self.set];
        let ranges = [vk::PushConstantRange::default()
            .stage_flags(self.immediate_stages)
            .size(self.immediate_bytes.next_multiple_of(4))];
        let mut create = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets);
        if self.immediate_bytes > 0 {
            create = create.push_constant_ranges(&ranges);
        }
        // SAFETY: the set layout was just made; the range is within the limit.
        self.handle = unsafe { device.create_pipeline_layout(&create, None) }
            .map_err(GpuError::vulkan("vkCreatePipelineLayout"))?;
        if self.slots.is_empty() {
            return Ok(());
        }
        let entries: Vec<_> = self
            .slots
            .iter()
            .enumerate()
            .map(|(index, slot)| vk::DescriptorUpdateTemplateEntry {
                dst_binding: slot.binding,
                dst_array_element: 0,
                descriptor_count: 1,
                descriptor_type: descriptor_type(&slot.kind),
                offset: index * size_of::<DescriptorData>(),
                stride: size_of::<DescriptorData>(),
            })
            .collect();
        let create = vk::DescriptorUpdateTemplateCreateInfo::default()
            .descriptor_update_entries(&entries)
            .template_type(vk::DescriptorUpdateTemplateType::PUSH_DESCRIPTORS_KHR)
            .descriptor_set_layout(self.set)
            .pipeline_bind_point(bind_point)
            .pipeline_layout(self.handle)
            .set(0);
        // SAFETY: entries match the set layout; set 0 is one of push
        // descriptors.
        self.template = unsafe { device.create_descriptor_update_template(&create, None) }
            .map_err(GpuError::vulkan("vkCreateDescriptorUpdateTemplate"))?;
        Ok(())
    }
}

impl Drop for Layout {
    fn drop(&mut self) {
        let device = &self.core.device;
        // SAFETY: submissions hold the pipeline, and so this, until the device
        // has finished. Null handles are ignored.
        unsafe {
            device.destroy_descriptor_update_template(self.template, None);
            device.destroy_pipeline_layout(self.handle, None);
            device.destroy_descriptor_set_layout(self.set, None);
        }
    }
}

/// Bindings of all stages, each once.
fn merge(core: &Core, shaders: &[&Compiled]) -> Result<Vec<Slot>, GpuError> {
    let mut slots: Vec<Slot> = Vec::new();
    for shader in shaders {
        let refuse = |cause: String| GpuError::Shader {
            shader: shader.label.clone(),
            cause,
        };
        for binding in &shader.bindings {
            if binding.group != 0 {
                return Err(refuse(format!(
                    "\"{}\" is in group {}; everything is bound in group 0",
                    binding.name, binding.group
                )));
            }
            let Some(scope) = scope(shader.stage, &binding.kind) else {
                return Err(refuse(format!(
                    "\"{}\" cannot be bound in stage {:?}, which reads storage buffers only; \
                     use a compute pass for it",
                    binding.name, shader.stage
                )));
            };
            let stage = stage_flag(shader.stage);
            match slots
                .iter_mut()
                .find(|slot| slot.binding == binding.binding)
            {
                Some(slot) if slot.name == binding.name && slot.kind == binding.kind => {
                    slot.scope = slot.scope.union(scope);
                    slot.stages |= stage;
                }
                Some(slot) => {
                    return Err(refuse(format!(
                        "binding {} is \"{}\" here and \"{}\" in the other stage, or of another \
                         kind there; give both stages the same declaration",
                        binding.binding, binding.name, slot.name
                    )));
                }
                None => slots.push(Slot {
                    name: binding.name.clone(),
                    binding: binding.binding,
                    kind: binding.kind,
                    scope,
                    stages: stage,
                }),
            }
        }
        let limit = core.info.limits.bindings.min(32);
        if slots.len() > limit as usize {
            return Err(refuse(format!(
                "{} bindings are over the limit of {limit}; merge some buffers",
                slots.len()
            )));
        }
    }
    Ok(slots)
}

fn stage_flag(stage: Stage) -> vk::ShaderStageFlags {
    match stage {
        Stage::Vertex => vk::ShaderStageFlags::VERTEX,
        Stage::Fragment => vk::ShaderStageFlags::FRAGMENT,
        Stage::Compute => vk::ShaderStageFlags::COMPUTE,
    }
}

fn descriptor_type(kind: &BindingKind) -> vk::DescriptorType {
    match kind {
        BindingKind::Storage { .. } => vk::DescriptorType::STORAGE_BUFFER,
        BindingKind::Texels(_) => vk::DescriptorType::STORAGE_TEXEL_BUFFER,
        BindingKind::Uniform { .. } => vk::DescriptorType::UNIFORM_BUFFER,
        BindingKind::SampledImage { .. } => vk::DescriptorType::SAMPLED_IMAGE,
        BindingKind::StorageImage { .. } => vk::DescriptorType::STORAGE_IMAGE,
        BindingKind::Sampler { .. } => vk::DescriptorType::SAMPLER,
    }
}

/// How `stage` accesses a binding; `None` where the stage cannot have one of that kind.
fn scope(stage: Stage, kind: &BindingKind) -> Option<Scope> {
    let pick = |readable: bool, writable: bool| {
        let mut scope = Scope::NONE;
        if readable {
            scope = scope.union(Scope::COMPUTE_READ);
        }
        if writable {
            scope = scope.union(Scope::COMPUTE_WRITE);
        }
        scope
    };
    Some(match (stage, *kind) {
        (Stage::Vertex, BindingKind::Storage { writable: false }) => Scope::VERTEX_READ,
        (Stage::Fragment, BindingKind::Storage { writable: false }) => Scope::FRAGMENT_READ,
        (Stage::Vertex | Stage::Fragment, _) => return None,
        (_, BindingKind::Storage { writable }) => pick(true, writable),
        (_, BindingKind::Uniform { .. }) => Scope::COMPUTE_UNIFORM,
        (_, BindingKind::Texels(_)) => Scope::COMPUTE_READ,
        (_, BindingKind::SampledImage { .. }) => Scope::COMPUTE_SAMPLED,
        (
            _,
            BindingKind::StorageImage {
                readable, writable, ..
            },
        ) => pick(readable, writable),
        (_, BindingKind::Sampler { .. }) => Scope::NONE,
    })
}
