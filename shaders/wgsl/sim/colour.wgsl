// Line 28, surface tension, 1 of 8: each particle's volume on the nodes about it, as sums of integers, which do not depend on
// order. Claims the blocks that these nodes are in.
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/features.wgsl
//!include common/glass/vessel.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/blocks_about.wgsl
//!include common/liquid/claim_block.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl

/// V0 over a node's volume.
override COLOUR_SHARE: f32 = 1.0;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(1) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> bulk: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> list_counts: array<u32>;
@group(0) @binding(44) var<storage, read_write> colour: array<atomic<u32>>;

/// How far from a mouth, in nodes, liquid is in the grids on both of its sides.
const MOUTH_REACH: f32 = 4.0;

/// Whether `x` is so near flask k's mouth.
fn is_near_mouth(k: u32, x: vec3<f32>) -> bool {
    let p = flask_from_stage(poses[step.after + k], x);
    let away = vec2<f32>(max(length(p.xz) - flasks[k].mouth, 0.0), p.y - flasks[k].rim) / NODE;
    return dot(away, away) < MOUTH_REACH * MOUTH_REACH;
}

/// Whether a particle's volume is part of a grid beside its own: through a mouth of the next.
fn is_part_of(grid: u32, membership: u32, x: vec3<f32>) -> bool {
    if (grid == NOBODYS) { return is_near_mouth(membership - 1u, x); }
    return membership == NOBODYS && is_near_mouth(grid - 1u, x);
}

/// None for a particle that takes no part: its lanes go along.
fn block_slot(block: vec3<i32>, grid: u32) -> u32 {
    if (grid == REMOVED) { return NO_BLOCK; }
    return claim(block, grid);
}

/// First of the nodes that a particle's volume is spread over.
fn first_of(x: vec3<f32>) -> vec3<i32> {
    return first_of_row(vec3<i32>(floor(x / NODE)), 0u);
}

/// Adds this lane's rows of a particle's volume to the blocks with these slots.
fn add_volume(x: vec3<f32>, volume: f32, lane: u32, blocks: array<u32, 8>) {
    var slots = blocks;
    let below = floor(x / NODE);
    let within = x / NODE - below;
    let node = vec3<i32>(below);
    for (var row = lane; row < ROWS; row += LANES) {
        let first = first_of_row(node, row);
        let away = vec3<f32>(first - node) - within;
        let across = spread(away.y) * spread(away.z) * volume * (COLOUR_SHARE * COLOUR_FULL);
        let row_place = place_of_row(first_of_row(node, 0u), first);
        for (var i = 0; i < 4; i++) {
            let at = first + vec3<i32>(i, 0, 0);
            let slot = slots[place_in_row(row_place, first, i)];
            if (slot == NO_BLOCK) { continue; }
            let share = u32(round(spread(away.x + f32(i)) * across));
            atomicAdd(&colour[slot * BLOCK_NODES + node_in_block(at)], share);
        }
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(subgroup_invocation_id) in_subgroup: u32) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= awake_count()) { return; }
    let membership = tags[i].x;
    let own_grid = select(REMOVED, membership, list_counts[i] >= FEWEST);
    let x = position[i].xyz;
    let slots = slots_together(blocks_about(own_grid, first_of(x)), lane, in_subgroup);
    if (own_grid == REMOVED) { return; }
    var volume = 1.0;
    if (DENSITY) { volume = unpack_bulk(bulk[i]).volume; }
    add_volume(x, volume, lane, slots);
    for (var grid = 0u; grid <= FLASKS; grid++) {
        if (grid != membership && is_part_of(grid, membership, x)) {
            // Not together: where particles differ, Vulkan does not promise that a particle's lanes meet.
            add_volume(x, volume, lane, slots_alone(blocks_about(grid, first_of(x))));
        }
    }
}
