//! Motions that no wall survives unless the flask constraint holds.

use super::*;
use crate::flask::Region;
use glam::{Quat, Vec3};

/// Substeps a second; each is a frame here, so that every one is looked at.
const RATE: f64 = 1080.0;

/// A glass of 400 particles, 60 drops around it, driven along `pose_at`
/// (seconds) for `substeps`; every substep each particle's region is
/// determined anew from its position alone. Between two substeps a particle
/// may go between inside and above and between above and outside, never
/// between inside and outside.
fn drive(substeps: u32, pose_at: impl Fn(f64) -> Pose) -> Reference {
    let p = Parameters {
        frame_time: 1.0 / RATE,
        substeps: 1,
        ..parameters()
    };
    let mut water = glass_of_water(p.clone(), 400, pose_at(0.0));
    let mut positions = water.positions.clone();
    let mut random = Random(3);
    for _ in 0..60 {
        let around = random.point(0.08) + DVec3::new(0.0, 0.03, 0.0);
        let local = DVec3::new(around.x.signum() * 0.016, 0.0, 0.0) + around;
        if local.x.hypot(local.z) > 0.0155 {
            positions.push(water.placements()[0].to_stage(local));
        }
    }
    water = Reference::new(p, water.surroundings, positions, &[pose_at(0.0)]);
    assert!(water.membership.iter().filter(|m| m.is_none()).count() > 20);
    let profile = narrow_glass();
    let regions = |water: &Reference| -> Vec<Region> {
        let placement = water.placements()[0];
        let positions = water.positions.iter();
        positions
            .map(|&x| Region::of(&profile, placement.to_flask(x)))
            .collect()
    };
    let mut before = regions(&water);
    for substep in 0..substeps {
        let time = |n: u32| f64::from(n) / RATE;
        water.step(&[pose_at(time(substep))], &[pose_at(time(substep + 1))]);
        let now = regions(&water);
        assert_eq!((now.len(), water.removed), (before.len(), 0));
        for (i, pair) in before.iter().zip(&now).enumerate() {
            let through = [
                (Region::Inside, Region::Outside),
                (Region::Outside, Region::Inside),
            ];
            assert!(
                !through.contains(&(*pair.0, *pair.1)),
                "{i} at {substep}: {pair:?}"
            );
            assert_eq!(water.membership[i].is_some(), *pair.1 == Region::Inside);
        }
        before = now;
    }
    assert!(water.velocities.iter().all(|v| v.length() < 8.0 + 0.1));
    water
}

#[test]
fn shaken_at_50_metres_a_second() {
    // 20 cm to and fro.
    let water = drive(160, |t| {
        let phase = (t * 50.0 / 0.2).rem_euclid(2.0);
        let x = 0.2 * (1.0 - (phase - 1.0).abs());
        Pose::from_position(Vec3::new(x as f32, 0.0, 0.0))
    });
    assert!(water.masses().in_flasks[0] > 0.0);
}

#[test]
fn teleported() {
    drive(60, |t| {
        let jumped = if t > 0.02 { 10.0 } else { 0.0 };
        Pose::from_position(Vec3::new(jumped, 0.3 * jumped, 0.0))
    });
}

#[test]
fn spun_at_100_radians_a_second() {
    let water = drive(200, |t| {
        Pose::new(Vec3::ZERO, Quat::from_rotation_y((100.0 * t) as f32))
    });
    assert!(water.masses().in_flasks[0] > 300.0 * water.parameters.particle_mass());
    drive(100, |t| {
        Pose::new(Vec3::ZERO, Quat::from_rotation_x((100.0 * t) as f32))
    });
}

#[test]
fn turned_over() {
    let water = drive(540, |t| {
        let angle = (t / 0.25).min(1.0) * std::f64::consts::PI;
        Pose::new(Vec3::ZERO, Quat::from_rotation_z(angle as f32))
    });
    // It runs out, by the mouth.
    let left = water.masses().in_flasks[0] / water.parameters.particle_mass();
    assert!(left < 200.0, "{left}");
}

#[test]
fn all_in_one_point() {
    let mut water = glass_of_water(parameters(), 200, Pose::IDENTITY);
    water.positions = vec![DVec3::new(0.001, 0.02, -0.002); 200];
    for _ in 0..20 {
        water.step(&[Pose::IDENTITY], &[Pose::IDENTITY]);
    }
    assert_eq!((water.positions.len(), water.removed), (200, 0));
    let closest = (0..200)
        .flat_map(|i| (0..i).map(move |j| (i, j)))
        .map(|(i, j)| water.positions[i].distance(water.positions[j]))
        .fold(1.0, f64::min);
    assert!(closest > 1e-3 * H, "{closest}");
}

#[test]
fn non_finite_particles_are_taken_out_and_counted() {
    let mut water = glass_of_water(parameters(), 100, Pose::IDENTITY);
    let mut clean = water.clone();
    for (i, bad) in [(7, f64::NAN), (50, f64::INFINITY), (99, 1e200)] {
        water.velocities[i].y = bad;
        clean.positions[i].y += 100.0;
        clean.membership[i] = None;
    }
    for _ in 0..2 {
        water.step(&[Pose::IDENTITY], &[Pose::IDENTITY]);
        clean.step(&[Pose::IDENTITY], &[Pose::IDENTITY]);
    }
    assert_eq!((water.removed, water.positions.len()), (3, 97));
    assert!([7, 50, 99].iter().all(|id| !water.ids.contains(id)));
    // The others are where they would have been without them.
    for (x, id) in water.positions.iter().zip(&water.ids) {
        assert_eq!(*x, clean.positions[*id as usize]);
    }
}
