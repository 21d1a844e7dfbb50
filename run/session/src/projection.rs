//! Where a screen's picture shows what is in the stage. A place in the picture is 0 to 1 from its upper left.

use glam::{Vec2, Vec3};
use vitriol_xr::{Pose, View};

/// Least distance before the eye that counts, m: nearer, places have no end.
const NEAREST: f32 = 0.01;

/// The upper left and the lower right corner of what has these corners, in the picture or beyond it; `None` where one is behind the eye.
pub fn bounds(eye: &View, corners: impl IntoIterator<Item = Vec3>) -> Option<[[f32; 2]; 2]> {
    let mut ends = [Vec2::INFINITY, Vec2::NEG_INFINITY];
    for corner in corners {
        let at = place(eye, corner)?;
        ends = [ends[0].min(at), ends[1].max(at)];
    }
    ends[0].is_finite().then(|| ends.map(|end| end.to_array()))
}

/// Where a place of the stage is seen; `None` behind the eye.
fn place(eye: &View, at: Vec3) -> Option<Vec2> {
    let at = eye.stage_from_eye.inverse().transform_point(at);
    let [corner, across, down] = rays(eye);
    let seen = at.truncate() / -at.z - corner.truncate();
    (at.z < -NEAREST).then(|| Vec2::new(seen.x / across.x, seen.y / down.y))
}

/// In the eye's axes: along the ray of the picture's upper left corner, and from there to the right and down to the other corners'.
fn rays(eye: &View) -> [Vec3; 3] {
    let fov = eye.fov;
    let [left, right, up, down] = [fov.left, fov.right, fov.up, fov.down].map(f32::tan);
    [
        Vec3::new(left, up, -1.0),
        (right - left) * Vec3::X,
        (down - up) * Vec3::Y,
    ]
}

/// From a place in the picture, (x, y, 1, 0), to the place on a panel of that pose and size (m) that is seen there: from its middle to the
/// right and up, over half its sides, both times the third component. By columns.
pub fn panel_from_picture(eye: &View, (panel, size): (Pose, [f32; 2])) -> [[f32; 4]; 4] {
    let panel_from_eye = panel.inverse().compose(&eye.stage_from_eye);
    let half = 0.5 * Vec2::from_array(size);
    let from = panel_from_eye.position;
    // A ray `from + t along` meets the panel's plane at t = -from.z / along.z, and its direction is linear in the picture's place.
    let column = |along: Vec3| {
        let along = panel_from_eye.orientation * along;
        let at = (from.truncate() * along.z - from.z * along.truncate()) / half;
        [at.x, at.y, along.z, 0.0]
    };
    let [corner, across, down] = rays(eye).map(column);
    [across, down, corner, [0.0; 4]]
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::panel::{SIZE, met};
    use glam::{Mat4, Quat, Vec4};
    use vitriol_xr::Fov;

    /// An eye beside a panel that leans back, in front of it.
    fn eye() -> View {
        let turned = Quat::from_rotation_y(0.4) * Quat::from_rotation_x(-0.2);
        View {
            stage_from_eye: Pose::new(Vec3::new(0.3, 1.3, 0.1), turned),
            fov: Fov {
                left: -0.7,
                right: 0.6,
                up: 0.4,
                down: -0.5,
            },
        }
    }

    fn panel() -> (Pose, [f32; 2]) {
        let pose = Pose::new(Vec3::new(0.0, 1.16, -0.8), Quat::from_rotation_x(-0.12));
        (pose, SIZE)
    }

    /// The ray through a place, by the definition of the field of view: tangents of its angles change evenly over the picture.
    fn ray([x, y]: [f32; 2]) -> (Vec3, Vec3) {
        let View {
            stage_from_eye,
            fov,
        } = eye();
        let along = Vec3::new(
            fov.left.tan() + x * (fov.right.tan() - fov.left.tan()),
            fov.up.tan() + y * (fov.down.tan() - fov.up.tan()),
            -1.0,
        );
        (
            stage_from_eye.position,
            stage_from_eye.orientation * along.normalize(),
        )
    }

    /// The matrix leads to where a ray meets the panel, as a press on it does.
    #[test]
    fn a_place_leads_to_what_is_seen_there_of_the_panel() {
        let matrix = Mat4::from_cols_array_2d(&panel_from_picture(&eye(), panel()));
        let mut on_panel = 0;
        for at in [[0.5, 0.5], [0.4, 0.6], [0.6, 0.3], [0.55, 0.55]] {
            let Some(expected) = met(ray(at), panel()) else {
                continue;
            };
            on_panel += 1;
            let found = matrix * Vec4::new(at[0], at[1], 1.0, 0.0);
            let found = 0.5 * Vec2::from_array(SIZE) * found.truncate().truncate() / found.z;
            // Rounding of single precision at 1 m.
            assert!((found - expected.truncate()).length() < 1e-5, "{at:?}");
        }
        assert!(on_panel > 1, "{on_panel}");
    }

    /// Bounds are around where rays to the corners go, and there are none of what is behind the eye.
    #[test]
    fn what_is_seen_has_its_bounds() {
        let at = |place, way: f32| {
            let (from, along) = ray(place);
            from + way * along
        };
        let seen = bounds(&eye(), [at([0.2, 0.7], 0.5), at([0.4, 0.1], 2.0)]).unwrap();
        let expected = [[0.2, 0.1], [0.4, 0.7]];
        let mut pairs = seen.as_flattened().iter().zip(expected.as_flattened());
        let near = pairs.all(|(a, b): (&f32, &f32)| (a - b).abs() < 1e-5);
        assert!(near, "{seen:?}");
        assert_eq!(
            bounds(&eye(), [at([0.2, 0.7], 0.5), at([0.5, 0.5], -1.0)]),
            None
        );
        assert_eq!(bounds(&eye(), []), None);
    }
}
