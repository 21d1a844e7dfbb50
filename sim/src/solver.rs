//! Algorithm 1 on the GPU.
//!
//! `frame.rs` is the loop itself. Each pass is a file of the same name in the
//! shaders' folder `sim/`; `reference/` is the same mathematics in f64.
//!
//! Few passes, since a dispatch with its barrier costs as much as the work of
//! a small scene: two over neighbours per iteration (`multiplier`,
//! `displacement`), and `forces`. The last displacement also commits (lines 22
//! to 25); `forces` has lines 26 to 28 and the next substep's prediction (line
//! 16). The neighbour list is rebuilt when a particle has used up its
//! margin; the GPU decides, by the sizes of four indirect dispatches.

mod bubbles;
mod buffers;
mod bundles;
mod carry;
mod census;
mod colour;
mod counters;
mod dormant;
mod error;
mod frame;
mod grid;
mod handle;
mod lanes;
mod matter;
mod pane;
mod pipelines;
mod search;
mod sleep;
mod snapshot;
mod solids;
mod spec;
mod spray;
mod state;
mod steam;
mod still;
mod transfer;
mod vapour;
mod vessels;
mod wall_heat;

pub(crate) use census::LooksMemoryRecord;
pub use census::{
    BubbleCount, Bubbling, Came, Census, CensusRecord, HARMFUL, Held, LYING, Landed, LooksMemory,
    MOST_LIMBS, Moved, Onto, Place, SCALDS, Skin, SkinPart, Touching,
};
pub use counters::Counters;
pub use dormant::Dormant;
pub use error::SolverError;
pub use frame::FrameRecord;
pub use handle::{ROD_DRAG, Touch};
pub use pane::Pane;
pub(crate) use snapshot::SolverStateRecord;
pub use spec::{Ground, Particle, SolverSpec};
pub use state::SolverState;
pub use vapour::PUFFS;

use crate::chemistry::Chemistry;
use crate::parameters::Parameters;
use buffers::Buffers;
use bundles::Bundles;
use census::Looks;
use grid::Grid;
use pipelines::{Constants, Pipelines};
use std::sync::atomic::{AtomicBool, Ordering};
use steam::SteamPasses;
use still::Still;
use vessels::Vessels;
use vitriol_gpu::{Buffer, Gpu, QueueKind};
use vitriol_shaders::Library;

/// The particles of a scene on a device, and the passes that move them.
pub struct Solver {
    gpu: Gpu,
    parameters: Parameters,
    coefficients: Vec<(f64, f64)>,
    count: u32,
    flasks: usize,
    grid: Grid,
    lanes: u32,
    loads: bool,
    /// Whether a frame has been recorded, which makes the neighbour list.
    listed: AtomicBool,
    /// Elements of each array of a state, in the order of their table.
    lengths: Vec<usize>,
    buffers: Buffers,
    vessels: Vessels,
    pipelines: Pipelines,
    steam: Option<SteamPasses>,
    looks: Looks,
    bundles: Bundles,
    still: Still,
}

impl Solver {
    /// Compiles the passes that the scene needs and puts its particles on the
    /// device.
    ///
    /// # Errors
    /// [`SolverError`] where a shader or the device refuses.
    pub fn new(gpu: &Gpu, library: &Library, spec: &SolverSpec<'_>) -> Result<Self, SolverError> {
        let count = u32::try_from(spec.particles.len())
            .map_err(|_| SolverError::TooManyParticles(spec.particles.len()))?;
        let grid = Grid::new(&spec.parameters, count, spec.flasks.len());
        let lanes = spec
            .lanes
            .unwrap_or_else(|| lanes::of_particles(gpu, count));
        let list_lanes = spec.lanes.unwrap_or_else(|| lanes::of_list(gpu, count));
        let group = lanes::group(gpu, lanes);
        let mut rec = gpu.recorder(QueueKind::Main)?;
        let vessels = Vessels::new(gpu, &mut rec, spec)?;
        let buffers = Buffers::new(gpu, &mut rec, spec, count, &grid)?;
        // `restore` waits for it, behind it on its queue.
        gpu.submit(rec)?;
        let constants = Constants::new(spec, count, &grid, [lanes, list_lanes, group]);
        let all = buffers.all(&vessels);
        let pipelines = Pipelines::new(gpu, library, spec, &constants, &all)?;
        let steam = SteamPasses::new(gpu, library, spec, &constants, &all)?;
        let sizes = [count as usize, spec.flasks.len()];
        let looks = Looks::new(
            gpu,
            library,
            &spec.parameters,
            sizes,
            (spec.ground.scale, spec.tools),
            (&constants, &buffers, &vessels),
        )?;
        let start = SolverState::start(spec, &grid);
        let solver = Self {
            lengths: snapshot::lengths(&start),
            gpu: gpu.clone(),
            coefficients: spec
                .parameters
                .relaxation
                .coefficients(spec.parameters.iterations),
            parameters: spec.parameters.clone(),
            count,
            flasks: spec.flasks.len(),
            grid,
            lanes,
            loads: spec.loads,
            listed: AtomicBool::new(false),
            buffers,
            vessels,
            pipelines,
            steam,
            looks,
            bundles: Bundles::default(),
            still: Still::default(),
        };
        solver.restore(&start)?;
        Ok(solver)
    }

