// Line 28, surface tension, 7 of 8: the derivative of the surface's energy by the volume that lies on each node, in σ over a
// node's distance: at a surface, its curvature. Leaves the nodes' volumes at 0.
//!include common/liquid/node_rows.wgsl

/// By row.
@group(0) @binding(44) var<storage, read_write> colour: array<vec4<u32>>;
@group(0) @binding(45) var<storage, read> unfiltered: array<vec4<f32>>;
@group(0) @binding(48) var<storage, read_write> curvature: array<vec4<f32>>;

fn row_at(slot: u32, at: vec2<i32>) -> Row {
    let rows = rows_around(slot, at);
    var found: Row;
    if (rows.y != NO_BLOCK) { found.nodes = unfiltered[rows.y]; }
    if (rows.x != NO_BLOCK) { found.before = unfiltered[rows.x].w; }
    if (rows.z != NO_BLOCK) { found.after = unfiltered[rows.z].x; }
    return found;
}

fn filtered_along_z(slot: u32, at: vec2<i32>) -> Row {
    return filtered(row_at(slot, at - vec2<i32>(0, 1)), row_at(slot, at), row_at(slot, at + vec2<i32>(0, 1)));
}

@compute @workgroup_size(16)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) row: u32) {
    let slot = colour_used[group.x];
    let at = vec2<i32>(vec2<u32>(row & 3u, row >> 2u));
    let along_z = filtered_along_z(slot, at);
    let rows = filtered(
        filtered_along_z(slot, at - vec2<i32>(1, 0)), along_z, filtered_along_z(slot, at + vec2<i32>(1, 0)));
    curvature[slot * BLOCK_ROWS + row] = filtered_along(rows);
    colour[slot * BLOCK_ROWS + row] = vec4<u32>(0u);
}
