//! Images of swapchains, on the session's device.
//!
//! A released image is used as a compositor would: commands on the session's queue take it out of the layout in which the application has
//! to give it back, and into it again. So Vulkan's validation reports one that is given back in another layout.

use ash::vk;
use openxr::sys;
use sys::Result as R;

use crate::vulkan::Device;

/// Images of each swapchain.
const IMAGES: usize = 3;

/// The images of a swapchain.
#[derive(Default)]
pub(crate) struct Pictures {
    pub all: Vec<Picture>,
    pool: vk::CommandPool,
}

/// One image of a swapchain.
#[derive(Default)]
pub(crate) struct Picture {
    pub image: vk::Image,
    memory: vk::DeviceMemory,
    /// The commands that use it as a compositor would.
    look: vk::CommandBuffer,
    /// Signalled where these commands are not under way. A runtime waits for its own work before it destroys an image: the application
    /// cannot.
    looked: vk::Fence,
}

/// The Vulkan usage for an OpenXR usage.
fn usage(flags: sys::SwapchainUsageFlags) -> vk::ImageUsageFlags {
    use sys::SwapchainUsageFlags as X;
    use vk::ImageUsageFlags as V;
    let pairs = [
        (X::COLOR_ATTACHMENT, V::COLOR_ATTACHMENT),
        (X::DEPTH_STENCIL_ATTACHMENT, V::DEPTH_STENCIL_ATTACHMENT),
        (X::UNORDERED_ACCESS, V::STORAGE),
        (X::TRANSFER_SRC, V::TRANSFER_SRC),
        (X::TRANSFER_DST, V::TRANSFER_DST),
    ];
    // The runtime itself would sample it.
    let asked = pairs.iter().filter(|(flag, _)| flags.contains(*flag));
    asked.fold(V::SAMPLED, |all, (_, usage)| all | *usage)
}

/// Whether the format is one of depth.
pub(crate) fn is_depth(format: i64) -> bool {
    [
        vk::Format::D16_UNORM,
        vk::Format::D32_SFLOAT,
        vk::Format::D24_UNORM_S8_UINT,
        vk::Format::D32_SFLOAT_S8_UINT,
    ]
    .iter()
    .any(|depth| i64::from(depth.as_raw()) == format)
}

/// The layout in which the application has an image, and its aspects.
fn home(format: i64) -> (vk::ImageLayout, vk::ImageAspectFlags) {
    use vk::ImageAspectFlags as A;
    let with_stencil = [
        vk::Format::D24_UNORM_S8_UINT,
        vk::Format::D32_SFLOAT_S8_UINT,
    ];
    let has_stencil = with_stencil
        .iter()
        .any(|stencil| i64::from(stencil.as_raw()) == format);
    let depth = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    match (is_depth(format), has_stencil) {
        (true, true) => (depth, A::DEPTH | A::STENCIL),
        (true, false) => (depth, A::DEPTH),
        (false, _) => (vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL, A::COLOR),
    }
}

impl Device {
    /// Images for a swapchain, in the layout in which the application gets them.
    pub(crate) fn pictures(&self, info: &sys::SwapchainCreateInfo) -> Result<Pictures, R> {
        let mut pictures = Pictures::default();
        match self.fill(&mut pictures, info) {
            Ok(()) => Ok(pictures),
            Err(_) => {
                self.destroy(&pictures);
                Err(R::ERROR_RUNTIME_FAILURE)
            }
        }
    }

    fn fill(
        &self,
        pictures: &mut Pictures,
        info: &sys::SwapchainCreateInfo,
    ) -> Result<(), vk::Result> {
        for _ in 0..IMAGES {
            pictures.all.push(self.picture(info)?);
        }
        let pool = vk::CommandPoolCreateInfo::default().queue_family_index(self.family);
        // SAFETY: the device is the session's.
        pictures.pool = unsafe { self.device.create_command_pool(&pool, None)? };
        let (home, aspect) = home(info.format);
        let away = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        let mut begin = Vec::new();
        for picture in &mut pictures.all {
            let step = |from, to| (picture.image, aspect, from, to);
            let looks = [step(home, away), step(away, home)];
            begin.push(step(vk::ImageLayout::UNDEFINED, home));
            picture.look = self.record(pictures.pool, &looks)?;
        }
        let begin = self.record(pictures.pool, &begin)?;
        // SAFETY: while a swapchain is made, nothing else is submitted to the queue (as Monado requires of its clients too). It waits for
        // submitted work: the application need not.
        unsafe {
            self.submit(begin, vk::Fence::null())?;
            self.device.queue_wait_idle(self.queue)
        }
    }

