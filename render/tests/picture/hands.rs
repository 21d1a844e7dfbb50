//! Gloves against a march through the same surface in f64, written another way.

use crate::rig::{Picture, Reference, Rig, ray, right_of, turned_eye};
use glam::{DVec3, EulerRot, Quat, Vec3};
use vitriol_render::camera::NEAR;
use vitriol_render::{
    Bone, Finish, Fov, FrameDesc, JOINED, MOST_BONES, ParticleSource, RenderError, View,
};

const EXTENT: [u32; 2] = [320, 240];

/// How far from the surface the shader's march may end, pixels (`CLOSE` in `render/hands/light.wgsl`), and the flattest angle between ray
/// and surface that is compared.
const CLOSE: f64 = 0.01;
const FLATTEST: f64 = 0.2;

/// A hand of a palm, three fingers and a cuff, where the eye sees it: `place` is in its own frame.
fn hand(view: &View, place: Vec3, turn: f32) -> Vec<Bone> {
    let turn = Quat::from_euler(EulerRot::ZXY, turn, 0.5, 0.3);
    let bone = |a: [f32; 3], b: [f32; 3], radii: [f32; 2], cuff: bool| {
        Bone::new(
            if cuff { Finish::Cuff } else { Finish::Glove },
            [a, b].map(|end| {
                let end = place + turn * (0.001 * Vec3::from(end));
                view.stage_from_eye.transform_point3(end)
            }),
            radii.map(|radius| 0.001 * radius),
        )
    };
    let mut bones = vec![
        bone([-14.0, 0.0, 0.0], [-20.0, 70.0, 0.0], [14.0, 12.0], false),
        bone([0.0, 0.0, 0.0], [0.0, 75.0, 0.0], [14.0, 12.0], false),
        bone([14.0, 0.0, 0.0], [20.0, 70.0, 0.0], [14.0, 12.0], false),
        bone([0.0, -10.0, 0.0], [0.0, -60.0, 5.0], [22.0, 26.0], true),
        // A bone of one ball, and one of two balls of which one holds the other.
        bone(
            [-30.0, 20.0, 20.0],
            [-30.0, 20.0, 20.0],
            [16.0, 16.0],
            false,
        ),
        bone([30.0, 20.0, 15.0], [32.0, 20.0, 15.0], [9.0, 16.0], false),
    ];
    for (x, y) in [(-20.0, 70.0), (0.0, 75.0), (20.0, 70.0)] {
        let (knuckle, tip) = ([x, y + 42.0, 12.0], [x, y + 50.0, 44.0]);
        bones.push(bone([x, y, 0.0], knuckle, [11.0, 9.0], false));
        bones.push(bone(knuckle, tip, [9.0, 6.5], false));
    }
    bones
}

/// Distance to a bone: the least over the spheres of its axis, by golden section, since it has one least.
fn distance(bone: &Bone, at: DVec3) -> f64 {
    let [a, b] = bone.ends.map(|end| end.as_dvec3());
    let [ra, rb] = bone.radii.map(f64::from);
    let of = |s: f64| at.distance(a.lerp(b, s)) - (ra + s * (rb - ra));
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = (0.0, 1.0);
    let (mut left, mut right) = (1.0 - ratio, ratio);
    let (mut of_left, mut of_right) = (of(left), of(right));
    for _ in 0..45 {
        if of_left < of_right {
            (high, right, of_right) = (right, left, of_left);
            left = high - ratio * (high - low);
            of_left = of(left);
        } else {
            (low, left, of_left) = (left, right, of_right);
            right = low + ratio * (high - low);
            of_right = of(right);
        }
    }
    of(0.5 * (low + high)).min(of(0.0)).min(of(1.0))
}

