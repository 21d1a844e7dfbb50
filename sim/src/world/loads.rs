//! What the liquid does to the flasks: its loads, which act two steps later.

use super::{World, WorldError};
use crate::bodies::Load;
use crate::pose::Pose;
use crate::solver::{FrameRecord, SolverError};
use glam::Vec3;
use vitriol_gpu::Ticket;
use vitriol_shaders::layout::LiquidLoad;

/// Steps after which the liquid's push acts on a flask. Two, always: by then
/// the device has finished the frame, so that no step waits for it, and a
/// replay has the same bits as the live session.
pub(super) const LOAD_DELAY: usize = 2;

/// A step's loads, on the device still or read already.
pub(super) enum PendingLoad {
    Device(FrameRecord, Ticket),
    Host(Vec<LiquidLoad>),
}

impl World {
    /// Impulse of the liquid on each flask in the last step, which acts on the flask
    /// two steps later; empty where no flask can move. Waits for the device.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn loads(&self) -> Result<Vec<Load>, WorldError> {
        let Some(newest) = self.loads.back() else {
            return Ok(Vec::new());
        };
        Ok(self.in_si(&newest.read()?))
    }

    /// The liquid's loads on the flasks of [`LOAD_DELAY`] steps ago; empty before there are any.
    pub(super) fn due_loads(&mut self) -> Result<Vec<Load>, WorldError> {
        if self.loads.len() < LOAD_DELAY {
            return Ok(Vec::new());
        }
        let Some(due) = self.loads.pop_front() else {
            return Ok(Vec::new());
        };
        let loads = due.read()?;
        if let PendingLoad::Device(record, _) = &*due {
            self.solver.note(record)?;
        }
        for (stirring, sum) in self.stirring.iter_mut().zip(&loads) {
            *stirring = sum.angular[3];
        }
        Ok(self.in_si(&loads))
    }

    fn in_si(&self, loads: &[LiquidLoad]) -> Vec<Load> {
        let mass = self.solver.parameters().particle_mass() as f32;
        loads
            .iter()
            .zip(self.bodies.poses())
            .map(|(sum, pose)| load(sum, *pose, mass))
            .collect()
    }
}

impl PendingLoad {
    pub(super) fn is_done(&self) -> Result<bool, WorldError> {
        match self {
            Self::Device(_, ticket) => Ok(ticket.is_done()?),
            Self::Host(_) => Ok(true),
        }
    }

    pub(super) fn read(&self) -> Result<Vec<LiquidLoad>, SolverError> {
        match self {
            Self::Device(record, ticket) => {
                // Checked first: a caller that steps only when the world is ready does not wait.
                if !ticket.is_done()? {
                    ticket.wait()?;
                }
                record.loads()
            }
            Self::Host(loads) => Ok(loads.clone()),
        }
    }
}

/// A flask's load from its sums over particles.
fn load(sum: &LiquidLoad, stage_from_flask: Pose, particle_mass: f32) -> Load {
    let axes = |v: [f32; 4]| Vec3::new(v[0], v[1], v[2]);
    let number = sum.impulse[3];
    let offset = axes(sum.offsets) / number.max(1.0);
    Load {
        impulse: axes(sum.impulse),
        angular_impulse: axes(sum.angular),
        liquid_mass: number * particle_mass,
        liquid_centre: stage_from_flask.orientation.inverse() * offset,
    }
}
