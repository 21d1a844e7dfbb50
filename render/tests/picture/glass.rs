//! Traced glass against a cylinder in f64.

use crate::panel::image;
use crate::rig::{Rig, cylinder, ray};
use glam::{Affine3A, DVec3, Quat, Vec3};
use vitriol_render::{Fov, FrameDesc, Label, Panel, SceneDesc, VesselDesc, View};

const EXTENT: [u32; 2] = [320, 240];
const RADIUS: f64 = 0.022;
const HEIGHT: f64 = 0.05;
/// Pixels from an outline within which smoothing moves it: half the way that it looks along one.
const SMOOTHED: i32 = 4;

/// A cylinder of glass of 2 mm, so broad and high (m).
pub fn beaker(radius: f64, height: f64) -> VesselDesc {
    cylinder([radius - 0.002, radius], 0.002, height)
}

/// Whether a ray meets the cylinder that the beaker fits in, eye outside: through its mouth it meets a wall or the
/// floor from within, so it meets glass if and only if it meets that.
fn meets(origin: DVec3, along: DVec3) -> bool {
    let (mut enters, mut leaves) = (0.0_f64, f64::INFINITY);
    // Between the planes of foot and rim.
    let (a, b) = (-origin.y / along.y, (HEIGHT - origin.y) / along.y);
    (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
    let squared = along.x * along.x + along.z * along.z;
    let half = origin.x * along.x + origin.z * along.z;
    let beyond = origin.x * origin.x + origin.z * origin.z - RADIUS * RADIUS;
    let root = half * half - squared * beyond;
    if root < 0.0 {
        return false;
    }
    (enters, leaves) = (
        enters.max((-half - root.sqrt()) / squared),
        leaves.min((-half + root.sqrt()) / squared),
    );
    enters < leaves
}

/// There is glass wherever a ray meets the beaker, upright, tipped over and upside down, from aside, from above and through an asymmetric
/// frustum; and nowhere else.
#[test]
fn glass_is_where_its_cylinder_is() {
    let mut rig = Rig::new(EXTENT, 1);
    rig.set_vessels(vec![beaker(RADIUS, HEIGHT)]);
    let image = image(&rig);
    let foot = Vec3::new(0.1, 0.75, -0.4);
    let middle = foot + Vec3::Y * 0.02;
    let fov = Fov::symmetric(0.5, 4.0 / 3.0);
    let beside = Fov {
        left: -0.2,
        right: 0.5,
        up: 0.3,
        down: -0.15,
    };
    let turns = [
        Quat::IDENTITY,
        Quat::from_rotation_z(1.9),
        Quat::from_rotation_x(3.1),
    ];
    for (from, fov) in [
        (Vec3::new(0.05, 0.03, 0.2), fov),
        (Vec3::new(0.02, 0.22, 0.05), fov),
        (Vec3::new(-0.12, 0.09, 0.1), beside),
    ] {
        let view = View::look_at(middle + from, middle, fov);
        // The scene keeps one vessel: it stands behind the eye.
        let away = [Affine3A::from_translation(middle + 10.0 * from)];
        // Glass is clear, and its reflection may be as bright as the background. Over a panel that is seen through, alpha shows it.
        let behind = Affine3A::from_translation(-Vec3::Z);
        let panel = Some(Panel {
            image: &image,
            stage_from_panel: view.stage_from_eye * behind,
            size: [4.0; 2],
        });
        let nothing = rig.draw(&FrameDesc {
            vessels: &away,
            panel,
            ..FrameDesc::empty(&[view])
        });
        for turn in turns {
            let stage_from_vessel = Affine3A::from_rotation_translation(turn, foot);
            let picture = rig.draw(&FrameDesc {
                vessels: &[stage_from_vessel],
                panel,
                ..FrameDesc::empty(&[view])
            });
            let vessel_from_stage = stage_from_vessel.inverse();
            let eye = vessel_from_stage.transform_point3a(view.stage_from_eye.translation);
            let turned = vessel_from_stage.matrix3.as_dmat3();
            let inside = |x: i32, y: i32| {
                let along = turned * ray(&view, EXTENT, x as u32, y as u32);
                meets(eye.as_dvec3(), along)
            };
            let (mut glass, mut open) = (0, 0);
            for y in SMOOTHED..EXTENT[1] as i32 - SMOOTHED {
                for x in SMOOTHED..EXTENT[0] as i32 - SMOOTHED {
                    let expected = inside(x, y);
                    let ends = [-SMOOTHED, 0, SMOOTHED];
                    let around = ends.iter().flat_map(|dy| ends.map(|dx| (dx, *dy)));
                    if around
                        .clone()
                        .any(|(dx, dy)| inside(x + dx, y + dy) != expected)
                    {
                        continue;
                    }
                    let index = 4 * (y * EXTENT[0] as i32 + x) as usize;
                    let differs =
                        picture.colour[0][index..index + 4] != nothing.colour[0][index..index + 4];
                    assert_eq!(
                        differs, expected,
                        "({x}, {y}) from {from}, turned by {turn}"
                    );
                    (glass, open) = (glass + u32::from(expected), open + u32::from(!expected));
                }
            }
            assert!(
                glass > 1500 && open > 1500,
                "{glass} of glass, {open} beside it"
            );
        }
    }
}

/// The picture of two vessels with marks and a label, with the shaders changed by `edit`, which sets each pixel's rays to the glass.
fn with_rays(edit: impl Fn(String) -> String) -> Vec<u8> {
    let mut rig = Rig::edited(EXTENT, |name, text| match name {
        "common/picture/glass_light.wgsl" => edit(text),
        _ => text,
    });
    let mut beaker = beaker(0.033, 0.09);
    beaker.marks = vec![0.02, 0.03, 0.04, 0.05];
    beaker.volumes = vec![25, 50, 75, 100];
    beaker.label = Some(Label {
        lines: vec!["H₂O".to_owned()],
        bottom: 0.06,
        letters: 0.005,
        angles: [-0.7, 0.3],
    });
    rig.set_scene(&SceneDesc::laboratory(
        vec![beaker.clone(), beaker],
        0.75,
        1.0,
    ));
    let views = [View::look_at(
        Vec3::new(0.1, 1.0, -0.02),
        Vec3::new(0.05, 0.79, -0.4),
        Fov::symmetric(0.45, 4.0 / 3.0),
    )];
    let vessels = [
        Affine3A::from_translation(Vec3::new(0.0, 0.75, -0.42)),
        Affine3A::from_rotation_translation(
            Quat::from_rotation_z(1.0),
            Vec3::new(0.11, 0.80, -0.4),
        ),
    ];
    let picture = rig.draw(&FrameDesc {
        vessels: &vessels,
        ..FrameDesc::empty(&views)
    });
    picture.colour[0].clone()
}

/// A GPU traces four rays where a pixel has an edge of glass or print and one elsewhere: the rays that it saves are not missed.
#[test]
fn edges_are_as_smooth_as_by_four_rays_everywhere() {
    // The software driver traces one, so its shader is changed to trace more.
    let four = |text: String| {
        let text = text.replace("GLASS_RAYS == 1u || !ray.edge", "!ray.edge");
        text.replace("n < GLASS_RAYS", "n < 4u")
            .replace("f32(GLASS_RAYS)", "4.0")
    };
    let chosen = with_rays(four);
    let everywhere = with_rays(|text| four(text).replace("(!ray.edge)", "(false)"));
    let one = with_rays(|text| four(text).replace("(!ray.edge)", "(true)"));
    let apart = |picture: &[u8]| {
        let pixels = picture.chunks(4).zip(everywhere.chunks(4));
        let apart = pixels.map(|(a, b)| {
            a.iter()
                .zip(b)
                .map(|(a, b)| a.abs_diff(*b))
                .max()
                .unwrap_or(0)
        });
        apart.filter(|&apart| apart > 5).count()
    };
    // One pixel in twenty may be one where a mirrored edge of the room goes through the glass.
    let (missed, rough) = (apart(&chosen), apart(&one));
    assert!(rough > 150 && missed * 20 < rough, "{missed} of {rough}");
}
