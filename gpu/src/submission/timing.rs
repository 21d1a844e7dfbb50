//! Labels, times and markers of the passes of one submission.

use std::sync::Arc;

use ash::vk;

use crate::device::Core;
use crate::{Buffer, GpuError};

/// Time of one pass on the device.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTiming {
    /// Label of the pass; "total" for the whole submission.
    pub label: String,
    /// From the end of the work before it to its own end, in nanoseconds.
    pub nanoseconds: f64,
    /// Bytes of the buffers that it binds, each counted once.
    pub bytes: u64,
}

/// Labels of passes, end to end in one string, so that none is allocated.
#[derive(Default)]
pub(crate) struct Names {
    text: String,
    ends: Vec<usize>,
    bytes: Vec<u64>,
}

impl Names {
    pub(crate) fn push(&mut self, name: &str, bytes: u64) {
        self.text.push_str(name);
        self.ends.push(self.text.len());
        self.bytes.push(bytes);
    }

    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }

    pub(crate) fn get(&self, index: usize) -> &str {
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        &self.text[start..self.ends[index]]
    }

    pub(crate) fn clear(&mut self) {
        self.text.clear();
        self.ends.clear();
        self.bytes.clear();
    }
}

/// Timestamps of one pool.
const POOL_SIZE: u32 = 512;

/// Timestamps: one at the start, one at the end of each pass where that is asked for, one at the end.
pub(crate) struct Queries {
    pub(crate) of_passes: bool,
    pools: Vec<vk::QueryPool>,
    written: u32,
}

impl Queries {
    pub(crate) fn new(of_passes: bool) -> Self {
        Self {
            of_passes,
            pools: Vec::new(),
            written: 0,
        }
    }

    pub(crate) fn begin(&mut self) {
        self.written = 0;
    }

    /// Writes a timestamp when all work before it is done. `ALL_COMMANDS`: a
    /// stamp at the top of the pipe would not wait for the barrier before it.
    pub(crate) fn write(&mut self, core: &Core, cmd: vk::CommandBuffer) -> Result<(), GpuError> {
        let size = if self.of_passes { POOL_SIZE } else { 2 };
        let (pool, query) = (self.written / size, self.written % size);
        if pool as usize == self.pools.len() {
            let create = vk::QueryPoolCreateInfo::default()
                .query_type(vk::QueryType::TIMESTAMP)
                .query_count(size);
            // SAFETY: the device is alive.
            let made = unsafe { core.device.create_query_pool(&create, None) }
                .map_err(GpuError::vulkan("vkCreateQueryPool"))?;
            self.pools.push(made);
        }
        let handle = self.pools[pool as usize];
        // SAFETY: `cmd` is recording outside a raster scope; the query is in
        // the pool and was reset after its last use.
        unsafe {
            if query == 0 {
                core.device.cmd_reset_query_pool(cmd, handle, 0, size);
            }
            core.device.cmd_write_timestamp2(
                cmd,
                vk::PipelineStageFlags2::ALL_COMMANDS,
                handle,
                query,
            );
        }
        self.written += 1;
        Ok(())
    }

    pub(crate) fn read(
        &mut self,
        core: &Core,
        names: &Names,
        mask: u64,
    ) -> Result<Vec<PassTiming>, GpuError> {
        let mut stamps = vec![0_u64; self.written as usize];
        for (pool, part) in self.pools.iter().zip(stamps.chunks_mut(POOL_SIZE as usize)) {
            // SAFETY: the device has written these queries.
            unsafe {
                core.device
                    .get_query_pool_results(*pool, 0, part, vk::QueryResultFlags::TYPE_64)
            }
            .map_err(GpuError::vulkan("vkGetQueryPoolResults"))?;
        }
        let none = Names::default();
        let names = if self.of_passes { names } else { &none };
        Ok(timings(&stamps, names, mask, core.info.timestamp_period))
    }

    pub(crate) fn destroy(&mut self, core: &Core) {
        for pool in self.pools.drain(..) {
            // SAFETY: the device has finished what used the pool.
            unsafe { core.device.destroy_query_pool(pool, None) };
        }
    }
}

/// Times from stamps: one before everything, then one after each pass.
fn timings(stamps: &[u64], names: &Names, mask: u64, period: f32) -> Vec<PassTiming> {
    // Counters with fewer than 64 bits wrap.
    let elapsed = |from: u64, to: u64| (to.wrapping_sub(from) & mask) as f64 * f64::from(period);
    let mut list: Vec<PassTiming> = stamps
        .windows(2)
        .take(names.len())
        .enumerate()
        .map(|(index, pair)| PassTiming {
            label: names.get(index).to_owned(),
            nanoseconds: elapsed(pair[0], pair[1]),
            bytes: names.bytes[index],
        })
        .collect();
    if let (Some(first), Some(last)) = (stamps.first(), stamps.last()) {
        list.push(PassTiming {
            label: "total".to_owned(),
            nanoseconds: elapsed(*first, *last),
            bytes: names.bytes.iter().sum(),
        });
    }
    list
}

/// Passes that can be marked in one submission.
const MARKED_PASSES: usize = 4096;

/// One word a pass in host memory, set as the device reaches the pass. A word
/// each, because writes to the same one would have to be ordered by barriers.
pub(crate) struct Markers {
    buffer: Buffer,
}

impl Markers {
    pub(crate) fn new(core: &Arc<Core>) -> Result<Self, GpuError> {
        let markers = Self {
            buffer: Buffer::readback(core, "markers", 4 * MARKED_PASSES as u64)?,
        };
        markers.clear(MARKED_PASSES)?;
        Ok(markers)
    }

    pub(crate) fn write(&self, core: &Core, cmd: vk::CommandBuffer, pass: usize) {
        if pass < MARKED_PASSES {
            // SAFETY: `cmd` is recording outside a raster scope; the word lies
            // in the buffer, which lives as long as the storage.
            unsafe {
                core.device
                    .cmd_fill_buffer(cmd, self.buffer.inner.handle, 4 * pass as u64, 4, 1);
            }
        }
    }

    pub(crate) fn clear(&self, passes: usize) -> Result<(), GpuError> {
        let words = [0_u32; 64];
        let passes = passes.min(MARKED_PASSES);
        for start in (0..passes).step_by(words.len()) {
            let count = words.len().min(passes - start);
            self.buffer
                .inner
                .write_at(4 * start as u64, bytemuck::cast_slice(&words[..count]))?;
        }
        Ok(())
    }

    /// Index of the last pass reached.
    pub(crate) fn reached(&self, passes: usize) -> Option<usize> {
        let words: Vec<u32> = self
            .buffer
            .inner
            .read_at(0, passes.min(MARKED_PASSES))
            .ok()?;
        words.iter().rposition(|word| *word != 0)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn times_from_a_counter_that_wraps() {
        let mut names = Names::default();
        names.push("a", 16);
        names.push("bc", 32);
        // 36 valid bits, as some drivers have; 2 ns a tick.
        let mask = (1 << 36) - 1;
        let list = timings(&[mask - 9, mask, 19], &names, mask, 2.0);
        let expected = [("a", 18.0), ("bc", 40.0), ("total", 58.0)];
        assert_eq!(list.len(), expected.len());
        for (timing, (label, nanoseconds)) in list.iter().zip(expected) {
            assert_eq!(
                (timing.label.as_str(), timing.nanoseconds),
                (label, nanoseconds)
            );
        }
    }
}
