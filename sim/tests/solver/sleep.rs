//! Liquid that sleeps: it stays where it is, wakes before anything meets it, and goes on as if it had not slept.

mod awake;
mod start;

use crate::chemistry::setup::{glass_of, with, with_bubbles};
use crate::common::*;
use glam::{DVec3, Vec3};
use std::collections::BTreeSet;
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_shaders::layout::Drops;
use vitriol_sim::chemistry::{Chemistry, Physical};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::{Particle, Solver, Touch};
use vitriol_tests::gpu;

/// Frames after which a glass of water has long slept, and seconds of one.
const SETTLED: usize = 90;
const FRAME: f64 = 1.0 / 90.0;

/// Real size, with viscosity enough for 500 particles in a narrow glass to come to rest soon.
fn calm() -> Parameters {
    Parameters {
        viscosity: 0.1,
        carry_rate: 5.4,
        sleep: true,
        ..parameters()
    }
}

fn glass(particles: Vec<Particle>, lanes: u32) -> Setup {
    Setup {
        lanes: Some(lanes),
        ..Setup::new(calm(), vec![narrow_glass()], particles)
    }
}

fn still() -> Vec<Particle> {
    water(&narrow_glass(), 0, Pose::IDENTITY, 500)
}

/// Runs frames until all liquid sleeps but `awake` particles; their number.
fn fall_asleep(gpu: &Gpu, solver: &Solver, poses: &[Pose], awake: u32) -> usize {
    let slept = (0..SETTLED).find(|_| {
        frames(gpu, solver, poses, 1);
        solver.awake().unwrap() == awake
    });
    slept.expect("comes to rest")
}

/// How much higher a plane surface through the liquid of a narrow glass at x = `x` stands at one wall than in the middle, m: under a surface
/// y = H + a x in a round glass of radius r, the mean of y x is a r²/4.
fn raised(found: &[Found], x: f64) -> f64 {
    let moments = found.iter().map(|it| it.position.y * (it.position.x - x));
    4.0 * moments.sum::<f64>() / found.len() as f64 / 0.013
}

/// Not one bit of the liquid changes while it sleeps, and its load on the glass stays its weight.
#[test]
fn what_sleeps_stays() {
    let gpu = gpu::device();
    for lanes in lanes(&gpu) {
        let mut setup = glass(still(), lanes);
        setup.loads = true;
        let solver = setup.solver(&gpu);
        let slept = fall_asleep(&gpu, &solver, &[Pose::IDENTITY], 0);
        // Not before nothing happened for 0.2 s.
        assert!(slept >= 18, "{slept}");
        // One frame more, in which nothing is sorted.
        frames(&gpu, &solver, &[Pose::IDENTITY], 1);
        let before = solver.snapshot().unwrap();
        let weight = before.positions.len() as f64 * setup.parameters.particle_mass() * 9.81;
        for _ in 0..5 {
            let load = frame(&gpu, &solver, &[Pose::IDENTITY], &[Pose::IDENTITY])[0];
            let push = -f64::from(load.impulse[1]) / FRAME;
            assert!((push / weight - 1.0).abs() < 0.1, "{push} N of {weight}");
        }
        let after = solver.snapshot().unwrap();
        assert!(after == before, "{lanes} lanes");
    }
}

/// A drop that falls from 6 m, in the end at v_max: the liquid is awake again while the drop is still out of the reach of its forces.
#[test]
fn what_falls_wakes_liquid_before_it_meets_it() {
    let gpu = gpu::device();
    for lanes in lanes(&gpu) {
        let mut particles = still();
        particles.push(drop_at(DVec3::new(0.0, 6.0, 0.0), DVec3::ZERO));
        let solver = glass(particles, lanes).solver(&gpu);
        let (mut slept, mut gap) = (0, f64::INFINITY);
        for _ in 0..2 * SETTLED {
            frames(&gpu, &solver, &[Pose::IDENTITY], 1);
            let found = self::particles(&solver.snapshot().unwrap());
            let (drop, liquid) = found.split_last().unwrap();
            let near = liquid
                .iter()
                .map(|it| it.position.distance(drop.position))
                .fold(f64::INFINITY, f64::min);
            if solver.awake().unwrap() == 1 {
                slept += 1;
                gap = near;
            } else if slept > 0 {
                break;
            }
        }
        assert!(slept > 10, "{slept} frames");
        assert_eq!(solver.awake().unwrap(), 501);
        // Two frames of its fall, and the support radius.
        assert!(gap > 2.0 * 8.0 * FRAME + H, "{gap} m");
    }
}

