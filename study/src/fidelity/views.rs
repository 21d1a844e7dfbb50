//! The views of the liquids.

use glam::{Affine3A, Vec3};
use vitriol_render::{Fov, View};

use super::states::StateSpec;

/// Distance between the eyes, metres: the median of grown people (Dodgson 2004).
const EYES_APART: f32 = 0.063;

/// Part by which a frustum's outer half is wider than its mean, and the inner half narrower; and the lower and the upper one. A headset's
/// are so.
const ASYMMETRY: [f32; 2] = [0.15, 0.1];

/// A head's way between two frames: 0.2 m/s at 90 Hz, metres.
const HEAD_STEP: f32 = 0.0022;

/// A place of the head.
#[derive(Clone, Copy, Debug)]
pub struct Stand {
    /// Its name.
    pub name: &'static str,
    /// Offset from the target to the point between the eyes, metres.
    offset: [f32; 3],
}

/// Four places around the liquid.
pub const STANDS: [Stand; 4] = [
    Stand {
        name: "before the bench",
        offset: [0.0, 0.18, 0.76],
    },
    Stand {
        name: "over the rim",
        offset: [-0.08, 0.34, 0.28],
    },
    Stand {
        name: "close",
        offset: [0.14, 0.08, 0.26],
    },
    Stand {
        name: "from the side",
        offset: [0.48, 0.02, 0.10],
    },
];

impl Stand {
    /// Left and right eye there, for pictures of `size` pixels, after so many
    /// frames of a head that moves to the right.
    pub fn eyes(&self, state: &StateSpec, size: [u32; 2], frame: u32) -> [View; 2] {
        let target = Vec3::from(state.target);
        let offset = Vec3::from(self.offset);
        let between = View::look_at(target + offset, target, Fov::symmetric(1.0, 1.0));
        let axes = between.stage_from_eye.matrix3;
        let middle = target + offset + Vec3::from(axes.x_axis) * (HEAD_STEP * frame as f32);
        let up = state.reach / offset.length();
        let right = up * size[0] as f32 / size[1] as f32;
        [-1.0, 1.0].map(|side: f32| {
            let eye = middle + Vec3::from(axes.x_axis) * (0.5 * side * EYES_APART);
            // Eyes look ahead side by side; their frusta are shifted towards the target.
            let towards = -0.5 * side * EYES_APART / offset.length();
            let wider = |outer: f32| 1.0 + ASYMMETRY[0] * outer;
            View {
                stage_from_eye: Affine3A {
                    matrix3: axes,
                    translation: eye.into(),
                },
                fov: Fov {
                    left: (towards - right * wider(-side)).atan(),
                    right: (towards + right * wider(side)).atan(),
                    up: (up * (1.0 - ASYMMETRY[1])).atan(),
                    down: -(up * (1.0 + ASYMMETRY[1])).atan(),
                },
            }
        })
    }
}
