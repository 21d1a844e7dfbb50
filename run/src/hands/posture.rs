//! The hand that holds a controller: its size, and how its fingers bend.

use glam::Vec3;
use vitriol_xr::Side;

use super::bones::{FINGERS, JOINTS, Joints, PALM, THUMB, WRIST};

/// Length of a hand from the wrist to the tip of the middle finger, m: between the medians of women (181 mm) and men (194 mm),
/// ANSUR II (2012).
const HAND: f32 = 0.188;
/// Lengths of each finger's proximal, intermediate and distal bone over the hand's (B. Buchholz, T. Armstrong and S. Goldstein,
/// "Anthropometric data for describing the kinematics of the human hand", 1992), from index to little finger; and of the
/// thumb's metacarpal, proximal and distal one.
const BONES: [[f32; 3]; 4] = [
    [0.245, 0.143, 0.097],
    [0.266, 0.170, 0.108],
    [0.244, 0.165, 0.107],
    [0.204, 0.117, 0.093],
];
const THUMB_BONES: [f32; 3] = [0.251, 0.196, 0.158];

// In a hand's own frame: x to the fingers, y out of the palm, z to the thumb; m. Its origin is the grip's, the middle of the
// palm's skin (OpenXR, "Standard pose identifiers"). The palm is 84 mm broad (NASA-STD-3000) and 28 mm thick.
/// Middles of the wrist and the thumb's root.
const WRIST_AT: Vec3 = Vec3::new(-0.048, -0.016, 0.002);
const THUMB_AT: Vec3 = Vec3::new(-0.034, -0.010, 0.022);
/// Of each finger's metacarpal bone the root, and the knuckle.
const METACARPALS: [[Vec3; 2]; 4] = [
    [
        Vec3::new(-0.036, -0.016, 0.014),
        Vec3::new(0.034, -0.0125, 0.0295),
    ],
    [
        Vec3::new(-0.038, -0.017, 0.004),
        Vec3::new(0.037, -0.0135, 0.0085),
    ],
    [
        Vec3::new(-0.037, -0.016, -0.006),
        Vec3::new(0.030, -0.0130, -0.0120),
    ],
    [
        Vec3::new(-0.034, -0.015, -0.015),
        Vec3::new(0.020, -0.0125, -0.0305),
    ],
];
/// The index finger's.
pub(super) const INDEX: [Vec3; 2] = METACARPALS[0];
/// Radii at root, knuckle, the two joints and the tip of an index finger in a glove, and of the other fingers over its: joints 18 to 20 mm
/// broad (NASA-STD-3000, index finger).
const RADII: [f32; 5] = [0.0140, 0.0118, 0.0096, 0.0084, 0.0070];
const THICKNESS: [f32; 4] = [1.0, 1.02, 0.96, 0.86];
const THUMB_RADII: [f32; 4] = [0.0150, 0.0125, 0.0108, 0.0085];
/// How far straight fingers spread towards the thumb, rad.
const SPREAD: [f32; 4] = [0.09, 0.01, -0.06, -0.16];

/// How a hand's joints are bent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Posture {
    /// Of each finger, from the index to the little one, the angles at the knuckle and the two joints, rad.
    pub fingers: [[f32; 3]; 4],
    /// The thumb's posture.
    pub thumb: Thumb,
}

/// How a thumb is bent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thumb {
    /// Where its metacarpal bone points, in the hand's frame; of length one.
    pub along: Vec3,
    /// Where its pad faces, which is where it bends to.
    pub pad: Vec3,
    /// Angles at its two other joints, rad.
    pub bends: [f32; 2],
}

/// An open hand at rest, and a fist.
const OPEN: Posture = Posture {
    fingers: [
        [0.20, 0.30, 0.16],
        [0.26, 0.36, 0.20],
        [0.32, 0.40, 0.22],
        [0.36, 0.40, 0.22],
    ],
    thumb: Thumb {
        along: Vec3::new(0.70, 0.36, 0.62),
        pad: Vec3::new(-0.35, 0.70, -0.62),
        bends: [0.20, 0.20],
    },
};
const FIST: Posture = Posture {
    fingers: [[1.35, 1.65, 1.00]; 4],
    thumb: Thumb {
        along: Vec3::new(0.67, 0.59, 0.45),
        pad: Vec3::new(0.12, 0.52, -0.85),
        bends: [0.90, 0.80],
    },
};

