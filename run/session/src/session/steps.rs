//! The simulation's steps in a frame: which are due, with what poses, and that they are taken.

use std::collections::VecDeque;

use vitriol_gpu::{QueueKind, Ticket};
use vitriol_run::{Blame, Failure, Run, stage};
use vitriol_sim::scene::Scene;
use vitriol_xr::PoseFrame;

use super::ended::NoFrameOpen;
use crate::clock::StepClock;
use crate::placement::{self, Placement};

/// Share of real time below which the panel shows slow motion.
const SLOW: f64 = 0.97;
/// How much a frame counts in the mean speed of the last ones.
const SMOOTHING: f64 = 0.05;

/// Plans a frame's steps and takes them.
pub(super) struct Steps {
    /// When they are due. It pauses while the display stands still, or where the bench leaps.
    pub clock: StepClock,
    /// Poses of the steps that the frame has still to take, in the frame of the scene's file.
    due: VecDeque<PoseFrame>,
    /// Submissions of the steps since the last picture.
    submitted: Vec<Ticket>,
    /// Simulated time over display time, of the last frames.
    speed: f64,
}

impl Steps {
    /// None yet, in real time.
    pub fn new() -> Self {
        Self {
            clock: StepClock::default(),
            due: VecDeque::new(),
            submitted: Vec::new(),
            speed: 1.0,
        }
    }

    /// Finds the steps that are due between the last frame and `now`, each with poses between the two frames'
    /// at its own end. In the first frame and after a [`StepClock::pause`] there are none.
    pub fn plan(&mut self, now: &PoseFrame, placement: &Placement, scene: &Scene) {
        let due = self.clock.advance(now.info.xr_time, scene.scale.frame_time);
        let (Some(last), true) = (&placement.last, placement.is_known()) else {
            return;
        };
        let passed = (now.info.xr_time - last.info.xr_time) as f64;
        for s in due.ends {
            let poses = placement::in_scene(&last.between(now, s), &placement.stage_from_scene());
            let mut poses = stage::stage_from_near(&poses, scene);
            poses.info.xr_time = last.info.xr_time + (f64::from(s) * passed).round() as i64;
            self.due.push_back(poses);
        }
        if passed > 0.0 {
            let speed = self.clock.rate - 1e9 * due.skipped / passed;
            self.speed += SMOOTHING * (speed - self.speed);
        }
    }

    /// One more step is due, in which the hands are as in `now`.
    pub fn once_more(&mut self, now: &PoseFrame, placement: &Placement, scene: &Scene) {
        let poses = placement::in_scene(now, &placement.stage_from_scene());
        self.due.push_back(stage::stage_from_near(&poses, scene));
    }

    /// Takes the steps that are due as far as the device has got: a step needs the push on the flasks of two
    /// steps ago, and a frame that is open waits for nothing. The rest is for [`Steps::take_rest`].
    pub fn take_ready(&mut self, run: &mut Run) -> Result<(), Failure> {
        while !self.due.is_empty() && run.world.is_ready().other()? {
            self.take(run)?;
        }
        Ok(())
    }

    /// Takes all steps that are due; may wait for the device.
    pub fn take_rest(&mut self, run: &mut Run, _: &NoFrameOpen) -> Result<(), Failure> {
        while !self.due.is_empty() {
            self.take(run)?;
        }
        Ok(())
    }

    fn take(&mut self, run: &mut Run) -> Result<(), Failure> {
        let Some(poses) = self.due.front() else {
            return Ok(());
        };
        let before = run.time().steps();
        let submitted = run.step(QueueKind::Async, poses);
        // Where the device is lost in it, it is due on the next one.
        if run.time().steps() > before {
            self.due.pop_front();
        }
        self.submitted.extend(submitted?);
        Ok(())
    }

    /// Submissions since the last call.
    pub fn submitted(&mut self) -> Vec<Ticket> {
        std::mem::take(&mut self.submitted)
    }

    /// Steps of `frame_time` (s) between the flasks as they are now and the frame's display time.
    pub fn behind(&self, frame_time: f64) -> f64 {
        self.clock.since / frame_time + self.due.len() as f64
    }

