//! Looks at where the liquid is, behind a step.

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
    /// What looks know of the ones before, for another world that takes up this one's state; waits for the device.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn looks_memory(&self) -> Result<LooksMemory, WorldError> {
        self.wait()?;
        Ok(self.solver.looks_memory()?)
    }

    /// Goes on with what the looks of another world of this scene know, whose state this one has taken up.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn remember_looks(&mut self, memory: &LooksMemory) -> Result<(), WorldError> {
        self.solver.remember_looks(memory)?;
        self.keep_memory(memory);
        Ok(())
    }

    /// Looks at the state after the last step, on the queue of the steps; `skin` is that of the user. What came to a place is said by one
    /// look alone, so each is to be read. A look after each step, with what the step was taken with, says the same in a session
    /// and in its replay.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn look_on(&mut self, queue: QueueKind, skin: &[SkinPart]) -> Result<Look, WorldError> {
        let steps = self.step.saturating_sub(self.looked);
        let elapsed = steps as f64 * self.scene.scale.frame_time;
        // Before it: where the device is lost in it, it is made again with the step that it is behind.
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

    /// What it saw, if the device has got so far; does not wait.
    ///
    /// # Errors
    /// [`WorldError::Gpu`] where the device is lost.
    pub fn try_get(&self) -> Result<Option<Census>, WorldError> {
        match self.ticket.is_done()? {
            true => Ok(Some(self.record.get()?)),
            false => Ok(None),
        }
    }

    /// What it saw; waits for the device.
    ///
    /// # Errors
    /// [`WorldError::Gpu`] where the device is lost.
    pub fn get(&self) -> Result<Census, WorldError> {
        self.ticket.wait()?;
        Ok(self.record.get()?)
    }
}
