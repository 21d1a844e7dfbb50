//! A scene for both solvers, the GPU's and the f64 reference.
//!
//! 800 jittered particles in a leaning glass, puddles on the table beside it
//! and on the floor, drops that run down its outside. Coordinates are up to
//! 0.1 m, so positions are rounded to 7 nm; a velocity is a difference of two
//! over Δt = 1/1080 s, and rounded to 1e-5 m/s with it.

use crate::common::*;
use glam::{DVec2, DVec3, Quat, Vec3};
use std::ops::Range;
use vitriol_gpu::Gpu;
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::reference::Reference;
use vitriol_sim::reference::surroundings::{Slab, Surroundings, Vessel};
use vitriol_sim::solver::{Ground, Solver};

/// Rounding of a place in the scene after a substep: some ten operations.
pub const PLACE: f64 = 5e-8;

/// What interpolating the half space's table linearly over h/256 makes of a
/// density: V''·(h/256)²/8 with V'' = 3/h² at h/3.
pub const PLANE: f64 = 7.5e-6;

/// The table's edges and underside lie between the colour's nodes, which are 2.5 mm apart: on one, the last bit decides what is solid.
pub const GROUND: Ground = Ground {
    floor: -0.05,
    table: Some((-0.01, DVec2::new(0.0, 0.01), DVec2::new(0.162, 0.102))),
    scale: 1.02,
};

pub fn glass_pose() -> Pose {
    let lean = Quat::from_rotation_z(0.15) * Quat::from_rotation_x(-0.1);
    Pose::new(Vec3::new(0.01, 0.0, 0.02), lean)
}

/// Where it is after a substep on its way, at 0.5 m/s and 2 rad/s.
pub fn moved_glass() -> Pose {
    let start = glass_pose();
    let time = SUBSTEP as f32;
    Pose::new(
        start.position + Vec3::new(0.5, 0.1, 0.0) * time,
        Quat::from_rotation_y(2.0 * time) * start.orientation,
    )
}

pub fn scene(parameters: Parameters) -> Setup {
    let mut random = Random(7);
    let mut particles = water(&narrow_glass(), 0, glass_pose(), 800);
    let block = |count: u32, corner: DVec3| {
        (0..count).map(move |i| {
            let site = DVec3::new((i % 5).into(), (i / 15).into(), (i / 5 % 3).into());
            corner + site * D
        })
    };
    let on_table = block(45, DVec3::new(-0.055, -0.01 + 0.5 * D, -0.02));
    let on_floor = block(30, DVec3::new(-0.1, -0.05 + 0.5 * D, 0.03));
    let down_the_glass = (0..12).map(|i| {
        let angle = f64::from(i) * 0.5;
        let local = DVec3::new(
            0.0165 * angle.cos(),
            0.01 + 0.003 * f64::from(i),
            0.0165 * angle.sin(),
        );
        glass_pose().transform_point(local.as_vec3()).as_dvec3()
    });
    let outside = on_table.chain(on_floor).chain(down_the_glass);
    particles.extend(outside.map(|position| drop_at(position, DVec3::ZERO)));
    for particle in &mut particles {
        particle.position += random.point(0.1 * D);
        // Both solvers start with the same floats.
        particle.position = particle.position.as_vec3().as_dvec3();
        particle.velocity = random.point(0.1).as_vec3().as_dvec3();
        particle.carried = f64::from(-0.2 * random.number() as f32);
    }
    Setup {
        ground: GROUND,
        ..Setup::new(parameters, vec![narrow_glass()], particles)
    }
}

pub fn reference(setup: &Setup, poses: &[Pose]) -> Reference {
    let vessels = setup.flasks.iter().cloned();
    let vessels = (0..).zip(vessels).map(|(k, profile)| match &setup.solids {
        None => Vessel::with_maps(profile, H),
        Some(solids) => Vessel::with_particles(profile, Vec::clone(&solids[k]), H),
    });
    let table = setup.ground.table.map(|(top, centre, size)| Slab {
        top,
        under: setup.ground.table_under(top),
        centre,
        size,
    });
    let surroundings = Surroundings::new(vessels.collect(), table, Some(setup.ground.floor), H);
    let positions = setup.particles.iter().map(|p| p.position).collect();
    let mut reference = Reference::new(setup.parameters.clone(), surroundings, positions, poses);
    reference.velocities = setup.particles.iter().map(|p| p.velocity).collect();
    reference.carried = setup.particles.iter().map(|p| p.carried).collect();
    let member_of: Vec<_> = setup.particles.iter().map(|p| p.flask).collect();
    assert_eq!(reference.membership, member_of);
    reference
}

/// Largest value, and whose.
pub fn worst(among: Range<usize>, of: impl Fn(usize) -> f64) -> (f64, usize) {
    let worst = among.map(|i| (of(i), i));
    worst.fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a })
}

/// Greatest difference of a velocity from the reference's, m/s, and whose.
pub fn velocity_error(found: &[Found], truth: &Reference) -> (f64, usize) {
    worst(0..found.len(), |i| {
        found[i].velocity.distance(truth.velocities[i])
    })
}

pub fn no_limiter_acted(solver: &Solver) {
    let counters = solver.counters().unwrap();
    let limited = (
        counters.list_limited,
        counters.speed_limited,
        counters.list_overflows,
    );
    assert_eq!(limited, (0, 0, 0));
}

/// A frame by both.
pub fn both(gpu: &Gpu, setup: &Setup, after: Pose) -> (Vec<Found>, Reference) {
    let solver = setup.solver(gpu);
    let mut truth = reference(setup, &[glass_pose()]);
    frame(gpu, &solver, &[glass_pose()], &[after]);
    truth.step(&[glass_pose()], &[after]);
    no_limiter_acted(&solver);
    (particles(&solver.snapshot().unwrap()), truth)
}

/// After a frame: greatest error of the report's density at the places where the GPU has its particles, the slot that has it, and the
/// reference's densities.
pub fn density_error(gpu: &Gpu, setup: &Setup) -> (f64, usize, Vec<f64>) {
    let solver = setup.solver(gpu);
    let after = Pose::new(glass_pose().position, Quat::from_rotation_z(0.12));
    frame(gpu, &solver, &[glass_pose()], &[after]);
    let state = solver.snapshot().unwrap();
    let own = densities(gpu, &solver);
    let found = particles(&state);
    let mut truth = reference(setup, &[glass_pose()]);
    // Sets where the glass is at the frame's end.
    truth.step(&[after], &[after]);
    truth.positions = found.iter().map(|p| p.position).collect();
    truth.membership = found.iter().map(|p| p.flask).collect();
    let truth = truth.densities(&truth.positions, &truth.neighbours(&truth.positions));
    let (error, slot) = worst(0..own.len(), |slot| {
        (own[slot] - truth[state.tags[slot][1] as usize]).abs()
    });
    (error, slot, truth)
}
