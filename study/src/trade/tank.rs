//! Water in a beaker on the device: at rest, and tipped until half of it has run
//! out.

use std::time::Instant;

use glam::{Quat, Vec3};
use serde::{Deserialize, Serialize};
use vitriol_gpu::Gpu;
use vitriol_run::{Blame, Failure, Ranks};
use vitriol_sim::fill::{count_for_volume, fill};
use vitriol_sim::flask::{Profile, glassware, particles::sample};
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::{Particle, Solver, SolverSpec, SolverState};

use super::exact;
use super::setting::Setting;
use crate::liquid;
use crate::merge::number;

/// Water at rest, m³: the paper's single dilution at d = 2.5 mm.
pub const VOLUME: f64 = 217.09e-6;
/// Water that is poured from, m³.
const POURED_FROM: f64 = 150e-6;
/// The vessel.
const VESSEL: &str = "beaker-250";
/// Time before it is tipped, s.
const SETTLED_IN: f64 = 1.0;
/// Angle by which it is tipped, radians, duration of the tipping, s, and time for which it is held there, s.
const TILT: f64 = 1.2;
const TIPPED_IN: f64 = 1.5;
const HELD: f64 = 1.0;
/// Frames between two observations.
const BETWEEN: u32 = 5;

/// Time to record, solve and wait for a frame.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Cost {
    /// Median, ms.
    #[serde(deserialize_with = "number")]
    pub median_ms: f64,
    /// 99th percentile, ms.
    #[serde(deserialize_with = "number")]
    pub p99_ms: f64,
}

impl Cost {
    /// Statistics of times in ms.
    pub fn of(times: &[f64]) -> Self {
        let ranks = Ranks::of(times);
        let rank = |share| ranks.at(share).unwrap_or(f64::NAN);
        Self {
            median_ms: rank(0.5),
            p99_ms: rank(0.99),
        }
    }
}

/// Measurements of water at rest.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Rested {
    /// Particles.
    pub particles: u32,
    /// A frame's time.
    pub cost: Cost,
    /// Mean of max(0, ρ/ρ₀ − 1) over the last part.
    pub density_mean: f64,
    /// 99th percentile of max(0, ρ/ρ₀ − 1) over the last part.
    pub density_p99: f64,
    /// Mean of ρ/ρ₀ − 1, of either sign, of particles deeper than a support radius.
    pub density_signed: f64,
    /// By how much the centre of mass is too low, over its height: lost volume.
    pub lost_volume: f64,
    /// Root mean square speed, m/s.
    pub speed: f64,
    /// Root mean square of the carried −p/ρ less g times the depth, over that at the
    /// floor; none where nothing is carried.
    pub pressure: Option<f64>,
}

/// Measurements of water that is poured.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Tipped {
    /// A frame's time.
    pub cost: Cost,
    /// 99th percentile of max(0, ρ/ρ₀ − 1) in the vessel while it runs out, mean over observations.
    pub density_p99: f64,
    /// Volume that has run out, m³.
    pub poured: f64,
    /// Volume that will have run out in the end, by geometry, m³: the last of it
    /// takes many seconds over the lip.
    pub in_the_end: f64,
    /// Particles that went through the glass.
    pub lost: u64,
}

/// A vessel of water, and nothing around it.
struct Tank {
    gpu: Gpu,
    profile: Profile,
    solver: Solver,
    frame_time: f64,
    gravity: f64,
}

