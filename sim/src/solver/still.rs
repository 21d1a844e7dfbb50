//! Frames in which all liquid sleeps: nothing over particles is recorded, and the bits are the same.

use super::frame::FrameRecord;
use super::{Solver, SolverError, sleep};
use crate::pose::Pose;
use glam::Vec4;
use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};
use vitriol_gpu::Recorder;

/// Frames for which poses are kept until the device has told of them.
const KEPT: usize = 8;

/// What was recorded since something could last wake liquid. Only flasks that move, what is done to their contents, and liquid that is awake
/// can; of the last the device tells some frames later.
#[derive(Default)]
pub(super) struct Still(Mutex<Since>);

#[derive(Default)]
struct Since {
    /// Frames recorded.
    frames: u64,
    /// The first frame that nothing but motion can have disturbed.
    first: u64,
    /// Frames of which the device has not told yet, and where flasks stood at their end.
    after: VecDeque<(u64, Vec<Pose>)>,
    /// Where flasks stand while all liquid sleeps, as the device has noted it.
    stands: Option<Vec<Pose>>,
}

impl Still {
    fn lock(&self) -> MutexGuard<'_, Since> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Something else than motion may wake liquid in the next frame.
    pub(super) fn disturb(&self) {
        let mut since = self.lock();
        since.first = since.frames + 1;
        since.stands = None;
    }

    /// Counts a frame; its number, and whether all liquid sleeps in it. `near` tells whether flasks at two places count as unmoved.
    pub(super) fn count(
        &self,
        [before, after]: [&[Pose]; 2],
        near: impl Fn(&[Pose], &[Pose]) -> bool,
    ) -> (u64, bool) {
        let mut since = self.lock();
        since.frames += 1;
        let number = since.frames;
        let stands = since.stands.take();
        since.stands = stands.filter(|stand| near(stand, before) && near(stand, after));
        if since.after.len() == KEPT {
            since.after.pop_front();
        }
        since.after.push_back((number, after.to_vec()));
        (number, since.stands.is_some())
    }

    /// All liquid slept in that frame, with flasks that count as standing at `stands`.
    fn slept(&self, frame: u64, stands: Vec<Pose>, near: impl Fn(&[Pose], &[Pose]) -> bool) {
        let mut since = self.lock();
        while (since.after.front()).is_some_and(|&(number, _)| number < frame) {
            since.after.pop_front();
        }
        let is_known = (since.after.front()).is_some_and(|&(number, _)| number == frame);
        let stood = since.after.iter().all(|(_, after)| near(&stands, after));
        if frame >= since.first && is_known && stood {
            since.stands = Some(stands);
        }
    }
}

impl Solver {
    /// Takes note of what a finished frame tells about sleep: while nothing can wake liquid, frames are recorded without it.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] before the frame is done.
    pub fn note(&self, record: &FrameRecord) -> Result<(), SolverError> {
        if let Some(stands) = record.sleeping_at()? {
            let near = |a: &[Pose], b: &[Pose]| self.near(a, b);
            self.still.slept(record.frame, stands, near);
        }
        Ok(())
    }

    /// Whether the device counts flasks at two places as unmoved, whatever it rounds: half of what it allows.
    pub(super) fn near(&self, a: &[Pose], b: &[Pose]) -> bool {
        let [drift, turn] = sleep::unmoved(&self.parameters).map(|most| 0.5 * most as f32);
        let close = |(a, b): (&Pose, &Pose)| {
            let [p, q] = [a, b].map(|pose| Vec4::from(pose.orientation));
            a.position.distance(b.position) <= drift && p.distance(q).min(p.distance(-q)) <= turn
        };
        a.len() == b.len() && a.iter().zip(b).all(close)
    }

    /// Whether the next frame is recorded without liquid if no flask moves.
    pub fn is_still(&self) -> bool {
        self.still.lock().stands.is_some()
    }

    /// Records what goes on over liquid that sleeps, of which the first pass notes where flasks stand.
    pub(super) fn record_still(&self, rec: &mut Recorder) -> Result<(), SolverError> {
        self.record_sleep(rec)?;
        // No bubble is there, but the flow of gas still fades.
        for n in 0..self.parameters.substeps {
            self.bubble(rec, &self.step(n), n)?;
        }
        self.record_surroundings(rec)?;
        self.load(rec)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn at(x: f32) -> Vec<Pose> {
        vec![Pose::from_position(Vec3::X * x)]
    }

    fn near(a: &[Pose], b: &[Pose]) -> bool {
        a[0].position.distance(b[0].position) < 0.01
    }

    /// A frame's number and whether it is still, with a flask that goes from one place to the other.
    fn step(still: &Still, from: f32, to: f32) -> (u64, bool) {
        still.count([&at(from), &at(to)], near)
    }

    #[test]
    fn a_frame_is_still_if_nothing_moved_since_all_slept() {
        let still = Still::default();
        still.slept(0, at(0.0), near);
        assert_eq!(step(&still, 0.0, 0.0), (1, false));
        assert_eq!(step(&still, 0.0, 0.002), (2, false));
        still.slept(1, at(0.0), near);
        assert_eq!(step(&still, 0.002, 0.0), (3, true));
        // A drift, each frame of which is as nothing.
        assert_eq!(step(&still, 0.0, 0.007), (4, true));
        assert_eq!(step(&still, 0.007, 0.014), (5, false));
        // News of frames before the motion.
        still.slept(3, at(0.0), near);
        assert_eq!(step(&still, 0.014, 0.014), (6, false));
        still.slept(5, at(0.014), near);
        assert_eq!(step(&still, 0.014, 0.014), (7, true));
        still.disturb();
        assert_eq!(step(&still, 0.014, 0.014), (8, false));
        still.slept(7, at(0.014), near);
        assert_eq!(step(&still, 0.014, 0.014), (9, false));
        still.slept(8, at(0.014), near);
        assert_eq!(step(&still, 0.014, 0.014), (10, true));
        // A flask that was put elsewhere between frames.
        assert_eq!(step(&still, 0.2, 0.2), (11, false));
        // News that come too late to know what happened since.
        for _ in 0..2 * KEPT {
            step(&still, 0.2, 0.2);
        }
        still.slept(12, at(0.2), near);
        assert!(!step(&still, 0.2, 0.2).1);
    }
}
