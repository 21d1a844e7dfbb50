//! The device's solver against the f64 reference for one setting: the same water by both.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use vitriol_gpu::Gpu;
use vitriol_run::{Blame, Failure};
use vitriol_sim::fill::fill;
use vitriol_sim::flask::Profile;
use vitriol_sim::pose::Pose;
use vitriol_sim::reference::Reference;
use vitriol_sim::reference::measure::DensityError;
use vitriol_sim::reference::surroundings::{Surroundings, Vessel};
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::{Particle, SolverSpec};

use super::setting::Setting;
use crate::liquid;

/// Results of both for a glass of water that settles.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Vouched {
    /// Particles.
    pub particles: usize,
    /// Simulated time, s.
    pub seconds: f64,
    /// 99th percentile of max(0, ρ/ρ₀ − 1), f64 and device.
    pub density_p99: [f64; 2],
    /// Mean of max(0, ρ/ρ₀ − 1), f64 and device.
    pub density_mean: [f64; 2],
    /// Height of the centre of mass, f64 and device, m.
    pub centre: [f64; 2],
    /// Kinetic energy, f64 and device, J.
    pub kinetic: [f64; 2],
    /// Largest distance between a particle's positions by both, m.
    pub apart: f64,
}

/// Lets `count` particles settle for `seconds` by both.
///
/// # Errors
/// The device's error.
pub fn vouch(
    gpu: &Gpu,
    scene: &Scene,
    setting: &Setting,
    count: usize,
    seconds: f64,
) -> Result<Vouched, Failure> {
    let parameters = setting.parameters(scene);
    let d = setting.spacing;
    // As deep as it is wide.
    let radius = (count as f64 * d.powi(3) / (2.0 * std::f64::consts::PI)).cbrt();
    let height = 4.0 * radius;
    let profile = Profile::new(&[[0.0, radius], [height, radius]], 0.002).other()?;
    let places = fill(&profile, Pose::IDENTITY, count, d, Some(1)).other()?;
    let still = [Pose::IDENTITY];
    let frames = (seconds / setting.frame_time).ceil() as usize;

    let vessel = Vessel::with_maps(profile.clone(), parameters.support_radius);
    let around = Surroundings::new(vec![vessel], None, None, parameters.support_radius);
    let mut reference = Reference::new(parameters.clone(), around, places.clone(), &still);
    for _ in 0..frames {
        reference.step(&still, &still);
    }
    let truth = reference.density_error();

    let particles: Vec<Particle> = places
        .iter()
        .map(|&position| Particle {
            flask: Some(0),
            ..liquid::water(position)
        })
        .collect();
    let mass = parameters.particle_mass();
    let spec = SolverSpec {
        flasks: &[profile],
        ..liquid::alone(parameters, &particles)
    };
    let solver = liquid::solver(gpu, &spec)?;
    for _ in 0..frames {
        liquid::frame(gpu, &solver, &still, &still)?;
    }
    let state = solver.snapshot().other()?;
    let densities = liquid::densities(gpu, &solver)?;
    let own: Vec<f64> = densities.iter().take(count).map(|&d| d.into()).collect();
    let own = DensityError::of(&own);
    let (mut apart, mut centre, mut squares) = (0.0f64, 0.0, 0.0);
    for (slot, tag) in state.tags.iter().enumerate() {
        let [x, y, z, _] = state.positions[slot].map(f64::from);
        let [u, v, w, _] = state.velocities[slot].map(f64::from);
        let place = DVec3::new(x, y, z);
        if let Some(at) = reference.ids.iter().position(|&id| id == tag[1]) {
            apart = apart.max(place.distance(reference.positions[at]));
        }
        centre += y / count as f64;
        squares += u * u + v * v + w * w;
    }
    let middle: f64 = reference.positions.iter().map(|p| p.y).sum();
    Ok(Vouched {
        particles: count,
        seconds,
        density_p99: [truth.p99, own.p99],
        density_mean: [truth.mean, own.mean],
        centre: [middle / reference.positions.len().max(1) as f64, centre],
        kinetic: [reference.kinetic_energy(), 0.5 * mass * squares],
        apart,
    })
}
