//! Choice of the queues that the device is opened with.

use ash::vk;

use super::provider::QueueRequest;

/// Priorities of the main queue and of the second: a picture that is late is seen, a step of the simulation that is late is not.
const PRIORITIES: [f32; 2] = [1.0, 0.5];

/// One queue of the device.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    pub(crate) family: u32,
    pub(crate) index: u32,
    /// Valid bits of a timestamp.
    pub(crate) timestamp_mask: u64,
}

/// The queues that are used.
pub(crate) struct QueuePlan {
    main: Place,
    /// `None`: the main queue serves as both.
    second: Option<Place>,
}

impl QueuePlan {
    /// A family with compute and without graphics is the best second queue: it
    /// is scheduled beside the main one. `None` where no family has both
    /// graphics and compute.
    pub(crate) fn of(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Option<Self> {
        // SAFETY: `physical` is a device of `instance`.
        let families = unsafe { instance.get_physical_device_queue_family_properties(physical) };
        let place = |family: usize, index: u32| Place {
            family: family as u32,
            index,
            timestamp_mask: match families[family].timestamp_valid_bits {
                0 => 0,
                bits => u64::MAX >> (64 - bits.min(64)),
            },
        };
        let both = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
        let main = families
            .iter()
            .position(|family| family.queue_flags.contains(both))?;
        let compute_only = families.iter().position(|family| {
            family.queue_flags.contains(vk::QueueFlags::COMPUTE)
                && !family.queue_flags.contains(vk::QueueFlags::GRAPHICS)
        });
        let second = match compute_only {
            Some(family) => Some(place(family, 0)),
            None if families[main].queue_count > 1 => Some(place(main, 1)),
            None => None,
        };
        Some(Self {
            main: place(main, 0),
            second,
        })
    }

    pub(crate) fn timestamps(&self) -> bool {
        self.places().all(|place| place.timestamp_mask != 0)
    }

    pub(crate) fn places(&self) -> impl Iterator<Item = Place> {
        std::iter::once(self.main).chain(self.second)
    }

    pub(crate) fn families(&self) -> Vec<u32> {
        let mut families: Vec<u32> = self.places().map(|place| place.family).collect();
        families.dedup();
        families
    }

    pub(crate) fn requests(&self) -> Vec<QueueRequest> {
        self.families()
            .into_iter()
            .map(|family| QueueRequest {
                family,
                priorities: PRIORITIES
                    .into_iter()
                    .zip(self.places())
                    .filter(|(_, place)| place.family == family)
                    .map(|(priority, _)| priority)
                    .collect(),
            })
            .collect()
    }
}
