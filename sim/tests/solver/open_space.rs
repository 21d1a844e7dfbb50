//! Liquid with nothing around it.

use crate::common::*;
use glam::DVec3;
use vitriol_sim::parameters::Parameters;
use vitriol_tests::gpu;

/// With powers of two for g, Δt and the start every sum is a float without
/// rounding, so that the fall is that of the formula to the last bit, however
/// often the list is rebuilt on the way.
#[test]
fn free_fall_is_exact() {
    let device = gpu::device();
    let p = Parameters {
        gravity: [0.0, -8.0, 0.0],
        frame_time: 1.0 / 64.0,
        substeps: 4,
        max_speed: 1e3,
        ..parameters()
    };
    let velocities = [DVec3::new(0.5, 2.0, -0.25), DVec3::ZERO];
    for count in 0..=2 {
        let start: Vec<_> = (0..count)
            .map(|i| drop_at(DVec3::new(i as f64, 4.0, -2.0), velocities[i]))
            .collect();
        let solver = Setup::new(p.clone(), Vec::new(), start.clone()).solver(&device);
        frames(&device, &solver, &[], 64);
        let state = solver.snapshot().unwrap();
        let (n, dt) = (256.0, 1.0 / 256.0);
        // Symplectic Euler: v by n·g·Δt, x by g·Δt²·n(n + 1)/2 beside v₀·t.
        let gravity = DVec3::new(0.0, -8.0, 0.0);
        let found = particles(&state);
        assert_eq!(found.len(), count);
        for (found, start) in found.iter().zip(&start) {
            let velocity = start.velocity + gravity * (n * dt);
            let fallen = gravity * (dt * dt * n * (n + 1.0) / 2.0);
            assert_eq!(found.velocity, velocity);
            assert_eq!(found.position, start.position + start.velocity + fallen);
            assert!(found.present && found.flask.is_none());
        }
        let counters = solver.counters().unwrap();
        // 5 m in one second, of which a list serves 0.3 mm.
        assert_eq!(counters.list_rebuilds > 200, count > 0, "{counters:?}");
        assert_eq!((counters.list_limited, counters.speed_limited), (0, 0));
    }
}

/// A blob 6 % too dense, with velocities at random, that expands.
#[test]
fn momentum_is_kept_without_gravity() {
    let device = gpu::device();
    let p = Parameters {
        gravity: [0.0; 3],
        viscosity: 0.3,
        carry_rate: 5.4,
        ..parameters()
    };
    let mut random = Random(9);
    let blob: Vec<_> = (0..512)
        .map(|i| {
            let site = DVec3::new((i % 8).into(), (i / 8 % 8).into(), (i / 64).into());
            let position = site * (0.98 * D) + random.point(0.05 * D);
            drop_at(position, random.point(0.1))
        })
        .collect();
    let solver = Setup::new(p, Vec::new(), blob.clone()).solver(&device);
    frames(&device, &solver, &[], 8);
    let state = solver.snapshot().unwrap();
    let found = particles(&state);
    let counters = solver.counters().unwrap();
    // Both would take momentum away, and be counted.
    assert_eq!((counters.list_limited, counters.speed_limited), (0, 0));
    let n = found.len() as f64;
    let before = blob.iter().map(|p| p.velocity).sum::<DVec3>() / n;
    let after = found.iter().map(|p| p.velocity).sum::<DVec3>() / n;
    // Velocities come from positions of 20 mm, rounded to 2 nm: 2e-6 m/s a
    // substep and particle, at random: 96 substeps of 512 make 1e-6 m/s.
    let drift = (after - before).length();
    assert!(drift < 2e-6, "{drift}");
    // It was no gas: it has pushed itself apart.
    let spread = |at: &dyn Fn(usize) -> DVec3| -> f64 {
        let centre = (0..512).map(at).sum::<DVec3>() / n;
        (0..512).map(|i| (at(i) - centre).length()).sum::<f64>() / n
    };
    let (packed, loose) = (
        spread(&|i| blob[i].position),
        spread(&|i| found[i].position),
    );
    assert!(loose > 1.004 * packed, "{packed} {loose}");
}

/// Kernel gradients vanish where particles coincide, so that nothing of the
/// density would part them.
#[test]
fn what_is_in_one_point_separates() {
    let device = gpu::device();
    let p = Parameters {
        gravity: [0.0; 3],
        ..parameters()
    };
    for count in [2, 300] {
        let all = vec![drop_at(DVec3::new(0.3, -0.1, 0.2), DVec3::ZERO); count];
        let solver = Setup::new(p.clone(), Vec::new(), all).solver(&device);
        frames(&device, &solver, &[], 20);
        let found = particles(&solver.snapshot().unwrap());
        assert_eq!(found.len(), count);
        assert!(found.iter().all(|p| p.present && p.position.is_finite()));
        // v_max for 20 frames.
        let origin = DVec3::new(0.3, -0.1, 0.2);
        let reach = 8.0 * 20.0 / 90.0;
        assert!(found.iter().all(|p| p.position.distance(origin) < reach));
        let closest = closest_pair(&found);
        let counters = solver.counters().unwrap();
        assert!(closest > 0.01 * H, "{count}: {closest} m, {counters:?}");
        // 72 places for 299 neighbours: counted, not hidden.
        assert_eq!(counters.list_overflows > 0, count > 72, "{counters:?}");
        assert_eq!(counters.nan_particles, 0);
    }
}
