// Line 28, surface tension, 3 of 8: how much of each node is solid, and how that is wetted. All blocks are claimed now, so each learns
// which are around it.
//!include common/glass/boundary.wgsl
//!include common/liquid/find_block.wgsl
//!include common/liquid/step.wgsl

/// Cosine of the contact angle of table and floor.
override GROUND_WETTING: f32 = 0.0;

@group(0) @binding(41) var<storage, read> colour_used: array<u32>;
@group(0) @binding(42) var<storage, read> colour_blocks: array<vec4<i32>>;
/// By node: S, and S·cos θ.
@group(0) @binding(45) var<storage, read_write> colour_solid: array<vec2<f32>>;
/// By block: slots of those around it, x running fastest.
@group(0) @binding(46) var<storage, read_write> colour_around: array<u32>;

/// What is solid of a node of a flask's inside, or of the outside of all.
fn solid_at(grid: u32, x: vec3<f32>) -> vec2<f32> {
    var sum = vec2<f32>(0.0);
    for (var k = 0u; k < FLASKS; k++) {
        let pose = poses[step.after + k];
        if (may_touch(k, grid, pose, x)) {
            let volume = wall_of_map(k, grid, flask_from_stage(pose, x)).volume;
            sum += volume * vec2<f32>(1.0, flasks[k].wetting);
        }
    }
    if (grid == NOBODYS) {
        let above = heights(x);
        let volume = half_space(above.table).volume + half_space(above.floor).volume;
        sum += volume * vec2<f32>(1.0, GROUND_WETTING);
    }
    return sum / max(sum.x, 1.0);
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let slot = colour_used[group.x];
    let block = colour_blocks[slot];
    if (local < AROUND) {
        let offset = vec3<i32>(vec3<u32>(local % 3u, (local / 3u) % 3u, local / 9u)) - vec3<i32>(1);
        colour_around[slot * AROUND + local] = find_block(block.xyz + offset, u32(block.w));
    }
    let x = vec3<f32>(block.xyz * 4 + node_of(local)) * NODE;
    colour_solid[slot * BLOCK_NODES + local] = solid_at(u32(block.w), x);
}
