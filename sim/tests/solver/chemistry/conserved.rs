//! Σ m·c does not drift, whether the liquid is stirred or at rest; nothing
//! leaves the range of what it came from.

use super::setup::*;
use crate::common::*;
use vitriol_sim::chemistry::paper::Boiling;
use vitriol_sim::chemistry::{Chemistry, PaperDilution};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::{Solver, SolverState};
use vitriol_tests::gpu;

fn acid(state: &SolverState) -> f64 {
    if state.matter.is_empty() {
        sum(&state.heat, |row| row[1])
    } else {
        sum(&state.matter, |row| row[0] * row[3])
    }
}

fn in_range(state: &SolverState) -> bool {
    let acid = |rows: &[[f32; 4]], k: usize| rows.iter().all(|r| (0.0..=1.0).contains(&r[k]));
    acid(&state.heat, 1) && acid(&state.matter, 0)
}

fn half_acid(chemistry: Chemistry, lanes: u32) -> Setup {
    let particles = glass_of(400, |height| {
        // Warm, so that the physical one boils where they meet.
        (60.0, if height < 0.4 { 0.98 } else { 0.0 })
    });
    let p = with(chemistry, parameters());
    Setup {
        lanes: Some(lanes),
        ..Setup::new(p, vec![narrow_glass()], particles)
    }
}

fn chemistries() -> [Chemistry; 2] {
    let boils = anti_viscosity(Boiling::Power);
    [
        paper(Some(dilution()), Some(boils)),
        Chemistry::Physical(boiling()),
    ]
}

fn no_list_was_full(solver: &Solver) {
    let counters = solver.counters().unwrap();
    assert_eq!((counters.list_overflows, counters.nan_particles), (0, 0));
}

/// 300 substeps, with another velocity for every particle in each frame.
#[test]
fn acid_does_not_drift_where_the_liquid_is_stirred() {
    let device = gpu::device();
    for lanes in lanes(&device) {
        for chemistry in chemistries() {
            let solver = half_acid(chemistry, lanes).solver(&device);
            let start = solver.snapshot().unwrap();
            let mut random = Random(4);
            for _ in 0..25 {
                stir(&device, &solver, &mut random, 0.5);
            }
            no_list_was_full(&solver);
            let end = solver.snapshot().unwrap();
            let drift = acid(&end) / acid(&start) - 1.0;
            assert!(drift.abs() < 1e-6, "{lanes}: {drift}");
            assert!(in_range(&end));
            // It boiled on the way.
            let vapour = sum(&end.matter, |[_, _, vapour, mass]| vapour * mass);
            assert!(vapour > 0.01 || end.matter.is_empty(), "{lanes}: {vapour}");
        }
    }
}

/// Acid under water, both nearly at rest: what diffuses in a substep is below
/// the last bit of the one and not of the other.
#[test]
fn acid_does_not_drift_where_hardly_any_diffuses() {
    let device = gpu::device();
    let slow = PaperDilution {
        heat_diffusivity: 1.4e-7,
        acid_diffusivity: 1.7e-9,
        ..dilution()
    };
    for (chemistry, gravity) in [
        (paper(Some(slow), None), 0.0),
        (Chemistry::Physical(mixing_alone()), 0.0),
        // With its weight, the light one floats, until it boils.
        (Chemistry::Physical(boiling()), -9.81),
    ] {
        let mut setup = half_acid(chemistry, 1);
        setup.parameters.gravity = [0.0, gravity, 0.0];
        let solver = setup.solver(&device);
        let start = solver.snapshot().unwrap();
        frames(&device, &solver, &[Pose::IDENTITY], 40);
        let end = solver.snapshot().unwrap();
        let drift = acid(&end) / acid(&start) - 1.0;
        let gained = end.heat.iter().filter(|row| row[1] > 0.0 && row[1] < 0.1);
        let gained = gained.count();
        // Water next to the acid has gained some.
        assert!(gained > 40 || gravity != 0.0, "{gained}");
        // The sum is of numbers that were rounded once, at the end.
        assert!(drift.abs() < 5e-8, "{drift}");
        no_list_was_full(&solver);
    }
}

