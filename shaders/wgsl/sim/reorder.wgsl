// Line 11: all of a particle's state to its place by cell, and within a cell
// by its former index, so that the order (and so every sum) repeats. Counts return to zero.
//!include common/chemistry/features.wgsl
//!include common/liquid/cell_items.wgsl
//!include common/liquid/cell_starts.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/trial.wgsl

@group(0) @binding(0) var<storage, read> trial: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> velocity: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read> cell_starts: array<u32>;
@group(0) @binding(5) var<storage, read_write> cell_counts: array<u32>;
@group(0) @binding(6) var<storage, read> cell_items: array<u32>;
@group(0) @binding(7) var<storage, read_write> sorted_trial: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> sorted_position: array<vec4<f32>>;
@group(0) @binding(9) var<storage, read_write> sorted_velocity: array<vec4<f32>>;
@group(0) @binding(10) var<storage, read_write> sorted_tags: array<vec2<u32>>;
@group(0) @binding(11) var<storage, read> wall_push: array<vec4<f32>>;
@group(0) @binding(12) var<storage, read_write> sorted_push: array<vec4<f32>>;
@group(0) @binding(13) var<storage, read> heat: array<vec4<f32>>;
@group(0) @binding(14) var<storage, read_write> sorted_heat: array<vec4<f32>>;
@group(0) @binding(15) var<storage, read> matter: array<vec4<f32>>;
@group(0) @binding(16) var<storage, read_write> sorted_matter: array<vec4<f32>>;
@group(0) @binding(17) var<storage, read> bulk: array<vec4<f32>>;
@group(0) @binding(18) var<storage, read_write> sorted_bulk: array<vec4<f32>>;
@group(0) @binding(19) var<storage, read> eddies: array<vec2<f32>>;
@group(0) @binding(31) var<storage, read_write> sorted_eddies: array<vec2<f32>>;
@group(0) @binding(32) var<storage, read_write> block_counts: array<u32>;

/// 1 where particle `other` is in the cell and comes before particle i, else 0.
fn one_before(other: u32, i: u32, cell: u32) -> u32 {
    let j = min(other, i);
    let is_there = cell_index(cell_of(trial[j].xyz)) + table_half_of(tags[j].x) == cell;
    return select(0u, select(0u, 1u, is_there), other < i);
}

/// The same of four particles from `first` on.
fn four_before(first: u32, i: u32, cell: u32) -> u32 {
    return one_before(first, i, cell) + one_before(first + 1u, i, cell) + one_before(first + 2u, i, cell)
        + one_before(first + 3u, i, cell);
}

/// The same of sixteen.
fn sixteen_before(first: u32, i: u32, cell: u32) -> u32 {
    return four_before(first, i, cell) + four_before(first + 4u, i, cell) + four_before(first + 8u, i, cell)
        + four_before(first + 12u, i, cell);
}

/// How many of a cell's `count` particles come before particle i.
fn rank_in_cell(i: u32, cell: u32, count: u32) -> u32 {
    var rank = 0u;
    if (count <= CELL_ITEMS) {
        for (var n = 0u; n < count; n++) { rank += select(0u, 1u, cell_items[item_of(cell, n)] < i); }
        return rank;
    }
    // Which of a crowd were noted is chance, so all are asked. 32 a turn: Mesa 22.3's software driver ends all loops of an invocation
    // after 65,535 turns, and lets buffers hold 1.25 million particles.
    for (var first = 0u; first < i; first += 32u) { rank += sixteen_before(first, i, cell) + sixteen_before(first + 16u, i, cell); }
    return rank;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x;
    if (i >= sorted_count()) { return; }
    let x = trial[i];
    let tag = tags[i];
    let cell = cell_index(cell_of(x.xyz)) + table_half_of(tag.x);
    let start = start_of(cell);
    let to = start + rank_in_cell(i, cell, start_of(cell + 1u) - start);
    cell_counts[cell] = 0u;
    block_counts[cell / SCAN_BLOCK] = 0u;
    // The list pass reads both of every candidate: one fetch in place of two.
    sorted_trial[to] = pack_sorted_trial(x.xyz, tag.x);
    sorted_position[to] = position[i];
    sorted_velocity[to] = velocity[i];
    sorted_tags[to] = tag;
    if (LOADS) { sorted_push[to] = wall_push[i]; }
    if (HEAT) { sorted_heat[to] = heat[i]; }
    if (PHYSICAL) { sorted_matter[to] = matter[i]; }
    if (PHYSICAL) { sorted_bulk[to] = bulk[i]; }
    if (PHYSICAL) { sorted_eddies[to] = eddies[i]; }
}
