// The cells around a place, as the last rebuild of the list filled them. Particles may have moved by the list's reach since.
//!include common/liquid/cell_starts.wgsl
//!include common/liquid/list_reach.wgsl

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

/// Cell n of those, from the one that they are around.
fn offset_around(reach: i32, n: u32) -> vec3<i32> {
    let sides = sides_around(reach);
    return vec3<i32>(vec3<u32>(n % sides.x, n / sides.x % sides.y, n / (sides.x * sides.y))) - reach;
}

/// Cell n of those.
fn cell_around(cell: vec3<i32>, reach: i32, n: u32) -> Run {
    return run_of(cell + offset_around(reach, n));
}

/// How far particles of a cell may be from it, over the list's reach: that, and where glass put them back from there.
const STRAYED: f32 = 2.0;

/// Cell n within `cells` cells of the one that `x` is in; of one whose particles are all further than `distance` (m) from `x`, none. Half
/// of the cells of a cube are such, and a loop over particles is one that Mesa 22.3's software driver ends after 65,535 turns.
fn cell_within(x: vec3<f32>, distance: f32, cells: i32, n: u32) -> Run {
    let cell = cell_of(x) + offset_around(cells, n);
    let low = vec3<f32>(cell) * CELL;
    let gap = max(max(low - x, x - low - CELL), vec3<f32>(0.0));
    // Along an edge on which the torus is smaller, a cell stands for places on both sides.
    let apart = select(vec3<f32>(0.0), gap, sides_around(cells) == vec3<u32>(u32(2 * cells + 1)));
    let near = distance + STRAYED * LIST_REACH;
    if (dot(apart, apart) > near * near) { return Run(0u, 0u); }
    return run_of(cell);
}

fn run_of(cell: vec3<i32>) -> Run {
    let index = cell_index(cell);
    return Run(start_of(index), start_of(index + 1u));
}
