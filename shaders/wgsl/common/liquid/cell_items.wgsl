// Where the first particles of each cell are noted during a rebuild, in memory that the list takes up afterwards. So they need not wait until
// it is known where each cell begins.
//!include common/liquid/cells.wgsl
//!include common/liquid/particle.wgsl

/// Particles of a cell for which there is room: half of a list's and more, where there are more than some 500 particles. In liquid at rest
/// a cell has a sixth of a list's on average.
override CELL_ITEMS: u32 = 1u;

/// Place of a cell's nth.
fn item_of(cell: u32, n: u32) -> u32 {
    return cell * CELL_ITEMS + n;
}
