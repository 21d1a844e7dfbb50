//! Between the stage in which tracks and headsets have their poses, in real metres about the origin of the scene's file, and the frame
//! that is solved and drawn: about the scene's own origin ([`Scene::origin`]), where numbers of 32 bits are exact, and in its own unit.
//!
//! | frame | about | unit |
//! |---|---|---|
//! | stage | origin of the scene's file | m |
//! | near | the scene's own origin | m |
//! | scene | the scene's own origin | the scene's, m / [`length_scale`](vitriol_sim::scene::Scale::length_scale) |

use glam::{DVec3, Vec3};
use vitriol_sim::bodies;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::{StepInput, World};
use vitriol_xr::{Hand, PoseFrame};

/// The scene's own origin in the stage, m.
pub fn origin(scene: &Scene) -> Vec3 {
    (scene.origin * scene.scale.length_scale).as_vec3()
}

/// A place of the scene in the stage, m.
pub fn stage_from_scene(scene: &Scene, at: DVec3) -> DVec3 {
    (at + scene.origin) * scene.scale.length_scale
}

/// A frame of the stage near the scene's own origin, m.
pub fn near_from_stage(frame: &PoseFrame, scene: &Scene) -> PoseFrame {
    moved(frame, -origin(scene))
}

/// A frame near the scene's own origin in the stage, m.
pub fn stage_from_near(frame: &PoseFrame, scene: &Scene) -> PoseFrame {
    moved(frame, origin(scene))
}

fn moved(frame: &PoseFrame, by: Vec3) -> PoseFrame {
    let mut frame = frame.clone();
    frame.stage_from_view.position += by;
    for hand in &mut frame.hands {
        hand.stage_from_grip.position += by;
        hand.stage_from_aim.position += by;
    }
    frame
}

/// A frame of the stage as a step's input. It goes to the scene's unit first, and then to its origin: the bits of a step depend on it.
pub fn input(frame: &PoseFrame, scene: &Scene) -> StepInput {
    let (scale, origin) = (scene.scale.length_scale as f32, scene.origin.as_vec3());
    let place = |at: Vec3| at / scale - origin;
    let head = &frame.stage_from_view;
    // The greater of squeeze and trigger closes a hand.
    let grip = |hand: &Hand| bodies::Hand {
        stage_from_grip: Pose::new(
            place(hand.stage_from_grip.position),
            hand.stage_from_grip.orientation,
        ),
        squeeze: hand.squeeze.max(hand.trigger),
        present: hand.active && hand.valid,
    };
    StepInput {
        hands: frame.hands.each_ref().map(grip),
        head: Some(Pose::new(place(head.position), head.orientation)),
    }
}

/// stage_from_flask of each flask, m, as a track has it.
pub fn flasks(world: &World) -> Vec<vitriol_xr::Pose> {
    let scene = world.scene();
    let (scale, origin) = (scene.scale.length_scale as f32, scene.origin.as_vec3());
    let real =
        |pose: &Pose| vitriol_xr::Pose::new(scale * (pose.position + origin), pose.orientation);
    world.poses().iter().map(real).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// A scene at a twentieth that stands 2 m to the right: a hand 2.1 m to the right is 0.1 m from its origin, 2 of its units.
    #[test]
    fn a_hand_goes_from_the_stage_to_the_scene_and_back() {
        let mut scene = Scene::builtin("single-dilution").unwrap();
        scene.origin = DVec3::new(40.0, 0.0, 0.0);
        assert!((origin(&scene) - 2.0 * Vec3::X).length() < 1e-6);
        let mut hand = Hand::default();
        hand.stage_from_grip.position = Vec3::new(2.1, 0.8, -0.4);
        let frame = PoseFrame {
            stage_from_view: vitriol_xr::Pose::new(Vec3::new(2.0, 1.2, 0.0), glam::Quat::IDENTITY),
            hands: [hand, Hand::default()],
            ..PoseFrame::default()
        };
        let near = near_from_stage(&frame, &scene);
        let input = input(&frame, &scene);
        // Some roundings of 32 bits of 40.
        let at = input.hands[0].stage_from_grip.position;
        assert!((at - Vec3::new(2.0, 16.0, -8.0)).length() < 1e-5, "{at}");
        let head = input.head.unwrap().position;
        assert!((head - Vec3::new(0.0, 24.0, 0.0)).length() < 1e-5, "{head}");
        let back = stage_from_near(&near, &scene).hands[0]
            .stage_from_grip
            .position;
        assert!((back - Vec3::new(2.1, 0.8, -0.4)).length() < 1e-6, "{back}");
        let place = stage_from_scene(&scene, at.as_dvec3());
        assert!(
            (place - DVec3::new(2.1, 0.8, -0.4)).length() < 1e-6,
            "{place}"
        );
    }
}
