//! From a hand's joints to a glove's bones.

use glam::Vec3;
use vitriol_render::{Bone, Finish};

/// Joints of a hand.
pub const JOINTS: usize = 26;

/// Where each joint is (m) and how far the skin is from it (m), in the order of OpenXR's `XrHandJointEXT`: palm, wrist; of
/// the thumb metacarpal, proximal, distal, tip; of index, middle, ring and little finger metacarpal, proximal, intermediate, distal,
/// tip.
pub type Joints = [(Vec3, f32); JOINTS];

pub(super) const PALM: usize = 0;
pub(super) const WRIST: usize = 1;
/// The thumb's first joint, and each finger's.
pub(super) const THUMB: usize = 2;
pub(super) const FINGERS: [usize; 4] = [6, 11, 16, 21];
/// How many bones the thumb has: the first ones.
pub(super) const THUMB_BONES: usize = 3;

/// Which of a hand's bones lies across its knuckles: behind those of thumb and fingers, three between the metacarpal ones, and the web.
pub(crate) const ACROSS: usize = THUMB_BONES + 4 * FINGERS.len() + 3 + 1;

/// What a runtime's radii are taken for at least and at most, m: a runtime that has none gives 0.
const RADII: [f32; 2] = [0.004, 0.025];
/// Radius of the skin between thumb and index finger, and over the knuckles, m. Our choice.
const WEB: f32 = 0.0085;
const KNUCKLES: f32 = 0.010;
/// Half thickness of a wrist, m, in a cuff, and what its middles lie apart
/// across: 58 mm broad (NASA-STD-3000, wrist breadth).
const WRIST_RADIUS: f32 = 0.022;
const WRIST_APART: f32 = 0.014;
/// Length of the cuff that is seen, and by how much it grows wider, m. Our choice.
const CUFF: f32 = 0.055;
const FLARE: f32 = 0.003;

/// The bones of a glove, in the joints' frame: at most [`vitriol_render::MOST_BONES`].
pub fn bones_of(joints: &Joints) -> Vec<Bone> {
    let at = |joint: usize| joints[joint].0;
    let radius = |joint: usize| joints[joint].1.clamp(RADII[0], RADII[1]);
    let bone = |ends: [Vec3; 2], radii: [f32; 2]| Bone::new(Finish::Glove, ends, radii);
    let between = |a: usize, b: usize| bone([at(a), at(b)], [radius(a), radius(b)]);

    let mut bones: Vec<Bone> = (THUMB..THUMB + THUMB_BONES)
        .map(|n| between(n, n + 1))
        .collect();
    for first in FINGERS {
        bones.extend((first..first + 4).map(|n| between(n, n + 1)));
    }
    let [index, .., little] = FINGERS;
    // Between the metacarpal bones, so that palm and back are flat.
    for pair in FINGERS.windows(2) {
        let middle = |n: usize| 0.5 * (at(pair[0] + n) + at(pair[1] + n));
        let mean = |n: usize| 0.5 * (radius(pair[0] + n) + radius(pair[1] + n));
        bones.push(bone([middle(0), middle(1)], [mean(0), mean(1)]));
    }
    bones.push(web(at(THUMB), at(THUMB + 1), [at(index), at(index + 1)]));
    bones.push(bone([at(index + 1), at(little + 1)], [KNUCKLES; 2]));
    bones.extend(cuff(
        at(WRIST),
        at(FINGERS[1] + 1),
        at(index + 1) - at(little + 1),
    ));
    bones
}

/// The skin between a thumb's first bone and an index finger's.
pub(super) fn web(root: Vec3, end: Vec3, index: [Vec3; 2]) -> Bone {
    Bone::new(
        Finish::Glove,
        [root.lerp(end, 0.35), index[0].lerp(index[1], 0.42)],
        [WEB; 2],
    )
}

/// From the wrist towards the elbow, `across` along the knuckles: two cones side by side.
fn cuff(wrist: Vec3, knuckle: Vec3, across: Vec3) -> [Bone; 2] {
    let along = (wrist - knuckle).normalize_or(Vec3::Y);
    let aside = across.reject_from(along).normalize_or(Vec3::X);
    [-0.5, 0.5].map(|side| {
        let start = wrist + side * WRIST_APART * aside;
        Bone::new(
            Finish::Cuff,
            [start, start + CUFF * along],
            [WRIST_RADIUS, WRIST_RADIUS + FLARE],
        )
    })
}
