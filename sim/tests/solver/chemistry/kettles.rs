//! Liquids that boil far more violently than in any scene: mass is conserved, all numbers stay finite, and speeds stay bounded.

use super::bubbles::of;
use super::bubbly_liquid::held;
use super::setup::*;
use super::spray::spraying;
use crate::common::*;
use glam::{DQuat, DVec3};
use vitriol_sim::flask::Profile;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::{Counters, Solver};
use vitriol_tests::gpu;

/// Nuclei `nuclei_spacing` (m) apart and at most `most` bubbles, with spray.
fn boils(
    particles: Vec<vitriol_sim::solver::Particle>,
    profile: Profile,
    nuclei_spacing: f64,
    most: u32,
) -> Setup {
    let law = bubbling(spraying(bubbly()), |it| {
        (it.nuclei_spacing, it.most) = (nuclei_spacing, most);
    });
    Setup::new(of(law, parameters()), vec![profile], particles)
}

/// Runs a third of a second and asserts that all particles are present and finite, and that mass is conserved; gives the solver, and its
/// mass and enthalpy at the start.
fn finite(setup: &Setup, pose: Pose) -> (Solver, [f64; 2]) {
    let device = gpu::device();
    let solver = setup.solver(&device);
    let start = held(&solver);
    frames(&device, &solver, &[pose], 30);
    let state = solver.snapshot().unwrap();
    assert_eq!(solver.counters().unwrap().nan_particles, 0);
    for found in particles(&state) {
        assert!(found.present && found.position.is_finite(), "{found:?}");
        // Its limit acts before lines 27 and 28.
        assert!(
            found.velocity.length() < 2.0 * setup.parameters.max_speed,
            "{found:?}"
        );
    }
    for bubble in state.bubbles().iter().filter(|bubble| bubble.mass > 0.0) {
        let numbers = [bubble.position, bubble.velocity].concat();
        assert!(
            numbers.iter().all(|x| x.is_finite()) && bubble.radius < 0.1,
            "{bubble:?}"
        );
    }
    for drops in state.drops().iter().filter(|drops| drops.mass > 0.0) {
        let numbers = [drops.position, drops.velocity].concat();
        assert!(numbers.iter().all(|x| x.is_finite()), "{drops:?}");
    }
    let end = held(&solver);
    assert!((end[0] / start[0] - 1.0).abs() < 1e-5, "{start:?}, {end:?}");
    (solver, start)
}

/// Runs [`finite`] and asserts that energy too is conserved, to 1e-4 of the heat that warms as much water by 100 K plus the energy at
/// the start; gives the solver and its counters.
fn run(setup: &Setup, pose: Pose) -> (Solver, Counters) {
    let (solver, start) = finite(setup, pose);
    let end = held(&solver);
    let scale = start[0] * 4216.0 * 100.0 + start[1].abs();
    assert!(
        (end[1] - start[1]).abs() < 1e-4 * scale,
        "{start:?}, {end:?}"
    );
    let counters = solver.counters().unwrap();
    (solver, counters)
}

fn cup(count: usize, temperature: f64, acid: f64) -> (Vec<vitriol_sim::solver::Particle>, Profile) {
    let profile = Profile::new(&[[0.0, 0.015], [0.06, 0.015]], 0.002).unwrap();
    let mut particles = water(&profile, 0, Pose::IDENTITY, count);
    fill(&mut particles, |_| (temperature, acid));
    (particles, profile)
}

/// 60 K above the boiling point everywhere, which a tenth of it takes as steam.
fn all_at_once(temperature: f64, acid: f64) {
    let (particles, profile) = cup(1200, temperature, acid);
    let (solver, counters) = run(&boils(particles, profile, 0.003, 4096), Pose::IDENTITY);
    let steam: f64 = solver
        .snapshot()
        .unwrap()
        .bubbles()
        .iter()
        .map(|b| f64::from(b.gone[0]))
        .sum();
    eprintln!("{acid}: {steam} particles' worth of steam, {counters:?}");
    assert!(steam > 10.0, "{steam}");
}

#[test]
fn all_at_once_above_the_boiling_point() {
    all_at_once(185.0, 0.5);
}

/// One particle at 10⁶ °C, which no liquid reaches. Its bubbles hold more enthalpy than a word of quanta: the enthalpy is not conserved,
/// but all stays finite.
#[test]
fn a_million_degrees_in_one_particle() {
    let (mut particles, profile) = cup(600, 99.0, 0.2);
    particles[300].temperature = 1e6;
    finite(&boils(particles, profile, 0.003, 256), Pose::IDENTITY);
}

