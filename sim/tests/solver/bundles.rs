//! A frame's commands that are executed again equal those that are recorded anew.

use crate::common::*;
use glam::DVec3;
use vitriol_gpu::{Gpu, Timestamps};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::surface_tension::{SurfaceTension, WATER};
use vitriol_tests::gpu;

/// Water that a glass swings, with surface tension, whose passes upload and fill.
fn scene() -> Setup {
    let mut particles = water(&narrow_glass(), 0, at(0.0, 0.01, 0.0), 500);
    particles.push(drop_at(DVec3::new(0.05, 0.05, 0.0), DVec3::X));
    let p = Parameters {
        surface: Some(SurfaceTension::new(WATER)),
        carry_rate: 5.4,
        ..parameters()
    };
    Setup {
        loads: true,
        ..Setup::new(p, vec![narrow_glass()], particles)
    }
}

/// Hash after frames, and the impulse on the glass in the last of them.
fn run(gpu: &Gpu) -> (u64, [f32; 4]) {
    let solver = scene().solver(gpu);
    let mut impulse = [0.0; 4];
    for n in 0..6_u8 {
        let pose = |n: u8| at(0.002 * (f32::from(n) * 0.9).sin(), 0.01, 0.0);
        impulse = frame(gpu, &solver, &[pose(n)], &[pose(n + 1)])[0].impulse;
    }
    (solver.snapshot().unwrap().hash(), impulse)
}

#[test]
fn executed_again_is_recorded_anew() {
    let executing = gpu::device();
    assert!(!executing.options().tells_passes());
    let recording = gpu::another_device(|options| options.timestamps = Timestamps::Passes);
    let (hash, impulse) = run(&executing);
    assert_eq!((hash, impulse), run(&recording));
    assert!(impulse[1] < 0.0, "the liquid weighs: {impulse:?}");
}
