//! The volume of bubbles pushes liquid: where they are, and before they grow.

use super::bubbles::{beaker, of, quick};
use super::setup::*;
use crate::common::*;
use glam::DVec3;
use std::f64::consts::PI;
use vitriol_gpu::Gpu;
use vitriol_shaders::layout::Bubble;
use vitriol_sim::chemistry::Physical;
use vitriol_sim::flask::Profile;
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::{Solver, SolverState};
use vitriol_tests::gpu;

/// Bubbles that last as long as a test.
fn lasting() -> Physical {
    bubbling(bubbly(), |it| it.foam_time = Some(100.0))
}

/// `count` particles of water of 20 °C at rest in a vessel of that radius (m).
pub fn vessel(device: &Gpu, radius: f64, count: usize) -> Solver {
    let depth = count as f64 * parameters().particle_volume() / (PI * radius * radius);
    let height = f64::max(0.16, 1.4 * depth);
    let profile = Profile::new(&[[0.0, radius], [height, radius]], 0.002).unwrap();
    let mut particles = water(&profile, 0, Pose::IDENTITY, count);
    fill(&mut particles, |_| (20.0, 0.0));
    let solver = Setup::new(of(lasting(), quick()), vec![profile], particles).solver(device);
    steps(device, &[&solver], 240);
    solver
}

pub fn steps(device: &Gpu, solvers: &[&Solver], count: usize) {
    for solver in solvers {
        frames(device, solver, &[Pose::IDENTITY], count);
    }
}

pub fn volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3)
}

pub fn live(state: &SolverState) -> impl Iterator<Item = &Bubble> {
    state
        .bubbles()
        .iter()
        .filter(|b| b.mass > 0.0 || b.air > 0.0)
}

fn at(row: [f32; 4]) -> DVec3 {
    DVec3::new(row[0].into(), row[1].into(), row[2].into())
}

/// Air in a bubble of that radius (m) at 20 °C, as the solver counts it.
pub fn air(p: &Parameters, radius: f64) -> f32 {
    (volume(radius) * 101_325.0 / (461.5 * 293.15) / p.particle_mass()) as f32
}

/// Holds a bubble of air of that radius (m) at rest at `centre`, in place 0.
pub fn hold(solver: &Solver, centre: DVec3, radius: f64) {
    let mut state = solver.snapshot().unwrap();
    let p = solver.parameters();
    if state.bubbles()[0].air == 0.0 {
        state.put_bubble(p, 0, 1, [centre, DVec3::ZERO], [1e-4, 20.0]);
    }
    let record = &mut state.bubbles_mut()[0];
    (record.air, record.air_temperature) = (air(p, radius), 20.0);
    (record.mass, record.enthalpy) = (0.0, 0.0);
    record.position = centre.as_vec3().to_array();
    record.position_before = record.position;
    (record.velocity, record.flow) = ([0.0; 3], [0.0; 3]);
    solver.restore(&state).unwrap();
}

/// Liquid within spheres around `centre` whose radii are 4 to 9 mm more than `radius` (m), m³: the mean, with edges that are 4 mm wide,
/// so that layers of particles do not count.
fn liquid_around(state: &SolverState, p: &Parameters, centre: DVec3, radius: f64) -> f64 {
    let within = |slot: usize, reach: f64| {
        let gap = (reach - (at(state.positions[slot]) - centre).length()) / 4e-3;
        state.mass_of(slot) * (0.5 + gap).clamp(0.0, 1.0)
    };
    let reaches = (4..10).map(|mm| radius + 1e-3 * f64::from(mm));
    let sums = reaches.map(|reach| {
        (0..state.tags.len())
            .map(|slot| within(slot, reach))
            .sum::<f64>()
    });
    sums.sum::<f64>() / 6.0 * p.particle_volume()
}

/// Volume that a bubble of each radius (m) displaces over its own, once it has grown for 0.1 s and been held for 0.03 s, against the
/// state in which each begins.
fn displaced(radii: &[f64], across: f64, count: usize) -> Vec<f64> {
    let device = gpu::device();
    let solver = vessel(&device, across, count);
    let still = solver.snapshot().unwrap();
    let p = solver.parameters().clone();
    let centre = DVec3::Y * 0.5 * count as f64 * p.particle_volume() / (PI * across * across);
    let of = |&radius: &f64| {
        solver.restore(&still).unwrap();
        for k in 1..=72 {
            hold(&solver, centre, radius * (f64::from(k) / 72.0).cbrt());
            steps(&device, &[&solver], 1);
        }
        let mut sum = 0.0;
        for _ in 0..24 {
            hold(&solver, centre, radius);
            steps(&device, &[&solver], 1);
            let state = solver.snapshot().unwrap();
            sum += liquid_around(&still, &p, centre, radius)
                - liquid_around(&state, &p, centre, radius);
        }
        let found = sum / 24.0 / volume(radius);
        eprintln!("a bubble of {radius} m displaces {found} of its volume");
        found
    };
    radii.iter().map(of).collect()
}

