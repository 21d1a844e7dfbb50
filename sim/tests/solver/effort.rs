//! Substeps and iterations that change while it runs.

use crate::common::{AWAY, coarse_beaker, densities, tracked_hand};
use glam::{Quat, Vec3};
use std::f64::consts::TAU;
use vitriol_gpu::Gpu;
use vitriol_shaders::Library;
use vitriol_sim::bodies::Hand;
use vitriol_sim::flask::Profile;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_sim::world::{StepInput, World, WorldError};
use vitriol_tests::gpu;

/// Half of the beaker's water: 880 particles.
fn world(gpu: &Gpu, effort: [u32; 2]) -> World {
    let scene = coarse_beaker(110e-6).with_effort(effort).without_sleep();
    World::new(gpu, &Library::watching(), &scene, 1).unwrap()
}

/// Greatest kinetic energy (J) of the states after every third of so many steps, and the mean
/// density error of the last of them.
fn rest(world: &mut World, steps: u32) -> (f64, f64) {
    let (mut energy, mut error) = (0.0_f64, 0.0);
    for step in 0..steps {
        world.step(&AWAY).unwrap();
        if step % 3 == 2 {
            let measured = world.measure().unwrap();
            assert_eq!((measured.lost_particles, measured.nan_particles), (0, 0));
            energy = energy.max(measured.kinetic_energy);
            error = measured.density_error_mean;
        }
    }
    (energy, error)
}

/// A change is nothing but a change: a world made with the other substeps and iterations that
/// takes up the state goes on with the same bits, its beaker in hand.
#[test]
fn it_is_as_if_it_had_been_made_so() {
    let gpu = gpu::device();
    let mut changed = world(&gpu, [5, 3]);
    let stood = changed.poses()[0].position;
    let hand = |step: u32| {
        let lifted = Vec3::Y * (0.004 * step as f32);
        let at = Pose::from_position(stood + Vec3::new(0.05, 0.05, 0.0) + lifted);
        let held = tracked_hand(at, if step > 0 { 1.0 } else { 0.0 });
        StepInput::of_hands([held, Hand::ABSENT])
    };
    for step in 0..12 {
        changed.step(&hand(step)).unwrap();
    }
    // One that changes the iterations alone, and one that was before.
    for effort in [[8, 6], [8, 3], [8, 6], [4, 2]] {
        let state = changed.snapshot().unwrap();
        let mut made = world(&gpu, effort);
        made.restore(&state).unwrap();
        changed.set_effort(effort).unwrap();
        assert_eq!(changed.effort(), effort);
        for step in 12..18 {
            changed.step(&hand(step)).unwrap();
            made.step(&hand(step)).unwrap();
        }
        let [changed, made] = [&changed, &made].map(|world| world.snapshot().unwrap());
        assert!(changed == made, "{effort:?}");
    }
    assert!(changed.poses()[0].position.y > stood.y + 0.02);
    assert_eq!(changed.scene().solver.substeps, 4);
}

#[test]
fn what_no_liquid_stands_up_under_is_refused() {
    let gpu = gpu::device();
    let mut world = world(&gpu, [5, 3]);
    for effort in [[1, 3], [5, 0], [2000, 3]] {
        let refused = world.set_effort(effort);
        assert!(
            matches!(refused, Err(WorldError::Effort { .. })),
            "{effort:?}: {refused:?}"
        );
        assert_eq!(world.effort(), [5, 3]);
    }
}

