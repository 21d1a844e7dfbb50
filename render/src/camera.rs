//! Eyes, their frusta and the projection.
//!
//! Conventions: the stage is right-handed with +Y up, in metres; an eye looks
//! along its own −Z with +Y up (as in OpenXR). Clip space is Vulkan's: +Y down.
//! **Depth is reversed and its far plane lies at infinity**: depth = near / z,
//! 1 at the near plane and 0 infinitely far away, compared with GREATER and
//! cleared to 0. Floating-point depth then keeps its relative precision over
//! the whole range, and a depth turns back into a distance by one division.

use glam::{Affine3A, Mat3, Mat4, Vec3, Vec4};

/// Distance of the near plane from the eye, metres. A headset's wearer leans
/// right over the glass, so it is close.
pub const NEAR: f32 = 0.01;

/// The four angles between an eye's axis and the planes of its frustum,
/// radians, signed as in OpenXR's `XrFovf`: `left` and `down` are negative for
/// a frustum that holds its axis. A headset's are not symmetric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fov {
    /// Angle to the left plane.
    pub left: f32,
    /// Angle to the right plane.
    pub right: f32,
    /// Angle to the upper plane.
    pub up: f32,
    /// Angle to the lower plane.
    pub down: f32,
}

impl Fov {
    /// A symmetric frustum of the full `vertical` angle (radians) for a
    /// picture of `aspect` = width / height.
    pub fn symmetric(vertical: f32, aspect: f32) -> Self {
        let up = 0.5 * vertical;
        let right = (up.tan() * aspect).atan();
        Self {
            left: -right,
            right,
            up,
            down: -up,
        }
    }

    /// The projection `clip_from_eye` (reversed depth, infinite far plane) for
    /// a near plane at `near`, in the unit of the eye space's coordinates.
    pub fn clip_from_eye(&self, near: f32) -> Mat4 {
        let [l, r, u, d] = [self.left, self.right, self.up, self.down].map(f32::tan);
        Mat4::from_cols(
            Vec4::new(2.0 / (r - l), 0.0, 0.0, 0.0),
            Vec4::new(0.0, 2.0 / (d - u), 0.0, 0.0),
            Vec4::new((r + l) / (r - l), (d + u) / (d - u), 0.0, -1.0),
            Vec4::new(0.0, 0.0, near, 0.0),
        )
    }
}

/// One eye: a headset has two, a film one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the eye is in the stage; rigid, in metres.
    pub stage_from_eye: Affine3A,
    /// Its frustum.
    pub fov: Fov,
}

impl View {
    /// A fixed camera at `eye` that looks at `target` (metres in the stage)
    /// and holds +Y upright. With no upright to hold (it looks straight up or
    /// down, or `eye` = `target`), −Z is taken for up, or for forward.
    pub fn look_at(eye: Vec3, target: Vec3, fov: Fov) -> Self {
        let back = (eye - target).normalize_or(Vec3::Z);
        let right = Vec3::Y
            .cross(back)
            .try_normalize()
            .unwrap_or_else(|| Vec3::NEG_Z.cross(back).normalize_or(Vec3::X));
        let axes = Mat3::from_cols(right, back.cross(right), back);
        Self {
            stage_from_eye: Affine3A::from_mat3_translation(axes, eye),
            fov,
        }
    }

    /// The film's camera for a bench before a user who stands at the origin
    /// and looks along −Z: the table's top at y = 0.75, vessels around
    /// (±0.12, 0.75, −0.40), and what a hand lifts up to y ≈ 1.0 in the frame.
    /// `aspect` is width / height.
    pub fn bench(aspect: f32) -> Self {
        // A long lens from a standing observer's place: little perspective
        // distortion of the glass, and the rims' ellipses stay flat.
        Self::look_at(
            Vec3::new(0.0, 1.06, 0.36),
            Vec3::new(0.0, 0.865, -0.40),
            Fov::symmetric(20.5_f32.to_radians(), aspect),
        )
    }

    /// `clip_from_stage` for coordinates in which a unit is `length_scale`
    /// metres of the stage.
    ///
    /// A projection does not change when the world and the eye's distance are
    /// scaled alike; so a scene simulated at another size is drawn by moving
    /// the eye instead of the particles.
    pub fn clip_from_scaled(&self, length_scale: f32) -> Mat4 {
        let mut scaled_from_eye = self.stage_from_eye;
        scaled_from_eye.translation /= length_scale;
        self.fov.clip_from_eye(NEAR / length_scale) * Mat4::from(scaled_from_eye.inverse())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quest-like left eye: wide to the left and down.
    const ASYMMETRIC: Fov = Fov {
        left: -0.94,
        right: 0.70,
        up: 0.73,
        down: -0.96,
    };

    #[test]
    fn corners_of_the_frustum_are_the_corners_of_the_picture() {
        let clip_from_eye = ASYMMETRIC.clip_from_eye(NEAR);
        for (horizontal, x) in [(ASYMMETRIC.left, -1.0), (ASYMMETRIC.right, 1.0)] {
            for (vertical, y) in [(ASYMMETRIC.up, -1.0), (ASYMMETRIC.down, 1.0)] {
                for distance in [NEAR, 0.4, 30.0] {
                    let point = Vec3::new(horizontal.tan(), vertical.tan(), -1.0) * distance;
                    let ndc = clip_from_eye.project_point3(point);
                    let expected = Vec3::new(x, y, NEAR / distance);
                    // Five roundings in f32.
                    assert!((ndc - expected).length() < 1e-6, "{ndc} {expected}");
                }
            }
        }
    }

    #[test]
    fn look_at_centres_its_target_upright() {
        let fov = Fov::symmetric(0.6, 16.0 / 9.0);
        for (eye, target) in [
            (Vec3::new(0.3, 1.2, 0.4), Vec3::new(0.0, 0.8, -0.4)),
            (Vec3::new(0.0, 2.0, 0.0), Vec3::ZERO),
            (Vec3::new(0.0, -2.0, 1.0), Vec3::new(0.0, 3.0, 1.0)),
        ] {
            let clip_from_stage = View::look_at(eye, target, fov).clip_from_scaled(1.0);
            let centre = clip_from_stage.project_point3(target);
            assert!(centre.truncate().length() < 1e-5, "{centre}");
            let above = clip_from_stage.project_point3(target + Vec3::Y * 0.01);
            assert!(above.x.abs() < 1e-5 && above.y <= 1e-6, "{above}");
        }
    }

    #[test]
    fn scaled_world_projects_to_the_same_pixels() {
        let view = View::bench(16.0 / 9.0);
        let point = Vec3::new(0.1, 0.8, -0.35);
        let real = view.clip_from_scaled(1.0).project_point3(point);
        let scaled = view.clip_from_scaled(0.05).project_point3(point / 0.05);
        assert!((real - scaled).length() < 1e-5, "{real} {scaled}");
    }
}
