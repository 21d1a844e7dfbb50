//! Readback buffers that are not used any more, kept for the next ones of their size. A frame that reads back allocates none, so it does
//! not wait for a thread that allocates blocks, which take the driver milliseconds.

use std::collections::VecDeque;
use std::sync::Mutex;

use ash::vk;
use gpu_allocator::vulkan::Allocation;

use crate::device::lock;

/// Most bytes of spare buffers: some states of a scene of 10,000 particles. The oldest are freed first.
const MOST: u64 = 1 << 26;

/// Handle and memory of a readback buffer.
pub(crate) struct Spare {
    pub(crate) handle: vk::Buffer,
    pub(crate) allocation: Allocation,
    pub(crate) bytes: u64,
}

/// A device's spare readback buffers, oldest first.
#[derive(Default)]
pub(crate) struct Spares(Mutex<VecDeque<Spare>>);

impl Spares {
    /// Takes a spare buffer of exactly `bytes` bytes, if there is one.
    pub(crate) fn take(&self, bytes: u64) -> Option<Spare> {
        let mut spares = lock(&self.0);
        let place = spares.iter().position(|spare| spare.bytes == bytes)?;
        spares.remove(place)
    }

    /// Adds a spare buffer, and returns those that exceed [`MOST`], to be destroyed.
    pub(crate) fn put(&self, spare: Spare) -> Vec<Spare> {
        let mut spares = lock(&self.0);
        spares.push_back(spare);
        let mut held: u64 = spares.iter().map(|spare| spare.bytes).sum();
        let mut gone = Vec::new();
        while held > MOST
            && let Some(oldest) = spares.pop_front()
        {
            held -= oldest.bytes;
            gone.push(oldest);
        }
        gone
    }

    /// Takes all spare buffers, at the device's end.
    pub(crate) fn take_all(&self) -> Vec<Spare> {
        lock(&self.0).drain(..).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(bytes: u64) -> Spare {
        Spare {
            handle: vk::Buffer::null(),
            allocation: Allocation::default(),
            bytes,
        }
    }

    #[test]
    fn one_of_the_size_is_found_and_the_oldest_goes() {
        let spares = Spares::default();
        assert!(spares.put(of(16)).is_empty() && spares.put(of(64)).is_empty());
        assert!(spares.take(32).is_none());
        assert_eq!(spares.take(64).map(|spare| spare.bytes), Some(64));
        assert!(spares.take(64).is_none());
        let sizes = |gone: Vec<Spare>| gone.iter().map(|spare| spare.bytes).collect::<Vec<_>>();
        assert_eq!(sizes(spares.put(of(MOST - 16))), [0; 0]);
        assert_eq!(sizes(spares.put(of(4))), [16]);
        // A buffer that is larger than [`MOST`] is not kept.
        assert_eq!(sizes(spares.put(of(MOST + 4))), [MOST - 16, 4, MOST + 4]);
        assert!(spares.take_all().is_empty());
    }
}