/// Glass that is moved takes its liquid along in the same frame.
#[test]
fn glass_that_is_moved_wakes_its_liquid() {
    let gpu = gpu::device();
    let solver = glass(still(), 1).solver(&gpu);
    fall_asleep(&gpu, &solver, &[Pose::IDENTITY], 0);
    let mut pose = Pose::IDENTITY;
    for _ in 0..10 {
        let next = at(pose.position.x + 0.004, 0.0, 0.0);
        frame(&gpu, &solver, &[pose], &[next]);
        pose = next;
        assert_eq!(solver.awake().unwrap(), 500);
    }
    let found = particles(&solver.snapshot().unwrap());
    let profile = narrow_glass();
    let inside = |it: &Found| {
        let local = it.position - pose.position.as_dvec3();
        profile.is_inside(local.x.hypot(local.z), local.y)
    };
    assert!(found.iter().all(inside), "liquid was left behind");
}

/// A glass that drifts by less than counts as motion in a frame is noticed all the same.
#[test]
fn a_slow_drift_wakes_liquid() {
    let gpu = gpu::device();
    let solver = glass(still(), 1).solver(&gpu);
    fall_asleep(&gpu, &solver, &[Pose::IDENTITY], 0);
    let mut pose = Pose::IDENTITY;
    let woken = (0..40).find(|_| {
        let next = at(pose.position.x + 1e-5, 0.0, 0.0);
        frame(&gpu, &solver, &[pose], &[next]);
        pose = next;
        solver.awake().unwrap() > 0
    });
    assert!(woken.is_some_and(|frames| frames < 12), "{woken:?}");
}

/// A rod that stirs moves no glass.
#[test]
fn a_rod_wakes_liquid() {
    let gpu = gpu::device();
    let mut setup = glass(still(), 1);
    setup.tools = true;
    let solver = setup.solver(&gpu);
    let poses = [Pose::IDENTITY];
    fall_asleep(&gpu, &solver, &poses, 0);
    let mut rod = Touch {
        ends: [Vec3::new(0.0, 0.005, 0.0), Vec3::new(0.0, 0.2, 0.0)],
        velocities: [Vec3::ZERO; 2],
        radius: 0.0035,
        wipes: false,
    };
    let touch = |rod: &Touch| {
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        solver.handle(&mut rec, rod, FRAME).unwrap();
        solver.record(&mut rec, &poses, &poses).unwrap();
        gpu.submit(rec).unwrap().wait().unwrap();
        solver.awake().unwrap()
    };
    assert_eq!(touch(&rod), 0, "a rod that stands still");
    rod.velocities = [0.1 * Vec3::X; 2];
    assert_eq!(touch(&rod), 500);
}

/// Two glasses whose liquid sleeps: one of 500 particles, and one `x` m beside it of `count`.
fn two_glasses(gpu: &Gpu, count: usize, x: f32) -> Solver {
    let far = at(x, 0.0, 0.0);
    let mut particles = still();
    particles.extend(water(&narrow_glass(), 1, far, count));
    let mut setup = glass(particles, 1);
    setup.flasks.push(narrow_glass());
    let solver = setup.solver(gpu);
    fall_asleep(gpu, &solver, &[Pose::IDENTITY, far], 0);
    solver
}

/// The glass of another flask does not act on liquid in a flask. So liquid sleeps on while an empty glass passes within a
/// millimetre, and wakes for one with water once that may meet it in two frames.
#[test]
fn water_that_is_carried_near_wakes_liquid() {
    /// Way in a frame, m: at 0.27 m/s no drop flies ahead.
    const STEP: f32 = 0.003;
    let gpu = gpu::device();
    for (count, nearest) in [(0, 0.031f32), (100, 0.0)] {
        let solver = two_glasses(&gpu, count, 0.3);
        let (mut x, mut gap) = (0.3f32, f64::INFINITY);
        loop {
            let [from, to] = [x, x - STEP].map(|x| [Pose::IDENTITY, at(x.max(nearest), 0.0, 0.0)]);
            frame(&gpu, &solver, &from, &to);
            x -= STEP;
            if solver.awake().unwrap() > count as u32 || x < 0.0 {
                break;
            }
            let found = particles(&solver.snapshot().unwrap());
            // From the water to the other glass, 15 mm in radius.
            gap = found[500..]
                .iter()
                .map(|it| it.position.x - 0.015)
                .fold(gap, f64::min);
        }
        if count == 0 {
            assert!(x < 0.0, "an empty glass at {x} woke it");
        } else {
            assert!(gap > H + f64::from(STEP) && gap < 0.03, "{gap} m");
        }
    }
}

