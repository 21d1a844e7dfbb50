//! What keeps liquid awake: motion, warmth, unevenness, drops and mixing that goes on.

use super::*;

/// Liquid that is warm, or not even, goes on: it would cool, or mix.
#[test]
fn warm_and_uneven_liquid_stays_awake() {
    let gpu = gpu::device();
    let law = Chemistry::Physical(with_bubbles());
    let asleep = |of: &dyn Fn(f64) -> (f64, f64)| {
        let p = with(law.clone(), calm());
        let setup = Setup::new(p, vec![narrow_glass()], glass_of(500, of));
        let solver = setup.solver(&gpu);
        frames(&gpu, &solver, &[Pose::IDENTITY], SETTLED);
        solver.awake().unwrap() == 0
    };
    assert!(asleep(&|_| (20.0, 0.98)));
    assert!(!asleep(&|_| (30.0, 0.98)), "10 K above the room");
    assert!(!asleep(&|_| (21.5, 0.98)), "1.5 K above the room");
    // Two fractions that lie apart, with nothing unmixed within particles.
    let law = Physical {
        lamella: None,
        ..with_bubbles()
    };
    let p = with(Chemistry::Physical(law), calm());
    let layers = |height: f64| (20.0, if height > 0.5 { 0.977 } else { 0.98 });
    let setup = Setup::new(p, vec![narrow_glass()], glass_of(500, layers));
    let solver = setup.solver(&gpu);
    frames(&gpu, &solver, &[Pose::IDENTITY], SETTLED);
    assert_eq!(solver.awake().unwrap(), 500, "two layers");
}

/// Liquid over a plate that is on never sleeps.
#[test]
fn a_plate_keeps_liquid_awake() {
    let gpu = gpu::device();
    let mut p = with(Chemistry::Physical(with_bubbles()), calm());
    p.heaters = vec![50.0];
    let setup = Setup::new(p, vec![narrow_glass()], glass_of(200, |_| (20.0, 0.0)));
    let solver = setup.solver(&gpu);
    frames(&gpu, &solver, &[Pose::IDENTITY], 30);
    assert_eq!(solver.awake().unwrap(), 200);
}

/// Liquid that sloshes is not caught at the turn of its swing: its particles are slow then, and only for a moment.
#[test]
fn a_slosh_is_not_caught_at_its_turn() {
    let gpu = gpu::device();
    let mut setup = glass(still(), 1);
    setup.parameters.viscosity = 0.05;
    let solver = setup.solver(&gpu);
    let mut pose = Pose::IDENTITY;
    for _ in 0..4 {
        let next = at(pose.position.x + 0.002, 0.0, 0.0);
        frame(&gpu, &solver, &[pose], &[next]);
        pose = next;
    }
    let asleep = (0..300).find(|_| {
        frames(&gpu, &solver, &[pose], 1);
        solver.awake().unwrap() == 0
    });
    assert!(asleep.is_some(), "never sleeps");
    // A quarter of a spacing at the wall.
    let found = particles(&solver.snapshot().unwrap());
    let raised = raised(&found, pose.position.x.into());
    assert!(raised.abs() < 0.25 * D, "{raised} m");
}

/// Water that turns slowly with no particle fast: the mean alone tells that it is not at rest.
#[test]
fn water_that_turns_as_a_whole_stays_awake() {
    let gpu = gpu::device();
    let mut setup = glass(still(), 1);
    setup.parameters.viscosity = 0.05;
    let solver = setup.solver(&gpu);
    frames(&gpu, &solver, &[Pose::IDENTITY], 2 * SETTLED);
    let mut state = solver.snapshot().unwrap();
    // 0.02 m/s at the wall.
    let rate = 0.02 / 0.013;
    for (v, x) in state.velocities.iter_mut().zip(&state.positions) {
        *v = [rate * x[2], 0.0, -rate * x[0], v[3]];
    }
    solver.restore(&state).unwrap();
    // Wakes it, and lifts no wave.
    let lifted = at(0.0, 2e-4, 0.0);
    frame(&gpu, &solver, &[Pose::IDENTITY], &[lifted]);
    // A particle is slow below √(2g·0.016 d), and liquid rests below a fifth of that on average.
    let slow = (2.0 * 9.81 * 0.016 * D).sqrt();
    for n in 0..40 {
        frames(&gpu, &solver, &[lifted], 1);
        let speeds = particles(&solver.snapshot().unwrap());
        let squares = speeds.iter().map(|it| it.velocity.length_squared());
        let (sum, most) = squares.fold((0.0, 0.0_f64), |(sum, most), v| (sum + v, most.max(v)));
        let mean = (sum / 500.0).sqrt();
        // What else would keep it awake ends in time for 0.2 s of calm.
        assert!(
            n < 15 || most.sqrt() < slow,
            "frame {n}: {} m/s",
            most.sqrt()
        );
        assert!(mean > 0.22 * slow, "frame {n}: {mean} m/s on average");
        assert_eq!(solver.awake().unwrap(), 500, "frame {n}");
    }
}

