//! Line 26 of the physical chemistry.

use super::{in_the_open, parameters};
use crate::chemistry::OutOfRange;
use crate::chemistry::Physical as Law;
use crate::chemistry::adiabatic::{Feed, mix};
use crate::chemistry::eddies::Mixing;
use crate::chemistry::segregation::USUAL_FEED;
use crate::chemistry::transport::Losses;
use crate::parameters::Parameters;
use crate::reference::Reference;
use crate::reference::chemistry::{ReferenceChemistry, ReferencePhysical};

/// An insulated vessel whose particles hold their vapour.
pub fn closed() -> Law {
    Law {
        bubbles: None,
        lamella: None,
        mixing: Mixing::default(),
        feed: USUAL_FEED,
        losses: None,
        density: false,
        viscosity: false,
        superheat_time: Some(0.01),
    }
}

/// A block of 6 × 6 × 6 particles at real size, `(temperature, acid)` by
/// height from 0 to 1.
fn block(law: Law, of: impl Fn(f64) -> (f64, f64)) -> Reference {
    let parameters = parameters();
    let mut positions = Vec::new();
    let mut particles = Vec::new();
    for y in 0..6 {
        for x in 0..6 {
            for z in 0..6 {
                let site = glam::DVec3::new(x.into(), y.into(), z.into());
                positions.push(site * parameters.spacing);
                particles.push(of(f64::from(y) / 5.0));
            }
        }
    }
    let volume = parameters.particle_volume();
    let mut reference = in_the_open(parameters, positions);
    let physical = ReferencePhysical::new(law, volume, &particles).unwrap();
    reference.chemistry = Some(ReferenceChemistry::Physical(Box::new(physical)));
    reference
}

pub fn physical(reference: &Reference) -> &ReferencePhysical {
    match &reference.chemistry {
        Some(ReferenceChemistry::Physical(physical)) => physical,
        _ => panic!("has the physical chemistry"),
    }
}

/// Mass, acid (kg) and enthalpy (J) of all particles.
fn totals(physical: &ReferencePhysical) -> [f64; 3] {
    let sum = |of: fn(&crate::chemistry::physical::Content) -> f64| -> f64 {
        physical.contents.iter().map(of).sum()
    };
    [
        sum(|c| c.mass),
        sum(|c| c.mass * c.acid),
        sum(|c| c.mass * c.enthalpy),
    ]
}

/// Eddies of that diffusivity (m²/s) everywhere.
pub fn stir(reference: &mut Reference, diffusivity: f64) {
    if let Some(ReferenceChemistry::Physical(physical)) = &mut reference.chemistry {
        physical.eddies.fill(diffusivity);
    }
}

#[test]
fn a_stirred_box_ends_where_the_formula_does_whichever_is_above() {
    let end = |water_below: bool| {
        // A third of the layers is acid.
        let mut reference = block(closed(), |height| {
            let acid = if water_below {
                height > 0.7
            } else {
                height < 0.3
            };
            (20.0, if acid { 0.98 } else { 0.0 })
        });
        let neighbours = reference.neighbours(&reference.positions);
        let before = totals(physical(&reference));
        stir(&mut reference, 8e-4);
        for _ in 0..2000 {
            reference.dilute(&neighbours);
        }
        let physical = physical(&reference);
        for (before, after) in before.iter().zip(totals(physical)) {
            assert!((after / before - 1.0).abs() < 1e-10, "{before} {after}");
        }
        let formula = mix(
            &physical.table,
            &[(144.0, 0.0), (72.0, 0.98)].map(|(volume, acid)| Feed {
                mass: volume * physical.table.at(acid).density_at(20.0),
                acid,
                temperature: 20.0,
            }),
        )
        .unwrap();
        for content in &physical.contents {
            let temperature = content.temperature(&physical.table);
            // Differences that remain after the stirring.
            assert!(
                (temperature - formula.temperature).abs() < 0.05,
                "{content:?} {formula:?}"
            );
            assert!((content.liquid_acid() - formula.acid).abs() < 1e-3);
        }
        physical.contents[0].temperature(&physical.table)
    };
    assert!((end(true) - end(false)).abs() < 0.05);
}