impl Tank {
    fn new(gpu: &Gpu, scene: &Scene, setting: &Setting, volume: f64) -> Result<Self, Failure> {
        let parameters = setting.parameters(scene);
        let vessel = glassware::find(VESSEL).ok_or("the vessel of the trade is no glassware");
        let profile = vessel.other()?.profile(1.0).other()?;
        let d = setting.spacing;
        let count = count_for_volume(volume, d);
        let places = fill(&profile, Pose::IDENTITY, count, d, Some(1)).other()?;
        let top = places.iter().map(|place| place.y).fold(0.0, f64::max);
        let gravity = scene.scale.gravity;
        let particles: Vec<Particle> = places
            .into_iter()
            .map(|position| Particle {
                flask: Some(0),
                carried: gravity * (position.y - top),
                ..liquid::water(position)
            })
            .collect();
        let flasks = [profile.clone()];
        let solids = setting
            .boundary_particles
            .then(|| vec![sample(&profile, 0.5 * d, parameters.support_radius)]);
        let spec = SolverSpec {
            flasks: &flasks,
            solids: solids.as_deref(),
            ..liquid::alone(parameters, &particles)
        };
        Ok(Self {
            gpu: gpu.clone(),
            solver: liquid::solver(gpu, &spec)?,
            profile,
            frame_time: setting.frame_time,
            gravity,
        })
    }

    /// Runs a frame; returns its time, ms.
    fn frame(&self, before: Pose, after: Pose) -> Result<f64, Failure> {
        let begin = Instant::now();
        liquid::frame(&self.gpu, &self.solver, &[before], &[after])?;
        Ok(begin.elapsed().as_secs_f64() * 1e3)
    }

    /// Mean and 99th percentile of max(0, ρ/ρ₀ − 1) of the vessel's particles.
    fn density(&self, state: &SolverState, densities: &[f32]) -> (f64, f64) {
        let members = (0..state.tags.len()).filter(|&slot| state.flask_of(slot) == Some(0));
        let errors: Vec<f64> = members
            .map(|slot| (f64::from(densities[slot]) - 1.0).max(0.0))
            .collect();
        let mean = errors.iter().sum::<f64>() / errors.len().max(1) as f64;
        let p99 = Ranks::of(&errors).at(0.99).unwrap_or(0.0);
        (mean, p99)
    }

    fn rested(&self) -> Result<Look, Failure> {
        let state = self.solver.snapshot().other()?;
        let count = state.tags.len() as f64;
        let volume = count * self.solver.parameters().particle_volume();
        let none = "the liquid of the trade does not fit its vessel";
        let exact = exact::centre_of_mass(&self.profile, volume).ok_or(none);
        let level = self.profile.level_for_volume(volume).ok_or(none).other()?;
        let floor = self.profile.floor_height();
        let exact = exact.other()? - floor;
        let (mut centre, mut squares, mut pressures) = (0.0, 0.0, 0.0);
        for (position, velocity) in state.positions.iter().zip(&state.velocities) {
            let y = f64::from(position[1]);
            centre += y / count;
            let [u, v, w, carried] = velocity.map(f64::from);
            squares += (u * u + v * v + w * w) / count;
            // −p/ρ is never above zero.
            let off = carried + self.gravity * (level - y).max(0.0);
            pressures += off * off / count;
        }
        let densities = liquid::densities(&self.gpu, &self.solver)?;
        let support = self.solver.parameters().support_radius;
        let deep: Vec<f64> = (state.positions.iter().zip(&densities))
            .filter(|(position, _)| level - f64::from(position[1]) > support)
            .map(|(_, density)| f64::from(*density) - 1.0)
            .collect();
        Ok(Look {
            density: self.density(&state, &densities),
            signed: deep.iter().sum::<f64>() / deep.len().max(1) as f64,
            lost_volume: 1.0 - (centre - floor) / exact,
            speed: squares.sqrt(),
            pressure: pressures.sqrt() / (self.gravity * (level - floor)),
        })
    }

    /// Number of particles that are in the vessel and not its members, or the reverse.
    fn through_glass(&self, state: &SolverState, pose: Pose) -> u64 {
        let flask_from_stage = pose.inverse();
        let tolerance = 0.05 * self.solver.parameters().support_radius;
        let wrong = (0..state.tags.len()).filter(|&slot| {
            let [x, y, z, _] = state.positions[slot];
            let local = flask_from_stage
                .transform_point(Vec3::new(x, y, z))
                .as_dvec3();
            let r = local.x.hypot(local.z);
            let depth = self.profile.signed_distance_inner(r, local.y);
            match state.flask_of(slot) {
                Some(_) => depth < -tolerance,
                None => self.profile.is_inside(r, local.y) && depth > tolerance,
            }
        });
        wrong.count() as u64
    }
}

