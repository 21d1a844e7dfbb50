//! Heat that leaves a glass, by its geometry.

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
