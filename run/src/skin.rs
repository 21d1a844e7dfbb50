//! What of the user liquid can touch: the bones of the gloves, and the face.

use glam::Vec3;
use vitriol_render::Bone;
use vitriol_sim::solver::{Skin, SkinPart};
use vitriol_xr::Pose;

/// Middles of the two spheres of a face, from the eyes' middle along the head's axes, and their radius, m: a head is 0.15 m broad
/// and 0.19 m long (NASA-STD-3000, males' mean), and its chin is 0.11 m below the eyes.
const FACE: [Vec3; 2] = [Vec3::new(0.0, 0.02, 0.05), Vec3::new(0.0, -0.05, 0.04)];
const FACE_RADIUS: f32 = 0.085;

/// What of the user liquid can touch, in the scene's own metres: the bones of its hands, and its face, which are in real metres.
pub fn skin(hands: [&[Bone]; 2], stage_from_head: &Pose, length_scale: f64) -> Vec<SkinPart> {
    let scale = length_scale as f32;
    let part = |whose: Skin, ends: [Vec3; 2], radii: [f32; 2]| SkinPart {
        whose,
        ends: ends.map(|end| end / scale),
        radii: radii.map(|radius| radius / scale),
    };
    let of_hand = |whose: Skin, bones: &[Bone]| -> Vec<SkinPart> {
        let bones = bones.iter();
        bones
            .map(|bone| part(whose, bone.ends, bone.radii))
            .collect()
    };
    let mut skin = of_hand(Skin::Left, hands[0]);
    skin.extend(of_hand(Skin::Right, hands[1]));
    let ends = FACE.map(|at| stage_from_head.transform_point(at));
    skin.push(part(Skin::Face, ends, [FACE_RADIUS; 2]));
    skin
}
