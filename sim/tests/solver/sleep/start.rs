//! A scene's start: what stands in flasks settles from the lattice that it was filled in.

use super::*;

fn standing() -> Setup {
    Setup {
        at_rest: true,
        ..glass(still(), 1)
    }
}

/// 99th percentile over particles of ρ/ρ0 − 1.
fn compressed(gpu: &Gpu, solver: &Solver) -> f64 {
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let density = solver.record_density(&mut rec).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    let mut errors = density.get::<f32>().unwrap();
    errors.sort_unstable_by(f32::total_cmp);
    f64::from(errors[errors.len() * 99 / 100]) - 1.0
}

/// Height of the centre, m.
fn height(solver: &Solver) -> f64 {
    let found = particles(&solver.snapshot().unwrap());
    found.iter().map(|it| it.position.y).sum::<f64>() / found.len() as f64
}

/// It sleeps 0.2 s after the start, no denser than the beaker of `vitriol bench` at rest (`fast`: 0.35 %). Its centre is as high as where liquid
/// came to rest by itself, within a sixth of what a slosh may raise liquid that sleeps (0.6 mm).
#[test]
fn a_filling_settles_and_sleeps() {
    let gpu = gpu::device();
    let [settled, free] = [standing(), glass(still(), 1)].map(|setup| {
        let solver = setup.solver(&gpu);
        let slept = fall_asleep(&gpu, &solver, &[Pose::IDENTITY], 0);
        (slept, compressed(&gpu, &solver), height(&solver))
    });
    assert!(settled.0 == 18 && free.0 > 22, "{settled:?} {free:?}");
    assert!(settled.1 < 3.5e-3, "{settled:?} {free:?}");
    assert!((settled.2 - free.2).abs() < 1e-4, "{settled:?} {free:?}");
}

/// That what stands in a glass does after `run` as what may not settle.
fn does_not_settle(particles: &[Particle], run: impl Fn(&Gpu, &Solver)) {
    let gpu = gpu::device();
    let [settled, free] = [true, false].map(|at_rest| {
        let setup = Setup {
            at_rest,
            tools: true,
            ..glass(particles.to_vec(), 1)
        };
        let solver = setup.solver(&gpu);
        run(&gpu, &solver);
        solver.snapshot().unwrap()
    });
    assert!(settled == free);
}

#[test]
fn a_glass_that_is_moved_at_once_is_as_without() {
    does_not_settle(&still(), |gpu, solver| {
        for n in 0..5u8 {
            let poses = [n, n + 1].map(|n| [at(0.002 * f32::from(n), 0.0, 0.0)]);
            frame(gpu, solver, &poses[0], &poses[1]);
        }
    });
}

/// What is filled into a glass that leans does not lie level: it flows there at once, as without.
#[test]
fn a_glass_that_leans_does_not_settle() {
    let leaning = Pose {
        orientation: glam::Quat::from_rotation_z(0.1),
        ..Pose::IDENTITY
    };
    let particles = water(&narrow_glass(), 0, leaning, 500);
    does_not_settle(&particles, |gpu, solver| {
        frames(gpu, solver, &[leaning], 19);
        assert_eq!(solver.awake().unwrap(), 500);
    });
}

#[test]
fn what_is_stirred_at_once_does_not_settle() {
    let rod = Touch {
        ends: [Vec3::new(0.0, 0.005, 0.0), Vec3::new(0.0, 0.2, 0.0)],
        velocities: [0.1 * Vec3::X; 2],
        radius: 0.003,
        wipes: false,
    };
    does_not_settle(&still(), |gpu, solver| {
        for _ in 0..5 {
            let mut rec = gpu.recorder(QueueKind::Main).unwrap();
            solver.handle(&mut rec, &rod, FRAME).unwrap();
            solver
                .record(&mut rec, &[Pose::IDENTITY], &[Pose::IDENTITY])
                .unwrap();
            gpu.submit(rec).unwrap().wait().unwrap();
        }
    });
}