/// Distance to a hand: of its two nearest bones, joined.
fn hand_distance(bones: &[Bone], at: DVec3) -> f64 {
    // A bone is no nearer than the ball that holds it.
    let ball = |bone: &Bone| {
        let [a, b] = bone.ends.map(|end| end.as_dvec3());
        let radius = 0.5 * a.distance(b) + f64::from(bone.radii[0].max(bone.radii[1]));
        at.distance(0.5 * (a + b)) - radius
    };
    let mut balls: Vec<(f64, &Bone)> = bones.iter().map(|bone| (ball(bone), bone)).collect();
    balls.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut nearest, mut second) = (f64::INFINITY, f64::INFINITY);
    for (least, bone) in balls {
        if least > second {
            break;
        }
        let found = distance(bone, at);
        (nearest, second) = (nearest.min(found), second.min(found.max(nearest)));
    }
    if second == f64::INFINITY {
        return nearest;
    }
    let joined = f64::from(JOINED);
    let near = (joined - (second - nearest)).max(0.0);
    nearest - near * near / (4.0 * joined)
}

/// Depth that an eye sees of the hands.
fn reference(view: &View, extent: [u32; 2], hands: [&[Bone]; 2]) -> Reference {
    let eye = view.stage_from_eye.translation.as_dvec3();
    let mut reference = Reference {
        depth: Vec::new(),
        facing: Vec::new(),
    };
    let all = |at: DVec3| {
        let [left, right] = hands.map(|bones| hand_distance(bones, at));
        left.min(right)
    };
    // A ball about each hand, so that the most of the rays need no march.
    let balls = hands.map(|bones| {
        let ends = || bones.iter().flat_map(|bone| bone.ends);
        let middle = ends().sum::<Vec3>() / ends().count().max(1) as f32;
        let radius = ends().map(|end| end.distance(middle)).fold(0.0, f32::max);
        (middle.as_dvec3() - eye, f64::from(radius) + 0.03)
    });
    for y in 0..extent[1] {
        for x in 0..extent[0] {
            let ray = ray(view, extent, x, y);
            let passes = |(middle, radius): (DVec3, f64)| {
                middle.cross(ray).length() > radius || middle.dot(ray) + radius < 0.0
            };
            let (mut t, mut seen) = (1e-3, (0.0, 0.0));
            for _ in 0..500 {
                if balls.into_iter().all(passes) || t > 2.0 {
                    break;
                }
                let apart = all(eye + t * ray);
                if apart < 1e-8 {
                    let step = 1e-6;
                    let at = eye + t * ray;
                    let slope = |axis: DVec3| all(at + step * axis) - all(at - step * axis);
                    let normal = DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z));
                    let axis = -ray.dot(view.stage_from_eye.matrix3.z_axis.as_dvec3());
                    seen = (f64::from(NEAR) / (t * axis), -normal.normalize().dot(ray));
                    break;
                }
                t += apart;
            }
            reference.depth.push(seen.0);
            reference.facing.push(seen.1);
        }
    }
    // Where one surface ends before another, a ray next to the end may meet either.
    let width = extent[0] as usize;
    for index in 0..reference.depth.len() {
        for next in [index + 1, index + width] {
            let depths = (reference.depth[index], reference.depth.get(next));
            if let (here, Some(&there)) = depths
                && (here / there - 1.0).abs() > 0.05
            {
                reference.facing[index] = 0.0;
            }
        }
    }
    reference
}

fn draw(rig: &Rig, views: &[View], hands: [&[Bone]; 2]) -> Picture {
    rig.draw(&FrameDesc {
        hands,
        ..FrameDesc::empty(views)
    })
}

/// Compares a view; the pixels whose depth was compared.
fn compared(view: &View, extent: [u32; 2], hands: [&[Bone]; 2], depth: &[f32]) -> usize {
    let across = f64::from(view.fov.right.tan() - view.fov.left.tan());
    let pixel = across / f64::from(extent[0]);
    // And f32, as for spheres.
    let tolerance = CLOSE * pixel / FLATTEST + 1e-5;
    reference(view, extent, hands).compare(depth, extent, tolerance)
}

