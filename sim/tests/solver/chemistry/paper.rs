//! The paper's chemistry by the f64 reference.

use super::setup::*;
use crate::common::*;
use crate::leaning_glass::*;
use vitriol_sim::chemistry::paper::Boiling;
use vitriol_sim::chemistry::{Chemistry, PaperBoiling, thomsen};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::reference::chemistry as reference;
use vitriol_tests::gpu;

/// Largest differences after a frame of `parameters`.
#[derive(Debug)]
struct Errors {
    /// K, of the liquid that touches no glass and of all.
    inner: f64,
    temperature: f64,
    acid: f64,
    velocity: f64,
    /// Largest change of T (K), c and v (m/s) in the frame.
    changed: [f64; 3],
}

fn errors(parameters: Parameters, lanes: u32) -> Errors {
    let device = gpu::device();
    let mut setup = Setup {
        lanes: Some(lanes),
        ..leaning_scene(parameters)
    };
    // None near T_B, where the last bit decides whether a particle boils.
    for particle in &mut setup.particles {
        let hot = particle.temperature > 85.0;
        particle.temperature = if hot { 150.0 } else { 20.0 };
    }
    let poses = [glass_pose()];
    let solver = setup.solver(&device);
    frame(&device, &solver, &poses, &poses);
    let mut truth = leaning_reference(&setup, &poses);
    truth.step(&poses, &poses);
    no_limiter_acted(&solver);
    let state = solver.snapshot().unwrap();
    let (found, heat) = (particles(&state), by_identity(&state, &state.heat));
    let Some(reference::ReferenceChemistry::Paper(paper)) = &truth.chemistry else {
        panic!("has the paper's chemistry")
    };
    let inside = |i: usize| {
        let local = glass_pose()
            .inverse()
            .transform_point(setup.particles[i].position.as_vec3());
        i < 800 && local.x.hypot(local.z) < 0.007 && local.y > 0.006
    };
    let all = 0..found.len();
    assert!(all.clone().filter(|&i| inside(i)).count() > 100);
    let difference = |i: usize| (heat[i][0] - paper.temperatures[i]).abs();
    let start = |i: usize| &setup.particles[i];
    Errors {
        inner: worst(all.clone(), |i| if inside(i) { difference(i) } else { 0.0 }).0,
        temperature: worst(all.clone(), difference).0,
        acid: worst(all.clone(), |i| (heat[i][1] - paper.acid[i]).abs()).0,
        velocity: velocity_error(&found, &truth).0,
        changed: [
            worst(all.clone(), |i| (heat[i][0] - start(i).temperature).abs()).0,
            worst(all.clone(), |i| (heat[i][1] - start(i).acid).abs()).0,
            worst(all, |i| found[i].velocity.distance(start(i).velocity)).0,
        ],
    }
}

/// Dilution and both kinds of boiling after a substep and after a frame.
#[test]
fn against_the_reference() {
    for law in [Boiling::Power, Boiling::Literal] {
        // At k_v = 1 the default's impulses would be at their bound.
        let boiling = PaperBoiling {
            intensity: if law == Boiling::Power { 0.2 } else { 1.0 },
            ..anti_viscosity(law)
        };
        let chemistry = paper(Some(dilution()), Some(boiling));
        for lanes in lanes(&gpu::device()) {
            let one = errors(with(chemistry.clone(), single_substeps()), lanes);
            // T near 150 has its last bit at 1.5e-5 K, and gets some twenty
            // terms of a kelvin.
            assert!(one.inner < 1e-4, "{law:?} {lanes} {one:?}");
            // The volume of the wall is that of before the last displacement,
            // some 10 µm of which are 1 % of what the wall takes.
            assert!(one.temperature < 0.1, "{law:?} {lanes} {one:?}");
            // A float below one.
            assert!(one.acid < 5e-7, "{law:?} {lanes} {one:?}");
            assert!(one.velocity < PLACE / SUBSTEP, "{law:?} {lanes} {one:?}");
            let [heated, diluted, pushed] = one.changed;
            assert!(heated > 2.0 && diluted > 3e-3 && pushed > 0.02, "{one:?}");
            let frame = errors(with(chemistry.clone(), parameters()), lanes);
            // Twelve substeps. Errors of velocity grow as in
            // `against_reference`, more where it boils, and by the last bits
            // of who is at T_B; a percent of all that changes.
            assert!(frame.inner < 0.1, "{law:?} {lanes} {frame:?}");
            assert!(frame.temperature < 0.3, "{law:?} {lanes} {frame:?}");
            assert!(frame.acid < 5e-4, "{law:?} {lanes} {frame:?}");
            let grown = 120.0 * PLACE / SUBSTEP;
            assert!(frame.velocity < grown, "{law:?} {lanes} {frame:?}");
        }
    }
}

/// Without a wall in reach, the liquid warms by the heat of solution alone.
#[test]
fn pair_heats_sum_to_the_change_of_enthalpy() {
    let device = gpu::device();
    let p = Parameters {
        gravity: [0.0; 3],
        ..with(paper(Some(dilution()), None), parameters())
    };
    let mut particles = loose(9, D / 1.2, &mut Random(3), 0.05);
    fill(&mut particles, |at| {
        (20.0, if at.y > 4.5 * D { 0.98 } else { 0.0 })
    });
    let setup = Setup::new(p.clone(), Vec::new(), particles);
    for lanes in lanes(&device) {
        let solver = Setup {
            lanes: Some(lanes),
            ..setup.clone()
        }
        .solver(&device);
        let before = solver.snapshot().unwrap();
        frames(&device, &solver, &[], 20);
        let after = solver.snapshot().unwrap();
        let Some(Chemistry::Paper(law)) = &p.chemistry else {
            panic!("has the paper's chemistry")
        };
        let per_joule = law.dilution.unwrap().heat_generation / thomsen::JOULES_PER_CALORIE;
        let heat = |rows: &[[f32; 4]]| sum(rows, |row| thomsen::heat(row[1]) * p.particle_mass());
        let released = heat(&after.heat) - heat(&before.heat);
        let warming = sum(&after.heat, |row| row[0]) - sum(&before.heat, |row| row[0]);
        let error = warming / (released * per_joule) - 1.0;
        // 1e-4 is asked for; there are 240 substeps of additions in f32.
        assert!(error.abs() < 1e-4, "{lanes}: {warming} {released} {error}");
        assert!(warming > 729.0, "{warming}");
    }
}
