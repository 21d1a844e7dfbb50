//! A pane against flight in closed form: particles that fly at it stay before it, those that fly past it are not affected.

use crate::chemistry::setup::bubbly;
use crate::chemistry::spray::spraying;
use crate::common::*;
use glam::{DVec3, Vec3};
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_shaders::layout::Drops;
use vitriol_sim::chemistry::Chemistry;
use vitriol_sim::solver::{Pane, Solver};
use vitriol_tests::gpu;

const FRAME: f64 = 1.0 / 90.0;
const THICK: f32 = 0.006;

/// 0.4 m wide and 0.3 m high, across z and 0.1 m behind the origin; its lower edge is as high as that.
fn pane() -> Pane {
    Pane {
        corner: Vec3::new(-0.2, 0.0, 0.1),
        sides: [0.4 * Vec3::X, 0.3 * Vec3::Y],
        thickness: THICK,
    }
}

fn frame_behind(gpu: &Gpu, solver: &Solver) {
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    solver.stop_at(&mut rec, &pane(), FRAME).unwrap();
    solver.record(&mut rec, &[], &[]).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
}

/// Drops that fly at 3 m/s, which is three of their diameters and five panes a frame: at the pane, beneath it, beside it, over
/// it, away from it, and along it a millimetre from its face. All but the first two are where y₀ + v t − ½ g t² has them.
#[test]
fn drops_stay_before_a_pane() {
    let gpu = gpu::device();
    let flies = |x: f64, y: f64, z: f64, velocity: DVec3| drop_at(DVec3::new(x, y, z), velocity);
    let towards = 3.0 * DVec3::Z;
    let all = vec![
        flies(0.0, 0.15, 0.0, towards),
        flies(0.1, 0.20, 0.3, -towards),
        flies(0.05, -0.02, 0.0, towards),
        flies(0.25, 0.15, 0.0, towards),
        flies(-0.1, 0.36, 0.0, towards),
        flies(-0.1, 0.15, 0.08, -towards),
        flies(-0.15, 0.15, 0.1 - 0.003 - 0.5 * D - 0.001, 0.5 * DVec3::X),
    ];
    let setup = Setup {
        tools: true,
        ..Setup::new(parameters(), Vec::new(), all.clone())
    };
    let solver = setup.solver(&gpu);
    let frames = 9;
    (0..frames).for_each(|_| frame_behind(&gpu, &solver));
    let time = f64::from(frames) * FRAME;
    let found = particles(&solver.snapshot().unwrap());
    // A drop's surface is half a spacing from its middle, and a step of the solver's rounds by micrometres.
    let face = 0.5 * f64::from(THICK) + 0.5 * D;
    for (index, (before, after)) in all.iter().zip(&found).enumerate() {
        let free = before.position + time * before.velocity - 0.5 * 9.81 * time * time * DVec3::Y;
        let off = after.position - free;
        // The solver's Euler steps fall by ½ g t Δt more than the parabola.
        assert!(off.with_z(0.0).length() < 1e-3, "{index}: {off}");
        if index < 2 {
            let side = if index == 0 { -1.0 } else { 1.0 };
            let apart = side * (after.position.z - 0.1) - face;
            assert!(apart.abs() < 2e-5, "{index}: {apart} m before it");
            assert!(after.velocity.z.abs() < 1e-3);
        } else {
            assert!(off.z.abs() < 1e-4, "{index}: {off}");
        }
    }
}

/// Spray is stopped where it is thrown, and drops beside the pane fly on.
#[test]
fn spray_stays_before_a_pane() {
    let gpu = gpu::device();
    let mut parameters = parameters();
    parameters.chemistry = Some(Chemistry::Physical(spraying(bubbly())));
    let setup = Setup {
        tools: true,
        ..Setup::new(
            parameters,
            Vec::new(),
            vec![drop_at(DVec3::Y * 5.0, DVec3::ZERO)],
        )
    };
    let solver = setup.solver(&gpu);
    let launched = |x: f32, z: f32| Drops {
        position: [x, 0.15, z],
        velocity: [0.0, 0.0, 2.0],
        mass: 0.015_625,
        radius: 5e-4,
        density: 998.0,
        ..Drops::default()
    };
    let mut state = solver.snapshot().unwrap();
    let all = [launched(0.0, 0.05), launched(0.5, 0.05)];
    state.drops_mut()[..2].copy_from_slice(&all);
    solver.restore(&state).unwrap();
    (0..9).for_each(|_| frame_behind(&gpu, &solver));
    let state = solver.snapshot().unwrap();
    let after = [0, 1].map(|place| state.drops()[place]);
    let face = 0.1 - 0.5 * THICK - 5e-4;
    let apart = face - after[0].position[2];
    assert!((0.0..1e-3).contains(&apart), "{apart} m before it");
    // It runs down, and the air has slowed the other by a tenth.
    assert!(after[0].velocity[1] < -0.5, "{:?}", after[0]);
    assert!(
        (0.19..0.25).contains(&after[1].position[2]),
        "{:?}",
        after[1]
    );
}