/// A flask that leaps, as where a hand is tracked again, may be in the other from one frame to the next; so may one that begins to move beside it.
#[test]
fn a_glass_that_leaps_or_sets_off_nearby_wakes_liquid() {
    let gpu = gpu::device();
    let leap = [at(0.26, 0.0, 0.0), at(0.3, 0.0, 0.0)];
    for after in [leap, [Pose::IDENTITY, at(0.04, 0.0, 0.0)]] {
        let solver = two_glasses(&gpu, 100, 0.3);
        frame(&gpu, &solver, &after, &after);
        assert_eq!(solver.awake().unwrap(), 600, "{after:?}");
    }
    let before = [Pose::IDENTITY, at(0.032, 0.0, 0.0)];
    for moved in [0, 1] {
        let solver = two_glasses(&gpu, 100, 0.032);
        let mut after = before;
        after[moved].position.y += 0.001;
        frame(&gpu, &solver, &before, &after);
        assert_eq!(solver.awake().unwrap(), 600, "{moved}");
    }
}

/// A flask that creeps, by less than counts as motion in a frame, keeps the liquid beside it awake.
#[test]
fn a_glass_that_creeps_nearby_keeps_liquid_awake() {
    let gpu = gpu::device();
    let solver = two_glasses(&gpu, 100, 0.035);
    let mut x = 0.035;
    for step in 0..60 {
        let [from, to] = [x, x - 4e-5].map(|x| [Pose::IDENTITY, at(x, 0.0, 0.0)]);
        frame(&gpu, &solver, &from, &to);
        x -= 4e-5;
        assert!(step < 4 || solver.awake().unwrap() == 600, "{step}");
    }
}

/// While one glass sleeps and another is shaken, lists are made anew all the time; those of what sleeps lack nothing, and the
/// others have nothing of it.
#[test]
fn lists_of_what_sleeps_stay_whole() {
    let gpu = gpu::device();
    for lanes in lanes(&gpu) {
        let mut particles = still();
        let other = at(0.3, 0.0, 0.0);
        particles.extend(water(&narrow_glass(), 1, other, 300));
        let mut setup = glass(particles, lanes);
        setup.flasks.push(narrow_glass());
        let solver = setup.solver(&gpu);
        fall_asleep(&gpu, &solver, &[Pose::IDENTITY, other], 0);
        let mut x = 0.3;
        for n in 0..12 {
            let next = if n % 4 < 2 { x + 0.006 } else { x - 0.006 };
            let [from, to] = [x, next].map(|x| [Pose::IDENTITY, at(x, 0.0, 0.0)]);
            frame(&gpu, &solver, &from, &to);
            x = next;
            assert_eq!(solver.awake().unwrap(), 300, "frame {n}");
        }
        let state = solver.snapshot().unwrap();
        let list = List::of(&state, setup.parameters.list_capacity());
        // Those that sleep are the last.
        let flask = |slot: usize| state.flask_of(slot);
        assert!((0..300).all(|slot| flask(slot) != Some(0)));
        assert!((300..800).all(|slot| flask(slot) == Some(0)));
        let place = |slot: usize| {
            let [x, y, z, _] = state.positions[slot].map(f64::from);
            DVec3::new(x, y, z)
        };
        for slot in 300..800 {
            let own: BTreeSet<_> = list.neighbours[slot].iter().copied().collect();
            let near = |other: &usize| {
                *other != slot
                    && flask(*other) == Some(0)
                    && place(slot).distance(place(*other)) < H
            };
            let must: BTreeSet<_> = (0..800).filter(near).collect();
            let missed: Vec<_> = must.difference(&own).collect();
            assert!(missed.is_empty(), "{lanes} lanes, {slot} lacks {missed:?}");
        }
        let awake = &list.neighbours[..300];
        assert!(awake.iter().flatten().all(|&other| other < 300));
        assert!(awake.iter().any(|own| own.len() > 20));
    }
}

