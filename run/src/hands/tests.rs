#![allow(clippy::unwrap_used)]
//! Hands at glass of known shape, and from joints of known places.

use std::f32::consts::FRAC_PI_2;

use glam::{EulerRot, Quat, Vec2, Vec3};
use vitriol_render::{Bone, Finish, MOST_BONES};
use vitriol_sim::flask::glassware::find;
use vitriol_xr::{Pose, Side};

use super::bones::{FINGERS, THUMB};
use super::*;

/// Outer radius and height of a beaker of 250 mL, m (ISO 3819, low form).
const BEAKER: [f32; 2] = [0.035, 0.095];

fn beaker() -> Glass {
    Glass::of(&find("beaker-250").unwrap().profile(1.0).unwrap(), 1.0)
}

/// Signed distance from a solid cylinder that stands on the origin.
fn from_beaker(at: Vec3) -> f32 {
    let [radius, height] = BEAKER;
    let over = Vec2::new(
        at.x.hypot(at.z) - radius,
        (at.y - 0.5 * height).abs() - 0.5 * height,
    );
    over.max(Vec2::ZERO).length() + over.max_element().min(0.0)
}

/// Least distance of a bone's surface from the beaker.
fn clearance(bone: &Bone) -> f32 {
    let places = (0..=100).map(|n| {
        let share = n as f32 / 100.0;
        let radius = bone.radii[0] + share * (bone.radii[1] - bone.radii[0]);
        from_beaker(bone.ends[0].lerp(bone.ends[1], share)) - radius
    });
    places.fold(f32::INFINITY, f32::min)
}

/// The grip of a hand at the side of an upright flask that faces the user (`xr/tracks`), `height` above its foot and `before`
/// its wall, turned by `turn` about the way to its axis.
fn at_side(side: Side, height: f32, before: f32, turn: f32) -> Pose {
    let yaw = match side {
        Side::Left => FRAC_PI_2,
        Side::Right => -FRAC_PI_2,
    };
    let upright = Quat::from_euler(EulerRot::YXZ, yaw, FRAC_PI_2, 0.0);
    Pose::new(
        Vec3::new(0.0, height, BEAKER[0] + before),
        Quat::from_rotation_z(turn) * upright,
    )
}

/// Bones of the hand by finger, the thumb first: those beyond the knuckle.
fn by_finger(bones: &[Bone]) -> [&[Bone]; 5] {
    [
        &bones[0..3],
        &bones[4..7],
        &bones[8..11],
        &bones[12..15],
        &bones[16..19],
    ]
    .map(|bones| {
        assert!(bones.iter().all(|bone| bone.finish == Finish::Glove));
        bones
    })
}

#[test]
fn fingers_close_on_a_beaker_and_do_not_go_into_it() {
    let glass = beaker();
    for side in Side::BOTH {
        for (height, before, turn) in [
            (0.055, 0.0, 0.0),
            (0.05, 0.04, 0.0),
            (0.05, -0.01, 0.0),
            (0.05, -0.034, 0.0),
            (0.045, 0.01, 0.3),
            (0.05, 0.0, -0.4),
        ] {
            let grip = at_side(side, height, before, turn);
            let grasp = closed_on(&grip, side, &glass, &Pose::IDENTITY);
            let bones = bones_of(&grasp.joints(&grip, side));
            let case = format!("{} {height} {before} {turn}", side.name());
            let deepest = bones.iter().map(clearance).fold(f32::INFINITY, f32::min);
            assert!(deepest > -0.001, "{case}: {deepest}");
            let touching = by_finger(&bones).map(|finger| {
                let nearest = finger.iter().map(clearance).fold(f32::INFINITY, f32::min);
                nearest < 0.003
            });
            let fingers = touching[1..].iter().filter(|touches| **touches).count();
            assert!(touching[0] && fingers >= 2, "{case}: {touching:?}");
            // Around it: the palm is before the beaker, fingertips are behind its axis.
            let tips = by_finger(&bones).map(|finger| finger[2].ends[1].z);
            assert!(tips[1] < 0.0 && tips[2] < 0.0, "{case}: {tips:?}");
        }
    }
}

