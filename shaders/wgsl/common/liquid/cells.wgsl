// The cells of the neighbour search: a torus of cells, so that the scene has
// no bounds. Two distant cells may share a place in it; the distance test
// tells them apart. Coordinates are floored, not truncated: truncation loses
// neighbours around zero.

/// Edge of a cell, metres: support radius plus list margin.
override CELL: f32 = 0.00525;
/// Logarithms of the number of cells in x, y, z.
override CELL_BITS_X: u32 = 4u;
override CELL_BITS_Y: u32 = 4u;
override CELL_BITS_Z: u32 = 4u;

/// Cells that one workgroup scans.
const SCAN_BLOCK: u32 = 1024u;

fn cell_of(x: vec3<f32>) -> vec3<i32> {
    return vec3<i32>(floor(x / CELL));
}

/// Logarithm of the cells along each edge of a block. The smallest table has 16 × 8 × 8 cells, so blocks fill it.
const BLOCK_BITS: u32 = 2u;

/// Place of a cell in the table: cells of a block lie side by side, and in either x runs fastest. So a workgroup's particles fill a
/// compact piece of the liquid and share their neighbours.
fn cell_index(cell: vec3<i32>) -> u32 {
    let c = bitcast<vec3<u32>>(cell)
        & vec3<u32>((1u << CELL_BITS_X) - 1u, (1u << CELL_BITS_Y) - 1u, (1u << CELL_BITS_Z) - 1u);
    let within = c & vec3<u32>((1u << BLOCK_BITS) - 1u);
    let block = c >> vec3<u32>(BLOCK_BITS);
    let place = within.x | (within.y << BLOCK_BITS) | (within.z << (2u * BLOCK_BITS));
    let blocks = block.x | (block.y << (CELL_BITS_X - BLOCK_BITS)) | (block.z << (CELL_BITS_X + CELL_BITS_Y - 2u * BLOCK_BITS));
    return place | (blocks << (3u * BLOCK_BITS));
}