/// A state that is taken up while one glass sleeps and another moves goes on with the same bits, on a solver that has seen nothing, and the
/// glasses bear the same loads.
#[test]
fn a_restored_sleep_goes_on_with_the_same_bits() {
    let gpu = gpu::device();
    let other = at(0.3, 0.0, 0.0);
    let mut particles = still();
    particles.extend(water(&narrow_glass(), 1, other, 300));
    let mut setup = glass(particles, 1);
    setup.flasks.push(narrow_glass());
    setup.loads = true;
    let solver = setup.solver(&gpu);
    let pose = |x: f32| [Pose::IDENTITY, at(x, 0.0, 0.0)];
    let loads = |solver: &Solver, from: f32, to: f32| {
        let loads = frame(&gpu, solver, &pose(from), &pose(to));
        let loads = [0, 1].map(|flask: usize| loads[flask].impulse);
        assert!(loads[0][1] < 0.0, "{loads:?}");
        loads.map(|impulse| impulse.map(f32::to_bits))
    };
    let taken_up = || {
        let fresh = setup.solver(&gpu);
        fresh.restore(&solver.snapshot().unwrap()).unwrap();
        fresh
    };
    fall_asleep(&gpu, &solver, &pose(0.3), 0);
    // Also where all sleeps.
    let fresh = taken_up();
    let [on, anew] = [&solver, &fresh].map(|it| loads(it, 0.3, 0.3));
    assert_eq!(on, anew);
    frame(&gpu, &solver, &pose(0.3), &pose(0.305));
    assert_eq!(solver.awake().unwrap(), 300);
    let fresh = taken_up();
    let then = |solver: &Solver| {
        let loads = loads(solver, 0.305, 0.3);
        // The sleeper is woken too.
        frame(&gpu, solver, &pose(0.3), &[at(0.005, 0.0, 0.0), other]);
        frames(&gpu, solver, &[at(0.005, 0.0, 0.0), other], 3);
        (solver.snapshot().unwrap(), loads)
    };
    let [(on, loads), (anew, same)] = [&solver, &fresh].map(then);
    assert!(on == anew);
    assert_eq!(loads, same);
}

/// After it was woken, liquid stands as it does without sleep: its centre within a hundredth of a spacing, its surface at the wall within a
/// tenth, and its density within the error of these substeps (0.4 %).
#[test]
fn liquid_that_slept_stands_as_if_it_had_not() {
    let gpu = gpu::device();
    let stands = |sleep: bool| {
        let mut setup = glass(still(), 1);
        setup.parameters.sleep = sleep;
        let solver = setup.solver(&gpu);
        frames(&gpu, &solver, &[Pose::IDENTITY], SETTLED);
        assert_eq!(solver.awake().unwrap() == 0, sleep);
        let moved = at(0.002, 0.0, 0.0);
        frame(&gpu, &solver, &[Pose::IDENTITY], &[moved]);
        frames(&gpu, &solver, &[moved], 45);
        let found = particles(&solver.snapshot().unwrap());
        let heights: f64 = found.iter().map(|it| it.position.y).sum();
        let densities = densities(&gpu, &solver);
        let error: f64 = densities.iter().map(|it| (it - 1.0).max(0.0)).sum();
        let [height, error] = [heights, error].map(|sum| sum / found.len() as f64);
        [height, error, raised(&found, 0.002)]
    };
    let [slept, not] = [true, false].map(stands);
    assert!((slept[0] - not[0]).abs() < 0.01 * D, "{slept:?} {not:?}");
    assert!((slept[1] - not[1]).abs() < 0.004, "{slept:?} {not:?}");
    assert!((slept[2] - not[2]).abs() < 0.1 * D, "{slept:?} {not:?}");
}

