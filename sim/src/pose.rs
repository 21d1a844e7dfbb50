//! Rigid transforms.

use glam::{Quat, Vec3};
use serde::{Deserialize, Serialize};

/// How far a quaternion's length may be from 1: above what rounding to f32 and a runtime's own filter leave, below what would visibly
/// scale a mesh.
const UNIT_TOLERANCE: f32 = 1e-3;

/// A rigid transform, named `target_from_source` where it is stored: a point of
/// `source`'s frame goes through [`Pose::transform_point`] into `target`'s.
///
/// `position` is in metres; `orientation` is a unit quaternion. [`Pose::IDENTITY`] by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// The source frame's origin, in the target frame (m).
    pub position: Vec3,
    /// The source frame's axes, in the target frame; of unit length.
    pub orientation: Quat,
}

impl Pose {
    /// The two frames coincide.
    pub const IDENTITY: Self = Self {
        position: Vec3::ZERO,
        orientation: Quat::IDENTITY,
    };

    /// A pose of the given position (m) and unit orientation.
    pub const fn new(position: Vec3, orientation: Quat) -> Self {
        Self {
            position,
            orientation,
        }
    }

    /// A pose without rotation, at `position` (m).
    pub const fn from_position(position: Vec3) -> Self {
        Self::new(position, Quat::IDENTITY)
    }

    /// `a_from_b.compose(b_from_c)` is `a_from_c`.
    ///
    /// The orientation is normalised again, so that a long chain of poses does
    /// not drift away from a rotation.
    pub fn compose(self, other: Self) -> Self {
        Self {
            position: self.transform_point(other.position),
            orientation: (self.orientation * other.orientation).normalize(),
        }
    }

    /// `a_from_b.inverse()` is `b_from_a`.
    pub fn inverse(self) -> Self {
        let orientation = self.orientation.conjugate();
        Self {
            position: orientation * -self.position,
            orientation,
        }
    }

    /// Rotates and moves a point (m).
    pub fn transform_point(self, point: Vec3) -> Vec3 {
        self.orientation * point + self.position
    }

    /// Rotates a direction, velocity or force.
    pub fn transform_vector(self, vector: Vec3) -> Vec3 {
        self.orientation * vector
    }

    /// The pose at `fraction` of the way from `self` (0) to `other` (1): the
    /// position on the straight line, the orientation on the shorter arc.
    pub fn interpolate(self, other: Self, fraction: f32) -> Self {
        Self {
            position: self.position.lerp(other.position, fraction),
            orientation: self
                .orientation
                .slerp(other.orientation, fraction)
                .normalize(),
        }
    }

    /// Whether every component is finite and the orientation's length is within 1e-3 of one: the condition for a tracker's pose to be
    /// used, and for the poses of a track (`xr/src/pose.rs`).
    pub fn is_valid(self) -> bool {
        self.position.is_finite()
            && self.orientation.is_finite()
            && (self.orientation.length() - 1.0).abs() <= UNIT_TOLERANCE
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::FRAC_PI_2;

    use super::*;

    fn sample() -> (Pose, Pose) {
        (
            Pose::new(Vec3::new(1.0, 2.0, 3.0), Quat::from_rotation_z(FRAC_PI_2)),
            Pose::new(Vec3::new(-0.5, 0.25, 4.0), Quat::from_rotation_x(0.7)),
        )
    }

    /// Homogeneous 4 × 4 matrices are the outside truth of composition and inverse.
    #[test]
    fn agrees_with_matrices() {
        let (a, b) = sample();
        let matrix =
            |pose: Pose| glam::Mat4::from_rotation_translation(pose.orientation, pose.position);
        let point = Vec3::new(0.3, -0.2, 0.9);
        let composed = (matrix(a) * matrix(b)).transform_point3(point);
        // f32 round-off of coordinates up to 10.
        assert!((a.compose(b).transform_point(point) - composed).length() < 4e-6);
        let inverse = matrix(a).inverse().transform_point3(point);
        assert!((a.inverse().transform_point(point) - inverse).length() < 4e-6);
        let vector = matrix(a).transform_vector3(point);
        assert!((a.transform_vector(point) - vector).length() < 1e-6);
    }

    #[test]
    fn interpolates_along_the_shorter_arc() {
        let (a, _) = sample();
        // The same rotation by the other sign: the naive arc would go the long way round.
        let b = Pose::new(
            a.position + Vec3::X,
            -(a.orientation * Quat::from_rotation_y(0.4)),
        );
        let middle = a.interpolate(b, 0.5);
        assert!((middle.position - (a.position + Vec3::X * 0.5)).length() < 1e-6);
        let expected = a.orientation * Quat::from_rotation_y(0.2);
        assert!(middle.orientation.dot(expected).abs() > 1.0 - 1e-6);
        assert_eq!(a.interpolate(b, 0.0).position, a.position);
    }

    #[test]
    fn rejects_what_no_tracker_may_deliver() {
        let (a, _) = sample();
        assert!(a.is_valid());
        let of_length = |length: f32| Pose::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 0.0, length));
        assert!(of_length(0.9991).is_valid() && !of_length(1.002).is_valid());
        assert!(!Pose::from_position(Vec3::new(f32::NAN, 0.0, 0.0)).is_valid());
        assert!(!Pose::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 0.0, 0.0)).is_valid());
        assert!(!Pose::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 0.0, f32::INFINITY)).is_valid());
    }
}