#[test]
fn gloves_lie_where_the_surface_is() {
    let rig = Rig::new(EXTENT, 1);
    let view = turned_eye();
    // In the middle, over an edge, cut by a corner, close up, far away, and of both hands through each other.
    for (left, right, least) in [
        (Some([0.0, 0.0, -0.4]), None, 700),
        (None, Some([-0.55, 0.0, -0.4]), 200),
        (None, Some([0.30, 0.33, -0.4]), 400),
        (Some([0.0, -0.05, -0.14]), None, 16_000),
        (Some([0.1, 0.1, -1.5]), None, 5),
        (Some([0.0, -0.1, -0.4]), Some([0.03, -0.1, -0.39]), 1000),
    ] {
        let hand = |place: Option<[f32; 3]>, turn: f32| {
            place.map_or_else(Vec::new, |place| hand(&view, place.into(), turn))
        };
        let (left, right) = (hand(left, 0.6), hand(right, -0.9));
        let picture = draw(&rig, &[view], [&left, &right]);
        let count = compared(&view, EXTENT, [&left, &right], &picture.depth[0]);
        assert!(count >= least, "{count} pixels of {least}");
    }
}

/// Palm, thumb, first finger bones and cuff of an open glove, in a hand's frame (x to the fingers, y out of the palm, z to the thumb, mm),
/// with radii: as `run/src/hands/bones.rs` makes them, so that up to eight are close to one place.
const PALM: [([i8; 3], [i8; 3], [f32; 2]); 18] = [
    ([-34, -10, 22], [-1, 7, 51], [15.0, 12.5]),
    ([-1, 7, 51], [24, 27, 70], [12.5, 10.8]),
    ([24, 27, 70], [36, 41, 79], [10.8, 8.5]),
    ([-36, -16, 14], [34, -12, 30], [14.0, 11.8]),
    ([34, -12, 30], [79, -3, 33], [11.8, 9.6]),
    ([-38, -17, 4], [37, -14, 8], [14.3, 12.0]),
    ([37, -14, 8], [85, -1, 9], [12.0, 9.8]),
    ([-37, -16, -6], [30, -13, -12], [13.4, 11.3]),
    ([30, -13, -12], [73, 1, -14], [11.3, 9.2]),
    ([-34, -15, -15], [20, -12, -30], [12.0, 10.1]),
    ([20, -12, -30], [56, 1, -35], [10.1, 8.3]),
    ([-37, -16, 9], [36, -13, 19], [14.1, 11.9]),
    ([-38, -16, -1], [34, -13, -2], [13.9, 11.7]),
    ([-36, -16, -10], [25, -13, -21], [12.7, 10.7]),
    ([-22, -4, 32], [-7, -15, 21], [8.5, 8.5]),
    ([34, -12, 30], [20, -12, -30], [10.0, 10.0]),
    ([-47, -16, -5], [-102, -18, -9], [22.0, 25.0]),
    ([-49, -16, 9], [-103, -18, 5], [22.0, 25.0]),
];

/// A palm half a metre away, a pixel of which is 0.8 mm: flat, from its edge, and along the wrist, so that rays pass closely by several
/// bones and end in the creases between others.
#[test]
fn no_ray_goes_through_a_palm() {
    const EXTENT: [u32; 2] = [128, 128];
    /// Rounding of a depth in f32: some ten roundings of half of 2⁻²³ in the ray, the way and the ratio.
    const ROUNDED: f64 = 1e-6;
    let rig = Rig::new(EXTENT, 1);
    let view = View {
        fov: Fov::symmetric(0.2, 1.0),
        ..turned_eye()
    };
    for (y, x) in [(0.2, 0.3), (1.4, 0.4), (-0.5, 1.3), (2.3, -0.6)] {
        let turn = Quat::from_euler(EulerRot::YXZ, y, x, 0.0);
        let bone = |(a, b, radii): ([i8; 3], [i8; 3], [f32; 2])| {
            Bone::new(
                Finish::Glove,
                [a, b].map(|end| {
                    let end = 0.001 * Vec3::from(end.map(f32::from));
                    let place = Vec3::new(0.0, 0.0, -0.5) + turn * end;
                    view.stage_from_eye.transform_point3(place)
                }),
                radii.map(|radius| 0.001 * radius),
            )
        };
        let bones = PALM.map(bone);
        let depth = &draw(&rig, &[view], [&bones, &[]]).depth[0];
        let seen = reference(&view, EXTENT, [&bones, &[]]);
        let pixel = 2.0 * f64::from(0.1_f32.tan()) / f64::from(EXTENT[0]);
        let count = seen.compare(depth, EXTENT, CLOSE * pixel / FLATTEST + ROUNDED);
        assert!(count > 4_000, "{count} pixels");
        // The march goes no further than there is room, at edges too.
        for (index, (&wanted, &got)) in seen.depth.iter().zip(depth).enumerate() {
            assert!(
                f64::from(got) >= wanted * (1.0 - ROUNDED),
                "pixel {index}: depth {got}, expected {wanted}"
            );
        }
    }
}

