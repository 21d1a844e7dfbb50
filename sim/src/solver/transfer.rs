//! Whole buffers from the host and back.

use super::error::SolverError;
use vitriol_gpu::{Buffer, Gpu, GpuError, Recorder};

/// The first `count` elements; buffers are a few bytes longer where a scene is empty. Waits for the device.
pub(super) fn read<T: bytemuck::AnyBitPattern>(
    gpu: &Gpu,
    buffer: &Buffer,
    count: usize,
) -> Result<Vec<T>, SolverError> {
    let mut all = gpu.read(buffer)?;
    all.truncate(count);
    Ok(all)
}

/// A new buffer that holds `data` from this place of `rec` on.
pub(super) fn upload<T: bytemuck::NoUninit>(
    gpu: &Gpu,
    rec: &mut Recorder,
    label: &str,
    data: &[T],
) -> Result<Buffer, GpuError> {
    let buffer = Buffer::storage(gpu, label, size_of_val(data) as u64)?;
    rec.upload(&buffer, data)?;
    Ok(buffer)
}
