// Line 10, counting sort: each cell's particles, in an order that differs
// from run to run; `reorder` ranks them. Counts return to zero.
//!include common/liquid/cells.wgsl
//!include common/liquid/particle.wgsl

@group(0) @binding(0) var<storage, read> trial: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> cell_starts: array<u32>;
@group(0) @binding(2) var<storage, read> block_sums: array<u32>;
@group(0) @binding(3) var<storage, read_write> cell_counts: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read_write> cell_items: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= COUNT) { return; }
    let cell = cell_index(cell_of(trial[id.x].xyz));
    let slot = atomicSub(&cell_counts[cell], 1u) - 1u;
    cell_items[block_sums[cell / SCAN_BLOCK] + cell_starts[cell] + slot] = id.x;
}
