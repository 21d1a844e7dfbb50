//! Shards against the whole vessel.

use crate::glass::beaker;
use crate::rig::{Picture, Rig, ray};
use glam::{Affine3A, DVec3, Quat, Vec3};
use std::f64::consts::TAU;
use vitriol_render::{Fov, FrameDesc, ShardDesc, View};

const EXTENT: [u32; 2] = [240, 240];
const RADIUS: f64 = 0.035;
const HEIGHT: f64 = 0.095;
const BASE: f32 = 0.033;
const PLACE: Vec3 = Vec3::new(0.1, 0.75, -0.4);

fn rig() -> Rig {
    let mut rig = Rig::new(EXTENT, 1);
    rig.set_vessels(vec![beaker(RADIUS, HEIGHT)]);
    rig
}

/// Nowhere, as the pose of a broken vessel is.
fn away() -> Affine3A {
    Affine3A::from_translation(Vec3::new(0.0, -1000.0, 0.0))
}

fn shard(piece: u32, stage_from_vessel: Affine3A) -> ShardDesc {
    ShardDesc {
        vessel: 0,
        piece,
        base: BASE,
        stage_from_vessel,
    }
}

fn drawn(rig: &mut Rig, view: View, vessel: Affine3A, shards: &[ShardDesc]) -> Picture {
    rig.draw(&FrameDesc {
        vessels: &[vessel],
        shards,
        ..FrameDesc::empty(&[view])
    })
}

/// Pixels at which two pictures differ.
fn differs(a: &Picture, b: &Picture) -> Vec<bool> {
    let pixels = a.colour[0].chunks(4).zip(b.colour[0].chunks(4));
    pixels.map(|(a, b)| a != b).collect()
}

/// Pixels of which only one of two pictures has glass, except those within some pixels of an outline, where smoothing moves it.
fn beside(found: &[bool], glass: &[bool]) -> usize {
    const SMOOTHED: i32 = 4;
    let side = EXTENT[0] as i32;
    let is_outline = |n: usize| {
        let (x, y) = (n as i32 % side, n as i32 / side);
        let near =
            (-SMOOTHED..=SMOOTHED).flat_map(|dy| (-SMOOTHED..=SMOOTHED).map(move |dx| (dx, dy)));
        let mut inside =
            near.filter(|(dx, dy)| (0..side).contains(&(x + dx)) && (0..side).contains(&(y + dy)));
        inside.any(|(dx, dy)| glass[((y + dy) * side + x + dx) as usize] != glass[n])
    };
    let pairs = found.iter().zip(glass).enumerate();
    pairs
        .filter(|(n, (found, glass))| found != glass && !is_outline(*n))
        .count()
}

/// Together shards are where the whole was, and nowhere else; without one of them something is missing. Shards of a vessel that does not
/// exist are not drawn, and of too many the first are.
#[test]
fn shards_are_the_whole() {
    let mut rig = rig();
    let pose = Affine3A::from_rotation_translation(Quat::from_rotation_z(0.4), PLACE);
    let eye = PLACE + Vec3::new(0.05, 0.2, 0.25);
    let view = View::look_at(eye, PLACE + Vec3::Y * 0.04, Fov::symmetric(0.5, 1.0));
    let nothing = drawn(&mut rig, view, away(), &[]);
    let whole = drawn(&mut rig, view, pose, &[]);
    let glass = differs(&whole, &nothing);
    assert!(glass.iter().filter(|it| **it).count() > 4000);
    let all: Vec<ShardDesc> = (0..4).map(|piece| shard(piece, pose)).collect();
    let shards = drawn(&mut rig, view, away(), &all);
    assert_eq!(beside(&differs(&shards, &nothing), &glass), 0);
    for missing in 0..4 {
        let mut some = all.clone();
        some.remove(missing);
        let without = drawn(&mut rig, view, away(), &some);
        let left = differs(&without, &nothing);
        let both: Vec<bool> = left.iter().zip(&glass).map(|(a, b)| *a || *b).collect();
        assert_eq!(beside(&both, &glass), 0, "{missing}");
        // Behind a shard of the wall there is another.
        let other = differs(&without, &shards).iter().filter(|it| **it).count();
        assert!(other > 300, "{missing}: {other}");
    }
    let mut others = [shard(0, pose); 20];
    for other in &mut others[..16] {
        other.vessel = 5;
    }
    let shards = drawn(&mut rig, view, away(), &others);
    assert!(!differs(&shards, &nothing).contains(&true));
}

/// Seen down the axis, each shard of the wall is within its third of a turn, but for cracks that stray by up to 0.224 rad, and fills the
/// rest of that; the base is seen from everywhere, and from the side it is low.
#[test]
fn each_has_its_part() {
    let mut rig = rig();
    let pose = Affine3A::from_translation(PLACE);
    let above = PLACE + Vec3::Y * 0.35;
    let down = Affine3A::from_rotation_translation(
        Quat::from_rotation_x(-0.5 * std::f32::consts::PI),
        above,
    );
    let view = View {
        stage_from_eye: down,
        fov: Fov::symmetric(0.3, 1.0),
    };
    let nothing = drawn(&mut rig, view, away(), &[]);
    const STRAYS: f64 = 0.224;
    for wall in 0..3_u32 {
        let picture = drawn(&mut rig, view, away(), &[shard(wall + 1, pose)]);
        let mut filled = [false; 36];
        for (n, seen) in differs(&picture, &nothing).into_iter().enumerate() {
            let (x, y) = (n as u32 % EXTENT[0], n as u32 / EXTENT[0]);
            let along: DVec3 = ray(&view, EXTENT, x, y);
            let angle = along.z.atan2(along.x).rem_euclid(TAU);
            let third = TAU / 3.0;
            let from = (angle - f64::from(wall) * third + STRAYS).rem_euclid(TAU) - STRAYS;
            // A pixel at the wall is 0.03 rad wide.
            let within = (-0.05 - STRAYS..third + STRAYS + 0.05).contains(&from);
            assert!(!seen || within, "{wall}: {angle}");
            if seen && (STRAYS..third - STRAYS).contains(&from) {
                filled[(36.0 * angle / TAU) as usize] = true;
            }
        }
        assert!(
            filled.iter().filter(|it| **it).count() >= 9,
            "{wall}: {filled:?}"
        );
    }
    // From the side, elsewhere: it is as high as its base and 0.15 of the radius.
    let aside = Vec3::new(0.15, 0.0, 0.0);
    let eye = PLACE + aside + Vec3::Z * 0.4 + Vec3::Y * 0.001;
    let view = View::look_at(
        eye,
        PLACE + aside + Vec3::Y * 0.001,
        Fov::symmetric(0.5, 1.0),
    );
    let nothing = drawn(&mut rig, view, away(), &[]);
    let moved = Affine3A::from_translation(PLACE + aside);
    let picture = drawn(&mut rig, view, away(), &[shard(0, moved)]);
    let mut highest = f64::NEG_INFINITY;
    for (n, seen) in differs(&picture, &nothing).into_iter().enumerate() {
        if seen {
            let along: DVec3 = ray(&view, EXTENT, n as u32 % EXTENT[0], n as u32 / EXTENT[0]);
            highest = highest.max(along.y / -along.z);
        }
    }
    // Its front is nearer by a radius.
    let tallest = (f64::from(BASE) + 0.15 * RADIUS) / (0.4 - RADIUS);
    let least = (f64::from(BASE) - 0.15 * RADIUS) / 0.4;
    assert!(
        highest < tallest + 0.005 && highest > least,
        "{least} {highest} {tallest}"
    );
}
