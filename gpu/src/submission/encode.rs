//! Commands around every pass: barriers, labels, timestamps, markers.

use std::ffi::CStr;
use std::sync::Arc;

use ash::vk;

use super::Submission;
use super::storage::Storage;
use crate::GpuError;
use crate::barrier::{Barrier, Use};
use crate::pipeline::LayoutPush;

impl Storage {
    pub(crate) fn begin(&mut self, submission: Arc<Submission>) -> Result<(), GpuError> {
        self.submission = submission;
        self.bound = vk::Pipeline::null();
        self.host_reads = false;
        let inheritance = vk::CommandBufferInheritanceInfo::default();
        let flags = if self.is_bundle {
            // The next submission executes the bundle while the device still executes the one before.
            vk::CommandBufferUsageFlags::SIMULTANEOUS_USE
        } else {
            vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT
        };
        let begin = vk::CommandBufferBeginInfo::default()
            .flags(flags)
            .inheritance_info(&inheritance);
        // SAFETY: the pool was made or reset, so the buffer is in its initial
        // state.
        unsafe { self.core.device.begin_command_buffer(self.cmd, &begin) }
            .map_err(GpuError::vulkan("vkBeginCommandBuffer"))?;
        if self.is_bundle {
            // The recorder that executes a bundle orders it as one pass.
            return Ok(());
        }
        // After everything that was submitted to this queue before; that is why
        // tracking can start afresh in every recorder.
        self.global_barrier(
            (
                vk::PipelineStageFlags2::ALL_COMMANDS,
                vk::AccessFlags2::MEMORY_WRITE,
            ),
            (
                vk::PipelineStageFlags2::ALL_COMMANDS,
                vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE,
            ),
        );
        if let Some(queries) = &mut self.queries {
            queries.begin();
            queries.write(&self.core, self.cmd)?;
        }
        Ok(())
    }

    pub(crate) fn end(&mut self) -> Result<(), GpuError> {
        self.images_home();
        if self.is_bundle {
            return self.end_commands();
        }
        if self.host_reads || self.markers.is_some() {
            self.global_barrier(
                (
                    vk::PipelineStageFlags2::ALL_TRANSFER,
                    vk::AccessFlags2::TRANSFER_WRITE,
                ),
                (vk::PipelineStageFlags2::HOST, vk::AccessFlags2::HOST_READ),
            );
        }
        if let Some(queries) = &mut self.queries {
            queries.write(&self.core, self.cmd)?;
        }
        self.end_commands()
    }

    fn end_commands(&self) -> Result<(), GpuError> {
        // SAFETY: the buffer is recording; labels are closed.
        unsafe { self.core.device.end_command_buffer(self.cmd) }
            .map_err(GpuError::vulkan("vkEndCommandBuffer"))
    }

    fn global_barrier(
        &self,
        (src_stages, src_access): (vk::PipelineStageFlags2, vk::AccessFlags2),
        (dst_stages, dst_access): (vk::PipelineStageFlags2, vk::AccessFlags2),
    ) {
        let barriers = [vk::MemoryBarrier2::default()
            .src_stage_mask(src_stages)
            .src_access_mask(src_access)
            .dst_stage_mask(dst_stages)
            .dst_access_mask(dst_access)];
        let info = vk::DependencyInfo::default().memory_barriers(&barriers);
        // SAFETY: the buffer is recording outside a raster scope.
        unsafe { self.core.device.cmd_pipeline_barrier2(self.cmd, &info) };
    }

    /// One barrier command for the planner's barrier and `image_barriers`.
    fn emit(&mut self, barrier: Option<Barrier>) {
        if barrier.is_none() && self.image_barriers.is_empty() {
            return;
        }
        let mut memory = vk::MemoryBarrier2::default();
        if let Some(Barrier { src, dst }) = barrier {
            memory = memory
                .src_stage_mask(src.stages())
                .src_access_mask(src.write_accesses())
                .dst_stage_mask(dst.stages())
                .dst_access_mask(dst.accesses());
            if self.markers.is_some() {
                // The marker of the next pass waits for the passes before it.
                memory.dst_stage_mask |= vk::PipelineStageFlags2::ALL_TRANSFER;
            }
        }
        let memory = [memory];
        let mut info = vk::DependencyInfo::default().image_memory_barriers(&self.image_barriers);
        if barrier.is_some() {
            info = info.memory_barriers(&memory);
        }
        // SAFETY: the buffer is recording outside a raster scope; images are
        // held by the storage.
        unsafe { self.core.device.cmd_pipeline_barrier2(self.cmd, &info) };
        self.image_barriers.clear();
    }