/// One particle at 2000 °C, where [`a_million_degrees_in_one_particle`] has 10⁶ °C: the enthalpy is conserved too.
#[test]
fn two_thousand_degrees_in_one_particle() {
    let (mut particles, profile) = cup(600, 99.0, 0.2);
    particles[300].temperature = 2000.0;
    let setup = boils(particles, profile, 0.003, 256);
    run(&setup, Pose::IDENTITY);
}

/// A bottle whose neck, 10 mm long, is as wide as a particle.
#[test]
fn a_sealed_neck() {
    let profile = Profile::new(
        &[
            [0.0, 0.015],
            [0.03, 0.015],
            [0.035, 0.00125],
            [0.045, 0.00125],
        ],
        0.002,
    )
    .unwrap();
    let mut particles = water(&profile, 0, Pose::IDENTITY, 1100);
    fill(&mut particles, |_| (110.0, 0.0));
    let (solver, _) = run(&boils(particles, profile, 0.003, 1024), Pose::IDENTITY);
    let state = solver.snapshot().unwrap();
    assert!(
        state
            .bubbles()
            .iter()
            .any(|bubble| bubble.mass > 0.0 || bubble.gone[0] > 0.0)
    );
}

/// It falls out and boils as it falls.
#[test]
fn a_cup_that_boils_upside_down() {
    let (particles, profile) = cup(1200, 115.0, 0.0);
    let turned = DQuat::from_rotation_x(std::f64::consts::PI);
    let pose = Pose {
        position: (DVec3::Y * 0.3).as_vec3(),
        orientation: turned.as_quat(),
    };
    let mut setup = boils(particles, profile, 0.003, 1024);
    setup
        .particles
        .iter_mut()
        .for_each(|p| p.position = turned * p.position + DVec3::Y * 0.3);
    setup.ground.floor = 0.0;
    let (solver, _) = run(&setup, pose);
    let state = solver.snapshot().unwrap();
    assert!(
        (0..state.tags.len())
            .filter(|&slot| state.flask_of(slot).is_none())
            .count()
            > 100
    );
}

/// A nucleus at each particle, and fewer places, or more than the 65,536 that a key has bits for. Those without one are counted: with more
/// places than nuclei those that draw the same by lot, n²/2 of so many pairs, once at least in the 43 ms that a nucleus waits.
fn more_bubbles_than(most: u32, places: usize, count: usize) {
    let (particles, profile) = cup(count, 108.0, 0.0);
    let setup = boils(particles, profile, 1e-4, most);
    let (solver, counters) = run(&setup, Pose::IDENTITY);
    let state = solver.snapshot().unwrap();
    assert_eq!(state.bubbles().len(), places);
    let used = state
        .bubbles()
        .iter()
        .filter(|b| b.mass > 0.0 || b.gone[0] > 0.0)
        .count();
    eprintln!("{used} of {places} used, {counters:?}");
    let met = (count * count / (2 * places)).min(1000);
    assert!(counters.bubbles_refused as usize > met, "{counters:?}");
    assert!(used > places.min(1000) / 2, "{used}");
}

#[test]
fn more_bubbles_than_there_are_places() {
    more_bubbles_than(64, 64, 1200);
}

/// Acid of 300 °C under water of 300 °C, with all that the built-in scenes have: water boils away but for a few per cent, and so many
/// bubbles draw on a particle at once that they would take more than it has.
#[test]
fn acid_and_water_200_kelvin_too_hot() {
    let (mut particles, profile) = cup(400, 300.0, 0.0);
    fill(&mut particles, |at| {
        (300.0, if at.y < 0.0045 { 0.98 } else { 0.0 })
    });
    let setup = Setup::new(of(with_bubbles(), parameters()), vec![profile], particles);
    let device = gpu::device();
    let solver = setup.solver(&device);
    let start = ledger(&solver);
    frames(&device, &solver, &[Pose::IDENTITY], 45);
    let end = ledger(&solver);
    let mass = (end.mass + end.steam) / start.mass - 1.0;
    let acid = end.acid / start.acid - 1.0;
    eprintln!("mass {mass}, acid {acid}, enthalpy {}", end.closure(&start));
    // Drops and bubbles asked one for more than all that it had.
    assert_eq!(solver.counters().unwrap().nan_particles, 0);
    assert!(end.steam > 0.1 * start.mass, "{end:?}");
    assert!(mass.abs() < 1e-5 && acid.abs() < 1e-5, "{mass}, {acid}");
    assert!(end.closure(&start).abs() < 1e-4, "{end:?}");
}

mod long {
    use super::*;

    #[test]
    fn water_all_at_once_above_the_boiling_point() {
        all_at_once(160.0, 0.0);
    }

    #[test]
    fn more_bubbles_than_there_may_be_places() {
        more_bubbles_than(1_000_000, 65_536, 2000);
    }
}