/// Rests water for `seconds`, and measures it over the last third.
///
/// # Errors
/// The device's error.
pub fn rest(gpu: &Gpu, scene: &Scene, setting: &Setting, seconds: f64) -> Result<Rested, Failure> {
    let tank = Tank::new(gpu, scene, setting, VOLUME)?;
    let frames = (seconds / tank.frame_time).ceil() as u32;
    let still = Pose::IDENTITY;
    let (mut times, mut looks) = (Vec::new(), Vec::new());
    for frame in 1..=frames {
        let time = tank.frame(still, still)?;
        if 3 * frame < 2 * frames {
            continue;
        }
        times.push(time);
        if frame % BETWEEN == 0 || frame == frames {
            looks.push(tank.rested()?);
        }
    }
    let mean = |of: &dyn Fn(&Look) -> f64| looks.iter().map(of).sum::<f64>() / looks.len() as f64;
    let parameters = tank.solver.parameters();
    Ok(Rested {
        particles: tank.solver.count(),
        cost: Cost::of(&times),
        density_mean: mean(&|look| look.density.0),
        density_p99: mean(&|look| look.density.1),
        density_signed: mean(&|look| look.signed),
        lost_volume: mean(&|look| look.lost_volume),
        speed: mean(&|look| look.speed * look.speed).sqrt(),
        pressure: (parameters.carry_rate > 0.0).then(|| mean(&|look| look.pressure)),
    })
}

struct Look {
    density: (f64, f64),
    signed: f64,
    lost_volume: f64,
    speed: f64,
    pressure: f64,
}

/// Tips a vessel about its base's edge, holds it, and measures the volume that has run out.
///
/// # Errors
/// The device's error.
pub fn tip(gpu: &Gpu, scene: &Scene, setting: &Setting) -> Result<Tipped, Failure> {
    let tank = Tank::new(gpu, scene, setting, POURED_FROM)?;
    let pose = |time: f64| {
        // Smoothly from rest to rest.
        let part = (time / TIPPED_IN).clamp(0.0, 1.0);
        let angle = TILT * part * part * (3.0 - 2.0 * part);
        Pose::new(Vec3::ZERO, Quat::from_rotation_z(-angle as f32))
    };
    // The filling's lattice comes to rest first.
    for _ in 0..(SETTLED_IN / tank.frame_time).ceil() as u32 {
        tank.frame(pose(0.0), pose(0.0))?;
    }
    let all = ((TIPPED_IN + HELD) / tank.frame_time).ceil() as u32;
    let (mut times, mut densities, mut lost) = (Vec::new(), Vec::new(), 0);
    for frame in 1..=all {
        let time = |frame: u32| f64::from(frame) * tank.frame_time;
        times.push(tank.frame(pose(time(frame - 1)), pose(time(frame)))?);
        if frame % BETWEEN == 0 || frame == all {
            let state = tank.solver.snapshot().other()?;
            if time(frame) < TIPPED_IN {
                let now = liquid::densities(gpu, &tank.solver)?;
                densities.push(tank.density(&state, &now).1);
            }
            lost = lost.max(tank.through_glass(&state, pose(time(frame))));
        }
    }
    let state = tank.solver.snapshot().other()?;
    let left = (0..state.tags.len()).filter(|&slot| state.flask_of(slot).is_none());
    let volume = tank.solver.parameters().particle_volume();
    // The first frames are recorded while the driver compiles.
    let warm = times.len() / 10;
    Ok(Tipped {
        cost: Cost::of(&times[warm..]),
        density_p99: densities.iter().sum::<f64>() / densities.len().max(1) as f64,
        poured: left.count() as f64 * volume,
        in_the_end: f64::from(tank.solver.count()) * volume - exact::retained(&tank.profile, TILT),
        lost,
    })
}