    /// Solves from the next frame on with these substeps a frame and iterations a substep; only
    /// the poses' buffer and the iterations' coefficients depend on them.
    pub(crate) fn set_effort(&mut self, substeps: u32, iterations: u32) -> Result<(), SolverError> {
        self.still.disturb();
        let bytes = buffers::bytes_of_poses(substeps, self.flasks as u64);
        if self.buffers.poses.bytes() < bytes {
            self.buffers.poses = Buffer::storage(&self.gpu, "poses", bytes)?;
            self.bundles.clear();
        }
        let parameters = &mut self.parameters;
        (parameters.substeps, parameters.iterations) = (substeps, iterations);
        self.coefficients = parameters.relaxation.coefficients(iterations);
        Ok(())
    }

    /// k_v of Eq. 17; `None` where the paper's boiling is not modelled.
    pub(crate) fn intensity(&self) -> Option<f64> {
        match &self.parameters.chemistry {
            Some(Chemistry::Paper(paper)) => Some(paper.boiling?.intensity),
            _ => None,
        }
    }

    /// Solves from the next frame on with this k_v (Eq. 17); without effect where the paper's boiling is not modelled.
    pub(crate) fn set_intensity(&mut self, intensity: f64) {
        if let Some(Chemistry::Paper(paper)) = &mut self.parameters.chemistry
            && let Some(boiling) = &mut paper.boiling
        {
            boiling.intensity = intensity;
        }
    }

    /// Number of particles, those taken out included.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Parameters it runs with.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// Positions as `array<vec4<f32>>`, stage frame, metres; w is −1 for a
    /// particle that was taken out, else the vapour that it holds over V0·ρ0.
    /// For the renderer, in place.
    pub fn positions(&self) -> &Buffer {
        &self.buffers.position
    }

    /// Velocities as `array<vec4<f32>>`, m/s, in the order of the positions;
    /// w is no velocity.
    pub fn velocities(&self) -> &Buffer {
        &self.buffers.velocity
    }

    /// Volume over that at rest density, and more, as `array<vec4<f32>>`, in the
    /// order of the positions; `None` where each particle has the same.
    pub fn volumes(&self) -> Option<&Buffer> {
        match &self.parameters.chemistry {
            Some(Chemistry::Physical(physical)) if physical.density => Some(&self.buffers.bulk),
            _ => None,
        }
    }

    /// Temperature (°C), acid mass fraction and more as `array<vec4<f32>>`, in
    /// the order of the positions; `None` where no heat is modelled.
    pub fn heat(&self) -> Option<&Buffer> {
        self.parameters
            .chemistry
            .as_ref()
            .map(|_| &self.buffers.heat)
    }

    /// Number of neighbours of each particle as `array<u32>`, the list itself as `array<vec4<u32>>`, and the number of fours in a
    /// particle's place. The list has the layout of `common/liquid/list_block.wgsl`, the last four filled up with the particle itself. It
    /// is complete within the support radius at the positions after a frame, except for particles with more neighbours than a place has
    /// room for: of their longer lists only the first ones are here. `None` before the first frame.
    pub fn neighbours(&self) -> Option<(&Buffer, &Buffer, u32)> {
        let listed = self.listed.load(Ordering::Relaxed);
        let fours = self.grid.list_capacity / 4;
        listed.then_some((&self.buffers.list_counts, &self.buffers.list, fours))
    }

    /// The flasks' shapes and their distances to the glass over (r, y), as
    /// `common/glass/glass_distance.wgsl` reads them.
    pub fn flask_tables(&self) -> (&Buffer, &Buffer) {
        (&self.vessels.flasks, &self.vessels.distances)
    }

    /// Puffs of steam, `array<Puff>` of `common/chemistry/puff.wgsl`, [`PUFFS`] of them;
    /// a record of radius 0 is empty. `None` where no steam leaves the liquid.
    pub fn puffs(&self) -> Option<&Buffer> {
        self.steam.as_ref().map(|_| &self.buffers.puffs)
    }

    /// Water on the flasks' inner walls, `array<Dew>` of `common/chemistry/dew.wgsl`: by flask, from the inner floor up, and around
    /// from +X towards +Z. `None` where none condenses.
    pub fn dew(&self) -> Option<&Buffer> {
        let steam = self.steam.as_ref().filter(|steam| steam.condenses());
        steam.map(|_| &self.buffers.dew)
    }

    /// Bubbles, `array<Bubble>` of `common/chemistry/bubble.wgsl`, and the number of their places; a record without steam and air is
    /// empty. `None` where vapour has no volume.
    pub fn bubbles(&self) -> Option<(&Buffer, u32)> {
        let bubbles = self.parameters.bubbles()?;
        Some((&self.buffers.bubbles, bubbles.slots()))
    }

    /// Drops that bubbles threw up, `array<Drops>` of `common/chemistry/drops.wgsl`, two records for each place of a bubble. `None` where
    /// spray is not modelled.
    pub fn drops(&self) -> Option<&Buffer> {
        let bubbles = self.parameters.bubbles()?;
        (bubbles.places_of_drops() > 0).then_some(&self.buffers.drops)
    }

    /// Bytes of device memory that a particle takes.
    pub fn bytes_per_particle(&self) -> u64 {
        let all = self.buffers.all(&self.vessels);
        let of_particles = all.iter().take(buffers::OF_PARTICLES);
        let count = u64::from(self.count.max(1));
        // A buffer that a scene has no use for still has a few bytes.
        let used = of_particles.map(|buffer| buffer.bytes());
        used.filter(|&bytes| bytes >= count).sum::<u64>() / count
    }
}
