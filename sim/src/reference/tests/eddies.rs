//! The filtered flow's strain and stratification, by flows whose own are known.

use super::mixing::closed;
use super::{in_the_open, parameters};
use crate::chemistry::Physical as Law;
use crate::chemistry::eddies::{Mixing, SCHMIDT};
use crate::parameters::Parameters;
use crate::reference::Reference;
use crate::reference::chemistry::{ReferenceChemistry, ReferencePhysical};
use glam::DVec3;
use std::f64::consts::PI;
use vitriol_tests::random::Random;

/// A cube of `side`³ particles of 20 °C, whose middle is at 0, with these velocities and acid fractions.
fn cube(
    spacing: f64,
    side: i32,
    shake: f64,
    velocity: impl Fn(DVec3) -> DVec3,
    acid: impl Fn(DVec3) -> f64,
) -> Reference {
    let parameters = Parameters {
        spacing,
        support_radius: 2.0 * spacing,
        ..parameters()
    };
    let mut random = Random(3);
    let half = 0.5 * f64::from(side - 1);
    let positions: Vec<_> = (0..side.pow(3))
        .map(|i| [i / side / side, i / side % side, i % side])
        .map(|site| (DVec3::from_array(site.map(f64::from)) - half) * spacing)
        .map(|site| site + random.point(shake * spacing))
        .collect();
    let particles: Vec<_> = positions.iter().map(|&x| (20.0, acid(x))).collect();
    let law = Law {
        density: true,
        ..closed()
    };
    let volume = parameters.particle_volume();
    let mut reference = in_the_open(parameters, positions);
    reference.velocities = reference.positions.iter().map(|&x| velocity(x)).collect();
    let physical = ReferencePhysical::new(law, volume, &particles).unwrap();
    reference.chemistry = Some(ReferenceChemistry::Physical(Box::new(physical)));
    reference
}

/// K over C·Δ² (1/s) of the particle that is nearest to the middle.
fn rate(reference: &Reference, mixing: &Mixing) -> f64 {
    let neighbours = reference.neighbours(&reference.positions);
    let middle = (0..reference.positions.len())
        .min_by(|&a, &b| {
            let [a, b] = [a, b].map(|i| reference.positions[i].length());
            a.total_cmp(&b)
        })
        .unwrap();
    let eddies = reference.eddies(mixing, &neighbours)[middle];
    eddies / (mixing.turbulence * mixing.width.powi(2))
}

fn water(_: DVec3) -> f64 {
    0.0
}

#[test]
fn strain_of_a_linear_flow_is_its_own() {
    let mixing = Mixing::default();
    // Shear of 30/s has |S| = 30/s; stretching by (2, −1, −1)·10/s has √(2·600); turning and swelling none.
    type Flow = fn(DVec3) -> DVec3;
    let flows: [(Flow, f64); 5] = [
        (|x| DVec3::X * (30.0 * x.y), 30.0),
        (|x| DVec3::Z * (30.0 * x.x), 30.0),
        (|x| DVec3::new(20.0, -10.0, -10.0) * x, 1200f64.sqrt()),
        (|x| DVec3::new(3.0, 20.0, 5.0).cross(x), 0.0),
        (|x| x * 25.0, 0.0),
    ];
    for (flow, known) in flows {
        // On a lattice smoothing and gradient are exact; shaken by a tenth of a
        // spacing they are off by a sixth of the flow's gradient.
        for (shake, within) in [(0.0, 1e-9), (0.2, 7.0)] {
            let found = rate(&cube(0.0025, 13, shake, flow, water), &mixing);
            assert!((found - known).abs() < within, "{shake}: {found} {known}");
        }
    }
}