/// D from nothing to a hundred times what an explicit step of Eq. 5 bears.
#[test]
fn no_diffusivity_makes_new_extremes() {
    let device = gpu::device();
    let p = Parameters {
        substeps: 4,
        ..parameters()
    };
    let exchange = p.exchange(p.list_capacity());
    let lattice: f64 = (0..125)
        .map(|i| [i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2].map(|k: i32| (k * k) as f64))
        .map(|[x, y, z]| exchange.coefficient(D * (x + y + z).sqrt()))
        .sum();
    // Σ K = 1: a particle's own value is gone.
    let explicit = 1.0 / (p.substep_time() * lattice);
    for times in [0.0, 0.05, 1.0, 3.0, 10.0, 100.0] {
        let law = PaperDilution {
            heat_diffusivity: times * explicit,
            acid_diffusivity: times * explicit,
            // No heat of solution: nothing may be hotter than the hottest liquid at the start.
            heat_generation: 0.0,
            ..dilution()
        };
        let p = with(paper(Some(law), None), p.clone());
        let particles = glass_of(400, |height| {
            if height < 0.5 {
                (80.0, 0.98)
            } else {
                (20.0, 0.1)
            }
        });
        let solver = Setup::new(p, vec![narrow_glass()], particles).solver(&device);
        frames(&device, &solver, &[Pose::IDENTITY], 6);
        let state = solver.snapshot().unwrap();
        for &[temperature, acid, ..] in &state.heat {
            // A weighted mean of old values, each rounded.
            let bounds = (20.0 - 1e-4..=80.0 + 1e-4, 0.1 - 1e-6..=0.98 + 1e-6);
            assert!(bounds.0.contains(&temperature), "{times}: {temperature}");
            assert!(bounds.1.contains(&acid), "{times}: {acid}");
        }
        let limited = solver.counters().unwrap().diffusion_limited;
        assert_eq!(limited > 0, times > 0.5, "{times}: {limited}");
        let spread = state.heat.iter().fold([1.0f32, 0.0], |[low, high], row| {
            [low.min(row[1]), high.max(row[1])]
        });
        assert_eq!(spread[0] == 0.1 && spread[1] == 0.98, times == 0.0);
    }
}

/// The physical chemistry's exchange makes no new extremes either, in contrast to [`no_diffusivity_makes_new_extremes`] in a liquid of one
/// composition, part of it hot, whose eddies mix up to ten thousand times as fast as they should.
#[test]
fn no_eddies_make_new_extremes() {
    let device = gpu::device();
    for times in [0.0, 1.0, 1e4] {
        let mut law = mixing_alone();
        law.mixing.turbulence *= times;
        let p = with(Chemistry::Physical(law), parameters());
        let particles = glass_of(400, |height| (if height < 0.5 { 80.0 } else { 20.0 }, 0.4));
        let solver = Setup::new(p, vec![narrow_glass()], particles).solver(&device);
        let mut random = Random(6);
        for _ in 0..4 {
            stir(&device, &solver, &mut random, 0.5);
        }
        let state = solver.snapshot().unwrap();
        for &[temperature, acid, ..] in &state.heat {
            // T is found from h, whose last bit is 0.03 J/kg: 1e-5 K in each
            // of 48 substeps.
            let range = 20.0 - 1e-3..=80.0 + 1e-3;
            assert!(range.contains(&temperature), "{times}: {temperature}");
            assert!((acid - 0.4).abs() < 1e-6, "{times}: {acid}");
        }
        let limited = solver.counters().unwrap().diffusion_limited;
        // As fast as they should, they mix less than pairs may swap.
        assert_eq!(limited > 0, times > 1.0, "{times}: {limited}");
    }
}
