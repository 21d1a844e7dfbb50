//! Poses in the script and in the log of calls.

use glam::{Quat, Vec3};
use openxr::sys;
use serde::{Deserialize, Serialize};

use crate::number::Number;

/// Position and orientation. In JSON seven numbers: x, y, z in m, then the quaternion's x, y, z, w.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "[Number; 7]", into = "[Number; 7]")]
pub struct Pose {
    /// Position, m.
    pub position: Vec3,
    /// Unit quaternion, unless a test needs an invalid one.
    pub orientation: Quat,
}

impl Pose {
    /// No shift, no turn.
    pub const IDENTITY: Self = Self::new(Vec3::ZERO, Quat::IDENTITY);

    /// A pose from its parts.
    #[must_use]
    pub const fn new(position: Vec3, orientation: Quat) -> Self {
        Self {
            position,
            orientation,
        }
    }

    /// A pose at (x, y, z), not rotated.
    #[must_use]
    pub const fn at(x: f32, y: f32, z: f32) -> Self {
        Self::new(Vec3::new(x, y, z), Quat::IDENTITY)
    }

    /// The pose `inner`, given in this pose's frame, in the outer frame.
    #[must_use]
    pub fn compose(&self, inner: &Self) -> Self {
        Self {
            position: self.position + self.orientation * inner.position,
            orientation: self.orientation * inner.orientation,
        }
    }

    /// The inverse pose.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let back = self.orientation.conjugate();
        Self {
            position: back * -self.position,
            orientation: back,
        }
    }

    /// Whether it is finite, with a unit quaternion.
    pub(crate) fn is_proper(&self) -> bool {
        let length = self.orientation.length();
        self.position.is_finite() && length.is_finite() && (length - 1.0).abs() < 1e-3
    }

    pub(crate) fn read(pose: &sys::Posef) -> Self {
        let (p, q) = (pose.position, pose.orientation);
        Self::new(
            Vec3::new(p.x, p.y, p.z),
            Quat::from_xyzw(q.x, q.y, q.z, q.w),
        )
    }

    pub(crate) fn raw(&self) -> sys::Posef {
        let (p, q) = (self.position, self.orientation);
        sys::Posef {
            position: sys::Vector3f {
                x: p.x,
                y: p.y,
                z: p.z,
            },
            orientation: sys::Quaternionf {
                x: q.x,
                y: q.y,
                z: q.z,
                w: q.w,
            },
        }
    }
}

impl From<[Number; 7]> for Pose {
    fn from(numbers: [Number; 7]) -> Self {
        let [x, y, z, a, b, c, d] = numbers.map(|number| number.0);
        Self::new(Vec3::new(x, y, z), Quat::from_xyzw(a, b, c, d))
    }
}

impl From<Pose> for [Number; 7] {
    fn from(pose: Pose) -> Self {
        let (p, q) = (pose.position, pose.orientation);
        [p.x, p.y, p.z, q.x, q.y, q.z, q.w].map(Number)
    }
}

/// Which parts of a pose are valid, and which are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Known {
    /// XR_SPACE_LOCATION_POSITION_VALID_BIT
    pub position_valid: bool,
    /// XR_SPACE_LOCATION_ORIENTATION_VALID_BIT
    pub orientation_valid: bool,
    /// XR_SPACE_LOCATION_POSITION_TRACKED_BIT
    pub position_tracked: bool,
    /// XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT
    pub orientation_tracked: bool,
}

impl Known {
    /// All parts are measured.
    pub const TRACKED: Self = Self {
        position_valid: true,
        orientation_valid: true,
        position_tracked: true,
        orientation_tracked: true,
    };
    /// All parts are guessed.
    pub const GUESSED: Self = Self {
        position_tracked: false,
        orientation_tracked: false,
        ..Self::TRACKED
    };
    /// The orientation is measured; the position is unknown.
    pub const TURNED: Self = Self {
        position_valid: false,
        position_tracked: false,
        ..Self::TRACKED
    };
    /// All parts are unknown.
    pub const NOTHING: Self = Self {
        position_valid: false,
        orientation_valid: false,
        position_tracked: false,
        orientation_tracked: false,
    };

    /// Knowledge of a pose that is composed of two.
    pub(crate) fn and(self, other: Self) -> Self {
        // A position in a frame of unknown orientation is unknown too.
        let orientation_valid = self.orientation_valid && other.orientation_valid;
        Self {
            position_valid: self.position_valid && other.position_valid && orientation_valid,
            orientation_valid,
            position_tracked: self.position_tracked && other.position_tracked,
            orientation_tracked: self.orientation_tracked && other.orientation_tracked,
        }
    }

    /// Flags of a location, and the pose with rubbish in place of its invalid parts.
    pub(crate) fn show(self, pose: &Pose) -> (sys::SpaceLocationFlags, sys::Posef) {
        use sys::SpaceLocationFlags as F;
        let mut flags = F::EMPTY;
        for (on, flag) in [
            (self.position_valid, F::POSITION_VALID),
            (self.orientation_valid, F::ORIENTATION_VALID),
            (self.position_tracked, F::POSITION_TRACKED),
            (self.orientation_tracked, F::ORIENTATION_TRACKED),
        ] {
            if on {
                flags |= flag;
            }
        }
        let mut shown = *pose;
        if !self.position_valid {
            shown.position = Vec3::splat(1e9);
        }
        if !self.orientation_valid {
            shown.orientation = Quat::from_xyzw(3.0, -2.0, 1.0, -0.5);
        }
        (flags, shown.raw())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_and_its_inverse_are_nothing() {
        let pose = Pose::new(Vec3::new(1.0, 2.0, 3.0), Quat::from_rotation_y(0.7));
        let none = pose.compose(&pose.inverse());
        assert!(none.position.length() < 1e-6, "{none:?}");
        assert!(none.orientation.w > 1.0 - 1e-6, "{none:?}");
    }

    #[test]
    fn what_is_not_valid_is_rubbish() {
        let (flags, pose) = Known::TURNED.show(&Pose::IDENTITY);
        assert!(!flags.contains(sys::SpaceLocationFlags::POSITION_VALID));
        assert!(flags.contains(sys::SpaceLocationFlags::ORIENTATION_VALID));
        assert!(pose.position.x > 1e6 && pose.orientation.w == 1.0);
    }
}
