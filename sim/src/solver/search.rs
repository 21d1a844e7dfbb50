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
        let (b, p) = (&self.buffers, &self.pipelines);
        const PARTICLES: u64 = 0;
        const CELLS: u64 = 16;
        const LIST: u64 = 32;
        const ONE: u64 = 48;
        rec.pass(&p.cell_count)
            .read("trial", &b.trial)
            .write("cell_counts", &b.cell_counts)
            .indirect(&b.list_args, PARTICLES)?;
        rec.pass(&p.cell_scan)
            .read("cell_counts", &b.cell_counts)
            .write("cell_starts", &b.cell_starts)
            .write("block_sums", &b.block_sums)
            .indirect(&b.list_args, CELLS)?;
        rec.pass(&p.block_scan)
            .write("block_sums", &b.block_sums)
            .indirect(&b.list_args, ONE)?;
        rec.pass(&p.cell_scatter)
            .read("trial", &b.trial)
            .read("cell_starts", &b.cell_starts)
            .read("block_sums", &b.block_sums)
            .write("cell_counts", &b.cell_counts)
            .write("cell_items", &b.cell_items)
            .indirect(&b.list_args, PARTICLES)?;
        rec.pass(&p.reorder)
            .read("trial", &b.trial)
            .read("position", &b.position)
            .read("velocity", &b.velocity)
            .read("tags", &b.tags)
            .read("wall_push", &b.wall_push)
            .read("heat", &b.heat)
            .read("matter", &b.matter)
            .read("bulk", &b.bulk)
            .read("cell_starts", &b.cell_starts)
            .read("block_sums", &b.block_sums)
            .read("cell_items", &b.cell_items)
            .write("sorted_trial", &b.solved)
            .write("sorted_position", &b.sorted_position)
            .write("sorted_velocity", &b.new_velocity)
            .write("sorted_tags", &b.sorted_tags)
            .write("sorted_push", &b.sorted_push)
            .write("sorted_heat", &b.sorted_heat)
            .write("sorted_matter", &b.sorted_matter)
            .write("sorted_bulk", &b.sorted_bulk)
            .indirect(&b.list_args, PARTICLES)?;
        self.vessels(rec.pass(&p.list))
            .read("sorted_trial", &b.solved)
            .read("sorted_position", &b.sorted_position)
            .read("sorted_velocity", &b.new_velocity)
            .read("sorted_tags", &b.sorted_tags)
            .read("sorted_push", &b.sorted_push)
            .read("sorted_heat", &b.sorted_heat)
            .read("sorted_matter", &b.sorted_matter)
            .read("sorted_bulk", &b.sorted_bulk)
            .read("cell_starts", &b.cell_starts)
            .read("block_sums", &b.block_sums)
            .write("trial", &b.trial)
            .write("position", &b.position)
            .write("velocity", &b.velocity)
            .write("tags", &b.tags)
            .write("wall_push", &b.wall_push)
            .write("heat", &b.heat)
            .write("matter", &b.matter)
            .write("bulk", &b.bulk)
            .write("list_origin", &b.list_origin)
            .write("list_counts", &b.list_counts)
            .write("list", &b.list)
            .write("counters", &b.counters)
            .constants(step)
            .indirect(&b.list_args, LIST)?;
        Ok(())
    }
}
