//! Drops that lie where they came to rest.

use glam::Vec3;
use vitriol_gpu::{Buffer, CopyRegion, Gpu, GpuError, Recorder, bytes_of_elements};
use vitriol_shaders::layout;

use crate::spray::Flights;

/// Most drops that lie where they came to rest, as in `common/picture/spray_drops.wgsl`.
pub const MOST_RESTING: usize = 160;

/// A drop that lies where it came to rest: half a ball, whose other half is in what it lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestingDrop {
    /// Where its middle is, on the surface of what it lies on; in the stage, metres.
    pub position: Vec3,
    /// Its radius, metres.
    pub radius: f32,
    /// Its acid mass fraction, by which it is tinted as a flying drop is.
    pub acid: f32,
}

/// Puts them behind the flights that a frame draws.
pub(crate) struct Resting {
    buffer: Buffer,
}

impl Resting {
    pub(crate) fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let bytes = bytes_of_elements::<layout::Flight>(MOST_RESTING);
        let buffer = Buffer::storage(gpu, "resting drops", bytes)?;
        Ok(Self { buffer })
    }

    /// Records their copy behind the flights; of more than [`MOST_RESTING`] the first ones.
    pub(crate) fn record(
        &self,
        rec: &mut Recorder,
        flights: Flights<'_>,
        (drops, length_scale): (&[RestingDrop], f32),
    ) -> Result<(), GpuError> {
        let mut all = [layout::Flight::default(); MOST_RESTING];
        for (flight, drop) in all.iter_mut().zip(drops) {
            *flight = layout::Flight {
                position: (drop.position / length_scale).to_array(),
                radius: drop.radius / length_scale,
                drops: 1,
                acid: drop.acid,
                ..layout::Flight::default()
            };
        }
        rec.upload(&self.buffer, &all)?;
        let bytes = |flights: usize| (flights * size_of::<layout::Flight>()) as u64;
        let behind = CopyRegion {
            from: 0,
            to: bytes(flights.places),
            bytes: bytes(MOST_RESTING),
        };
        rec.copy(&self.buffer, flights.buffer, &[behind])
    }
}
