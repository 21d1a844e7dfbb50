// Line 28, surface tension, 8 of 8: the force of the surface's energy on each particle, −V_i ∇ of what a volume there costs,
// as the change of velocity over the time until it is found again. And what walls hold it back with until then.
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/features.wgsl
//!include common/chemistry/heat.wgsl
//!include common/chemistry/surface_tension.wgsl
//!include common/glass/boundary.wgsl
//!include common/glass/wall.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/blocks_about.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/find_block.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl
//!include common/liquid/velocity.wgsl

/// σ/(ρ0·node²), m/s².
override TENSION: f32 = 0.0;
/// Blocks from which on the table is full, and tension is left out.
override MOST_BLOCKS: u32 = 48u;
/// What of σ·sin θ holds a line: the sine of half of the difference between the advancing and the receding contact angle, over the
/// share of it that comes to particles.
override HYSTERESIS: f32 = 0.0;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(1) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> bulk: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read_write> new_velocity: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> wall_push: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> counters: Counters;
@group(0) @binding(6) var<storage, read> list_counts: array<u32>;
@group(0) @binding(7) var<storage, read> heat: array<vec4<f32>>;
@group(0) @binding(43) var<storage, read> colour_args: array<u32>;
@group(0) @binding(48) var<storage, read> curvature: array<f32>;
@group(0) @binding(49) var<storage, read> line_hold: array<vec4<f32>>;
/// By identity: the acceleration (m/s²) that holds a particle back along its direction, and the flask that holds it, from 1 on;
/// 0 for table and floor.
@group(0) @binding(50) var<storage, read_write> held: array<vec4<f32>>;
@group(0) @binding(51) var<storage, read> boundary: array<vec4<f32>>;

fn block_slot(block: vec3<i32>, grid: u32) -> u32 {
    return find_block(block, grid);
}

/// ∇ of the curvature at `x`, per node, from the blocks with these slots: this lane's rows of it.
fn curvature_slope(x: vec3<f32>, lane: u32, blocks: array<u32, 8>) -> vec3<f32> {
    var slots = blocks;
    let below = floor(x / NODE);
    let within = x / NODE - below;
    let node = vec3<i32>(below);
    var sum = vec3<f32>(0.0);
    for (var row = lane; row < ROWS; row += LANES) {
        let first = first_of_row(node, row);
        let away = vec3<f32>(first - node) - within;
        // Σ of the row's values by the weights along x, and by their slopes.
        var along = vec2<f32>(0.0);
        let row_place = place_of_row(first_of_row(node, 0u), first);
        for (var i = 0; i < 4; i++) {
            let at = first + vec3<i32>(i, 0, 0);
            let slot = slots[place_in_row(row_place, first, i)];
            if (slot == NO_BLOCK) { continue; }
            let value = curvature[slot * BLOCK_NODES + node_in_block(at)];
            let distance = away.x + f32(i);
            along += value * vec2<f32>(spread(distance), spread_slope(distance));
        }
        let weight = vec2<f32>(spread(away.y), spread(away.z));
        let slope = vec2<f32>(spread_slope(away.y), spread_slope(away.z));
        sum -= vec3<f32>(along.y * weight.x * weight.y, along.x * slope.x * weight.y, along.x * weight.x * slope.y);
    }
    return sum;
}

/// `x` in nodes, from a node's cell: cells lie half a node beyond it.
fn in_cells(x: vec3<f32>) -> vec3<f32> {
    return x / NODE - 0.5;
}

/// What the cells around `x` hold there, from the blocks with these slots: this lane's rows of it.
fn hold_at(x: vec3<f32>, lane: u32, blocks: array<u32, 8>) -> vec3<f32> {
    var slots = blocks;
    let at_cells = in_cells(x);
    let below = floor(at_cells);
    let within = at_cells - below;
    let cell = vec3<i32>(below);
    var sum = vec3<f32>(0.0);
    for (var row = lane; row < ROWS; row += LANES) {
        let first = first_of_row(cell, row);
        let away = vec3<f32>(first - cell) - within;
        var along = vec3<f32>(0.0);
        let row_place = place_of_row(first_of_row(cell, 0u), first);
        for (var i = 0; i < 4; i++) {
            let at = first + vec3<i32>(i, 0, 0);
            let slot = slots[place_in_row(row_place, first, i)];
            if (slot == NO_BLOCK) { continue; }
            along += line_hold[slot * BLOCK_NODES + node_in_block(at)].xyz * spread(away.x + f32(i));
        }
        sum += along * spread(away.y) * spread(away.z);
    }
    return sum;
}

/// The wall that has most of what a particle at `x` touches: a flask, from 1 on, or 0 for table and floor.
fn holder_of(membership: u32, x: vec3<f32>) -> u32 {
    if (membership != NOBODYS) { return membership; }
    var holder = 0u;
    let above = heights(x);
    var most = half_space(above.table).volume + half_space(above.floor).volume;
    for (var k = 0u; k < FLASKS; k++) {
        let pose = poses[step.after + k];
        if (may_touch(k, membership, pose, x)) {
            let volume = wall_of_map(k, membership, flask_from_stage(pose, x)).volume;
            if (volume > most) {
                most = volume;
                holder = k + 1u;
            }
        }
    }
    return holder;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(subgroup_invocation_id) in_subgroup: u32) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (colour_args[0] >= MOST_BLOCKS) {
        if (id.x == 0u) { atomicAdd(&counters.tension_skipped, 1u); }
        if (HYSTERESIS > 0.0 && lane == 0u && i < awake_count()) { held[tags[i].y] = vec4<f32>(0.0); }
        return;
    }
    if (i >= awake_count()) { return; }
    let membership = tags[i].x;
    let takes_part = membership != REMOVED && list_counts[i] >= FEWEST;
    let x = position[i].xyz;
    var slope = vec3<f32>(0.0);
    let first = first_of_row(vec3<i32>(floor(x / NODE)), 0u);
    let around_nodes = slots_together(blocks_about(membership, first), lane, in_subgroup);
    if (takes_part) { slope = curvature_slope(x, lane, around_nodes); }
    slope = lane_sum3(slope);
    var hold = vec3<f32>(0.0);
    if (HYSTERESIS > 0.0) {
        let first_cell = first_of_row(vec3<i32>(floor(in_cells(x))), 0u);
        let around_cells = slots_together(blocks_about(membership, first_cell), lane, in_subgroup);
        // Further off there is a twentieth of it, not worth the fetches.
        if (takes_part && wall_volume(boundary[i]) > 0.0) { hold = hold_at(x, lane, around_cells); }
        hold = lane_sum3(hold);
    }
    if (lane != 0u) { return; }
    if (!takes_part) {
        if (HYSTERESIS > 0.0) { held[tags[i].y] = vec4<f32>(0.0); }
        return;
    }
    var strength = TENSION;
    if (DENSITY) { strength *= unpack_bulk(bulk[i]).lightness; }
    if (HEAT) { strength *= relative_tension(acid_in(heat[i]), temperature_in(heat[i])); }
    if (HYSTERESIS > 0.0) {
        var holder = 0u;
        if (any(hold != vec3<f32>(0.0))) { holder = holder_of(membership, x); }
        held[tags[i].y] = vec4<f32>(strength * hold, f32(holder));
    }
    let change = -strength * step.tension * slope;
    let before = new_velocity[i];
    new_velocity[i] = pack_velocity(before.xyz + change, carried_by(before));
    // What liquid does to itself sums to nothing; what is left over a flask's liquid is its glass's.
    if (LOADS && membership != NOBODYS) { wall_push[i] += vec4<f32>(step.time * change, 0.0); }
}
