// Rows of cells around a place, as the last rebuild of the list filled them. Particles may have moved by its margin since.
//!include common/liquid/cell_starts.wgsl

/// Particles of one row of cells along x: two runs of them, as the torus may wrap.
struct Runs {
    first: u32,
    count: u32,
    second: u32,
    wrapped: u32,
}

fn row_around(cell: vec3<i32>, reach: i32, row: u32) -> Runs {
    let side = u32(2 * reach + 1);
    let last = (1 << CELL_BITS_X) - 1;
    let low = u32((cell.x - reach) & last);
    let high = u32((cell.x + reach) & last);
    let wraps = low > high;
    let start = cell_index(vec3<i32>(0, cell.y + i32(row % side) - reach, cell.z + i32(row / side) - reach));
    let first = start_of(start + low);
    let end = start_of(start + select(high, u32(last), wraps) + 1u);
    let second = start_of(start);
    let second_end = select(second, start_of(start + high + 1u), wraps);
    return Runs(first, end - first, second, second_end - second);
}
