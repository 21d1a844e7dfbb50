// Line 28, surface tension, 4 of 8: the colour of what is not solid, filtered.
//!include common/liquid/find_block.wgsl
//!include common/liquid/node_rows.wgsl
//!include common/liquid/surface_energy.wgsl

/// By row.
@group(0) @binding(44) var<storage, read> colour: array<vec4<u32>>;
/// S and S·cos θ by node, two to each.
@group(0) @binding(45) var<storage, read> colour_solid: array<vec4<f32>>;
/// By node: colour, S, S·cos θ, and 1 over the share that is not solid.
@group(0) @binding(47) var<storage, read_write> smooth_colour: array<vec4<f32>>;

/// Of a row's nodes.
struct Rows {
    colour: Row,
    solid: Row,
    wetted: Row,
}

fn rows_at(slot: u32, at: vec2<i32>) -> Rows {
    let rows = rows_around(slot, at);
    var found: Rows;
    if (rows.y != NO_BLOCK) {
        let near = colour_solid[2u * rows.y];
        let far = colour_solid[2u * rows.y + 1u];
        found.colour.nodes = vec4<f32>(colour[rows.y]) / COLOUR_FULL;
        found.solid.nodes = vec4<f32>(near.xz, far.xz);
        found.wetted.nodes = vec4<f32>(near.yw, far.yw);
    }
    if (rows.x != NO_BLOCK) {
        let last = colour_solid[2u * rows.x + 1u];
        found.colour.before = f32(colour[rows.x].w) / COLOUR_FULL;
        found.solid.before = last.z;
        found.wetted.before = last.w;
    }
    if (rows.z != NO_BLOCK) {
        let first = colour_solid[2u * rows.z];
        found.colour.after = f32(colour[rows.z].x) / COLOUR_FULL;
        found.solid.after = first.x;
        found.wetted.after = first.y;
    }
    return found;
}

fn filtered_rows(before: Rows, here: Rows, after: Rows) -> Rows {
    return Rows(
        filtered(before.colour, here.colour, after.colour),
        filtered(before.solid, here.solid, after.solid),
        filtered(before.wetted, here.wetted, after.wetted));
}

fn filtered_along_z(slot: u32, at: vec2<i32>) -> Rows {
    return filtered_rows(rows_at(slot, at - vec2<i32>(0, 1)), rows_at(slot, at), rows_at(slot, at + vec2<i32>(0, 1)));
}

/// 1 over the share of a node that is not solid; 0 where that is too little.
fn space_of(solid: f32) -> f32 {
    let space = 1.0 - solid;
    return select(0.0, 1.0 / space, space > LEAST_SPACE);
}

@compute @workgroup_size(16)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) row: u32) {
    let slot = colour_used[group.x];
    let first = slot * BLOCK_NODES + 4u * row;
    if (!is_near_colour(slot)) {
        for (var n = 0u; n < 4u; n++) { smooth_colour[first + n] = vec4<f32>(0.0, 0.0, 0.0, 1.0); }
        return;
    }
    let at = vec2<i32>(vec2<u32>(row & 3u, row >> 2u));
    let along_z = filtered_along_z(slot, at);
    let rows = filtered_rows(
        filtered_along_z(slot, at - vec2<i32>(1, 0)), along_z, filtered_along_z(slot, at + vec2<i32>(1, 0)));
    let liquid = filtered_along(rows.colour);
    let solid = filtered_along(rows.solid);
    let wetted = filtered_along(rows.wetted);
    for (var n = 0u; n < 4u; n++) {
        let space = space_of(solid[n]);
        smooth_colour[first + n] = vec4<f32>(liquid[n] * space, solid[n], wetted[n], space);
    }
}
