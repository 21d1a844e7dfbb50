//! From keyframes to frames at a fixed rate.

use std::sync::Arc;

use glam::{DQuat, DVec3, Quat, Vec3};

use super::ease::Ease;
use super::keyframes::Keyframes;
use super::{Track, TrackMetadata};
use crate::{Fov, FrameInfo, Hand, Pose, PoseFrame, SessionState};

/// Stands for the interaction profile where no runtime gave one.
const PROFILE: &str = "/vitriol/keyframes";

/// How far the aim is turned from the grip, about the grip's X: down from the thumb towards
/// the fingers. Chosen, as controllers differ; 45° is a pointing hand's between a fist's axis
/// and the forearm's.
const GRIP_FROM_AIM_PITCH: f32 = -std::f32::consts::FRAC_PI_4;

/// One keyframe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// Time, s.
    pub t: f64,
    /// Of the path's pivot in the stage frame, m.
    pub position: DVec3,
    /// Stage from the moved frame, a unit quaternion.
    pub rotation: DQuat,
    /// 0..=1.
    pub squeeze: f64,
    /// 0..=1.
    pub trigger: f64,
    /// Of the movement that arrives here.
    pub ease: Ease,
}

/// Keyframes of the head or of one hand, times ascending.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The keyframes.
    pub keys: Vec<Key>,
    /// The point of the moved frame whose position the keyframes give, m.
    pub pivot: DVec3,
}

impl Path {
    /// Values at time `t` (s); a keyframe's own at its time. `None` without keyframes.
    fn at(&self, t: f64) -> Option<Key> {
        let later = self.keys.partition_point(|key| key.t <= t);
        let Some(index) = later.checked_sub(1) else {
            return self.keys.first().copied();
        };
        let from = self.keys[index];
        let Some(to) = self.keys.get(later) else {
            return Some(from);
        };
        let s = to.ease.at((t - from.t) / (to.t - from.t));
        if s == 0.0 {
            return Some(from);
        }
        Some(Key {
            t,
            position: from.position.lerp(to.position, s),
            rotation: from.rotation.slerp(to.rotation, s),
            squeeze: from.squeeze + (to.squeeze - from.squeeze) * s,
            trigger: from.trigger + (to.trigger - from.trigger) * s,
            ease: to.ease,
        })
    }

    /// `stage_from_moved` of the values `key`.
    fn pose(&self, key: &Key) -> Pose {
        let origin = key.position - key.rotation * self.pivot;
        Pose::new(origin.as_vec3(), key.rotation.as_quat())
    }

    fn hand(&self, t: f64) -> Hand {
        let Some(key) = self.at(t) else {
            return Hand::default();
        };
        let stage_from_grip = self.pose(&key);
        let grip_from_aim = Pose::new(Vec3::ZERO, Quat::from_rotation_x(GRIP_FROM_AIM_PITCH));
        Hand {
            active: true,
            valid: true,
            tracked: true,
            stage_from_grip,
            stage_from_aim: stage_from_grip.compose(&grip_from_aim),
            squeeze: key.squeeze as f32,
            trigger: key.trigger as f32,
            profile: Arc::from(PROFILE),
            ..Hand::default()
        }
    }
}

impl Keyframes {
    /// Time of frame `step`, s: the step's own on a clock of [`rate_hz`](Self::rate_hz).
    fn time(&self, step: u64) -> f64 {
        step as f64 / self.rate_hz
    }

    /// The user at time `t`, s, as the frame of simulation step `step`. The frame's scenario
    /// is empty: a switch belongs to a span of time, not to a point.
    pub fn sample(&self, step: u64, t: f64) -> PoseFrame {
        let time_ns = (t * 1e9).round() as i64;
        // Checked when read: there is a head.
        let stage_from_view = self
            .head
            .at(t)
            .map_or(Pose::IDENTITY, |key| self.head.pose(&key));
        PoseFrame {
            step,
            time_ns,
            stage_from_view,
            hands: self.hands.each_ref().map(|path| path.hand(t)),
            scenario: Vec::new(),
            info: FrameInfo {
                xr_time: time_ns,
                period_ns: (1e9 / self.rate_hz).round() as i64,
                fov: [Fov::default(); 2],
                session_state: SessionState::Focused,
            },
        }
    }

    /// The track: frames at [`rate_hz`](Self::rate_hz) from 0 to the duration, a switch in
    /// the first frame at or after its time, or in the last one.
    pub fn sample_track(&self) -> Track {
        // A hair more than whole, so that 9 s at 90 Hz has its frame 810 in spite of rounding.
        let last = (self.duration * self.rate_hz + 1e-9).floor() as u64;
        let mut switches = self.scenario.iter().peekable();
        let frames: Vec<PoseFrame> = (0..=last)
            .map(|step| {
                let t = self.time(step);
                let mut frame = self.sample(step, t);
                while let Some((_, switch)) = switches.next_if(|(at, _)| *at <= t || step == last) {
                    frame.scenario.push(switch.clone());
                }
                frame
            })
            .collect();
        Track {
            metadata: TrackMetadata {
                scene: self.scene.clone(),
                seed: self.seed,
                parameters: [("track".to_owned(), self.name.clone())].into(),
                program_version: env!("CARGO_PKG_VERSION").into(),
            },
            stage_from_flasks: vec![Vec::new(); frames.len()],
            frames,
            recovered: false,
        }
    }
}
