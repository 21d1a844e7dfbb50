// The counting sort's result: where each cell's particles lie, by `cell_starts` of the including shader.
//!include common/liquid/sleep_cells.wgsl

/// Index of the first particle of a cell; of the end of what was sorted after the last.
fn start_of(cell: u32) -> u32 {
    let cells = half_table() * select(1u, 2u, SLEEP);
    if (cell >= cells) { return sorted_count(); }
    return cell_starts[cell];
}
