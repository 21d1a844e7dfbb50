//! Limited motions and particles that were taken out are counted.

use crate::common::{particles as particles_of, *};
use glam::DVec3;
use vitriol_gpu::Gpu;
use vitriol_sim::flask::particles::sample;
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::Particle;
use vitriol_sim::surface_tension::SurfaceTension;
use vitriol_tests::gpu;

#[test]
fn speed_is_limited_and_counted() {
    let device = gpu::device();
    let p = Parameters {
        max_speed: 2.0,
        ..weightless()
    };
    let lone = |i: i32, speed: f64| drop_at(DVec3::X * f64::from(i), DVec3::Z * speed);
    let all = vec![lone(0, 3.0), lone(1, 1.9), lone(2, -50.0), lone(3, 0.0)];
    let solver = Setup::new(p, Vec::new(), all).solver(&device);
    frames(&device, &solver, &[], 1);
    let found = particles(&solver.snapshot().unwrap());
    let speeds: Vec<_> = found.iter().map(|p| p.velocity.z).collect();
    for (own, expected) in speeds.iter().zip([2.0, 1.9, -2.0, 0.0]) {
        // Rounding of z over Δt.
        assert!((own - expected).abs() < 1e-5, "{speeds:?}");
    }
    assert_eq!(solver.counters().unwrap().speed_limited, 2);
    // Once limited, no more.
    frames(&device, &solver, &[], 3);
    let again = solver.counters().unwrap().speed_limited;
    assert!(again <= 2 + 3 * 2, "{again}");
}

/// Line 24 bounds a velocity; a correction that goes further than v_max in a substep would tunnel all the same. By the f64 reference,
/// and by the bound itself.
#[test]
fn no_particle_goes_further_than_its_speed() {
    let device = gpu::device();
    let p = Parameters {
        max_speed: 0.05,
        ..weightless()
    };
    let farthest = p.max_speed * p.frame_time;
    let mut random = Random(1);
    // 40 in a ball of 2 mm, where 2 have room: unbounded they go as far as the list allows, eight times as far.
    let all: Vec<_> = (0..40)
        .map(|_| drop_at(random.point(0.002), DVec3::ZERO))
        .collect();
    let starts: Vec<DVec3> = all.iter().map(|particle| particle.position).collect();
    let solver = Setup::new(p, Vec::new(), all).solver(&device);
    frames(&device, &solver, &[], 1);
    let found = particles(&solver.snapshot().unwrap());
    let ways = found
        .iter()
        .zip(&starts)
        .map(|(now, start)| now.position.distance(*start));
    let (mut cut, mut longest) = (0, 0.0_f64);
    for way in ways {
        longest = longest.max(way);
        cut += u32::from(way > 0.999 * farthest);
    }
    // Rounding of places some mm off.
    assert!(longest < farthest + 1e-9, "{longest} m for {farthest} m");
    assert!(cut > 10, "{cut}");
    assert_eq!(solver.counters().unwrap().speed_limited, cut);
}

/// Two particles a hundredth of h apart are pushed further than the
/// list's reach.
#[test]
fn corrections_beyond_the_list_are_limited_and_counted() {
    let device = gpu::device();
    let mut random = Random(1);
    // 40 in a ball of 2 mm, where 2 have room.
    let all: Vec<_> = (0..40)
        .map(|_| drop_at(random.point(0.002), DVec3::ZERO))
        .collect();
    let solver = Setup::new(weightless(), Vec::new(), all).solver(&device);
    frames(&device, &solver, &[], 1);
    let state = solver.snapshot().unwrap();
    let found = particles(&state);
    let list = List::of(&state, weightless().list_capacity());
    let reach = 0.075 * H;
    let mut at_reach = 0;
    for (slot, tag) in state.tags.iter().enumerate() {
        let moved = found[tag[1] as usize].position.distance(list.origins[slot]);
        assert!(moved < reach + 1e-8, "{moved}");
        at_reach += u32::from(moved > reach - 1e-8);
    }
    assert!(at_reach > 10);
    assert_eq!(solver.counters().unwrap().list_limited, at_reach);
}

/// Surface tension that would throw a cube together in a substep: line 24 holds after the
/// forces as well.
#[test]
fn speed_is_limited_after_the_forces_too() {
    let device = gpu::device();
    let p = Parameters {
        max_speed: 0.5,
        surface: Some(SurfaceTension::new(1e4)),
        ..weightless()
    };
    // Eight particles in a cube: each is pulled to the middle.
    let corner = |i: i32| DVec3::new((i % 2).into(), (i / 2 % 2).into(), (i / 4).into());
    let cube = (0..8)
        .map(|i| drop_at(corner(i) * D, DVec3::ZERO))
        .collect();
    let solver = Setup::new(p, Vec::new(), cube).solver(&device);
    frames(&device, &solver, &[], 1);
    let found = particles(&solver.snapshot().unwrap());
    for particle in found {
        let speed = particle.velocity.length();
        assert!((speed - 0.5).abs() < 1e-5, "{speed}");
    }
    assert_eq!(solver.counters().unwrap().speed_limited, 8);
}

