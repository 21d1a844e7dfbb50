//! Acid under water mixes no faster than molecules while it is left alone, and no more than is paid for when
//! it is stirred.

use super::setup::*;
use crate::common::*;
use std::f64::consts::PI;
use vitriol_sim::chemistry::ACID_DIFFUSIVITY;
use vitriol_sim::chemistry::eddies::Mixing;
use vitriol_sim::chemistry::table::SolutionTable;
use vitriol_sim::chemistry::{Chemistry, Physical};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::SolverState;
use vitriol_tests::gpu;

/// A lower half of 50 % acid, an upper one of 30 %, with the other features of the scenes, but without losses and boiling.
fn layers(turbulence: f64) -> (Parameters, Setup) {
    let law = Physical {
        density: true,
        viscosity: true,
        mixing: Mixing {
            turbulence,
            ..Mixing::default()
        },
        ..mixing_alone()
    };
    let p = with(Chemistry::Physical(law), parameters());
    let particles = glass_of(700, |height| (20.0, if height < 0.5 { 0.5 } else { 0.3 }));
    (p.clone(), Setup::new(p, vec![narrow_glass()], particles))
}

/// Acid that is above where it was, kg: of the particles that were of the upper layer.
fn risen(state: &SolverState, start: &SolverState, unit: f64) -> f64 {
    let by_start = by_identity(start, &start.matter);
    let now = by_identity(state, &state.matter);
    let gained = now
        .iter()
        .zip(&by_start)
        .filter(|(_, first)| first[0] < 0.4);
    unit * gained
        .map(|(now, first)| now[0] * now[3] - first[0] * first[3])
        .sum::<f64>()
}

/// Molecules alone bring ρΔc·√(Dt/π) of acid across unit area (Crank 1975, Eq. 2.14). Particles of 2.5 mm do
/// not resolve that and bring less, as much as without any eddies; what jitters between them would bring a
/// hundred times as much.
fn mix_no_faster_than_molecules(time: f64) {
    let device = gpu::device();
    let [found, molecules] = [Mixing::default().turbulence, 0.0].map(|turbulence| {
        let (p, setup) = layers(turbulence);
        let solver = setup.solver(&device);
        // Until the filling has come to rest.
        frames(&device, &solver, &[Pose::IDENTITY], 90);
        let start = solver.snapshot().unwrap();
        let count = (time / p.frame_time) as usize;
        frames(&device, &solver, &[Pose::IDENTITY], count);
        risen(&solver.snapshot().unwrap(), &start, p.particle_mass())
    });
    let area = PI * 0.013 * 0.013;
    let table = SolutionTable::new();
    let density = 0.5 * (table.at(0.3).density_at(20.0) + table.at(0.5).density_at(20.0));
    let most = density * 0.2 * (ACID_DIFFUSIVITY * time / PI).sqrt() * area;
    let case = format!("{found} and {molecules} of {most} kg");
    assert!(molecules > 0.0 && molecules < most, "{case}");
    // A fifth of what molecules may bring, for eddies where the layers' surface is not level.
    assert!(found - molecules < 0.2 * most, "{case}");
}

#[test]
fn layers_at_rest_mix_no_faster_than_molecules() {
    mix_no_faster_than_molecules(1.5);
}

/// Potential energy (J) that mixing alone may change: that of the least heavy order of what there is, acid
/// lowest, stacked in level layers (Winters et al. 1995). The bowl that a turning liquid makes is not in it, nor
/// what heat of mixing and contraction do to volumes.
fn background(state: &SolverState, unit: f64) -> f64 {
    let table = SolutionTable::new();
    let density = |acid: f64| table.at(acid).density_at(20.0);
    let mean = density(0.4);
    let heavier = (density(0.5) - density(0.3)) / (0.2 * mean);
    let mut acids: Vec<[f64; 2]> = state
        .matter
        .iter()
        .map(|matter| [f64::from(matter[0]), unit * f64::from(matter[3])])
        .collect();
    acids.sort_by(|a, b| b[0].total_cmp(&a[0]));
    let area = PI * 0.013 * 0.013;
    let (mut level, mut energy) = (0.0, 0.0);
    for [acid, mass] in acids {
        let rise = mass / (mean * area);
        energy += 9.81 * mass * (1.0 + heavier * (acid - 0.4)) * (level + 0.5 * rise);
        level += rise;
    }
    energy
}

/// Layers that turn against each other mix where their shear passes what stratification bears, and gain less
/// potential energy by it than they were given in motion.
///
/// Over 6 mm N² is 280 1/s², and N²/Pr is met by a shear of 20 1/s: by some 10 rad/s.
fn pays_for_what_it_lifts(cases: &[(f32, bool)]) {
    let device = gpu::device();
    for &(turning, mixes) in cases {
        let mut given = 0.0;
        let [mixed, unmixed] = [Mixing::default().turbulence, 0.0].map(|turbulence| {
            let (p, setup) = layers(turbulence);
            let solver = setup.solver(&device);
            frames(&device, &solver, &[Pose::IDENTITY], 45);
            let mut state = solver.snapshot().unwrap();
            let start = state.clone();
            let unit = p.particle_mass();
            given = 0.0;
            for slot in 0..state.tags.len() {
                let [x, _, z, _] = state.positions[slot];
                let turning = if state.matter[slot][0] < 0.4 {
                    turning
                } else {
                    -turning
                };
                state.velocities[slot][0] = turning * z;
                state.velocities[slot][2] = -turning * x;
                let square = f64::from(turning * turning * (x * x + z * z));
                given += 0.5 * unit * state.mass_of(slot) * square;
            }
            solver.restore(&state).unwrap();
            frames(&device, &solver, &[Pose::IDENTITY], 60);
            let state = solver.snapshot().unwrap();
            let potential = background(&state, unit) - background(&start, unit);
            (potential, risen(&state, &start, unit))
        });
        let gained = mixed.0;
        let case = format!("{turning} rad/s: {gained} J of {given} J, {mixed:?} {unmixed:?}");
        if mixes {
            assert!(mixed.1 > 100.0 * unmixed.1 && gained > 0.0, "{case}");
        } else {
            assert!(mixed.1 < 10.0 * unmixed.1, "{case}");
        }
        assert!(gained < given, "{case}");
    }
}

#[test]
fn stirring_pays_for_what_it_lifts() {
    pays_for_what_it_lifts(&[(4.0, false), (20.0, true)]);
}

mod long {
    use super::*;

    #[test]
    fn layers_at_rest_for_long_mix_no_faster_than_molecules() {
        mix_no_faster_than_molecules(4.0);
    }

    #[test]
    fn wild_stirring_pays_for_what_it_lifts() {
        pays_for_what_it_lifts(&[(40.0, true)]);
    }
}
