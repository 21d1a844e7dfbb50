// Line 28, surface tension, 6 of 8: the derivative of the surface's energy by the colour of each node, which is still to be filtered.
//!include common/liquid/blocks_around.wgsl
//!include common/liquid/find_block.wgsl

@group(0) @binding(46) var<storage, read> interface_stress: array<vec4<f32>>;
@group(0) @binding(47) var<storage, read> smooth_colour: array<vec4<f32>>;
/// By node.
@group(0) @binding(48) var<storage, read_write> unfiltered: array<f32>;

fn stress_at(slot: u32, cell: vec3<i32>) -> vec4<f32> {
    let place = place_around(slot, cell);
    if (place == NO_BLOCK) { return vec4<f32>(0.0); }
    return interface_stress[place];
}

/// What two cells along z have for the node between them: slopes along x and y, and the rest.
fn along_z(slot: u32, cell: vec3<i32>) -> vec3<f32> {
    let before = stress_at(slot, cell);
    let after = stress_at(slot, cell + vec3<i32>(0, 0, 1));
    let sum = before + after;
    return vec3<f32>(sum.xy, 0.25 * (before.z - after.z) + 0.125 * sum.w);
}

/// The same of four cells: the slope along x, and the rest.
fn along_y(slot: u32, cell: vec3<i32>) -> vec2<f32> {
    let before = along_z(slot, cell);
    let after = along_z(slot, cell + vec3<i32>(0, 1, 0));
    return vec2<f32>(before.x + after.x, 0.25 * (before.y - after.y) + before.z + after.z);
}

/// What the eight cells about a node have for it: the difference's transpose, −∇· in the continuum. Axis by axis, since what is
/// not along a slope's axis is only summed.
fn gathered(slot: u32, node: vec3<i32>) -> f32 {
    let before = along_y(slot, node - vec3<i32>(1));
    let after = along_y(slot, node - vec3<i32>(0, 1, 1));
    return 0.25 * (before.x - after.x) + before.y + after.y;
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let slot = colour_used[group.x];
    let place = slot * BLOCK_NODES + local;
    if (!is_near_colour(slot)) {
        unfiltered[place] = 0.0;
        return;
    }
    unfiltered[place] = gathered(slot, node_of(local)) * smooth_colour[place].w;
}
