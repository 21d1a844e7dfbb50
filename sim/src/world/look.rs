//! Looks: censuses of where the liquid is, each after a step.

use super::lifeline::Act;
use super::{World, WorldError};
use crate::solver::{Census, CensusRecord, LooksMemory, SkinPart};
use vitriol_gpu::{QueueKind, Ticket};

/// A look that is under way.
pub struct Look {
    record: CensusRecord,
    ticket: Ticket,
    /// Simulated time since the look before, s.
    pub elapsed: f64,
}

impl World {
    /// The looks' memory of the ones before, for another world that takes up this one's state; waits for the device.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn looks_memory(&self) -> Result<LooksMemory, WorldError> {
        self.wait()?;
        Ok(self.solver.looks_memory()?)
    }

    /// Takes up the looks' memory of another world of this scene, whose state this one has taken up.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn remember_looks(&mut self, memory: &LooksMemory) -> Result<(), WorldError> {
        self.solver.remember_looks(memory)?;
        self.keep_memory(memory);
        Ok(())
    }

    /// Takes a census of the state after the last step, on the queue of the steps; `skin` is that of the user. An arrival at a place is
    /// counted in one look alone, so each is to be read. Looks after each step, with that step's input, have the same values in a
    /// session and in its replay.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn look_on(&mut self, queue: QueueKind, skin: &[SkinPart]) -> Result<Look, WorldError> {
        let steps = self.step.saturating_sub(self.looked);
        let elapsed = steps as f64 * self.scene.scale.frame_time;
        // Noted before the submission: where the device is lost in it, the look is repeated with the step before it.
        self.note(Act::Look(queue, skin.to_vec()));
        let mut rec = self.gpu.recorder(queue)?;
        let record = self.solver.record_census(&mut rec, skin, elapsed)?;
        let ticket = self.gpu.submit(rec)?;
        self.looked = self.step;
        Ok(Look {
            record,
            ticket,
            elapsed,
        })
    }
}

impl Look {
    /// The submission that it is in.
    pub fn ticket(&self) -> &Ticket {
        &self.ticket
    }

    /// The census, if the device has finished it; does not wait.
    ///
    /// # Errors
    /// [`WorldError::Gpu`] where the device is lost.
    pub fn try_get(&self) -> Result<Option<Census>, WorldError> {
        match self.ticket.is_done()? {
            true => Ok(Some(self.record.get()?)),
            false => Ok(None),
        }
    }

    /// The census; waits for the device.
    ///
    /// # Errors
    /// [`WorldError::Gpu`] where the device is lost.
    pub fn get(&self) -> Result<Census, WorldError> {
        self.ticket.wait()?;
        Ok(self.record.get()?)
    }
}
