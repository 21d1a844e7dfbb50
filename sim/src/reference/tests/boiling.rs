//! Line 27: anti-viscosity.

use super::{Random, in_the_open};
use crate::chemistry::paper::{AntiViscosity, Boiling, REFERENCE_POWER};
use crate::parameters::Parameters;
use crate::reference::Reference;
use crate::reference::chemistry::{ReferenceChemistry, ReferencePaper};
use crate::scene::Scene;

/// Liquid of `temperature` °C in the open at k_v = `intensity`, its
/// particles in random motion.
fn hot(temperature: f64, intensity: f64, kind: Boiling, substeps: u32) -> Reference {
    let parameters = Parameters {
        substeps,
        ..Parameters::from_scene(&Scene::builtin("tomato-soup").unwrap())
    };
    let mut random = Random(5);
    let mut positions = Vec::new();
    for x in 0..7 {
        for y in 0..7 {
            for z in 0..7 {
                let site = glam::DVec3::new(x.into(), y.into(), z.into());
                positions.push((site + random.point(0.2)) * parameters.spacing);
            }
        }
    }
    let mut reference = in_the_open(parameters, positions);
    reference.velocities = random.points(reference.positions.len(), 4.0);
    let law = AntiViscosity::new(100.0, intensity).unwrap();
    let particles = vec![(temperature, 0.0); reference.positions.len()];
    let paper = ReferencePaper::new(None, Some((law, kind)), &particles).unwrap();
    reference.chemistry = Some(ReferenceChemistry::Paper(paper));
    reference
}

/// Kinetic energy that `frames` frames of line 27 alone add to `reference`, J/kg.
fn gain(mut reference: Reference, frames: u32) -> f64 {
    let neighbours = reference.neighbours(&reference.positions);
    // e_i is known from the second substep on.
    if let Some(ReferenceChemistry::Paper(paper)) = &mut reference.chemistry {
        paper.agitation.fill(1e300);
    }
    reference.smooth(&neighbours);
    let before = reference.kinetic_energy();
    for _ in 0..frames * reference.parameters.substeps {
        reference.smooth(&neighbours);
    }
    let mass = reference.parameters.particle_mass() * reference.positions.len() as f64;
    (reference.kinetic_energy() - before) / mass
}

#[test]
fn the_stated_power_is_injected_whatever_the_substeps() {
    // 150 °C at k_v = 0.2: P = 0.01 P₀.
    let stated = 0.01 * REFERENCE_POWER * 2.0 / 60.0;
    for substeps in 1..=8 {
        let gained = gain(hot(150.0, 0.2, Boiling::Power, substeps), 2);
        // α is a tenth to a fortieth, and its second order adds a share of
        // about α: 11 % at one substep, 7 % at two, 2 % at eight.
        let tolerance = if substeps == 1 { 0.2 } else { 0.1 };
        assert!(
            (gained / stated - 1.0).abs() < tolerance,
            "{substeps}: {gained} {stated}"
        );
    }
}

#[test]
fn anti_viscosity_keeps_momentum() {
    for kind in [Boiling::Power, Boiling::Literal] {
        let mut reference = hot(150.0, 1.0, kind, 3);
        // Some of it is below T_B, so that the pairs' means matter.
        if let Some(ReferenceChemistry::Paper(paper)) = &mut reference.chemistry {
            for temperature in paper.temperatures.iter_mut().step_by(3) {
                *temperature = 20.0;
            }
        }
        let neighbours = reference.neighbours(&reference.positions);
        let before = reference.momentum();
        for _ in 0..20 {
            reference.smooth(&neighbours);
        }
        let scale = reference.parameters.particle_mass()
            * reference.velocities.iter().map(|v| v.length()).sum::<f64>();
        let drift = (reference.momentum() - before).length();
        assert!(drift < 1e-13 * scale, "{kind:?} {drift} {scale}");
    }
}

#[test]
fn cold_liquid_is_smoothed_as_without_boiling() {
    let mut with = hot(99.0, 1.0, Boiling::Power, 3);
    let mut without = with.clone();
    without.chemistry = None;
    let neighbours = with.neighbours(&with.positions);
    with.smooth(&neighbours);
    without.smooth(&neighbours);
    for (a, b) in with.velocities.iter().zip(&without.velocities) {
        // Rounding alone: the sums are of other terms.
        assert!(a.distance(*b) < 1e-13);
    }
}