impl Posture {
    /// A share of the way from this one to another.
    #[must_use]
    pub fn towards(&self, other: &Self, share: f32) -> Self {
        let mix = |a: f32, b: f32| a + share * (b - a);
        let finger =
            |n: usize| std::array::from_fn(|i| mix(self.fingers[n][i], other.fingers[n][i]));
        Self {
            fingers: std::array::from_fn(finger),
            thumb: self.thumb.towards(&other.thumb, share),
        }
    }

    /// The posture of a hand that holds nothing, closed by 0 (open) to 1 (a fist).
    pub fn empty(closed: f32) -> Self {
        OPEN.towards(&FIST, closed.clamp(0.0, 1.0))
    }

    /// The joints in the hand's frame.
    pub fn joints(&self) -> Joints {
        let mut joints = [(Vec3::ZERO, 0.0); JOINTS];
        joints[PALM] = (Vec3::new(0.0, -0.014, 0.0), RADII[0]);
        joints[WRIST] = (WRIST_AT, 0.020);
        for n in 0..4 {
            let first = FINGERS[n];
            joints[first] = (METACARPALS[n][0], THICKNESS[n] * RADII[0]);
            joints[first + 1..first + 5].copy_from_slice(&self.finger(n));
        }
        joints[THUMB..THUMB + 4].copy_from_slice(&self.thumb.chain());
        joints
    }

    /// A finger from the knuckle on.
    pub(super) fn finger(&self, n: usize) -> Chain {
        let bends = self.fingers[n];
        let straight = 1.0 - (bends[0] / FIST.fingers[n][0]).clamp(0.0, 1.0);
        let spread = Vec3::new(1.0, 0.0, straight * SPREAD[n]).normalize();
        let [_, radii @ ..] = RADII.map(|radius| THICKNESS[n] * radius);
        chain(METACARPALS[n][1], [spread, Vec3::Y], bends, BONES[n], radii)
    }
}

impl Thumb {
    /// A share of the way from this one to another.
    pub(super) fn towards(&self, other: &Self, share: f32) -> Self {
        let mix = |a: f32, b: f32| a + share * (b - a);
        Self {
            along: self.along.normalize().lerp(other.along.normalize(), share),
            pad: self.pad.normalize().lerp(other.pad.normalize(), share),
            bends: std::array::from_fn(|i| mix(self.bends[i], other.bends[i])),
        }
    }

    /// The thumb from its root on.
    pub(super) fn chain(&self) -> Chain {
        let along = self.along.normalize_or(Vec3::X);
        let pad = self.pad.reject_from(along).normalize_or(Vec3::Y);
        let bends = [0.0, self.bends[0], self.bends[1]];
        chain(THUMB_AT, [along, pad], bends, THUMB_BONES, THUMB_RADII)
    }
}

/// Four joints in a row, with their radii.
pub(super) type Chain = [(Vec3, f32); 4];

/// A row from `root` along the first axis, each bone bent from the one before towards the second; the lengths are
/// shares of the hand's, the last to the skin of the tip.
fn chain(
    root: Vec3,
    [along, pad]: [Vec3; 2],
    bends: [f32; 3],
    lengths: [f32; 3],
    radii: [f32; 4],
) -> Chain {
    let (mut at, mut bent) = (root, 0.0);
    std::array::from_fn(|n| {
        if let Some(bone) = usize::checked_sub(n, 1) {
            bent += bends[bone];
            let tip = if n == 3 { radii[3] } else { 0.0 };
            at += (HAND * lengths[bone] - tip) * (bent.cos() * along + bent.sin() * pad);
        }
        (at, radii[n])
    })
}

/// From a hand's frame to its grip's. OpenXR: −Z runs from the little finger to the thumb, +X out of the left palm and into
/// the right one; so the fingers of an open hand point along −Y.
pub(super) fn in_grip(at: Vec3, side: Side) -> Vec3 {
    let out = match side {
        Side::Left => at.y,
        Side::Right => -at.y,
    };
    Vec3::new(out, -at.x, -at.z)
}

/// A hand about to close on what lies at its palm, and what it closes to.
pub(super) const SPREAD_OUT: Posture = Posture {
    fingers: [[-0.15, 0.05, 0.02]; 4],
    thumb: Thumb {
        along: Vec3::new(-0.80, 0.40, 0.42),
        pad: Vec3::new(0.55, 0.75, -0.35),
        bends: [-0.10, -0.15],
    },
};
pub(super) const CLOSED: Posture = Posture {
    fingers: [[1.55, 1.80, 1.25]; 4],
    thumb: Thumb {
        along: Vec3::new(0.15, 0.98, 0.12),
        pad: Vec3::new(0.95, -0.10, -0.35),
        bends: [0.95, 1.35],
    },
};
