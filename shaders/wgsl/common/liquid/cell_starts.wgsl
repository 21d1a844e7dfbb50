// The counting sort's result: where each cell's particles lie, by `cell_starts` of the including shader.
//!include common/liquid/cells.wgsl
//!include common/liquid/particle.wgsl

/// Index of the first particle of a cell; of the end of the table after the last.
fn start_of(cell: u32) -> u32 {
    if (cell >= 1u << (CELL_BITS_X + CELL_BITS_Y + CELL_BITS_Z)) { return COUNT; }
    return cell_starts[cell];
}
