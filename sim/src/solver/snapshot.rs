//! The solver's state, taken from a device and put on one again.

use super::buffers::NO_PLACES;
use super::glass;
use super::steam::Steam;
use super::transfer::{read, write};
use super::{Counters, Solver, SolverError, SolverState};
use crate::chemistry::Chemistry;
use bytemuck::AnyBitPattern;
use std::sync::atomic::Ordering;
use vitriol_gpu::{Buffer, GpuError, QueueKind, Recorder};

/// Puts the first elements of a buffer's copy into the state.
type Fill = Box<dyn FnOnce(&mut SolverState) -> Result<(), GpuError> + Send>;

/// A state on its way to the host.
pub(crate) struct SolverStateRecord(Vec<Fill>);

impl SolverStateRecord {
    /// The state.
    ///
    /// # Errors
    /// [`GpuError::NotDone`] before the submission has finished.
    pub(crate) fn get(self) -> Result<SolverState, GpuError> {
        let mut state = SolverState::default();
        for fill in self.0 {
            fill(&mut state)?;
        }
        Ok(state)
    }

    /// Copies the first `count` elements of `buffer` into `field`; buffers are a few bytes longer where a scene is empty.
    fn copy<T: AnyBitPattern>(
        &mut self,
        rec: &mut Recorder,
        (buffer, count): (&Buffer, usize),
        field: fn(&mut SolverState) -> &mut Vec<T>,
    ) -> Result<(), GpuError> {
        if count > 0 {
            let readback = rec.read_back(buffer)?;
            self.0.push(Box::new(move |state| {
                let mut all = readback.get()?;
                all.truncate(count);
                *field(state) = all;
                Ok(())
            }));
        }
        Ok(())
    }
}

impl Solver {
    /// Reads the state to the host; waits for the device.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device fails.
    pub fn snapshot(&self) -> Result<SolverState, SolverError> {
        let mut rec = self.gpu.recorder(QueueKind::Main)?;
        let record = self.record_state(&mut rec)?;
        self.gpu.submit(rec)?.wait()?;
        Ok(record.get()?)
    }

