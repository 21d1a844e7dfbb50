// Line 28, surface tension, 1 of 7: each particle's volume on the nodes about it, as sums of integers, which do not depend on
// order. Claims the blocks that these nodes are in.
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/features.wgsl
//!include common/glass/vessel.wgsl
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

/// Whether a particle's volume is part of a grid: of its own, and through a mouth of the next.
fn is_part_of(grid: u32, membership: u32, x: vec3<f32>) -> bool {
    if (grid == membership) { return true; }
    if (grid == NOBODYS) { return is_near_mouth(membership - 1u, x); }
    return membership == NOBODYS && is_near_mouth(grid - 1u, x);
}

/// Slots of the blocks, at most two along each axis, that a particle's 4 × 4 × 4 nodes from `first` on lie in; bits x, y, z
/// say which.
fn claim_blocks(grid: u32, first: vec3<i32>) -> array<u32, 8> {
    let low = first >> vec3<u32>(2u);
    let two = vec3<u32>((first + vec3<i32>(3)) >> vec3<u32>(2u)) != vec3<u32>(low);
    let within = select(vec3<u32>(0u), vec3<u32>(1u, 2u, 4u), two);
    let spans = within.x | within.y | within.z;
    var slots: array<u32, 8>;
    for (var k = 0u; k < 8u; k++) {
        let block = k & spans;
        if (block != k) {
            slots[k] = slots[block];
            continue;
        }
        slots[k] = claim(low + vec3<i32>(vec3<u32>(k & 1u, (k >> 1u) & 1u, k >> 2u)), grid);
    }
    return slots;
}

/// Adds this lane's rows of a particle's volume.
fn add_volume(grid: u32, x: vec3<f32>, volume: f32, lane: u32) {
    let below = floor(x / NODE);
    let within = x / NODE - below;
    let node = vec3<i32>(below);
    let corner = first_of_row(node, 0u);
    var slots = claim_blocks(grid, corner);
    for (var row = lane; row < ROWS; row += LANES) {
        let first = first_of_row(node, row);
        let away = vec3<f32>(first - node) - within;
        let across = spread(away.y) * spread(away.z) * volume * (COLOUR_SHARE * COLOUR_FULL);
        let beyond = vec3<u32>((first >> vec3<u32>(2u)) - (corner >> vec3<u32>(2u)));
        for (var i = 0; i < 4; i++) {
            let at = first + vec3<i32>(i, 0, 0);
            let next = u32((at.x >> 2u) - (corner.x >> 2u));
            let slot = slots[next + 2u * beyond.y + 4u * beyond.z];
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