    fn picture(&self, info: &sys::SwapchainCreateInfo) -> Result<Picture, vk::Result> {
        let flags = match info
            .usage_flags
            .contains(sys::SwapchainUsageFlags::MUTABLE_FORMAT)
        {
            true => vk::ImageCreateFlags::MUTABLE_FORMAT,
            false => vk::ImageCreateFlags::empty(),
        };
        let create = vk::ImageCreateInfo::default()
            .flags(flags)
            .image_type(vk::ImageType::TYPE_2D)
            .format(vk::Format::from_raw(info.format as i32))
            .extent(vk::Extent3D {
                width: info.width,
                height: info.height,
                depth: 1,
            })
            .mip_levels(info.mip_count)
            .array_layers(info.array_size)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(usage(info.usage_flags));
        // SAFETY: the create info is complete; the device is the session's, and lives as long.
        unsafe {
            let image = self.device.create_image(&create, None)?;
            let needs = self.device.get_image_memory_requirements(image);
            let kinds = self
                .instance
                .get_physical_device_memory_properties(self.physical);
            let fits = |kind: &u32| needs.memory_type_bits & (1 << kind) != 0;
            let local = |kind: &u32| {
                kinds.memory_types[*kind as usize]
                    .property_flags
                    .contains(vk::MemoryPropertyFlags::DEVICE_LOCAL)
            };
            let all = || (0..kinds.memory_type_count).filter(fits);
            let kind = all().find(local).or_else(|| all().next()).unwrap_or(0);
            let allocate = vk::MemoryAllocateInfo::default()
                .allocation_size(needs.size)
                .memory_type_index(kind);
            let memory = self
                .device
                .allocate_memory(&allocate, None)
                .and_then(|memory| {
                    let bound = self.device.bind_image_memory(image, memory, 0);
                    bound
                        .map(|()| memory)
                        .inspect_err(|_| self.device.free_memory(memory, None))
                });
            let memory = memory.inspect_err(|_| self.device.destroy_image(image, None))?;
            let signalled = vk::FenceCreateInfo::default().flags(vk::FenceCreateFlags::SIGNALED);
            let looked = self.device.create_fence(&signalled, None);
            let looked = looked.inspect_err(|_| {
                self.device.destroy_image(image, None);
                self.device.free_memory(memory, None);
            })?;
            Ok(Picture {
                image,
                memory,
                look: vk::CommandBuffer::null(),
                looked,
            })
        }
    }

    /// Commands that take images from one layout to another, one after the other, between all that is before
    /// and all that is after. They can be submitted again and again.
    fn record(
        &self,
        pool: vk::CommandPool,
        steps: &[(
            vk::Image,
            vk::ImageAspectFlags,
            vk::ImageLayout,
            vk::ImageLayout,
        )],
    ) -> Result<vk::CommandBuffer, vk::Result> {
        let allocate = vk::CommandBufferAllocateInfo::default()
            .command_pool(pool)
            .command_buffer_count(1);
        let begin = vk::CommandBufferBeginInfo::default()
            .flags(vk::CommandBufferUsageFlags::SIMULTANEOUS_USE);
        let all = vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE;
        let stages = vk::PipelineStageFlags::ALL_COMMANDS;
        // SAFETY: pool and images are of this device.
        unsafe {
            let commands = self.device.allocate_command_buffers(&allocate)?[0];
            self.device.begin_command_buffer(commands, &begin)?;
            for &(image, aspect_mask, old, new) in steps {
                let barrier = vk::ImageMemoryBarrier::default()
                    .src_access_mask(all)
                    .dst_access_mask(all)
                    .old_layout(old)
                    .new_layout(new)
                    .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .image(image)
                    .subresource_range(vk::ImageSubresourceRange {
                        aspect_mask,
                        level_count: vk::REMAINING_MIP_LEVELS,
                        layer_count: vk::REMAINING_ARRAY_LAYERS,
                        ..Default::default()
                    });
                let none = vk::DependencyFlags::empty();
                self.device.cmd_pipeline_barrier(
                    commands,
                    stages,
                    stages,
                    none,
                    &[],
                    &[],
                    &[barrier],
                );
            }
            self.device.end_command_buffer(commands)?;
            Ok(commands)
        }
    }

    /// # Safety
    /// The commands are of this device and of the queue's family; nobody else uses the queue meanwhile.
    unsafe fn submit(
        &self,
        commands: vk::CommandBuffer,
        done: vk::Fence,
    ) -> Result<(), vk::Result> {
        let commands = [commands];
        let submit = vk::SubmitInfo::default().command_buffers(&commands);
        // SAFETY: by this function's own contract.
        unsafe { self.device.queue_submit(self.queue, &[submit], done) }
    }

    /// Uses a released image as a compositor would.
    pub(crate) fn look(&self, picture: &Picture) -> Result<(), R> {
        // SAFETY: XR_KHR_vulkan_enable2 has the application leave the queue alone meanwhile. The fence is this image's own, and signalled
        // once its last use is over.
        let submitted = unsafe {
            self.device
                .wait_for_fences(&[picture.looked], true, u64::MAX)
                .and_then(|()| self.device.reset_fences(&[picture.looked]))
                .and_then(|()| self.submit(picture.look, picture.looked))
        };
        submitted.map_err(|_| R::ERROR_RUNTIME_FAILURE)
    }

    /// Destroys images that the application does not use any more.
    pub(crate) fn destroy(&self, pictures: &Pictures) {
        // SAFETY: all of it was made of this device, and OpenXR requires of its callers that the device is done with a swapchain's images
        // before it is destroyed.
        unsafe {
            let looks: Vec<_> = pictures.all.iter().map(|picture| picture.looked).collect();
            if !looks.is_empty() {
                // It fails on a lost device, which executes nothing any more.
                let _ = self.device.wait_for_fences(&looks, true, u64::MAX);
            }
            self.device.destroy_command_pool(pictures.pool, None);
            for picture in &pictures.all {
                self.device.destroy_fence(picture.looked, None);
                self.device.destroy_image(picture.image, None);
                self.device.free_memory(picture.memory, None);
            }
        }
    }
}
