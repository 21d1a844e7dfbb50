//! Cameras: the film's on its tripod, and the user's eyes.

use glam::{Affine3A, Vec3};
use serde_json::{Value, json};
use vitriol_render::{Fov, View};
use vitriol_run::{EYES_APART, HEAD_FIELD, stage, tripod};
use vitriol_sim::scene::Scene;
use vitriol_xr::PoseFrame;

/// Width over height of a picture where no headset gives it.
const ASPECT: f32 = 16.0 / 9.0;

/// A camera in the stage, m: it looks along its −Z, its +Y is up.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedView {
    /// Its name.
    pub name: &'static str,
    /// Where it is and what it sees.
    pub view: View,
}

/// Cameras of a scene at a moment, eyes where a frame has them.
pub fn of(scene: &Scene, frame: Option<&PoseFrame>) -> Vec<NamedView> {
    let mut fixed = tripod(scene, ASPECT);
    fixed.stage_from_eye.translation += glam::Vec3A::from(stage::origin(scene));
    let mut cameras = vec![NamedView {
        name: "tripod",
        view: fixed,
    }];
    let eyes = [("left eye", -0.5), ("right eye", 0.5)];
    for (index, (name, side)) in eyes.into_iter().enumerate() {
        let Some(frame) = frame else { break };
        let head = &frame.stage_from_view;
        let stage_from_head =
            Affine3A::from_rotation_translation(head.orientation.normalize(), head.position);
        let seen = frame.info.fov[index];
        let fov = if seen.right > seen.left && seen.up > seen.down {
            Fov {
                left: seen.left,
                right: seen.right,
                up: seen.up,
                down: seen.down,
            }
        } else {
            Fov::symmetric(HEAD_FIELD.to_radians(), ASPECT)
        };
        cameras.push(NamedView {
            name,
            view: View {
                stage_from_eye: stage_from_head
                    * Affine3A::from_translation(Vec3::X * (side * EYES_APART)),
                fov,
            },
        });
    }
    cameras
}

/// Cameras at a time as JSON: matrices by rows, angles of the frustum's planes in radians.
pub fn json(cameras: &[NamedView], seconds: f64) -> Value {
    let camera = |NamedView { name, view }: &NamedView| {
        let matrix = glam::Mat4::from(view.stage_from_eye).transpose();
        let fov = view.fov;
        json!({
            "name": name,
            "stage_from_camera": matrix.to_cols_array_2d(),
            "fov_rad": { "left": fov.left, "right": fov.right, "up": fov.up, "down": fov.down },
        })
    };
    json!({
        "time_s": seconds,
        "axes": "+Y up, the camera looks along its -Z; metres",
        "cameras": cameras.iter().map(camera).collect::<Vec<_>>(),
    })
}