/// Two eyes, 64 mm apart, with mirrored frusta.
#[test]
fn each_eye_sees_its_own_gloves() {
    let rig = Rig::new(EXTENT, 2);
    let left = turned_eye();
    let right = right_of(&left);
    let bones = hand(&left, Vec3::new(0.0, 0.0, -0.5), 0.4);
    let picture = draw(&rig, &[left, right], [&[], &bones]);
    for (view, depth) in [left, right].iter().zip(&picture.depth) {
        assert!(compared(view, EXTENT, [&[], &bones], depth) > 300);
    }
    assert!(picture.depth[0] != picture.depth[1]);
}

/// In a picture smaller than the images, whose tiles lie elsewhere.
#[test]
fn gloves_in_a_smaller_picture() {
    const SMALL: [u32; 2] = [201, 150];
    let rig = Rig::new(EXTENT, 1);
    let view = turned_eye();
    let bones = hand(&view, Vec3::new(0.05, -0.05, -0.4), 0.4);
    draw(&rig, &[view], [&bones, &[]]);
    let picture = rig.draw(&FrameDesc {
        extent: Some(SMALL),
        hands: [&bones, &[]],
        ..FrameDesc::empty(&[view])
    });
    let rows = picture.depth[0].chunks(EXTENT[0] as usize);
    let depth: Vec<f32> = rows
        .take(SMALL[1] as usize)
        .flat_map(|row| &row[..SMALL[0] as usize])
        .copied()
        .collect();
    assert!(compared(&view, SMALL, [&bones, &[]], &depth) > 120);
}

#[test]
fn where_there_is_no_hand_there_is_nothing() {
    let rig = Rig::new(EXTENT, 1);
    let view = turned_eye();
    let near = hand(&view, Vec3::new(0.0, 0.0, -0.3), 0.0);
    draw(&rig, &[view], [&near, &near]);
    // Hands of the frame before are not seen.
    let empty = rig.draw(&FrameDesc::empty(&[view]));
    assert!(empty.depth[0].iter().all(|depth| *depth == 0.0));
    let behind = hand(&view, Vec3::new(0.0, 0.0, 0.4), 0.0);
    let nowhere = [f32::NAN, f32::INFINITY, 1e30]
        .map(|x| Bone::new(Finish::Glove, [Vec3::splat(x), Vec3::Y], [0.01; 2]));
    let picture = draw(&rig, &[view], [&behind, &nowhere]);
    assert!(picture.depth == empty.depth && picture.colour == empty.colour);
    // A hand about the eye is not seen from within.
    let about = Bone::new(
        Finish::Glove,
        [Vec3::from(view.stage_from_eye.translation); 2],
        [0.05; 2],
    );
    let picture = draw(&rig, &[view], [&[], &[about]]);
    assert!(picture.depth == empty.depth && picture.colour == empty.colour);
}

#[test]
fn the_order_of_bones_changes_no_bit() {
    let rig = Rig::new(EXTENT, 1);
    let view = turned_eye();
    let mut bones = hand(&view, Vec3::new(0.0, 0.0, -0.3), 0.3);
    let first = draw(&rig, &[view], [&bones, &[]]);
    for turn in 1..4 {
        bones.rotate_left(turn);
        bones.swap(0, turn + 2);
        let picture = draw(&rig, &[view], [&bones, &[]]);
        assert!(picture.depth == first.depth && picture.colour == first.colour);
    }
}

