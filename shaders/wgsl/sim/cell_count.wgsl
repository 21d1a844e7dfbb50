// Line 10, counting sort: particles per cell and per block of them, and each cell's first ones, in an order that differs from run to run;
// `reorder` ranks them.
//!include common/liquid/cell_items.wgsl
//!include common/liquid/sleep_cells.wgsl

@group(0) @binding(0) var<storage, read> trial: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> cell_counts: array<atomic<u32>>;
@group(0) @binding(2) var<storage, read_write> block_counts: array<atomic<u32>>;
@group(0) @binding(3) var<storage, read_write> cell_items: array<u32>;
/// (membership, identity)
@group(0) @binding(4) var<storage, read> tags: array<vec2<u32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= sorted_count()) { return; }
    let cell = cell_index(cell_of(trial[id.x].xyz)) + table_half_of(tags[id.x].x);
    let n = atomicAdd(&cell_counts[cell], 1u);
    atomicAdd(&block_counts[cell / SCAN_BLOCK], 1u);
    if (n < CELL_ITEMS) { cell_items[item_of(cell, n)] = id.x; }
}
