// The cells around a place, as the last rebuild of the list filled them. Particles may have moved by the list's reach since.
//!include common/liquid/cell_starts.wgsl

/// Particles of a cell: from the first to before the end.
struct Run {
    first: u32,
    end: u32,
}

/// How many cells are within `reach` cells of one.
fn count_around(reach: i32) -> u32 {
    let side = u32(2 * reach + 1);
    return side * side * side;
}

/// Cell n of those.
fn cell_around(cell: vec3<i32>, reach: i32, n: u32) -> Run {
    let side = u32(2 * reach + 1);
    let offset = vec3<i32>(vec3<u32>(n % side, n / side % side, n / (side * side))) - reach;
    return run_of(cell + offset);
}

fn run_of(cell: vec3<i32>) -> Run {
    let index = cell_index(cell);
    return Run(start_of(index), start_of(index + 1u));
}