/// Once a finished frame has told that all liquid sleeps, frames are recorded without it; the bits, and the loads, are as with all passes.
#[test]
fn still_frames_have_the_same_bits() {
    let gpu = gpu::device();
    let p = with(Chemistry::Physical(with_bubbles()), calm());
    let mut setup = Setup::new(p, vec![narrow_glass()], glass_of(500, |_| (20.0, 0.5)));
    setup.loads = true;
    let [noting, not] = [0; 2].map(|_| setup.solver(&gpu));
    let both = |before: Pose, after: Pose| {
        let [(state, loads), (same, others)] = [&noting, &not].map(|solver| {
            let mut rec = gpu.recorder(QueueKind::Main).unwrap();
            let record = solver.record(&mut rec, &[before], &[after]).unwrap();
            gpu.submit(rec).unwrap().wait().unwrap();
            if std::ptr::eq(solver, &raw const noting) {
                solver.note(&record).unwrap();
            }
            (solver.snapshot().unwrap(), record.loads().unwrap())
        });
        assert!(state == same);
        assert_eq!(
            bytemuck::cast_slice::<_, u32>(&loads),
            bytemuck::cast_slice::<_, u32>(&others)
        );
    };
    let still = (0..SETTLED).filter(|_| {
        both(Pose::IDENTITY, Pose::IDENTITY);
        noting.is_still()
    });
    assert!(still.count() > 5);
    assert!(!not.is_still());
    let mut pose = Pose::IDENTITY;
    for n in 0..8 {
        let next = at(pose.position.x + 0.003, 0.0, 0.0);
        both(pose, next);
        assert!(!noting.is_still(), "{n}");
        assert_eq!(noting.awake().unwrap(), 500);
        pose = next;
    }
}

/// What a cloth takes up leaves the liquid that is awake: each particle is there once, and the others go on.
#[test]
fn what_is_wiped_up_takes_none_along() {
    let gpu = gpu::device();
    for lanes in lanes(&gpu) {
        let x = |n: u32| 0.2 + 0.1 * f64::from(n);
        let mut particles = still();
        particles.extend((0..40).map(|n| drop_at(DVec3::new(x(n), 1.0, 0.0), DVec3::ZERO)));
        let mut setup = glass(particles, lanes);
        setup.tools = true;
        let solver = setup.solver(&gpu);
        let poses = [Pose::IDENTITY];
        frames(&gpu, &solver, &poses, 3);
        let cloth = Touch {
            ends: [0.5, 1.5].map(|y| Vec3::new(x(20) as f32, y, 0.0)),
            velocities: [Vec3::ZERO; 2],
            radius: 0.03,
            wipes: true,
        };
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        solver.handle(&mut rec, &cloth, FRAME).unwrap();
        solver.record(&mut rec, &poses, &poses).unwrap();
        gpu.submit(rec).unwrap().wait().unwrap();
        frames(&gpu, &solver, &poses, 10);
        let state = solver.snapshot().unwrap();
        let mut found: Vec<_> = state.tags.iter().map(|tag| tag[1]).collect();
        found.sort_unstable();
        assert!(found.into_iter().eq(0..540), "{lanes} lanes");
        // Taken out, it is in no pass.
        assert_eq!(solver.awake().unwrap(), 539);
        let gone = (0..540).filter(|&slot| !state.is_present(slot));
        assert_eq!(
            gone.map(|slot| state.tags[slot][1]).collect::<Vec<_>>(),
            [520]
        );
        // 14 frames of its fall are 0.12 m.
        let falls = |slot: &usize| state.tags[*slot][0] == 0 && state.positions[*slot][1] < 0.92;
        assert_eq!((0..540).filter(falls).count(), 39, "{lanes} lanes");
    }
}

/// The pass of turnovers is dormant while all sleeps, and runs for liquid that wakes up with fast eddies: the same bits as if it always ran.
#[test]
fn what_wakes_up_swaps_as_with_all_passes() {
    let gpu = gpu::device();
    let run = |dormant: bool| {
        let p = Parameters {
            dormant,
            ..with(Chemistry::Physical(with_bubbles()), calm())
        };
        let setup = Setup::new(p, vec![narrow_glass()], glass_of(500, |_| (20.0, 0.98)));
        let solver = setup.solver(&gpu);
        fall_asleep(&gpu, &solver, &[Pose::IDENTITY], 0);
        let mut state = solver.snapshot().unwrap();
        for (slot, eddies) in state.eddies.iter_mut().enumerate() {
            eddies[0] = 1e-3 * (1.0 + slot as f32 / 500.0);
        }
        solver.restore(&state).unwrap();
        frames(&gpu, &solver, &[Pose::IDENTITY], 4);
        assert_eq!(solver.awake().unwrap(), 0);
        assert_eq!(solver.dormant().unwrap().turnover, dormant);
        frame(&gpu, &solver, &[Pose::IDENTITY], &[at(0.0, 5e-4, 0.0)]);
        assert_eq!(solver.awake().unwrap(), 500);
        solver.snapshot().unwrap()
    };
    let [with, without] = [true, false].map(run);
    assert!(with == without);
}
