//! Quantities that a report gives of a world at one moment.

mod departures;
mod heat;
mod percentile;

pub use departures::{Departed, Departures};
pub use heat::{AIR_OVER_STEAM, HeatMeasurement, Ledger, Superheat, measure as measure_heat};

use crate::flask::Region;
use crate::scene::{Flask, Scene};
use crate::solver::{LYING, SolverState};
use crate::world::{World, WorldError};
use glam::{DVec3, Vec3};
use percentile::percentile;
use serde::Serialize;
use vitriol_gpu::QueueKind;

/// How far beyond a wall a particle has to be to count as lost, support
/// radii: rounding in the stage's frame is far below it.
const THROUGH_WALL: f64 = 0.05;

/// A world at one moment, SI units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measurement {
    /// Mean over all particles of max(0, ρ/ρ₀ − 1): compression, since Eq. 2
    /// is an inequality, and the liquid's surface may be thinner.
    pub density_error_mean: f64,
    /// 99th percentile of max(0, ρ/ρ₀ − 1) over all particles.
    pub density_error_p99: f64,
    /// Kinetic energy, J.
    pub kinetic_energy: f64,
    /// Temperature and composition, where heat is modelled.
    pub heat: Option<HeatMeasurement>,
    /// Mass in each flask, kg.
    pub in_flasks: Vec<f64>,
    /// Area of each flask's inside at the height that its liquid would have at rest, upright and without bubbles, m²; 0 of an empty
    /// one.
    pub surfaces: Vec<f64>,
    /// Mass on the table beside the flasks, kg.
    pub on_table: f64,
    /// Mass on the floor, kg.
    pub on_floor: f64,
    /// Mass elsewhere: in the stream, or flying, kg.
    pub in_air: f64,
    /// Mass of drops of bubbles that came to rest elsewhere than in the flask that they came from, kg.
    pub spray_left: f64,
    /// Particles that went through a wall.
    pub lost_particles: u64,
    /// Particles taken out because they turned non-finite.
    pub nan_particles: u64,
    /// Times that the neighbour list was rebuilt.
    pub list_rebuilds: u32,
}

impl World {
    /// Measures the world as it is now; waits for the device.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn measure(&self) -> Result<Measurement, WorldError> {
        self.measure_state(&self.solver().snapshot()?)
    }

    /// Measures as [`World::measure`] does, from `state`, a snapshot of the present state that the caller has already.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn measure_state(&self, state: &SolverState) -> Result<Measurement, WorldError> {
        let solver = self.solver();
        let counters = solver.counters()?;
        let mut errors = Vec::new();
        if solver.count() > 0 {
            let mut rec = self.gpu().recorder(QueueKind::Main)?;
            let density = solver.record_density(&mut rec)?;
            self.gpu().submit(rec)?.wait()?;
            errors = density.get::<f32>()?;
            errors.truncate(solver.count() as usize);
            errors
                .iter_mut()
                .for_each(|density| *density = (*density - 1.0).max(0.0));
            errors.sort_by(f32::total_cmp);
        }
        let count = errors.len().max(1);
        let mass = solver.parameters().particle_mass();
        let flasks = self.scene().flasks.len();
        let mut measured = Measurement {
            density_error_mean: errors.iter().map(|&e| f64::from(e)).sum::<f64>() / count as f64,
            density_error_p99: percentile(&errors, 0.99),
            kinetic_energy: kinetic_energy(state, mass),
            heat: measure_heat(solver.parameters(), state),
            in_flasks: vec![0.0; flasks],
            surfaces: self.surfaces(state),
            on_table: 0.0,
            on_floor: 0.0,
            in_air: 0.0,
            spray_left: mass * (0..flasks).map(|k| state.spray_left(k)).sum::<f64>(),
            lost_particles: 0,
            nan_particles: u64::from(counters.nan_particles),
            list_rebuilds: counters.list_rebuilds,
        };
        self.place(state, mass, &mut measured);
        Ok(measured)
    }

    /// Adds up what is where.
    fn place(&self, state: &SolverState, mass: f64, measured: &mut Measurement) {
        let scene = self.scene();
        let support = scene.scale.support();
        for slot in (0..state.positions.len()).filter(|&slot| state.is_present(slot)) {
            let [x, y, z, _] = state.positions[slot];
            let position = DVec3::new(x.into(), y.into(), z.into());
            let flask = state.flask_of(slot);
            if self.is_lost(position, flask) {
                measured.lost_particles += 1;
            }
            let mass = mass * state.mass_of(slot);
            if let Some(flask) = flask {
                measured.in_flasks[flask] += mass;
            } else if lies_on_table(scene, position, LYING * support) {
                measured.on_table += mass;
            } else if position.y < scene.floor.height + LYING * support {
                measured.on_floor += mass;
            } else {
                measured.in_air += mass;
            }
        }
    }

    /// By flask, the surface of its liquid, m².
    fn surfaces(&self, state: &SolverState) -> Vec<f64> {
        let flasks = &self.scene().flasks;
        let mut volumes = vec![0.0; flasks.len()];
        for slot in 0..state.positions.len() {
            if let Some(flask) = state.flask_of(slot) {
                volumes[flask] += state.volume_of(slot);
            }
        }
        let one = self.solver().parameters().particle_volume();
        let surface =
            |(flask, volume): (&Flask, f64)| flask.profile.surface_for_volume(one * volume);
        flasks.iter().zip(volumes).map(surface).collect()
    }

    /// Whether a particle is on the wrong side of a wall: not in the flask
    /// that it belongs to, in one that it does not belong to, or below the floor.
    fn is_lost(&self, position: DVec3, member_of: Option<usize>) -> bool {
        let scene = self.scene();
        let tolerance = THROUGH_WALL * scene.scale.support();
        if position.y < scene.floor.height - tolerance {
            return true;
        }
        scene.flasks.iter().enumerate().any(|(index, flask)| {
            let pose = self.poses()[index];
            let local = pose
                .inverse()
                .transform_point(position.as_vec3())
                .as_dvec3();
            let depth = flask
                .profile
                .signed_distance_inner(local.x.hypot(local.z), local.y);
            if member_of == Some(index) {
                Region::of(&flask.profile, local) == Region::Outside && depth < -tolerance
            } else {
                Region::of(&flask.profile, local) == Region::Inside && depth > tolerance
            }
        })
    }
}

fn lies_on_table(scene: &Scene, position: DVec3, thickness: f64) -> bool {
    scene.table.is_some_and(|table| {
        let beside = (position.x - table.centre[0]).abs() > 0.5 * table.size[0]
            || (position.z - table.centre[1]).abs() > 0.5 * table.size[1];
        let height = position.y - table.top;
        !beside && (-thickness..thickness).contains(&height)
    })
}

fn kinetic_energy(state: &SolverState, mass: f64) -> f64 {
    let doubled = (0..).zip(&state.velocities).map(|(slot, &[x, y, z, _])| {
        state.mass_of(slot) * f64::from(Vec3::new(x, y, z).length_squared())
    });
    0.5 * mass * doubled.sum::<f64>()
}