    /// Records the copies of which a state is made, behind a frame.
    pub(crate) fn record_state(&self, rec: &mut Recorder) -> Result<SolverStateRecord, GpuError> {
        let b = &self.buffers;
        let n = self.count as usize;
        let [heat, matter] = self.lengths();
        let (bubbles, spray) = (self.bubbles_at_start(), self.spray_at_start());
        let mut to = SolverStateRecord(Vec::new());
        to.copy(rec, (&b.position, n), |it| &mut it.positions)?;
        to.copy(rec, (&b.velocity, n), |it| &mut it.velocities)?;
        to.copy(rec, (&b.tags, n), |it| &mut it.tags)?;
        to.copy(rec, (&b.heat, heat), |it| &mut it.heat)?;
        to.copy(rec, (&b.matter, matter), |it| &mut it.matter)?;
        to.copy(rec, (&b.ledger, matter), |it| &mut it.ledger)?;
        to.copy(rec, (&b.bulk, matter), |it| &mut it.bulk)?;
        to.copy(rec, (&b.eddies, matter), |it| &mut it.eddies)?;
        to.copy(rec, (&b.glass, self.rings()), |it| &mut it.glass)?;
        if let Some(steam) = &self.steam {
            let [puffs, vented, made] = steam.state(n);
            to.copy(rec, puffs, |it| &mut it.steam.puffs)?;
            to.copy(rec, vented, |it| &mut it.steam.vented)?;
            to.copy(rec, made, |it| &mut it.steam.made)?;
            if let Some(dew) = steam.state_of_dew() {
                to.copy(rec, dew, |it| &mut it.steam.dew)?;
            }
        }
        let count = (&b.bubbles, bubbles.bubbles.len());
        to.copy(rec, count, |it| &mut it.bubbles.bubbles)?;
        let count = (&b.bubbled, bubbles.bubbled.len());
        to.copy(rec, count, |it| &mut it.bubbles.bubbled)?;
        to.copy(rec, (&b.gas, bubbles.gas.len()), |it| &mut it.bubbles.gas)?;
        let count = (&b.merging, bubbles.merging.len());
        to.copy(rec, count, |it| &mut it.bubbles.merging)?;
        to.copy(rec, (&b.falls, bubbles.falls.len()), |it| {
            &mut it.bubbles.falls
        })?;
        let count = (&b.cell_starts, bubbles.cell_starts.len());
        to.copy(rec, count, |it| &mut it.bubbles.cell_starts)?;
        to.copy(rec, (&b.drops, spray.drops.len()), |it| &mut it.spray.drops)?;
        to.copy(rec, (&b.sprayed, spray.sprayed.len()), |it| {
            &mut it.spray.sprayed
        })?;
        to.copy(rec, (&b.spray_left, spray.left.len()), |it| {
            &mut it.spray.left
        })?;
        to.copy(rec, (&b.held, self.sticking()), |it| &mut it.held)?;
        to.copy(rec, (&b.list_origin, n), |it| &mut it.list_origin)?;
        to.copy(rec, (&b.list_counts, n), |it| &mut it.list_counts)?;
        let grid = self.grid;
        let words = grid.places(self.count) + grid.long(self.count);
        to.copy(rec, (&b.list, words as usize), |it| &mut it.list)?;
        let long_lists = rec.read_back(&b.long_lists)?;
        to.0.push(Box::new(move |state| {
            grid.settle(&state.list_counts, &long_lists.get()?, &mut state.list);
            Ok(())
        }));
        let words = size_of::<Counters>() / 4;
        to.copy(rec, (&b.counters, words), |it| &mut it.counters)?;
        Ok(to)
    }

