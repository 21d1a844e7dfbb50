//! Drops from a wetted nozzle, against Tate's law with Harkins and Brown's correction.

use crate::common::*;
use crate::tension::tense;
use glam::{DVec3, Quat, Vec3};
use std::f64::consts::{PI, TAU};
use vitriol_gpu::Gpu;
use vitriol_sim::flask::Profile;
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::{Ground, SolverState};
use vitriol_sim::surface_tension::{SurfaceTension, WATER};
use vitriol_tests::gpu;

/// ρg of water, N/m³.
const WEIGHT: f64 = 1000.0 * 9.81;

/// Harkins and Brown 1919: the share of Tate's drop that falls, over r/V^⅓.
const FALLS: [(f64, f64); 10] = [
    (0.3, 0.726),
    (0.4, 0.683),
    (0.5, 0.652),
    (0.6, 0.625),
    (0.7, 0.609),
    (0.8, 0.600),
    (0.9, 0.600),
    (1.0, 0.610),
    (1.1, 0.628),
    (1.2, 0.654),
];

/// Volume (m³) of the drops that fall from a wetted nozzle of `radius` (m), fed with `flow` (m³/s). Without flow ρgV = 2πrσ·f;
/// what comes after while the neck gives way is Scheele and Meister's term (1968), 4.5 (Q²D²ρσ/(ρg)²)^⅓ beside 2πrσ/(ρg).
fn falling(radius: f64, flow: f64) -> f64 {
    let comes_after = (2.0 * radius * flow / WEIGHT).powi(2) * 1000.0 * WATER;
    let all = TAU * radius * WATER / WEIGHT + 4.5 * comes_after.cbrt();
    let mut volume = 0.6 * all;
    for _ in 0..50 {
        let ratio = radius / volume.cbrt();
        let k = FALLS.iter().take_while(|&&(at, _)| at < ratio).count();
        let [(a, low), (b, high)] = [FALLS[k.clamp(1, 9) - 1], FALLS[k.clamp(1, 9)]];
        volume = all * (low + (ratio - a) / (b - a) * (high - low));
    }
    volume
}

/// Where drops are counted, and where what fell lies, m.
const PASSED: f32 = -0.03;
const FLOOR: f64 = -0.3;
/// Length of the nozzle's tube, how much of it is full at the start, and its wall, m: an edge thinner than some particles holds no line.
const TUBE: f64 = 0.02;
const FILLED: f64 = 0.004;
const WALL: f64 = 1.2e-3;
/// Contact angle of the nozzle, degrees.
const ANGLE: f64 = 60.0;
/// Time between two feedings, and without anything that falls after a drop, s.
const STEP: f64 = 1.0 / 120.0;
const PAUSE: f64 = 0.15;

/// A lattice of `spacing` that fills a disc from height `base` on, layer by layer.
fn disc_layers(radius: f64, spacing: f64, base: f64) -> impl Iterator<Item = DVec3> {
    let reach = (radius / spacing) as i32 + 1;
    let side = (-reach..reach).flat_map(move |x| (-reach..reach).map(move |z| (x, z)));
    let layer: Vec<_> = side
        .map(|(x, z)| (f64::from(x) + 0.5, f64::from(z) + 0.5))
        .filter(|&(x, z)| x.hypot(z) < radius / spacing - 0.5)
        .collect();
    (0..).flat_map(move |k| {
        let y = base + (f64::from(k) + 0.5) * spacing;
        let at = move |(x, z)| DVec3::new(x * spacing, y, z * spacing);
        layer.clone().into_iter().map(at)
    })
}

/// Puts `count` particles that have fallen onto the liquid in the tube.
fn feed(state: &mut SolverState, count: usize, radius: f64, spacing: f64) {
    let inside = (0..state.tags.len()).filter(|&slot| state.flask_of(slot).is_some());
    let heights = inside.map(|slot| state.positions[slot][1]);
    let top = heights.fold(0.0, f32::max);
    let is_down =
        |&slot: &usize| state.flask_of(slot).is_none() && state.positions[slot][1] < 2.0 * PASSED;
    let fallen = (0..state.tags.len()).filter(is_down).take(count);
    let fallen: Vec<_> = fallen.collect();
    assert_eq!(fallen.len(), count, "nothing is left to feed");
    let places = disc_layers(radius, spacing, f64::from(top) + 0.5 * spacing);
    for (slot, at) in fallen.into_iter().zip(places) {
        state.positions[slot] = [at.x as f32, at.y as f32, at.z as f32, 0.0];
        state.velocities[slot] = [0.0; 4];
        state.tags[slot][0] = 1;
    }
}