/// One of two balls is charred: its blue is gone (CHARRED reflects four times as much red as blue, the glove a third), its shape
/// is not, and the other, which it does not touch, has the same bits.
#[test]
fn acid_blackens_the_bone_that_it_came_to() {
    let rig = Rig::new(EXTENT, 1);
    let view = turned_eye();
    let mut balls = hand(&view, Vec3::new(0.0, 0.0, -0.3), 0.0);
    balls.truncate(2);
    for (ball, x) in balls.iter_mut().zip([-0.04, 0.04]) {
        let at = view
            .stage_from_eye
            .transform_point3(Vec3::new(x, 0.0, -0.3));
        (ball.ends, ball.radii) = ([at; 2], [0.02; 2]);
    }
    let clean = draw(&rig, &[view], [&balls, &[]]);
    balls[0].stain = 1.0;
    let charred = draw(&rig, &[view], [&balls, &[]]);
    assert!(clean.depth == charred.depth);
    // The first eye's left half has the charred one; the middle of the picture is between them.
    let [width, height] = EXTENT.map(|side| side as usize);
    let [left, right] = [0.94_f64, 0.70].map(f64::tan);
    let middle = (left / (left + right) * width as f64) as usize;
    let mut counts = [0, 0];
    let mut sums = [[0; 3]; 2];
    for index in 0..width * height {
        if clean.depth[0][index] == 0.0 {
            continue;
        }
        let pixel = |picture: &Picture| -> [u8; 3] {
            std::array::from_fn(|n| picture.colour[0][4 * index + n])
        };
        let (before, after) = (pixel(&clean), pixel(&charred));
        let is_charred = index % width < middle;
        counts[usize::from(is_charred)] += 1;
        if is_charred {
            for (sum, pixel) in sums.iter_mut().zip([before, after]) {
                sum.iter_mut()
                    .zip(pixel)
                    .for_each(|(sum, channel)| *sum += u32::from(channel));
            }
        } else {
            assert_eq!(before, after);
        }
    }
    assert!(counts.into_iter().all(|count| count > 150), "{counts:?}");
    // Highlights stay: light that is reflected at the surface has the lamp's colour.
    let [[red, _, blue], [charred_red, _, charred_blue]] = sums;
    assert!(blue > red && charred_red > charred_blue, "{sums:?}");
    assert!(2 * charred_blue < blue, "{sums:?}");
}

/// Hands among coloured spheres: each pixel shows the nearer one.
#[test]
fn gloves_and_spheres_hide_each_other() {
    let rig = Rig::new(EXTENT, 1);
    let view = turned_eye();
    let bones = hand(&view, Vec3::new(0.0, 0.0, -0.4), 0.0);
    let at = |x: f32, y: f32, z: f32| {
        let place = view.stage_from_eye.transform_point3(Vec3::new(x, y, z));
        place.extend(1.0).to_array()
    };
    let places = [
        at(0.0, 0.03, -0.35),
        at(0.02, 0.08, -0.45),
        at(-0.2, 0.1, -0.4),
    ];
    let (positions, attributes) = (
        rig.buffer("positions", &places),
        rig.buffer("attributes", &[[0.0; 4]; 3]),
    );
    let both = rig.draw(&FrameDesc {
        hands: [&bones, &[]],
        particles: Some(ParticleSource {
            positions: &positions,
            attributes: &attributes,
            count: 3,
            radius: 0.03,
        }),
        ..FrameDesc::empty(&[view])
    });
    let alone = [
        draw(&rig, &[view], [&bones, &[]]),
        rig.draw_spheres(&[view], &places, 0.03),
    ];
    let mut seen = [0; 2];
    for (index, &depth) in both.depth[0].iter().enumerate() {
        let [hand, ball] = [0, 1].map(|n: usize| alone[n].depth[0][index]);
        assert_eq!(depth, hand.max(ball), "pixel {index}");
        seen[0] += u32::from(hand > ball);
        seen[1] += u32::from(ball > hand);
    }
    assert!(seen.into_iter().all(|count| count > 300), "{seen:?}");
}

#[test]
fn more_bones_than_there_is_room_for_are_refused() {
    let rig = Rig::new(EXTENT, 1);
    let views = [turned_eye()];
    let bone = hand(&views[0], Vec3::NEG_Z, 0.0)[0];
    let bones = [bone; MOST_BONES + 1];
    let frame = FrameDesc {
        hands: [&[], &bones],
        ..FrameDesc::empty(&views)
    };
    let error = rig.refusal(&frame);
    assert!(matches!(error, RenderError::TooManyBones { .. }), "{error}");
}
