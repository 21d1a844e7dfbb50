//! The layer's messages are caught: mistakes made on purpose, past this crate's
//! own checks, are among them.

use vitriol_gpu::{Buffer, Gpu, ash, vk};

use crate::common::open;

/// The device without this crate's checks; `gpu` must outlive it.
fn raw(gpu: &Gpu) -> (ash::Entry, ash::Device) {
    let handles = gpu.handles();
    // SAFETY: the handles are alive as long as `gpu`.
    unsafe {
        let entry = ash::Entry::load().unwrap();
        let instance = ash::Instance::load(entry.static_fn(), handles.instance);
        let device = ash::Device::load(instance.fp_v1_0(), handles.device);
        (entry, device)
    }
}

#[test]
fn a_mistake_made_on_purpose_is_collected() {
    let gpu = open();
    let (_entry, device) = raw(&gpu);
    assert_eq!(gpu.validation_messages(), Vec::<String>::new());
    // A buffer of no size.
    let create = vk::BufferCreateInfo::default().usage(vk::BufferUsageFlags::TRANSFER_SRC);
    // SAFETY: the layer reports it; drivers make an empty buffer or refuse.
    unsafe {
        if let Ok(buffer) = device.create_buffer(&create, None) {
            device.destroy_buffer(buffer, None);
        }
    }
    let messages = gpu.take_validation_messages();
    assert!(
        messages
            .iter()
            .any(|text| text.contains("VUID-VkBufferCreateInfo-size")),
        "{messages:?}"
    );
    assert_eq!(gpu.validation_messages(), Vec::<String>::new());
}

#[test]
fn synchronisation_validation_is_on() {
    let gpu = open();
    let (_entry, device) = raw(&gpu);
    let [a, b, c] = ["a", "b", "c"].map(|l| Buffer::storage(&gpu, l, 64).unwrap());
    let pool = vk::CommandPoolCreateInfo::default().queue_family_index(gpu.handles().family);
    let region = [vk::BufferCopy {
        src_offset: 0,
        dst_offset: 0,
        size: 64,
    }];
    // SAFETY: the commands are only recorded, never submitted.
    unsafe {
        let pool = device.create_command_pool(&pool, None).unwrap();
        let allocate = vk::CommandBufferAllocateInfo::default()
            .command_pool(pool)
            .command_buffer_count(1);
        let cmd = device.allocate_command_buffers(&allocate).unwrap()[0];
        device
            .begin_command_buffer(cmd, &vk::CommandBufferBeginInfo::default())
            .unwrap();
        device.cmd_copy_buffer(cmd, a.handle(), b.handle(), &region);
        // No barrier between the write and the read of b.
        device.cmd_copy_buffer(cmd, b.handle(), c.handle(), &region);
        device.end_command_buffer(cmd).unwrap();
        device.destroy_command_pool(pool, None);
    }
    let messages = gpu.take_validation_messages();
    assert!(
        messages
            .iter()
            .any(|text| text.contains("SYNC-HAZARD-READ-AFTER-WRITE")),
        "{messages:?}"
    );
}
