//! A bare hand grips by closing round a flask.
//!
//! How far fingers are bent is no measure of that: a hand at rest is bent as much as one that holds a beaker. So it is closed where
//! thumb and fingers touch the same flask from opposite sides, and open where they no longer do. The glass does not stop
//! them: fingers that go into it touch it, too. The result is the hand's squeeze, which a recording keeps.

use glam::Vec3;
use vitriol_sim::world::World;
use vitriol_xr::{Joints, Pose, PoseFrame, Side};

/// Distances of the skin from the glass (m) at which a finger touches it, and at which it clearly does not. A tracked
/// fingertip is off by some 10 mm.
const TOUCHES: f32 = 0.004;
const AWAY: f32 = 0.025;
/// Least angle between thumb and finger, seen from the flask's axis, that has it between them, rad.
const OPPOSITE: f32 = 1.4;
/// Fingers beside the thumb that must touch.
const FINGERS: usize = 2;

/// Closes the bare hands of `now`, whose joints these are, by how they lie round the flasks. `last` are the poses of the frame
/// before, of which the flasks are; `None` where the bench has leapt since then.
pub fn close(
    now: &mut PoseFrame,
    joints: &[Option<Joints>; 2],
    last: Option<&PoseFrame>,
    world: &World,
    stage_from_scene: &Pose,
) {
    for side in Side::BOTH {
        let Some(joints) = &joints[side as usize] else {
            continue;
        };
        let hand = &mut now.hands[side as usize];
        let grip = hand.stage_from_grip;
        let before = last.map(|last| last.hand(side).stage_from_grip);
        let flasks = 0..world.scene().flasks.len();
        let closed = flasks.filter_map(|flask| {
            // A flask in the hand goes with it, and is to be seen from where the hand was.
            let then_from_now = match (world.holder(flask) == Some(side as usize), before) {
                (false, _) => Pose::IDENTITY,
                (true, Some(before)) => before.compose(&grip.inverse()),
                (true, None) => return Some(1.0),
            };
            let scene_from_now = stage_from_scene.inverse().compose(&then_from_now);
            closed(joints, world, flask, &scene_from_now)
        });
        hand.squeeze = closed.fold(hand.squeeze, f32::max);
    }
}

/// How far a hand is closed round a flask, 0 to 1; `None` where it is not round it, or nobody can grip that.
fn closed(joints: &Joints, world: &World, flask: usize, scene_from_stage: &Pose) -> Option<f32> {
    let scale = world.scene().scale.length_scale as f32;
    let flask_from_scene = world.poses().get(flask)?.inverse();
    // Distance of a tip's skin from the glass, at real size, and where it is seen from the axis.
    let touch = |index: usize| {
        let (position, radius) = joints.0[index];
        let position = scene_from_stage.transform_point(position) / scale;
        let distance = scale * world.distance(flask, position)? - radius;
        let around = flask_from_scene.transform_point(position) * Vec3::new(1.0, 0.0, 1.0);
        Some((distance, around))
    };
    let (thumb, side) = touch(Joints::THUMB)?;
    let mut fingers: Vec<f32> = Joints::FINGERS
        .into_iter()
        .filter_map(touch)
        .filter(|(_, around)| around.angle_between(side) > OPPOSITE)
        .map(|(distance, _)| distance)
        .collect();
    fingers.sort_by(f32::total_cmp);
    let farthest = thumb.max(*fingers.get(FINGERS - 1)?);
    Some(((AWAY - farthest) / (AWAY - TOUCHES)).clamp(0.0, 1.0))
}
