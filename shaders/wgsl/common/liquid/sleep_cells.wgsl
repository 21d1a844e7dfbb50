// The table of cells has a second half for liquid that sleeps: sorted by cell, it lies behind all other liquid, and neither finds the other.
//!include common/liquid/awake.wgsl
//!include common/liquid/cells.wgsl

/// Cells of one half.
fn half_table() -> u32 {
    return 1u << (CELL_BITS_X + CELL_BITS_Y + CELL_BITS_Z);
}

/// First cell of the half that a membership's particles are in.
fn table_half_of(membership: u32) -> u32 {
    return select(0u, half_table(), sleeps(membership));
}
