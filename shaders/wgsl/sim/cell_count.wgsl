// Line 10, counting sort: particles per cell.
//!include common/liquid/cells.wgsl
//!include common/liquid/particle.wgsl

@group(0) @binding(0) var<storage, read> trial: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> cell_counts: array<atomic<u32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= COUNT) { return; }
    atomicAdd(&cell_counts[cell_index(cell_of(trial[id.x].xyz))], 1u);
}
