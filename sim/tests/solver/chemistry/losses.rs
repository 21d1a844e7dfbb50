//! Heat and water that leave a glass, by its geometry and by measurements.

use super::setup::*;
use crate::common::*;
use std::f64::consts::PI;
use vitriol_sim::chemistry::transport::Losses;
use vitriol_sim::chemistry::{Chemistry, Physical};
use vitriol_sim::pose::Pose;
use vitriol_tests::gpu;

/// A glass of water at 80 °C that has come to rest loses what Newton's law has for its surface,
/// πr², and for the glass that it wets, πr² + 2πr·level.
///
/// A tenth is allowed of the surface (a particle is 0.2 r wide), and 12 % of the glass: in the corner of wall
/// and floor two gradients add as vectors and not as areas, which takes 5 % off in so small a glass.
#[test]
fn a_glass_loses_heat_by_its_surface_and_its_wall() {
    let device = gpu::device();
    let (radius, transfer) = (0.013, 200.0);
    for (glass, surface, allowed) in [(0.0, transfer, 0.10), (transfer, 0.0, 0.12)] {
        let law = Physical {
            losses: Some(Losses {
                ambient: 20.0,
                glass,
                surface,
            }),
            ..mixing_alone()
        };
        let p = with(Chemistry::Physical(law), parameters());
        let (unit, frame_time) = (p.particle_mass(), p.frame_time);
        let volume = 800.0 * p.particle_volume();
        let particles = glass_of(800, |_| (80.0, 0.0));
        let solver = Setup::new(p, vec![narrow_glass()], particles).solver(&device);
        frames(&device, &solver, &[Pose::IDENTITY], 40);
        let lost = || -unit * sum(&solver.snapshot().unwrap().ledger, |row| row[1]);
        let mean = || {
            let heat = solver.snapshot().unwrap().heat;
            sum(&heat, |row| row[0]) / heat.len() as f64
        };
        let (before, warmth) = (lost(), mean() - 20.0);
        frames(&device, &solver, &[Pose::IDENTITY], 5);
        let power = (lost() - before) / (5.0 * frame_time);
        let level = volume / (PI * radius * radius);
        let wetted = PI * radius * radius + 2.0 * PI * radius * level;
        let area = if glass > 0.0 {
            wetted
        } else {
            PI * radius * radius
        };
        let found = power / (transfer * warmth * area);
        assert!(
            (found - 1.0).abs() < allowed,
            "{glass} {surface}: {found} of the area"
        );
    }
}

/// Open water in a full glass evaporates at the rate of a handbook's tanks in still air of 60 °F ('Heat Loss
/// from Open Water Tanks', Engineering Toolbox: 660, 1740, 2680 Btu/(ft² h) at 140, 180, 200 °F), within a
/// quarter; half of that is the handbook's scatter, a tenth the surface's area. What leaves is the ledger's.
#[test]
fn open_water_evaporates_at_the_published_rate() {
    let device = gpu::device();
    let radius = 0.013;
    for (temperature, known) in [(60.0, 2082.0), (82.2, 5489.0), (93.3, 8454.0)] {
        let law = Physical {
            superheat_time: Some(0.4),
            losses: Some(Losses {
                ambient: 15.6,
                glass: 0.0,
                surface: 0.0,
            }),
            ..mixing_alone()
        };
        let p = with(Chemistry::Physical(law), parameters());
        let (unit, frame_time) = (p.particle_mass(), p.frame_time);
        let particles = glass_of(800, |_| (temperature, 0.0));
        let solver = Setup::new(p, vec![narrow_glass()], particles).solver(&device);
        frames(&device, &solver, &[Pose::IDENTITY], 40);
        let totals = || {
            let state = solver.snapshot().unwrap();
            let steam = [2, 3].map(|k| unit * sum(&state.ledger, |row| row[k]));
            let mass = unit * sum(&state.matter, |row| row[3]);
            let enthalpy = unit * sum(&state.matter, |row| row[3] * row[1]);
            (steam, mass, enthalpy)
        };
        let (before, mass, enthalpy) = totals();
        frames(&device, &solver, &[Pose::IDENTITY], 5);
        let (after, less, lower) = totals();
        let gone = after[0] - before[0];
        let power = (after[1] - before[1] + lower - enthalpy) / (5.0 * frame_time);
        assert!(power.abs() < 1e-2, "{power} W came from nowhere");
        assert!(
            (mass - less - gone).abs() < 1e-2 * gone,
            "{mass} {less} {gone}"
        );
        // 2.5 MJ/kg less what the water that goes held itself.
        let latent = 2.501e6 - 2361.0 * temperature;
        let flux = gone * latent / (5.0 * frame_time * PI * radius * radius);
        assert!(
            (flux / known - 1.0).abs() < 0.25,
            "{temperature} °C: {flux} W/m²"
        );
    }
}
