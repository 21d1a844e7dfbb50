//! A feature that is on and has nothing to do leaves the motion as it is, bit
//! for bit.

use super::setup::*;
use crate::common::*;
use vitriol_sim::chemistry::eddies::Mixing;
use vitriol_sim::chemistry::paper::Boiling;
use vitriol_sim::chemistry::table::SolutionTable;
use vitriol_sim::chemistry::transport::Losses;
use vitriol_sim::chemistry::{Chemistry, PaperBoiling, Physical};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::SolverState;
use vitriol_tests::gpu;

/// Water of 20 °C in a glass, shaken, after two frames.
fn shaken(p: Parameters, temperature: f64, acid: f64, lanes: u32) -> SolverState {
    let device = gpu::device();
    let mut random = Random(8);
    let mut particles = glass_of(300, |_| (temperature, acid));
    for particle in &mut particles {
        particle.velocity = random.point(0.3);
    }
    let setup = Setup {
        lanes: Some(lanes),
        ..Setup::new(p, vec![narrow_glass()], particles)
    };
    let solver = setup.solver(&device);
    frames(&device, &solver, &[Pose::IDENTITY], 2);
    solver.snapshot().unwrap()
}

fn same_motion(a: &SolverState, b: &SolverState, what: &str) {
    assert_eq!(a.tags, b.tags, "{what}");
    let bits = |rows: &[[f32; 4]]| -> Vec<[u32; 4]> {
        rows.iter().map(|row| row.map(f32::to_bits)).collect()
    };
    assert!(bits(&a.positions) == bits(&b.positions), "{what}");
    assert!(bits(&a.velocities) == bits(&b.velocities), "{what}");
}

#[test]
fn paper() {
    use super::setup::paper;
    // As printed, Eq. 17 is another viscosity altogether: μ₀ per substep.
    let boils = anti_viscosity(Boiling::Power);
    let still = PaperBoiling {
        intensity: 0.0,
        ..boils
    };
    for lanes in lanes(&gpu::device()) {
        let of = |chemistry: Option<Chemistry>, temperature: f64| {
            shaken(with(chemistry, parameters()), temperature, 0.0, lanes)
        };
        let none = of(None, 20.0);
        let both = of(Some(paper(Some(dilution()), Some(boils))), 20.0);
        same_motion(&none, &both, "both");
        assert!(both.heat.iter().all(|row| row[..2] == [20.0, 0.0]));
        if lanes == 1 {
            let cold = of(Some(paper(None, Some(boils))), 99.0);
            same_motion(&none, &cold, "boiling below T_B");
            let still = of(Some(paper(None, Some(still))), 99.0);
            same_motion(&none, &still, "k_v = 0");
            let uniform = of(Some(paper(Some(dilution()), None)), 20.0);
            same_motion(&none, &uniform, "dilution of water in water");
        }
    }
}

#[test]
fn physical() {
    for lanes in lanes(&gpu::device()) {
        let of = |law: Physical| {
            shaken(
                with(Chemistry::Physical(law), parameters()),
                20.0,
                0.3,
                lanes,
            )
        };
        let none = shaken(with(None, parameters()), 20.0, 0.3, lanes);
        // Eddies carry momentum too, whatever they mix.
        let mixing = Mixing {
            turbulence: 0.0,
            ..Mixing::default()
        };
        let of = |law: Physical| of(Physical { mixing, ..law });
        let plain = of(mixing_alone());
        same_motion(&none, &plain, "mixing of a liquid with itself");
        let evaporation = Physical {
            superheat_time: Some(0.01),
            ..mixing_alone()
        };
        let lossy = Physical {
            losses: Some(Losses::to_air(20.0)),
            ..mixing_alone()
        };
        let idle = of(evaporation);
        same_motion(&plain, &idle, "evaporation below the boiling point");
        assert!(plain.matter == idle.matter);
        // T is found from h and is 20 °C but for its last bits, so that a
        // trace of heat is exchanged; nothing that moves depends on it.
        let idle = of(lossy);
        same_motion(&plain, &idle, "losses to air of the liquid's temperature");
    }
}

/// Density cannot be idle to the bit: volume and density are found anew in
/// each substep from c and T, and their quotient is 1 but for its last bits.
#[test]
fn density_of_one_liquid_at_rest_density() {
    let p = Parameters {
        rest_density: SolutionTable::new().at(0.0).density_at(20.0),
        ..single_substeps()
    };
    let law = |density| Physical {
        density,
        ..mixing_alone()
    };
    let of = |density| {
        let p = with(Chemistry::Physical(law(density)), p.clone());
        particles(&shaken(p, 20.0, 0.0, 1))
    };
    let (without, with_density) = (of(false), of(true));
    let apart = without.iter().zip(&with_density);
    let apart = apart.map(|(a, b)| a.position.distance(b.position));
    let error = apart.fold(0.0, f64::max);
    // Two substeps of rounding, as in `leaning_glass`.
    assert!(error < 2e-7, "{error}");
}
