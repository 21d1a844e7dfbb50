//! The hand's motion in a case.

use glam::{DQuat, DVec3, EulerRot, Quat, Vec3};
use vitriol_sim::bodies::Hand;
use vitriol_sim::pose::Pose;

/// Duration of a hand's motion, s.
pub const LASTS: f64 = 0.3;
/// Time before the motion, s.
pub const BEFORE: f64 = 0.1;

/// A hand's motion with the flask, at real size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// No hand.
    Still,
    /// To and fro along a direction at this speed, m/s.
    Shaken { speed: f64, vertical: bool },
    /// Moved from one step to the next, m.
    Teleported([f64; 3]),
    /// Turned about its axis, or about one across it, rad/s.
    Spun { rate: f64, across: bool },
    /// The program stood still for this long, s, while the hand went on.
    Stalled(f64),
    /// The tracker's pose is invalid.
    NoPose(Broken),
}

/// An invalid value that a tracker must not deliver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Broken {
    /// Position of NaN.
    Position,
    /// Orientation of NaN.
    Orientation,
    /// Position of infinity.
    Infinite,
    /// Orientation of length 0.
    Null,
    /// A squeeze of NaN.
    Squeeze,
}

impl Motion {
    /// The hand at `time` (s) that holds the flask which stands at `grip` at the
    /// start; in metres of a scene of `length_scale`.
    pub fn hand(self, time: f64, grip: DVec3, length_scale: f64) -> Hand {
        if self == Self::Still {
            return Hand::ABSENT;
        }
        // The flask is lifted off the table before anything else.
        let lift = match self {
            Self::NoPose(_) => DVec3::ZERO,
            _ => DVec3::Y * 0.5 * (time / BEFORE).min(1.0),
        };
        let t = (time - BEFORE).clamp(0.0, LASTS);
        let (offset, turn) = self.path(t);
        let position = grip + (lift + offset) / length_scale;
        let mut hand = Hand {
            stage_from_grip: Pose::new(position.as_vec3(), turn.as_quat()),
            squeeze: 1.0,
            present: true,
        };
        if let Self::NoPose(broken) = self
            && t > 0.0
            && t < LASTS
        {
            match broken {
                Broken::Position => hand.stage_from_grip.position = Vec3::NAN,
                Broken::Orientation => hand.stage_from_grip.orientation = Quat::NAN,
                Broken::Infinite => hand.stage_from_grip.position = Vec3::INFINITY,
                Broken::Null => {
                    hand.stage_from_grip.orientation = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
                }
                Broken::Squeeze => hand.squeeze = f32::NAN,
            }
        }
        hand
    }

    /// Displacement (m) and turn at `t`, from 0 to [`LASTS`].
    fn path(self, t: f64) -> (DVec3, DQuat) {
        let none = (DVec3::ZERO, DQuat::IDENTITY);
        match self {
            Self::Still => none,
            Self::Shaken { speed, vertical } => {
                // A triangle of 0.4 m, which ends where it began.
                let legs = (speed * LASTS / 0.8).floor().max(1.0);
                let phase = (t / LASTS * legs).rem_euclid(1.0);
                let way = 0.4 * (1.0 - (2.0 * phase - 1.0).abs());
                let axis = if vertical { DVec3::Y } else { DVec3::X };
                (axis * way, DQuat::IDENTITY)
            }
            Self::Teleported(to) if t > 0.0 => (DVec3::from_array(to), DQuat::IDENTITY),
            Self::Spun { rate, across } => {
                let turns = (rate * LASTS / std::f64::consts::TAU).round().max(1.0);
                let angle = t / LASTS * turns * std::f64::consts::TAU;
                let turn = if across {
                    DQuat::from_rotation_x(angle)
                } else {
                    DQuat::from_rotation_y(angle)
                };
                (DVec3::ZERO, turn)
            }
            // A hand at 0.3 m/s and 0.2 rad/s about all axes, and upright again at the end.
            Self::Stalled(seconds) if t > 0.0 => {
                let angle = if t < LASTS { 0.2 * seconds } else { 0.0 };
                let turn = DQuat::from_euler(EulerRot::YXZ, angle, 0.3 * angle, 0.3 * angle);
                (DVec3::new(0.2, 0.1, 0.2) * seconds, turn)
            }
            Self::Teleported(_) | Self::Stalled(_) | Self::NoPose(_) => none,
        }
    }
}