/// A wave of velocity is damped as a Gauss filter of the variance Δ²/12 damps it, exp(−k²Δ²/24), whatever the
/// particles' size: so the width that is stated is the width.
#[test]
fn the_filter_is_as_wide_as_it_says() {
    let mixing = Mixing::default();
    let k = 2.0 * PI / 0.02;
    let known = k * (-(k * mixing.width).powi(2) / 24.0).exp();
    let mut errors = Vec::new();
    for spacing in [0.0029, 0.0025, 0.0018, 0.00125] {
        let side = (0.036 / spacing) as i32 | 1;
        let wave = move |x: DVec3| DVec3::X * (k * x.y).sin();
        let found = rate(&cube(spacing, side, 0.0, wave, water), &mixing);
        errors.push(found / known - 1.0);
    }
    // Of the coarsest, the sum over its few neighbours is not the integral.
    let most = errors.iter().fold(0.0, |a: f64, e| a.max(e.abs()));
    assert!(most < 0.06, "{errors:?}");
    assert!(errors[3].abs() < 0.02, "{errors:?}");
}

/// Jitter without flow: 1 mm/s from particle to particle, as liquid at rest has. As a difference of
/// velocities over a spacing that is 0.5/s; filtered it is less, and the less the finer.
#[test]
fn jitter_is_filtered() {
    let mixing = Mixing::default();
    let rates = [0.0025, 0.0018, 0.00125].map(|spacing| {
        let side = (0.03 / spacing) as i32 | 1;
        let mut jittering = cube(spacing, side, 0.0, |_| DVec3::ZERO, water);
        jittering.velocities = Random(5).points(jittering.positions.len(), 0.002);
        let neighbours = jittering.neighbours(&jittering.positions);
        let eddies = jittering.eddies(&mixing, &neighbours);
        let squares = eddies.iter().map(|k| k * k);
        let mean = (squares.sum::<f64>() / eddies.len() as f64).sqrt();
        mean / (mixing.turbulence * mixing.width.powi(2))
    });
    assert!(
        rates[0] < 0.25 && rates[1] < 0.7 * rates[0] && rates[2] < 0.7 * rates[1],
        "{rates:?}"
    );
}

/// Acid under water with density falling linearly: N² = g/ρ·|dρ/dz|. Shear of less than that over the Prandtl
/// number mixes nothing, more of it mixes by √(S² − N²/Pr), and acid over water mixes by itself.
#[test]
fn stratification_damps_as_lilly_says() {
    let mixing = Mixing::default();
    // Fractions of acid whose densities are linear in height.
    let table = crate::chemistry::table::SolutionTable::new();
    let slope = 4e4;
    let acid_at = |density: f64| {
        let (mut low, mut high) = (0.0, 0.9);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if table.at(middle).density_at(20.0) < density {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    };
    for (sign, shear) in [
        (-1.0, 0.0),
        (-1.0, 15.0),
        (-1.0, 40.0),
        (1.0, 0.0),
        (1.0, 20.0),
    ] {
        let flow = move |x: DVec3| DVec3::X * (shear * x.y);
        let liquid = cube(0.0025, 9, 0.0, flow, |x| {
            acid_at(1400.0 + sign * slope * x.y)
        });
        let buoyancy = -9.81 / 1400.0 * sign * slope;
        let known = (shear * shear - buoyancy / SCHMIDT).max(0.0).sqrt();
        let found = rate(&liquid, &mixing);
        assert!(
            (found - known).abs() < 0.02 * known + 1e-9,
            "{sign} {shear}: {found} {known}"
        );
    }
}

/// The power that lifts acid, K·N² a kilogram, is never more than the eddies take from the flow.
#[test]
fn lifting_is_paid_for() {
    let mixing = Mixing::default();
    for strain in [0.0, 1.0, 100.0, 1e4] {
        for richardson in [0.0, 0.1, 0.5, 0.69, 0.71, 5.0] {
            let buoyancy = richardson * strain;
            let diffusivity = mixing.diffusivity(strain, buoyancy);
            let lifted = diffusivity * buoyancy;
            // From the mean flow: ν_t·S².
            let taken = SCHMIDT * diffusivity * strain;
            assert!(lifted <= taken, "{strain} {richardson}: {lifted} {taken}");
        }
    }
}
