#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
//! Truth from outside: formulas, brute force, finite differences, and the
//! flask's regions on their own.

mod boiling;
mod contact;
mod dilution;
mod eddies;
mod mixing;
mod mixing_line;
mod passes;
mod rest;
mod surface;
mod walls;

use super::Reference;
use super::surroundings::{Surroundings, Vessel};
use crate::fill::fill;
use crate::flask::Profile;
use crate::parameters::Parameters;
use crate::pose::Pose;
use glam::DVec3;
use vitriol_tests::random::Random;

/// Spacing of real glass, metres.
const D: f64 = 0.0025;
const H: f64 = 2.0 * D;

/// Real size at 90 Hz × 8 × 4.
fn parameters() -> Parameters {
    Parameters {
        substeps: 8,
        ..Parameters::of_water(D)
    }
}

/// A glass 26 mm wide, of which 800 particles fill 24 mm.
fn narrow_glass() -> Profile {
    Profile::new(&[[0.0, 0.013], [0.06, 0.013]], 0.002).unwrap()
}

/// `count` particles at rest in the narrow glass at `pose`.
fn glass_of_water(parameters: Parameters, count: usize, pose: Pose) -> Reference {
    let profile = narrow_glass();
    let positions = fill(&profile, pose, count, D, Some(1)).unwrap();
    let vessels = vec![Vessel::with_maps(profile, H)];
    let surroundings = Surroundings::new(vessels, None, None, H);
    Reference::new(parameters, surroundings, positions, &[pose])
}

/// Liquid without anything around it.
fn in_the_open(parameters: Parameters, positions: Vec<DVec3>) -> Reference {
    let surroundings = Surroundings::new(Vec::new(), None, None, parameters.support_radius);
    Reference::new(parameters, surroundings, positions, &[])
}
