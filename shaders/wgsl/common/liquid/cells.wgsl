// The cells of the neighbour search: a torus of cells, so that the scene has
// no bounds. Two distant cells may share a place in it; the distance test
// tells them apart. Coordinates are floored, not truncated: truncation loses
// neighbours around zero.

/// Edge of a cell, metres: support radius plus list margin.
override CELL: f32 = 0.00575;
/// Logarithms of the number of cells in x, y, z.
override CELL_BITS_X: u32 = 4u;
override CELL_BITS_Y: u32 = 4u;
override CELL_BITS_Z: u32 = 4u;

/// Cells that one workgroup scans.
const SCAN_BLOCK: u32 = 1024u;

fn cell_of(x: vec3<f32>) -> vec3<i32> {
    return vec3<i32>(floor(x / CELL));
}

/// Place of a cell in the table; x runs fastest.
fn cell_index(cell: vec3<i32>) -> u32 {
    let c = bitcast<vec3<u32>>(cell)
        & vec3<u32>((1u << CELL_BITS_X) - 1u, (1u << CELL_BITS_Y) - 1u, (1u << CELL_BITS_Z) - 1u);
    return c.x | (c.y << CELL_BITS_X) | (c.z << (CELL_BITS_X + CELL_BITS_Y));
}