/// A nozzle that is a tube with its mouth down, and what will fall lying below.
fn nozzle(diameter: f64, spacing: f64) -> (Setup, Pose) {
    let (outer, inner) = (0.5 * diameter, 0.5 * diameter - WALL);
    let profile = Profile::new(&[[0.0, inner], [TUBE, inner]], WALL).unwrap();
    let upside_down = Quat::from_rotation_x(PI as f32);
    let pose = Pose::new(Vec3::Y * profile.rim_height() as f32, upside_down);
    let cell = spacing.powi(3);
    let tube = disc_layers(inner, spacing, 0.0).take_while(|at| at.y < FILLED);
    let mut start: Vec<_> = tube.map(|at| drop_at(at, DVec3::ZERO)).collect();
    start.iter_mut().for_each(|p| p.flask = Some(0));
    let needed = (2.5 * falling(outer, 0.0) / cell) as usize;
    let bank = disc_layers(2.0 * outer, spacing, FLOOR).take(needed);
    start.extend(bank.map(|at| drop_at(at, DVec3::ZERO)));
    let support = 2.0 * spacing;
    let longest = (1000.0 * cell / (TAU * WATER)).sqrt();
    let p = Parameters {
        gravity: [0.0, -9.81, 0.0],
        frame_time: STEP,
        substeps: (STEP / (0.7 * longest)).ceil() as u32,
        carry_rate: 2.25,
        // ν of water, as XSPH has it.
        viscosity: (1e-6 / (6.75 * support * support)).min(1.0),
        surface: Some(SurfaceTension {
            glass: vec![ANGLE.to_radians()],
            ..SurfaceTension::new(WATER)
        }),
        ..tense(spacing)
    };
    let setup = Setup {
        ground: Ground {
            floor: FLOOR,
            table: None,
            scale: 1.0,
        },
        lanes: None,
        ..Setup::new(p, vec![profile], start)
    };
    (setup, pose)
}

/// The drop that falls from a nozzle `diameter` (m) wide outside, of particles `spacing` wide, fed so that one would fall in `period`
/// seconds, its satellites with it: the first, as those after it are within 2 % of it. Its volume over Harkins and Brown's, and over what
/// that is at this flow.
fn drop_of(device: &Gpu, diameter: f64, spacing: f64, period: f64) -> [f64; 2] {
    let (setup, pose) = nozzle(diameter, spacing);
    let solver = setup.solver(device);
    let (radius, cell) = (0.5 * diameter, spacing.powi(3));
    let expected = falling(radius, 0.0) / cell;
    let rate = expected / period * STEP;
    let (mut fed, mut now, mut last) = (0, 0.0, 0.0);
    let mut current = 0usize;
    let mut before = usize::MAX;
    while now < 6.0 * period {
        frame(device, &solver, &[pose], &[pose]);
        now += STEP;
        let mut state = solver.snapshot().unwrap();
        let below = (0..state.tags.len()).filter(|&slot| state.positions[slot][1] < PASSED);
        let below = below.count();
        if below > before {
            current += below - before;
            last = now;
        }
        if current as f64 > 0.2 * expected && now - last > PAUSE {
            let volume = current as f64 * cell;
            let flow = rate / STEP * cell;
            let of = [0.0, flow].map(|flow| volume / falling(radius, flow));
            eprintln!("{diameter} m, {spacing} m, {now:.2} s: {volume} m³, {of:?}");
            return of;
        }
        let due = (now / STEP * rate) as usize - fed;
        // In fours, so that it falls by a layer and not one by one.
        let due = due - due % 4;
        before = below - due;
        if due > 0 {
            feed(&mut state, due, radius - WALL, spacing);
            solver.restore(&state).unwrap();
            fed += due;
        }
    }
    panic!("no drop falls");
}

/// 10 %, of what falls at this flow; a fifth more than without flow.
#[test]
fn a_coarse_nozzles_drop_weighs_what_harkins_and_brown_found() {
    let [_, of] = drop_of(&gpu::device(), 6e-3, 0.75e-3, 0.5);
    assert!((of - 1.0).abs() < 0.1, "{of}");
}

/// Slowly, so that the flow adds no more than a twentieth.
#[test]
#[ignore = "minutes on a graphics card; 4 and 8 mm miss, see docs/measurements/solver.md"]
fn slow_drops_weigh_what_harkins_and_brown_found() {
    let device = gpu::device();
    let cases = [(4e-3, 0.25e-3), (6e-3, 0.3e-3), (8e-3, 0.4e-3)];
    let found = cases.map(|(diameter, spacing)| drop_of(&device, diameter, spacing, 8.0));
    for [of, _] in found {
        assert!((of - 1.0).abs() < 0.1, "{found:?}");
    }
}

mod long {
    use super::*;

    /// 10 %, of what falls at this flow; a sixth more than without flow.
    #[test]
    fn a_nozzles_drop_weighs_what_harkins_and_brown_found() {
        let [_, of] = drop_of(&gpu::device(), 6e-3, 0.5e-3, 1.5);
        assert!((of - 1.0).abs() < 0.1, "{of}");
    }
}
