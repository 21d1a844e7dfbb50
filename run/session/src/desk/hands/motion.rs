//! Motion of a hand, or of what it holds: smooth, and no faster than a careful person moves glass.

use glam::{Quat, Vec3};
use vitriol_xr::Pose;

/// Highest speed, m/s, and acceleration, m/s². Our choice: a hand at the side of a turning flask, up to 0.1 m from its axis, stays
/// below 0.6 m/s and 3 m/s² with them; a person pours with about as much.
pub(super) const SPEED: f32 = 0.45;
pub(super) const ACCELERATION: f32 = 2.0;
/// Speed for each metre to the target, 1/s: `GAIN` × `SPEED` is below `ACCELERATION`, so that the motion ends without overshoot.
pub(super) const GAIN: f32 = 4.4;
/// Highest turning speed, rad/s (75° a second), and its change, rad/s².
const SPIN: f32 = 1.3;
pub(super) const SPIN_CHANGE: f32 = 8.0;
/// Turning speed for each radian to the target, 1/s; `SPIN_GAIN` × `SPIN` is below `SPIN_CHANGE`, as for `GAIN`.
pub(super) const SPIN_GAIN: f32 = 6.0;
/// Below these a motion is at rest, m/s and rad/s.
const STILL: [f32; 2] = [0.01, 0.02];

/// A pose that moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    /// Where it is, in the stage.
    pub pose: Pose,
    /// Its velocity, m/s.
    pub velocity: Vec3,
    /// Its angular velocity, rad/s.
    pub spin: Vec3,
}

impl Motion {
    /// At rest there.
    pub fn at(pose: Pose) -> Self {
        Self {
            pose,
            velocity: Vec3::ZERO,
            spin: Vec3::ZERO,
        }
    }

    /// The motion `h` seconds later on its way to `target`, sinking no faster than `sinks` (m/s).
    pub fn towards(&self, target: &Pose, sinks: f32, h: f32) -> Self {
        // Nothing is to come of a place that is no number.
        if !target.is_valid() {
            return self.braked(h);
        }
        let mut wanted = GAIN * (target.position - self.pose.position);
        wanted = wanted.clamp_length_max(SPEED);
        wanted.y = wanted.y.max(-sinks);
        let change = (wanted - self.velocity).clamp_length_max(ACCELERATION * h);
        let error = turn_between(self.pose.orientation, target.orientation);
        let spin = (SPIN_GAIN * error).clamp_length_max(SPIN);
        let spin_change = (spin - self.spin).clamp_length_max(SPIN_CHANGE * h);
        self.moved(self.velocity + change, self.spin + spin_change, h)
    }

    /// The motion `h` seconds later if it stops as fast as it can.
    pub fn braked(&self, h: f32) -> Self {
        let velocity = self.velocity - self.velocity.clamp_length_max(ACCELERATION * h);
        let spin = self.spin - self.spin.clamp_length_max(SPIN_CHANGE * h);
        self.moved(velocity, spin, h)
    }

    /// Whether it is at rest.
    pub fn is_still(&self) -> bool {
        self.is_slow() && self.turns_no_more()
    }

    /// Whether it does not move: what a hand takes is then where it was as the hand closed.
    pub fn is_slow(&self) -> bool {
        self.velocity.length() < STILL[0]
    }

    /// Whether it does not turn.
    pub fn turns_no_more(&self) -> bool {
        self.spin.length() < STILL[1]
    }

    /// With these velocities at the end of `h` seconds. Mean velocities make the way independent of how it is divided into steps.
    fn moved(&self, velocity: Vec3, spin: Vec3, h: f32) -> Self {
        let position = self.pose.position + 0.5 * h * (self.velocity + velocity);
        let turn = Quat::from_scaled_axis(0.5 * h * (self.spin + spin));
        let orientation = (turn * self.pose.orientation).normalize();
        Self {
            pose: Pose::new(position, orientation),
            velocity,
            spin,
        }
    }
}

/// The rotation from `from` to `to` by the shorter way: its axis times its angle, rad.
pub(super) fn turn_between(from: Quat, to: Quat) -> Vec3 {
    let turn = (to * from.conjugate()).normalize();
    // q and -q are the same rotation.
    let turn = if turn.w < 0.0 { -turn } else { turn };
    turn.to_scaled_axis()
}