/// From one that particles hold to a cavity 12 d wide. 10 %: particles lie in layers around a cavity, which no lattice has.
#[test]
fn a_bubble_displaces_its_volume() {
    for found in displaced(&[2.5e-3, 5e-3], 0.025, 5000) {
        assert!((found - 1.0).abs() < 0.1, "{found}");
    }
}

/// Air that is blown into the bottom of a tube 26 mm wide lifts the liquid above it at its volume rate over the tube's area. 5 %.
#[test]
fn a_bubble_that_grows_in_a_tube_lifts_the_liquid_above_it() {
    let device = gpu::device();
    let across = 0.013;
    let solver = vessel(&device, across, 2400);
    let p = solver.parameters().clone();
    let centre = DVec3::Y * 0.014;
    let radius =
        |k: u32| (0.004f64.powi(3) + 1.2e-5 * f64::from(k) / 720.0 / (4.0 / 3.0 * PI)).cbrt();
    for k in 1..=36 {
        hold(&solver, centre, radius(0) * (f64::from(k) / 36.0).cbrt());
        steps(&device, &[&solver], 1);
    }
    for _ in 0..72 {
        hold(&solver, centre, radius(0));
        steps(&device, &[&solver], 1);
    }
    // By identity, as those above now are those above later.
    let start = solver.snapshot().unwrap();
    let marked: Vec<u32> = (0..start.tags.len())
        .filter(|&slot| start.positions[slot][1] > 0.035)
        .map(|slot| start.tags[slot][1])
        .collect();
    let mean = |state: &SolverState| {
        let slots = (0..state.tags.len()).filter(|&slot| marked.contains(&state.tags[slot][1]));
        slots
            .map(|slot| f64::from(state.positions[slot][1]))
            .sum::<f64>()
            / marked.len() as f64
    };
    let before = mean(&start);
    for k in 1..=36 {
        hold(&solver, centre, radius(k));
        steps(&device, &[&solver], 1);
    }
    // What was blown in at the last step is displaced in the next.
    hold(&solver, centre, radius(36));
    steps(&device, &[&solver], 2);
    let lifted = mean(&solver.snapshot().unwrap()) - before;
    let expected = (volume(radius(36)) - volume(radius(0))) / (PI * across * across);
    eprintln!(
        "lifted by {lifted} m, {} of the volume over the area; d is {}",
        lifted / expected,
        p.spacing
    );
    assert!(
        (lifted / expected - 1.0).abs() < 0.05,
        "{lifted}, {expected}"
    );
}

/// A bubble that is there at once, as where two join, is given no work. Nothing is faster then than what falls through the whole depth; a
/// fifth more is allowed, as cavities shift particles by discrete steps. Until 2026-11-30 liquid had 1.6 to 2.2 m/s, as it was shifted by up to h in a substep.
#[test]
fn what_appears_throws_no_liquid() {
    let device = gpu::device();
    let across = 0.025;
    let solver = vessel(&device, across, 8000);
    let depth = 8000.0 * solver.parameters().particle_volume() / (PI * across * across);
    let falls = (2.0 * 9.81 * depth).sqrt();
    let still = solver.snapshot().unwrap();
    for radius in [4e-3, 8e-3, 12e-3] {
        solver.restore(&still).unwrap();
        hold(&solver, DVec3::Y * 0.4 * depth, radius);
        let mut fastest = 0.0;
        for _ in 0..3 {
            steps(&device, &[&solver], 1);
            let state = solver.snapshot().unwrap();
            let speeds = state.velocities.iter().map(|&v| at(v).length());
            fastest = speeds.fold(fastest, f64::max);
            assert_eq!(live(&state).count(), 1);
        }
        eprintln!("{radius} m: {fastest} m/s, of {falls} m/s");
        assert!(
            fastest > 0.05 && fastest < 1.2 * falls,
            "{radius}: {fastest}"
        );
    }
}

