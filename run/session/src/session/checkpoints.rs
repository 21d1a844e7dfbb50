//! States from which the session restores the bench after its device is lost: they are read back again and again.
//!
//! The copies go to the host behind a frame's steps; a thread of its own makes a state of them, because they are some
//! megabytes. With the steps since that state, which are taken again, nothing of the liquid is lost.

use std::thread::JoinHandle;

use vitriol_gpu::{Recorder, Ticket};
use vitriol_run::{Blame, Failure};
use vitriol_sim::world::{Kept, StateRecord, World, WorldError};

/// Steps between two states: at 90 Hz a quarter of a second, so that with the one that is under way half a second of steps is
/// taken again at most.
const EVERY: u64 = 22;

/// Reads the world's state back at intervals, so that it can be restored where the device is lost.
#[derive(Default)]
pub(super) struct Checkpoints {
    /// The step that is kept next.
    due: u64,
    /// Copies on their way, with the submission that they are in.
    under_way: Option<(StateRecord, Ticket)>,
    reading: Option<JoinHandle<Result<Kept, WorldError>>>,
}

impl Checkpoints {
    /// Records the copies if they are due, behind all steps.
    pub fn record(
        &mut self,
        world: &World,
        rec: &mut Recorder,
    ) -> Result<Option<StateRecord>, Failure> {
        let busy = self.under_way.is_some() || self.reading.is_some();
        if busy || world.steps() < self.due {
            return Ok(None);
        }
        self.due = world.steps() + EVERY;
        world.record_state(rec).other().map(Some)
    }

    /// Takes in that the copies are part of that submission.
    pub fn submitted(&mut self, record: StateRecord, ticket: Ticket) {
        self.under_way = Some((record, ticket));
    }

    /// Has a thread make a state of copies that have arrived, and gives `world` a state that is made; does not wait.
    pub fn collect(&mut self, world: &mut World) -> Result<(), Failure> {
        if let Some(thread) = self.reading.take_if(|thread| thread.is_finished()) {
            let read = thread.join();
            let read = read.map_err(|_| "the state's reader broke down; report it");
            world.keep(read.other()?.other()?);
        }
        let is_done = match &self.under_way {
            Some((_, ticket)) => ticket.is_done().other()?,
            None => false,
        };
        if let Some((record, _)) = self.under_way.take_if(|_| is_done) {
            self.reading = Some(std::thread::spawn(move || record.kept()));
        }
        Ok(())
    }

    /// Another world, or this one on another device.
    pub fn forget(&mut self) {
        *self = Self::default();
    }
}