    /// Speed in per cent of real time, to the next 5; `None` at full speed.
    pub fn slow_motion(&self) -> Option<u32> {
        (self.speed < SLOW).then(|| 5 * (20.0 * self.speed).round() as u32)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::placement::Posture;
    use glam::{DVec3, Quat, Vec3};
    use vitriol_xr::{FrameInfo, Hand, Pose};

    /// The display's time at the start, ns; not 0, so that it is not mistaken for the simulation's.
    const EPOCH: i64 = 1_000_000_000;

    /// Someone who sits at (0.3, 1.2, 0.1) m and whose right hand goes 0.9 m a second to the right.
    fn at(seconds: f64) -> PoseFrame {
        let mut hands = [Hand::default(), Hand::default()];
        let position = Vec3::new(0.3 + 0.9 * seconds as f32, 1.0, -0.3);
        hands[1] = Hand {
            active: true,
            valid: true,
            stage_from_grip: Pose::new(position, Quat::IDENTITY),
            ..Hand::default()
        };
        PoseFrame {
            stage_from_view: Pose::new(Vec3::new(0.3, 1.2, 0.1), Quat::IDENTITY),
            hands,
            info: FrameInfo {
                xr_time: EPOCH + (1e9 * seconds).round() as i64,
                ..FrameInfo::default()
            },
            ..PoseFrame::default()
        }
    }

    /// Frames at these times, the bench placed in the first one; what is due after each.
    fn planned(steps: &mut Steps, scene: &Scene, times: &[f64]) -> Vec<Vec<PoseFrame>> {
        let mut placement = Placement::new(Posture::Seated);
        let plan = |&time: &f64| {
            let now = at(time);
            placement.place(&now, false);
            steps.plan(&now, &placement, scene);
            placement.last = Some(now);
            steps.due.drain(..).collect()
        };
        times.iter().map(plan).collect()
    }

    /// A display of 30 Hz has three steps of 1/90 s in each frame, each with the hand where it was at its end.
    #[test]
    fn each_step_has_the_poses_of_its_own_time() {
        let mut scene = Scene::builtin("two-flasks").unwrap();
        scene.origin = DVec3::new(0.0, 0.0, 0.5);
        let mut steps = Steps::new();
        let times: Vec<f64> = (0..5).map(|n| f64::from(n) / 30.0).collect();
        let planned = planned(&mut steps, &scene, &times);
        let counts: Vec<usize> = planned.iter().map(Vec::len).collect();
        assert_eq!(counts, [0, 3, 3, 3, 3]);
        for (n, step) in planned.iter().flatten().enumerate() {
            let seconds = (n + 1) as f64 / 90.0;
            // Display times are whole nanoseconds, places between frames of 32 bits.
            let expected = EPOCH + (1e9 * seconds).round() as i64;
            assert!((step.info.xr_time - expected).abs() < 10, "step {n}");
            // The bench is before her: her head is over its origin. The file's frame is 0.5 m behind that.
            let hand = step.hands[1].stage_from_grip.position;
            let expected = Vec3::new(0.9 * seconds as f32, 1.0, -0.4 + 0.5);
            assert!((hand - expected).length() < 1e-5, "step {n}: {hand}");
        }
        assert_eq!(steps.slow_motion(), None);
    }

    #[test]
    fn a_pause_plans_nothing() {
        let scene = Scene::builtin("two-flasks").unwrap();
        let mut steps = Steps::new();
        let mut placement = Placement::new(Posture::Seated);
        placement.place(&at(0.0), false);
        let mut due = |time: f64, pause: bool| {
            if pause {
                steps.clock.pause();
            }
            steps.plan(&at(time), &placement, &scene);
            placement.last = Some(at(time));
            steps.due.drain(..).count()
        };
        assert_eq!(due(0.0, false), 0);
        assert_eq!(due(1.0 / 90.0, false), 1);
        assert_eq!(due(5.0, true), 0);
        assert_eq!(due(5.0 + 1.0 / 90.0, false), 1);
    }

    /// At 10 Hz nine steps are due in a frame, of which five are taken: 56 % of real time.
    #[test]
    fn slow_motion_is_said_to_the_next_five_per_cent() {
        let scene = Scene::builtin("two-flasks").unwrap();
        let mut steps = Steps::new();
        let times: Vec<f64> = (0..200).map(|n| 0.1 * f64::from(n)).collect();
        let planned = planned(&mut steps, &scene, &times);
        assert!(planned[1..].iter().all(|due| due.len() == 5));
        assert_eq!(steps.slow_motion(), Some(55));
        assert!((steps.clock.slowed - 199.0 * (0.1 - 5.0 / 90.0)).abs() < 1e-6);
    }
}