/// A left hand is a right one in a mirror.
#[test]
fn hands_are_mirror_images() {
    let glass = beaker();
    let joints = |side: Side| {
        let grip = at_side(side, 0.055, 0.02, 0.0);
        let grasp = closed_on(&grip, side, &glass, &Pose::IDENTITY);
        grasp.joints(&grip, side)
    };
    let [left, right] = Side::BOTH.map(joints);
    for ((left, _), (right, _)) in left.into_iter().zip(right) {
        let mirrored = left * Vec3::new(-1.0, 1.0, 1.0);
        assert!((mirrored - right).length() < 1e-4, "{left} {right}");
    }
    // The thumb is above, and fingers and thumb go round opposite ways.
    let at = |joint: usize| right[joint].0;
    assert!(at(THUMB + 3).y > at(FINGERS[1] + 1).y && at(FINGERS[0]).y > at(FINGERS[3]).y);
    assert!(at(FINGERS[1] + 2).x > 0.02 && at(THUMB + 1).x < -0.02);
}

/// What is not within reach is not grasped: the hand stays, and is a fist.
#[test]
fn nothing_is_grasped_that_is_not_there() {
    let grip = at_side(Side::Right, 0.05, 0.3, 0.0);
    let grasp = closed_on(&grip, Side::Right, &beaker(), &Pose::IDENTITY);
    assert_eq!(grasp.shift, 0.0);
    assert!(grasp.posture.fingers.iter().all(|bends| bends[1] > 1.7));
}

#[test]
fn an_open_hand_is_as_long_and_broad_as_a_hand() {
    let joints = Grasp::empty(0.0).joints(&Pose::IDENTITY, Side::Right);
    let straight = |first: usize, last: usize| {
        let pairs = (first..last).map(|n| joints[n].0.distance(joints[n + 1].0));
        pairs.sum::<f32>()
    };
    let tip = FINGERS[1] + 4;
    let long =
        straight(FINGERS[1], tip) + joints[tip].1 + joints[1].0.distance(joints[FINGERS[1]].0);
    assert!((long - 0.188).abs() < 0.006, "{long}");
    let [index, .., little] = FINGERS.map(|first| joints[first + 1]);
    let broad = index.0.distance(little.0) + index.1 + little.1;
    assert!((broad - 0.084).abs() < 0.004, "{broad}");
    // Fingers along −Y, the thumb towards −Z, the palm faces −X.
    let at = |joint: usize| joints[joint].0;
    assert!(at(tip).y < -0.10 && at(THUMB + 3).z < at(FINGERS[0] + 4).z);
    assert!(at(tip).x < at(FINGERS[1] + 1).x);
    let fist = Grasp::empty(1.0).joints(&Pose::IDENTITY, Side::Right);
    assert!(fist[tip].0.y > -0.05 && fist[tip].0.x < -0.005);
}

/// A synthetic hand: joint n at (n, 0, 0) mm.
#[test]
fn bones_join_the_joints_that_openxr_names() {
    let mut joints: Joints = std::array::from_fn(|n| (Vec3::X * (0.001 * n as f32), 0.008));
    joints[9].1 = 0.0;
    joints[10].1 = f32::INFINITY;
    let bones = bones_of(&joints);
    assert!(bones.len() <= MOST_BONES, "{}", bones.len());
    let numbers = |bone: &Bone| bone.ends.map(|end| (end.x * 1000.0).round() as usize);
    let chains: Vec<_> = bones
        .iter()
        .filter(|bone| bone.finish == Finish::Glove)
        .map(numbers)
        .collect();
    let mut expected = vec![[2, 3], [3, 4], [4, 5]];
    for first in [6, 11, 16, 21] {
        expected.extend((first..first + 4).map(|n| [n, n + 1]));
    }
    // Over the knuckles.
    expected.push([7, 22]);
    for pair in &expected {
        assert!(chains.contains(pair), "{pair:?}");
    }
    // Palm alone is no bone's end, and the wrist is the cuff's.
    assert!(chains.iter().flatten().all(|&joint| joint > 1));
    let cuffs: Vec<_> = bones
        .iter()
        .filter(|bone| bone.finish == Finish::Cuff)
        .collect();
    assert_eq!(cuffs.len(), 2);
    assert!(
        cuffs
            .iter()
            .all(|bone| (bone.ends[0].x - 0.001).abs() < 0.01)
    );
    // Radii that a runtime does not know, or that are none, are those of a finger.
    let radii = bones.iter().flat_map(|bone| bone.radii);
    assert!(
        radii
            .into_iter()
            .all(|radius| (0.003..0.026).contains(&radius))
    );
}