    /// Commands before every pass; its uses are in `uses`, `image_uses`.
    pub(crate) fn open_pass(&mut self, label: &[u8]) -> Result<(), GpuError> {
        for index in 0..self.image_uses.len() {
            let used = self.image_uses[index];
            let state = &mut self.images[used.index];
            if state.layout != used.layout {
                let old = if used.discard {
                    vk::ImageLayout::UNDEFINED
                } else {
                    state.layout
                };
                let src = self.planner.transition(state.slot, used.scope);
                self.image_barriers.push(
                    vk::ImageMemoryBarrier2::default()
                        .src_stage_mask(src.stages())
                        .src_access_mask(src.write_accesses())
                        .dst_stage_mask(used.scope.stages())
                        .dst_access_mask(used.scope.accesses())
                        .old_layout(old)
                        .new_layout(used.layout)
                        .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                        .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                        .image(state.image.handle)
                        .subresource_range(state.image.range()),
                );
                state.layout = used.layout;
            }
            let slot = state.slot;
            self.uses.push(Use {
                slot,
                scope: used.scope,
            });
        }
        let barrier = self.planner.pass(&self.uses);
        self.emit(barrier);
        if self.times_passes() || self.markers.is_some() {
            let text = String::from_utf8_lossy(label);
            self.names.push(&text, self.pass_bytes);
        }
        if let Some(markers) = &self.markers {
            markers.write(&self.core, self.cmd, self.names.len() - 1);
        }
        self.open_label(label);
        Ok(())
    }

    /// Pushes a pass's or draw's descriptors and immediates.
    pub(crate) fn bind(&self, layout: &LayoutPush, descriptors: usize, constants: usize) {
        // SAFETY: the buffer is recording; the template reads as many
        // descriptors as `Binder::new` reserved from there on, all of them
        // filled (checked), with objects that the storage holds; the immediates
        // are as many bytes as the layout has (checked).
        unsafe {
            if layout.template != vk::DescriptorUpdateTemplate::null() {
                self.core.push.cmd_push_descriptor_set_with_template(
                    self.cmd,
                    layout.template,
                    layout.handle,
                    0,
                    self.descriptors[descriptors..].as_ptr().cast(),
                );
            }
            if layout.immediate_bytes > 0 {
                self.core.device.cmd_push_constants(
                    self.cmd,
                    layout.handle,
                    layout.immediate_stages,
                    0,
                    &self.constants[constants..constants + layout.immediate_bytes],
                );
            }
        }
    }

    /// Records the draws of the open scope.
    pub(crate) fn replay_draws(&mut self) {
        self.bound = vk::Pipeline::null();
        let mut bound = vk::Pipeline::null();
        for draw in &self.draws {
            let device = &self.core.device;
            if bound != draw.pipeline {
                bound = draw.pipeline;
                // SAFETY: the buffer is recording; the pipeline is held.
                unsafe {
                    device.cmd_bind_pipeline(
                        self.cmd,
                        vk::PipelineBindPoint::GRAPHICS,
                        draw.pipeline,
                    );
                }
            }
            self.bind(&draw.push, draw.descriptors, draw.constants);
            // SAFETY: pipeline, descriptors and immediates are bound; buffers
            // are held, and their ranges were checked when the draw was made.
            unsafe {
                device.cmd_bind_index_buffer(self.cmd, draw.indices, 0, vk::IndexType::UINT32);
                device.cmd_draw_indexed(self.cmd, draw.count, 1, 0, 0, 0);
            }
        }
    }

    /// Commands after every pass.
    pub(crate) fn close_pass(&mut self) -> Result<(), GpuError> {
        self.close_label();
        if let Some(queries) = self.queries.as_mut().filter(|it| it.of_passes) {
            queries.write(&self.core, self.cmd)?;
        }
        self.clear_pass();
        Ok(())
    }

    fn times_passes(&self) -> bool {
        self.queries.as_ref().is_some_and(|it| it.of_passes)
    }

    pub(crate) fn open_label(&mut self, label: &[u8]) {
        let Some(functions) = &self.core.labels else {
            return;
        };
        self.label.clear();
        self.label.extend_from_slice(label);
        self.label.push(0);
        if let Ok(name) = CStr::from_bytes_until_nul(&self.label) {
            let info = vk::DebugUtilsLabelEXT::default().label_name(name);
            // SAFETY: the buffer is recording; the name lives through the call.
            unsafe { functions.cmd_begin_debug_utils_label(self.cmd, &info) };
        }
    }

    pub(crate) fn close_label(&self) {
        if let Some(functions) = &self.core.labels {
            // SAFETY: the buffer is recording and a label is open.
            unsafe { functions.cmd_end_debug_utils_label(self.cmd) };
        }
    }

    /// Brings every image back to the layout in which recorders find it.
    fn images_home(&mut self) {
        for state in &mut self.images {
            if state.layout == state.image.home {
                continue;
            }
            self.image_barriers.push(
                vk::ImageMemoryBarrier2::default()
                    .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
                    .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
                    .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
                    .old_layout(state.layout)
                    .new_layout(state.image.home)
                    .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .image(state.image.handle)
                    .subresource_range(state.image.range()),
            );
            state.layout = state.image.home;
        }
        self.emit(None);
    }
}
