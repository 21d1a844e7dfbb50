//! Buffers, images and samplers.

mod buffer;
mod image;
mod sampler;
mod spares;

use std::sync::atomic::{AtomicU64, Ordering};

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};

pub use buffer::{Buffer, bytes_of_elements};
pub(crate) use image::ImageInner;
pub use image::{Image, ImageDesc};
pub use sampler::Sampler;
pub(crate) use spares::{Spare, Spares};

use crate::GpuError;
use crate::device::{Core, lock_memory};

/// A number that no other resource of this process has.
fn next_id() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

fn allocate(
    core: &Core,
    label: &str,
    requirements: vk::MemoryRequirements,
    location: MemoryLocation,
    linear: bool,
) -> Result<Allocation, GpuError> {
    lock_memory(&core.allocator)
        .allocate(&AllocationCreateDesc {
            name: label,
            requirements,
            location,
            linear,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        })
        .map_err(|error| GpuError::OutOfMemory {
            label: label.to_owned(),
            bytes: Some(requirements.size),
            cause: error.to_string(),
        })
}

fn free(core: &Core, allocation: &mut Allocation) {
    if let Err(error) = lock_memory(&core.allocator).free(std::mem::take(allocation)) {
        tracing::error!("device memory could not be freed: {error}");
    }
}
