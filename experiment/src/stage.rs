//! Between the stage's real metres, in which tracks and headsets speak, and the
//! scene's own.

use vitriol_sim::bodies;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::{StepInput, World};
use vitriol_xr::{Hand, PoseFrame};

/// A recorded frame as a step's input, where the scene is near its own origin.
pub fn input(frame: &PoseFrame, scene: &Scene) -> StepInput {
    let head = &frame.stage_from_view;
    let position = head.position / scene.scale.length_scale as f32 - scene.origin.as_vec3();
    StepInput {
        hands: hands(&frame.hands, scene),
        head: Some(Pose::new(position, head.orientation)),
    }
}

/// Recorded hands in the simulation's terms, where the scene is near its own origin.
pub fn hands(hands: &[Hand; 2], scene: &Scene) -> [bodies::Hand; 2] {
    let origin = scene.origin.as_vec3();
    hands.each_ref().map(|hand| {
        let mut hand = grip(hand, scene.scale.length_scale);
        hand.stage_from_grip.position -= origin;
        hand
    })
}

/// A recorded hand in the simulation's terms, in the frame of the scene's file.
/// Hands move in real metres, the scene in its own.
pub fn grip(hand: &Hand, length_scale: f64) -> bodies::Hand {
    bodies::Hand {
        stage_from_grip: Pose {
            position: hand.stage_from_grip.position / length_scale as f32,
            orientation: hand.stage_from_grip.orientation,
        },
        squeeze: hand.squeeze.max(hand.trigger),
        present: hand.active && hand.valid,
    }
}

/// stage_from_flask of each flask as a track keeps it, in real metres.
pub fn flasks(world: &World) -> Vec<vitriol_xr::Pose> {
    let scene = world.scene();
    let (scale, origin) = (scene.scale.length_scale as f32, scene.origin.as_vec3());
    let real =
        |pose: &Pose| vitriol_xr::Pose::new(scale * (pose.position + origin), pose.orientation);
    world.poses().iter().map(real).collect()
}
