//! Lines 9 to 12: the neighbour list, as passes.

use super::{Solver, SolverError};
use vitriol_gpu::Recorder;
use vitriol_shaders::layout::Step;

impl Solver {
    /// Counting sort by cell, reordering and list, all with no workgroups
    /// while the list of an earlier substep serves.
    pub(super) fn find_neighbours(
        &self,
        rec: &mut Recorder,
        step: &Step,
    ) -> Result<(), SolverError> {
        const PARTICLES: u64 = 0;
        const CELLS: u64 = 16;
        const LIST: u64 = 32;
        let (p, args) = (&self.pipelines, &self.buffers.list_args);
        for (pass, size) in [
            (&p.cell_count, PARTICLES),
            (&p.cell_scan, CELLS),
            (&p.reorder, PARTICLES),
        ] {
            self.pass(rec, pass).indirect(args, size)?;
        }
        self.pass(rec, &p.list)
            .constants(step)
            .indirect(args, LIST)?;
        Ok(())
    }
}
