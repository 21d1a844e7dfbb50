//! Dew of whole solvers: over liquid that boils, on its vessel alone, and with the same bits.

use super::bubbles::beaker;
use super::bubbly_liquid::kettle;
use super::setup::*;
use crate::common::*;
use vitriol_sim::chemistry::Chemistry;
use vitriol_sim::chemistry::dew::{AROUND, UP};
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::{Solver, SolverState};
use vitriol_tests::gpu;

const PLACES: usize = AROUND * UP;

/// A kettle that loses heat, and an empty one like it beside it. It has 103 °C: at 108 its vapour throws out most of the liquid, and there
/// is no level.
fn kettles() -> (Setup, [Pose; 2]) {
    let mut setup = kettle(0.002, 4096);
    setup.particles = beaker(103.0, bubbly()).particles;
    setup.particles.truncate(3400);
    if let Some(Chemistry::Physical(law)) = &mut setup.parameters.chemistry {
        law.losses = built_in().losses;
    }
    setup.flasks.push(setup.flasks[0].clone());
    (setup, [Pose::IDENTITY, at(0.2, 0.0, 0.0)])
}

fn film(state: &SolverState, place: usize) -> f64 {
    state.dew()[place].film.into()
}

#[test]
fn dew_is_over_what_boils_and_nowhere_else() {
    let device = gpu::device();
    let (setup, poses) = kettles();
    let solver = setup.solver(&device);
    // Dew under the liquid is washed off in the first frame.
    let mut state = solver.snapshot().unwrap();
    for place in &mut state.dew_mut()[..PLACES] {
        place.water = 1_000_000;
    }
    solver.restore(&state).unwrap();
    frames(&device, &solver, &poses, 1);
    let state = solver.snapshot().unwrap();
    let level = particles(&state)
        .iter()
        .fold(0.0_f64, |top, p| top.max(p.position.y));
    let profile = &setup.flasks[0];
    let row_of = |y: f64| {
        let (floor, rim) = (profile.floor_height(), profile.rim_height());
        ((y - floor) / (rim - floor) * UP as f64) as usize
    };
    let (low, high) = (row_of(level - 0.006), row_of(level + 0.006) + 1);
    let dry = |rows: std::ops::Range<usize>| {
        let places = rows.start * AROUND..rows.end * AROUND;
        places
            .filter(|&place| state.dew()[place].water == 0)
            .count()
    };
    assert!(low > 2 && high + 3 < UP, "{low} {high}");
    let under = dry(0..low) as f64 / (low * AROUND) as f64;
    assert!(under > 0.98, "{under} of what is under liquid");
    assert_eq!(dry(high..UP), 0);
    // And steam brings it back over the liquid, on this vessel alone.
    let mut state = state;
    for place in state.dew_mut() {
        *place = Default::default();
    }
    solver.restore(&state).unwrap();
    let mut widest = 0.0_f64;
    for _ in 0..9 {
        frames(&device, &solver, &poses, 5);
        state = solver.snapshot().unwrap();
        let radii = state
            .bubbles()
            .iter()
            .map(|bubble| f64::from(bubble.radius));
        widest = radii.map(|radius| 2.0 * radius).fold(widest, f64::max);
    }
    let sum = |places: std::ops::Range<usize>| places.map(|p| film(&state, p)).sum::<f64>();
    let (over, other) = (sum(low * AROUND..PLACES), sum(PLACES..2 * PLACES));
    let steam = state.mist();
    eprintln!(
        "{over} kg/m² over {} places, {steam} kg of mist, {} kg of dew",
        PLACES - low * AROUND,
        state.dew_mass()
    );
    assert!(over > 0.0 && other == 0.0, "{over} {other}");
    // A bubble at the wall lays bare as much of it as it is wide, for a moment: few places down to there have any, and none further down.
    let deep = row_of(level - 0.006 - widest);
    let bare = state.dew()[..low * AROUND].iter();
    let bare = bare.filter(|place| place.water > 0).count();
    let under = sum(0..deep * AROUND);
    eprintln!(
        "{widest} m is the widest bubble; {bare} places of {}",
        low * AROUND
    );
    assert!(deep > 0 && bare * 10 < low * AROUND, "{deep} {bare}");
    assert!(under < 0.02 * over);
}

fn run(solver: &Solver, device: &vitriol_gpu::Gpu, poses: &[Pose], count: usize) -> SolverState {
    frames(device, solver, poses, count);
    solver.snapshot().unwrap()
}

mod long {
    use super::*;

    #[test]
    fn dew_has_the_same_bits_again_and_on_a_new_device() {
        let device = gpu::device();
        let (setup, poses) = kettles();
        let solver = setup.solver(&device);
        let middle = run(&solver, &device, &poses, 20);
        assert!(middle.dew_mass() > 0.0);
        let end = run(&solver, &device, &poses, 4);
        assert_ne!(end.dew_mass(), middle.dew_mass());
        assert!(run(&setup.solver(&device), &device, &poses, 24) == end);
        let bytes = postcard::to_allocvec(&middle).unwrap();
        drop(solver);
        let device = gpu::another_device(|_| {});
        let solver = setup.solver(&device);
        let stored: SolverState = postcard::from_bytes(&bytes).unwrap();
        solver.restore(&stored).unwrap();
        assert!(run(&solver, &device, &poses, 4) == end);
    }
}