/// In a tube 26 mm wide a bubble that grows to what a sphere of 18 mm holds becomes some of half the tube's width at most, which hold
/// its air.
#[test]
fn a_bubble_wider_than_half_its_vessel_divides() {
    let device = gpu::device();
    let solver = vessel(&device, 0.013, 2400);
    for k in 1..=36 {
        hold(
            &solver,
            DVec3::Y * 0.02,
            0.006 * (f64::from(k) / 36.0).cbrt(),
        );
        steps(&device, &[&solver], 1);
    }
    let held = |state: &SolverState| -> f64 { live(state).map(|b| f64::from(b.air)).sum() };
    let mut blown = 0.0;
    for _ in 0..40 {
        let mut state = solver.snapshot().unwrap();
        state.bubbles_mut().iter_mut().for_each(|b| b.air *= 1.03);
        blown = held(&state);
        solver.restore(&state).unwrap();
        steps(&device, &[&solver], 1);
    }
    let state = solver.snapshot().unwrap();
    let widest = live(&state).map(|b| b.radius).fold(0.0, f32::max);
    eprintln!("{} bubbles, the widest {widest} m", live(&state).count());
    // One that has grown past the width divides in the step after.
    assert!(live(&state).count() >= 3 && widest < 0.0067, "{widest}");
    assert!((held(&state) / blown - 1.0).abs() < 1e-5);
}

/// Mesa 22.3's software driver ends the loops of an invocation after 65,535 turns together. A cavity of nearly the greatest radius, with
/// liquid on all sides, is looked around three times in a step: by all cells of a cube that took twice as many turns
/// (`docs/measurements/solver.md`).
#[test]
fn a_wide_cavity_has_all_that_is_around_it() {
    let device = gpu::device();
    let radius = 6.5 * H;
    let side = 36;
    let sites = (0..side * side * side).map(|n| {
        let site = [n % side, n / side % side, n / (side * side)];
        DVec3::from_array(site.map(|k: i32| (f64::from(k) + 0.5 * f64::from(1 - side)) * D))
    });
    let around = sites.filter(|site| site.length() > radius);
    let particles = around.map(|site| drop_at(site, DVec3::ZERO)).collect();
    let weightless = Parameters {
        gravity: [0.0; 3],
        ..quick()
    };
    let solver = Setup::new(of(lasting(), weightless), Vec::new(), particles).solver(&device);
    let mut state = solver.snapshot().unwrap();
    let p = solver.parameters().clone();
    let motion = [DVec3::ZERO, DVec3::X * 0.1];
    state.put_bubble(&p, 0, 0, motion, [1e-4, 20.0]);
    let record = &mut state.bubbles_mut()[0];
    (record.air, record.air_temperature) = (air(&p, radius), 20.0);
    (record.mass, record.enthalpy) = (0.0, 0.0);
    solver.restore(&state).unwrap();
    frames(&device, &solver, &[], 1);
    let bubble = solver.snapshot().unwrap().bubbles()[0];
    // It is still what was put there, so that it was looked around.
    assert_eq!(bubble.cavity, 1.0);
    assert!((f64::from(bubble.radius) / radius - 1.0).abs() < 0.01);
    assert_eq!(solver.counters().unwrap().bubbles_cut, 0);
}

/// Liquid that falls freely has no pressure that would lift a bubble: one of 4 mm goes with it and its glass, where at rest it rises at
/// 0.23 m/s. A tenth of that.
#[test]
fn a_bubble_does_not_rise_in_liquid_that_falls() {
    let device = gpu::device();
    let solver = beaker(20.0, lasting()).solver(&device);
    frames(&device, &solver, &[Pose::IDENTITY], 20);
    let mut state = solver.snapshot().unwrap();
    let p = solver.parameters().clone();
    state.put_bubble(&p, 0, 1, [DVec3::Y * 0.02, DVec3::ZERO], [2e-3, 20.0]);
    let record = &mut state.bubbles_mut()[0];
    (record.air, record.air_temperature) = (air(&p, 2e-3), 20.0);
    (record.mass, record.enthalpy) = (0.0, 0.0);
    solver.restore(&state).unwrap();
    let fallen = |frame: u32| {
        let time = f64::from(frame) * p.frame_time;
        Pose::from_position((DVec3::NEG_Y * 0.5 * 9.81 * time * time).as_vec3())
    };
    for k in 0..14 {
        frame(&device, &solver, &[fallen(k)], &[fallen(k + 1)]);
    }
    let bubble = solver.snapshot().unwrap().bubbles()[0];
    let relative = bubble.velocity[1] - bubble.flow[1];
    eprintln!(
        "{relative} m/s past liquid that falls at {} m/s; {} s at a surface",
        bubble.flow[1], bubble.surfaced
    );
    assert_eq!(bubble.surfaced, 0.0);
    assert!(
        bubble.flow[1] < -1.3 && relative.abs() < 0.023,
        "{relative}"
    );
}

mod long {
    use super::*;

    #[test]
    fn a_bubble_of_16_and_30_mm_displaces_its_volume() {
        for found in displaced(&[8e-3, 15e-3], 0.04, 16_000) {
            assert!((found - 1.0).abs() < 0.1, "{found}");
        }
    }
}
