//! Whole buffers from the host and back; each waits for the device.

use super::error::SolverError;
use vitriol_gpu::{Buffer, Gpu, GpuError};

/// The first `count` elements; buffers are a few bytes longer where a scene is empty.
pub(super) fn read<T: bytemuck::AnyBitPattern>(
    gpu: &Gpu,
    buffer: &Buffer,
    count: usize,
) -> Result<Vec<T>, SolverError> {
    let mut all = gpu.read(buffer)?;
    all.truncate(count);
    Ok(all)
}

pub(super) fn write<T: bytemuck::NoUninit>(
    gpu: &Gpu,
    buffer: &Buffer,
    data: &[T],
) -> Result<(), GpuError> {
    if !data.is_empty() {
        gpu.write(buffer, data)?;
    }
    Ok(())
}

/// A new buffer that holds `data`.
pub(super) fn upload<T: bytemuck::NoUninit>(
    gpu: &Gpu,
    label: &str,
    data: &[T],
) -> Result<Buffer, GpuError> {
    let buffer = Buffer::storage(gpu, label, size_of_val(data) as u64)?;
    write(gpu, &buffer, data)?;
    Ok(buffer)
}
