//! State of Algorithm 1, and the quantities that follow from it without neighbours.

use super::chemistry::ReferenceChemistry;
use super::placement::Motion;
use super::surroundings::{Contact, Surroundings};
use crate::flask::Region;
use crate::kernel::Kernel;
use crate::parameters::Parameters;
use crate::pose::Pose;
use glam::DVec3;

/// The liquid and its surroundings. All per-particle vectors have one
/// length; the solids' order is [`Surroundings::vessels`]'.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Parameters of Algorithm 1.
    pub parameters: Parameters,
    /// Flasks, table and floor.
    pub surroundings: Surroundings,
    /// Identity of each particle, which stays when others are taken out.
    pub ids: Vec<u32>,
    /// x_i, stage, metres.
    pub positions: Vec<DVec3>,
    /// v_i, m/s.
    pub velocities: Vec<DVec3>,
    /// λ_i/Δt² of past substeps, low-passed: −p/ρ, m²/s².
    pub carried: Vec<f64>,
    /// Index of the flask that the particle is in.
    pub membership: Vec<Option<usize>>,
    /// Particles that turned non-finite and were taken out.
    pub removed: usize,
    /// Heat, acid and boiling, where they are modelled.
    pub chemistry: Option<ReferenceChemistry>,
    pub(super) motion: Vec<Motion>,
    /// Accelerations (m/s²) with which walls hold back the line of a surface, along their directions, and which.
    pub(super) held: Vec<Hold>,
}

/// Acceleration with which a wall holds a particle back across the surface's line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hold {
    /// m/s²; along it and against it.
    pub(super) acceleration: DVec3,
    /// The flask that holds it; else table or floor.
    pub(super) flask: Option<usize>,
}

impl Reference {
    /// Liquid at rest at `positions` (stage, metres) among flasks at `poses`
    /// (`stage_from_flask`, one per vessel).
    pub fn new(
        parameters: Parameters,
        surroundings: Surroundings,
        positions: Vec<DVec3>,
        poses: &[Pose],
    ) -> Self {
        let time = parameters.substep_time();
        let motion: Vec<_> = poses
            .iter()
            .map(|&pose| Motion::of_substep(pose, pose, 0, 1, time))
            .collect();
        let membership = positions
            .iter()
            .map(|&position| flask_around(&surroundings, &motion, position))
            .collect();
        Self {
            parameters,
            surroundings,
            ids: (0..positions.len() as u32).collect(),
            velocities: vec![DVec3::ZERO; positions.len()],
            carried: vec![0.0; positions.len()],
            positions,
            membership,
            removed: 0,
            chemistry: None,
            motion,
            held: Vec::new(),
        }
    }

    /// V_i, m³, and ρ₀/ρ_i of every particle: V₀ and 1 where density does not
    /// follow composition.
    pub(super) fn bulk(&self) -> (Vec<f64>, Vec<f64>) {
        match &self.chemistry {
            Some(ReferenceChemistry::Physical(physical)) => physical.bulk_of(&self.parameters),
            _ => {
                let count = self.positions.len();
                (
                    vec![self.parameters.particle_volume(); count],
                    vec![1.0; count],
                )
            }
        }
    }

    /// [`Surroundings::contacts`] of particle `i`.
    pub(super) fn contacts(&self, i: usize, visit: impl FnMut(Contact)) {
        let (position, member_of) = (self.positions[i], self.membership[i]);
        self.surroundings
            .contacts(position, member_of, &self.motion, visit);
    }

    /// The kernel W of Eq. 1.
    pub fn kernel(&self) -> Kernel {
        Kernel::new(self.parameters.support_radius)
    }

    /// Σ ½mv², J.
    pub fn kinetic_energy(&self) -> f64 {
        let squares: f64 = self.velocities.iter().map(|v| v.length_squared()).sum();
        0.5 * self.parameters.particle_mass() * squares
    }

    /// Σ mv, kg·m/s.
    pub fn momentum(&self) -> DVec3 {
        self.velocities.iter().sum::<DVec3>() * self.parameters.particle_mass()
    }
}

fn flask_around(surroundings: &Surroundings, motion: &[Motion], position: DVec3) -> Option<usize> {
    surroundings
        .vessels
        .iter()
        .zip(motion)
        .position(|(vessel, motion)| {
            let local = motion.after.to_flask(position);
            Region::of(&vessel.profile, local) == Region::Inside
        })
}
