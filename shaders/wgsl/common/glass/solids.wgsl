// The paper's boundary: solid particles on the glass (Akinci et al. 2012). They
// do not move in their flask's frame, so they are sorted once, on the host,
// into cells of one support radius in that frame, and each cell lists all
// that reach into it: a particle of the liquid looks into one cell, in one loop.

/// The cells of one flask, x running fastest.
struct SolidCells {
    /// Low corner in the flask's frame, metres.
    low_x: f32,
    low_y: f32,
    low_z: f32,
    /// Cells along x, y and z.
    count_x: u32,
    count_y: u32,
    count_z: u32,
    /// Place of the first cell in `solid_starts`.
    first: u32,
}

@group(0) @binding(27) var<storage, read> solid_cells: array<SolidCells>;
/// Place of each cell's first solid in `solids`; the next cell's is its end.
@group(0) @binding(28) var<storage, read> solid_starts: array<u32>;
/// (position in the flask's frame, volume times W(0)), a solid as often as cells list it.
@group(0) @binding(29) var<storage, read> solids: array<vec4<f32>>;

/// This lane's part of flask k's wall at `p`, in the flask's frame.
fn wall_of_solids(k: u32, p: vec3<f32>, lane: u32) -> Wall {
    let low = vec3<f32>(solid_cells[k].low_x, solid_cells[k].low_y, solid_cells[k].low_z);
    let counts = vec3<u32>(solid_cells[k].count_x, solid_cells[k].count_y, solid_cells[k].count_z);
    let at = floor((p - low) / SUPPORT);
    let edge = clamp(at, vec3<f32>(0.0), vec3<f32>(counts - 1u));
    // What is no number has no cell, and must not be an index either.
    let c = min(vec3<u32>(edge), counts - 1u);
    let cell = solid_cells[k].first + c.x + counts.x * (c.y + counts.y * c.z);
    let begin = solid_starts[cell];
    let end = select(begin, solid_starts[cell + 1u], all(at == edge));
    var wall = Wall(vec3<f32>(0.0), 0.0);
    for (var n = begin + lane; n < end; n += LANES) {
        let solid = solids[n];
        let volume = solid.w;
        let offset = p - solid.xyz;
        let square = max(dot(offset, offset), 1e-12 * SUPPORT * SUPPORT);
        let per_distance = inverseSqrt(square);
        let q = square * per_distance * INVERSE_SUPPORT;
        wall.volume += volume * spline(q);
        wall.gradient += offset * (volume * per_distance * spline_slope(q) / SUPPORT);
    }
    return wall;
}