    /// Puts a state on this device, a new one perhaps; what follows has the
    /// bits that it would have had without the interruption.
    ///
    /// # Errors
    /// [`SolverError::OtherState`], or [`SolverError::Gpu`].
    pub fn restore(&self, state: &SolverState) -> Result<(), SolverError> {
        let n = self.count as usize;
        let long_lists = self.grid.long_lists(&state.list_counts);
        let long = if self.grid.fit(long_lists[0], self.count) {
            4 * long_lists[0] as usize
        } else {
            0
        };
        let listed = self.grid.places(self.count) as usize + long;
        let [heat, matter] = self.lengths();
        let (steam, start) = (&state.steam, Steam::start(&self.parameters, n, self.flasks));
        let (bubbles, none) = (&state.bubbles, self.bubbles_at_start());
        let (spray, no_spray) = (&state.spray, self.spray_at_start());
        for (what, found, expected) in [
            ("positions", state.positions.len(), n),
            ("velocities", state.velocities.len(), n),
            ("tags", state.tags.len(), n),
            ("heat", state.heat.len(), heat),
            ("contents", state.matter.len(), matter),
            ("ledger", state.ledger.len(), matter),
            ("bulk", state.bulk.len(), matter),
            ("held lines", state.held.len(), self.sticking()),
            ("list origins", state.list_origin.len(), n),
            ("list counts", state.list_counts.len(), n),
            ("list", state.list.len(), listed),
            ("eddies", state.eddies.len(), matter),
            ("glass", state.glass.len(), self.rings()),
            ("puffs", steam.puffs.len(), start.puffs.len()),
            ("vented steam", steam.vented.len(), start.vented.len()),
            ("counts of steam", steam.made.len(), start.made.len()),
            ("dew", steam.dew.len(), start.dew.len()),
            ("bubbles", bubbles.bubbles.len(), none.bubbles.len()),
            (
                "bubbled particles",
                bubbles.bubbled.len(),
                none.bubbled.len(),
            ),
            ("gas", bubbles.gas.len(), none.gas.len()),
            ("joining bubbles", bubbles.merging.len(), none.merging.len()),
            ("falls", bubbles.falls.len(), none.falls.len()),
            ("cells", bubbles.cell_starts.len(), none.cell_starts.len()),
            ("drops", spray.drops.len(), no_spray.drops.len()),
            (
                "sprayed particles",
                spray.sprayed.len(),
                no_spray.sprayed.len(),
            ),
            (
                "flasks that spray left",
                spray.left.len(),
                no_spray.left.len(),
            ),
            ("counters", state.counters.len(), size_of::<Counters>() / 4),
        ] {
            if found != expected {
                return Err(SolverError::OtherState {
                    what,
                    found,
                    expected,
                });
            }
        }
        let any = state.list_counts.iter().any(|&count| count > 0);
        self.listed.store(any, Ordering::Relaxed);
        self.looks.begin_anew();
        let (b, gpu) = (&self.buffers, &self.gpu);
        write(gpu, &b.position, &state.positions)?;
        write(gpu, &b.velocity, &state.velocities)?;
        write(gpu, &b.tags, &state.tags)?;
        write(gpu, &b.heat, &state.heat)?;
        write(gpu, &b.matter, &state.matter)?;
        write(gpu, &b.ledger, &state.ledger)?;
        write(gpu, &b.bulk, &state.bulk)?;
        write(gpu, &b.eddies, &state.eddies)?;
        write(gpu, &b.glass, &state.glass)?;
        if let Some(steam) = &self.steam {
            steam.restore(gpu, &state.steam)?;
        }
        state.bubbles.write(gpu, b)?;
        state.spray.write(gpu, b)?;
        write(gpu, &b.held, &state.held)?;
        write(gpu, &b.list_origin, &state.list_origin)?;
        write(gpu, &b.list_counts, &state.list_counts)?;
        write(gpu, &b.list, &state.list)?;
        write(gpu, &b.long_lists, &long_lists)?;
        write(gpu, &b.counters, &state.counters)?;
        let mut rec = gpu.recorder(QueueKind::Main)?;
        rec.fill(&b.cell_counts, 0)?;
        rec.fill(&b.block_counts, 0)?;
        if self.pipelines.bubbles.is_some() {
            // At a frame's end nothing is to be born.
            rec.fill(&b.claims, 0)?;
            rec.fill(&b.live, 0)?;
            rec.upload(&b.live_args, &NO_PLACES)?;
        }
        rec.fill(&b.glass_taken, 0)?;
        rec.fill(&b.wetted, 0)?;
        if self.parameters.surface.is_some() {
            // Volumes are added to it, and each impulse leaves it at 0.
            rec.fill(&b.colour, 0)?;
        }
        // Nothing is stale yet; y and z of the dispatch sizes are 1.
        rec.upload(&b.list_args, &[[0u32, 1, 1, 0]; 3])?;
        gpu.submit(rec)?.wait()?;
        Ok(())
    }

    /// How long the arrays are that only some scenes have: `heat`, and those of `matter`.
    fn lengths(&self) -> [usize; 2] {
        let of = |asked: bool| if asked { self.count as usize } else { 0 };
        let chemistry = self.parameters.chemistry.as_ref();
        let physical = matches!(chemistry, Some(Chemistry::Physical(_)));
        [of(chemistry.is_some()), of(physical)]
    }

    /// Particles that walls can hold.
    fn sticking(&self) -> usize {
        if self.parameters.sticks() {
            self.count as usize
        } else {
            0
        }
    }

    fn rings(&self) -> usize {
        glass::ring_count(self.parameters.chemistry.as_ref(), self.flasks)
    }

    /// Reads the counters; waits for the device.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device fails.
    pub fn counters(&self) -> Result<Counters, SolverError> {
        let words = read::<Counters>(&self.gpu, &self.buffers.counters, 1)?;
        Ok(words.first().copied().unwrap_or_default())
    }
}