/// Drops in the air may come down, and what is unmixed within particles mixes.
#[test]
fn drops_and_unmixed_particles_keep_liquid_awake() {
    let gpu = gpu::device();
    let p = with(Chemistry::Physical(with_bubbles()), calm());
    let setup = Setup::new(p, vec![narrow_glass()], glass_of(500, |_| (20.0, 0.5)));
    let poses = [Pose::IDENTITY];
    let solver = setup.solver(&gpu);
    let mut flying = solver.snapshot().unwrap();
    // It falls past all, for longer than the liquid needs to come to rest.
    flying.drops_mut()[0] = Drops {
        position: [1.0, 3.0, 0.0],
        mass: 0.01,
        radius: 5e-4,
        density: 1000.0,
        ..Drops::default()
    };
    solver.restore(&flying).unwrap();
    frames(&gpu, &solver, &poses, SETTLED);
    let state = solver.snapshot().unwrap();
    assert!(state.drops()[0].mass > 0.0, "it is gone");
    assert_eq!(solver.awake().unwrap(), 500, "a drop in the air");
    let mut unmixed = setup.solver(&gpu).snapshot().unwrap();
    for eddies in &mut unmixed.eddies {
        eddies[1] = 1e-5;
    }
    solver.restore(&unmixed).unwrap();
    frames(&gpu, &solver, &poses, SETTLED);
    assert_eq!(solver.awake().unwrap(), 500, "unmixed particles");
    let state = solver.snapshot().unwrap();
    let warmest = state.heat.iter().map(|heat| heat[0]).fold(0.0, f32::max);
    assert!(warmest < 21.0, "{warmest} °C would keep it awake too");
}

/// Water that is held over a glass does not wake its liquid, as near as it may be to the glass. Lowered, it does before it can meet it.
#[test]
fn water_that_is_lowered_into_a_glass_wakes_liquid() {
    const STEP: f32 = 0.003;
    let gpu = gpu::device();
    let above = at(0.0, 0.09, 0.0);
    let mut held = still();
    held.extend(water(&narrow_glass(), 1, above, 100));
    let mut setup = glass(held, 1);
    setup.flasks.push(narrow_glass());
    let solver = setup.solver(&gpu);
    fall_asleep(&gpu, &solver, &[Pose::IDENTITY, above], 0);
    let top = |found: &[Found]| found.iter().map(|it| it.position.y).fold(0.0, f64::max);
    let liquid = top(&particles(&solver.snapshot().unwrap())[..500]);
    assert!(liquid < 0.03, "{liquid}");
    let (mut pose, mut gap) = (above, 1.0);
    for _ in 0..40 {
        if solver.awake().unwrap() > 100 {
            break;
        }
        let found = particles(&solver.snapshot().unwrap());
        let lowest = found[500..].iter().map(|it| it.position.y);
        gap = lowest.fold(1.0, f64::min) - liquid;
        let mut to = pose;
        to.position.y -= STEP;
        frame(
            &gpu,
            &solver,
            &[Pose::IDENTITY, pose],
            &[Pose::IDENTITY, to],
        );
        pose = to;
    }
    assert!(gap > H + f64::from(STEP) && gap < 0.03, "{gap} m");
}

/// What stands at the rim of a glass that moves may run into another within a frame, so that one's liquid is awake before.
#[test]
fn water_at_a_rim_wakes_what_it_may_run_into() {
    let gpu = gpu::device();
    let full = vitriol_sim::flask::Profile::new(&[[0.0, 0.013], [0.016, 0.013]], 0.002).unwrap();
    let [held, moved] = [0.0, 0.001].map(|x| [Pose::IDENTITY, at(x, 0.065, 0.0)]);
    let mut liquid = still();
    liquid.extend(water(&full, 1, held[1], 300));
    let mut setup = glass(liquid, 1);
    setup.flasks.push(full);
    let solver = setup.solver(&gpu);
    fall_asleep(&gpu, &solver, &held, 0);
    frame(&gpu, &solver, &held, &moved);
    assert_eq!(solver.awake().unwrap(), 300);
    frames(&gpu, &solver, &moved, 1);
    assert_eq!(solver.awake().unwrap(), 800);
}
