//! Measurements of a report on states whose particles were put in place by hand.

use crate::chemistry::setup::{boiling, glass_of, with};
use crate::common::*;
use glam::Vec3;
use vitriol_shaders::Library;
use vitriol_sim::chemistry::Chemistry;
use vitriol_sim::measure::measure_heat;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::SolverState;
use vitriol_sim::world::World;
use vitriol_tests::gpu;

const REMOVED: u32 = u32::MAX;

/// Leaves the first `count` particles of `state` and takes out the others.
fn only(state: &mut SolverState, count: usize) {
    assert!(state.tags.len() > count);
    for tag in &mut state.tags[count..] {
        tag[0] = REMOVED;
    }
}

#[test]
fn each_particle_is_where_it_is() {
    let device = gpu::device();
    let mut scene = Scene::builtin("beaker").unwrap();
    scene.liquids[0].volume = 5e-6;
    let world = World::new(&device, &Library::watching(), &scene, 1).unwrap();
    // The beaker is 33 mm wide within and 35 mm without, 95 mm high, and stands on the
    // table at 0.75 m, whose edge is at x = 0.6.
    let foot = Vec3::new(0.0, 0.75, -0.4);
    let in_glass = |x: f32, y: f32| foot + Vec3::new(x, y, 0.0);
    // (place, membership, lost)
    let cases = [
        (in_glass(0.0, 0.05), 1, false),
        (in_glass(0.0325, 0.01), 1, false),
        // A member that is in the air past the wall, and one under the floor of the glass.
        (in_glass(0.04, 0.05), 1, true),
        (in_glass(0.0, -0.01), 1, true),
        // A member above the rim has not left yet.
        (in_glass(0.04, 0.2), 1, false),
        // Nobody's, in the flask; in the air; on the table; beside it on the floor; under it.
        (in_glass(0.01, 0.05), 0, true),
        (in_glass(0.01, 0.2), 0, false),
        (Vec3::new(0.5, 0.752, -0.4), 0, false),
        (Vec3::new(0.7, 0.005, -0.4), 0, false),
        (Vec3::new(0.7, -0.01, -0.4), 0, true),
    ];
    let mut state = world.snapshot().unwrap().solver;
    only(&mut state, cases.len());
    for (i, (place, membership, _)) in cases.into_iter().enumerate() {
        state.positions[i] = place.extend(0.0).to_array();
        state.velocities[i] = [0.0, 0.0, -2.0, 9.0];
        state.tags[i][0] = membership;
    }
    for velocity in &mut state.velocities[cases.len()..] {
        *velocity = [0.0; 4];
    }
    let measured = world.measure_state(&state).unwrap();
    let lost = cases.iter().filter(|case| case.2).count();
    assert_eq!(measured.lost_particles, lost as u64);
    let mass = world.solver().parameters().particle_mass();
    let near = |own: f64, particles: f64| (own / mass - particles).abs() < 1e-9;
    assert!(near(measured.in_flasks[0], 5.0), "{measured:?}");
    assert!(near(measured.on_table, 1.0), "{measured:?}");
    assert!(near(measured.on_floor, 2.0), "{measured:?}");
    assert!(near(measured.in_air, 2.0), "{measured:?}");
    // ½mv² of ten at 2 m/s.
    assert!(near(measured.kinetic_energy, 20.0), "{measured:?}");
    // Each that is lost is one more.
    for (i, case) in cases.iter().enumerate() {
        let mut without = state.clone();
        without.tags[i][0] = REMOVED;
        let left = world.measure_state(&without).unwrap().lost_particles;
        assert_eq!(left, (lost - usize::from(case.2)) as u64, "{i}");
    }
}

#[test]
fn heat_is_summed_by_mass_and_superheat_by_composition() {
    let device = gpu::device();
    let p = with(Chemistry::Physical(boiling()), parameters());
    let setup = Setup::new(
        p.clone(),
        vec![narrow_glass(); 2],
        glass_of(8, |_| (20.0, 0.0)),
    );
    let mut state = setup.solver(&device).snapshot().unwrap();
    only(&mut state, 4);
    // Boiling points by the table: 100 °C of water, 338 °C at 98 %. Masses are 1, 1, 2, 1.
    let heat = [(101.0, 0.0), (99.0, 0.0), (150.0, 0.98), (110.0, 0.0)];
    let matter = [
        [0.0, 4e5, 0.25, 1.0],
        [0.0, 3e5, 0.0, 1.0],
        [0.98, -2e5, 0.0, 2.0],
        [0.0, 4e5, 0.0, 1.0],
    ];
    for i in 0..4 {
        state.heat[i][..2].copy_from_slice(&[heat[i].0, heat[i].1]);
        state.matter[i] = matter[i];
        state.tags[i][0] = [1, 2, 2, 0][i];
    }
    state.ledger.fill([0.0; 4]);
    // Of those that were taken out, too.
    state.matter[4..].fill([0.0; 4]);
    state.matter[6] = [0.2, -1e5, 0.0, 1.5];
    state.ledger[0] = [-20.0, 0.5, 300.0, 0.0];
    state.ledger[6] = [-10.0, 0.25, 100.0, 0.0];
    let found = measure_heat(&p, &state).unwrap();
    let near = |own: f64, expected: f64| (own - expected).abs() < 1e-6 * expected.abs().max(1.0);
    let mean = (101.0 + 99.0 + 2.0 * 150.0 + 110.0) / 5.0;
    assert!(near(found.temperature_mean, mean), "{found:?}");
    let squares = [101.0, 99.0, 150.0, 150.0, 110.0].map(|t: f64| (t - mean).powi(2));
    let spread = (squares.iter().sum::<f64>() / 5.0).sqrt();
    assert!(near(found.temperature_spread, spread), "{found:?}");
    assert!(near(found.temperature_max, 150.0) && near(found.temperature_p99, 150.0));
    assert!(near(found.acid_mean, 0.98 * 2.0 / 5.0), "{found:?}");
    assert!(near(found.acid_min, 0.0) && near(found.acid_max, 0.98));
    let [first, second] = [[101.0, 101.0], [99.0, 150.0]];
    assert_eq!(found.temperatures_in_flasks, [first, second]);
    let superheat = found.superheat.unwrap();
    assert!(near(superheat.max, 10.0), "{superheat:?}");
    assert_eq!((superheat.particles, superheat.in_flasks), (2, vec![1]));
    let ledger = found.ledger.unwrap();
    let unit = p.particle_mass();
    for (own, expected) in [
        (ledger.mass, 5.0),
        (ledger.acid, 1.96),
        (ledger.vapour, 0.25),
        (ledger.held, 7e5),
        (ledger.turnover, 1.5e6),
        (ledger.exchanged, -30.0),
        (ledger.steam, 0.75),
        (ledger.steam_enthalpy, 400.0),
        (ledger.taken_out, 1.5),
        (ledger.taken_out_enthalpy, -1.5e5),
    ] {
        assert!(
            near(own / unit, expected),
            "{own} for {expected}: {ledger:?}"
        );
    }
    // Enthalpy held, carried off and taken out, less the heat gained.
    assert!(near(ledger.balance() / unit, 7e5 + 400.0 - 1.5e5 + 30.0));
    let mut later = ledger;
    later.held += 0.01 * ledger.turnover;
    assert!(near(later.closure(&ledger), 0.01));
}
