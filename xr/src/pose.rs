//! Rigid transforms.

use glam::{Quat, Vec3};

/// How far a quaternion's length may be from 1: above what rounding to f32 and a runtime's
/// own filter leave, below what would visibly scale a mesh.
const UNIT_TOLERANCE: f32 = 1e-3;

/// A rigid transform `parent_from_child`: it takes a point's coordinates in the child frame
/// to its coordinates in the parent frame, `p_parent = orientation * p_child + position`.
/// [`Pose::IDENTITY`] by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Origin of the child frame in the parent frame, m.
    pub position: Vec3,
    /// Rotation from the child frame to the parent frame, a unit quaternion.
    pub orientation: Quat,
}

impl Pose {
    /// The transform of a child frame that coincides with the parent frame.
    pub const IDENTITY: Self = Self {
        position: Vec3::ZERO,
        orientation: Quat::IDENTITY,
    };

    /// A pose from its position (m) and its orientation (unit quaternion).
    pub const fn new(position: Vec3, orientation: Quat) -> Self {
        Self {
            position,
            orientation,
        }
    }

    /// Whether position and orientation are finite and the quaternion is of unit length
    /// within 1e-3.
    pub fn is_valid(&self) -> bool {
        self.position.is_finite()
            && self.orientation.is_finite()
            && (self.orientation.length() - 1.0).abs() <= UNIT_TOLERANCE
    }

    /// Position interpolated linearly, orientation by the shorter spherical arc, at `s` in
    /// 0..=1 between `self` and `to`. `s` = 0 gives `self` and 1 gives `to`, bit for bit: a
    /// recorded pose that is asked for at its own time must come back unchanged.
    pub fn interpolate(&self, to: &Self, s: f32) -> Self {
        if s <= 0.0 {
            return *self;
        }
        if s >= 1.0 {
            return *to;
        }
        Self {
            position: self.position.lerp(to.position, s),
            orientation: self.orientation.slerp(to.orientation, s),
        }
    }

    /// The point `p` (m, child frame) in the parent frame, m.
    pub fn transform_point(&self, p: Vec3) -> Vec3 {
        self.orientation * p + self.position
    }

    /// `parent_from_grandchild` from `parent_from_child` (self) and `child_from_grandchild`.
    pub fn compose(&self, child_from_grandchild: &Self) -> Self {
        Self {
            position: self.transform_point(child_from_grandchild.position),
            orientation: self.orientation * child_from_grandchild.orientation,
        }
    }

    /// `child_from_parent`.
    pub fn inverse(&self) -> Self {
        let orientation = self.orientation.conjugate();
        Self {
            position: -(orientation * self.position),
            orientation,
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;
    use std::f32::consts::PI;

    #[test]
    fn interpolation_goes_the_short_way_round() {
        // 0 and 1.5 pi about Y are a quarter turn apart backwards: halfway is -pi/4. The two
        // quaternions have a negative dot product, so a slerp that ignored it gives 3/4 pi.
        let a = Pose::new(Vec3::ZERO, Quat::from_rotation_y(0.0));
        let b = Pose::new(Vec3::new(2.0, 0.0, -4.0), Quat::from_rotation_y(1.5 * PI));
        let m = a.interpolate(&b, 0.5);
        assert_eq!(m.position, Vec3::new(1.0, 0.0, -2.0));
        let x = m.orientation * Vec3::X;
        // Ry(-pi/4) X = (cos, 0, sin); 1e-6 is a few f32 roundings of values below 1.
        let c = (0.5f32).sqrt();
        assert!((x - Vec3::new(c, 0.0, c)).length() < 1e-6, "{x}");
    }

    #[test]
    fn ends_are_exact_even_for_a_sloppy_quaternion() {
        let a = Pose::new(Vec3::X, Quat::from_xyzw(0.0, 0.0, 0.0, 1.0005));
        // Of length 1.0003, and so near to `a` that a slerp would normalise.
        let b_turn = Quat::from_xyzw(0.001, 0.0, 0.0, 1.0003);
        let b = Pose::new(Vec3::Y, b_turn);
        assert_eq!(a.interpolate(&b, 0.0), a);
        assert_eq!(a.interpolate(&b, 1.0), b);
    }

    #[test]
    fn validity() {
        let mut p = Pose::IDENTITY;
        assert!(p.is_valid());
        p.orientation = Quat::from_xyzw(0.0, 0.0, 0.0, 1.002);
        assert!(!p.is_valid());
        p.orientation = Quat::from_xyzw(0.0, 0.0, 0.0, 0.9991);
        assert!(p.is_valid());
        p.orientation = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        assert!(!p.is_valid());
        p = Pose::IDENTITY;
        p.position.y = f32::INFINITY;
        assert!(!p.is_valid());
        p = Pose::IDENTITY;
        p.orientation.z = f32::NAN;
        assert!(!p.is_valid());
    }

    #[test]
    fn inverse_undoes_and_compose_chains() {
        let p = Pose::new(
            Vec3::new(0.1, 0.8, -0.4),
            Quat::from_rotation_z(0.7) * Quat::from_rotation_y(-1.1),
        );
        let q = p.compose(&p.inverse());
        // Products of unit f32 values: a few ulp of 1.
        assert!(q.position.length() < 1e-6);
        assert!((q.orientation.dot(Quat::IDENTITY).abs() - 1.0).abs() < 1e-6);
        let point = Vec3::new(0.3, -0.2, 0.9);
        let chained = p.compose(&p).transform_point(point);
        assert!((chained - p.transform_point(p.transform_point(point))).length() < 1e-6);
    }
}
