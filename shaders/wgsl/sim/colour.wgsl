// Line 28, surface tension, 1 of 6: each particle's volume on the nodes about it, as sums of integers, which do not depend on
// order. Claims the blocks of nodes that what follows reads about the particle.
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/features.wgsl
//!include common/glass/vessel.wgsl
//!include common/liquid/colour.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl

/// Blocks from which on the table is full, and tension is left out.
override MOST_BLOCKS: u32 = 48u;

/// V0 over a node's volume.
override COLOUR_SHARE: f32 = 1.0;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(1) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> bulk: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> list_counts: array<u32>;
@group(0) @binding(40) var<storage, read_write> colour_keys: array<atomic<u32>>;
@group(0) @binding(41) var<storage, read_write> colour_used: array<u32>;
@group(0) @binding(42) var<storage, read_write> colour_blocks: array<vec4<i32>>;
/// Blocks claimed: the dispatch size of the passes over them.
@group(0) @binding(43) var<storage, read_write> colour_args: array<atomic<u32>>;
@group(0) @binding(44) var<storage, read_write> colour: array<atomic<u32>>;

/// Slot of the block, which is made where there is none yet.
fn claim(block: vec3<i32>, grid: u32) -> u32 {
    let key = block_key(block, grid);
    var slot = slot_of(key);
    for (var tries = 0u; tries < BLOCK_SLOTS; tries++) {
        let seen = atomicLoad(&colour_keys[slot]);
        if (seen == key) { return slot; }
        if (seen == 0u) {
            if (atomicLoad(&colour_args[0]) >= MOST_BLOCKS) { return NO_BLOCK; }
            let old = atomicCompareExchangeWeak(&colour_keys[slot], 0u, key).old_value;
            if (old == 0u) {
                colour_used[atomicAdd(&colour_args[0], 1u)] = slot;
                colour_blocks[slot] = pack_block(block, grid);
                return slot;
            }
            if (old == key) { return slot; }
        }
        slot = (slot + 1u) & (BLOCK_SLOTS - 1u);
    }
    return NO_BLOCK;
}

/// How far from a mouth, in nodes, liquid is in the grids on both of its sides.
const MOUTH_REACH: f32 = 4.0;

/// Whether `x` is so near flask k's mouth.
fn is_near_mouth(k: u32, x: vec3<f32>) -> bool {
    let p = flask_from_stage(poses[step.after + k], x);
    let away = vec2<f32>(max(length(p.xz) - flasks[k].mouth, 0.0), p.y - flasks[k].rim) / NODE;
    return dot(away, away) < MOUTH_REACH * MOUTH_REACH;
}

/// Whether a particle's volume is part of a grid: of its own, and through a mouth of the next.
fn is_part_of(grid: u32, membership: u32, x: vec3<f32>) -> bool {
    if (grid == membership) { return true; }
    if (grid == NOBODYS) { return is_near_mouth(membership - 1u, x); }
    return membership == NOBODYS && is_near_mouth(grid - 1u, x);
}

/// Claims this lane's part of the blocks that what a particle feels is in.
fn claim_around(grid: u32, node: vec3<i32>, lane: u32) {
    let low = (node - vec3<i32>(NODES_BEFORE)) >> vec3<u32>(2u);
    let high = (node + vec3<i32>(NODES_BEYOND)) >> vec3<u32>(2u);
    let extent = vec3<u32>(high - low + vec3<i32>(1));
    for (var n = lane; n < extent.x * extent.y * extent.z; n += LANES) {
        let offset = vec3<u32>(n % extent.x, (n / extent.x) % extent.y, n / (extent.x * extent.y));
        claim(low + vec3<i32>(offset), grid);
    }
}

/// Adds this lane's rows of a particle's volume.
fn add_volume(grid: u32, x: vec3<f32>, volume: f32, lane: u32) {
    let below = floor(x / NODE);
    let within = x / NODE - below;
    let node = vec3<i32>(below);
    claim_around(grid, node, lane);
    for (var row = lane; row < ROWS; row += LANES) {
        let first = first_of_row(node, row);
        let away = vec3<f32>(first - node) - within;
        let across = spread(away.y) * spread(away.z) * volume * (COLOUR_SHARE * COLOUR_FULL);
        var slot = NO_BLOCK;
        for (var i = 0; i < 4; i++) {
            let at = first + vec3<i32>(i, 0, 0);
            if (i == 0 || (at.x & 3) == 0) { slot = claim(at >> vec3<u32>(2u), grid); }
            if (slot == NO_BLOCK) { continue; }
            let share = u32(round(spread(away.x + f32(i)) * across));
            atomicAdd(&colour[slot * BLOCK_NODES + node_in_block(at)], share);
        }
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= COUNT) { return; }
    let membership = tags[i].x;
    if (membership == REMOVED || list_counts[i] < FEWEST) { return; }
    let x = position[i].xyz;
    var volume = 1.0;
    if (DENSITY) { volume = unpack_bulk(bulk[i]).volume; }
    for (var grid = 0u; grid <= FLASKS; grid++) {
        if (is_part_of(grid, membership, x)) { add_volume(grid, x, volume, lane); }
    }
}
