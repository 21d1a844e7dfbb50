//! Frames in which all liquid sleeps: nothing over particles is recorded, and the bits are the same.

use super::frame::FrameRecord;
use super::{Solver, SolverError};
use crate::pose::Pose;
use std::sync::{Mutex, MutexGuard, PoisonError};
use vitriol_gpu::Recorder;

/// What was recorded since something could last wake liquid. Only flasks that move, what is done to their contents, and liquid that is awake
/// can; of the last the device tells some frames later.
#[derive(Default)]
pub(super) struct Still(Mutex<Since>);

#[derive(Default)]
struct Since {
    /// Frames recorded.
    frames: u64,
    /// The first of those at whose end all flasks stood where they stand now.
    first: u64,
    poses: Vec<Pose>,
    /// Whether all liquid slept in one of these.
    asleep: bool,
}

impl Still {
    fn lock(&self) -> MutexGuard<'_, Since> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Something may wake liquid in the next frame.
    pub(super) fn disturb(&self) {
        let mut since = self.lock();
        since.poses.clear();
        since.asleep = false;
    }

    /// Counts a frame; its number, and whether all liquid sleeps in it.
    pub(super) fn count(&self, before: &[Pose], after: &[Pose]) -> (u64, bool) {
        let mut since = self.lock();
        since.frames += 1;
        if before != after || since.poses != after {
            since.first = since.frames + 1;
            since.poses = after.to_vec();
            since.asleep = false;
        }
        (since.frames, since.asleep)
    }

    /// All liquid slept in that frame.
    fn slept(&self, frame: u64) {
        let mut since = self.lock();
        since.asleep |= !since.poses.is_empty() && frame >= since.first;
    }
}

impl Solver {
    /// Takes note of what a finished frame tells about sleep: while nothing can wake liquid, frames are recorded without it.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] before the frame is done.
    pub fn note(&self, record: &FrameRecord) -> Result<(), SolverError> {
        if record.awake()? == Some(0) {
            self.still.slept(record.frame);
        }
        Ok(())
    }

    /// Whether the next frame is recorded without liquid if no flask moves.
    pub fn is_still(&self) -> bool {
        self.still.lock().asleep
    }

    /// Records what goes on over liquid that sleeps.
    pub(super) fn record_still(&self, rec: &mut Recorder) -> Result<(), SolverError> {
        self.record_surroundings(rec)?;
        self.load(rec)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    /// A frame's number and whether it is still, with a flask that goes from one place to the other.
    fn step(still: &Still, from: f32, to: f32) -> (u64, bool) {
        let [before, after] = [from, to].map(|x| [Pose::from_position(Vec3::X * x)]);
        still.count(&before, &after)
    }

    #[test]
    fn a_frame_is_still_if_nothing_moved_since_all_slept() {
        let still = Still::default();
        still.slept(0);
        assert_eq!(step(&still, 0.0, 0.0), (1, false));
        // That frame began the rest: what slept in it may have been woken at its end.
        still.slept(1);
        assert_eq!(step(&still, 0.0, 0.0), (2, false));
        still.slept(2);
        assert_eq!(step(&still, 0.0, 0.0), (3, true));
        assert_eq!(step(&still, 0.0, 0.1), (4, false));
        // News of frames before the motion.
        still.slept(3);
        still.slept(4);
        assert_eq!(step(&still, 0.1, 0.1), (5, false));
        still.slept(5);
        assert_eq!(step(&still, 0.1, 0.1), (6, true));
        still.disturb();
        still.slept(6);
        assert_eq!(step(&still, 0.1, 0.1), (7, false));
        still.slept(6);
        assert_eq!(step(&still, 0.1, 0.1), (8, false));
        // A flask that was put elsewhere between frames.
        still.slept(8);
        assert_eq!(step(&still, 0.2, 0.2), (9, false));
    }
}