#[test]
fn the_ledger_closes_while_it_boils() {
    let law = Law {
        losses: Some(Losses::to_air(20.0)),
        ..closed()
    };
    let mut reference = block(law, |height| (110.0, 1.0 - height));
    stir(&mut reference, 2e-4);
    let before = totals(physical(&reference));
    let neighbours = reference.neighbours(&reference.positions);
    for _ in 0..300 {
        reference.dilute(&neighbours);
    }
    let physical = physical(&reference);
    let after = totals(physical);
    let ledger = physical.ledger;
    assert!(ledger.steam.mass > 1e-4 * before[0], "{ledger:?}");
    assert!(ledger.exchanged < 0.0, "{ledger:?}");
    assert!(((after[0] + ledger.steam.mass) / before[0] - 1.0).abs() < 1e-12);
    assert!((after[1] / before[1] - 1.0).abs() < 1e-12);
    let scale = before[0] * 1e5;
    let open = after[2] + ledger.steam.enthalpy - ledger.exchanged - before[2];
    assert!(open.abs() < 1e-10 * scale, "{open} {scale}");
}

/// A shear wave in liquid of a tabulated viscosity ν decays by exp(−νk²t).
#[test]
fn a_shear_wave_decays_as_its_viscosity_says() {
    let law = Law {
        viscosity: true,
        superheat_time: None,
        ..closed()
    };
    let parameters = Parameters {
        viscosity: 0.0,
        ..parameters()
    };
    let (time, spacing) = (parameters.substep_time(), parameters.spacing);
    // Of 32 layers; its middle is far from the ends.
    let k = 2.0 * std::f64::consts::PI / (32.0 * spacing);
    let mut positions = Vec::new();
    for (x, y, z) in (0..64).flat_map(|x| (0..5).flat_map(move |y| (0..5).map(move |z| (x, y, z))))
    {
        let site = glam::DVec3::new(x.into(), y.into(), z.into());
        positions.push(site * spacing);
    }
    for (acid, temperature) in [(0.0, 20.0), (0.9, 20.0), (0.9, 100.0)] {
        let particles = vec![(temperature, acid); positions.len()];
        let mut reference = in_the_open(parameters.clone(), positions.clone());
        let volume = parameters.particle_volume();
        let state = ReferencePhysical::new(law, volume, &particles).unwrap();
        let row = state.table.at(acid);
        let viscosity = row.viscosity_at(temperature) / row.density_at(temperature);
        reference.chemistry = Some(ReferenceChemistry::Physical(Box::new(state)));
        let neighbours = reference.neighbours(&reference.positions);
        // Known from the first line 26 on.
        reference.dilute(&neighbours);
        let wave = |x: &glam::DVec3| glam::DVec3::Y * (k * x.x).sin();
        reference.velocities = reference.positions.iter().map(wave).collect();
        reference.smooth(&neighbours);
        // The crest at five quarters of the length. The lattice has 0.998 of the
        // moment; 1 − exp(−x) is 0.8 % below x at most.
        let crest = 40 * 25 + 12;
        let decay = 1.0 - reference.velocities[crest].y / wave(&reference.positions[crest]).y;
        let expected = viscosity * k * k * time;
        assert!(
            (decay / expected - 1.0).abs() < 0.02,
            "{acid} {temperature}: {decay} {expected}"
        );
    }
}

#[test]
fn impossible_liquids_are_refused() {
    let refused = ReferencePhysical::new(closed(), 1e-8, &[(20.0, 0.5), (20.0, 1.1)]);
    assert!(matches!(refused, Err(OutOfRange::Acid(_))));
}
