// The cells around a place, as the last rebuild of the list filled them. Particles may have moved by the list's reach since.
//!include common/liquid/cell_starts.wgsl

/// Particles of a cell: from the first to before the end.
struct Run {
    first: u32,
    end: u32,
}

/// How many cells along each axis are within `reach` cells of one: of a torus that is smaller, each once.
fn sides_around(reach: i32) -> vec3<u32> {
    let all = vec3<u32>(1u << CELL_BITS_X, 1u << CELL_BITS_Y, 1u << CELL_BITS_Z);
    return min(vec3<u32>(u32(2 * reach + 1)), all);
}

fn count_around(reach: i32) -> u32 {
    let sides = sides_around(reach);
    return sides.x * sides.y * sides.z;
}

/// Cell n of those.
fn cell_around(cell: vec3<i32>, reach: i32, n: u32) -> Run {
    let sides = sides_around(reach);
    let offset = vec3<i32>(vec3<u32>(n % sides.x, n / sides.x % sides.y, n / (sides.x * sides.y))) - reach;
    return run_of(cell + offset);
}

fn run_of(cell: vec3<i32>) -> Run {
    let index = cell_index(cell);
    return Run(start_of(index), start_of(index + 1u));
}
