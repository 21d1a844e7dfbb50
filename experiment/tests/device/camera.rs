//! The camera from the track's head.

use crate::common::{BEFORE, SIZE, experiment, frame, liquid};
use glam::{Quat, Vec3};
use vitriol_shaders::Library;
use vitriol_tests::gpu;
use vitriol_xr::Pose;

/// Half of the vertical field of view, 40°.
const HALF_FIELD: f64 = 20.0;

#[test]
fn the_picture_follows_the_head() {
    let device = gpu::device();
    let level = Pose::new(BEFORE, Quat::IDENTITY);
    let mut laboratory = experiment(&device, Some(level), Library::embedded());
    // What is straight ahead is in the middle, before the first step too.
    let (x, y) = liquid(laboratory.picture(0).unwrap());
    assert!(x.abs() < 1.0 && y.abs() < 15.0, "{x} {y}");

    // Pixels from the axis: tangents, half a picture being tan(20°) high.
    let pixels = |tangent: f64| tangent / HALF_FIELD.to_radians().tan() * f64::from(SIZE.1) / 2.0;
    let angle = 10f64.to_radians();
    let turned = |q: Quat| Pose::new(BEFORE, q);
    for (head, moves) in [
        // To the left: the liquid goes to the right. OpenXR's axes: +Y up.
        (
            turned(Quat::from_rotation_y(angle as f32)),
            (pixels(angle.tan()), 0.0),
        ),
        // Up: it goes down.
        (
            turned(Quat::from_rotation_x(angle as f32)),
            (0.0, pixels(angle.tan())),
        ),
        // Aside by 0.1 m of the 0.6 m between.
        (
            Pose::new(BEFORE + 0.1 * Vec3::X, Quat::IDENTITY),
            (-pixels(0.1 / 0.6), 0.0),
        ),
        (level, (0.0, 0.0)),
    ] {
        laboratory.step(&frame(0, head)).unwrap();
        let (new_x, new_y) = liquid(laboratory.picture(0).unwrap());
        // The liquid settles, and its near side is nearer than its middle; what
        // is asked for is 44 pixels.
        let off = (new_x - x - moves.0).hypot(new_y - y - moves.1);
        assert!(
            off < 6.0,
            "{head:?}: ({new_x}, {new_y}) instead of {moves:?}"
        );
    }
}

#[test]
fn a_fixed_camera_stays() {
    let device = gpu::device();
    let mut laboratory = experiment(&device, None, Library::embedded());
    let before = liquid(laboratory.picture(0).unwrap());
    let away = Pose::new(BEFORE, Quat::from_rotation_y(0.5));
    laboratory.step(&frame(0, away)).unwrap();
    let after = liquid(laboratory.picture(0).unwrap());
    // Settling in a small picture; a head turned by 0.5 rad moves it out of
    // the picture.
    let moved = (after.0 - before.0).hypot(after.1 - before.1);
    assert!(moved < 5.0, "{moved}");
}
