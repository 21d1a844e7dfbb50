//! Anti-viscosity of the paper's chemistry (Eq. 17).

use super::setup::*;
use crate::common::*;
use vitriol_sim::chemistry::PaperBoiling;
use vitriol_sim::chemistry::paper::{Boiling, REFERENCE_POWER};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::SolverState;
use vitriol_tests::gpu;

/// The stated power at 150 °C and k_v = 0.2: (0.2·0.5)²·P₀, W/kg; more, and α
/// would be at its bound.
const POWER: f64 = 0.01 * REFERENCE_POWER;

/// Boiling of that power, or Eq. 17 as printed with k_v = 1.
fn weak(law: Boiling) -> PaperBoiling {
    let intensity = match law {
        Boiling::Power => 0.2,
        Boiling::Literal => 1.0,
    };
    PaperBoiling {
        intensity,
        ..anti_viscosity(law)
    }
}

/// Soup at 150 °C without weight, too thin to push: line 27 is alone.
fn soup(law: Boiling, substeps: u32, speed: f64) -> Setup {
    let p = Parameters {
        substeps,
        gravity: [0.0; 3],
        ..with(
            paper(None, Some(weak(law))),
            Parameters::from_scene(&Scene::builtin("tomato-soup").unwrap()),
        )
    };
    let mut particles = loose(9, p.spacing, &mut Random(5), speed);
    fill(&mut particles, |_| (150.0, 0.0));
    Setup::new(p, Vec::new(), particles)
}

/// ½ Σ v², J/kg.
fn energy(state: &SolverState) -> f64 {
    let squares = sum(&state.velocities, |[x, y, z, _]| x * x + y * y + z * z);
    0.5 * squares / state.velocities.len() as f64
}

/// Kinetic energy that two frames add, J/kg, once each particle has the agitation of the motion
/// around it, `speed` m/s at the start.
fn gain(law: Boiling, substeps: u32, speed: f64) -> f64 {
    let device = gpu::device();
    let solver = soup(law, substeps, speed).solver(&device);
    let mut state = solver.snapshot().unwrap();
    state.heat.iter_mut().for_each(|row| row[2] = 1e30);
    solver.restore(&state).unwrap();
    frames(&device, &solver, &[], 1);
    let before = energy(&solver.snapshot().unwrap());
    frames(&device, &solver, &[], 2);
    assert_eq!(solver.counters().unwrap().speed_limited, 0);
    energy(&solver.snapshot().unwrap()) - before
}

#[test]
fn the_stated_power_is_injected_whatever_the_substeps() {
    let stated = POWER * 2.0 / 60.0;
    for substeps in 2..=8 {
        let gained = gain(Boiling::Power, substeps, 1.0);
        assert!(
            (gained / stated - 1.0).abs() < 0.2,
            "{substeps}: {gained} {stated}"
        );
    }
}

#[test]
fn the_literal_equation_depends_on_the_substeps() {
    let gains = [2, 8].map(|substeps| gain(Boiling::Literal, substeps, 1.0));
    assert!(gains[1] > 4.0 * gains[0] && gains[0] > 0.0, "{gains:?}");
}

/// One substep a frame, from nearly at rest and from a storm.
#[test]
fn one_substep_stays_bounded() {
    let stated = POWER * 2.0 / 60.0;
    for speed in [0.01, 0.3, 1.0, 2.0, 4.0] {
        let gained = gain(Boiling::Power, 1, speed);
        // By half more than stated: e_i is that of a frame ago, in which a
        // particle goes by more than its spacing.
        assert!(gained < 1.5 * stated, "{speed}: {gained} {stated}");
    }
    // A second of it.
    let device = gpu::device();
    let solver = soup(Boiling::Power, 1, 0.01).solver(&device);
    frames(&device, &solver, &[], 60);
    let end = energy(&solver.snapshot().unwrap());
    assert!(end < POWER, "{end}");
}
