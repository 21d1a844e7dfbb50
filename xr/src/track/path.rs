//! Keyframes of one moved frame, and its pose between them.

use std::sync::Arc;

use glam::{DQuat, DVec3, Quat, Vec3};

use super::ease::Ease;
use crate::{Hand, Pose};

/// Interaction profile of hands that no runtime provided.
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
    /// Position of the path's pivot in the stage frame, m.
    pub position: DVec3,
    /// Rotation from the moved frame to the stage, a unit quaternion.
    pub rotation: DQuat,
    /// Squeeze, 0..=1.
    pub squeeze: f64,
    /// Trigger, 0..=1.
    pub trigger: f64,
    /// Course of the movement that arrives here.
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
    pub(super) fn at(&self, t: f64) -> Option<Key> {
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
    pub(super) fn pose(&self, key: &Key) -> Pose {
        let origin = key.position - key.rotation * self.pivot;
        Pose::new(origin.as_vec3(), key.rotation.as_quat())
    }

    /// The hand at time `t` (s); an inactive one without keyframes.
    pub(super) fn hand(&self, t: f64) -> Hand {
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
