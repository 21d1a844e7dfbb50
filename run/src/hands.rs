//! The user's hands as gloves: without them nobody sees where to grip.
//!
//! A hand is OpenXR's 26 joints, tracked or, from a controller's pose, as a hand would hold it; bones are
//! made of either. What a hand holds is between its palm and its fingers.

mod bones;
mod grasp;
mod held_glass;
mod posture;
#[cfg(test)]
mod tests;

use vitriol_render::{Bone, Finish};
use vitriol_sim::scene::Scene;
use vitriol_sim::world::World;
use vitriol_xr::{Hand, Pose, Side};

pub(crate) use bones::ACROSS;
pub use bones::{JOINTS, Joints, bones_of};
pub use grasp::{Grasp, closed_on};
pub use held_glass::Glass;
pub use posture::Posture;

/// A hand's bones without the glove: the cuff is left out, and the rest is skin.
fn bare(mut bones: Vec<Bone>) -> Vec<Bone> {
    bones.retain(|bone| bone.finish != Finish::Cuff);
    for bone in &mut bones {
        bone.finish = Finish::Skin;
    }
    bones
}

/// The gloves of a scene's user.
#[derive(Clone, Debug)]
pub struct Gloves {
    /// Of the flasks, in the scene's order.
    glasses: Vec<Glass>,
}

impl Gloves {
    /// The gloves of a scene's user.
    pub fn of(scene: &Scene) -> Self {
        let scale = scene.scale.length_scale;
        let glass = |flask: &vitriol_sim::scene::Flask| Glass::of(&flask.profile, scale);
        Self {
            glasses: scene.flasks.iter().map(glass).collect(),
        }
    }

    /// The bones of both hands in the scene's stage, real metres, as they are at the flasks of `world`: of hands that are
    /// tracked their own, of others as their controllers' poses place them. None of a hand that is not there.
    pub fn worn(
        &self,
        world: &World,
        hands: &[Hand; 2],
        joints: &[Option<Joints>; 2],
    ) -> [Vec<Bone>; 2] {
        Side::BOTH.map(|side| {
            let hand = &hands[side as usize];
            let joints = match &joints[side as usize] {
                Some(joints) => *joints,
                None if hand.active && hand.valid => self.of_controller(world, hand, side),
                None => return Vec::new(),
            };
            let bones = bones_of(&joints);
            match world.worn().gloves {
                Some(gloves) if !gloves[side as usize] => bare(bones),
                _ => bones,
            }
        })
    }

    fn of_controller(&self, world: &World, hand: &Hand, side: Side) -> Joints {
        let held = (0..self.glasses.len()).find(|&n| world.holder(n) == Some(side as usize));
        let held = held.and_then(|n| Some((self.glasses.get(n)?, world.poses().get(n)?)));
        let grasp = held.map(|(glass, pose)| {
            let scale = world.scene().scale.length_scale as f32;
            let stage_from_flask = Pose::new(scale * pose.position, pose.orientation);
            closed_on(&hand.stage_from_grip, side, glass, &stage_from_flask)
        });
        let grasp = grasp.unwrap_or_else(|| Grasp::empty(hand.squeeze.max(hand.trigger)));
        grasp.joints(&hand.stage_from_grip, side)
    }
}
