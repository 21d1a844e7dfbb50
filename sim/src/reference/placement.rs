//! Poses in f64, and their motion over a substep.

use crate::pose::Pose;
use glam::{DQuat, DVec3};

/// `stage_from_flask` in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Origin of the flask in the stage, metres.
    pub position: DVec3,
    /// Its axes in the stage; a unit quaternion.
    pub orientation: DQuat,
}

impl From<Pose> for Placement {
    fn from(pose: Pose) -> Self {
        Self {
            position: pose.position.as_dvec3(),
            orientation: pose.orientation.as_dquat().normalize(),
        }
    }
}

impl Placement {
    /// A point of the flask's frame in the stage, metres.
    pub fn to_stage(&self, point: DVec3) -> DVec3 {
        self.orientation * point + self.position
    }

    /// A point of the stage in the flask's frame, metres.
    pub fn to_flask(&self, point: DVec3) -> DVec3 {
        self.orientation.conjugate() * (point - self.position)
    }

    /// A direction of the flask's frame in the stage.
    pub fn direction_to_stage(&self, direction: DVec3) -> DVec3 {
        self.orientation * direction
    }

    /// The pose at `fraction` of the way to `other`: position on the straight
    /// line, orientation on the shorter arc.
    pub fn interpolate(&self, other: &Self, fraction: f64) -> Self {
        Self {
            position: self.position.lerp(other.position, fraction),
            orientation: self
                .orientation
                .slerp(other.orientation, fraction)
                .normalize(),
        }
    }
}

/// How a flask moves during a substep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Pose at the substep's start: the flask constraint's previous one.
    pub before: Placement,
    /// Pose at its end: the current one, at which everything is evaluated.
    pub after: Placement,
    /// Δt_s, seconds.
    pub time: f64,
}

impl Motion {
    /// Substep `index` of `count` of a frame in which the flask goes from
    /// `before` to `after`, where a substep takes `time` seconds.
    ///
    /// Lines 1–5 move the flask by the whole frame before the substeps;
    /// taken literally the liquid would meet a wall that has jumped.
    pub fn of_substep(before: Pose, after: Pose, index: u32, count: u32, time: f64) -> Self {
        let (start, end) = (Placement::from(before), Placement::from(after));
        let at = |step: u32| start.interpolate(&end, f64::from(step) / f64::from(count));
        Self {
            before: at(index),
            after: at(index + 1),
            time,
        }
    }

    /// At rest where it is at the substep's start.
    pub fn start(&self) -> Self {
        Self {
            after: self.before,
            ..*self
        }
    }

    /// Velocity of the flask's point that is at `point` (stage, metres) at
    /// the substep's end, m/s: line 3 divided by the time, so that rotation
    /// is in it.
    pub fn velocity_at(&self, point: DVec3) -> DVec3 {
        let before = self.before.to_stage(self.after.to_flask(point));
        (point - before) / self.time
    }
}
