//! The flask constraint in f32 on the device against that in f64, for random
//! profiles and motions: line 16 to line 25 of one substep, of particles so few
//! that none touches another.

use crate::common::*;
use glam::{DVec3, Quat};
use vitriol_sim::flask::Profile;
use vitriol_sim::parameters::{Parameters, Relaxation};
use vitriol_sim::pose::Pose;
use vitriol_sim::reference::Reference;
use vitriol_sim::reference::placement::Placement;
use vitriol_sim::reference::surroundings::{Surroundings, Vessel};
use vitriol_tests::gpu;

/// Profiles; each is a compilation of all passes.
const SHAPES: u64 = 10;
/// Particles that begin in a flask, and around it.
const COUNT: usize = 60;
/// Rounding of places within 2 m of the origin, three transforms one after the
/// other, metres.
const ROUNDING: f64 = 2e-6;
/// How far the device's distances, samples of a table, are from the outline's at
/// its corners, metres: a quarter of the table's step.
const TABLE: f64 = 3e-4;

fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.number()
}

/// From tubes to bowls, with necks and bulges.
fn shape(random: &mut Random) -> Profile {
    let steps = 1 + (between(random, 0.0, 5.0) as usize).min(4);
    let round = between(random, 0.0, 1.0) < 0.3;
    let floor = if round {
        0.0
    } else {
        between(random, 0.008, 0.05)
    };
    let mut points = vec![[0.0, floor]];
    for _ in 0..steps {
        let height = points[points.len() - 1][0] + between(random, 0.01, 0.05);
        points.push([height, between(random, 0.008, 0.05)]);
    }
    Profile::new(&points, between(random, 0.001, 0.004)).unwrap()
}

/// A motion of micrometres to 20 cm and up to a radian, from anywhere near.
fn motion(random: &mut Random) -> [Pose; 2] {
    let far = 10f64.powf(between(random, -5.0, -0.7));
    let turn = 10f64.powf(between(random, -4.0, 0.0)) as f32;
    let axis = random.point(1.0).normalize().as_vec3();
    let tilt = random.point(1.0).as_vec3();
    let before = Pose::new(
        random.point(1.0).as_vec3(),
        Quat::from_scaled_axis(tilt * 3.0).normalize(),
    );
    let after = Pose::new(
        before.position + (random.point(1.0).normalize() * far).as_vec3(),
        (Quat::from_axis_angle(axis, turn) * before.orientation).normalize(),
    );
    [before, after]
}

/// Places in the flask's frame, some inside and some around.
fn places(random: &mut Random, profile: &Profile) -> Vec<(DVec3, bool)> {
    let size = profile.outer_radius().max(profile.rim_height());
    let middle = DVec3::Y * 0.5 * profile.rim_height();
    let mut found: Vec<(DVec3, bool)> = Vec::new();
    let mut tries = 0;
    while found.len() < 2 * COUNT && tries < 200_000 {
        tries += 1;
        let local = middle + random.point(1.0) * 3.0 * size;
        let r = local.x.hypot(local.z);
        let inside = profile.is_inside(r, local.y);
        let clear = profile.signed_distance_glass(r, local.y) > 2e-4;
        let own = found.iter().filter(|(_, other)| *other == inside).count();
        let apart = found
            .iter()
            .all(|(other, _)| other.distance(local) > 1.2 * D);
        if clear && own < COUNT && apart {
            found.push((local, inside));
        }
    }
    found
}

#[test]
fn random_flasks_and_motions_keep_what_the_reference_keeps() {
    let device = gpu::device();
    let p = Parameters {
        gravity: [0.0; 3],
        viscosity: 0.0,
        max_speed: 1e4,
        iterations: 1,
        // Particles that flasks put together stay so: nothing but the constraint moves a particle.
        relaxation: Relaxation::Jacobi { omega: 1e-9 },
        ..single_substeps()
    };
    let (mut compared, mut moved, mut changed) = (0, 0, 0);
    for seed in 0..SHAPES {
        let mut random = Random(100 + seed);
        let profile = shape(&mut random);
        let [before, after] = motion(&mut random);
        let (start, end) = (Placement::from(before), Placement::from(after));
        let places = places(&mut random, &profile);
        let particles: Vec<_> = places
            .iter()
            .map(|&(local, inside)| vitriol_sim::solver::Particle {
                flask: inside.then_some(0),
                ..drop_at(start.to_stage(local), DVec3::ZERO)
            })
            .collect();
        let setup = Setup::new(p.clone(), vec![profile.clone()], particles.clone());
        let solver = setup.solver(&device);
        frame(&device, &solver, &[before], &[after]);
        let found = crate::common::particles(&solver.snapshot().unwrap());

        let vessel = Vessel::with_maps(profile.clone(), p.support_radius);
        let around = Surroundings::new(vec![vessel], None, Some(-1000.0), p.support_radius);
        let positions = particles.iter().map(|particle| particle.position).collect();
        let mut reference = Reference::new(p.clone(), around, positions, &[before]);
        reference.step(&[before], &[after]);

        for (i, own) in found.iter().enumerate() {
            let local = end.to_flask(own.position);
            let r = local.x.hypot(local.z);
            let who = format!("{i} of shape {seed} at {local}, from {}", places[i].0);
            // Wherever the two put it, it is on its side of the glass.
            let depth = profile.signed_distance_inner(r, local.y.min(profile.rim_height() - 1e-9));
            if own.flask.is_some() {
                assert!(depth > -ROUNDING, "{who}: {depth} m in");
            } else {
                let out = !profile.is_inside(r, local.y) || depth < ROUNDING;
                assert!(out, "{who}: {depth} m in, and nobody's");
                assert!(profile.signed_distance_glass(r, local.y) > -TABLE, "{who}");
            }
            let whole = reference.membership[i];
            let truth = end.to_flask(reference.positions[i]);
            // At the rim rounding decides which side it passes.
            let rim = |at: DVec3| (at.y - profile.rim_height()).abs() < 2.0 * TABLE;
            if own.flask != whole {
                assert!(
                    rim(local) || rim(truth),
                    "{who}: {:?}, not {whole:?}",
                    own.flask
                );
                continue;
            }
            compared += 1;
            let off = own.position.distance(reference.positions[i]);
            let pushed = truth.distance(end.to_flask(start.to_stage(places[i].0))) > 1e-5;
            moved += usize::from(pushed);
            changed += usize::from(whole.is_some() != places[i].1);
            if whole.is_some() && places[i].1 {
                // Both look the radius up in one table.
                assert!(off < ROUNDING, "{who}: {off} m from the reference");
            }
        }
    }
    // Or it was about nothing.
    assert!(
        compared > 800 && moved > 100 && changed > 5,
        "{compared}, {moved}, {changed}"
    );
}
