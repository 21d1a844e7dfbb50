//! What the liquid does to a flask, by statics.

use crate::common::*;
use glam::{DVec3, Quat, Vec3};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_tests::gpu;

fn vector(v: [f32; 4]) -> DVec3 {
    DVec3::new(v[0].into(), v[1].into(), v[2].into())
}

/// A leaning glass of water at rest bears the water's weight, at its centre
/// of mass; an empty one beside it bears nothing.
#[test]
fn a_glass_bears_the_weight_of_its_water() {
    let device = gpu::device();
    let lean = Quat::from_rotation_z(0.2);
    let poses = [
        Pose::new(Vec3::new(0.1, 0.05, 0.02), lean),
        at(0.5, 0.0, 0.0),
    ];
    let p = Parameters {
        substeps: 8,
        carry: 0.005,
        viscosity: 0.3,
        ..parameters()
    };
    let mass = p.particle_mass();
    let time = p.frame_time;
    let setup = Setup {
        loads: true,
        ..Setup::new(
            p,
            vec![narrow_glass(); 2],
            water(&narrow_glass(), 0, poses[0], 600),
        )
    };
    let solver = setup.solver(&device);
    frames(&device, &solver, &poses, 60);
    let count = 30.0;
    let (mut impulse, mut angular) = (DVec3::ZERO, DVec3::ZERO);
    for _ in 0..30 {
        let loads = frame(&device, &solver, &poses, &poses);
        assert_eq!((loads[0].impulse[3], loads[1].impulse), (600.0, [0.0; 4]));
        impulse += vector(loads[0].impulse) / count;
        angular += vector(loads[0].angular) / count;
        let found = particles(&solver.snapshot().unwrap());
        let origin = poses[0].position.as_dvec3();
        let offsets: DVec3 = found.iter().map(|p| p.position - origin).sum();
        // 600 sums of floats below 0.06.
        assert!(offsets.distance(vector(loads[0].offsets)) < 1e-4);
    }
    let found = particles(&solver.snapshot().unwrap());
    let centre = found.iter().map(|p| p.position).sum::<DVec3>() / 600.0;
    let weight = DVec3::Y * (-9.81 * mass * 600.0 * time);
    // At rest but for what still sways.
    let off = impulse.distance(weight) / weight.length();
    assert!(off < 0.02, "{impulse} for {weight}");
    let torque = (centre - poses[0].position.as_dvec3()).cross(weight);
    let off = angular.distance(torque) / (weight.length() * 0.013);
    assert!(off < 0.03, "{angular} for {torque}");
}
