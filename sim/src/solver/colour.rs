//! Line 28: surface tension, by eight passes over particles and over nodes between them.

use super::{Solver, SolverError};
use crate::parameters::Parameters;
use crate::surface_tension::{SurfaceTension, flat};
use vitriol_gpu::Recorder;
use vitriol_shaders::layout::Step;

/// Nodes of a block, as in `common/liquid/colour.wgsl`.
pub(super) const BLOCK_NODES: u64 = 64;
/// Blocks about a block and itself.
pub(super) const AROUND: u64 = 27;

/// The table of blocks of nodes.
pub(super) struct Colour {
    /// Its slots, a power of two.
    pub(super) slots: u32,
}

impl Colour {
    /// A small piece of liquid takes some 35 blocks, and a particle within liquid a thirtieth of one: room for 140 pieces,
    /// and for one more to every 70 particles.
    pub(super) fn new(parameters: &Parameters, count: u32) -> Self {
        let pieces = 50 * (100 + count / 100);
        let wanted = match parameters.surface {
            Some(_) => pieces + count / 16,
            None => 1,
        };
        Self {
            slots: wanted.next_power_of_two(),
        }
    }

    /// Distance between nodes, metres.
    fn node(parameters: &Parameters) -> f64 {
        0.5 * parameters.support_radius
    }

    /// Constants of its shaders.
    pub(super) fn constants(
        &self,
        p: &Parameters,
        surface: &SurfaceTension,
    ) -> [(&'static str, f64); 8] {
        let node = Self::node(p);
        [
            ("BLOCK_SLOTS", self.slots.into()),
            ("MOST_BLOCKS", f64::from(self.slots / 4 * 3)),
            ("NODE", node),
            ("COLOUR_SHARE", p.particle_volume() / node.powi(3)),
            ("FLAT", flat()),
            (
                "TENSION",
                surface.tension / (flat() * p.rest_density * node * node),
            ),
            ("GROUND_WETTING", surface.ground.cos()),
            ("HYSTERESIS", surface.stickiness()),
        ]
    }
}

impl Solver {
    /// Substeps after which surface tension acts, and for how many.
    pub(super) fn impulses(&self) -> Vec<(u32, u32)> {
        let p = &self.parameters;
        let of = |surface: &SurfaceTension| {
            surface.impulses(p.particle_mass(), p.substeps, p.substep_time())
        };
        p.surface.as_ref().map(of).unwrap_or_default()
    }

    /// Surface tension at the committed positions, as an impulse over as many substeps: an impulse, and not the same
    /// acceleration in each of them, since a force of the past would feed waves.
    pub(super) fn hold_together(
        &self,
        rec: &mut Recorder,
        step: &Step,
        substeps: u32,
    ) -> Result<(), SolverError> {
        let Some(tension) = &self.pipelines.tension else {
            return Ok(());
        };
        rec.fill(&self.buffers.colour_keys, 0)?;
        rec.upload(&self.buffers.colour_args, &[0u32, 1, 1, 0, 0, 1, 1, 0])?;
        self.over_awake(self.pass(rec, &tension.colour).constants(step))?;
        let blocks = &self.buffers.colour_args;
        self.pass(rec, &tension.rim).indirect(blocks, 0)?;
        self.pass(rec, &tension.walls)
            .constants(step)
            .indirect(blocks, 0)?;
        self.pass(rec, &tension.smooth).indirect(blocks, 0)?;
        self.pass(rec, &tension.interface).indirect(blocks, 0)?;
        self.pass(rec, &tension.unfiltered).indirect(blocks, 0)?;
        // Particles have their own nodes' only.
        self.pass(rec, &tension.curvature).indirect(blocks, 16)?;
        let step = Step {
            tension: step.time * substeps as f32,
            ..*step
        };
        self.over_awake(self.pass(rec, &tension.push).constants(&step))
    }
}
