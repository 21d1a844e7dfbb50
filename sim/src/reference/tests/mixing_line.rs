//! Mixtures by eddies lie on the straight line between the two liquids, in c and h.
//!
//! Of water and 98 % acid at 20 °C that line is at most 9.0 K above its boiling point, and at
//! most 159.9 °C hot: by the tables of heats of mixing, heat capacities and boiling points,
//! without a particle. With water at 60 °C it is 38 K above, with acid at 60 °C 23 K.

use super::mixing::{closed, physical, stir};
use super::{in_the_open, parameters};
use crate::chemistry::Physical as Law;
use crate::reference::Reference;
use crate::reference::chemistry::{ReferenceChemistry, ReferencePhysical};
use glam::DVec3;

const WATER: (f64, f64) = (20.0, 0.0);
const ACID: (f64, f64) = (20.0, 0.98);

/// A cube of `side`³ particles of `around`, and of `drop` at the sites for which `inside` is true.
fn cube(
    side: i32,
    inside: impl Fn([i32; 3]) -> bool,
    drop: (f64, f64),
    around: (f64, f64),
) -> Reference {
    let law = Law {
        superheat_time: None,
        ..closed()
    };
    let parameters = parameters();
    let sites = (0..side.pow(3)).map(|i| [i / side / side, i / side % side, i % side]);
    let (mut positions, mut particles) = (Vec::new(), Vec::new());
    for site in sites {
        positions.push(DVec3::from_array(site.map(f64::from)) * parameters.spacing);
        particles.push(if inside(site) { drop } else { around });
    }
    let volume = parameters.particle_volume();
    let mut reference = in_the_open(parameters, positions);
    let physical = ReferencePhysical::new(law, volume, &particles).unwrap();
    reference.chemistry = Some(ReferenceChemistry::Physical(Box::new(physical)));
    reference
}

/// Largest superheat (K) and temperature (°C) of any particle until the acid is even to 0.01,
/// stirred by eddies of that diffusivity (m²/s).
fn stirred(mut reference: Reference, diffusivity: f64) -> [f64; 2] {
    let neighbours = reference.neighbours(&reference.positions);
    stir(&mut reference, diffusivity);
    let mut most = [f64::NEG_INFINITY; 2];
    for _ in 0..20_000 {
        reference.dilute(&neighbours);
        let physical = physical(&reference);
        let mut acid = [f64::INFINITY, f64::NEG_INFINITY];
        for content in &physical.contents {
            most[0] = most[0].max(content.superheat(&physical.table));
            most[1] = most[1].max(content.temperature(&physical.table));
            acid = [acid[0].min(content.acid), acid[1].max(content.acid)];
        }
        if acid[1] - acid[0] < 0.01 {
            return most;
        }
    }
    panic!("not mixed after 20,000 substeps");
}

#[test]
fn drops_and_layers_reach_the_mixing_line_and_do_not_pass_it() {
    let drop = |site: [i32; 3], from: i32, to: i32| site.iter().all(|k| (from..to).contains(k));
    for (inner, outer) in [(ACID, WATER), (WATER, ACID)] {
        let cases = [
            ("a particle", cube(5, |site| drop(site, 2, 3), inner, outer)),
            (
                "8 particles",
                cube(6, |site| drop(site, 2, 4), inner, outer),
            ),
            (
                "27 particles",
                cube(7, |site| drop(site, 2, 5), inner, outer),
            ),
            ("a plane", cube(6, |[_, y, _]| y < 3, inner, outer)),
        ];
        for (name, start) in cases {
            // A thousand times what conducts heat: at 1e-5 conduction takes up to a degree from a
            // single particle. Twice that again, and a drop passes the peak within a step.
            for eddies in [8e-5, 1.6e-4] {
                let [superheat, temperature] = stirred(start.clone(), eddies);
                let case =
                    format!("{name} of {inner:?} by {eddies} m²/s: {superheat} {temperature}");
                assert!((8.0..=10.0).contains(&superheat), "{case}");
                assert!((temperature - 159.9).abs() <= 0.5, "{case}");
            }
        }
    }
}

/// Feeds of 20 °C differ by 26 kJ/kg only; warm ones tell whether enthalpy comes as fast as acid.
#[test]
fn warm_feeds_reach_their_own_line() {
    for (water, acid, line) in [(60.0, 20.0, 38.0), (20.0, 60.0, 23.0)] {
        let start = cube(6, |[_, y, _]| y < 3, (acid, 0.98), (water, 0.0));
        let [superheat, _] = stirred(start, 3e-4);
        // To what the line's figure is rounded, and half a kelvin of conduction.
        assert!(
            (superheat - line).abs() <= 1.0,
            "{water} {acid}: {superheat}"
        );
    }
}
