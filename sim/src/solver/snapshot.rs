//! The solver's state, taken from a device and put on one again.

use super::bubbles::BubbleState;
use super::buffers::NO_PLACES;
use super::glass;
use super::spray::SprayState;
use super::steam::{Steam, SteamState};
use super::transfer::{read, write};
use super::{Counters, Solver, SolverError, SolverState};
use crate::chemistry::Chemistry;
use std::sync::atomic::Ordering;

impl Solver {
    /// Reads the state to the host; waits for the device.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device fails.
    pub fn snapshot(&self) -> Result<SolverState, SolverError> {
        let (b, gpu) = (&self.buffers, &self.gpu);
        let n = self.count as usize;
        let [heat, matter] = self.lengths();
        Ok(SolverState {
            positions: read(gpu, &b.position, n)?,
            velocities: read(gpu, &b.velocity, n)?,
            tags: read(gpu, &b.tags, n)?,
            heat: read(gpu, &b.heat, heat)?,
            matter: read(gpu, &b.matter, matter)?,
            ledger: read(gpu, &b.ledger, matter)?,
            bulk: read(gpu, &b.bulk, matter)?,
            eddies: read(gpu, &b.eddies, matter)?,
            glass: read(gpu, &b.glass, self.rings())?,
            steam: match &self.steam {
                Some(steam) => steam.snapshot(gpu, n)?,
                None => SteamState::default(),
            },
            bubbles: BubbleState::read(gpu, b, &self.bubbles_at_start())?,
            spray: SprayState::read(gpu, b, &self.spray_at_start())?,
            held: read(gpu, &b.held, self.sticking())?,
            list_origin: read(gpu, &b.list_origin, n)?,
            list_counts: read(gpu, &b.list_counts, n)?,
            list: read(gpu, &b.list, n * self.grid.list_capacity as usize)?,
            counters: read(gpu, &b.counters, size_of::<Counters>() / 4)?,
        })
    }

    /// Puts a state on this device, a new one perhaps; what follows has the
    /// bits that it would have had without the interruption.
    ///
    /// # Errors
    /// [`SolverError::OtherState`], or [`SolverError::Gpu`].
    pub fn restore(&self, state: &SolverState) -> Result<(), SolverError> {
        let n = self.count as usize;
        let listed = n * self.grid.list_capacity as usize;
        let [heat, matter] = self.lengths();
        let (steam, start) = (&state.steam, Steam::start(&self.parameters, n));
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
            ("vents", steam.made.len(), start.made.len()),
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
            ("blocks", bubbles.block_sums.len(), none.block_sums.len()),
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
        write(gpu, &b.counters, &state.counters)?;
        let mut rec = gpu.recorder(vitriol_gpu::QueueKind::Main)?;
        rec.fill(&b.cell_counts, 0)?;
        if self.pipelines.bubbles.is_some() {
            // At a frame's end nothing is to be born.
            rec.fill(&b.claims, 0)?;
            rec.fill(&b.live, 0)?;
            rec.upload(&b.live_args, &NO_PLACES)?;
        }
        rec.fill(&b.glass_taken, 0)?;
        if self.parameters.surface.is_some() {
            // Volumes are added to it, and each impulse leaves it at 0.
            rec.fill(&b.colour, 0)?;
        }
        // Nothing is stale yet; y and z of the dispatch sizes are 1.
        rec.upload(&b.list_args, &[[0u32, 1, 1, 0]; 4])?;
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
