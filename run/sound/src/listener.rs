//! The listener's head.

use glam::{Quat, Vec3};

/// The listener's head in the stage: Y up, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Listener {
    /// Middle between the ears.
    pub position: Vec3,
    /// Rotation from the head's frame (-Z ahead, X to the right) to the stage's.
    pub orientation: Quat,
}

impl Default for Listener {
    fn default() -> Self {
        Self {
            position: Vec3::ZERO,
            orientation: Quat::IDENTITY,
        }
    }
}

/// Nearest that a source comes to the head's middle, metres: just outside of the head.
const NEAREST: f32 = 0.1;

impl Listener {
    /// Whether it can be used: all numbers are finite, and the orientation is a rotation.
    pub(crate) fn is_sound(&self) -> bool {
        let length = self.orientation.length_squared();
        self.position.is_finite() && self.orientation.is_finite() && length > 1e-6 && length < 1e6
    }

    /// Cosine of the angle between the source and the right ear's axis, and the source's distance in metres.
    ///
    /// The rotation is written out, as a vector unit's result need not be the same everywhere.
    pub(crate) fn see(&self, source: Vec3) -> (f32, f32) {
        let q = self.orientation.to_array();
        let scale = 1.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
        let [x, y, z, w] = q.map(|part| part * scale);
        let right = [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y + w * z),
            2.0 * (x * z - w * y),
        ];
        let [dx, dy, dz] = (source - self.position).to_array();
        let distance = (dx * dx + dy * dy + dz * dz).sqrt();
        if distance < 1e-6 {
            return (0.0, NEAREST);
        }
        if !distance.is_finite() {
            return (0.0, f32::MAX);
        }
        let along = (dx * right[0] + dy * right[1] + dz * right[2]) / distance;
        (along.clamp(-1.0, 1.0), distance.max(NEAREST))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::FRAC_PI_2;

    #[test]
    fn a_head_that_turns_left_has_what_was_ahead_at_its_right() {
        let ahead = Vec3::new(0.0, 0.0, -2.0);
        let mut listener = Listener::default();
        assert_eq!(listener.see(ahead), (0.0, 2.0));
        listener.orientation = Quat::from_rotation_y(FRAC_PI_2);
        let (along, distance) = listener.see(ahead);
        assert!((along - 1.0).abs() < 1e-6 && (distance - 2.0).abs() < 1e-6);
    }

    #[test]
    fn what_is_in_the_head_is_in_its_middle() {
        assert_eq!(Listener::default().see(Vec3::ZERO), (0.0, NEAREST));
    }

    /// Their distance is greater than a number can hold.
    #[test]
    fn what_is_farther_than_any_number_is_far() {
        let listener = Listener {
            position: Vec3::splat(-f32::MAX),
            ..Listener::default()
        };
        assert_eq!(listener.see(Vec3::splat(f32::MAX)), (0.0, f32::MAX));
    }
}