/// A lump in the middle of the glass that its own pressure throws against the
/// wall; one particle at rest beside it needs no constraint.
#[test]
fn flask_constraints_are_counted() {
    let device = gpu::device();
    let inside = |position| Particle {
        flask: Some(0),
        ..drop_at(position, DVec3::ZERO)
    };
    let run = |particles: Vec<Particle>| {
        let setup = Setup::new(weightless(), vec![narrow_glass()], particles);
        let solver = setup.solver(&device);
        frames(&device, &solver, &[Pose::IDENTITY], 5);
        let state = solver.snapshot().unwrap();
        let found = particles_of(&state);
        assert!(found.iter().all(|p| p.flask == Some(0)));
        solver.counters().unwrap().flask_constraints
    };
    assert_eq!(run(vec![inside(DVec3::Y * 0.03)]), 0);
    // Predictions into the glass are put back and not counted.
    let thrown = Particle {
        velocity: DVec3::X * 5.0,
        ..inside(DVec3::new(0.01, 0.03, 0.0))
    };
    assert_eq!(run(vec![thrown]), 0);
    let mut random = Random(6);
    let at_the_wall = DVec3::new(0.011, 0.03, 0.0);
    let lump = (0..60).map(|_| inside(at_the_wall + random.point(0.0038)));
    let count = run(lump.collect());
    assert!(count > 10, "{count}");
}

/// A liquid around a particle whose velocity has become `bad`, by what a
/// state on the host lets one do; with `solids` with all forces, too.
fn with_bad_velocity(device: &Gpu, bad: [f32; 3], (flasks, solids): (bool, bool), lanes: u32) {
    let strength = if solids { 0.05 } else { 0.0 };
    let p = Parameters {
        carry_rate: 5.4,
        vorticity: strength,
        surface: (!solids).then(|| SurfaceTension::new(0.05)),
        ..parameters()
    };
    let mut particles_at_start = water(&narrow_glass(), 0, Pose::IDENTITY, 300);
    let (shapes, poses) = if flasks {
        (vec![narrow_glass()], vec![Pose::IDENTITY])
    } else {
        for p in &mut particles_at_start {
            p.flask = None;
        }
        (Vec::new(), Vec::new())
    };
    let setup = Setup {
        loads: flasks,
        lanes: Some(lanes),
        solids: solids.then(|| vec![sample(&narrow_glass(), 0.5 * D, H)]),
        ..Setup::new(p, shapes, particles_at_start)
    };
    let solver = setup.solver(device);
    frames(device, &solver, &poses, 2);
    let mut state = solver.snapshot().unwrap();
    let victim = 123;
    let [x, y, z] = bad;
    let carried = state.velocities[victim][3];
    state.velocities[victim] = [x, y, z, carried];
    let identity = state.tags[victim][1] as usize;
    solver.restore(&state).unwrap();
    let mut loads = Vec::new();
    for _ in 0..3 {
        loads.extend(frame(device, &solver, &poses, &poses));
    }
    let counters = solver.counters().unwrap();
    assert_eq!(counters.nan_particles, 1, "{bad:?}: {counters:?}");
    let end = solver.snapshot().unwrap();
    for (i, p) in particles(&end).iter().enumerate() {
        let finite = p.position.is_finite() && p.velocity.is_finite() && p.carried.is_finite();
        assert!(finite, "{bad:?}: {i} is {p:?}");
        assert_eq!(p.present, i != identity, "{bad:?}: {i}");
        if flasks {
            assert_eq!(p.flask, (i != identity).then_some(0));
        }
        // It has not shaken the others: they are at rest, or fall, or move
        // off the solids, too near to which they were filled in.
        let fast = if flasks && !solids { 0.3 } else { 1.0 };
        assert!(p.velocity.length() < fast, "{bad:?}: {i} at {}", p.velocity);
    }
    // Its mark in the positions, by which the picture leaves it out.
    let marked = end.positions.iter().filter(|p| p[3] == -1.0).count();
    assert_eq!(marked, 1);
    let finite = |v: [f32; 4]| v.iter().all(|x| x.is_finite());
    assert!(
        loads
            .iter()
            .all(|load| finite(load.impulse) && finite(load.angular))
    );
    for load in loads {
        assert_eq!(load.impulse[3], 299.0);
    }
    let density = densities(device, &solver);
    assert!(density.iter().all(|d| d.is_finite()));
}

#[test]
fn a_particle_that_is_no_number_is_taken_out_and_counted() {
    let device = gpu::device();
    let nan = f32::NAN;
    for bad in [
        [nan; 3],
        [0.0, nan, 0.0],
        [nan, 0.0, 0.0],
        [0.0, 0.0, f32::INFINITY],
    ] {
        for walls in [(false, false), (true, false), (true, true)] {
            with_bad_velocity(&device, bad, walls, 1);
        }
    }
    for lanes in lanes(&device) {
        with_bad_velocity(&device, [nan; 3], (true, false), lanes);
    }
}