/// A flask whose neck is a particle wide, at `balanced`, shaken as a hand can: to and fro at up to 2.7 m/s, turned at up to 900°/s.
/// The greatest 99th percentile of the density error in it at any step's end, and the most substeps of a step.
fn shaken(gpu: &Gpu, wall_step: Option<f64>) -> (f64, u32) {
    let mut scene = Scene::builtin("beaker")
        .unwrap()
        .with_preset(Preset::Balanced);
    let d = scene.scale.spacing;
    let points = [[0.0, 8.0], [12.0, 8.0], [16.0, 0.55], [24.0, 0.55]];
    scene.flasks[0].profile = Profile::new(&points.map(|p| p.map(|x| x * d)), 0.8 * d).unwrap();
    scene.liquids.truncate(1);
    scene.liquids[0].volume = 1200.0 * d.powi(3);
    scene.solver.wall_step = wall_step;
    let mut world = World::new(gpu, &Library::watching(), &scene, 1).unwrap();
    let grip = scene.flasks[0]
        .stage_from_flask
        .transform_point(Vec3::Y * (12.0 * d) as f32);
    let hand = |time: f64| {
        let lift = 0.3 * (time / 0.5).min(1.0);
        let time = (time - 0.5).max(0.0);
        let ramp = (time / 0.3).min(1.0);
        let (ramp, pace) = (ramp * ramp * (3.0 - 2.0 * ramp), TAU * 3.0);
        let aside = ramp * 2.7 / pace * (pace * time).sin();
        let up = lift + ramp * 0.8 / pace * (1.3 * pace * time).sin();
        let turn = ramp * f64::to_radians(900.0) / pace * (pace * time).sin();
        let at = grip + Vec3::new(aside as f32, up as f32, 0.0);
        tracked_hand(Pose::new(at, Quat::from_rotation_z(turn as f32)), 1.0)
    };
    let (mut most, mut substeps, mut furthest) = (0.0_f64, 0, 0.0_f32);
    for step in 1..=120 {
        let hands = [hand(f64::from(step) / 90.0), Hand::ABSENT];
        world.step(&StepInput::of_hands(hands)).unwrap();
        let state = world.snapshot().unwrap().solver;
        let all = densities(gpu, world.solver());
        let inside = (0..all.len()).filter(|&slot| state.flask_of(slot).is_some());
        let errors = inside.map(|slot| (all[slot] - 1.0).max(0.0));
        let mut errors: Vec<_> = errors.collect();
        errors.sort_by(f64::total_cmp);
        most = most.max(errors[errors.len() * 99 / 100]);
        substeps = substeps.max(world.solver().parameters().substeps);
        furthest = furthest.max(world.poses()[0].position.y);
    }
    assert!(furthest > 0.3, "the hand does not hold it: {furthest}");
    (most, substeps)
}

/// 10 % of a density; with no more substeps than the scene has it is three times as much and more.
#[test]
fn a_flask_that_is_shaken_has_more_substeps() {
    let gpu = gpu::device();
    let (without, substeps) = shaken(&gpu, None);
    assert!(without > 0.2 && substeps == 10, "{without} {substeps}");
    let (with, substeps) = shaken(&gpu, Some(0.4));
    eprintln!("{without} without, {with} with {substeps} substeps");
    assert!(with < 0.1 && substeps > 20, "{with} {substeps}");
}

mod long {
    use super::*;

    /// A column at rest does not jump. What is carried on is a pressure: if it were the multiplier of
    /// a substep, it would be 2.6 times too large after the change from 5 to 8 substeps.
    #[test]
    fn a_column_at_rest_takes_no_notice() {
        let gpu = gpu::device();
        // The dearest, the first, the cheapest.
        let efforts = [[8, 6], [5, 3], [4, 2]];
        let alone = efforts.map(|effort| {
            let mut world = world(&gpu, effort);
            rest(&mut world, 60);
            rest(&mut world, 60)
        });
        // Each effort has a compression of its own to go to, on whose way the column gives off no more
        // than it did while it settled: 4 µJ, an rms speed of 9 mm/s.
        let most = alone
            .map(|(energy, _)| energy)
            .into_iter()
            .fold(0.0, f64::max);
        let mut world = world(&gpu, efforts[1]);
        rest(&mut world, 60);
        for n in [2, 0, 1, 0, 2, 1] {
            world.set_effort(efforts[n]).unwrap();
            let (energy, error) = rest(&mut world, 45);
            assert!(
                energy < 2.0 * most,
                "{:?}: {energy} J of {alone:?}",
                efforts[n]
            );
            // Half a second later the density error is that effort's own, within 0.01 %.
            assert!(
                error < alone[n].1 + 1e-4,
                "{:?}: {error} of {alone:?}",
                efforts[n]
            );
        }
    }
}
