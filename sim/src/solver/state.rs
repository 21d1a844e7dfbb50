//! The solver's state on the host: taken, compared, and put on a device again.

use super::pipelines::Grid;
use super::{Counters, Particle, Solver, SolverError};
use serde::{Deserialize, Serialize};
use vitriol_gpu::{Buffer, Gpu};
use xxhash_rust::xxh3::Xxh3;

/// Everything that the next frame depends on. The neighbour list is part of
/// it: rebuilt at another moment than in the run that was interrupted, it
/// would have the same pairs in another order, and sums other bits.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct SolverState {
    /// Positions in the stage (m) by slot; w is −1 for one taken out.
    pub positions: Vec<[f32; 4]>,
    /// Velocities (m/s) by slot; w is the carried multiplier −p/ρ (m²/s²).
    pub velocities: Vec<[f32; 4]>,
    /// (membership, identity) by slot: 0 for nobody's, k + 1 for flask k's,
    /// `u32::MAX` for one taken out; and the particle's index at the start.
    pub tags: Vec<[u32; 2]>,
    /// (temperature in °C, acid mass fraction, …) by slot; empty where no heat
    /// is modelled.
    pub heat: Vec<[f32; 4]>,
    /// Predicted positions when the list was built.
    list_origin: Vec<[f32; 4]>,
    list_counts: Vec<u32>,
    list: Vec<u32>,
    counters: Vec<u32>,
}

/// Membership of a particle that was taken out.
const REMOVED: u32 = u32::MAX;

impl SolverState {
    /// The state before the first frame: a list that is stale for all.
    pub(super) fn start(particles: &[Particle], grid: &Grid, heated: bool) -> Self {
        let n = particles.len();
        let words = |v: glam::DVec3, w: f32| [v.x as f32, v.y as f32, v.z as f32, w];
        let membership = |p: &Particle| p.flask.map_or(0, |flask| flask as u32 + 1);
        Self {
            positions: particles.iter().map(|p| words(p.position, 1.0)).collect(),
            velocities: particles
                .iter()
                .map(|p| words(p.velocity, p.carried as f32))
                .collect(),
            tags: (0..)
                .zip(particles)
                .map(|(i, p)| [membership(p), i])
                .collect(),
            heat: particles
                .iter()
                .filter(|_| heated)
                .map(|p| [p.temperature as f32, p.acid as f32, 0.0, 0.0])
                .collect(),
            list_origin: vec![[f32::NAN; 4]; n],
            list_counts: vec![0; n],
            list: vec![0; n * grid.list_capacity as usize],
            counters: vec![0; size_of::<Counters>() / 4],
        }
    }

    /// Hash of what a replay must repeat: every particle's bits of position,
    /// velocity, membership and heat, in the order of their identities.
    pub fn hash(&self) -> u64 {
        let mut order: Vec<usize> = (0..self.tags.len()).collect();
        order.sort_by_key(|&slot| self.tags[slot][1]);
        let mut hash = Xxh3::new();
        for slot in order {
            hash.update(bytemuck::bytes_of(&self.positions[slot]));
            hash.update(bytemuck::bytes_of(&self.velocities[slot]));
            hash.update(bytemuck::bytes_of(&self.tags[slot]));
            if let Some(heat) = self.heat.get(slot) {
                hash.update(bytemuck::bytes_of(heat));
            }
        }
        hash.digest()
    }

    /// Whether the particle in a slot is still there.
    pub fn is_present(&self, slot: usize) -> bool {
        self.tags[slot][0] != REMOVED
    }

    /// Index of the flask that the particle in a slot is in.
    pub fn flask_of(&self, slot: usize) -> Option<usize> {
        match self.tags[slot][0] {
            0 | REMOVED => None,
            membership => Some(membership as usize - 1),
        }
    }
}

impl Solver {
    /// Reads the state to the host; waits for the device.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device fails.
    pub fn snapshot(&self) -> Result<SolverState, SolverError> {
        let (b, gpu) = (&self.buffers, &self.gpu);
        let n = self.count as usize;
        Ok(SolverState {
            positions: read(gpu, &b.position, n)?,
            velocities: read(gpu, &b.velocity, n)?,
            tags: read(gpu, &b.tags, n)?,
            heat: read(gpu, &b.heat, self.heated())?,
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
        for (what, found, expected) in [
            ("positions", state.positions.len(), n),
            ("velocities", state.velocities.len(), n),
            ("tags", state.tags.len(), n),
            ("heat", state.heat.len(), self.heated()),
            ("list origins", state.list_origin.len(), n),
            ("list counts", state.list_counts.len(), n),
            ("list", state.list.len(), listed),
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
        let (b, gpu) = (&self.buffers, &self.gpu);
        write(gpu, &b.position, &state.positions)?;
        write(gpu, &b.velocity, &state.velocities)?;
        write(gpu, &b.tags, &state.tags)?;
        write(gpu, &b.heat, &state.heat)?;
        write(gpu, &b.list_origin, &state.list_origin)?;
        write(gpu, &b.list_counts, &state.list_counts)?;
        write(gpu, &b.list, &state.list)?;
        write(gpu, &b.counters, &state.counters)?;
        let mut rec = gpu.recorder(vitriol_gpu::QueueKind::Main)?;
        rec.fill(&b.cell_counts, 0)?;
        // Nothing is stale yet; y and z of the dispatch sizes are 1.
        rec.upload(&b.list_args, &[[0u32, 1, 1, 0]; 4])?;
        gpu.submit(rec)?.wait()?;
        Ok(())
    }

    /// Particles that have a temperature: all or none.
    fn heated(&self) -> usize {
        match self.parameters.chemistry {
            Some(_) => self.count as usize,
            None => 0,
        }
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

/// The first `count` elements; buffers are a few bytes longer where a scene is empty.
fn read<T: bytemuck::AnyBitPattern>(
    gpu: &Gpu,
    buffer: &Buffer,
    count: usize,
) -> Result<Vec<T>, SolverError> {
    let mut all = gpu.read(buffer)?;
    all.truncate(count);
    Ok(all)
}

fn write<T: bytemuck::NoUninit>(gpu: &Gpu, buffer: &Buffer, data: &[T]) -> Result<(), SolverError> {
    if !data.is_empty() {
        gpu.write(buffer, data)?;
    }
    Ok(())
}
